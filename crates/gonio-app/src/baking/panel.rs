//! The settings of a bake, its progress, its figures, and what becomes of it.

use super::{BakedResult, Baking, Running};
use crate::action::Action;
use crate::document::{BakedLook, Document, Pane, PaneArrangement, Panes};
use crate::exported::{self, WidgetRole};
use crate::saving::Product;
use crate::session::Session;
use crate::theme::{self, colors, icons};
use crate::widgets::{NumberField, SPACE, choice, grouped, heading, icon_button, row, toggle};
use egui::{Align, Button, Grid, Label, Layout, ProgressBar, RichText, ScrollArea, Ui, WidgetInfo, vec2};
use gonio_atlas::UvSource;
use gonio_bake::{BakeJob, MapKind};
use gonio_language::tr;
use gonio_scene::Scene;

/// Sizes to choose from, texels along a side, with their names and the ids of their tooltips.
const SIZES: [(u32, &str, &str); 5] = [
    (256, "256", "bench-256-x-256-texels"),
    (512, "512", "bench-512-x-512-texels"),
    (1024, "1024", "bench-1024-x-1024-texels"),
    (2048, "2048", "bench-2048-x-2048-texels"),
    (4096, "4096", "bench-4096-x-4096-texels-64-mb"),
];
/// Samples to choose from: along a side of a texel.
const GRIDS: [(u32, &str, &str); 4] = [
    (1, "1", "bench-one-is-enough-for-textures-which"),
    (2, "4", "bench-four-samples-of-each-texel-smooth"),
    (3, "9", "bench-nine-samples-of-each-texel"),
    (4, "16", "bench-sixteen-samples-of-each-texel"),
];
const SOURCES: [(UvSource, &str, &str); 3] = [
    (UvSource::New, "bench-unwrap", "bench-new-texture-coordinates-charts-without-overlaps"),
    (UvSource::Repacked, "bench-repack", "bench-the-model-s-own-charts-packed"),
    (UvSource::Kept, "bench-keep-uvs", "bench-the-model-s-own-texture-coordinates"),
];
const LOOKS: [(Option<BakedLook>, &str, &str); 3] = [
    (None, "bench-original", "bench-the-scene-s-own-materials"),
    (Some(BakedLook::Materials), "bench-baked", "bench-the-materials-of-the-baked-model"),
    (Some(BakedLook::Picture), "bench-picture", "bench-the-picture-that-the-atlas-shows"),
];
/// Rays of each texel for ambient occlusion.
const RAYS: std::ops::RangeInclusive<u32> = 1..=4096;
/// Rows of the figures: the id of the name, the value, the tooltip, and whether the value is wrong.
type Figures = Vec<(&'static str, String, &'static str, bool)>;

/// A map's name in the interface.
pub fn title(kind: MapKind) -> String {
    let mut letters = gonio_language::name(kind.name()).chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).map(|c| if c == '-' { ' ' } else { c }).collect()
}

fn description(kind: MapKind) -> &'static str {
    match kind {
        MapKind::Diffuse => tr!("bench-the-diffuse-colour-k-d-with"),
        MapKind::Specular => tr!("bench-the-specular-colour-k-s-with"),
        MapKind::Normal => tr!("bench-the-normal-in-tangent-space-mikktspace"),
        MapKind::AmbientOcclusion => tr!("bench-the-share-of-the-hemisphere-that"),
        MapKind::Light => tr!("bench-the-scene-s-light-on-the"),
        MapKind::Position => tr!("bench-the-position-in-world-space-openexr"),
        MapKind::Emitted => tr!("bench-the-emitted-light-e-with-its"),
        MapKind::Id => tr!("bench-a-colour-for-each-part-of"),
    }
}

/// Whether the panel offers these settings: kept ones may be damaged.
pub fn is_offered(job: &BakeJob) -> bool {
    SIZES.iter().any(|(size, ..)| *size == job.size)
        && GRIDS.iter().any(|(grid, ..)| *grid == job.grid)
        && (0.0..=0.1).contains(&job.margin)
        && RAYS.contains(&job.occlusion_rays)
}

/// Shows the panel. `has_atlas`: the atlas is below it, as there is no room beside the scene.
pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, has_atlas: bool, actions: &mut Vec<Action>) {
    if has_atlas && session.baking.result().is_some() {
        pages(ui, &mut session.baking, actions);
        if session.baking.shows_atlas {
            progress(ui, &session.baking, actions);
            super::view(ui, session);
            return;
        }
    }
    ScrollArea::vertical().id_salt("bake").auto_shrink([false, false]).show(ui, |ui| {
        settings(ui, session, actions);
        let Some(result) = session.baking.result().cloned() else { return };
        on_the_model(ui, &mut document.panes, &result);
        if session.generation != result.facts.generation {
            let text = tr!("bench-the-scene-has-changed-since-bake");
            let label = ui.add(Label::new(RichText::new(text).small().color(colors::WARNING.of(ui))).wrap());
            exported::note(ui, &label, "bake-stale", WidgetRole::Text, text, "");
        }
        save(ui, actions);
        figures(ui, &result);
    });
}

