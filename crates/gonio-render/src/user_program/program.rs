//! A program with whatever attributes and uniforms it has.

use gonio_gl::trace::enums;
use gonio_gl::{Gl, GlError};
use std::cell::RefCell;
use std::fmt;

/// The logs of the driver for a pair of shaders that is not a program; at least one of them is present.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BrokenProgram {
    /// The log of the vertex shader, if it does not compile.
    pub vertex_log: Option<String>,
    /// The log of the fragment shader, if it does not compile.
    pub fragment_log: Option<String>,
    /// The log of the linker, if both compile.
    pub link_log: Option<String>,
    /// The error before compilation, if there was one.
    pub driver: Option<String>,
}

impl fmt::Display for BrokenProgram {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            ("the vertex shader does not compile", &self.vertex_log),
            ("the fragment shader does not compile", &self.fragment_log),
            ("the two do not link", &self.link_log),
            ("OpenGL made no program", &self.driver),
        ];
        let said = parts.iter().filter_map(|(what, log)| log.as_ref().map(|log| format!("{what}: {}", log.trim_end())));
        f.write_str(&said.collect::<Vec<_>>().join("\n"))
    }
}

impl std::error::Error for BrokenProgram {}

impl From<GlError> for BrokenProgram {
    fn from(error: GlError) -> Self {
        BrokenProgram { driver: Some(error.message), ..Self::default() }
    }
}

/// An attribute or a uniform that a program uses, as OpenGL tells it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramVariable {
    /// OpenGL's name, without a closing `[0]`: `light.light_pos`, `lights[1].position`, `colours`.
    pub name: String,
    /// Its GLSL type: `vec3`, `mat4`, `samplerCube`.
    pub glsl_type: String,
    /// Elements of an array of a basic type; 1 where it is none.
    pub elements: u32,
    code: u32,
}

/// A linked program. Freed when dropped.
pub struct UserProgram {
    gl: Gl,
    handle: glow::Program,
    attributes: Vec<(ProgramVariable, u32)>,
    uniforms: Vec<(ProgramVariable, Vec<glow::UniformLocation>)>,
    /// The last value of each uniform, to avoid calls, which are expensive in browsers; empty if it was never set.
    given: RefCell<Vec<Vec<f32>>>,
}

impl UserProgram {
    /// Compiles and links. Both logs are there where both shaders are broken.
    pub fn new(gl: &Gl, vertex: &str, fragment: &str) -> Result<Self, BrokenProgram> {
        let handle = gl.create_program().map_err(GlError::new)?;
        let mut program = UserProgram {
            gl: gl.clone(),
            handle,
            attributes: Vec::new(),
            uniforms: Vec::new(),
            given: RefCell::default(),
        };
        let mut shaders = Vec::new();
        for (kind, source) in [(glow::VERTEX_SHADER, vertex), (glow::FRAGMENT_SHADER, fragment)] {
            let shader = gl.create_shader(kind).map_err(GlError::new)?;
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            gl.attach_shader(handle, shader);
            shaders.push(shader);
        }
        gl.link_program(handle);
        let linked = gl.get_program_link_status(handle);
        let log =
            |&shader: &glow::Shader| (!gl.get_shader_compile_status(shader)).then(|| gl.get_shader_info_log(shader));
        let mut broken = BrokenProgram::default();
        if !linked {
            [broken.vertex_log, broken.fragment_log] = [log(&shaders[0]), log(&shaders[1])];
            if broken.vertex_log.is_none() && broken.fragment_log.is_none() {
                broken.link_log = Some(gl.get_program_info_log(handle));
            }
        }
        for shader in shaders {
            gl.detach_shader(handle, shader);
            gl.delete_shader(shader);
        }
        if !linked {
            return Err(broken);
        }
        program.read_interface();
        Ok(program)
    }

    fn read_interface(&mut self) {
        let gl = &self.gl;
        for index in 0..gl.get_active_attributes(self.handle) {
            let Some(attribute) = gl.get_active_attribute(self.handle, index) else { continue };
            // gl_VertexID and its like have none.
            let Some(location) = gl.get_attrib_location(self.handle, &attribute.name) else { continue };
            let elements = attribute.size.max(1) as u32;
            let (code, glsl_type) = (attribute.atype, enums::glsl_type(attribute.atype));
            self.attributes.push((ProgramVariable { name: attribute.name, glsl_type, elements, code }, location));
        }
        for index in 0..gl.get_active_uniforms(self.handle) {
            let Some(uniform) = gl.get_active_uniform(self.handle, index) else { continue };
            let name = uniform.name.strip_suffix("[0]").unwrap_or(&uniform.name).to_owned();
            let locations: Vec<_> = (0..uniform.size)
                .filter_map(|element| match uniform.size {
                    1 => gl.get_uniform_location(self.handle, &uniform.name),
                    _ => gl.get_uniform_location(self.handle, &format!("{name}[{element}]")),
                })
                .collect();
            // Members of blocks have none.
            if !locations.is_empty() {
                let elements = locations.len() as u32;
                let glsl_type = enums::glsl_type(uniform.utype);
                self.uniforms.push((ProgramVariable { name, glsl_type, elements, code: uniform.utype }, locations));
            }
        }
        self.attributes.sort_by_key(|(_, location)| *location);
        self.uniforms.sort_by(|(a, _), (b, _)| a.name.cmp(&b.name));
        self.given = RefCell::new(vec![Vec::new(); self.uniforms.len()]);
    }

