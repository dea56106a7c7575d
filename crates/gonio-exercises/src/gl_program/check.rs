//! Checks a GL program: right, or wrong with the mistakes that explain it.
//!
//! A mistake is named only if the picture is right without it: each suspect comes with the corrected program, which is
//! executed. If no single correction makes the picture right, combinations are tried, the most promising first.

use super::compare::{ENOUGH, Judge};
use super::findings::{GlProgramFindings, GlProgramMistake, GlProgramWarning, errors, warnings};
use super::names::name_of;
use super::program::GlProgram;
use super::suspects::Suspect;
use gonio_check::verdict::Outcome;
use gonio_gl::trace::Severity;
use gonio_gl::{Gl, GlError};
use gonio_language::tr;
use gonio_render::gl_program::{GlProgramFailure, GlProgramFiles, GlProgramImage, GlProgramRun, Step};
use gonio_render::user_program::is_embedded;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

const START_VERTEX: &str = include_str!("../../../../exercises/ex11-texture-unit/start.vert");
const START_FRAGMENT: &str = include_str!("../../../../exercises/ex11-texture-unit/start.frag");
const REFERENCE: &str = include_str!("../../../../exercises/ex11-texture-unit/host/reference.txt");
/// Maximum number of mistakes that are searched for in one program.
const MOST_MISTAKES: usize = 3;
/// Maximum number of pictures that are drawn for one program.
const MOST_PICTURES: usize = 180;
/// Number of suspects of each round that are followed further.
const FOLLOWED: usize = 4;
/// An increase of the share of right pixels that does not count as progress.
const LITTLE: f64 = 1e-4;

/// Checks a GL program's text. `files` are the shaders and images that it may use; the reference reads the same files, such
/// as `start.vert`, `start.frag` and `checker.png`.
///
/// # Errors
/// OpenGL fails, or one of these files is missing.
pub fn check(gl: &Gl, text: &str, file_name: &str, files: &GlProgramFiles) -> Result<GlProgramFindings, GlError> {
    match GlProgram::parse(text, file_name) {
        Ok(program) => check_program(gl, &program, files),
        Err(errors) => Ok(GlProgramFindings::broken(file_name, errors)),
    }
}

/// Checks a file's bytes.
pub fn check_bytes(
    gl: &Gl,
    bytes: &[u8],
    file_name: &str,
    files: &GlProgramFiles,
) -> Result<GlProgramFindings, GlError> {
    match GlProgram::parse_bytes(bytes, file_name) {
        Ok(program) => check_program(gl, &program, files),
        Err(errors) => Ok(GlProgramFindings::broken(file_name, errors)),
    }
}

/// The exercise's own program, which is right.
pub fn reference() -> Result<GlProgram, GlError> {
    GlProgram::parse(REFERENCE, "reference.txt").map_err(|errors| {
        let first = errors.first().map_or(String::new(), ToString::to_string);
        GlError::new(tr!("check-gl-cannot-read-the-exercise-s-own", first = first))
    })
}

/// The images that GL programs may use, and their folder below `assets`.
pub const IMAGES: [&str; 3] = ["checker.png", "planks.png", "tiles.png"];
/// See [`IMAGES`].
pub const IMAGE_FOLDER: &str = "models/textures/";

/// The exercise's shaders, and the images that are part of gonio: none on the web, where they are fetched.
pub fn exercise_files() -> GlProgramFiles {
    let mut files = GlProgramFiles::default();
    files.shaders.insert("start.vert".to_owned(), START_VERTEX.to_owned());
    files.shaders.insert("start.frag".to_owned(), START_FRAGMENT.to_owned());
    for name in IMAGES {
        if let Some(image) = GlProgramImage::built_in(name) {
            files.images.insert(name.to_owned(), Arc::new(image));
        }
    }
    files
}

/// The first line of the exercise's shaders in OpenGL ES, which WebGL2 uses.
const ES_VERSION: &str = "#version 300 es";

/// The same files for the context that draws: in OpenGL ES, `#version 330 core` becomes `#version 300 es`, and the line
/// after it begins with the precisions that OpenGL ES needs. Lines keep their numbers.
pub fn for_context<'a>(gl: &Gl, files: &'a GlProgramFiles) -> Cow<'a, GlProgramFiles> {
    if !is_embedded(gl) {
        return Cow::Borrowed(files);
    }
    let mut files = files.clone();
    for source in files.shaders.values_mut() {
        *source = embedded(source);
    }
    Cow::Owned(files)
}

fn embedded(source: &str) -> String {
    let mut lines = source.lines();
    match lines.next() {
        Some(first) if first.starts_with("#version") && !first.contains("es") => {
            let rest: Vec<&str> = lines.collect();
            format!("{ES_VERSION}\nprecision highp float; precision highp int; {}\n", rest.join("\n"))
        }
        _ => source.to_owned(),
    }
}

