//! `gonio environment`: panoramas and cubemaps.

pub mod check;
pub mod convert;
mod write;

use crate::cli::WordOptions;
use crate::report::{CliError, Outcome, Reporter};
use clap::Subcommand;
use gonio_environment::arrange::Arrangement;
use gonio_scene::environment_file::{OpenedEnvironment, Source};

/// Convert panoramas and cubemaps into one another; check which way round they are.
#[derive(Subcommand, Debug)]
#[command(after_help = "\
Examples:
  gonio environment convert panorama.hdr faces
  gonio environment check faces

`gonio environment convert --help` and `gonio environment check --help` tell more.")]
pub enum EnvironmentCommand {
    /// Convert a panorama or a cubemap: to six faces, a cross, a strip, a panorama or KTX2, of any size, turned.
    Convert(convert::ConvertArgs),
    /// Say which way round an environment is: faces that are mirrored, turned or swapped, and how to repair them.
    Check(check::CheckArgs),
}

impl EnvironmentCommand {
    /// What is said.
    pub fn words(&self) -> &WordOptions {
        match self {
            EnvironmentCommand::Convert(args) => &args.words,
            EnvironmentCommand::Check(args) => &args.words,
        }
    }
}

/// Does it.
pub fn run(command: &EnvironmentCommand, reporter: &Reporter) -> Result<Outcome, CliError> {
    match command {
        EnvironmentCommand::Convert(args) => convert::run(args, reporter),
        EnvironmentCommand::Check(args) => check::run(args, reporter),
    }
}

/// What an environment is, in words: `a panorama of 1024 x 512`.
fn describe(opened: &OpenedEnvironment) -> String {
    let layout = opened.layout.map_or(String::new(), |layout| format!(", {layout} layout"));
    match (&opened.source, opened.arrangement) {
        (Source::Panorama(panorama), _) => {
            format!("a panorama of {} x {}", panorama.image.width, panorama.image.height)
        }
        (Source::Cubemap(map), Arrangement::Faces) if opened.files.len() == 1 => {
            format!("a cubemap of {0} x {0}{layout}", map.size())
        }
        (Source::Cubemap(map), Arrangement::Faces) => format!("six faces of {0} x {0}{layout}", map.size()),
        (Source::Cubemap(map), arrangement) => format!("a {arrangement} of faces of {0} x {0}{layout}", map.size()),
    }
}
