//! Scales of values, with their ticks; numbers as text.

use plotters::coord::ranged1d::BoldPoints;
use plotters::coord::ranged1d::{KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

named_enum! {
    /// The scale of plotted values.
    pub enum PlotScale {
        /// Lengths are proportional to values
        Linear = "linear",
        /// Equal lengths are equal factors, over five powers of ten below the largest value
        Log = "log",
        /// Lengths are proportional to cube roots, which show highlights and the rest together
        CubeRoot = "cube-root",
    }
    default Linear;
    what "scale";
}

/// Powers of ten below the largest value that a logarithmic scale shows.
const DECADES: f64 = 5.0;

impl PlotScale {
    /// The position of a value, 0 at the origin and 1 at `largest`. Values below the origin have negative positions on a
    /// linear or cube-root scale, and 0 on a logarithmic one.
    pub fn position(self, value: f64, largest: f64) -> f64 {
        match self {
            PlotScale::Linear => value / largest,
            PlotScale::CubeRoot => (value / largest).cbrt(),
            PlotScale::Log => {
                if value > 0.0 {
                    (1.0 + (value / largest).log10() / DECADES).max(0.0)
                } else {
                    0.0
                }
            }
        }
    }

    /// The least value on an axis that ends at `largest`: 0 has no place on a logarithmic one.
    pub fn least(self, largest: f64) -> f64 {
        if self == PlotScale::Log { largest / 10_f64.powf(DECADES) * (1.0 - 1e-9) } else { f64::NEG_INFINITY }
    }

    /// A value at or above `value` at which an axis may end.
    pub fn end(self, value: f64) -> f64 {
        if !(value.is_finite() && value > 0.0) {
            return 1.0;
        }
        match self {
            PlotScale::Log => 10_f64.powf(value.log10().ceil()),
            _ => {
                let step = 10_f64.powf(value.log10().floor());
                let share = value / step;
                let ends = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
                step * ends.into_iter().find(|end| *end >= share * (1.0 - 1e-9)).unwrap_or(10.0)
            }
        }
    }

    /// Values with a tick, from the origin to `largest`.
    pub fn ticks(self, largest: f64) -> Vec<f64> {
        match self {
            PlotScale::Linear => linear_ticks(0.0, largest, 6),
            PlotScale::Log => (0..=DECADES as i32).rev().map(|decade| largest / 10_f64.powi(decade)).collect(),
            PlotScale::CubeRoot => {
                let mut ticks = vec![0.0];
                let first = largest.log10().floor() as i32 - 4;
                for decade in first..=first + 5 {
                    for digit in [1.0, 2.0, 5.0] {
                        let value = digit * 10_f64.powi(decade);
                        let last = ticks.last().copied().unwrap_or(0.0);
                        let gap = self.position(value, largest) - self.position(last, largest);
                        if gap >= 0.13 && value <= largest * (1.0 + 1e-9) {
                            ticks.push(value);
                        }
                    }
                }
                ticks
            }
        }
    }
}

/// Round values between two others, at most `most` of them, as the plotting library chooses them.
pub fn linear_ticks(from: f64, to: f64, most: usize) -> Vec<f64> {
    RangedCoordf64::from(from..to).key_points(hint(most))
}

fn hint(most: usize) -> impl KeyPointHint {
    BoldPoints(most)
}

/// A value as text of at most four digits, with a minus sign of the font.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value < 0.0 {
        return format!("\u{2212}{}", number(size));
    }
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e5).contains(&size) {
        let exponent = size.log10().floor();
        let digits = trimmed(format!("{:.2}", value / 10_f64.powf(exponent)));
        return format!("{digits}e{exponent}");
    }
    let decimals = (3.0 - size.log10().floor()).clamp(0.0, 7.0) as usize;
    trimmed(format!("{value:.decimals$}"))
}

fn trimmed(text: String) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_run_from_0_to_1() {
        for scale in PlotScale::ALL {
            assert!((scale.position(7.0, 7.0) - 1.0).abs() < 1e-12);
            assert_eq!(scale.position(0.0, 7.0), 0.0);
            let ticks = scale.ticks(7.0);
            assert!((4..=8).contains(&ticks.len()), "{scale} {ticks:?}");
            assert!(ticks.windows(2).all(|pair| scale.position(pair[0], 7.0) < scale.position(pair[1], 7.0)));
        }
        assert_eq!(PlotScale::CubeRoot.position(1.0, 8.0), 0.5);
        assert!((PlotScale::Log.position(1e-3, 1e2)).abs() < 1e-12);
    }

    #[test]
    fn axes_end_at_round_values() {
        let ends = [(0.31, 0.4), (1.0, 1.0), (7.3, 8.0), (1234.0, 1500.0)];
        assert!(ends.iter().all(|(value, end)| (PlotScale::Linear.end(*value) - end).abs() < 1e-9 * end));
        assert_eq!(PlotScale::Log.end(34.0), 100.0);
        assert_eq!((PlotScale::Linear.end(0.0), PlotScale::Linear.end(f64::NAN)), (1.0, 1.0));
    }

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 0.3, 1.0, 45.0, 1500.0, 2e-5, 3.183_098_86, 2.5e7, -0.25].map(number);
        assert_eq!(texts, ["0", "0.3", "1", "45", "1500", "2e-5", "3.183", "2.5e7", "\u{2212}0.25"]);
    }
}
