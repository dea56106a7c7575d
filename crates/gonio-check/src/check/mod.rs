//! Checks a student's files and returns a verdict.

mod by_reference;
mod by_values;
mod corrections;
mod explained;
mod flat;
mod proposed;

pub use by_values::WRONG_VALUE;
pub use proposed::with_edits;

use crate::cause::DiagnosisDepth;
use crate::comparison::{Evidence, Prepared, ShaderChecker, Task};
use crate::compile::{ParsedStage, compile, compiler_messages, does_not_link, first_message, strictness};
use crate::dataflow::Shader;
use crate::mistakes::{self, ModelSolution};
use crate::panorama;
use crate::picture_judge::PictureJudge;
use crate::roles::{Declared, NamesFile};
use crate::source::{Analysis, Place};
use crate::submission::{SourceFile, Submission};
use crate::verdict::{FoundMistake, Outcome, Peculiarity, Verdict};
use gonio_gl::GlError;
use gonio_glsl::Stage;
use gonio_language::tr;
use gonio_render::user_program::BrokenProgram;
use std::rc::Rc;
use std::sync::Arc;

/// Starts the threads of checks, and lets each of them and this one set up what it keeps. Both would wait for the system's loader
/// of libraries while a driver is starting.
pub fn start_threads() {
    gonio_threads::broadcast(|_| gonio_interpreter::prepare_thread());
    gonio_interpreter::prepare_thread();
}

/// Options of a check.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CheckOptions {
    /// The pair to check if there are several, by the name of its file or variable.
    pub pair: Option<String>,
    /// Accept what the lab's own solutions do too.
    pub as_the_lab: bool,
}

/// The parts of an exercise that the checker needs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShaderExercise<'a> {
    /// The identifier, such as `ex04`.
    pub id: &'a str,
    /// The task, if the exercise is judged by a model solution.
    pub task: Option<&'static Task>,
    /// The right pictures of an exercise without a model solution, which precede the task.
    pub judge: Option<&'a PictureJudge>,
    /// The vertex shader that students start from.
    pub start_vertex: Option<&'a str>,
    /// The fragment shader that students start from.
    pub start_fragment: Option<&'a str>,
}

impl<'a> ShaderExercise<'a> {
    /// Creates one of the built-in exercises, without start files.
    #[must_use]
    pub fn new(id: &'a str) -> Self {
        ShaderExercise { id, task: Task::find(id), ..ShaderExercise::default() }
    }
}

/// Checks a student's files. Errors are the driver's; everything that is wrong with the files is a verdict.
pub fn check(
    checker: &mut ShaderChecker,
    exercise: &ShaderExercise<'_>,
    files: Vec<SourceFile>,
    options: &CheckOptions,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    check_files(checker, exercise, files, options, Purpose::Fix)
}

/// Checks a student's files where no fix is shown, which saves drawing it.
///
/// # Errors
/// Errors of the driver.
pub fn check_without_fix(
    checker: &mut ShaderChecker,
    exercise: &ShaderExercise<'_>,
    files: Vec<SourceFile>,
    options: &CheckOptions,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    check_files(checker, exercise, files, options, Purpose::Causes)
}

/// What a check is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// Whether the files are right.
    Right,
    /// Also what is wrong with them.
    Causes,
    /// Also a fix.
    Fix,
}

