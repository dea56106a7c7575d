//! The quantities of the light equation at all points: those of a model solution, and those that the mistakes of the
//! catalogue compute instead.

pub use super::answer::{AnswerMethod, Space};
use super::answer::{DIRECTIONS, POSITIONS, has_space, hypothesis_of, peculiarities};
use super::program::{Change, Program, Runner};
pub(super) use super::recording::{Recorded, STAGES, TELLING, observe};
use super::samples::{SceneSamples, interpolated};
use super::solutions::ModelSolutions;
use super::values::Values;
use super::ward;
use crate::mistakes::{Assignment, Hypotheses, Mistake, ModelSolution};
use crate::roles::{Meaning, Role};
use crate::testbench::numbers;
use glam::{Mat3, Vec3};
use gonio_glsl::{Stage, TokenRange};
use gonio_interpreter::{ExprId, SourceMap};
use std::collections::BTreeMap;

/// A quantity at all points of a stage.
#[derive(Clone, Debug)]
pub(crate) struct Quantity {
    /// The variable of the model solution, or the name of an input.
    pub name: String,
    /// The stage whose points have the values.
    pub stage: Stage,
    /// Its space.
    pub space: Space,
    /// The mistake that computes this instead of the variable; `None` for the right values.
    pub mistake: Option<&'static Mistake>,
    /// Whether the mistake assigns to this variable, and not to one that it is computed from.
    pub is_direct: bool,
    /// Whether it was computed at the vertices and interpolated.
    pub interpolated: bool,
    /// The values.
    pub values: Values,
}

impl Default for Quantity {
    fn default() -> Self {
        Quantity {
            name: String::new(),
            stage: Stage::Vertex,
            space: Space::World,
            mistake: None,
            is_direct: false,
            interpolated: false,
            values: Values::absent(1, 0),
        }
    }
}

/// The quantities of one method.
pub(crate) struct Model {
    /// The method.
    pub method: AnswerMethod,
    /// The space in which it computes the light.
    pub space: Space,
    /// All of them.
    pub quantities: Vec<Quantity>,
}

/// A value that the model solution or a mistake assigns.
struct Assigned {
    variable: String,
    /// The change of a mistake, by its index.
    change: Option<usize>,
    expr: ExprId,
}

/// The mistakes whose values a model has.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Mistakes<'a> {
    /// Those with these ids.
    These(&'a [&'a str]),
    /// All of the catalogue, but only the variables that they assign to.
    OwnValues,
}

/// A way to make a mistake: the variables and the values assigned instead.
pub(super) type Way = (&'static Mistake, Vec<(String, String)>);

impl AnswerMethod {
    /// The model's shaders as this method writes them, and ways to make mistakes.
    pub(super) fn sources(self, all: &Hypotheses, wanted: Mistakes<'_>) -> ([String; 2], Vec<Way>) {
        let chosen = hypothesis_of(all, &peculiarities(self, self.highlight)).unwrap_or_default();
        let is_wanted = |mistake: &&&'static Mistake| match wanted {
            Mistakes::OwnValues => !mistake.harmless,
            Mistakes::These(ids) => ids.contains(&mistake.id.as_str()),
        };
        let changes = all.mistakes.iter().filter(is_wanted).flat_map(|mistake| {
            let way = |change: &BTreeMap<String, String>| change.clone().into_iter().collect();
            mistake.change.iter().map(move |change| (*mistake, way(change)))
        });
        (all.written(&chosen), changes.collect())
    }
}

/// The shaders of a model solution, compiled, with what they assign.
pub(super) struct ModelProgram {
    pub(super) program: Program,
    assigned: [Vec<Assigned>; 2],
}

impl ModelProgram {
    pub(super) fn new(texts: &[String; 2], written_exponent: f32) -> Result<Self, String> {
        let parsed = |stage: Stage| {
            let mut parsed = gonio_glsl::parse(&texts[stage as usize]);
            let checked = gonio_glsl::check(&mut parsed, stage);
            (parsed, checked)
        };
        let [vertex, fragment] = STAGES.map(parsed);
        let mut names = crate::comparison::model_names();
        names.names.insert("written_exponent".to_owned(), Meaning::Value(vec![written_exponent]));
        let texts = texts.each_ref().map(String::as_str);
        let program = Program::new((&vertex.0, &vertex.1), (&fragment.0, &fragment.1), texts, &names)
            .map_err(|(stage, error)| format!("{stage}: {error}"))?;
        let assigned = STAGES.map(|stage| assigned(texts[stage as usize], &program.stage(stage).source));
        Ok(ModelProgram { program, assigned })
    }

