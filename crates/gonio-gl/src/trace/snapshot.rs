//! Everything that one draw call reads, at the moment of the call, and whether its textures are complete.

use super::data::{
    ArraySource, AttributeRecord, AttributeSource, BindingRecord, BlendRecord, DrawRecord, SamplerRecord,
    SamplingRecord, StateRecord, TextureRecord, UniformValue,
};
use super::enums::{self, TextureKind};
use super::object_state::Binding;
use super::program_reader::{self, ActiveUniform, ProgramInterface};
use super::recorder::{Recorder, errors, texture_record};
use super::state::State;
use crate::bounds::DrawCall;
use crate::functions::Functions;
use std::rc::Rc;

/// Bytes of indices that are read to find the highest vertex.
const MOST_INDEX_BYTES: usize = 64 << 20;
/// The initial value of an attribute without an array.
const INITIAL_CONSTANT: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

impl Recorder {
    /// Collects everything that a draw will read.
    pub(super) fn snapshot(&mut self, state: &mut State, gl: &Functions, call: &DrawCall) -> DrawRecord {
        // Before the queries below could raise one.
        let errors = errors(gl);
        let subject = state.subject.as_ref().map(|(_, subject)| Rc::as_ref(subject).clone());
        let program = state.program;
        if let Some(program) = program.filter(|program| !self.interfaces.contains_key(program)) {
            let interface = program_reader::interface(gl, program, self.record.programs.len());
            self.record.programs.push(program_reader::record(&interface, state.programs.get(&program)));
            self.interfaces.insert(program, interface);
        }
        let interface = program.and_then(|program| Some((program, self.interfaces.get(&program)?)));
        let index_bytes = call.index_type.map(index_bytes);
        DrawRecord {
            index: self.record.draws.len(),
            pass: self.record.passes.len().saturating_sub(1),
            groups: self.groups.clone(),
            subject,
            program: interface.map(|(_, interface)| interface.index),
            primitive: enums::primitive(call.mode),
            count: call.count.max(0) as u32,
            first: index_bytes.map_or(call.first, |bytes| call.first / bytes).max(0) as u32,
            indexed: call.index_type.is_some(),
            highest_vertex: self.highest_vertex(state, gl, call),
            instances: call.instances.max(0) as u32,
            vertices_shaded: None,
            fragments_shaded: None,
            state: fixed_functions(gl),
            uniforms: interface.map(|(program, interface)| values(gl, state, program, interface)).unwrap_or_default(),
            samplers: interface
                .map(|(program, interface)| self.samplers(gl, state, program, interface))
                .unwrap_or_default(),
            attributes: interface.map(|(_, interface)| self.attributes(gl, state, interface)).unwrap_or_default(),
            units: units(state),
            bound: std::mem::take(&mut state.bindings),
            errors,
        }
    }

    fn highest_vertex(&self, state: &mut State, gl: &Functions, call: &DrawCall) -> Option<u32> {
        let count = u32::try_from(call.count).ok().filter(|count| *count > 0)?;
        let first = u32::try_from(call.first).ok()?;
        let Some(index_type) = call.index_type else { return Some(first + count - 1) };
        let each = index_bytes(index_type) as usize;
        let bytes = count as usize * each;
        let buffer_bytes =
            state.array().index_buffer.and_then(|buffer| state.buffers.get(&buffer))?.contents.borrow().bytes;
        if !self.reads_buffers || bytes > MOST_INDEX_BYTES || u64::from(first) + bytes as u64 > buffer_bytes {
            return None;
        }
        let mut indices = vec![0; bytes];
        gl.get_buffer_sub_data(glow::ELEMENT_ARRAY_BUFFER, call.first, &mut indices);
        let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
        indices.chunks_exact(each).map(number).max()
    }

