//! `gonio scene`: the complete effective scene of an input, so that any picture can be made again.

use crate::cli::{SceneOptions, WordOptions};
use crate::escapes::toml_for_terminal;
use crate::loading;
use crate::output::atomic;
use crate::report::{CliError, Outcome, Reporter, json_text};
use clap::Args;
use gonio_scene::SceneFile;
use std::path::{Path, PathBuf};

/// Print the complete effective scene of an input, or the JSON Schema of scene files.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio scene model.obj -o scene.toml
      The scene that `gonio render model.obj` draws, every default written out.
  gonio render scene.toml -o picture.png
      The same picture from it.
  gonio scene model.obj --shading flat --light \"directional direction=0,-1,0\"
      With the options of render laid over it.
  gonio scene --schema > scene.schema.json
      What an editor needs to complete and check scene files.

Paths in the printed scene are relative to the folder of the scene file: to where -o puts it, or to this folder.")]
pub struct SceneArgs {
    /// Models (.obj) or scenes (.toml); several become one scene. builtin:NAME is a model that gonio carries.
    #[arg(required_unless_present = "schema", value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// Print the JSON Schema of scene files instead.
    #[arg(long, help_heading = "Output", conflicts_with = "inputs")]
    pub schema: bool,
    /// Write to this file instead of stdout.
    #[arg(long, short, help_heading = "Output", value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Every option that replaces something of the scene.
    #[command(flatten)]
    pub scene: SceneOptions,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Prints it.
pub fn run(args: &SceneArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    if let Some(path) = &args.output {
        atomic::check_writable(path)?;
    }
    let text = if args.schema { schema()? } else { effective(args, reporter)? };
    match &args.output {
        Some(path) => atomic::write(path, text.as_bytes())?,
        None => reporter.data(text.as_bytes())?,
    }
    Ok(Outcome::Done)
}

fn schema() -> Result<String, CliError> {
    json_text(&SceneFile::json_schema())
}

fn effective(args: &SceneArgs, reporter: &Reporter) -> Result<String, CliError> {
    let loaded = {
        let _busy = reporter.busy("reading the scene");
        loading::load_scene(&args.inputs, &args.scene)?
    };
    reporter.diagnostics(&loaded.diagnostics);
    let mut scene = SceneFile::from(&loaded.settings);
    if let Some(folder) = args.output.as_deref().and_then(Path::parent) {
        for object in &mut scene.objects {
            object.model = seen_from(folder, &object.model);
        }
    }
    if reporter.json() {
        let report = serde_json::json!({
            "command": "scene",
            "inputs": args.inputs,
            "scene": scene,
            "warnings": loaded.diagnostics,
        });
        return json_text(&report);
    }
    Ok(toml_for_terminal(&scene.to_toml_string()))
}

/// A model's path, relative to this folder until now, as seen from `folder`.
pub(super) fn seen_from(folder: &Path, model: &str) -> String {
    if model.starts_with("builtin:") || Path::new(model).is_absolute() || folder.as_os_str().is_empty() {
        return model.to_owned();
    }
    let (Ok(folder), Ok(target)) = (folder.canonicalize(), Path::new(model).canonicalize()) else {
        return model.to_owned();
    };
    let common = folder.components().zip(target.components()).take_while(|(a, b)| a == b).count();
    let up = std::iter::repeat_n(Path::new("..").components(), folder.components().count() - common).flatten();
    let path: PathBuf = up.chain(target.components().skip(common)).collect();
    // Scene files have forward slashes on every system.
    path.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn paths_are_seen_from_the_scene_file() {
        assert_eq!(seen_from(Path::new("/tmp"), "builtin:cube"), "builtin:cube");
        assert_eq!(seen_from(Path::new(""), "a/b.obj"), "a/b.obj");
        // Tests run in this crate's folder.
        assert_eq!(seen_from(Path::new("src"), "Cargo.toml"), "../Cargo.toml");
        assert_eq!(seen_from(Path::new("src/output"), "src/main.rs"), "../main.rs");
        assert_eq!(seen_from(Path::new("."), "src/main.rs"), "src/main.rs");
    }
}
