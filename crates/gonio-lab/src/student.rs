//! From a student's files to a verdict.

use crate::bank::{self, Model};
use crate::check::{Checker, Evidence, PLACES, Prepared, Task};
use crate::exercise::{Exercise, Kind};
use crate::faces;
use crate::locate::{Place, Shader, Source};
use crate::looked_up;
use crate::messages::{self, Message};
use crate::names::{Meaning, NamesFile};
use crate::other;
use crate::other_programs;
use crate::submission::{SourceFile, StageText, Submission};
use crate::terms;
use crate::unexplained;
use crate::verdict::{CompilerMessage, FoundMistake, Outcome, Peculiarity, Verdict};
use gonio_gl::{Gl, GlError};
use gonio_glsl::{Checked, Limit, Lookup, LoopBound, Parsed, Problem, Severity, Stage, Target, Translated};
use gonio_render::user_program::{BrokenProgram, UserProgram};
use std::rc::Rc;

/// The picture of the right answer that an exercise is begun with.
pub const GOAL: &str = "goal.png";

/// How a check is made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CheckOptions {
    /// Of several pairs: the one whose file or variable is called so.
    pub pair: Option<String>,
    /// Pass what the lab's own solutions do too.
    pub as_the_lab: bool,
}

/// A stage as it was read.
pub(crate) struct ReadStage<'a> {
    pub(crate) text: &'a StageText,
    parsed: Parsed,
    pub(crate) checked: Checked,
    pub(crate) translated: Translated,
    target: Target,
}

impl<'a> ReadStage<'a> {
    pub(crate) fn new(text: &'a StageText, stage: Stage, target: Target) -> Self {
        let mut parsed = gonio_glsl::parse(&text.text);
        let checked = gonio_glsl::check(&mut parsed, stage);
        let translated = gonio_glsl::translate_bounded(&parsed, &checked, target, Some(LoopBound::STUDENTS));
        ReadStage { text, parsed, checked, translated, target }
    }

    /// The text of the stage, putting out what it looks up there.
    pub(crate) fn showing(&self, lookup: Lookup) -> String {
        let bound = Some(LoopBound::STUDENTS);
        gonio_glsl::translate_showing(&self.parsed, &self.checked, self.target, bound, Some(lookup)).text
    }

    /// Where it looks cubemaps up.
    pub(crate) fn lookups(&self) -> Vec<Lookup> {
        gonio_glsl::lookups(&self.parsed)
    }

    pub(crate) fn problems(&self) -> impl Iterator<Item = &Problem> {
        self.parsed.problems.iter().chain(&self.checked.problems)
    }

    /// The limit of size or depth that it exceeds: no driver must see it then.
    pub(crate) fn refusal(&self) -> Option<&Problem> {
        self.parsed.refusal().or(self.checked.refusal())
    }

    pub(crate) fn message(&self, problem: &Problem) -> CompilerMessage {
        let (file, line, column) = self.text.place(problem.span.line, problem.span.column);
        CompilerMessage {
            file: file.to_owned(),
            line: Some(line),
            column: Some(column),
            text: problem.message.clone(),
            quoted: self.text.line(problem.span.line).map(str::to_owned),
            explanation: problem.help.clone(),
        }
    }
}

/// Most messages of one kind that are told: what follows from the first is no help.
const MOST_MESSAGES: usize = 12;

