//! What a model's file holds, in numbers.

use super::{MOST_ROWS, figure, more};
use crate::exported::{self, WidgetRole};
use crate::widgets::{NO_BREAK, grouped, heading};
use egui::{Label, RichText, Ui};
use gonio_language::tr;
use gonio_mesh::{ModelLightKind, NormalSource};
use gonio_scene::inspect::Inspection;

/// Format and size of the file.
pub fn size(ui: &mut Ui, i: &Inspection) {
    let text = match i.unpacked_bytes {
        Some(unpacked) => {
            tr!("file-unpacked", name = i.format.name(), bytes = bytes(i.bytes), unpacked = bytes(unpacked))
        }
        None => format!("{}, {}", i.format.name(), bytes(i.bytes)),
    };
    let label = ui.add(Label::new(RichText::new(&text).small().weak()).wrap());
    exported::note(ui, &label, "file-format", WidgetRole::Text, tr!("file-format"), text);
}

/// The elements of the file, its triangles, their connections, and its parts.
pub fn show(ui: &mut Ui, i: &Inspection) {
    heading(ui, tr!("file-content"));
    if let Some(exporter) = &i.exporter {
        noted(ui, tr!("file-exporter"), exporter);
    }
    let counts: Vec<String> =
        i.contents.iter().map(|count| format!("{} {}", grouped(count.count, NO_BREAK), count.what)).collect();
    if !counts.is_empty() {
        noted(ui, tr!("file-elements"), &counts.join(", "));
    }
    geometry(ui, i);
    surface(ui, i);
    heading(ui, tr!("file-parts"));
    for part in i.geometry.parts.iter().take(MOST_ROWS) {
        let name = if part.name.is_empty() { tr!("file-no-name") } else { &part.name };
        let material = if part.material.is_empty() { tr!("file-the-default-material") } else { &part.material };
        figure(
            ui,
            name,
            &tr!("file-triangles-2", count = grouped(part.triangles as u64, NO_BREAK), material = material),
        );
    }
    more(ui, i.geometry.parts.len());
}

/// A figure that tests and screen readers find by its name.
fn noted(ui: &mut Ui, name: &str, value: &str) {
    let row = figure(ui, name, value);
    exported::note(ui, &row, &format!("file-{}", name.to_lowercase()), WidgetRole::Text, name, value);
}

fn geometry(ui: &mut Ui, i: &Inspection) {
    let g = &i.geometry;
    noted(ui, tr!("file-triangles"), &grouped(g.triangles as u64, NO_BREAK));
    noted(ui, tr!("file-vertices"), &tr!("file-equal-corners-merged", count = grouped(g.vertices as u64, NO_BREAK)));
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let (low, high) = (g.min[axis], g.max[axis]);
        let title = if axis == 0 { tr!("file-bounds") } else { "" };
        figure(
            ui,
            title,
            &tr!("file-from-to-size", name = name, low = number(low), high = number(high), size = number(high - low)),
        );
    }
    let normals = match i.normals.source {
        NormalSource::None => "none",
        NormalSource::File => tr!("file-from-the-file"),
        NormalSource::FileAndAveraged => tr!("file-from-the-file-averaged-where-missing"),
        NormalSource::Flat => tr!("file-one-per-triangle"),
        NormalSource::Averaged => tr!("file-averaged-over-adjacent-faces-weighted-by"),
    };
    noted(ui, tr!("file-normals"), normals);
    for note in &i.normals.notes {
        figure(ui, "", note);
    }
    match g.tex_coords {
        Some([low, high]) => {
            let range = |k: usize| tr!("file-to", least = number(low[k]), greatest = number(high[k]));
            figure(ui, tr!("file-texture-coordinates"), &format!("u {}, v {}", range(0), range(1)))
        }
        None => figure(ui, tr!("file-texture-coordinates"), "none"),
    };
    if g.colors {
        figure(ui, tr!("file-vertex-colours"), "yes");
    }
    match g.smoothing_groups {
        Some(0) => drop(figure(ui, tr!("file-smoothing-groups"), tr!("file-off-everywhere"))),
        Some(groups) => drop(figure(ui, tr!("file-smoothing-groups"), &groups.to_string())),
        None => {}
    }
    let whole: u64 = g.memory.iter().map(|memory| memory.count).sum();
    figure(ui, tr!("file-memory"), &bytes(whole));
}

