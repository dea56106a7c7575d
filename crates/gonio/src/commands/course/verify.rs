//! `gonio course verify`: how well the checker judges the exercises of a course.

use super::folder;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, values};
use crate::report::Reporter;
use crate::terminal::{Style, TerminalPage};
use clap::Args;
use gonio_check::verdict::Outcome;
use gonio_course::course::CourseExercise;
use gonio_course::verify::{Verification, VerifyError, VerifyOptions, verify};
use gonio_course::{Course, CourseFile};
use gonio_gl::HeadlessContext;
use std::path::PathBuf;

/// Measure how well the checker judges the exercises of a course.
#[derive(Args, Debug)]
#[command(after_long_help = "\
The reference has to be right, and the files to start from wrong. Then mistakes are made in the reference, one at a time: another \
operator, argument, constant or input. Those that a person would see, in scenes other than the checker's, have to be called wrong; the \
report counts how many have a name and the right line. Last, the reference is written in other ways (names, order, layout, functions), which \
have to be right. Mistakes of mistakes.toml have to be named.

Examples:
  gonio course verify graphics
  gonio course verify graphics rim-light --mutants 200
  gonio course verify --json

Exit codes: 0 every goal is reached (85 % of the mistakes are called wrong, or --least; no false alarm), 1 one is not, 2 error.")]
pub struct VerifyArgs {
    /// The course's folder, by default the one around the current folder; or an exercise of that one.
    #[arg(value_name = "FOLDER")]
    pub folder: Option<PathBuf>,
    /// Exercise, by its id or folder; by default all.
    #[arg(value_name = "EXERCISE")]
    pub exercise: Option<String>,
    /// Most mistakes to make in a reference.
    #[arg(long, value_name = "N", default_value_t = 80, value_parser = clap::value_parser!(u32).range(1..=10_000),
          help_heading = "Check options")]
    pub mutants: u32,
    /// Share of the visible mistakes that have to be called wrong, from 0 to 1.
    #[arg(long, value_name = "SHARE", default_value = "0.85", value_parser = values::not_negative, help_heading = "Check options")]
    pub least: f64,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &VerifyArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let (_, course, word) = course_and_exercise(args)?;
    let chosen: Vec<&CourseExercise> = match &word {
        Some(word) => vec![find(&course, word)?],
        None => course.exercises.iter().filter(|one| one.folder.is_some()).collect(),
    };
    let context = HeadlessContext::new().map_err(CliError::from)?;
    let options = VerifyOptions { most_mutants: args.mutants as usize, least_found: args.least };
    let mut found = Vec::new();
    for (done, one) in chosen.iter().enumerate() {
        let progress = reporter.progress("verifying");
        let all = chosen.len() as f64;
        let measured = verify(context.gl(), one, &options, |share| progress.set((done as f64 + share) / all));
        drop(progress);
        found.push(measured.map_err(|error| match error {
            VerifyError::NoReference => CliError::new(format!(
                "{} has no reference.vert and reference.frag, without which nothing can be measured",
                one.exercise.id
            )),
            VerifyError::Gl(error) => error.into(),
        })?);
    }
    if reporter.json() {
        reporter.report(&found)?;
    } else {
        reporter.text(&page(&found, args))?;
    }
    // The process ends next, and the system frees it faster.
    std::mem::forget(context);
    Ok(if found.iter().all(|one| one.is_good) { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

/// The course, and the exercise that is asked for: `verify`, `verify FOLDER`, `verify FOLDER EX`, and `verify EX` within a course.
fn course_and_exercise(args: &VerifyArgs) -> Result<(Vec<CourseFile>, Course, Option<String>), CliError> {
    let around = || folder::around_here();
    let (folder, word) = match (&args.folder, &args.exercise) {
        (Some(folder), word) if folder.join(gonio_course::course::COURSE_FILE).is_file() || word.is_some() => {
            (folder.clone(), word.clone())
        }
        (Some(word), _) => match around() {
            Some(folder) => (folder, Some(word.to_string_lossy().into_owned())),
            None => (word.clone(), None),
        },
        (None, _) => (around().unwrap_or_else(|| PathBuf::from(".")), None),
    };
    let (files, course) = folder::read(&folder)?;
    Ok((files, course, word))
}

/// An exercise of a course.
pub(super) fn find<'a>(course: &'a Course, word: &str) -> Result<&'a CourseExercise, CliError> {
    course.find(word).ok_or_else(|| {
        let ids: Vec<&str> = course.exercises.iter().map(|one| one.exercise.id.as_str()).collect();
        CliError::new(format!("the course has no exercise `{word}`; its exercises are {}", ids.join(", ")))
    })
}

