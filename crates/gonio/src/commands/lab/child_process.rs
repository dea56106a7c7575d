//! Processes of gonio's own, which a shader may crash.
//!
//! A command runs again in one. `gonio lab check-worker` is the one that a check runs in (see
//! [`gonio_app::platform::desktop::worker`]), and `gonio lab trial` compiles and draws a pair of shaders before the window's own
//! OpenGL does.

use super::exercise;
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions};
use crate::report::{Reporter, output_for_gonio};
use clap::Args;
use gonio_app::platform::desktop::child;
use gonio_app::platform::desktop::trial::TrialAnswer;
use gonio_app::platform::desktop::worker::{self, WorkerAnswer, WorkerRequest};
use gonio_check::submission::SourceFile;
use gonio_check::testbench::TestScene;
use gonio_exercises::Checker;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::{self, CompiledPair, PreviewRenderer, PreviewScene, PreviewShape, SubmittedPair};
use gonio_exercises::report;
use gonio_gl::headless::HeadlessOptions;
use gonio_gl::{DeferredGl, Dialect, Gl, GlError, HeadlessContext};
use gonio_render::{DisplayTexture, Renderer};
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Seconds that it may take; an endless loop takes more.
const PATIENCE_S: u64 = 30;

/// Runs this program with its own arguments and `flag` after the command's name of two words. The process prints and writes by
/// itself; the error here is that it was stopped or crashed.
pub fn run_again(flag: &str) -> Result<CommandOutcome, CliError> {
    run_again_within(flag, 2, Duration::from_secs(PATIENCE_S), child::MOST_RESIDENT_KB)
}

/// [`run_again`] for a command's name of `words` words, with other limits on time and memory.
pub fn run_again_within(
    flag: &str,
    words: usize,
    patience: Duration,
    most_resident_kb: u64,
) -> Result<CommandOutcome, CliError> {
    let not_started = |error| CliError::io("gonio cannot start itself", &error);
    let mut arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    arguments.insert(arguments.len().min(words), flag.into());
    let mut command = child::command(&own_program()?).map_err(not_started)?;
    command.env_remove("LP_NUM_THREADS").args(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::inherit()).stderr(Stdio::inherit());
    let mut child = command.spawn().map_err(not_started)?;
    // Its stdin stays open as long as this process waits.
    let ended = child::wait_within(&mut child, patience, most_resident_kb, || false);
    match ended.map_err(|error| CliError::io("cannot wait for gonio's own process", &error))? {
        child::Ended::ByItself(status) => match status.code() {
            Some(0) => Ok(CommandOutcome::Done),
            Some(1) => Ok(CommandOutcome::CheckFailed),
            Some(2) => Err(CliError::AlreadyReported),
            _ => Err(CliError::new("drawing crashed: the graphics driver cannot compile or run this shader")),
        },
        child::Ended::TooLong => Err(CliError::new(format!(
            "drawing did not finish within {} seconds; does a shader contain an endless loop?",
            patience.as_secs()
        ))),
        child::Ended::TooLarge => Err(CliError::new(format!(
            "drawing took more than {} gigabytes of memory and was stopped; does a shader contain a giant array?",
            most_resident_kb >> 20
        ))),
        child::Ended::GivenUp => Err(CliError::new("drawing was stopped")),
    }
}

/// Ends this process when the one that waits for it has ended.
pub fn end_with_the_caller() {
    std::thread::spawn(|| worker::end_with(std::io::stdin()));
}

/// Stack of the thread that reads, compiles and draws: drivers recurse along the shader. The system commits only what is used.
const STACK_BYTES: usize = 256 << 20;

