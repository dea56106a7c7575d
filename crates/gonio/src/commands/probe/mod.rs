//! `gonio probe`: the light equation at one pixel by the CPU reference, compared with the pixel that the GPU drew.

mod shaders;
mod surroundings;
mod text;
mod traced;

use crate::backend::{self, Backend, BackendReport, Opened};
use crate::commands::render::shaders::{ShaderOptions, on_a_large_stack};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{BackendChoice, BackendOptions, GeneralOptions, SceneOptions, values};
use crate::report::{Reporter, Times};
use crate::terminal::TerminalPage;

use clap::Args;
use gonio_mesh::Diagnostic;
use gonio_reference::{Probe, ReferenceScene};
use gonio_scene::{DisplayMap, Frame, Scene};
use serde::Serialize;
use traced::TracedPixel;

/// Evaluate the light equation at one pixel, term by term and light by light.
#[derive(Args, Debug)]
#[command(mut_arg("samples", |arg| arg
    .help("Paths with --traced; 4096 by default")
    .value_parser(values::paths)
    .allow_negative_numbers(true)
    .requires("traced")))]
#[command(after_long_help = "\
Examples:
  gonio probe model.obj --at 512,384
      Every vector, factor and term of the light equation there, and their sum.
  gonio probe scene.toml --at 100,80 --size 320x240 --shading gouraud
      With options of render. For Gouraud shading, the light is listed at the triangle's corners.
  gonio probe model.obj --at 512,384 --json
      The same for machines.
  gonio probe model.obj --fragment toon.frag --at 512,384
      Your own shaders there: the value of every variable beside its line, as `gonio lab step` lists it. --corners adds the \
vertex shader at the corners of the triangle, and --at-vertex 7 lists it at one vertex.
  gonio probe scene.toml --at 100,80 --traced
      Also the light of the rendering equation there: emitted, direct from each source, of the first bounce, and the rest.

The numbers come from the CPU reference (f64, through the centre of the pixel). Where OpenGL is available, the pixel that it \
draws with one sample is listed for comparison. Where no object is visible, the background is listed.")]
pub struct ProbeArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model.
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// The pixel: column and row, counted from 0 at the top left.
    ///
    /// With your own shaders it may be left out: the drawn pixel nearest to the picture's middle.
    #[arg(long, required_unless_present_any = ["vertex", "fragment"], value_name = "X,Y", value_parser = values::pixel,
          allow_hyphen_values = true, help_heading = "Picture options")]
    pub at: Option<(u32, u32)>,
    /// Time in seconds, for lights that move.
    #[arg(long, help_heading = "Light options", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub time: f64,
    /// Also follow paths of light through the pixel, and list what they bring by the way they took.
    #[arg(long, help_heading = "Picture options")]
    pub traced: bool,
    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub shaders: ShaderOptions,
    /// Step through the vertex shader at this vertex, counted from 0 over all parts of the scene.
    #[arg(long, value_name = "N", conflicts_with = "at", help_heading = "Shader options")]
    pub at_vertex: Option<u32>,
    /// Also step through the vertex shader at the corners of the pixel's triangle.
    #[arg(long, conflicts_with = "at_vertex", help_heading = "Shader options")]
    pub corners: bool,
    #[command(flatten)]
    pub backend: BackendOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The report about a pixel. Colours are linear RGBA, premultiplied, unless stated otherwise.
#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    x: u32,
    y: u32,
    width: u32,
    height: u32,
    /// Whether a surface is visible there.
    hit: bool,
    /// The light equation there.
    probe: Option<&'a Probe>,
    /// The pixel by the CPU reference.
    reference: [f64; 4],
    /// The displayed pixel, `#rrggbb`.
    displayed: String,
    gpu: Option<GpuValue>,
    /// With `--traced`.
    traced: Option<TracedPixel>,
    backend: BackendReport,
    warnings: &'a [Diagnostic],
}

/// The pixel that the GPU drew.
#[derive(Clone, Debug, Serialize)]
struct GpuValue {
    renderer: String,
    value: [f32; 4],
    /// The largest absolute difference of a channel from the reference.
    difference: f64,
}

