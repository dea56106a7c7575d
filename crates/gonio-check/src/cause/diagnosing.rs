//! One program in its test scenes: whether it is right, and what is wrong with it.

use super::answer::LightingMethod;
use super::budget::Budget;
use super::edit::{self, Editor, TextFix};
use super::explain::{Explainer, MOST_WHOLE, Singly};
use super::explanation::is_absent;
use super::explanation::{Explanation, Strengths};
use super::found::Found;
use super::methods::{Hints, methods};
use super::model::{Mistakes, Model};
use super::observed::Observer;
use super::place::MistakePlace;
use super::prediction::Predictor;
use super::program::{Program, Runner};
use super::samples::SceneSamples;
use super::scope::Scopes;
use super::search::{Search, Tried};
use super::seeing::see;
use super::shown::Shown;
use super::solutions::ModelSolutions;
use super::target::{Highlight, RightPicture, Seen};
use super::trial::{FewPoints, Trials};
use crate::comparison::{Lights, Parameterisation, Second, Task};
use crate::mistakes::{Hypothesis, ModelSolution};
use crate::roles::NamesFile;
use crate::testbench::TestScene;
use gonio_glsl::{Checked, Parsed, Span, Stage};
use std::cell::Cell;
use std::sync::{Arc, Mutex, PoisonError};

use super::answer::{self, AnswerMethod, Space};
use super::{Diagnosis, explanation, place};

/// Most methods that are searched for causes by all repairs.
const MOST_METHODS: usize = 2;
/// Most methods that are searched for a known mistake.
const MOST_VARIANTS: usize = 6;
/// Places in each scene at which causes are searched.
const SEARCHED_PLACES: usize = 128;

/// Most proven fixes that are kept for the driver.
const MOST_FIXES: usize = 2;

/// A program in its test scenes.
pub(super) struct Diagnosing<'a> {
    pub(super) task: &'a Task,
    pub(super) solutions: &'a Arc<ModelSolutions>,
    pub(super) program: &'a Program,
    pub(super) stages: [(&'a Parsed, &'a Checked); 2],
    pub(super) texts: [&'a str; 2],
    pub(super) names: &'a NamesFile,
    pub(super) parameterisation: Parameterisation,
    /// Each scene as it is, and the points in it with the inputs of the program.
    pub(super) scenes: Vec<(TestScene, SceneSamples)>,
    /// The number of scenes with one light, which come first.
    pub(super) of_one: usize,
    pub(super) hints: &'a Hints<'a>,
    /// Most runs of pairs of mistakes at few places.
    pub(super) most_pairs: usize,
    /// The quantities that the program computes, by the method that they are compared with.
    pub(super) shown: Mutex<Vec<(LightingMethod, Arc<Shown>)>>,
}

