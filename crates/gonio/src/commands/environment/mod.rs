//! `gonio environment`: panoramas and cubemaps.

pub mod check;
pub mod convert;
mod write;

use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use clap::Subcommand;

#[derive(Subcommand, Debug)]
#[command(after_long_help = "\
Examples:
  gonio environment convert panorama.hdr faces
  gonio environment check faces

`gonio help environment convert` and `gonio help environment check` explain both.")]
pub enum EnvironmentCommand {
    Convert(convert::ConvertArgs),
    Check(check::CheckArgs),
}

impl EnvironmentCommand {
    /// The options that every command has.
    pub fn general(&self) -> &GeneralOptions {
        match self {
            EnvironmentCommand::Convert(args) => &args.general,
            EnvironmentCommand::Check(args) => &args.general,
        }
    }
}

pub fn run(command: &EnvironmentCommand, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    match command {
        EnvironmentCommand::Convert(args) => convert::run(args, reporter),
        EnvironmentCommand::Check(args) => check::run(args, reporter),
    }
}
