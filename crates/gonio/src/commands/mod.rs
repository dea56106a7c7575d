//! The commands, one module each.

pub mod about;
pub mod convert;
pub mod diff;
pub mod environment;
pub mod frame;
pub mod inspect;
pub mod lab;
pub mod probe;
pub mod render;
pub mod scene;
pub mod serve;
pub mod tour;
pub mod view;

use crate::cli::Command;
use crate::output::path::check_folder;
use crate::report::{CliError, Outcome, Reporter};

pub fn run(command: &Command, reporter: &Reporter) -> Result<Outcome, CliError> {
    match command {
        Command::Render(args) => render::run(args, reporter),
        Command::Probe(args) => probe::run(args, reporter),
        Command::Frame(args) => frame::run(args, reporter),
        Command::Convert(args) => convert::run(args, reporter),
        Command::Environment(command) => environment::run(command, reporter),
        Command::Diff(args) => diff::run(args, reporter),
        Command::Inspect(args) => inspect::run(args, reporter),
        Command::Lab(command) => lab::run(command, reporter),
        Command::Scene(args) => scene::run(args, reporter),
        Command::Serve(args) => serve::run(args, reporter),
        Command::Tour(args) => {
            check_folder(&args.output, "`gonio tour`")?;
            tour::run(args, reporter)
        }
        Command::View(args) => view::run(args),
        Command::Completions(args) => about::completions(args),
        Command::Man(args) => about::man(args, reporter),
        Command::Licenses(_) => about::licenses(reporter),
    }
}