fn surface(ui: &mut Ui, i: &Inspection) {
    let s = &i.surface;
    let state = match (s.closed, s.outward) {
        (true, true) => tr!("file-closed-front-faces-outside"),
        (true, false) => tr!("file-closed-but-not-every-piece-has"),
        (false, _) => "open",
    };
    noted(ui, tr!("file-surface"), state);
    figure(ui, tr!("file-pieces"), &grouped(s.pieces, NO_BREAK));
    if let Some(genus) = s.genus {
        figure(ui, tr!("file-genus"), &genus.to_string());
    }
    figure(ui, tr!("file-area"), &number(s.area as f32));
    if let Some(volume) = s.volume {
        figure(ui, tr!("file-volume"), &number(volume as f32));
    }
    if !s.orientable {
        figure(ui, tr!("file-orientation"), tr!("file-no-choice-of-front-faces-is"));
    } else if s.triangles_to_turn > 0 {
        let turn = grouped(s.triangles_to_turn, NO_BREAK);
        figure(ui, tr!("file-orientation"), &tr!("file-triangles-must-be-flipped-to-make", count = turn));
    }
    let findings = [
        (tr!("file-triangles-without-area"), &s.degenerate_triangles),
        (tr!("file-duplicate-triangles"), &s.duplicate_triangles),
        (tr!("file-triangles-back-to-back"), &s.back_to_back_triangles),
        (tr!("file-edges-of-one-triangle-only"), &s.boundary_edges),
        (tr!("file-edges-of-more-than-two-triangles"), &s.non_manifold_edges),
        (tr!("file-edges-between-a-front-and-a"), &s.inconsistent_edges),
        (tr!("file-points-where-surfaces-merely-touch"), &s.non_manifold_positions),
    ];
    for (name, found) in findings.into_iter().filter(|(_, found)| found.count > 0) {
        let count = grouped(found.count, NO_BREAK);
        match found.first.first() {
            Some(first) => {
                let at: Vec<String> = first.positions.iter().map(|p| p.map(number).join(", ")).collect();
                figure(ui, name, &tr!("file-the-first-at", count = count, place = at.join(" to ")))
            }
            None => figure(ui, name, &count),
        };
    }
}

/// Lights, cameras, and what other programs read differently.
pub fn after_materials(ui: &mut Ui, i: &Inspection) {
    if !i.lights.is_empty() || !i.cameras.is_empty() {
        heading(ui, tr!("file-lights-and-cameras"));
    }
    for light in i.lights.iter().take(MOST_ROWS) {
        let kind = match light.kind {
            ModelLightKind::Ambient => tr!("file-ambient-light"),
            ModelLightKind::Directional => tr!("file-directional-light"),
            ModelLightKind::Point => tr!("file-point-light"),
            ModelLightKind::Spot { .. } => tr!("file-spot-light"),
        };
        let color = light.color.map(number).join(" ");
        figure(
            ui,
            &light.name,
            &tr!("file-colour-intensity", kind = kind, color = color, intensity = number(light.intensity)),
        );
    }
    for camera in i.cameras.iter().take(MOST_ROWS) {
        let lens = match camera.fov_y_rad {
            Some(fov) => tr!("file-camera-high", degrees = number(fov.to_degrees() as f32)),
            None => tr!("file-camera-with-parallel-projection").to_owned(),
        };
        figure(ui, &camera.name, &lens);
    }
    if i.differences.is_empty() {
        return;
    }
    heading(ui, tr!("file-interpreted-differently-by-other-programs"));
    for difference in &i.differences {
        ui.add(Label::new(RichText::new(difference.feature).small().strong()).wrap());
        ui.add(Label::new(RichText::new(tr!("file-elsewhere", others = difference.others)).small().weak()).wrap());
        ui.add(Label::new(RichText::new(tr!("file-here", here = difference.here)).small().weak()).wrap());
    }
}

/// A number: exactly if that is short, else with four decimals.
fn number(value: f32) -> String {
    let text = (value + 0.0).to_string();
    if text.len() <= 9 {
        return text;
    }
    let rounded = format!("{value:.4}");
    if rounded == "-0.0000" { "0".to_owned() } else { rounded }
}

/// A number of bytes in a readable unit.
pub fn bytes(count: u64) -> String {
    let value = count as f64;
    match count {
        0..10_000 => tr!("file-bytes", count = grouped(count, NO_BREAK)),
        10_000..1_000_000 => tr!("file-kb", size = format!("{:.1}", value / 1e3)),
        1_000_000..1_000_000_000 => tr!("file-mb", size = format!("{:.1}", value / 1e6)),
        _ => tr!("file-gb", size = format!("{:.2}", value / 1e9)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_sizes_are_short() {
        assert_eq!((number(0.1), number(-0.0), number(1.0 / 3.0)), ("0.1".into(), "0".into(), "0.3333".into()));
        assert_eq!(
            (bytes(999), bytes(12_345), bytes(3_200_000)),
            ("999 bytes".into(), "12.3 kB".into(), "3.2 MB".into())
        );
    }
}
