//! `gonio lab step`: a student's shaders with the value of every variable at one pixel or vertex.

pub mod text;

use super::{child_process, exercise, intake};
use crate::backend;
use crate::commands::lab::draw::shaders::{compile_error, note_text, on_a_large_stack, scene};
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions, values};
use crate::report::Reporter;
use clap::Args;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::{Exercise, ExerciseKind};
use gonio_exercises::preview::{self, NoteKind, PreviewScene, SubmittedPair};
use gonio_exercises::step::{
    ListedPlace, ListedStep, ListedVariable, PixelSurface, RightAnswer, RightValue, ShownValue, StepListing,
    StepOptions, SteppedPair, SteppedPlace, SteppedScene,
};
use gonio_glsl::Stage;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;

/// The number of steps in the report of `--json`.
const MOST_STEPS: usize = 10_000;

/// Show the value of every variable of a student's shaders at one pixel or vertex.
#[derive(Args, Debug)]
#[command(after_long_help = "\
The shaders run on the CPU, in the order of their statements. Beside each line are the values that it wrote, matrices by rows. \
Lines that run several times, in loops and functions, refer to numbered steps below the source. Declarations show the values of \
varyings and uniforms. Below the line where the values begin to be wrong is what they should be. The end names reads of values that were never written, where the first NaN or infinity arose, a \
`discard`, and a loop that does not end.

Examples:
  gonio lab step ex07 mine --at 300,200
      The fragment shader at a pixel of the picture that `gonio lab draw ex07 mine` writes.
  gonio lab step ex07 mine --at 300,200 --corners
      Also the vertex shader at the three corners of the triangle there.
  gonio lab step ex07 mine --vertex 1310
      The vertex shader at one vertex.
  gonio lab step ex07 mine --scene stretched
      Without a place, the drawn pixel nearest to the picture's middle.")]
pub struct StepArgs {
    /// Exercise: ex07, or 7.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// The student's files, or their folder or zip; by default the reference solution.
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// The pixel: column and row, counted from 0 at the top left.
    #[arg(long, value_name = "X,Y", value_parser = values::pixel, allow_hyphen_values = true, conflicts_with = "vertex",
          help_heading = "Drawing options")]
    pub at: Option<(u32, u32)>,
    /// Step through the vertex shader at this vertex, counted from 0 over all objects of the scene.
    #[arg(long, value_name = "N", help_heading = "Drawing options")]
    pub vertex: Option<u32>,
    /// Also step through the vertex shader at the corners of the pixel's triangle.
    #[arg(long, conflicts_with = "vertex", help_heading = "Drawing options")]
    pub corners: bool,
    /// Pixels along each side of the picture.
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096),
          help_heading = "Drawing options")]
    pub size: u32,
    /// Scene, by its name; by default the lab's own.
    #[arg(long, value_name = "NAME", help_heading = "Drawing options")]
    pub scene: Option<String>,
    /// Time in seconds, for a light that moves.
    #[arg(long, value_name = "SECONDS", value_parser = values::number, allow_negative_numbers = true, default_value = "0",
          help_heading = "Drawing options")]
    pub time: f64,
    /// Run in this process, which the caller guards.
    #[arg(long, hide = true)]
    pub in_this_process: bool,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// What a command does with a pair of shaders in a scene.
pub struct SceneRequest {
    /// The exercise.
    pub exercise: &'static Exercise,
    /// The student's files.
    pub files: Vec<SourceFile>,
    /// The scene; by default the lab's own.
    pub scene: Option<String>,
    /// Pixels along each side of the picture.
    pub size: u32,
    /// Seconds.
    pub time: f64,
    /// Whether the pair is compared with the right answer.
    pub is_compared: bool,
}

/// The place to step through.
#[derive(Clone, Copy)]
pub struct StepPlace {
    /// Column and row from the top left; by default the drawn pixel nearest to the middle.
    pub at: Option<(u32, u32)>,
    /// A vertex, counted over all objects, in place of a pixel.
    pub vertex: Option<u32>,
    /// Whether the vertex shader at the corners of the pixel's triangle is listed too.
    pub corners: bool,
    /// The option that chooses a vertex.
    pub vertex_option: &'static str,
}

/// The place that was stepped through, and the listings: the fragment shader's, then those of vertices.
pub struct Stepped {
    pixel: Option<([u32; 2], PixelSurface)>,
    vertices: Vec<u32>,
    listings: Vec<StepListing>,
    /// The right values at the causes of what is wrong, of each listing.
    right: Vec<Vec<RightValue>>,
}

