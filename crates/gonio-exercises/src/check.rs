//! Checks a student's files, for every kind of exercise.

use crate::baking::{self, Original, original::FetchedFiles};
use crate::buffers::{self, Expected};
use crate::cubemap;
use crate::exercise::{Exercise, ExerciseKind};
use crate::gl_program::{self, GlProgramFiles, GlProgramImage};
use crate::preview::SubmittedPair;
use crate::step::endless_loop;
use gonio_check::comparison::{Evidence, endless};
use gonio_check::feedback::Feedback;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{CompilerMessage, FoundMistake, Outcome, Verdict, join_names};
use gonio_check::{CheckOptions, ShaderChecker, ShaderExercise};
use gonio_gl::{DeferredGl, Gl, GlError};
use gonio_language::tr;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Name of the picture of the right answer, which is one of the start files.
pub const GOAL: &str = "goal.png";

/// Checks submissions, one after the other, in one context. Compiled programs are kept.
pub struct Checker {
    shaders: ShaderChecker,
    images: BTreeMap<String, Arc<GlProgramImage>>,
    fetched: FetchedFiles,
}

impl Checker {
    /// Creates a checker for this OpenGL context.
    pub fn new(gl: &Gl) -> Self {
        Self::deferred(DeferredGl::from(gl))
    }

    /// Creates a checker for an OpenGL context that may be opened later: what needs none precedes it.
    pub fn deferred(gl: DeferredGl) -> Self {
        Checker { shaders: ShaderChecker::deferred(gl), images: BTreeMap::new(), fetched: FetchedFiles::default() }
    }

    /// Adds a built-in file by its path below `assets`. Needed on the web, where no files are built in, for
    /// [`Exercise::needed_files`].
    ///
    /// # Errors
    /// An image that GL programs may use cannot be read; the reason.
    pub fn give_file(&mut self, path: &str, bytes: Vec<u8>) -> Result<(), String> {
        if let Some(name) = path.strip_prefix(gl_program::IMAGE_FOLDER) {
            let image = GlProgramImage::decode(name, &bytes).map_err(|error| format!("{name}: {error}"))?;
            self.images.insert(name.to_owned(), Arc::new(image));
        }
        self.fetched.0.insert(path.to_owned(), bytes.into());
        Ok(())
    }

    /// Returns the files that GL programs may use.
    fn host_files(&self) -> GlProgramFiles {
        let mut files = gl_program::exercise_files();
        files.images.extend(self.images.clone());
        files
    }
}

/// Checks a student's files, and returns what `feedback` shows of the verdict and its pictures. Everything that is wrong with
/// the files is a verdict. There are no pictures if the exercise hides its reference.
///
/// This is the only source of verdicts for reports and windows, so none of them can show more.
///
/// # Errors
/// Errors of the driver.
pub fn check(
    checker: &mut Checker,
    exercise: &Exercise,
    files: Vec<SourceFile>,
    options: &CheckOptions,
    feedback: Feedback,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let (mut verdict, evidence) = whole(checker, exercise, files, options, feedback)?;
    // What is hidden counts too.
    if let Some(scheme) = &exercise.points {
        let points = scheme.award(&verdict);
        verdict.score = points.earned / points.most;
        verdict.points = Some(points);
    }
    let evidence = evidence.filter(|_| exercise.shows_reference).map(|evidence| feedback.reduce_pictures(evidence));
    Ok((feedback.reduce(verdict), evidence))
}

