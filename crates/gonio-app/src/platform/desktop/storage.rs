//! Where gonio keeps settings and drafts, and atomic writing of files.
//!
//! Folders follow the XDG Base Directory Specification 0.8, Known Folders of Windows, and the Library of macOS.

use gonio_language::tr;
use std::env::var_os;
use std::ffi::OsString;
use std::fs::File;
use std::io::{Error, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The file of the window's settings; `None` without a home folder.
pub fn settings_file() -> Option<PathBuf> {
    Some(folder()?.join("window.json"))
}

/// The folder of drafts of unsaved text; `None` without a home folder.
pub fn drafts_folder() -> Option<PathBuf> {
    Some(folder()?.join("drafts"))
}

fn folder() -> Option<PathBuf> {
    let folder = |name: &str| var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let place = if cfg!(windows) {
        folder("LOCALAPPDATA")?
    } else if cfg!(target_os = "macos") {
        folder("HOME")?.join("Library/Application Support")
    } else {
        folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")))?
    };
    Some(place.join("gonio"))
}

/// Writes a temporary file beside `place` and renames it, so that readers see the old or the new content, and a failure leaves
/// the old one. An error is one sentence.
pub fn write_atomically(place: &Path, bytes: &[u8]) -> Result<(), String> {
    let beside = hidden_beside(place)?;
    let written =
        File::create(&beside).and_then(|mut file| file.write_all(bytes)).and_then(|()| std::fs::rename(&beside, place));
    written.map_err(|error| {
        // It may not exist.
        let _ = std::fs::remove_file(&beside);
        could_not_be_written(place, &error)
    })
}

/// A hidden name beside `place` that no other process uses. An error in one sentence if `place` cannot be a file.
pub fn hidden_beside(place: &Path) -> Result<PathBuf, String> {
    let failed = |kind: ErrorKind| could_not_be_written(place, &kind.into());
    if place.is_dir() {
        return Err(failed(ErrorKind::IsADirectory));
    }
    let mut hidden = OsString::from(".");
    hidden.push(place.file_name().ok_or_else(|| failed(ErrorKind::InvalidFilename))?);
    hidden.push(format!(".{}.part", std::process::id()));
    Ok(place.with_file_name(hidden))
}

/// The error of a file that cannot be written, in one sentence.
pub fn could_not_be_written(place: &Path, error: &Error) -> String {
    tr!("window-could-not-be-written", place = place.display(), error = reason(error))
}

fn reason(error: &Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => tr!("window-no-such-folder-create-it-or").into(),
        ErrorKind::PermissionDenied => tr!("window-permission-denied-choose-another-folder").into(),
        ErrorKind::IsADirectory => tr!("window-this-is-a-folder-add-a").into(),
        ErrorKind::InvalidFilename => tr!("window-the-file-name-is-missing").into(),
        ErrorKind::StorageFull => tr!("window-the-disk-is-full").into(),
        _ => tr!("window-choose-another-place", error = error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_replaced_whole_and_nothing_else_is_left() {
        let folder = std::env::temp_dir().join(format!("gonio-write-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap_or_else(|e| panic!("{e}"));
        let place = folder.join("a.png");
        for content in ["first", "second"] {
            write_atomically(&place, content.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(std::fs::read_to_string(&place).unwrap_or_default(), content);
        }
        assert!(write_atomically(&folder, b"x").is_err_and(|error| error.contains("this is a folder")));
        let nowhere = folder.join("none").join("a.png");
        assert!(write_atomically(&nowhere, b"x").is_err_and(|error| error.contains("no such folder")));
        let names = std::fs::read_dir(&folder).map(|entries| entries.count()).unwrap_or_default();
        assert_eq!(names, 1);
        std::fs::remove_dir_all(&folder).unwrap_or_else(|e| panic!("{e}"));
    }
}
