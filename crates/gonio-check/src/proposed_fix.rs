//! A proposed fix as a diff, and its application to a text.

use crate::verdict::ProposedEdit;
use gonio_language::tr;

/// A line of a diff.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiffLine<'a> {
    /// A line of both texts.
    Kept(&'a str),
    /// A line of the old text only.
    Removed(&'a str),
    /// A line of the new text only.
    Added(&'a str),
}

impl<'a> DiffLine<'a> {
    /// The sign in front of the line, as in a unified diff.
    pub fn sign(self) -> char {
        match self {
            DiffLine::Kept(_) => ' ',
            DiffLine::Removed(_) => '-',
            DiffLine::Added(_) => '+',
        }
    }

    /// The line without its sign.
    pub fn text(self) -> &'a str {
        let (DiffLine::Kept(text) | DiffLine::Removed(text) | DiffLine::Added(text)) = self;
        text
    }
}

impl ProposedEdit {
    /// The edit as a diff. Lines at its beginning and its end that do not change are kept lines.
    pub fn diff(&self) -> Vec<DiffLine<'_>> {
        let (old, new) = (lines(&self.before), lines(&self.after));
        let start = old.iter().zip(&new).take_while(|(a, b)| a == b).count();
        let rest = old.len().min(new.len()) - start;
        let end = old.iter().rev().zip(new.iter().rev()).take(rest).take_while(|(a, b)| a == b).count();
        let mut diff: Vec<DiffLine<'_>> = old[..start].iter().map(|text| DiffLine::Kept(text)).collect();
        diff.extend(old[start..old.len() - end].iter().map(|text| DiffLine::Removed(text)));
        diff.extend(new[start..new.len() - end].iter().map(|text| DiffLine::Added(text)));
        diff.extend(old[old.len() - end..].iter().map(|text| DiffLine::Kept(text)));
        diff
    }
}

/// The sentence above the diff of a proposed fix.
pub fn promise(edits: &[ProposedEdit]) -> &'static str {
    match edits.len() {
        1 => tr!("check-with-this-change-every-test-scene"),
        _ => tr!("check-with-these-changes-every-test-scene"),
    }
}

/// The text of a file with all edits of that file. `None` if the text differs from the one that was checked where an edit
/// replaces lines. Line ends are kept; new lines have the ends of the text's first line.
pub fn applied(edits: &[ProposedEdit], file: &str, text: &str) -> Option<String> {
    let mut content: Vec<String> = text.split_inclusive('\n').map(str::to_owned).collect();
    let end = if content.first().is_some_and(|line| line.ends_with("\r\n")) { "\r\n" } else { "\n" };
    let mut edits: Vec<&ProposedEdit> = edits.iter().filter(|edit| edit.file == file).collect();
    // Edits below a line do not move it; what is inserted before a line moves it.
    edits.sort_by_key(|edit| std::cmp::Reverse((edit.line, !edit.before.is_empty())));
    for edit in edits {
        let first = usize::try_from(edit.line).ok()?.checked_sub(1)?;
        let old = lines(&edit.before);
        let range = first..first.checked_add(old.len())?;
        let is_old =
            content.get(range.clone())?.iter().zip(&old).all(|(line, old)| line.trim_end_matches(['\r', '\n']) == *old);
        if !is_old {
            return None;
        }
        // The last line of a text may have no end.
        if range.start == content.len()
            && let Some(last) = content.last_mut().filter(|last| !last.ends_with('\n'))
        {
            last.push_str(end);
        }
        let is_last = range.end == content.len() && !old.is_empty() && !text.ends_with('\n');
        let mut new: Vec<String> = lines(&edit.after).into_iter().map(|line| format!("{line}{end}")).collect();
        if let Some(last) = new.last_mut().filter(|_| is_last) {
            last.truncate(last.len() - end.len());
        }
        content.splice(range, new);
    }
    Some(content.concat())
}

/// The lines of a part of an edit, which has no last line break; an empty part has none.
fn lines(text: &str) -> Vec<&str> {
    text.lines().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edit(line: u32, before: &str, after: &str) -> ProposedEdit {
        ProposedEdit { file: "a.frag".to_owned(), line, before: before.to_owned(), after: after.to_owned() }
    }

    fn signed(edit: &ProposedEdit) -> String {
        edit.diff().iter().map(|line| format!("{}{}\n", line.sign(), line.text())).collect()
    }

    #[test]
    fn a_diff_has_the_old_lines_before_the_new_ones_between_kept_lines() {
        assert_eq!(signed(&edit(3, "a", "b")), "-a\n+b\n");
        assert_eq!(signed(&edit(3, "", "b")), "+b\n");
        assert_eq!(signed(&edit(3, "x\na\ny", "x\nb\nc\ny")), " x\n-a\n+b\n+c\n y\n");
        // A line that is repeated is not both the beginning and the end.
        assert_eq!(signed(&edit(3, "x\nx", "x")), " x\n-x\n");
        assert_eq!(signed(&edit(3, "x", "x\nx")), " x\n+x\n");
    }

    #[test]
    fn edits_are_applied_together_with_the_texts_line_ends() {
        let edits = [edit(1, "", "new"), edit(2, "b", "B\nC"), edit(3, "c", "")];
        assert_eq!(applied(&edits, "a.frag", "a\nb\nc\nd\n").as_deref(), Some("new\na\nB\nC\nd\n"));
        assert_eq!(applied(&edits, "a.frag", "a\r\nb\r\nc").as_deref(), Some("new\r\na\r\nB\r\nC"));
        assert_eq!(applied(&edits[1..2], "a.frag", "a\nb").as_deref(), Some("a\nB\nC"));
        assert_eq!(applied(&[edit(2, "", "b")], "a.frag", "a").as_deref(), Some("a\nb\n"));
        let same_line = [edit(1, "", "new"), edit(1, "a", "A")];
        assert_eq!(applied(&same_line, "a.frag", "a\n").as_deref(), Some("new\nA\n"));
        assert_eq!(applied(&edits, "b.vert", "x").as_deref(), Some("x"));
    }

    #[test]
    fn edits_of_another_text_are_refused() {
        for (line, text) in [(2, "a\nx\nc"), (2, "a"), (0, "b"), (u32::MAX, "b"), (2, "a\n b")] {
            assert_eq!(applied(&[edit(line, "b", "B")], "a.frag", text), None, "line {line} of {text:?}");
        }
    }
}
