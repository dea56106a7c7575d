#![allow(clippy::unwrap_used)]

use super::*;
use crate::files::{ExerciseFile, MemoryFiles};
use crate::platform::{Event, FileDialog, Purpose};
use crate::saving::Product;
use crate::session::Settings;
use gonio_exercises::exercise;
use gonio_scene::files::FileSource;
use std::path::PathBuf;
use std::sync::Arc;
use web_time::Instant;

/// A platform that keeps drafts in memory, and has nothing else.
#[derive(Default)]
struct Memory {
    drafts: BTreeMap<String, String>,
    written: usize,
    is_full: bool,
}

impl Platform for Memory {
    fn files(&self) -> Arc<dyn FileSource> {
        Arc::new(MemoryFiles::default())
    }
    fn choose_files(&mut self, _: Purpose, _: &Context) -> FileDialog {
        FileDialog::Unavailable
    }
    fn open_paths(&mut self, _: Vec<String>, _: Purpose, _: &Context) {}
    fn choose_place(&mut self, _: Product, _: &str, _: &Context) -> FileDialog {
        FileDialog::Unavailable
    }
    fn poll(&mut self, _: Purpose, _: &Context) -> Vec<Event> {
        Vec::new()
    }
    fn write(&mut self, _: &str, _: &[u8]) -> Result<String, String> {
        Err("nothing is written here".into())
    }
    fn link(&self, _: &str) -> String {
        String::new()
    }
    fn settings(&self) -> Settings {
        Settings::default()
    }
    fn keep(&mut self, _: &Settings) {}
    fn keep_draft(&mut self, key: &str, text: &str) -> Result<(), String> {
        if self.is_full {
            return Err("the disk is full".into());
        }
        self.written += 1;
        self.drafts.insert(key.into(), text.into());
        Ok(())
    }
    fn remove_draft(&mut self, key: &str) {
        self.drafts.remove(key);
    }
    fn take_draft(&mut self, key: &str) -> Option<String> {
        self.drafts.get(key).cloned()
    }
}

fn exercise_file(path: &str, text: &str) -> ExerciseFile {
    let name = path.rsplit('/').next().unwrap().to_owned();
    ExerciseFile { name, path: path.starts_with('/').then(|| PathBuf::from(path)), bytes: text.into() }
}

fn work(files: &[(&str, &str)]) -> Work {
    let files = files.iter().map(|(path, text)| exercise_file(path, text)).collect();
    Work::new(exercise::find("ex04").unwrap(), files)
}

/// The context of a window with or without the focus.
fn window(focused: bool) -> Context {
    let ctx = Context::default();
    let input = egui::RawInput { focused, ..Default::default() };
    ctx.run_ui(input, |_| ()).textures_delta.clear();
    ctx
}

/// The drafts that a window restores into these files, without failures.
fn restored(work: &mut Work, platform: &mut Memory) -> Drafts {
    let mut drafts = Drafts::default();
    assert_eq!(drafts.restore(&Context::default(), work, platform), Vec::<String>::new());
    drafts
}

/// A window in which `text` is typed into a file, and which is then killed.
fn killed(work: &mut Work, file: usize, text: &str, platform: &mut Memory) {
    work.files[file].text = text.into();
    assert_eq!(Drafts::default().flush([&*work].into_iter(), platform), Vec::<String>::new());
}

#[test]
fn unsaved_text_is_restored_as_unsaved() {
    let mut platform = Memory::default();
    let files = [("/a/light.vert", "one"), ("/a/light.frag", "two")];
    killed(&mut work(&files), 1, "typed", &mut platform);
    let mut next = work(&files);
    next.current = 0;
    let drafts = restored(&mut next, &mut platform);
    let file = &next.files[1];
    assert_eq!((file.text.as_str(), file.saved.as_slice(), file.other.as_ref()), ("typed", &b"two"[..], None));
    assert_eq!(file.restored.as_deref(), Some("less than a minute ago"));
    assert!(file.is_restored() && !next.files[0].is_restored());
    assert_eq!((next.current, drafts.count()), (1, 1), "the restored file is shown");
    // Nothing is restored into other exercises, other files or other folders.
    let mut others = work(&[("/b/light.frag", "two"), ("/a/light.vert", "one")]);
    restored(&mut others, &mut platform);
    let mut other = Work::new(exercise::find("ex03").unwrap(), vec![exercise_file("/a/light.frag", "two")]);
    restored(&mut other, &mut platform);
    assert!(!others.is_changed() && !other.is_changed());
}

#[test]
fn a_file_that_changed_on_disk_is_kept_beside_the_draft() {
    let mut platform = Memory::default();
    killed(&mut work(&[("/a/light.frag", "two")]), 0, "typed", &mut platform);
    let mut next = work(&[("/a/light.frag", "of another editor")]);
    restored(&mut next, &mut platform);
    let file = &next.files[0];
    assert_eq!((file.text.as_str(), file.other.as_deref()), ("typed", Some(&b"of another editor"[..])));
}

#[test]
fn saved_and_discarded_text_leaves_no_draft() {
    let mut platform = Memory::default();
    let files = [("/a/light.frag", "two")];
    killed(&mut work(&files), 0, "typed", &mut platform);
    for is_saved in [true, false] {
        let mut next = work(&files);
        let mut drafts = restored(&mut next, &mut platform);
        assert!(next.is_changed() && platform.drafts.len() == 1);
        let file = &mut next.files[0];
        if is_saved {
            file.saved = file.text.clone().into_bytes();
        } else {
            file.take(file.saved.clone());
        }
        drafts.follow(&Context::default(), [&next].into_iter(), &mut platform);
        assert_eq!((platform.drafts.len(), drafts.count()), (0, 0), "saved: {is_saved}");
        killed(&mut work(&files), 0, "typed", &mut platform);
    }
    // A text that another window has saved is not a draft any more.
    restored(&mut work(&[("/a/light.frag", "typed")]), &mut platform);
    assert_eq!(platform.drafts.len(), 0);
}

