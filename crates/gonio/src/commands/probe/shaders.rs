//! Steps through the user's own shaders at a pixel or a vertex of any scene.

use super::ProbeArgs;
use crate::commands::lab::step::{StepPlace, step, text};
use crate::commands::render::shaders::SteppedShaders;
use crate::error::{CliError, CommandOutcome};
use crate::options::BackendChoice;
use crate::report::Reporter;
use gonio_exercises::step::StepWork;
use serde_json::json;

/// Refuses options that need the user's shaders.
pub fn refuse(args: &ProbeArgs) -> Result<(), CliError> {
    args.shaders.check()?;
    let option = if args.corners { "--corners" } else { "--at-vertex" };
    if args.corners || args.at_vertex.is_some() {
        return Err(CliError::new(format!("{option} steps through your shaders; add --vertex or --fragment")));
    }
    Ok(())
}

pub fn run(args: &ProbeArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if args.traced {
        return Err(CliError::new("--traced follows light, not your shaders; leave out --vertex and --fragment"));
    }
    if args.backend.backend == BackendChoice::Gl {
        return Err(CliError::new("gonio's interpreter runs your shaders on the CPU; leave out --backend gl"));
    }
    let SteppedShaders { pair, scene, stepped } =
        args.shaders.in_scene(&args.inputs, &args.scene, args.time, StepWork::PATIENT, reporter)?;
    let (at, vertex, corners) = (args.at, args.at_vertex, args.corners);
    let listed = step(&stepped, None, StepPlace { at, vertex, corners, vertex_option: "--at-vertex" })?;
    if reporter.json() {
        let mut report = json!({
            "command": "probe",
            "inputs": args.inputs,
            "size": stepped.size(),
            "warnings": scene.diagnostics,
            "shader_warnings": pair.inputs.warnings,
        });
        listed.add_to(&mut report);
        reporter.report(&report)?;
    } else {
        let files: Vec<&str> = args.shaders.vertex.iter().chain(&args.shaders.fragment).map(String::as_str).collect();
        let detail = format!("shaders {}", files.join(", "));
        reporter.text(&text::page(&args.inputs.join(", "), &detail, stepped.size(), &listed))?;
    }
    Ok(CommandOutcome::Done)
}
