//! Finds out where a program goes wrong, by its values and without pictures.
//!
//! The interpreter computes every expression of a student's program at points on the surfaces of the test scenes
//! (`samples`, `program`). The light equation gives the right values of all quantities there, and the catalogue
//! those of known mistakes (`model`). A cause is proven by a counterfactual: with the right value instead of one
//! expression's own, the whole picture becomes right (`target`, [`search`]).

mod answer;
mod assign;
mod budget;
mod conclusion;
mod conventions;
pub mod edit;
pub mod explain;
pub(crate) mod formula;
mod methods;
pub(crate) mod model;
pub mod naming;
pub(crate) mod observed;
pub mod place;
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
mod shown;
mod steps;
pub(crate) mod target;
mod unused;
pub(crate) mod values;
mod ward;
pub(crate) mod words;

pub(crate) use answer::{AnswerMethod, Space, peculiarities};
pub(crate) use methods::answer_methods;

use crate::comparison::{Lights, Parameterisation, Second, Task};
use crate::mistakes::{Hypothesis, ModelSolution};
use crate::roles::{Bindings, NamesFile};
use crate::source::SourceConstants;
use crate::testbench::TestScene;
use budget::Budget;
use conclusion::{Attempt, first_conclusion};
use edit::{Editor, TextFix, Trial};
pub(crate) use explain::is_absent;
use explain::{Explainer, Explanation, LightingMethod, Singly, Strengths};
use gonio_glsl::{Checked, Parsed, Span, Stage};
use methods::{Hints, methods};
use model::{Mistakes, Model};
use observed::Observer;
use place::MistakePlace;
pub use prediction::ModelSolutions;
use prediction::Predictor;
use program::{Program, Runner};
pub use samples::SceneSamples;
use scope::Scopes;
use search::{Found, Search, Tried, see};
use shown::Shown;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
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
    /// Which quantities are inputs, with these roles.
    pub parameterisation: Parameterisation,
    /// The lights of the right answer.
    pub lights: Lights,
    /// The strengths of ambient, diffuse and specular light, where they are constants of the program and shown.
    pub strengths: Strengths,
    /// Single runs of scenes.
    pub runs: usize,
    /// Mistakes that explain the picture.
    pub explanations: Vec<Explanation>,
    /// Where the program makes these mistakes, as far as its values show it.
    pub places: Vec<MistakePlace>,
    /// Where the program computes the light in the stage of its method, and where in any: the places of a wrong stage, and
    /// of a term that is missing.
    pub light_places: [Option<(Stage, Span)>; 2],
    /// Edits with which every scene is right, the most promising first; empty if none were found.
    pub fixes: Vec<TextFix>,
    /// For ambient, diffuse and specular: whether a right program computes the term and never uses it.
    pub unused_terms: [bool; 3],
    /// Whether a right program draws diffuse light in steps.
    pub has_steps: bool,
}

/// Most methods that are searched for causes by all repairs.
const MOST_METHODS: usize = 2;
/// Most methods that are searched for a known mistake.
const MOST_VARIANTS: usize = 6;

