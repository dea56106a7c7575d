//! The files of the repository.

use crate::process;
use std::path::Path;
use std::process::Command;

/// A text file of the repository.
#[derive(Clone, Debug)]
pub struct TextFile {
    /// From the top of the repository, with `/`.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl TextFile {
    /// Whether it is Rust.
    pub fn is_rust(&self) -> bool {
        self.path.ends_with(".rs")
    }
}

/// Every text file that git tracks, or would track once it is added. Binary files are left out.
pub fn text_files(root: &Path) -> Result<Vec<TextFile>, String> {
    let list = process::stdout_of(Command::new("git").current_dir(root).args([
        "ls-files",
        "-z",
        "--cached",
        "--others",
        "--exclude-standard",
    ]))?;
    let mut files = Vec::new();
    for path in list.split('\0').filter(|p| !p.is_empty()) {
        // A tracked file that has been deleted is none any more; a submodule or link is no text.
        let Ok(bytes) = std::fs::read(root.join(path)) else { continue };
        if let Ok(text) = String::from_utf8(bytes) {
            files.push(TextFile { path: path.to_owned(), text });
        }
    }
    if !files.iter().any(TextFile::is_rust) {
        return Err("git lists no Rust file here: the checks would look at nothing".into());
    }
    Ok(files)
}
