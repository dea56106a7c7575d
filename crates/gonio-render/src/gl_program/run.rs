//! Executes a program call by call.

use super::call::{Constant, GlCall, IntArgument, ObjectKind, Pointer, Selector, Step, UniformArgument};
use super::errors::{self, CallError, CallRefusal, DrawRequest, explain};
use super::files::GlProgramFiles;
use super::state::{AttributePointer, BufferWithBytes, ExecutionState, LinkedShaders};
use super::{GlProgramFailure, MOST_BUFFER_BYTES, MOST_TEXEL_BYTES};
use gonio_gl::objects::{Buffer, TextureObject, VertexArray};
use gonio_gl::trace::enums;
use gonio_gl::{Gl, GlError, Texels};
use std::cell::RefCell;
use std::rc::Rc;

/// Executes calls on its own [`Gl`].
pub struct Runner<'a> {
    gl: Gl,
    files: &'a GlProgramFiles,
    state: ExecutionState,
    /// The calls that were refused so far.
    pub errors: Vec<CallError>,
    /// The line of each draw, and how many errors there were before it.
    pub draws: Vec<(u32, usize)>,
}

/// OpenGL refuses it, or gonio does.
type Refused = Result<(), CallRefusal>;

const NO_VERTEX_ARRAY: &str = "no vertex array is bound; call bind_vertex_array first";

impl<'a> Runner<'a> {
    /// `gl` is apart, and its context's state is as in a new one.
    pub fn new(gl: Gl, files: &'a GlProgramFiles) -> Self {
        Runner { gl, files, state: ExecutionState::new(), errors: Vec::new(), draws: Vec::new() }
    }

    /// Executes one call, or notes the reason for its refusal.
    pub fn step(&mut self, step: &Step) -> Result<(), GlProgramFailure> {
        match &step.call {
            GlCall::Data { name, numbers } => {
                self.state.data.insert(name.clone(), Rc::new(bytemuck::cast_slice(numbers).to_vec()));
            }
            GlCall::Indices { name, numbers } => {
                self.state.data.insert(name.clone(), Rc::new(bytemuck::cast_slice(numbers).to_vec()));
            }
            GlCall::LoadImage { name, file } => {
                self.files.image(file).ok_or_else(|| GlProgramFailure::missing(step, file))?;
                self.state.images.insert(name.clone(), file.clone());
            }
            GlCall::CreateProgram { name, vertex, fragment } => self.create_program(step, name, vertex, fragment)?,
            GlCall::Generate { name, kind } => self.generate(name, *kind)?,
            call if call.draws() => self.draw(step),
            call => {
                if let Err(refusal) = self.plain(call) {
                    self.note(step, refusal);
                }
            }
        }
        Ok(())
    }

    fn note(&mut self, step: &Step, refusal: CallRefusal) {
        let code = refusal.code.to_owned();
        self.errors.push(CallError { line: step.line, call: step.call.word(), code, why: refusal.why });
    }

    fn create_program(
        &mut self,
        step: &Step,
        name: &str,
        vertex: &str,
        fragment: &str,
    ) -> Result<(), GlProgramFailure> {
        let find = |file: &str| self.files.shader(file).ok_or_else(|| GlProgramFailure::missing(step, file));
        let (vertex_source, fragment_source) = (find(vertex)?, find(fragment)?);
        let program = LinkedShaders::new(&self.gl, vertex_source, fragment_source).map_err(|broken| {
            GlProgramFailure::Shaders {
                line: step.line,
                vertex: vertex.to_owned(),
                fragment: fragment.to_owned(),
                broken: Box::new(broken),
            }
        })?;
        self.gl.name_program(program.handle, name);
        let program = Rc::new(program);
        let number = self.state.programs.add(program.clone());
        self.gl.renumber_program(program.handle, number.unsigned_abs());
        self.state.created = Some(program);
        self.state.numbers.insert(name.to_owned(), number);
        Ok(())
    }