    /// The active attributes, in order of location.
    pub fn attributes(&self) -> impl Iterator<Item = &ProgramVariable> {
        self.attributes.iter().map(|(variable, _)| variable)
    }

    /// The active uniforms outside of blocks, in order of name.
    pub fn uniforms(&self) -> impl Iterator<Item = &ProgramVariable> {
        self.uniforms.iter().map(|(variable, _)| variable)
    }

    /// The location of an attribute.
    pub fn attribute_location(&self, name: &str) -> Option<u32> {
        self.attributes.iter().find(|(variable, _)| variable.name == name).map(|(_, location)| *location)
    }

    /// The number of a uniform, for [`UserProgram::set_index`].
    pub fn uniform_index(&self, name: &str) -> Option<usize> {
        self.uniforms.iter().position(|(variable, _)| variable.name == name)
    }

    /// Locations of all attributes.
    pub(super) fn locations(&self) -> impl Iterator<Item = u32> {
        self.attributes.iter().map(|(_, location)| *location)
    }

    /// Makes it the current program, which `set` and draws require.
    pub fn bind(&self) {
        self.gl.use_program(Some(self.handle));
    }

    /// Gives a uniform its numbers, of the bound program: matrices by columns, samplers their unit, integers and booleans
    /// rounded. Too few numbers are filled up with 0, too many are left out. False where there is no such uniform.
    pub fn set(&self, name: &str, values: &[f32]) -> bool {
        self.uniform_index(name).is_some_and(|index| self.set_index(index, values))
    }

    /// Sets a uniform by its number.
    pub fn set_index(&self, index: usize, values: &[f32]) -> bool {
        let Some((variable, locations)) = self.uniforms.get(index) else { return false };
        if let Some(given) = self.given.borrow_mut().get_mut(index) {
            if !values.is_empty() && given == values {
                return true;
            }
            values.clone_into(given);
        }
        let size = enums::layout(variable.code).map_or(1, |(_, numbers)| numbers);
        for (element, location) in locations.iter().enumerate() {
            let mut numbers = [0.0_f32; 16];
            for (number, value) in numbers.iter_mut().zip(values.iter().skip(element * size).take(size)) {
                *number = *value;
            }
            self.set_element(variable.code, location, &numbers[..size.min(16)]);
        }
        true
    }

    fn set_element(&self, code: u32, location: &glow::UniformLocation, v: &[f32]) {
        let (gl, at) = (&self.gl, Some(location));
        let int = |i: usize| v.get(i).map_or(0, |x| x.round() as i32);
        let uint = |i: usize| v.get(i).map_or(0, |x| x.round() as u32);
        match code {
            glow::FLOAT => gl.uniform_1_f32(at, v[0]),
            glow::FLOAT_VEC2 => gl.uniform_2_f32(at, v[0], v[1]),
            glow::FLOAT_VEC3 => gl.uniform_3_f32(at, v[0], v[1], v[2]),
            glow::FLOAT_VEC4 => gl.uniform_4_f32_slice(at, v),
            glow::FLOAT_MAT2 => gl.uniform_matrix_2_f32_slice(at, false, v),
            glow::FLOAT_MAT3 => gl.uniform_matrix_3_f32_slice(at, false, v),
            glow::FLOAT_MAT4 => gl.uniform_matrix_4_f32_slice(at, false, v),
            glow::INT_VEC2 | glow::BOOL_VEC2 => gl.uniform_2_i32(at, int(0), int(1)),
            glow::INT_VEC3 | glow::BOOL_VEC3 => gl.uniform_3_i32(at, int(0), int(1), int(2)),
            glow::INT_VEC4 | glow::BOOL_VEC4 => gl.uniform_4_i32(at, int(0), int(1), int(2), int(3)),
            glow::UNSIGNED_INT => gl.uniform_1_u32(at, uint(0)),
            // int, bool and samplers; what is rarer (doubles, non-square matrices) stays 0.
            glow::INT | glow::BOOL => gl.uniform_1_i32(at, int(0)),
            _ if enums::TextureKind::from_sampler_type(code).is_some() => gl.uniform_1_i32(at, int(0)),
            _ => {}
        }
    }
}

impl Drop for UserProgram {
    fn drop(&mut self) {
        self.gl.delete_program(self.handle);
    }
}
