//! The OpenGL functions that leave something to be noted: [`Gl`]'s own methods, which come before glow's of the same name.
//!
//! Each notes what it is given and calls glow's function. Functions that are not here change nothing that a record
//! tells, or can be asked for when a draw is recorded (blending, depth, culling, a texture's parameters). Not noted are
//! sampler objects, uniform blocks and buffer textures, which gonio does not use.

use super::state::{ArrayState, State, TextureState};
use super::state::{Attached, Binding, BufferState, FramebufferState, Label, ProgramState, RenderbufferState};
use super::words::TextureKind;
use crate::Gl;
use crate::objects::native_name;
use glow::HasContext;

/// Calls glow's function of the same name.
macro_rules! passed_on {
    ($gl:ident.$call:ident($($argument:expr),* $(,)?)) => {{
        // SAFETY: the caller's promise, passed on as it is: noting a call changes nothing of it.
        unsafe { $gl.functions().$call($($argument),*) }
    }};
}
pub(super) use passed_on;

/// OpenGL's number of an object, or the next one where it shows none.
macro_rules! id_of {
    ($state:expr, $handle:expr) => {{
        let id: u32 = native_name!($handle);
        if id == 0 {
            $state.made += 1;
            $state.made
        } else {
            id
        }
    }};
}

/// Objects: noted when they are made and named, forgotten when they are deleted.
macro_rules! objects {
    ($($Handle:ident, $create:ident, $delete:ident, $name:ident, $renumber:ident, $States:ident { $table:ident [$key:expr] };)*) => {
        impl Gl {
            $(
                pub unsafe fn $create(&self) -> Result<glow::$Handle, String> {
                    let handle = passed_on!(self.$create())?;
                    self.mirror().with(|state| {
                        let label = Label { id: id_of!(state, handle), name: String::new() };
                        state.$table.insert($key(handle), $States { label, ..$States::default() });
                    });
                    Ok(handle)
                }

                /// Names it for records.
                pub fn $name(&self, handle: glow::$Handle, name: &str) {
                    self.mirror().with(|state| {
                        if let Some(object) = state.$table.get_mut(&$key(handle)) {
                            object.label.name = name.to_owned();
                        }
                    });
                }

                /// Gives it another id in records.
                pub fn $renumber(&self, handle: glow::$Handle, id: u32) {
                    self.mirror().with(|state| {
                        if let Some(object) = state.$table.get_mut(&$key(handle)) {
                            object.label.id = id;
                        }
                    });
                }
            )*
        }
    };
}

objects! {
    Texture, create_texture, delete_texture, name_texture, renumber_texture, TextureState { textures[std::convert::identity] };
    Buffer, create_buffer, delete_buffer, name_buffer, renumber_buffer, BufferState { buffers[std::convert::identity] };
    VertexArray, create_vertex_array, delete_vertex_array, name_vertex_array, renumber_vertex_array, ArrayState { arrays[Some] };
    Framebuffer, create_framebuffer, delete_framebuffer, name_framebuffer, renumber_framebuffer, FramebufferState { framebuffers[std::convert::identity] };
    Renderbuffer, create_renderbuffer, delete_renderbuffer, name_renderbuffer, renumber_renderbuffer, RenderbufferState { renderbuffers[std::convert::identity] };
    Program, create_program, delete_program, name_program, renumber_program, ProgramState { programs[std::convert::identity] };
}

/// Textures and units.
impl Gl {
    pub unsafe fn delete_texture(&self, texture: glow::Texture) {
        self.mirror().with(|state| {
            let gone = state.textures.remove(&texture);
            // OpenGL unbinds what it deletes.
            for slot in state.units.iter_mut().flat_map(|unit| &mut unit.bound) {
                if slot.as_ref().is_some_and(|binding| binding.texture == texture) {
                    *slot = None;
                }
            }
            if let (Some(recorder), Some(gone)) = (&mut state.recorder, gone) {
                recorder.deleted(&gone);
            }
        });
        passed_on!(self.delete_texture(texture));
    }

    pub unsafe fn active_texture(&self, unit: u32) {
        self.mirror().with(|state| state.active_unit = unit.wrapping_sub(glow::TEXTURE0) as usize);
        passed_on!(self.active_texture(unit));
    }

    pub unsafe fn bind_texture(&self, target: u32, texture: Option<glow::Texture>) {
        self.mirror().with(|state| {
            let Some(kind) = TextureKind::of_target(target) else { return };
            let owner = state.recorder.as_ref().and_then(|recorder| recorder.subject.clone());
            if let Some(slot) = state.slot(kind) {
                *slot = texture.map(|texture| Binding { texture, owner });
            }
            if let Some(mut recorder) = state.recorder.take() {
                if let Some(texture) = texture.and_then(|texture| state.textures.get_mut(&texture)) {
                    texture.kind = Some(kind);
                }
                recorder.bound(state, kind, texture);
                state.recorder = Some(recorder);
            }
        });
        passed_on!(self.bind_texture(target, texture));
    }