pub fn run(args: &StepArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    if !args.in_this_process {
        return child_process::run_again("--in-this-process");
    }
    child_process::end_with_the_caller();
    let files = match args.files.as_slice() {
        [] => {
            exercise.reference_files().map_err(CliError::new)?.map(|(name, text)| SourceFile::new(name, text)).collect()
        }
        named => intake::read(named)?,
    };
    backend::report_driver(reporter);
    let (scene, is_compared) = (args.scene.clone(), !args.files.is_empty());
    let request = SceneRequest { exercise, files, scene, size: args.size, time: args.time, is_compared };
    let place = StepPlace { at: args.at, vertex: args.vertex, corners: args.corners, vertex_option: "--vertex" };
    let step = move |scene: &_, of: &PreviewScene, right: Option<&_>| {
        Ok((step(scene, right, place)?, of.name.clone().into_owned()))
    };
    let ((stepped, scene), warnings) = with_scene(request, step)?;
    for warning in &warnings {
        reporter.warning(warning);
    }
    if reporter.json() {
        let mut report = json!({
            "command": "lab step",
            "exercise": exercise.id,
            "scene": scene,
            "size": [args.size, args.size],
            "warnings": warnings,
        });
        stepped.add_to(&mut report);
        reporter.report(&report)?;
    } else {
        reporter.text(&text::page(&exercise.id, &format!("scene `{scene}`"), [args.size; 2], &stepped))?;
    }
    Ok(CommandOutcome::Done)
}

/// Compiles a pair of shaders for OpenGL, which lists its variables and reports errors, and for the interpreter, and runs it
/// over the vertices of a scene. Returns warnings too.
pub fn with_scene<T: Send + 'static>(
    request: SceneRequest,
    use_it: impl FnOnce(&SteppedScene, &PreviewScene, Option<&RightAnswer>) -> Result<T, CliError> + Send + 'static,
) -> Result<(T, Vec<String>), CliError> {
    let SceneRequest { exercise, files, scene: name, size, time, is_compared } = request;
    if exercise.kind != ExerciseKind::Shaders || !preview::is_drawn(exercise) {
        return Err(CliError::new(format!("{} has no pair of shaders to step through", exercise.id)));
    }
    let source = SubmittedPair::gather(exercise, files).map_err(CliError::new)?;
    let scene = scene(name.as_deref(), exercise)?;
    on_a_large_stack(move || {
        let context = super::draw::context()?;
        let compiled = source.compile(context.gl()).map_err(compile_error)?;
        let pair = SteppedPair::new(&source, &compiled.bindings).map_err(|note| compile_error(vec![note]))?;
        let notes = compiled.notes.iter().filter(|note| note.kind == NoteKind::Warning).map(note_text);
        let warnings = notes.chain(compiled.warnings.iter().cloned()).collect();
        let objects = scene.test_scenes(&scene.eye, time as f32, [size; 2]);
        let right = is_compared.then(|| RightAnswer::new(exercise, &source)).flatten();
        let stepped = SteppedScene::new(Arc::new(pair), &objects, StepOptions::square(size));
        let result = use_it(&stepped, &scene, right.as_ref());
        // The process ends next, and the system frees it faster.
        std::mem::forget((compiled, context));
        Ok((result?, warnings))
    })
}

/// Steps through the shaders of a scene.
pub fn step(scene: &SteppedScene, right: Option<&RightAnswer>, place: StepPlace) -> Result<Stepped, CliError> {
    let StepPlace { vertex, corners, .. } = place;
    let right_at = |place| right.map_or_else(Vec::new, |right| scene.right_at(right, place));
    if let Some(vertex) = vertex {
        let listing = scene.step_vertex(vertex).ok_or_else(|| {
            CliError::new(format!("there is no vertex {vertex}; the scene has {}, from 0 on", scene.vertex_count()))
        })?;
        let right = vec![right_at(SteppedPlace::Vertex(vertex))];
        return Ok(Stepped { pixel: None, vertices: vec![vertex], listings: vec![listing], right });
    }
    let pixel = the_pixel(scene, place)?;
    let (Some(surface), Some(listing)) = (scene.surface(pixel), scene.step_pixel(pixel)) else {
        return Err(CliError::new(format!("nothing is drawn at pixel {},{}", pixel[0], pixel[1])));
    };
    let vertices = if corners { surface.vertices.to_vec() } else { Vec::new() };
    let of_vertices = vertices.iter().filter_map(|vertex| scene.step_vertex(*vertex));
    let listings = std::iter::once(listing).chain(of_vertices).collect();
    let places = std::iter::once(SteppedPlace::Pixel(pixel));
    let right = places.chain(vertices.iter().copied().map(SteppedPlace::Vertex)).map(right_at).collect();
    Ok(Stepped { pixel: Some((pixel, surface)), vertices, listings, right })
}

