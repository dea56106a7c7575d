//! The user's own shaders: their files, texts and errors, and a widget for each uniform.

use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::files::short;
use crate::session::{OwnShaders, Session};
use crate::step::code::{self, Code, Mark, MarkKind};
use crate::theme::{colors, icons};
use crate::widgets::{NumberField, color, compact, heading, icon_button, row, slug, toggle, tool_button};
use egui::{Align, Id, Label, Layout, RichText, Sense, Ui};
use gonio_check::user_shaders::{UniformSource, UserUniform};
use gonio_check::verdict::CompilerMessage;
use gonio_language::tr;
use gonio_light::color::{srgb_decode, srgb_encode};
use gonio_scene::color_value::Color;
use gonio_scene::{Frame, Scene};

pub fn show(ui: &mut Ui, session: &mut Session, pane: usize, actions: &mut Vec<Action>) {
    let scene = session.loaded.clone();
    let seen = scene.as_deref().map(|scene| (scene, scene.frame(session.clock.time)));
    let Some(shaders) = &mut session.shaders else { return };
    heading(ui, tr!("scene-your-shaders"));
    buttons(ui, shaders, pane, actions);
    files(ui, shaders);
    heading(ui, tr!("scene-uniforms-2"));
    let Some(program) = shaders.program_mut() else {
        ui.label(tr!("scene-none-no-program-has-been-compiled"));
        return;
    };
    let mut changed = false;
    let inputs = &mut program.inputs;
    let count = inputs.uniforms().len();
    for uniform in inputs.uniforms_mut() {
        changed |= uniform_row(ui, uniform, seen.as_ref());
    }
    let samplers: Vec<_> = inputs.sampler_origins().collect();
    for (name, origin) in &samplers {
        row(ui, name, name, |ui| ui.add(Label::new(RichText::new(*origin).weak()).truncate()));
    }
    if count + samplers.len() == 0 {
        ui.label(tr!("scene-the-program-has-none"));
    }
    if changed {
        shaders.touch();
    }
}

/// Buttons for the texts, for the values at a pixel, and to close the shaders.
fn buttons(ui: &mut Ui, shaders: &mut OwnShaders, pane: usize, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let on = |ui: &Ui, is_on: bool| is_on.then(|| colors::ACCENT.of(ui));
        let (texts, pinned) = (shaders.shows_texts, shaders.stepper.is_pinned());
        if tool_button(ui, "shader-texts", icons::EYE, tr!("scene-show-the-texts"), on(ui, texts), true).clicked() {
            shaders.shows_texts = !texts;
        }
        let tip = tr!("scene-show-each-line-s-values-at");
        if tool_button(ui, "step-pin", icons::CROSSHAIR, tip, on(ui, pinned), true).clicked() {
            match pinned {
                true => shaders.stepper.unpin(),
                false => shaders.stepper.pin_middle(),
            }
            shaders.pane = pane;
        }
        if icon_button(ui, "close-shaders", icons::X, tr!("scene-close-your-shaders-gonio-s-own")).clicked() {
            actions.push(Action::CloseShaders);
        }
    });
    if !shaders.stepper.is_pinned() {
        ui.add(Label::new(RichText::new(tr!("scene-a-click-on-the-picture-shows")).weak()).wrap());
    }
}

