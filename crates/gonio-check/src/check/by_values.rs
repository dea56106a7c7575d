//! Corrects a verdict by the values that a program computes: a right program is never wrong, a mistake is named only
//! where another value repairs every test scene, and an unlisted one gets its line and both quantities in words.

use super::explained::NOT_PUT_OUT;
use crate::cause::edit::TextFix;
use crate::cause::found::Found;
use crate::cause::proven_cause::ProvenCause;
use crate::cause::{
    AnswerMethod, Diagnosis, DiagnosisDepth, ModelSolutions, Space, answer_methods, diagnose, is_absent, is_present,
    peculiarities,
};
use crate::comparison::{
    Evidence, MOST_FOR_WRONG, PLACES, PossibleAnswer, Prepared, RightAnswer, ShaderChecker, Task, bound, declared,
    endless_verdict, named as mistake_named, peculiarities_of, report_violations,
};
use crate::compile::{ParsedStage, compile};
use crate::mistakes::{Mistake, ModelSolution, TERMS};
use crate::roles::{Bindings, Bound, Declared, How, NamesFile, Role, VariableKind};
use crate::source::{Analysis, SourceConstants};
use crate::submission::{StageText, Submission};
use crate::testbench::scene;
use crate::verdict::{FoundMistake, Outcome, Peculiarity, Verdict};
use gonio_gl::GlError;
use gonio_glsl::{Span, Stage};
use gonio_language::tr;
use gonio_render::user_program::UserProgram;
use std::sync::Arc;

/// The id of a wrong value that no mistake of the catalogue explains.
pub const WRONG_VALUE: &str = "wrong-value";

/// Most lookups of a program that are judged alone; a mirror and glass together have two.
const MOST_LOOKUPS: usize = 4;

/// A program that the interpreter runs, without the driver.
#[derive(Clone, Copy)]
pub(super) struct ProgramValues<'a> {
    pub task: &'static Task,
    pub stages: [&'a ParsedStage<'a>; 2],
    pub names: &'a NamesFile,
    pub constants: &'a SourceConstants,
    pub depth: DiagnosisDepth,
}

impl ProgramValues<'_> {
    /// Looks at the values that the program computes. `None` if they do not tell what is wrong.
    pub fn diagnose(&self, solutions: &Arc<ModelSolutions>) -> Option<Diagnosis> {
        let texts = self.stages.map(|stage| stage.text.text.as_str());
        let [vertex, fragment] = self.stages.map(|stage| (&stage.parsed, &stage.checked));
        diagnose(self.task, [vertex, fragment], texts, self.names, self.constants, solutions, self.depth).ok()
    }
}

/// A program that is judged.
#[derive(Clone, Copy)]
pub(super) struct Judging<'a> {
    pub values: ProgramValues<'a>,
    pub prepared: &'a Prepared,
    pub submission: &'a Submission,
    pub program: &'a UserProgram,
    pub source: &'a Analysis,
}

/// A verdict by values.
pub(super) struct Judged {
    pub verdict: Verdict,
    pub evidence: Option<Evidence>,
    /// Edits with which the interpreter finds every scene right.
    pub fixes: Vec<TextFix>,
}

