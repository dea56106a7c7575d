//! Several files that appear together, or not at all.
//!
//! Each file is written to a temporary folder beside its target as soon as it is ready, and all are renamed to their targets
//! at the end. If one cannot be written (on a full disk, say), none is left, and neither are folders made for them. An output
//! that goes to stdout is written last.

use super::OutputPath;
use super::atomic::{self, write_error};
use crate::report::{self, CliError};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The files of one command.
#[derive(Default)]
pub struct FileSet {
    /// Folders that were created, the outermost first.
    made: Vec<PathBuf>,
    /// Temporary folders and the folders that contain them.
    beside: Vec<(PathBuf, TempDir)>,
    /// Targets and temporary files, in the order in which they were added.
    files: Vec<(PathBuf, PathBuf)>,
    stdout: Option<Vec<u8>>,
}

impl FileSet {
    pub fn new() -> Self {
        FileSet::default()
    }

    /// Creates a folder and its missing parents.
    pub fn make_folder(&mut self, folder: &Path) -> Result<(), CliError> {
        let missing = folder.ancestors().take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        self.made.extend(missing.into_iter().rev());
        std::fs::create_dir_all(folder)
            .map_err(|e| CliError::io(format!("cannot create the folder `{}`", folder.display()), &e))
    }

    /// Adds an output; at most one may go to stdout.
    pub fn add_output(&mut self, output: &OutputPath, bytes: Vec<u8>) -> Result<(), CliError> {
        match output {
            OutputPath::Stdout => self.stdout = Some(bytes),
            OutputPath::File(path) => self.add(path, &bytes)?,
        }
        Ok(())
    }

    /// Adds a file, whose folder must exist.
    pub fn add(&mut self, target: &Path, bytes: &[u8]) -> Result<(), CliError> {
        // Obstacles are found now, not after other files have been replaced.
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
        std::fs::write(&finished, bytes).map_err(|e| write_error(target, &e))?;
        self.files.push((target.to_owned(), finished));
        Ok(())
    }

    /// Moves all files to their targets, in the order in which they were added, then writes to stdout.
    pub fn commit(mut self) -> Result<(), CliError> {
        let mut placed: Vec<(&Path, Option<PathBuf>)> = Vec::with_capacity(self.files.len());
        for (target, finished) in &self.files {
            // A second name for the old file, so that it can be restored.
            let old = finished.with_extension("old");
            let kept =
                std::fs::canonicalize(target).and_then(|was| std::fs::hard_link(was, &old)).is_ok().then_some(old);
            let was_there = target.exists();
            if let Err(error) = atomic::replace(target, finished) {
                for (target, old) in placed.into_iter().rev() {
                    // If this fails too, the first error is the one to report.
                    let _ = old.map_or_else(|| std::fs::remove_file(target), |old| std::fs::rename(old, target));
                }
                return Err(error);
            }
            if kept.is_some() || !was_there {
                placed.push((target, kept));
            }
        }
        self.made.clear();
        self.stdout.take().map_or(Ok(()), |bytes| report::write_stdout(&bytes))
    }
}

impl Drop for FileSet {
    fn drop(&mut self) {
        self.beside.clear();
        for folder in self.made.iter().rev() {
            // Fails unless it is empty: others may have used it meanwhile.
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

    /// A set of these files, added until one is rejected.
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
