//! Checks a class of submissions on the disk with the program itself. Whatever the class contains, the program ends with one
//! of its exit codes, writes nothing into the submissions, and accounts for every entry.
//!
//! The input is text. A line `@@ file NAME` begins a file, `@@ zip NAME` a zip of the entries up to `@@ end`, `@@ link NAME`
//! a link to the next line, `@@ pipe NAME` a pipe, `@@ sparse NAME` a large file without content. Names may have folders.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::collections::BTreeSet;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};

/// The number of submissions that one input may have: each takes a process.
const MOST_ENTRIES: usize = 12;

fuzz_target!(|data: &[u8]| {
    let Ok(place) = tempfile::tempdir() else { return };
    let class = place.path().join("class");
    if std::fs::create_dir(&class).is_err() {
        return;
    }
    for (kind, name, content) in entries(data).into_iter().take(MOST_ENTRIES) {
        write(&class, kind, name, content);
    }
    let before = listing(&class);
    let program = std::env::var_os("GONIO_PROGRAM").expect("GONIO_PROGRAM names the program to run");
    let mut command = Command::new(program);
    command.args(["lab", "check", "ex07", "class", "-o", "results", "--patience", "10", "--json"]);
    let output = command.current_dir(place.path()).stdin(Stdio::null()).output().expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.signal(), None, "{stderr}");
    assert!(
        matches!(output.status.code(), Some(0..=2)) && !stderr.contains("panicked"),
        "{:?}: {stderr}",
        output.status
    );
    assert_eq!(listing(&class), before, "the submissions were changed");
    let beside: BTreeSet<_> = names(place.path()).into_iter().collect();
    assert!(beside.iter().all(|name| name == "class" || name == "results"), "{beside:?}");
    if output.status.code() == Some(2) {
        return;
    }
    let rows: Vec<serde_json::Value> = serde_json::from_slice(&output.stdout).expect("an array of rows");
    let labels: BTreeSet<String> = rows.iter().map(|row| row["submission"].to_string().to_lowercase()).collect();
    assert_eq!(labels.len(), rows.len(), "labels differ");
    let pages = names(&place.path().join("results")).iter().filter(|name| name.as_bytes().ends_with(b".html")).count();
    assert_eq!(pages, rows.len() + 1, "a page for each, and the overview");
});

type Entry<'a> = (&'a [u8], &'a [u8], Vec<u8>);

/// Returns kind, name and content of each entry; the content of a zip is the archive.
fn entries(data: &[u8]) -> Vec<Entry<'_>> {
    let mut found: Vec<Entry> = Vec::new();
    let mut zip: Option<(&[u8], Vec<(&[u8], Vec<u8>)>)> = None;
    for line in data.split_inclusive(|byte| *byte == b'\n') {
        let head = line.strip_prefix(b"@@ ").map(<[u8]>::trim_ascii_end);
        let Some(head) = head else {
            let content = match &mut zip {
                Some((_, files)) => files.last_mut().map(|(_, content)| content),
                None => found.last_mut().map(|(.., content)| content),
            };
            content.into_iter().for_each(|content| content.extend(line));
            continue;
        };
        let at = head.iter().position(|byte| *byte == b' ').unwrap_or(head.len());
        let (kind, name) = (&head[..at], head.get(at + 1..).unwrap_or_default());
        match (kind, &mut zip) {
            (b"zip", None) => zip = Some((name, Vec::new())),
            (b"end", Some(_)) => {
                let Some((name, files)) = zip.take() else { continue };
                found.push((b"file", name, packed(&files)));
            }
            (_, Some((_, files))) => files.push((name, Vec::new())),
            (kind, None) => found.push((kind, name, Vec::new())),
        }
    }
    found
}

fn write(class: &Path, kind: &[u8], name: &[u8], content: Vec<u8>) {
    let name = Path::new(std::ffi::OsStr::from_bytes(name));
    if name.components().next().is_none() || name.components().any(|part| !matches!(part, Component::Normal(_))) {
        return;
    }
    // Never write through a link, which may lead anywhere, or into a pipe without a reader.
    let path = class.join(name);
    let above = path.ancestors().skip(1).take_while(|above| above.starts_with(class));
    let is_in_the_way = |above: &Path| std::fs::symlink_metadata(above).is_ok_and(|there| !there.is_dir());
    if std::fs::symlink_metadata(&path).is_ok() || above.into_iter().any(is_in_the_way) {
        return;
    }
    // Entries that the file system rejects are skipped.
    let _ = path.parent().map(std::fs::create_dir_all);
    let _ = match kind {
        b"link" => {
            let target = content.split(|byte| *byte == b'\n').next().unwrap_or_default();
            std::os::unix::fs::symlink(std::ffi::OsStr::from_bytes(target), path)
        }
        b"pipe" => Command::new("mkfifo").arg("--").arg(path).stderr(Stdio::null()).status().map(drop),
        b"sparse" => std::fs::File::create(path).and_then(|file| file.set_len(4 << 30)),
        _ => std::fs::write(path, content),
    };
}

/// Returns a zip of these files, uncompressed. The stated size of a content that ends with `!` is one byte too small.
fn packed(files: &[(&[u8], Vec<u8>)]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let claimed = content.len() - usize::from(content.ends_with(b"!\n"));
        let mut common = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        common.extend((content.len() as u32).to_le_bytes());
        common.extend((claimed as u32).to_le_bytes());
        common.extend((name.len() as u16).to_le_bytes());
        let local = zip.len() as u32;
        zip.extend([b"PK\x03\x04".as_slice(), &common, &[0, 0], name, content].concat());
        directory.extend([b"PK\x01\x02\x14\0".as_slice(), &common, &[0; 12], &local.to_le_bytes(), name].concat());
    }
    let (at, size) = (zip.len() as u32, directory.len() as u32);
    let count = (files.len() as u16).to_le_bytes();
    zip.extend(directory);
    zip.extend(
        [b"PK\x05\x06\0\0\0\0".as_slice(), &count, &count, &size.to_le_bytes(), &at.to_le_bytes(), &[0, 0]].concat(),
    );
    zip
}

/// Returns everything below a folder, with sizes and modification times.
fn listing(folder: &Path) -> Vec<(PathBuf, u64, Option<std::time::SystemTime>)> {
    let mut found = Vec::new();
    for name in names(folder) {
        let path = folder.join(name);
        let Ok(metadata) = std::fs::symlink_metadata(&path) else { continue };
        found.push((path.clone(), metadata.len(), metadata.modified().ok()));
        if metadata.is_dir() {
            found.extend(listing(&path));
        }
    }
    found
}

fn names(folder: &Path) -> Vec<std::ffi::OsString> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.file_name())).collect();
    names.sort();
    names
}
