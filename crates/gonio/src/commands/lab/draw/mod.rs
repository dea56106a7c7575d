//! `gonio lab draw`: what a student's files draw, and how.

mod host;
mod shaders;

pub use shaders::goal;

use super::{exercise, guard, intake};
use crate::capture;
use crate::cli::WordOptions;
use crate::commands::frame::Shown;
use crate::output::atomic;
use crate::report::{CliError, Outcome, Reporter};
use crate::values;
use clap::Args;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::Kind;
use gonio_exercises::preview;
use gonio_gl::HeadlessContext;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{self, ColorTag};
use std::path::PathBuf;

/// Draw what a student's files draw, and take the frame apart.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio lab draw ex07 mine -o mine.png
      What a pair of shaders draws, in the lab's own scene; --scene stretched shows what that hides.
  gonio lab draw ex11 host/texture-name-as-unit.txt -o triangle.png
      The picture of a host program: its OpenGL calls are really made.
  gonio lab draw ex11 host/texture-name-as-unit.txt --frame
      The frame taken apart: which sampler reads which unit, what lies there, and what is wrong with it.
  gonio lab draw ex11 host/texture-name-as-unit.txt --capture triangle.rdc
      For RenderDoc's own window.
  gonio lab draw ex11 -o right.png
      Without files: the right answer.")]
pub struct DrawArgs {
    /// Which: ex11, or 11.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// The student's files, or the folder or zip that they are in; the right answer, where none is named.
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write the picture here.
    #[arg(long, short, value_name = "FILE.png", help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Pixels along each side of the picture.
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096),
          help_heading = "Output")]
    pub size: u32,
    /// Also write a RenderDoc capture of it, for RenderDoc's own window.
    #[arg(long, value_name = "FILE.rdc", help_heading = "Output")]
    pub capture: Option<PathBuf>,
    /// Of a pair of shaders: the scene, by its name; the lab's own, where none is named.
    #[arg(long, value_name = "NAME", help_heading = "Details")]
    pub scene: Option<String>,
    /// Of a host program: the frame taken apart, draws, samplers, textures and programs.
    #[arg(long, help_heading = "Details")]
    pub frame: bool,
    /// Of a host program: one draw with all that it read, by its number.
    #[arg(long, value_name = "N", help_heading = "Details", conflicts_with = "program")]
    pub draw: Option<usize>,
    /// Of a host program: a program with its GLSL, by its number.
    #[arg(long, value_name = "N", help_heading = "Details")]
    pub program: Option<usize>,
    /// Seconds: where a moving light is.
    #[arg(long, value_name = "SECONDS", value_parser = values::number, allow_negative_numbers = true, default_value = "0",
          help_heading = "Details")]
    pub time: f64,
    /// Draw in this process, which the caller guards.
    #[arg(long, hide = true)]
    pub in_this_process: bool,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

impl DrawArgs {
    /// What of the frame is asked for.
    fn shown(&self) -> Option<Shown> {
        match (self.draw, self.program) {
            (Some(number), _) => Some(Shown::Draw(number)),
            (None, Some(number)) => Some(Shown::Program(number)),
            (None, None) => self.frame.then_some(Shown::Everything),
        }
    }
}

/// Draws.
pub fn run(args: &DrawArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    if !args.in_this_process {
        return guard::run_again("--in-this-process");
    }
    if let Some(target) = &args.capture {
        capture::prepare(target)?;
    }
    if args.output.is_none() && args.capture.is_none() && args.shown().is_none() && !reporter.json() {
        return Err(CliError::new("nothing was asked for; `-o picture.png` writes the picture"));
    }
    guard::end_with_the_caller();
    let submitted = match args.files.as_slice() {
        [] => exercise.reference_files().map(|(name, text)| SourceFile::new(name, text)).collect(),
        named => intake::read(named)?,
    };
    match exercise.kind {
        Kind::HostProgram => host::run(args, submitted, reporter),
        Kind::Shaders if preview::is_drawn(exercise) => shaders::run(args, exercise, submitted, reporter),
        _ => Err(CliError::new(format!("{} has no picture to draw", exercise.id))),
    }
}

/// A context; with what stands in the way where there is none.
fn context() -> Result<HeadlessContext, CliError> {
    HeadlessContext::new().map_err(|why| CliError::new(why.message.replace("; `--backend cpu` needs none", "")))
}

/// Writes RGBA, the top row first, where a picture was asked for. The lab's colours are written without any encoding.
fn write_picture(args: &DrawArgs, size: [u32; 2], rgba: Vec<u8>) -> Result<(), CliError> {
    let Some(path) = &args.output else { return Ok(()) };
    if !path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png")) {
        return Err(CliError::new(format!("`{}`: a picture is a .png file", path.display())));
    }
    atomic::write(path, &encoded(size, rgba)?)
}

fn encoded([width, height]: [u32; 2], rgba: Vec<u8>) -> Result<Vec<u8>, CliError> {
    Ok(png::encode8(&EncodedPicture { width, height, rgba }, ColorTag::Srgb)?)
}
