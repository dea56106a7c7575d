//! A pair of shaders for the interpreter, and its run over the points of the test scenes.

use super::samples::SceneSamples;
use super::values::Values;
use crate::roles::{self, Bindings, Bound, Declared, How, NamesFile, Role, VariableKind, VectorReads};
use crate::testbench::{CUBEMAP_UNIT, TestScene, WHITE_UNIT, numbers_of, radiance, stream_of, uniform_bits, unit};
use glam::Vec3;
use gonio_glsl::{Checked, Item, Parsed, Scalar, Stage, TokenPlace, Type};
use gonio_interpreter::{
    CompiledStage, ExprId, InputRate, PointValues, RunOptions, StageInput, StageInputs, StageRun, Substitute,
    TextureLookup, TextureSource, Unsupported, interpolate, run,
};
use std::borrow::Cow;
use std::sync::Arc;

/// A pair of shaders that the interpreter can run.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    /// The vertex shader.
    pub vertex: CompiledStage,
    /// The fragment shader.
    pub fragment: CompiledStage,
    /// The roles of its inputs.
    pub bindings: Bindings,
    /// The roles of all that it declares, used or not.
    pub declared: Bindings,
    /// The uniform vectors whose components are read one by one, and whether they are also read as vectors.
    pub packed: Vec<(String, bool)>,
    /// The names of uniform blocks, and what the text calls them.
    instances: Vec<(String, String)>,
    /// The texts of both stages.
    texts: [String; 2],
}

/// Work for the points of one scene, in units of the interpreter: 20 ms.
const MOST_WORK: u64 = 200_000;

impl Program {
    /// Compiles a pair. Variables that a shader declares but never uses have no role.
    pub fn new(
        (of_vertex, in_vertex): (&Parsed, &Checked),
        (of_fragment, in_fragment): (&Parsed, &Checked),
        texts: [&str; 2],
        names: &NamesFile,
    ) -> Result<Self, (Stage, Unsupported)> {
        let compiled = |stage, parsed, checked| {
            gonio_interpreter::compile(parsed, checked).map_err(|unsupported| (stage, unsupported))
        };
        let vertex = compiled(Stage::Vertex, of_vertex, in_vertex)?;
        let fragment = compiled(Stage::Fragment, of_fragment, in_fragment)?;
        let used = |checked: &Checked, name: &str| {
            let base = name.split(['.', '[']).next().unwrap_or(name);
            let interface = &checked.interface;
            let mut all = interface.uniforms.iter().chain(&interface.inputs);
            // The members of blocks are not among these.
            all.find(|variable| variable.name == base).is_none_or(|variable| variable.is_used)
        };
        let (mut all, mut active): (Vec<Declared>, Vec<Declared>) = (Vec::new(), Vec::new());
        for (stage, checked) in [(&vertex, in_vertex), (&fragment, in_fragment)] {
            for input in &stage.inputs {
                let kind = match (input.rate, stage.stage) {
                    (InputRate::Uniform, _) => VariableKind::Uniform,
                    (InputRate::PerPoint, Stage::Vertex) => VariableKind::Attribute,
                    (InputRate::PerPoint, Stage::Fragment) => continue,
                };
                let (name, glsl_type) = (input.name.clone(), input.ty.written());
                let declared = Declared { name, glsl_type, array: input.count, kind };
                if !is_indexed(&input.name, texts) {
                    continue;
                }
                let is_active = used(checked, &input.name) && is_read(&input.name, texts);
                if is_active && !active.contains(&declared) {
                    active.push(declared.clone());
                }
                // The old pipeline's state is declared in every program.
                if !all.contains(&declared) && (is_active || !input.name.starts_with("gl_")) {
                    all.push(declared);
                }
            }
        }
        let (mut bindings, declared) = (roles::bind(&active, names), roles::bind(&all, names));
        let is_vector = |declared: &&Declared| {
            let is_single = declared.kind == VariableKind::Uniform && declared.array <= 1;
            is_single && matches!(declared.glsl_type.as_str(), "vec3" | "vec4")
        };
        let tokens = tokens_of([(of_vertex, texts[0]), (of_fragment, texts[1])]);
        let instances = [of_vertex, of_fragment].into_iter().flat_map(instances_of).collect::<Vec<_>>();
        let mut packed = Vec::new();
        for vector in active.iter().filter(is_vector) {
            let reads = VectorReads::new(&tokens, &in_text(&instances, &vector.name));
            if reads.is_packed {
                packed.push((vector.name.clone(), reads.is_vector));
            }
            // The names beside them tell more than the values where there is a mistake.
            let is_only_packed = reads.is_packed && !reads.is_vector;
            let by_name =
                bindings.bound.iter().find(|bound| bound.declared == *vector).map(|bound| (bound.role, bound.how));
            if is_only_packed && by_name.is_none_or(|(role, how)| how == How::Name && role.is_colour()) {
                bindings.unknown.retain(|unknown| unknown != vector);
                bindings.bound.retain(|bound| bound.declared != *vector);
                let declared = vector.clone();
                let has_strengths = bindings.bound.iter().any(|bound| bound.role.is_strength());
                let is_attenuation = has_strengths || reads.is_polynomial;
                let role = if is_attenuation { Role::Attenuation(0) } else { Role::Strengths(0) };
                let role = role.with_light(index_of(&vector.name));
                bindings.bound.push(Bound { declared, role, how: How::Type });
            }
            if reads.last_is_apart && vector.glsl_type == "vec4" && !vector.name.starts_with("gl_") {
                let declared = roles::last_of(vector);
                bindings.bound.push(Bound { declared, role: Role::Tint, how: How::Type });
            }
        }
        Ok(Program { vertex, fragment, bindings, declared, packed, instances, texts: texts.map(str::to_owned) })
    }

