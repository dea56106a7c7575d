//! The toolbar of the exercise view, and its keyboard shortcuts.

use super::command::ExerciseCommand;
use super::editor;
use super::work::{OpenFile, Work};
use crate::exported::{self, WidgetRole};
use crate::theme::{self, colors, icons};
use crate::widgets::language_menu;
use egui::{
    Align, Align2, Button, Frame, Key, KeyboardShortcut, Layout, Margin, Modifiers, Panel, RichText, TextEdit, Ui,
    WidgetInfo, Window, vec2,
};
use gonio_language::tr;

/// Below this width (points) icons replace names.
const NARROW: f32 = 620.0;

/// Keyboard shortcuts. A focused editor handles undo and redo itself.
const KEYS: [(Modifiers, Key, ExerciseCommand); 7] = [
    (Modifiers::COMMAND, Key::Enter, ExerciseCommand::Check),
    (Modifiers::COMMAND, Key::S, ExerciseCommand::Save),
    (Modifiers::COMMAND, Key::O, ExerciseCommand::Open),
    (Modifiers { shift: true, ..Modifiers::COMMAND }, Key::Z, ExerciseCommand::Redo),
    (Modifiers::COMMAND, Key::Y, ExerciseCommand::Redo),
    (Modifiers::COMMAND, Key::Z, ExerciseCommand::Undo),
    (Modifiers::NONE, Key::Escape, ExerciseCommand::StopChecking),
];

/// Handles the keys of this frame.
pub fn keys(ui: &Ui, work: Option<&Work>, commands: &mut Vec<ExerciseCommand>) {
    let Some(work) = work else { return };
    let is_writing = work.files.get(work.current).is_some_and(|file| ui.memory(|m| m.has_focus(file.id())));
    for (modifiers, key, command) in KEYS {
        let is_editors_own = matches!(command, ExerciseCommand::Undo | ExerciseCommand::Redo);
        if is_editors_own && (is_writing || work.asking.is_some()) {
            continue;
        }
        if command == ExerciseCommand::StopChecking && !work.checking {
            continue;
        }
        if ui.input_mut(|i| i.consume_shortcut(&KeyboardShortcut::new(modifiers, key))) {
            commands.push(command);
        }
    }
}

pub fn show(ui: &mut Ui, work: Option<&mut Work>, commands: &mut Vec<ExerciseCommand>) {
    let bar = Frame::NONE.inner_margin(Margin::symmetric(10, 5));
    let work = Panel::top("exercise bar").frame(bar).resizable(false).show(ui, |ui| {
        let narrow = ui.available_width() < NARROW;
        ui.horizontal(|ui| {
            let is_phone = theme::touch::least(ui) > 0.0;
            if is_phone {
                ui.spacing_mut().item_spacing.x = 0.0;
                ui.spacing_mut().button_padding.x = 7.0;
            }
            if icon(ui, "leave", icons::CARET_LEFT, tr!("exercise-back-to-the-scene"), true) {
                commands.push(ExerciseCommand::Leave);
            }
            if !narrow {
                ui.label(
                    RichText::new(tr!("exercise-exercises"))
                        .font(theme::bold(16.0))
                        .color(ui.visuals().strong_text_color()),
                );
                ui.add_space(4.0);
            }
            if let Some(work) = &work {
                let label = if narrow {
                    work.exercise.id.clone()
                } else {
                    format!("{}  {}", work.exercise.id, work.exercise.title())
                };
                if button(ui, "exercises", RichText::new(label), tr!("exercise-select-another-exercise"), true) {
                    commands.push(ExerciseCommand::List);
                }
                check(ui, work, narrow, commands);
                files(ui, work, narrow, commands);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let dark = ui.visuals().dark_mode;
                if icon(
                    ui,
                    "theme",
                    if dark { icons::SUN } else { icons::MOON },
                    tr!("exercise-light-or-dark-theme"),
                    true,
                ) {
                    commands.push(ExerciseCommand::Theme);
                }
                // A phone has no room for it: the bar of the scene has it.
                if !is_phone && let Some(language) = language_menu(ui) {
                    commands.push(ExerciseCommand::SetLanguage(language));
                }
            });
        });
        work
    });
    if let Some(work) = work.inner {
        ask(ui, work, commands);
    }
}

