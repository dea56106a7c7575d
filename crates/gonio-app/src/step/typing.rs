//! Keys of the editor beyond a text field's own: indentation of new lines and of several lines, and comments.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Event, Id, Key, Modifiers, TextBuffer, Ui};
use std::ops::Range;

/// One step of indentation where the text has none yet.
const STEP: &str = "    ";

/// A text with its selection, in characters.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Edited {
    /// The whole text.
    text: String,
    /// The selected characters; empty for a cursor alone.
    selection: Range<usize>,
}

/// Handles the keys of this frame in the focused editor with this id, before the text field gets them.
pub fn keys(ui: &Ui, id: Id, text: &mut dyn TextBuffer) {
    if !text.is_mutable() || !ui.memory(|memory| memory.has_focus(id)) {
        return;
    }
    // The text is copied only in frames with such a key.
    if !ui.input(|input| input.events.iter().any(is_handled)) {
        return;
    }
    let Some(mut state) = TextEditState::load(ui.ctx(), id) else { return };
    let Some(range) = state.cursor.char_range() else { return };
    let [from, to] = range.sorted_cursors().map(|cursor| cursor.index.0);
    let before = Edited { text: text.as_str().to_owned(), selection: from..to };
    let Some(edited) = ui.input_mut(|input| handled(&mut input.events, &before)) else { return };
    let mut undoer = state.undoer();
    undoer.add_undo(&(range, before.text));
    state.set_undoer(undoer);
    text.replace_with(&edited.text);
    let cursors = CCursorRange::two(CCursor::new(edited.selection.start), CCursor::new(edited.selection.end));
    state.cursor.set_char_range(Some(cursors));
    state.store(ui.ctx(), id);
}

/// Whether an event may be one of the keys of this module.
fn is_handled(event: &Event) -> bool {
    match event {
        Event::Text(text) => text == "}",
        Event::Key { key, pressed, .. } => *pressed && matches!(key, Key::Enter | Key::Tab | Key::Slash),
        _ => false,
    }
}

/// Handles the events of a frame, of which a slow one has several: keys that insert text become that text, in their order. Returns
/// the text after a key that changes whole lines.
fn handled(events: &mut Vec<Event>, before: &Edited) -> Option<Edited> {
    let mut now = before.clone();
    let mut changed = None;
    // Whether the text field will have this text and selection at this event.
    let mut is_known = true;
    let mut is_typed = false;
    for event in std::mem::take(events) {
        let inserted = match &event {
            Event::Text(text) if is_known && text == "}" => {
                let removed = now.spaces_before_brace();
                (0..removed).for_each(|_| events.push(pressed(Key::Backspace)));
                now.selection.start -= removed;
                Some(text.clone())
            }
            Event::Text(text) | Event::Paste(text) => Some(text.clone()),
            Event::Key { key, pressed: true, modifiers, .. } if is_known && !modifiers.alt => {
                let lines = match (key, modifiers.command, modifiers.shift) {
                    (Key::Slash, true, _) => Some(now.with_comments_toggled()),
                    (Key::Tab, false, true) => Some(now.outdented()),
                    (Key::Tab, false, false) if now.selected().contains('\n') => Some(now.indented()),
                    _ => None,
                };
                if let Some(lines) = lines.filter(|_| !is_typed) {
                    now = lines;
                    changed = Some(now.clone());
                    continue;
                }
                match (key, modifiers.command) {
                    (Key::Enter, false) => Some(now.new_line()),
                    (Key::Tab, false) if !modifiers.shift => Some(now.step_to_insert().to_owned()),
                    _ => None,
                }
            }
            _ => None,
        };
        match inserted {
            Some(text) => {
                now = now.replaced(&text);
                is_typed = true;
                // A text field ignores a text that is a line break alone.
                events.push(if text == "\n" { event } else { Event::Text(text) });
            }
            None => {
                is_known &= !matches!(event, Event::Key { pressed: true, .. } | Event::Ime(_) | Event::Cut);
                events.push(event);
            }
        }
    }
    changed
}

fn pressed(key: Key) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
}

impl Edited {
    fn byte(&self, index: usize) -> usize {
        self.text.char_indices().nth(index).map_or(self.text.len(), |(byte, _)| byte)
    }

    fn selected(&self) -> &str {
        self.text.get(self.byte(self.selection.start)..self.byte(self.selection.end)).unwrap_or_default()
    }

    /// The part of the cursor's line that is before the cursor.
    fn before_cursor(&self) -> &str {
        let before = self.text.get(..self.byte(self.selection.start)).unwrap_or_default();
        before.rsplit('\n').next().unwrap_or_default()
    }

