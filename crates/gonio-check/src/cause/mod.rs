//! Finds out where a program goes wrong, by its values and without pictures.
//!
//! The interpreter computes every expression of a student's program at points on the surfaces of the test scenes
//! (`samples`, `program`). The light equation gives the right values of all quantities there, and the catalogue
//! those of known mistakes (`model`). A cause is proven by a counterfactual: with the right value instead of one
//! expression's own, the whole picture becomes right (`target`, [`search`]).

mod answer;
mod assign;
mod conventions;
pub mod edit;
pub mod explain;
pub(crate) mod formula;
mod methods;
pub(crate) mod model;
pub mod naming;
pub(crate) mod observed;
mod prediction;
mod products;
pub(crate) mod program;
pub mod quantity_of;
mod recording;
pub(crate) mod repair;
pub mod right_change;
pub(crate) mod samples;
pub(crate) mod scope;
pub mod search;
pub(crate) mod target;
pub(crate) mod values;
pub(crate) mod words;

use crate::mistakes::ModelSolution;
use crate::roles::{Bindings, NamesFile};
use crate::rules::SourceConstants;
use crate::search::{Lights, Parameterisation, Second, Task};
use crate::testbench::TestScene;
use edit::{Editor, TextFix, Trial};
use explain::{Explainer, Explanation, LightingMethod, Singly};
use gonio_glsl::{Checked, Parsed, Stage};
use methods::{Hints, methods, suspects};
use model::{AnswerMethod, Mistakes, Model, Space};
use observed::Observer;
pub use prediction::ModelSolutions;
use prediction::Predictor;
use program::{Program, Runner};
pub use samples::SceneSamples;
use scope::Scopes;
use search::{Found, Search, Tried, see};
use std::cell::Cell;
use target::{Highlight, RightPicture, Seen};

/// Why values cannot be judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotJudged {
    /// The interpreter does not run a construct.
    Unsupported(String),
    /// It takes too long for many counterfactuals.
    TooLong,
}

/// What was found, and with which method of a right answer.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The result.
    pub found: Found,
    /// The method that it refers to.
    pub method: AnswerMethod,
    /// The roles of its inputs, found by their values where the names do not determine them.
    pub bindings: Bindings,
    /// Single runs of scenes.
    pub runs: usize,
    /// Mistakes that explain the picture.
    pub explanations: Vec<Explanation>,
    /// Edits with which every scene is right, the most promising first; empty if none were found.
    pub fixes: Vec<TextFix>,
}

/// Most methods that are searched for causes by all repairs.
const MOST_METHODS: usize = 2;
/// Most methods that are searched for a known mistake.
const MOST_VARIANTS: usize = 6;

/// Most proven fixes that are kept for the driver.
const MOST_FIXES: usize = 2;

/// Most statements of one scene, all points together; the exercises' own answers have about 3,000.
const MOST_STATEMENTS: u64 = 60_000;

/// Most expressions of both stages; students' programs have 100 to 400.
const MOST_EXPRESSIONS: usize = 1_500;

fn is_long(program: &Program, scene: &TestScene) -> bool {
    let expressions = |stage: Stage| program.stage(stage).source.expressions.len();
    if expressions(Stage::Vertex) + expressions(Stage::Fragment) > MOST_EXPRESSIONS {
        return true;
    }
    let samples = [SceneSamples::new(scene.clone())];
    let runner = Runner::new(program, &samples);
    let result = runner.run(0, &[], [&[], &[]]);
    result.vertex.statements + result.fragment.statements > MOST_STATEMENTS
}

