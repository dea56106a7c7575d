//! Programs for overlays and for views that are not quantities of the equation.

use super::define;
use super::output::output_vertex;
use crate::shader_text::shader_text;
use gonio_gl::Dialect;
use gonio_scene::scene::SHADOW_OPACITY;
use std::fmt::Write;

const PLAIN_VERT: &str = shader_text!("../../shaders/plain.vert");
const UV_CHECKER_FRAG: &str = shader_text!("../../shaders/uv_checker.frag");
const COUNT_FRAG: &str = shader_text!("../../shaders/count.frag");
const OVERDRAW_FRAG: &str = shader_text!("../../shaders/overdraw.frag");
const WIREFRAME_VERT: &str = shader_text!("../../shaders/wireframe.vert");
const WIREFRAME_FRAG: &str = shader_text!("../../shaders/wireframe.frag");
const LINE_VERT: &str = shader_text!("../../shaders/line.vert");
const LINE_FRAG: &str = shader_text!("../../shaders/line.frag");
const SHADOW_MAP_FRAG: &str = shader_text!("../../shaders/shadow_map.frag");
const CONTACT_FRAG: &str = shader_text!("../../shaders/contact.frag");
const OUTLINE_FRAG: &str = shader_text!("../../shaders/outline.frag");
const GROUND_VERT: &str = shader_text!("../../shaders/ground.vert");
const GROUND_FRAG: &str = shader_text!("../../shaders/ground.frag");

/// The colours of 0, 1, 2 ... fragments at a pixel, as displayed; the last is for 8 and more. Dark to light,
/// blue through green and yellow to red, so that they can also be distinguished by lightness.
pub const OVERDRAW_SCALE: [[f32; 3]; 9] = [
    [0.03, 0.03, 0.05],
    [0.13, 0.20, 0.45],
    [0.12, 0.40, 0.60],
    [0.16, 0.60, 0.55],
    [0.42, 0.76, 0.38],
    [0.85, 0.82, 0.28],
    [0.96, 0.62, 0.22],
    [0.90, 0.32, 0.22],
    [1.00, 0.92, 0.90],
];

/// A program for overlays or special views.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SpecialProgram {
    /// Texture coordinates as a board of squares.
    UvChecker,
    /// A one for each fragment.
    Count,
    /// Counts as colours, over the whole picture.
    Overdraw,
    /// The edges of triangles that have vertices of their own.
    Wireframe,
    /// Lines of the world, one an instance.
    Line,
    /// Depths of a shadow map.
    ShadowMap,
    /// The same of a surface with holes.
    MaskedShadowMap,
    /// The contact shadow on the ground.
    Contact,
    /// The ground with its grid.
    Ground,
    /// The line around a mask.
    Outline,
}

impl SpecialProgram {
    /// All programs.
    pub const ALL: [SpecialProgram; 10] = [
        SpecialProgram::UvChecker,
        SpecialProgram::Count,
        SpecialProgram::Overdraw,
        SpecialProgram::Wireframe,
        SpecialProgram::Line,
        SpecialProgram::ShadowMap,
        SpecialProgram::MaskedShadowMap,
        SpecialProgram::Contact,
        SpecialProgram::Ground,
        SpecialProgram::Outline,
    ];

    /// Vertex and fragment shader.
    pub fn sources(self, dialect: Dialect) -> [String; 2] {
        let (vertex, fragment) = match self {
            SpecialProgram::UvChecker => (PLAIN_VERT, UV_CHECKER_FRAG),
            SpecialProgram::Count => (PLAIN_VERT, COUNT_FRAG),
            SpecialProgram::Overdraw => (output_vertex(), OVERDRAW_FRAG),
            SpecialProgram::Wireframe => (WIREFRAME_VERT, WIREFRAME_FRAG),
            SpecialProgram::Line => (LINE_VERT, LINE_FRAG),
            SpecialProgram::ShadowMap | SpecialProgram::MaskedShadowMap => (PLAIN_VERT, SHADOW_MAP_FRAG),
            SpecialProgram::Contact => (output_vertex(), CONTACT_FRAG),
            SpecialProgram::Ground => (GROUND_VERT, GROUND_FRAG),
            SpecialProgram::Outline => (output_vertex(), OUTLINE_FRAG),
        };
        let header = dialect.header();
        let constants = match self {
            SpecialProgram::Overdraw => overdraw_scale(),
            SpecialProgram::ShadowMap => "#define MASKED 0\n".to_owned(),
            SpecialProgram::Contact => format!("#define PI {:e}\n", std::f64::consts::PI),
            SpecialProgram::MaskedShadowMap => {
                format!("#define MASKED 1\n#define SHADOW_OPACITY {SHADOW_OPACITY:e}\n")
            }
            _ => String::new(),
        };
        [[header, vertex].concat(), [header, &constants, fragment].concat()]
    }

    /// The name in labels and messages.
    pub fn name(self) -> &'static str {
        match self {
            SpecialProgram::UvChecker => "UV checker",
            SpecialProgram::Count => "count",
            SpecialProgram::Overdraw => "overdraw",
            SpecialProgram::Wireframe => "wireframe",
            SpecialProgram::Line => "lines",
            SpecialProgram::ShadowMap => "shadow map",
            SpecialProgram::MaskedShadowMap => "shadow map with holes",
            SpecialProgram::Contact => "contact shadow",
            SpecialProgram::Ground => "ground",
            SpecialProgram::Outline => "outline",
        }
    }
}

/// [`OVERDRAW_SCALE`] as GLSL.
fn overdraw_scale() -> String {
    let mut text = String::new();
    let steps = OVERDRAW_SCALE.len();
    define(&mut text, "OVERDRAW_STEPS", &steps.to_string());
    let colors = OVERDRAW_SCALE.map(|[r, g, b]| format!("vec3({r:?}, {g:?}, {b:?})")).join(", ");
    // Writing to a String cannot fail.
    let _ = writeln!(text, "const vec3 OVERDRAW_SCALE[{steps}] = vec3[{steps}]({colors});");
    text
}
