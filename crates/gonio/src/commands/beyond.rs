//! `gonio beyond`: the stations of `gonio-beyond` as pictures, plots, pages and checks. This module has the options and the files.

use super::brdf::functions::parameters_json;
use crate::backend;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, values};
use crate::output::{OutputFiles, atomic, check_folder};
use crate::report::{Reporter, Times};
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_app::files::link::StationLink;
use gonio_app::platform::desktop::{self, WindowOptions};
use gonio_beyond::{LawCheck, PictureRefinement, STATIONS, Station, StationFiles, StationPicture, page, station};
use gonio_bsdf::{ParameterKind, ParameterValues};
use gonio_image::encode::exr::{self, ExrPrecision};
use gonio_image::encode::png::{self, ColorTag, Depth};
use gonio_image::{EncodedPicture, Image};
use gonio_light::DVec3;
use gonio_plot::{PlotFigure, PlotTheme};
use serde_json::json;
use std::path::PathBuf;

/// Show phenomena beyond the rendering equation: polarisation, interference, fluorescence and others.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio beyond list
      The stations with their parameters.
  gonio beyond polarisation -o out
      Pictures (.png, linear .exr), a plot, and a page of text with checks of the law: out/polarisation.md.
  gonio beyond polarisation -o out --set angle=0
      The polariser turned: the reflection is back.
  gonio beyond phosphorescence -o out --time 30
      Half a minute after the lamp has gone out.
  gonio beyond interference -o out --picture wand --frames 48 --size 400x300 --samples 4
      A film (animated PNG) of the draining soap film.

  gonio beyond fog --window
      The station in the window: sliders, a picture that becomes finer, the plot and the checks.

A film changes one parameter from one end of its range to the other; `list` marks it.

Exit codes: 0 success, 1 a check of the law failed, 2 error.")]
pub struct BeyondArgs {
    /// A station; `list` lists them.
    #[arg(value_name = "STATION", value_parser = values::named(&CHOICES, std::convert::identity))]
    pub station: &'static str,
    /// Folder to write to, created or updated.
    #[arg(long, short, value_name = "DIR", help_heading = "Output options")]
    pub output: Option<PathBuf>,
    /// Write this picture only.
    #[arg(long, help_heading = "Output options", value_name = "NAME")]
    pub picture: Option<String>,
    /// Also write a film of the first picture, with this number of frames.
    #[arg(long, help_heading = "Output options", value_name = "N", value_parser = values::frames,
          allow_negative_numbers = true)]
    pub frames: Option<u32>,
    /// Show the station in the window, with a slider for each parameter, instead of writing files.
    #[arg(long, help_heading = "Output options", conflicts_with_all = ["output", "picture", "frames", "samples", "seed"])]
    pub window: bool,
    /// Write the window's state to this file after every frame, as JSON (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub state: Option<PathBuf>,

    /// Set a parameter; may be repeated.
    #[arg(long, help_heading = "Station options", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Set the parameter `time`, in seconds.
    #[arg(long, help_heading = "Station options", value_name = "SECONDS", allow_negative_numbers = true)]
    pub time: Option<String>,

    /// Size of the pictures in pixels.
    #[arg(long, help_heading = "Drawing options", value_name = "WIDTHxHEIGHT", default_value = "800x600",
          value_parser = values::size)]
    pub size: (u32, u32),
    /// Samples per pixel: 1, 2, 4, 8 or 16.
    #[arg(long, help_heading = "Drawing options", value_name = "N", default_value = "16", value_parser = values::samples,
          allow_negative_numbers = true)]
    pub samples: u32,
    /// Seed of the random numbers.
    #[arg(long, help_heading = "Drawing options", value_name = "N", default_value = "0", value_parser = values::seed,
          allow_negative_numbers = true)]
    pub seed: u64,
    /// Threads; all cores by default.
    #[arg(long, help_heading = "Drawing options", value_name = "N", value_parser = values::threads,
          allow_negative_numbers = true)]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The word in place of a station.
const LIST: &str = "list";

/// The values of the first argument.
static CHOICES: [&str; STATIONS.len() + 1] = {
    let mut names = [LIST; STATIONS.len() + 1];
    let mut index = 0;
    while index < STATIONS.len() {
        names[index + 1] = STATIONS[index].name;
        index += 1;
    }
    names
};

/// Frames of a film per second.
const FRAME_RATE: u16 = 15;
/// The size of a plot in pixels.
const PLOT_SIZE: [u32; 2] = [800, 500];

