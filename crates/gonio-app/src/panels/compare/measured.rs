//! Measurements of the panes, and the difference of two.

use crate::session::Session;
use crate::widgets::{SPACE, grouped};
use egui::{Grid, RichText, Ui};

/// One row for each pane: triangles, vertices, fragments, milliseconds.
pub fn show(ui: &mut Ui, session: &Session) {
    let panes = &session.comparison.panes;
    if panes.is_empty() {
        ui.weak("Nothing has been drawn yet");
        return;
    }
    // Of one width for each column, so that digits stand below each other and nothing jumps.
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
        let count = |n: Option<u64>| n.map_or("–".to_owned(), |n| grouped(n, SPACE));
        let vertices = match (pane.vertices, pane.counted) {
            // From the index buffers: no more than these are asked for.
            (Some(n), false) => format!("≤ {}", grouped(n, SPACE)),
            (n, _) => count(n),
        };
        let triangles = grouped(pane.triangles as u64, SPACE);
        let ms = format!("{:.1}", pane.ms);
        let text = line([&(index + 1).to_string(), &triangles, &vertices, &count(pane.fragments), &ms]);
        ui.label(RichText::new(text).monospace().size(11.0));
    }
}

/// Statistics of the difference of the pair.
pub fn difference(ui: &mut Ui, session: &Session) {
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
}