impl Judging<'_> {
    /// Judges a program by the diagnosis of its values, and draws it. `None` if values do not tell what is wrong.
    ///
    /// # Errors
    /// Errors of the driver.
    pub fn judge(&self, checker: &mut ShaderChecker, diagnosis: Diagnosis) -> Result<Option<Judged>, GlError> {
        let is_concluded = matches!(diagnosis.found, Found::Right(_) | Found::Endless);
        if !is_concluded && let Some(judged) = self.not_interpolated(checker, &diagnosis)? {
            return Ok(Some(judged));
        }
        if is_concluded || !diagnosis.explanations.is_empty() {
            return self.judged(checker, &diagnosis).map(Some);
        }
        let of_part = match self.values.task.model {
            ModelSolution::Camera => self.positions_alone(checker)?,
            model if model.is_looked_up() => self.lookups_alone(checker)?,
            _ => None,
        };
        if of_part.is_some() { Ok(of_part) } else { self.judged(checker, &diagnosis).map(Some) }
    }

    /// Compares the picture alone with those of right answers, where values tell nothing. No mistake is named.
    ///
    /// # Errors
    /// Errors of the driver.
    pub fn by_pictures(&self, checker: &mut ShaderChecker) -> Result<(Verdict, Option<Evidence>), GlError> {
        let declared = declared(self.program);
        let bindings = crate::roles::bind(&declared, &self.prepared.names);
        let is_position = |b: &Bound| b.declared.kind == VariableKind::Attribute && b.role == Role::Position;
        if !bindings.bound.iter().any(is_position) {
            let sentence = tr!("check-no-attribute-looks-like-the-position");
            let mut verdict = Verdict::new(self.values.task.exercise, Outcome::Unsure, sentence);
            verdict.bound = bound(&bindings);
            return Ok((verdict, None));
        }
        let mut answers = Vec::new();
        let mut methods = Vec::new();
        for method in answer_methods(self.values.task) {
            let all = checker.solutions.get(method.model).map_err(GlError::new)?;
            if let Some(choices) = method.choices(&all.hypotheses) {
                answers.push(PossibleAnswer { model: method.model, choices });
                methods.push(method);
            }
        }
        let found = checker.resembling(self.values.task, self.program, self.prepared, &answers)?;
        let Some((right, mut verdict, evidence)) = found else {
            return Ok((endless_verdict(self.values.task.exercise), None));
        };
        let right = right.map(|index| methods[index]);
        let word = self.values.task.other.filter(|(model, _)| right.is_some_and(|right| *model == right.model));
        if let Some(mistake) = word.and_then(|(_, word)| mistake_named(word?, 1.0)) {
            return Ok((wrong(verdict, vec![mistake]), Some(evidence)));
        }
        if right.is_some() {
            verdict.verdict = Outcome::Correct;
            verdict.score = 1.0;
            verdict.summary = tr!("check-right-in-every-scene").to_owned();
            return Ok((verdict, Some(evidence)));
        }
        Ok((unexplained(self.values.task, verdict, &bindings), Some(evidence)))
    }

    /// Judges a camera by the distances of what is drawn, for programs whose colours are not those of the vertices. `None`
    /// if that explains no more.
    fn positions_alone(&self, checker: &mut ShaderChecker) -> Result<Option<Judged>, GlError> {
        let mut text = self.submission.fragment.clone();
        text.text = checker.places_fragment();
        let fragment = ParsedStage::new(&text, Stage::Fragment, self.values.stages[1].target);
        let Some(mut judged) = self.with_fragment(checker, PLACES, &fragment)? else { return Ok(None) };
        judged.verdict.warnings.push(tr!("check-the-output-is-not-the-vertex").to_owned());
        Ok(Some(judged))
    }

    /// Judges the cubemap lookups of a program alone: a tint, a texture or fog over a mirror is a choice, not a mistake
    /// with the direction. `None` if that explains no more, or if no lookup flows into the colour.
    fn lookups_alone(&self, checker: &mut ShaderChecker) -> Result<Option<Judged>, GlError> {
        let mut best: Option<Judged> = None;
        let fragment = self.values.stages[1];
        let lookups = fragment.lookups().into_iter().filter(|lookup| self.source.puts_out_lookup(lookup.span));
        for lookup in lookups.take(MOST_LOOKUPS) {
            let mut text = self.submission.fragment.clone();
            text.text = fragment.showing(lookup);
            let fragment = ParsedStage::new(&text, Stage::Fragment, fragment.target);
            let Some(mut judged) = self.with_fragment(checker, self.values.task, &fragment)? else { continue };
            if judged.verdict.verdict == Outcome::Correct {
                judged.verdict.summary = tr!("check-the-lookup-is-right-in-every").to_owned();
                judged
                    .verdict
                    .peculiarities
                    .push(Peculiarity { id: "lookup-mixed".to_owned(), name: tr!("check-lookup-mixed").to_owned() });
                return Ok(Some(judged));
            }
            let count = |judged: &Judged| judged.verdict.mistakes.len();
            if best.as_ref().is_none_or(|best| count(&judged) < count(best)) {
                judged.verdict.warnings.push(tr!("check-only-the-lookup-was-judged").to_owned());
                best = Some(judged);
            }
        }
        Ok(best)
    }

    /// Judges the program with another fragment shader; `None` unless it is right or explained.
    fn with_fragment(
        &self,
        checker: &mut ShaderChecker,
        task: &'static Task,
        fragment: &ParsedStage<'_>,
    ) -> Result<Option<Judged>, GlError> {
        let vertex = self.values.stages[0];
        let Ok(program) = compile(checker.gl()?, vertex, fragment) else { return Ok(None) };
        let values = ProgramValues { task, stages: [vertex, fragment], ..self.values };
        let judging = Judging { values, program: &program, ..*self };
        let Some(diagnosis) = values.diagnose(&checker.solutions) else { return Ok(None) };
        if !matches!(diagnosis.found, Found::Right(_)) && diagnosis.explanations.is_empty() {
            return Ok(None);
        }
        judging.judged(checker, &Diagnosis { fixes: Vec::new(), ..diagnosis }).map(Some)
    }

    /// The verdict on a program with this diagnosis.
    fn judged(&self, checker: &mut ShaderChecker, diagnosis: &Diagnosis) -> Result<Judged, GlError> {
        let endless =
            || Judged { verdict: endless_verdict(self.values.task.exercise), evidence: None, fixes: Vec::new() };
        let groups = if let Found::Causes(groups) = &diagnosis.found { groups.as_slice() } else { &[] };
        let mistakes = match &diagnosis.found {
            Found::Endless => return Ok(endless()),
            Found::Right(_) => self.beside_right_values(diagnosis),
            // A late value can be repaired in every program: without a name it proves nothing about inputs.
            found
                if diagnosis.explanations.is_empty()
                    && !found.is_rooted()
                    && diagnosis.bindings.bound.iter().any(is_guessed) =>
            {
                Vec::new()
            }
            _ if diagnosis.explanations.is_empty() => proven(groups, self.submission),
            _ => self.explained(diagnosis, groups),
        };
        let Some((verdict, evidence)) = self.pictures(checker, diagnosis)? else { return Ok(endless()) };
        let fixes = diagnosis.fixes.clone();
        if mistakes.is_empty() && !matches!(diagnosis.found, Found::Right(_)) {
            let verdict = unexplained(self.values.task, verdict, &diagnosis.bindings);
            return Ok(Judged { verdict, evidence: Some(evidence), fixes });
        }
        Ok(match mistakes.is_empty() {
            true => self.correct(verdict, evidence, diagnosis),
            false => Judged { verdict: wrong(verdict, mistakes), evidence: Some(evidence), fixes },
        })
    }

    pub(super) fn pictures(
        &self,
        checker: &mut ShaderChecker,
        diagnosis: &Diagnosis,
    ) -> Result<Option<(Verdict, Evidence)>, GlError> {
        // Light in the wrong stage is compared with light in the right one.
        let is_wrong_stage = self.wrong_stage(diagnosis).is_some();
        let model = if is_wrong_stage { self.values.task.model } else { diagnosis.method.model };
        let method = AnswerMethod { model, ..diagnosis.method };
        let hypotheses = checker.solutions.get(model).map_err(GlError::new)?;
        let explanation = diagnosis.explanations.first();
        let explanation = explanation.filter(|found| found.space == Space::World && !is_wrong_stage);
        let right = RightAnswer {
            bindings: &diagnosis.bindings,
            parameterisation: &diagnosis.parameterisation,
            model,
            choices: &method.choices(&hypotheses.hypotheses).unwrap_or_default(),
            lights: diagnosis.lights,
            strengths: diagnosis.strengths,
            due_terms: [0, 1, 2].map(|term| self.is_due(diagnosis, term)),
            wrong: explanation.map(|explanation| &explanation.hypothesis),
        };
        checker.pictures(self.values.task, self.program, self.prepared, &right)
    }

    /// Makes the verdict right, and states the roles that this assumes where the names do not tell them.
    fn correct(&self, mut verdict: Verdict, evidence: Evidence, diagnosis: &Diagnosis) -> Judged {
        let is_seen = verdict.scenes.iter().all(|scene| scene.right);
        verdict.verdict = Outcome::Correct;
        verdict.score = 1.0;
        verdict.scenes.iter_mut().for_each(|scene| scene.right = true);
        let method = diagnosis.method;
        let chosen = peculiarities(method, method.highlight).into_iter().filter(|(_, is_chosen)| *is_chosen);
        let chosen: Vec<&Mistake> = chosen.filter_map(|(id, _)| crate::mistakes::find(id)).collect();
        let is_other = method.model != self.values.task.model;
        verdict.peculiarities = peculiarities_of(self.values.task, &chosen, diagnosis.strengths, is_other);
        if diagnosis.has_steps {
            verdict.peculiarities.push(Peculiarity {
                id: "diffuse-in-steps".to_owned(),
                name: tr!("check-the-diffuse-light-is-drawn-in").to_owned(),
            });
        }
        if diagnosis.limits_colours {
            verdict.peculiarities.push(Peculiarity {
                id: "light-limited-at-vertices".to_owned(),
                name: tr!("check-the-light-is-limited-at-the-vertices").to_owned(),
            });
        }
        if diagnosis.has_own_depth {
            verdict.warnings.push(tr!("check-the-sky-has-a-depth-of-its-own").to_owned());
        }
        let mut assumed: Vec<String> = Vec::new();
        for bound in self.assumed(&diagnosis.bindings) {
            let assumption = assumption(bound);
            if !assumed.contains(&assumption) {
                assumed.push(assumption);
            }
        }
        if diagnosis.parameterisation.white_material {
            assumed.push(tr!("check-all-but-one-of-the-object").to_owned());
        }
        verdict.summary = match (assumed.is_empty(), verdict.peculiarities.is_empty()) {
            (false, _) => tr!("check-right-in-every-test-scene-provided", assumptions = assumed.join(", ")),
            (true, true) => tr!("check-right-in-every-scene").to_owned(),
            (true, false) => tr!("check-right-in-every-scene-by-another").to_owned(),
        };
        Judged { verdict, evidence: is_seen.then_some(evidence), fixes: Vec::new() }
    }

    /// The uniforms whose names do not tell their roles.
    fn assumed<'b>(&self, bindings: &'b Bindings) -> Vec<&'b Bound> {
        let declared = bindings.bound.iter().map(|bound| &bound.declared).chain(&bindings.unknown);
        let declared: Vec<Declared> = declared.cloned().collect();
        let named = crate::roles::bind(&declared, &self.prepared.names);
        let is_named = |bound: &Bound| {
            named.bound.iter().any(|known| known.declared == bound.declared && known.role == bound.role)
        };
        // The meaning of the old pipeline's state is fixed.
        let is_open = |bound: &&Bound| {
            let is_uniform = bound.declared.kind == VariableKind::Uniform;
            is_uniform && !bound.declared.name.starts_with("gl_") && !is_named(bound)
        };
        bindings.bound.iter().filter(is_open).collect()
    }

    /// The mistake of computing the light in the wrong stage, if it is made.
    fn wrong_stage(&self, diagnosis: &Diagnosis) -> Option<&'static str> {
        self.values.task.other.filter(|(model, _)| *model == diagnosis.method.model).and_then(|(_, word)| word)
    }

    /// Whether a right program shows a term: the exercise requires it, or the program computes it and never uses it, although
    /// it shows another one that the exercise does not require.
    fn is_due(&self, diagnosis: &Diagnosis, term: usize) -> bool {
        let required = self.values.task.required;
        let is_unused = self.prepared.unused_terms[term] || diagnosis.unused_terms[term];
        required[term] || is_unused && (0..3).any(|term| !required[term] && is_present(diagnosis.strengths[term]))
    }

    /// Mistakes that do not show in the colours: light computed in the wrong stage, and optional terms that are computed
    /// and not added.
    pub(super) fn beside_right_values(&self, diagnosis: &Diagnosis) -> Vec<FoundMistake> {
        let word = self.wrong_stage(diagnosis);
        let [of_light, of_sum] = diagnosis.light_places;
        let at = |found: FoundMistake, place: Option<(Stage, Span)>| match place {
            Some(place) => placed(found, place, self.submission),
            None => found,
        };
        let of_stage = word.and_then(|word| mistake_named(word, 1.0)).map(|found| at(found, of_light));
        let mut found: Vec<FoundMistake> = of_stage.into_iter().collect();
        for term in (0..3).filter(|term| self.is_due(diagnosis, *term) && is_absent(diagnosis.strengths[*term])) {
            let missing = crate::mistakes::find(&format!("{}-missing", TERMS[term]));
            found.extend(missing.map(|mistake| {
                let or = vec![NOT_PUT_OUT.to_owned()];
                at(FoundMistake { or, ..FoundMistake::from_catalogue(mistake, 1.0) }, of_sum)
            }));
        }
        found
    }
}

