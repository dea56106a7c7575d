//! Changes that affect single words: directives, precisions, doubles.

use super::Translator;
use crate::Span;

impl Translator<'_> {
    /// Removes directives except for macros: `#if` has been evaluated for the student's version, and must not be
    /// evaluated again for another.
    pub(super) fn directives(&mut self) {
        let source = &self.parsed.source;
        for directive in &self.parsed.directives {
            if matches!(&*directive.word, "define" | "undef" | "pragma") {
                self.join(directive.span);
                continue;
            }
            self.edits.blank(source, directive.span.start, directive.span.end);
        }
        for (start, end) in &self.parsed.inactive {
            self.edits.blank(source, *start, *end);
        }
    }

    /// Joins a macro's lines, because 3.30 has no line continuations; the line ends follow it.
    fn join(&mut self, span: Span) {
        let source = &self.parsed.source;
        let text = source.get(span.start as usize..span.end as usize).unwrap_or("");
        let mut ends = String::new();
        for (at, _) in text.match_indices('\\') {
            let rest = &text[at + 1..];
            let end =
                if rest.starts_with("\r\n") { "\r\n" } else { rest.get(..1).filter(|c| *c == "\n").unwrap_or("") };
            if !end.is_empty() {
                let start = span.start + at as u32;
                self.edits.replace(start, start + 1 + end.len() as u32, "");
                ends.push_str(end);
            }
        }
        if !ends.is_empty() {
            self.edits.append(span.end, &ends);
        }
    }

    /// Replaces line continuations between statements by line ends.
    pub(super) fn continuations(&mut self) {
        let source = &self.parsed.source;
        for (at, _) in source.match_indices('\\') {
            let at32 = at as u32;
            let is_end = source[at + 1..].starts_with(['\r', '\n']);
            let before = self.parsed.directives.partition_point(|d| d.span.start <= at32);
            let is_define = before > 0 && at32 < self.parsed.directives[before - 1].span.end;
            let line = source[..at].rsplit('\n').next().unwrap_or("");
            if is_end && !is_define && !line.contains("//") {
                self.edits.replace(at32, at32 + 1, "");
            }
        }
    }

    pub(super) fn words(&mut self) {
        for index in 0..self.parsed.tokens.len() as u32 {
            let place = self.parsed.tokens[index as usize];
            if let Some(text) = other_word(self.token_text(index)) {
                self.edits.replace(place.start, place.end, text);
            }
        }
        for (word, start, end) in &self.parsed.macro_words {
            if let Some(text) = other_word(word) {
                self.edits.replace(*start, *end, text);
            }
        }
    }
}

fn other_word(word: &str) -> Option<String> {
    match word {
        "mediump" | "lowp" => Some("highp".into()),
        "double" => Some("float".into()),
        _ if word.starts_with("dvec") || word.starts_with("dmat") => {
            crate::Type::named(word).map(|_| word[1..].to_string())
        }
        _ if word.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            let number = word.strip_suffix("lf").or_else(|| word.strip_suffix("LF"))?;
            Some(number.to_string())
        }
        _ => None,
    }
}
