//! The objects and bindings of a context, as calls have set them.
//!
//! OpenGL has queries for most of this, but WebGL2 has none for the size or the format of a texture. So it is noted when
//! objects are created, which is rare; frequent calls only note the binding.

use super::data::{BindingRecord, DrawSubject};
use super::enums::TextureKind;
use super::object_state::{
    ArrayState, Attached, AttributeState, Binding, BufferState, FramebufferState, ProgramState, RenderbufferState,
    TextureState, TextureUnit, base_name,
};
use crate::bounds::{CheckedDraw, Contents, DrawCall, IndexLimits, SharedContents};
use crate::functions::AttributeLayout;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// The objects and bindings of a context.
#[derive(Default)]
pub struct State {
    /// The active texture unit, from 0.
    pub active_unit: usize,
    /// Grows with the units that are used.
    pub units: Vec<TextureUnit>,
    /// All textures.
    pub textures: HashMap<glow::Texture, TextureState>,
    /// All buffers.
    pub buffers: HashMap<glow::Buffer, BufferState>,
    /// The buffer bound to `GL_ARRAY_BUFFER`.
    pub array_buffer: Option<glow::Buffer>,
    /// All vertex arrays; `None` is the default one.
    pub arrays: HashMap<Option<glow::VertexArray>, ArrayState>,
    /// The one that is bound.
    pub vertex_array: Option<glow::VertexArray>,
    /// All framebuffers.
    pub framebuffers: HashMap<glow::Framebuffer, FramebufferState>,
    /// The framebuffer that is drawn into; `None` is the window.
    pub draw_framebuffer: Option<glow::Framebuffer>,
    /// All renderbuffers.
    pub renderbuffers: HashMap<glow::Renderbuffer, RenderbufferState>,
    /// The one that is bound.
    pub renderbuffer: Option<glow::Renderbuffer>,
    /// All programs.
    pub programs: HashMap<glow::Program, ProgramState>,
    /// The one that is in use.
    pub program: Option<glow::Program>,
    /// Kinds and sources of shaders, while a recording runs.
    pub shaders: HashMap<glow::Shader, (u32, String)>,
    /// Whether a recording runs.
    pub is_recording: bool,
    /// The subject that is being drawn and its number, while a recording runs.
    pub subject: Option<(usize, Rc<DrawSubject>)>,
    /// The number of subjects so far.
    pub subjects: usize,
    /// Textures that were bound since the draw before, while a recording runs.
    pub bindings: Vec<BindingRecord>,
    /// Attributes whose constants were set while a recording ran.
    pub constants: HashSet<u32>,
    /// Textures that were deleted while a recording ran.
    pub deleted_textures: Vec<TextureState>,
    /// Grows whenever a buffer is filled.
    fills: u64,
    /// The number of objects created, for contexts without names of objects.
    pub made: u32,
}

/// The most units that are tracked; known drivers have at most 192.
const MOST_UNITS: usize = 256;

impl State {
    /// The slot of the active unit for textures of a kind.
    pub fn slot(&mut self, kind: TextureKind) -> Option<&mut Option<Binding>> {
        let unit = self.active_unit;
        if unit >= MOST_UNITS {
            return None;
        }
        if self.units.len() <= unit {
            self.units.resize_with(unit + 1, TextureUnit::default);
        }
        self.units.get_mut(unit)?.bound.get_mut(kind.index())
    }

    /// Returns the binding of a unit.
    pub fn bound(&self, unit: u32, kind: TextureKind) -> Option<&Binding> {
        self.units.get(unit as usize)?.bound.get(kind.index())?.as_ref()
    }

    /// The texture of the active unit, for a target or a face of a cubemap.
    pub fn bound_texture(&mut self, target: u32) -> Option<&mut TextureState> {
        let kind = TextureKind::from_target(target)?;
        let texture = self.slot(kind)?.as_ref()?.texture;
        let state = self.textures.get_mut(&texture)?;
        state.kind = Some(kind);
        Some(state)
    }

    /// The vertex array that is bound.
    pub fn array(&mut self) -> &mut ArrayState {
        self.arrays.entry(self.vertex_array).or_default()
    }

    /// The id of a new object: OpenGL's number of it, or the next one where there is none.
    pub fn id_for(&mut self, native_name: u32) -> u32 {
        if native_name != 0 {
            return native_name;
        }
        self.made += 1;
        self.made
    }

    /// Forgets everything that only a recording needs.
    pub fn forget_recording(&mut self) {
        self.subject = None;
        self.subjects = 0;
        self.bindings.clear();
        self.constants.clear();
        self.deleted_textures.clear();
        self.shaders.clear();
    }
}

