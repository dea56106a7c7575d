//! The compiler's and the linker's messages, brought home to the student's file and explained.

mod explain;
mod log;

#[cfg(test)]
mod tests;

pub use explain::explain;
pub use log::{LogLine, Severity, read_log};

use crate::nearest::distance;
use crate::submission::{StageText, without_comments};
use std::collections::BTreeSet;

/// One message at its place in the student's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// The severity.
    pub severity: Severity,
    /// The student's file.
    pub file: String,
    /// Its line, where the driver named one.
    pub line: Option<u32>,
    /// Its column, where the driver named one.
    pub column: Option<u32>,
    /// The driver's message.
    pub text: String,
    /// The student's line.
    pub quoted: Option<String>,
    /// An explanation and a remedy, for common messages.
    pub explanation: Option<String>,
}

/// The messages of one stage's log. `first_line` is the line of the compiled text on which the stage's text begins,
/// from 1 (gonio may put lines in front).
#[must_use]
pub fn to_messages(log: &str, stage: &StageText, first_line: u32) -> Vec<Message> {
    let mut messages: Vec<Message> = Vec::new();
    let lines: Vec<&str> = stage.text.lines().collect();
    for LogLine { line, column, severity, text } in read_log(log) {
        let text_line = line.map(|line| line.saturating_sub(first_line.max(1) - 1).max(1));
        let quoted =
            text_line.and_then(|line| lines.get(usize::try_from(line).ok()? - 1)).map(|line| (*line).to_owned());
        let place = text_line.map(|line| stage.place(line, column.unwrap_or(0)));
        let explanation = [explain(&text), similar_name(&text, stage), before(&text, text_line, &lines, stage)];
        let explanation: Vec<String> = explanation.into_iter().flatten().collect();
        messages.push(Message {
            severity,
            file: stage.file.clone(),
            line: place.map(|(_, line, _)| line),
            column: place.and_then(|(_, _, found)| column.map(|_| found)),
            text,
            quoted,
            explanation: (!explanation.is_empty()).then(|| explanation.join(" ")),
        });
    }
    messages
}

/// The messages of a link's log. A message that names a variable is placed where a stage declares it.
#[must_use]
pub fn link_messages(log: &str, vertex: &StageText, fragment: &StageText) -> Vec<Message> {
    read_log(log)
        .into_iter()
        .map(|LogLine { severity, text, .. }| {
            let named = explain::quoted_names(&text);
            let rather_fragment = text.to_lowercase().find("fragment").is_some_and(|at| at < 10);
            let stages = if rather_fragment { [fragment, vertex] } else { [vertex, fragment] };
            let found = stages.iter().find_map(|stage| {
                let (line, column) = named.iter().find_map(|name| declaration(stage, name))?;
                Some((*stage, line, column))
            });
            let place = found.map(|(stage, line, column)| stage.place(line, column));
            Message {
                severity,
                file: found.map_or(stages[0], |(stage, ..)| stage).file.clone(),
                line: place.map(|(_, line, _)| line),
                column: place.map(|(_, _, column)| column),
                quoted: found.and_then(|(stage, line, _)| stage.line(line)).map(str::to_owned),
                explanation: explain(&text),
                text,
            }
        })
        .collect()
}

/// The line and column of a global variable's declaration.
fn declaration(stage: &StageText, name: &str) -> Option<(u32, u32)> {
    let qualifiers = ["in", "out", "uniform", "varying", "attribute"];
    let code = without_comments(&stage.text);
    for (line, text) in (1u32..).zip(code.lines()) {
        let words = || identifiers(text);
        if words().any(|(_, word)| qualifiers.contains(&word))
            && let Some((at, _)) = words().find(|(_, word)| *word == name)
        {
            let column = text.get(..at).map_or(0, |before| before.chars().count()) + 1;
            return Some((line, u32::try_from(column).unwrap_or(u32::MAX)));
        }
    }
    None
}

/// The words of a line and where they begin.
fn identifiers(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let is_outside = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    let mut next = 0;
    text.split_inclusive(is_outside).filter_map(move |piece| {
        let at = next;
        next += piece.len();
        let word = piece.trim_end_matches(is_outside);
        (!word.is_empty()).then_some((at, word))
    })
}

/// For a name that is not declared: one of the shader's own that is spelt nearly so.
fn similar_name(text: &str, stage: &StageText) -> Option<String> {
    if !explain::is_undeclared(text) {
        return None;
    }
    let name = explain::quoted_names(text).into_iter().next()?;
    let known: BTreeSet<&str> = identifiers(&stage.text).map(|(_, word)| word).take(20_000).collect();
    let may_be = |word: &&str| *word != name && word.len() > 2 && !word.starts_with(|c: char| c.is_ascii_digit());
    let (slips, word) = known.iter().copied().filter(may_be).map(|word| (distance(word, &name), word)).min()?;
    let near = slips <= 2 && slips * 3 <= name.len() || word.eq_ignore_ascii_case(&name);
    near.then(|| format!("Did you mean `{word}`?"))
}

/// For a message of syntax: the line before, if it lacks its semicolon.
fn before(text: &str, line: Option<u32>, lines: &[&str], stage: &StageText) -> Option<String> {
    if !explain::is_syntax(text) {
        return None;
    }
    let at = usize::try_from(line?).ok()?;
    let (index, code) = (0..at.saturating_sub(1)).rev().take(20).find_map(|index| {
        let code = lines.get(index)?.split("//").next().unwrap_or_default().trim();
        (!code.is_empty()).then_some((index, code))
    })?;
    let ended =
        code.starts_with('#') || code.ends_with([';', '{', '}', ',', '(', '*', '/', '+', '-', '=', '&', '|', '?', ':']);
    let head = code.ends_with(')') && ["if", "for", "while", "void"].iter().any(|word| code.starts_with(word));
    if ended || head || code == "else" {
        return None;
    }
    let (_, line, _) = stage.place(u32::try_from(index + 1).ok()?, 0);
    Some(format!("Line {line} ends without a semicolon: `{code}`."))
}
