//! Draws the faces of a cubemap with a program, from a panorama.

use super::tiles::Tiles;
use crate::comparison::CompiledModel;
use crate::mistakes::Hypothesis;
use crate::roles::{Bindings, Role, VariableKind};
use crate::testbench::{TestShape, numbers, scene};
use glam::{DVec3, Vec3};
use gonio_environment::{Conversion, Panorama, convert};
use gonio_gl::{Gl, GlError};
use gonio_render::user_program::{FloatTexture, Stream, StreamMesh, TileTarget, UserProgram};

/// Most columns of the panorama's texture. A face has a quarter of them.
const MOST_COLUMNS: u32 = 1024;
/// Columns and rows of the panorama that shaders are tested with.
const SMOOTH: [u32; 2] = [128, 64];
const PANORAMA_UNIT: u32 = 0;

/// The meshes, textures and targets that faces are drawn with.
pub struct FaceBench {
    square: StreamMesh,
    cube: StreamMesh,
    panorama: FloatTexture,
    /// The target for all six faces.
    together: TileTarget,
    /// The target for one face: a program may use gl_FragCoord, which starts at 0 only here.
    alone: TileTarget,
    side: u32,
}

impl FaceBench {
    /// Uses the colours that mirrors are tested with: smooth, so that rounding does not matter, and without symmetry.
    pub fn smooth(gl: &Gl, side: u32) -> Result<Self, GlError> {
        let colours = |direction: DVec3| {
            let [r, g, b] = crate::testbench::radiance(direction.as_vec3());
            Vec3::new(r, g, b).as_dvec3()
        };
        FaceBench::new(gl, side, &Panorama::from_function(SMOOTH[0], SMOOTH[1], colours))
    }

    /// Uses a panorama, reduced if it is too large.
    pub fn of_panorama(gl: &Gl, side: u32, panorama: &Panorama) -> Result<Self, GlError> {
        let (width, height) = (panorama.image.width, panorama.image.height);
        if width <= MOST_COLUMNS && height <= MOST_COLUMNS {
            return FaceBench::new(gl, side, panorama);
        }
        let from = convert::EnvironmentRef::Panorama(panorama);
        let smaller = Conversion::default().panorama(from, MOST_COLUMNS, MOST_COLUMNS / 2);
        FaceBench::new(gl, side, &smaller)
    }

    fn new(gl: &Gl, side: u32, panorama: &Panorama) -> Result<Self, GlError> {
        let corners = [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0_f32];
        let coords = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0_f32];
        let stream = |name, components, numbers| Stream { name, components, numbers };
        let square = [stream("position", 3, corners.as_slice()), stream("tex_coord", 2, coords.as_slice())];
        let mesh = TestShape::Cube.mesh();
        let cube = [stream("position", 3, &mesh.positions), stream("tex_coord", 2, &mesh.tex_coords)];
        let image = &panorama.image;
        let size = [image.width as usize, image.height as usize];
        Ok(FaceBench {
            square: StreamMesh::new(gl, &square, &[0, 1, 2, 0, 2, 3], "face")?,
            cube: StreamMesh::new(gl, &cube, &mesh.indices, "cube")?,
            panorama: FloatTexture::panorama(gl, size, &image.pixels, "panorama")?,
            together: TileTarget::new(gl, side, 6)?,
            alone: TileTarget::new(gl, side, 1)?,
            side,
        })
    }

    /// Draws a student's program, with one draw call for each of the first `faces`; the others remain black.
    pub fn draw_student(
        &self,
        program: &UserProgram,
        bindings: &Bindings,
        fixed: &[(String, Vec<f32>)],
        is_cube: bool,
        faces: usize,
    ) -> Result<Tiles, GlError> {
        let feed = feed(program, bindings);
        let mut pixels = Vec::new();
        for face in 0..faces {
            self.alone.begin();
            self.panorama.bind(PANORAMA_UNIT);
            program.bind();
            for (name, values) in fixed {
                program.set(name, values);
            }
            self.set(program, bindings, face);
            self.alone.select(0);
            if is_cube { &self.cube } else { &self.square }.draw(program, &feed);
            if let Some(error) = self.alone.error() {
                return Err(error);
            }
            pixels.extend(self.alone.read(1));
        }
        Ok(self.tiles(&pixels))
    }

    /// Draws the model under a hypothesis.
    pub fn draw_model(&self, model: &CompiledModel, hypothesis: &Hypothesis) -> Result<Tiles, GlError> {
        // With the empty hypothesis, this is the program of all hypotheses.
        let made = model.program(&Hypothesis::default())?;
        let (program, bindings) = (&made.program, &made.bindings);
        let feed = feed(program, bindings);
        self.together.begin();
        self.panorama.bind(PANORAMA_UNIT);
        program.bind();
        for (name, values) in model.ways_of(hypothesis) {
            program.set(&name, &values);
        }
        for face in 0..6 {
            self.set(program, bindings, face);
            self.together.select(face);
            self.square.draw(program, &feed);
        }
        match self.together.error() {
            Some(error) => Err(error),
            None => Ok(self.tiles(&self.together.read(6))),
        }
    }

    fn set(&self, program: &UserProgram, bindings: &Bindings, face: usize) {
        let test_scene = scene::face(face);
        for bound in bindings.bound.iter().filter(|bound| bound.declared.kind == VariableKind::Uniform) {
            let glsl_type = bound.declared.glsl_type.as_str();
            let values = match (glsl_type, bound.role) {
                ("sampler2D", _) => Some(vec![PANORAMA_UNIT as f32]),
                (_, Role::Face) => Some(vec![face as f32]),
                (_, Role::Resolution) => Some(vec![self.side as f32; 2]),
                (_, role) => numbers(role, glsl_type, &test_scene),
            };
            if let Some(values) = values {
                program.set(&bound.declared.name, &values);
            }
        }
    }

    /// The first row that OpenGL returns is the first row of a face: t = -1.
    fn tiles(&self, pixels: &[[f32; 4]]) -> Tiles {
        let side = self.side as usize;
        let face = |face: usize| {
            let of_face = pixels.get(face * side * side..(face + 1) * side * side).unwrap_or_default();
            let mut face: Vec<[f32; 3]> = of_face.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
            face.resize(side * side, [0.0; 3]);
            face
        };
        Tiles { side, faces: std::array::from_fn(face) }
    }
}

/// Returns the locations of attributes and the streams that feed them.
fn feed(program: &UserProgram, bindings: &Bindings) -> Vec<(u32, usize)> {
    let stream = |role: Role| match role {
        Role::Position => Some(0),
        Role::TexCoord => Some(1),
        _ => None,
    };
    let attributes = bindings.bound.iter().filter(|bound| bound.declared.kind == VariableKind::Attribute);
    attributes
        .filter_map(|bound| Some((program.attribute_location(&bound.declared.name)?, stream(bound.role)?)))
        .collect()
}