    fn samplers(
        &self,
        gl: &Functions,
        state: &State,
        program: glow::Program,
        interface: &ProgramInterface,
    ) -> Vec<SamplerRecord> {
        let mut samplers = Vec::new();
        for uniform in &interface.uniforms {
            let Some(kind) = uniform.sampler() else { continue };
            let known = state.programs.get(&program);
            let sent = known.and_then(|program| program.sent.get(&uniform.name)).and_then(Option::as_ref);
            for (element, location) in uniform.locations.iter().enumerate() {
                let unit = program_reader::unit(gl, program, location);
                let binding = state.bound(unit, kind);
                let id = |texture: glow::Texture| state.textures.get(&texture).map(|texture| texture.label.id);
                let others = TextureKind::ALL.into_iter().filter(|other| *other != kind);
                let others = others.filter_map(|other| id(state.bound(unit, other)?.texture)).collect();
                let owner = binding.and_then(|binding| binding.owner.as_ref());
                let sampling = binding.and_then(|_| sampling(gl, kind, unit));
                let texture = binding.and_then(|binding| state.textures.get(&binding.texture)).map(texture_record);
                let mine = state.subject.as_ref().map(|(serial, _)| *serial);
                let foreign = owner.filter(|(serial, _)| Some(*serial) != mine);
                samplers.push(SamplerRecord {
                    name: match uniform.locations.len() {
                        1 => uniform.name.clone(),
                        _ => format!("{}[{element}]", uniform.name),
                    },
                    glsl_type: enums::glsl_type(uniform.code),
                    unit,
                    sent: sent.and_then(|sent| sent.get(element)).copied(),
                    was_set: known.is_some_and(|program| program.was_sent(&uniform.name)),
                    texture: texture.as_ref().map(|texture| texture.id),
                    incomplete: texture.and_then(|texture| why_incomplete(&texture, sampling.as_ref())),
                    sampling,
                    others,
                    bound_for: foreign.map(|(_, subject)| Rc::as_ref(subject).clone()),
                });
            }
        }
        gl.active_texture(glow::TEXTURE0 + state.active_unit as u32);
        samplers
    }

    fn attributes(&self, gl: &Functions, state: &mut State, interface: &ProgramInterface) -> Vec<AttributeRecord> {
        let mut attributes = Vec::new();
        for declaration in &interface.attributes {
            let fed = state.array().attributes.get(&declaration.location).cloned().filter(|fed| fed.enabled);
            let source = if let Some(fed) = fed {
                let buffer = fed.buffer.and_then(|buffer| state.buffers.get(&buffer));
                AttributeSource::Array(ArraySource {
                    buffer: buffer.map_or(0, |buffer| buffer.label.id),
                    buffer_name: buffer.map(|buffer| buffer.label.name.clone()).unwrap_or_default(),
                    buffer_bytes: buffer.map_or(0, |buffer| buffer.contents.borrow().bytes),
                    components: fed.components,
                    component_type: enums::component(fed.component_type),
                    element_bytes: fed.components * enums::component_bytes(fed.component_type),
                    normalized: fed.normalized,
                    stride: fed.stride,
                    offset: fed.offset,
                    divisor: fed.divisor,
                })
            } else {
                let value = gl.get_constant_attribute(declaration.location);
                let set = state.constants.contains(&declaration.location) || value != INITIAL_CONSTANT;
                AttributeSource::Constant { value, set }
            };
            attributes.push(AttributeRecord {
                name: declaration.name.clone(),
                glsl_type: declaration.glsl_type.clone(),
                location: declaration.location,
                source,
            });
        }
        attributes
    }
}

/// All textures that are bound to units.
fn units(state: &State) -> Vec<BindingRecord> {
    let units = (0..).zip(&state.units).flat_map(|(number, unit)| {
        TextureKind::ALL
            .into_iter()
            .zip(&unit.bound)
            .filter_map(move |(kind, bound)| Some((number, kind, bound.as_ref()?)))
    });
    let record = |(unit, kind, binding): (u32, TextureKind, &Binding)| BindingRecord {
        unit,
        kind: kind.name().to_owned(),
        texture: state.textures.get(&binding.texture).map(|texture| texture.label.id),
    };
    units.map(record).collect()
}

fn index_bytes(index_type: u32) -> i32 {
    enums::component_bytes(index_type) as i32
}

fn values(gl: &Functions, state: &State, program: glow::Program, interface: &ProgramInterface) -> Vec<UniformValue> {
    let known = state.programs.get(&program);
    let value = |uniform: &ActiveUniform| {
        let sent = known.and_then(|program| program.sent.get(&uniform.name)).and_then(Option::as_deref);
        UniformValue {
            name: uniform.name.clone(),
            glsl_type: enums::glsl_type(uniform.code),
            sent: known.is_some_and(|program| program.was_sent(&uniform.name)),
            value: program_reader::value(gl, program, uniform, sent),
        }
    };
    interface.uniforms.iter().filter(|uniform| uniform.sampler().is_none()).map(value).collect()
}