    /// One of the stages.
    #[must_use]
    pub fn stage(&self, stage: Stage) -> &CompiledStage {
        if stage == Stage::Vertex { &self.vertex } else { &self.fragment }
    }

    /// The expressions of a stage whose values are floats, vectors or matrices.
    #[must_use]
    pub fn numbers(&self, stage: Stage) -> Vec<ExprId> {
        let is_number = |ty: &Type| ty.scalar() == Some(Scalar::Float) && ty.components().is_some();
        let all = self.stage(stage).source.expressions.iter().enumerate();
        let numbers = all.filter(|(_, expr)| expr.ty.as_ref().is_some_and(is_number));
        numbers.map(|(index, _)| ExprId(index as u32)).collect()
    }

    /// The text of an expression.
    #[must_use]
    pub fn text(&self, stage: Stage, expr: ExprId) -> &str {
        let span = self.stage(stage).source.expression(expr).map(|expr| expr.span);
        let text = span.and_then(|span| self.texts[stage as usize].get(span.start as usize..span.end as usize));
        text.unwrap_or_default()
    }

    /// The name of an input in the text: that of a block's member begins with the block's instance.
    #[must_use]
    pub fn in_text<'n>(&self, name: &'n str) -> Cow<'n, str> {
        in_text(&self.instances, name)
    }

    /// Whether something is raised to a power, or an input is an exponent.
    pub fn has_exponent(&self) -> bool {
        let is_power =
            |stage: Stage| self.numbers(stage).into_iter().any(|expr| self.text(stage, expr).contains("pow"));
        self.bindings.bound.iter().any(|bound| bound.role == Role::Shininess)
            || is_power(Stage::Vertex)
            || is_power(Stage::Fragment)
    }

    /// Whether a text is the name of a uniform, or of an attribute.
    #[must_use]
    pub fn is_input(&self, stage: Stage, text: &str) -> bool {
        let is_given = |rate: InputRate| stage == Stage::Vertex || rate == InputRate::Uniform;
        let is_component = |name: &str| {
            let is_one = |rest: &str| rest.len() == 2 && rest.starts_with('.');
            text.strip_prefix(&*self.in_text(name)).is_some_and(is_one)
        };
        self.stage(stage).inputs.iter().any(|input| self.in_text(&input.name) == text && is_given(input.rate))
            || self.packed.iter().any(|(name, _)| is_component(name))
    }

    /// The text of a stage.
    #[must_use]
    pub fn source_text(&self, stage: Stage) -> &str {
        &self.texts[stage as usize]
    }

    /// Whether an expression is all that a variable is set to.
    #[must_use]
    pub fn is_whole_value(&self, stage: Stage, expr: ExprId) -> bool {
        let Some(span) = self.stage(stage).source.expression(expr).map(|expr| expr.span) else { return false };
        let text = &self.texts[stage as usize];
        let (before, after) = (text.get(..span.start as usize), text.get(span.end as usize..));
        let is_set = before
            .and_then(|text| text.trim_end().strip_suffix('='))
            .is_some_and(|rest| !rest.ends_with(['=', '<', '>', '!', '+', '-', '*', '/', '%', '&', '|', '^']));
        is_set && after.is_some_and(|text| text.trim_start().starts_with([';', ',']))
    }

    /// Whether an expression is compared with another one.
    #[must_use]
    pub fn is_compared(&self, stage: Stage, expr: ExprId) -> bool {
        const COMPARISONS: [&str; 6] = ["==", "!=", "<=", ">=", "<", ">"];
        let Some(span) = self.stage(stage).source.expression(expr).map(|expr| expr.span) else { return false };
        let text = &self.texts[stage as usize];
        let after = text.get(span.end as usize..).unwrap_or_default().trim_start();
        let before = text.get(..span.start as usize).unwrap_or_default().trim_end();
        COMPARISONS.iter().any(|comparison| after.starts_with(comparison) || before.ends_with(comparison))
    }

    /// The name of the variable that is set to an expression and to nothing else.
    #[must_use]
    pub fn variable_set_to(&self, stage: Stage, expr: ExprId) -> Option<&str> {
        let span = self.stage(stage).source.expression(expr).filter(|_| self.is_whole_value(stage, expr))?.span;
        let before = self.texts[stage as usize].get(..span.start as usize)?.trim_end().strip_suffix('=')?.trim_end();
        let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
        let start = before
            .rfind(|c: char| !is_of_name(c))
            .map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
        Some(&before[start..]).filter(|name| !name.is_empty())
    }

    /// The name that a value gets: that of the variable that is set to it, or of the function that returns it.
    #[must_use]
    pub fn named(&self, stage: Stage, expr: ExprId) -> Option<&str> {
        self.variable_set_to(stage, expr).or_else(|| {
            let function = self.stage(stage).source.expression(expr)?.function.as_deref();
            function.filter(|name| *name != "main" && self.is_set_or_returned(stage, expr))
        })
    }

    /// Whether an expression is all that a variable is set to or that a function returns, perhaps as each component of a
    /// vector: `vec3(1.0)`.
    #[must_use]
    pub fn is_set_in_vector_or_alone(&self, stage: Stage, expr: ExprId) -> bool {
        let source = &self.stage(stage).source;
        let Some(tokens) = source.expression(expr).map(|expr| expr.tokens) else { return false };
        // `vec3`, `(` and `)` around it.
        let is_vector = |other: &ExprId| {
            let around = source.expressions[other.0 as usize].tokens;
            around.first + 2 == tokens.first && around.last == tokens.last + 1
        };
        self.is_set_or_returned(stage, expr)
            || self
                .numbers(stage)
                .iter()
                .filter(|other| is_vector(other))
                .any(|other| self.text(stage, *other).starts_with("vec") && self.is_set_or_returned(stage, *other))
    }

    /// Whether an expression is all that a variable is set to, or that a function returns.
    #[must_use]
    pub fn is_set_or_returned(&self, stage: Stage, expr: ExprId) -> bool {
        let Some(span) = self.stage(stage).source.expression(expr).map(|expr| expr.span) else { return false };
        let text = &self.texts[stage as usize];
        let before = text.get(..span.start as usize).unwrap_or_default().trim_end();
        let after = text.get(span.end as usize..).unwrap_or_default().trim_start();
        self.is_whole_value(stage, expr) || before.ends_with("return") && after.starts_with(';')
    }

    /// Whether an expression is the call of a function of the program itself.
    #[must_use]
    pub fn is_call(&self, stage: Stage, expr: ExprId) -> bool {
        let text = self.text(stage, expr);
        let Some((name, _)) = text.split_once('(').filter(|_| text.ends_with(')')) else { return false };
        let name = name.trim();
        self.stage(stage).source.expressions.iter().any(|other| other.function.as_deref() == Some(name))
    }

    /// Whether a text is the name of an output.
    #[must_use]
    pub fn is_output(&self, stage: Stage, text: &str) -> bool {
        self.stage(stage).outputs.iter().any(|output| output.name == text)
    }

    /// The output of the fragment shader that is the colour.
    #[must_use]
    pub fn colour_output(&self) -> Option<usize> {
        let outputs = &self.fragment.outputs;
        let is_colour = |at: usize| outputs[at].ty.components().is_some_and(|count| count >= 3);
        let first = (0..outputs.len()).filter(|at| is_colour(*at) && outputs[*at].name != "gl_FragDepth");
        first.min_by_key(|at| outputs[*at].location.unwrap_or(0))
    }

    /// The role of an input.
    #[must_use]
    pub fn role(&self, name: &str) -> Option<Role> {
        self.bindings.bound.iter().find(|bound| bound.declared.name == name).map(|bound| bound.role)
    }

    fn uniform(&self, input: &StageInput, scene: &TestScene) -> Option<Vec<f32>> {
        if let Some(unit) = unit(&input.name, &input.ty.written()) {
            return Some(vec![unit as f32; input.count as usize]);
        }
        if let Some(fixed) = self.bindings.fixed.iter().find(|fixed| fixed.declared.name == input.name) {
            return Some(fixed.values.clone());
        }
        let bound = self.bindings.bound.iter().find(|bound| bound.declared.name == input.name)?;
        numbers_of(&self.bindings, bound, scene)
    }

    pub(super) fn set_uniforms(&self, stage: &CompiledStage, inputs: &mut StageInputs, scene: &TestScene) {
        for (index, input) in stage.inputs.iter().enumerate().filter(|(_, input)| input.rate == InputRate::Uniform) {
            if let Some(values) = self.uniform(input, scene) {
                inputs.set(index, PointValues::Same(uniform_bits(&input.ty, input.count, &values)));
            }
        }
    }

    pub(super) fn vertex_inputs(&self, samples: &SceneSamples) -> StageInputs {
        let mut inputs = StageInputs::new(&self.vertex, samples.vertices());
        self.set_uniforms(&self.vertex, &mut inputs, &samples.scene);
        let mesh = &samples.mesh;
        let streams = [(&mesh.positions, 3), (&mesh.normals, 3), (&mesh.tex_coords, 2), (&mesh.colors, 3)];
        for (index, input) in self.vertex.inputs.iter().enumerate().filter(|(_, i)| i.rate == InputRate::PerPoint) {
            let Some((numbers, size)) = self.role(&input.name).and_then(stream_of).and_then(|s| streams.get(s)) else {
                continue;
            };
            let component = |at: usize| numbers.iter().skip(at).step_by(*size).map(|x| x.to_bits()).collect();
            inputs.set(index, PointValues::Each { components: (0..*size).map(component).collect(), written: None });
        }
        inputs
    }
}

