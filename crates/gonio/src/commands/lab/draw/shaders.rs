//! Drawing a pair of shaders in the exercise's scene.

use super::DrawArgs;
use crate::capture::CaptureRecorder;
use crate::error::{CliError, CommandOutcome};
use crate::report::Reporter;
use gonio_check::submission::SourceFile;
use gonio_check::user_shaders::message_text;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::{
    self, CompiledPair, Note, NoteKind, PreviewRenderer, PreviewScene, PreviewShape, SubmittedPair, VariableValue,
};
use gonio_gl::HeadlessContext;
use gonio_render::{DisplayTexture, Renderer};
use serde_json::json;

/// The colour where nothing is drawn: the window's dark grey.
pub const BACKGROUND: [f32; 3] = [0.13, 0.14, 0.16];
/// Stack of the drawing thread. The system commits only what is used.
const STACK_BYTES: usize = 256 << 20;

/// Pixels along each side of the picture to reach.
const GOAL: u32 = 512;

/// The result of drawing a pair.
struct Drawn {
    /// RGBA rows, the top row first.
    rgba: Vec<u8>,
    notes: Vec<Note>,
    warnings: Vec<String>,
    variables: Vec<VariableValue>,
}

pub fn run(
    args: &DrawArgs,
    exercise: &'static Exercise,
    files: Vec<SourceFile>,
    reporter: &Reporter,
) -> Result<CommandOutcome, CliError> {
    if args.shown().is_some() {
        return Err(CliError::new(
            "--frame, --draw and --program list the frame of a GL program; a pair of shaders has one draw call per body",
        ));
    }
    let source = SubmittedPair::gather(exercise, files).map_err(CliError::new)?;
    let scene = scene(args.scene.as_deref(), exercise)?;
    let recorder = args.capture.as_deref().map(CaptureRecorder::new).transpose()?;
    let size = [args.size; 2];
    let (time, drawn_scene) = (args.time, scene.clone());
    let drawn = on_a_large_stack(move || draw(size[0], time, &source, &drawn_scene, recorder))?;
    for note in drawn.notes.iter().filter(|note| note.kind == NoteKind::Warning) {
        reporter.warning(note_text(note));
    }
    for warning in &drawn.warnings {
        reporter.warning(warning);
    }
    super::write_picture(args, size, drawn.rgba)?;
    if reporter.json() {
        let variable = |variable: &VariableValue| {
            let role = variable.role.as_ref().map(|(role, _)| role);
            json!({ "name": variable.name, "type": variable.glsl_type, "role": role, "value": variable.value })
        };
        reporter.report(&json!({
            "command": "lab draw",
            "exercise": exercise.id,
            "scene": scene.name,
            "size": size,
            "bound": drawn.variables.iter().map(variable).collect::<Vec<_>>(),
            "warnings": drawn.notes.iter().map(note_text).chain(drawn.warnings.iter().cloned()).collect::<Vec<_>>(),
        }))?;
    }
    Ok(CommandOutcome::Done)
}

/// The picture of the reference solution, as PNG; an error if it cannot be drawn here.
pub fn goal(exercise: &'static Exercise) -> Result<Vec<u8>, CliError> {
    let source = preview::reference(exercise).map_err(CliError::new)?;
    let scene = preview::scenes(exercise).into_iter().next();
    let scene = scene.ok_or_else(|| CliError::new(format!("{} has no scene", exercise.id)))?;
    let drawn = on_a_large_stack(move || draw(GOAL, 0.0, &source, &scene, None))?;
    super::encoded([GOAL; 2], drawn.rgba)
}

/// The scene with this name, or the lab's own.
pub fn scene(name: Option<&str>, exercise: &Exercise) -> Result<PreviewScene, CliError> {
    let mut scenes = preview::scenes(exercise);
    let Some(name) = name else {
        return scenes.into_iter().next().ok_or_else(|| CliError::new(format!("{} has no scene", exercise.id)));
    };
    for test in preview::test_scenes(exercise) {
        if scenes.iter().all(|known| known.name != test.name) {
            scenes.push(test);
        }
    }
    let names: Vec<&str> = scenes.iter().map(|scene| scene.name.as_ref()).collect();
    let known = format!("{} has no scene `{name}`; its scenes are {}", exercise.id, names.join(", "));
    scenes.into_iter().find(|scene| scene.name == name).ok_or_else(|| CliError::new(known))
}

/// Works in a thread with a large stack: drivers recurse along a shader's expressions.
pub fn on_a_large_stack<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, CliError> + Send + 'static,
) -> Result<T, CliError> {
    let drawing = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(work);
    let drawing = drawing.map_err(|error| CliError::io("cannot start the drawing", &error))?;
    drawing.join().unwrap_or_else(|_| std::process::abort())
}

fn draw(
    size: u32,
    time: f64,
    source: &SubmittedPair,
    scene: &PreviewScene,
    mut recorder: Option<CaptureRecorder>,
) -> Result<Drawn, CliError> {
    let context: HeadlessContext = super::context()?;
    let gl = context.gl();
    let pair = source.compile(gl).map_err(compile_error)?;
    if !pair.has_position() {
        return Err(CliError::new(
            "no attribute could be recognised as the position; call it `position`, or state it in names.toml",
        ));
    }
    let sky = match scene.has_sky {
        true => preview::sky().ok().and_then(|sky| sky.compile(gl).ok()),
        false => None,
    };
    let mut renderer = Renderer::new(gl.clone())?;
    let mut canvas = DisplayTexture::new(gl, [size; 2])?;
    let stage = PreviewRenderer::new(gl)?;
    stage.prepare(scene)?;
    let bodies = scene.test_scenes(&scene.eye, time as f32, [size; 2]);
    if let Some(recorder) = &mut recorder {
        recorder.start();
    }
    renderer.paint_user_program(&mut canvas, [size; 2], BACKGROUND, || {
        if let (Some(sky), Some((_, first))) = (&sky, bodies.first()) {
            stage.draw(sky, &[(PreviewShape::Cube, first.clone())]);
        }
        stage.draw(&pair, &bodies);
    })?;
    let rgba = canvas.read8();
    if let Some(recorder) = recorder {
        recorder.finish(gl)?;
    }
    let variables = bodies.first().map(|(_, test_scene)| pair.variable_values(test_scene)).unwrap_or_default();
    let CompiledPair { notes, warnings, .. } = pair;
    // The process ends next, and the system frees it faster.
    std::mem::forget((renderer, canvas, stage, sky, context));
    Ok(Drawn { rgba, notes, warnings, variables })
}

/// The errors of a compiler, one line each.
pub fn compile_error(notes: Vec<Note>) -> CliError {
    CliError::lines(notes.iter().map(note_text))
}

/// A note with its place in the student's files.
pub fn note_text(note: &Note) -> String {
    message_text(&note.message)
}
