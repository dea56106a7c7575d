//! `gonio tour`: every technique on several models.
//!
//! The exhibits, the contact sheet and the page are those of `gonio-gallery`. This module has the options, the
//! progress bar and the files.

mod command;
mod draw;
mod report;

use crate::cli::{BackendOptions, GeneralOptions};
use crate::output::{FileSet, atomic};
use crate::report::{CliError, Outcome, Reporter, Times};
use crate::values;
use clap::Args;
use gonio_gallery::{SheetLayout, contact_sheet, page, sections};
use gonio_image::encode::png::{self, ColorTag};
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
    set: FileSet,
}

impl Folder {
    /// Creates missing folders and checks that files can be written.
    fn new(path: &Path) -> Result<Self, CliError> {
        let mut folder = Folder { path: path.to_owned(), set: FileSet::new() };
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
pub fn run(args: &TourArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
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
        reporter.report(&report::Report::new(args, &folder, &sections, &drawn, size, &times))?;
    } else {
        reporter.note(format!(
            "{} pictures in {:.1} s; open {}",
            drawn.exhibits.len(),
            start.elapsed().as_secs_f64(),
            folder.page().display()
        ));
    }
    Ok(Outcome::Done)
}
