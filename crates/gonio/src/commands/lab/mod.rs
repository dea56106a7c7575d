//! `gonio lab`: the exercises, and the checker that names the mistake.

mod batch;
pub mod check;
pub mod child_process;
pub mod draw;
mod exercises;
pub mod format;
pub mod intake;
pub mod mistakes;
mod open;
mod score;
pub mod step;
mod text;
mod watch;

use crate::commands::course::folder;
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions};
use crate::report::Reporter;
use clap::Subcommand;
use gonio_exercises::exercise::{self, Exercise};

#[derive(Subcommand, Debug)]
#[command(after_long_help = "\
Examples:
  gonio lab list
  gonio lab show ex04
  gonio lab start ex04 mine
      Writes the text and the files to start from into the folder `mine`.
  gonio lab open ex04 mine
      Opens them in a window with an editor, your picture beside the reference solution's, and the checker.
  gonio lab check ex04 mine
      Reports what is right and what is wrong, by name and line.
  gonio lab step ex04 mine --at 256,200
      Shows every variable's value at one pixel, line by line.
  gonio lab mistakes
      Lists every mistake that the checker knows.

`gonio help lab COMMAND` explains a command.")]
pub enum LabCommand {
    List(exercises::ListArgs),
    Show(exercises::ShowArgs),
    Start(exercises::StartArgs),
    Open(Box<open::OpenArgs>),
    Reference(exercises::ReferenceArgs),
    Check(Box<check::CheckArgs>),
    Draw(draw::DrawArgs),
    Step(step::StepArgs),
    Mistakes(mistakes::MistakesArgs),
    Score(score::ScoreArgs),
    #[command(hide = true)]
    CheckWorker(child_process::CheckWorkerArgs),
    #[command(hide = true)]
    Trial(child_process::TrialArgs),
}

impl LabCommand {
    /// The options that every command has.
    pub fn general(&self) -> &GeneralOptions {
        match self {
            LabCommand::List(args) => &args.general,
            LabCommand::Show(args) => &args.general,
            LabCommand::Start(args) => &args.general,
            LabCommand::Open(args) => &args.general,
            LabCommand::Reference(args) => &args.general,
            LabCommand::Check(args) => &args.general,
            LabCommand::Draw(args) => &args.general,
            LabCommand::Step(args) => &args.general,
            LabCommand::Mistakes(args) => &args.general,
            LabCommand::Score(args) => &args.general,
            LabCommand::CheckWorker(args) => &args.general,
            LabCommand::Trial(args) => &args.general,
        }
    }

    /// The course whose exercises the command knows; `None` for those without exercises.
    fn course(&self) -> Option<&CourseOptions> {
        Some(match self {
            LabCommand::List(args) => &args.course,
            LabCommand::Show(args) => &args.course,
            LabCommand::Start(args) => &args.course,
            LabCommand::Open(args) => &args.course,
            LabCommand::Reference(args) => &args.course,
            LabCommand::Check(args) => &args.course,
            LabCommand::Draw(args) => &args.course,
            LabCommand::Step(args) => &args.course,
            // Processes of gonio's own: the one that starts them found the course.
            LabCommand::CheckWorker(args) => args.course.course.is_some().then_some(&args.course)?,
            LabCommand::Trial(args) => args.course.course.is_some().then_some(&args.course)?,
            LabCommand::Mistakes(_) | LabCommand::Score(_) => return None,
        })
    }
}

pub fn run(command: &LabCommand, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if let Some(options) = command.course() {
        folder::install(options, reporter)?;
    }
    match command {
        LabCommand::List(args) => exercises::list(args, reporter),
        LabCommand::Show(args) => exercises::show(args, reporter),
        LabCommand::Start(args) => exercises::start(args, reporter),
        LabCommand::Open(args) => open::run(args, reporter),
        LabCommand::Reference(args) => exercises::reference(args, reporter),
        LabCommand::Check(args) => check::run(args, reporter),
        LabCommand::Draw(args) => draw::run(args, reporter),
        LabCommand::Step(args) => step::run(args, reporter),
        LabCommand::Mistakes(args) => mistakes::run(args, reporter),
        LabCommand::Score(args) => score::run(args, reporter),
        LabCommand::CheckWorker(_) => child_process::check_worker(),
        LabCommand::Trial(args) => child_process::run_trial(args, reporter),
    }
}

/// The exercise with this id or number.
pub fn exercise(word: &str) -> Result<&'static Exercise, CliError> {
    exercise::find(word).ok_or_else(|| {
        let ids: Vec<&str> = exercise::all().iter().map(|exercise| exercise.id.as_str()).collect();
        CliError::new(format!("there is no exercise `{word}`; the exercises are {}", ids.join(", ")))
    })
}
