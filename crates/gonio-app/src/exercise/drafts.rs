//! Drafts: unsaved text, kept for the next window.
//!
//! A draft belongs to one file of one exercise. It is written at most a second after the first change, and at once when the
//! window loses the focus or closes; it is removed when the file is saved or the text is discarded. A draft is never written
//! into the student's file: the next window puts it into the editor, as text that is not saved yet.

use super::editor;
use super::work::{OpenFile, Work};
use crate::drafting::{DraftWriting, fingerprint, hexadecimal, in_words, now};
use crate::platform::Platform;
use egui::Context;
use gonio_language::tr;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// Longer texts are not kept, which is reported.
const MOST_BYTES: usize = 1024 * 1024;
/// Drafts that are older are not restored, and are removed.
pub const MOST_AGE: Duration = Duration::from_secs(90 * 24 * 60 * 60);

/// A draft as it is stored.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Draft {
    exercise: String,
    /// The file's name in the exercise.
    file: String,
    /// [`fingerprint`] of the file that the text was based on, as hexadecimal digits.
    base: String,
    /// Seconds since 1970.
    written: u64,
    text: String,
}

/// The drafts of this window.
#[derive(Default)]
pub struct Drafts {
    /// The last kept text by key.
    kept: BTreeMap<String, String>,
    writing: DraftWriting,
}

impl Drafts {
    /// Number of drafts.
    pub fn count(&self) -> usize {
        self.kept.len()
    }

    /// Restores drafts of earlier windows into files that were just opened. Returns a sentence for each failure.
    pub fn restore(&mut self, ctx: &Context, work: &mut Work, platform: &mut dyn Platform) -> Vec<String> {
        let mut failures = Vec::new();
        let mut first = None;
        let exercise = &work.exercise.id;
        for (index, file) in work.files.iter_mut().enumerate().filter(|(_, file)| !file.locked) {
            if std::mem::replace(&mut file.draft_was_checked, true) {
                continue;
            }
            let key = key(exercise, file);
            // This window has a text under this key, in another set of files.
            if self.kept.contains_key(&key) {
                continue;
            }
            let Some(stored) = platform.take_draft(&key) else { continue };
            let draft: Draft = match serde_json::from_str(&stored) {
                Ok(draft) => draft,
                Err(error) => {
                    failures.push(tr!("exercise-the-draft-of-is-damaged-and", name = file.name, error = error));
                    continue;
                }
            };
            let age = Duration::from_secs(now().saturating_sub(draft.written));
            if draft.text == file.text || age > MOST_AGE {
                platform.remove_draft(&key);
                continue;
            }
            self.kept.insert(key, draft.text.clone());
            // Undo leads back to the saved text.
            editor::remember(ctx, file);
            file.text = draft.text;
            file.restored = Some(in_words(age));
            if file.path.is_some() && draft.base != hexadecimal(fingerprint(&file.saved)) {
                file.other = Some(file.saved.clone());
            }
            first.get_or_insert(index);
        }
        let is_restored = |file: &OpenFile| file.restored.is_some();
        if let Some(first) = first.filter(|_| !work.files.get(work.current).is_some_and(is_restored)) {
            work.current = first;
        }
        failures
    }

