//! Atomic writes: a file is complete, or it is as it was before; several files appear together, or not at all.
//!
//! The bytes go to a temporary file in the target's folder, which is then renamed to the target; on an error (a full disk,
//! say) the temporary file is removed. Devices and pipes cannot be replaced and are written directly.

use super::OutputPath;
use crate::error::{CliError, io_reason};
use crate::report;
use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempDir};

/// Replaces or creates the file at `path`.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    write_inner(path, bytes).map_err(|e| write_error(path, &e))
}

/// Finds out whether something prevents a file at `path`: a folder, say.
pub fn check_target(path: &Path) -> Result<(), CliError> {
    destination(path).map(drop).map_err(|e| write_error(path, &e))
}

/// Finds out whether [`write()`] could succeed, before a picture is drawn for it.
pub fn check_writable(path: &Path) -> Result<(), CliError> {
    let check = || -> io::Result<()> {
        if path.file_name().is_none() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        match destination(path)? {
            Destination::File(target) => temporary_beside(&target).map(drop),
            Destination::Device => OpenOptions::new().write(true).open(path).map(drop),
        }
    };
    check().map_err(|e| write_error(path, &e))
}

/// Moves the file at `finished` to `path`; `finished` is in the same folder or in one from [`folder_beside`].
pub fn replace(path: &Path, finished: &Path) -> Result<(), CliError> {
    let replace = || match destination(path)? {
        Destination::Device => std::fs::read(finished).and_then(|bytes| write_to_device(path, &bytes)),
        Destination::File(target) => std::fs::rename(finished, target),
    };
    replace().map_err(|e| write_error(path, &e))
}

/// A temporary folder for files that will [`replace`] the one at `path`.
pub fn folder_beside(path: &Path) -> Result<TempDir, CliError> {
    let make = || match destination(path)? {
        Destination::Device => tempfile::tempdir(),
        Destination::File(target) => tempfile::Builder::new().prefix(".gonio-").tempdir_in(folder_of(&target)),
    };
    make().map_err(|e| write_error(path, &e))
}

/// The error of a file that cannot be written.
pub fn write_error(path: &Path, error: &io::Error) -> CliError {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
    if error.kind() == io::ErrorKind::NotFound
        && let Some(folder) = folder
        && !folder.is_dir()
    {
        return CliError::new(format!(
            "`{}` cannot be written: there is no folder `{}`; create it first",
            path.display(),
            folder.display()
        ));
    }
    CliError::new(format!("`{}` cannot be written: {}", path.display(), io_reason(error)))
}

enum Destination {
    /// A file, which may not exist yet; links are followed.
    File(PathBuf),
    /// A device or a pipe.
    Device,
}

fn destination(path: &Path) -> io::Result<Destination> {
    match std::fs::metadata(path) {
        Ok(meta) if meta.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        // Renaming onto a link would replace the link instead of its target.
        Ok(meta) if meta.is_file() => std::fs::canonicalize(path).map(Destination::File),
        Ok(_) => Ok(Destination::Device),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(Destination::File(path.to_owned())),
        Err(e) => Err(e),
    }
}

fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let folder = folder_of(path);
    let mut builder = tempfile::Builder::new();
    builder.prefix(".gonio-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The permissions of any new file; the umask restricts them.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

fn write_to_device(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut device = OpenOptions::new().write(true).open(path)?;
    device.write_all(bytes)?;
    device.flush()
}

fn write_inner(path: &Path, bytes: &[u8]) -> io::Result<()> {
    match destination(path)? {
        Destination::Device => write_to_device(path, bytes),
        Destination::File(target) => {
            let mut temporary = temporary_beside(&target)?;
            temporary.write_all(bytes)?;
            temporary.flush()?;
            temporary.persist(&target).map_err(|e| e.error)?;
            Ok(())
        }
    }
}

/// The files of one command.
#[derive(Default)]
pub struct OutputFiles {
    /// Folders that were created, the outermost first.
    made: Vec<PathBuf>,
    /// Temporary folders and the folders that contain them.
    beside: Vec<(PathBuf, TempDir)>,
    /// Targets and temporary files, in the order in which they were added.
    files: Vec<(PathBuf, PathBuf)>,
    stdout: Option<Vec<u8>>,
}

impl OutputFiles {
    pub fn new() -> Self {
        OutputFiles::default()
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
        check_target(target)?;
        let folder = target.parent().unwrap_or(Path::new("")).to_owned();
        let place = match self.beside.iter().position(|(known, _)| *known == folder) {
            Some(place) => place,
            None => {
                self.beside.push((folder, folder_beside(target)?));
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
            if let Err(error) = replace(target, finished) {
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

impl Drop for OutputFiles {
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

    #[test]
    fn a_file_is_created_and_replaced_without_leftovers() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.bin");
        check_writable(&path).unwrap();
        assert!(names(folder.path()).is_empty());
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(names(folder.path()), ["out.bin"]);
    }

    #[test]
    fn folders_and_missing_folders_are_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let text = check_writable(folder.path()).unwrap_err().to_string();
        assert!(text.contains("it is a folder"), "{text}");
        let text = check_writable(&folder.path().join("no/out.png")).unwrap_err().to_string();
        assert!(text.contains("there is no folder") && text.contains("/no`"), "{text}");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        write(&file, b"old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, b"new").unwrap();
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
        assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    }

    /// A set of these files, added until one is rejected.
    fn set(files: &[(&Path, &[u8])]) -> Result<OutputFiles, CliError> {
        let mut set = OutputFiles::new();
        for (path, bytes) in files {
            set.make_folder(path.parent().unwrap())?;
            set.add(path, bytes)?;
        }
        Ok(set)
    }

    #[test]
    fn files_appear_together_at_the_end() {
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
    fn uncommitted_files_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let deep = folder.path().join("x/y/z");
        drop(set(&[(&deep, b"1")]).unwrap());
        assert!(names(folder.path()).is_empty());
        // No file system has names as long as the second's.
        let long = folder.path().join("x").join("b".repeat(9999));
        set(&[(&deep, b"1"), (&long, b"2")]).and_then(OutputFiles::commit).unwrap_err();
        assert!(names(folder.path()).is_empty(), "{:?}", names(folder.path()));
    }

    #[test]
    fn a_failure_at_the_end_restores_everything() {
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
