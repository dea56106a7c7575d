//! `gonio lab trial`: the process that compiles and draws a pair of shaders before the window's own OpenGL does.

use super::{child_process, exercise};
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use clap::Args;
use gonio_app::platform::desktop::trial::Answer;
use gonio_app::platform::desktop::worker;
use gonio_check::submission::SourceFile;
use gonio_check::testbench::TestScene;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::{self, CompiledPair, PreviewRenderer, PreviewScene, PreviewShape, SubmittedPair};
use gonio_gl::{Gl, GlError, HeadlessContext};
use gonio_render::{DisplayTexture, Renderer};
use std::time::Instant;

/// Stack of the thread that reads, compiles and draws: half of what the window's thread has, for a margin there. The first
/// thread of a program has 1 MB on Windows, and 8 MB on the other systems.
const STACK_BYTES: usize = if cfg!(windows) { 512 * 1024 } else { 4 * 1024 * 1024 };
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

/// Compile and draw the pair of shaders that comes from standard input, for the window.
#[derive(Args, Debug)]
pub struct TrialArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &TrialArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    let mut input = std::io::stdin();
    let unread = |error| CliError::io("cannot read the files to try", &error);
    let files = worker::read_request(&mut input).map_err(unread)?.files;
    child_process::end_with_the_caller();
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(move || answer(exercise, files));
    let thread = thread.map_err(|error| CliError::io("cannot start the thread of the trial", &error))?;
    let answer = match thread.join() {
        Ok(answer) => answer,
        // A panic counts as a crash, as it would in the window.
        Err(_) => std::process::abort(),
    };
    reporter.report(&answer)?;
    Ok(CommandOutcome::Done)
}

fn answer(exercise: &Exercise, files: Vec<SourceFile>) -> Answer {
    let context = match HeadlessContext::new() {
        Ok(context) => context,
        Err(why) => return Answer::Unavailable { why: why.message },
    };
    let pair = SubmittedPair::gather(exercise, files).ok().and_then(|source| source.compile(context.gl()).ok());
    let answer = match pair {
        // The window reports what is wrong: the reader and the driver ended.
        None => Answer::Harmless,
        Some(pair) => match seconds(context.gl(), exercise, &pair) {
            Ok(seconds) if seconds > MOST_SECONDS => Answer::Slow { seconds },
            Ok(_) => Answer::Harmless,
            Err(why) => Answer::Failed { why: why.to_string() },
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