/// The first index in a name: the number of a light.
pub(super) fn index_of(name: &str) -> u32 {
    let index = name.split_once('[').and_then(|(_, rest)| rest.split_once(']'));
    index.and_then(|(index, _)| index.parse().ok()).unwrap_or(0)
}

/// The blocks that have an instance name.
fn instances_of(parsed: &Parsed) -> impl Iterator<Item = (String, String)> {
    parsed.unit.items.iter().filter_map(|item| match item {
        Item::Block(block) => Some((block.name.clone(), block.instance.as_ref()?.name.clone())),
        _ => None,
    })
}

fn in_text<'n>(instances: &[(String, String)], name: &'n str) -> Cow<'n, str> {
    let member = |(block, instance): &(String, String)| {
        Some(format!("{instance}{}", name.strip_prefix(block.as_str()).filter(|rest| rest.starts_with('.'))?))
    };
    instances.iter().find_map(member).map_or(Cow::Borrowed(name), Cow::Owned)
}

/// The tokens of both stages.
fn tokens_of<'t>(stages: [(&Parsed, &'t str); 2]) -> Vec<&'t str> {
    let of_stage = |(parsed, text): (&Parsed, &'t str)| {
        let token = |place: &TokenPlace| text.get(place.start as usize..place.end as usize).unwrap_or_default();
        parsed.tokens.iter().map(token).collect::<Vec<&str>>()
    };
    stages.into_iter().flat_map(of_stage).collect()
}

