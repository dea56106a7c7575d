//! A pair of shaders for the interpreter, and its run over the vertices of a scene.

use super::coverage::{Coverage, Plane, SurfacePoint, Triangle, fragment_at, ndc, ndc_from_bottom, quad_of};
use super::textures::PreviewTextures;
use super::value::StructTypes;
use crate::preview::{Note, NoteKind, PreviewShape, SubmittedPair, held};
use gonio_check::compile::ParsedStage;
use gonio_check::roles::{self, Bindings, Declared, NamesFile, VariableKind};
use gonio_check::submission::StageText;
use gonio_check::testbench::{TestMesh, TestScene, stream_of, uniform_bits, unit};
use gonio_check::verdict::CompilerMessage;
use gonio_glsl::{OutputVersion, Parsed, Stage};
use gonio_interpreter::{
    CompiledStage, EndedEarly, Fragment, InputRate, PointValues, RunOptions, StageInput, StageInputs, StageRun,
    TextureSource, run,
};
use gonio_language::tr;
use std::collections::HashMap;
use std::sync::Arc;

/// A shader that the interpreter can run.
#[derive(Clone, Debug)]
pub struct SteppedStage {
    /// The student's text.
    pub text: StageText,
    /// Its syntax tree.
    pub parsed: Parsed,
    /// Its instructions.
    pub compiled: CompiledStage,
    pub(super) structs: StructTypes,
    /// The names in the program that OpenGL compiled, where they are others.
    renamed: HashMap<String, String>,
}

impl SteppedStage {
    fn new(text: &StageText, stage: Stage) -> Result<Self, Note> {
        let ParsedStage { parsed, checked, translated, .. } = ParsedStage::new(text, stage, OutputVersion::Core330);
        let compiled = gonio_interpreter::compile(&parsed, &checked).map_err(|unsupported| {
            let (file, line, column) = text.place(unsupported.span.line, unsupported.span.column);
            let message = CompilerMessage {
                file: file.to_owned(),
                line: Some(line),
                column: Some(column),
                text: tr!("check-step-gonio-cannot-run-on-the-cpu", construct = unsupported.construct),
                quoted: text.line(unsupported.span.line).map(str::to_owned),
                explanation: Some(tr!("check-step-rewrite-this-part-without-it-to").to_owned()),
            };
            Note { kind: NoteKind::Error, message }
        })?;
        let renamed = translated.renames.into_iter().map(|rename| (rename.from, rename.to)).collect();
        Ok(Self { text: text.clone(), structs: StructTypes::new(&checked), parsed, compiled, renamed })
    }

    /// The name of an input in the program that OpenGL compiled.
    pub(super) fn name_in_program(&self, name: &str) -> String {
        let (base, rest) = name.split_at(name.find(['.', '[']).unwrap_or(name.len()));
        match (self.renamed.get(base), base.strip_prefix("gl_")) {
            (Some(renamed), _) => format!("{renamed}{rest}"),
            // The translation declares the variables of old OpenGL.
            (None, Some(built_in)) => format!("gonio_{built_in}{rest}"),
            (None, None) => name.to_owned(),
        }
    }

    /// The values of uniforms by their numbers among the inputs: those for which `values` has one.
    pub(super) fn uniforms(&self, values: impl Fn(&StageInput) -> Option<Vec<f32>>) -> Uniforms {
        let uniforms = self.compiled.inputs.iter().enumerate().filter(|(_, input)| input.rate == InputRate::Uniform);
        let bits = |input: &StageInput| Some(uniform_bits(&input.ty, input.count, &values(input)?));
        uniforms.filter_map(|(index, input)| Some((index, PointValues::Same(bits(input)?)))).collect()
    }

    /// The uniforms as [`crate::preview::PreviewRenderer`] sets them.
    fn uniforms_of_exercise(&self, bindings: &Bindings, test_scene: &TestScene) -> Uniforms {
        self.uniforms(|input| self.uniform(input, bindings, test_scene))
    }

    fn uniform(&self, input: &StageInput, bindings: &Bindings, test_scene: &TestScene) -> Option<Vec<f32>> {
        if let Some(unit) = unit(&input.name, &input.ty.written()) {
            return Some(vec![unit as f32; input.count as usize]);
        }
        let name = self.name_in_program(&input.name);
        let bound = |kind: VariableKind, declared: &str| kind == VariableKind::Uniform && declared == name;
        let fixed = bindings.fixed.iter().find(|fixed| bound(fixed.declared.kind, &fixed.declared.name));
        if let Some(fixed) = fixed {
            return Some(fixed.values.clone());
        }
        held(
            bindings,
            bindings.bound.iter().find(|found| bound(found.declared.kind, &found.declared.name))?,
            test_scene,
        )
    }