/// Reads the sampling parameters of the texture of a unit. Leaves that unit active.
fn sampling(gl: &Functions, kind: TextureKind, unit: u32) -> Option<SamplingRecord> {
    if kind == TextureKind::Multisample {
        return None; // It is only fetched, and has no such parameters.
    }
    gl.active_texture(glow::TEXTURE0 + unit);
    let parameter = |what: u32| gl.get_tex_parameter_i32(kind.target(), what).max(0) as u32;
    Some(SamplingRecord {
        min_filter: enums::sampling(parameter(glow::TEXTURE_MIN_FILTER)),
        mag_filter: enums::sampling(parameter(glow::TEXTURE_MAG_FILTER)),
        wrap: [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T].map(|what| enums::sampling(parameter(what))),
        base_level: parameter(glow::TEXTURE_BASE_LEVEL),
        max_level: parameter(glow::TEXTURE_MAX_LEVEL),
    })
}

/// Reads the state of blending, depth, culling, viewport and scissor.
fn fixed_functions(gl: &Functions) -> StateRecord {
    let number = |what: u32| gl.get_parameter_i32(what).max(0) as u32;
    let factors = |from: u32, onto: u32| [from, onto].map(|what| enums::factor(number(what)));
    StateRecord {
        blend: gl.is_enabled(glow::BLEND).then(|| BlendRecord {
            color: factors(glow::BLEND_SRC_RGB, glow::BLEND_DST_RGB),
            alpha: factors(glow::BLEND_SRC_ALPHA, glow::BLEND_DST_ALPHA),
        }),
        depth_test: gl.is_enabled(glow::DEPTH_TEST).then(|| enums::comparison(number(glow::DEPTH_FUNC))),
        depth_mask: gl.get_depth_mask(),
        cull: gl.is_enabled(glow::CULL_FACE).then(|| enums::faces(number(glow::CULL_FACE_MODE))),
        front_face: match number(glow::FRONT_FACE) {
            glow::CW => "clockwise".to_owned(),
            _ => "counter-clockwise".to_owned(),
        },
        color_mask: gl.get_color_mask(),
        viewport: gl.get_rectangle(glow::VIEWPORT),
        scissor: gl.is_enabled(glow::SCISSOR_TEST).then(|| gl.get_rectangle(glow::SCISSOR_BOX)),
    }
}

/// Returns the first and the last level that are read.
pub fn levels_read(texture: &TextureRecord, sampling: Option<&SamplingRecord>) -> [u32; 2] {
    // A multisampled texture has one.
    let Some(sampling) = sampling else { return [0, 0] };
    let base = sampling.base_level;
    if !sampling.min_filter.contains("mipmap") {
        return [base, base];
    }
    let largest = texture.levels.iter().find(|level| level.level == base);
    let side = largest.map_or(1, |level| level.width.max(level.height)).max(1);
    [base, sampling.max_level.min(base + side.ilog2())]
}

/// Explains why a texture is incomplete, in which case it reads as black (OpenGL 3.3, section 3.8.14). That OpenGL ES need not
/// filter float formats is not considered.
pub fn why_incomplete(texture: &TextureRecord, sampling: Option<&SamplingRecord>) -> Option<String> {
    let [first, last] = levels_read(texture, sampling);
    let faces = if texture.kind == "cube" { 6 } else { 1 };
    let find = |number: u32| texture.levels.iter().find(|level| level.level == number);
    let Some(base) = find(first) else { return Some(format!("it has no level {first}")) };
    for number in first..=last {
        let Some(level) = find(number) else {
            let has = texture.levels.len();
            let plural = if has == 1 { "" } else { "s" };
            return Some(format!("it has {has} level{plural} of {}", last - first + 1));
        };
        if level.faces < faces {
            return Some(format!("it has {} of 6 faces", level.faces));
        }
        let [width, height] = [base.width, base.height].map(|side| (side >> (number - first)).max(1));
        if [level.width, level.height] != [width, height] || base.width == 0 || base.height == 0 {
            return Some(format!("level {number} is {} x {} and not {width} x {height}", level.width, level.height));
        }
    }
    None
}
