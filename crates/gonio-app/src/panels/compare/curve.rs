//! The curve of errors: asked for, stopped, shown.

use super::noted;
use super::plot::{Line, Plot};
use crate::session::Session;
use crate::session::comparison::{Curve, CurvePoint};
use crate::theme::colors;
use crate::widgets::{SPACE, grouped};
use egui::{Grid, RichText, ScrollArea, Ui};
use gonio_scene::scene_file::Shading;

const SHADINGS: [Shading; 3] = [Shading::Flat, Shading::Gouraud, Shading::Phong];

pub fn show(ui: &mut Ui, session: &mut Session) {
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