    /// Sets the attributes of all vertices.
    fn set_attributes(&self, inputs: &mut StageInputs, bindings: &Bindings, mesh: &TestMesh) {
        let points = inputs.points();
        let streams = [(&mesh.positions, 3), (&mesh.normals, 3), (&mesh.tex_coords, 2), (&mesh.colors, 3)];
        for (index, input) in self.compiled.inputs.iter().enumerate().filter(|(_, i)| i.rate == InputRate::PerPoint) {
            let name = self.name_in_program(&input.name);
            let is_it = |kind: VariableKind, declared: &str| kind == VariableKind::Attribute && declared == name;
            let bound = bindings.bound.iter().find(|found| is_it(found.declared.kind, &found.declared.name));
            let Some((numbers, size)) = bound.and_then(|b| stream_of(b.role)).and_then(|s| streams.get(s)) else {
                continue;
            };
            let number = |vertex: usize, at: usize| numbers.get(vertex * size + at).map_or(0, |x| x.to_bits());
            let components = (0..*size).map(|at| (0..points).map(|vertex| number(vertex, at)).collect()).collect();
            inputs.set(index, PointValues::Each { components, written: None });
        }
    }
}

/// A pair of shaders that the interpreter can run.
#[derive(Clone, Debug)]
pub struct SteppedPair {
    /// The vertex shader.
    pub vertex: SteppedStage,
    /// The fragment shader.
    pub fragment: SteppedStage,
    pub(super) bindings: Bindings,
}

impl SteppedPair {
    /// Compiles a pair. `bindings` are those of the program that OpenGL has compiled.
    ///
    /// # Errors
    /// A construct that the interpreter does not support, such as `double` or recursion, with its place.
    pub fn new(submitted: &SubmittedPair, bindings: &Bindings) -> Result<Self, Note> {
        let submission = submitted.submission();
        let vertex = SteppedStage::new(&submission.vertex, Stage::Vertex)?;
        let fragment = SteppedStage::new(&submission.fragment, Stage::Fragment)?;
        let mut bindings = bindings.clone();
        add_inactive(&mut bindings, [&vertex, &fragment], submitted.names());
        Ok(Self { vertex, fragment, bindings })
    }

    /// Compiles a user's own pair, whose values have other sources than roles in an exercise.
    ///
    /// # Errors
    /// As for [`SteppedPair::new`].
    pub(super) fn of_texts(vertex: &StageText, fragment: &StageText) -> Result<Self, Note> {
        let vertex = SteppedStage::new(vertex, Stage::Vertex)?;
        let fragment = SteppedStage::new(fragment, Stage::Fragment)?;
        Ok(Self { vertex, fragment, bindings: Bindings::default() })
    }

    /// The role of an attribute or uniform of a stage, and the evidence for it, in words; `None` if it has none.
    #[must_use]
    pub fn role(&self, stage: Stage, name: &str) -> Option<(String, String)> {
        let name = self.stage(stage).name_in_program(name);
        let is_it = |declared: &Declared| {
            declared.name == name && (stage == Stage::Vertex || declared.kind == VariableKind::Uniform)
        };
        if let Some(bound) = self.bindings.bound.iter().find(|bound| is_it(&bound.declared)) {
            return Some((bound.role.to_string(), bound.how.to_string()));
        }
        let is_fixed = self.bindings.fixed.iter().any(|fixed| is_it(&fixed.declared));
        is_fixed.then(|| (tr!("check-preview-a-value").to_owned(), tr!("check-inputs-by-names-toml").to_owned()))
    }

    /// One of the stages.
    #[must_use]
    pub fn stage(&self, stage: Stage) -> &SteppedStage {
        if stage == Stage::Vertex { &self.vertex } else { &self.fragment }
    }