/// Checks a student's files. Errors are the driver's; everything that is wrong with the files is a verdict.
pub fn check(
    checker: &mut Checker,
    exercise: &Exercise,
    files: Vec<SourceFile>,
    options: &CheckOptions,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    match exercise.kind {
        Kind::Buffers => return Ok((other::buffers(exercise, files), None)),
        Kind::HostProgram => {
            return Ok((other::host_program(checker.gl(), exercise, files, &checker.host_files())?, None));
        }
        Kind::Faces if answers_with_pictures(exercise, &files) => return faces::pictures(checker, exercise, &files),
        Kind::Shaders | Kind::Faces => {}
    }
    let unsure = |sentence: String| Ok((Verdict::new(&exercise.id, Outcome::Unsure, sentence), None));
    let Some(task) = Task::of(&exercise.id) else {
        return unsure(format!("{} cannot be checked yet", exercise.id));
    };
    // What was handed out beside the shaders is nobody's answer.
    let handed_out = |name: &str| {
        let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
        name == GOAL || [".md", ".svg"].iter().any(|end| name.ends_with(end)) && exercise.file(name).is_some()
    };
    let files: Vec<SourceFile> =
        files.into_iter().filter(|file| !handed_out(&file.name) && !is_given_picture(exercise, file)).collect();
    let hints = [exercise.id.as_str()];
    let submission = match Submission::gather_with(files, options.pair.as_deref(), &hints) {
        Ok(submission) => submission,
        Err(error) => return unsure(error.to_string()),
    };
    let mut names = match submission.names.as_deref().map(NamesFile::parse).transpose() {
        Ok(names) => names.unwrap_or_default(),
        Err(error) => return unsure(error.to_string()),
    };
    let target = if gonio_render::user_program::is_embedded(checker.gl()) { Target::Es300 } else { Target::Core330 };
    let vertex = ReadStage::new(&submission.vertex, Stage::Vertex, target);
    let fragment = ReadStage::new(&submission.fragment, Stage::Fragment, target);
    let program = match compile(checker.gl(), &vertex, &fragment) {
        Ok(program) => program,
        Err(broken) => {
            let mut verdict = Verdict::new(&exercise.id, Outcome::DoesNotCompile, "");
            verdict.messages = compiler_messages(&broken, &vertex, &fragment);
            verdict.summary = first_message(&verdict.messages, &broken);
            verdict.warnings = submission.warnings.clone();
            return Ok((verdict, None));
        }
    };
    if let Some(verdict) = does_not_link(&exercise.id, &vertex, &fragment) {
        return Ok((verdict, None));
    }
    let read = |names: &NamesFile| {
        let [vertex, fragment] =
            [&vertex, &fragment].map(|stage| Shader { parsed: &stage.parsed, checked: &stage.checked });
        Source::read(&vertex, &fragment, names)
    };
    let mut source = read(&names);
    let by_use = if task.model.is_of_places() { Vec::new() } else { source.matrices_by_use() };
    if !by_use.is_empty() {
        for (name, role) in by_use {
            names.names.entry(name).or_insert(Meaning::Role(role));
        }
        source = read(&names);
    }
    let source = Rc::new(source);
    let asked = Rc::clone(&source);
    let prepared = Prepared {
        declared: gonio_glsl::leaves(&vertex.checked.interface)
            .into_iter()
            .chain(gonio_glsl::leaves(&fragment.checked.interface))
            .map(|leaf| crate::names::Declared::uniform(leaf.name.clone(), leaf.ty.written()))
            .collect(),
        names,
        written: source.written(),
        in_vain: in_vain(&fragment),
        looks_like: Box::new(move |id, model| asked.looks_like(id, model)),
    };
    let (mut verdict, mut evidence) = match task.model {
        Model::Panorama => faces::program(checker, task.exercise, &program, &prepared)?,
        _ => checker.check(task, &program, &prepared)?,
    };
    if task.model == Model::Camera
        && let Some((by_places, seen)) = by_places(checker, &verdict, &vertex, &prepared)?
    {
        (verdict, evidence) = (by_places, seen);
    }
    if let Some((of_lookup, seen)) =
        looked_up::judge(checker, task, [&vertex, &fragment], &prepared, &source, &verdict)?
    {
        (verdict, evidence) = (of_lookup, seen);
    }
    let place = |found: &mut FoundMistake, place: Place| {
        let text = if place.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
        let (file, line, _) = text.place(place.span.line, place.span.column);
        found.file = Some(file.to_owned());
        found.line = Some(line);
        found.quoted = text.line(place.span.line).map(str::to_owned);
    };
    if task.model == Model::Skybox {
        other_programs::trust(&mut verdict, &source);
    }
    by_the_source(&mut verdict, &source, task.model);
    unexplained::mend(&mut verdict, evidence.as_ref(), &source, task);
    for found in &mut verdict.mistakes {
        if let Some(at) = source.line(&found.id, task.model) {
            place(found, at);
        }
    }
    for (id, at, sentence) in source.in_source_only() {
        let Some(mut found) = in_source(id, sentence, task.model) else { continue };
        place(&mut found, at);
        if verdict.verdict == Outcome::Correct {
            verdict.verdict = Outcome::Wrong;
            verdict.summary = format!("{}; the picture is right here by luck", found.name);
            verdict.score = verdict.score.min(0.9);
        }
        if verdict.mistakes.iter().all(|known| known.id != found.id) {
            verdict.mistakes.push(found);
        }
    }
    if let Some((at, sentence)) = source.seam_by_mipmaps().filter(|_| task.model == Model::Panorama) {
        let text = if at.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
        let (file, line, _) = text.place(at.span.line, at.span.column);
        verdict.warnings.push(format!("{file}:{line}: {sentence}"));
    }
    if options.as_the_lab {
        pass_as_the_lab(&mut verdict);
    }
    if verdict.verdict == Outcome::Wrong && is_unchanged(exercise, &submission) {
        tell_unchanged(&mut verdict);
    }
    if task.model.is_lit() {
        terms::agree(&mut verdict);
    }
    verdict.warnings.extend(submission.warnings.iter().cloned());
    verdict.warnings.extend(strictness(&vertex, &fragment));
    Ok((verdict, evidence))
}

