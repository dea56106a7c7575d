//! The second factor of the split sum as a small table: the reflection of uniform light by a rough mirror.

use gonio_light::microfacet::environment_brdf;
use gonio_threads::prelude::*;
use std::sync::OnceLock;

/// Scale and bias of [`environment_brdf`] over the view's cosine and the roughness.
///
/// A texture of [`Self::SIZE`] x [`Self::SIZE`] with two channels: columns are the *square root* of the cosine from 0
/// to 1 (all that is steep happens at grazing), rows the roughness from 0 to 1. The first and the last texel's *middles* are the ends, so that roughness 0 is exact; a shader asks at
/// [`Self::coordinates`] with linear filtering.
#[derive(Clone, Debug, PartialEq)]
pub struct BrdfTable {
    values: Vec<[f32; 2]>,
}

impl BrdfTable {
    /// Texels along an edge. With 64 the interpolation errs by 0.0025 at most, but for roughnesses below 0.1 seen within
    /// a degree (a cosine of 0.02) of edge on, where it errs by up to 0.06.
    pub const SIZE: usize = 64;

    /// Returns the table, computed at the first call in some 30 ms.
    pub fn get() -> &'static BrdfTable {
        static TABLE: OnceLock<BrdfTable> = OnceLock::new();
        TABLE.get_or_init(|| {
            let at = |i: usize| i as f64 / (Self::SIZE - 1) as f64;
            let texel = |i: usize| {
                let (scale, bias) = environment_brdf(at(i % Self::SIZE).powi(2), at(i / Self::SIZE));
                [scale as f32, bias as f32]
            };
            BrdfTable { values: (0..Self::SIZE * Self::SIZE).into_par_iter().map(texel).collect() }
        })
    }

    /// Returns (scale, bias) of each texel, rows of equal roughness, smooth first: ready for a texture.
    pub fn values(&self) -> &[[f32; 2]] {
        &self.values
    }

    /// Returns the texture coordinates, `s` and `t` from 0 to 1; a cosine or a roughness beyond `[0, 1]` counts as the end, NaN as 0.
    pub fn coordinates(cos_v: f64, roughness: f64) -> (f64, f64) {
        let from_middle_to_middle = |v: f64| (0.5 + v * (Self::SIZE - 1) as f64) / Self::SIZE as f64;
        (from_middle_to_middle(held(cos_v).sqrt()), from_middle_to_middle(held(roughness)))
    }

    /// Returns (scale, bias), bilinear as the texture at the [coordinates](Self::coordinates).
    pub fn lookup(&self, cos_v: f64, roughness: f64) -> (f64, f64) {
        let last = Self::SIZE - 1;
        let place = |value: f64| {
            let at = value * last as f64;
            ((at as usize).min(last - 1), at - (at as usize).min(last - 1) as f64)
        };
        let ((column, right), (row, down)) = (place(held(cos_v).sqrt()), place(held(roughness)));
        let mixed = |channel: usize| {
            let at = |dy: usize, dx: usize| f64::from(self.values[(row + dy) * Self::SIZE + column + dx][channel]);
            let upper = at(0, 0) + right * (at(0, 1) - at(0, 0));
            let lower = at(1, 0) + right * (at(1, 1) - at(1, 0));
            upper + down * (lower - upper)
        };
        (mixed(0), mixed(1))
    }
}

fn held(value: f64) -> f64 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_its_function() {
        let table = BrdfTable::get();
        for i in 0..=50 {
            for j in 0..=50 {
                // Not on the grid.
                let (cos_v, roughness) = (0.01 + 0.0196 * f64::from(i), 0.0199 * f64::from(j));
                let (scale, bias) = environment_brdf(cos_v, roughness);
                let (got_scale, got_bias) = table.lookup(cos_v, roughness);
                // As its documentation says.
                let tolerance = if roughness > 0.1 || cos_v > 0.02 { 2.5e-3 } else { 0.06 };
                assert!((got_scale - scale).abs() < tolerance, "{cos_v} {roughness}: {got_scale} is not {scale}");
                assert!((got_bias - bias).abs() < tolerance, "{cos_v} {roughness}: {got_bias} is not {bias}");
                assert!(got_scale + got_bias <= 1.0 + 1e-6);
            }
        }
        // A smooth mirror at normal view; values beyond the ends.
        let (scale, bias) = table.lookup(1.0, 0.0);
        assert!((scale - 1.0).abs() < 1e-6 && bias.abs() < 1e-6);
        assert_eq!(table.lookup(7.0, -1.0), table.lookup(1.0, 0.0));
        assert_eq!(table.lookup(f64::NAN, 9.0), table.lookup(0.0, 1.0));
    }

    #[test]
    fn a_texture_with_linear_filtering_gives_the_same() {
        let table = BrdfTable::get();
        // As OpenGL defines it (OpenGL 4.6, section 8.14.3), clamped to the edge.
        let texture = |s: f64, t: f64, channel: usize| {
            let (x, y) = (s * BrdfTable::SIZE as f64 - 0.5, t * BrdfTable::SIZE as f64 - 0.5);
            let texel = |x: f64, y: f64| {
                let held = |v: f64| v.clamp(0.0, (BrdfTable::SIZE - 1) as f64) as usize;
                f64::from(table.values()[held(y) * BrdfTable::SIZE + held(x)][channel])
            };
            let (a, b) = (x - x.floor(), y - y.floor());
            let row = |y: f64| (1.0 - a) * texel(x.floor(), y) + a * texel(x.floor() + 1.0, y);
            (1.0 - b) * row(y.floor()) + b * row(y.floor() + 1.0)
        };
        for (cos_v, roughness) in [(0.0, 0.0), (1.0, 1.0), (0.37, 0.81), (0.5, 0.02), (2.0, -3.0)] {
            let (s, t) = BrdfTable::coordinates(cos_v, roughness);
            let (scale, bias) = table.lookup(cos_v, roughness);
            assert!((texture(s, t, 0) - scale).abs() < 1e-12 && (texture(s, t, 1) - bias).abs() < 1e-12);
        }
    }
}