    /// Runs the vertex shader: every object, and all triangles in order.
    pub(super) fn run_vertices(
        &self,
        parts: Vec<DrawnPart>,
        textures: &dyn TextureSource,
        most_work: u64,
    ) -> (Vec<SteppedObject>, Vec<Triangle>) {
        let (mut stepped, mut triangles, mut first_vertex) = (Vec::new(), Vec::new(), 0);
        for (object, part) in parts.into_iter().enumerate() {
            let DrawnPart { vertices: mut inputs, indices, fragment_uniforms, is_mirrored, of_exercise } = part;
            set_numbers(&self.vertex, &mut inputs);
            let vertices =
                run(&self.vertex.compiled, &inputs, &RunOptions { textures, most_work, ..RunOptions::default() });
            let first_triangle = triangles.len();
            let position = vertices.output(&self.vertex.compiled, "gl_Position");
            let corner = |vertex: u32| {
                std::array::from_fn(|at| position.map_or(f32::NAN, |position| position.float(at, vertex as usize)))
            };
            triangles.extend(indices.chunks_exact(3).map(|corners| {
                let corners = [corners[0], corners[1], corners[2]];
                Triangle { object, corners, clip: corners.map(corner) }
            }));
            let count = inputs.points() as u32;
            stepped.push(SteppedObject {
                inputs,
                fragment_uniforms,
                is_mirrored,
                of_exercise,
                first_vertex,
                first_triangle,
                vertices,
            });
            first_vertex += count;
        }
        (stepped, triangles)
    }

    /// The inputs of the fragment shader at some points of an object. `origin`: that of [`StepOptions`].
    pub(super) fn inputs_of_points(
        &self,
        object: &SteppedObject,
        origin: [u32; 2],
        points: &[SurfacePoint<'_>],
    ) -> StageInputs {
        let (vertex, stage) = (&self.vertex.compiled, &self.fragment);
        let fragments: Vec<Fragment> = points.iter().map(|point| fragment_at(point.triangle, &point.place)).collect();
        let mut inputs = gonio_interpreter::interpolate(vertex, &object.vertices.outputs, &stage.compiled, &fragments);
        for (index, values) in &object.fragment_uniforms {
            inputs.set(*index, values.clone());
        }
        let [left, bottom] = origin.map(|pixels| pixels as f32);
        let coordinates: Vec<[f32; 4]> = points
            .iter()
            .map(|SurfacePoint { pixel: [x, row], place, .. }| {
                let (depth, over_w) = ((place.depth * 0.5 + 0.5) as f32, (1.0 / place.w) as f32);
                [*x as f32 + 0.5 - left, *row as f32 + 0.5 - bottom, depth, over_w]
            })
            .collect();
        let each = |at: usize| coordinates.iter().map(|c| c[at].to_bits()).collect();
        let is_front = |point: &SurfacePoint<'_>| u32::from(point.is_front != object.is_mirrored);
        let built_in = [
            ("gl_FragCoord", (0..4).map(each).collect()),
            ("gl_FrontFacing", vec![points.iter().map(is_front).collect()]),
        ];
        for (name, components) in built_in {
            inputs.set_named(&stage.compiled, name, PointValues::Each { components, written: None });
        }
        inputs
    }
}

/// Adds the variables that OpenGL's compiler has removed because no colour depends on them. The roles of the others stay as they
/// are.
fn add_inactive(bindings: &mut Bindings, stages: [&SteppedStage; 2], names: &NamesFile) {
    let bound = bindings.bound.iter().map(|bound| &bound.declared);
    let fixed = bindings.fixed.iter().map(|fixed| &fixed.declared);
    let mut all: Vec<Declared> = bound.chain(fixed).chain(&bindings.unknown).cloned().collect();
    let active = all.len();
    for stage in stages {
        for input in &stage.compiled.inputs {
            let kind = match (input.rate, stage.compiled.stage) {
                (InputRate::Uniform, _) => VariableKind::Uniform,
                (InputRate::PerPoint, Stage::Vertex) => VariableKind::Attribute,
                (InputRate::PerPoint, Stage::Fragment) => continue,
            };
            let name = stage.name_in_program(&input.name);
            if !all.iter().any(|known| known.name == name && known.kind == kind) {
                all.push(Declared { name, glsl_type: input.ty.written(), array: input.count, kind });
            }
        }
    }
    let inactive = all.split_off(active);
    let is_inactive = |declared: &Declared| inactive.contains(declared);
    let found = roles::bind(&[&all[..], &inactive[..]].concat(), names);
    bindings.bound.extend(found.bound.into_iter().filter(|bound| is_inactive(&bound.declared)));
    bindings.fixed.extend(found.fixed.into_iter().filter(|fixed| is_inactive(&fixed.declared)));
}

/// The part of an object that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSurface {
    /// The object's index in the scene.
    pub object: usize,
    /// The triangle's number within the object.
    pub triangle: usize,
    /// The numbers of its vertices, counted over all objects of the scene.
    pub vertices: [u32; 3],
    /// Barycentric coordinates in space; their sum is 1.
    pub shares: [f64; 3],
}

