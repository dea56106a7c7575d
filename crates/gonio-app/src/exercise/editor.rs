//! The editor: a tab per file, questions about files, and the current text.

use super::command::ExerciseCommand;
use super::file_sets::listed;
use super::work::{OpenFile, Work};
use crate::exported::{self, WidgetRole};
use crate::step::Stepper;
use crate::step::code::{self, Code, MarkKind};
use crate::theme::colors;
use egui::text_edit::TextEditState;
use egui::{Color32, Frame, Label, Margin, RichText, Ui, vec2};
use gonio_language::tr;

/// Shows the tabs of the files, and the current file's text with its messages. Texts are edited in place. Returns a command
/// if one was given.
pub fn show(ui: &mut Ui, work: &mut Work, stepper: &mut Stepper) -> Option<ExerciseCommand> {
    let file = work.files.get(work.current).map_or("", |file| file.name.as_str());
    if let Some(stepped) = stepper.follow_file(file).and_then(|file| work.file_named(&file)) {
        work.current = stepped;
    }
    tabs(ui, work);
    let asked = restored(ui, work).or(conflict(ui, work)).or(put_back(ui, work));
    let marks = work.marks(work.current);
    let jump = work.jump.take_if(|(file, _)| *file == work.current).map(|(_, line)| line);
    let (current, error) = (work.current, work.program.unusable.as_deref());
    if !work.files.iter().any(OpenFile::is_shown) {
        // The text and the figures are on a page of their own.
        ui.add(Label::new(RichText::new(tr!("exercise-the-exercise-has-no-files-to")).weak()).wrap());
    } else if let Some(file) = work.files.get_mut(current) {
        let of = Code { id: file.id(), name: &file.name.clone(), marks: &marks, jump, is_fixed: file.locked };
        if let Some(line) = code::show(ui, &of, &mut file.text, error, stepper) {
            work.jump = Some((current, line));
        }
    }
    asked
}

fn tabs(ui: &mut Ui, work: &mut Work) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        for index in 0..work.files.len() {
            let Some(file) = work.files.get(index).filter(|file| file.is_shown()) else { continue };
            let worst = work.marks(index).iter().map(|mark| mark.kind).max();
            let chosen = index == work.current;
            let name = if file.is_changed() { format!("{} •", file.name) } else { file.name.clone() };
            let mut label = RichText::new(name);
            match worst {
                // The selection's colour leaves too little contrast for a tint, and the marks are in view.
                _ if chosen => label = label.color(ui.visuals().strong_text_color()),
                Some(MarkKind::Error) => label = label.color(colors::ERROR.of(ui)),
                Some(MarkKind::Mistake) => label = label.color(colors::WRONG.of(ui)),
                Some(MarkKind::Warning) => label = label.color(colors::WARNING.of(ui)),
                None => {}
            }
            let button = egui::Button::new(label).selected(chosen).frame_when_inactive(chosen);
            let button = ui.add(button);
            let tip = match (&file.path, file.locked) {
                (_, true) => tr!("exercise-this-file-is-not-utf").into(),
                (Some(path), _) => path.display().to_string(),
                (None, _) => tr!("exercise-in-memory-only-ctrl-s-saves").into(),
            };
            exported::note(ui, &button, &format!("file-{index}"), WidgetRole::Tab, &file.name, chosen);
            if button.on_hover_text(tip).clicked() {
                work.current = index;
            }
        }
    });
}

/// The question about drafts of an earlier window that are in the editor now.
fn restored(ui: &mut Ui, work: &Work) -> Option<ExerciseCommand> {
    let in_conflict = |file: &OpenFile| file.other.is_some();
    // The question about the conflict covers it, with the same answers.
    if work.files.get(work.current).is_some_and(|file| file.is_restored() && in_conflict(file)) {
        return None;
    }
    let files: Vec<&OpenFile> = work.files.iter().filter(|file| file.is_restored() && !in_conflict(file)).collect();
    let age = files.first()?.restored.as_deref()?;
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let sentence = tr!("exercise-restored-unsaved-changes-from-in-they", age = age, names = listed(&names));
    let answers = [
        ("discard-restored", tr!("exercise-discard"), ExerciseCommand::DiscardRestored),
        ("keep-restored", tr!("exercise-keep"), ExerciseCommand::KeepRestored),
    ];
    question(ui, "restored", colors::ACCENT.of(ui), &sentence, answers)
}

