//! Settings of panes: presets for common comparisons, and the current pane's own settings.

use super::{noted, truth};
use crate::document::{Document, Pane, PaneReflectance, TruthSettings};
use crate::exported::{self, WidgetRole};
use crate::widgets::slug;
use egui::{ComboBox, Grid, Ui};
use gonio_language::{name, tr};
use gonio_light::{Convention, Quantity, Specular};
use gonio_scene::detail::{self, LevelOfDetail};
use gonio_scene::scene_file::Shading;
use gonio_scene::{Scene, SceneSettings, ViewSpec};

const AS_SCENE: &str = "scene-as-in-the-scene";

/// Shows the settings; `loaded` is the scene without them.
pub fn show(ui: &mut Ui, document: &mut Document, loaded: Option<&Scene>) {
    let scene = &document.scene;
    let Some(pane) = document.panes.list.get_mut(document.panes.current) else { return };
    truth::show(ui, pane);
    Grid::new("pane settings").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
        let shadings = Shading::ALL.iter().map(|&s| (s, s.name()));
        choice(ui, "pane-shading", tr!("scene-shading"), &mut pane.shading, shadings.collect());
        let speculars = Specular::ALL.iter().map(|&s| (s, s.name()));
        choice(ui, "pane-specular", tr!("scene-specular-term"), &mut pane.specular, speculars.collect());
        let conventions = Convention::ALL.iter().map(|&c| (c, c.name()));
        choice(ui, "pane-convention", tr!("scene-convention"), &mut pane.convention, conventions.collect());
        let weights = [(true, "yes"), (false, "no")];
        choice(ui, "pane-cosine-weighted", tr!("scene-spec-times-n-l"), &mut pane.cosine_weighted, weights.into());
        let brdfs = PaneReflectance::all().into_iter().map(|r| (r, r.name()));
        choice(ui, "pane-brdf", "BRDF", &mut pane.reflectance, brdfs.collect());
        let view = |quantity: Quantity| (ViewSpec { quantity, light: None }, quantity.name());
        if pane.truth.is_none() {
            choice(
                ui,
                "pane-view",
                tr!("scene-view"),
                &mut pane.view,
                Quantity::ALL.iter().copied().map(view).collect(),
            );
        }
        detail(ui, pane, scene, loaded);
    });
    if *pane != Pane::default() {
        let reset = ui.button(tr!("scene-reset-to-the-scene"));
        exported::note(ui, &reset, "pane-reset", WidgetRole::Button, tr!("scene-reset-to-the-scene"), "");
        if reset.clicked() {
            *pane = Pane::default();
        }
    }
}

/// A row of the table: the pane's own value, or the scene's. A double click on the name resets it to the scene's.
fn choice<T: Copy + PartialEq>(ui: &mut Ui, id: &str, label: &str, value: &mut Option<T>, all: Vec<(T, &'static str)>) {
    let of_row = ui.add(egui::Label::new(label).sense(egui::Sense::click()));
    if of_row.double_clicked() {
        *value = None;
    }
    let known = value.and_then(|v| all.iter().find(|(other, _)| *other == v));
    let chosen = known.map_or(tr!(AS_SCENE), |(_, word)| name(word));
    let combo = ComboBox::from_id_salt(id).width(170.0).selected_text(chosen).show_ui(ui, |ui| {
        let mut entry = |requested: Option<T>, of_entry: &str, shown: &str| {
            let response = ui.selectable_value(value, requested, shown);
            let of_entry = format!("{id}-{}", slug(of_entry));
            exported::note(ui, &response, &of_entry, WidgetRole::Choice, shown, *value == requested);
        };
        entry(None, "as in the scene", tr!(AS_SCENE));
        for (other, word) in &all {
            entry(Some(*other), word, name(word));
        }
    });
    combo.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, label));
    exported::note(ui, &combo.response, id, WidgetRole::Choice, label, chosen);
    ui.end_row();
}