/// Places in each scene at which causes are searched.
const SEARCHED_PLACES: usize = 128;

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
    [vertex, fragment]: [(&Parsed, &Checked); 2],
    texts: [&str; 2],
    names: &NamesFile,
    constants: &SourceConstants,
    solutions: &Rc<ModelSolutions>,
    depth: DiagnosisDepth,
) -> Result<Diagnosis, NotJudged> {
    let named = Program::new(vertex, fragment, texts, names)
        .map_err(|(stage, why)| NotJudged::Unsupported(format!("{stage}: {why}")))?;
    let (scenes, [of_one, of_two]) = task.test_scenes();
    if scenes.iter().take(1).any(|scene| is_long(&named, scene)) {
        return Err(NotJudged::TooLong);
    }
    let mut assigned = named.clone();
    let mut by_influence = Vec::new();
    if assign::is_open(&assigned) {
        let parameterisation = Parameterisation::new(task, &assigned.bindings, &assigned.declared, constants);
        let first: Vec<SceneSamples> = (scenes.iter().take(1).cloned())
            .map(|mut scene| {
                parameterisation.apply(&mut scene);
                scene.light.position = constants.light_position.unwrap_or(scene.light.position);
                SceneSamples::new(scene)
            })
            .collect();
        let plain = methods(task)
            .into_iter()
            .map(|method| Model::new(solutions, method, Space::World, &first, 1.0, Mistakes::These(&[])));
        let plain = plain.collect::<Result<Vec<_>, _>>().map_err(NotJudged::Unsupported)?;
        assign::assign(solutions, &mut assigned, &first, &plain);
        by_influence = assign::by_influence(&named, &assigned, &first[0], task.model.is_lit());
        // A light that is turned to view space shows which matrix is V.
        for program in by_influence.iter_mut().filter(|_| task.model.is_lit()) {
            assign::choose_open_matrices(program, &first, &plain);
        }
    }
    // A mistake may hide the roles: then those that the names tell explain more. Another convention makes no mistake.
    let mut others = conventions::other_conventions(&named);
    if task.model == ModelSolution::Skybox {
        others.extend(conventions::without_translation(&assigned));
    }
    // What a mistake changes in the number of right values may give inputs other roles.
    let of_values = if by_influence.is_empty() { Attempt::Whole } else { Attempt::Right };
    let mut programs: Vec<(&Program, Attempt)> = by_influence.iter().map(|one| (one, Attempt::Whole)).collect();
    programs.push((&assigned, of_values));
    programs.extend((named.bindings != assigned.bindings).then_some((&named, of_values)));
    let switched: Vec<Program> = programs.iter().flat_map(|(one, _)| assign::with_other_switches(one)).collect();
    // The sun's direction is a convention too, and so is which of several colours is the object's.
    let all = programs.clone();
    let whole = all.iter().filter(|(_, attempt)| *attempt == Attempt::Whole);
    programs.extend(whole.map(|(one, _)| (*one, Attempt::Turned)));
    programs.extend(all.iter().map(|(one, _)| (*one, Attempt::White)));
    programs.extend(switched.iter().map(|one| (one, Attempt::Right)));
    let is_new = |other: &&Program| other.bindings != assigned.bindings;
    programs.extend(others.iter().filter(is_new).map(|one| (one, Attempt::Single)));
    let hints = Hints::new(task, [vertex.1, fragment.1], texts);
    let stages = [vertex, fragment];
    let diagnosing = |one| {
        let (program, attempt): (&Program, Attempt) = one;
        let mut parameterisation = Parameterisation::new(task, &program.bindings, &program.declared, constants);
        match attempt {
            Attempt::Turned => parameterisation = parameterisation.with_turned_sun()?,
            Attempt::White => parameterisation = parameterisation.with_white_material(&program.bindings)?,
            _ => {}
        }
        let count = if parameterisation.second == Second::None { of_one } else { of_one + of_two };
        let applied = |mut scene: TestScene| {
            parameterisation.apply(&mut scene);
            SceneSamples::new(scene)
        };
        let scenes = scenes.iter().take(count).map(|scene| (scene.clone(), applied(scene.clone()))).collect();
        let one = Diagnosing {
            task,
            solutions,
            program,
            stages,
            texts,
            names,
            parameterisation,
            scenes,
            of_one,
            hints: &hints,
            shown: RefCell::default(),
        };
        Some((one, attempt))
    };
    first_conclusion(programs.into_iter().filter_map(diagnosing), depth).map_err(NotJudged::Unsupported)
}

/// How far a diagnosis goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiagnosisDepth {
    /// Only whether the pair is right.
    Right,
    /// Also what makes it wrong.
    Causes,
}