fn check(ui: &mut Ui, work: &Work, narrow: bool, commands: &mut Vec<ExerciseCommand>) {
    if work.checking {
        ui.spinner();
        if button(ui, "stop-checking", RichText::new(tr!("exercise-stop")), tr!("exercise-stop-the-check-esc"), true) {
            commands.push(ExerciseCommand::StopChecking);
        }
        return;
    }
    let text = RichText::new(if narrow { tr!("exercise-check") } else { tr!("exercise-check-ctrl-enter") });
    let fill = colors::ACCENT.of(ui).gamma_multiply(0.35);
    let check = ui.add(Button::new(text.color(ui.visuals().strong_text_color())).fill(fill));
    check.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, tr!("exercise-check")));
    exported::note(ui, &check, "check", WidgetRole::Button, tr!("exercise-check"), "");
    if check.on_hover_text(tr!("exercise-find-mistakes-by-name-and-line")).clicked() {
        commands.push(ExerciseCommand::Check);
    }
}

fn files(ui: &mut Ui, work: &Work, narrow: bool, commands: &mut Vec<ExerciseCommand>) {
    let tip = tr!("exercise-open-your-own-files-in-place");
    if icon(ui, "open-files", icons::FOLDER_OPEN, tip, true) {
        commands.push(ExerciseCommand::Open);
    }
    let in_memory = work.files.iter().all(|file| file.path.is_none());
    if icon(ui, "save-files", icons::FLOPPY_DISK, tr!("exercise-save-the-files-ctrl-s"), in_memory || work.is_changed())
    {
        commands.push(ExerciseCommand::Save);
    }
    let file: Option<&OpenFile> = work.files.get(work.current);
    let [back, forth] = file.map_or([false; 2], |file| editor::can_step(ui.ctx(), file));
    if icon(ui, "undo", icons::ARROW_U_UP_LEFT, tr!("exercise-undo-in-this-file-ctrl-z"), back) {
        commands.push(ExerciseCommand::Undo);
    }
    if icon(ui, "redo", icons::ARROW_U_UP_RIGHT, tr!("exercise-redo-in-this-file-ctrl-y"), forth) {
        commands.push(ExerciseCommand::Redo);
    }
    // A phone has no room for it.
    if !narrow
        && icon(ui, "find-open", icons::MAGNIFYING_GLASS, tr!("exercise-find-in-this-file-ctrl-f"), file.is_some())
    {
        commands.push(ExerciseCommand::Find);
    }
}

/// The dialog for the folder to save to.
fn ask(ui: &Ui, work: &mut Work, commands: &mut Vec<ExerciseCommand>) {
    let Some(mut folder) = work.asking.take() else { return };
    let (mut open, mut done) = (true, false);
    let width = 420_f32.min(ui.ctx().content_rect().width() - 48.0);
    let window = Window::new(tr!("exercise-save-to-a-folder")).open(&mut open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0)).show(ui.ctx(), |ui| {
        ui.set_width(width);
        ui.label(RichText::new(tr!("exercise-the-folder-is-created-if-it")).weak());
        let field = ui.add(TextEdit::singleline(&mut folder).desired_width(f32::INFINITY).id_salt("folder"));
        exported::note(ui, &field, "folder", WidgetRole::Text, tr!("exercise-folder"), &folder);
        done |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if !field.has_focus() && !done && ui.memory(|m| m.focused().is_none()) {
            field.request_focus();
        }
        let save = ui.add_enabled(!folder.trim().is_empty(), Button::new(tr!("exercise-save")));
        exported::note(ui, &save, "folder-done", WidgetRole::Button, tr!("exercise-save"), "");
        done |= save.clicked();
    });
    if ui.input(|i| i.key_pressed(Key::Escape)) {
        open = false;
    }
    match done {
        true if !folder.trim().is_empty() => commands.push(ExerciseCommand::SaveInto(folder.trim().to_owned())),
        _ if open => work.asking = Some(folder),
        _ => {}
    }
}

fn button(ui: &mut Ui, id: &str, text: RichText, tip: &str, enabled: bool) -> bool {
    let label = text.text().to_owned();
    let button = ui.add_enabled(enabled, Button::new(text).frame_when_inactive(false));
    exported::note(ui, &button, id, WidgetRole::Button, &label, "");
    button.on_hover_text(tip).clicked()
}

fn icon(ui: &mut Ui, id: &str, icon: &str, tip: &str, enabled: bool) -> bool {
    let text = RichText::new(icon).font(theme::icon_font(17.0));
    let least = theme::touch::least(ui);
    let button = Button::new(text).frame_when_inactive(false).min_size(vec2(least, least));
    let button = ui.add_enabled(enabled, button);
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, enabled, tip));
    exported::note(ui, &button, id, WidgetRole::Button, tip, "");
    button.on_hover_text(tip).clicked()
}