/// The tabs of a narrow window.
fn pages(ui: &mut Ui, baking: &mut Baking, actions: &mut Vec<Action>) {
    let options = [
        (false, tr!("bench-settings"), tr!("bench-what-is-baked-and-how")),
        (true, tr!("bench-atlas"), tr!("bench-the-charts-over-the-baked-maps")),
    ];
    ui.horizontal(|ui| {
        choice(ui, "bake-page", tr!("bench-page"), &mut baking.shows_atlas, &options, true);
        if baking.shows_atlas {
            close(ui, actions);
        }
    });
}

/// The button that hides everything about baking.
fn close(ui: &mut Ui, actions: &mut Vec<Action>) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if icon_button(ui, "bake-close", icons::X, tr!("bench-close-the-atlas-and-the-settings")).clicked() {
            actions.push(Action::CloseBake);
        }
    });
}

fn settings(ui: &mut Ui, session: &mut Session, actions: &mut Vec<Action>) {
    let triangles = session.loaded.as_deref().map_or(0, triangle_count);
    let has_tex_coords = session.loaded.as_deref().is_some_and(has_tex_coords);
    let baking = &mut session.baking;
    let is_running = baking.is_running();
    start(ui, baking, triangles, actions);
    ui.add_space(4.0);
    ui.add_enabled_ui(!is_running, |ui| {
        let job = &mut baking.job;
        maps(ui, job);
        heading(ui, tr!("bench-texture"));
        row(ui, tr!("bench-layout"), tr!("bench-the-texture-coordinates-to-bake-for"), |ui| {
            choice(
                ui,
                "bake-layout",
                tr!("bench-layout"),
                &mut job.uv_source,
                &SOURCES.map(|(source, name, tip)| (source, tr!(name), tr!(tip))),
                UvSource::New,
            );
        });
        if job.uv_source != UvSource::New && !has_tex_coords {
            ui.add(Label::new(RichText::new(tr!("bench-the-model-has-no-texture-coordinates")).small().weak()).wrap());
        }
        row(ui, tr!("bench-size"), tr!("bench-texels-along-a-side"), |ui| {
            choice(
                ui,
                "bake-size",
                tr!("bench-size"),
                &mut job.size,
                &SIZES.map(|(size, name, tip)| (size, name, tr!(tip))),
                BakeJob::default().size,
            );
        });
        row(ui, tr!("bench-samples"), tr!("bench-samples-of-each-texel"), |ui| {
            choice(
                ui,
                "bake-samples",
                tr!("bench-samples"),
                &mut job.grid,
                &GRIDS.map(|(grid, name, tip)| (grid, name, tr!(tip))),
                1,
            );
        });
        if job.uv_source != UvSource::Kept {
            row(ui, tr!("bench-margin"), tr!("bench-the-distance-between-charts-as-a"), |ui| {
                let mut percent = 100.0 * job.margin;
                let field =
                    NumberField::new("bake-margin", tr!("bench-margin")).unit("%").range(0.0..=10.0).default(1.0);
                field.step(0.1).width(64.0).show(ui, &mut percent);
                job.margin = 0.01 * percent;
                let texels = tr!("bench-texels", count = format!("{:.1}", job.margin * f64::from(job.size)));
                ui.label(RichText::new(texels).small().weak());
            });
        }
        if job.maps.contains(&MapKind::AmbientOcclusion) {
            row(ui, tr!("bench-rays"), tr!("bench-rays-of-each-texel-for-ambient"), |ui| {
                let mut rays = f64::from(job.occlusion_rays);
                let field = NumberField::new("bake-rays", tr!("bench-rays")).default(64.0).whole();
                let field = field.range(f64::from(*RAYS.start())..=f64::from(*RAYS.end()));
                field.width(64.0).show(ui, &mut rays);
                job.occlusion_rays = rays as u32;
            });
        }
    });
}

