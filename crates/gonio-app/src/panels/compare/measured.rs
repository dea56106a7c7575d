//! Measurements: of the panes, of the difference of two, and the error curve.

use super::noted;
use super::plot::{Line, Plot};
use crate::document::{Document, Panes};
use crate::session::Session;
use crate::session::comparison::{Curve, CurvePoint};
use crate::theme::colors;
use crate::widgets::{SPACE, grouped};
use egui::{Grid, RichText, ScrollArea, Ui};
use gonio_language::tr;
use gonio_scene::scene_file::Shading;

/// One row for each pane: triangles, vertices, fragments, milliseconds.
pub fn show(ui: &mut Ui, document: &Document, session: &Session) {
    let panes = &session.comparison.panes;
    if panes.is_empty() {
        ui.weak(tr!("scene-nothing-has-been-drawn-yet"));
        return;
    }
    // Columns have a fixed width, so that digits are aligned and nothing moves.
    let line = |cells: [&str; 5]| {
        let [pane, triangles, vertices, fragments, ms] = cells;
        format!("{pane:1}{triangles:>10}{vertices:>11}{fragments:>11}{ms:>8}")
    };
    let header =
        line(["", tr!("scene-triangles-column"), tr!("scene-vertices-column"), tr!("scene-fragments-column"), "ms"]);
    ui.label(RichText::new(header).monospace().size(11.0).weak())
        .on_hover_text(tr!("scene-vertex-shader-runs-where-gouraud-shading"));
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
        ui.weak(tr!("scene-the-panes-have-not-been-compared"));
        return;
    };
    Grid::new("difference").num_columns(2).spacing([14.0, 4.0]).show(ui, |ui| {
        let mut row = |name: &str, tip: &str, value: String| {
            ui.label(name).on_hover_text(tip);
            ui.label(RichText::new(value).monospace());
            ui.end_row();
        };
        let differing =
            tr!("scene-pixels", count = grouped(facts.differing, SPACE), percent = format!("{:.2}", facts.percent()));
        row(tr!("scene-differing"), tr!("scene-by-more-than-1-255-in"), differing);
        row(tr!("scene-largest"), tr!("scene-8-bit-steps"), format!("{:.0}/255", facts.spread.max));
        row(tr!("scene-mean"), tr!("scene-of-the-absolute-differences-8-bit"), format!("{:.3}/255", facts.spread.mean));
        row("RMS", tr!("scene-root-of-the-mean-square"), format!("{:.3}/255", facts.spread.rms));
        let psnr = facts.psnr_db.map_or(tr!("scene-equal").to_owned(), |db| tr!("scene-db", db = format!("{db:.1}")));
        row("PSNR", tr!("scene-20-log10-255-rms"), psnr);
        if let Some([column, row_of]) = facts.worst {
            row(tr!("scene-maximum-at"), tr!("scene-column-and-row-of-the-pixel"), format!("{column}, {row_of}"));
        }
    });
    let noise = |&index: &usize| traced_caption(panes, session, index);
    if let Some(traced) = panes.pair.iter().find_map(noise) {
        ui.label(RichText::new(tr!("scene-a-part-of-it-is-noise", traced = traced)).small().weak());
    }
}

const SHADINGS: [Shading; 3] = [Shading::Flat, Shading::Gouraud, Shading::Phong];

/// The error curve, with a button to draw and to stop it.
pub fn show_curve(ui: &mut Ui, session: &mut Session) {
    let curve = &mut session.comparison.curve;
    ui.horizontal(|ui| {
        let label = match (curve.running, curve.points.is_empty()) {
            (true, _) => tr!("scene-stop"),
            (false, true) => tr!("scene-draw-the-curve"),
            (false, false) => tr!("scene-draw-it-again"),
        };
        let button = noted(ui, |ui| ui.button(label), "curve", label, curve.points.len());
        let tip = tr!("scene-draws-the-scene-with-more-and");
        if button.on_hover_text(tip).clicked() {
            curve.running = !curve.running;
        }
        if curve.running {
            let [done, all] = curve.progress;
            let share = done as f32 / all.max(1) as f32;
            ui.add(egui::ProgressBar::new(share).desired_width(120.0).text(tr!("scene-of", done = done, all = all)));
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
    let plot = Plot {
        x_label: tr!("scene-triangles-column"),
        y_label: tr!("scene-rms-difference-0-to-255"),
        lines: lines.collect(),
    };
    plot.show(ui, tr!("scene-error-curve"));
    ui.label(RichText::new(tr!("scene-against", against = curve.against)).small().weak());
    table(ui, curve);
}

fn points_of(curve: &Curve, shading: Shading) -> impl Iterator<Item = &CurvePoint> {
    curve.points.iter().filter(move |point| point.shading == shading)
}

fn title(shading: Shading) -> &'static str {
    match shading {
        Shading::Flat => "flat",
        Shading::FlatPerFace => tr!("scene-per-face"),
        Shading::Gouraud => "Gouraud",
        Shading::Phong => "Phong",
    }
}

/// Evaluations of the equation for each number of triangles: at vertices for Gouraud, at fragments for Phong.
fn table(ui: &mut Ui, curve: &Curve) {
    ScrollArea::horizontal().id_salt("curve table").show(ui, |ui| {
        Grid::new("curve").num_columns(4).spacing([16.0, 3.0]).striped(true).show(ui, |ui| {
            for title in [tr!("scene-triangles-column"), tr!("scene-shading-column"), "RMS", tr!("scene-lit-column")] {
                ui.label(RichText::new(title).small().weak());
            }
            ui.end_row();
            for point in &curve.points {
                // Gouraud shading lights vertices, the others fragments.
                let (lit, what) = match point.shading {
                    Shading::Gouraud => (point.vertices, tr!("scene-vertices-column")),
                    _ => (point.fragments, tr!("scene-fragments-column")),
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