/// Notes of calls on textures.
impl State {
    /// `glBindTexture`
    pub fn texture_bound(&mut self, target: u32, texture: Option<glow::Texture>) {
        let Some(kind) = TextureKind::from_target(target) else { return };
        let owner = self.subject.clone();
        if let Some(slot) = self.slot(kind) {
            *slot = texture.map(|texture| Binding { texture, owner });
        }
        if !self.is_recording {
            return;
        }
        let texture = texture.and_then(|texture| self.textures.get_mut(&texture)).map(|texture| {
            texture.kind = Some(kind);
            texture.label.id
        });
        self.bindings.push(BindingRecord { unit: self.active_unit as u32, kind: kind.name().to_owned(), texture });
    }

    /// `glDeleteTextures`, which unbinds what it deletes.
    pub fn texture_deleted(&mut self, texture: glow::Texture) {
        for slot in self.units.iter_mut().flat_map(|unit| &mut unit.bound) {
            if slot.as_ref().is_some_and(|binding| binding.texture == texture) {
                *slot = None;
            }
        }
        if let Some(deleted) = self.textures.remove(&texture).filter(|_| self.is_recording) {
            self.deleted_textures.push(deleted);
        }
    }

    /// `glTexImage2D` and its like: width, height, layers.
    pub fn image(&mut self, target: u32, level: i32, format: u32, [width, height, depth]: [i32; 3], samples: i32) {
        if let Some(texture) = self.bound_texture(target) {
            texture.image(target, level, format, [width, height], depth, samples);
        }
    }

    /// `glGenerateMipmap`
    pub fn mipmaps_generated(&mut self, target: u32) {
        if let Some(texture) = self.bound_texture(target) {
            texture.mipmaps();
        }
    }
}

/// Notes of calls on buffers and vertex arrays.
impl State {
    /// `glBindBuffer`
    pub fn buffer_bound(&mut self, target: u32, buffer: Option<glow::Buffer>) {
        match target {
            glow::ARRAY_BUFFER => self.array_buffer = buffer,
            glow::ELEMENT_ARRAY_BUFFER => {
                let contents = self.contents(buffer);
                let array = self.array();
                array.index_buffer = buffer;
                array.indices = contents;
            }
            _ => {}
        }
    }

    /// The buffer that is bound to a target.
    pub fn buffer_of(&mut self, target: u32) -> Option<glow::Buffer> {
        match target {
            glow::ARRAY_BUFFER => self.array_buffer,
            glow::ELEMENT_ARRAY_BUFFER => self.array().index_buffer,
            _ => None,
        }
    }

    fn contents(&self, buffer: Option<glow::Buffer>) -> Option<SharedContents> {
        self.buffers.get(&buffer?).map(|buffer| buffer.contents.clone())
    }

    /// `glBufferData`
    pub fn buffer_filled(&mut self, target: u32, data: &[u8]) {
        if let Some(buffer) = self.buffer_of(target).and_then(|buffer| self.buffers.get(&buffer)) {
            buffer.contents.replace(Contents::new(data, target == glow::ELEMENT_ARRAY_BUFFER));
            self.fills += 1;
        }
    }

    /// `glDeleteBuffers`: the bound vertex array drops it, others keep its contents.
    pub fn buffer_deleted(&mut self, buffer: glow::Buffer) {
        self.buffers.remove(&buffer);
        if self.array_buffer == Some(buffer) {
            self.array_buffer = None;
        }
        let Some(array) = self.arrays.get_mut(&self.vertex_array) else { return };
        array.limits = None;
        for attribute in array.attributes.values_mut().filter(|attribute| attribute.buffer == Some(buffer)) {
            attribute.buffer = None;
            attribute.contents = None;
        }
        if array.index_buffer == Some(buffer) {
            array.index_buffer = None;
            array.indices = None;
        }
    }

    /// `glVertexAttribPointer`
    pub fn attribute_described(&mut self, index: u32, layout: AttributeLayout) {
        let buffer = self.array_buffer;
        let contents = self.contents(buffer);
        let attribute = self.array().attribute(index);
        attribute.buffer = buffer;
        attribute.contents = contents;
        attribute.components = layout.components.max(0) as u32;
        attribute.component_type = layout.component_type;
        attribute.normalized = layout.normalized;
        attribute.stride = layout.stride.max(0) as u32;
        attribute.offset = layout.offset.max(0) as u32;
    }

    /// `glVertexAttrib4f`
    pub fn constant_set(&mut self, index: u32) {
        if self.is_recording {
            self.constants.insert(index);
        }
    }

    /// `glDeleteVertexArrays`
    pub fn vertex_array_deleted(&mut self, array: glow::VertexArray) {
        self.arrays.remove(&Some(array));
        if self.vertex_array == Some(array) {
            self.vertex_array = None;
        }
    }