    fn generate(&mut self, name: &str, kind: ObjectKind) -> Result<(), GlError> {
        let (gl, state) = (&self.gl, &mut self.state);
        let number = match kind {
            ObjectKind::Texture => {
                let texture = TextureObject::create(gl)?;
                gl.name_texture(texture.handle(), name);
                gl.renumber_texture(texture.handle(), state.textures.next().unsigned_abs());
                state.textures.add(texture)
            }
            ObjectKind::Buffer => {
                let object = Buffer::create(gl)?;
                gl.name_buffer(object.handle(), name);
                gl.renumber_buffer(object.handle(), state.buffers.next().unsigned_abs());
                state.buffers.add(Rc::new(RefCell::new(BufferWithBytes { object, bytes: Rc::default() })))
            }
            ObjectKind::VertexArray => {
                let array = VertexArray::create(gl)?;
                gl.name_vertex_array(array.handle(), name);
                state.arrays.add(array)
            }
        };
        state.numbers.insert(name.to_owned(), number);
        Ok(())
    }

    /// Makes a call, and returns the error if OpenGL refuses it. The [`Gl`] is apart, so refused calls are not recorded.
    fn attempt(&self, call: &GlCall, make: impl FnOnce(&Gl)) -> Refused {
        make(&self.gl);
        match self.gl.get_error() {
            glow::NO_ERROR => Ok(()),
            error => {
                let code = error_name(error);
                Err(CallRefusal::new(code, explain(call, code)))
            }
        }
    }

    /// A call that neither makes an object nor draws.
    fn plain(&mut self, call: &GlCall) -> Refused {
        match call {
            GlCall::Delete { kind, object } => self.delete(*kind, object),
            GlCall::BindVertexArray(array) => self.bind_vertex_array(array),
            GlCall::BindBuffer { target, buffer } => self.bind_buffer(call, *target, buffer),
            GlCall::BufferData { target, data, usage } => self.buffer_data(call, *target, data, *usage),
            GlCall::VertexAttribPointer(pointer) => self.pointer(call, pointer),
            GlCall::SwitchAttribute { attribute, on } => self.switch_attribute(attribute, *on),
            GlCall::ActiveTexture(selector) => self.active_texture(call, selector),
            GlCall::BindTexture { target, texture } => self.bind_texture(call, *target, texture),
            GlCall::TexImage2d { target, level, format, image } => self.image(call, *target, *level, *format, image),
            GlCall::TexParameter { target, parameter, value } => self.parameter(call, *target, *parameter, value),
            GlCall::GenerateMipmap { target } => self.mipmap(call, *target),
            GlCall::UseProgram(program) => self.use_program(program),
            GlCall::Uniform { uniform, given } => self.uniform(call, uniform, given),
            _ => self.fixed_function(call),
        }
    }

    fn delete(&mut self, kind: ObjectKind, object: &IntArgument) -> Refused {
        // As in OpenGL: 0 and unused numbers are ignored.
        let number = self.state.value(object);
        match kind {
            ObjectKind::Texture => {
                self.state.bound.retain(|_, bound| *bound != number);
                self.state.textures.objects.remove(&number);
            }
            ObjectKind::Buffer => self.state.forget_buffer(number),
            ObjectKind::VertexArray => {
                if self.state.arrays.objects.remove(&number).is_some() && self.state.array == number {
                    self.state.array = 0;
                }
                self.state.views.remove(&number);
            }
        }
        Ok(())
    }

    fn bind_vertex_array(&mut self, array: &IntArgument) -> Refused {
        let number = self.state.value(array);
        let object = self.state.arrays.get(number);
        if number != 0 && object.is_none() {
            return Err(CallRefusal::new("INVALID_OPERATION", format!("no vertex array has the number {number}")));
        }
        self.gl.bind_vertex_array(object.map(VertexArray::handle));
        self.state.array = number;
        Ok(())
    }

