//! Inserts the files that a shader includes. GLSL has no `#include`; engines and loaders insert the text.

use super::error::IntakeError;
use super::text::{Builder, LARGEST, StageText};

/// Most levels of inclusion.
const MOST_LEVELS: u32 = 16;

/// Returns the name in an `#include` line, in quotes or angle brackets.
fn included(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("include")?.trim();
    let (open, close) = match rest.chars().next()? {
        '"' => ('"', '"'),
        '<' => ('<', '>'),
        _ => return None,
    };
    rest.strip_prefix(open)?.split_once(close).map(|(name, _)| name.trim())
}

fn base_name(name: &str) -> String {
    name.rsplit(['/', '\\']).next().unwrap_or_default().to_lowercase()
}

/// Replaces each `#include` line by the text of that file, found by its name without folders among `files` (names and
/// texts). Each file is inserted once. Also returns the names of the inserted files.
///
/// # Errors
/// Returns an [`IntakeError`] if a file is not among them, or the text becomes too large.
pub(super) fn insert(text: StageText, files: &[(String, String)]) -> Result<(StageText, Vec<String>), IntakeError> {
    if !text.text.lines().any(|line| included(line).is_some()) {
        return Ok((text, Vec::new()));
    }
    let mut inserting = Inserting { files, found: Builder::new(), inserted: Vec::new() };
    let own = text.file.clone();
    inserting.take(&text, 0, 0)?;
    let Inserting { found, inserted, .. } = inserting;
    Ok((found.finish_with(&own, inserted.clone()), inserted))
}

struct Inserting<'a> {
    files: &'a [(String, String)],
    found: Builder,
    /// The names of the files that were inserted.
    inserted: Vec<String>,
}

impl Inserting<'_> {
    /// Appends a text; `source` is 0 for the stage's own file, else one more than the index in `inserted`.
    fn take(&mut self, text: &StageText, source: usize, level: u32) -> Result<(), IntakeError> {
        for (line, number) in text.text.lines().zip(1..) {
            self.found.source = source;
            let Some(name) = included(line) else {
                let (_, file_line, _) = text.place(number, 1);
                self.found.push_line(line, file_line);
                if self.found.text.len() > LARGEST {
                    return Err(IntakeError::TooLarge { file: text.file.clone(), bytes: self.found.text.len() });
                }
                continue;
            };
            let wanted = base_name(name);
            let missing = || {
                let line = text.place(number, 1).1;
                IntakeError::MissingInclude { file: text.file.clone(), line, included: name.to_owned() }
            };
            let (file, inner) = self.files.iter().find(|(file, _)| base_name(file) == wanted).ok_or_else(missing)?;
            if level >= MOST_LEVELS {
                return Err(missing());
            }
            if !self.inserted.contains(file) && *file != text.file {
                self.inserted.push(file.clone());
                let source = self.inserted.len();
                self.take(&StageText::whole(file, inner.clone()), source, level + 1)?;
            }
        }
        Ok(())
    }
}