/// The pixel, if something is drawn there; without one, that nearest to the middle.
fn the_pixel(scene: &SteppedScene, place: StepPlace) -> Result<[u32; 2], CliError> {
    let StepPlace { at, vertex_option: option, .. } = place;
    let [width, height] = scene.size();
    let [x, y] = at.map_or([width / 2, height / 2], |(x, y)| [x, y]);
    let Some([near_x, near_y]) = scene.nearest_drawn([x, y]) else {
        return Err(CliError::new(match scene.endless_vertex() {
            Some(vertex) => format!(
                "the vertex shader does not end at vertex {vertex}, so nothing is drawn; `{option} {vertex}` steps through it"
            ),
            None => format!("nothing is drawn anywhere; `{option} 0` steps through the vertex shader"),
        }));
    };
    match at {
        None => Ok([near_x, near_y]),
        Some(_) if x >= width || y >= height => Err(CliError::new(format!(
            "pixel {x},{y} is outside of the picture of {width}x{height} pixels; something is drawn at {near_x},{near_y}"
        ))),
        Some(_) if [near_x, near_y] != [x, y] => Err(CliError::new(format!(
            "nothing is drawn at pixel {x},{y}; the nearest pixel where something is drawn is {near_x},{near_y}"
        ))),
        Some(_) => Ok([x, y]),
    }
}

/// The stage in words.
pub fn stage_name(stage: Stage) -> &'static str {
    if stage == Stage::Vertex { "vertex" } else { "fragment" }
}

impl Stepped {
    /// Adds the place and the listings to a report.
    pub fn add_to(&self, report: &mut Value) {
        if let Some((pixel, surface)) = &self.pixel {
            report["pixel"] = json!(pixel);
            report["object"] = json!(surface.object);
            report["triangle"] = json!(surface.triangle);
            report["triangle_vertices"] = json!(surface.vertices);
            report["weights"] = json!(surface.shares);
        }
        let first_vertex = usize::from(self.pixel.is_some());
        let listing = |(index, listing): (usize, &StepListing)| {
            let vertex = index.checked_sub(first_vertex).and_then(|index| self.vertices.get(index));
            let mut report = listing_to_json(listing, vertex.copied());
            let right = self.right.get(index).into_iter().flatten();
            report["should_be"] = right.map(right_to_json).collect();
            report
        };
        report["stages"] = self.listings.iter().enumerate().map(listing).collect();
    }
}

fn listing_to_json(listing: &StepListing, vertex: Option<u32>) -> Value {
    let place =
        |place: &ListedPlace| json!({ "line": place.line, "column": place.column, "expression": place.expression });
    let not_run = listing.lines.iter().filter(|line| line.ran == Some(false)).map(|line| line.number);
    json!({
        "stage": stage_name(listing.stage),
        "file": listing.file,
        "vertex": vertex,
        "inputs": listing.inputs.iter().map(variable).collect::<Vec<_>>(),
        "steps": listing.steps.iter().take(MOST_STEPS).enumerate().map(step_to_json).collect::<Vec<_>>(),
        "outputs": listing.outputs.iter().map(variable).collect::<Vec<_>>(),
        "lines_not_run": not_run.collect::<Vec<_>>(),
        "never_written": listing.unwritten.iter().map(place).collect::<Vec<_>>(),
        "first_not_finite": listing.non_finite.as_ref().map(|(found, value)| {
            let mut found = place(found);
            found["value"] = value.to_json();
            found
        }),
        "discarded_at_line": listing.discarded,
        "endless_loop": listing.endless.map(|(line, statements)| json!({ "line": line, "statements": statements })),
        "more_steps": listing.is_truncated || listing.steps.len() > MOST_STEPS,
    })
}

fn right_to_json(right: &RightValue) -> Value {
    json!({
        "line": right.line,
        "column": right.column,
        "expression": right.expression,
        "should": right.should,
        "value": right.value.as_ref().map(ShownValue::to_json),
    })
}

fn variable(variable: &ListedVariable) -> Value {
    json!({
        "name": variable.name,
        "type": variable.glsl_type,
        "line": variable.line,
        "uniform": variable.is_uniform,
        "value": variable.value.to_json(),
    })
}

fn step_to_json((index, step): (usize, &ListedStep)) -> Value {
    let write =
        |write: &ListedVariable| json!({ "name": write.name, "type": write.glsl_type, "value": write.value.to_json() });
    let condition = |found: &gonio_exercises::step::ListedCondition| json!({ "expression": found.expression, "holds": found.holds });
    json!({
        "step": index + 1,
        "line": step.line,
        "function": step.function,
        "calls": step.calls,
        "iterations": step.iterations,
        "conditions": step.conditions.iter().map(condition).collect::<Vec<_>>(),
        "writes": step.writes.iter().map(write).collect::<Vec<_>>(),
    })
}
