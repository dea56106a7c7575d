//! Submissions on disk: files, folders, zips, and folders full of those.

use crate::report::{CliError, io_reason};
use gonio_app::files::zip;
use gonio_lab::submission::SourceFile;
use gonio_scene::files::FileSource;
use std::path::{Path, PathBuf};

/// Files larger than this are no shaders.
const MOST_BYTES: u64 = 32 * 1024 * 1024;
/// More files than this are no submission.
const MOST_FILES: usize = 2000;
/// Folders within folders.
const DEEPEST: usize = 8;

/// The files, and those in folders and zips.
pub fn read(paths: &[PathBuf]) -> Result<Vec<SourceFile>, CliError> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            read_folder(path, path, &mut files, 0)?;
            continue;
        }
        let content = bytes(path)?;
        if zip::is_zip(&content) {
            let unpacked = zip::unpack(&content).map_err(|why| CliError::new(format!("{}: {why}", path.display())))?;
            for name in unpacked.names().into_iter().take(MOST_FILES) {
                if let Ok(content) = unpacked.read(Path::new(&name)) {
                    files.push(SourceFile { name, bytes: content.to_vec() });
                }
            }
        } else {
            files.push(SourceFile { name: path.to_string_lossy().into_owned(), bytes: content });
        }
    }
    Ok(files)
}

/// The submissions in a folder of submissions; `None` where it is one itself: where files lie in it that are no zips.
pub fn submissions(folder: &Path) -> Result<Option<Vec<PathBuf>>, CliError> {
    if !folder.is_dir() {
        return Ok(None);
    }
    let is_zip = |path: &PathBuf| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("zip"));
    let entries = entries(folder)?;
    if entries.is_empty() || !entries.iter().all(|path| path.is_dir() || is_zip(path)) {
        return Ok(None);
    }
    Ok(Some(entries))
}

/// What is in a folder, in order, without what is hidden and without links, which may lead anywhere, also back to here.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, CliError> {
    let failed = |error: std::io::Error| CliError::new(format!("{}: {}", folder.display(), io_reason(&error)));
    let mut entries = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(['.', '_']));
        if !hidden && !path.is_symlink() {
            entries.push(path);
        }
    }
    entries.sort();
    Ok(entries)
}

fn bytes(path: &Path) -> Result<Vec<u8>, CliError> {
    let failed = |error: std::io::Error| CliError::new(format!("{}: {}", path.display(), io_reason(&error)));
    let size = std::fs::metadata(path).map_err(failed)?.len();
    if size > MOST_BYTES {
        return Err(CliError::new(format!("{}: {} MB is no submission of shaders", path.display(), size / 1_000_000)));
    }
    std::fs::read(path).map_err(failed)
}

fn read_folder(top: &Path, folder: &Path, files: &mut Vec<SourceFile>, depth: usize) -> Result<(), CliError> {
    for path in entries(folder)? {
        if path.is_dir() {
            if depth < DEEPEST {
                read_folder(top, &path, files, depth + 1)?;
            }
        } else if files.len() < MOST_FILES && std::fs::metadata(&path).is_ok_and(|data| data.len() <= MOST_BYTES) {
            // What is larger is a model or a picture, and none of ours.
            let name = path.strip_prefix(top).unwrap_or(&path).to_string_lossy().into_owned();
            files.push(SourceFile { bytes: bytes(&path)?, name });
        }
    }
    Ok(())
}
