//! `gonio scene`: the complete effective scene of an input, from which any picture can be drawn again.

use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{GeneralOptions, SceneOptions};
use crate::output::OutputPath;
use crate::report::{Reporter, json_text};
use crate::terminal::toml_for_terminal;
use clap::Args;
use gonio_app::files::link;
use gonio_scene::SceneFile;
use std::path::{Path, PathBuf};

/// Print the complete effective scene of an input, or the JSON Schema of scene files.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio scene model.obj -o scene.toml
      The scene that `gonio render model.obj` draws, with every default.
  gonio render scene.toml -o picture.png
      The same picture, drawn from it.
  gonio scene model.obj --shading flat --light \"directional direction=0,-1,0\"
      The scene with options of render.
  gonio scene builtin:cube --shading flat --link
      What follows the address of gonio's page to open this scene there: #scene=...
  gonio scene --schema > scene.schema.json
      The schema by which an editor completes and checks scene files.

Paths in the scene are relative to the folder of the file that -o names, else to the current folder.")]
pub struct SceneArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model.
    #[arg(required_unless_present = "schema", value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// Print the JSON Schema of scene files instead.
    #[arg(long, help_heading = "Output options", conflicts_with = "inputs")]
    pub schema: bool,
    /// Print the link to this scene instead, to be appended to the address of gonio's page.
    ///
    /// A link contains the scene, but no files: all models and environments must be built in.
    #[arg(long, help_heading = "Output options", conflicts_with = "schema")]
    pub link: bool,
    /// File to write; - is stdout, the default.
    #[arg(long, short, help_heading = "Output options", value_name = "FILE")]
    pub output: Option<OutputPath>,
    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &SceneArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let output = args.output.clone().unwrap_or(OutputPath::Stdout);
    output.check_writable()?;
    let text = if args.schema { schema()? } else { effective(args, reporter)? };
    output.write(text.as_bytes())?;
    Ok(CommandOutcome::Done)
}

fn schema() -> Result<String, CliError> {
    json_text(&SceneFile::json_schema())
}

fn effective(args: &SceneArgs, reporter: &Reporter) -> Result<String, CliError> {
    let loaded = {
        let _busy = reporter.busy("reading the scene");
        loading::load_scene(&args.inputs, &args.scene, reporter)?
    };
    reporter.diagnostics(&loaded.diagnostics);
    if args.link {
        let link = link::of_scene(&loaded.settings).map_err(CliError::new)?;
        return if reporter.json() {
            json_text(&serde_json::json!({ "command": "scene", "inputs": args.inputs, "link": format!("#{link}") }))
        } else {
            Ok(format!("#{link}\n"))
        };
    }
    let mut scene = SceneFile::from(&loaded.settings);
    if let Some(folder) = args.output.as_ref().and_then(OutputPath::file).and_then(Path::parent) {
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

/// Converts a model's path from one relative to the current folder to one relative to `folder`.
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