    /// Replaces the selection; the cursor is behind the new text.
    fn replaced(&self, with: &str) -> Self {
        let (from, to) = (self.byte(self.selection.start), self.byte(self.selection.end));
        let mut text = self.text.clone();
        text.replace_range(from..to, with);
        let cursor = self.selection.start + with.chars().count();
        Edited { text, selection: cursor..cursor }
    }

    /// A step of indentation as the text uses it.
    fn step(&self) -> &'static str {
        if self.text.lines().any(|line| line.starts_with('\t')) { "\t" } else { STEP }
    }

    /// The indentation that a tab inserts: up to the next multiple of a step.
    fn step_to_insert(&self) -> &'static str {
        match self.step() {
            "\t" => "\t",
            step => step.get(self.before_cursor().chars().count() % step.len()..).unwrap_or(step),
        }
    }

    /// A line break with the indentation of this line, and one step more after an opening brace.
    fn new_line(&self) -> String {
        let line = self.before_cursor();
        let indentation: String = line.chars().take_while(|c| *c == ' ' || *c == '\t').collect();
        let more = if line.trim_end().ends_with('{') { self.step() } else { "" };
        format!("\n{indentation}{more}")
    }

    /// Number of characters that are removed before a closing brace: a step, if only indentation is before it.
    fn spaces_before_brace(&self) -> usize {
        let line = self.before_cursor();
        let is_indentation = self.selection.is_empty() && line.chars().all(char::is_whitespace);
        if is_indentation { removed_step(line, self.step()) } else { 0 }
    }

    /// The bytes of the lines that the selection touches, without the last line break.
    fn touched_lines(&self) -> Range<usize> {
        let (from, to) = (self.byte(self.selection.start), self.byte(self.selection.end));
        let start = self.text.get(..from).and_then(|before| before.rfind('\n')).map_or(0, |at| at + 1);
        // A selection that ends at the beginning of a line does not touch that line.
        let last = if to > from && self.text.as_bytes().get(to - 1) == Some(&b'\n') { to - 1 } else { to };
        let end = self.text.get(last..).and_then(|after| after.find('\n')).map_or(self.text.len(), |at| last + at);
        start..end
    }

    /// Changes each line that the selection touches; the selection is then these lines.
    fn with_lines(&self, change: impl Fn(&str) -> String) -> Self {
        let (from, Range { start, end }) = (self.byte(self.selection.start), self.touched_lines());
        let lines: Vec<String> = self.text.get(start..end).unwrap_or_default().split('\n').map(change).collect();
        let (lines, mut text) = (lines.join("\n"), self.text.clone());
        text.replace_range(start..end, &lines);
        let first = self.text.get(..start).map_or(0, |before| before.chars().count());
        if self.selection.is_empty() {
            // The cursor keeps its distance from the end of its line.
            let behind = self.text.get(from..end).map_or(0, |rest| rest.chars().count());
            let cursor = first + lines.chars().count().saturating_sub(behind);
            return Edited { text, selection: cursor..cursor };
        }
        Edited { text, selection: first..first + lines.chars().count() }
    }

    /// Indents the lines of the selection by a step.
    fn indented(&self) -> Self {
        let step = self.step();
        self.with_lines(|line| if line.trim().is_empty() { line.to_owned() } else { format!("{step}{line}") })
    }

    /// Removes a step of indentation from the lines of the selection.
    fn outdented(&self) -> Self {
        let step = self.step();
        self.with_lines(|line| line.get(removed_step(line, step)..).unwrap_or_default().to_owned())
    }

    /// Makes the lines of the selection comments, or, if all of them are, removes the comment marks.
    fn with_comments_toggled(&self) -> Self {
        let touched = self.text.get(self.touched_lines()).unwrap_or_default();
        let lines = || touched.split('\n').filter(|line| !line.trim().is_empty());
        let are_comments = lines().count() > 0 && lines().all(|line| line.trim_start().starts_with("//"));
        let column = lines().map(|line| line.len() - line.trim_start().len()).min().unwrap_or(0);
        self.with_lines(|line| {
            if line.trim().is_empty() {
                return line.to_owned();
            }
            if !are_comments {
                let (indentation, rest) = line.split_at_checked(column).unwrap_or(("", line));
                return format!("{indentation}// {rest}");
            }
            let at = line.len() - line.trim_start().len();
            let (indentation, rest) = line.split_at(at);
            let rest = rest.strip_prefix("// ").or_else(|| rest.strip_prefix("//")).unwrap_or(rest);
            format!("{indentation}{rest}")
        })
    }
}

