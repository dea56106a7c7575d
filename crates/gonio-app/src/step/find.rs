//! The search in a text: Ctrl + F, then Enter and Shift + Enter, F3 and Shift + F3.

use crate::exported::{self, WidgetRole};
use crate::theme::icons;
use crate::widgets::icon_button;
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Id, Key, KeyboardShortcut, Modifiers, RichText, TextEdit, Ui};
use gonio_language::tr;
use std::ops::Range;

/// The search of one text.
#[derive(Clone, Debug, Default)]
struct Search {
    is_open: bool,
    query: String,
    /// Index of the current match.
    current: usize,
    /// Whether the field gets the keyboard focus.
    wants_focus: bool,
    /// Whether it had the focus in the last frame: Escape removes it before widgets see the key.
    had_focus: bool,
}

/// Opens the search in the text with this id.
pub fn open(ctx: &egui::Context, id: Id) {
    ctx.data_mut(|data| {
        let search: &mut Search = data.get_temp_mut_or_default(id.with("search"));
        (search.is_open, search.wants_focus) = (true, true);
    });
}

/// Shows the field while it is open. Returns the characters to select and to scroll to, if another match was chosen.
pub fn show(ui: &mut Ui, id: Id, text: &str) -> Option<Range<usize>> {
    let key = |modifiers, key| KeyboardShortcut::new(modifiers, key);
    if ui.input_mut(|input| input.consume_shortcut(&key(Modifiers::COMMAND, Key::F))) {
        open(ui.ctx(), id);
    }
    let data_id = id.with("search");
    let mut search: Search = ui.data(|data| data.get_temp(data_id)).filter(|search: &Search| search.is_open)?;
    let field_id = id.with(tr!("exercise-search-field"));
    let is_in_field = ui.memory(|memory| memory.has_focus(field_id));
    let mut way = ui.input_mut(|input| {
        if input.consume_shortcut(&key(Modifiers::SHIFT, Key::F3)) {
            Some(false)
        } else if input.consume_shortcut(&key(Modifiers::NONE, Key::F3)) {
            Some(true)
        } else if is_in_field && input.key_pressed(Key::Enter) {
            Some(!input.modifiers.shift)
        } else {
            None
        }
    });
    let escape =
        (is_in_field || search.had_focus) && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    let mut closed = escape;
    search.had_focus = is_in_field;
    let mut changed = false;
    let found = matches(text, &search.query);
    ui.horizontal(|ui| {
        let field =
            TextEdit::singleline(&mut search.query).id(field_id).hint_text(tr!("exercise-find")).desired_width(180.0);
        let field = ui.add(field);
        exported::note(ui, &field, "find", WidgetRole::Text, tr!("exercise-find"), &search.query);
        if std::mem::take(&mut search.wants_focus) || (way.is_some() && is_in_field) {
            field.request_focus();
        }
        changed = field.changed();
        let count = match (found.len(), search.query.is_empty()) {
            (_, true) => String::new(),
            (0, false) => tr!("exercise-not-found").to_owned(),
            (count, false) => tr!("exercise-of", number = search.current.min(count - 1) + 1, count = count),
        };
        let label = ui.label(RichText::new(&count).small().weak());
        exported::note(ui, &label, "found", WidgetRole::Text, tr!("exercise-matches"), &count);
        if icon_button(ui, "find-previous", icons::CARET_UP, tr!("exercise-previous-match-shift-f3")).clicked() {
            way = Some(false);
        }
        if icon_button(ui, "find-next", icons::CARET_DOWN, tr!("exercise-next-match-f3")).clicked() {
            way = Some(true);
        }
        closed |= icon_button(ui, "find-close", icons::X, tr!("exercise-close-the-search-esc")).clicked();
    });
    let found = if changed { matches(text, &search.query) } else { found };
    let mut chosen = None;
    if changed {
        search.current = 0;
        chosen = found.first().cloned();
    } else if let (Some(forth), count @ 1..) = (way, found.len()) {
        search.current = if forth { (search.current + 1) % count } else { (search.current + count - 1) % count };
        chosen = found.get(search.current).cloned();
    }
    search.is_open = !closed;
    if closed {
        // The text gets the focus back, with the match selected.
        ui.memory_mut(|memory| memory.request_focus(id));
        chosen = found.get(search.current).cloned();
    }
    ui.data_mut(|data| data.insert_temp(data_id, search));
    if let Some(range) = &chosen {
        select(ui, id, range);
    }
    chosen
}

fn select(ui: &Ui, id: Id, range: &Range<usize>) {
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    let cursors = CCursorRange::two(CCursor::new(range.start), CCursor::new(range.end));
    state.cursor.set_char_range(Some(cursors));
    state.store(ui.ctx(), id);
}

/// The places of `query` in a text, in characters, without regard to upper and lower case; none for an empty query.
fn matches(text: &str, query: &str) -> Vec<Range<usize>> {
    let lower = |c: char| c.to_lowercase().next().unwrap_or(c);
    let query: Vec<char> = query.chars().map(lower).collect();
    let text: Vec<char> = text.chars().map(lower).collect();
    let mut found = Vec::new();
    let mut at = 0;
    while !query.is_empty() && at + query.len() <= text.len() {
        if text.get(at..at + query.len()) == Some(&query[..]) {
            found.push(at..at + query.len());
            at += query.len();
        } else {
            at += 1;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matches_are_counted_in_characters_without_regard_to_case() {
        assert_eq!(matches("é Light light_pos", "LIGHT"), [2..7, 8..13]);
        assert_eq!(matches("aaaa", "aa"), [0..2, 2..4], "matches do not overlap");
        assert_eq!(matches("abc", ""), []);
        assert_eq!(matches("ab", "abc"), []);
        assert_eq!(matches("法線 法線", "法線"), [0..2, 3..5]);
    }
}