    #[allow(clippy::too_many_arguments)] // OpenGL's own
    pub unsafe fn tex_image_2d(
        &self,
        target: u32,
        level: i32,
        internal_format: i32,
        width: i32,
        height: i32,
        border: i32,
        format: u32,
        ty: u32,
        pixels: glow::PixelUnpackData<'_>,
    ) {
        self.image(target, level, internal_format as u32, [width, height], 1, 1);
        passed_on!(self.tex_image_2d(target, level, internal_format, width, height, border, format, ty, pixels));
    }

    #[allow(clippy::too_many_arguments)] // OpenGL's own
    pub unsafe fn tex_image_3d(
        &self,
        target: u32,
        level: i32,
        internal_format: i32,
        width: i32,
        height: i32,
        depth: i32,
        border: i32,
        format: u32,
        ty: u32,
        pixels: glow::PixelUnpackData<'_>,
    ) {
        self.image(target, level, internal_format as u32, [width, height], depth, 1);
        passed_on!(self.tex_image_3d(target, level, internal_format, width, height, depth, border, format, ty, pixels));
    }

    pub unsafe fn tex_image_2d_multisample(
        &self,
        target: u32,
        samples: i32,
        internal_format: i32,
        width: i32,
        height: i32,
        fixed: bool,
    ) {
        self.image(target, 0, internal_format as u32, [width, height], 1, samples);
        passed_on!(self.tex_image_2d_multisample(target, samples, internal_format, width, height, fixed));
    }

    pub unsafe fn generate_mipmap(&self, target: u32) {
        self.mirror().with(|state| {
            if let Some(texture) = state.bound_texture(target) {
                texture.mipmaps();
            }
        });
        passed_on!(self.generate_mipmap(target));
    }

    fn image(&self, target: u32, level: i32, format: u32, size: [i32; 2], depth: i32, samples: i32) {
        self.mirror().with(|state| {
            if let Some(texture) = state.bound_texture(target) {
                texture.image(target, level, format, size, depth, samples);
            }
        });
    }

    /// Notes how the texels of the 2-D texture of the active unit hold what they mean.
    pub fn note_content(&self, content: super::Content) {
        self.mirror().with(|state| {
            if let Some(texture) = state.bound_texture(glow::TEXTURE_2D) {
                texture.content = content;
            }
        });
    }
}

/// Buffers and vertex arrays.
impl Gl {
    pub unsafe fn delete_buffer(&self, buffer: glow::Buffer) {
        self.mirror().with(|state| state.buffers.remove(&buffer));
        passed_on!(self.delete_buffer(buffer));
    }

    pub unsafe fn delete_vertex_array(&self, array: glow::VertexArray) {
        self.mirror().with(|state| {
            state.arrays.remove(&Some(array));
            if state.vertex_array == Some(array) {
                state.vertex_array = None;
            }
        });
        passed_on!(self.delete_vertex_array(array));
    }

    pub unsafe fn bind_vertex_array(&self, array: Option<glow::VertexArray>) {
        self.mirror().with(|state| state.vertex_array = array);
        passed_on!(self.bind_vertex_array(array));
    }

    pub unsafe fn bind_buffer(&self, target: u32, buffer: Option<glow::Buffer>) {
        self.mirror().with(|state| match target {
            glow::ARRAY_BUFFER => state.array_buffer = buffer,
            glow::ELEMENT_ARRAY_BUFFER => state.array().index_buffer = buffer,
            _ => {}
        });
        passed_on!(self.bind_buffer(target, buffer));
    }

    pub unsafe fn buffer_data_u8_slice(&self, target: u32, data: &[u8], usage: u32) {
        self.mirror().with(|state| {
            let buffer = match target {
                glow::ARRAY_BUFFER => state.array_buffer,
                glow::ELEMENT_ARRAY_BUFFER => state.array().index_buffer,
                _ => None,
            };
            if let Some(buffer) = buffer.and_then(|buffer| state.buffers.get_mut(&buffer)) {
                buffer.bytes = data.len() as u64;
            }
        });
        passed_on!(self.buffer_data_u8_slice(target, data, usage));
    }

    pub unsafe fn enable_vertex_attrib_array(&self, index: u32) {
        self.mirror().with(|state| state.array().attributes.entry(index).or_default().enabled = true);
        passed_on!(self.enable_vertex_attrib_array(index));
    }

    pub unsafe fn disable_vertex_attrib_array(&self, index: u32) {
        self.mirror().with(|state| state.array().attributes.entry(index).or_default().enabled = false);
        passed_on!(self.disable_vertex_attrib_array(index));
    }

    pub unsafe fn vertex_attrib_pointer_f32(
        &self,
        index: u32,
        size: i32,
        data_type: u32,
        normalized: bool,
        stride: i32,
        offset: i32,
    ) {
        self.mirror().with(|state| {
            let buffer = state.array_buffer;
            let attribute = state.array().attributes.entry(index).or_default();
            attribute.buffer = buffer;
            attribute.components = size.max(0) as u32;
            attribute.component_type = data_type;
            attribute.normalized = normalized;
            attribute.stride = stride.max(0) as u32;
            attribute.offset = offset.max(0) as u32;
        });
        passed_on!(self.vertex_attrib_pointer_f32(index, size, data_type, normalized, stride, offset));
    }

