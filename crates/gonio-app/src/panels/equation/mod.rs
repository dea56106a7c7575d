//! The light equation, typeset; its terms are switches.
//!
//! | on a term | effect |
//! |---|---|
//! | click | switches it on or off |
//! | double click, Shift + click, Alt + click | shows it alone, or restores the switches |
//!
//! The line below holds the parameters of the term that was clicked last; the arrow opens all definitions.

mod formula;
mod parameters;
mod switch;

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::{Session, Tab, Term};
use crate::theme::{self, icons};
use crate::typeset::{self, EguiFonts, Laid, Node, Tag};
use crate::widgets::{self, compact, icon_button};
use egui::{Color32, CursorIcon, Id, Rect, RichText, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use gonio_language::tr;
use gonio_light::Specular;
use gonio_scene::SceneSettings;
use gonio_scene::scene_file::LightSourceKind;

/// Sizes of the formula that are tried until it fits on a line, points per em.
const SIZES: [f32; 4] = [23.0, 21.0, 19.0, 17.0];
/// Size of the formula if it is broken into lines.
const BROKEN_SIZE: f32 = 18.0;
/// Height of a term's clickable area above and below its baseline, points.
const ABOVE: f32 = 21.0;
const BELOW: f32 = 12.0;
/// Room for the buttons at the right.
const BUTTONS: f32 = 56.0;
/// Room for the buttons that show a term alone. Below this width of the panel, they and the other buttons have a line of their
/// own under the formula.
const SOLO: f32 = 236.0;
const WIDE: f32 = 940.0;
/// The same in a window of little height.
const LOW_AND_WIDE: f32 = 640.0;
/// Below this width the parameters are hidden until the definitions are opened.
const NARROW: f32 = 780.0;

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    if session.loaded.is_none() {
        // The same height as later, so that nothing moves when the first scene is loaded.
        ui.allocate_exact_size(vec2(ui.available_width(), 92.0), Sense::hover());
        return;
    }
    // A phone held sideways has width to spare, and no height.
    let low = theme::touch::is_low(ui.ctx());
    let narrow = low || ui.available_width() < NARROW;
    let wide = ui.available_width() >= if low { LOW_AND_WIDE } else { WIDE };
    let buttons_width = BUTTONS + 2.0 * (theme::touch::least(ui) - widgets::SIDE).max(0.0);
    let shown = effective(document);
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let room = ui.available_width() - if wide { buttons_width + SOLO } else { 0.0 };
        let lines = fitted(ui, &formula::equation(&shown), room);
        let clicked = lines_of_terms(ui, &lines, room, document, session);
        if let Some((term, alone)) = clicked {
            act(document, session, actions, term, alone);
        }
        if wide {
            ui.add_space(4.0);
            solo(ui, SOLO, document, session, actions);
            buttons(ui, document, session);
        }
    });
    if !wide {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            solo(ui, ui.available_width() - buttons_width, document, session, actions);
            buttons(ui, document, session);
        });
    }
    if !narrow || session.equation.open {
        ui.add_space(2.0);
        parameters::show(ui, document, session, &shown, actions);
    }
    if session.equation.open {
        definitions(ui, document, session, &shown);
    }
}

/// The scene with the settings of the current pane.
fn effective(document: &Document) -> SceneSettings {
    let pane = document.panes.current();
    pane.map_or_else(|| document.scene.clone(), |pane| pane.applied_to(&document.scene))
}

/// The lines of a formula at the largest size that fits.
fn fitted(ui: &Ui, parts: &[Node], width: f32) -> Vec<Laid> {
    let mut fonts = EguiFonts(ui.painter());
    for size in SIZES {
        let lines = typeset::broken(parts, size, width, &mut fonts);
        if lines.len() <= 1 {
            return lines;
        }
    }
    typeset::broken(parts, BROKEN_SIZE, width, &mut fonts)
}

