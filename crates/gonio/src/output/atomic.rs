//! Atomic writes: a file is complete, or it is as it was before.
//!
//! The bytes go to a temporary file in the target's folder, which is then renamed to the target; on an error (a full disk,
//! say) the temporary file is removed. Devices and pipes cannot be replaced and are written directly.

use crate::report::{CliError, io_reason};
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_file_is_made_and_replaced_and_nothing_else_is_left() {
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
    fn a_link_keeps_being_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        write(&file, b"old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, b"new").unwrap();
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
        assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