/// Whether it is what was handed out, to the letter.
fn is_unchanged(exercise: &Exercise, submission: &Submission) -> bool {
    let is_same = |name: &str, text: &str| exercise.file(name).is_some_and(|start| start.lines().eq(text.lines()));
    is_same("start.vert", &submission.vertex.text) && is_same("start.frag", &submission.fragment.text)
}

/// Names that were found stay: they are what there is to do first. Guesses do not.
fn tell_unchanged(verdict: &mut Verdict) {
    verdict.summary = match verdict.mistakes.first() {
        Some(first) => {
            format!("these are the files one starts from, and nothing in them is changed yet; {}", first.name)
        }
        None => "these are the files one starts from, and nothing in them is changed yet".to_owned(),
    };
    verdict.runner_up = None;
    verdict.peculiarities.clear();
}

/// Whether there are pictures among the files beside what was handed out, so that they are the answer.
fn answers_with_pictures(exercise: &Exercise, files: &[SourceFile]) -> bool {
    let pictures = files.iter().filter(|file| faces::is_picture(file) && !is_given_picture(exercise, file)).count();
    // One that lies beside shaders is a texture or a screenshot.
    pictures > 1 || pictures > 0 && files.iter().all(|file| faces::is_picture(file) || file.name.ends_with(".md"))
}

/// What was handed out, as it was.
fn is_given_picture(exercise: &Exercise, file: &SourceFile) -> bool {
    exercise.pictures().any(|(_, bytes)| file.bytes == bytes)
}

/// Where colours are none of the vertices', a camera can be judged all the same: by how far away things are drawn.
/// `None` where the colours tell, or places tell no more.
fn by_places(
    checker: &mut Checker,
    verdict: &Verdict,
    vertex: &ReadStage<'_>,
    prepared: &Prepared,
) -> Result<Option<(Verdict, Option<Evidence>)>, GlError> {
    let unexplained = verdict.verdict == Outcome::Wrong && verdict.mistakes.is_empty();
    if !unexplained {
        return Ok(None);
    }
    let fragment = checker.places_fragment();
    let Ok(program) = UserProgram::new(checker.gl(), &vertex.translated.text, &fragment) else { return Ok(None) };
    let (mut by_places, evidence) = checker.check(PLACES, &program, prepared)?;
    if by_places.verdict == Outcome::Wrong && by_places.mistakes.is_empty() {
        return Ok(None);
    }
    by_places.bound.clone_from(&verdict.bound);
    by_places.warnings.push(
        "the colours are not those of the vertices (`color`); only where things are drawn was judged, which is what \
         this exercise asks, and the pictures show distances"
            .to_owned(),
    );
    Ok(Some((by_places, evidence)))
}

/// From this support by the source on a mistake counts that the picture leaves open.
pub(crate) const SURE: f32 = 0.95;

