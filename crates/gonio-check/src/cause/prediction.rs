//! Predicts the colours and positions that a model solution computes with mistakes, at places of the test scenes.

use super::answer::Space;
use super::line_by_line::PointInputs;
use super::program::run_in_scene;
use super::samples::SceneSamples;
use super::solutions::{AllHypotheses, repeated};
use crate::comparison::{Lights, Parameterisation};
use crate::mistakes::Hypothesis;
use crate::testbench::TestScene;
use gonio_glsl::Stage;
use gonio_interpreter::{Fragment, InputRate, PointValues, StageInputs, interpolate};
use std::collections::{HashMap, HashSet};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The terms that are lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lit {
    /// All but those whose strengths are fitted.
    Known,
    /// Also one of these.
    Term(usize),
    /// All with equal strengths.
    Whole,
}

/// The inputs of one light with some terms.
struct LitInputs {
    lit: Lit,
    /// Whether a hypothesis applies to this light.
    is_changed: bool,
    vertex: StageInputs,
    uniforms: Vec<(usize, PointValues)>,
    /// The inputs of the fragment shader, by the choices in the vertex shader.
    vertices: Mutex<HashMap<Vec<i32>, Arc<OfVertices>>>,
}

/// `gl_Position` at each vertex.
type ClipPositions = Arc<[[f32; 4]]>;

/// The results of the vertex shader with some choices.
struct OfVertices {
    clip: ClipPositions,
    /// The varyings at the places, by the inputs of the fragment shader.
    varyings: PointInputs,
}

/// A model solution in one test scene.
struct SceneModel {
    samples: SceneSamples,
    lit: Vec<LitInputs>,
    /// The inputs of the vertex shader for positions, where the light is computed in view space: the camera keeps its own
    /// matrices.
    in_world: Option<StageInputs>,
    /// The positions with them, by the choices on which they depend.
    positions: Mutex<HashMap<Vec<i32>, ClipPositions>>,
}

/// Predicts pictures for one program: with its parameterisation, in its test scenes.
pub(crate) struct Predictor {
    /// The model solution.
    pub all: Arc<AllHypotheses>,
    /// The lights.
    pub lights: Lights,
    /// Whether the ambient light may have a colour of its own.
    pub has_own_ambient: bool,
    /// Whether the program's text has the strength of the ambient light, if there is one.
    pub is_ambient_written: bool,
    open: Vec<usize>,
    scenes: Vec<SceneModel>,
}

/// Red, green and blue at each place.
pub(crate) type Planes = [Vec<f32>; 3];

/// How strengths that are open add up to a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sum {
    /// Each term has its own strength.
    Terms,
    /// All have the usual strengths, with a common factor.
    Whole,
}

/// A predicted picture of one test scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Predicted {
    /// The colours without the terms whose strengths are open.
    pub known: Planes,
    /// The terms whose strengths are open: ambient 0, diffuse 1, specular 2; `None` for all together. They are added to
    /// the known colours.
    pub open: Vec<(Option<usize>, Planes)>,
    /// `gl_Position` at each vertex.
    pub clip: ClipPositions,
}

/// Most variants of the vertex shader that are kept.
const MOST_KEPT: usize = 1_000;

