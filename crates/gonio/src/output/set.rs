//! Several files that appear together, or not at all.
//!
//! Each is written into a temporary folder beside its target as soon as it is ready; all are renamed into their places at the
//! end. Where one cannot be written (a full disk, say), nothing of any of them is left, nor of the folders made for them.

use super::atomic::{self, refused};
use crate::report::CliError;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The files of one command.
#[derive(Default)]
pub struct FileSet {
    /// Folders that were made, the outermost first.
    made: Vec<PathBuf>,
    /// Temporary folders by the folder that they stand in.
    beside: Vec<(PathBuf, TempDir)>,
    /// Target and temporary file, in the order in which they appear.
    files: Vec<(PathBuf, PathBuf)>,
}

impl FileSet {
    /// No file yet.
    pub fn new() -> Self {
        FileSet::default()
    }

    /// Makes a folder and those that it lies in, as far as they are missing.
    pub fn make_folder(&mut self, folder: &Path) -> Result<(), CliError> {
        let missing = folder.ancestors().take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        self.made.extend(missing.into_iter().rev());
        std::fs::create_dir_all(folder)
            .map_err(|e| CliError::io(format!("the folder `{}` cannot be made", folder.display()), &e))
    }

    /// Adds a file; its folder must be there.
    pub fn add(&mut self, target: &Path, bytes: &[u8]) -> Result<(), CliError> {
        // What is in the way of it is found out now, not when others have taken their places.
        atomic::check_target(target)?;
        let folder = target.parent().unwrap_or(Path::new("")).to_owned();
        let place = match self.beside.iter().position(|(known, _)| *known == folder) {
            Some(place) => place,
            None => {
                self.beside.push((folder, atomic::folder_beside(target)?));
                self.beside.len() - 1
            }
        };
        let finished = self.beside[place].1.path().join(self.files.len().to_string());
        std::fs::write(&finished, bytes).map_err(|e| refused(target, &e))?;
        self.files.push((target.to_owned(), finished));
        Ok(())
    }

    /// Puts all files into their places, in the order in which they were added.
    pub fn commit(mut self) -> Result<(), CliError> {
        let mut placed: Vec<(&Path, Option<PathBuf>)> = Vec::with_capacity(self.files.len());
        for (target, finished) in &self.files {
            // A second name for what was there, so that it can be put back.
            let old = finished.with_extension("old");
            let kept =
                std::fs::canonicalize(target).and_then(|was| std::fs::hard_link(was, &old)).is_ok().then_some(old);
            let was_there = target.exists();
            if let Err(error) = atomic::replace(target, finished) {
                for (target, old) in placed.into_iter().rev() {
                    // Where this fails too, the first error says enough.
                    let _ = old.map_or_else(|| std::fs::remove_file(target), |old| std::fs::rename(old, target));
                }
                return Err(error);
            }
            if kept.is_some() || !was_there {
                placed.push((target, kept));
            }
        }
        self.made.clear();
        Ok(())
    }
}

impl Drop for FileSet {
    fn drop(&mut self) {
        self.beside.clear();
        for folder in self.made.iter().rev() {
            // Only where it is empty: others may have used it meanwhile.
            let _ = std::fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// A set of these files, added until one is refused.
    fn set(files: &[(&Path, &[u8])]) -> Result<FileSet, CliError> {
        let mut set = FileSet::new();
        for (path, bytes) in files {
            set.make_folder(path.parent().unwrap())?;
            set.add(path, bytes)?;
        }
        Ok(set)
    }

    #[test]
    fn nothing_is_seen_before_the_end_and_everything_then() {
        let folder = tempfile::tempdir().unwrap();
        let (one, two) = (folder.path().join("a/b/one"), folder.path().join("a/two"));
        let ready = set(&[(&one, b"1"), (&two, b"2")]).unwrap();
        assert!(!one.exists() && !two.exists());
        ready.commit().unwrap();
        assert_eq!((std::fs::read(&one).unwrap(), std::fs::read(&two).unwrap()), (b"1".to_vec(), b"2".to_vec()));
        assert_eq!(names(&folder.path().join("a")), ["b", "two"]);
        assert_eq!(names(&folder.path().join("a/b")), ["one"]);
    }

    #[test]
    fn what_is_not_committed_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let deep = folder.path().join("x/y/z");
        drop(set(&[(&deep, b"1")]).unwrap());
        assert!(names(folder.path()).is_empty());
        // No file system has names as long as the second's.
        let long = folder.path().join("x").join("b".repeat(9999));
        set(&[(&deep, b"1"), (&long, b"2")]).and_then(FileSet::commit).unwrap_err();
        assert!(names(folder.path()).is_empty(), "{:?}", names(folder.path()));
    }

    #[test]
    fn a_failure_at_the_end_puts_everything_back() {
        let folder = tempfile::tempdir().unwrap();
        let [old, new, third] = ["old", "new", "third"].map(|name| folder.path().join(name));
        std::fs::write(&old, "before").unwrap();
        let ready = set(&[(&old, b"after"), (&new, b"new"), (&third, b"3")]).unwrap();
        // A folder that was made meanwhile.
        std::fs::create_dir(&third).unwrap();
        let error = ready.commit().unwrap_err().to_string();
        assert!(error.contains("third") && error.contains("it is a folder"), "{error}");
        assert_eq!(std::fs::read(&old).unwrap(), b"before");
        assert_eq!(names(folder.path()), ["old", "third"]);
    }

    #[test]
    fn a_folder_in_the_way_is_found_before_anything_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let (old, taken) = (folder.path().join("old"), folder.path().join("taken"));
        std::fs::write(&old, "before").unwrap();
        std::fs::create_dir(&taken).unwrap();
        let error = set(&[(&old, b"after"), (&taken, b"2")]).err().unwrap().to_string();
        assert!(error.contains("it is a folder"), "{error}");
        assert_eq!(std::fs::read(&old).unwrap(), b"before");
        assert_eq!(names(folder.path()), ["old", "taken"]);
    }
}
