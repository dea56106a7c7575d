//! `gonio lab`: the exercises, and the checker that names the mistake.

mod batch;
mod check;
mod draw;
mod exercises;
mod guard;
mod intake;
mod mistakes;
mod open;
mod score;
mod text;
mod trial;
mod worker;

use crate::cli::WordOptions;
use crate::report::{CliError, Outcome, Reporter};
use clap::Subcommand;
use gonio_exercises::exercise::{self, Exercise};
use std::path::PathBuf;

/// Exercises, students' own shaders, and a checker that names the mistake.
#[derive(Subcommand, Debug)]
#[command(after_help = "\
Examples:
  gonio lab list
  gonio lab show ex04
  gonio lab start ex04 mine
      The text and the files to start from, in the folder `mine`.
  gonio lab open ex04 mine
      The same in a window: an editor, the picture beside the right answer's, and the checker.
  gonio lab check ex04 mine
      What is right and what is wrong with it, by name and line.
  gonio lab mistakes
      Everything that the checker knows by name.

`gonio lab check --help` tells more.")]
pub enum LabCommand {
    /// The exercises, a line each.
    List(exercises::ListArgs),
    /// An exercise's text.
    Show(exercises::ShowArgs),
    /// Write an exercise's text and the files to start from into a folder.
    Start(exercises::StartArgs),
    /// Work on an exercise in the window: editor, picture, checker.
    Open(Box<open::OpenArgs>),
    /// Print or write the right answer.
    Reference(exercises::ReferenceArgs),
    /// Check a pair of shaders: what is right, what is wrong, and the mistake's name and line.
    Check(Box<check::CheckArgs>),
    /// Draw what a student's files draw, and take the frame apart.
    Draw(draw::DrawArgs),
    /// Every mistake that the checker knows, or one of them with its explanation.
    Mistakes(mistakes::MistakesArgs),
    /// Measure the checker: the share of the bank's mistakes that it names right, and its false alarms.
    Score(score::ScoreArgs),
    /// The process that a check runs in.
    #[command(hide = true)]
    CheckWorker(WordOptions),
    /// Compile and draw the pair of shaders that comes from standard input, for the window.
    #[command(hide = true)]
    Trial(trial::TrialArgs),
}

impl LabCommand {
    /// What is said.
    pub fn words(&self) -> &WordOptions {
        match self {
            LabCommand::List(args) => &args.words,
            LabCommand::Show(args) => &args.words,
            LabCommand::Start(args) => &args.words,
            LabCommand::Open(args) => &args.words,
            LabCommand::Reference(args) => &args.words,
            LabCommand::Check(args) => &args.words,
            LabCommand::Draw(args) => &args.words,
            LabCommand::Mistakes(args) => &args.words,
            LabCommand::Score(args) => &args.words,
            LabCommand::CheckWorker(words) => words,
            LabCommand::Trial(args) => &args.words,
        }
    }
}

/// Does it.
pub fn run(command: &LabCommand, reporter: &Reporter) -> Result<Outcome, CliError> {
    match command {
        LabCommand::List(args) => exercises::list(args, reporter),
        LabCommand::Show(args) => exercises::show(args, reporter),
        LabCommand::Start(args) => exercises::start(args, reporter),
        LabCommand::Open(args) => open::run(args),
        LabCommand::Reference(args) => exercises::reference(args, reporter),
        LabCommand::Check(args) => check::run(args, reporter),
        LabCommand::Draw(args) => draw::run(args, reporter),
        LabCommand::Mistakes(args) => mistakes::run(args, reporter),
        LabCommand::Score(args) => score::run(args, reporter),
        LabCommand::CheckWorker(_) => worker::run(),
        LabCommand::Trial(args) => trial::run(args, reporter),
    }
}

/// gonio's own program, for processes that a shader may crash.
fn own_program() -> Result<PathBuf, CliError> {
    std::env::current_exe().map_err(|error| CliError::io("gonio's own program was not found", &error))
}

/// The exercise that somebody named.
fn exercise(word: &str) -> Result<&'static Exercise, CliError> {
    exercise::find(word).ok_or_else(|| {
        let ids: Vec<&str> = exercise::all().iter().map(|exercise| exercise.id.as_str()).collect();
        CliError::new(format!("there is no exercise `{word}`; there are {}", ids.join(", ")))
    })
}
