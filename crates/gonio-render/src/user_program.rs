//! Programs with any attributes and uniforms, drawn into float targets: students' shaders and their references.
//!
//! The names and types of attributes and uniforms are those that OpenGL reports after linking. The caller decides which
//! stream of a mesh feeds which attribute, and sets every uniform.

use gonio_gl::objects::{Buffer, TextureObject, VertexArray};
use gonio_gl::target::{ColorPrecision, Sampling, Target};
use gonio_gl::trace::enums;
use gonio_gl::{Dialect, Gl, GlError, Texels};
use std::cell::RefCell;
use std::fmt;

/// Whether a context is one of OpenGL ES, as WebGL2 is, whose shaders begin with `#version 300 es`.
pub fn is_embedded(gl: &gonio_gl::Gl) -> bool {
    gl.is_embedded()
}

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
        let logs = parts.iter().filter_map(|(what, log)| log.as_ref().map(|log| format!("{what}: {}", log.trim_end())));
        f.write_str(&logs.collect::<Vec<_>>().join("\n"))
    }
}

impl std::error::Error for BrokenProgram {}

impl From<GlError> for BrokenProgram {
    fn from(error: GlError) -> Self {
        BrokenProgram { driver: Some(error.message), ..Self::default() }
    }
}

/// An active attribute or uniform of a program, as OpenGL reports it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramVariable {
    /// OpenGL's name, without a closing `[0]`: `light.light_pos`, `lights[1].position`, `colours`.
    pub name: String,
    /// Its GLSL type: `vec3`, `mat4`, `samplerCube`.
    pub glsl_type: String,
    /// Number of elements of an array of a basic type; 1 if it is not an array.
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
    /// Compiles and links. The error has the logs of all shaders that do not compile.
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
            // Built-in attributes such as gl_VertexID have no location.
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
            // Members of blocks have no location.
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
    pub(crate) fn locations(&self) -> impl Iterator<Item = u32> {
        self.attributes.iter().map(|(_, location)| *location)
    }

    /// Makes it the current program, which `set` and draws require.
    pub fn bind(&self) {
        self.gl.use_program(Some(self.handle));
    }

    /// Sets a uniform of the bound program: matrices by columns, samplers to a unit, integers and booleans rounded. Missing
    /// numbers are 0, extra ones are ignored. Returns `false` if there is no such uniform.
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
            // int, bool and samplers; rarer types (doubles, non-square matrices) stay 0.
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

/// Numbers for each vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream<'a> {
    /// The label in debuggers.
    pub name: &'a str,
    /// A vertex' numbers, 1 to 4.
    pub components: usize,
    /// All vertices' numbers.
    pub numbers: &'a [f32],
}

/// Triangles on the GPU.
pub struct StreamMesh {
    gl: Gl,
    array: VertexArray,
    streams: Vec<(i32, Buffer)>,
    _indices: Buffer,
    count: i32,
}

impl StreamMesh {
    /// Uploads a mesh. An index that is not less than the number of vertices of every stream is an error.
    pub fn new(gl: &Gl, streams: &[Stream<'_>], indices: &[u32], name: &str) -> Result<Self, GlError> {
        let array = VertexArray::bound(gl, name)?;
        let last = indices.iter().copied().max().unwrap_or(0) as usize;
        let mut buffers = Vec::new();
        for stream in streams {
            if !(1..=4).contains(&stream.components) || (last + 1) * stream.components > stream.numbers.len() {
                return Err(GlError::new(format!("{name}: the stream `{}` has too few vertices", stream.name)));
            }
            let bytes: &[u8] = bytemuck::cast_slice(stream.numbers);
            let label = format!("{name}: {}", stream.name);
            let buffer = Buffer::with_bytes(gl, glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW, &label)?;
            buffers.push((stream.components as i32, buffer));
        }
        let bytes: &[u8] = bytemuck::cast_slice(indices);
        let indices_buffer = Buffer::with_bytes(gl, glow::ELEMENT_ARRAY_BUFFER, bytes, glow::STATIC_DRAW, name)?;
        gl.bind_vertex_array(None);
        let count = indices.len() as i32;
        Ok(StreamMesh { gl: gl.clone(), array, streams: buffers, _indices: indices_buffer, count })
    }

    /// Draws it with the bound program: attributes by location, each with the number of its stream; those that are not named
    /// read (0, 0, 0, 1).
    pub fn draw(&self, program: &UserProgram, feed: &[(u32, usize)]) {
        let gl = &self.gl;
        gl.bind_vertex_array(Some(self.array.handle()));
        for location in program.locations() {
            gl.disable_vertex_attrib_array(location);
            gl.vertex_attrib_4_f32(location, 0.0, 0.0, 0.0, 1.0);
        }
        for &(location, stream) in feed {
            let Some((components, buffer)) = self.streams.get(stream) else { continue };
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer.handle()));
            gl.enable_vertex_attrib_array(location);
            gl.vertex_attrib_pointer_f32(location, *components, glow::FLOAT, false, 0, 0);
        }
        gl.draw_elements(glow::TRIANGLES, self.count, glow::UNSIGNED_INT, 0);
        gl.bind_vertex_array(None);
    }
}

/// A texture of float texels, filtered linearly, without mipmaps.
pub struct FloatTexture {
    gl: Gl,
    object: TextureObject,
    target: u32,
}

impl FloatTexture {
    /// A 2-D texture that repeats; rows from the bottom.
    pub fn flat(gl: &Gl, size: [usize; 2], rgba: &[[f32; 4]], name: &str) -> Result<Self, GlError> {
        let object = TextureObject::bound(gl, name)?;
        fill(gl, glow::TEXTURE_2D, size, rgba, name)?;
        finish(gl, glow::TEXTURE_2D, glow::REPEAT);
        Ok(FloatTexture { gl: gl.clone(), object, target: glow::TEXTURE_2D })
    }