/// What threads share: kept results, which are whole whatever happens.
fn locked<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Predictor {
    /// Prepares predictions in test scenes, at places on their surfaces.
    #[must_use]
    pub fn new(
        all: Arc<AllHypotheses>,
        lights: Lights,
        parameterisation: &Parameterisation,
        space: Space,
        scenes: impl IntoIterator<Item = (TestScene, SceneSamples)>,
    ) -> Self {
        let open: Vec<usize> = (0..3).filter(|term| parameterisation.to_find[*term]).collect();
        let exponent = parameterisation.written_exponent.unwrap_or(1.0);
        let lit_inputs = |scene: &TestScene, samples: &SceneSamples, lit: Lit, light: usize, is_changed: bool| {
            let mut scene = scene.clone();
            match lit {
                Lit::Known => parameterisation.apply_to_model(&mut scene, lights, light, None),
                Lit::Term(term) => parameterisation.apply_to_model(&mut scene, lights, light, Some(term)),
                Lit::Whole => parameterisation.apply_whole(&mut scene, lights, light),
            }
            if space == Space::View {
                scene = scene.in_view_space();
            }
            let samples = SceneSamples { scene: scene.clone(), ..samples.clone() };
            let mut vertex = all.program.vertex_inputs(&samples);
            if let Some(input) = all.exponent[0] {
                vertex.set(input, PointValues::floats(&[exponent]));
            }
            let fragment = &all.program.fragment;
            let mut of_fragment = StageInputs::new(fragment, samples.places.len());
            all.program.set_uniforms(fragment, &mut of_fragment, &scene);
            if let Some(input) = all.exponent[1] {
                of_fragment.set(input, PointValues::floats(&[exponent]));
            }
            let is_uniform = |input: &usize| fragment.inputs[*input].rate == InputRate::Uniform;
            let uniforms = (0..fragment.inputs.len()).filter(is_uniform);
            let uniforms = uniforms.filter_map(|input| Some((input, of_fragment.values(input)?.clone()))).collect();
            LitInputs { lit, is_changed, vertex, uniforms, vertices: Mutex::default() }
        };
        let scenes = scenes.into_iter().map(|(scene, samples)| {
            let lit = std::iter::once(Lit::Known).chain(open.iter().map(|term| Lit::Term(*term)));
            let lit = lit.chain((!open.is_empty()).then_some(Lit::Whole));
            let lit =
                lit.flat_map(|lit| lights.each().iter().map(move |(light, is_changed)| (lit, *light, *is_changed)));
            let lit = lit.map(|(lit, light, changed)| lit_inputs(&scene, &samples, lit, light, changed)).collect();
            let in_world = (space == Space::View).then(|| all.program.vertex_inputs(&samples));
            SceneModel { samples, lit, in_world, positions: Mutex::default() }
        });
        let scenes = scenes.collect();
        let has_own_ambient = parameterisation.own_ambient;
        let is_ambient_written = !parameterisation.given[0] && !has_own_ambient;
        Predictor { all, lights, has_own_ambient, is_ambient_written, open, scenes }
    }

    /// The terms whose strengths are fitted: ambient 0, diffuse 1, specular 2.
    #[must_use]
    pub fn open(&self) -> &[usize] {
        &self.open
    }

    /// The number of test scenes.
    #[must_use]
    pub fn scenes(&self) -> usize {
        self.scenes.len()
    }

    /// The places in a scene.
    #[must_use]
    pub fn places(&self, scene: usize) -> usize {
        self.scenes[scene].samples.places.len()
    }

    /// The ways to add the terms of a hypothesis.
    #[must_use]
    pub fn sums(&self, hypothesis: &Hypothesis) -> &'static [Sum] {
        let is_whole = |mistake: &usize| self.all.hypotheses.mistakes[*mistake].whole;
        match !self.open.is_empty() && hypothesis.mistakes.iter().any(is_whole) {
            true => &[Sum::Terms, Sum::Whole],
            false => &[Sum::Terms],
        }
    }

    /// Runs the vertex shader with each of several choices, all together.
    fn of_vertices(&self, scene: &SceneModel, lit: &LitInputs, choices: &[Vec<i32>]) -> Vec<Arc<OfVertices>> {
        let program = &self.all.program;
        let mut found: HashMap<&[i32], Arc<OfVertices>> = HashMap::new();
        let mut new: Vec<Vec<i32>> = Vec::new();
        {
            let kept = locked(&lit.vertices);
            let mut missing: HashSet<&[i32]> = HashSet::new();
            for choices in choices {
                match kept.get(choices) {
                    Some(known) => drop(found.insert(choices, Arc::clone(known))),
                    None if missing.insert(choices) => new.push(choices.clone()),
                    None => {}
                }
            }
        }
        if !new.is_empty() {
            let points = scene.samples.vertices();
            let outputs = self.all.run_vertices(&lit.vertex, &new);
            // The places around each copy of the vertices.
            let shifted = |place: &Fragment, copy: usize| Fragment {
                corners: place.corners.map(|corner| corner + (copy * points) as u32),
                ..*place
            };
            let places = &scene.samples.places;
            let all: Vec<Fragment> =
                (0..new.len()).flat_map(|copy| places.iter().map(move |place| shifted(place, copy))).collect();
            let fragment = interpolate(&program.vertex, &outputs, &program.fragment, &all);
            let position = program.vertex.output("gl_Position").and_then(|at| outputs.get(at));
            let mut made = Vec::with_capacity(new.len());
            for copy in 0..new.len() {
                let clip = clip_positions(position, copy * points..(copy + 1) * points);
                let range = copy * places.len()..(copy + 1) * places.len();
                let varyings = (0..program.fragment.inputs.len()).filter_map(|input| match fragment.values(input)? {
                    PointValues::Each { components, .. } => {
                        Some((input, components.iter().map(|all| all[range.clone()].to_vec()).collect()))
                    }
                    PointValues::Same(_) => None,
                });
                let varyings = varyings.collect();
                made.push(Arc::new(OfVertices { clip, varyings }));
            }
            let mut kept = locked(&lit.vertices);
            if kept.len() > MOST_KEPT {
                kept.clear();
            }
            for (choices, made) in new.iter().zip(made) {
                found.insert(choices, Arc::clone(&made));
                kept.insert(choices.clone(), made);
            }
        }
        choices.iter().filter_map(|choices| found.get(choices.as_slice()).cloned()).collect()
    }

    /// `gl_Position` at each vertex with some choices in the vertex shader.
    fn positions(&self, scene: &SceneModel, choices: &[i32], of_light: &OfVertices) -> ClipPositions {
        let Some(in_world) = &scene.in_world else { return Arc::clone(&of_light.clip) };
        let mut only: Vec<i32> = vec![0; choices.len()];
        self.all.of_position.iter().for_each(|at| only[*at] = choices[*at]);
        if let Some(known) = locked(&scene.positions).get(&only) {
            return Arc::clone(known);
        }
        let stage = &self.all.program.vertex;
        let points = scene.samples.vertices();
        let mut inputs = repeated(in_world, stage, 1);
        self.all.choose(Stage::Vertex, &[&only], points, &mut inputs);
        let result = run_in_scene(stage, &inputs);
        let new = clip_positions(result.output(stage, "gl_Position"), 0..points);
        locked(&scene.positions).insert(only, Arc::clone(&new));
        new
    }

    /// Predicts one scene.
    #[must_use]
    pub fn predict(&self, scene: usize, hypothesis: &Hypothesis, sum: Sum) -> Predicted {
        let mut all = self.predict_each(scene, &[hypothesis], sum);
        all.pop().unwrap_or_default()
    }

    /// Predicts one scene with each of several hypotheses.
    #[must_use]
    pub fn predict_each(&self, scene: usize, hypotheses: &[&Hypothesis], sum: Sum) -> Vec<Predicted> {
        let program = &self.all.program;
        let scene = &self.scenes[scene];
        let plain = Hypothesis::default();
        let count = scene.samples.places.len();
        let black = || [(); 3].map(|()| vec![0.0_f32; count]);
        let mut made: Vec<Predicted> =
            hypotheses.iter().map(|_| Predicted { known: black(), ..Predicted::default() }).collect();
        let colour = program.colour_output();
        let is_whole = sum == Sum::Whole;
        let choices = |hypotheses: &[&Hypothesis]| {
            [Stage::Vertex, Stage::Fragment]
                .map(|stage| hypotheses.iter().map(|one| self.all.choices(stage, one)).collect::<Vec<_>>())
        };
        let changed = choices(hypotheses);
        let is_any_unchanged = scene.lit.iter().any(|lit| !lit.is_changed);
        let unchanged = is_any_unchanged.then(|| choices(&vec![&plain; hypotheses.len()]));
        for lit in scene.lit.iter().filter(|lit| is_whole == (lit.lit == Lit::Whole)) {
            let [of_vertex, of_fragment] = unchanged.as_ref().filter(|_| !lit.is_changed).unwrap_or(&changed);
            let vertices = self.of_vertices(scene, lit, of_vertex);
            let varyings: Vec<&PointInputs> = vertices.iter().map(|one| &one.varyings).collect();
            let outputs = self.all.run_fragments(count, of_fragment, &lit.uniforms, &varyings);
            let Some(colour) = colour.and_then(|at| outputs.get(at)) else { continue };
            for (at, (made, vertices)) in made.iter_mut().zip(&vertices).enumerate() {
                if made.clip.is_empty() {
                    made.clip = self.positions(scene, &of_vertex[at], vertices);
                }
                let to = match lit.lit {
                    Lit::Known => &mut made.known,
                    Lit::Term(term) => of_term(&mut made.open, Some(term), black),
                    Lit::Whole => of_term(&mut made.open, None, black),
                };
                for (channel, plane) in to.iter_mut().enumerate() {
                    let numbers = colour.floats_at(channel, at * count..(at + 1) * count);
                    plane.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number);
                }
            }
        }
        for made in &mut made {
            for (_, planes) in &mut made.open {
                for (plane, known) in planes.iter_mut().zip(&made.known) {
                    plane.iter_mut().zip(known).for_each(|(sum, known)| *sum -= known);
                }
            }
        }
        made
    }
}

