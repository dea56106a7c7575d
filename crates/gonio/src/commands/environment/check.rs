//! `gonio environment check`: which way round an environment is.

use super::describe;
use super::write::{Kind, Look, Plan};
use crate::cli::{LimitOptions, WordOptions};
use crate::page::Page;
use crate::report::{CliError, Outcome, Reporter};
use crate::values;
use clap::Args;
use gonio_environment::arrange::Arrangement;
use gonio_environment::check::{self, Certificate, Verdict};
use gonio_environment::check_panorama::{PanoramaCertificate, Seam, check_panorama};
use gonio_environment::{Cubemap, EnvironmentError, Layout, Panorama};
use gonio_light::color::{ColorEncoding, OutputTransform};
use gonio_scene::environment_file::{self, OpenedEnvironment, Reading, Source};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Say which way round an environment is: faces that are mirrored, turned or swapped, and how to repair them.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio environment check faces
      `negy` is turned by 180 degrees; `posx` and `negx` are swapped
  gonio environment check faces --repair repaired
  gonio environment check panorama.hdr
  gonio environment check \"sky_*.png\" --json

The twelve edges that the faces share are compared, and the arrangement is found in which they meet. Exit code 1 where
they do not meet as the faces are, and --repair is not given.

Edges cannot tell the two layouts apart, nor a mirrored world from the right one: legible text can. `gonio render
builtin:sphere-smooth --environment faces --material mirror -o mirror.png` shows.")]
pub struct CheckArgs {
    /// A folder of six faces, one of six faces, a pattern, a cross, a strip, a cubemap or a panorama.
    #[arg(value_name = "INPUT")]
    pub input: String,
    /// Write the repaired environment: six faces to this folder, or (a file's name) one picture as INPUT is.
    #[arg(long, value_name = "OUT")]
    pub repair: Option<PathBuf>,
    /// The layout of INPUT's faces; photographic by default, and opengl in .ktx2 and .dds.
    #[arg(long, value_parser = values::named(Layout::ALL, Layout::name))]
    pub layout: Option<Layout>,
    /// What INPUT is, where its proportions mislead.
    #[arg(long, value_parser = values::named(Arrangement::ALL, Arrangement::name))]
    pub from: Option<Arrangement>,
    /// What a file may make us allocate.
    #[command(flatten)]
    pub limits: LimitOptions,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Checks.
pub fn run(args: &CheckArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let plan = args.repair.as_deref().map(|output| Plan::new(output, None, None, None)).transpose()?;
    if let Some(plan) = &plan {
        plan.check_writable()?;
    }
    let reading = Reading { layout: args.layout, arrangement: args.from, size: None };
    let files = args.limits.files([args.input.as_str()]);
    let busy = reporter.busy("reading the environment");
    let opened = environment_file::open(&args.input, reading, Path::new(""), &files, &args.limits.limits())?;
    drop(busy);
    reporter.diagnostics(&opened.diagnostics);
    let found = match &opened.source {
        Source::Cubemap(map) => Found::faces(map, opened.layout.unwrap_or_default())?,
        Source::Panorama(panorama) => Found::panorama(panorama),
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
            "outputs": outputs,
            "warnings": opened.diagnostics,
        }))?;
    } else {
        let mut page = Page::new();
        page.line(format_args!("{}: {}", args.input, describe(&opened)));
        found.sentences().iter().for_each(|sentence| page.line(format_args!("  {sentence}")));
        outputs.iter().for_each(|path| page.line(format_args!("repaired: {}", path.display())));
        reporter.text(&page)?;
    }
    if found.fits() || args.repair.is_some() {
        return Ok(Outcome::Done);
    }
    Ok(Outcome::CheckFailed)
}

/// What was found.
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

    /// Whether there is nothing to complain of.
    fn fits(&self) -> bool {
        match self {
            Found::Faces(c) => matches!(c.verdict, Verdict::Fits | Verdict::TooPlain),
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
                "verdict": format!("{:?}", c.verdict),
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

    /// Writes what it should have been.
    fn repair(&self, opened: &OpenedEnvironment, plan: Plan) -> Result<super::write::Written, CliError> {
        let layout = opened.layout.unwrap_or_default();
        let look = Look {
            layout,
            transform: OutputTransform { encoding: ColorEncoding::Srgb, ..OutputTransform::default() },
            high_dynamic_range: opened.high_dynamic_range,
            // No texel changes but its place.
            exact: true,
        };
        if plan.clips(opened.high_dynamic_range) {
            let message = "--repair: a PNG would cut off the light above 1 that INPUT may have; name an .exr or .hdr";
            return Err(CliError::new(message));
        }
        match (self, &opened.source) {
            (Found::Faces(c), Source::Cubemap(map)) => {
                if c.verdict == Verdict::NeverMeets {
                    return Err(CliError::new("the faces meet in no arrangement, so there is no repair to write"));
                }
                if !plan.kind.has_faces() {
                    return Err(CliError::new(
                        "--repair of six faces wants a folder, or the kind of file that INPUT is",
                    ));
                }
                let repaired = Cubemap::from_faces(c.repair.apply(&map.faces(layout)), layout).map_err(failed)?;
                plan.write_cubemap(repaired, &look)
            }
            (Found::Panorama(c), Source::Panorama(panorama)) => {
                if plan.kind != Kind::Equirectangular {
                    return Err(CliError::new("--repair of a panorama wants the name of a picture"));
                }
                if c.is_turned {
                    let turned = panorama.turned_back();
                    return plan.write_panorama(&turned, &look);
                }
                if c.closes() {
                    return plan.write_panorama(panorama, &look);
                }
                Err(CliError::new(
                    "the panorama does not close; what it lacks cannot be made up, so nothing is written",
                ))
            }
            _ => Err(CliError::new("there is nothing to repair")),
        }
    }
}

fn failed(error: EnvironmentError) -> CliError {
    CliError::new(error.to_string())
}