    pub unsafe fn vertex_attrib_4_f32(&self, index: u32, x: f32, y: f32, z: f32, w: f32) {
        self.mirror().with(|state| {
            if let Some(recorder) = &mut state.recorder {
                recorder.constants.insert(index);
            }
        });
        passed_on!(self.vertex_attrib_4_f32(index, x, y, z, w));
    }
}

/// Framebuffers.
impl Gl {
    pub unsafe fn delete_framebuffer(&self, framebuffer: glow::Framebuffer) {
        self.mirror().with(|state| {
            state.framebuffers.remove(&framebuffer);
            if state.draw_framebuffer == Some(framebuffer) {
                state.draw_framebuffer = None;
            }
        });
        passed_on!(self.delete_framebuffer(framebuffer));
    }

    pub unsafe fn delete_renderbuffer(&self, renderbuffer: glow::Renderbuffer) {
        self.mirror().with(|state| state.renderbuffers.remove(&renderbuffer));
        passed_on!(self.delete_renderbuffer(renderbuffer));
    }

    pub unsafe fn bind_framebuffer(&self, target: u32, framebuffer: Option<glow::Framebuffer>) {
        self.mirror().with(|state| {
            if target != glow::READ_FRAMEBUFFER {
                state.draw_framebuffer = framebuffer;
            }
        });
        passed_on!(self.bind_framebuffer(target, framebuffer));
    }

    pub unsafe fn bind_renderbuffer(&self, target: u32, renderbuffer: Option<glow::Renderbuffer>) {
        self.mirror().with(|state| state.renderbuffer = renderbuffer);
        passed_on!(self.bind_renderbuffer(target, renderbuffer));
    }

    pub unsafe fn renderbuffer_storage_multisample(
        &self,
        target: u32,
        samples: i32,
        format: u32,
        width: i32,
        height: i32,
    ) {
        self.mirror().with(|state| {
            if let Some(buffer) = state.renderbuffer.and_then(|buffer| state.renderbuffers.get_mut(&buffer)) {
                buffer.format = format;
                buffer.size = [width, height].map(|side| side.max(0) as u32);
                buffer.samples = samples.max(1) as u32;
            }
        });
        passed_on!(self.renderbuffer_storage_multisample(target, samples, format, width, height));
    }

    pub unsafe fn framebuffer_texture_2d(
        &self,
        target: u32,
        attachment: u32,
        texture_target: u32,
        texture: Option<glow::Texture>,
        level: i32,
    ) {
        self.attach(attachment, texture.map(|texture| Attached::Texture(texture, level.max(0) as u32)));
        passed_on!(self.framebuffer_texture_2d(target, attachment, texture_target, texture, level));
    }

    pub unsafe fn framebuffer_renderbuffer(
        &self,
        target: u32,
        attachment: u32,
        renderbuffer_target: u32,
        renderbuffer: Option<glow::Renderbuffer>,
    ) {
        self.attach(attachment, renderbuffer.map(Attached::Renderbuffer));
        passed_on!(self.framebuffer_renderbuffer(target, attachment, renderbuffer_target, renderbuffer));
    }

    /// To the framebuffer that is drawn into: attachments are made where both bindings are the same.
    fn attach(&self, attachment: u32, what: Option<Attached>) {
        self.mirror().with(|state| {
            let framebuffer = state.draw_framebuffer.and_then(|f| state.framebuffers.get_mut(&f));
            match (framebuffer, what) {
                (Some(framebuffer), Some(what)) => drop(framebuffer.attachments.insert(attachment, what)),
                (Some(framebuffer), None) => drop(framebuffer.attachments.remove(&attachment)),
                (None, _) => {}
            }
        });
    }

    pub unsafe fn clear(&self, mask: u32) {
        self.recorded(|recorder, state, gl| recorder.cleared(state, gl, mask));
        passed_on!(self.clear(mask));
    }

    #[allow(clippy::too_many_arguments)] // OpenGL's own
    pub unsafe fn blit_framebuffer(
        &self,
        x0: i32,
        y0: i32,
        x1: i32,
        y1: i32,
        to_x0: i32,
        to_y0: i32,
        to_x1: i32,
        to_y1: i32,
        mask: u32,
        filter: u32,
    ) {
        self.recorded(|recorder, state, _| recorder.resolved(state));
        passed_on!(self.blit_framebuffer(x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, mask, filter));
    }

    /// Does something with the recorder, where one is on.
    pub(super) fn recorded(&self, f: impl FnOnce(&mut super::recorder::Recorder, &mut State, &glow::Context)) {
        self.mirror().with(|state| {
            if let Some(mut recorder) = state.recorder.take() {
                f(&mut recorder, state, self.functions());
                state.recorder = Some(recorder);
            }
        });
    }
}
