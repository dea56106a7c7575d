//! How well the checker judges an exercise: its reference has to be right, what students start from wrong; mistakes made in the
//! reference have to be found, and the reference written in other ways has to be right.

mod mutation;
mod rewrite;
mod scenes;
mod source;

pub use mutation::{Mutant, mutants, spread};
pub use rewrite::{Rewrite, RewriteKind, rewrites};

use crate::course::{CourseExercise, REFERENCE_FILES, START_FILES};
use gonio_check::CheckOptions;
use gonio_check::WRONG_VALUE;
use gonio_check::feedback::Feedback;
use gonio_check::picture_judge::{JudgePictures, PictureJudge};
use gonio_check::roles::NamesFile;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_exercises::{Checker, check};
use gonio_gl::{Gl, GlError};
use gonio_glsl::Stage;
use serde::Serialize;

/// Settings of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerifyOptions {
    /// Most mutants; more are left out, evenly.
    pub most_mutants: usize,
    /// The least share of visible mutants that have to be called wrong.
    pub least_found: f64,
}

impl Default for VerifyOptions {
    fn default() -> Self {
        VerifyOptions { most_mutants: 80, least_found: 0.85 }
    }
}

/// A mutant that was not called wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MissedMutant {
    /// The file.
    pub file: &'static str,
    /// The line, from 1.
    pub line: u32,
    /// The text that was replaced.
    pub before: String,
    /// The text in its place.
    pub after: String,
    /// The outcome.
    pub verdict: Outcome,
}

/// A mistake of the teacher's own list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OwnMistakeCheck {
    /// Its id.
    pub id: String,
    /// Whether it is named, alone or among those that no picture tells from it.
    pub is_named: bool,
    /// Whether the place in the verdict is a line that the mistake changes.
    pub has_line: bool,
}

/// A right program that was not called right.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FalseAlarm {
    /// The rewrite.
    pub rewrite: String,
    /// The outcome.
    pub verdict: Outcome,
    /// The verdict in one sentence.
    pub summary: String,
}

/// The measurement of one exercise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verification {
    /// The exercise's id.
    pub exercise: String,
    /// The outcome for the reference.
    pub reference: Outcome,
    /// The verdict on the reference in one sentence.
    pub reference_summary: String,
    /// The outcome for the files that students start from.
    pub start: Outcome,
    /// Mutants that were made.
    pub mutants: usize,
    /// Those that compile and that a person would see.
    pub visible: usize,
    /// Visible ones that were called wrong.
    pub called_wrong: usize,
    /// Of those: with a mistake that has a name in the catalogue or in the exercise.
    pub named: usize,
    /// Of those called wrong: with a line.
    pub with_line: usize,
    /// Of those with a line: with that of the mutant.
    pub right_line: usize,
    /// Visible ones that were not called wrong.
    pub missed: Vec<MissedMutant>,
    /// The teacher's own mistakes.
    pub own_mistakes: Vec<OwnMistakeCheck>,
    /// Rewrites that draw the same pictures as the reference.
    pub rewrites: usize,
    /// Rewrites that were not called right.
    pub false_alarms: Vec<FalseAlarm>,
    /// Files of the folder that are neither used nor handed out.
    pub unused: Vec<String>,
    /// Whether every goal is reached.
    pub is_good: bool,
}

impl Verification {
    /// The share of visible mutants that were called wrong; 1 without any.
    #[must_use]
    pub fn share_found(&self) -> f64 {
        if self.visible == 0 { 1.0 } else { self.called_wrong as f64 / self.visible as f64 }
    }
}

/// The reason why an exercise cannot be measured.
#[derive(Debug)]
pub enum VerifyError {
    /// It has no reference with source.
    NoReference,
    /// The driver failed, or the reference does not compile.
    Gl(GlError),
}

impl From<GlError> for VerifyError {
    fn from(error: GlError) -> Self {
        VerifyError::Gl(error)
    }
}

struct Measuring<'a> {
    checker: Checker,
    of: &'a CourseExercise,
}

impl Measuring<'_> {
    fn verdict(&mut self, names: [&str; 2], shaders: &[String; 2]) -> Result<Verdict, GlError> {
        let files = names.iter().zip(shaders).map(|(name, text)| SourceFile::new(*name, text.as_bytes())).collect();
        // The whole verdict, whatever students see of it.
        let checked = check(&mut self.checker, &self.of.exercise, files, &CheckOptions::default(), Feedback::Line)?;
        Ok(checked.0)
    }
}

