//! The picture of one expression of the user's own shaders.

use super::RenderArgs;
use super::plan::PictureFormat;
use super::shaders::SteppedShaders;
use crate::commands::lab::draw::show::{ShownStage, TOO_LONG, background, note, shown_to_json};
use crate::error::{CliError, CommandOutcome};
use crate::output::OutputFiles;
use crate::report::Reporter;
use gonio_exercises::step::{PictureBeside, StepWork};
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{self, ColorTag};
use serde_json::json;

/// The work of the fragment shader at all pixels: an endless loop ends after twenty seconds.
const WORK: StepWork = StepWork { picture: 200_000_000, ..StepWork::PATIENT };

pub fn run(args: &RenderArgs, place: [u32; 2], reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let plans = args.plans(reporter)?;
    if args.frames.is_some() || plans.iter().any(|plan| plan.format != PictureFormat::Png || plan.bits != 8) {
        return Err(CliError::new("--show draws one picture of 8 bits per channel; write .png, without --frames"));
    }
    let (own, stage) = match (args.file, &args.shaders.fragment) {
        (Some(ShownStage::Vertex), _) | (None, None) => (&args.shaders.vertex, ShownStage::Vertex),
        (Some(ShownStage::Fragment), _) | (None, Some(_)) => (&args.shaders.fragment, ShownStage::Fragment),
    };
    if own.is_none() {
        let option = if stage == ShownStage::Vertex { "--vertex" } else { "--fragment" };
        return Err(CliError::new(format!("--show points into gonio's own shader; add {option}, or change --file")));
    }
    let SteppedShaders { scene, stepped, .. } =
        args.shaders.in_scene(&args.inputs, &args.scene, args.time, WORK, reporter)?;
    let PictureBeside { own: picture, .. } =
        stepped.picture(stage.stage(), place, background(), None).map_err(CliError::new)?;
    if picture.is_truncated {
        reporter.warning(TOO_LONG);
    }
    let [width, height] = stepped.size();
    let encoded = EncodedPicture { width, height, rgba: picture.rgba.clone() };
    let bytes = png::encode8(&encoded, ColorTag::Srgb)?;
    let mut files = OutputFiles::new();
    for plan in &plans {
        files.add_output(&plan.output(0, None), bytes.clone())?;
    }
    files.commit()?;
    if !reporter.json() {
        reporter.note(note(&picture));
        return Ok(CommandOutcome::Done);
    }
    reporter.report(&json!({
        "command": "render",
        "inputs": args.inputs,
        "outputs": args.output.iter().filter_map(|output| output.file()).map(|p| p.display().to_string()).collect::<Vec<_>>(),
        "width": width,
        "height": height,
        "shown": shown_to_json(&picture),
        "warnings": scene.diagnostics,
    }))?;
    Ok(CommandOutcome::Done)
}