/// Number of characters at the start of a line that are one step of indentation, or what there is of it.
fn removed_step(line: &str, step: &str) -> usize {
    if line.starts_with('\t') {
        return 1;
    }
    line.bytes().take(step.len().max(STEP.len())).take_while(|byte| *byte == b' ').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A text with its selection between two `|`, or its cursor at one.
    fn text(marked: &str) -> Edited {
        let places: Vec<usize> =
            marked.chars().enumerate().filter(|(_, c)| *c == '|').map(|(index, _)| index).collect();
        let selection = match places[..] {
            [cursor] => cursor..cursor,
            [from, to] => from..to - 1,
            _ => panic!("{marked}"),
        };
        Edited { text: marked.replace('|', ""), selection }
    }

    /// The text after these keys: the events as a text field applies them.
    fn after(marked: &str, mut events: Vec<Event>) -> Edited {
        let before = text(marked);
        let changed = handled(&mut events, &before);
        events.iter().fold(changed.unwrap_or(before), |now, event| match event {
            Event::Text(text) => now.replaced(text),
            Event::Key { key: Key::Enter, .. } => now.replaced("\n"),
            Event::Key { key: Key::Backspace, .. } => {
                let start = now.selection.start - 1;
                Edited { selection: start..now.selection.end, ..now }.replaced("")
            }
            other => panic!("{other:?}"),
        })
    }

    fn typed(text: &str) -> Event {
        Event::Text(text.to_owned())
    }

    #[test]
    fn a_new_line_has_the_indentation_of_the_one_before() {
        let enter = || vec![pressed(Key::Enter)];
        assert_eq!(after("    a = 1;|", enter()), text("    a = 1;\n    |"));
        assert_eq!(after("    if (x) { |", enter()), text("    if (x) { \n        |"));
        assert_eq!(after("\tif (x) {|}", enter()), text("\tif (x) {\n\t\t|}"));
        assert_eq!(after("é|ü|", enter()), text("é\n|"), "a selection is replaced");
        assert_eq!(after("    ab|cd", enter()), text("    ab\n    |cd"));
    }

    #[test]
    fn keys_of_one_frame_keep_their_order() {
        let events = vec![typed("{"), pressed(Key::Enter), typed("a"), typed(";"), pressed(Key::Enter), typed("}")];
        assert_eq!(after("  |", events), text("  {\n      a;\n  }|"));
        // Where the cursor is after an arrow key is not known: the text field does what it always does.
        let mut events = vec![pressed(Key::ArrowUp), pressed(Key::Enter)];
        assert_eq!(handled(&mut events, &text("  |")), None);
        assert_eq!(events, [pressed(Key::ArrowUp), pressed(Key::Enter)]);
        let combination =
            |key, modifiers| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
        let mut events = vec![combination(Key::Enter, Modifiers::ALT), combination(Key::Enter, Modifiers::COMMAND)];
        assert_eq!((handled(&mut events, &text("|")), events.len()), (None, 2), "keys of others");
        let comment = vec![combination(Key::Slash, Modifiers::COMMAND)];
        assert_eq!(after("a|b", comment), text("// a|b"));
        assert_eq!(after("|a\nb|", vec![pressed(Key::Tab)]), text("|    a\n    b|"));
        assert_eq!(after("    a|", vec![combination(Key::Tab, Modifiers::SHIFT)]), text("a|"));
    }

    #[test]
    fn a_closing_brace_goes_back_a_step() {
        let brace = || vec![typed("}")];
        assert_eq!(after("{\n        |", brace()), text("{\n    }|"));
        assert_eq!(after("\t\t|", brace()), text("\t}|"));
        assert_eq!(after("  |", brace()), text("}|"));
        assert_eq!(after("x |", brace()), text("x }|"));
        assert_eq!(after("|", brace()), text("}|"));
    }

    #[test]
    fn lines_are_indented_and_outdented_together() {
        let lines = text("x\n    a|;\n\n  b;|\nc;");
        assert_eq!(lines.indented(), text("x\n|        a;\n\n      b;|\nc;"));
        assert_eq!(lines.outdented(), text("x\n|a;\n\nb;|\nc;"));
        // The line after the selection's last line break is not part of it.
        assert_eq!(text("|a;\n|b;").indented(), text("|    a;|\nb;"));
        assert_eq!(text("    a|b").outdented(), text("a|b"));
        assert_eq!(after("ab|", vec![pressed(Key::Tab)]), text("ab  |"), "up to the next multiple of four");
    }

    #[test]
    fn comments_are_toggled_at_the_smallest_indentation() {
        let code = text("    |if (x)\n        é;|\n");
        let comments = text("|    // if (x)\n    //     é;|\n");
        assert_eq!(code.with_comments_toggled(), comments);
        assert_eq!(comments.with_comments_toggled(), text("|    if (x)\n        é;|\n"));
        assert_eq!(text("//a|b").with_comments_toggled(), text("a|b"));
        assert_eq!(text("a|b").with_comments_toggled(), text("// a|b"));
        assert_eq!(text("|").with_comments_toggled(), text("|"), "an empty line stays empty");
    }
}