/// Bounds on the work, in the interpreter's units of about 0.1 microseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepWork {
    /// For all vertices of an object.
    pub vertices: u64,
    /// For one pixel or vertex.
    pub point: u64,
    /// For all pixels of a picture; 600,000 for exercise 07 at 512 x 512.
    pub picture: u64,
}

impl StepWork {
    /// For a caller that can wait: an endless loop takes a second for the vertices and two for a picture; at one pixel, there
    /// are some 100,000 passes of a short loop.
    pub const PATIENT: StepWork = StepWork { vertices: 10_000_000, point: 1_000_000, picture: 20_000_000 };
    /// For a thread that also draws the interface: a tenth of that.
    pub const BRIEF: StepWork = StepWork { vertices: 1_000_000, point: 200_000, picture: 1_000_000 };
}

/// The picture of a scene that is stepped through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepOptions {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// The pixel of this picture, column and row from the bottom left, at which `gl_FragCoord` is (0.5, 0.5): not 0 if the picture
    /// on the screen is a part of this one.
    pub origin: [u32; 2],
    /// Bounds on the work.
    pub work: StepWork,
}

impl StepOptions {
    /// A whole square of `size` pixels along each side.
    #[must_use]
    pub fn square(size: u32) -> Self {
        StepOptions { size: [size; 2], origin: [0; 2], work: StepWork::PATIENT }
    }
}

/// The values of uniforms, by their numbers among a stage's inputs.
pub(super) type Uniforms = Vec<(usize, PointValues)>;

/// What a draw call reads.
pub(super) struct DrawnPart {
    /// The inputs of the vertex shader at all vertices.
    pub vertices: StageInputs,
    /// The vertices of each triangle.
    pub indices: Vec<u32>,
    /// The uniforms of the fragment shader.
    pub fragment_uniforms: Uniforms,
    /// Whether front faces are clockwise.
    pub is_mirrored: bool,
    /// The scene and the mesh of an exercise.
    pub of_exercise: Option<(TestScene, TestMesh)>,
}

pub(super) struct SteppedObject {
    /// The inputs of the vertex shader at all vertices.
    pub inputs: StageInputs,
    fragment_uniforms: Uniforms,
    is_mirrored: bool,
    /// The scene and the mesh of an exercise.
    pub of_exercise: Option<(TestScene, TestMesh)>,
    /// The number of its first vertex in the scene.
    pub first_vertex: u32,
    first_triangle: usize,
    pub vertices: StageRun,
}

/// A pair of shaders in a scene: all vertices are computed, and the triangle at each pixel is known.
pub struct SteppedScene {
    pub(super) pair: Arc<SteppedPair>,
    pub(super) options: StepOptions,
    pub(super) objects: Vec<SteppedObject>,
    pub(super) coverage: Coverage,
    pub(super) textures: Box<dyn TextureSource + Send>,
}

impl SteppedScene {
    /// Runs the vertex shader over the objects of an exercise's scene.
    #[must_use]
    pub fn new(pair: Arc<SteppedPair>, objects: &[(PreviewShape, TestScene)], options: StepOptions) -> Self {
        let part = |(shape, test_scene): &(PreviewShape, TestScene)| {
            let mesh = shape.mesh();
            let mut vertices = StageInputs::new(&pair.vertex.compiled, mesh.positions.len() / 3);
            for (index, values) in pair.vertex.uniforms_of_exercise(&pair.bindings, test_scene) {
                vertices.set(index, values);
            }
            pair.vertex.set_attributes(&mut vertices, &pair.bindings, &mesh);
            DrawnPart {
                vertices,
                indices: mesh.indices.clone(),
                fragment_uniforms: pair.fragment.uniforms_of_exercise(&pair.bindings, test_scene),
                is_mirrored: false,
                of_exercise: Some((test_scene.clone(), mesh)),
            }
        };
        let parts: Vec<DrawnPart> = objects.iter().map(part).collect();
        Self::of_parts(pair, parts, Box::new(PreviewTextures::new()), options)
    }

    /// Runs the vertex shader over the parts of a scene.
    pub(super) fn of_parts(
        pair: Arc<SteppedPair>,
        parts: Vec<DrawnPart>,
        textures: Box<dyn TextureSource + Send>,
        options: StepOptions,
    ) -> Self {
        let (objects, triangles) = pair.run_vertices(parts, &*textures, options.work.vertices);
        Self { pair, options, objects, coverage: Coverage::new(options.size, triangles), textures }
    }