pub fn run(args: &ProbeArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let (Some((x, y)), false) = (args.at, args.shaders.any()) else {
        return on_a_large_stack(|| shaders::run(args, reporter))?;
    };
    shaders::refuse(args)?;
    let times = Times::default();
    let options = SceneOptions { samples: None, ..args.scene.clone() };
    let (scene, opened) = loading::load_scene_while(&args.inputs, &options, reporter, &times, || {
        Opened::new(&args.backend, None, &times)
    });
    let scene = scene?.at(args.time);
    reporter.diagnostics(&scene.diagnostics);
    // One sample: the ray through the centre of the pixel.
    let frame = Frame { samples: 1, ..scene.frame(args.time) };
    if x >= frame.width || y >= frame.height {
        return Err(CliError::new(format!(
            "pixel {x},{y} is outside the picture of {}x{} pixels: columns 0 to {}, rows 0 to {}",
            frame.width,
            frame.height,
            frame.width - 1,
            frame.height - 1
        )));
    }
    let mut backend = opened?.take_scene(&scene, &args.backend, reporter, &times)?;
    if let (BackendChoice::Auto, Backend::Cpu { reason: Some(reason), .. }) = (args.backend.backend, &backend) {
        reporter.note(format!("the reference is not compared with OpenGL: {reason}"));
    }
    let probe_with = |reference: &ReferenceScene| {
        let probe = reference.probe(&frame, x, y);
        let value = probe.as_ref().map_or_else(|| reference.behind(&frame, x, y), |probe| probe.total.to_array());
        (probe, value)
    };
    let (probe, reference) = match &backend {
        Backend::Cpu { scene, .. } => probe_with(scene),
        Backend::Gl { .. } => probe_with(&ReferenceScene::new(&scene)),
    };
    let traced = args.traced.then(|| TracedPixel::new(&scene, &frame, (x, y), args.scene.samples, reporter, &times));
    let gpu = gpu_value(&mut backend, &frame, (x, y), reference, reporter, &times)?;
    if let Some(driver) = backend.driver() {
        reporter.verbose(format_args!("driver: {}", backend::driver_line(driver)));
    }
    reporter.verbose_times(&times);
    let report = Report {
        command: "probe",
        inputs: &args.inputs,
        x,
        y,
        width: frame.width,
        height: frame.height,
        hit: probe.is_some(),
        probe: probe.as_ref(),
        reference,
        displayed: displayed(&frame, reference),
        gpu,
        traced,
        backend: backend.report(),
        warnings: &scene.diagnostics,
    };
    if reporter.json() {
        reporter.report(&report)?;
    } else {
        reporter.text(&text(&report, &scene, &frame))?;
    }
    // The process ends next, and the system frees it faster.
    std::mem::forget(backend);
    std::mem::forget(scene);
    Ok(CommandOutcome::Done)
}

fn text(report: &Report<'_>, scene: &Scene, frame: &Frame) -> TerminalPage {
    text::ProbePage::new(scene, frame).write(report)
}

fn gpu_value(
    backend: &mut Backend,
    frame: &Frame,
    (x, y): (u32, u32),
    reference: [f64; 4],
    reporter: &Reporter,
    times: &Times,
) -> Result<Option<GpuValue>, CliError> {
    let Some(renderer) = backend.driver().map(|d| d.renderer.clone()) else { return Ok(None) };
    let mut value = None;
    backend.draw(frame, &[None], reporter, times, |_, shot| {
        value = Some(shot.linear()?.at(x, y));
        Ok(())
    })?;
    Ok(value.map(|value| {
        let difference = (0..4).map(|c| (f64::from(value[c]) - reference[c]).abs()).fold(0.0, f64::max);
        GpuValue { renderer, value, difference }
    }))
}

/// The displayed colour of a pixel, `#rrggbb`.
fn displayed(frame: &Frame, pixel: [f64; 4]) -> String {
    let map = DisplayMap::for_view(None, frame);
    let [r, g, b, _] = map.apply(pixel.map(|v| v as f32)).map(|v| (v * 255.0 + 0.5) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