fn clip_positions(position: Option<&PointValues>, points: std::ops::Range<usize>) -> ClipPositions {
    let at = |position: &PointValues, point: usize| std::array::from_fn(|c| position.float(c, point));
    position.map_or_else(Arc::default, |position| points.map(|point| at(position, point)).collect())
}

fn of_term(open: &mut Vec<(Option<usize>, Planes)>, term: Option<usize>, black: impl Fn() -> Planes) -> &mut Planes {
    let at = open.iter().position(|(known, _)| *known == term).unwrap_or_else(|| {
        open.push((term, black()));
        open.len() - 1
    });
    &mut open[at].1
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::cause::solutions::{LEAST_BY_LINES, ModelSolutions};
    use crate::comparison::Task;
    use crate::source::SourceConstants;

    /// The numbers of a prediction, with their bits.
    fn bits(predicted: &Predicted) -> Vec<u32> {
        let of_terms = predicted.open.iter().flat_map(|(_, planes)| planes);
        let colours = predicted.known.iter().chain(of_terms).flatten().copied();
        colours.chain(predicted.clip.iter().flatten().copied()).map(f32::to_bits).collect()
    }

    #[test]
    fn line_by_line_hypotheses_have_the_values_of_the_whole_program() {
        let solutions = ModelSolutions::default();
        let tasks = ["ex01", "ex03", "ex06", "ex07", "ex08", "ex09", "ex10", "ex12"].map(|id| Task::find(id).unwrap());
        for task in tasks {
            let all = solutions.get(task.model).unwrap();
            for stage in [Stage::Vertex, Stage::Fragment] {
                assert!(all.lines(stage, LEAST_BY_LINES).is_some(), "{:?} {stage}", task.model);
            }
            let bindings = &all.program.bindings;
            let mut parameterisation = Parameterisation::new(task, bindings, bindings, &SourceConstants::default());
            // The strengths of open terms are predicted one by one.
            parameterisation.to_find = [task.model.is_lit(); 3];
            let scene = task.test_scenes().0.remove(0);
            let samples = SceneSamples::new(scene.clone()).few(5);
            for space in [Space::World, Space::View] {
                let scenes = [(scene.clone(), samples.clone())];
                let new = || Predictor::new(all.clone(), Lights::One, &parameterisation, space, scenes.clone());
                let singles = &all.hypotheses.singles;
                let apart = singles.iter().zip(singles.iter().skip(17)).filter_map(|(a, b)| a.and(b));
                let both: Vec<Hypothesis> = singles.iter().cloned().chain(apart).collect();
                assert!(both.len() > LEAST_BY_LINES);
                let together = new().predict_each(0, &both.iter().collect::<Vec<_>>(), Sum::Terms);
                let alone = new();
                for (hypothesis, predicted) in both.iter().zip(&together) {
                    let whole = alone.predict(0, hypothesis, Sum::Terms);
                    assert_eq!(bits(predicted), bits(&whole), "{:?} {space:?} {hypothesis:?}", task.model);
                }
            }
        }
    }
}