/// The whole verdict with all pictures.
fn whole(
    checker: &mut Checker,
    exercise: &Exercise,
    files: Vec<SourceFile>,
    options: &CheckOptions,
    feedback: Feedback,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    match exercise.kind {
        ExerciseKind::Buffers => return Ok((buffers(exercise, files), None)),
        ExerciseKind::Baking => return Ok((baked(exercise, &files, &checker.fetched), None)),
        ExerciseKind::GlProgram => {
            let files_here = checker.host_files();
            return Ok((host_program(checker.shaders.gl()?, exercise, files, &files_here, feedback)?, None));
        }
        ExerciseKind::Faces if answers_with_pictures(exercise, &files) => {
            return cubemap::check(&mut checker.shaders, exercise, &files);
        }
        ExerciseKind::Shaders | ExerciseKind::Faces => {}
    }
    // Files that were handed out with the shaders are not an answer.
    let handed_out = |name: &str| {
        let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
        name == GOAL || [".md", ".svg"].iter().any(|end| name.ends_with(end)) && exercise.file(name).is_some()
    };
    let files: Vec<SourceFile> =
        files.into_iter().filter(|file| !handed_out(&file.name) && !is_given_picture(exercise, file)).collect();
    let shader_exercise = ShaderExercise {
        id: &exercise.id,
        task: exercise.task(),
        judge: exercise.picture_judge(),
        start_vertex: exercise.file("start.vert"),
        start_fragment: exercise.file("start.frag"),
    };
    let (verdict, evidence) = match feedback {
        Feedback::Fix => gonio_check::check(&mut checker.shaders, &shader_exercise, files.clone(), options),
        _ => gonio_check::check_without_fix(&mut checker.shaders, &shader_exercise, files.clone(), options),
    }?;
    Ok((with_endless_loop(verdict, exercise, files), evidence))
}

/// The verdict on a program with an endless loop, with the line of that loop.
fn with_endless_loop(mut verdict: Verdict, exercise: &Exercise, files: Vec<SourceFile>) -> Verdict {
    if verdict.summary != endless() {
        return verdict;
    }
    let pair = SubmittedPair::gather(exercise, files).ok();
    if let Some(found) = pair.and_then(|pair| endless_loop(exercise, &pair)) {
        verdict.summary = found.to_string();
        verdict.messages.push(found.message());
    }
    verdict
}

/// Whether the answer is pictures: whether there are other pictures than those handed out.
fn answers_with_pictures(exercise: &Exercise, files: &[SourceFile]) -> bool {
    let pictures = files.iter().filter(|file| cubemap::is_picture(file) && !is_given_picture(exercise, file)).count();
    // A single picture beside shaders is a texture or a screenshot.
    pictures > 1 || pictures > 0 && files.iter().all(|file| cubemap::is_picture(file) || file.name.ends_with(".md"))
}

/// Whether the file is an unchanged start file.
fn is_given_picture(exercise: &Exercise, file: &SourceFile) -> bool {
    exercise.pictures().any(|(_, bytes)| file.bytes == bytes)
}

/// The files with one of these endings; if there is none, a file that is alone.
fn answers<'a>(files: &'a [SourceFile], endings: &[&str]) -> Vec<&'a SourceFile> {
    let fits = |name: &str| {
        let name = name.to_ascii_lowercase();
        endings.iter().any(|ending| name.ends_with(ending))
    };
    let fitting: Vec<&SourceFile> = files.iter().filter(|file| fits(&file.name)).collect();
    if fitting.is_empty() && files.len() == 1 { files.iter().collect() } else { fitting }
}

/// Checks a baked model against the exercise's own.
fn baked(exercise: &Exercise, files: &[SourceFile], fetched: &FetchedFiles) -> Verdict {
    let is_own = |file: &&SourceFile| file.name.rsplit(['/', '\\']).next() != Some(GOAL);
    let files: Vec<SourceFile> = files.iter().filter(is_own).cloned().collect();
    match Original::load(exercise, fetched) {
        Ok(original) => baking::check(exercise, &files, &original),
        Err(reason) => Verdict::new(&exercise.id, Outcome::Unsure, reason),
    }
}