/// The question about a file that changed on disk while it has unsaved changes here.
fn conflict(ui: &mut Ui, work: &Work) -> Option<ExerciseCommand> {
    let current = work.current;
    let file = work.files.get(current).filter(|file| file.other.is_some())?;
    let sentence = match file.restored.as_ref().filter(|_| file.is_restored()) {
        Some(age) => tr!("exercise-restored-unsaved-changes-from-in-but", age = age, name = file.name),
        None => tr!("exercise-has-changed-on-disk-and-you", name = file.name),
    };
    let answers = [
        ("take-other", tr!("exercise-load-the-version-on-disk"), ExerciseCommand::TakeOther(current)),
        ("keep-mine", tr!("exercise-keep-mine-and-save-it"), ExerciseCommand::KeepMine(current)),
    ];
    question(ui, "conflict", colors::WARNING.of(ui), &sentence, answers)
}

/// A sentence with two buttons. Returns the command of the pressed one.
fn question(
    ui: &mut Ui,
    id: &str,
    tint: Color32,
    sentence: &str,
    answers: [(&str, &str, ExerciseCommand); 2],
) -> Option<ExerciseCommand> {
    let mut asked = None;
    let frame = Frame::NONE.fill(tint.gamma_multiply(0.18)).corner_radius(5).inner_margin(Margin::same(6));
    let response = frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.add(Label::new(sentence).wrap());
        ui.horizontal_wrapped(|ui| {
            for (id, label, answer) in answers {
                let button = ui.button(label);
                exported::note(ui, &button, id, WidgetRole::Button, label, "");
                if button.clicked() {
                    asked = Some(answer);
                }
            }
        });
    });
    exported::note(ui, &response.response, id, WidgetRole::Text, sentence, "");
    asked
}

/// The previous set of files, with a button to put it back.
fn put_back(ui: &mut Ui, work: &Work) -> Option<ExerciseCommand> {
    let before = work.before.last()?;
    ui.horizontal_wrapped(|ui| {
        let files = before.names_beside(&work.files);
        let sentence = if before.files.iter().any(OpenFile::is_changed) {
            tr!("exercise-replaced-unsaved", files = files)
        } else {
            tr!("exercise-replaced", files = files)
        };
        ui.add(Label::new(RichText::new(sentence).small().weak()).wrap());
        let button = ui.small_button(tr!("exercise-restore"));
        exported::note(ui, &button, "put-back", WidgetRole::Button, tr!("exercise-restore"), work.before.len());
        let tip = tr!("exercise-switch-back-to-the-files-that");
        button.on_hover_text(tip).clicked().then_some(ExerciseCommand::PutBack)
    })
    .inner
}

/// Undoes a step in a file, or redoes one (`forth`). Returns whether there was one.
pub fn undo_step(ctx: &egui::Context, file: &mut OpenFile, forth: bool) -> bool {
    let id = file.id();
    let Some(mut state) = TextEditState::load(ctx, id).filter(|_| !file.locked) else { return false };
    let range = state.cursor.char_range().unwrap_or_default();
    let now = (range, file.text.clone());
    let mut undoer = state.undoer();
    let then = if forth { undoer.redo(&now) } else { undoer.undo(&now) };
    let Some((range, text)) = then.cloned() else { return false };
    file.text = text;
    state.cursor.set_char_range(Some(range));
    state.set_undoer(undoer);
    state.store(ctx, id);
    true
}

/// Adds the text to the undo history, before it is replaced by other means than typing.
pub fn remember(ctx: &egui::Context, file: &OpenFile) {
    let id = file.id();
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let range = state.cursor.char_range().unwrap_or_default();
    let mut undoer = state.undoer();
    undoer.add_undo(&(range, file.text.clone()));
    state.set_undoer(undoer);
    state.store(ctx, id);
}

/// Gives up the keyboard focus, so that another field can take it.
pub fn release_focus(ctx: &egui::Context, work: &Work) {
    if let Some(file) = work.files.get(work.current) {
        ctx.memory_mut(|memory| memory.surrender_focus(file.id()));
    }
}

/// Whether there is a step to undo, and one to redo.
pub fn can_step(ctx: &egui::Context, file: &OpenFile) -> [bool; 2] {
    let Some(state) = TextEditState::load(ctx, file.id()).filter(|_| !file.locked) else { return [false; 2] };
    let now = (state.cursor.char_range().unwrap_or_default(), file.text.clone());
    let undoer = state.undoer();
    [undoer.has_undo(&now), undoer.has_redo(&now)]
}