/// Measures an exercise. `progress` is called with the share that is done.
///
/// # Errors
/// The exercise has no reference, or the driver failed.
pub fn verify(
    gl: &Gl,
    of: &CourseExercise,
    options: &VerifyOptions,
    progress: impl Fn(f64),
) -> Result<Verification, VerifyError> {
    let reference = of.reference.as_ref().ok_or(VerifyError::NoReference)?;
    let mut measuring = Measuring { checker: Checker::new(gl), of };
    let judged = match (of.exercise.picture_judge(), of.exercise.task()) {
        (Some(judge), _) => judge.scenes.all[..judge.scenes.whole].to_vec(),
        (None, Some(task)) => {
            let (scenes, [whole, _]) = task.test_scenes();
            scenes.into_iter().take(whole).collect()
        }
        (None, None) => return Err(VerifyError::NoReference),
    };
    let bench = PictureJudge {
        scenes: scenes::own_scenes(&judged),
        names: of.exercise.picture_judge().map_or_else(NamesFile::default, |judge| judge.names.clone()),
        reference: JudgePictures::Shaders(reference.clone()),
        mistakes: Vec::new(),
    };
    let testbench = bench.testbench(gl)?;
    let right = bench.draw(&testbench, gl, reference)?;
    let count = bench.scenes.all.len();

    let of_reference = measuring.verdict(REFERENCE_FILES, reference)?;
    let start = START_FILES.map(|name| of.exercise.file(name).unwrap_or_default().to_owned());
    let of_start = measuring.verdict(START_FILES, &start)?;
    let mut found = Verification {
        exercise: of.exercise.id.clone(),
        reference: of_reference.verdict,
        reference_summary: of_reference.summary,
        start: of_start.verdict,
        mutants: 0,
        visible: 0,
        called_wrong: 0,
        named: 0,
        with_line: 0,
        right_line: 0,
        missed: Vec::new(),
        own_mistakes: Vec::new(),
        rewrites: 0,
        false_alarms: Vec::new(),
        unused: of.unused.clone(),
        is_good: false,
    };
    for mistake in &of.mistakes {
        let wrong = mistake.applied(reference);
        let verdict = measuring.verdict(REFERENCE_FILES, &wrong)?;
        let named = verdict.mistakes.iter().find(|m| m.id == mistake.id || m.or.contains(&mistake.id));
        let is_changed = |file: &str, line: u32| {
            let at = REFERENCE_FILES.iter().position(|name| *name == file);
            let lines = |text: &str| text.lines().nth((line as usize).saturating_sub(1)).map(str::to_owned);
            at.is_some_and(|at| lines(&wrong[at]) != lines(&reference[at]))
        };
        let place = named.and_then(|m| Some((m.file.as_deref()?, m.line?)));
        let has_line = place.is_some_and(|(file, line)| is_changed(file, line));
        found.own_mistakes.push(OwnMistakeCheck { id: mistake.id.clone(), is_named: named.is_some(), has_line });
    }
    let mutants = spread(mutants(reference), options.most_mutants);
    let rewrites = rewrites(reference, &right.bindings);
    let all = (mutants.len() + rewrites.len()).max(1) as f64;
    for (done, mutant) in mutants.iter().enumerate() {
        progress(done as f64 / all);
        found.mutants += 1;
        // One that does not compile is no mistake of understanding.
        let Ok(drawn) = bench.draw(&testbench, gl, &mutant.shaders) else { continue };
        if scenes::is_visible(&drawn.pictures, &right.pictures, count) {
            let verdict = measuring.verdict(REFERENCE_FILES, &mutant.shaders)?;
            found.add(mutant, &verdict);
        }
    }
    for (done, rewrite) in rewrites.into_iter().enumerate() {
        progress((mutants.len() + done) as f64 / all);
        // The rewrite itself may be at fault: it counts only if it draws the same.
        let Ok(drawn) = bench.draw(&testbench, gl, &rewrite.shaders) else { continue };
        if scenes::is_visible(&drawn.pictures, &right.pictures, count) {
            continue;
        }
        found.rewrites += 1;
        let verdict = measuring.verdict(REFERENCE_FILES, &rewrite.shaders)?;
        if verdict.verdict != Outcome::Correct {
            let (rewrite, summary) = (rewrite.name, verdict.summary);
            found.false_alarms.push(FalseAlarm { rewrite, verdict: verdict.verdict, summary });
        }
    }
    found.is_good = found.reference == Outcome::Correct
        && found.start != Outcome::Correct
        && found.share_found() >= options.least_found
        && found.own_mistakes.iter().all(|mistake| mistake.is_named)
        && found.false_alarms.is_empty();
    Ok(found)
}

impl Verification {
    fn add(&mut self, mutant: &Mutant, verdict: &Verdict) {
        self.visible += 1;
        let file = REFERENCE_FILES[usize::from(mutant.stage == Stage::Fragment)];
        if verdict.verdict != Outcome::Wrong {
            let (before, after) = (mutant.before.clone(), mutant.after.clone());
            self.missed.push(MissedMutant { file, line: mutant.line, before, after, verdict: verdict.verdict });
            return;
        }
        self.called_wrong += 1;
        self.named += usize::from(verdict.mistakes.iter().any(|mistake| mistake.id != WRONG_VALUE));
        let lines: Vec<(&str, u32)> =
            verdict.mistakes.iter().filter_map(|mistake| Some((mistake.file.as_deref()?, mistake.line?))).collect();
        self.with_line += usize::from(!lines.is_empty());
        self.right_line += usize::from(lines.contains(&(file, mutant.line)));
    }
}
