//! `gonio tour --json`.

use super::draw::{self, Difference};
use super::exhibit::{Section, Subject};
use super::{Folder, TourArgs};
use crate::backend::{BackendReport, Counts};
use crate::report::Times;
use serde::Serialize;

/// The whole report. Times are milliseconds, sizes pixels.
#[derive(Serialize)]
pub struct Report<'a> {
    command: &'static str,
    output: String,
    page: String,
    sheet: Sheet,
    backend: &'a BackendReport,
    pictures: Vec<PictureReport<'a>>,
    times_ms: serde_json::Value,
}

#[derive(Serialize)]
struct Sheet {
    file: String,
    width: u32,
    height: u32,
}

#[derive(Serialize)]
struct PictureReport<'a> {
    name: &'a str,
    section: &'a str,
    file: String,
    /// None of an environment that was converted.
    scene: Option<String>,
    command: &'a str,
    view: Option<String>,
    time: f64,
    width: u32,
    height: u32,
    draw_ms: f64,
    drawn: Counts,
    gpu_against_cpu: Option<Difference>,
}

impl<'a> Report<'a> {
    /// Of a finished tour with a sheet of this size.
    pub fn new(
        args: &TourArgs,
        folder: &Folder,
        sections: &'a [Section],
        drawn: &'a draw::Result<'a>,
        (width, height): (u32, u32),
        times: &Times,
    ) -> Self {
        let pictures = drawn.shown.iter().map(|shown| PictureReport {
            name: &shown.exhibit.name,
            section: sections.get(shown.section).map_or("", |s| s.id),
            file: folder.picture(&shown.exhibit.name).display().to_string(),
            scene: match shown.exhibit.subject {
                Subject::Scene(_) => Some(folder.scene(&shown.exhibit.name).display().to_string()),
                Subject::Converted(_) => None,
            },
            command: &shown.command,
            view: shown.exhibit.view.map(|v| v.to_string()),
            time: shown.exhibit.time,
            width: shown.width,
            height: shown.height,
            draw_ms: (shown.ms * 1e3).round() / 1e3,
            drawn: shown.counts,
            gpu_against_cpu: shown.difference,
        });
        Report {
            command: "tour",
            output: args.output.display().to_string(),
            page: folder.page().display().to_string(),
            sheet: Sheet { file: folder.sheet().display().to_string(), width, height },
            backend: &drawn.backend,
            pictures: pictures.collect(),
            times_ms: times.to_json(),
        }
    }
}
