//! A user's own pair of shaders on the CPU, and its draw calls in a scene.

use super::pair::{DrawnPart, StepOptions, StepWork, SteppedPair, SteppedScene, SteppedStage, Uniforms};
use super::user_textures::{NONE, TextureNumbers, UserTextures};
use gonio_check::user_shaders::{UserInputs, UserShaders};
use gonio_check::verdict::CompilerMessage;
use gonio_glsl::Stage;
use gonio_interpreter::{InputRate, PointValues, StageInputs};
use gonio_mesh::Mesh;
use gonio_mesh::normals::with_face_normals;
use gonio_render::{SampledTexture, VertexData, wants_unshared};
use gonio_scene::{Frame, Object, Scene, SceneMaterial};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// A user's own shaders, compiled for the CPU, with the values of their inputs.
#[derive(Clone)]
pub struct UserPair {
    pub(super) pair: Arc<SteppedPair>,
    /// The attributes, uniforms and samplers, and where each gets its value.
    pub inputs: UserInputs,
}

/// Consecutive triangles of an object with one material.
pub(super) struct UserPart {
    pub drawn: DrawnPart,
    /// Whether it is drawn after the others, and blended.
    pub is_transparent: bool,
    /// The centroid of each triangle, world space; empty for an opaque part.
    pub centres: Vec<glam::Vec3>,
}

/// The work of the vertex shader that is allowed for each vertex, besides that of [`StepWork`].
const WORK_OF_A_VERTEX: u64 = 100;

impl UserPair {
    /// Compiles them without a driver.
    ///
    /// # Errors
    /// Errors by file and line; never an empty list. Constructs that the CPU cannot run are among them.
    pub fn new(shaders: &UserShaders) -> Result<Self, Vec<CompilerMessage>> {
        let (texts, inputs) = shaders.interpreted()?;
        let pair = SteppedPair::of_texts(&texts.vertex, &texts.fragment).map_err(|note| vec![note.message])?;
        Ok(UserPair { pair: Arc::new(pair), inputs })
    }

    /// One of the stages; gonio's own if the user left it out.
    #[must_use]
    pub fn stage(&self, stage: Stage) -> &SteppedStage {
        self.pair.stage(stage)
    }

    /// Runs the vertex shader over a scene, for pictures of a frame's size.
    #[must_use]
    pub fn in_scene(&self, scene: &Scene, frame: &Frame, work: StepWork) -> SteppedScene {
        let (parts, textures) = self.parts(scene, frame);
        let parts: Vec<DrawnPart> = parts.into_iter().map(|part| part.drawn).collect();
        let most = parts.iter().map(|part| part.vertices.points()).max().unwrap_or(0) as u64;
        let work = StepWork { vertices: work.vertices.max(most * WORK_OF_A_VERTEX), ..work };
        let options = StepOptions { size: [frame.width, frame.height], origin: [0; 2], work };
        SteppedScene::of_parts(self.pair.clone(), parts, Box::new(textures), options)
    }

    /// The draw calls of a frame, and the textures that they read.
    pub(super) fn parts(&self, scene: &Scene, frame: &Frame) -> (Vec<UserPart>, UserTextures) {
        let mut textures = TextureNumbers::new(scene, self.inputs.files());
        let mut parts = Vec::new();
        for object in &scene.objects {
            let Some(mesh) = scene.meshes.get(object.mesh) else { continue };
            let flat = wants_unshared(object.shading).then(|| with_face_normals(mesh));
            let mesh: &Mesh = flat.as_ref().unwrap_or(mesh);
            for part in &object.parts {
                let Some(material) = scene.materials.get(part.material) else { continue };
                let first = part.first_triangle * 3;
                let corners = mesh.indices.get(first..first + part.triangle_count * 3).unwrap_or_default();
                let (vertices, indices) = compacted(corners);
                let [of_vertex, of_fragment] = self.uniforms(frame, object, material, &mut textures);
                let mut inputs = StageInputs::new(&self.pair.vertex.compiled, vertices.len());
                for (index, values) in of_vertex {
                    inputs.set(index, values);
                }
                self.set_attributes(&mut inputs, mesh, &vertices);
                let is_transparent = material.is_transparent();
                let centre = |corners: &[u32]| {
                    let place = |corner: &u32| {
                        let position = mesh.positions.get(*corner as usize).copied().unwrap_or_default();
                        object.world_from_model.transform_point3(glam::Vec3::from(position).as_dvec3())
                    };
                    (corners.iter().map(place).sum::<glam::DVec3>() / 3.0).as_vec3()
                };
                let centres = if is_transparent { corners.chunks_exact(3).map(centre).collect() } else { Vec::new() };
                let drawn = DrawnPart {
                    vertices: inputs,
                    indices,
                    fragment_uniforms: of_fragment,
                    is_mirrored: object.world_from_model.determinant() < 0.0,
                    of_exercise: None,
                };
                parts.push(UserPart { drawn, is_transparent, centres });
            }
        }
        let reads_environment = self.inputs.samplers().iter().any(|(_, read)| *read == SampledTexture::Environment);
        (parts, textures.finish(frame, reads_environment))
    }

