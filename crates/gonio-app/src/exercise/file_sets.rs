//! Sets of files: a student's files replace the open ones, which are kept and can be put back.

use super::work::{OpenFile, Work};
use crate::files::ExerciseFile;
use gonio_check::submission::SourceFile;
use gonio_exercises::preview::{self, FileUse};
use gonio_language::tr;

/// Files that were open together.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenFileSet {
    /// The files with their edits.
    pub files: Vec<OpenFile>,
    /// The file in the editor.
    pub current: usize,
}

/// Result of opening a student's files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReplaceOutcome {
    /// The opened files, for screen readers; `None` if nothing was opened.
    pub announcement: Option<String>,
    /// The reason why some files were ignored, in one sentence.
    pub ignored: Option<String>,
}

impl Work {
    /// Opens files in place of those with the same use: see [`preview::sort_files`].
    pub fn take(&mut self, opened: Vec<ExerciseFile>) -> ReplaceOutcome {
        let sources: Vec<SourceFile> =
            opened.iter().map(|file| SourceFile::new(file.name.clone(), file.bytes.clone())).collect();
        let sorted = preview::sort_files(self.exercise, &sources);
        let taken: Vec<(&SourceFile, FileUse)> =
            sorted.taken.iter().filter_map(|(index, of_file)| Some((sources.get(*index)?, *of_file))).collect();
        if taken.is_empty() {
            return ReplaceOutcome { announcement: None, ignored: sorted.aside };
        }
        let is_open = |file: &ExerciseFile| self.files.iter().position(|open| open.is_same(file));
        let all: Option<Vec<usize>> =
            sorted.taken.iter().map(|(index, _)| opened.get(*index).and_then(is_open)).collect();
        let names: Vec<&str> = taken.iter().map(|(file, _)| file.name.as_str()).collect();
        if let Some(&first) = all.as_ref().and_then(|all| all.first()) {
            // The files are open already.
            self.current = first;
            return ReplaceOutcome {
                announcement: Some(tr!("exercise-opened", names = listed(&names))),
                ignored: sorted.aside,
            };
        }
        let mut kept = Vec::new();
        let mut away = Vec::new();
        let open: Vec<&str> = self.files.iter().map(|file| file.name.as_str()).collect();
        for file in &self.files {
            let source = SourceFile::new(file.name.clone(), file.content());
            if preview::is_replaced(self.exercise, &source, &taken, &open) { &mut away } else { &mut kept }
                .push(file.clone());
        }
        let others: Vec<&str> = away.iter().map(|file| file.name.as_str()).collect();
        let announcement = if others.is_empty() {
            tr!("exercise-opened", names = listed(&names))
        } else {
            tr!("exercise-opened-in-place", names = listed(&names), others = listed(&others))
        };
        let uses: Vec<FileUse> = taken.iter().map(|(_, of_file)| *of_file).collect();
        let numbers: Vec<usize> = sorted.taken.iter().map(|(index, _)| *index).collect();
        self.sets += 1;
        let first_new = kept.len();
        let mut files = kept;
        for (index, file) in opened.into_iter().enumerate().filter(|(index, _)| numbers.contains(index)) {
            files.push(OpenFile::new(self.exercise, file, (self.sets, index)).shown());
        }
        // Students mostly edit the fragment shader.
        let fragment = uses.iter().position(|of_file| of_file.fragment).unwrap_or(0);
        self.replace(OpenFileSet { files, current: first_new + fragment });
        ReplaceOutcome { announcement: Some(announcement), ignored: sorted.aside }
    }

    /// Starts over with the original files.
    pub fn begin_again(&mut self) {
        self.sets += 1;
        let mut files = Work::start_files(self.exercise, self.sets);
        // Drafts are not restored when starting over.
        files.iter_mut().for_each(|file| file.draft_was_checked = true);
        let current = Work::first_shown(self.exercise, &files);
        self.replace(OpenFileSet { files, current });
    }

    /// Puts back the files that were open before these, which are kept in turn.
    pub fn put_back(&mut self) {
        let Some(set) = self.before.pop() else { return };
        let now = self.exchange(set);
        self.before.insert(0, now);
    }

    /// Whether files that were open before have unsaved changes.
    pub fn has_unsaved_before(&self) -> bool {
        self.before.iter().any(|set| set.files.iter().any(OpenFile::is_changed))
    }

    fn replace(&mut self, set: OpenFileSet) {
        let now = self.exchange(set);
        // Each set is kept once.
        self.before.retain(|set| set.files != now.files);
        self.before.push(now);
    }

