//! Draws programs in all test scenes at once.

use super::{CUBEMAP_UNIT, SKY_SIDE, TestScene, TestShape, WHITE_UNIT, numbers_of, samplers, sky_faces, unit};
use crate::roles::{Bindings, Bound, Role, VariableKind};
use gonio_gl::{Gl, GlError};
use gonio_render::user_program::{FloatTexture, NOT_DRAWN, Stream, StreamMesh, TileTarget, UserProgram};

/// Side length of a test scene's picture in pixels: enough for a hundred triangles, and cheap without a GPU.
pub const TILE: u32 = 32;

/// The pictures of all test scenes in order, linear RGBA; [`NOT_DRAWN`] where nothing is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// `TILE * TILE` pixels for each test scene, the bottom row first.
    pub pixels: Vec<[f32; 4]>,
}

impl Atlas {
    /// Returns the pixels of one test scene.
    pub fn tile(&self, index: usize) -> &[[f32; 4]] {
        let size = (TILE * TILE) as usize;
        self.pixels.get(index * size..(index + 1) * size).unwrap_or_default()
    }

    /// Whether something was drawn at a pixel.
    pub fn is_drawn(pixel: &[f32; 4]) -> bool {
        // Not `!=`: a pixel may hold NaN.
        pixel[0] != NOT_DRAWN[0] || pixel[3] != NOT_DRAWN[3]
    }
}

/// The meshes, textures, scenes and target that programs are drawn with.
pub struct Testbench {
    meshes: Vec<StreamMesh>,
    cubemap: FloatTexture,
    white: FloatTexture,
    target: TileTarget,
    test_scenes: Vec<TestScene>,
}

impl Testbench {
    /// Creates a testbench with these test scenes.
    pub fn new(gl: &Gl, test_scenes: Vec<TestScene>) -> Result<Self, GlError> {
        let mesh = |shape: TestShape| {
            let mesh = shape.mesh();
            let stream = |name, components, numbers| Stream { name, components, numbers };
            StreamMesh::new(
                gl,
                &[
                    stream("position", 3, &mesh.positions),
                    stream("normal", 3, &mesh.normals),
                    stream("tex_coord", 2, &mesh.tex_coords),
                    stream("color", 3, &mesh.colors),
                ],
                &mesh.indices,
                &format!("{shape:?}"),
            )
        };
        Ok(Testbench {
            meshes: TestShape::ALL.into_iter().map(mesh).collect::<Result<_, _>>()?,
            cubemap: FloatTexture::cube(gl, SKY_SIDE, &sky_faces(), "surroundings")?,
            white: FloatTexture::flat(gl, [1, 1], &[[1.0; 4]], "white")?,
            target: TileTarget::new(gl, TILE, test_scenes.len())?,
            test_scenes,
        })
    }

    /// Returns the test scenes.
    pub fn test_scenes(&self) -> &[TestScene] {
        &self.test_scenes
    }

    /// Computes the attributes and uniforms of a program in each test scene, after `change` has changed it.
    pub fn inputs(&self, program: &UserProgram, bindings: &Bindings, change: impl Fn(&mut TestScene)) -> ProgramInputs {
        let feed = bindings
            .bound
            .iter()
            .filter(|bound| bound.declared.kind == VariableKind::Attribute)
            .filter_map(|bound| Some((program.attribute_location(&bound.declared.name)?, stream_of(bound.role)?)))
            .collect();
        let uniforms: Vec<(usize, &Bound)> = bindings
            .bound
            .iter()
            .filter(|bound| bound.declared.kind == VariableKind::Uniform)
            .filter_map(|bound| Some((program.uniform_index(&bound.declared.name)?, bound)))
            .collect();
        let samplers = samplers(program, bindings);
        let values = self
            .test_scenes
            .iter()
            .map(|test_scene| {
                let mut test_scene = test_scene.clone();
                change(&mut test_scene);
                let value = |&(index, bound): &(usize, &Bound)| {
                    let glsl_type = bound.declared.glsl_type.as_str();
                    let values = match unit(&bound.declared.name, glsl_type) {
                        Some(_) => None,
                        None => numbers_of(bindings, bound, &test_scene),
                    };
                    Some((index, values?))
                };
                samplers.iter().cloned().chain(uniforms.iter().filter_map(value)).collect()
            })
            .collect();
        ProgramInputs { feed, values }
    }

    /// Returns an error if OpenGL reported one since the last call. In a browser this costs as much as several draw
    /// calls.
    pub fn error(&self) -> Result<(), GlError> {
        self.target.error().map_or(Ok(()), Err)
    }

    /// Draws a program in the first `count` test scenes; `fixed` are uniforms with the same value in all. Errors of
    /// OpenGL are reported by [`Testbench::error`].
    pub fn draw(
        &self,
        program: &UserProgram,
        inputs: &ProgramInputs,
        fixed: &[(String, Vec<f32>)],
        count: usize,
    ) -> Result<Atlas, GlError> {
        self.target.begin();
        self.cubemap.bind(CUBEMAP_UNIT);
        self.white.bind(WHITE_UNIT);
        program.bind();
        for (name, values) in fixed {
            program.set(name, values);
        }
        for (tile, (test_scene, values)) in self.test_scenes.iter().zip(&inputs.values).take(count).enumerate() {
            for (index, values) in values {
                program.set_index(*index, values);
            }
            self.target.select(tile);
            self.meshes[test_scene.shape.index()].draw(program, &inputs.feed);
        }
        Ok(Atlas { pixels: self.target.read(count) })
    }
}

/// The values of a program's attributes and uniforms in every test scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramInputs {
    /// Locations of attributes, and the streams that feed them.
    feed: Vec<(u32, usize)>,
    /// For each test scene, the indices of uniforms and their values.
    values: Vec<Vec<(usize, Vec<f32>)>>,
}

/// Returns the stream of a mesh that an attribute reads.
pub fn stream_of(role: Role) -> Option<usize> {
    match role {
        Role::Position => Some(0),
        Role::Normal => Some(1),
        Role::TexCoord => Some(2),
        Role::Color => Some(3),
        _ => None,
    }
}
