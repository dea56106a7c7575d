//! `gonio tour --json`.

use super::draw::DrawnTour;
use super::{Folder, TourArgs};
use crate::backend::BackendReport;
use crate::report::Times;
use gonio_gallery::drawing::{Difference, DrawCounts};
use gonio_gallery::{Section, Subject};
use serde::Serialize;

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
    /// `None` for converted environments.
    scene: Option<String>,
    command: &'a str,
    view: Option<String>,
    time: f64,
    width: u32,
    height: u32,
    draw_ms: f64,
    drawn: DrawCounts,
    gpu_against_cpu: Option<Difference>,
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
                Subject::Scene(_) => Some(folder.scene(&drawn.exhibit.name).display().to_string()),
                Subject::Environment(_) => None,
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
