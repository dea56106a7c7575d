//! `gonio frame`: the OpenGL calls of a frame, and what is wrong with them.

mod details;
mod text;

use crate::backend::{self, open_context};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{BackendChoice, BackendOptions, GeneralOptions, SceneOptions, values};
use crate::report::{Reporter, Times};
use crate::terminal::TerminalPage;

use clap::Args;
use gonio_gl::DriverInfo;
use gonio_gl::trace::{Finding, FrameRecord, Severity, lint};
use gonio_mesh::Diagnostic;
use gonio_render::Renderer;
use gonio_scene::ViewSpec;
use serde::Serialize;

/// List the OpenGL calls of a frame and what is wrong with them.
///
/// Passes, draw calls, programs, uniforms, samplers and the units that they read.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio frame model.obj
      What is wrong with the frame, then its passes, draw calls, samplers with their units, textures and programs.
  gonio frame model.obj --draw 0
      One draw call with everything it read: attributes, uniforms with their values, samplers, state.
  gonio frame scene.toml --program 0
      The attributes and uniforms of a program, and its GLSL.
  gonio frame model.obj --json
      Everything about all draw calls, for machines.

The GPU counts vertices and fragments around each draw call if the driver supports it (ARB_pipeline_statistics_query).

Exit codes: 0 success, 1 the frame has an error (warnings do not count), 2 error.")]
pub struct FrameArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model.
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// Show one draw call with everything it read, by its number.
    #[arg(long, help_heading = "Detail options", value_name = "N", conflicts_with = "program")]
    pub draw: Option<usize>,
    /// Show a program with its GLSL, by its number.
    #[arg(long, help_heading = "Detail options", value_name = "N")]
    pub program: Option<usize>,
    /// Draw a debug view instead of the picture: NAME, NAME:LIGHT, or a symbol such as N.
    #[arg(long, help_heading = "Detail options", value_name = "VIEW", value_parser = values::view_list())]
    pub debug: Option<ViewSpec>,
    /// Time in seconds, for lights that move.
    #[arg(long, help_heading = "Light options", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub time: f64,
    #[command(flatten)]
    pub scene: SceneOptions,
    /// Load OpenGL's EGL from this library instead of the system's (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub egl_library: Option<String>,
    #[command(flatten)]
    pub general: GeneralOptions,
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

pub fn run(args: &FrameArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let times = Times::default();
    let backend = BackendOptions { backend: BackendChoice::Gl, threads: None, egl_library: args.egl_library.clone() };
    let (scene, context) =
        loading::load_scene_while(&args.inputs, &args.scene, reporter, &times, || open_context(&backend));
    let scene = scene?.at(args.time);
    reporter.diagnostics(&scene.diagnostics);
    loading::check_views(args.debug, &scene)?;
    // The CPU makes no OpenGL calls.
    let context = context.map_err(|error| CliError::new(error.message))?;
    let mut renderer = Renderer::new(context.gl().clone())?;
    let frame = scene.frame(args.time);
    let record = {
        let _busy = reporter.busy("drawing");
        let uploaded = renderer.upload(&scene)?;
        let record = renderer.record(&uploaded, &frame, args.debug)?;
        // The process ends next, and the system frees it faster.
        std::mem::forget(uploaded);
        record
    };
    let findings = lint(&record);
    let info: &DriverInfo = renderer.info();
    reporter.verbose(format_args!("driver: {}", backend::driver_line(info)));
    reporter.verbose_times(&times);
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
        return Ok(CommandOutcome::Done);
    }
    reporter.check_failed(match errors {
        1 => "the frame has one error".to_owned(),
        _ => format!("the frame has {errors} errors"),
    });
    Ok(CommandOutcome::CheckFailed)
}

/// The part of a frame that is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Everything, briefly.
    Everything,
    /// One draw call with everything it read.
    Draw(usize),
    /// A program with its GLSL.
    Program(usize),
}

/// A frame as text; an error if there is no such draw call or program.
pub fn page(about: &str, record: &FrameRecord, findings: &[Finding], shown: Shown) -> Result<TerminalPage, CliError> {
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

fn missing(kind: &str, number: usize, count: usize) -> CliError {
    CliError::new(match count {
        0 => format!("there is no {kind} {number}: the frame has none"),
        1 => format!("there is no {kind} {number}; the frame has one, number 0"),
        _ => format!("there is no {kind} {number}; the frame has {count}, numbers 0 to {}", count - 1),
    })
}
