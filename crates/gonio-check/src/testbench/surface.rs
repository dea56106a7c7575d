//! Which triangle each pixel of a test scene shows, and where on it: the driver's own answer, asked once.

use super::atlas::{TILE, Testbench};
use super::{Atlas, TestScene};
use crate::interpreter::{Drawn, Points, Value};
use gonio_gl::{Gl, GlError};
use gonio_render::user_program::{Stream, StreamMesh, UserProgram};
use std::rc::Rc;

/// The pixels that a way of placing vertices draws.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Situation by test scene: which vertices each pixel lies between.
    pub drawn: Drawn,
    /// The number in the atlas of each of these pixels.
    pub places: Vec<u32>,
}

impl Surface {
    /// Those of its pixels that are kept, of the first test scenes.
    pub fn filtered(&self, test_scenes: usize, keep: impl Fn(u32) -> bool) -> Surface {
        let mut kept = Surface::default();
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

/// The meshes again, with a number for every triangle.
pub(super) struct Numbered {
    meshes: Vec<StreamMesh>,
    indices: Vec<Vec<u32>>,
}

impl Numbered {
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let mut numbered = Numbered { meshes: Vec::new(), indices: Vec::new() };
        for shape in super::Shape::ALL {
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

/// A program that puts out the corners' shares and the triangle's number; `place` is what a model writes to `gl_Position`.
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
    /// Which pixels are drawn where a model writes `place` to `gl_Position`, in all test scenes. Asked once of the driver.
    pub fn surface(&self, place: &str) -> Result<Rc<Surface>, GlError> {
        if let Some(known) = self.surfaces.borrow().get(place) {
            return Ok(Rc::clone(known));
        }
        let surface = Rc::new(self.ask(place)?);
        self.surfaces.borrow_mut().insert(place.to_owned(), Rc::clone(&surface));
        Ok(surface)
    }

    fn ask(&self, place: &str) -> Result<Surface, GlError> {
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

    fn read(&self, seen: &Atlas) -> Surface {
        let mut surface = Surface::default();
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

    /// The vertices of the first test scenes' meshes, one after the other.
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
