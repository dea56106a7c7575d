//! `gonio course`, and `gonio lab` with a teacher's own exercises.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;
#[path = "courses/exercises.rs"]
mod exercises;
#[path = "courses/graders.rs"]
mod graders;
#[path = "courses/secrecy.rs"]
mod secrecy;
#[path = "courses/verification.rs"]
mod verification;

use common::Lab;
use std::path::Path;

/// A folder with the course `course`, whose exercise is about rim light and is judged by its own reference.
fn rim_light() -> Lab {
    let lab = Lab::new();
    lab.run(&["course", "new", "course", "--from", "reference", "--language", "en"]).good();
    lab
}

/// A folder with the course `course`, whose exercise is a copy of ex07.
fn light_equation() -> Lab {
    let lab = Lab::new();
    lab.run(&["course", "new", "course", "--language", "en"]).good();
    lab
}

/// Hands in the reference of an exercise of `course`, with a piece of one of its shaders replaced, which has to be there.
fn hand_in(lab: &Lab, exercise: &str, folder: &str, changes: &[(&str, &str, &str)]) {
    std::fs::create_dir_all(lab.path(folder)).unwrap();
    for name in ["reference.vert", "reference.frag"] {
        let mut text = read(lab, &format!("course/{exercise}/{name}"));
        for (_, from, to) in changes.iter().filter(|(file, ..)| *file == name) {
            assert!(text.contains(from), "`{from}` is not in {text}");
            text = text.replace(from, to);
        }
        let own = name.replace("reference", "mine");
        lab.write(&format!("{folder}/{own}"), text);
    }
}

fn read(lab: &Lab, name: &str) -> String {
    String::from_utf8(lab.read(name)).unwrap()
}

/// Replaces a piece of a file, which has to be there.
fn edit(lab: &Lab, name: &str, from: &str, to: &str) {
    let text = read(lab, name);
    assert!(text.contains(from), "`{from}` is not in {text}");
    lab.write(name, text.replace(from, to));
}

/// All files below a folder: paths from it, and bytes.
fn all_files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, Vec<u8>)>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{prefix}{}", entry.file_name().into_string().unwrap());
            if entry.path().is_dir() {
                collect(&entry.path(), &format!("{name}/"), files);
            } else {
                files.push((name, std::fs::read(entry.path()).unwrap()));
            }
        }
    }
    let mut files = Vec::new();
    collect(folder, "", &mut files);
    files.sort();
    files
}
