//! Reads the submissions of crates/gonio-check/corpus; its README.md explains `expected.toml`.
#![allow(dead_code, reason = "each test uses a part")]

use gonio_check::submission::SourceFile;
use gonio_check::verdict::Verdict;
use gonio_check::{CheckOptions, ShaderChecker, ShaderExercise};
use gonio_fixtures::tables_below;
use std::path::Path;

/// A submission with the expected result.
pub struct Submission {
    /// Table and case: `ex04/wrong/view-space`.
    pub name: String,
    /// The id of the exercise: `ex04`.
    pub exercise: String,
    /// The student's files.
    pub files: Vec<SourceFile>,
    /// The content of `expected.toml`; empty if the case has none.
    pub expected: toml::Table,
}

impl Submission {
    /// Returns the checker's verdict, without pictures.
    pub fn check(&self, checker: &mut ShaderChecker) -> Verdict {
        let exercise = ShaderExercise::new(&self.exercise);
        gonio_check::check(checker, &exercise, self.files.clone(), &CheckOptions::default()).unwrap().0
    }
}

/// Returns all submissions of one sort, `correct` or `wrong`, in order of exercise and name.
pub fn submissions(sort: &str) -> Vec<Submission> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut all = Vec::new();
    for (folder, table) in tables_below(&corpus).unwrap_or_else(|error| panic!("{error}")) {
        if !folder.ends_with(sort) {
            continue;
        }
        let exercise = folder.parent().unwrap().to_str().unwrap();
        for case in table.cases().unwrap_or_else(|error| panic!("{error}")) {
            let name = format!("{exercise}/{sort}/{}", case.name);
            let mut expected = toml::Table::new();
            let mut files = Vec::new();
            for file in case.files {
                if file.path == "expected.toml" {
                    let text = String::from_utf8(file.bytes).unwrap();
                    expected = text.parse().unwrap_or_else(|error| panic!("{name}/expected.toml: {error}"));
                } else {
                    files.push(SourceFile::new(file.path, file.bytes));
                }
            }
            all.push(Submission { name, exercise: exercise.to_owned(), files, expected });
        }
    }
    all.sort_by(|a, b| a.name.cmp(&b.name));
    all
}
