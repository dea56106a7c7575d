//! A linked program and its uniforms by name.

use crate::calls::native_name;
use crate::{Gl, GlError};
use glam::{DVec3, Mat3, Mat4, Vec2, Vec3};
use std::cell::RefCell;
use std::collections::HashMap;

/// A linked program. Freed when dropped.
pub struct Program {
    gl: Gl,
    handle: glow::Program,
    locations: RefCell<HashMap<&'static str, Option<glow::UniformLocation>>>,
}

impl Program {
    /// Compiles and links. An error carries the driver's log and the source with its line numbers.
    pub fn new(gl: &Gl, name: &str, vertex: &str, fragment: &str, attributes: &[(u32, &str)]) -> Result<Self, GlError> {
        let handle = gl.create_program().map_err(GlError::new)?;
        // Owned from here on, so that every return frees it.
        let program = Program { gl: gl.clone(), handle, locations: RefCell::default() };
        let mut shaders = Vec::new();
        for (kind, stage, source) in
            [(glow::VERTEX_SHADER, "vertex", vertex), (glow::FRAGMENT_SHADER, "fragment", fragment)]
        {
            let shader = gl.create_shader(kind).map_err(GlError::new)?;
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            gl.attach_shader(handle, shader);
            shaders.push((shader, stage, source));
        }
        for &(location, attribute) in attributes {
            gl.bind_attrib_location(handle, location, attribute);
        }
        gl.link_program(handle);
        // Only one query without errors, because each waits for the GPU on the web: shaders that do not compile do not link.
        let mut failed = None;
        if !gl.get_program_link_status(handle) {
            let broken = shaders.iter().rfind(|(shader, ..)| !gl.get_shader_compile_status(*shader));
            failed = Some(match broken {
                Some((shader, stage, source)) => format!(
                    "the {stage} shader of `{name}` does not compile:\n{}\n{}",
                    gl.get_shader_info_log(*shader).trim_end(),
                    numbered(source)
                ),
                None => format!("`{name}` does not link:\n{}", gl.get_program_info_log(handle).trim_end()),
            });
        }
        for (shader, ..) in shaders {
            gl.detach_shader(handle, shader);
            gl.delete_shader(shader);
        }
        if let Some(message) = failed {
            return Err(GlError::new(message));
        }
        gl.name_program(handle, name);
        if gl.functions().supports_debug() {
            gl.object_label(glow::PROGRAM, native_name!(handle), Some(name));
        }
        Ok(program)
    }

    /// Its id in records.
    pub fn id(&self) -> u32 {
        self.gl.program_id(self.handle)
    }

    /// The OpenGL object.
    pub fn handle(&self) -> glow::Program {
        self.handle
    }

    /// Makes it the current program.
    pub fn bind(&self) {
        self.gl.use_program(Some(self.handle));
    }

    /// The location of a uniform; `None` if the compiler removed it.
    #[allow(clippy::clone_on_copy)] // not Copy on the web
    fn location(&self, name: &'static str) -> Option<glow::UniformLocation> {
        self.locations
            .borrow_mut()
            .entry(name)
            .or_insert_with(|| self.gl.get_uniform_location(self.handle, name))
            .clone()
    }

    /// Sets an `int`, `bool` or sampler of the current program.
    pub fn set_i32(&self, name: &'static str, value: i32) {
        self.gl.uniform_1_i32(self.location(name).as_ref(), value);
    }

    /// Sets a `float` of the current program.
    pub fn set_f32(&self, name: &'static str, value: f32) {
        self.gl.uniform_1_f32(self.location(name).as_ref(), value);
    }

    /// Sets a `vec2` of the current program.
    pub fn set_vec2(&self, name: &'static str, v: Vec2) {
        self.gl.uniform_2_f32(self.location(name).as_ref(), v.x, v.y);
    }

    /// Sets an `ivec2` of the current program.
    pub fn set_ivec2(&self, name: &'static str, [x, y]: [i32; 2]) {
        self.gl.uniform_2_i32(self.location(name).as_ref(), x, y);
    }

    /// Sets a `vec3` of the current program.
    pub fn set_vec3(&self, name: &'static str, v: Vec3) {
        self.gl.uniform_3_f32(self.location(name).as_ref(), v.x, v.y, v.z);
    }

    /// Sets a `vec3` of the current program, rounded to f32.
    pub fn set_dvec3(&self, name: &'static str, v: DVec3) {
        self.set_vec3(name, v.as_vec3());
    }

    /// Sets a `vec4` of the current program.
    pub fn set_vec4(&self, name: &'static str, v: [f32; 4]) {
        self.gl.uniform_4_f32_slice(self.location(name).as_ref(), &v);
    }

    /// Sets the first elements of an array of `vec4` of the current program.
    pub fn set_vec4_array(&self, name: &'static str, values: &[[f32; 4]]) {
        self.gl.uniform_4_f32_slice(self.location(name).as_ref(), values.as_flattened());
    }

    /// Sets the first elements of an array of `vec3` of the current program.
    pub fn set_vec3_array(&self, name: &'static str, values: &[[f32; 3]]) {
        self.gl.uniform_3_f32_slice(self.location(name).as_ref(), values.as_flattened());
    }

    /// Sets a `mat3x2` (three columns of two) of the current program.
    pub fn set_mat3x2(&self, name: &'static str, columns: &[[f32; 2]; 3]) {
        self.gl.uniform_matrix_3x2_f32_slice(self.location(name).as_ref(), false, columns.as_flattened());
    }

    /// Sets a `mat3` of the current program.
    pub fn set_mat3(&self, name: &'static str, m: &Mat3) {
        self.gl.uniform_matrix_3_f32_slice(self.location(name).as_ref(), false, &m.to_cols_array());
    }

    /// Sets a `mat4` of the current program.
    pub fn set_mat4(&self, name: &'static str, m: &Mat4) {
        self.gl.uniform_matrix_4_f32_slice(self.location(name).as_ref(), false, &m.to_cols_array());
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.gl.delete_program(self.handle);
    }
}

fn numbered(source: &str) -> String {
    source.lines().enumerate().map(|(i, line)| format!("{:4}  {line}\n", i + 1)).collect()
}