#[test]
fn files_in_memory_are_distinguished_by_their_content() {
    let mut platform = Memory::default();
    killed(&mut work(&[("light.frag", "of one student")]), 0, "typed", &mut platform);
    let mut other = work(&[("light.frag", "of another student")]);
    restored(&mut other, &mut platform);
    assert!(!other.is_changed());
    let mut same = work(&[("light.frag", "of one student")]);
    restored(&mut same, &mut platform);
    assert_eq!(same.files[0].text, "typed");
}

#[test]
fn drafts_are_written_once_after_typing() {
    let mut platform = Memory::default();
    let mut work = work(&[("/a/light.frag", "two")]);
    let mut drafts = Drafts::default();
    let ctx = window(true);
    drafts.follow(&ctx, [&work].into_iter(), &mut platform);
    assert_eq!((platform.written, drafts.writing.due), (0, None));
    work.files[0].text = "typed".into();
    drafts.follow(&ctx, [&work].into_iter(), &mut platform);
    assert!(platform.written == 0 && drafts.writing.due.is_some(), "it waits for more typing");
    drafts.writing.due = Some(Instant::now());
    for _ in 0..3 {
        drafts.follow(&ctx, [&work].into_iter(), &mut platform);
    }
    assert_eq!((platform.written, drafts.writing.due), (1, None));
}

#[test]
fn a_window_that_loses_the_focus_keeps_its_drafts_at_once() {
    let mut platform = Memory::default();
    let mut work = work(&[("/a/light.frag", "two")]);
    work.files[0].text = "typed".into();
    let mut drafts = Drafts::default();
    drafts.follow(&window(false), [&work].into_iter(), &mut platform);
    assert_eq!(platform.written, 1);
}

#[test]
fn all_unsaved_texts_of_one_file_are_kept() {
    let mut platform = Memory::default();
    let mut work = work(&[("/a/light.frag", "two")]);
    work.files[0].text = "first".into();
    work.take(vec![ExerciseFile { bytes: b"void main() {}".to_vec(), ..exercise_file("/a/light.frag", "") }]);
    assert_eq!((work.files.len(), work.before.len()), (1, 1));
    work.files[0].text = "second".into();
    let mut drafts = Drafts::default();
    drafts.flush([&work].into_iter(), &mut platform);
    let texts: Vec<String> =
        platform.drafts.values().map(|draft| serde_json::from_str::<Draft>(draft).unwrap().text).collect();
    assert_eq!(texts, ["second", "first"]);
}

#[test]
fn a_failure_to_keep_a_draft_is_reported_once_and_retried() {
    let mut platform = Memory { is_full: true, ..Memory::default() };
    let mut work = work(&[("/a/light.frag", "two")]);
    let mut drafts = Drafts::default();
    let ctx = window(true);
    let mut messages = Vec::new();
    let mut follow = |work: &Work, platform: &mut Memory| {
        drafts.writing.due = Some(Instant::now());
        messages.extend(drafts.follow(&ctx, [work].into_iter(), platform));
    };
    work.files[0].text = "typed".into();
    follow(&work, &mut platform);
    follow(&work, &mut platform);
    platform.is_full = false;
    follow(&work, &mut platform);
    assert_eq!(platform.drafts.len(), 1);
    work.files[0].text = "x".repeat(MOST_BYTES + 1);
    follow(&work, &mut platform);
    assert_eq!(
        messages,
        [
            "the unsaved changes to light.frag could not be kept as a draft: the disk is full; Ctrl + S saves the file",
            "the unsaved changes to light.frag could not be kept as a draft: the file is larger than 1 MB; Ctrl + S saves the file"
        ]
    );
    // It is reported again when the window closes.
    assert_eq!(drafts.flush([&work].into_iter(), &mut platform).len(), 1);
}

#[test]
fn damaged_drafts_are_reported_and_old_ones_removed() {
    let mut platform = Memory::default();
    let files = [("/a/light.frag", "two")];
    killed(&mut work(&files), 0, "typed", &mut platform);
    let (key, stored) = platform.drafts.first_key_value().map(|(key, text)| (key.clone(), text.clone())).unwrap();
    let mut old: Draft = serde_json::from_str(&stored).unwrap();
    old.written -= MOST_AGE.as_secs() + 60;
    platform.drafts.insert(key.clone(), serde_json::to_string(&old).unwrap());
    let mut next = work(&files);
    restored(&mut next, &mut platform);
    assert!(!next.is_changed() && platform.drafts.is_empty());
    platform.drafts.insert(key, stored[..10].into());
    let mut next = work(&files);
    let messages = Drafts::default().restore(&Context::default(), &mut next, &mut platform);
    assert!(messages.len() == 1 && messages[0].starts_with("the draft of light.frag is damaged"), "{messages:?}");
    assert!(!next.is_changed());
}

#[test]
fn ages_are_formatted_in_words() {
    for (seconds, words) in [
        (0, "less than a minute ago"),
        (60, "1 minute ago"),
        (3599, "59 minutes ago"),
        (3600, "1 hour ago"),
        (86_399, "23 hours ago"),
        (86_400, "1 day ago"),
        (864_000, "10 days ago"),
    ] {
        assert_eq!(in_words(Duration::from_secs(seconds)), words);
    }
}
