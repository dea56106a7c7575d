//! `gonio lab score`: measurements of the checker.

use super::intake::{self, ClassMember, Intake, Submissions};
use super::{child_process, exercise};
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::output::OutputFiles;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_app::platform::desktop::child;
use gonio_check::CheckOptions;
use gonio_check::comparison::TASKS;
use gonio_check::feedback::Feedback;
use gonio_check::verdict::Outcome as Word;
use gonio_exercises::Checker;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::report::visible;
use gonio_exercises::score::{self, GeneratedScore, Score, ScoredPair};
use gonio_gl::HeadlessContext;
use gonio_submissions::GeneratedTask;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

/// Measure the checker: the share of mistakes that it names correctly, and its false alarms.
#[derive(Args, Debug)]
#[command(after_long_help = "\
The measurement makes each mistake of the catalogue in the exercise's model, submits it and compares the verdict. Mistakes that are \
invisible in an exercise (in attenuation, if there is none) do not count.

With --generated, the programs are new: a generator writes correct answers in many styles, most of them with one mistake or two, and \
checks itself that the mistakes are visible. A seed and a number give the same program everywhere. A verdict is also compared with \
that on the same program in another style, which must not differ.

Exit codes: 0 the goals are reached (97 % of single mistakes, 85 % of pairs, no false alarm; with --generated 97 % of single mistakes \
with their line, 90 % of pairs, no false alarm, no verdict that depends on the style), 1 they are not, 2 error.

Examples:
  gonio lab score
  gonio lab score --generated 200 --seed 7
  gonio lab score ex07 --generated 1 --index 12 --seed 7 --write there")]
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
    /// Check this many generated programs, in place of the catalogue's mistakes.
    #[arg(long, value_name = "N", help_heading = "Check options", conflicts_with_all = ["pairs", "corpus"])]
    pub generated: Option<u64>,
    /// Seed of the generated programs; by default a new one, which is printed.
    #[arg(long, value_name = "SEED", help_heading = "Check options", requires = "generated")]
    pub seed: Option<u64>,
    /// Number of the first generated program.
    #[arg(long, value_name = "I", default_value_t = 0, help_heading = "Check options", requires = "generated")]
    pub index: u64,
    /// Versions of each program in other styles, which must get the same verdict.
    #[arg(long, value_name = "K", default_value_t = 1, help_heading = "Check options", requires = "generated")]
    pub rewrites: usize,
    /// Write the programs with what is expected of them, FOLDER/EX/correct/NAME/ and FOLDER/EX/wrong/NAME/, and their other
    /// versions, FOLDER/EX/rewritten/NAME/.
    #[arg(long, value_name = "FOLDER", help_heading = "Check options", requires = "generated")]
    pub write: Option<PathBuf>,
    /// Write only the programs with a wrong verdict.
    #[arg(long, help_heading = "Check options", requires = "write")]
    pub failing: bool,
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
    if let Some(count) = args.generated {
        return run_generated(args, count, reporter);
    }
    let exercises = match args.exercises.as_slice() {
        [] => TASKS.iter().map(|task| exercise(task.exercise)).collect::<Result<Vec<_>, _>>()?,
        named => named.iter().map(|word| exercise(word)).collect::<Result<Vec<_>, _>>()?,
    };
    let rows = match exercises.as_slice() {
        [one] => vec![measure(args, one)?],
        several => {
            in_processes(several.len(), reporter, |index, program| measure_in_child(args, several[index], program))?
        }
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
            let (verdict, _) =
                gonio_exercises::check(&mut checker, exercise, submitted, &CheckOptions::default(), Feedback::Fix)?;
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

/// Measures each of several parts in a process of its own, as many at once as there are cores: a software driver uses them better
/// that way than by drawing small pictures with all of them.
fn in_processes<T: Send>(
    count: usize,
    reporter: &Reporter,
    part: impl Fn(usize, &Path) -> Result<T, CliError> + Sync,
) -> Result<Vec<T>, CliError> {
    let program = child_process::own_program()?;
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, Result<T, CliError>)>> = Mutex::default();
    let progress = reporter.progress("measuring");
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        return;
                    }
                    let result = part(index, &program);
                    if let Ok(mut done) = done.lock() {
                        done.push((index, result));
                        progress.set(done.len() as f64 / count as f64);
                    }
                }
            });
        }
    });
    drop(progress);
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

