//! `gonio lab score`: measurements of the checker.

use super::intake::{self, ClassMember, Intake, Submissions};
use super::{child_process, exercise};
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_app::platform::desktop::child;
use gonio_check::CheckOptions;
use gonio_check::search::TASKS;
use gonio_check::verdict::Outcome as Word;
use gonio_exercises::Checker;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::report::visible;
use gonio_exercises::score::{self, Score};
use gonio_gl::HeadlessContext;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Measure the checker: the share of mistakes that it names correctly, and its false alarms.
#[derive(Args, Debug)]
#[command(after_long_help = "\
The measurement makes each mistake of the catalogue in the exercise's model, submits it and compares the verdict. Mistakes that are \
invisible in an exercise (in attenuation, if there is none) do not count.

Exit codes: 0 the goals are reached (97 % of single mistakes, 85 % of pairs, no false alarm), 1 they are not, 2 error.")]
pub struct ScoreArgs {
    /// Exercises to measure; by default all that a pair of shaders answers.
    #[arg(value_name = "EX")]
    pub exercises: Vec<String>,
    /// Pairs of mistakes per exercise.
    #[arg(long, value_name = "N", default_value_t = 40, help_heading = "Check options")]
    pub pairs: usize,
    /// Correct answers to look for false alarms in: FOLDER/EX/correct/NAME/.
    #[arg(long, value_name = "FOLDER", help_heading = "Check options")]
    pub corpus: Option<PathBuf>,
    /// End when the calling process ends and so closes stdin.
    #[arg(long, hide = true)]
    pub end_with_the_caller: bool,
    #[command(flatten)]
    pub general: GeneralOptions,
}

#[derive(Serialize, Deserialize)]
struct Row {
    #[serde(flatten)]
    score: Score,
    right_answers: usize,
    false_alarms: Vec<String>,
}

impl Row {
    fn reaches_the_goals(&self) -> bool {
        self.score.single.share() >= 0.97 && self.score.pairs.share() >= 0.85 && self.false_alarms.is_empty()
    }
}

pub fn run(args: &ScoreArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if args.end_with_the_caller {
        child_process::end_with_the_caller();
    }
    let exercises = match args.exercises.as_slice() {
        [] => TASKS.iter().map(|task| exercise(task.exercise)).collect::<Result<Vec<_>, _>>()?,
        named => named.iter().map(|word| exercise(word)).collect::<Result<Vec<_>, _>>()?,
    };
    let rows = match exercises.as_slice() {
        [one] => vec![measure(args, one)?],
        several => measure_apart(args, several, reporter)?,
    };
    if reporter.json() {
        reporter.report(&rows)?;
    } else {
        reporter.text(&TerminalPage::from_text(&table(&rows)))?;
    }
    Ok(if rows.iter().all(Row::reaches_the_goals) { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

/// Measures one exercise in this process.
fn measure(args: &ScoreArgs, exercise: &Exercise) -> Result<Row, CliError> {
    let context = HeadlessContext::new()?;
    let mut checker = Checker::new(context.gl());
    let score = score::measure(&mut checker, exercise, args.pairs)?;
    let mut row = Row { score, right_answers: 0, false_alarms: Vec::new() };
    if let Some(corpus) = &args.corpus {
        let right = corpus.join(&exercise.id).join("correct");
        for submission in right_answers(&right, exercise)? {
            let mut submitted = submission.gather().files;
            submitted.retain(|file| !file.name.ends_with("expected.toml"));
            let (verdict, _) = gonio_exercises::check(&mut checker, exercise, submitted, &CheckOptions::default())?;
            row.right_answers += 1;
            if verdict.verdict != Word::Correct {
                row.false_alarms.push(submission.label);
            }
        }
    }
    // The process ends next, and the system frees it faster.
    std::mem::forget((checker, context));
    Ok(row)
}

/// Measures each exercise in a process of its own, as many at once as there are cores: a software driver uses them better that
/// way than by drawing small pictures with all of them.
fn measure_apart(args: &ScoreArgs, exercises: &[&Exercise], reporter: &Reporter) -> Result<Vec<Row>, CliError> {
    let program = child_process::own_program()?;
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, Result<Row, CliError>)>> = Mutex::default();
    let progress = reporter.progress("measuring");
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(exercise) = exercises.get(index) else { return };
                    let row = measure_in_child(args, exercise, &program);
                    if let Ok(mut done) = done.lock() {
                        done.push((index, row));
                        progress.set(done.len() as f64 / exercises.len() as f64);
                    }
                }
            });
        }
    });
    drop(progress);
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, row)| row).collect()
}

fn measure_in_child(args: &ScoreArgs, exercise: &Exercise, program: &Path) -> Result<Row, CliError> {
    let not_started = |error| CliError::io("gonio cannot start itself to measure", &error);
    let mut command = child::command(program).map_err(not_started)?;
    command.args(["lab", "score", &exercise.id, "--json", "--end-with-the-caller"]);
    command.args(["--pairs", &args.pairs.to_string()]);
    if let Some(corpus) = &args.corpus {
        command.arg("--corpus").arg(corpus);
    }
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(not_started)?;
    let input = child.stdin.take();
    let output = child.wait_with_output().map_err(not_started)?;
    drop(input);
    let rows = serde_json::from_slice::<Vec<Row>>(&output.stdout).unwrap_or_default();
    rows.into_iter().next().ok_or_else(|| {
        let messages = String::from_utf8_lossy(&output.stderr);
        CliError::new(format!("cannot measure {}: {}", exercise.id, messages.trim()))
    })
}

/// The submissions in a folder; none if it does not exist, because not every exercise has correct answers of its own.
fn right_answers(folder: &Path, exercise: &Exercise) -> Result<Vec<ClassMember>, CliError> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    match intake::take(&[folder.to_owned()], exercise, Submissions::Many, true)? {
        Intake::Class(class) => Ok(class.submissions),
        Intake::One(_) => Ok(Vec::new()),
    }
}

/// The measurements as a table in Markdown, as documents contain it.
fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "| exercise | single, named right | pairs, named right | right answers | false alarms |\n|---|---|---|---|---|\n",
    );
    for Row { score, right_answers, false_alarms } in rows {
        let share = |count: &gonio_exercises::score::MistakeCounts| {
            format!("{} of {} ({:.0} %)", count.named, count.visible, 100.0 * count.share())
        };
        text.push_str(&format!(
            "| {} | {} | {} | {right_answers} | {} |\n",
            score.exercise,
            share(&score.single),
            share(&score.pairs),
            false_alarms.len()
        ));
    }
    for row in rows {
        for (made, named) in row.score.single.misnamed.iter().chain(&row.score.pairs.misnamed) {
            text.push_str(&format!("\n{}: {made} was named {named}", row.score.exercise));
        }
        for name in &row.false_alarms {
            text.push_str(&format!("\n{}: {} is correct but was called wrong", row.score.exercise, visible(name)));
        }
    }
    text.trim_end().to_owned() + "\n"
}
