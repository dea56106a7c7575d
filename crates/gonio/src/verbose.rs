//! `--verbose`: the files that a command reads.

use crate::report::print_info;
use gonio_scene::files::{FileBytes, FileSource};
use std::io::Error;
use std::path::{Path, PathBuf};

/// A source of files that reports each one it reads if `is_verbose`.
pub struct ReportedReads<S> {
    pub source: S,
    pub is_verbose: bool,
}

impl<S: FileSource> FileSource for ReportedReads<S> {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        let bytes = self.source.read_within(path, most);
        if self.is_verbose
            && let Ok(bytes) = &bytes
        {
            print_info(format_args!("read `{}`, {} bytes", path.display(), bytes.len()));
        }
        bytes
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        self.source.list(folder)
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.source.builtin(name)
    }

    fn is_coming(&self, name: &str) -> bool {
        self.source.is_coming(name)
    }
}