    /// Removes drafts of saved or discarded texts, and keeps changed texts after a moment; called in every frame.
    pub fn follow<'a>(
        &mut self,
        ctx: &Context,
        works: impl Iterator<Item = &'a Work>,
        platform: &mut dyn Platform,
    ) -> Vec<String> {
        let unsaved = unsaved(works);
        self.forget(&unsaved, platform);
        if !self.is_behind(&unsaved) {
            self.writing.rest();
            return Vec::new();
        }
        if !self.writing.is_due(ctx) {
            return Vec::new();
        }
        let failures = self.write(&unsaved, platform);
        if self.writing.is_news(failures.first()) { failures } else { Vec::new() }
    }

    /// Keeps all unsaved text now, because the window closes. Returns a sentence for each text that could not be kept.
    pub fn flush<'a>(&mut self, works: impl Iterator<Item = &'a Work>, platform: &mut dyn Platform) -> Vec<String> {
        let unsaved = unsaved(works);
        self.forget(&unsaved, platform);
        self.write(&unsaved, platform)
    }

    fn is_behind(&self, unsaved: &[Unsaved<'_>]) -> bool {
        unsaved.iter().any(|unsaved| self.kept.get(&unsaved.key) != Some(&unsaved.file.text))
    }

    fn forget(&mut self, unsaved: &[Unsaved<'_>], platform: &mut dyn Platform) {
        self.kept.retain(|key, _| {
            let stays = unsaved.iter().any(|unsaved| unsaved.key == *key);
            if !stays {
                platform.remove_draft(key);
            }
            stays
        });
    }

    fn write(&mut self, unsaved: &[Unsaved<'_>], platform: &mut dyn Platform) -> Vec<String> {
        self.writing.rest();
        let mut failures = Vec::new();
        for Unsaved { key, exercise, file } in unsaved {
            if self.kept.get(key) == Some(&file.text) {
                continue;
            }
            match keep(key, exercise, file, platform) {
                Ok(()) => {
                    self.kept.insert(key.clone(), file.text.clone());
                }
                Err(error) => {
                    failures.push(tr!("exercise-the-unsaved-changes-to-could-not", name = file.name, error = error))
                }
            }
        }
        failures
    }
}

/// A file with text that was not saved.
struct Unsaved<'a> {
    key: String,
    exercise: &'a str,
    file: &'a OpenFile,
}

/// All unsaved files. A file that was opened several times may have several texts; the open ones come first.
fn unsaved<'a>(works: impl Iterator<Item = &'a Work>) -> Vec<Unsaved<'a>> {
    let mut found: Vec<Unsaved<'a>> = Vec::new();
    for work in works {
        let before = work.before.iter().rev().flat_map(|set| &set.files);
        for file in work.files.iter().chain(before).filter(|file| file.is_changed()) {
            // A file may be in several sets.
            if found.iter().any(|known| known.file.id() == file.id()) {
                continue;
            }
            let first = key(&work.exercise.id, file);
            let numbered = |number: usize| if number == 1 { first.clone() } else { format!("{first}-{number}") };
            let is_free = |key: &String| found.iter().all(|known| known.key != *key);
            if let Some(key) = (1..).map(numbered).find(is_free) {
                found.push(Unsaved { key, exercise: &work.exercise.id, file });
            }
        }
    }
    found
}

fn keep(key: &str, exercise: &str, file: &OpenFile, platform: &mut dyn Platform) -> Result<(), String> {
    if file.text.len() > MOST_BYTES {
        return Err(tr!("exercise-the-file-is-larger-than-mb", megabytes = MOST_BYTES / (1024 * 1024)));
    }
    let draft = Draft {
        exercise: exercise.to_owned(),
        file: file.name.clone(),
        base: hexadecimal(fingerprint(&file.saved)),
        written: now(),
        text: file.text.clone(),
    };
    let text = serde_json::to_string(&draft).map_err(|error| error.to_string())?;
    platform.keep_draft(key, &text)
}

/// The key of a file's draft. It depends on the exercise and the path on disk; for files in memory, on the name and the
/// content that they were opened with.
fn key(exercise: &str, file: &OpenFile) -> String {
    let mut bytes = exercise.as_bytes().to_vec();
    bytes.push(0);
    match &file.path {
        Some(path) => bytes.extend(path.to_string_lossy().as_bytes()),
        None => {
            bytes.extend(file.name.as_bytes());
            bytes.push(0);
            bytes.extend(fingerprint(&file.saved).to_le_bytes());
        }
    }
    hexadecimal(fingerprint(&bytes))
}

#[cfg(test)]
#[path = "drafts_tests.rs"]
mod tests;
