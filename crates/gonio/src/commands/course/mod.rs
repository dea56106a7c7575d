//! `gonio course`: a teacher's own exercises.

pub mod folder;
mod new;
mod package;
mod verify;

use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use clap::Subcommand;

#[derive(Subcommand, Debug)]
#[command(after_long_help = "\
A course is a folder with a course.toml and a folder for each exercise: its text, the files to start from, the reference, and \
exercise.toml, which states how it is judged, what is shown and what mistakes cost. `gonio lab` knows its exercises in the folder \
and below it, or with --course.

Examples:
  gonio course new graphics
      Writes a course with one exercise, a copy of ex07.
  gonio course verify graphics
      Measures how well the checker judges its exercises.
  gonio course package light-equation --course graphics --for gradescope -o light-equation.zip
      Writes what is uploaded to Gradescope.

`gonio help course COMMAND` explains a command.")]
pub enum CourseCommand {
    New(new::NewArgs),
    Verify(verify::VerifyArgs),
    Package(package::PackageArgs),
}

impl CourseCommand {
    /// The options that every command has.
    pub fn general(&self) -> &GeneralOptions {
        match self {
            CourseCommand::New(args) => &args.general,
            CourseCommand::Verify(args) => &args.general,
            CourseCommand::Package(args) => &args.general,
        }
    }
}

pub fn run(command: &CourseCommand, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    match command {
        CourseCommand::New(args) => new::run(args, reporter),
        CourseCommand::Verify(args) => verify::run(args, reporter),
        CourseCommand::Package(args) => package::run(args, reporter),
    }
}
