//! The shaders of an OpenGL program: compiled, linked, and freed with it.

use crate::user_program::BrokenProgram;
use gonio_gl::{Gl, GlError};

/// A linked program.
pub struct LinkedShaders {
    gl: Gl,
    /// OpenGL's name for it.
    pub handle: glow::Program,
}

impl LinkedShaders {
    /// Compiles and links. Both logs are there where both shaders are broken.
    pub fn new(gl: &Gl, vertex: &str, fragment: &str) -> Result<Self, BrokenProgram> {
        let handle = gl.create_program().map_err(GlError::new)?;
        let program = LinkedShaders { gl: gl.clone(), handle };
        let mut shaders = Vec::new();
        for (kind, source) in [(glow::VERTEX_SHADER, vertex), (glow::FRAGMENT_SHADER, fragment)] {
            let shader = gl.create_shader(kind).map_err(GlError::new)?;
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            gl.attach_shader(handle, shader);
            shaders.push(shader);
        }
        gl.link_program(handle);
        let mut broken = None;
        if !gl.get_program_link_status(handle) {
            let mut logs = shaders
                .iter()
                .map(|&shader| (!gl.get_shader_compile_status(shader)).then(|| gl.get_shader_info_log(shader)));
            let [vertex_log, fragment_log] = [logs.next().flatten(), logs.next().flatten()];
            let neither = vertex_log.is_none() && fragment_log.is_none();
            let link_log = neither.then(|| gl.get_program_info_log(handle));
            broken = Some(BrokenProgram { vertex_log, fragment_log, link_log, driver: None });
        }
        for shader in shaders {
            gl.detach_shader(handle, shader);
            gl.delete_shader(shader);
        }
        match broken {
            Some(broken) => Err(broken),
            None => Ok(program),
        }
    }

    /// The location of an attribute; `None` if the program has no active attribute of that name.
    pub fn attribute(&self, name: &str) -> Option<u32> {
        self.gl.get_attrib_location(self.handle, name)
    }

    /// The location of a uniform; `None` if the program has no active uniform of that name.
    pub fn uniform(&self, name: &str) -> Option<glow::UniformLocation> {
        self.gl.get_uniform_location(self.handle, name)
    }

    /// Locations of all attributes that it reads.
    pub fn locations(&self) -> Vec<u32> {
        let gl = &self.gl;
        let attributes =
            (0..gl.get_active_attributes(self.handle)).filter_map(|index| gl.get_active_attribute(self.handle, index));
        // gl_VertexID and its like have none.
        attributes.filter_map(|attribute| gl.get_attrib_location(self.handle, &attribute.name)).collect()
    }
}

impl Drop for LinkedShaders {
    fn drop(&mut self) {
        self.gl.delete_program(self.handle);
    }
}