pub fn run(args: &BeyondArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let Some(station) = station(args.station) else { return list(reporter) };
    let values = chosen_values(args, station)?;
    if args.window {
        return show(args, station, &values);
    }
    let Some(output) = &args.output else {
        return Err(CliError::new(format!("no folder to write to: add `-o DIR` to `gonio beyond {}`", station.name)));
    };
    let pictures = chosen_pictures(args, station)?;
    check_folder(output, "`gonio beyond`")?;
    if output.exists() && !output.is_dir() {
        return Err(CliError::new(format!("`{}` is a file; name a folder with -o", output.display())));
    }
    let page_path = output.join(format!("{}.md", station.name));
    {
        // Whether the folder can be written to is known before the work is done; an interruption leaves none behind.
        let mut tried = OutputFiles::new();
        tried.make_folder(output)?;
        atomic::check_writable(&page_path)?;
    }
    backend::limit_threads(args.threads);
    let times = Times::default();
    let checks = times.measure("check", || (station.checks)(&values));
    let made = times.measure("draw", || draw(args, station, &values, &pictures, &checks, reporter))?;
    times.measure("write", || -> Result<(), CliError> {
        let mut files = OutputFiles::new();
        files.make_folder(output)?;
        for (name, bytes) in &made {
            files.add(&output.join(name), bytes)?;
        }
        files.commit()
    })?;
    reporter.verbose_times(&times);
    let failed = checks.iter().filter(|check| !check.holds()).count();
    if reporter.json() {
        reporter.report(&json!({
            "command": "beyond",
            "station": station.name,
            "output": output,
            "page": page_path,
            "files": made.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "size": [args.size.0, args.size.1],
            "samples": args.samples,
            "seed": args.seed,
            "parameters": parameters_json(&values),
            "checks": checks,
            "failed": failed,
            "times_ms": times.to_json(),
        }))?;
    } else {
        if !args.general.quiet {
            reporter.text(&text(station, &checks))?;
        }
        reporter.note(format_args!("see {}", page_path.display()));
    }
    if failed > 0 {
        reporter.check_failed(format_args!("{failed} of {} checks of the law failed", checks.len()));
        return Ok(CommandOutcome::CheckFailed);
    }
    Ok(CommandOutcome::Done)
}

/// Opens the window with the station, and returns when it is closed.
fn show(args: &BeyondArgs, station: &Station, values: &ParameterValues) -> Result<CommandOutcome, CliError> {
    let values = values.iter().map(|(parameter, value)| (parameter.name.to_string(), parameter.format(value)));
    let window = WindowOptions {
        language: args.general.language,
        state: args.state.clone(),
        program: std::env::current_exe().ok(),
        station: Some(StationLink { name: station.name.to_owned(), values: values.collect() }),
        ..WindowOptions::default()
    };
    desktop::run(window).map_err(CliError::new)?;
    Ok(CommandOutcome::Done)
}

/// The parameters with the values that the options set.
fn chosen_values(args: &BeyondArgs, station: &Station) -> Result<ParameterValues, CliError> {
    let mut values = station.defaults();
    let mut set = |name: &str, value: &str| {
        values.set(name, value).map_err(|error| CliError::new(format!("{}: {error}", station.name)))
    };
    for setting in &args.set {
        let (name, value) = setting
            .split_once('=')
            .ok_or_else(|| CliError::new(format!("invalid setting `{setting}`: expected NAME=VALUE")))?;
        set(name.trim(), value)?;
    }
    if let Some(time) = &args.time {
        set("time", time)?;
    }
    Ok(values)
}

/// The pictures to draw.
fn chosen_pictures(args: &BeyondArgs, station: &Station) -> Result<Vec<&'static StationPicture>, CliError> {
    let pictures = station.pictures.iter();
    let Some(name) = &args.picture else { return Ok(pictures.collect()) };
    let chosen: Vec<_> = pictures.filter(|picture| picture.name == name).collect();
    if chosen.is_empty() {
        let known: Vec<&str> = station.pictures.iter().map(|picture| picture.name).collect();
        let known = known.join(", ");
        return Err(CliError::new(format!("{}: unknown picture `{name}`: expected one of {known}", station.name)));
    }
    Ok(chosen)
}

/// A file's name and its bytes.
type MadeFile = (String, Vec<u8>);

