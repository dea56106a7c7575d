//! OpenGL's functions as methods of [`Gl`]: those of the table, and those with longer notes or checked arguments.

use crate::Gl;
use crate::bounds::DrawCall;
use crate::call_table::call_table;
use crate::functions::{AttributeLayout, Texels};
use crate::trace::data::{DrawSubject, TexelEncoding};
use crate::trace::object_state::{
    ArrayState, Attached, BufferState, FramebufferState, Label, ProgramState, RenderbufferState, TextureState,
};
use std::convert::identity;
use std::rc::Rc;

macro_rules! define_methods {
    (
        tabled { $(fn $name:ident($($argument:ident: $Type:ty),* $(,)?) $(-> $Result:ty)? $(=> |$state:ident| $note:expr)?;)* }
        written_out { $($written:tt)* }
    ) => {
        /// The plain calls.
        #[allow(clippy::too_many_arguments)] // OpenGL's own
        impl Gl {
            $(
                #[doc = concat!("glow's `", stringify!($name), "`.")]
                #[inline]
                pub fn $name(&self, $($argument: $Type),*) $(-> $Result)? {
                    #[allow(clippy::let_unit_value)] // of functions without a result
                    let result = self.functions().$name($($argument),*);
                    $(self.note(|$state| $note);)?
                    result
                }
            )*
        }
    };
}

call_table!(define_methods);

/// The number of an object in OpenGL, for labels and records; 0 in browsers, where objects have no numbers.
macro_rules! native_name {
    ($handle:expr) => {{
        #[cfg(not(target_arch = "wasm32"))]
        let name: u32 = $handle.0.into();
        #[cfg(target_arch = "wasm32")]
        let name = {
            let _ = $handle;
            0
        };
        name
    }};
}
pub(crate) use native_name;

