//! The buttons and keys of the steps, what was found, and the table of variables.

use super::Stepper;
use super::values::{Movement, ShaderSteps, ValueKind, short};
use crate::exported::{self, WidgetRole};
use crate::theme::{self, colors, icons};
use crate::widgets;
use egui::{
    Align, Button, Color32, Grid, Key, Label, Layout, Modifiers, RichText, ScrollArea, Sense, Slider, Spinner, Ui,
    WidgetInfo, vec2,
};
use gonio_exercises::step::ListedStep;
use gonio_glsl::Stage;
use gonio_language::tr;

/// Below this width (points) the table has no column of types.
const NARROW: f32 = 420.0;

/// Below this width (points) the corners have a row of their own.
const NARROW_BAR: f32 = 480.0;
/// Height of a row of the table, points.
const ROW: f32 = 16.0;

/// Keys of movements. Browsers keep F11 for themselves, so each has a second one.
const KEYS: [(Modifiers, Key, Movement); 8] = [
    (Modifiers::SHIFT, Key::F10, Movement::BackOver),
    (Modifiers::SHIFT, Key::F11, Movement::BackInto),
    (Modifiers::NONE, Key::F10, Movement::Over),
    (Modifiers::NONE, Key::F11, Movement::Into),
    (Modifiers::ALT, Key::ArrowDown, Movement::Over),
    (Modifiers::ALT, Key::ArrowUp, Movement::BackOver),
    (Modifiers::ALT, Key::ArrowRight, Movement::Into),
    (Modifiers::ALT, Key::ArrowLeft, Movement::BackInto),
];

/// Keys that move the pinned pixel.
const ARROWS: [(Key, [i32; 2]); 4] =
    [(Key::ArrowLeft, [-1, 0]), (Key::ArrowRight, [1, 0]), (Key::ArrowUp, [0, -1]), (Key::ArrowDown, [0, 1])];

/// Handles the keys of this frame, before the editor takes them. `F9` pins the picture's middle, or removes the pin.
pub fn keys(ui: &Ui, stepper: &mut Stepper) {
    if ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::F9)) {
        match stepper.is_pinned() {
            true => stepper.unpin(),
            false => stepper.pin_middle(),
        }
    }
    if !stepper.is_pinned() {
        return;
    }
    for (key, by) in ARROWS {
        let modifiers = Modifiers { shift: true, ..Modifiers::ALT };
        if ui.input_mut(|i| i.consume_key(modifiers, key)) {
            stepper.move_pin(by);
        }
    }
    // There, they move by words in a text.
    let is_text_key = ui.ctx().os().is_mac() && ui.memory(|memory| memory.focused().is_some());
    for (modifiers, key, movement) in KEYS {
        if modifiers == Modifiers::ALT && is_text_key {
            continue;
        }
        if ui.input_mut(|i| i.consume_key(modifiers, key)) {
            stepper.go(movement);
        }
    }
    if ui.input_mut(|i| i.consume_key(Modifiers::ALT, Key::Enter)) {
        stepper.hover.at_cursor = !stepper.hover.at_cursor;
    }
    if stepper.hover.at_cursor && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
        stepper.hover.at_cursor = false;
    }
}

/// Shows the bar above the editor.
pub fn bar(ui: &mut Ui, stepper: &mut Stepper) {
    if !stepper.is_pinned() {
        return;
    }
    let fill = ui.visuals().faint_bg_color;
    let frame = egui::Frame::NONE.fill(fill).corner_radius(5).inner_margin(egui::Margin::symmetric(6, 4));
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.spacing_mut().item_spacing = vec2(4.0, 3.0);
        // Rows of their own: buttons with icons do not wrap.
        let is_narrow = ui.available_width() < NARROW_BAR;
        ui.horizontal(|ui| {
            head(ui, stepper);
            if !is_narrow {
                corners(ui, stepper);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let tip = tr!("exercise-remove-the-pin-and-the-values");
                if widgets::icon_button(ui, "step-unpin", icons::X, tip).clicked() {
                    stepper.unpin();
                }
                if stepper.is_outdated() {
                    ui.add(Spinner::new().size(14.0));
                }
            });
        });
        if is_narrow && stepper.stage() == Stage::Vertex {
            ui.horizontal(|ui| corners(ui, stepper));
        }
        if stepper.current().is_some() {
            ui.horizontal(|ui| movements(ui, stepper));
        }
        if let Some(message) = stepper.message() {
            let label = ui.add(Label::new(RichText::new(message).color(colors::WARNING.of(ui))).wrap());
            exported::note(ui, &label, "step-message", WidgetRole::Text, message, "");
        }
        if let Some(steps) = stepper.current() {
            let caption = caption(steps);
            let label = ui.add(Label::new(RichText::new(&caption).small().weak()).wrap());
            exported::note(ui, &label, "step-caption", WidgetRole::Text, &caption, steps.at() + 1);
        }
        findings(ui, stepper);
    });
}