/// Whether a program may read this member of a struct: other members of the same struct do not count.
fn is_read(name: &str, texts: [&str; 2]) -> bool {
    let Some((container, member)) = name.rsplit_once('.') else { return true };
    let member = member.split('[').next().unwrap_or(member);
    let is_member = |after: &str| {
        let rest = after.trim_start().strip_prefix(member);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_'))
    };
    // Several structs of the old pipeline have members of the same names.
    if let Some(container) = container.split('[').next().filter(|container| container.starts_with("gl_")) {
        let of_container = |after: &str| {
            let after = after.trim_start();
            let after =
                after.strip_prefix('[').and_then(|after| after.split_once(']')).map_or(after, |(_, after)| after);
            after.trim_start().strip_prefix('.').is_none_or(is_member)
        };
        return texts.iter().flat_map(|text| text.split(container).skip(1)).any(of_container);
    }
    texts.iter().flat_map(|text| text.split('.').skip(1)).any(is_member)
}

/// Whether a program may read this element of an array of OpenGL's own, such as `gl_LightSource[3].position`. These
/// arrays have all elements in every program.
fn is_indexed(name: &str, texts: [&str; 2]) -> bool {
    let Some((array, rest)) = name.split_once('[').filter(|(array, _)| array.starts_with("gl_")) else { return true };
    let element = rest.split(']').next().unwrap_or_default();
    texts.iter().flat_map(|text| text.split(array).skip(1)).any(|after| {
        let Some(index) = after.trim_start().strip_prefix('[').and_then(|after| after.split(']').next()) else {
            return true;
        };
        let index = index.trim();
        index == element || index.parse::<u32>().is_err()
    })
}

