//! `gonio trace`: the rendering equation by path tracing, until a number of samples, a time or an error is reached.

mod run;

use crate::backend;
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{GeneralOptions, SceneOptions, TraceOptions, values};
use crate::output::atomic;
use crate::output::{OutputKind, OutputPath, check_stdout};
use crate::report::{Reporter, Times};
use clap::{ArgAction, Args};
use gonio_mesh::Diagnostic;
use gonio_scene::{Scene, ViewSpec};
use gonio_trace::{Film, Simplification, Simplifications, TraceGoal, TraceScene, TraceSettings};
use run::TraceRun;
use serde::Serialize;
use std::time::Instant;

/// Trace the paths of light: the rendering equation itself, with shadows and light between surfaces.
#[derive(Args, Debug)]
#[command(mut_arg("samples", |arg| arg
    .help("Paths per pixel; 64 by default")
    .help_heading("Trace options")
    .value_parser(values::paths)
    .allow_negative_numbers(true)
    .conflicts_with_all(["time", "error"])))]
#[command(after_long_help = "\
Examples:
  gonio trace scene.toml -o truth.png
      64 paths per pixel.
  gonio trace scene.toml --error 1 -o truth.exr
      Until the error of a pixel is 1 % of the mean brightness, with 95 % confidence; noisy parts get more paths.
  gonio trace scene.toml --time 30 -o truth.exr -o truth.png
      For half a minute.
  gonio trace scene.toml --samples 4096 --rgb --max-depth 2 -o direct.png
      Red, green and blue instead of wavelengths; light sources and the surfaces that they light, without interreflection.
  gonio trace scene.toml --samples 32 --denoise -o quick.png
      Few paths, and a filter that removes most of their noise.
  gonio trace scene.toml --views normal,albedo -o truth.exr
      The variance and debug views as layers.

While it runs, the picture so far is written, and beside it a checkpoint, OUT.trace. After an interruption (Ctrl-C, say) the \
same command goes on from there; the result is the same, bit for bit, as without the interruption.

Lights: point and spot lights obey the inverse square law; at the centre of the objects they are as bright as in the light \
equation. Materials that emit light are light sources. Ambient light does not exist.

Exit codes: 0 success, 2 error.")]
pub struct TraceArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model.
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,

    /// File to write: .exr (linear float) or .png; - is stdout. Repeat it for several formats.
    #[arg(long, short, required = true, value_name = "FILE", action = ArgAction::Append, help_heading = "Output options",
          allow_hyphen_values = true)]
    pub output: Vec<OutputPath>,
    /// Remove noise: .png shows the filtered picture; .exr keeps the traced one and has the filtered one as layer `denoised`.
    ///
    /// Filtering guesses: what it makes of noise may be wrong. Its guides are the layers `guide-albedo` and `guide-normal`.
    #[arg(long, help_heading = "Output options")]
    pub denoise: bool,
    /// Also write debug views of the light equation as layers of .exr.
    #[arg(long, help_heading = "Output options", value_name = "VIEW,...", value_delimiter = ',',
          value_parser = values::view_list())]
    pub views: Vec<ViewSpec>,
    /// Write the picture so far and the checkpoint this often.
    #[arg(long, help_heading = "Output options", value_name = "SECONDS", value_parser = values::seconds,
          default_value = "10", allow_negative_numbers = true)]
    pub checkpoint_every: f64,
    /// Start over even if there is a checkpoint.
    #[arg(long, help_heading = "Output options")]
    pub restart: bool,

    #[command(flatten)]
    pub trace: TraceOptions,
    /// Trace red, green and blue instead of wavelengths: faster, less exact.
    #[arg(long, help_heading = "Trace options")]
    pub rgb: bool,
    /// Radius of the lens, in world units; 0 is a pinhole.
    #[arg(long, help_heading = "Trace options", value_name = "RADIUS", default_value = "0", value_parser = values::radius,
          allow_negative_numbers = true)]
    pub aperture: f64,
    /// Distance at which the lens is in focus, in world units; by default that of the point the camera looks at.
    #[arg(long, help_heading = "Trace options", value_name = "DISTANCE", value_parser = values::distance,
          allow_negative_numbers = true)]
    pub focus: Option<f64>,
    /// How long the shutter is open, in seconds, from --moment on: what moves is blurred.
    #[arg(long, help_heading = "Trace options", value_name = "SECONDS", default_value = "0",
          value_parser = values::not_negative, allow_negative_numbers = true)]
    pub shutter: f64,

    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The paths of each pixel without `--samples`, `--time` and `--error`.
const DEFAULT_PATHS: u32 = 64;

/// Paths without which the noise of a pixel is not known.
const LEAST_DENOISED: u32 = 4;

impl TraceArgs {
    fn goal(&self) -> TraceGoal {
        self.trace.goal(self.scene.samples, DEFAULT_PATHS)
    }

