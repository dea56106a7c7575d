//! Folders for settings and drafts: XDG Base Directory Specification 0.8, Known Folders of Windows, Library of
//! macOS.

use std::env::var_os;
use std::path::PathBuf;

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
