//! The list of lights: each is a summand of the equation.

mod details;
mod edits;

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::{Selection, Session};
use crate::theme::{self, colors, icons};
use crate::widgets::{NumberField, color_swatch, icon_button, tool_button};
use egui::{Align, Atom, Button, Layout, RichText, Ui, WidgetInfo, vec2};
use gonio_language::tr;
use gonio_scene::defaults;
use gonio_scene::scene_file::LightSourceKind;

/// The icon of a kind of light.
pub fn icon_of(kind: LightSourceKind) -> &'static str {
    match kind {
        LightSourceKind::Ambient => icons::GLOBE_HEMISPHERE_WEST,
        LightSourceKind::Directional => icons::SUN,
        LightSourceKind::Point => icons::LIGHTBULB,
        LightSourceKind::Spot => icons::FLASHLIGHT,
        LightSourceKind::Rectangle => icons::FRAME_CORNERS,
    }
}

/// The name of a light, or its kind and number.
pub fn name_of(document: &Document, index: usize) -> String {
    match document.scene.lights.get(index) {
        Some(light) if !light.name.is_empty() => light.name.clone(),
        Some(light) => format!("{} {index}", light.kind),
        None => String::new(),
    }
}

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    if session.loaded.is_none() {
        return;
    }
    let mut requested = None;
    for index in 0..document.scene.lights.len() {
        ui.push_id(index, |ui| {
            row(ui, document, session, index);
            if session.selection == Selection::Light(index) {
                let asked = details::show(ui, document, session, index);
                requested = requested.take().or(asked);
            }
        });
    }
    if let Some(edit) = requested {
        edits::apply(document, session, edit);
    }
    if document.scene.lights.is_empty() {
        ui.label(RichText::new(tr!("scene-no-lights-only-a-e-and")).weak());
    }
    add(ui, document, session);
    let _ = actions;
}

fn row(ui: &mut Ui, document: &mut Document, session: &mut Session, index: usize) {
    let name = name_of(document, index);
    let only = edits::is_alone(document, index);
    let selected = session.selection == Selection::Light(index);
    let Some(light) = document.scene.lights.get_mut(index) else { return };
    let (kind, on) = (light.kind, light.enabled);
    let mut make_alone = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        let (icon, tip) = if on {
            (icons::EYE, tr!("scene-on-click-to-switch-it-off"))
        } else {
            (icons::EYE_SLASH, tr!("scene-off-click-to-switch-it-on"))
        };
        let eye = tool_button(ui, &format!("light-{index}-on"), icon, &format!("{name}: {tip}"), None, true);
        if eye.clicked() {
            light.enabled = !on;
        }
        let tint = only.then(|| colors::ACCENT.of(ui));
        let tip = if only { tr!("scene-show-all-lights-again") } else { tr!("scene-show-this-light-alone") };
        let alone =
            tool_button(ui, &format!("light-{index}-alone"), icons::TARGET, &format!("{name}: {tip}"), tint, true);
        make_alone = alone.clicked();
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let caret = if selected { icons::CARET_UP } else { icons::CARET_DOWN };
            if icon_button(ui, &format!("light-{index}-open"), caret, &tr!("scene-parameters-of", name = name))
                .clicked()
            {
                session.selection = if selected { Selection::None } else { Selection::Light(index) };
            }
            let id = format!("light-{index}-intensity");
            let number = NumberField::new(&id, "intensity")
                .tip(tr!("scene-intensity-l-i-is-the-colour"))
                .range(0.0..=1e6)
                .default(defaults::LIGHT_INTENSITY)
                .width(58.0);
            number.show(ui, &mut light.intensity);
            let id = format!("light-{index}-swatch");
            let default = Some(defaults::LIGHT_COLOR);
            color_swatch(
                ui,
                &id,
                tr!("scene-colour-of-the-light"),
                &mut light.color,
                default,
                tr!("scene-colour-of-l-i"),
            );
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if title(ui, index, kind, &name, on, selected) {
                    session.selection = if selected { Selection::None } else { Selection::Light(index) };
                }
            });
        });
    });
    if make_alone {
        edits::alone(document, index);
    }
}

/// Icon and name, as a button over the available width. Returns whether it was clicked.
fn title(ui: &mut Ui, index: usize, kind: LightSourceKind, name: &str, on: bool, selected: bool) -> bool {
    let visuals = ui.visuals();
    let color = match (on, selected) {
        (false, _) => visuals.weak_text_color(),
        (true, true) => visuals.strong_text_color(),
        (true, false) => visuals.text_color(),
    };
    let lamp = if on { colors::LIGHT.of(ui) } else { color };
    let icon = RichText::new(icon_of(kind)).font(theme::icon_font(15.0)).color(lamp);
    let text = RichText::new(name).color(color);
    let size = vec2(ui.available_width(), theme::touch::least(ui).max(24.0));
    let response = ui
        .scope(|ui| {
            ui.spacing_mut().button_padding.x = 3.0;
            let button = Button::new((icon, text, Atom::grow())).frame_when_inactive(selected).truncate();
            ui.add_sized(size, button.min_size(size))
        })
        .inner;
    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, selected, name));
    exported::note(
        ui,
        &response,
        &format!("light-{index}"),
        WidgetRole::Button,
        name,
        if on { tr!("scene-on") } else { tr!("scene-off") },
    );
    let clicked = response.clicked();
    response.on_hover_text(format!("{name}: {}", gonio_language::name(kind.description().trim())));
    clicked
}

/// A button for each kind of light.
fn add(ui: &mut Ui, document: &mut Document, session: &mut Session) {
    ui.add_space(6.0);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        ui.label(RichText::new(tr!("scene-add")).weak());
        for kind in LightSourceKind::ALL.iter().rev() {
            let icon = RichText::new(icon_of(*kind)).font(theme::icon_font(14.0));
            let button = ui.button((icon, RichText::new(gonio_language::name(kind.name()))));
            let label = tr!("scene-add-light", kind = gonio_language::name(kind.name()));
            button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &label));
            exported::note(ui, &button, &format!("add-light-{kind}"), WidgetRole::Button, &label, "");
            if button.clicked() {
                edits::add(document, session, *kind);
            }
            button.on_hover_text(gonio_language::name(kind.description().trim()));
        }
    });
}