    /// The uniforms of both stages for one draw call.
    fn uniforms(
        &self,
        frame: &Frame,
        object: &Object,
        material: &SceneMaterial,
        textures: &mut TextureNumbers<'_>,
    ) -> [Uniforms; 2] {
        let values = self.inputs.values(frame, object.world_from_model, material);
        let values: HashMap<&str, Vec<f32>> = values.map(|(uniform, values)| (uniform.name.as_str(), values)).collect();
        let samplers = self.inputs.samplers().iter();
        let units: HashMap<&str, u32> =
            samplers.map(|(name, read)| (name.as_str(), textures.number(*read, material))).collect();
        [Stage::Vertex, Stage::Fragment].map(|of| {
            let stage = self.stage(of);
            let mut uniforms = stage.uniforms(|input| values.get(stage.name_in_program(&input.name).as_str()).cloned());
            for (index, input) in stage.compiled.inputs.iter().enumerate() {
                let ty = input.ty.written();
                if !ty.contains("sampler") {
                    continue;
                }
                let is_known = matches!(ty.as_str(), "sampler2D" | "samplerCube");
                let unit = units.get(stage.name_in_program(&input.name).as_str()).filter(|_| is_known);
                let unit = unit.copied().unwrap_or(NONE);
                uniforms.push((index, PointValues::Same(vec![unit; input.count.max(1) as usize])));
            }
            uniforms
        })
    }

    /// Sets the attributes of some vertices of a mesh. Those that nothing feeds read (0, 0, 0, 1).
    fn set_attributes(&self, inputs: &mut StageInputs, mesh: &Mesh, vertices: &[u32]) {
        let stage = &self.pair.vertex;
        let numbers = PointValues::Each { components: vec![vertices.to_vec()], written: None };
        inputs.set_named(&stage.compiled, "gl_VertexID", numbers);
        for (index, input) in stage.compiled.inputs.iter().enumerate() {
            if input.rate != InputRate::PerPoint || matches!(&*input.name, "gl_VertexID" | "gl_InstanceID") {
                continue;
            }
            let name = stage.name_in_program(&input.name);
            let data = self.inputs.attributes().iter().find(|(known, _)| *known == name).map(|(_, data)| *data);
            let missing = data.map_or([0.0, 0.0, 0.0, 1.0], |data| data.layout().2);
            let values = match data.and_then(|data| columns(mesh, data, vertices)) {
                Some(components) => PointValues::Each { components, written: None },
                None => PointValues::floats(&missing),
            };
            inputs.set(index, values);
        }
    }
}

/// The numbers of some vertices, component by component; `None` if the mesh has none.
fn columns(mesh: &Mesh, data: VertexData, vertices: &[u32]) -> Option<Vec<Vec<u32>>> {
    fn split<const N: usize>(all: &[[f32; N]], vertices: &[u32]) -> Option<Vec<Vec<u32>>> {
        let number = |vertex: u32, at: usize| all.get(vertex as usize).map_or(0, |numbers| numbers[at].to_bits());
        let column = |at: usize| vertices.iter().map(|vertex| number(*vertex, at)).collect();
        (!all.is_empty()).then(|| (0..N).map(column).collect())
    }
    match data {
        VertexData::Position => split(&mesh.positions, vertices),
        VertexData::Normal => split(&mesh.normals, vertices),
        VertexData::TexCoord => split(&mesh.tex_coords, vertices),
        VertexData::Color => split(&mesh.colors, vertices),
        VertexData::Tangent => split(&mesh.tangents, vertices),
    }
}

/// The vertices that triangles use, in ascending order, and the triangles' corners among them.
fn compacted(corners: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut places: BTreeMap<u32, u32> = corners.iter().map(|vertex| (*vertex, 0)).collect();
    for (at, place) in places.values_mut().enumerate() {
        *place = at as u32;
    }
    let indices = corners.iter().filter_map(|corner| places.get(corner).copied()).collect();
    (places.into_keys().collect(), indices)
}