/// Checks files for a purpose.
fn check_files(
    checker: &mut ShaderChecker,
    exercise: &ShaderExercise<'_>,
    files: Vec<SourceFile>,
    options: &CheckOptions,
    purpose: Purpose,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let unsure = |sentence: String| Ok((Verdict::new(exercise.id, Outcome::Unsure, sentence), None));
    if exercise.task.is_none() && exercise.judge.is_none() {
        return unsure(tr!("check-cannot-be-checked-yet", id = exercise.id));
    }
    let hints = [exercise.id];
    let given = if purpose == Purpose::Fix { files.clone() } else { Vec::new() };
    let submission = match Submission::gather_with(files, options.pair.as_deref(), &hints) {
        Ok(submission) => submission,
        Err(error) => return unsure(error.to_string()),
    };
    let mut names = match submission.names.as_deref().map(NamesFile::parse).transpose() {
        Ok(names) => names.unwrap_or_default(),
        Err(error) => return unsure(error.to_string()),
    };
    let target = checker.target();
    let vertex = ParsedStage::new(&submission.vertex, Stage::Vertex, target);
    let fragment = ParsedStage::new(&submission.fragment, Stage::Fragment, target);
    let does_not_compile = |broken: &BrokenProgram| {
        let mut verdict = Verdict::new(exercise.id, Outcome::DoesNotCompile, "");
        verdict.messages = compiler_messages(broken, &vertex, &fragment);
        verdict.summary = first_message(&verdict.messages, broken);
        verdict.warnings = submission.warnings.clone();
        Ok((verdict, None))
    };
    // The driver says why; the interpreter runs nothing that does not compile.
    let unlinked = does_not_link(exercise.id, &vertex, &fragment);
    let is_sound = vertex.is_accepted() && fragment.is_accepted() && unlinked.is_none();
    if !is_sound && let Err(broken) = compile(checker.gl()?, &vertex, &fragment) {
        return does_not_compile(&broken);
    }
    if let Some(verdict) = unlinked {
        return Ok((verdict, None));
    }
    if let Some(judge) = exercise.judge {
        let gl = checker.gl()?;
        let program = match compile(gl, &vertex, &fragment) {
            Ok(program) => program,
            Err(broken) => return does_not_compile(&broken),
        };
        let (mut verdict, evidence) = by_reference::judge(gl, judge, exercise.id, &submission, &program, &names)?;
        if verdict.verdict == Outcome::Wrong && is_unchanged(exercise, &submission) {
            report_unchanged(&mut verdict);
        }
        verdict.warnings.extend(submission.warnings.iter().cloned());
        verdict.warnings.extend(strictness(&vertex, &fragment));
        return Ok((verdict, evidence));
    }
    let Some(task) = exercise.task else {
        return unsure(tr!("check-cannot-be-checked-yet", id = exercise.id));
    };
    let shaders = [&vertex, &fragment].map(|stage| Shader { parsed: &stage.parsed, checked: &stage.checked });
    let source = match task.model.is_of_places() {
        true => Analysis::new(&shaders[0], &shaders[1], &names),
        false => Analysis::with_roles_by_use(&shaders[0], &shaders[1], &mut names),
    };
    let source = Rc::new(source);
    let asked = Rc::clone(&source);
    let prepared = Prepared {
        declared: gonio_glsl::leaves(&vertex.checked.interface)
            .into_iter()
            .chain(gonio_glsl::leaves(&fragment.checked.interface))
            .map(|leaf| Declared::uniform(leaf.name.clone(), leaf.ty.written()))
            .collect(),
        names,
        constants: source.constants(),
        unused_terms: unused_terms(&fragment),
        source_support: Box::new(move |id| asked.support(id)),
    };
    let values = by_values::ProgramValues {
        task,
        stages: [&vertex, &fragment],
        names: &prepared.names,
        constants: &prepared.constants,
        depth: if purpose == Purpose::Right { DiagnosisDepth::Right } else { DiagnosisDepth::Causes },
    };
    let compiled = |checker: &mut ShaderChecker| -> Result<_, GlError> {
        let program = compile(checker.gl()?, &vertex, &fragment);
        if let Ok(program) = &program {
            checker.draw_ahead(task, program, &prepared)?;
        }
        Ok(program)
    };
    let (diagnosis, program) = if task.model == ModelSolution::Panorama {
        (None, compile(checker.gl()?, &vertex, &fragment))
    } else {
        // The interpreter and the driver work at the same time.
        let solutions = Arc::clone(&checker.solutions);
        let (diagnosis, program) = gonio_threads::beside(|| values.diagnose(&solutions), || compiled(checker));
        (diagnosis, program?)
    };
    let program = match program {
        Ok(program) => program,
        Err(broken) => return does_not_compile(&broken),
    };
    let judging =
        by_values::Judging { values, prepared: &prepared, submission: &submission, program: &program, source: &source };
    let judged = diagnosis.map(|diagnosis| judging.judge(checker, diagnosis)).transpose()?.flatten();
    let (mut verdict, evidence, fixes) = match judged {
        Some(by_values::Judged { verdict, evidence, fixes }) => (verdict, evidence, fixes),
        None => {
            let (verdict, evidence) = match task.model {
                ModelSolution::Panorama => panorama::check(checker, task.exercise, &program, &prepared)?,
                _ => judging.by_pictures(checker)?,
            };
            (verdict, evidence, Vec::new())
        }
    };
    let placed = |found: FoundMistake, at: Place| by_values::placed(found, (at.stage, at.span), &submission);
    if verdict.verdict == Outcome::Wrong
        && verdict.mistakes.is_empty()
        && task.model.is_lit()
        && let Some(evidence) = &evidence
    {
        corrections::explain_blank(&mut verdict, evidence);
    }
    for found in verdict.mistakes.iter_mut().filter(|_| task.model == ModelSolution::Panorama) {
        if let Some(at) = source.line(&found.id) {
            *found = placed(found.clone(), at);
        }
    }
    for (id, at, sentence) in source.in_source_only() {
        let Some(found) = in_source(id, sentence, task.model) else { continue };
        let found = placed(found, at);
        if verdict.verdict == Outcome::Correct {
            verdict.verdict = Outcome::Wrong;
            verdict.summary = tr!("check-the-picture-is-right-here-only", name = found.name);
            verdict.score = verdict.score.min(0.9);
        }
        if verdict.mistakes.iter().all(|known| known.id != found.id) {
            verdict.mistakes.push(found);
        }
    }
    if let Some((at, sentence)) = source.seam_by_mipmaps().filter(|_| task.model == ModelSolution::Panorama) {
        let text = if at.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
        let (file, line, _) = text.place(at.span.line, at.span.column);
        verdict.warnings.push(format!("{file}:{line}: {sentence}"));
    }
    if purpose == Purpose::Fix && verdict.verdict == Outcome::Wrong && !is_unchanged(exercise, &submission) {
        verdict.proposed_fix = proposed::propose(checker, exercise, &given, options, &submission, &fixes);
    }
    if options.as_the_lab {
        pass_as_the_lab(&mut verdict);
    }
    if verdict.verdict == Outcome::Wrong && is_unchanged(exercise, &submission) {
        report_unchanged(&mut verdict);
    }
    if task.model.is_lit() {
        corrections::agree_terms(&mut verdict);
    }
    verdict.warnings.extend(submission.warnings.iter().cloned());
    verdict.warnings.extend(strictness(&vertex, &fragment));
    Ok((verdict, evidence))
}