/// The verdict on a wrong program without a named mistake: unsure while the meaning of an input is unknown.
fn unexplained(task: &Task, mut verdict: Verdict, bindings: &Bindings) -> Verdict {
    // Another model of the surface, of which the exercise knows nothing.
    let is_other = |bound: &&Bound| bound.role == Role::Roughness && !task.model.has_roughness();
    let others = bindings.bound.iter().filter(is_other).map(|bound| &bound.declared);
    let unknown = bindings.unknown.iter().chain(others).filter(|declared| declared.kind == VariableKind::Uniform);
    let guessed = bindings.bound.iter().filter(|bound| is_guessed(bound)).map(|bound| &bound.declared);
    let unknown = unknown.chain(guessed);
    let mut unknown: Vec<String> = unknown.map(|declared| format!("`{}`", declared.name)).collect();
    // Pictures are drawn without the inputs that have no role.
    let unset = verdict.bound.iter().filter(|bound| bound.role.is_none()).map(|bound| format!("`{}`", bound.name));
    unset.for_each(|name| {
        if !unknown.contains(&name) {
            unknown.push(name);
        }
    });
    if !unknown.is_empty() {
        verdict.verdict = Outcome::Unsure;
        verdict.summary = tr!("check-the-picture-differs-from-the-reference", names = unknown.join(", "));
        return verdict;
    }
    let wrong: Vec<String> = verdict.scenes.iter().filter(|s| !s.right).map(|s| scene::title(&s.scene)).collect();
    verdict.summary = tr!("check-no-known-mistake-explains-the-difference", scenes = wrong.join(", "));
    verdict.score = score_of_wrong(&verdict);
    report_violations(&mut verdict);
    verdict
}

