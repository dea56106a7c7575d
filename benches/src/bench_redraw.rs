//! Redraws the BRDF bench while the angle of incidence changes, and compares the CPU time of a frame with its bar.
//!
//! A frame is everything but OpenGL: the widgets, the plot, and egui's triangles of both.

use crate::{Places, measure};
use egui::{Context, Pos2, RawInput, Rect, vec2};
use gonio_app::bench::BenchView;
use gonio_app::platform::{Event, FileDialog, Platform, Purpose};
use gonio_app::saving::Product;
use gonio_app::session::Settings;
use gonio_app::theme;
use gonio_plot::PlotKind;
use gonio_scene::files::{Disk, FileSource};
use serde_json::{Value, json};
use std::sync::Arc;

/// Most CPU time of a frame in milliseconds. Issue 19 set it.
const BAR_MS: f64 = 16.0;
const FRAMES: u32 = 61;
/// The plots that are computed in the frame.
const KINDS: [PlotKind; 4] = [PlotKind::Polar, PlotKind::Cartesian, PlotKind::Lobe, PlotKind::Samples];

/// A platform without files. Work beside the interface is done at once, as on a page.
struct Nowhere;

impl Platform for Nowhere {
    fn files(&self) -> Arc<dyn FileSource> {
        Arc::new(Disk)
    }
    fn choose_files(&mut self, _: Purpose, _: &Context) -> FileDialog {
        FileDialog::Unavailable
    }
    fn open_paths(&mut self, _: Vec<String>, _: Purpose, _: &Context) {}
    fn choose_place(&mut self, _: Product, _: &str, _: &Context) -> FileDialog {
        FileDialog::Unavailable
    }
    fn poll(&mut self, _: Purpose, _: &Context) -> Vec<Event> {
        Vec::new()
    }
    fn write(&mut self, _: &str, _: &[u8]) -> Result<String, String> {
        Err("there are no files here".to_owned())
    }
    fn link(&self, fragment: &str) -> String {
        fragment.to_owned()
    }
    fn settings(&self) -> Settings {
        Settings::default()
    }
    fn keep(&mut self, _: &Settings) {}
}

/// The CPU times of frames in which the angle changes, in milliseconds.
fn frames(kind: PlotKind) -> Vec<f64> {
    let ctx = Context::default();
    theme::install(&ctx);
    let mut view = BenchView::default();
    view.open();
    view.settings.kind = kind;
    let mut times = Vec::new();
    for frame in 0..FRAMES {
        view.settings.theta_i_deg = 10.0 + f64::from(frame);
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 800.0)));
        let start = measure::cpu_time();
        let mut output = ctx.run_ui(RawInput { screen_rect, ..RawInput::default() }, |ui| {
            view.ui(ui, &mut Nowhere, &mut Vec::new());
        });
        let triangles = ctx.tessellate(output.shapes, output.pixels_per_point);
        times.push((measure::cpu_time() - start).as_secs_f64() * 1000.0);
        drop(triangles);
        // Nothing draws the letters.
        output.textures_delta.clear();
    }
    // The first frames lay out the panels and the letters.
    times.split_off(5)
}

/// Measures, prints, and returns whether the bar is met.
pub fn run(places: &Places) -> Result<bool, String> {
    println!("bench: three models, 1280x800 points, CPU time of a frame when the angle of incidence changes");
    let mut held = true;
    let mut results: Vec<Value> = Vec::new();
    for kind in KINDS {
        let times = frames(kind);
        let most = times.iter().copied().fold(0.0, f64::max);
        let median = measure::median(times);
        held &= median <= BAR_MS;
        println!(
            "  {:9}  median {median:.2} ms, longest {most:.2} ms; at most {BAR_MS} ms: {}",
            kind.name(),
            median <= BAR_MS
        );
        results.push(json!({ "kind": kind.name(), "median_ms": median, "longest_ms": most }));
    }
    measure::write_json(&places.out, "bench", &json!({ "kinds": results, "bars_held": held }))?;
    Ok(held)
}