/// The button that starts a bake, or the progress of the one at work; at the top, so that a phone shows it.
fn start(ui: &mut Ui, baking: &Baking, triangles: usize, actions: &mut Vec<Action>) {
    if baking.is_running() {
        return progress(ui, baking, actions);
    }
    ui.horizontal(|ui| {
        let text = if baking.result.is_some() { tr!("bench-bake-again") } else { tr!("bench-bake-textures") };
        let fill = colors::ACCENT.of(ui).gamma_multiply(0.35);
        let can_start = !baking.job.maps.is_empty() && triangles > 0;
        let button = Button::new(RichText::new(text).strong()).fill(fill).min_size(vec2(120.0, 26.0));
        let button = ui.add_enabled(can_start, button);
        exported::note(ui, &button, "bake-start", WidgetRole::Button, text, "");
        if button.clicked() {
            actions.push(Action::StartBake);
        }
        let remark = match (triangles, baking.job.maps.len()) {
            (0, _) => tr!("bench-there-is-no-triangle-to-bake").to_owned(),
            (_, 0) => tr!("bench-choose-at-least-one-map").to_owned(),
            (count, _) => tr!("bench-triangles", count = grouped(count as u64, SPACE)),
        };
        ui.label(RichText::new(remark).small().weak());
        close(ui, actions);
    });
    if let Some(error) = &baking.failed {
        let text = RichText::new(error).small().color(colors::ERROR.of(ui));
        let label = ui.add(Label::new(text).wrap());
        exported::note(ui, &label, "bake-error", WidgetRole::Text, tr!("bench-error"), error);
    }
}

fn maps(ui: &mut Ui, job: &mut BakeJob) {
    Grid::new("bake maps").num_columns(2).spacing([18.0, 2.0]).min_col_width(120.0).show(ui, |ui| {
        for pair in MapKind::ALL.chunks(2) {
            for &kind in pair {
                let mut is_chosen = job.maps.contains(&kind);
                let id = format!("bake-map-{}", kind.name());
                if toggle(ui, &id, &title(kind), &mut is_chosen, description(kind)) {
                    job.maps.retain(|other| *other != kind);
                    job.maps.extend(is_chosen.then_some(kind));
                }
            }
            ui.end_row();
        }
    });
}

fn triangle_count(scene: &Scene) -> usize {
    scene.objects.iter().filter_map(|object| scene.meshes.get(object.mesh)).map(|mesh| mesh.triangle_count()).sum()
}

fn has_tex_coords(scene: &Scene) -> bool {
    scene.objects.iter().any(|o| scene.meshes.get(o.mesh).is_some_and(|mesh| !mesh.tex_coords.is_empty()))
}

/// The bar of a bake at work, and its button to cancel.
fn progress(ui: &mut Ui, baking: &Baking, actions: &mut Vec<Action>) {
    if !baking.is_running() {
        return;
    }
    let (step, share, left) = match &baking.running {
        Some(running) => (running.step.0.as_str(), running.step.1, running.seconds_left()),
        None => (tr!("bench-preparing-the-atlas"), 1.0, None),
    };
    let mut text = format!("{step}, {:.0} %", 100.0 * share);
    if let Some(left) = left {
        text += &tr!("bench-about", left = duration(left));
    }
    // The button first: the bar fills what is left.
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        let cancel = ui.button(tr!("bench-cancel"));
        exported::note(ui, &cancel, "bake-cancel", WidgetRole::Button, tr!("bench-cancel"), "");
        if cancel.clicked() {
            actions.push(Action::CancelBake);
        }
        let width = ui.available_width();
        let bar = ui.add(ProgressBar::new(share as f32).desired_width(width).desired_height(10.0));
        bar.widget_info(|| WidgetInfo::labeled(egui::Role::ProgressIndicator, true, &text));
        exported::note(ui, &bar, "bake-progress", WidgetRole::Text, tr!("bench-progress"), format!("{share:.3}"));
    });
    ui.label(RichText::new(&text).small().weak());
}

/// `40 s left`.
fn duration(seconds: f64) -> String {
    if seconds < 90.0 {
        tr!("bench-s-left", seconds = format!("{seconds:.0}"))
    } else {
        tr!("bench-min-left", seconds = format!("{:.0}", seconds / 60.0))
    }
}

impl Running {
    /// The time that is left, once it can be estimated.
    fn seconds_left(&self) -> Option<f64> {
        let (elapsed, share) = (self.start.elapsed().as_secs_f64(), self.step.1);
        (elapsed > 2.0 && share > 0.05).then(|| (elapsed * (1.0 - share) / share).ceil())
    }
}

/// The choice of what the current pane shows, and comparisons.
fn on_the_model(ui: &mut Ui, panes: &mut Panes, result: &BakedResult) {
    heading(ui, tr!("bench-on-the-model"));
    if let Some(pane) = panes.current_mut() {
        let mut look = pane.baked;
        if choice(
            ui,
            "bake-look",
            tr!("bench-on-the-model"),
            &mut look,
            &LOOKS.map(|(look, name, tip)| (look, tr!(name), tr!(tip))),
            None,
        ) {
            pane.show_baked(look);
        }
    }
    ui.horizontal_wrapped(|ui| {
        let ways = [
            ("bake-wipe", tr!("bench-wipe"), tr!("bench-the-original-and-the-baked-model")),
            ("bake-difference", tr!("bench-difference"), tr!("bench-colour-map-of-the-difference-between")),
            ("bake-single", tr!("bench-one-picture"), tr!("bench-a-single-pane-again")),
        ];
        for (id, name, tip) in ways {
            if id == "bake-single" && panes.list.len() == 1 {
                continue;
            }
            let button = ui.button(name);
            exported::note(ui, &button, id, WidgetRole::Button, name, "");
            if button.on_hover_text(tip).clicked() {
                compare(panes, id);
            }
        }
    });
    let seconds = result.facts.seconds;
    let label = ui.label(RichText::new(tr!("bench-baked-in-s", seconds = format!("{seconds:.1}"))).small().weak());
    exported::note(ui, &label, "bake-time", WidgetRole::Text, tr!("bench-time"), seconds);
}

