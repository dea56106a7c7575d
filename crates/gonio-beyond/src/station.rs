//! The description of a station, and the checks of its law.

use glam::{DVec2, DVec3};
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_light::color::OutputTransform;
use gonio_plot::{PlotError, PlotFigure};
use gonio_trace::Sampler;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A phenomenon that the rendering equation leaves out, with everything that a command, a window or a page shows of it.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    /// The name on the command line.
    pub name: &'static str,
    /// The heading.
    pub title: &'static str,
    /// The part of the rendering equation that excludes the phenomenon.
    pub assumption: &'static str,
    /// The phenomenon in nature.
    pub nature: &'static str,
    /// The law, one formula a line.
    pub formula: &'static str,
    /// Author, year and place of the law.
    pub source: &'static str,
    /// Where to look in the pictures.
    pub look: &'static str,
    /// A question to the reader.
    pub question: &'static str,
    /// The parameters: options of the command line, sliders elsewhere.
    pub parameters: &'static [Parameter],
    /// The parameter that a film changes from one end of its range to the other.
    pub film_parameter: &'static str,
    /// The pictures, the main one first.
    pub pictures: &'static [StationPicture],
    /// Draws the law as curves.
    pub plot: fn(&ParameterValues, &mut PlotFigure) -> Result<(), PlotError>,
    /// Compares the law with what the pictures are computed from.
    pub checks: fn(&ParameterValues) -> Vec<LawCheck>,
}

/// A picture of a station.
#[derive(Clone, Copy, Debug)]
pub struct StationPicture {
    /// The name, part of the file's name.
    pub name: &'static str,
    /// The caption.
    pub caption: &'static str,
    /// From linear light to the display.
    pub output: OutputTransform,
    /// Builds the image plane for values of the parameters.
    pub image_plane: fn(&ParameterValues) -> Box<dyn ImagePlane>,
}

/// The light that reaches the points of an image plane.
pub trait ImagePlane: Send + Sync {
    /// Linear sRGB at a point: y from -1 at the bottom to 1 at the top, x in the same unit from the centre to the right.
    /// Channels may be slightly negative where the light is more saturated than sRGB.
    fn light(&self, at: DVec2, sampler: &mut Sampler) -> DVec3;
}

/// A value that a law predicts beside the value found without that law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawCheck {
    /// The quantity with its conditions.
    pub quantity: String,
    /// The unit; empty if it has none.
    pub unit: Cow<'static, str>,
    /// The value by the law.
    pub expected: f64,
    /// The value found.
    pub measured: f64,
    /// The largest difference that agrees with the law.
    pub bound: f64,
}

impl LawCheck {
    /// Whether the values differ by the bound or less.
    pub fn holds(&self) -> bool {
        (self.measured - self.expected).abs() <= self.bound
    }
}

impl Station {
    /// The parameters with their defaults.
    pub fn defaults(&self) -> ParameterValues {
        ParameterValues::defaults(self.parameters)
    }

    /// The value of the film parameter in a frame: the ends of its range are the first and the last frame.
    pub fn film_value(&self, frame: u32, frames: u32) -> f64 {
        let film = self.parameters.iter().find(|parameter| parameter.name == self.film_parameter);
        let [min, max] = film.map_or([0.0, 1.0], Parameter::range);
        min + (max - min) * f64::from(frame) / f64::from(frames.saturating_sub(1).max(1))
    }
}
