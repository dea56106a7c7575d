//! Draws programs in all test scenes at once, and determines which triangle each pixel shows.

use super::{CUBEMAP_UNIT, SKY_SIDE, TestScene, TestShape, WHITE_UNIT, numbers_of_array, samplers, sky_faces, unit};
use crate::interpreter::{Fragments, Points, Value};
use crate::roles::{Bindings, Bound, Role, VariableKind};
use gonio_gl::{Gl, GlError};
use gonio_render::user_program::{FloatTexture, NOT_DRAWN, Stream, StreamMesh, TileTarget, UserProgram};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

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
    pub(super) gl: Gl,
    meshes: Vec<StreamMesh>,
    pub(super) numbered: Numbered,
    cubemap: FloatTexture,
    white: FloatTexture,
    pub(super) target: TileTarget,
    test_scenes: Vec<TestScene>,
    /// The covered pixels by the expression assigned to `gl_Position`.
    pub(super) surfaces: RefCell<HashMap<String, Rc<CoverageMap>>>,
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
            gl: gl.clone(),
            numbered: Numbered::new(gl)?,
            meshes: TestShape::ALL.into_iter().map(mesh).collect::<Result<_, _>>()?,
            cubemap: FloatTexture::cube(gl, SKY_SIDE, &sky_faces(), "surroundings")?,
            white: FloatTexture::flat(gl, [1, 1], &[[1.0; 4]], "white")?,
            target: TileTarget::new(gl, TILE, test_scenes.len())?,
            test_scenes,
            surfaces: RefCell::default(),
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
                    let values = match unit(glsl_type) {
                        Some(_) => None,
                        None => numbers_of_array(bound.role, glsl_type, bound.declared.array, &test_scene),
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

/// The pixels that an expression for `gl_Position` covers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoverageMap {
    /// For each test scene, the vertices and weights of each pixel.
    pub drawn: Fragments,
    /// The index of each pixel in the atlas.
    pub places: Vec<u32>,
}

impl CoverageMap {
    /// Returns the pixels of the first test scenes that satisfy the condition.
    pub fn filtered(&self, test_scenes: usize, keep: impl Fn(u32) -> bool) -> CoverageMap {
        let mut kept = CoverageMap::default();
        for span in self.drawn.spans.iter().take(test_scenes) {
            let start = kept.places.len();
            for index in span.clone().filter(|&index| keep(self.places[index])) {
                kept.places.push(self.places[index]);
                kept.drawn.corners.push(self.drawn.corners[index]);
                kept.drawn.shares.push(self.drawn.shares[index]);
            }
            kept.drawn.spans.push(start..kept.places.len());
        }
        kept
    }
}

/// The meshes with a number for each triangle.
pub(super) struct Numbered {
    meshes: Vec<StreamMesh>,
    indices: Vec<Vec<u32>>,
}

impl Numbered {
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let mut numbered = Numbered { meshes: Vec::new(), indices: Vec::new() };
        for shape in super::TestShape::ALL {
            let mesh = shape.mesh();
            let (mut positions, mut corners, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
            for (index, &vertex) in mesh.indices.iter().enumerate() {
                let at = vertex as usize * 3;
                positions.extend_from_slice(mesh.positions.get(at..at + 3).unwrap_or(&[0.0; 3]));
                corners.extend([0, 1, 2].map(|corner| if index % 3 == corner { 1.0 } else { 0.0 }));
                triangles.push((index / 3) as f32);
            }
            let streams = [
                Stream { name: "position", components: 3, numbers: &positions },
                Stream { name: "corner", components: 3, numbers: &corners },
                Stream { name: "triangle", components: 1, numbers: &triangles },
            ];
            let each: Vec<u32> = (0..mesh.indices.len() as u32).collect();
            numbered.meshes.push(StreamMesh::new(gl, &streams, &each, "numbered triangles")?);
            numbered.indices.push(mesh.indices);
        }
        Ok(numbered)
    }
}