    /// The assigned values of both stages.
    pub(super) fn exprs(&self) -> [Vec<ExprId>; 2] {
        self.assigned.each_ref().map(|all| all.iter().map(|assigned| assigned.expr).collect())
    }

    fn assigned(&self, stage: Stage, expr: ExprId) -> Option<&Assigned> {
        self.assigned[stage as usize].iter().find(|assigned| assigned.expr == expr)
    }

    /// The variable that is assigned an expression.
    pub(super) fn variable(&self, stage: Stage, expr: ExprId) -> Option<&str> {
        self.assigned(stage, expr).map(|assigned| assigned.variable.as_str())
    }
}

/// What each mistake assigns, as changes of the plain program.
fn wrong_values(
    solutions: &ModelSolutions,
    sources: &[String; 2],
    ways: &[Way],
    written_exponent: f32,
    samples: &[SceneSamples],
    plain: &ModelProgram,
) -> Result<Vec<Vec<Change>>, String> {
    let texts = sources.each_ref().map(|source| with_mistakes(source, ways));
    let wrong = solutions.program(&texts, written_exponent)?;
    let runner = Runner::new(&wrong.program, samples);
    let exprs = wrong.exprs();
    let mut changes: Vec<Vec<Change>> = vec![Vec::new(); ways.len()];
    let right = |seen: &Recorded, of: &Assigned| {
        let all = &plain.assigned[seen.stage as usize];
        all.iter().find(|right| right.variable == of.variable).map(|right| right.expr)
    };
    for seen in observe(&runner, &[], 0..samples.len(), [&exprs[0], &exprs[1]]) {
        let Some(of) = wrong.assigned(seen.stage, seen.expr) else { continue };
        if let (Some(change), Some(expr)) = (of.change, right(&seen, of)) {
            let (stage, exprs) = (seen.stage, vec![expr]);
            changes[change].push(Change { stage, exprs, occurrence: None, values: seen.values });
        }
    }
    // A line of a way may read what another line of the same way changes.
    let few = 0..samples.len().min(TELLING);
    for (way, changes) in changes.iter_mut().enumerate().filter(|(_, changes)| changes.len() > 1) {
        let in_wrong = |change: &Change| {
            let variable = &plain.assigned(change.stage, change.exprs[0])?.variable;
            let all = &wrong.assigned[change.stage as usize];
            let expr = all.iter().find(|of| of.change.is_none() && of.variable == *variable)?.expr;
            Some(Change { exprs: vec![expr], ..change.clone() })
        };
        let before: Vec<Change> = changes.iter().filter_map(in_wrong).collect();
        let of_way = STAGES.map(|stage| {
            let all = wrong.assigned[stage as usize].iter();
            all.filter(|of| of.change == Some(way)).map(|of| of.expr).collect::<Vec<_>>()
        });
        for seen in observe(&runner, &before, few.clone(), [&of_way[0], &of_way[1]]) {
            let expr = wrong.assigned(seen.stage, seen.expr).and_then(|of| right(&seen, of));
            let is_it = |change: &&mut Change| change.stage == seen.stage && expr == Some(change.exprs[0]);
            if let Some(change) = changes.iter_mut().find(is_it) {
                change.values = seen.values;
            }
        }
    }
    Ok(changes)
}

/// Adds what each mistake assigns to the end of the function that assigns the right value.
fn with_mistakes(source: &str, ways: &[Way]) -> String {
    let mut text = String::new();
    let mut pending = String::new();
    for line in source.lines() {
        if line.starts_with('}') || line.trim_start().starts_with("return ") {
            text.push_str(&std::mem::take(&mut pending));
        }
        text.push_str(line);
        text.push('\n');
        let Some(Assignment { variable, ty: declared, .. }) = Assignment::of(line) else { continue };
        let out = format!("{variable};");
        let of_output = || source.lines().find_map(|l| l.strip_prefix("out ")?.strip_suffix(&out).map(str::trim));
        let ty = declared.or_else(of_output).unwrap_or("vec4");
        for (index, (_, changes)) in ways.iter().enumerate() {
            for (_, value) in changes.iter().filter(|(changed, _)| changed == variable) {
                pending.push_str(&format!("{ty} wrong_{index}_{variable} = {value};\n"));
            }
        }
    }
    text
}