/// Checks a vertex buffer against the exercise's models.
fn buffers(exercise: &Exercise, files: Vec<SourceFile>) -> Verdict {
    let answers = answers(&files, &buffers::ENDINGS);
    let [answer] = answers.as_slice() else {
        let summary = match answers.len() {
            0 => tr!("check-there-is-no-buffer-among-the").to_owned(),
            count => tr!("check-there-are-buffers-among-the-files", count = count),
        };
        return Verdict::new(&exercise.id, Outcome::Unsure, summary);
    };
    let buffer = match buffers::read_buffer(&answer.name, &answer.bytes) {
        Ok(buffer) => buffer,
        Err(error) => return Verdict::new(&exercise.id, Outcome::Unsure, error.to_string()),
    };
    let models: Vec<(String, Expected)> = exercise
        .start_files()
        .filter(|(name, _)| name.ends_with(".obj"))
        .filter_map(|(name, text)| Some((name.to_owned(), Expected::from_obj(text.as_bytes()).ok()?)))
        .collect();
    let Some((model, expected)) = buffers::choose(&models, &answer.name, &buffer) else {
        let summary = tr!("check-the-buffer-resembles-none-of-the");
        return Verdict::new(&exercise.id, Outcome::Unsure, summary);
    };
    let found = buffers::compare(expected, &buffer);
    let outcome = found.verdict;
    let names: Vec<&str> = found.mistakes.iter().map(|mistake| mistake.name).collect();
    let summary = match (outcome, names.is_empty()) {
        (Outcome::Correct, _) => {
            tr!("check-all-triangles-of-are-right", count = found.shares.triangles_expected, model = model)
        }
        (_, false) => tr!("check-mistakes-of-model", names = join_names(names), model = model),
        (_, true) => tr!(
            "check-of-the-triangles-of-are-right",
            percent = format!("{:.0}", 100.0 * found.shares.all),
            model = model
        ),
    };
    let mut verdict = Verdict::new(&exercise.id, outcome, summary);
    verdict.score = if outcome == Outcome::Correct { 1.0 } else { found.shares.all.min(0.95) };
    let or: Vec<String> = found.alternatives.iter().map(|ids| ids.join(" and ")).collect();
    verdict.mistakes = found
        .mistakes
        .iter()
        .map(|mistake| {
            let known = FoundMistake::new(mistake.id, mistake.name, mistake.share_explained);
            let known = known.taught(mistake.explanation, mistake.how_to_fix, &exercise.lecture_section);
            let line = |example: &buffers::Example| u32::try_from(example.line?).ok();
            let placed = match &mistake.example {
                Some(example) => known.at(model, line(example), &example.line_text),
                None => known,
            };
            FoundMistake { or: or.clone(), ..placed }
        })
        .collect();
    verdict.warnings = found.warnings.iter().chain(&buffer.warnings).cloned().collect();
    verdict
}

/// Checks a GL program by running it; `usable` are the files that it may use.
fn host_program(
    gl: &Gl,
    exercise: &Exercise,
    files: Vec<SourceFile>,
    usable: &GlProgramFiles,
    feedback: Feedback,
) -> Result<Verdict, GlError> {
    let answers = answers(&files, &[".txt"]);
    let [answer] = answers.as_slice() else {
        let summary = match answers.len() {
            0 => tr!("check-there-is-no-gl-program-among").to_owned(),
            count => tr!("check-there-are-gl-programs-among-the", count = count),
        };
        return Ok(Verdict::new(&exercise.id, Outcome::Unsure, summary));
    };
    let found = gl_program::check_bytes(gl, &answer.bytes, &answer.name, usable)?;
    let outcome = found.verdict;
    let mut verdict = Verdict::new(&exercise.id, outcome, found.summary.clone());
    verdict.score = if outcome == Outcome::Correct { 1.0 } else { found.share_right.min(0.95) };
    verdict.mistakes = found
        .mistakes
        .into_iter()
        .map(|mistake| {
            // The fix is the text to write, which is the answer.
            let fix = if feedback == Feedback::Fix { mistake.fix } else { mistake.explanation };
            FoundMistake::new(mistake.id, mistake.name, 1.0)
                .taught(mistake.looks_like, fix, &exercise.lecture_section)
                .at(&answer.name, Some(mistake.line), mistake.quoted)
        })
        .collect();
    verdict.messages = found
        .errors
        .into_iter()
        .map(|error| CompilerMessage {
            file: answer.name.clone(),
            line: Some(error.line),
            column: Some(error.column),
            text: error.message,
            quoted: None,
            explanation: (!error.help.is_empty()).then_some(error.help),
        })
        .collect();
    let at = |line: Option<u32>| line.map_or(String::new(), |line| format!("{}:{line}: ", answer.name));
    verdict.warnings = found.warnings.into_iter().map(|w| format!("{}{}", at(w.line), w.text)).collect();
    Ok(verdict)
}