    fn exchange(&mut self, set: OpenFileSet) -> OpenFileSet {
        let files = std::mem::replace(&mut self.files, set.files);
        let current = std::mem::replace(&mut self.current, set.current);
        self.jump = None;
        OpenFileSet { files, current }
    }
}

impl OpenFileSet {
    /// Names of its files that are not in `files`.
    pub fn names_beside(&self, files: &[OpenFile]) -> String {
        let is_there = |file: &OpenFile| files.iter().any(|other| other.id() == file.id());
        listed(&self.files.iter().filter(|file| !is_there(file)).map(|file| file.name.as_str()).collect::<Vec<_>>())
    }
}

/// Most names in an enumeration.
const MOST: usize = 4;

/// Names as an enumeration.
pub(super) fn listed(names: &[&str]) -> String {
    match names {
        [] => tr!("exercise-nothing").to_owned(),
        [one] => (*one).to_owned(),
        [first @ .., last] if names.len() <= MOST => tr!("exercise-and", names = first.join(", "), last = last),
        several => {
            let first: Vec<&str> = several.iter().take(MOST - 1).copied().collect();
            tr!("exercise-and-more", names = first.join(", "), count = several.len() - first.len())
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_exercises::exercise;

    const FRAGMENT: &str = "out vec4 FragColor;\nvoid main() { FragColor = vec4(1.0); }\n";

    fn exercise_file(name: &str, text: &str) -> ExerciseFile {
        ExerciseFile { name: name.into(), path: None, bytes: text.into() }
    }

    fn shown(work: &Work) -> Vec<&str> {
        work.files.iter().filter(|file| file.is_shown()).map(|file| file.name.as_str()).collect()
    }

    #[test]
    fn replaced_files_can_be_put_back_in_turn() {
        let mut work = Work::new(exercise::find("ex04").unwrap(), Vec::new());
        work.files[work.current].text = "what I wrote".into();
        let taken = work.take(vec![exercise_file("light.txt", FRAGMENT), exercise_file("notes.txt", "to do")]);
        assert_eq!(taken.announcement.as_deref(), Some("opened light.txt in place of start.frag"));
        assert!(taken.ignored.unwrap().contains("no shader in notes.txt"));
        assert_eq!((shown(&work), work.current), (vec!["start.vert", "light.txt"], work.files.len() - 1));
        assert!(!work.is_changed() && work.has_unsaved_before());
        assert_eq!(work.before[0].names_beside(&work.files), "start.frag");
        work.files[work.current].text = "more".into();
        work.take(vec![exercise_file("start.frag", FRAGMENT)]);
        // Two sets before this one: each comes, and then this one again.
        let mut seen = Vec::new();
        for _ in 0..3 {
            work.put_back();
            seen.push(work.files[work.current].text.clone());
        }
        assert_eq!(seen, ["more", "what I wrote", FRAGMENT]);
        assert_eq!(work.before.len(), 2);
    }

    #[test]
    fn opening_an_open_file_shows_it() {
        let mut work = Work::new(exercise::find("ex04").unwrap(), Vec::new());
        let vertex = work.file_named("start.vert").unwrap();
        let same = exercise_file("start.vert", &work.files[vertex].text);
        assert_eq!(work.take(vec![same]).announcement.as_deref(), Some("opened start.vert"));
        assert_eq!((work.current, work.before.len()), (vertex, 0));
    }

    #[test]
    fn files_of_no_use_to_the_exercise_change_nothing() {
        let mut work = Work::new(exercise::find("ex04").unwrap(), Vec::new());
        let before = work.files.clone();
        let taken = work.take(vec![exercise_file("photo.png", "PNG\0")]);
        assert_eq!(taken.announcement, None);
        assert!(taken.ignored.unwrap().contains("ex04 does not read photo.png"));
        assert!(work.files == before && work.before.is_empty());
    }

    #[test]
    fn starting_over_keeps_the_previous_files() {
        let mut work = Work::new(exercise::find("ex03").unwrap(), Vec::new());
        let text = work.files[work.current].text.clone();
        work.files[work.current].text = "mine".into();
        let id = work.files[work.current].id();
        work.begin_again();
        assert_eq!(work.files[work.current].text, text);
        assert_ne!(work.files[work.current].id(), id, "its undo is its own");
        work.put_back();
        assert_eq!((work.files[work.current].text.as_str(), work.files[work.current].id()), ("mine", id));
    }

    #[test]
    fn names_are_listed_with_commas_and_and() {
        for (names, text) in [
            (&["a"][..], "a"),
            (&["a", "b"], "a and b"),
            (&["a", "b", "c", "d"], "a, b, c and d"),
            (&["a", "b", "c", "d", "e"], "a, b, c and 2 more"),
        ] {
            assert_eq!(listed(names), text);
        }
    }
}