/// Finds the assigned values in a compiled source.
fn assigned(text: &str, map: &SourceMap) -> Vec<Assigned> {
    let (mut found, mut start) = (Vec::new(), 0);
    for line in text.split_inclusive('\n') {
        if let Some(Assignment { variable, at, .. }) = Assignment::of(line) {
            let byte = (start + at) as u32;
            let here = map.expressions.iter().enumerate().filter(|(_, expr)| expr.span.start == byte);
            if let Some((index, _)) = here.max_by_key(|(_, expr)| expr.span.end) {
                let parts = variable.strip_prefix("wrong_").and_then(|rest| rest.split_once('_'));
                let wrong = parts.and_then(|(number, of)| Some((number.parse().ok()?, of)));
                found.push(Assigned {
                    variable: wrong.map_or(variable, |(_, of)| of).to_owned(),
                    change: wrong.map(|(change, _)| change),
                    expr: ExprId(index as u32),
                });
            }
        }
        start += line.len();
    }
    found
}

/// The variables that a source assigns, and the tokens of their values.
pub(super) fn assignments(text: &str, map: &SourceMap) -> Vec<(String, TokenRange)> {
    let tokens = |expr: ExprId| map.expressions[expr.0 as usize].tokens;
    assigned(text, map).into_iter().map(|assigned| (assigned.variable, tokens(assigned.expr))).collect()
}

/// Inputs of the light equation, by the names that the model solutions give them.
pub(super) const INPUTS: [(&str, Role, &str); 19] = [
    ("light_pos", Role::LightPos(0), "vec3"),
    ("u_view_pos", Role::ViewPos, "vec3"),
    ("materialColour", Role::MaterialColor, "vec3"),
    ("light.ambient_strength", Role::AmbientStrength(0), "float"),
    ("light.diffuse_strength", Role::DiffuseStrength(0), "float"),
    ("light.specular_strength", Role::SpecularStrength(0), "float"),
    ("light.constant", Role::AttenuationConstant(0), "float"),
    ("light.linear", Role::AttenuationLinear(0), "float"),
    ("light.quadratic", Role::AttenuationQuadratic(0), "float"),
    ("shininess", Role::Shininess, "float"),
    ("roughness", Role::Roughness, "float"),
    ("refractionIndice", Role::RefractionIndex, "float"),
    ("M", Role::Model, "mat4"),
    ("V", Role::View, "mat4"),
    ("P", Role::Projection, "mat4"),
    ("itM", Role::NormalMatrix, "mat4"),
    ("V * M", Role::ModelView, "mat4"),
    ("P * V", Role::ViewProjection, "mat4"),
    ("P * V * M", Role::ModelViewProjection, "mat4"),
];

fn inputs(stage: Stage, samples: &[SceneSamples], model: ModelSolution) -> Vec<Quantity> {
    let count = |samples: &SceneSamples| match stage {
        Stage::Vertex => samples.vertices(),
        Stage::Fragment => samples.places.len(),
    };
    let mut all = Vec::new();
    let mut push = |name: &str, space: Space, of: &dyn Fn(&SceneSamples) -> Option<Vec<f32>>| {
        let mut values = Vec::new();
        let mut size = 0;
        for samples in samples {
            let Some(numbers) = of(samples) else { return };
            size = numbers.len();
            (0..count(samples)).for_each(|_| values.extend(&numbers));
        }
        if size > 0 {
            let values = Values::new(size, values);
            all.push(Quantity { name: name.to_owned(), stage, space, values, ..Quantity::default() });
        }
    };
    let is_read = |role: Role| match role {
        Role::Shininess => !model.has_roughness(),
        Role::Roughness => model.has_roughness(),
        _ => true,
    };
    for (name, role, ty) in INPUTS.into_iter().filter(|(_, role, _)| is_read(*role)) {
        push(name, Space::World, &|samples| {
            let mut numbers = numbers(role, ty, &samples.scene)?;
            numbers.truncate(match ty {
                "float" => 1,
                "vec3" => 3,
                _ => 16,
            });
            Some(numbers)
        });
        if ty == "mat4" {
            push(&format!("mat3({name})"), Space::World, &|samples| numbers(role, "mat3", &samples.scene));
        }
    }
    push("mat3(transpose(inverse(V * M)))", Space::View, &|samples| {
        Some(samples.scene.view_normal_matrix().to_cols_array().to_vec())
    });
    push("light_pos", Space::View, &|samples| {
        let scene = &samples.scene;
        Some(scene.view_from_world().transform_point3(scene.light.position).to_array().to_vec())
    });
    all
}

