//! `gonio inspect`: what a model file holds, and how it was understood.

mod text;

use crate::cli::{LimitOptions, WordOptions};
use crate::report::{CliError, Outcome, Reporter};
use clap::Args;
use gonio_scene::inspect;
use serde::Serialize;

/// Say what a model file holds and how each part of it was understood.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio inspect model.obj
      Counts, bounds, materials value by value, files sought and found, where normals come from, warnings.
  gonio inspect model.obj --line 1204
      That line in words, with the vertices that it points at.
  gonio inspect model.mtl --line 3
      The same of a material library.
  gonio inspect model.glb --json
      Everything as one JSON object.
  zcat model.obj.gz | gonio inspect -
      What is piped in; compressed files are read as they are, too.")]
pub struct InspectArgs {
    /// A model (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst), - for stdin, or builtin:NAME.
    #[arg(value_name = "FILE")]
    pub input: String,
    /// Explain one line of an OBJ or MTL file, from 1.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub line: Option<u64>,
    /// What a file may make us allocate.
    #[command(flatten)]
    pub limits: LimitOptions,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Inspects.
pub fn run(args: &InspectArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let files = args.limits.files([args.input.as_str()]);
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