    fn bind_buffer(&mut self, call: &GlCall, target: Constant, buffer: &IntArgument) -> Refused {
        let number = self.state.value(buffer);
        let found = self.state.buffers.get(number).cloned();
        if number != 0 && found.is_none() {
            return Err(CallRefusal::new("INVALID_OPERATION", format!("no buffer has the number {number}")));
        }
        let handle = found.as_ref().map(|buffer| buffer.borrow().object.handle());
        self.attempt(call, |gl| gl.bind_buffer(target.value, handle))?;
        match target.value {
            glow::ARRAY_BUFFER => self.state.array_buffer = found.map(|_| number),
            glow::ELEMENT_ARRAY_BUFFER => self.state.view().indices = found,
            _ => {}
        }
        Ok(())
    }

    fn buffer_data(&mut self, call: &GlCall, target: Constant, data: &str, usage: Constant) -> Refused {
        let bytes = self.state.data.get(data).cloned().unwrap_or_default();
        let buffer = match target.value {
            glow::ARRAY_BUFFER => self.state.array_buffer.and_then(|number| self.state.buffers.get(number)).cloned(),
            glow::ELEMENT_ARRAY_BUFFER => self.state.view().indices.clone(),
            _ => return Err(CallRefusal::new("INVALID_ENUM", explain(call, "INVALID_ENUM"))),
        };
        let Some(buffer) = buffer else {
            return Err(CallRefusal::new("INVALID_OPERATION", format!("no buffer is bound to {}", target.name)));
        };
        self.state.buffer_bytes += bytes.len();
        if self.state.buffer_bytes > MOST_BUFFER_BYTES {
            let most = MOST_BUFFER_BYTES >> 20;
            return Err(CallRefusal::new("OUT_OF_MEMORY", format!("a program may have at most {most} MB of buffers")));
        }
        self.attempt(call, |gl| gl.buffer_data(target.value, &bytes, usage.value))?;
        buffer.borrow_mut().bytes = bytes;
        Ok(())
    }

    /// An attribute's location in the program that was created last.
    fn location(&self, attribute: &str) -> Result<u32, CallRefusal> {
        if self.state.array == 0 {
            return Err(CallRefusal::new("INVALID_OPERATION", NO_VERTEX_ARRAY));
        }
        match self.state.created.as_ref().map(|program| program.attribute(attribute)) {
            Some(Some(location)) => Ok(location),
            Some(None) => Err(CallRefusal::new(
                "INVALID_VALUE",
                format!("the program has no active attribute `{attribute}`, so its location is -1"),
            )),
            None => Err(CallRefusal::new(
                "INVALID_VALUE",
                format!("no program has been created yet, so `{attribute}` has no location"),
            )),
        }
    }

    fn pointer(&mut self, call: &GlCall, pointer: &Pointer) -> Refused {
        let location = self.location(&pointer.attribute)?;
        let buffer = self.state.array_buffer.and_then(|number| self.state.buffers.get(number)).cloned();
        if pointer.offset < 0 {
            return Err(CallRefusal::new("INVALID_VALUE", "the offset cannot be negative"));
        }
        if buffer.is_none() && pointer.offset != 0 {
            return Err(CallRefusal::new(
                "INVALID_OPERATION",
                "an offset needs a buffer, but none is bound to ARRAY_BUFFER",
            ));
        }
        let Pointer { size, kind, normalized, stride, offset, .. } = *pointer;
        self.attempt(call, |gl| {
            gl.vertex_attrib_pointer_f32(location, size, kind.value, normalized, stride, offset);
        })?;
        self.state.view().sources.insert(location, AttributePointer { pointer: pointer.clone(), buffer });
        Ok(())
    }

    fn switch_attribute(&mut self, attribute: &str, on: bool) -> Refused {
        let location = self.location(attribute)?;
        if on {
            self.gl.enable_vertex_attrib_array(location)
        } else {
            self.gl.disable_vertex_attrib_array(location)
        }
        let enabled = &mut self.state.view().enabled;
        if on {
            enabled.insert(location)
        } else {
            enabled.remove(&location)
        };
        Ok(())
    }

