//! The toolbar over the picture: view, overlays, and the legend of debug views.

use crate::document::{Document, Pane, TruthSettings, VIEW_KEYS};
use crate::exported::{self, WidgetRole};
use crate::session::{Session, Settings, Tab};
use crate::theme::{self, colors, icons};
use egui::{Align2, Color32, FontId, Frame, Margin, Painter, Rect, RichText, Ui, UiBuilder, Vec2, pos2, vec2};
use glam::DVec3;
use gonio_language::{name, tr};
use gonio_light::Quantity;
use gonio_light::quantity::Encoding;
use gonio_scene::{DisplayMap, SpecialView, ViewSpec};

/// Height with margins, points.
pub const HEIGHT: f32 = 34.0;

const TRACED: &str = "scene-traced-truth";
const ABOUT_TRACED: &str = "scene-solves-the-rendering-equation-by-following";
/// What a traced pane does not follow. The page's worker reads the scene again, without levels of detail.
const NOT_TRACED: &str = if cfg!(target_arch = "wasm32") {
    "scene-overlays-are-not-drawn-over-it-2"
} else {
    "scene-overlays-are-not-drawn-over-it"
};

/// Shows the toolbar at the upper left of a pane. `frame` is the drawn frame.
pub fn show(ui: &mut Ui, rect: Rect, frame: &gonio_scene::Frame, document: &mut Document, session: &mut Session) {
    let lights = document.scene.lights.len();
    let Some(pane) = document.panes.current_mut() else { return };
    let room = Rect::from_min_max(rect.min + vec2(10.0, 10.0), rect.max - vec2(10.0, 10.0));
    let plate = Frame::NONE
        .fill(ui.visuals().window_fill.gamma_multiply(0.9))
        .corner_radius(7.0)
        .inner_margin(Margin::symmetric(5, 3));
    let shown = ui.scope_builder(UiBuilder::new().max_rect(room), |ui| {
        plate.show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = if theme::touch::least(ui) > 0.0 { 1.0 } else { 3.0 };
                chooser(ui, pane, lights);
                ui.add_space(3.0);
                overlays(ui, pane, &mut session.settings);
                ui.add_space(3.0);
                tools(ui, session);
            });
        });
    });
    let below = shown.response.rect.left_bottom() + vec2(0.0, 6.0);
    legend(ui, &ui.painter_at(rect), below, pane, frame);
}