/// Returns a program that outputs the weights of the vertices and the number of the triangle; `place` is the
/// expression that a model assigns to `gl_Position`.
fn sources(place: &str) -> [String; 2] {
    let vertex = format!(
        "#version 330 core\nin vec3 position;\nin vec3 corner;\nin float triangle;\n\
         uniform mat4 M;\nuniform mat4 V;\nuniform mat4 P;\nout vec3 share;\nflat out float which;\n\
         void main() {{\n    vec4 world_place = M * vec4(position, 1.0);\n    share = corner;\n    which = triangle;\n    \
         gl_Position = {place};\n}}\n"
    );
    let fragment = "#version 330 core\nin vec3 share;\nflat in float which;\nout vec4 seen;\n\
                    void main() {\n    seen = vec4(share, which);\n}\n";
    [vertex, fragment.to_owned()]
}

impl Testbench {
    /// Returns the pixels that are covered if a model assigns `place` to `gl_Position`, in all test scenes. The
    /// driver determines them once.
    pub fn surface(&self, place: &str) -> Result<Rc<CoverageMap>, GlError> {
        if let Some(known) = self.surfaces.borrow().get(place) {
            return Ok(Rc::clone(known));
        }
        let surface = Rc::new(self.ask(place)?);
        self.surfaces.borrow_mut().insert(place.to_owned(), Rc::clone(&surface));
        Ok(surface)
    }

    fn ask(&self, place: &str) -> Result<CoverageMap, GlError> {
        let [vertex, fragment] = sources(place).map(|source| super::for_context(&self.gl, &source));
        let program = UserProgram::new(&self.gl, &vertex, &fragment)
            .map_err(|broken| GlError::new(format!("gonio's own shader does not compile on this driver: {broken}")))?;
        let feed: Vec<(u32, usize)> = ["position", "corner", "triangle"]
            .into_iter()
            .enumerate()
            .filter_map(|(stream, name)| Some((program.attribute_location(name)?, stream)))
            .collect();
        self.target.begin();
        program.bind();
        for (tile, test_scene) in self.test_scenes().iter().enumerate() {
            program.set("M", &test_scene.world_from_model.to_cols_array());
            program.set("V", &test_scene.view_from_world().to_cols_array());
            program.set("P", &test_scene.clip_from_view().to_cols_array());
            self.target.select(tile);
            self.numbered.meshes[test_scene.shape.index()].draw(&program, &feed);
        }
        if let Some(error) = self.target.error() {
            return Err(error);
        }
        let pixels = self.target.read(self.test_scenes().len());
        Ok(self.read(&Atlas { pixels }))
    }

    fn read(&self, seen: &Atlas) -> CoverageMap {
        let mut surface = CoverageMap::default();
        let mut first_vertex = 0;
        for (tile, test_scene) in self.test_scenes().iter().enumerate() {
            let indices = &self.numbered.indices[test_scene.shape.index()];
            let start = surface.places.len();
            for (index, pixel) in seen.tile(tile).iter().enumerate().filter(|(_, p)| p[3] >= 0.0) {
                let triangle = pixel[3].round() as usize * 3;
                let Some(&[a, b, c]) = indices.get(triangle..triangle + 3) else { continue };
                surface.places.push((tile * (TILE * TILE) as usize + index) as u32);
                surface.drawn.corners.push([a, b, c].map(|corner| corner + first_vertex));
                surface.drawn.shares.push([pixel[0], pixel[1], pixel[2]]);
            }
            surface.drawn.spans.push(start..surface.places.len());
            first_vertex += vertices(test_scene) as u32;
        }
        surface
    }

    /// Returns the vertices of the meshes of the first test scenes.
    pub fn points(&self, test_scenes: usize) -> Points {
        let mut spans = Vec::new();
        let mut planes = [vec![Vec::new(); 3], vec![Vec::new(); 3]];
        let mut count = 0;
        for test_scene in self.test_scenes().iter().take(test_scenes) {
            let mesh = test_scene.shape.mesh();
            let start = count;
            count += vertices(test_scene);
            spans.push(start..count);
            for (planes, numbers) in planes.iter_mut().zip([&mesh.positions, &mesh.normals]) {
                for vertex in numbers.chunks_exact(3) {
                    for (plane, number) in planes.iter_mut().zip(vertex) {
                        plane.push(*number);
                    }
                }
            }
        }
        Points { spans, attributes: planes.map(|planes| Rc::new(Value::Each(planes))) }
    }
}

fn vertices(test_scene: &TestScene) -> usize {
    test_scene.shape.mesh().positions.len() / 3
}