/// The pixel and the choice of the shader.
fn head(ui: &mut Ui, stepper: &mut Stepper) {
    ui.label(RichText::new(icons::PUSH_PIN).font(theme::icon_font(15.0)).color(colors::ACCENT.of(ui)));
    let pixel =
        stepper.pixel().map_or(tr!("exercise-pixel-2").to_owned(), |[x, y]| tr!("exercise-pixel", x = x, y = y));
    ui.label(pixel);
    if stepper.listing().is_none() {
        return;
    }
    let mut stage = stepper.stage();
    let options = [
        (Stage::Fragment, "fragment", tr!("exercise-the-fragment-shader-at-this-pixel")),
        (Stage::Vertex, "vertex", tr!("exercise-the-vertex-shader-at-a-corner")),
    ];
    if widgets::choice(ui, "step-stage", tr!("exercise-shader"), &mut stage, &options, Stage::Fragment) {
        (stepper.stage, stepper.shows_file) = (Some(stage), true);
        stepper.hover.forget();
    }
}

/// The choice of the corner.
fn corners(ui: &mut Ui, stepper: &mut Stepper) {
    if stepper.stage() == Stage::Vertex
        && let Some(listed) = stepper.listing()
    {
        let (vertices, shares) = (listed.surface.vertices, listed.surface.shares);
        let mut corner = stepper.corner();
        let nearest = stepper.nearest_corner();
        let tips = [0, 1, 2].map(|at| {
            tr!("exercise-vertex-with-a-weight-of-at", vertex = vertices[at], weight = format!("{:.2}", shares[at]))
        });
        let options = [0, 1, 2].map(|at| {
            (at, [tr!("exercise-corner-1"), tr!("exercise-corner-2"), tr!("exercise-corner-3")][at], tips[at].as_str())
        });
        if widgets::choice(ui, "step-corner", tr!("exercise-corner"), &mut corner, &options, nearest) {
            stepper.corner = Some(corner);
            stepper.hover.forget();
        }
    }
}

fn movements(ui: &mut Ui, stepper: &mut Stepper) {
    let Some(steps) = stepper.current() else { return };
    let (at, count) = (steps.at(), steps.listing.steps.len());
    let (can_return, can_go_on) = (at > 0, at + 1 < count);
    for (id, icon, tip, movement, enabled) in [
        ("step-first", icons::SKIP_BACK, tr!("exercise-first-step"), Movement::First, can_return),
        (
            "step-back-over",
            icons::CARET_LEFT,
            tr!("exercise-back-over-calls-shift-f10-alt"),
            Movement::BackOver,
            can_return,
        ),
        ("step-over", icons::CARET_RIGHT, tr!("exercise-next-step-over-calls-f10-alt"), Movement::Over, can_go_on),
        (
            "step-back-into",
            icons::CARET_UP,
            tr!("exercise-back-into-calls-shift-f11-alt"),
            Movement::BackInto,
            can_return,
        ),
        ("step-into", icons::CARET_DOWN, tr!("exercise-next-step-into-calls-f11-alt"), Movement::Into, can_go_on),
    ] {
        if widgets::tool_button(ui, id, icon, tip, None, enabled).clicked() {
            stepper.go(movement);
        }
    }
    if count > 1 {
        let mut number = at + 1;
        ui.spacing_mut().slider_width = (ui.available_width() - 56.0).clamp(40.0, 240.0);
        let slider = ui.add(Slider::new(&mut number, 1..=count).show_value(false));
        slider.widget_info(|| WidgetInfo::slider(true, number as f64, tr!("exercise-step")));
        exported::note(ui, &slider, "step-slider", WidgetRole::Number, tr!("exercise-step"), number);
        if slider.changed() {
            stepper.go(Movement::To(number - 1));
        }
    }
    let tip = tr!("exercise-value-and-picture-of-the-expression");
    let color = stepper.hover.at_cursor.then(|| colors::ACCENT.of(ui));
    if widgets::tool_button(ui, "step-expression", icons::EYE, tip, color, true).clicked() {
        stepper.hover.at_cursor = !stepper.hover.at_cursor;
    }
}

