//! `gonio view`: the gonio window.

use crate::commands::render::shaders::ShaderOptions;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, SceneOptions};
use clap::Args;
use gonio_app::platform::desktop::{self, WindowOptions};
use gonio_scene::SceneFile;
use std::path::PathBuf;
use std::sync::Arc;

/// Open the gonio window to view and edit a scene.
#[derive(Args, Debug, Default)]
#[command(after_long_help = "\
Examples:
  gonio view
      The first sample. `gonio` alone does the same where there is a display.
  gonio view model.obj
  gonio view scene.toml --size 1600x1000
  gonio view model.obj --environment sky.hdr --light \"point position=2,3,4 intensity=5\"
      The scene with options of render; --size is the size of the window.
  gonio view model.obj --fragment toon.frag
      Your own shaders. The tab Shaders has their uniforms; a text that does not compile leaves the last program on. A click on \
      the picture shows each line's values at that pixel.

The window reads files again when they change. Drop files on it to open them, shaders too; press ? for its keys.

Exit codes: 0 the window was closed, 2 error (no display, no OpenGL).")]
pub struct ViewArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model.
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<String>,
    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub shaders: ShaderOptions,
    /// Write the window's state to this file after every frame, as JSON (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub state: Option<PathBuf>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Opens the window, and returns when it is closed.
pub fn run(args: &ViewArgs) -> Result<CommandOutcome, CliError> {
    args.shaders.check()?;
    // The size is the window's: the picture adapts to it.
    let size = args.scene.size.map(|(width, height)| [width as f32, height as f32]);
    let options = SceneOptions { size: None, ..args.scene.clone() };
    let limits = options.limits.limits();
    let environments = options.surroundings.named().map(str::to_owned).collect();
    let sandbox = options.limits.sandbox;
    let adjust = Arc::new(move |scene: &mut SceneFile| options.apply(scene));
    let window = WindowOptions {
        language: args.general.language,
        inputs: args.inputs.clone(),
        size,
        adjust: Some(adjust),
        limits,
        environments,
        sandbox,
        state: args.state.clone(),
        program: std::env::current_exe().ok(),
        shaders: args.shaders.files(),
        ..WindowOptions::default()
    };
    desktop::run(window).map_err(CliError::new)?;
    Ok(CommandOutcome::Done)
}

/// The options of `gonio` without a command: the window, if there is a display.
pub fn alone() -> Option<ViewArgs> {
    desktop::has_display().then(ViewArgs::default)
}