/// Whether the name of a uniform does not tell its role. An array's elements may be anything.
fn is_guessed(bound: &Bound) -> bool {
    let is_array = bound.declared.array > 1 && bound.role.light().is_none();
    bound.declared.kind == VariableKind::Uniform && (bound.how == How::Type || is_array && bound.how != How::NamesFile)
}

/// What the program has to send for a right verdict, as the end of "provided that".
fn assumption(bound: &Bound) -> String {
    let is_element = bound.declared.name.contains('[');
    let name = of_any_element(&bound.declared.name);
    match if is_element { bound.role.with_light(0) } else { bound.role } {
        Role::ViewRotation | Role::ViewProjectionRotation => {
            tr!("check-the-program-sends-without-its-translation", name = name)
        }
        role => tr!("check-assumed-role", name = name, role = role.to_string()),
    }
}

/// A name with `i` for each index, since the elements of an array mean the same: `lights[i].pos`.
fn of_any_element(name: &str) -> String {
    let mut parts = name.split('[');
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let behind = part.split_once(']').map_or(part, |(_, behind)| behind);
        whole.push_str("[i]");
        whole.push_str(behind);
    }
    whole
}

/// The share of right scenes, at most that of a wrong answer.
fn score_of_wrong(verdict: &Verdict) -> f64 {
    let right = verdict.scenes.iter().filter(|scene| scene.right).count();
    (right as f64 / verdict.scenes.len().max(1) as f64).min(MOST_FOR_WRONG)
}