/// The texts, with the values at the pinned pixel.
pub fn texts(ui: &mut Ui, shaders: &mut OwnShaders) {
    if let Some(stepped) = shaders.stepper.follow_file(&shaders.shown) {
        shaders.shown = stepped;
    }
    let all = shaders.texts();
    let own = shaders.files().fragment.as_ref().or(shaders.files().vertex.as_ref());
    if !all.iter().any(|file| file.name == shaders.shown) {
        shaders.shown = own.cloned().unwrap_or_default();
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (index, file) in all.iter().enumerate() {
            let chosen = file.name == shaders.shown;
            let name = short(std::slice::from_ref(&file.name));
            let mut label = RichText::new(&name);
            if !marks(shaders, &file.name).is_empty() {
                label = label.color(marks_color(shaders).of(ui));
            } else if chosen {
                label = label.color(ui.visuals().strong_text_color());
            }
            let button = ui.add(egui::Button::new(label).selected(chosen).frame_when_inactive(chosen));
            exported::note(ui, &button, &format!("file-{index}"), WidgetRole::Tab, &name, chosen);
            if button.on_hover_text(&file.name).clicked() {
                shaders.shown.clone_from(&file.name);
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if icon_button(ui, "close-texts", icons::X, tr!("scene-close-the-texts")).clicked() {
                shaders.shows_texts = false;
                shaders.stepper.unpin();
            }
        });
    });
    let Some(file) = all.iter().find(|file| file.name == shaders.shown) else { return };
    let marks = marks(shaders, &file.name);
    let text = String::from_utf8_lossy(&file.bytes);
    let id = Id::unique("shader text").with(&file.name);
    let of = Code { id, name: &file.name, marks: &marks, jump: shaders.jump.take(), is_fixed: false };
    let without_place = shaders.remarks().iter().find(|remark| shaders.has_failed() && remark.message.is_none());
    let error = without_place.map(|remark| remark.text.clone());
    // The files are edited elsewhere; here the text can be selected.
    shaders.jump = code::show(ui, &of, &mut &*text, error.as_deref(), &mut shaders.stepper);
}

/// The marked lines of a file.
fn marks(shaders: &OwnShaders, file: &str) -> Vec<Mark> {
    let kind = if shaders.has_failed() { MarkKind::Error } else { MarkKind::Warning };
    let messages = shaders.remarks().iter().filter_map(|remark| remark.message.as_ref());
    let of_file = messages.filter(|message| message.file == file);
    let mark = |message: &CompilerMessage| {
        let help = message.explanation.as_ref().map_or(String::new(), |help| format!("\n{help}"));
        Mark { line: message.line.unwrap_or(1), kind, text: format!("{}{help}", message.text) }
    };
    let mut marks: Vec<Mark> = of_file.map(mark).collect();
    marks.sort_by_key(|mark| mark.line);
    marks
}

fn marks_color(shaders: &OwnShaders) -> colors::Tint {
    if shaders.has_failed() { colors::ERROR } else { colors::WARNING }
}

/// The files, and whether the picture is theirs.
fn files(ui: &mut Ui, shaders: &mut OwnShaders) {
    let files = shaders.files();
    for (stage, file) in [(tr!("scene-vertex"), &files.vertex), (tr!("scene-fragment"), &files.fragment)] {
        row(ui, stage, tr!("scene-the-window-reads-the-file-again"), |ui| {
            let name = file.as_deref().unwrap_or(tr!("scene-gonio-s-own"));
            ui.add(Label::new(name).truncate()).on_hover_text(name);
        });
    }
    let (text, color) = match (shaders.has_failed(), shaders.program()) {
        (false, Some(_)) => (tr!("scene-compiled"), None),
        (false, None) => (tr!("scene-compiling"), None),
        (true, Some(_)) => (tr!("scene-these-texts-do-not-compile-the"), Some(colors::ERROR)),
        (true, None) => (tr!("scene-these-texts-do-not-compile-gonio"), Some(colors::ERROR)),
    };
    let text = match color {
        Some(color) => RichText::new(text).color(color.of(ui)),
        None => RichText::new(text),
    };
    let label = ui.label(text);
    exported::note(
        ui,
        &label,
        "shaders-state",
        WidgetRole::Text,
        tr!("scene-state-of-your-shaders"),
        label_of(shaders),
    );
    let mut requested = None;
    for (index, remark) in shaders.remarks().iter().enumerate() {
        let text = Label::new(RichText::new(&remark.text).monospace().small()).wrap().sense(Sense::click());
        let label = ui.add(text);
        exported::note(ui, &label, &format!("remark-{index}"), WidgetRole::Text, &remark.text, "");
        if let Some(message) = &remark.message
            && label.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text(tr!("scene-show-the-line")).clicked()
        {
            requested = Some((message.file.clone(), message.line));
        }
    }
    if let Some((file, line)) = requested {
        (shaders.shown, shaders.jump, shaders.shows_texts) = (file, line, true);
    }
}

fn label_of(shaders: &OwnShaders) -> &'static str {
    match (shaders.has_failed(), shaders.program().is_some()) {
        (false, true) => "compiled",
        (false, false) => "compiling",
        (true, true) => "kept",
        (true, false) => "failed",
    }
}

