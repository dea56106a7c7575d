//! The stations.

mod fluorescence;
mod fog;
mod interference;
mod nonlinear;
mod phosphorescence;
mod polarisation;
mod relativity;
mod subsurface;
mod transient;
mod transmission;

use crate::station::Station;
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};

/// All stations, in the lecture's order (Appendix 5).
pub const STATIONS: &[Station] = &[
    transmission::STATION,
    subsurface::STATION,
    polarisation::STATION,
    phosphorescence::STATION,
    interference::STATION,
    fluorescence::STATION,
    nonlinear::STATION,
    relativity::STATION,
    fog::STATION,
    transient::STATION,
];

/// The station of a name.
pub fn station(name: &str) -> Option<&'static Station> {
    STATIONS.iter().find(|station| station.name == name)
}

/// The display of most pictures: a film-like curve after `exposure` stops.
const fn filmic(exposure: f64) -> OutputTransform {
    OutputTransform { exposure, tone_map: ToneMap::Aces, encoding: ColorEncoding::Srgb }
}

/// The display of pictures whose colours are data: clamped light.
const PLAIN: OutputTransform =
    OutputTransform { exposure: 0.0, tone_map: ToneMap::None, encoding: ColorEncoding::Srgb };