    /// Width and height of the picture in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.coverage.size
    }

    /// The number of vertices of all objects.
    #[must_use]
    pub fn vertex_count(&self) -> u32 {
        self.objects.last().map_or(0, |last| last.first_vertex + last.vertices.points as u32)
    }

    /// The vertex at which the vertex shader did not end, counted over all objects.
    #[must_use]
    pub fn endless_vertex(&self) -> Option<u32> {
        let ended = |object: &SteppedObject| -> Option<u32> {
            let EndedEarly { point, .. } = object.vertices.ended?;
            Some(object.first_vertex + point as u32)
        };
        self.objects.iter().find_map(ended)
    }

    /// The surface at a pixel, column and row from the top left; `None` if nothing is drawn there.
    #[must_use]
    pub fn surface(&self, pixel: [u32; 2]) -> Option<PixelSurface> {
        let (number, triangle) = (self.coverage.number(pixel)?, self.coverage.at(pixel)?);
        let object = self.objects.get(triangle.object)?;
        let place = Plane::new(&triangle.clip)?.at(ndc(pixel, self.coverage.size));
        Some(PixelSurface {
            object: triangle.object,
            triangle: number - object.first_triangle,
            vertices: triangle.corners.map(|corner| corner + object.first_vertex),
            shares: place.shares,
        })
    }

    /// The drawn pixel that is nearest to a place; `None` if nothing is drawn.
    #[must_use]
    pub fn nearest_drawn(&self, [x, y]: [u32; 2]) -> Option<[u32; 2]> {
        let distance = |p: &[u32; 2]| u64::from(p[0].abs_diff(x)).pow(2) + u64::from(p[1].abs_diff(y)).pow(2);
        self.coverage.covered().min_by_key(distance)
    }

    /// The object of a vertex, and the vertex' number in its mesh.
    pub(super) fn vertex(&self, vertex: u32) -> Option<(&SteppedObject, u32)> {
        let object = self.objects.iter().rev().find(|object| object.first_vertex <= vertex)?;
        let within = vertex - object.first_vertex;
        ((within as usize) < object.vertices.points).then_some((object, within))
    }

    /// The inputs of some of an object's vertices.
    pub(super) fn inputs_of_vertices(&self, object: &SteppedObject, vertices: &[u32]) -> StageInputs {
        let stage = &self.pair.vertex.compiled;
        let mut inputs = StageInputs::new(stage, vertices.len());
        for index in 0..stage.inputs.len() {
            match object.inputs.values(index) {
                Some(PointValues::Each { components, .. }) => {
                    let of = |all: &Vec<u32>| {
                        vertices.iter().map(|vertex| all.get(*vertex as usize).copied().unwrap_or(0)).collect()
                    };
                    let components = components.iter().map(of).collect();
                    inputs.set(index, PointValues::Each { components, written: None });
                }
                Some(same) => {
                    inputs.set(index, same.clone());
                }
                None => {}
            }
        }
        inputs
    }

    /// The inputs of the fragment shader for pixels of one object. With quads, each pixel becomes four points, of which
    /// [`super::coverage::lane_in_quad`] is its own.
    pub(super) fn fragment_inputs(&self, object: usize, pixels: &[[u32; 2]], quads: bool) -> StageInputs {
        let size = self.coverage.size;
        let mut points = Vec::with_capacity(pixels.len() * if quads { 4 } else { 1 });
        for [x, y] in pixels {
            let Some(triangle) = self.coverage.at([*x, *y]) else { continue };
            let Some(plane) = Plane::new(&triangle.clip) else { continue };
            let own = [*x, size[1] - 1 - y];
            let point = |pixel: [u32; 2]| SurfacePoint {
                triangle,
                is_front: plane.is_front,
                pixel,
                place: plane.at(ndc_from_bottom(pixel, size)),
            };
            match quads {
                false => points.push(point(own)),
                true => points.extend(quad_of(own).map(point)),
            }
        }
        match self.objects.get(object) {
            Some(object) => self.pair.inputs_of_points(object, self.options.origin, &points),
            None => StageInputs::new(&self.pair.fragment.compiled, 0),
        }
    }
}

/// Sets the numbers of vertices, unless they are set, and of instances.
fn set_numbers(stage: &SteppedStage, inputs: &mut StageInputs) {
    let is_set = |input: usize| inputs.values(input).is_some();
    if !stage.compiled.input("gl_VertexID").is_some_and(is_set) {
        let numbers = (0..inputs.points() as u32).collect();
        let each = PointValues::Each { components: vec![numbers], written: None };
        inputs.set_named(&stage.compiled, "gl_VertexID", each);
    }
    inputs.set_named(&stage.compiled, "gl_InstanceID", PointValues::ints(&[0]));
}