/// Shows the lines with clickable terms. Returns the clicked term, and whether to show it alone.
fn lines_of_terms(
    ui: &mut Ui,
    lines: &[Laid],
    width: f32,
    document: &Document,
    session: &Session,
) -> Option<(Term, bool)> {
    const LINE_GAP: f32 = 3.0;
    let height: f32 = lines.iter().map(|line| line.size().y + LINE_GAP).sum();
    let (room, _) = ui.allocate_exact_size(vec2(width, height + 2.0), Sense::hover());
    let mut clicked = None;
    let mut top = room.top() + 1.0;
    for (number, line) in lines.iter().enumerate() {
        let start = pos2(room.left() + 2.0, top + line.ascent);
        let (above, below) = (line.ascent.min(ABOVE), line.descent.min(BELOW));
        let backgrounds = ui.painter().add(egui::Shape::Noop);
        let colors = |tag: Option<Tag>| color_of(ui, document, tag.and_then(formula::term));
        let tagged = typeset::paint(ui.painter(), line, start, &colors);
        let mut behind = Vec::new();
        for (tag, rect) in tagged {
            let Some(term) = formula::term(tag) else { continue };
            // All areas have the same height, so that they are easy to hit and nothing moves with the pointer.
            let area = Rect::from_x_y_ranges(rect.x_range(), start.y - above..=start.y + below).expand2(vec2(2.0, 0.0));
            let asked = one_term(ui, term, area, number, document, session, &mut behind);
            clicked = clicked.or(asked);
        }
        ui.painter().set(backgrounds, egui::Shape::Vec(behind));
        top += line.size().y + LINE_GAP;
    }
    clicked
}

