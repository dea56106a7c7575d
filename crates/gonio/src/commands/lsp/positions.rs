//! Positions of the protocol and ours: the protocol counts lines and UTF-16 code units from 0, gonio lines and characters from 1.

use gonio_check::source_problems::LineAndColumn;
use lsp_types::{Position, Range};

/// The lines of a text, without their ends.
pub struct Lines<'a>(Vec<&'a str>);

impl<'a> Lines<'a> {
    /// Splits a text at the protocol's line ends.
    pub fn new(text: &'a str) -> Self {
        let mut lines = Vec::new();
        let mut rest = text;
        while let Some(end) = rest.find(['\n', '\r']) {
            lines.push(&rest[..end]);
            let width = if rest[end..].starts_with("\r\n") { 2 } else { 1 };
            rest = &rest[end + width..];
        }
        lines.push(rest);
        Lines(lines)
    }

    fn line(&self, index: u32) -> &'a str {
        self.0.get(index as usize).copied().unwrap_or_default()
    }

    /// The position of a line and column. Places beyond the text are at its end, and those beyond a line at the line's.
    pub fn position(&self, [line, column]: LineAndColumn) -> Position {
        let last = u32::try_from(self.0.len() - 1).unwrap_or(u32::MAX);
        let index = line.saturating_sub(1).min(last);
        let before = self.line(index).chars().take(column.saturating_sub(1) as usize);
        Position::new(index, units(before))
    }

    /// The line and column of a position. A unit within a character is that character's.
    pub fn place(&self, position: Position) -> LineAndColumn {
        let mut units = 0;
        let is_before = |c: &char| {
            units += c.len_utf16() as u32;
            units <= position.character
        };
        let column = self.line(position.line).chars().take_while(is_before).count();
        [position.line.saturating_add(1), u32::try_from(column).unwrap_or(u32::MAX).saturating_add(1)]
    }

    /// The range between two places.
    pub fn range(&self, start: LineAndColumn, end: LineAndColumn) -> Range {
        Range::new(self.position(start), self.position(end))
    }

    /// The range of a line's text, without the blanks around it.
    pub fn text_of_line(&self, line: u32) -> Range {
        let text = self.line(line.saturating_sub(1));
        let blank = text.chars().take_while(|c| c.is_whitespace()).count();
        let [start, end] = [blank, text.trim_end().chars().count().max(blank)];
        let column = |count: usize| u32::try_from(count + 1).unwrap_or(u32::MAX);
        self.range([line, column(start)], [line, column(end)])
    }

    /// The range of the word, or else of the character, at a place.
    pub fn word_at(&self, [line, column]: LineAndColumn) -> Range {
        let rest = self.line(line.saturating_sub(1)).chars().skip(column.saturating_sub(1) as usize);
        let length = rest.take_while(|c| c.is_alphanumeric() || *c == '_').count().max(1);
        self.range([line, column], [line, column.saturating_add(u32::try_from(length).unwrap_or(1))])
    }
}

fn units(characters: impl Iterator<Item = char>) -> u32 {
    u32::try_from(characters.map(char::len_utf16).sum::<usize>()).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_utf_16_code_units_there_and_characters_here() {
        let lines = Lines::new("// é😀 x\r\n\tint a;  \rb\n");
        for (place, position) in [
            ([1, 1], (0, 0)),
            ([1, 5], (0, 4)),
            ([1, 6], (0, 6)),
            ([1, 7], (0, 7)),
            ([2, 2], (1, 1)),
            ([3, 1], (2, 0)),
            ([4, 1], (3, 0)),
        ] {
            let position = Position::new(position.0, position.1);
            assert_eq!((lines.position(place), lines.place(position)), (position, place));
        }
        // Within the smiley, beyond the line, and beyond the text.
        assert_eq!(lines.place(Position::new(0, 5)), [1, 5]);
        assert_eq!(lines.position([3, 99]), Position::new(2, 1));
        assert_eq!(lines.position([99, 1]), Position::new(3, 0));
        assert_eq!(lines.place(Position::new(99, 9)), [100, 1]);
        assert_eq!(lines.text_of_line(2), Range::new(Position::new(1, 1), Position::new(1, 7)));
        assert_eq!(lines.word_at([2, 2]), Range::new(Position::new(1, 1), Position::new(1, 4)));
        assert_eq!(Lines::new("").position([1, 1]), Position::new(0, 0));
    }
}
