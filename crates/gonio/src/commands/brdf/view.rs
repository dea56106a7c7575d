//! `gonio brdf view`: the BRDF bench in the window.

use super::functions::open;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, values};
use crate::report::Reporter;
use clap::Args;
use gonio_app::platform::desktop::{self, WindowOptions};
use gonio_plot::MOST_FUNCTIONS;
use std::path::PathBuf;

/// Open the BRDF bench: plots in the window, with a slider for each parameter.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf view
      Phong, Blinn and Ward, normalised.
  gonio brdf view ggx:alpha=0.2 measured.binary fit.toml
  gonio brdf view mine.brdf --size 1600x1000
      A file of BRDF Explorer: its parameters are sliders.

Drag in the polar plot to turn the light. Drop files on the window to add them.

Exit codes: 0 the window was closed, 2 error (no display, no such file).")]
pub struct ViewArgs {
    /// Models or files, with values of their parameters; at most seven.
    #[arg(value_name = "MODEL")]
    pub models: Vec<String>,
    /// Size of the window.
    #[arg(long, value_name = "WxH", value_parser = values::size, help_heading = "Window options")]
    pub size: Option<(u32, u32)>,
    /// Write the window's state to this file after every frame, as JSON (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub state: Option<PathBuf>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Opens the window, and returns when it is closed.
pub fn run(args: &ViewArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if args.models.len() > MOST_FUNCTIONS {
        let message = format!("{} functions on the bench: expected at most {MOST_FUNCTIONS}", args.models.len());
        return Err(CliError::new(message));
    }
    let functions = args.models.iter().map(|text| open(text, reporter)).collect::<Result<Vec<_>, _>>()?;
    let window = WindowOptions {
        language: args.general.language,
        size: args.size.map(|(width, height)| [width as f32, height as f32]),
        state: args.state.clone(),
        program: std::env::current_exe().ok(),
        bench: Some(functions),
        ..WindowOptions::default()
    };
    desktop::run(window).map_err(CliError::new)?;
    Ok(CommandOutcome::Done)
}