    /// A panorama: repeated along its rows, clamped to its first and last row. The first row is at t = 0.
    pub fn panorama(gl: &Gl, size: [usize; 2], rgba: &[[f32; 4]], name: &str) -> Result<Self, GlError> {
        let panorama = Self::flat(gl, size, rgba, name)?;
        gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE as i32);
        Ok(panorama)
    }

    /// A cubemap: six faces +X -X +Y -Y +Z -Z in OpenGL's layout, each with the rows from t = 0.
    pub fn cube(gl: &Gl, side: usize, faces: &[Vec<[f32; 4]>; 6], name: &str) -> Result<Self, GlError> {
        let object = TextureObject::cube(gl, name)?;
        for (target, face) in (glow::TEXTURE_CUBE_MAP_POSITIVE_X..).zip(faces) {
            fill(gl, target, [side, side], face, name)?;
        }
        finish(gl, glow::TEXTURE_CUBE_MAP, glow::CLAMP_TO_EDGE);
        Ok(FloatTexture { gl: gl.clone(), object, target: glow::TEXTURE_CUBE_MAP })
    }

    /// Binds it to a unit.
    pub fn bind(&self, unit: u32) {
        self.gl.active_texture(glow::TEXTURE0 + unit.min(15));
        self.gl.bind_texture(self.target, Some(self.object.handle()));
    }
}

/// Half floats, which every driver filters.
fn fill(gl: &Gl, target: u32, [w, h]: [usize; 2], rgba: &[[f32; 4]], name: &str) -> Result<(), GlError> {
    if rgba.len() != w * h {
        return Err(GlError::new(format!("{name}: {} texels are not {w} x {h}", rgba.len())));
    }
    gl.tex_image_2d(target, 0, glow::RGBA16F, [w as i32, h as i32], Texels::f32(glow::RGBA, rgba.as_flattened()));
    Ok(())
}

fn finish(gl: &Gl, target: u32, wrap: u32) {
    let parameters = [
        (glow::TEXTURE_MIN_FILTER, glow::LINEAR),
        (glow::TEXTURE_MAG_FILTER, glow::LINEAR),
        (glow::TEXTURE_WRAP_S, wrap),
        (glow::TEXTURE_WRAP_T, wrap),
    ];
    for (parameter, value) in parameters {
        gl.tex_parameter_i32(target, parameter, value as i32);
    }
}

/// The value of a pixel that nothing was drawn to; light is never that negative.
pub const NOT_DRAWN: [f32; 4] = [-31_337.0; 4];

/// Square tiles side by side, each with a depth buffer; 32-bit floats, one sample a pixel.
pub struct TileTarget {
    gl: Gl,
    target: Target,
    side: i32,
    columns: i32,
    count: usize,
}

impl TileTarget {
    /// Creates `count` tiles of `side` pixels. More than the driver's largest texture can hold is an error.
    pub fn new(gl: &Gl, side: u32, count: usize) -> Result<Self, GlError> {
        let columns = (count as f64).sqrt().ceil().max(1.0) as i32;
        let rows = (count as i32 + columns - 1) / columns;
        let size = [columns * side as i32, rows.max(1) * side as i32];
        let dialect = if gl.is_embedded() { Dialect::Es300 } else { Dialect::Core330 };
        let target = Target::new(gl, dialect, size, Sampling::Multi(1), ColorPrecision::Full)?;
        Ok(TileTarget { gl: gl.clone(), target, side: side as i32, columns, count })
    }

    /// Pixels along a tile's side.
    pub fn side(&self) -> usize {
        self.side as usize
    }

    /// Empties all tiles: [`NOT_DRAWN`], depth 1.
    pub fn begin(&self) {
        let gl = &self.gl;
        self.target.begin(gl, 0, self.target.size[1]);
        let [r, g, b, a] = NOT_DRAWN;
        gl.clear_color(r, g, b, a);
        gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.disable(glow::STENCIL_TEST);
        gl.enable(glow::DEPTH_TEST);
        // Fragments at the far plane pass, as a skybox needs.
        gl.depth_func(glow::LEQUAL);
    }

    /// Restricts later draws to this tile. Returns `false` if there is no such tile.
    pub fn select(&self, tile: usize) -> bool {
        if tile >= self.count {
            return false;
        }
        let (x, y) = (tile as i32 % self.columns * self.side, tile as i32 / self.columns * self.side);
        self.gl.viewport(x, y, self.side, self.side);
        self.gl.enable(glow::SCISSOR_TEST);
        self.gl.scissor(x, y, self.side, self.side);
        true
    }

    /// The first tiles one after the other, each `side * side` pixels, the bottom row first. Waits for the GPU.
    pub fn read(&self, count: usize) -> Vec<[f32; 4]> {
        self.gl.disable(glow::SCISSOR_TEST);
        let all = self.target.read_single(&self.gl);
        let (side, width) = (self.side as usize, self.target.size[0] as usize);
        let count = count.min(self.count);
        let mut tiles = Vec::with_capacity(count * side * side);
        for tile in 0..count {
            let (column, row) = (tile % self.columns as usize, tile / self.columns as usize);
            for y in 0..side {
                let first = ((row * side + y) * width + column * side) * 4;
                let line = all.get(first..first + side * 4).unwrap_or_default();
                tiles.extend(line.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]));
            }
        }
        tiles
    }

    /// The error that OpenGL has raised since the last call, if any.
    pub fn error(&self) -> Option<GlError> {
        let code = self.gl.get_error();
        (code != glow::NO_ERROR).then(|| GlError::new(format!("OpenGL reported error {code:#06x} while drawing")))
    }
}
