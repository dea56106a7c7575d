//! A student's files on disk, including those in folders and zip files.

use crate::files::ExerciseFile;
use crate::files::zip;
use gonio_scene::files::{Disk, FileSource};
use std::path::Path;

/// Largest file of an exercise, as for `gonio lab check`.
const MOST_BYTES: u64 = 32 * 1024 * 1024;
/// Most files of an exercise.
const MOST_FILES: usize = 500;
/// Folders within folders.
const DEEPEST: usize = 8;

/// Reads them. An error is one sentence.
pub fn read(paths: &[String]) -> Result<Vec<ExerciseFile>, String> {
    let mut files = Vec::new();
    for path in paths {
        let path = Path::new(path);
        if path.is_dir() {
            within(path, path, &mut files, 0)?;
        } else {
            one(path, &mut files)?;
        }
    }
    match files.len() {
        0 => Err(format!("there are no files in {}", paths.join(", "))),
        1..=MOST_FILES => Ok(files),
        _ => Err(format!(
            "there are more than {MOST_FILES} files in {}: open only those of the exercise",
            paths.join(", ")
        )),
    }
}

/// A file, or what a zip holds.
fn one(path: &Path, files: &mut Vec<ExerciseFile>) -> Result<(), String> {
    let told = |why: std::io::Error| format!("`{}` cannot be read: {why}", path.display());
    let size = std::fs::metadata(path).map_err(told)?.len();
    if size > MOST_BYTES {
        return Err(format!("`{}` is too large for an exercise: {} MB", path.display(), size / 1_000_000));
    }
    let bytes = Disk.read_within(path, MOST_BYTES).map_err(told)?.into_vec();
    if zip::is_zip(&bytes) {
        let unpacked = zip::unpack_within(&bytes, &zip::Limits::SUBMISSION)
            .map_err(|why| format!("`{}`: {why}", path.display()))?;
        for name in unpacked.names() {
            let bytes = unpacked.read(Path::new(&name)).map_err(told)?.to_vec();
            files.push(ExerciseFile { name, path: None, bytes });
        }
        return Ok(());
    }
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    files.push(ExerciseFile { name, path: Some(std::path::absolute(path).map_err(told)?), bytes });
    Ok(())
}

/// The files of a folder, in order, but for hidden ones, for links, which may lead anywhere, and for those too large.
fn within(top: &Path, folder: &Path, files: &mut Vec<ExerciseFile>, depth: usize) -> Result<(), String> {
    let told = |why: std::io::Error| format!("`{}` cannot be read: {why}", folder.display());
    let entries = std::fs::read_dir(folder).map_err(told)?;
    let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let is_hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if is_hidden || path.is_symlink() || files.len() > MOST_FILES {
            continue;
        }
        if path.is_dir() {
            if depth < DEEPEST {
                within(top, &path, files, depth + 1)?;
            }
        } else if std::fs::metadata(&path).is_ok_and(|data| data.is_file() && data.len() <= MOST_BYTES) {
            let read = Disk.read_within(&path, MOST_BYTES);
            let bytes = read.map_err(|why| format!("`{}` cannot be read: {why}", path.display()))?.into_vec();
            let name = path.strip_prefix(top).unwrap_or(&path).to_string_lossy().into_owned();
            files.push(ExerciseFile { name, path: Some(std::path::absolute(&path).unwrap_or(path)), bytes });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn folders_are_read_with_what_is_in_them_and_what_is_not_there_is_said() {
        let folder = std::env::temp_dir().join(format!("gonio-handed-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("src")).unwrap();
        for (name, text) in [("src/light.frag", "f"), ("a.vert", "v"), (".hidden", "h")] {
            std::fs::write(folder.join(name), text).unwrap();
        }
        let text = |path: &Path| path.to_string_lossy().into_owned();
        let read_all = read(&[text(&folder), text(&folder.join("a.vert"))]).unwrap();
        let names: Vec<&str> = read_all.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["a.vert", "src/light.frag", "a.vert"]);
        assert_eq!(read_all[1].path, Some(folder.join("src/light.frag")));
        assert!(read(&[text(&folder.join("none"))]).is_err_and(|why| why.contains("none` cannot be read")));
        std::fs::create_dir_all(folder.join("empty")).unwrap();
        assert!(read(&[text(&folder.join("empty"))]).is_err_and(|why| why.starts_with("there are no files in")));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
