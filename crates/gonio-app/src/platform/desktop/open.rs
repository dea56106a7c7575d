//! Opens files on disk in a thread: the model among several files, or a student's files; both in folders and zip files.

use super::Access;
use crate::files::{ExerciseFile, Layered, MemoryFiles, zip};
use crate::platform::{Event, Purpose, SceneInput};
use gonio_language::tr;
use gonio_scene::files::{Disk, FileSource, Sandbox};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// Opens files in a thread, because zip files take time.
pub fn in_thread(paths: Vec<String>, purpose: Purpose, access: Access, sender: Sender<Event>, ctx: &egui::Context) {
    let ctx = ctx.clone();
    std::thread::spawn(move || {
        let event = match purpose {
            Purpose::Scene => scene_input(paths, access).map(|input| Event::Open(Box::new(input))),
            Purpose::Exercise => read_exercise_files(&paths).map(Event::ExerciseFiles),
            Purpose::Bench => read_bench_files(&paths).map(Event::BenchFiles),
        };
        let event = event.unwrap_or_else(Event::Failed);
        // The window may be closed by now.
        let _ = sender.send(event);
        ctx.request_repaint();
    });
}

/// Finds the models and the environment among these files. A folder means the files directly in it.
fn scene_input(paths: Vec<String>, access: Access) -> Result<SceneInput, String> {
    let disk: Arc<dyn FileSource> =
        if access.sandbox { Arc::new(Sandbox::new(Disk, paths.iter().map(String::as_str))) } else { Arc::new(Disk) };
    let mut names = Vec::new();
    let mut memory = MemoryFiles::default();
    let mut left = access.max_bytes;
    let paths = paths.into_iter().flat_map(|path| if Path::new(&path).is_dir() { files_in(&path) } else { vec![path] });
    for path in paths {
        let is_zip = Path::new(&path).extension().is_some_and(|e| e.eq_ignore_ascii_case("zip"));
        if !is_zip {
            names.push(path);
            continue;
        }
        let bytes = disk
            .read_within(Path::new(&path), left)
            .map_err(|error| tr!("window-cannot-be-read", folder = path, error = error))?;
        let unpacked = zip::unpack_within(&bytes, &zip::ZipLimits::MODELS.within(left));
        let unpacked = unpacked.map_err(|error| format!("`{path}`: {error}"))?;
        left -= unpacked.total_bytes().min(left);
        memory.add_all(unpacked);
    }
    names.extend(memory.names());
    let files = if memory.is_empty() { disk } else { Arc::new(Layered { first: Arc::new(memory), then: disk }) };
    Ok(SceneInput::gathered(names, files))
}