/// Finds out whether a pair is right, and otherwise what makes it wrong.
///
/// # Errors
/// The reason why the values of this program cannot be judged.
pub fn diagnose(
    task: &Task,
    vertex: (&Parsed, &Checked),
    fragment: (&Parsed, &Checked),
    texts: [&str; 2],
    names: &NamesFile,
    constants: &SourceConstants,
    solutions: &ModelSolutions,
) -> Result<Diagnosis, NotJudged> {
    let named = Program::new(vertex, fragment, texts, names)
        .map_err(|(stage, why)| NotJudged::Unsupported(format!("{stage}: {why}")))?;
    let (scenes, [of_one, of_two]) = task.test_scenes();
    if scenes.iter().take(1).any(|scene| is_long(&named, scene)) {
        return Err(NotJudged::TooLong);
    }
    let mut assigned = named.clone();
    if assign::is_open(&assigned) {
        let parameterisation = Parameterisation::new(task, &assigned.bindings, &assigned.declared, constants);
        let first: Vec<SceneSamples> = (scenes.iter().take(1).cloned())
            .map(|mut scene| {
                parameterisation.apply(&mut scene);
                scene.light.position = constants.light_position.unwrap_or(scene.light.position);
                SceneSamples::new(scene)
            })
            .collect();
        let plain =
            methods(task).into_iter().map(|method| Model::new(method, Space::World, &first, 1.0, Mistakes::These(&[])));
        let plain = plain.collect::<Result<Vec<_>, _>>().map_err(NotJudged::Unsupported)?;
        assign::assign(&mut assigned, &first, &plain);
    }
    // A mistake may hide the roles: then those that the names tell explain more. Another convention makes no mistake.
    let others = conventions::other_conventions(&named);
    let mut programs = vec![&assigned];
    let is_open = named.bindings != assigned.bindings;
    programs.extend(is_open.then_some(&named));
    let may_be_wrong = programs.len();
    programs.extend(others.iter().filter(|other| other.bindings != assigned.bindings));
    let hints = Hints::new(task, [vertex.1, fragment.1], texts);
    let stages = [vertex, fragment];
    let diagnosing = |program| {
        let program: &Program = program;
        let parameterisation = Parameterisation::new(task, &program.bindings, &program.declared, constants);
        let count = if parameterisation.second == Second::None { of_one } else { of_one + of_two };
        let applied = |mut scene: TestScene| {
            parameterisation.apply(&mut scene);
            SceneSamples::new(scene)
        };
        let scenes = scenes.iter().take(count).map(|scene| (scene.clone(), applied(scene.clone()))).collect();
        Diagnosing { task, solutions, program, stages, texts, names, parameterisation, scenes, of_one, hints: &hints }
    };
    first_conclusion(programs.into_iter().map(diagnosing), may_be_wrong).map_err(NotJudged::Unsupported)
}

/// The diagnosis with the first roles with which the program is right, or else with the first of some by which it is
/// explained.
fn first_conclusion<'a>(all: impl Iterator<Item = Diagnosing<'a>>, may_be_wrong: usize) -> Result<Diagnosis, String> {
    let mut wrong = Vec::new();
    for (number, one) in all.enumerate() {
        let Some(seen) = one.picture() else { return Ok(one.diagnosis(Found::Endless, methods(one.task)[0])) };
        if let Some(right) = one.right(&seen)? {
            return Ok(right);
        }
        if number < may_be_wrong {
            wrong.push((one, seen));
        }
    }
    let mut unexplained = Vec::new();
    for (one, seen) in &wrong {
        match one.explaining(|explainer| explainer.singly(seen))? {
            Singly::Explained(explanations) => return one.wrong(explanations),
            Singly::Unexplained(tried) => unexplained.push(tried),
        }
    }
    for ((one, seen), tried) in wrong.iter().zip(&unexplained) {
        let explanations = one.explaining(|explainer| explainer.by_pairs(tried, seen))?;
        if !explanations.is_empty() {
            return one.wrong(explanations);
        }
    }
    let Some((first, _)) = wrong.first() else { return Err("no program".to_owned()) };
    first.wrong(Vec::new())
}

/// A program in its test scenes.
struct Diagnosing<'a> {
    task: &'a Task,
    solutions: &'a ModelSolutions,
    program: &'a Program,
    stages: [(&'a Parsed, &'a Checked); 2],
    texts: [&'a str; 2],
    names: &'a NamesFile,
    parameterisation: Parameterisation,
    /// Each scene as it is, and the points in it with the inputs of the program.
    scenes: Vec<(TestScene, SceneSamples)>,
    /// The number of scenes with one light, which come first.
    of_one: usize,
    hints: &'a Hints<'a>,
}