/// Vectors at the vertices, which are called as at the places.
const VARYINGS: [(&str, &str); 2] = [("v_to_light", "to_light"), ("v_to_eye", "to_eye")];

/// The vectors from the eye in the model solutions of mirrors and glass, and those to the eye.
const OPPOSITE: [(&str, &str); 2] = [("from_eye", "to_eye"), ("I", "V")];

impl Model {
    /// Evaluates a method at all points. It computes the light in a space, in which its mistakes are made.
    ///
    /// # Errors
    /// The model solution cannot be compiled; a test ensures that all can.
    pub fn new(
        solutions: &ModelSolutions,
        method: AnswerMethod,
        space: Space,
        given: &[SceneSamples],
        written_exponent: f32,
        mistakes: Mistakes<'_>,
    ) -> Result<Self, String> {
        let in_space = |samples: &SceneSamples| match space {
            Space::World => samples.clone(),
            Space::View => SceneSamples { scene: samples.scene.in_view_space(), ..samples.clone() },
        };
        let samples: Vec<SceneSamples> = given.iter().map(in_space).collect();
        let samples = samples.as_slice();
        let (sources, ways) = method.sources(&solutions.hypotheses(method.model), mistakes);
        let plain = solutions.program(&sources, written_exponent)?;
        let runner = Runner::new(&plain.program, samples);
        let exprs = plain.exprs();
        let mut quantities = Vec::new();
        for seen in observe(&runner, &[], 0..samples.len(), [&exprs[0], &exprs[1]]) {
            let Some(of) = plain.assigned(seen.stage, seen.expr) else { continue };
            let name = of.variable.clone();
            quantities.push(Quantity { name, stage: seen.stage, values: seen.values, ..Quantity::default() });
        }
        if !ways.is_empty() {
            let right = quantities.len();
            let few = 0..samples.len().min(TELLING);
            let changes = wrong_values(solutions, &sources, &ways, written_exponent, samples, &plain)?;
            for ((mistake, _), changes) in ways.iter().zip(changes).filter(|(_, changes)| !changes.is_empty()) {
                if matches!(mistakes, Mistakes::OwnValues) {
                    quantities.extend(
                        changes
                            .into_iter()
                            .filter_map(|Change { stage, exprs, values, .. }| {
                                let name = plain.assigned(stage, exprs[0])?.variable.clone();
                                let is_it = |q: &&Quantity| q.stage == stage && q.name == name;
                                let is_wrong =
                                    quantities[..right].iter().find(is_it).is_some_and(|q| !q.values.is_same(&values));
                                let own = Quantity {
                                    name,
                                    stage,
                                    mistake: Some(mistake),
                                    is_direct: true,
                                    values,
                                    ..Quantity::default()
                                };
                                is_wrong.then_some(own)
                            })
                            .collect::<Vec<_>>(),
                    );
                    continue;
                }
                for seen in observe(&runner, &changes, few.clone(), [&exprs[0], &exprs[1]]) {
                    let Some(of) = plain.assigned(seen.stage, seen.expr) else { continue };
                    let is_it = |q: &&Quantity| q.stage == seen.stage && q.name == of.variable;
                    let known = quantities[..right].iter().find(is_it);
                    if known.is_none_or(|known| known.values.is_same(&seen.values)) {
                        continue;
                    }
                    quantities.push(Quantity {
                        name: of.variable.clone(),
                        stage: seen.stage,
                        mistake: Some(mistake),
                        is_direct: changes.iter().any(|c| c.stage == seen.stage && c.exprs == [seen.expr]),
                        values: seen.values,
                        ..Quantity::default()
                    });
                }
            }
        }
        let places: Vec<f32> = samples
            .iter()
            .flat_map(|samples| samples.mesh.positions.chunks_exact(3))
            .flat_map(|at| [at[0], at[1], at[2], 1.0])
            .collect();
        quantities.push(Quantity {
            name: "vec4(position, 1.0)".to_owned(),
            stage: Stage::Vertex,
            values: Values::new(4, places),
            ..Quantity::default()
        });
        for (varying, vector) in VARYINGS {
            quantities.iter_mut().filter(|q| q.name == varying).for_each(|q| vector.clone_into(&mut q.name));
        }
        quantities.iter_mut().filter(|q| has_space(&q.name)).for_each(|q| q.space = space);
        let mut model = Model { method, space, quantities };
        if method.model.has_roughness() {
            model.leave_out_behind();
        }
        model.add_vectors_to_eye();
        let inputs: Vec<Quantity> = STAGES.into_iter().flat_map(|stage| inputs(stage, given, method.model)).collect();
        model.add_vectors_at_vertices(&inputs);
        model.add_intermediate(&inputs);
        model.add_steps_of_optics();
        model.interpolate(samples);
        if space == Space::World {
            model.add_views(samples);
        }
        model.quantities.extend(inputs);
        Ok(model)
    }

