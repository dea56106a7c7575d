//! Traces of sequences of OpenGL calls, on the driver of this machine: Mesa's llvmpipe in CI.

mod deferred;
mod samplers;
mod vertices;

use crate::headless::{HeadlessContext, HeadlessOptions};
use crate::objects::{Buffer, TextureObject, VertexArray};
use crate::program::Program;
use crate::target::OutputTarget;
use crate::trace::{Finding, FrameRecord, Recording, Rule, lint};
use crate::{Gl, Texels};

/// Pixels along a side of the picture.
pub const SIDE: i32 = 16;

/// A vertex shader with a position, a normal and two matrices.
pub const LIT: &str = "in vec3 position;\nin vec3 normal;\nuniform mat4 model;\nuniform mat3 normal_matrix;\nout vec3 n;\n\
    void main() { n = normal_matrix * normal; gl_Position = model * vec4(position, 1.0); }\n";
/// Its fragment shader.
pub const NORMALS: &str = "in vec3 n;\nout vec4 c;\nvoid main() { c = vec4(n, 1.0); }\n";
/// Three corners without a buffer.
pub const CORNERS: &str =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }\n";

/// A context; panics with the packages to install if there is none.
fn context(es: bool) -> HeadlessContext {
    HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() })
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A context in which a sequence of calls is recorded, right or wrong, as a student might write it.
pub struct Lab {
    recording: Option<Recording>,
    gl: Gl,
    es: bool,
    output: OutputTarget,
    textures: Vec<TextureObject>,
    programs: Vec<Program>,
    _array: VertexArray,
    _context: HeadlessContext,
}

impl Lab {
    /// Creates a context with a small picture, and starts recording.
    pub fn new(es: bool) -> Lab {
        let context = context(es);
        let gl = context.gl().clone();
        let output = OutputTarget::new(&gl, [SIDE; 2], false).unwrap_or_else(|e| panic!("{e}"));
        let recording = Recording::begin(&gl).unwrap_or_else(|e| panic!("{e}"));
        output.bind(&gl);
        let array = VertexArray::bound(&gl, "lab").unwrap_or_else(|e| panic!("{e}"));
        Lab {
            recording: Some(recording),
            gl,
            es,
            output,
            textures: Vec::new(),
            programs: Vec::new(),
            _array: array,
            _context: context,
        }
    }

    /// The functions.
    pub fn gl(&self) -> &Gl {
        &self.gl
    }

    /// Compiles a program and uses it.
    pub fn program(&mut self, vertex: &str, fragment: &str) {
        let header = if self.es {
            "#version 300 es\nprecision highp float;\nprecision highp samplerCube;\n"
        } else {
            "#version 330 core\n"
        };
        let [vertex, fragment] = [vertex, fragment].map(|source| [header, source].concat());
        let attributes = [(0, "position"), (1, "normal")];
        let program =
            Program::new(&self.gl, "student's", &vertex, &fragment, &attributes).unwrap_or_else(|e| panic!("{e}"));
        program.bind();
        self.programs.push(program);
    }

    /// The program in use.
    pub fn used(&self) -> &Program {
        self.programs.last().unwrap_or_else(|| panic!("no program"))
    }

    /// A texture of 4 x 4 red texels with one level, bound to a unit; its id.
    pub fn texture(&mut self, unit: u32, name: &str) -> u32 {
        self.texels(unit, name, glow::TEXTURE_2D)
    }

    /// The same as a cubemap.
    pub fn cube(&mut self, unit: u32, name: &str) -> u32 {
        self.texels(unit, name, glow::TEXTURE_CUBE_MAP)
    }

    fn texels(&mut self, unit: u32, name: &str, target: u32) -> u32 {
        let gl = &self.gl;
        gl.active_texture(glow::TEXTURE0 + unit);
        let (texture, faces) = match target {
            glow::TEXTURE_2D => (TextureObject::bound(gl, name), glow::TEXTURE_2D..=glow::TEXTURE_2D),
            _ => (TextureObject::cube(gl, name), glow::TEXTURE_CUBE_MAP_POSITIVE_X..=glow::TEXTURE_CUBE_MAP_NEGATIVE_Z),
        };
        let texture = texture.unwrap_or_else(|e| panic!("{e}"));
        let red = [255, 0, 0, 255].repeat(16);
        for face in faces {
            gl.tex_image_2d(face, 0, glow::RGBA8, [4, 4], Texels::u8(glow::RGBA, &red));
        }
        gl.tex_parameter_i32(target, glow::TEXTURE_MIN_FILTER, glow::LINEAR as i32);
        let id = texture.handle().0.get();
        self.textures.push(texture);
        id
    }

    /// OpenGL's name of the texture that was made last.
    pub fn newest_texture(&self) -> Option<glow::Texture> {
        self.textures.last().map(TextureObject::handle)
    }

    /// Binds a texture that was made before, the first being 0.
    pub fn bind(&self, unit: u32, which: usize) {
        self.gl.active_texture(glow::TEXTURE0 + unit);
        self.gl.bind_texture(glow::TEXTURE_2D, Some(self.textures[which].handle()));
    }

    /// Three vertices of six numbers each, position and normal, in one buffer; their strides.
    pub fn vertices(&self, strides: [i32; 2]) -> Buffer {
        let numbers: Vec<f32> = [[-1.0_f32, -1.0], [3.0, -1.0], [-1.0, 3.0]]
            .into_iter()
            .flat_map(|[x, y]| [x, y, 0.0, 0.0, 0.0, 1.0])
            .collect();
        let bytes = bytemuck::cast_slice(&numbers);
        let buffer = Buffer::with_bytes(&self.gl, glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW, "corners");
        for (location, stride) in (0..).zip(strides) {
            self.gl.enable_vertex_attrib_array(location);
            self.gl.vertex_attrib_pointer_f32(location, 3, glow::FLOAT, false, stride, 12 * location as i32);
        }
        buffer.unwrap_or_else(|e| panic!("{e}"))
    }

    /// Draws three vertices.
    pub fn draw(&self) {
        self.draw_vertices(3);
    }

    /// Draws this many vertices.
    pub fn draw_vertices(&self, count: i32) {
        self.gl.draw_arrays(glow::TRIANGLES, 0, count);
    }

    /// The record and its findings.
    pub fn finish(mut self) -> (FrameRecord, Vec<Finding>) {
        let recording = self.recording.take().unwrap_or_else(|| panic!("it records"));
        let record = recording.finish();
        let findings = lint(&record);
        (record, findings)
    }

    /// The picture's first pixel.
    pub fn pixel(&self) -> [u8; 4] {
        self.output.read8(&self.gl).first_chunk().copied().unwrap_or_default()
    }
}

/// Returns the only finding, and asserts its rule and the number of draws.
pub fn only(findings: &[Finding], rule: Rule, draws: usize) -> &Finding {
    assert_eq!(findings.iter().map(|f| (f.rule, f.draws)).collect::<Vec<_>>(), [(rule, draws)], "{findings:#?}");
    &findings[0]
}

/// Runs a test in OpenGL and in OpenGL ES.
pub fn both(test: impl Fn(Lab)) {
    for es in [false, true] {
        test(Lab::new(es));
    }
}