/// The textures of the test scenes: the sky as a function of the direction, and white.
pub(super) struct SceneTextures;

/// Runs a stage with the textures of the test scenes, and records nothing.
pub(super) fn run_in_scene(stage: &CompiledStage, inputs: &StageInputs) -> StageRun {
    run(stage, inputs, &RunOptions { textures: &SceneTextures, ..RunOptions::default() })
}

impl TextureSource for SceneTextures {
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4] {
        let [x, y, z, _] = lookup.coordinates;
        match lookup.sampler {
            CUBEMAP_UNIT if lookup.dims == 3 => {
                let [r, g, b] = radiance(Vec3::new(x, y, z));
                [r, g, b, 1.0]
            }
            WHITE_UNIT if [x, y].iter().any(|x| !x.is_finite()) => [f32::NAN; 4],
            WHITE_UNIT => [1.0; 4],
            _ => [0.0, 0.0, 0.0, 1.0],
        }
    }

    fn size(&self, _sampler: u32, _level: i32) -> [u32; 3] {
        [32, 32, 1]
    }
}

/// Other values for expressions of one stage.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    /// The stage.
    pub stage: Stage,
    /// The expressions: one, or all reads of a variable.
    pub exprs: Vec<ExprId>,
    /// Only this evaluation of each; `None` for all.
    pub occurrence: Option<u32>,
    /// Their values at all points of the stage.
    pub values: Values,
}

/// The results of one scene.
#[derive(Clone, Debug)]
pub(crate) struct SceneResult {
    /// The vertex shader's run.
    pub vertex: Arc<StageRun>,
    /// The fragment shader's run.
    pub fragment: StageRun,
}

