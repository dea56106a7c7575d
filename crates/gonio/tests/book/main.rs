//! The book in `docs`: its commands run, its links lead somewhere, its pictures and its reference are those of today's program.
//!
//! | file | contents |
//! |---|---|
//! | `pages` | the pages as mdBook reads them: includes, code blocks, links, headings |
//! | `commands` | every command is run, or at least parsed; what the book shows of its output is compared |
//! | `links` | links, anchors, pictures, and the scenes behind pictures |
#![allow(clippy::unwrap_used, missing_docs)]

mod commands;
mod links;
mod pages;

#[path = "../common/mod.rs"]
mod common;

use common::Lab;
use pages::{docs, pages};
use std::collections::BTreeSet;

/// What the failure of a test of generated text says.
const REGENERATE: &str = "run `cargo xtask book` and commit what it writes";

#[test]
fn every_page_is_in_the_summary_once() {
    let summary = std::fs::read_to_string(docs().join("SUMMARY.md")).unwrap();
    let mut listed = BTreeSet::new();
    for line in summary.lines() {
        let Some((_, target)) = line.split_once("](") else { continue };
        let target = target.trim_end_matches(')');
        assert!(listed.insert(target.to_owned()), "SUMMARY.md lists {target} twice");
    }
    let existing: BTreeSet<String> = pages().into_iter().map(|page| page.name).collect();
    assert!(existing.len() > 30, "{existing:?}");
    assert_eq!(listed, existing, "left: in SUMMARY.md; right: in docs");
}

#[test]
fn the_reference_is_what_the_program_writes() {
    let lab = Lab::new();
    lab.run(&["man", "--markdown", "reference"]).good();
    let names = |folder: &std::path::Path| -> BTreeSet<String> {
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    };
    let folder = docs().join("reference");
    assert_eq!(names(&lab.path("reference")), names(&folder), "{REGENERATE}");
    for name in names(&folder) {
        let committed = std::fs::read_to_string(folder.join(&name)).unwrap().replace("\r\n", "\n");
        let written = String::from_utf8(lab.read(&format!("reference/{name}"))).unwrap();
        let differing = committed.lines().zip(written.lines()).find(|(a, b)| a != b);
        assert!(
            committed == written,
            "docs/reference/{name} is not what the program writes, {REGENERATE}: {differing:?}"
        );
    }
}

/// The chapters include the exercises' texts by their lines, around the figure. No line may be lost when a text changes.
#[test]
fn the_chapter_of_an_exercise_has_its_whole_text() {
    let all = pages();
    let mut count = 0;
    for entry in std::fs::read_dir(docs().join("../exercises")).unwrap() {
        let folder = entry.unwrap().path();
        let Ok(text) = std::fs::read_to_string(folder.join("text.md")) else { continue };
        let id = folder.file_name().unwrap().to_str().unwrap().split('-').next().unwrap().to_owned();
        let page = all.iter().find(|page| page.name == format!("exercises/{id}.md"));
        let page = page.unwrap_or_else(|| panic!("there is no docs/exercises/{id}.md"));
        let mut rest = page.text.lines();
        for line in text.lines() {
            // The figure is inserted as SVG.
            if let Some((_, file)) = line.strip_prefix("![").and_then(|figure| figure.split_once("](")) {
                let figure = std::fs::read_to_string(folder.join(file.trim_end_matches(')'))).unwrap();
                let mut lines = figure.lines();
                assert!(rest.any(|l| Some(l) == figure.lines().next()), "{}: {file} is not included", page.name);
                lines.next();
                assert!(lines.all(|l| !l.trim().is_empty()), "{file}: mdBook ends a figure at an empty line");
                continue;
            }
            assert!(rest.any(|l| l == line), "docs/exercises/{id}.md lacks a line of the text: {line}");
        }
        count += 1;
    }
    assert_eq!(count, 14);
}
