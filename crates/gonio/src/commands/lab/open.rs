//! `gonio lab open`: an exercise in the window.

use super::{exercise, intake};
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions, values};
use crate::report::Reporter;
use clap::Args;
use gonio_app::exercise::Start;
use gonio_app::files::ExerciseFile;
use gonio_app::platform::desktop::{self, WindowOptions};
use std::path::{Path, PathBuf};

/// Open an exercise in the window: an editor, your picture beside the reference solution's, and the checker.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio lab open ex04
      The files to start from, in memory; Ctrl+S saves them into a folder.
  gonio lab open ex04 mine
      The files in the folder `mine`. Change them in any editor, and the window follows.
  gonio lab open ex07 light.vert light.frag --size 1600x1000

Ctrl+Enter checks, Ctrl+S saves.

Exit codes: 0 the window was closed, 2 error (no display, no such file).")]
pub struct OpenArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// Your files, or their folder; by default the files to start from.
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Size of the window.
    #[arg(long, value_name = "WxH", value_parser = values::size, help_heading = "Window options")]
    pub size: Option<(u32, u32)>,
    /// Write the window's state to this file after every frame, as JSON (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub state: Option<PathBuf>,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Opens the window, and returns when it is closed.
pub fn run(args: &OpenArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    let mut files = Vec::new();
    for path in &args.files {
        files.extend(read(path)?);
    }
    if files.is_empty() && !args.files.is_empty() {
        let places: Vec<String> = args.files.iter().map(|path| path.display().to_string()).collect();
        return Err(CliError::new(format!(
            "there are no files in {}; `gonio lab start {} {}` begins the exercise there",
            places.join(", "),
            exercise.id,
            places.join(" ")
        )));
    }
    for file in &files {
        reporter.verbose(format_args!("read `{}`, {} bytes", file.name, file.bytes.len()));
    }
    let window = WindowOptions {
        language: args.general.language,
        size: args.size.map(|(width, height)| [width as f32, height as f32]),
        state: args.state.clone(),
        program: std::env::current_exe().ok(),
        exercise: Some(Start { exercise: exercise.id.clone(), files }),
        ..WindowOptions::default()
    };
    desktop::run(window).map_err(CliError::new)?;
    Ok(CommandOutcome::Done)
}

/// The files of a path: those of a folder by their names in it, those of a zip in memory.
fn read(path: &Path) -> Result<Vec<ExerciseFile>, CliError> {
    let found = intake::read(std::slice::from_ref(&path.to_owned()))?;
    let exercise_file = |file: gonio_check::submission::SourceFile| {
        let place = if path.is_dir() { path.join(&file.name) } else { path.to_owned() };
        let is_itself = place.is_file() && (path.is_dir() || Path::new(&file.name) == path);
        let own = Path::new(&file.name).file_name().map(|name| name.to_string_lossy().into_owned());
        let name = if path.is_dir() { file.name } else { own.unwrap_or(file.name) };
        let absolute = || std::path::absolute(&place).unwrap_or_else(|_| place.clone());
        ExerciseFile { name, path: is_itself.then(absolute), bytes: file.bytes }
    };
    Ok(found.into_iter().map(exercise_file).collect())
}
