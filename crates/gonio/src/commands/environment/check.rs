//! `gonio environment check`: the orientation of an environment.

use super::write::{EnvironmentPlan, WrittenEnvironment};
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, LimitOptions, values};
use crate::output::{OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_environment::arrange::Arrangement;
use gonio_environment::check_panorama::Seam;
use gonio_environment::encode::{Appearance, Container};
use gonio_environment::{EnvironmentError, Layout};
use gonio_light::color::{ColorEncoding, OutputTransform};
use gonio_scene::environment_check::EnvironmentFinding;
use gonio_scene::environment_file::{self, EnvironmentMap, EnvironmentReadOptions, OpenedEnvironment};
use serde_json::{Value, json};
use std::path::Path;

/// Check the orientation of an environment: find faces that are mirrored, rotated or swapped, and repair them.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio environment check faces
      `negy` is turned by 180 degrees; `posx` and `negx` are swapped
  gonio environment check faces --repair repaired
  gonio environment check panorama.hdr
  gonio environment check \"sky_*.png\" --json

The check compares the twelve edges that faces share, and finds the arrangement in which they match.

Edges cannot tell the two layouts apart, nor a mirrored world from the right one. Legible text can: look at the picture of \
`gonio render builtin:sphere-smooth --environment faces --material mirror -o mirror.png`.

Exit codes: 0 the edges match or --repair is given, 1 they do not match, 2 error.")]
pub struct CheckArgs {
    /// A folder of six faces, one of six faces, a pattern, a cross, a strip, a cubemap or a panorama.
    #[arg(value_name = "INPUT")]
    pub input: String,
    /// Write the repaired environment: six faces to this folder, or one picture to this file; - is stdout.
    #[arg(long, value_name = "OUT", help_heading = "Output options")]
    pub repair: Option<OutputPath>,
    /// Layout of INPUT's faces; by default photographic, and opengl for .ktx2 and .dds.
    #[arg(long, value_parser = values::named(Layout::ALL, Layout::name), help_heading = "Input options")]
    pub layout: Option<Layout>,
    /// Arrangement of INPUT, if its proportions are misleading.
    #[arg(long, value_name = "ARRANGEMENT", value_parser = values::named(Arrangement::ALL, Arrangement::name),
          help_heading = "Input options")]
    pub from: Option<Arrangement>,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &CheckArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let plan = args.repair.as_ref().map(|output| EnvironmentPlan::new(output, None, None, None)).transpose()?;
    let is_stdout_taken = check_stdout(args.repair.iter().map(|output| (output, OutputKind::Binary)), reporter)?;
    if let Some(plan) = &plan {
        plan.check_writable()?;
    }
    let reading = EnvironmentReadOptions { layout: args.layout, arrangement: args.from, size: None };
    let files = args.limits.files([args.input.as_str()], reporter);
    let busy = reporter.busy("reading the environment");
    let opened = environment_file::open(&args.input, reading, Path::new(""), &files, &args.limits.limits())?;
    drop(busy);
    reporter.diagnostics(&opened.diagnostics);
    let found = EnvironmentFinding::of(&opened).map_err(failed)?;
    let mut outputs = Vec::new();
    if let Some(plan) = plan {
        let written = repair(&found, &opened, plan.with_arrangement(opened.arrangement).with_format_of(opened.format))?;
        written.warnings.iter().for_each(|w| reporter.warning(w));
        outputs = written.outputs;
    }
    if reporter.json() {
        reporter.report(&json!({
            "command": "environment check",
            "input": args.input,
            "is": opened.description(),
            "layout": opened.layout.map(Layout::name),
            "fits": found.fits(),
            "sentences": found.sentences(),
            "details": details(&found),
            "outputs": outputs.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "warnings": opened.diagnostics,
        }))?;
    } else {
        let mut page = TerminalPage::new();
        page.line(format_args!("{}: {}", args.input, opened.description()));
        found.sentences().iter().for_each(|sentence| page.line(format_args!("  {sentence}")));
        if is_stdout_taken {
            reporter.text_on_stderr(&page);
        } else {
            outputs.iter().for_each(|path| page.line(format_args!("repaired: {path}")));
            reporter.text(&page)?;
        }
    }
    if found.fits() || args.repair.is_some() {
        return Ok(CommandOutcome::Done);
    }
    Ok(CommandOutcome::CheckFailed)
}

fn details(found: &EnvironmentFinding) -> Value {
    match found {
        EnvironmentFinding::Faces(c) => json!({
            "verdict": format!("{:?}", c.fit),
            "edges": c.edges.iter().map(|e| json!({
                "faces": [e.faces.0.name(), e.faces.1.name()],
                "across_stops": e.across,
                "inside_stops": e.inside,
                "ratio": e.ratio(),
                "meets": e.meets,
            })).collect::<Vec<_>>(),
            "changed": c.repair.changed().iter().map(|f| f.name()).collect::<Vec<_>>(),
            "undecided": c.undecided.iter().map(|f| f.name()).collect::<Vec<_>>(),
            "margin": c.margin,
        }),
        EnvironmentFinding::Panorama(c) => {
            let seam = |s: Seam| json!({ "across_stops": s.across, "inside_stops": s.inside, "shows": s.shows() });
            json!({
                "sides": seam(c.sides),
                "top": seam(c.top),
                "bottom": seam(c.bottom),
                "is_turned": c.is_turned,
                "upper_is_brighter_by_stops": c.upper_is_brighter_by,
            })
        }
    }
}

/// Writes the repaired environment.
fn repair(
    found: &EnvironmentFinding,
    opened: &OpenedEnvironment,
    plan: EnvironmentPlan,
) -> Result<WrittenEnvironment, CliError> {
    let appearance = Appearance {
        layout: opened.layout.unwrap_or_default(),
        transform: OutputTransform { encoding: ColorEncoding::Srgb, ..OutputTransform::default() },
        high_dynamic_range: opened.high_dynamic_range,
        // Texels change their places only.
        exact: true,
    };
    if plan.clips(opened.high_dynamic_range) {
        let message = "--repair: a PNG would clip the light above 1 that INPUT may contain; name an .exr or .hdr file";
        return Err(CliError::new(message));
    }
    let is_panorama = matches!(opened.map, EnvironmentMap::Panorama(_));
    if is_panorama && plan.container != Container::Equirectangular {
        return Err(CliError::new("--repair of a panorama needs the name of a picture"));
    }
    match found.repaired(opened).map_err(failed)? {
        EnvironmentMap::Cubemap(_) if !plan.container.has_faces() => {
            Err(CliError::new("--repair of six faces needs a folder, or a file of the same format as INPUT"))
        }
        EnvironmentMap::Cubemap(map) => plan.write_cubemap(map, &appearance),
        EnvironmentMap::Panorama(panorama) => plan.write_panorama(&panorama, &appearance),
    }
}

fn failed(error: EnvironmentError) -> CliError {
    CliError::new(error.to_string())
}
