//! The picture of one expression of a pair of shaders.

use super::DrawArgs;
use super::shaders::BACKGROUND;
use crate::commands::lab::step::{SceneRequest, stage_name, with_scene};
use crate::error::{CliError, CommandOutcome};
use crate::report::Reporter;
use clap::ValueEnum;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::PreviewScene;
use gonio_exercises::step::{ExpressionPicture, PictureBeside, RightAnswer, SteppedScene};
use gonio_glsl::Stage;
use serde_json::{Value, json};

/// A stage of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShownStage {
    Vertex,
    Fragment,
}

impl ShownStage {
    /// The stage.
    pub fn stage(self) -> Stage {
        match self {
            ShownStage::Vertex => Stage::Vertex,
            ShownStage::Fragment => Stage::Fragment,
        }
    }
}

/// The colour where nothing is drawn, as it is shown.
pub fn background() -> [u8; 3] {
    BACKGROUND.map(|x| (x * 255.0 + 0.5) as u8)
}

/// The warning about a picture that is not complete.
pub const TOO_LONG: &str = "the shader runs for too long: some pixels lack their value";

/// Parses `LINE:COLUMN`.
pub fn line_and_column(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("invalid place `{text}`: expected LINE:COLUMN, both from 1, for example 26:14");
    let (line, column) = text.split_once(':').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse().ok().filter(|number| *number > 0).ok_or_else(wrong);
    Ok([number(line)?, number(column)?])
}

pub fn run(
    args: &DrawArgs,
    place: [u32; 2],
    exercise: &'static Exercise,
    files: Vec<SourceFile>,
    reporter: &Reporter,
) -> Result<CommandOutcome, CliError> {
    let (scene, is_compared) = (args.scene.clone(), !args.files.is_empty());
    let request = SceneRequest { exercise, files, scene, size: args.size, time: args.time, is_compared };
    let (stage, background) = (args.file.stage(), background());
    let draw = move |scene: &SteppedScene, of: &PreviewScene, right: Option<&RightAnswer>| {
        let pictures = scene.picture(stage, place, background, right).map_err(CliError::new)?;
        Ok((pictures, of.name.clone().into_owned()))
    };
    let ((pictures, scene), mut warnings) = with_scene(request, draw)?;
    let PictureBeside { own: picture, right, quantity } = pictures;
    if picture.is_truncated {
        warnings.push(TOO_LONG.to_owned());
    }
    for warning in &warnings {
        reporter.warning(warning);
    }
    let size = args.size as usize;
    let (size, rgba) = match &right {
        Some(right) => beside(&picture.rgba, &right.rgba, size, background),
        None => ([args.size; 2], picture.rgba.clone()),
    };
    super::write_picture(args, size, rgba)?;
    if !reporter.json() {
        reporter.note(note(&picture));
        if let Some(quantity) = quantity {
            let beside = if right.is_some() { " Its right values are on the right." } else { "" };
            reporter.note(format!("{quantity}{beside}"));
        }
        return Ok(CommandOutcome::Done);
    }
    reporter.report(&json!({
        "command": "lab draw",
        "exercise": exercise.id,
        "scene": scene,
        "size": size,
        "quantity": quantity,
        "right_beside": right.is_some(),
        "shown": shown_to_json(&picture),
        "warnings": warnings,
    }))?;
    Ok(CommandOutcome::Done)
}

/// The expression, the meaning of the colours, and the numbers of pixels.
pub fn shown_to_json(picture: &ExpressionPicture) -> Value {
    json!({
        "expression": picture.expression,
        "stage": stage_name(picture.stage),
        "file": picture.file,
        "line": picture.line,
        "column": picture.column,
        "type": picture.glsl_type,
        "mapping": picture.mapping.to_string(),
        "evaluations": picture.evaluations,
        "pixels": picture.drawn,
        "pixels_not_finite": picture.non_finite,
        "pixels_never_written": picture.unwritten,
        "pixels_not_evaluated": picture.unevaluated,
    })
}

/// Two square pictures with a gap of a thirty-second of their side.
fn beside(left: &[u8], right: &[u8], side: usize, [r, g, b]: [u8; 3]) -> ([u32; 2], Vec<u8>) {
    let gap = (side / 32).max(1);
    let between = [r, g, b, 255].repeat(gap);
    let rows = left.chunks_exact(side * 4).zip(right.chunks_exact(side * 4));
    let rgba = rows.flat_map(|(left, right)| [left, &between, right].concat()).collect();
    ([(2 * side + gap) as u32, side as u32], rgba)
}

/// The expression and the meaning of the colours.
pub fn note(picture: &ExpressionPicture) -> String {
    let ExpressionPicture { expression, file, line, column, glsl_type, mapping, .. } = picture;
    let mut note = format!("{file}:{line}:{column}: `{expression}`, {glsl_type}: {mapping}");
    if picture.stage == Stage::Vertex {
        note.push_str("; interpolated between the vertices");
    }
    if picture.evaluations > 1 {
        note.push_str(&format!("; the last of up to {} values of a pixel", picture.evaluations));
    }
    let pixels = |count: usize| format!("{count} of {} pixels", picture.drawn);
    for (count, what) in [
        (picture.non_finite, "magenta: not a finite number"),
        (picture.unwritten, "cyan: computed from values that were never written"),
        (picture.unevaluated, "chequered: not evaluated"),
    ] {
        if count > 0 {
            note.push_str(&format!("; {what}, at {}", pixels(count)));
        }
    }
    note
}
