//! `gonio simplify`: from the rendering equation to the light equation, one simplification at a time. The pictures, the numbers and
//! the page are those of `gonio-simplify`; this module has the options, the progress bar and the files.

use crate::backend;
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{GeneralOptions, SceneOptions, TraceOptions, values};
use crate::output::{OutputFiles, atomic, check_folder};
use crate::report::{Reporter, Times, json_text};
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_mesh::Diagnostic;
use gonio_scene::{Frame, Scene};
use gonio_simplify::report::{StaircaseReport, StepReport, percent, report};
use gonio_simplify::{StaircaseSettings, build, page};
use gonio_trace::{Simplification, TraceScene, TraceSettings};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simplify the rendering equation step by step to the light equation: what each step gives up and saves in a scene.
#[derive(Args, Debug)]
#[command(mut_arg("samples", |arg| arg
    .help("Paths per pixel of every picture; 32 by default")
    .help_heading("Trace options")
    .value_parser(values::paths)
    .allow_negative_numbers(true)
    .conflicts_with_all(["time", "error"])))]
#[command(mut_arg("time", |arg| arg.help("Trace for this many seconds, all pictures together")))]
#[command(mut_arg("error", |arg| arg
    .help("Trace every picture until the error of a pixel is this percentage of the mean brightness, with 95 % confidence")))]
#[command(after_long_help = "\
Examples:
  gonio simplify builtin:glass-and-mirror -o stairs
      Then open stairs/index.html: the formulas, the pictures, the differences, one slide per step.
  gonio simplify scene.toml -o stairs --size 960x640 --error 1
      Larger, and every picture until the error of a pixel is 1 % of the mean brightness.
  gonio simplify scene.toml -o stairs --time 30
      Half a minute for all pictures together.
  gonio simplify scene.toml -o stairs --only shadows
      The truth, and the truth without shadows.
  gonio simplify scene.toml -o stairs --steps time,wavelengths --shutter 0.5
      Two steps; everything that moves does so for half a second.
  gonio simplify scene.toml -o stairs --points 16
      16 point lights replace each lamp.

Every picture is also written as .png and linear .exr, and all numbers as steps.json. Differences that noise explains are called so: \
trace with more --samples to see them.

Steps: time, wavelengths, emission, brdf, interreflection, shadows, cosine, attenuation, sum, ambient.

Exit codes: 0 success, 2 error.")]
pub struct SimplifyArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model or scene.
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,

    /// Folder to write to, created or updated.
    #[arg(long, short, required = true, value_name = "DIR", help_heading = "Output options")]
    pub output: PathBuf,

    /// Make these steps only, in the lecture's order.
    #[arg(long, help_heading = "Equation options", value_name = "STEP,...", value_delimiter = ',',
          value_parser = values::named(Simplification::ALL, Simplification::name), conflicts_with = "only")]
    pub steps: Vec<Simplification>,
    /// Make one simplification by itself.
    #[arg(long, help_heading = "Equation options", value_name = "STEP",
          value_parser = values::named(Simplification::ALL, Simplification::name))]
    pub only: Option<Simplification>,
    /// Point lights that replace each lamp where the integral becomes a sum.
    #[arg(long, help_heading = "Equation options", value_name = "N", default_value = "1",
          value_parser = values::points, allow_negative_numbers = true)]
    pub points: u32,

    #[command(flatten)]
    pub trace: TraceOptions,
    /// Time that the shutter is open, in seconds, for what moves.
    #[arg(long, help_heading = "Trace options", value_name = "SECONDS", default_value = "1",
          value_parser = values::not_negative, allow_negative_numbers = true)]
    pub shutter: f64,

    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Paths of each pixel without `--samples`, `--time` and `--error`.
const DEFAULT_PATHS: u32 = 32;
/// The longest side of the pictures without `--size`.
const DEFAULT_SIDE: u32 = 480;

impl SimplifyArgs {
    fn settings(&self) -> StaircaseSettings {
        let chosen = |one: &Simplification| match self.only {
            Some(only) => *one == only,
            None => self.steps.is_empty() || self.steps.contains(one),
        };
        StaircaseSettings {
            steps: Simplification::ALL.iter().copied().filter(chosen).collect(),
            alone: self.only.is_none(),
            goal: self.trace.goal(self.scene.samples, DEFAULT_PATHS),
            trace: TraceSettings { points_per_light: self.points, shutter: self.shutter, ..self.trace.settings() },
        }
    }

    /// The scene, no larger than [`DEFAULT_SIDE`] unless a size was asked for.
    fn load(&self, reporter: &Reporter) -> Result<Scene, CliError> {
        let options = SceneOptions { samples: None, ..self.scene.clone() };
        let mut scene = loading::load_scene(&self.inputs, &options, reporter)?.at(self.trace.moment);
        let picture = &mut scene.settings.picture;
        let longest = picture.width.max(picture.height);
        if self.scene.size.is_none() && longest > DEFAULT_SIDE {
            let scaled = |side: u32| (u64::from(side) * u64::from(DEFAULT_SIDE) / u64::from(longest)).max(1) as u32;
            (picture.width, picture.height) = (scaled(picture.width), scaled(picture.height));
        }
        Ok(scene)
    }

    /// The command that makes the same folder.
    fn command(&self) -> String {
        let quoted = |text: &str| {
            let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,".contains(c);
            if !text.is_empty() && text.chars().all(is_plain) { text.to_owned() } else { format!("\"{text}\"") }
        };
        std::env::args_os().skip(1).fold("gonio".to_owned(), |all, word| all + " " + &quoted(&word.to_string_lossy()))
    }
}

