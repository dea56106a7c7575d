//! The picture of one expression of a pair of shaders.

use super::DrawArgs;
use super::shaders::BACKGROUND;
use crate::commands::lab::step::{SceneRequest, stage_name, with_scene};
use crate::error::{CliError, CommandOutcome};
use crate::report::Reporter;
use clap::ValueEnum;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::step::{ExpressionPicture, SteppedScene};
use gonio_glsl::Stage;
use serde_json::json;

/// A stage of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShownStage {
    Vertex,
    Fragment,
}

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
    let request = SceneRequest { exercise, files, scene: args.scene.clone(), size: args.size, time: args.time };
    let stage = match args.file {
        ShownStage::Vertex => Stage::Vertex,
        ShownStage::Fragment => Stage::Fragment,
    };
    let draw = move |scene: &SteppedScene, of: &gonio_exercises::preview::PreviewScene| {
        let background = BACKGROUND.map(|x| (x * 255.0 + 0.5) as u8);
        let picture = scene.picture(stage, place, background).map_err(CliError::new)?;
        Ok((picture, of.name))
    };
    let ((mut picture, scene), mut warnings) = with_scene(request, draw)?;
    if picture.is_truncated {
        warnings.push("the shader runs for too long: some pixels lack their value".to_owned());
    }
    for warning in &warnings {
        reporter.warning(warning);
    }
    super::write_picture(args, [args.size; 2], std::mem::take(&mut picture.rgba))?;
    if !reporter.json() {
        reporter.note(note(&picture));
        return Ok(CommandOutcome::Done);
    }
    reporter.report(&json!({
        "command": "lab draw",
        "exercise": exercise.id,
        "scene": scene,
        "size": [args.size, args.size],
        "shown": {
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
        },
        "warnings": warnings,
    }))?;
    Ok(CommandOutcome::Done)
}

/// The expression and the meaning of the colours.
fn note(picture: &ExpressionPicture) -> String {
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
