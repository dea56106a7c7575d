//! The programs that turn the linear picture into the numbers that are shown.

use super::{COLOR, bit, constants, define};
use gonio_gl::Dialect;
use gonio_gl::target::SamplesOf;
use gonio_light::color::{ColorEncoding, ToneMap};

const DISPLAY_LIGHT: &str = include_str!("../../shaders/display_light.glsl");
pub(super) const OUTPUT_VERT: &str = include_str!("../../shaders/output.vert");
const OUTPUT_FRAG: &str = include_str!("../../shaders/output.frag");

/// The encoding that an output program writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Display {
    /// The linear picture as it is.
    Linear,
    /// A debug view.
    Affine,
    /// Light.
    Light(ToneMap, ColorEncoding),
}

/// The variant of an output program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OutputKey {
    /// The encoding.
    pub display: Display,
    /// The samples that it averages.
    pub samples: SamplesOf,
}

impl OutputKey {
    /// Every key that the renderer can ask for in a dialect.
    pub fn all(dialect: Dialect) -> Vec<OutputKey> {
        let mut displays = vec![Display::Linear, Display::Affine];
        for &tone_map in ToneMap::ALL {
            displays.extend(ColorEncoding::ALL.iter().map(|&encoding| Display::Light(tone_map, encoding)));
        }
        let mut samples = vec![SamplesOf::One, SamplesOf::Grid];
        if dialect == Dialect::Core330 {
            samples.push(SamplesOf::Texel);
        }
        let keys = |samples| displays.iter().map(move |&display| OutputKey { display, samples });
        samples.into_iter().flat_map(keys).collect()
    }

    /// Vertex and fragment shader.
    pub fn sources(&self, dialect: Dialect) -> [String; 2] {
        let mut defines = String::new();
        for (number, name) in ["DISPLAY_LINEAR", "DISPLAY_AFFINE", "DISPLAY_LIGHT"].into_iter().enumerate() {
            define(&mut defines, name, &number.to_string());
        }
        let (display, tone_map, encoding) = match self.display {
            Display::Linear => ("DISPLAY_LINEAR", "TONE_MAP_NONE", "0"),
            Display::Affine => ("DISPLAY_AFFINE", "TONE_MAP_NONE", "0"),
            Display::Light(tone_map, encoding) => {
                ("DISPLAY_LIGHT", tone_map_define(tone_map), bit(encoding == ColorEncoding::Srgb))
            }
        };
        define(&mut defines, "DISPLAY", display);
        define(&mut defines, "TONE_MAP", tone_map);
        define(&mut defines, "ENCODE_SRGB", encoding);
        define(&mut defines, "MULTISAMPLED", bit(self.samples == SamplesOf::Texel));
        define(&mut defines, "GRID", bit(self.samples == SamplesOf::Grid));
        let shared = format!("{}{}{defines}", dialect.header(), constants());
        [[&shared, OUTPUT_VERT].concat(), [&shared, COLOR, DISPLAY_LIGHT, OUTPUT_FRAG].concat()]
    }
}

/// One triangle over the whole picture.
pub(super) fn output_vertex() -> &'static str {
    OUTPUT_VERT
}

pub(super) fn tone_map_define(tone_map: ToneMap) -> &'static str {
    match tone_map {
        ToneMap::None => "TONE_MAP_NONE",
        ToneMap::Reinhard => "TONE_MAP_REINHARD",
        ToneMap::Aces => "TONE_MAP_ACES",
        ToneMap::Agx => "TONE_MAP_AGX",
    }
}
