//! `gonio frame`: what OpenGL was told to draw a frame, and what is wrong with it.

mod details;
mod text;

use crate::backend::{BackendChoice, open_context};
use crate::cli::{self, BackendOptions, SceneOptions, WordOptions};
use crate::loading;
use crate::page::Page;
use crate::report::{CliError, Outcome, Reporter, Times};
use crate::values;
use clap::Args;
use gonio_gl::DriverInfo;
use gonio_gl::trace::{Finding, FrameRecord, Severity, lint};
use gonio_mesh::Diagnostic;
use gonio_render::Renderer;
use gonio_scene::ViewSpec;
use serde::Serialize;

/// The frame taken apart: passes, draw calls, programs, uniforms, samplers and the units they read.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio frame model.obj
      What OpenGL was told, in order: passes, draw calls, which sampler reads which unit, textures, programs; and what
      is wrong with it, above all.
  gonio frame model.obj --draw 0
      One draw with all that it read: attributes, uniforms with their values, samplers, state.
  gonio frame scene.toml --program 0
      A program's attributes and uniforms, and its GLSL.
  gonio frame model.obj --json
      Everything of all draws, for machines.

Vertices and fragments are counted by the GPU around each draw, where the driver can (ARB_pipeline_statistics_query).
Exit codes: 0 done, 1 something is wrong with the frame (an error, not a warning), 2 error.")]
pub struct FrameArgs {
    /// Models (.obj) or scenes (.toml); several become one scene. builtin:NAME is a model that gonio carries.
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// Show one draw with all that it read, by its number.
    #[arg(long, help_heading = "Details", value_name = "N", conflicts_with = "program")]
    pub draw: Option<usize>,
    /// Show a program with its GLSL, by its number.
    #[arg(long, help_heading = "Details", value_name = "N")]
    pub program: Option<usize>,
    /// Of a debug view in place of the picture: NAME, NAME:LIGHT, or a symbol such as N.
    #[arg(long, help_heading = "Details", value_name = "VIEW", value_parser = cli::view_list())]
    pub debug: Option<ViewSpec>,
    /// Seconds: where moving lights are.
    #[arg(long, help_heading = "Lights", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub time: f64,
    /// Every option that replaces something of the scene.
    #[command(flatten)]
    pub scene: SceneOptions,
    /// Load OpenGL's EGL from this library instead of the system's (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub egl_library: Option<String>,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    renderer: &'a str,
    version: &'a str,
    width: u32,
    height: u32,
    findings: &'a [Finding],
    frame: &'a FrameRecord,
    warnings: &'a [Diagnostic],
}

/// Draws a frame, and tells how.
pub fn run(args: &FrameArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let times = Times::default();
    let backend = BackendOptions { backend: BackendChoice::Gl, threads: None, egl_library: args.egl_library.clone() };
    let (scene, context) =
        loading::load_scene_while(&args.inputs, &args.scene, reporter, &times, || open_context(&backend));
    let scene = scene?;
    reporter.diagnostics(&scene.diagnostics);
    loading::check_views(args.debug, &scene)?;
    // There is nothing to take apart where the CPU draws.
    let context = context.map_err(|why| CliError::new(why.message.replace("; `--backend cpu` needs none", "")))?;
    let mut renderer = Renderer::new(context.gl().clone())?;
    let frame = scene.frame(args.time);
    let record = {
        let _busy = reporter.busy("drawing");
        let uploaded = renderer.upload(&scene)?;
        let record = renderer.record(&uploaded, &frame, args.debug)?;
        // As in render: the process ends next.
        std::mem::forget(uploaded);
        record
    };
    let findings = lint(&record);
    let info: &DriverInfo = renderer.info();
    if reporter.json() {
        reporter.report(&Report {
            command: "frame",
            inputs: &args.inputs,
            renderer: &info.renderer,
            version: &info.version,
            width: frame.width,
            height: frame.height,
            findings: &findings,
            frame: &record,
            warnings: &scene.diagnostics,
        })?;
    } else {
        let about = format!(
            "frame of {}, {} x {} pixels, by OpenGL ({})",
            args.inputs.join(", "),
            frame.width,
            frame.height,
            info.renderer
        );
        let shown = match (args.draw, args.program) {
            (Some(number), _) => Shown::Draw(number),
            (None, Some(number)) => Shown::Program(number),
            (None, None) => Shown::Everything,
        };
        reporter.text(&page(&about, &record, &findings, shown)?)?;
    }
    std::mem::forget((renderer, context, scene));
    let errors = findings.iter().filter(|finding| finding.severity == Severity::Error).count();
    if errors == 0 {
        return Ok(Outcome::Done);
    }
    reporter.check_failed(match errors {
        1 => "one thing is wrong with this frame".to_owned(),
        _ => format!("{errors} things are wrong with this frame"),
    });
    Ok(Outcome::CheckFailed)
}

/// What of a frame is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// All of it, briefly.
    Everything,
    /// One draw with all that it read.
    Draw(usize),
    /// A program with its GLSL.
    Program(usize),
}

/// A frame as text. An error where there is no such draw or program.
pub fn page(about: &str, record: &FrameRecord, findings: &[Finding], shown: Shown) -> Result<Page, CliError> {
    match shown {
        Shown::Everything => Ok(text::frame(about, record, findings)),
        Shown::Draw(number) => {
            let draw = record.draws.get(number).ok_or_else(|| missing("draw", number, record.draws.len()))?;
            Ok(details::draw(record, draw, findings))
        }
        Shown::Program(number) => {
            let program =
                record.programs.get(number).ok_or_else(|| missing("program", number, record.programs.len()))?;
            Ok(details::program(number, program))
        }
    }
}

fn missing(what: &str, number: usize, count: usize) -> CliError {
    CliError::new(match count {
        0 => format!("there is no {what} {number}: the frame has none"),
        1 => format!("there is no {what} {number}; the frame has one, number 0"),
        _ => format!("there is no {what} {number}; the frame has {count}, numbers 0 to {}", count - 1),
    })
}
