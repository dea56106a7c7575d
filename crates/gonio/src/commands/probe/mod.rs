//! `gonio probe`: the light equation at one pixel, from the CPU reference, beside what the GPU drew there.

mod surroundings;
mod text;

use crate::backend::{Backend, BackendChoice, BackendReport, Opened};
use crate::cli::{BackendOptions, SceneOptions, WordOptions};
use crate::loading;
use crate::report::{CliError, Outcome, Reporter, Times};
use crate::values;
use clap::Args;
use gonio_mesh::Diagnostic;
use gonio_reference::{Probe, ReferenceScene};
use gonio_scene::{DisplayMap, Frame, Scene};
use serde::Serialize;

/// The light equation at one pixel, term by term and light by light.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio probe model.obj --at 512,384
      Every vector, factor and term of the light equation there, and their sum.
  gonio probe scene.toml --at 100,80 --size 320x240 --shading gouraud
      With the options of render; Gouraud's light is shown at the triangle's corners.
  gonio probe model.obj --at 512,384 --json
      For machines.

The numbers come from the CPU reference (f64, through the pixel's centre); where there is OpenGL, what it draws
there with one sample per pixel stands beside them. Where no object is seen the background is shown: exit code 0.")]
pub struct ProbeArgs {
    /// Models (.obj) or scenes (.toml); several become one scene. builtin:NAME is a model that gonio carries.
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,
    /// The pixel: column and row from 0 at the top left.
    #[arg(long, required = true, value_name = "X,Y", value_parser = values::pixel, allow_hyphen_values = true)]
    pub at: (u32, u32),
    /// Seconds: where moving lights are.
    #[arg(long, help_heading = "Lights", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub time: f64,
    /// Every option that replaces something of the scene.
    #[command(flatten)]
    pub scene: SceneOptions,
    /// Who draws what stands beside the reference.
    #[command(flatten)]
    pub backend: BackendOptions,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// What is known about the pixel. Colours are linear, premultiplied RGBA unless said otherwise.
#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    x: u32,
    y: u32,
    width: u32,
    height: u32,
    /// Whether a surface is seen there.
    hit: bool,
    /// The whole equation there.
    probe: Option<&'a Probe>,
    /// By the reference.
    reference: [f64; 4],
    /// The same as displayed, `#rrggbb`.
    displayed: String,
    gpu: Option<GpuValue>,
    backend: BackendReport,
    warnings: &'a [Diagnostic],
}

/// What the GPU drew there.
#[derive(Clone, Debug, Serialize)]
struct GpuValue {
    renderer: String,
    value: [f32; 4],
    /// The largest absolute difference from the reference of the four.
    difference: f64,
}

/// Probes.
pub fn run(args: &ProbeArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let times = Times::default();
    let (x, y) = args.at;
    let (scene, opened) = loading::load_scene_while(&args.inputs, &args.scene, reporter, &times, || {
        Opened::new(&args.backend, None, &times)
    });
    let scene = scene?;
    reporter.diagnostics(&scene.diagnostics);
    // What is read at a pixel is what a ray through its centre meets: one sample.
    let frame = Frame { samples: 1, ..scene.frame(args.time) };
    if x >= frame.width || y >= frame.height {
        return Err(CliError::new(format!(
            "{x},{y} is outside of the picture, which has {}x{} pixels: columns 0 to {}, rows 0 to {}",
            frame.width,
            frame.height,
            frame.width - 1,
            frame.height - 1
        )));
    }
    let mut backend = opened?.take_scene(&scene, &args.backend, reporter, &times)?;
    if let (BackendChoice::Auto, Backend::Cpu { reason: Some(reason), .. }) = (args.backend.backend, &backend) {
        reporter.note(format!("nothing stands beside the reference: {reason}"));
    }
    let look = |reference: &ReferenceScene| {
        let probe = reference.probe(&frame, x, y);
        let value = probe.as_ref().map_or_else(|| reference.behind(&frame, x, y), |probe| probe.total.to_array());
        (probe, value)
    };
    let (probe, reference) = match &backend {
        Backend::Cpu { scene, .. } => look(scene),
        Backend::Gl { .. } => look(&ReferenceScene::new(&scene)),
    };
    let gpu = gpu_value(&mut backend, &frame, (x, y), reference, reporter, &times)?;
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
        backend: backend.report(),
        warnings: &scene.diagnostics,
    };
    if reporter.json() {
        reporter.report(&report)?;
    } else {
        reporter.text(&text(&report, &scene, &frame))?;
    }
    // As in render: the process ends next.
    std::mem::forget(backend);
    std::mem::forget(scene);
    Ok(Outcome::Done)
}

fn text(report: &Report<'_>, scene: &Scene, frame: &Frame) -> crate::page::Page {
    text::Page::new(scene, frame).write(report)
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

/// As displayed, `#rrggbb`.
fn displayed(frame: &Frame, pixel: [f64; 4]) -> String {
    let map = DisplayMap::for_view(None, frame);
    let [r, g, b, _] = map.apply(pixel.map(|v| v as f32)).map(|v| (v * 255.0 + 0.5) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
