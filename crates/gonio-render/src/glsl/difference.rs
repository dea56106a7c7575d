//! The program that draws where two pictures differ.

use super::OUTPUT_VERT;
use gonio_gl::Dialect;
use gonio_scene::difference::{HEAT, SIGNED};
use std::fmt::Write;

const DIFFERENCE_FRAG: &str = include_str!("../../shaders/difference.frag");

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
