//! Presets for common comparisons.

use super::noted;
use crate::document::{Document, Pane};
use egui::Ui;
use gonio_light::{Convention, Specular};
use gonio_scene::SceneSettings;
use gonio_scene::detail::{self, Detail};
use gonio_scene::scene_file::Shading;

/// A name, what it shows, and its panes.
type Preset = (&'static str, &'static str, &'static str, Vec<Pane>);

fn presets(scene: &SceneSettings) -> Vec<Preset> {
    let shading = |shading| Pane { shading: Some(shading), ..Pane::default() };
    let specular = |specular| Pane { specular: Some(specular), ..Pane::default() };
    let convention = |convention| Pane { convention: Some(convention), ..Pane::default() };
    let with_detail = |detail| Pane { detail: Some(detail), ..Pane::default() };
    let (coarse, fine) = if scene.objects.iter().any(detail::is_sphere) {
        (with_detail(Detail::Sphere(128)), with_detail(Detail::Sphere(8192)))
    } else {
        (with_detail(Detail::Share(0.05)), Pane::default())
    };
    vec![
        ("one", "One", "One pane with the scene's settings", vec![Pane::default()]),
        (
            "shadings",
            "Flat | Gouraud | Phong",
            "Where the equation is evaluated",
            vec![shading(Shading::Flat), shading(Shading::Gouraud), shading(Shading::Phong)],
        ),
        (
            "speculars",
            "Phong | Blinn-Phong",
            "⟨R·V⟩ or ⟨N·H⟩ to the power of g, the shininess",
            vec![specular(Specular::Phong), specular(Specular::BlinnPhong)],
        ),
        (
            "conventions",
            "Lab | physical",
            "Without and with 1/π and the cosine of the specular term",
            vec![convention(Convention::Lab), convention(Convention::Physical)],
        ),
        ("details", "Coarse | smooth", "Few and many triangles", vec![coarse, fine]),
    ]
}

pub fn show(ui: &mut Ui, document: &mut Document) {
    let presets = presets(&document.scene);
    ui.horizontal_wrapped(|ui| {
        for (id, name, tip, list) in presets {
            let chosen = document.panes.list == list;
            let button = noted(ui, |ui| ui.selectable_label(chosen, name), &format!("preset-{id}"), name, chosen);
            if button.on_hover_text(tip).clicked() {
                document.panes.set(list);
            }
        }
    });
}