fn measure_in_child(args: &ScoreArgs, exercise: &Exercise, program: &Path) -> Result<Row, CliError> {
    let mut words = vec![exercise.id.clone(), "--pairs".into(), args.pairs.to_string()];
    if let Some(corpus) = &args.corpus {
        words.extend(["--corpus".into(), corpus.display().to_string()]);
    }
    let (output, messages) = child_output(program, &words)?;
    let rows = serde_json::from_slice::<Vec<Row>>(&output).unwrap_or_default();
    rows.into_iter().next().ok_or_else(|| CliError::new(format!("cannot measure {}: {messages}", exercise.id)))
}

/// Runs this command again with other arguments; returns what it prints as JSON, and its messages.
fn child_output(program: &Path, words: &[String]) -> Result<(Vec<u8>, String), CliError> {
    let not_started = |error| CliError::io("gonio cannot start itself to measure", &error);
    let mut command = child::command(program).map_err(not_started)?;
    command.args(["lab", "score", "--json", "--end-with-the-caller"]).args(words);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(not_started)?;
    let input = child.stdin.take();
    let output = child.wait_with_output().map_err(not_started)?;
    drop(input);
    Ok((output.stdout, String::from_utf8_lossy(&output.stderr).trim().to_owned()))
}

/// The result with generated programs.
#[derive(Serialize, Deserialize)]
struct GeneratedReport {
    seed: u64,
    scores: Vec<GeneratedScore>,
    pairs: Vec<ScoredPair>,
}

/// Programs that one process checks: its start is a small part of its time, and a crash loses few of them.
const PROGRAMS_PER_PROCESS: u64 = 20;