    /// The right quantities at the points of the first scene.
    #[must_use]
    pub fn in_first_scene(&self, samples: &[SceneSamples]) -> Self {
        let Some(first) = samples.first() else {
            return Model { method: self.method, space: self.space, quantities: Vec::new() };
        };
        let points = |stage| if stage == Stage::Vertex { first.vertices() } else { first.places.len() };
        let right = self.quantities.iter().filter(|quantity| quantity.mistake.is_none());
        let quantities = right.map(|quantity| Quantity {
            name: quantity.name.clone(),
            values: quantity.values.first(points(quantity.stage)),
            ..*quantity
        });
        Model { method: self.method, space: self.space, quantities: quantities.collect() }
    }

    /// Leaves out the places at which quantities of Ward's model may be anything. Its own switch between them is none.
    fn leave_out_behind(&mut self) {
        self.quantities.retain(|quantity| quantity.name != "cut");
        let of = |name: &str| self.right(name, Stage::Fragment, false);
        let (Some(normal), Some(to_light), Some(to_eye)) = (of("N"), of("L"), of("V")) else { return };
        let in_front = ward::in_front(normal, to_light, to_eye);
        for quantity in self.quantities.iter_mut().filter(|quantity| ward::is_open_behind(&quantity.name)) {
            quantity.values.present.iter_mut().zip(&in_front).for_each(|(present, in_front)| *present &= in_front);
        }
    }

    /// Adds the vectors to the eye of mirrors and glass, which compute the opposite ones, with their known wrong values.
    fn add_vectors_to_eye(&mut self) {
        let opposite = |quantity: &Quantity| {
            let (_, name) = OPPOSITE.iter().find(|(of, _)| *of == quantity.name)?;
            let values = quantity.values.map(3, |_, a, to| to.iter_mut().zip(a).for_each(|(to, a)| *to = -a));
            Some(Quantity { name: (*name).to_owned(), values, ..quantity.clone() })
        };
        let of_eye: Vec<Quantity> = self.quantities.iter().filter_map(opposite).collect();
        self.quantities.extend(of_eye);
    }

    /// Adds the vectors to the light and to the eye at the vertices, where the model computes them at the places: as varyings,
    /// they are as right.
    fn add_vectors_at_vertices(&mut self, inputs: &[Quantity]) {
        let is_absent = |name: &str| self.right(name, Stage::Vertex, false).is_none();
        let Some(position) = self.right("world_position", Stage::Vertex, false).cloned() else { return };
        if self.right("to_light", Stage::Fragment, false).is_none() {
            return;
        }
        let given = |name: &str, space: Space| {
            let is_it = |q: &&Quantity| q.stage == Stage::Vertex && q.name == name && q.space == space;
            inputs.iter().find(is_it).map(|q| &q.values)
        };
        let from_position = |to: Option<&Values>| {
            let at = |point: usize, axis: usize| to.map_or(0.0, |to| to.at(point)[axis]);
            position.map(3, |point, from, vector| {
                vector.iter_mut().zip(from).enumerate().for_each(|(axis, (v, from))| *v = at(point, axis) - from);
            })
        };
        // In view space, the eye is at the origin.
        let eye = (self.space == Space::World).then(|| given("u_view_pos", Space::World)).flatten();
        let to_light = given("light_pos", self.space).map(|light| ("to_light", from_position(Some(light))));
        let vectors = to_light.into_iter().chain([("to_eye", from_position(eye))]);
        let vectors: Vec<(&str, Values)> = vectors.filter(|(name, _)| is_absent(name)).collect();
        self.quantities.extend(vectors.into_iter().map(|(name, values)| Quantity {
            name: name.to_owned(),
            stage: Stage::Vertex,
            space: self.space,
            values,
            ..Quantity::default()
        }));
    }