/// The number, line, function and iteration of the current step.
fn caption(steps: &ShaderSteps) -> String {
    let count = steps.listing.steps.len();
    let Some(ListedStep { line, function, calls, iterations, .. }) = steps.step() else {
        return tr!("exercise-no-statement-was-executed").to_owned();
    };
    let mut text =
        tr!("exercise-step-of-line-in", at = steps.at() + 1, count = count, line = line, function = function);
    if !calls.is_empty() {
        text.push_str(&tr!("exercise-called-at-line", and = numbers(calls, tr!("exercise-and-2"))));
    }
    if !iterations.is_empty() {
        text.push_str(&tr!("exercise-iteration", it = numbers(iterations, tr!("exercise-within-it"))));
    }
    if steps.listing.is_truncated {
        text.push_str(tr!("exercise-later-steps-are-not-shown"));
    }
    text
}

fn numbers(numbers: &[u32], between: &str) -> String {
    numbers.iter().map(u32::to_string).collect::<Vec<_>>().join(between)
}

/// What is odd about the run; a click goes to its line.
fn findings(ui: &mut Ui, stepper: &mut Stepper) {
    let Some(steps) = stepper.current() else { return };
    let listing = &steps.listing;
    let mut found: Vec<(&str, Color32, u32, String)> = Vec::new();
    if let Some((place, value)) = &listing.non_finite {
        let text = tr!(
            "exercise-first-nan-or-infinity-line",
            line = place.line,
            expression = place.expression,
            value = short(value)
        );
        found.push(("step-nan", colors::ERROR.of(ui), place.line, text));
    }
    for place in &listing.unwritten {
        let text = tr!("exercise-never-written-before-it-is-read", line = place.line, expression = place.expression);
        found.push(("step-unwritten", colors::WARNING.of(ui), place.line, text));
    }
    if let Some((line, statements)) = listing.endless {
        let text = tr!("exercise-the-loop-at-line-does-not", line = line, statements = statements);
        found.push(("step-endless", colors::ERROR.of(ui), line, text));
    }
    if let Some(line) = listing.discarded {
        found.push((
            "step-discarded",
            colors::WARNING.of(ui),
            line,
            tr!("exercise-line-discards-this-pixel", line = line),
        ));
    }
    let mut requested = None;
    for (id, color, line, text) in found.into_iter().take(4) {
        let text_of = RichText::new(&text).small().color(color);
        let button = ui.add(Button::new(text_of).wrap().frame_when_inactive(false));
        exported::note(ui, &button, id, WidgetRole::Button, &text, line);
        if button.on_hover_text(tr!("exercise-go-to-this-step")).clicked() {
            requested = Some(line);
        }
    }
    if let Some(line) = requested {
        stepper.go_to_line(line);
    }
}

/// Height of the table below the editor, of this much room.
pub fn table_height(stepper: &Stepper, room: f32) -> f32 {
    let rows = stepper.current().map_or(0, |steps| steps.variables().len());
    if rows == 0 { 0.0 } else { (12.0 + (ROW + 3.0) * rows as f32).min(0.3 * room) }
}

/// Shows the variables at the current step.
pub fn table(ui: &mut Ui, stepper: &Stepper) {
    let Some(steps) = stepper.current() else { return };
    let is_narrow = ui.available_width() < NARROW;
    let has_moved = stepper.scroll.is_some();
    ui.spacing_mut().interact_size.y = ROW;
    ScrollArea::both().id_salt("variables of the step").auto_shrink([false, false]).show(ui, |ui| {
        Grid::new("variables").num_columns(3).spacing([12.0, 3.0]).striped(true).show(ui, |ui| {
            for row in steps.variables() {
                let owner = row.function.as_ref().map_or(String::new(), |function| format!("{function}: "));
                let name = format!("{owner}{}", row.name);
                let (mark, color) = match row.is_changed {
                    true => ("\u{2022} ", colors::ACCENT.of(ui)),
                    false => ("  ", ui.visuals().text_color()),
                };
                ui.label(RichText::new(format!("{mark}{name}")).monospace().color(color));
                let color = match ValueKind::of(&row.value) {
                    ValueKind::Normal => color,
                    ValueKind::Unwritten => colors::WARNING.of(ui),
                    ValueKind::NonFinite => colors::ERROR.of(ui),
                };
                let value = Label::new(RichText::new(short(&row.value)).monospace().color(color)).extend();
                let value = ui.add(value.sense(Sense::hover()));
                if has_moved && row.is_changed {
                    value.scroll_to_me(None);
                }
                exported::note(ui, &value, &format!("variable-{name}"), WidgetRole::Text, &name, &row.value);
                let before = row
                    .before
                    .as_ref()
                    .map_or(String::new(), |before| "\n".to_owned() + &tr!("exercise-before", value = before));
                value.on_hover_text(format!("{} {}\n{}{before}", row.glsl_type, row.name, row.value));
                if !is_narrow {
                    ui.label(RichText::new(&row.glsl_type).small().weak());
                }
                ui.end_row();
            }
        });
    });
}
