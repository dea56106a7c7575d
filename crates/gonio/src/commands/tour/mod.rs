//! `gonio tour`: every technique on several models.
//!
//! The exhibits, the contact sheet and the page are those of `gonio-gallery`. This module has the options, the
//! progress bar and the files.

mod draw;

use crate::backend::BackendReport;
use crate::error::{CliError, CommandOutcome};
use crate::options::{BackendOptions, GeneralOptions, values};
use crate::output::{OutputFiles, atomic};
use crate::report::{Reporter, Times};
use clap::Args;
use draw::DrawnTour;
use gonio_gallery::drawing::{BackendDifference, DrawCounts};
use gonio_gallery::{ExhibitSubject, Section, SheetLayout, contact_sheet, page, sections};
use gonio_image::encode::png::{self, ColorTag};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Draw every technique on several models: a contact sheet and a web page.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio tour -o tour
      Then open tour/index.html; tour/sheet.png has all pictures on one sheet.
  gonio tour -o tour --backend cpu
      The same without OpenGL.
  gonio render tour/scenes/suzanne.toml -o suzanne.png
      One of the pictures again, from its scene.

The tour needs no files and no network: its models and environments are built in.")]
pub struct TourArgs {
    /// Folder to write to, created or updated.
    #[arg(long, short, value_name = "DIR", default_value = "tour", help_heading = "Output options")]
    pub output: PathBuf,
    /// Size of everything, 1 by default (for tests).
    #[arg(long, hide = true, value_name = "FACTOR", value_parser = scale, default_value = "1")]
    pub scale: f64,
    #[command(flatten)]
    pub backend: BackendOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

fn scale(text: &str) -> Result<f64, String> {
    match values::number(text)? {
        factor if (0.05..=2.0).contains(&factor) => Ok(factor),
        _ => Err(format!("invalid scale `{text}`: expected a number from 0.05 to 2")),
    }
}

/// The folder of the tour, and the files that will appear there together.
pub struct Folder {
    path: PathBuf,
    set: OutputFiles,
}

impl Folder {
    /// Creates missing folders and checks that files can be written.
    fn new(path: &Path) -> Result<Self, CliError> {
        let mut folder = Folder { path: path.to_owned(), set: OutputFiles::new() };
        for inner in [path.to_owned(), path.join("pictures"), path.join("scenes")] {
            if inner.exists() && !inner.is_dir() {
                return Err(CliError::new(format!(
                    "`{}` is a file; the tour needs a folder of its own there, name another one with -o",
                    inner.display()
                )));
            }
            folder.set.make_folder(&inner)?;
        }
        atomic::check_writable(&folder.sheet())?;
        atomic::check_writable(&folder.page())?;
        Ok(folder)
    }

    /// Adds a file.
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<(), CliError> {
        self.set.add(path, bytes)
    }

    /// Returns the path of a picture.
    pub fn picture(&self, name: &str) -> PathBuf {
        self.path.join("pictures").join(format!("{name}.png"))
    }

    /// Returns the path of a scene.
    pub fn scene(&self, name: &str) -> PathBuf {
        self.path.join("scenes").join(format!("{name}.toml"))
    }

    /// Returns the path of the contact sheet.
    pub fn sheet(&self) -> PathBuf {
        self.path.join("sheet.png")
    }

    /// Returns the path of the web page.
    pub fn page(&self) -> PathBuf {
        self.path.join("index.html")
    }
}

/// Draws the tour.
pub fn run(args: &TourArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let start = Instant::now();
    let times = Times::default();
    let sections = sections::all()?;
    let layout = SheetLayout::new(&sections, args.scale);
    let mut folder = Folder::new(&args.output)?;
    let drawn = draw::all(args, &mut folder, &sections, &layout, reporter, &times)?;
    let foot = format!("{} pictures, {}", drawn.exhibits.len(), drawn.drawn_by);
    let sheet = times.measure("sheet", || {
        contact_sheet::compose(&sections, &layout, &drawn.exhibits, &foot, "gonio tour -o tour")
    })?;
    times.measure("write", || -> Result<(), CliError> {
        folder.add(&folder.sheet(), &png::encode8(&sheet.encoded(), ColorTag::Srgb)?)?;
        // The page comes last, so that all files it names are there.
        folder.add(&folder.page(), page::write(&sections, &drawn.exhibits, &drawn.drawn_by).as_bytes())?;
        std::mem::take(&mut folder.set).commit()
    })?;
    times.add("total", start.elapsed());
    if reporter.json() {
        let size = (sheet.width, sheet.height);
        reporter.report(&Report::new(args, &folder, &sections, &drawn, size, &times))?;
    } else {
        reporter.note(format!(
            "{} pictures in {:.1} s; open {}",
            drawn.exhibits.len(),
            start.elapsed().as_secs_f64(),
            folder.page().display()
        ));
    }
    Ok(CommandOutcome::Done)
}

/// The whole report. Times are milliseconds, sizes pixels.
#[derive(Serialize)]
pub struct Report<'a> {
    command: &'static str,
    output: String,
    page: String,
    sheet: SheetReport,
    backend: &'a BackendReport,
    pictures: Vec<PictureReport<'a>>,
    times_ms: serde_json::Value,
}

#[derive(Serialize)]
struct SheetReport {
    file: String,
    width: u32,
    height: u32,
}

#[derive(Serialize)]
struct PictureReport<'a> {
    name: &'a str,
    section: &'a str,
    file: String,
    /// `None` for converted environments and for stations.
    scene: Option<String>,
    command: &'a str,
    view: Option<String>,
    time: f64,
    width: u32,
    height: u32,
    draw_ms: f64,
    drawn: DrawCounts,
    gpu_against_cpu: Option<BackendDifference>,
}

impl<'a> Report<'a> {
    /// Reports a finished tour with a sheet of this size.
    pub fn new(
        args: &TourArgs,
        folder: &Folder,
        sections: &'a [Section],
        drawn: &'a DrawnTour<'a>,
        (width, height): (u32, u32),
        times: &Times,
    ) -> Self {
        let pictures = drawn.exhibits.iter().map(|drawn| PictureReport {
            name: &drawn.exhibit.name,
            section: sections.get(drawn.section).map_or("", |s| s.id),
            file: folder.picture(&drawn.exhibit.name).display().to_string(),
            scene: match drawn.exhibit.subject {
                ExhibitSubject::Scene(_) => Some(folder.scene(&drawn.exhibit.name).display().to_string()),
                ExhibitSubject::Environment(_) | ExhibitSubject::Station(_) => None,
            },
            command: &drawn.command,
            view: drawn.exhibit.view.map(|v| v.to_string()),
            time: drawn.exhibit.time,
            width: drawn.width,
            height: drawn.height,
            draw_ms: (drawn.ms * 1e3).round() / 1e3,
            drawn: drawn.counts,
            gpu_against_cpu: drawn.difference,
        });
        Report {
            command: "tour",
            output: args.output.display().to_string(),
            page: folder.page().display().to_string(),
            sheet: SheetReport { file: folder.sheet().display().to_string(), width, height },
            backend: &drawn.backend,
            pictures: pictures.collect(),
            times_ms: times.to_json(),
        }
    }
}