/// Reads requests from stdin and writes the answers to stdout, until the caller ends.
pub fn check_worker() -> Result<CommandOutcome, CliError> {
    let serve = || {
        gonio_check::start_threads();
        let mut ready = None;
        // `exit` would wait for the driver.
        worker::serve(
            std::io::stdin(),
            output_for_gonio(),
            |request| check(request, &mut ready),
            || std::process::abort(),
        )
    };
    let serving = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(serve);
    let serving = serving.map_err(|error| CliError::io("cannot start the check", &error))?;
    // A panic has been reported on stderr; without an answer the process counts as crashed.
    let served = serving.join().unwrap_or_else(|_| std::process::abort());
    served.map_err(|error| CliError::io("cannot answer the check", &error))?;
    Ok(CommandOutcome::Done)
}

/// Most bytes of a file that a page may show.
const MAX_SHOWN_BYTES: usize = 1 << 20;

/// A checker, kept from one check to the next.
struct ReadyChecker {
    es: bool,
    checker: Checker,
}

/// A checker that opens OpenGL when a check needs it.
fn ready_checker(es: bool, kept: &mut Option<ReadyChecker>) -> &mut Checker {
    if kept.is_none() {
        HeadlessContext::start_driver(HeadlessOptions { es, ..HeadlessOptions::default() });
    }
    let ready = kept.take().filter(|kept| kept.es == es).unwrap_or_else(|| {
        let dialect = if es { Dialect::Es300 } else { Dialect::Core330 };
        let open = move || {
            let options = HeadlessOptions { es, ..HeadlessOptions::default() };
            // What is opened keeps the context.
            HeadlessContext::with_options(&options).map(|context| context.gl().clone())
        };
        ReadyChecker { es, checker: Checker::deferred(DeferredGl::new(dialect, open)) }
    });
    &mut kept.insert(ready).checker
}

fn check(request: WorkerRequest, kept: &mut Option<ReadyChecker>) -> Result<WorkerAnswer, String> {
    let checker = ready_checker(request.es, kept);
    let exercise = exercise(&request.exercise).map_err(|error| error.to_string())?;
    let feedback = request.feedback.unwrap_or(exercise.feedback);
    let is_shown = |file: &&SourceFile| request.page.is_some() && file.bytes.len() <= MAX_SHOWN_BYTES;
    let sources: Vec<SourceFile> = request.files.iter().filter(is_shown).cloned().collect();
    let checked = gonio_exercises::check(checker, exercise, request.files, &request.options, feedback);
    let (mut verdict, evidence) = checked.map_err(|error| CliError::from(error).to_string())?;
    verdict.warnings.extend(request.left_out);
    let page = request.page.map(|label| report::page(&label, &verdict, evidence.as_ref(), &sources).into_bytes());
    let drawn = evidence.as_ref();
    let thumbnail =
        drawn.filter(|_| page.is_some()).and_then(|evidence| report::SubmissionThumbnail::new(&verdict, evidence));
    let sheet = drawn.filter(|_| request.sheet).map(|evidence| report::contact_sheet(evidence, &verdict));
    Ok(WorkerAnswer { verdict, page, thumbnail, sheet })
}

/// gonio's own program, for processes that a shader may crash.
pub fn own_program() -> Result<PathBuf, CliError> {
    std::env::current_exe().map_err(|error| CliError::io("cannot find gonio's own program", &error))
}

/// Stack of the thread that reads, compiles and draws: half of what the window's thread has, for a margin there. The first
/// thread of a program has 1 MB on Windows, and 8 MB on the other systems.
const TRIAL_STACK_BYTES: usize = if cfg!(windows) { 512 * 1024 } else { 4 * 1024 * 1024 };
/// Pixels along each side of the pictures.
const SIDE: u32 = 128;
/// The colour where nothing is drawn.
const BACKGROUND: [f32; 3] = [0.13, 0.14, 0.16];
/// Seconds of `now` at which each scene is drawn. The first picture is drawn twice: a driver may compile at the first draw.
const TIMES: [f64; 4] = [0.0, 0.0, 1.0, 60.0];
/// Pixels of the picture in a large window.
const LARGE_PIXELS: f64 = 1_048_576.0;
/// Seconds that it may take.
const MOST_SECONDS: f64 = 8.0;
/// The number of times that a slow picture is drawn again: the machine may have been busy.
const REPEATS: usize = 2;