fn page(found: &[Verification], args: &VerifyArgs) -> TerminalPage {
    let (bold, green, red, dim) = (Style::Bold, Style::Green, Style::Red, Style::Dim);
    let mut page = TerminalPage::new();
    for one in found {
        let goal = |is_good: bool| if is_good { (green, "good") } else { (red, "bad") };
        page.line(format_args!("{bold}{}{bold:#}", one.exercise));
        let mut row = |what: &str, is_good: bool, number: String| {
            let (style, word) = goal(is_good);
            page.line(format_args!("  {style}{word:<4}{style:#}  {what:<34} {number}"));
        };
        row("the reference is right", one.reference == Outcome::Correct, word(one.reference).to_owned());
        row("the files to start from are not", one.start != Outcome::Correct, word(one.start).to_owned());
        let percent = |part: usize, all: usize| {
            format!("{part} of {all} ({:.0} %)", (100.0 * part as f64 / all.max(1) as f64).floor())
        };
        row("mistakes called wrong", one.share_found() >= args.least, percent(one.called_wrong, one.visible));
        if !one.own_mistakes.is_empty() {
            let named = one.own_mistakes.iter().filter(|mistake| mistake.is_named).count();
            row(
                "mistakes of mistakes.toml named",
                named == one.own_mistakes.len(),
                percent(named, one.own_mistakes.len()),
            );
        }
        let right = one.rewrites - one.false_alarms.len();
        row("rewrites called right", one.false_alarms.is_empty(), percent(right, one.rewrites));
        page.line(format_args!(
            "        {:<34} {}",
            "of those called wrong: with a name",
            percent(one.named, one.called_wrong)
        ));
        page.line(format_args!(
            "        {:<34} {}",
            "with a line, and the right one",
            percent(one.right_line, one.called_wrong)
        ));
        let unseen = one.mutants - one.visible;
        page.line(format_args!("        {dim}{:<34} {unseen} of {}{dim:#}", "mistakes that nobody sees", one.mutants));
        if one.reference != Outcome::Correct {
            page.line(format_args!("  {red}reference{red:#}: {}", one.reference_summary));
        }
        for missed in &one.missed {
            page.line(format_args!(
                "  {red}missed{red:#}: {}:{}: `{}` instead of `{}` ({})",
                missed.file,
                missed.line,
                missed.after.trim(),
                missed.before.trim(),
                word(missed.verdict)
            ));
        }
        for mistake in one.own_mistakes.iter().filter(|mistake| !mistake.is_named) {
            page.line(format_args!("  {red}not named{red:#}: {}", mistake.id));
        }
        for alarm in &one.false_alarms {
            page.line(format_args!(
                "  {red}false alarm{red:#}: {} ({}): {}",
                alarm.rewrite,
                word(alarm.verdict),
                alarm.summary
            ));
        }
        for name in &one.unused {
            page.line(format_args!("  {dim}not used and not handed out: {name}{dim:#}"));
        }
        page.blank();
    }
    page
}

fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Correct => "correct",
        Outcome::Wrong => "wrong",
        Outcome::DoesNotCompile => "does not compile",
        Outcome::Unsure => "unsure",
    }
}
