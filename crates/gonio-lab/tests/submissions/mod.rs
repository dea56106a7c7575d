//! The submissions of crates/gonio-lab/corpus, as tests read them: its README.md says what stands in `expected.toml`.

use gonio_lab::check::Checker;
use gonio_lab::submission::SourceFile;
use gonio_lab::verdict::Verdict;
use gonio_lab::{CheckOptions, exercise};
use std::path::{Path, PathBuf};

/// A submission, and what is expected of it.
pub struct Submission {
    /// Its folder below the corpus: `ex04/wrong/view-space`.
    pub name: String,
    /// `ex04`.
    pub exercise: String,
    /// The student's.
    pub files: Vec<SourceFile>,
    /// `expected.toml`; empty where there is none.
    pub expected: toml::Table,
}

impl Submission {
    /// The verdict, without pictures.
    pub fn check(&self, checker: &mut Checker) -> Verdict {
        let exercise = exercise::find(&self.exercise).unwrap();
        gonio_lab::check(checker, exercise, self.files.clone(), &CheckOptions::default()).unwrap().0
    }
}

fn folders(of: &Path) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = std::fs::read_dir(of)
        .unwrap_or_else(|error| panic!("{}: {error}", of.display()))
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .collect();
    folders.sort();
    folders
}

/// All of a kind, in order of exercise and name: `correct` or `wrong`.
pub fn submissions(kind: &str) -> Vec<Submission> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut all = Vec::new();
    for exercise in folders(&top) {
        for folder in folders(&exercise.join(kind)) {
            let mut submission = Submission {
                name: folder.strip_prefix(&top).unwrap().to_string_lossy().into_owned(),
                exercise: exercise.file_name().unwrap().to_string_lossy().into_owned(),
                files: Vec::new(),
                expected: toml::Table::new(),
            };
            for entry in std::fs::read_dir(&folder).unwrap() {
                let path = entry.unwrap().path();
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                match name.as_str() {
                    "expected.toml" => submission.expected = std::fs::read_to_string(&path).unwrap().parse().unwrap(),
                    _ => submission.files.push(SourceFile::new(name, std::fs::read(&path).unwrap())),
                }
            }
            all.push(submission);
        }
    }
    all
}
