//! Programs over a whole picture: from linear light to the numbers that are shown, differences, and the finished picture.

use super::{COLOR, bit, constants, define};
use crate::shader_text::shader_text;
use gonio_gl::Dialect;
use gonio_gl::target::SamplesOf;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_scene::difference::{HEAT, SIGNED};
use std::fmt::Write;

pub(super) const DISPLAY_LIGHT: &str = shader_text!("../../shaders/display_light.glsl");
pub(super) const OUTPUT_VERT: &str = shader_text!("../../shaders/output.vert");
const OUTPUT_FRAG: &str = shader_text!("../../shaders/output.frag");

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

const DIFFERENCE_FRAG: &str = shader_text!("../../shaders/difference.frag");

/// Vertex and fragment shader; the scales' colours are generated from those of `gonio-scene`.
pub fn difference_sources(dialect: Dialect) -> [String; 2] {
    let header = dialect.header();
    let scales = [scale("HEAT", &HEAT), scale("SIGNED", &SIGNED)].concat();
    [[header, OUTPUT_VERT].concat(), [header, &scales, DIFFERENCE_FRAG].concat()]
}

fn scale(name: &str, colors: &[[f64; 3]]) -> String {
    let count = colors.len();
    let mut text = format!("#define {name}_COUNT {count}\nconst vec3 {name}[{count}] = vec3[{count}](");
    for (i, [r, g, b]) in colors.iter().enumerate() {
        let comma = if i + 1 < count { ", " } else { ");\n" };
        // Writing to a String cannot fail.
        let _ = write!(text, "vec3({r:.1}, {g:.1}, {b:.1}){comma}");
    }
    text
}

/// Vertex and fragment shader: a triangle over the whole viewport, the texture's first row at the top.
pub fn presentation_sources(dialect: Dialect) -> [String; 2] {
    let header = dialect.header();
    let vertex = "out vec2 place;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    place = vec2(corner.x, 1.0 - corner.y);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
";
    let fragment = "uniform sampler2D picture;
in vec2 place;
out vec4 frag_color;
void main() {
    frag_color = texture(picture, place);
}
";
    [format!("{header}{vertex}"), format!("{header}{fragment}")]
}
