//! The parts of a plot as data: lines, areas, dots, texts, pictures.
//!
//! Places are in pixels of the paper, x to the right and y downwards. [`crate::canvas`] draws the parts as SVG and PNG; a window
//! draws them with its own painter.

use crate::palette::Rgb8;
use gonio_image::EncodedPicture;
use serde::{Deserialize, Serialize};

/// Which point of a text lies at its position, horizontally.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextAlign {
    /// The text begins there.
    Start,
    /// Its middle.
    Middle,
    /// The text ends there.
    End,
}

/// A part of a plot. Later ones cover earlier ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PlotShape {
    /// A line through at least two points.
    Line {
        /// The points.
        points: Vec<[f64; 2]>,
        /// The colour.
        color: Rgb8,
        /// The width in pixels.
        width: f64,
    },
    /// A filled polygon.
    Area {
        /// The corners.
        points: Vec<[f64; 2]>,
        /// The colour.
        color: Rgb8,
    },
    /// A filled circle.
    Dot {
        /// The centre.
        center: [f64; 2],
        /// The radius in pixels.
        radius: f64,
        /// The colour.
        color: Rgb8,
        /// 0 is invisible, 1 covers what is below.
        opacity: f64,
    },
    /// A line of text in Inter.
    Text {
        /// The place, vertically the middle of the line.
        at: [f64; 2],
        /// The text.
        text: String,
        /// The size of the font in pixels.
        size: f64,
        /// The colour.
        color: Rgb8,
        /// The point of the text at `at`.
        align: TextAlign,
        /// Whether the text runs upwards.
        is_upright: bool,
    },
}

impl PlotShape {
    /// The same shape `down` pixels lower.
    pub fn lowered(mut self, down: f64) -> Self {
        match &mut self {
            Self::Line { points, .. } | Self::Area { points, .. } => points.iter_mut().for_each(|[_, y]| *y += down),
            Self::Dot { center: [_, y], .. } | Self::Text { at: [_, y], .. } => *y += down,
        }
        self
    }
}

/// A picture with its place. All pictures lie below all shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPicture {
    /// Left, top, width, height in pixels.
    pub place: [f64; 4],
    /// The picture; its pixels may be of another size.
    pub picture: EncodedPicture<u8>,
}

/// The half circle of a polar plot: where an angle is on the paper.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PolarPlace {
    /// The point of incidence.
    pub center: [f64; 2],
    /// The radius of the rim in pixels.
    pub radius: f64,
}

impl PolarPlace {
    /// The angle of incidence whose light comes from a place on the paper, in degrees in `[0, 89.9]`; places on the viewer's
    /// side mean the mirror direction. `None` within 4 pixels of the point of incidence, where the angle is arbitrary.
    pub fn theta_i_deg(&self, [x, y]: [f64; 2]) -> Option<f64> {
        let (across, up) = (x - self.center[0], self.center[1] - y);
        (across.hypot(up) >= 4.0).then(|| across.abs().atan2(up).to_degrees().min(crate::LARGEST_THETA_DEG))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_on_the_paper_is_an_angle_of_incidence() {
        let place = PolarPlace { center: [100.0, 100.0], radius: 80.0 };
        let at = |x: f64, y: f64| place.theta_i_deg([x, y]);
        assert_eq!(at(100.0, 20.0), Some(0.0));
        for x in [50.0, 150.0] {
            assert!(at(x, 50.0).is_some_and(|angle| (angle - 45.0).abs() < 1e-9));
        }
        assert_eq!(at(20.0, 100.0), Some(89.9));
        // Below the horizon.
        assert_eq!(at(20.0, 160.0), Some(89.9));
        assert_eq!(at(101.0, 99.0), None);
        assert_eq!(at(f64::NAN, 20.0), None);
    }
}
