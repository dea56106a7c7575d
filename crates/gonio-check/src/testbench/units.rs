//! Which texture each sampler of a program reads.

use crate::roles::{Bindings, VariableKind};
use gonio_render::user_program::UserProgram;

/// Where the sky is.
pub const CUBEMAP_UNIT: u32 = 0;
/// Where the white texture is.
pub const WHITE_UNIT: u32 = 1;
/// No honest array of samplers is longer.
const MOST_ELEMENTS: u32 = 64;

/// The unit of a sampler of that type: each type its own, for no unit may be read in two ways. What gonio has no texture for
/// reads an empty unit, which is black; a 2D texture that nothing is known of is white, as a shadow map without shadows is.
pub fn unit(glsl_type: &str) -> Option<u32> {
    const EMPTY: [&str; 8] = [
        "sampler2DShadow",
        "samplerCubeShadow",
        "sampler2DArray",
        "sampler3D",
        "sampler1D",
        "sampler2DArrayShadow",
        "sampler2DMS",
        "samplerBuffer",
    ];
    match glsl_type {
        "samplerCube" => Some(CUBEMAP_UNIT),
        "sampler2D" => Some(WHITE_UNIT),
        _ => {
            let place = EMPTY.iter().position(|known| *known == glsl_type).unwrap_or(EMPTY.len());
            glsl_type.contains("sampler").then_some(2 + place as u32)
        }
    }
}

/// The numbers and units of all samplers of a program, of those too that nothing is known of.
pub fn samplers(program: &UserProgram, bindings: &Bindings) -> Vec<(usize, Vec<f32>)> {
    let unknown = bindings.unknown.iter().filter(|declared| declared.kind == VariableKind::Uniform);
    let all = bindings.bound.iter().map(|bound| &bound.declared).chain(unknown);
    all.filter_map(|declared| {
        let elements = declared.array.clamp(1, MOST_ELEMENTS) as usize;
        Some((program.uniform_index(&declared.name)?, vec![unit(&declared.glsl_type)? as f32; elements]))
    })
    .collect()
}