struct SceneStart {
    inputs: StageInputs,
    vertex: Arc<StageRun>,
    fragment_inputs: StageInputs,
}

/// Runs a program over the points of test scenes, again and again with changed values.
pub(crate) struct Runner<'a> {
    /// The program.
    pub program: &'a Program,
    /// The points.
    pub samples: &'a [SceneSamples],
    starts: Vec<SceneStart>,
}

fn options<'o>(watched: &'o [ExprId], substitutes: &'o [Substitute]) -> RunOptions<'o> {
    RunOptions { textures: &SceneTextures, watched, substitutes, most_work: MOST_WORK, ..RunOptions::default() }
}

impl<'a> Runner<'a> {
    /// Runs the vertex shader without changes in all scenes.
    #[must_use]
    pub fn new(program: &'a Program, samples: &'a [SceneSamples]) -> Self {
        let start = |samples: &SceneSamples| {
            let inputs = program.vertex_inputs(samples);
            let vertex = run(&program.vertex, &inputs, &options(&[], &[]));
            let fragment_inputs = fragment_inputs(program, samples, &vertex);
            SceneStart { inputs, vertex: Arc::new(vertex), fragment_inputs }
        };
        Runner { program, samples, starts: samples.iter().map(start).collect() }
    }

    /// The number of points of a stage in the scenes before this one.
    #[must_use]
    pub fn first_point(&self, stage: Stage, scene: usize) -> usize {
        self.samples[..scene].iter().map(|samples| points(samples, stage)).sum()
    }

    /// The number of points of a stage in all scenes.
    #[must_use]
    pub fn points(&self, stage: Stage) -> usize {
        self.first_point(stage, self.samples.len())
    }

    /// The run of the vertex shader without changes.
    #[must_use]
    pub fn start(&self, scene: usize) -> &StageRun {
        &self.starts[scene].vertex
    }

    /// Runs one scene with changes.
    #[must_use]
    pub fn run(&self, scene: usize, changes: &[Change], watched: [&[ExprId]; 2]) -> SceneResult {
        let (samples, start) = (&self.samples[scene], &self.starts[scene]);
        let substitutes = |stage: Stage| self.substitutes(scene, stage, changes);
        let [in_vertex, in_fragment] = [Stage::Vertex, Stage::Fragment].map(substitutes);
        let is_unchanged = in_vertex.is_empty() && watched[0].is_empty();
        let vertex = match is_unchanged {
            true => Arc::clone(&start.vertex),
            false => Arc::new(run(&self.program.vertex, &start.inputs, &options(watched[0], &in_vertex))),
        };
        let own;
        let inputs = if in_vertex.is_empty() {
            &start.fragment_inputs
        } else {
            own = fragment_inputs(self.program, samples, &vertex);
            &own
        };
        let fragment = run(&self.program.fragment, inputs, &options(watched[1], &in_fragment));
        SceneResult { vertex, fragment }
    }

    fn substitutes(&self, scene: usize, stage: Stage, changes: &[Change]) -> Vec<Substitute> {
        let first = self.first_point(stage, scene);
        let count = points(&self.samples[scene], stage);
        let mut made = Vec::new();
        for change in changes.iter().filter(|change| change.stage == stage) {
            let size = change.values.size;
            let component = |at: usize| (first..first + count).map(|p| change.values.at(p)[at].to_bits()).collect();
            let values =
                PointValues::Each { components: (0..size).map(component).collect::<Vec<Vec<u32>>>(), written: None };
            for expr in &change.exprs {
                made.push(Substitute { expr: *expr, occurrence: change.occurrence, values: values.clone() });
            }
        }
        made
    }
}

fn points(samples: &SceneSamples, stage: Stage) -> usize {
    if stage == Stage::Vertex { samples.vertices() } else { samples.places.len() }
}

fn fragment_inputs(program: &Program, samples: &SceneSamples, vertex: &StageRun) -> StageInputs {
    let mut inputs = interpolate(&program.vertex, &vertex.outputs, &program.fragment, &samples.places);
    program.set_uniforms(&program.fragment, &mut inputs, &samples.scene);
    inputs
}
