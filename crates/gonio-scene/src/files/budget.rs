//! One limit on memory for an input and everything that is read on its behalf.

use super::{FileBytes, FileRefusal, FileSource, OverLimit};
use std::collections::HashMap;
use std::io::Error;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The memory that one input may take together with all files that it refers to: bytes read, bytes unpacked, pictures
/// decoded. Nothing is returned to it, so whether the total is exceeded does not depend on the order of threads.
pub struct Budget {
    limit: u64,
    spent: Mutex<Spent>,
}

#[derive(Default)]
struct Spent {
    bytes: u64,
    /// Files that were read already: reading one again costs nothing.
    files: HashMap<PathBuf, u64>,
}

impl Budget {
    /// A budget of `limit` bytes.
    pub fn new(limit: u64) -> Self {
        Budget { limit, spent: Mutex::default() }
    }

    /// Bytes that are left.
    pub fn left(&self) -> u64 {
        self.limit - self.lock().bytes
    }

    /// Spends `bytes`, or nothing if they exceed what is left.
    pub fn spend(&self, bytes: u64) -> Result<(), OverLimit> {
        self.lock().spend(bytes, self.limit)
    }

    /// Runs `make` with the number of bytes left, and spends the size of the result. Other threads wait meanwhile, so
    /// that all together never exceed the limit.
    pub fn make<T, E>(&self, make: impl FnOnce(u64) -> Result<(T, u64), E>) -> Result<T, E>
    where
        E: From<OverLimit>,
    {
        let mut spent = self.lock();
        let (made, bytes) = make(self.limit - spent.bytes)?;
        spent.spend(bytes, self.limit)?;
        Ok(made)
    }

    /// The error of a reader whose limit was what is left.
    pub fn over(&self, needed: Option<u64>, left: u64) -> OverLimit {
        OverLimit { needed, left, limit: self.limit }
    }

    fn read(&self, path: &Path, read: impl FnOnce(u64) -> Result<FileBytes, Error>) -> Result<FileBytes, Error> {
        let mut spent = self.lock();
        let known = spent.files.get(path).copied().unwrap_or(0);
        let allowed = self.limit - spent.bytes + known;
        let bytes = read(allowed).map_err(|error| match FileRefusal::in_error(&error) {
            Some(FileRefusal::OverLimit(over)) => {
                FileRefusal::OverLimit(self.over(over.needed, allowed.min(over.left))).into()
            }
            _ => error,
        })?;
        let more = (bytes.len() as u64).saturating_sub(known);
        spent.spend(more, self.limit).map_err(FileRefusal::OverLimit)?;
        if more > 0 {
            spent.files.insert(path.to_owned(), bytes.len() as u64);
        }
        Ok(bytes)
    }

    /// No code under the lock can panic between two changes, so a poisoned lock is still consistent.
    fn lock(&self) -> MutexGuard<'_, Spent> {
        self.spent.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Spent {
    fn spend(&mut self, bytes: u64, limit: u64) -> Result<(), OverLimit> {
        let left = limit - self.bytes;
        if bytes > left {
            return Err(OverLimit { needed: Some(bytes), left, limit });
        }
        self.bytes += bytes;
        Ok(())
    }
}

/// Files whose size is charged to a [`Budget`]. Built-in files are free, because the program contains them anyway.
pub struct Budgeted<S> {
    inner: S,
    budget: Budget,
}

impl<S: FileSource> Budgeted<S> {
    /// The files of `inner`, which may have `limit` bytes in total.
    pub fn new(inner: S, limit: u64) -> Self {
        Budgeted { inner, budget: Budget::new(limit) }
    }

    /// The budget that the files are charged to.
    pub fn budget(&self) -> &Budget {
        &self.budget
    }
}

impl<S: FileSource> FileSource for Budgeted<S> {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        self.budget.read(path, |allowed| self.inner.read_within(path, allowed.min(most)))
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        self.inner.list(folder)
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.inner.builtin(name)
    }
    fn made(&self, name: &str) -> Result<FileBytes, Error> {
        self.inner.made(name)
    }

    fn is_coming(&self, name: &str) -> bool {
        self.inner.is_coming(name)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Files whose sizes are their names.
    struct Sized;

    impl FileSource for Sized {
        fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
            let size: u64 = path.to_str().unwrap().parse().unwrap();
            if size > most {
                return Err(FileRefusal::OverLimit(OverLimit { needed: Some(size), left: most, limit: most }).into());
            }
            Ok(vec![0; size as usize].into())
        }
        fn list(&self, _: &Path) -> Vec<PathBuf> {
            Vec::new()
        }
    }

    #[test]
    fn files_add_up_and_reading_one_again_is_free() {
        let files = Budgeted::new(Sized, 100);
        assert_eq!(files.read(Path::new("60")).unwrap().len(), 60);
        assert_eq!(files.read(Path::new("60")).unwrap().len(), 60);
        assert_eq!(files.budget().left(), 40);
        let error = files.read(Path::new("50")).unwrap_err();
        let over = OverLimit { needed: Some(50), left: 40, limit: 100 };
        assert_eq!(FileRefusal::in_error(&error), Some(&FileRefusal::OverLimit(over)));
        assert_eq!(files.read(Path::new("40")).unwrap().len(), 40);
        assert_eq!(files.budget().left(), 0);
        assert_eq!(files.read(Path::new("60")).unwrap().len(), 60, "it is paid for");
    }

    #[test]
    fn results_are_charged_once_their_size_is_known() {
        let budget = Budget::new(100);
        let made: Result<&str, OverLimit> = budget.make(|left| Ok(("made", left / 2)));
        assert_eq!((made, budget.left()), (Ok("made"), 50));
        let over = OverLimit { needed: Some(51), left: 50, limit: 100 };
        assert_eq!(budget.make(|left| Ok(("more", left + 1))), Err(over));
        assert_eq!((budget.spend(51), budget.left()), (Err(over), 50));
    }
}