    fn settings(&self, scene: &Scene, frame: &gonio_scene::Frame) -> TraceSettings {
        let target = scene.settings.camera.target().map(glam::DVec3::from);
        let looked_at = target.unwrap_or(0.5 * (frame.bounds_min + frame.bounds_max));
        let focus = self.focus.unwrap_or_else(|| frame.camera.depth_of(looked_at).max(frame.camera.near));
        let simplified =
            if self.rgb { Simplifications::NONE.with(Simplification::Wavelengths) } else { Simplifications::NONE };
        TraceSettings { simplified, aperture: self.aperture, focus, shutter: self.shutter, ..self.trace.settings() }
    }
}

pub fn run(args: &TraceArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let start = Instant::now();
    let times = Times::default();
    check_stdout(args.output.iter().map(|output| (output, OutputKind::Binary)), reporter)?;
    for output in &args.output {
        run::format_of(output)?;
        output.file().map_or(Ok(()), atomic::check_writable)?;
    }
    if !args.views.is_empty() && !args.output.iter().any(run::is_exr) {
        return Err(CliError::new("--views are layers of an .exr file; add -o FILE.exr"));
    }
    backend::limit_threads(args.trace.threads);
    let options = SceneOptions { samples: None, ..args.scene.clone() };
    let scene = {
        let _busy = reporter.busy("reading the scene");
        times.measure("load", || loading::load_scene(&args.inputs, &options, reporter))?.at(args.trace.moment)
    };
    reporter.diagnostics(&scene.diagnostics);
    loading::check_views(args.views.iter().copied(), &scene)?;
    let frame = scene.frame(args.trace.moment);
    let settings = args.settings(&scene, &frame);
    let ready = {
        let _busy = reporter.busy("preparing the scene");
        times.measure("prepare", || TraceScene::new(&scene, &frame))
    };
    for oddity in ready.oddities() {
        reporter.warning(oddity);
    }
    let run = TraceRun { args, reporter, scene: &scene, frame: &frame, ready: &ready, settings };
    if args.denoise && matches!(args.goal(), TraceGoal::Paths(paths) if paths < LEAST_DENOISED) {
        return Err(CliError::new(format!(
            "--denoise needs at least {LEAST_DENOISED} --samples to tell noise from light; it has {}",
            args.scene.samples.unwrap_or(DEFAULT_PATHS)
        )));
    }
    let film = times.measure("trace", || run.trace(args.goal()))?;
    let written = times.measure("write", || run.write(&film))?;
    run.remove_checkpoint();
    let error = film.error();
    if film.lost_samples() > 0 {
        reporter.warning(format_args!(
            "{} of {} paths were not finite and count as black; the materials or lights are too bright for 32-bit floats",
            film.lost_samples(),
            film.total_samples()
        ));
    }
    times.add("total", start.elapsed());
    reporter.verbose_times(&times);
    if reporter.json() {
        reporter.report(&Report::new(args, &scene, &ready, &film, &times, &written))?;
    } else {
        let paths = match (film.least_samples(), film.most_samples()) {
            (least, most) if least == most => format!("{least} paths per pixel"),
            (least, most) => format!("{least} to {most} paths per pixel"),
        };
        let error = if error.relative.is_finite() {
            format!(", error {:.2} % of the mean brightness", 100.0 * error.relative)
        } else {
            String::new()
        };
        reporter.note(format_args!("{paths}{error}, {:.1} s", start.elapsed().as_secs_f64()));
        if args.denoise {
            reporter.note("denoised: the error above is that of the traced picture; what the filter made of its noise may be wrong");
        }
    }
    Ok(CommandOutcome::Done)
}

/// The report. Times are in milliseconds, sizes in pixels.
#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    outputs: &'a [String],
    width: u32,
    height: u32,
    mode: &'static str,
    max_depth: u32,
    seed: u64,
    paths_least: u32,
    paths_most: u32,
    paths_total: u64,
    paths_lost: u64,
    /// Error of a pixel's luminance relative to the mean luminance; none with one path per pixel.
    error: Option<f64>,
    /// Its upper bound with 95 % confidence.
    error_bound: Option<f64>,
    triangles: usize,
    /// Whether the picture was filtered.
    denoised: bool,
    times_ms: serde_json::Value,
    warnings: &'a [Diagnostic],
}

impl<'a> Report<'a> {
    fn new(
        args: &'a TraceArgs,
        scene: &'a Scene,
        ready: &TraceScene,
        film: &Film,
        times: &Times,
        outputs: &'a [String],
    ) -> Self {
        let error = film.error();
        let finite = |value: f64| value.is_finite().then_some(value);
        Report {
            command: "trace",
            inputs: &args.inputs,
            outputs,
            width: film.width,
            height: film.height,
            mode: if args.rgb { "rgb" } else { "spectral" },
            max_depth: args.trace.max_depth,
            seed: args.trace.seed,
            paths_least: film.least_samples(),
            paths_most: film.most_samples(),
            paths_total: film.total_samples(),
            paths_lost: film.lost_samples(),
            error: finite(error.relative),
            error_bound: finite(error.upper),
            triangles: ready.triangles(),
            denoised: args.denoise,
            times_ms: times.to_json(),
            warnings: &scene.diagnostics,
        }
    }
}