    fn active_texture(&mut self, call: &GlCall, selector: &Selector) -> Refused {
        let value = match selector {
            Selector::Constant(constant) => constant.value,
            Selector::Number(number) => self.state.value(number) as u32,
        };
        self.attempt(call, |gl| gl.active_texture(value))?;
        self.state.unit = value.wrapping_sub(glow::TEXTURE0);
        Ok(())
    }

    fn bind_texture(&mut self, call: &GlCall, target: Constant, texture: &IntArgument) -> Refused {
        let number = self.state.value(texture);
        let handle = self.state.textures.get(number).map(TextureObject::handle);
        if number != 0 && handle.is_none() {
            return Err(CallRefusal::new("INVALID_OPERATION", format!("no texture has the number {number}")));
        }
        self.attempt(call, |gl| gl.bind_texture(target.value, handle))?;
        self.state.bound.insert((self.state.unit, target.value), number);
        Ok(())
    }

    /// OpenGL has a default texture with number 0, WebGL does not; filling it is never intended.
    fn something_bound(&self, target: Constant) -> Refused {
        let place = match enums::TextureKind::from_target(target.value) {
            Some(kind) => kind.target(),
            None => return Ok(()),
        };
        if self.state.bound.get(&(self.state.unit, place)).is_some_and(|number| *number != 0) {
            return Ok(());
        }
        let what = if place == glow::TEXTURE_2D { "TEXTURE_2D" } else { "TEXTURE_CUBE_MAP" };
        Err(CallRefusal::new(
            "INVALID_OPERATION",
            format!("no texture is bound to {what} of the active unit, {}", self.state.unit),
        ))
    }

    fn image(&mut self, call: &GlCall, target: Constant, level: i32, format: Constant, image: &str) -> Refused {
        self.something_bound(target)?;
        let image = self.state.images.get(image).and_then(|file| self.files.image(file));
        let Some(image) = image else { return Err(CallRefusal::new("INVALID_VALUE", "no image has this name")) };
        let [width, height] = image.size();
        self.state.texel_bytes += width as usize * height as usize * 4;
        if self.state.texel_bytes > MOST_TEXEL_BYTES {
            let most = MOST_TEXEL_BYTES >> 20;
            return Err(CallRefusal::new("OUT_OF_MEMORY", format!("a program may have at most {most} MB of texels")));
        }
        let (channels, transfer) = match format.value {
            glow::R8 | glow::RED => (1, glow::RED),
            glow::RG8 | glow::RG => (2, glow::RG),
            glow::RGBA8 | glow::RGBA | glow::SRGB8_ALPHA8 => (4, glow::RGBA),
            // OpenGL ES does not generate mipmaps of SRGB8.
            glow::SRGB8 if self.gl.is_embedded() => (4, glow::RGBA),
            _ => (3, glow::RGB),
        };
        let format = match format.value {
            glow::SRGB8 if channels == 4 => glow::SRGB8_ALPHA8,
            other => other,
        };
        let texels = image.texels(channels);
        let size = [width as i32, height as i32];
        self.attempt(call, |gl| gl.tex_image_2d(target.value, level, format, size, Texels::u8(transfer, &texels)))
    }

    fn parameter(&mut self, call: &GlCall, target: Constant, parameter: Constant, value: &Selector) -> Refused {
        self.something_bound(target)?;
        let value = match value {
            Selector::Constant(constant) => constant.value as i32,
            Selector::Number(number) => self.state.value(number),
        };
        self.attempt(call, |gl| gl.tex_parameter_i32(target.value, parameter.value, value))
    }

    fn mipmap(&mut self, call: &GlCall, target: Constant) -> Refused {
        self.something_bound(target)?;
        self.attempt(call, |gl| gl.generate_mipmap(target.value))
    }

    fn use_program(&mut self, program: &IntArgument) -> Refused {
        let number = self.state.value(program);
        let found = self.state.programs.get(number).cloned();
        if number != 0 && found.is_none() {
            return Err(CallRefusal::new("INVALID_VALUE", format!("no program has the number {number}")));
        }
        self.gl.use_program(found.as_ref().map(|program| program.handle));
        self.state.used = found;
        Ok(())
    }