/// Run one check that comes from standard input.
#[derive(Args, Debug)]
pub struct CheckWorkerArgs {
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Compile and draw the pair of shaders that comes from standard input, for the window.
#[derive(Args, Debug)]
pub struct TrialArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run_trial(args: &TrialArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    let mut input = std::io::stdin();
    let unread = |error| CliError::io("cannot read the files to try", &error);
    let files = worker::read_request(&mut input).map_err(unread)?.files;
    end_with_the_caller();
    let thread = std::thread::Builder::new().stack_size(TRIAL_STACK_BYTES).spawn(move || try_files(exercise, files));
    let thread = thread.map_err(|error| CliError::io("cannot start the thread of the trial", &error))?;
    let answer = match thread.join() {
        Ok(answer) => answer,
        // A panic counts as a crash, as it would in the window.
        Err(_) => std::process::abort(),
    };
    reporter.report(&answer)?;
    Ok(CommandOutcome::Done)
}

fn try_files(exercise: &Exercise, files: Vec<SourceFile>) -> TrialAnswer {
    let context = match HeadlessContext::new() {
        Ok(context) => context,
        Err(error) => return TrialAnswer::Unavailable { why: error.message },
    };
    let pair = SubmittedPair::gather(exercise, files).ok().and_then(|source| source.compile(context.gl()).ok());
    let answer = match pair {
        // The window reports what is wrong: the reader and the driver ended.
        None => TrialAnswer::Harmless,
        Some(pair) => match seconds(context.gl(), exercise, &pair) {
            Ok(seconds) if seconds > MOST_SECONDS => TrialAnswer::Slow { seconds },
            Ok(_) => TrialAnswer::Harmless,
            Err(error) => TrialAnswer::Failed { why: error.to_string() },
        },
    };
    // The process ends next, and the system frees it faster.
    std::mem::forget(context);
    answer
}

/// Draws all scenes, and estimates how long the slowest picture takes in a large window.
fn seconds(gl: &Gl, exercise: &Exercise, pair: &CompiledPair) -> Result<f64, GlError> {
    let mut preview = Preview {
        renderer: Renderer::new(gl.clone())?,
        canvas: DisplayTexture::new(gl, [SIDE; 2])?,
        stage: PreviewRenderer::new(gl)?,
    };
    let scale = LARGE_PIXELS / f64::from(SIDE * SIDE);
    let mut slowest = 0.0_f64;
    for scene in preview::scenes(exercise) {
        for (index, time) in TIMES.into_iter().enumerate() {
            let drawn = preview.draw(pair, &scene, time, if index == 0 { 0 } else { REPEATS }, MOST_SECONDS / scale)?;
            if index > 0 {
                slowest = slowest.max(drawn * scale);
            }
        }
    }
    // The process ends next, and the system frees it faster.
    std::mem::forget(preview);
    Ok(slowest)
}

struct Preview {
    renderer: Renderer,
    canvas: DisplayTexture,
    stage: PreviewRenderer,
}

impl Preview {
    /// Draws a scene, and again up to `repeats` times while it takes longer than `most` seconds. Returns the shortest time.
    fn draw(
        &mut self,
        pair: &CompiledPair,
        scene: &PreviewScene,
        time: f64,
        repeats: usize,
        most: f64,
    ) -> Result<f64, GlError> {
        self.stage.prepare(scene)?;
        let bodies: Vec<(PreviewShape, TestScene)> = scene.test_scenes(&scene.eye, time as f32, [SIDE; 2]);
        let mut shortest = f64::INFINITY;
        for _ in 0..=repeats {
            let start = Instant::now();
            let stage = &self.stage;
            self.renderer.paint_user_program(&mut self.canvas, [SIDE; 2], BACKGROUND, || stage.draw(pair, &bodies))?;
            // Wait for the picture.
            self.canvas.read8();
            shortest = shortest.min(start.elapsed().as_secs_f64());
            if shortest <= most {
                break;
            }
        }
        Ok(shortest)
    }
}