    /// Adds values that programs compute within a line.
    fn add_intermediate(&mut self, inputs: &[Quantity]) {
        for stage in STAGES {
            let of = |name: &str| self.right(name, stage, false).cloned();
            let (Some(normal), Some(to_light), Some(to_eye), reflected) = (of("N"), of("L"), of("V"), of("R")) else {
                continue;
            };
            let is_here = |q: &&Quantity| q.stage == stage && q.mistake.is_none() && !q.interpolated;
            let of_stage: Vec<Quantity> = self.quantities.iter().filter(is_here).cloned().collect();
            let mut push = |name: &str, values: Values| {
                let space = if has_space(name) { self.space } else { Space::World };
                self.quantities.push(Quantity { name: name.to_owned(), stage, space, values, ..Quantity::default() });
            };
            super::products::products(&mut push, &|name: &str| {
                let is_it = |q: &&Quantity| q.stage == stage && q.name == name;
                of_stage.iter().chain(inputs).find(is_it).map(|q| &q.values)
            });
            let dot =
                |a: &Values, b: &Values| a.map(1, |p, a, to| to[0] = a.iter().zip(b.at(p)).map(|(a, b)| a * b).sum());
            push("-L", to_light.map(3, |_, a, to| to.iter_mut().zip(a).for_each(|(to, a)| *to = -a)));
            push("dot(N, L)", dot(&normal, &to_light));
            push("dot(N, V)", dot(&normal, &to_eye));
            // The steps of the reflected direction's formula.
            let cosine = dot(&normal, &to_light);
            let along_normal = |factor: f32| {
                normal.map(3, |p, a, to| to.iter_mut().zip(a).for_each(|(to, a)| *to = factor * cosine.at(p)[0] * a))
            };
            push("2.0 * dot(N, L)", cosine.map(1, |_, a, to| to[0] = 2.0 * a[0]));
            push("dot(N, L) * N", along_normal(1.0));
            push("2.0 * dot(N, L) * N", along_normal(2.0));
            let sum = to_light.map(3, |p, a, to| {
                to.iter_mut().zip(a.iter().zip(to_eye.at(p))).for_each(|(to, (a, b))| *to = a + b);
            });
            let half = sum.unit();
            push("dot(N, H)", dot(&normal, &half));
            push("L + V", sum);
            push("H", half);
            if let Some(reflected) = reflected {
                push("dot(R, V)", dot(&reflected, &to_eye));
            }
        }
    }

    /// Adds the values of the vertices, interpolated.
    fn interpolate(&mut self, samples: &[SceneSamples]) {
        let of_vertices: Vec<Quantity> =
            self.quantities.iter().filter(|quantity| quantity.stage == Stage::Vertex).cloned().collect();
        for quantity in of_vertices {
            let values = interpolated(&quantity.values, samples);
            self.quantities.push(Quantity { stage: Stage::Fragment, interpolated: true, values, ..quantity });
        }
    }

    /// Adds directions and positions in view space.
    fn add_views(&mut self, samples: &[SceneSamples]) {
        let all: Vec<Quantity> = self.quantities.iter().filter(|q| q.values.size == 3).cloned().collect();
        for quantity in all {
            let is_direction = DIRECTIONS.contains(&quantity.name.as_str());
            if !is_direction && !POSITIONS.contains(&quantity.name.as_str()) {
                continue;
            }
            let scene_of: Vec<usize> = samples
                .iter()
                .enumerate()
                .flat_map(|(scene, samples)| {
                    let count = if quantity.stage == Stage::Vertex { samples.vertices() } else { samples.places.len() };
                    std::iter::repeat_n(scene, count)
                })
                .collect();
            let views: Vec<_> = samples.iter().map(|samples| samples.scene.view_from_world()).collect();
            let values = quantity.values.map(3, |point, from, to| {
                let (view, from) = (views[scene_of[point]], Vec3::from_slice(from));
                let turned = if is_direction { Mat3::from_mat4(view) * from } else { view.transform_point3(from) };
                to.copy_from_slice(&turned.to_array());
            });
            self.quantities.push(Quantity { space: Space::View, values, ..quantity });
        }
    }

    /// The right values of a variable, at the points of a stage.
    #[must_use]
    pub fn right(&self, name: &str, stage: Stage, interpolated: bool) -> Option<&Values> {
        let is_it = |q: &&Quantity| {
            q.name == name
                && q.stage == stage
                && q.interpolated == interpolated
                && q.mistake.is_none()
                && q.space == if has_space(name) { self.space } else { Space::World }
        };
        self.quantities.iter().find(is_it).map(|quantity| &quantity.values)
    }
}
