//! One place of files over another: an environment that was dropped lies elsewhere than the scene that it is for.

use gonio_scene::files::{FileBytes, FileSource};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files that are looked for in the first place, and then in the second.
pub struct Layered {
    /// The first source.
    pub first: Arc<dyn FileSource>,
    /// The source of files that the first does not have.
    pub then: Arc<dyn FileSource>,
}

impl FileSource for Layered {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        match self.first.read_within(path, most) {
            // Errors of the first source are reported; files that it does not have may be in the second.
            Err(why) if matches!(why.kind(), ErrorKind::NotFound | ErrorKind::IsADirectory) => self
                .then
                .read_within(path, most)
                .map_err(|other| if other.kind() == ErrorKind::NotFound { why } else { other }),
            other => other,
        }
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let mut names = self.first.list(folder);
        for name in self.then.list(folder) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.first.builtin(name).or_else(|| self.then.builtin(name))
    }

    fn is_coming(&self, name: &str) -> bool {
        self.first.is_coming(name) || self.then.is_coming(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::MemoryFiles;

    fn one(name: &str, text: &str) -> Arc<MemoryFiles> {
        let mut files = MemoryFiles::default();
        files.insert(name, text.as_bytes().to_vec());
        Arc::new(files)
    }

    #[test]
    fn the_first_hides_the_second_and_lacks_nothing_of_it() {
        let first = one("a/sky.hdr", "new");
        let mut second = (*one("a/sky.hdr", "old")).clone();
        second.insert("a/cube.obj", b"cube".to_vec());
        let both = Layered { first, then: Arc::new(second) };
        let text = |name: &str| both.read(Path::new(name)).map(|b| b.into_vec()).map_err(|e| e.kind());
        assert_eq!(text("a/sky.hdr"), Ok(b"new".to_vec()));
        assert_eq!(text("a/cube.obj"), Ok(b"cube".to_vec()));
        assert_eq!(text("a/none"), Err(ErrorKind::NotFound));
        assert_eq!(both.list(Path::new("a")), [PathBuf::from("sky.hdr"), PathBuf::from("cube.obj")]);
    }
}
