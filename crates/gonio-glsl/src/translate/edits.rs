//! Collects changes of a text by position, preserving its lines.

use std::collections::{BTreeMap, HashSet};

#[derive(Debug, Default)]
pub(super) struct Edits {
    /// Replacements by first byte.
    replaced: BTreeMap<u32, (u32, String)>,
    before: BTreeMap<u32, String>,
    /// Texts after a position, with the position of the matching opening text.
    after: BTreeMap<u32, Vec<(u32, String)>>,
    wraps: HashSet<(u32, u32, String)>,
}

impl Edits {
    /// Replaces a range. Replacements inside a longer one are dropped with it.
    pub fn replace(&mut self, start: u32, end: u32, text: impl Into<String>) {
        let is_longest = self.replaced.get(&start).is_none_or(|(known, _)| *known <= end);
        if is_longest && end > start {
            self.replaced.insert(start, (end, text.into()));
        }
    }

    /// Removes a range except for line ends.
    pub fn blank(&mut self, source: &str, start: u32, end: u32) {
        let text = source.get(start as usize..end as usize).unwrap_or("");
        let kept: String = text.chars().filter(|c| matches!(c, '\n' | '\r')).collect();
        self.replace(start, end, kept);
    }

    /// Inserts text before a position.
    pub fn insert(&mut self, at: u32, text: &str) {
        self.before.entry(at).or_default().push_str(text);
    }

    /// Inserts text after a position.
    pub fn append(&mut self, at: u32, text: &str) {
        self.after.entry(at).or_default().push((at, text.to_string()));
    }

    /// Wraps a range in `open` and `)`; an outer pair comes after the inner ones.
    pub fn wrap(&mut self, start: u32, end: u32, open: &str) {
        if !self.wraps.insert((start, end, open.to_string())) {
            return;
        }
        self.before.entry(start).or_default().insert_str(0, open);
        self.after.entry(end).or_default().push((start, ")".to_string()));
    }

    /// Wraps a range, and everything wrapped around it so far, in `open` and `close`.
    pub fn surround(&mut self, start: u32, end: u32, open: &str, close: &str) {
        self.before.entry(start).or_default().insert_str(0, open);
        self.after.entry(end).or_default().push((start, close.to_string()));
    }

    /// Returns the source between two bytes with all changes.
    pub fn apply(&self, source: &str, start: u32, end: u32) -> String {
        let mut places: Vec<u32> = self.replaced.range(start..end).map(|(at, _)| *at).collect();
        places.extend(self.before.range(start..end).map(|(at, _)| *at));
        places.extend(self.after.range(start.saturating_add(1)..end.saturating_add(1)).map(|(at, _)| *at));
        places.sort_unstable();
        places.dedup();
        let between = |from: u32, to: u32| source.get(from as usize..to as usize).unwrap_or("");
        let mut out = String::with_capacity((end - start) as usize + 256);
        let mut at = start;
        let mut gone = (end, end);
        for place in places {
            if place < at {
                continue;
            }
            out.push_str(between(at, place));
            at = place;
            for (opened, text) in self.after.get(&place).into_iter().flatten() {
                // A closing text without its opening one, in removed text or before the start, is dropped.
                let is_gone = gone.1 == place && *opened > gone.0 && *opened < place;
                if place > start && !is_gone && *opened >= start {
                    out.push_str(text);
                }
            }
            if place >= end {
                break;
            }
            if let Some(text) = self.before.get(&place) {
                out.push_str(text);
            }
            if let Some((to, text)) = self.replaced.get(&place) {
                out.push_str(text);
                gone = (place, *to);
                at = *to;
            }
        }
        out.push_str(between(at, end));
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Edits;

    #[test]
    fn changes_meet_in_the_right_order() {
        let source = "a = b + 1;";
        let mut edits = Edits::default();
        edits.wrap(4, 5, "float(");
        edits.replace(8, 9, "1.0");
        edits.wrap(4, 9, "vec3(");
        edits.append(9, "!");
        edits.insert(9, "?");
        assert_eq!(edits.apply(source, 0, 10), "a = vec3(float(b) + 1.0)!?;");
        assert_eq!(edits.apply(source, 8, 9), "1.0!");
        edits.blank(source, 2, 9);
        assert_eq!(edits.apply(source, 0, 10), "a !?;");
    }
}