/// Number of triangles of the sphere, or share of each model's.
fn detail(ui: &mut Ui, pane: &mut Pane, scene: &SceneSettings, loaded: Option<&Scene>) {
    let of_row = ui.add(egui::Label::new(tr!("scene-triangles")).sense(egui::Sense::click()));
    if of_row.on_hover_text(tr!("scene-double-click-as-in-the-scene")).double_clicked() {
        pane.detail = None;
    }
    ui.vertical(|ui| {
        ui.spacing_mut().slider_width = 110.0;
        if let Some(sphere) = scene.objects.iter().position(detail::is_sphere) {
            // The slider sets the frequency f; each of the octahedron's eight faces has f² triangles.
            let own = loaded.and_then(|loaded| loaded.meshes.get(loaded.objects.get(sphere)?.mesh));
            let shown = match pane.detail {
                Some(LevelOfDetail::Sphere(triangles)) => triangles,
                _ => own.map_or(0, |mesh| mesh.triangle_count()),
            };
            let mut frequency = (shown as f64 / 8.0).sqrt().round();
            let slider = egui::Slider::new(&mut frequency, 1.0..=64.0)
                .step_by(1.0)
                .logarithmic(true)
                .custom_formatter(|f, _| format!("{:.0}", 8.0 * f * f))
                .custom_parser(|text| text.trim().parse::<f64>().ok().map(|n| (n.max(8.0) / 8.0).sqrt().round()));
            let slider = ui.add(slider).on_hover_text(tr!("scene-triangles-of-each-sphere-8-f"));
            exported::note(ui, &slider, "pane-sphere", WidgetRole::Number, tr!("scene-triangles-of-the-sphere"), shown);
            if slider.changed() {
                pane.detail = Some(LevelOfDetail::Sphere((8.0 * frequency * frequency) as usize));
            }
        }
        let mut percent = if let Some(LevelOfDetail::Share(share)) = pane.detail { 100.0 * share } else { 100.0 };
        let slider = egui::Slider::new(&mut percent, 1.0..=100.0).step_by(1.0).logarithmic(true).suffix(" %");
        let slider = ui.add(slider).on_hover_text(tr!("scene-share-of-each-model-s-triangles"));
        exported::note(ui, &slider, "pane-simplify", WidgetRole::Number, tr!("scene-share-of-the-triangles"), percent);
        if slider.changed() {
            pane.detail = (percent < 100.0).then_some(LevelOfDetail::Share(percent / 100.0));
        }
    });
    ui.end_row();
}

/// Id, name, tooltip and panes.
type Preset = (&'static str, &'static str, &'static str, Vec<Pane>);

fn presets(scene: &SceneSettings) -> Vec<Preset> {
    let shading = |shading| Pane { shading: Some(shading), ..Pane::default() };
    let specular = |specular| Pane { specular: Some(specular), ..Pane::default() };
    let convention = |convention| Pane { convention: Some(convention), ..Pane::default() };
    let with_detail = |detail| Pane { detail: Some(detail), ..Pane::default() };
    let (coarse, fine) = if scene.objects.iter().any(detail::is_sphere) {
        (with_detail(LevelOfDetail::Sphere(128)), with_detail(LevelOfDetail::Sphere(8192)))
    } else {
        (with_detail(LevelOfDetail::Share(0.05)), Pane::default())
    };
    vec![
        ("one", tr!("scene-one"), tr!("scene-one-pane-with-the-scene-s"), vec![Pane::default()]),
        (
            "shadings",
            tr!("scene-flat-gouraud-phong"),
            tr!("scene-where-the-equation-is-evaluated"),
            vec![shading(Shading::Flat), shading(Shading::Gouraud), shading(Shading::Phong)],
        ),
        (
            "speculars",
            "Phong | Blinn-Phong",
            tr!("scene-r-v-or-n-h-to"),
            vec![specular(Specular::Phong), specular(Specular::BlinnPhong)],
        ),
        (
            "conventions",
            tr!("scene-lab-physical"),
            tr!("scene-without-and-with-1-and-the"),
            vec![convention(Convention::Lab), convention(Convention::Physical)],
        ),
        (
            "truth",
            tr!("scene-traced-opengl"),
            tr!("scene-the-rendering-equation-by-following-paths"),
            vec![Pane { truth: Some(TruthSettings::default()), ..Pane::default() }, Pane::default()],
        ),
        ("details", tr!("scene-coarse-smooth"), tr!("scene-few-and-many-triangles"), vec![coarse, fine]),
    ]
}

/// Shows the presets.
pub fn show_presets(ui: &mut Ui, document: &mut Document) {
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