impl Diagnosing<'_> {
    fn right_picture(
        &self,
        method: AnswerMethod,
        lights: Lights,
        scenes: &[(TestScene, SceneSamples)],
    ) -> Result<RightPicture, String> {
        let scenes = scenes.iter().cloned();
        let all = self.solutions.get(method.model)?;
        let predictor = Predictor::new(all, lights, &self.parameterisation, Space::World, scenes);
        Ok(RightPicture::new(predictor, method, self.task.required))
    }

    fn samples(&self) -> Vec<SceneSamples> {
        self.scenes.iter().map(|(_, samples)| samples.clone()).collect()
    }

    /// The picture; `None` if a run does not end.
    fn picture(&self) -> Option<Seen> {
        let samples = self.samples();
        see(&Runner::new(self.program, &samples), &[], 0..samples.len())
    }

    fn diagnosis(&self, found: Found, method: AnswerMethod) -> Diagnosis {
        let bindings = self.program.bindings.clone();
        Diagnosis { found, method, bindings, runs: 0, explanations: Vec::new(), fixes: Vec::new() }
    }

    /// The diagnosis of a right program.
    fn right(&self, seen: &Seen) -> Result<Option<Diagnosis>, String> {
        for method in methods(self.task) {
            for lights in self.parameterisation.right_lights() {
                if let Some(agreement) = self.right_picture(method, *lights, &self.scenes)?.agrees(seen) {
                    return Ok(Some(self.diagnosis(Found::Right(agreement), method)));
                }
            }
        }
        Ok(None)
    }

    /// The diagnosis of a wrong program.
    fn wrong(&self, explanations: Vec<Explanation>) -> Result<Diagnosis, String> {
        let usual = methods(self.task)[0];
        let (scenes, lights) = match self.parameterisation.second {
            Second::None => (&self.scenes[..], Lights::One),
            // A light that is off is in no picture, so causes are searched in the scenes of the other one.
            Second::Switched => (&self.scenes[..self.of_one], Lights::First),
            Second::Always => return Ok(Diagnosis { explanations, ..self.diagnosis(Found::Nothing, usual) }),
        };
        let samples: Vec<SceneSamples> = scenes.iter().map(|(_, samples)| samples.clone()).collect();
        let runner = Runner::new(self.program, &samples);
        // Strengths that are constants of the program are those of the explanation.
        let mut of_model = samples.clone();
        if let Some(explanation) = explanations.first() {
            of_model.iter_mut().for_each(|samples| explanation.strengthen(&mut samples.scene));
        }
        let explaining: Vec<&str> =
            explanations.iter().flat_map(|e| e.mistakes.iter().map(|mistake| mistake.id.as_str())).collect();
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let mut runs = 0;
        let all = self.methods_to_search(&runner, &explanations)?;
        // With a known mistake, its own wrong value is looked for in every method first.
        let known = if explanations.is_empty() { 0 } else { all.len() };
        let known = (0..known).map(|at| (at, Tried::Known));
        let others = (0..all.len().min(MOST_METHODS)).map(|at| (at, Tried::All));
        let mut of_methods: Vec<(Model, RightPicture)> = Vec::new();
        let mut best: Option<(Found, usize)> = None;
        for (at, tried) in known.chain(others) {
            if at == of_methods.len() {
                let (method, space) = all[at];
                let lighting = LightingMethod { model: method.model, space };
                let wrong = match explanations.is_empty() {
                    true => suspects(self.program, &self.scenes, lighting, exponent),
                    false => explaining.clone(),
                };
                let model = Model::new(method, space, &of_model, exponent, Mistakes::These(&wrong))?;
                of_methods.push((model, self.right_picture(method, lights, scenes)?));
            }
            let (model, target) = &of_methods[at];
            // What is wrong with the other light is in none of these scenes.
            let is_right_here =
                || see(&runner, &[], 0..samples.len()).is_some_and(|seen| target.agrees(&seen).is_some());
            if lights == Lights::First && is_right_here() {
                break;
            }
            let mut search = Search::new(Observer { runner: &runner, model }, target, &explanations);
            let found = search.run(tried);
            runs += search.runs();
            let rank = found.rank();
            if best.as_ref().is_none_or(|(known, _)| rank < known.rank()) {
                best = Some((found, at));
            }
            if rank == 0 {
                break;
            }
        }
        let is_rooted = best.as_ref().is_some_and(|(found, _)| found.is_rooted());
        // The mistakes of the catalogue are predicted in all scenes.
        if let (false, true, Lights::One) = (is_rooted, explanations.is_empty(), lights)
            && let Some((model, target)) = of_methods.first()
        {
            let explain = |seen: &Seen| {
                Ok(match self.explaining(|explainer| explainer.singly(seen))? {
                    Singly::Explained(explanations) => explanations,
                    Singly::Unexplained(_) => Vec::new(),
                })
            };
            let in_model = |explanations: &[Explanation]| {
                let ids: Vec<&str> =
                    explanations.iter().filter_map(|e| Some(e.mistakes.first()?.id.as_str())).collect();
                Model::new(model.method, model.space, &of_model, exponent, Mistakes::These(&ids))
            };
            let mut search = Search::new(Observer { runner: &runner, model }, target, &[]);
            let found = search.beside_one(&explain, &in_model)?;
            runs += search.runs();
            if best.as_ref().is_none_or(|(known, _)| found.rank() < known.rank()) {
                best = Some((found, 0));
            }
        }
        let Some((found, at)) = best else {
            return Ok(Diagnosis { runs, explanations, ..self.diagnosis(Found::Nothing, usual) });
        };
        let (model, target) = &of_methods[at];
        let mut fixes = Vec::new();
        if let Found::Causes(groups) = &found {
            let at = Observer { runner: &runner, model };
            let scopes = self.stages.map(|(parsed, checked)| Scopes::new(parsed, checked));
            let trial = Trial { at, target, texts: self.texts, names: self.names };
            let tried = Editor::new(at, scopes, self.texts).fixes(groups);
            fixes = tried.into_iter().filter(|fix| trial.is_right(fix)).take(MOST_FIXES).collect();
        }
        Ok(Diagnosis { runs, explanations, fixes, ..self.diagnosis(found, model.method) })
    }

    fn explaining<T>(&self, explain: impl FnOnce(&Explainer<'_>) -> T) -> T {
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let suspects = |method: LightingMethod| suspects(self.program, &self.scenes, method, exponent);
        explain(&Explainer {
            solutions: self.solutions,
            methods: &self.hints.methods(self.program),
            suspects: &suspects,
            is_likely: &|id| self.hints.is_likely(id),
            parameterisation: &self.parameterisation,
            required: self.task.required,
            scenes: &self.scenes,
            pairs_left: Cell::new(explain::MOST_PAIRS),
            whole_left: Cell::new(explain::MOST_WHOLE),
        })
    }

    /// The methods to search for causes: those of the explanations, or those that the program resembles most.
    fn methods_to_search(
        &self,
        runner: &Runner<'_>,
        explanations: &[Explanation],
    ) -> Result<Vec<(AnswerMethod, Space)>, String> {
        let mut found: Vec<(AnswerMethod, Space)> = Vec::new();
        for method in explanations.iter().map(|explanation| (explanation.method, explanation.space)) {
            if !found.contains(&method) {
                found.push(method);
            }
        }
        // Some mistakes look the same in either space, with a highlight that is cut off or not.
        for (method, _) in found.clone() {
            for space in self.hints.methods(self.program).iter().map(|method| method.space) {
                for gated in [method.highlight.gated, true] {
                    let is_likely = gated == method.highlight.gated || self.hints.is_likely("specular-gated");
                    let highlight = Highlight { gated, ..method.highlight };
                    let other = (AnswerMethod { highlight, ..method }, space);
                    if is_likely && !found.contains(&other) && !(gated && method.highlight.weighted) {
                        found.push(other);
                    }
                }
            }
        }
        if found.is_empty() {
            let samples = runner.samples;
            let mut all = Vec::new();
            for method in methods(self.task) {
                let model = Model::new(method, Space::World, samples, 1.0, Mistakes::These(&[]))?;
                all.push((method, Observer { runner, model: &model }.likeness()));
            }
            let is_gouraud = self.hints.is_gouraud();
            // The usual one first among equals.
            all.sort_by_key(|(method, likeness)| {
                let is_other_stage = self.task.model.is_lit() && (method.model == ModelSolution::Gouraud) != is_gouraud;
                (is_other_stage, std::cmp::Reverse(*likeness))
            });
            found = all.into_iter().map(|(method, _)| (method, Space::World)).collect();
        }
        found.truncate(MOST_VARIANTS);
        Ok(found)
    }
}