/// What pictures leave open, and the source tells: which of two names, and what looks right because it is another right way.
fn by_the_source(verdict: &mut Verdict, source: &Source, model: Model) {
    // A diffuse term without its cosine is light from everywhere, and so is ambient light alone.
    let flat = "diffuse-without-cosine";
    let missing = "diffuse-missing";
    if let Some(found) = verdict.mistakes.iter_mut().find(|found| found.id == flat)
        && source.looks_like(missing, model) > source.looks_like(flat, model)
        && let Some(other) = bank::of(model).find(|mistake| mistake.id == missing)
    {
        let other = FoundMistake::of_bank(other, found.share_explained);
        *found = FoundMistake { or: vec![flat.to_owned()], ..other };
        verdict.summary = found.name.clone();
    }
    // The product of diffuse and specular light is specular light weighted by the cosine.
    let weighted = verdict.peculiarities.iter().any(|p| p.id == "specular-cosine-weighted");
    let product = "terms-multiplied";
    if verdict.verdict == Outcome::Correct
        && weighted
        && source.looks_like(product, model) > SURE
        && let Some(mistake) = bank::of(model).find(|mistake| mistake.id == product)
    {
        // The pictures are those of a right answer: only the source shows it.
        let found = FoundMistake::of_bank(mistake, 0.0);
        verdict.verdict = Outcome::Wrong;
        verdict.score = 0.5;
        verdict.summary = found.name.clone();
        verdict.mistakes.push(found);
    }
}

/// Of ambient, diffuse and specular: whether the vertex shader hands it over and the fragment shader lets it lie.
fn in_vain(fragment: &ReadStage<'_>) -> [bool; 3] {
    let unused = |word: &str| {
        let inputs = fragment.checked.interface.inputs.iter();
        inputs.filter(|input| !input.is_used).any(|input| input.name.to_ascii_lowercase().contains(word))
    };
    ["amb", "diff", "spec"].map(unused)
}

/// A mistake that only the source shows; `sentence` says how to mend it there.
fn in_source(id: &str, sentence: String, model: Model) -> Option<FoundMistake> {
    let mistake = bank::of(model).find(|mistake| mistake.id == id)?;
    Some(FoundMistake { mend: sentence, ..FoundMistake::of_bank(mistake, 0.0) })
}

/// What the lab's own solutions do passes, and is said all the same.
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
    verdict.summary = "right as the lab's own solution is".to_owned();
    verdict.score = 1.0;
}

/// Compiles and links, unless our own reader refuses one of the two for its size or depth: drivers have no such limits, and
/// crash in our process.
pub(crate) fn compile(gl: &Gl, vertex: &ReadStage<'_>, fragment: &ReadStage<'_>) -> Result<UserProgram, BrokenProgram> {
    if vertex.refusal().is_some() || fragment.refusal().is_some() {
        let log = |stage: &ReadStage<'_>| stage.refusal().map(|problem| problem.message.clone());
        return Err(BrokenProgram { vertex_log: log(vertex), fragment_log: log(fragment), ..BrokenProgram::default() });
    }
    let program = UserProgram::new(gl, &vertex.translated.text, &fragment.translated.text)?;
    // Where the translation mended what every compiler refuses, the student's own text tells.
    let refused = |stage: &ReadStage<'_>| stage.problems().any(|problem| problem.severity == Severity::Error);
    if refused(vertex) || refused(fragment) {
        UserProgram::new(gl, &vertex.text.text, &fragment.text.text)?;
    }
    // This driver may be more lenient than all others: what the version does not have is wrong in any case.
    let missing = |stage: &ReadStage<'_>| {
        let is_missing = |p: &Problem| p.severity == Severity::Error && NOT_IN_VERSION.contains(&p.code);
        stage.problems().any(is_missing).then(String::new)
    };
    match (missing(vertex), missing(fragment)) {
        (None, None) => Ok(program),
        (vertex_log, fragment_log) => Err(BrokenProgram { vertex_log, fragment_log, ..BrokenProgram::default() }),
    }
}