/// The view's name, with a menu of all views.
fn chooser(ui: &mut Ui, pane: &mut Pane, lights: usize) {
    let title = RichText::new(format!("{}  {}", title(pane), icons::CARET_DOWN));
    let menu = ui.menu_button(title, |ui| {
        ui.set_min_width(210.0);
        let entry = |ui: &mut Ui, pane: &mut Pane, key: Option<usize>, quantity: Quantity| {
            let is_shown = pane.special.is_none()
                && pane.truth.is_none()
                && pane.view.map_or(Quantity::Total, |v| v.quantity) == quantity;
            let symbol = quantity.symbol().map(|s| format!("  {s}")).unwrap_or_default();
            let shown = if quantity == Quantity::Total {
                tr!("scene-picture").to_owned()
            } else {
                name(quantity.name()).to_owned() + &symbol
            };
            let mut button = egui::Button::selectable(is_shown, shown.as_str());
            if let Some(key) = key {
                button = button.shortcut_text(key.to_string());
            }
            let response = ui.add(button);
            exported::note(ui, &response, &format!("view-{quantity}"), WidgetRole::Choice, &shown, is_shown);
            if response.on_hover_text(name(quantity.description().trim())).clicked() {
                pane.show_view((quantity != Quantity::Total).then_some(ViewSpec { quantity, light: None }));
                ui.close();
            }
        };
        egui::ScrollArea::vertical().max_height(420.0).show(ui, |ui| {
            entry(ui, pane, Some(0), Quantity::Total);
            let traced = egui::Button::selectable(pane.truth.is_some(), tr!(TRACED)).shortcut_text("Shift + T");
            let traced = ui.add(traced);
            exported::note(ui, &traced, "view-traced", WidgetRole::Choice, tr!(TRACED), pane.truth.is_some());
            if traced.on_hover_text(format!("{} {}", tr!(ABOUT_TRACED), tr!(NOT_TRACED))).clicked() {
                pane.show_truth(Some(TruthSettings::default()));
                ui.close();
            }
            for (number, quantity) in VIEW_KEYS.into_iter().enumerate() {
                entry(ui, pane, Some(number + 1), quantity);
            }
            ui.separator();
            for view in [SpecialView::UvChecker, SpecialView::Overdraw] {
                let is_shown = pane.special == Some(view);
                let key = if view == SpecialView::Overdraw { "Shift + V" } else { "Shift + U" };
                let response = ui.add(egui::Button::selectable(is_shown, name(view.name())).shortcut_text(key));
                exported::note(ui, &response, &format!("view-{view}"), WidgetRole::Choice, name(view.name()), is_shown);
                if response.on_hover_text(name(view.description().trim())).clicked() {
                    pane.show_special(Some(view));
                    ui.close();
                }
            }
            ui.separator();
            for &quantity in Quantity::ALL {
                if quantity != Quantity::Total && !VIEW_KEYS.contains(&quantity) {
                    entry(ui, pane, None, quantity);
                }
            }
        });
    });
    exported::note(ui, &menu.response, "view-chooser", WidgetRole::Choice, "view", title_of(pane));
    menu.response.on_hover_text(tr!("scene-view-of-the-scene-number-keys"));
    // A view of one light has a menu of the lights.
    if let Some(view) = pane.view.as_mut().filter(|view| pane.special.is_none() && view.quantity.per_light())
        && lights > 1
    {
        let text =
            view.light.map_or_else(|| tr!("scene-first-light").to_owned(), |light| tr!("scene-light-3", light = light));
        ui.menu_button(format!("{text}  {}", icons::CARET_DOWN), |ui| {
            for light in 0..lights {
                if ui.selectable_label(view.light == Some(light), tr!("scene-light-3", light = light)).clicked() {
                    view.light = Some(light);
                    ui.close();
                }
            }
        });
    }
}

fn title_of(pane: &Pane) -> String {
    if pane.truth.is_some() {
        return tr!(TRACED).to_owned();
    }
    match (pane.special, pane.view) {
        (Some(special), _) => name(special.name()).to_owned(),
        (None, Some(view)) => described(view),
        (None, None) => tr!("scene-picture").to_owned(),
    }
}

/// A view's quantity, and the light that it is of.
fn described(view: ViewSpec) -> String {
    let quantity = name(view.quantity.name());
    view.light.map_or_else(|| quantity.to_owned(), |light| tr!("window-of-light", quantity = quantity, light = light))
}

fn title(pane: &Pane) -> String {
    if pane.truth.is_some() {
        return tr!("scene-traced-picture").to_owned();
    }
    let symbol = pane.view.filter(|_| pane.special.is_none()).and_then(|view| view.quantity.symbol());
    symbol.map_or_else(|| title_of(pane), |symbol| format!("{} {symbol}", title_of(pane)))
}

fn overlays(ui: &mut Ui, pane: &mut Pane, settings: &mut Settings) {
    // None is drawn over a traced picture.
    if pane.truth.is_some() {
        return;
    }
    let overlays = &mut pane.overlays;
    for (on, id, icon, tip) in [
        (&mut overlays.wireframe, "overlay-wireframe", icons::POLYGON, tr!("scene-wireframe-shift-w")),
        (&mut overlays.normals, "overlay-normals", icons::WIND, tr!("scene-normals-shift-n")),
        (&mut overlays.boxes, "overlay-boxes", icons::BOUNDING_BOX, tr!("scene-bounding-boxes-shift-b")),
    ] {
        if toggle(ui, id, icon, tip, *on) {
            *on = !*on;
        }
    }
    if toggle(ui, "ground", icons::GRID_FOUR, tr!("scene-ground-shift-g"), !settings.hides_ground) {
        settings.hides_ground = !settings.hides_ground;
    }
}