fn run_generated(args: &ScoreArgs, count: u64, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let tasks = args.exercises.iter().map(|word| generated_task(word)).collect::<Result<Vec<_>, _>>()?;
    let clock = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos() as u64);
    let seed = args.seed.unwrap_or_else(clock);
    let pairs = if args.end_with_the_caller || count == 1 {
        score_generated_here(args, &tasks, seed, count)?
    } else {
        let parts = count.div_ceil(PROGRAMS_PER_PROCESS) as usize;
        let scored = in_processes(parts, reporter, |part, program| {
            let first = part as u64 * PROGRAMS_PER_PROCESS;
            let some = PROGRAMS_PER_PROCESS.min(count - first);
            let [first, some, seed, rewrites] =
                [args.index.saturating_add(first), some, seed, args.rewrites as u64].map(|number| number.to_string());
            let mut words: Vec<String> = tasks.iter().map(|task| task.exercise().to_owned()).collect();
            let options =
                [("--generated", some), ("--index", first.clone()), ("--seed", seed), ("--rewrites", rewrites)];
            words.extend(options.into_iter().flat_map(|(option, value)| [option.to_owned(), value]));
            let (output, messages) = child_output(program, &words)?;
            serde_json::from_slice::<GeneratedReport>(&output)
                .map(|report| report.pairs)
                .map_err(|_| CliError::new(format!("cannot check the generated programs from {first}: {messages}")))
        })?;
        scored.concat()
    };
    if let Some(folder) = &args.write {
        let chosen = pairs.iter().filter(|pair| !args.failing || !pair.is_right());
        write_generated(folder, seed, args.rewrites, chosen)?;
    }
    let scores = GeneratedScore::of(&pairs);
    let reached = scores.last().is_none_or(GeneratedScore::reaches_the_goals);
    if reporter.json() {
        reporter.report(&GeneratedReport { seed, scores, pairs })?;
    } else {
        reporter.text(&TerminalPage::from_text(&generated_table(seed, &scores, &pairs)))?;
    }
    Ok(if reached { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

fn generated_task(word: &str) -> Result<GeneratedTask, CliError> {
    let exercise = exercise(word)?;
    GeneratedTask::find(&exercise.id).ok_or_else(|| {
        let known: Vec<&str> = GeneratedTask::ALL.iter().map(|(_, task)| task.exercise()).collect();
        CliError::new(format!("no programs are generated for {}: expected one of {}", exercise.id, known.join(", ")))
    })
}

/// Checks generated programs in this process.
fn score_generated_here(
    args: &ScoreArgs,
    tasks: &[GeneratedTask],
    seed: u64,
    count: u64,
) -> Result<Vec<ScoredPair>, CliError> {
    let context = HeadlessContext::new()?;
    let mut checker = Checker::new(context.gl());
    let mut scored = Vec::new();
    for index in (0..count).map(|number| args.index.saturating_add(number)) {
        let task = tasks.get((index % tasks.len().max(1) as u64) as usize).copied();
        let pair = gonio_submissions::generate(seed, index, task, args.rewrites).map_err(CliError::new)?;
        let known = exercise(pair.exercise)?;
        scored.push(score::score_generated(&mut checker, known, &pair).map_err(CliError::new)?);
    }
    // The process ends next, and the system frees it faster.
    std::mem::forget((checker, context));
    Ok(scored)
}

/// Generates programs again and writes them.
fn write_generated<'a>(
    folder: &Path,
    seed: u64,
    rewrites: usize,
    pairs: impl Iterator<Item = &'a ScoredPair>,
) -> Result<(), CliError> {
    let mut files = OutputFiles::new();
    for scored in pairs {
        let task = GeneratedTask::find(&scored.exercise);
        let pair = gonio_submissions::generate(seed, scored.index, task, rewrites).map_err(CliError::new)?;
        for (path, text) in pair.paths() {
            let target = folder.join(path);
            if let Some(parent) = target.parent() {
                files.make_folder(parent)?;
            }
            files.add(&target, text.as_bytes())?;
        }
    }
    files.commit()
}

/// The scores as a table in Markdown, and a line for each program with a wrong verdict.
fn generated_table(seed: u64, scores: &[GeneratedScore], pairs: &[ScoredPair]) -> String {
    let mut text = format!(
        "{} generated programs, seed {seed}\n\n| exercise | correct | false alarms | single, named | with the line | in no list, \
         found | with the line | pairs, named | with both lines | same when rewritten | fixes that pass |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
        pairs.len()
    );
    for score in scores {
        let fixes = score.fixes.map_or_else(|| "-".to_owned(), |fixes| fixes.to_string());
        text.push_str(&format!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {fixes} |\n",
            score.exercise,
            score.correct,
            score.false_alarms,
            score.single_named,
            score.single_located,
            score.unlisted_found,
            score.unlisted_located,
            score.pairs_named,
            score.pairs_located,
            score.same_when_rewritten
        ));
    }
    if let Some(all) = scores.last() {
        text.push_str(&format!(
            "\nThe outcome is right for {}. {} mistakes were left out because no picture shows them.\n",
            all.outcomes, all.invisible
        ));
    }
    for pair in pairs.iter().filter(|pair| !pair.is_right()) {
        text.push_str(&format!("\n{}", pair.complaint()));
    }
    text.trim_end().to_owned() + "\n"
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
        for made in row.score.single.unnamed.iter().chain(&row.score.pairs.unnamed) {
            text.push_str(&format!("\n{}: {made} was not named", row.score.exercise));
        }
        for name in &row.false_alarms {
            text.push_str(&format!("\n{}: {} is correct but was called wrong", row.score.exercise, visible(name)));
        }
    }
    text.trim_end().to_owned() + "\n"
}