fn compare(panes: &mut Panes, way: &str) {
    let pane = Pane { baked: None, ..panes.current().cloned().unwrap_or_default() };
    if way == "bake-single" {
        let pane = panes.current().cloned().unwrap_or_default();
        return panes.set(vec![pane]);
    }
    let mut baked = pane.clone();
    baked.show_baked(Some(BakedLook::Materials));
    panes.set(vec![pane, baked]);
    panes.current = 1;
    panes.arrangement = if way == "bake-wipe" { PaneArrangement::Wipe(0.5) } else { PaneArrangement::Difference };
}

fn save(ui: &mut Ui, actions: &mut Vec<Action>) {
    heading(ui, tr!("bench-save-2"));
    ui.horizontal_wrapped(|ui| {
        for &product in Product::OF_BAKING {
            let tip = match product {
                Product::BakedObj => tr!("bench-the-model-as-obj-and-mtl"),
                Product::BakedGlb => tr!("bench-one-file-with-the-model-and"),
                _ => tr!("bench-all-files-in-one-obj-mtl"),
            };
            let icon = RichText::new(icons::FLOPPY_DISK).font(theme::icon_font(15.0));
            let button = ui.button((icon, product.title()));
            button.widget_info(|| {
                WidgetInfo::labeled(egui::Role::Button, true, tr!("bench-save", title = product.title()))
            });
            exported::note(ui, &button, &format!("save-{}", product.id()), WidgetRole::Button, product.title(), "");
            if button.on_hover_text(tip).clicked() {
                actions.push(Action::Save(product));
            }
        }
    });
}

fn figures(ui: &mut Ui, result: &BakedResult) {
    let report = &result.atlas.report;
    heading(ui, tr!("bench-atlas"));
    let number = |n: usize| grouped(n as u64, SPACE);
    let mut rows: Figures = vec![
        ("bake-charts", number(report.charts), tr!("bench-connected-pieces-of-the-surface"), false),
        (
            "bake-coverage",
            format!("{:.1} %", 100.0 * report.coverage),
            tr!("bench-the-share-of-the-texture-that"),
            false,
        ),
        (
            "bake-overlaps",
            tr!("bench-texels", count = number(report.overlapping_texels)),
            tr!("bench-texels-that-two-or-more-triangles"),
            report.overlapping_texels > 0,
        ),
        ("bake-angle-stretch", format!("{:.3}", report.angle_stretch), tr!("bench-1-keeps-all-angles"), false),
        ("bake-area-stretch", format!("{:.3}", report.area_stretch), tr!("bench-1-keeps-all-areas"), false),
        (
            "bake-density",
            tr!("bench-texels-per-unit", texels_per_unit = format!("{:.1}", report.texels_per_unit)),
            tr!("bench-texels-per-unit-of-length-in"),
            false,
        ),
    ];
    if report.margin_texels > 0.0 {
        rows.push((
            "bench-margin",
            tr!("bench-texels", count = format!("{:.1}", report.margin_texels)),
            tr!("bench-the-distance-between-charts"),
            false,
        ));
    }
    let odd = [
        ("bake-degenerate", report.degenerate_triangles, true),
        ("bake-collapsed", report.collapsed_triangles, true),
        ("bake-mirrored", report.mirrored_triangles, false),
    ];
    for (name, count, is_wrong) in odd.into_iter().filter(|(_, count, _)| *count > 0) {
        rows.push((name, tr!("bench-triangles", count = number(count)), "", is_wrong));
    }
    Grid::new("bake figures").num_columns(2).spacing([14.0, 2.0]).show(ui, |ui| {
        for (name, value, tip, is_odd) in rows {
            let label = ui.label(RichText::new(tr!(name)).weak());
            if !tip.is_empty() {
                label.on_hover_text(tip);
            }
            let mut text = RichText::new(&value).monospace();
            if is_odd {
                text = text.color(colors::WARNING.of(ui));
            }
            let label = ui.label(text);
            exported::note(ui, &label, name, WidgetRole::Text, tr!(name), value);
            ui.end_row();
        }
    });
}
