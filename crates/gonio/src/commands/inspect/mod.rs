//! `gonio inspect`: what a model file contains, and how it was interpreted.

mod text;

use crate::cli::{GeneralOptions, LimitOptions};
use crate::report::{CliError, Outcome, Reporter};
use clap::Args;
use gonio_scene::inspect;
use serde::Serialize;

/// Show what a model file contains and how each part was interpreted.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio inspect model.obj
      Counts, bounds, the values of each material, the files it names, the source of the normals, warnings.
  gonio inspect model.obj --line 1204
      An explanation of that line, with the vertices that it refers to.
  gonio inspect model.mtl --line 3
      The same for a material library.
  gonio inspect model.glb --json
      Everything as one JSON object.
  curl https://example.com/model.obj | gonio inspect -
      A model from stdin. Files compressed by gzip or zstd are unpacked.")]
pub struct InspectArgs {
    /// Model (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst), - for stdin, or builtin:NAME.
    #[arg(value_name = "FILE")]
    pub input: String,
    /// Explain one line of an OBJ or MTL file, counted from 1.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), help_heading = "Detail options")]
    pub line: Option<u64>,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &InspectArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let files = args.limits.files([args.input.as_str()], reporter);
    let limits = args.limits.limits();
    let page = match args.line {
        Some(line) => {
            let explanation = inspect::explain_line(&args.input, line, &files, &limits)?;
            if reporter.json() {
                return json("line", &explanation, reporter);
            }
            text::line(&explanation)
        }
        None => {
            let inspection = {
                let _busy = reporter.busy("reading the model");
                inspect::inspect(&args.input, &files, &limits)?
            };
            if reporter.json() {
                return json("model", &inspection, reporter);
            }
            text::inspection(&inspection)
        }
    };
    reporter.text(&page)?;
    Ok(Outcome::Done)
}

fn json(key: &str, value: &impl Serialize, reporter: &Reporter) -> Result<Outcome, CliError> {
    reporter.report(&serde_json::json!({ "command": "inspect", key: value }))?;
    Ok(Outcome::Done)
}
