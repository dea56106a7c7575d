//! The view and projection matrices, live: what the lab's first exercise makes by hand.

use crate::theme::colors;
use crate::widgets::heading;
use egui::{Color32, FontFamily, FontId, Grid, RichText, Ui};
use glam::DMat4;
use gonio_scene::Camera;

/// Labels of one matrix.
struct Table {
    id: &'static str,
    rows: [&'static str; 4],
    columns: [&'static str; 4],
    /// Row by row: how each entry is made.
    tips: [[&'static str; 4]; 4],
}

const VIEW: Table = Table {
    id: "view-matrix",
    rows: ["Right", "Up", "\u{2212}Front", ""],
    columns: ["x", "y", "z", "position"],
    tips: [
        ["Right.x", "Right.y", "Right.z", "\u{2212}Right \u{22c5} Position"],
        ["Up.x", "Up.y", "Up.z", "\u{2212}Up \u{22c5} Position"],
        ["\u{2212}Front.x", "\u{2212}Front.y", "\u{2212}Front.z", "Front \u{22c5} Position"],
        ["0", "0", "0", "1, for points"],
    ],
};

const PROJECTION: Table = Table {
    id: "projection-matrix",
    rows: ["x", "y", "z", "w"],
    columns: ["", "", "", ""],
    tips: [
        ["f / aspect, f = 1 / tan(fov / 2), aspect = width / height", "0", "0", "0"],
        ["0", "f = 1 / tan(fov / 2)", "0", "0"],
        ["0", "0", "(far + near) / (near \u{2212} far)", "2 far near / (near \u{2212} far)"],
        ["0", "0", "\u{2212}1: w becomes the depth, by which x, y and z are divided", "0"],
    ],
};

/// Shows both.
pub fn show(ui: &mut Ui, camera: &Camera, aspect: f64) {
    heading(ui, "View matrix V").on_hover_text(
        "From world to eye space: the camera axes as rows, and in the last column minus the position in those axes",
    );
    table(ui, &VIEW, camera.view_from_world(), row_tints(ui));
    let [front_x, front_y, front_z] = camera.front.to_array();
    let text = format!("Front = ({front_x:.3}, {front_y:.3}, {front_z:.3})");
    ui.label(RichText::new(text).font(digits()).color(colors::AXIS_Z.of(ui)));
    heading(ui, "Projection matrix P").on_hover_text("From eye to OpenGL's clip space: z from -1 (near) to 1 (far)");
    let weak = ui.visuals().weak_text_color();
    table(ui, &PROJECTION, camera.clip_from_view(aspect), [weak; 4]);
}

fn row_tints(ui: &Ui) -> [Color32; 4] {
    let weak = ui.visuals().weak_text_color();
    [colors::AXIS_X.of(ui), colors::AXIS_Y.of(ui), colors::AXIS_Z.of(ui), weak]
}

fn digits() -> FontId {
    FontId::new(11.5, FontFamily::Monospace)
}

fn table(ui: &mut Ui, of: &Table, matrix: DMat4, tints: [Color32; 4]) {
    let weak = ui.visuals().weak_text_color();
    let strong = ui.visuals().strong_text_color();
    // glam keeps columns; rows are read across them.
    let rows = matrix.transpose().to_cols_array_2d();
    let has_heads = of.columns.iter().any(|head| !head.is_empty());
    Grid::new(of.id).num_columns(5).spacing([4.0, 3.0]).min_col_width(40.0).show(ui, |ui| {
        if has_heads {
            ui.label("");
            for head in of.columns {
                ui.label(RichText::new(format!("{head:>8}")).font(digits()).color(weak));
            }
            ui.end_row();
        }
        for (((entries, name), tips), tint) in rows.iter().zip(of.rows).zip(of.tips).zip(tints) {
            ui.label(RichText::new(name).font(FontId::proportional(11.5)).color(tint));
            for (entry, tip) in entries.iter().zip(tips) {
                let zero = *entry == 0.0;
                let color = if zero { weak.gamma_multiply(0.6) } else { strong };
                ui.label(RichText::new(entry_text(*entry)).font(digits()).color(color)).on_hover_text(tip);
            }
            ui.end_row();
        }
    });
}

/// Eight characters, the point always in the same place as long as it can be.
fn entry_text(v: f64) -> String {
    let v = v + 0.0;
    if v == 0.0 {
        return format!("{:>8}", "0    ");
    }
    // A zero that was rounded has no sign.
    let text = format!("{v:8.3}").replace("  -0.000", "   0.000");
    if text.chars().count() <= 8 { text } else { format!("{v:8.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_as_wide_as_each_other() {
        for v in [0.0, -0.0, 1.0, -1.0, 0.123456, -123.456, 9999.9, 123_456.0, -1e9] {
            assert_eq!(entry_text(v).chars().count(), 8, "{v}");
        }
        assert_eq!(entry_text(-0.0001).trim(), "0.000");
    }
}