    fn uniform(&mut self, call: &GlCall, uniform: &str, given: &UniformArgument) -> Refused {
        let Some(used) = self.state.used.clone() else {
            return Err(CallRefusal::new("INVALID_OPERATION", "no program is in use"));
        };
        // A uniform that the program does not need has the location -1, which OpenGL ignores.
        let known = self.state.created.as_ref().is_some_and(|created| created.uniform(uniform).is_some());
        if !known {
            return Ok(());
        }
        let Some(location) = used.uniform(uniform) else {
            let why = "the location belongs to the program that was created last, but another one is in use";
            return Err(CallRefusal::new("INVALID_OPERATION", why));
        };
        let at = Some(&location);
        match given {
            UniformArgument::Whole(number) => {
                let value = self.state.value(number);
                self.attempt(call, |gl| gl.uniform_1_i32(at, value))
            }
            UniformArgument::Floats(numbers) => {
                let n = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
                self.attempt(call, |gl| match numbers.len() {
                    0 | 1 => gl.uniform_1_f32(at, n(0)),
                    2 => gl.uniform_2_f32(at, n(0), n(1)),
                    3 => gl.uniform_3_f32(at, n(0), n(1), n(2)),
                    _ => gl.uniform_4_f32(at, n(0), n(1), n(2), n(3)),
                })
            }
        }
    }

    fn fixed_function(&mut self, call: &GlCall) -> Refused {
        self.attempt(call, |gl| match call {
            GlCall::Viewport([x, y, width, height]) => gl.viewport(*x, *y, *width, *height),
            GlCall::Switch { what, on: true } => gl.enable(what.value),
            GlCall::Switch { what, on: false } => gl.disable(what.value),
            GlCall::ClearColor([r, g, b, a]) => gl.clear_color(*r, *g, *b, *a),
            _ => {}
        })?;
        if let GlCall::Clear(bits) = call {
            let mask = bits.iter().fold(0, |mask, bit| mask | bit.value);
            self.attempt(call, |gl| gl.clear(mask))?;
        }
        Ok(())
    }

    fn draw(&mut self, step: &Step) {
        let request = match &step.call {
            GlCall::DrawArrays { mode, first, count } => {
                DrawRequest { mode: mode.value, first: *first, count: *count, index_type: None }
            }
            GlCall::DrawElements { mode, count, kind, offset } => {
                DrawRequest { mode: mode.value, first: *offset, count: *count, index_type: Some(kind.value) }
            }
            _ => return,
        };
        self.draws.push((step.line, self.errors.len()));
        let gl = self.gl.clone();
        match errors::check_draw(&mut self.state, &request) {
            Err(refusal) => {
                gl.refused_draw(request.mode, request.first.max(0), request.count.max(0), request.index_type);
                self.note(step, refusal);
            }
            Ok(hidden) => {
                hidden.iter().for_each(|location| gl.disable_vertex_attrib_array(*location));
                match request.index_type {
                    None => gl.draw_arrays(request.mode, request.first, request.count),
                    Some(kind) => gl.draw_elements(request.mode, request.count, kind, request.first),
                }
                hidden.iter().for_each(|location| gl.enable_vertex_attrib_array(*location));
            }
        }
    }
}

/// OpenGL's name of an error.
fn error_name(code: u32) -> &'static str {
    match code {
        glow::INVALID_ENUM => "INVALID_ENUM",
        glow::INVALID_VALUE => "INVALID_VALUE",
        glow::INVALID_OPERATION => "INVALID_OPERATION",
        glow::INVALID_FRAMEBUFFER_OPERATION => "INVALID_FRAMEBUFFER_OPERATION",
        glow::OUT_OF_MEMORY => "OUT_OF_MEMORY",
        glow::CONTEXT_LOST => "CONTEXT_LOST",
        _ => "an error",
    }
}