fn one_term(
    ui: &Ui,
    term: Term,
    area: Rect,
    line: usize,
    document: &Document,
    session: &Session,
    behind: &mut Vec<egui::Shape>,
) -> Option<(Term, bool)> {
    let id = Id::unique(("term", term.name(), line));
    let response = ui.interact(area, id, Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
    let on = switch::is_on(document, term);
    let name = tr!("scene-term", term = term);
    response.widget_info(|| match on {
        Some(on) => WidgetInfo::selected(egui::Role::Switch, true, on, &name),
        None => WidgetInfo::labeled(egui::Role::Button, true, &name),
    });
    let state = match on {
        None => "shown",
        Some(true) => "on",
        Some(false) => "off",
    };
    exported::note(ui, &response, &format!("term-{term}"), WidgetRole::Term, &name, state);
    let base = switch::tint(term).map_or_else(|| ui.visuals().strong_text_color(), |tint| tint.of(ui));
    let radius = 4.0;
    if response.hovered() || response.has_focus() {
        behind.push(egui::Shape::rect_filled(area, radius, base.gamma_multiply(0.14)));
    }
    if session.equation.selected == term {
        let y = area.bottom() + 0.5;
        let line = [pos2(area.left() + 3.0, y), pos2(area.right() - 3.0, y)];
        behind.push(egui::Shape::line_segment(line, Stroke::new(1.5, base.gamma_multiply(0.7))));
    }
    let alone = response.double_clicked() || ui.input(|i| i.modifiers.shift || i.modifiers.alt);
    let clicked = response.clicked();
    response.on_hover_ui(|ui| explain(ui, document, session, &effective(document), term));
    clicked.then_some((term, alone))
}

/// The colour of a term, grey where it is off.
fn color_of(ui: &Ui, document: &Document, term: Option<Term>) -> Color32 {
    let plain = ui.visuals().text_color();
    let Some(term) = term else { return plain };
    let color = switch::tint(term).map_or(ui.visuals().strong_text_color(), |tint| tint.of(ui));
    if switch::is_on(document, term) == Some(false) { ui.visuals().weak_text_color() } else { color }
}

fn act(document: &mut Document, session: &mut Session, actions: &mut Vec<Action>, term: Term, alone: bool) {
    session.equation.selected = term;
    if alone {
        switch::alone(document, &mut session.equation, term);
    } else if term == Term::Ambient && document.scene.equation.brdf.is_some() {
        session.announcement = tr!("scene-a-brdf-has-no-ambient-term").into();
        return;
    } else {
        switch::toggle(document, term);
    }
    if term == Term::Light {
        actions.push(Action::Show(Tab::Lights));
    }
    session.announcement = match (switch::is_on(document, term), alone) {
        (Some(true), true) => tr!("scene-alone-or-all-terms-again", term = term),
        (Some(true), false) => tr!("scene-is-on", term = term),
        (Some(false), _) => tr!("scene-is-off", term = term),
        (None, _) => format!("{term}"),
    };
}

/// Buttons that show a term alone, at the right of a part with this width.
fn solo(ui: &mut Ui, width: f32, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    let least = theme::touch::least(ui);
    let size = vec2(width, ui.spacing().interact_size.y);
    let mut asked = None;
    ui.allocate_ui_with_layout(size, egui::Layout::right_to_left(egui::Align::Center), |ui| {
        ui.set_min_size(size);
        ui.spacing_mut().button_padding = vec2(5.0, 1.0);
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.add_space(8.0);
        for term in switch::SUMMANDS.into_iter().rev() {
            let word = match term {
                Term::Ambient => "A",
                Term::Emitted => "E",
                Term::Environment => "env",
                Term::Diffuse => "diff",
                _ => "spec",
            };
            if switch::is_on(document, term).is_none() {
                continue;
            }
            let is_alone = switch::is_alone(document, term);
            let color = match switch::tint(term) {
                // The selection's colour leaves too little contrast for a tint.
                Some(tint) if !is_alone => tint.of(ui),
                _ => ui.visuals().strong_text_color(),
            };
            let button = egui::Button::new(RichText::new(word).small().color(color))
                .selected(is_alone)
                .min_size(vec2(least, least));
            let response = ui.add(button);
            let name = tr!("scene-alone-2", term = term);
            response.widget_info(|| WidgetInfo::selected(egui::Role::Switch, true, is_alone, &name));
            exported::note(ui, &response, &format!("solo-{term}"), WidgetRole::Toggle, &name, is_alone);
            let tip =
                if is_alone { tr!("scene-show-all-terms-again") } else { tr!("scene-show-this-term-alone-or-double") };
            if response.on_hover_text(tip).clicked() {
                asked = Some(term);
            }
        }
        ui.label(RichText::new(tr!("scene-alone")).small().weak());
    });
    if let Some(term) = asked {
        act(document, session, actions, term, true);
    }
}

fn buttons(ui: &mut Ui, document: &mut Document, session: &mut Session) {
    let some_off = switch::is_incomplete(document);
    let all = widgets::tool_button(
        ui,
        "terms-all",
        icons::ARROW_COUNTER_CLOCKWISE,
        tr!("scene-all-terms-on"),
        None,
        some_off,
    );
    if all.clicked() {
        switch::all_on(document);
        session.equation.before_alone = None;
        session.announcement = tr!("scene-all-terms-are-on").into();
    }
    let (icon, tip) = if session.equation.open {
        (icons::CARET_UP, tr!("scene-hide-the-definitions"))
    } else {
        (icons::CARET_DOWN, tr!("scene-show-the-definitions"))
    };
    if icon_button(ui, "definitions", icon, tip).clicked() {
        session.equation.open = !session.equation.open;
    }
}

/// All definitions; a click on one selects its term.
fn definitions(ui: &mut Ui, document: &Document, session: &mut Session, scene: &SceneSettings) {
    const SIZE: f32 = 15.0;
    let terms = [
        Term::Ambient,
        Term::Emitted,
        Term::Environment,
        Term::Diffuse,
        Term::Specular,
        Term::Attenuation,
        Term::Spot,
        Term::Cosine,
    ];
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(22.0, 4.0);
        for term in terms {
            if (term == Term::Environment && scene.environment.is_none())
                || (term == Term::Ambient && scene.equation.brdf.is_some())
            {
                continue;
            }
            let node = formula::definition(scene, term);
            let response = formula_line(ui, &node, SIZE, document, Sense::click());
            let name = tr!("scene-definition-of", term = term);
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &name));
            exported::note(ui, &response, &format!("definition-{term}"), WidgetRole::Button, &name, "");
            if response.clicked() {
                session.equation.selected = term;
            }
        }
        for node in formula::vectors(&scene.equation) {
            formula_line(ui, &node, SIZE, document, Sense::hover());
        }
    });
}

/// A formula as a widget.
fn formula_line(ui: &mut Ui, node: &Node, size: f32, document: &Document, sense: Sense) -> egui::Response {
    let laid = typeset::lay(node, size, &mut EguiFonts(ui.painter()));
    // All formulas of a line have the same baseline.
    let (up, down) = (laid.ascent.max(1.05 * size), laid.descent.max(0.65 * size));
    let (rect, response) = ui.allocate_exact_size(vec2(laid.width, up + down), sense);
    let colors = |tag: Option<Tag>| color_of(ui, document, tag.and_then(formula::term));
    typeset::paint(ui.painter(), &laid, pos2(rect.left(), rect.top() + up), &colors);
    response
}

