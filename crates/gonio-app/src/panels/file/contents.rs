//! What a model's file holds, in numbers.

use super::{MOST_ROWS, figure, more};
use crate::exported::{self, WidgetRole};
use crate::widgets::{NO_BREAK, grouped, heading};
use egui::{Label, RichText, Ui};
use gonio_mesh::{ModelLightKind, NormalSource};
use gonio_scene::inspect::Inspection;

/// Format and size of the file.
pub fn size(ui: &mut Ui, i: &Inspection) {
    let text = match i.unpacked_bytes {
        Some(unpacked) => format!("{}, {}, {} unpacked", i.format.name(), bytes(i.bytes), bytes(unpacked)),
        None => format!("{}, {}", i.format.name(), bytes(i.bytes)),
    };
    let label = ui.add(Label::new(RichText::new(&text).small().weak()).wrap());
    exported::note(ui, &label, "file-format", WidgetRole::Text, "Format", text);
}

/// The elements of the file, its triangles, their connections, and its parts.
pub fn show(ui: &mut Ui, i: &Inspection) {
    heading(ui, "Content");
    if let Some(exporter) = &i.exporter {
        noted(ui, "Exporter", exporter);
    }
    let counts: Vec<String> =
        i.contents.iter().map(|count| format!("{} {}", grouped(count.count, NO_BREAK), count.what)).collect();
    if !counts.is_empty() {
        noted(ui, "Elements", &counts.join(", "));
    }
    geometry(ui, i);
    surface(ui, i);
    heading(ui, "Parts");
    for part in i.geometry.parts.iter().take(MOST_ROWS) {
        let name = if part.name.is_empty() { "(no name)" } else { &part.name };
        let material = if part.material.is_empty() { "the default material" } else { &part.material };
        figure(ui, name, &format!("{} triangles, {material}", grouped(part.triangles as u64, NO_BREAK)));
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
    noted(ui, "Triangles", &grouped(g.triangles as u64, NO_BREAK));
    noted(ui, "Vertices", &format!("{} (equal corners merged)", grouped(g.vertices as u64, NO_BREAK)));
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let (low, high) = (g.min[axis], g.max[axis]);
        let title = if axis == 0 { "Bounds" } else { "" };
        figure(ui, title, &format!("{name} from {} to {}, size {}", number(low), number(high), number(high - low)));
    }
    let normals = match i.normals.source {
        NormalSource::None => "none",
        NormalSource::File => "from the file",
        NormalSource::FileAndAveraged => "from the file, averaged where missing",
        NormalSource::Flat => "one per triangle",
        NormalSource::Averaged => "averaged over adjacent faces, weighted by angle",
    };
    noted(ui, "Normals", normals);
    for note in &i.normals.notes {
        figure(ui, "", note);
    }
    match g.tex_coords {
        Some([low, high]) => {
            let range = |k: usize| format!("{} to {}", number(low[k]), number(high[k]));
            figure(ui, "Texture coordinates", &format!("u {}, v {}", range(0), range(1)))
        }
        None => figure(ui, "Texture coordinates", "none"),
    };
    if g.colors {
        figure(ui, "Vertex colours", "yes");
    }
    match g.smoothing_groups {
        Some(0) => drop(figure(ui, "Smoothing groups", "off everywhere")),
        Some(groups) => drop(figure(ui, "Smoothing groups", &groups.to_string())),
        None => {}
    }
    let whole: u64 = g.memory.iter().map(|memory| memory.count).sum();
    figure(ui, "Memory", &bytes(whole));
}

fn surface(ui: &mut Ui, i: &Inspection) {
    let s = &i.surface;
    let state = match (s.closed, s.outward) {
        (true, true) => "closed, front faces outside",
        (true, false) => "closed, but not every piece has its front faces outside",
        (false, _) => "open",
    };
    noted(ui, "Surface", state);
    figure(ui, "Pieces", &grouped(s.pieces, NO_BREAK));
    if let Some(genus) = s.genus {
        figure(ui, "Genus", &genus.to_string());
    }
    figure(ui, "Area", &number(s.area as f32));
    if let Some(volume) = s.volume {
        figure(ui, "Volume", &number(volume as f32));
    }
    if !s.orientable {
        figure(ui, "Orientation", "no choice of front faces is consistent");
    } else if s.triangles_to_turn > 0 {
        let turn = grouped(s.triangles_to_turn, NO_BREAK);
        figure(ui, "Orientation", &format!("{turn} triangles must be flipped to make all front faces consistent"));
    }
    let findings = [
        ("Triangles without area", &s.degenerate_triangles),
        ("Duplicate triangles", &s.duplicate_triangles),
        ("Triangles back to back", &s.back_to_back_triangles),
        ("Edges of one triangle only", &s.boundary_edges),
        ("Edges of more than two triangles", &s.non_manifold_edges),
        ("Edges between a front and a back face", &s.inconsistent_edges),
        ("Points where surfaces merely touch", &s.non_manifold_positions),
    ];
    for (name, found) in findings.into_iter().filter(|(_, found)| found.count > 0) {
        let count = grouped(found.count, NO_BREAK);
        match found.first.first() {
            Some(first) => {
                let at: Vec<String> = first.positions.iter().map(|p| p.map(number).join(", ")).collect();
                figure(ui, name, &format!("{count}, the first at {}", at.join(" to ")))
            }
            None => figure(ui, name, &count),
        };
    }
}

/// Lights, cameras, and what other programs read differently.
pub fn after_materials(ui: &mut Ui, i: &Inspection) {
    if !i.lights.is_empty() || !i.cameras.is_empty() {
        heading(ui, "Lights and cameras");
    }
    for light in i.lights.iter().take(MOST_ROWS) {
        let kind = match light.kind {
            ModelLightKind::Ambient => "ambient light",
            ModelLightKind::Directional => "directional light",
            ModelLightKind::Point => "point light",
            ModelLightKind::Spot { .. } => "spot light",
        };
        let color = light.color.map(number).join(" ");
        figure(ui, &light.name, &format!("{kind}, colour {color}, intensity {}", number(light.intensity)));
    }
    for camera in i.cameras.iter().take(MOST_ROWS) {
        let lens = match camera.fov_y_rad {
            Some(fov) => format!("camera, {}\u{b0} high", number(fov.to_degrees() as f32)),
            None => "camera with parallel projection".to_owned(),
        };
        figure(ui, &camera.name, &lens);
    }
    if i.differences.is_empty() {
        return;
    }
    heading(ui, "Interpreted differently by other programs");
    for difference in &i.differences {
        ui.add(Label::new(RichText::new(difference.feature).small().strong()).wrap());
        ui.add(Label::new(RichText::new(format!("Elsewhere: {}", difference.others)).small().weak()).wrap());
        ui.add(Label::new(RichText::new(format!("Here: {}", difference.here)).small().weak()).wrap());
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
        0..10_000 => format!("{} bytes", grouped(count, NO_BREAK)),
        10_000..1_000_000 => format!("{:.1} kB", value / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", value / 1e6),
        _ => format!("{:.2} GB", value / 1e9),
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