/// Whether the submission still equals the start files, character by character.
fn is_unchanged(exercise: &ShaderExercise<'_>, submission: &Submission) -> bool {
    let is_same = |start: Option<&str>, text: &str| start.is_some_and(|start| start.lines().eq(text.lines()));
    is_same(exercise.start_vertex, &submission.vertex.text)
        && is_same(exercise.start_fragment, &submission.fragment.text)
}

/// Says in the summary that the files are unchanged. Mistakes that were named remain, guesses do not.
fn report_unchanged(verdict: &mut Verdict) {
    verdict.summary = match verdict.mistakes.first() {
        Some(first) => {
            tr!("check-unchanged-start-files-with-mistake", name = first.name)
        }
        None => tr!("check-unchanged-start-files").to_owned(),
    };
    verdict.peculiarities.clear();
}

/// For ambient, diffuse and specular: whether the vertex shader outputs it but the fragment shader never uses it.
fn unused_terms(fragment: &ParsedStage<'_>) -> [bool; 3] {
    let unused = |word: &str| {
        let inputs = fragment.checked.interface.inputs.iter();
        inputs.filter(|input| !input.is_used).any(|input| input.name.to_ascii_lowercase().contains(word))
    };
    ["amb", "diff", "spec"].map(unused)
}

/// Creates a mistake that only the source shows; `sentence` tells how to fix it there.
fn in_source(id: &str, sentence: String, model: ModelSolution) -> Option<FoundMistake> {
    let mistake = mistakes::for_model(model).find(|mistake| mistake.id == id)?;
    Some(FoundMistake { fix: sentence, ..FoundMistake::from_catalogue(mistake, 0.0) })
}

/// Accepts mistakes that the lab's own solutions make, and reports them as peculiarities.
fn pass_as_the_lab(verdict: &mut Verdict) {
    if verdict.verdict != Outcome::Wrong
        || verdict.mistakes.is_empty()
        || !verdict.mistakes.iter().all(|m| m.lab_does_it)
    {
        return;
    }
    let passed = std::mem::take(&mut verdict.mistakes);
    verdict.peculiarities.extend(passed.into_iter().map(|m| Peculiarity { id: m.id, name: m.name }));
    verdict.verdict = Outcome::Correct;
    verdict.scenes.iter_mut().for_each(|scene| scene.right = true);
    verdict.summary = tr!("check-right-by-the-standard-of-the").to_owned();
    verdict.score = 1.0;
}