/// Objects: noted when they are made, named and numbered.
macro_rules! objects {
    ($($Handle:ident, $create:ident, $name:ident, $renumber:ident, $States:ident { $table:ident [$key:expr] };)*) => {
        impl Gl {
            $(
                #[doc = concat!("glow's `", stringify!($create), "`.")]
                pub fn $create(&self) -> Result<glow::$Handle, String> {
                    let handle = self.functions().$create()?;
                    self.with_state(|state| {
                        let label = Label { id: state.id_for(native_name!(handle)), name: String::new() };
                        state.$table.insert($key(handle), $States { label, ..$States::default() });
                    });
                    Ok(handle)
                }

                /// Names an object for records.
                pub fn $name(&self, handle: glow::$Handle, name: &str) {
                    self.with_state(|state| {
                        if let Some(object) = state.$table.get_mut(&$key(handle)) {
                            object.label.name = name.to_owned();
                        }
                    });
                }

                /// Changes the id of an object in records.
                pub fn $renumber(&self, handle: glow::$Handle, id: u32) {
                    self.with_state(|state| {
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
    Texture, create_texture, name_texture, renumber_texture, TextureState { textures[identity] };
    Buffer, create_buffer, name_buffer, renumber_buffer, BufferState { buffers[identity] };
    VertexArray, create_vertex_array, name_vertex_array, renumber_vertex_array, ArrayState { arrays[Some] };
    Framebuffer, create_framebuffer, name_framebuffer, renumber_framebuffer, FramebufferState { framebuffers[identity] };
    Renderbuffer, create_renderbuffer, name_renderbuffer, renumber_renderbuffer,
        RenderbufferState { renderbuffers[identity] };
    Program, create_program, name_program, renumber_program, ProgramState { programs[identity] };
}

/// Shaders and programs.
impl Gl {
    /// glow's `create_shader`.
    pub fn create_shader(&self, kind: u32) -> Result<glow::Shader, String> {
        let shader = self.functions().create_shader(kind)?;
        self.with_state(|state| state.shader_created(shader, kind));
        Ok(shader)
    }

    /// The location of an attribute; `None` if the program has no attribute of that name.
    pub fn get_attrib_location(&self, program: glow::Program, name: &str) -> Option<u32> {
        // Names in GLSL do not contain this character, and glow panics on it.
        if name.contains('\0') { None } else { self.functions().get_attrib_location(program, name) }
    }

    /// The location of a uniform; `None` if the program has no uniform of that name.
    pub fn get_uniform_location(&self, program: glow::Program, name: &str) -> Option<glow::UniformLocation> {
        if name.contains('\0') {
            return None;
        }
        let location = self.functions().get_uniform_location(program, name)?;
        self.with_state(|state| state.uniform_located(program, &location, name));
        Some(location)
    }

    /// The id of a program in records.
    pub fn program_id(&self, program: glow::Program) -> u32 {
        self.with_state(|state| state.programs.get(&program).map_or(0, |program| program.label.id))
    }
}

/// Textures.
impl Gl {
    /// Fills an image of the bound texture.
    pub fn tex_image_2d(&self, target: u32, level: i32, format: u32, size: [i32; 2], texels: Texels<'_>) {
        self.functions().tex_image_2d(target, level, format as i32, size, texels);
        self.note(|state| state.image(target, level, format, [size[0], size[1], 1], 1));
    }

    /// Replaces a rectangle of an image of the bound texture, from its corner `at`.
    pub fn tex_sub_image_2d(&self, target: u32, level: i32, at: [i32; 2], size: [i32; 2], texels: Texels<'_>) {
        self.functions().tex_sub_image_2d(target, level, at, size, texels);
    }

    /// Fills an image of the bound texture of three dimensions, or of layers.
    pub fn tex_image_3d(&self, target: u32, level: i32, format: u32, size: [i32; 3], texels: Texels<'_>) {
        self.functions().tex_image_3d(target, level, format as i32, size, texels);
        self.note(|state| state.image(target, level, format, size, 1));
    }

    /// Notes the encoding of the texels of the 2-D texture of the active unit.
    pub fn note_content(&self, content: TexelEncoding) {
        self.with_state(|state| {
            if let Some(texture) = state.bound_texture(glow::TEXTURE_2D) {
                texture.content = content;
            }
        });
    }
}

/// Buffers and vertex arrays.
impl Gl {
    /// Binds a buffer to `GL_ARRAY_BUFFER` or `GL_ELEMENT_ARRAY_BUFFER`. Other targets are refused, because they would change
    /// the meaning of other calls.
    pub fn bind_buffer(&self, target: u32, buffer: Option<glow::Buffer>) {
        if !matches!(target, glow::ARRAY_BUFFER | glow::ELEMENT_ARRAY_BUFFER) {
            return self.functions().raise(glow::INVALID_ENUM);
        }
        self.functions().bind_buffer(target, buffer);
        self.note(|state| state.buffer_bound(target, buffer));
    }

    /// Fills the buffer that is bound to a target.
    pub fn buffer_data(&self, target: u32, data: &[u8], usage: u32) {
        let functions = self.functions();
        let (array, buffer) = self.with_state(|state| (state.vertex_array, state.buffer_of(target)));
        // Other code that uses the context may have bound others.
        functions.bind_vertex_array(array);
        functions.bind_buffer(target, buffer);
        match self.error_of(|| functions.buffer_data_u8_slice(target, data, usage)) {
            glow::NO_ERROR => self.with_state(|state| state.buffer_filled(target, data)),
            // The buffer is then empty, so that draws cannot read it.
            glow::OUT_OF_MEMORY => self.with_state(|state| state.buffer_filled(target, &[])),
            _ => {}
        }
    }

    /// Makes a call and returns its error, which is also kept for [`Gl::get_error`]: the checks of draws must know whether
    /// OpenGL accepted the call. Not in browsers, which check draws themselves, and where `glGetError` waits for the GPU.
    fn error_of(&self, call: impl FnOnce()) -> u32 {
        if cfg!(target_arch = "wasm32") {
            call();
            return glow::NO_ERROR;
        }
        let functions = self.functions();
        let earlier = functions.get_own_error();
        call();
        let error = functions.get_own_error();
        [earlier, error].into_iter().filter(|error| *error != glow::NO_ERROR).for_each(|error| functions.raise(error));
        error
    }

    /// Describes an attribute of the bound vertex array, which reads the array buffer.
    pub fn vertex_attrib_pointer_f32(
        &self,
        index: u32,
        components: i32,
        component_type: u32,
        normalized: bool,
        stride: i32,
        offset: i32,
    ) {
        let layout = AttributeLayout { components, component_type, normalized, stride, offset };
        let functions = self.functions();
        let (array, buffer) = self.with_state(|state| (state.vertex_array, state.array_buffer));
        functions.bind_vertex_array(array);
        let mut is_made = false;
        let error = self.error_of(|| is_made = functions.vertex_attrib_pointer_f32(index, buffer, layout));
        if is_made && error == glow::NO_ERROR {
            self.with_state(|state| state.attribute_described(index, layout));
        }
    }
}

/// Framebuffers.
impl Gl {
    /// glow's `clear`.
    pub fn clear(&self, mask: u32) {
        self.functions().clear(mask);
        if self.is_noted() {
            self.recorded(|recorder, state, functions| recorder.cleared(state, functions, mask));
        }
    }

    /// glow's `blit_framebuffer`: from and to (x0, y0, x1, y1).
    pub fn blit_framebuffer(&self, from: [i32; 4], to: [i32; 4], mask: u32, filter: u32) {
        self.recorded(|recorder, state, _| recorder.resolved(state));
        let ([x0, y0, x1, y1], [to_x0, to_y0, to_x1, to_y1]) = (from, to);
        self.functions().blit_framebuffer(x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, mask, filter);
    }

    /// Reads a rectangle (x, y, width, height) of the bound framebuffer as RGBA of 8 bits.
    pub fn read_rgba8(&self, rectangle: [i32; 4], into: &mut [u8]) {
        self.functions().read_rgba8(rectangle, into);
    }

    /// Reads a rectangle (x, y, width, height) of the bound framebuffer as RGBA of floats.
    pub fn read_rgba_f32(&self, rectangle: [i32; 4], into: &mut [f32]) {
        self.functions().read_rgba_f32(rectangle, into);
    }
}

/// Draws.
impl Gl {
    /// glow's `draw_arrays`.
    pub fn draw_arrays(&self, mode: u32, first: i32, count: i32) {
        self.draw(DrawCall { mode, first, count, index_type: None, instances: 1 });
    }

    /// glow's `draw_elements`: `offset` is the first index's byte.
    pub fn draw_elements(&self, mode: u32, count: i32, index_type: u32, offset: i32) {
        self.draw(DrawCall { mode, first: offset, count, index_type: Some(index_type), instances: 1 });
    }

    /// glow's `draw_arrays_instanced`.
    pub fn draw_arrays_instanced(&self, mode: u32, first: i32, count: i32, instances: i32) {
        self.draw(DrawCall { mode, first, count, index_type: None, instances });
    }

    fn draw(&self, call: DrawCall) {
        self.recorded(|recorder, state, functions| recorder.before_draw(state, functions, &call));
        match self.with_state(|state| state.check_draw(call)) {
            Some(draw) => self.functions().draw(&draw),
            None => self.functions().raise(glow::INVALID_OPERATION),
        }
        self.recorded(|recorder, _, functions| recorder.after_draw(functions));
    }

    /// Notes a draw that is not made because it would read beyond a buffer. The record has everything that it would have read.
    pub fn refused_draw(&self, mode: u32, first: i32, count: i32, index_type: Option<u32>) {
        let call = DrawCall { mode, first, count, index_type, instances: 1 };
        self.recorded(|recorder, state, functions| {
            recorder.before_draw(state, functions, &call);
            recorder.after_draw(functions);
        });
    }

    /// Opens a debug group in the record.
    pub(crate) fn group_opened(&self, name: &str) {
        self.recorded(|recorder, _, _| recorder.enter_group(name));
    }

    /// Closes it.
    pub(crate) fn group_closed(&self) {
        self.recorded(|recorder, _, _| recorder.leave_group());
    }

    /// Names the subject of draws until the returned guard is dropped. Textures bound until then are bound for it.
    pub fn drawing(&self, subject: impl FnOnce() -> DrawSubject) -> Drawing<'_> {
        self.recorded(|_, state, _| {
            state.subjects += 1;
            state.subject = Some((state.subjects, Rc::new(subject())));
        });
        Drawing { gl: self }
    }
}

/// A guard while a named subject is drawn.
pub struct Drawing<'a> {
    gl: &'a Gl,
}

impl Drop for Drawing<'_> {
    fn drop(&mut self) {
        self.gl.recorded(|_, state, _| state.subject = None);
    }
}

/// Queries.
impl Gl {
    /// A single number of the context; 0 and an error for a parameter that is not one.
    pub fn get_parameter_i32(&self, parameter: u32) -> i32 {
        self.functions().get_parameter_i32(parameter)
    }

    /// `GL_VIEWPORT` or `GL_SCISSOR_BOX`: x, y, width, height.
    pub fn get_rectangle(&self, parameter: u32) -> [i32; 4] {
        self.functions().get_rectangle(parameter)
    }

    /// The framebuffer that is bound to `GL_DRAW_FRAMEBUFFER` or `GL_READ_FRAMEBUFFER`.
    pub fn get_framebuffer(&self, target: u32) -> Option<glow::Framebuffer> {
        self.functions().get_framebuffer(target)
    }

    /// Whether depth is written.
    pub fn get_depth_mask(&self) -> bool {
        self.functions().get_depth_mask()
    }

    /// A single number of the bound texture; 0 and an error for a parameter that is not one.
    pub fn get_tex_parameter_i32(&self, target: u32, parameter: u32) -> i32 {
        self.functions().get_tex_parameter_i32(target, parameter)
    }
}
