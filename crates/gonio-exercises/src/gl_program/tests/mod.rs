//! GL programs, right and wrong, executed on the installed driver.

mod broken;
mod execution;
mod hostile;
mod program;
mod right;

use crate::gl_program::{GlProgramFindings, check, exercise_files};
use gonio_gl::HeadlessContext;

/// The reference's text.
pub const REFERENCE: &str = include_str!("../../../../../exercises/ex11-texture-unit/host/reference.txt");

/// A headless context.
pub fn context() -> HeadlessContext {
    HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"))
}

/// The findings about a text.
pub fn judged(context: &HeadlessContext, text: &str) -> GlProgramFindings {
    check(context.gl(), text, "mine.txt", &exercise_files()).unwrap_or_else(|error| panic!("{error}"))
}

/// The reference with parts of its text replaced; each part must occur exactly once.
pub fn changed(edits: &[(&str, &str)]) -> String {
    let mut text = REFERENCE.to_owned();
    for (old, new) in edits {
        assert_eq!(text.matches(old).count(), 1, "`{old}` must occur once in\n{text}");
        text = text.replace(old, new);
    }
    text
}

/// The number of the only line that contains `needle`.
pub fn line_of(text: &str, needle: &str) -> u32 {
    let mut found = (1..).zip(text.lines()).filter(|(_, line)| line.contains(needle));
    let line = found.next().unwrap_or_else(|| panic!("no line with `{needle}`")).0;
    assert_eq!(found.next(), None, "`{needle}` occurs in several lines");
    line
}

/// Asserts that exactly these mistakes are found, each given by its id and a part of its line.
pub fn assert_mistakes(context: &HeadlessContext, text: &str, mistakes: &[(&str, &str)]) {
    let verdict = judged(context, text);
    assert_eq!(verdict.verdict, gonio_check::verdict::Outcome::Wrong, "{mistakes:?}: {}", verdict.summary);
    let mut expected: Vec<_> = mistakes.iter().map(|(id, needle)| (line_of(text, needle), *id)).collect();
    expected.sort_unstable();
    let found: Vec<_> = verdict.mistakes.iter().map(|m| (m.line, m.id.as_str())).collect();
    assert_eq!(found, expected, "{text}\n{}\n{:#?}\n{:#?}", verdict.summary, verdict.refused, verdict.findings);
}

/// The exercise's GL programs: names without ending, and texts.
pub fn host_programs() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../exercises/ex11-texture-unit/host");
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let read = |entry: std::io::Result<std::fs::DirEntry>| {
        let path = entry.unwrap_or_else(|error| panic!("{folder}: {error}")).path();
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        (path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default(), text)
    };
    entries.map(read).collect()
}