/// Checks a GL program that was read.
pub fn check_program(gl: &Gl, program: &GlProgram, files: &GlProgramFiles) -> Result<GlProgramFindings, GlError> {
    let reference = reference()?;
    let files = &*for_context(gl, files);
    let mut judge = Judge::new(gl, files, &reference.steps);
    let run = match judge.run(&program.steps, true) {
        Ok(run) => run,
        Err(GlProgramFailure::Driver(error)) => return Err(error),
        Err(failure) => {
            return Ok(GlProgramFindings::broken(&program.file, errors(&failure, program, files)));
        }
    };
    let share_right = judge.share_right(&run)?;
    let right = share_right >= ENOUGH;
    let found = if right { Vec::new() } else { search(&mut judge, &program.steps, &run, share_right)? };
    let mut mistakes: Vec<GlProgramMistake> = found.iter().filter_map(|suspect| mistake(program, suspect)).collect();
    mistakes.sort_by_key(|mistake| mistake.line);
    let warnings = warnings(program, &run, right);
    Ok(GlProgramFindings {
        file: program.file.clone(),
        verdict: if right { Outcome::Correct } else { Outcome::Wrong },
        summary: summary(right, &mistakes, &run, &warnings),
        mistakes,
        findings: run.findings.clone(),
        errors: Vec::new(),
        refused: run.errors.clone(),
        warnings,
        share_right,
        reference: judge.picture(None)?.to_vec(),
        run: Some(run),
    })
}

fn mistake(program: &GlProgram, suspect: &Suspect) -> Option<GlProgramMistake> {
    let quoted = program.quoted(suspect.line).unwrap_or_default();
    Some(GlProgramMistake::new(name_of(suspect.id)?, &suspect.message, &suspect.fix, suspect.line, quoted))
}

fn summary(right: bool, mistakes: &[GlProgramMistake], run: &GlProgramRun, warnings: &[GlProgramWarning]) -> String {
    if right {
        return match warnings.len() {
            0 => tr!("check-gl-the-picture-is-right").to_owned(),
            1 => tr!("check-gl-the-picture-is-right-but", text = warnings[0].text),
            many => tr!("check-gl-the-picture-is-right-and-there", many = many),
        };
    }
    let named: Vec<String> =
        mistakes.iter().map(|m| tr!("check-gl-line-of-mistake", line = m.line, name = m.name)).collect();
    match (named.is_empty(), run.errors.first()) {
        (false, _) => named.join("; "),
        (true, Some(error)) => {
            tr!("check-gl-unexplained-with-rejected-call", error = error.to_string())
        }
        (true, None) => tr!("check-gl-unexplained").to_owned(),
    }
}

/// A partly corrected program.
struct Attempt {
    corrected: Vec<Suspect>,
    steps: Vec<Step>,
    run: GlProgramRun,
    /// Rejected calls, and findings that cannot be intended.
    complaints: BTreeSet<String>,
    /// Number of complaints that the last fix has ended; it may have revealed others.
    ended: usize,
    share: f64,
}

impl Attempt {
    fn new(corrected: Vec<Suspect>, steps: Vec<Step>, run: GlProgramRun, share: f64) -> Self {
        let errors = run.findings.iter().filter(|finding| finding.severity == Severity::Error);
        let refused = run.errors.iter().map(|error| format!("{} {}", error.line, error.call));
        let complaints = errors.map(|finding| finding.rule.name().to_owned()).chain(refused).collect();
        Attempt { corrected, steps, run, complaints, ended: 0, share }
    }

    /// Whether it is closer to the solution. One mistake may hide another: replacing a complaint by another one counts.
    fn is_closer_than(&mut self, before: &Attempt) -> bool {
        self.ended = before.complaints.difference(&self.complaints).count();
        self.ended > 0 || self.share > before.share + LITTLE
    }
}

/// Mistakes that together explain the picture; empty if nothing explains it.
fn search(judge: &mut Judge<'_>, steps: &[Step], run: &GlProgramRun, share: f64) -> Result<Vec<Suspect>, GlError> {
    let mut round = vec![Attempt::new(Vec::new(), steps.to_vec(), run.clone(), share)];
    for _ in 0..MOST_MISTAKES {
        let mut next: Vec<Attempt> = Vec::new();
        for before in &round {
            let suspects = judge.case(&before.steps, &before.run).suspects();
            for suspect in suspects {
                if judge.drawn >= MOST_PICTURES {
                    return Ok(Vec::new());
                }
                if before.corrected.iter().any(|known| known.id == suspect.id && known.line == suspect.line) {
                    continue;
                }
                let run = match judge.run(&suspect.corrected, false) {
                    Ok(run) => run,
                    Err(GlProgramFailure::Driver(error)) => return Err(error),
                    Err(_) => continue,
                };
                let share = judge.share_right(&run)?;
                let steps = suspect.corrected.clone();
                let corrected = before.corrected.iter().cloned().chain([suspect]).collect();
                let mut attempt = Attempt::new(corrected, steps, run, share);
                if share >= ENOUGH {
                    return Ok(attempt.corrected);
                }
                if attempt.is_closer_than(before) {
                    next.push(attempt);
                }
            }
        }
        next.sort_by(|a, b| {
            let complaints = a.complaints.len().cmp(&b.complaints.len());
            complaints.then(b.ended.cmp(&a.ended)).then(b.share.total_cmp(&a.share))
        });
        round = distinct(next);
    }
    Ok(Vec::new())
}

/// The most promising attempts, each state at most twice.
fn distinct(attempts: Vec<Attempt>) -> Vec<Attempt> {
    let mut seen: BTreeMap<(BTreeSet<String>, u64), usize> = BTreeMap::new();
    let mut kept: Vec<Attempt> = Vec::new();
    for attempt in attempts {
        let times = seen.entry((attempt.complaints.clone(), attempt.share.to_bits())).or_default();
        *times += 1;
        if *times <= 2 && kept.len() < FOLLOWED {
            kept.push(attempt);
        }
    }
    kept
}
