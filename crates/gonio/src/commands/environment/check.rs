//! `gonio environment check`: the orientation of an environment.

use super::describe;
use super::write::{Appearance, Container, EnvironmentPlan};
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, LimitOptions, values};
use crate::output::{OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_environment::arrange::Arrangement;
use gonio_environment::check::{self, Certificate, FaceFit};
use gonio_environment::check_panorama::{PanoramaCertificate, Seam, check_panorama};
use gonio_environment::{Cubemap, EnvironmentError, Layout, Panorama};
use gonio_light::color::{ColorEncoding, OutputTransform};
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
    let found = match &opened.map {
        EnvironmentMap::Cubemap(map) => Found::faces(map, opened.layout.unwrap_or_default())?,
        EnvironmentMap::Panorama(panorama) => Found::panorama(panorama),
    };
    let mut outputs = Vec::new();
    if let Some(plan) = plan {
        let written = found.repair(&opened, plan.with_arrangement(opened.arrangement).with_format_of(opened.format))?;
        written.warnings.iter().for_each(|w| reporter.warning(w));
        outputs = written.outputs;
    }
    if reporter.json() {
        reporter.report(&json!({
            "command": "environment check",
            "input": args.input,
            "is": describe(&opened),
            "layout": opened.layout.map(Layout::name),
            "fits": found.fits(),
            "sentences": found.sentences(),
            "details": found.details(),
            "outputs": outputs.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "warnings": opened.diagnostics,
        }))?;
    } else {
        let mut page = TerminalPage::new();
        page.line(format_args!("{}: {}", args.input, describe(&opened)));
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

/// The result of the check.
enum Found {
    Faces(Box<Certificate>),
    Panorama(PanoramaCertificate),
}

impl Found {
    fn faces(map: &Cubemap, layout: Layout) -> Result<Found, CliError> {
        let certificate = check::check(&map.faces(layout), layout).map_err(failed)?;
        Ok(Found::Faces(Box::new(certificate)))
    }

    fn panorama(panorama: &Panorama) -> Found {
        Found::Panorama(check_panorama(panorama))
    }

    /// Whether nothing is wrong.
    fn fits(&self) -> bool {
        match self {
            Found::Faces(c) => matches!(c.fit, FaceFit::Fits | FaceFit::TooPlain),
            Found::Panorama(c) => c.closes() && !c.is_turned,
        }
    }

    fn sentences(&self) -> Vec<String> {
        match self {
            Found::Faces(c) => c.sentences(),
            Found::Panorama(c) => c.sentences(),
        }
    }

    fn details(&self) -> Value {
        match self {
            Found::Faces(c) => json!({
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
            Found::Panorama(c) => {
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
        &self,
        opened: &OpenedEnvironment,
        plan: EnvironmentPlan,
    ) -> Result<super::write::WrittenEnvironment, CliError> {
        let layout = opened.layout.unwrap_or_default();
        let appearance = Appearance {
            layout,
            transform: OutputTransform { encoding: ColorEncoding::Srgb, ..OutputTransform::default() },
            high_dynamic_range: opened.high_dynamic_range,
            // Texels change their places only.
            exact: true,
        };
        if plan.clips(opened.high_dynamic_range) {
            let message =
                "--repair: a PNG would clip the light above 1 that INPUT may contain; name an .exr or .hdr file";
            return Err(CliError::new(message));
        }
        match (self, &opened.map) {
            (Found::Faces(c), EnvironmentMap::Cubemap(map)) => {
                if c.fit == FaceFit::NeverMeets {
                    return Err(CliError::new("the faces match in no arrangement, so there is no repair to write"));
                }
                if !plan.container.has_faces() {
                    return Err(CliError::new(
                        "--repair of six faces needs a folder, or a file of the same format as INPUT",
                    ));
                }
                let repaired = Cubemap::from_faces(c.repair.apply(&map.faces(layout)), layout).map_err(failed)?;
                plan.write_cubemap(repaired, &appearance)
            }
            (Found::Panorama(c), EnvironmentMap::Panorama(panorama)) => {
                if plan.container != Container::Equirectangular {
                    return Err(CliError::new("--repair of a panorama needs the name of a picture"));
                }
                if c.is_turned {
                    let turned = panorama.turned_back();
                    return plan.write_panorama(&turned, &appearance);
                }
                if c.closes() {
                    return plan.write_panorama(panorama, &appearance);
                }
                Err(CliError::new(
                    "the panorama does not close; what is missing cannot be repaired, so nothing is written",
                ))
            }
            _ => Err(CliError::new("there is nothing to repair")),
        }
    }
}

fn failed(error: EnvironmentError) -> CliError {
    CliError::new(error.to_string())
}