/// Draws everything; the page comes last.
fn draw(
    args: &BeyondArgs,
    station: &Station,
    values: &ParameterValues,
    pictures: &[&StationPicture],
    checks: &[LawCheck],
    reporter: &Reporter,
) -> Result<Vec<MadeFile>, CliError> {
    let mut made = Vec::new();
    let mut files = StationFiles::default();
    for picture in pictures {
        let progress = reporter.progress(picture.name);
        let image = complete(args, picture, values, &|share| progress.set(share));
        drop(progress);
        let name = format!("{}-{}", station.name, picture.name);
        made.push((format!("{name}.png"), png::encode(&image, &picture.output, Depth::Eight)?));
        let exr = exr::encode(&image, ExrPrecision::Half)?;
        exr.warnings.iter().for_each(|warning| reporter.warning(format_args!("{name}.exr: {warning}")));
        made.push((format!("{name}.exr"), exr.bytes));
        files.pictures.push((picture.caption, format!("{name}.png")));
    }
    if let (Some(frames), Some(picture)) = (args.frames, pictures.first()) {
        let name = format!("{}-film.png", station.name);
        made.push((name.clone(), film(args, station, values, picture, frames, reporter)?));
        files.film = Some(name);
    }
    let mut figure = PlotFigure::new(PLOT_SIZE, PlotTheme::Light);
    let plotted = (station.plot)(values, &mut figure).and_then(|()| Ok((figure.svg()?, figure.png()?)));
    let (svg, png) = plotted.map_err(|error| CliError::new(error.to_string()))?;
    files.plot = format!("{}-plot.svg", station.name);
    made.push((files.plot.clone(), svg.into_bytes()));
    made.push((format!("{}-plot.png", station.name), png));
    made.push((format!("{}.md", station.name), page(station, values, &files, checks).into_bytes()));
    Ok(made)
}

/// A picture with all its samples.
fn complete(
    args: &BeyondArgs,
    picture: &StationPicture,
    values: &ParameterValues,
    progress: &(dyn Fn(f64) + Sync),
) -> Image {
    let plane = (picture.image_plane)(values);
    let mut refined = PictureRefinement::of_pixels(plane, [args.size.0, args.size.1], args.seed);
    refined.complete(args.samples, &|share| {
        progress(share);
        true
    });
    refined.picture()
}

/// An animated PNG of a picture over the film parameter.
fn film(
    args: &BeyondArgs,
    station: &Station,
    values: &ParameterValues,
    picture: &StationPicture,
    frames: u32,
    reporter: &Reporter,
) -> Result<Vec<u8>, CliError> {
    let progress = reporter.progress("film");
    let mut film = png::Animation::new(frames, (1, FRAME_RATE));
    let mut values = values.clone();
    for frame in 0..frames {
        values.set_value(station.film_parameter, DVec3::splat(station.film_value(frame, frames)));
        let image = complete(args, picture, &values, &|_| ());
        let opaque = |rgb: &[u8; 3]| [rgb[0], rgb[1], rgb[2], 255];
        let rgba = png::rows8(&image, &picture.output).as_chunks::<3>().0.iter().flat_map(opaque).collect();
        film.add(&EncodedPicture { width: image.width, height: image.height, rgba }, ColorTag::Srgb)?;
        progress.set(f64::from(frame + 1) / f64::from(frames));
    }
    Ok(film.finish()?)
}

/// The stations with their parameters.
fn list(reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if reporter.json() {
        let stations = STATIONS.iter().map(|station| {
            json!({
                "name": station.name,
                "title": station.title,
                "assumption": station.assumption,
                "nature": station.nature,
                "formula": station.formula,
                "source": station.source,
                "look": station.look,
                "question": station.question,
                "parameters": parameters_json(&station.defaults()),
                "film_parameter": station.film_parameter,
                "pictures": station.pictures.iter().map(|picture| json!({
                    "name": picture.name,
                    "caption": picture.caption,
                })).collect::<Vec<_>>(),
            })
        });
        reporter.report(&json!({ "command": "beyond list", "stations": stations.collect::<Vec<_>>() }))?;
        return Ok(CommandOutcome::Done);
    }
    let mut page = TerminalPage::new();
    for station in STATIONS {
        page.heading(format_args!("{}: {}", station.name, station.title));
        let pictures: Vec<&str> = station.pictures.iter().map(|picture| picture.name).collect();
        page.line(format_args!("  pictures: {}", pictures.join(", ")));
        for (parameter, value) in station.defaults().iter() {
            let range = match parameter.kind {
                ParameterKind::Number { min, max, .. } => format!("{min} to {max} {}", parameter.unit),
                _ => parameter.expected(),
            };
            let film = if parameter.name == station.film_parameter { "; changed by --frames" } else { "" };
            page.line(format_args!(
                "  {:<12} {:<8} {:<20} {}{film}",
                parameter.name,
                parameter.format(value),
                range,
                parameter.description
            ));
        }
    }
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

/// The checks of the law.
fn text(station: &Station, checks: &[LawCheck]) -> TerminalPage {
    let mut page = TerminalPage::new();
    page.line(station.title);
    station.formula.lines().for_each(|line| page.line(format_args!("  {line}")));
    let width = checks.iter().map(|check| check.quantity.chars().count()).max().unwrap_or(0);
    page.line(format_args!("{:width$}  {:>12} {:>12} {:>8}", "", "law", "found", "bound"));
    for check in checks {
        let LawCheck { quantity, expected, measured, bound, unit } = check;
        let failed = if check.holds() { "" } else { "  FAILED" };
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        page.line(format_args!("{quantity:width$}  {expected:>12.6} {measured:>12.6} {bound:>8.0e}{unit}{failed}"));
    }
    page
}
