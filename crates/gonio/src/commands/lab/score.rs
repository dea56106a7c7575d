//! `gonio lab score`: the checker measured.

use super::{exercise, files};
use crate::cli::WordOptions;
use crate::report::{CliError, Outcome, Reporter};
use clap::Args;
use gonio_gl::HeadlessContext;
use gonio_lab::CheckOptions;
use gonio_lab::check::{Checker, TASKS};
use gonio_lab::score::{Score, of_bank};
use gonio_lab::verdict::Outcome as Word;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Measure the checker: the share of the bank's mistakes that it names right, and its false alarms.
#[derive(Args, Debug)]
#[command(after_help = "\
Each mistake of the bank is made in the exercise's model, handed in and looked for. What cannot be seen in an exercise
(attenuation, where there is none) does not count.

Exit codes: 0 the goals are reached (97 % of single mistakes, 85 % of pairs, no false alarm), 1 not, 2 error.")]
pub struct ScoreArgs {
    /// Which exercises; all that a pair of shaders answers, where none is named.
    #[arg(value_name = "EX")]
    pub exercises: Vec<String>,
    /// Pairs of mistakes of each exercise.
    #[arg(long, value_name = "N", default_value_t = 40)]
    pub pairs: usize,
    /// Right answers to look for false alarms in: FOLDER/EX/correct/NAME/.
    #[arg(long, value_name = "FOLDER")]
    pub corpus: Option<PathBuf>,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

#[derive(Serialize)]
struct Row {
    #[serde(flatten)]
    score: Score,
    right_answers: usize,
    false_alarms: Vec<String>,
}

/// Measures.
pub fn run(args: &ScoreArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let context = HeadlessContext::new()?;
    let mut checker = Checker::new(context.gl());
    let words: Vec<String> = match args.exercises.as_slice() {
        [] => TASKS.iter().map(|task| task.exercise.to_owned()).collect(),
        named => named.to_vec(),
    };
    let progress = reporter.progress("measuring");
    let mut rows = Vec::new();
    for (index, word) in words.iter().enumerate() {
        let exercise = exercise(word)?;
        let score = of_bank(&mut checker, exercise, args.pairs)?;
        let mut row = Row { score, right_answers: 0, false_alarms: Vec::new() };
        if let Some(corpus) = &args.corpus {
            let right = corpus.join(&exercise.id).join("correct");
            for submission in files::submissions(&right)?.unwrap_or_default() {
                let mut submitted = files::read(std::slice::from_ref(&submission))?;
                submitted.retain(|file| !file.name.ends_with("expected.toml"));
                let (verdict, _) = gonio_lab::check(&mut checker, exercise, submitted, &CheckOptions::default())?;
                row.right_answers += 1;
                if verdict.verdict != Word::Correct {
                    row.false_alarms.push(name(&submission));
                }
            }
        }
        rows.push(row);
        progress.set((index + 1) as f64 / words.len() as f64);
    }
    drop(progress);
    std::mem::forget((checker, context));
    if reporter.json() {
        reporter.report(&rows)?;
    } else {
        reporter.text(&table(&rows))?;
    }
    let reached =
        |row: &Row| row.score.single.share() >= 0.97 && row.score.pairs.share() >= 0.85 && row.false_alarms.is_empty();
    Ok(if rows.iter().all(reached) { Outcome::Done } else { Outcome::CheckFailed })
}

fn name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// In Markdown, so that it can stand in a document as it is.
fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "| exercise | single, named right | pairs, named right | right answers | false alarms |\n|---|---|---|---|---|\n",
    );
    for Row { score, right_answers, false_alarms } in rows {
        let share = |count: &gonio_lab::score::Count| {
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
        for (made, said) in row.score.single.misnamed.iter().chain(&row.score.pairs.misnamed) {
            text.push_str(&format!("\n{}: {made} was called {said}", row.score.exercise));
        }
        for name in &row.false_alarms {
            text.push_str(&format!("\n{}: {name} is right and was called wrong", row.score.exercise));
        }
    }
    text.trim_end().to_owned() + "\n"
}
