//! `gonio environment`: panoramas and cubemaps.

pub mod check;
pub mod convert;
mod write;

use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use clap::Subcommand;
use gonio_environment::arrange::Arrangement;
use gonio_scene::environment_file::{EnvironmentMap, OpenedEnvironment};

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

/// A description of an environment: `a panorama of 1024 x 512`.
fn describe(opened: &OpenedEnvironment) -> String {
    let layout = opened.layout.map_or(String::new(), |layout| format!(", {layout} layout"));
    match (&opened.map, opened.arrangement) {
        (EnvironmentMap::Panorama(panorama), _) => {
            format!("a panorama of {} x {}", panorama.image.width, panorama.image.height)
        }
        (EnvironmentMap::Cubemap(map), Arrangement::Faces) if opened.files.len() == 1 => {
            format!("a cubemap of {0} x {0}{layout}", map.size())
        }
        (EnvironmentMap::Cubemap(map), Arrangement::Faces) => format!("six faces of {0} x {0}{layout}", map.size()),
        (EnvironmentMap::Cubemap(map), arrangement) => {
            format!("a {arrangement} of faces of {0} x {0}{layout}", map.size())
        }
    }
}