    /// Checks a draw with the bound vertex array; `None` if it would read beyond a buffer.
    pub fn check_draw(&mut self, call: DrawCall) -> Option<CheckedDraw> {
        let (bound, fills) = (self.vertex_array, self.fills);
        let array = self.array();
        // Arrays that other code created are not tracked; OpenGL would use the array that was bound before.
        if bound.is_some() && array.label.id == 0 && !cfg!(target_arch = "wasm32") {
            return None;
        }
        let limits = match array.limits {
            Some((known_at, limits)) if known_at == fills => limits,
            _ => {
                let enabled = array.attributes.values().filter(|attribute| attribute.enabled);
                let limits = IndexLimits::least_of(enabled.map(AttributeState::as_enabled_array));
                array.limits = Some((fills, limits));
                limits
            }
        };
        let indices = array.indices.as_ref().map(|indices| indices.borrow());
        CheckedDraw::new(call, bound, limits, indices.as_deref())
    }
}

/// Notes of calls on framebuffers.
impl State {
    /// `glBindFramebuffer`
    pub fn framebuffer_bound(&mut self, target: u32, framebuffer: Option<glow::Framebuffer>) {
        if target != glow::READ_FRAMEBUFFER {
            self.draw_framebuffer = framebuffer;
        }
    }

    /// `glDeleteFramebuffers`
    pub fn framebuffer_deleted(&mut self, framebuffer: glow::Framebuffer) {
        self.framebuffers.remove(&framebuffer);
        if self.draw_framebuffer == Some(framebuffer) {
            self.draw_framebuffer = None;
        }
    }

    /// `glFramebufferTexture2D`, `glFramebufferRenderbuffer`: to the framebuffer that is drawn into; both bindings are
    /// the same when attachments are made.
    pub fn attached(&mut self, attachment: u32, what: Option<Attached>) {
        let framebuffer = self.draw_framebuffer.and_then(|framebuffer| self.framebuffers.get_mut(&framebuffer));
        match (framebuffer, what) {
            (Some(framebuffer), Some(what)) => drop(framebuffer.attachments.insert(attachment, what)),
            (Some(framebuffer), None) => drop(framebuffer.attachments.remove(&attachment)),
            (None, _) => {}
        }
    }

    /// `glRenderbufferStorageMultisample`
    pub fn renderbuffer_made(&mut self, samples: i32, format: u32, size: [i32; 2]) {
        if let Some(buffer) = self.renderbuffer.and_then(|buffer| self.renderbuffers.get_mut(&buffer)) {
            buffer.format = format;
            buffer.size = size.map(|side| side.max(0) as u32);
            buffer.samples = samples.max(1) as u32;
        }
    }
}

/// Notes of calls on shaders and programs.
impl State {
    /// `glCreateShader`
    pub fn shader_created(&mut self, shader: glow::Shader, kind: u32) {
        if self.is_recording {
            self.shaders.insert(shader, (kind, String::new()));
        }
    }

    /// `glShaderSource`
    pub fn shader_source(&mut self, shader: glow::Shader, source: &str) {
        if let Some((_, kept)) = self.shaders.get_mut(&shader) {
            *kept = source.to_owned();
        }
    }

    /// `glAttachShader`
    pub fn shader_attached(&mut self, program: glow::Program, shader: glow::Shader) {
        let (Some((kind, source)), Some(program)) = (self.shaders.get(&shader), self.programs.get_mut(&program)) else {
            return;
        };
        let [vertex, fragment] = &mut program.sources;
        *(if *kind == glow::VERTEX_SHADER { vertex } else { fragment }) = source.clone();
    }

    /// `glLinkProgram`, which sets all uniforms to 0.
    pub fn program_linked(&mut self, program: glow::Program) {
        if let Some(program) = self.programs.get_mut(&program) {
            program.is_fresh = self.is_recording;
            program.sent.clear();
            program.looked_up.clear();
        }
    }

    /// `glDeleteProgram`
    pub fn program_deleted(&mut self, program: glow::Program) {
        self.programs.remove(&program);
    }

    /// `glGetUniformLocation`
    pub fn uniform_located(&mut self, program: glow::Program, location: &glow::UniformLocation, name: &str) {
        if let Some(program) = self.programs.get_mut(&program) {
            #[allow(clippy::clone_on_copy)] // not Copy on the web
            program.looked_up.push((location.clone(), name.to_owned()));
        }
    }

    /// `glUniform...` for the program in use, with its integers.
    #[inline]
    pub fn uniform_set(&mut self, location: Option<&glow::UniformLocation>, numbers: Option<&[i32]>) {
        // Often called: nothing is looked up while nothing is recorded.
        if self.is_recording {
            self.record_uniform(location, numbers);
        }
    }

    fn record_uniform(&mut self, location: Option<&glow::UniformLocation>, numbers: Option<&[i32]>) {
        let program = self.program.and_then(|program| self.programs.get_mut(&program));
        let (Some(program), Some(location)) = (program, location) else { return };
        let name = program.looked_up.iter().find(|(known, _)| known == location);
        if let Some(name) = name.map(|(_, name)| base_name(name).to_owned()) {
            program.sent.insert(name, numbers.map(<[i32]>::to_vec));
        }
    }
}