/// Makes the folder.
pub fn run(args: &SimplifyArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let start = Instant::now();
    let times = Times::default();
    check_folder(&args.output, "`gonio simplify`")?;
    if args.output.exists() && !args.output.is_dir() {
        return Err(CliError::new(format!("`{}` is a file; name a folder with -o", args.output.display())));
    }
    {
        // Whether the folder can be written to is known before the work is done; an interruption leaves none behind.
        let mut tried = OutputFiles::new();
        tried.make_folder(&args.output)?;
        atomic::check_writable(&args.output.join("index.html"))?;
    }
    backend::limit_threads(args.trace.threads);
    let scene = {
        let _busy = reporter.busy("reading the scene");
        times.measure("load", || args.load(reporter))?
    };
    reporter.diagnostics(&scene.diagnostics);
    let frame = scene.frame(args.trace.moment);
    let settings = args.settings();
    let ready = {
        let _busy = reporter.busy("preparing the scene");
        times.measure("prepare", || TraceScene::new(&scene, &frame))
    };
    for oddity in ready.oddities() {
        reporter.warning(oddity);
    }
    reporter.verbose(format_args!("tracing pictures of {}x{} pixels", frame.width, frame.height));
    let progress = reporter.progress("truth");
    let staircase = times.measure("trace", || {
        build(&scene, &frame, &ready, &settings, &computing_time, &|share, what| {
            progress.set(share);
            progress.message(what.to_owned());
            true
        })
    });
    drop(progress);
    let staircase = staircase.ok_or_else(|| CliError::new("tracing was stopped"))?;
    let numbers = {
        let _busy = reporter.busy("writing the page");
        let numbers = times.measure("measure", || report(&scene, &frame, &settings, &staircase));
        let subject = subject(&args.inputs);
        times.measure("write", || -> Result<(), CliError> {
            let mut files = OutputFiles::new();
            files.make_folder(&args.output)?;
            let made = page::files(&staircase, &numbers, &frame, &subject, &args.command())?;
            let json = json_text(&numbers)?;
            files.add(&args.output.join("steps.json"), json.as_bytes())?;
            // The page comes last, so that all files it belongs to are there.
            for (name, bytes) in made {
                files.add(&args.output.join(name), &bytes)?;
            }
            files.commit()
        })?;
        numbers
    };
    if let Some(missed) = numbers.missed() {
        reporter.warning(format_args!("{missed}; choose a larger --error, or a number of --samples"));
    }
    times.add("total", start.elapsed());
    reporter.verbose_times(&times);
    if reporter.json() {
        reporter.report(&Report::new(args, &scene, &numbers, &frame, &times))?;
    } else {
        if !args.general.quiet {
            reporter.text(&text(&numbers))?;
        }
        let page = args.output.join("index.html");
        reporter.note(format_args!("{:.1} s; open {}", start.elapsed().as_secs_f64(), page.display()));
    }
    Ok(CommandOutcome::Done)
}

/// The names of the inputs, without folders.
fn subject(inputs: &[String]) -> String {
    let name = |input: &String| match Path::new(input).file_name() {
        Some(name) if !input.starts_with("builtin:") => name.to_string_lossy().into_owned(),
        _ => input.clone(),
    };
    inputs.iter().map(name).collect::<Vec<_>>().join(" and ")
}

/// One line per step, and its sentence.
fn text(numbers: &StaircaseReport) -> TerminalPage {
    let mut page = TerminalPage::new();
    page.line(format_args!("{:34}{:>10}{:>12}{:>10}{:>10}", "", "radiance", "RMS", "noise", "FLIP"));
    page.line(format_args!("{:34}{:>10.4}", "0  the rendering equation", numbers.truth.mean));
    let line = |page: &mut TerminalPage, step: &StepReport| {
        page.line(format_args!(
            "{:34}{:>10.4}{:>12}{:>10}{:>10.4}",
            format!("{:3}{}", step.number, step.title),
            step.picture.mean,
            percent(step.to_truth.rms),
            percent(step.to_truth.noise),
            step.to_truth.flip
        ));
    };
    for step in &numbers.steps {
        line(&mut page, step);
        page.line(format_args!("   {}", step.look));
    }
    if !numbers.alone.is_empty() {
        page.blank();
        page.line("each alone");
        for step in &numbers.alone {
            line(&mut page, step);
        }
    }
    if let Some(fit) = &numbers.ambient {
        let [r, g, b] = fit.color.to_array();
        page.blank();
        page.line(format_args!(
            "The ambient light that loses least is {r:.4}, {g:.4}, {b:.4}: {} remains on the objects, instead of {} with the scene's \
             own and {} without.",
            percent(fit.rms_fitted),
            percent(fit.rms_own),
            percent(fit.rms_without)
        ));
    }
    page
}

/// The whole report.
#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    output: &'a Path,
    page: PathBuf,
    moment: f64,
    seed: u64,
    #[serde(flatten)]
    numbers: &'a StaircaseReport,
    times_ms: serde_json::Value,
    warnings: &'a [Diagnostic],
}

impl<'a> Report<'a> {
    fn new(
        args: &'a SimplifyArgs,
        scene: &'a Scene,
        numbers: &'a StaircaseReport,
        frame: &Frame,
        times: &Times,
    ) -> Self {
        Report {
            command: "simplify",
            inputs: &args.inputs,
            output: &args.output,
            page: args.output.join("index.html"),
            moment: frame.time,
            seed: args.trace.seed,
            numbers,
            times_ms: times.to_json(),
            warnings: &scene.diagnostics,
        }
    }
}

/// Seconds that all threads of this process have computed so far.
#[cfg(unix)]
fn computing_time() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// Seconds of the wall, because this system reports no computing time.
#[cfg(not(unix))]
fn computing_time() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}
