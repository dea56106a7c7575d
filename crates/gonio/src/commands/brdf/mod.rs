//! `gonio brdf`: models of reflection and transmission, measured and of one's own: plots, checks, exports, fits.

mod check;
mod export;
mod fit;
pub mod functions;
mod models;
mod plot;
mod view;

use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use clap::Subcommand;

#[derive(Subcommand, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf list
  gonio brdf show ward
  gonio brdf plot phong-normalised blinn-normalised ward -o lobes.svg
  gonio brdf view ggx measured.binary
  gonio brdf check ward:c=0.5,b=1
  gonio brdf export ggx:alpha=0.2 -o ggx.binary
  gonio brdf fit ggx.binary --model ward,ggx -o fit.toml

A MODEL is the name of a model or a file, with values of its parameters: name:key=value,... A colour is one number, or \
red/green/blue. Files: measured BRDFs (MERL .binary), .brdf of BRDF Explorer, .glsl with a function `vec3 BRDF(vec3 L, vec3 V, \
vec3 N, vec3 X, vec3 Y)`, and .toml of fits.

`gonio help brdf COMMAND` explains each command.")]
pub enum BrdfCommand {
    List(models::ListArgs),
    Show(models::ShowArgs),
    Plot(plot::PlotArgs),
    View(view::ViewArgs),
    Check(check::CheckArgs),
    Export(export::ExportArgs),
    Fit(fit::FitArgs),
}

impl BrdfCommand {
    /// The options that every command has.
    pub fn general(&self) -> &GeneralOptions {
        match self {
            BrdfCommand::List(args) => &args.general,
            BrdfCommand::Show(args) => &args.general,
            BrdfCommand::Plot(args) => &args.general,
            BrdfCommand::View(args) => &args.general,
            BrdfCommand::Check(args) => &args.general,
            BrdfCommand::Export(args) => &args.general,
            BrdfCommand::Fit(args) => &args.general,
        }
    }
}

pub fn run(command: &BrdfCommand, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    match command {
        BrdfCommand::List(_) => models::list(reporter),
        BrdfCommand::Show(args) => models::show(args, reporter),
        BrdfCommand::Plot(args) => plot::run(args, reporter),
        BrdfCommand::View(args) => view::run(args, reporter),
        BrdfCommand::Check(args) => check::run(args, reporter),
        BrdfCommand::Export(args) => export::run(args, reporter),
        BrdfCommand::Fit(args) => fit::run(args, reporter),
    }
}