/// A uniform's name, its widget, and where its value comes from. Returns whether its value was changed.
fn uniform_row(ui: &mut Ui, uniform: &mut UserUniform, seen: Option<&(&Scene, Frame)>) -> bool {
    let current = seen.map_or_else(|| uniform.values.clone(), |(scene, frame)| uniform.values_in(scene, frame));
    let tip = format!(
        "{} {}: {}\n{}",
        uniform.glsl_type,
        uniform.name,
        uniform.origin(),
        current.iter().take(16).map(|value| compact(f64::from(*value))).collect::<Vec<_>>().join(", ")
    );
    let name = uniform.name.clone();
    row(ui, &name, &tip, |ui| {
        let from_scene = matches!(uniform.source, UniformSource::Scene(_));
        let is_editable = !uniform.glsl_type.starts_with("mat") && uniform.elements == 1;
        if from_scene || !is_editable {
            let take = from_scene && is_editable;
            let origin = RichText::new(uniform.origin()).weak();
            ui.add(Label::new(origin).truncate());
            if take
                && icon_button(
                    ui,
                    &format!("take-{}", slug(&name)),
                    icons::SLIDERS_HORIZONTAL,
                    tr!("scene-choose-the-value"),
                )
                .clicked()
            {
                return uniform.choose(&current).is_ok();
            }
            return false;
        }
        let mut values = uniform.values.clone();
        let edited = widget(ui, uniform, &mut values);
        let is_chosen = uniform.source == UniformSource::Chosen;
        if is_chosen
            && icon_button(
                ui,
                &format!("reset-{}", slug(&name)),
                icons::ARROW_COUNTER_CLOCKWISE,
                tr!("scene-back-to-gonio-s-value"),
            )
            .clicked()
        {
            uniform.reset();
            return true;
        }
        edited && uniform.choose(&values).is_ok()
    })
}

/// The widget for a value of this type. Returns whether the value was changed.
fn widget(ui: &mut Ui, uniform: &UserUniform, values: &mut [f32]) -> bool {
    let before = values.to_vec();
    let id = format!("uniform-{}", slug(&uniform.name));
    let name = uniform.name.as_str();
    let scalar = uniform.glsl_type.as_str();
    if uniform.is_color()
        && let [r, g, b, ..] = values
    {
        // The numbers of a colour are those that are shown; the widget holds linear light.
        let mut linear = Color([*r, *g, *b].map(|v| srgb_decode(f64::from(v))));
        if color(ui, &id, name, &mut linear, None, tr!("scene-as-it-is-shown-not-decoded")) {
            [*r, *g, *b] = linear.0.map(|v| srgb_encode(v) as f32);
        }
    } else if scalar.starts_with('b') {
        for (component, value) in values.iter_mut().enumerate() {
            let mut on = *value != 0.0;
            let id = if component == 0 { id.clone() } else { format!("{id}-{component}") };
            if toggle(ui, &id, "", &mut on, name) {
                *value = if on { 1.0 } else { 0.0 };
            }
        }
    } else {
        let is_whole = scalar.starts_with(['i', 'u']);
        let is_single = values.len() == 1;
        ui.spacing_mut().item_spacing.x = 4.0;
        for (component, value) in values.iter_mut().enumerate() {
            let id = if component == 0 { id.clone() } else { format!("{id}-{component}") };
            let mut field = NumberField::new(&id, name);
            if !is_single {
                field = field.width(58.0);
            }
            if is_whole {
                field = field.whole().step(0.05);
            }
            field.show_f32(ui, value);
        }
        if is_single
            && !is_whole
            && let [value] = values
        {
            slider(ui, value);
        }
    }
    *values != before
}

/// A slider beside a number: from 0 to 1, or as far as the number needs.
fn slider(ui: &mut Ui, value: &mut f32) {
    let size = value.abs();
    let most = if size <= 1.0 { 1.0 } else { 10_f32.powf(size.log10().ceil()) };
    let least = if *value < 0.0 { -most } else { 0.0 };
    ui.spacing_mut().slider_width = (ui.available_width() - 34.0).clamp(40.0, 130.0);
    ui.add(egui::Slider::new(value, least..=most).show_value(false));
}