/// Problems that Mesa does not see: `texture2D` in `#version 300 es` (GLSL ES 3.00, section 8.8 has no such function; the
/// reference compiler and browsers refuse it).
const NOT_IN_VERSION: [&str; 1] = ["old-function"];
/// A varying that is read and that the vertex shader does not have: the specification has it refused, and not every driver does.
fn does_not_link(exercise: &str, vertex: &ReadStage<'_>, fragment: &ReadStage<'_>) -> Option<Verdict> {
    let problems = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
    let refused = |p: &&Problem| p.severity == Severity::Error && p.code == "not-given";
    let messages: Vec<CompilerMessage> =
        problems.iter().filter(refused).take(MOST_MESSAGES).map(|p| fragment.message(p)).collect();
    let first = messages.first()?;
    let mut verdict = Verdict::new(exercise, Outcome::DoesNotCompile, "");
    verdict.summary = match first.line {
        Some(line) => format!("{}:{line}: {}", first.file, first.text),
        None => format!("{}: {}", first.file, first.text),
    };
    verdict.messages = messages;
    Some(verdict)
}

/// What the driver says, at the student's lines; what our own reader found comes first where it is on the same line or where
/// the driver names none, for it is said in plain words.
pub(crate) fn compiler_messages(
    broken: &BrokenProgram,
    vertex: &ReadStage<'_>,
    fragment: &ReadStage<'_>,
) -> Vec<CompilerMessage> {
    let mut told = Vec::new();
    for (stage, log) in [(vertex, &broken.vertex_log), (fragment, &broken.fragment_log)] {
        let Some(log) = log else { continue };
        if let Some(refusal) = stage.refusal().filter(|refusal| refusal.limit != Some(Limit::SyntaxErrors)) {
            // What else is wrong may follow from it.
            told.push(stage.message(refusal));
            continue;
        }
        let own: Vec<CompilerMessage> =
            stage.problems().filter(|p| p.severity == Severity::Error).map(|p| stage.message(p)).collect();
        if own.is_empty() {
            let messages = messages::to_messages(log, stage.text, stage.translated.first_line);
            told.extend(messages.into_iter().take(MOST_MESSAGES).map(of_driver));
        } else {
            told.extend(own.into_iter().take(MOST_MESSAGES));
        }
    }
    if let Some(log) = &broken.link_log {
        let own: Vec<CompilerMessage> = gonio_glsl::check_pair(&vertex.checked, &fragment.checked)
            .iter()
            .filter(|p| p.severity == Severity::Error)
            .map(|p| fragment.message(p))
            .collect();
        if own.is_empty() {
            let messages = messages::link_messages(log, vertex.text, fragment.text);
            told.extend(messages.into_iter().take(MOST_MESSAGES).map(of_driver));
        } else {
            told.extend(own.into_iter().take(MOST_MESSAGES));
        }
    }
    told
}

fn of_driver(message: Message) -> CompilerMessage {
    CompilerMessage {
        file: message.file,
        line: message.line,
        column: message.column,
        text: message.text,
        quoted: message.quoted,
        explanation: message.explanation,
    }
}

fn first_message(messages: &[CompilerMessage], broken: &BrokenProgram) -> String {
    match messages.first() {
        Some(CompilerMessage { file, line: Some(line), text, .. }) => format!("{file}:{line}: {text}"),
        Some(message) => format!("{}: {}", message.file, message.text),
        None => broken.to_string(),
    }
}

/// What this driver takes and others may not.
fn strictness(vertex: &ReadStage<'_>, fragment: &ReadStage<'_>) -> Vec<String> {
    let said = |stage: &ReadStage<'_>, problem: &Problem| {
        let (file, line, _) = stage.text.place(problem.span.line, problem.span.column);
        format!("{file}:{line}: {}; other compilers may refuse it", problem.message)
    };
    let mut warnings: Vec<String> = Vec::new();
    for stage in [vertex, fragment] {
        warnings.extend(stage.problems().filter(|p| p.severity != Severity::Hint).map(|p| said(stage, p)));
    }
    let pair = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
    warnings.extend(pair.iter().filter(|p| p.severity != Severity::Hint).map(|p| said(fragment, p)));
    warnings.truncate(MOST_MESSAGES);
    warnings
}