/// A program in its test scenes.
struct Diagnosing<'a> {
    task: &'a Task,
    solutions: &'a Rc<ModelSolutions>,
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
    /// The quantities that the program computes, by the method that they are compared with.
    shown: RefCell<Vec<(LightingMethod, Rc<Shown>)>>,
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
        let lights = self.parameterisation.right_lights().first().copied().unwrap_or(Lights::One);
        Diagnosis {
            found,
            method,
            bindings: self.program.bindings.clone(),
            parameterisation: self.parameterisation.clone(),
            lights,
            strengths: [None; 3],
            runs: 0,
            explanations: Vec::new(),
            places: Vec::new(),
            light_places: [None; 2],
            fixes: Vec::new(),
            unused_terms: [false; 3],
            has_steps: false,
        }
    }

    /// The methods, and their lights, for which the program is right at a few places of the first scenes.
    fn may_be_right(&self) -> Result<Vec<(AnswerMethod, Lights)>, String> {
        const PLACES: usize = 16;
        let first = self.scenes.iter().take(2);
        let of_two = self.scenes.get(self.of_one..).into_iter().flatten().take(1);
        let few: Vec<(TestScene, SceneSamples)> =
            first.chain(of_two).map(|(scene, samples)| (scene.clone(), samples.few(PLACES))).collect();
        let samples: Vec<SceneSamples> = few.iter().map(|(_, samples)| samples.clone()).collect();
        let Some(seen) = see(&Runner::new(self.program, &samples), &[], 0..samples.len()) else {
            return Ok(Vec::new());
        };
        let mut found = Vec::new();
        for method in methods(self.task) {
            for lights in self.parameterisation.right_lights() {
                if self.right_picture(method, *lights, &few)?.may_agree(&seen) {
                    found.push((method, *lights));
                }
            }
        }
        Ok(found)
    }

    /// The diagnosis of a right program.
    fn right(&self, seen: &Seen, likely: &[(AnswerMethod, Lights)]) -> Result<Option<Diagnosis>, String> {
        for (method, lights) in likely.iter().copied() {
            if let Some(agreement) = self.right_picture(method, lights, &self.scenes)?.agrees(seen) {
                let method = AnswerMethod { highlight: agreement.highlight.unwrap_or_default(), ..method };
                let strengths = agreement.strengths;
                let found = self.diagnosis(Found::Right(agreement), method);
                let unused_terms = self.unused_terms(method, strengths)?;
                let light_places = self.light_places(method, &Hypothesis::default(), strengths)?;
                return Ok(Some(Diagnosis { lights, strengths, unused_terms, light_places, ..found }));
            }
        }
        Ok(None)
    }

    /// Where the sum of all light is computed, if it is in another stage or a term is absent.
    fn light_places(
        &self,
        method: AnswerMethod,
        hypothesis: &Hypothesis,
        strengths: Strengths,
    ) -> Result<[Option<(Stage, Span)>; 2], String> {
        let is_any_absent = strengths.into_iter().any(is_absent);
        if !self.task.model.is_lit() || method.model == self.task.model && !is_any_absent {
            return Ok([None; 2]);
        }
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let mut samples: Vec<SceneSamples> = self.scenes[..self.of_one].iter().map(|(_, one)| one.clone()).collect();
        samples.iter_mut().for_each(|samples| explain::strengthen(&strengths, &mut samples.scene));
        place::of_light(self.program, &samples, self.solutions, (method.model, hypothesis, exponent))
    }

    /// The diagnosis of a wrong program.
    fn wrong(&self, explanations: Vec<Explanation>) -> Result<Diagnosis, String> {
        let mut found = self.causes(explanations)?;
        found.places = self.places(&found.explanations)?;
        if let Some(first) = found.explanations.first().filter(|first| first.space == Space::World) {
            found.light_places = self.light_places(first.method, &first.hypothesis, first.strengths)?;
        }
        Ok(found)
    }

    /// Where the program makes the mistakes of explanations.
    fn places(&self, explanations: &[Explanation]) -> Result<Vec<MistakePlace>, String> {
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let mut all = Vec::new();
        for explanation in explanations {
            // With a second light that is off, or wrong, the scenes are those of both.
            let scenes = match explanation.lights {
                Lights::WrongInSecond | Lights::Second => &self.scenes[self.of_one..],
                _ => &self.scenes[..self.of_one],
            };
            let samples: Vec<SceneSamples> = scenes.iter().map(|(_, samples)| samples.clone()).collect();
            all.extend(place::places(self.program, &samples, self.solutions, explanation, exponent)?);
        }
        Ok(all)
    }

    /// The causes of what a program does wrong.
    fn causes(&self, explanations: Vec<Explanation>) -> Result<Diagnosis, String> {
        let usual = methods(self.task)[0];
        let (scenes, lights) = match self.parameterisation.second {
            Second::None => (&self.scenes[..], Lights::One),
            // A light that is off is in no picture, so causes are searched in the scenes of the other one.
            Second::Switched => (&self.scenes[..self.of_one], Lights::First),
            Second::Always => {
                let of_first = explanations.first().map(|first| (first.method, first.strengths));
                let (method, strengths) = of_first.unwrap_or((usual, [None; 3]));
                return Ok(Diagnosis { explanations, strengths, ..self.diagnosis(Found::Nothing, method) });
            }
        };
        let few = |(scene, samples): &(TestScene, SceneSamples)| (scene.clone(), samples.few(SEARCHED_PLACES));
        let scenes: Vec<(TestScene, SceneSamples)> = scenes.iter().map(few).collect();
        let scenes = scenes.as_slice();
        let samples: Vec<SceneSamples> = scenes.iter().map(|(_, samples)| samples.clone()).collect();
        let runner = Runner::new(self.program, &samples);
        // Strengths that are constants of the program are those of the explanation.
        let mut of_model = samples.clone();
        if let Some(explanation) = explanations.first() {
            of_model.iter_mut().for_each(|samples| explain::strengthen(&explanation.strengths, &mut samples.scene));
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
                    true => self.shown(lighting)?.suspects().iter().copied().collect(),
                    false => explaining.clone(),
                };
                let model = Model::new(self.solutions, method, space, &of_model, exponent, Mistakes::These(&wrong))?;
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
            let budget = Budget::default();
            let explain = |seen: &Seen| {
                Ok(match self.explaining(scenes, &budget, |explainer| explainer.singly(seen))? {
                    Singly::Explained(explanations) => explanations,
                    Singly::Unexplained(_) => Vec::new(),
                })
            };
            let in_model = |explanations: &[Explanation]| {
                let ids: Vec<&str> =
                    explanations.iter().filter_map(|e| Some(e.mistakes.first()?.id.as_str())).collect();
                Model::new(self.solutions, model.method, model.space, &of_model, exponent, Mistakes::These(&ids))
            };
            let mut search = Search::new(Observer { runner: &runner, model }, target, &[]);
            let found = search.beside_one(&explain, &in_model)?;
            runs += search.runs();
            if best.as_ref().is_none_or(|(known, _)| found.rank() < known.rank()) {
                best = Some((found, 0));
            }
        }
        let Some((found, at)) = best else {
            let of_first = explanations.first().map(|first| (first.method, first.strengths));
            let (method, strengths) = of_first.unwrap_or((usual, [None; 3]));
            return Ok(Diagnosis { runs, explanations, strengths, ..self.diagnosis(Found::Nothing, method) });
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
        let strengths = match explanations.first() {
            Some(explanation) => explanation.strengths,
            None => repaired_strengths(&found, &runner, model, target),
        };
        Ok(Diagnosis { runs, explanations, fixes, strengths, ..self.diagnosis(found, model.method) })
    }

    /// The quantities that the program computes, compared with a method.
    fn shown(&self, method: LightingMethod) -> Result<Rc<Shown>, String> {
        if let Some((_, known)) = self.shown.borrow().iter().find(|(known, _)| *known == method) {
            return Ok(Rc::clone(known));
        }
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let new = Shown::new(self.solutions, self.program, &self.scenes[..self.of_one], method, exponent)?;
        let new = Rc::new(new);
        self.shown.borrow_mut().push((method, Rc::clone(&new)));
        Ok(new)
    }

    /// Whether a peculiarity of right answers may be that of the program.
    fn is_likely(&self, id: &str) -> bool {
        self.hints.is_likely(id) && (self.parameterisation.own_ambient || !answer::OWN_AMBIENT.contains(&id))
    }

    fn explaining<T>(
        &self,
        scenes: &[(TestScene, SceneSamples)],
        budget: &Budget,
        explain: impl FnOnce(&Explainer<'_>) -> T,
    ) -> T {
        explain(&Explainer {
            shown: &|method| self.shown(method),
            solutions: self.solutions,
            methods: &self.hints.methods(self.program),
            is_likely: &|id| self.is_likely(id),
            parameterisation: &self.parameterisation,
            required: self.task.required,
            scenes,
            budget,
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
                let model = Model::new(self.solutions, method, Space::World, samples, 1.0, Mistakes::These(&[]))?;
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

/// The strengths with which the picture is right once the causes are repaired.
fn repaired_strengths(found: &Found, runner: &Runner<'_>, model: &Model, target: &RightPicture) -> Strengths {
    let Found::Causes(groups) = found else { return [None; 3] };
    let mut changes = Vec::new();
    for right in groups.iter().filter_map(|group| group.first()).flat_map(|cause| &cause.right) {
        changes.extend(right.change(runner, model, &changes));
    }
    let seen = see(runner, &changes, 0..runner.samples.len());
    seen.and_then(|seen| target.agrees(&seen)).map_or([None; 3], |agreement| agreement.strengths)
}
