//! `gonio view`: the lab window.

use crate::cli::{SceneOptions, WordOptions};
use crate::report::{CliError, Outcome};
use clap::Args;
use gonio_app::platform::desktop::{self, WindowOptions};
use gonio_scene::SceneFile;
use std::path::PathBuf;
use std::sync::Arc;

/// The lab window: see, change and take apart the light.
#[derive(Args, Debug, Default)]
#[command(after_help = "\
Examples:
  gonio view
      The first sample; so does `gonio` alone where there is a display.
  gonio view model.obj
  gonio view scene.toml --size 1600x1000
  gonio view model.obj --environment sky.hdr --light \"point position=2,3,4 intensity=5\"
      With the options of render laid over it; --size is that of the window.

What lies on the disk is read again when it changes. Files can be dropped on the window; ? lists the keys.

Exit codes: 0 the window was closed, 2 error (no display, no OpenGL).")]
pub struct ViewArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a model that gonio carries.
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// Every option that replaces something of the scene.
    #[command(flatten)]
    pub scene: SceneOptions,
    /// Write the window's state to this file after every frame, as JSON (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub state: Option<PathBuf>,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Opens it, and returns when it is closed.
pub fn run(args: &ViewArgs) -> Result<Outcome, CliError> {
    // The size is the window's: the picture takes what room it finds there.
    let size = args.scene.size.map(|(width, height)| [width as f32, height as f32]);
    let options = SceneOptions { size: None, ..args.scene.clone() };
    let limits = options.limits.limits();
    let environments = options.surroundings.named().map(str::to_owned).collect();
    let sandbox = options.limits.sandbox;
    let adjust = Arc::new(move |scene: &mut SceneFile| options.apply(scene));
    let window = WindowOptions {
        inputs: args.inputs.clone(),
        size,
        adjust: Some(adjust),
        limits,
        environments,
        sandbox,
        state: args.state.clone(),
        program: std::env::current_exe().ok(),
        exercise: None,
    };
    desktop::run(window).map_err(CliError::new)?;
    Ok(Outcome::Done)
}

/// What `gonio` alone is: the window, where there is a display.
pub fn alone() -> Option<ViewArgs> {
    desktop::has_display().then(ViewArgs::default)
}