fn tools(ui: &mut Ui, session: &mut Session) {
    let tip = tr!("scene-show-the-camera-and-its-frustum");
    if toggle(ui, "observer", icons::VIDEO_CAMERA, tip, session.observer.open) {
        session.observer.toggle();
    }
    let probes = session.tab == Tab::Probe;
    if toggle(ui, "probe-tool", icons::EYEDROPPER, tr!("scene-probe-the-pixel-under-the-pointer"), probes) {
        session.tab = if probes { Tab::Lights } else { Tab::Probe };
    }
}

/// An icon that is on or off. Returns whether it was pressed.
fn toggle(ui: &mut Ui, id: &str, icon: &str, tip: &str, on: bool) -> bool {
    let color = if on { colors::ACCENT.of(ui) } else { ui.visuals().text_color() };
    let text = RichText::new(icon).font(theme::icon_font(16.0)).color(color);
    let button = egui::Button::new(text).selected(on).frame_when_inactive(on);
    let response = ui
        .scope(|ui| {
            let least = theme::touch::least(ui);
            if least > 0.0 {
                ui.spacing_mut().button_padding.x = 2.0;
            }
            ui.add(button.min_size(Vec2::splat(least)))
        })
        .inner;
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, tip));
    exported::note(ui, &response, id, WidgetRole::Toggle, tip, on);
    response.on_hover_text(tip).clicked()
}

/// The legend of a debug view.
fn legend(ui: &Ui, painter: &Painter, place: egui::Pos2, pane: &Pane, frame: &gonio_scene::Frame) {
    if pane.special.is_some() {
        return;
    }
    let Some(view) = pane.view else { return };
    let DisplayMap::Affine { scale, bias } = DisplayMap::for_view(Some(view), frame) else { return };
    // The values that are shown as 0 and as 1.
    let (low, high) = (-bias / scale, (DVec3::ONE - bias) / scale);
    let names: &[(&str, Color32)] = match view.quantity.encoding() {
        Encoding::Direction | Encoding::Position => &[("x", Color32::RED), ("y", Color32::GREEN), ("z", Color32::BLUE)],
        _ if view.quantity == Quantity::Uv => &[("u", Color32::RED), ("v", Color32::GREEN)],
        _ => &[("", Color32::WHITE)],
    };
    const WIDTH: f32 = 96.0;
    const ROW: f32 = 16.0;
    let size = vec2(WIDTH + 116.0, ROW * names.len() as f32 + 8.0);
    let plate = Rect::from_min_size(place, size);
    painter.rect_filled(plate, 7.0, ui.visuals().window_fill.gamma_multiply(0.9));
    let font = FontId::monospace(11.0);
    let ink = ui.visuals().text_color();
    for (row, (name, color)) in names.iter().enumerate() {
        let y = place.y + 4.0 + ROW * (row as f32 + 0.5);
        let bar = Rect::from_center_size(pos2(place.x + 68.0 + 0.5 * WIDTH, y), vec2(WIDTH, 9.0));
        gradient(painter, bar, *color);
        painter.text(pos2(place.x + 8.0, y), Align2::LEFT_CENTER, name, font.clone(), ink);
        let (from, to) = (number(low[row]), number(high[row]));
        painter.text(bar.left_center() - vec2(5.0, 0.0), Align2::RIGHT_CENTER, from, font.clone(), ink);
        painter.text(bar.right_center() + vec2(5.0, 0.0), Align2::LEFT_CENTER, to, font.clone(), ink);
    }
}

/// A gradient from black to a colour, unencoded as in the view.
fn gradient(painter: &Painter, rect: Rect, color: Color32) {
    let mut mesh = egui::Mesh::default();
    for (corner, tint) in [
        (rect.left_top(), Color32::BLACK),
        (rect.right_top(), color),
        (rect.right_bottom(), color),
        (rect.left_bottom(), Color32::BLACK),
    ] {
        mesh.colored_vertex(corner, tint);
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    painter.add(mesh);
}

/// Formats a value with two decimals, or an exponent if it is large.
fn number(v: f64) -> String {
    let rounded = (v * 100.0).round() / 100.0 + 0.0;
    if rounded.abs() < 1000.0 { format!("{rounded}") } else { format!("{v:.1e}") }
}