/// The tooltip of a term.
fn explain(ui: &mut Ui, document: &Document, session: &Session, scene: &SceneSettings, term: Term) {
    ui.set_max_width(340.0);
    ui.label(RichText::new(term.description()).strong());
    formula_line(ui, &formula::definition(scene, term), 16.0, document, Sense::hover());
    if let Some(now) = now(scene, session, term) {
        ui.label(now);
    }
    let how = match switch::is_on(document, term) {
        None if term == Term::Light => tr!("scene-click-show-the-lights"),
        None => return,
        Some(on) if switch::SUMMANDS.contains(&term) => {
            if on {
                tr!("scene-click-switch-off-double-click-show")
            } else {
                tr!("scene-click-switch-on-double-click-show")
            }
        }
        Some(true) => tr!("scene-click-switch-off-counts-as-1"),
        Some(false) => tr!("scene-click-switch-on"),
    };
    ui.label(RichText::new(how).small().weak());
}

/// The values of a term in this scene.
fn now(scene: &SceneSettings, session: &Session, term: Term) -> Option<String> {
    let count = |kind: LightSourceKind| scene.lights.iter().filter(|l| l.kind == kind && l.enabled).count();
    let e = &scene.equation;
    Some(match term {
        Term::Ambient => {
            let lights = scene.lights.iter().filter(|l| l.kind == LightSourceKind::Ambient && l.enabled);
            let sum = lights.fold([0.0; 3], |sum, light| {
                let (color, intensity) = (light.color.0, light.intensity);
                [0, 1, 2].map(|i| sum[i] + color[i] * intensity)
            });
            let [r, g, b] = sum.map(compact);
            tr!("scene-the-scene-s-ambient-light-is", r = r, g = g, b = b)
        }
        Term::Emitted => {
            let materials = session.loaded.iter().flat_map(|loaded| &loaded.materials);
            let shining = materials.filter(|m| m.material.emitted.iter().any(|v| *v > 0.0)).count();
            match shining {
                0 => tr!("scene-no-material-of-this-scene-emits").into(),
                1 => tr!("scene-one-material-of-this-scene-emits").into(),
                n => tr!("scene-materials-of-this-scene-emit-light", n = n),
            }
        }
        Term::Environment => {
            let environment = scene.environment.as_ref()?;
            tr!("scene-environment-intensity", image = environment.image, intensity = compact(environment.intensity))
        }
        Term::Diffuse => match e.brdf {
            Some(brdf) => tr!("scene-the-diffuse-part-of-the-brdf", brdf = brdf),
            None => tr!("scene-by-the-convention", convention = e.convention),
        },
        Term::Specular => match (e.brdf, e.specular) {
            (Some(brdf), _) => tr!("scene-the-lobe-of-the-brdf", brdf = brdf),
            (None, Specular::None) => tr!("scene-none-a-click-selects-blinn-phong").into(),
            (None, specular) => {
                format!("{specular}{}", if e.gated { tr!("scene-0-where-the-light-is-behind-2") } else { "" })
            }
        },
        Term::Light => {
            let lit = scene.lights.iter().filter(|l| l.kind != LightSourceKind::Ambient);
            let on = lit.clone().filter(|l| l.enabled).count();
            tr!("scene-of-lights-are-on", on = on, count = lit.count())
        }
        Term::Attenuation => {
            let places: usize = LightSourceKind::ALL.iter().filter(|k| k.has_position()).map(|&k| count(k)).sum();
            match places {
                0 => tr!("scene-this-scene-has-only-directional-lights").into(),
                1 => tr!("scene-applies-to-one-light-directional-lights").into(),
                n => tr!("scene-applies-to-lights-directional-lights-have", n = n),
            }
        }
        // The equation treats a rectangle as a spot.
        Term::Spot => match count(LightSourceKind::Spot) + count(LightSourceKind::Rectangle) {
            0 => tr!("scene-this-scene-has-no-spot-light").into(),
            1 => tr!("scene-applies-to-one-spot-light-other").into(),
            n => tr!("scene-applies-to-spot-lights-other-lights", n = n),
        },
        Term::Cosine => tr!("scene-0-where-the-light-is-behind").into(),
    })
}