impl Diagnosing<'_> {
    pub(super) fn right_picture(
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

    pub(super) fn samples(&self) -> Vec<SceneSamples> {
        self.scenes.iter().map(|(_, samples)| samples.clone()).collect()
    }

    /// The picture; `None` if a run does not end.
    pub(super) fn picture(&self) -> Option<Seen> {
        let samples = self.samples();
        see(&Runner::new(self.program, &samples), &[], 0..samples.len())
    }

    pub(super) fn diagnosis(&self, found: Found, method: AnswerMethod) -> Diagnosis {
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
            limits_colours: false,
            has_own_depth: false,
        }
    }

    /// The methods, and their lights, for which the program is right at a few places of the first scenes.
    pub(super) fn may_be_right(&self) -> Result<Vec<(AnswerMethod, Lights)>, String> {
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
    pub(super) fn right(&self, seen: &Seen, likely: &[(AnswerMethod, Lights)]) -> Result<Option<Diagnosis>, String> {
        for (method, lights) in likely.iter().copied() {
            if let Some(agreement) = self.right_picture(method, lights, &self.scenes)?.agrees(seen) {
                let method = AnswerMethod { highlight: agreement.highlight.unwrap_or_default(), ..method };
                let strengths = agreement.strengths;
                let found = self.diagnosis(Found::Right(agreement), method);
                let unused_terms = self.unused_terms(method, strengths)?;
                let light_places = self.light_places(method, &Hypothesis::default(), strengths)?;
                let has_own_depth = self.task.model == ModelSolution::Skybox && self.has_own_depth();
                return Ok(Some(Diagnosis { lights, strengths, unused_terms, light_places, has_own_depth, ..found }));
            }
        }
        Ok(None)
    }

    /// Whether what is drawn is nearer than the largest depth, which is 1 after the division by w.
    fn has_own_depth(&self) -> bool {
        const LEAST: f32 = 0.999;
        let Some((_, first)) = self.scenes.first() else { return false };
        let runner = Runner::new(self.program, std::slice::from_ref(first));
        let Some(position) = runner.start(0).output(&self.program.vertex, "gl_Position") else { return false };
        (0..first.vertices()).any(|vertex| {
            let (z, w) = (position.float(2, vertex), position.float(3, vertex));
            w > 0.0 && z / w < LEAST
        })
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
        samples.iter_mut().for_each(|samples| explanation::strengthen(&strengths, &mut samples.scene));
        place::of_light(self.program, &samples, self.solutions, (method.model, hypothesis, exponent))
    }

    /// The diagnosis of a wrong program.
    pub(super) fn wrong(&self, explanations: Vec<Explanation>) -> Result<Diagnosis, String> {
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
        let certain = self.hints.certain(self.program);
        let mut all = Vec::new();
        for explanation in explanations {
            // With a second light that is off, or wrong, the scenes are those of both.
            let is_of_second = explanation.lights.is_last() || explanation.lights == Lights::WrongInSecond;
            let scenes = if is_of_second { &self.scenes[self.of_one..] } else { &self.scenes[..self.of_one] };
            let samples: Vec<SceneSamples> = scenes.iter().map(|(_, samples)| samples.clone()).collect();
            all.extend(place::places(self.program, &samples, self.solutions, explanation, (exponent, certain))?);
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
        let searched = |(scene, samples): &(TestScene, SceneSamples)| (scene.clone(), samples.few(SEARCHED_PLACES));
        let scenes: Vec<(TestScene, SceneSamples)> = scenes.iter().map(searched).collect();
        let scenes = scenes.as_slice();
        let samples: Vec<SceneSamples> = scenes.iter().map(|(_, samples)| samples.clone()).collect();
        let runner = Runner::new(self.program, &samples);
        let Some((first, of_first)) = scenes.first() else { return Err("no test scene".to_owned()) };
        let few = FewPoints::new(of_first);
        let few_scenes = [(first.clone(), few.samples[0].clone())];
        let runner_at_few = Runner::new(self.program, &few.samples);
        // Strengths that are constants of the program are those of the explanation.
        let mut of_model = samples.clone();
        if let Some(explanation) = explanations.first() {
            of_model.iter_mut().for_each(|samples| explanation::strengthen(&explanation.strengths, &mut samples.scene));
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
        // Each of two mistakes has a cause.
        let beside = explanations.first().map_or(0, |explanation| explanation.mistakes.len().saturating_sub(1));
        let mut of_methods: Vec<(Model, [RightPicture; 2])> = Vec::new();
        let mut best: Option<(Found, usize)> = None;
        for (at, tried) in known.chain(others) {
            // A known mistake that hides a choice of the method may be at its own place only with another method.
            let is_enough = |found: &Found| found.rank() <= beside && (tried == Tried::All || found.is_at_mistakes());
            if best.as_ref().is_some_and(|(found, _)| is_enough(found)) {
                break;
            }
            if at == of_methods.len() {
                let (method, space) = all[at];
                let lighting = LightingMethod { model: method.model, space };
                let wrong = match explanations.is_empty() {
                    true => self.shown(lighting)?.suspects().keys().copied().collect(),
                    false => explaining.clone(),
                };
                let model = Model::new(self.solutions, method, space, &of_model, exponent, Mistakes::These(&wrong))?;
                let targets = [scenes, &few_scenes].map(|scenes| self.right_picture(method, lights, scenes));
                let [target, at_few] = targets;
                of_methods.push((model, [target?, at_few?]));
            }
            let (model, [target, target_at_few]) = &of_methods[at];
            // What is wrong with the other light is in none of these scenes.
            let is_right_here =
                || see(&runner, &[], 0..samples.len()).is_some_and(|seen| target.agrees(&seen).is_some());
            if lights == Lights::First && is_right_here() {
                break;
            }
            let trials = Trials { runner: &runner, target, at_few: (&few, &runner_at_few, target_at_few) };
            let mut search = Search::new(Observer { runner: &runner, model }, trials, &explanations, lights);
            let found = search.run(tried);
            runs += search.runs();
            // Where no value is the mistake's own, the earliest is nearest to it.
            let rank = |found: &Found| match tried == Tried::Known && !found.is_at_mistakes() {
                true => (found.rank(), true, found.depth_of_firsts()),
                false => (found.rank(), false, 0),
            };
            if best.as_ref().is_none_or(|(known, _)| rank(&found) < rank(known)) {
                best = Some((found, at));
            }
        }
        let is_rooted = best.as_ref().is_some_and(|(found, _)| found.is_rooted());
        // The mistakes of the catalogue are predicted in all scenes.
        if let (false, true, Lights::One) = (is_rooted, explanations.is_empty(), lights)
            && let Some((model, [target, target_at_few])) = of_methods.first()
        {
            let budget = Budget::beside();
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
            let trials = Trials { runner: &runner, target, at_few: (&few, &runner_at_few, target_at_few) };
            let mut search = Search::new(Observer { runner: &runner, model }, trials, &[], lights);
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
        let (model, [target, _]) = &of_methods[at];
        let mut fixes = Vec::new();
        if let Found::Causes(groups) = &found {
            let at = Observer { runner: &runner, model };
            let scopes = self.stages.map(|(parsed, checked)| Scopes::new(parsed, checked));
            let trial = edit::Trial { at, texts: self.texts, names: self.names };
            let tried = Editor::new(at, scopes, self.texts).fixes(groups);
            fixes = self.right_fixes(tried, &trial, target, (lights, scenes))?;
        }
        let strengths = match explanations.first() {
            Some(explanation) => explanation.strengths,
            None => repaired_strengths(&found, &runner, model, target),
        };
        Ok(Diagnosis { runs, explanations, fixes, strengths, ..self.diagnosis(found, model.method) })
    }

    /// The fixes with which every scene is right: by the method of the cause, or else by any other.
    fn right_fixes(
        &self,
        tried: Vec<TextFix>,
        trial: &edit::Trial<'_>,
        target: &RightPicture,
        (lights, scenes): (Lights, &[(TestScene, SceneSamples)]),
    ) -> Result<Vec<TextFix>, String> {
        let (mut right, mut others) = (Vec::new(), Vec::new());
        for fix in tried {
            match trial.picture(&fix) {
                Some(seen) if target.agrees(&seen).is_some() => right.push(fix),
                Some(seen) => others.push((fix, seen)),
                None => {}
            }
            if right.len() == MOST_FIXES {
                break;
            }
        }
        if right.is_empty() {
            for method in methods(self.task) {
                let target = self.right_picture(method, lights, scenes)?;
                let here = others.iter().filter(|(_, seen)| target.agrees(seen).is_some());
                right.extend(here.map(|(fix, _)| fix.clone()));
            }
            right.truncate(MOST_FIXES);
        }
        Ok(right)
    }

    /// The quantities that the program computes, compared with a method.
    pub(super) fn shown(&self, method: LightingMethod) -> Result<Arc<Shown>, String> {
        let all = || self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = all().iter().find(|(known, _)| *known == method) {
            return Ok(Arc::clone(known));
        }
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let new = Shown::new(self.solutions, self.program, &self.scenes[..self.of_one], method, exponent)?;
        let new = Arc::new(new);
        all().push((method, Arc::clone(&new)));
        Ok(new)
    }

    /// Whether a peculiarity of right answers may be that of the program.
    pub(super) fn is_likely(&self, id: &str) -> bool {
        self.hints.is_likely(id) && (self.parameterisation.own_ambient || !answer::OWN_AMBIENT.contains(&id))
    }

    /// The methods with which a picture may be explained, the likeliest first: in view space only if the program has
    /// something there.
    fn lighting_methods(&self) -> Result<Vec<LightingMethod>, String> {
        let mut found = self.hints.methods(self.program);
        if found.len() > 1 {
            let shown = self.shown(found[0])?;
            found.retain(|method| method.space == Space::World || shown.is_in_view());
            found.sort_by_key(|method| (method.space == Space::World) == shown.is_mostly_in_view());
        }
        Ok(found)
    }

    pub(super) fn explaining<T>(
        &self,
        scenes: &[(TestScene, SceneSamples)],
        budget: &Budget,
        explain: impl FnOnce(&Explainer<'_>) -> Result<T, String>,
    ) -> Result<T, String> {
        let methods = self.lighting_methods()?;
        explain(&Explainer {
            shown: &|method| self.shown(method),
            solutions: self.solutions,
            methods: &methods,
            is_likely: &|id| self.is_likely(id),
            parameterisation: &self.parameterisation,
            required: self.task.required,
            certain: self.hints.certain(self.program),
            scenes,
            budget,
            pairs_left: Cell::new(self.most_pairs),
            whole_left: Cell::new(MOST_WHOLE),
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
        let spaces: Vec<Space> = self.lighting_methods()?.iter().map(|method| method.space).collect();
        // Some mistakes look the same in either space, with a highlight that is cut off or not.
        for (method, _) in found.clone() {
            for space in spaces.iter().copied() {
                for gated in [method.highlight.gated, true] {
                    let is_likely = gated == method.highlight.gated || self.hints.is_likely("specular-gated");
                    let highlight = Highlight { gated, ..method.highlight };
                    let other = (AnswerMethod { highlight, ..method }, space);
                    if is_likely && !found.contains(&other) && !(gated && method.highlight.weighted) {
                        found.push(other);
                    }
                }
            }
            // So does a highlight that a mistake hides, by either vector.
            let is_lit = method.model.has_exponent() && self.task.required[2];
            for space in spaces.iter().copied() {
                let highlight = Highlight { gated: false, ..method.highlight };
                let other = (AnswerMethod { highlight, half_vector: true, ..method }, space);
                if is_lit && self.hints.is_likely("specular-half-vector") && !found.contains(&other) {
                    found.push(other);
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
                let is_other_stage = self.task.model.is_lit() && method.model.is_per_vertex() != is_gouraud;
                (is_other_stage, std::cmp::Reverse(*likeness))
            });
            found = all.into_iter().map(|(method, _)| (method, Space::World)).collect();
        }
        // A highlight that a mistake hides is computed by the vector that the program shows.
        let lighting = |(method, space): &(AnswerMethod, Space)| LightingMethod { model: method.model, space: *space };
        if let Some(first) = found.first().map(lighting).filter(|first| first.model.has_exponent())
            && !explanations.is_empty()
            && let Some(half_vector) = self.shown(first)?.half_vector()
        {
            found.sort_by_key(|(method, _)| method.half_vector != half_vector);
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
