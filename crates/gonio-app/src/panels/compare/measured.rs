//! Measurements: of the panes, of the difference of two, and the error curve.

use super::noted;
use super::plot::{Line, Plot};
use crate::document::{Document, Panes};
use crate::session::Session;
use crate::session::comparison::{Curve, CurvePoint};
use crate::theme::colors;
use crate::widgets::{SPACE, grouped};
use egui::{Grid, RichText, ScrollArea, Ui};
use gonio_scene::scene_file::Shading;

/// One row for each pane: triangles, vertices, fragments, milliseconds.
pub fn show(ui: &mut Ui, document: &Document, session: &Session) {
    let panes = &session.comparison.panes;
    if panes.is_empty() {
        ui.weak("Nothing has been drawn yet");
        return;
    }
    // Columns have a fixed width, so that digits are aligned and nothing moves.
    let line = |cells: [&str; 5]| {
        let [pane, triangles, vertices, fragments, ms] = cells;
        format!("{pane:1}{triangles:>10}{vertices:>11}{fragments:>11}{ms:>8}")
    };
    let header = line(["", "triangles", "vertices", "fragments", "ms"]);
    ui.label(RichText::new(header).monospace().size(11.0).weak()).on_hover_text(
        "Vertex shader runs, where Gouraud shading evaluates the equation; fragment shader runs (including helper \
         fragments in blocks of 2 x 2), where the other shadings do; and the time of the last finished frame",
    );
    for (index, pane) in panes.iter().enumerate() {
        // OpenGL did not draw what a traced pane shows.
        if let Some(caption) = traced_caption(&document.panes, session, index) {
            ui.label(RichText::new(format!("{} {caption}", index + 1)).monospace().size(11.0));
            continue;
        }
        let count = |n: Option<u64>| n.map_or("–".to_owned(), |n| grouped(n, SPACE));
        let vertices = match (pane.vertices, pane.counted) {
            // Counted from the index buffers, which is an upper bound.
            (Some(n), false) => format!("≤ {}", grouped(n, SPACE)),
            (n, _) => count(n),
        };
        let triangles = grouped(pane.triangles as u64, SPACE);
        let ms = format!("{:.1}", pane.ms);
        let text = line([&(index + 1).to_string(), &triangles, &vertices, &count(pane.fragments), &ms]);
        ui.label(RichText::new(text).monospace().size(11.0));
    }
}

/// The number of paths and the error of a pane, if it is traced.
fn traced_caption(panes: &Panes, session: &Session, index: usize) -> Option<String> {
    panes.list.get(index)?.truth?;
    Some(format!("traced: {}", session.traced.get(index)?.caption()))
}

/// Statistics of the difference of the pair.
pub fn difference(ui: &mut Ui, panes: &Panes, session: &Session) {
    let Some(facts) = &session.comparison.difference else {
        ui.weak("The panes have not been compared yet");
        return;
    };
    Grid::new("difference").num_columns(2).spacing([14.0, 4.0]).show(ui, |ui| {
        let mut row = |name: &str, tip: &str, value: String| {
            ui.label(name).on_hover_text(tip);
            ui.label(RichText::new(value).monospace());
            ui.end_row();
        };
        let differing = format!("{} pixels, {:.2} %", grouped(facts.differing, SPACE), facts.percent());
        row("Differing", "By more than 1/255 in some channel", differing);
        row("Largest", "8-bit steps", format!("{:.0}/255", facts.spread.max));
        row("Mean", "Of the absolute differences, 8-bit steps", format!("{:.3}/255", facts.spread.mean));
        row("RMS", "Root of the mean square, 8-bit steps", format!("{:.3}/255", facts.spread.rms));
        let psnr = facts.psnr_db.map_or("equal".to_owned(), |db| format!("{db:.1} dB"));
        row("PSNR", "20 log10(255 / RMS)", psnr);
        if let Some([column, row_of]) = facts.worst {
            row("Maximum at", "Column and row of the pixel, circled in the map", format!("{column}, {row_of}"));
        }
    });
    let noise = |&index: &usize| traced_caption(panes, session, index);
    if let Some(traced) = panes.pair.iter().find_map(noise) {
        ui.label(RichText::new(format!("A part of it is noise, which fades ({traced})")).small().weak());
    }
}

const SHADINGS: [Shading; 3] = [Shading::Flat, Shading::Gouraud, Shading::Phong];

/// The error curve, with a button to draw and to stop it.
pub fn show_curve(ui: &mut Ui, session: &mut Session) {
    let curve = &mut session.comparison.curve;
    ui.horizontal(|ui| {
        let label = match (curve.running, curve.points.is_empty()) {
            (true, _) => "Stop",
            (false, true) => "Draw the curve",
            (false, false) => "Draw it again",
        };
        let button = noted(ui, |ui| ui.button(label), "curve", label, curve.points.len());
        let tip = "Draws the scene with more and more triangles in flat, Gouraud and Phong shading, and compares each \
                   picture with the finest one";
        if button.on_hover_text(tip).clicked() {
            curve.running = !curve.running;
        }
        if curve.running {
            let [done, all] = curve.progress;
            let share = done as f32 / all.max(1) as f32;
            ui.add(egui::ProgressBar::new(share).desired_width(120.0).text(format!("{done} of {all}")));
        }
    });
    if curve.points.is_empty() {
        return;
    }
    let tints = [colors::SPECULAR, colors::LIGHT, colors::DIFFUSE];
    let lines = SHADINGS.iter().zip(tints).map(|(&shading, tint)| Line {
        name: title(shading),
        color: tint.of(ui),
        points: points_of(curve, shading).map(|p| [p.triangles as f64, p.rms]).collect(),
    });
    let plot = Plot { x_label: "triangles", y_label: "RMS difference (0 to 255)", lines: lines.collect() };
    plot.show(ui, "error curve");
    ui.label(RichText::new(format!("against {}", curve.against)).small().weak());
    table(ui, curve);
}

fn points_of(curve: &Curve, shading: Shading) -> impl Iterator<Item = &CurvePoint> {
    curve.points.iter().filter(move |point| point.shading == shading)
}

fn title(shading: Shading) -> &'static str {
    match shading {
        Shading::Flat => "flat",
        Shading::FlatPerFace => "per face",
        Shading::Gouraud => "Gouraud",
        Shading::Phong => "Phong",
    }
}

/// Evaluations of the equation for each number of triangles: at vertices for Gouraud, at fragments for Phong.
fn table(ui: &mut Ui, curve: &Curve) {
    ScrollArea::horizontal().id_salt("curve table").show(ui, |ui| {
        Grid::new("curve").num_columns(4).spacing([16.0, 3.0]).striped(true).show(ui, |ui| {
            for title in ["triangles", "shading", "RMS", "lit"] {
                ui.label(RichText::new(title).small().weak());
            }
            ui.end_row();
            for point in &curve.points {
                // Gouraud shading lights vertices, the others fragments.
                let (lit, what) = match point.shading {
                    Shading::Gouraud => (point.vertices, "vertices"),
                    _ => (point.fragments, "fragments"),
                };
                let lit = lit.map_or("–".to_owned(), |n| format!("{} {what}", grouped(n, SPACE)));
                let cells = [
                    grouped(point.triangles as u64, SPACE),
                    title(point.shading).into(),
                    format!("{:.3}", point.rms),
                    lit,
                ];
                for cell in cells {
                    ui.label(RichText::new(cell).small());
                }
                ui.end_row();
            }
        });
    });
}