/// Makes the verdict wrong.
pub(super) fn wrong(mut verdict: Verdict, mistakes: Vec<FoundMistake>) -> Verdict {
    verdict.score = score_of_wrong(&verdict);
    verdict.mistakes = mistakes;
    verdict.summary = verdict.mistake_names();
    verdict
}

/// The causes that together make every scene right, by name where they have one.
fn proven(groups: &[Vec<ProvenCause>], submission: &Submission) -> Vec<FoundMistake> {
    let causes = groups.iter().filter_map(|group| group.first());
    let all = causes.flat_map(|cause| named(cause, submission).unwrap_or_else(|| vec![unlisted(cause, submission)]));
    let mut found: Vec<FoundMistake> = Vec::new();
    for mistake in all {
        let is_same = |known: &FoundMistake| {
            known.name == mistake.name && (&known.file, known.line) == (&mistake.file, mistake.line)
        };
        if !found.iter().any(is_same) {
            found.push(mistake);
        }
    }
    found
}

pub(super) fn unlisted(cause: &ProvenCause, submission: &Submission) -> FoundMistake {
    let found = FoundMistake::new(
        WRONG_VALUE,
        tr!("check-wrong-value", text = one_line(&cause.text), should = cause.should),
        1.0,
    );
    let taught = found.taught(cause.is_in_words(), tr!("check-with-this-value-every-test-scene"), "");
    placed(taught, cause.place(), submission)
}

/// The mistakes that a cause has by name.
fn named(cause: &ProvenCause, submission: &Submission) -> Option<Vec<FoundMistake>> {
    let first = cause.mistakes.first()?;
    let or = cause.mistakes.iter().skip(1).take(cause.equals).map(|other| other.id.clone()).collect();
    let found = FoundMistake { or, lab_does_it: first.lab_does_it, ..FoundMistake::from_catalogue(first, 1.0) };
    let second = cause.with.map(|with| FoundMistake::from_catalogue(with, 1.0));
    Some(std::iter::once(found).chain(second).map(|found| placed(found, cause.place(), submission)).collect())
}

/// The mistake with its file, line and the text of the line.
pub(super) fn placed(found: FoundMistake, (stage, span): (Stage, Span), submission: &Submission) -> FoundMistake {
    let text: &StageText = if stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
    let (file, line, _) = text.place(span.line, span.column);
    found.at(file, Some(line), text.line(span.line).unwrap_or_default())
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