fn files_in(folder: &str) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .map(|entries| entries.filter_map(|entry| Some(entry.ok()?.path())).collect::<Vec<_>>())
        .unwrap_or_default()
        .into_iter()
        .filter(|path| path.is_file())
        .map(|path| path.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Largest file of an exercise, as for `gonio lab check`.
const MOST_BYTES: u64 = 32 * 1024 * 1024;
/// Most files of an exercise.
const MOST_FILES: usize = 500;
/// Deepest level of folders.
const DEEPEST: usize = 8;

/// Reads a student's files, including those in folders and zip files. An error is one sentence.
fn read_exercise_files(paths: &[String]) -> Result<Vec<ExerciseFile>, String> {
    let mut files = Vec::new();
    for path in paths {
        let path = Path::new(path);
        if path.is_dir() {
            read_folder(path, path, &mut files, 0)?;
        } else {
            read_one(path, &mut files)?;
        }
    }
    match files.len() {
        0 => Err(tr!("window-there-are-no-files-in", places = paths.join(", "))),
        1..=MOST_FILES => Ok(files),
        _ => Err(tr!("window-there-are-more-than-files-in", count = MOST_FILES, places = paths.join(", "))),
    }
}

/// Largest file of the bench: a measured BRDF has 35 MB.
const MOST_BENCH_BYTES: u64 = 64 * 1024 * 1024;

/// Reads files of functions. An error is one sentence.
fn read_bench_files(paths: &[String]) -> Result<Vec<(String, Vec<u8>)>, String> {
    let read = |path: &String| {
        let bytes = Disk.read_within(Path::new(path), MOST_BENCH_BYTES);
        let bytes = bytes.map_err(|error| tr!("window-cannot-be-read", folder = path, error = error))?;
        Ok((path.clone(), bytes.into_vec()))
    };
    paths.iter().map(read).collect()
}

/// Reads a file, or the files in a zip file.
fn read_one(path: &Path, files: &mut Vec<ExerciseFile>) -> Result<(), String> {
    let failed = |error: std::io::Error| tr!("window-cannot-be-read", folder = path.display(), error = error);
    let size = std::fs::metadata(path).map_err(failed)?.len();
    if size > MOST_BYTES {
        return Err(tr!("window-is-too-large-for-an-exercise", path = path.display(), megabytes = size / 1_000_000));
    }
    let bytes = Disk.read_within(path, MOST_BYTES).map_err(failed)?.into_vec();
    if zip::is_zip(&bytes) {
        let unpacked = zip::unpack_within(&bytes, &zip::ZipLimits::SUBMISSION)
            .map_err(|error| format!("`{}`: {error}", path.display()))?;
        for name in unpacked.names() {
            let bytes = unpacked.read(Path::new(&name)).map_err(failed)?.to_vec();
            files.push(ExerciseFile { name, path: None, bytes });
        }
        return Ok(());
    }
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    files.push(ExerciseFile { name, path: Some(std::path::absolute(path).map_err(failed)?), bytes });
    Ok(())
}

/// Reads the files of a folder, in order, except hidden ones, links, which may lead anywhere, and files that are too large.
fn read_folder(top: &Path, folder: &Path, files: &mut Vec<ExerciseFile>, depth: usize) -> Result<(), String> {
    let failed = |error: std::io::Error| tr!("window-cannot-be-read", folder = folder.display(), error = error);
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let is_hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if is_hidden || path.is_symlink() || files.len() > MOST_FILES {
            continue;
        }
        if path.is_dir() {
            if depth < DEEPEST {
                read_folder(top, &path, files, depth + 1)?;
            }
        } else if std::fs::metadata(&path).is_ok_and(|data| data.is_file() && data.len() <= MOST_BYTES) {
            let read = Disk.read_within(&path, MOST_BYTES);
            let bytes =
                read.map_err(|error| tr!("window-cannot-be-read", folder = path.display(), error = error))?.into_vec();
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
    fn the_sandbox_confines_files_to_their_folder() {
        let folder = std::env::temp_dir().join(format!("gonio-opened-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("in")).unwrap();
        let [model, secret] = ["in/m.obj", "secret.mtl"].map(|name| folder.join(name));
        std::fs::write(&model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        std::fs::write(&secret, "newmtl m\n").unwrap();
        let paths = vec![model.to_string_lossy().into_owned()];
        for sandbox in [false, true] {
            let files = scene_input(paths.clone(), Access { max_bytes: 1 << 20, sandbox }).unwrap().files;
            assert!(files.read(&model).is_ok());
            assert_eq!(files.read(&folder.join("in/../secret.mtl")).is_ok(), !sandbox);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn folders_are_read_and_missing_ones_are_errors() {
        let folder = std::env::temp_dir().join(format!("gonio-exercise-files-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("src")).unwrap();
        for (name, text) in [("src/light.frag", "f"), ("a.vert", "v"), (".hidden", "h")] {
            std::fs::write(folder.join(name), text).unwrap();
        }
        let text = |path: &Path| path.to_string_lossy().into_owned();
        let read_all = read_exercise_files(&[text(&folder), text(&folder.join("a.vert"))]).unwrap();
        let names: Vec<&str> = read_all.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["a.vert", "src/light.frag", "a.vert"]);
        assert_eq!(read_all[1].path, Some(folder.join("src/light.frag")));
        assert!(
            read_exercise_files(&[text(&folder.join("none"))])
                .is_err_and(|error| error.contains("none` cannot be read"))
        );
        std::fs::create_dir_all(folder.join("empty")).unwrap();
        assert!(
            read_exercise_files(&[text(&folder.join("empty"))])
                .is_err_and(|error| error.starts_with("there are no files in"))
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
