//! Reads the interface of a program and the values of its uniforms from OpenGL.

use super::data::{AttributeDeclaration, ProgramRecord, UniformDeclaration, UniformNumbers};
use super::enums::{self, GlslScalar, TextureKind};
use super::object_state::{ProgramState, base_name};
use crate::functions::Functions;

/// A program's attributes and uniforms.
pub struct ProgramInterface {
    /// Its place among the record's programs.
    pub index: usize,
    /// Location, name, type.
    pub attributes: Vec<AttributeDeclaration>,
    /// Active uniforms outside of blocks.
    pub uniforms: Vec<ActiveUniform>,
}

/// A uniform, or all elements of one.
pub struct ActiveUniform {
    /// Without `[0]`.
    pub name: String,
    /// OpenGL's number of its type.
    pub code: u32,
    /// The locations of its elements.
    pub locations: Vec<glow::UniformLocation>,
}

impl ActiveUniform {
    /// The kind of texture that it reads, if it is a sampler.
    pub fn sampler(&self) -> Option<TextureKind> {
        TextureKind::from_sampler_type(self.code)
    }
}

/// Reads the interface of a linked program.
pub fn interface(gl: &Functions, program: glow::Program, index: usize) -> ProgramInterface {
    let mut attributes = Vec::new();
    let mut uniforms = Vec::new();
    for index in 0..gl.get_active_attributes(program) {
        let Some(attribute) = gl.get_active_attribute(program, index) else { continue };
        // gl_VertexID and its like have none.
        let Some(location) = gl.get_attrib_location(program, &attribute.name) else { continue };
        let glsl_type = enums::glsl_type(attribute.atype);
        attributes.push(AttributeDeclaration { name: attribute.name, glsl_type, location });
    }
    for index in 0..gl.get_active_uniforms(program) {
        let Some(uniform) = gl.get_active_uniform(program, index) else { continue };
        let name = base_name(&uniform.name).to_owned();
        let locations: Vec<_> = (0..uniform.size)
            .filter_map(|element| match uniform.size {
                1 => gl.get_uniform_location(program, &uniform.name),
                _ => gl.get_uniform_location(program, &format!("{name}[{element}]")),
            })
            .collect();
        // Members of blocks have none.
        if !locations.is_empty() {
            uniforms.push(ActiveUniform { name, code: uniform.utype, locations });
        }
    }
    attributes.sort_by_key(|attribute| attribute.location);
    uniforms.sort_by(|a, b| a.name.cmp(&b.name));
    ProgramInterface { index, attributes, uniforms }
}

/// A program for the record.
pub fn record(interface: &ProgramInterface, state: Option<&ProgramState>) -> ProgramRecord {
    let uniform = |uniform: &ActiveUniform| UniformDeclaration {
        name: uniform.name.clone(),
        glsl_type: enums::glsl_type(uniform.code),
        location: uniform.locations.first().and_then(number),
        array_size: uniform.locations.len() as u32,
    };
    let [vertex_source, fragment_source] = state.map(|state| state.sources.clone()).unwrap_or_default();
    ProgramRecord {
        id: state.map_or(0, |state| state.label.id),
        name: state.map(|state| state.label.name.clone()).unwrap_or_default(),
        vertex_source,
        fragment_source,
        attributes: interface.attributes.clone(),
        uniforms: interface.uniforms.iter().map(uniform).collect(),
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn number(location: &glow::UniformLocation) -> Option<u32> {
    Some(location.0)
}

/// WebGL's locations are objects.
#[cfg(target_arch = "wasm32")]
fn number(_: &glow::UniformLocation) -> Option<u32> {
    None
}

/// Reads the value of a uniform that is not a sampler. `sent` are the integers that were set last: glow does not read `bool`
/// on the web.
pub fn value(gl: &Functions, program: glow::Program, uniform: &ActiveUniform, sent: Option<&[i32]>) -> UniformNumbers {
    let Some((scalar, each)) = enums::layout(uniform.code) else { return UniformNumbers::Float(Vec::new()) };
    let count = each * uniform.locations.len();
    // Each element is read into room for exactly its numbers: more than that and glow panics on the web.
    match scalar {
        GlslScalar::Float => {
            let mut numbers = vec![0.0; count];
            for (location, numbers) in uniform.locations.iter().zip(numbers.chunks_exact_mut(each)) {
                gl.get_uniform_f32(program, location, numbers);
            }
            UniformNumbers::Float(numbers)
        }
        GlslScalar::Int => UniformNumbers::Int(whole_numbers(gl, program, uniform, each)),
        GlslScalar::Uint => {
            let mut numbers = vec![0; count];
            for (location, numbers) in uniform.locations.iter().zip(numbers.chunks_exact_mut(each)) {
                gl.get_uniform_u32(program, location, numbers);
            }
            UniformNumbers::Uint(numbers)
        }
        GlslScalar::Bool => {
            let numbers = match cfg!(target_arch = "wasm32") {
                true => sent.unwrap_or_default().to_vec(),
                false => whole_numbers(gl, program, uniform, each),
            };
            UniformNumbers::Bool(numbers.into_iter().map(|number| number != 0).collect())
        }
    }
}

fn whole_numbers(gl: &Functions, program: glow::Program, uniform: &ActiveUniform, each: usize) -> Vec<i32> {
    let mut numbers = vec![0; each * uniform.locations.len()];
    for (location, numbers) in uniform.locations.iter().zip(numbers.chunks_exact_mut(each)) {
        gl.get_uniform_i32(program, location, numbers);
    }
    numbers
}

/// The unit of a sampler's element.
pub fn unit(gl: &Functions, program: glow::Program, location: &glow::UniformLocation) -> u32 {
    let mut unit = [0];
    gl.get_uniform_i32(program, location, &mut unit);
    unit[0].max(0) as u32
}
