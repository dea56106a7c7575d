//! Drafts of unsaved text, on disk.
//!
//! | path below `gonio/drafts` | contents |
//! |---|---|
//! | `PROCESS-N/` | the drafts of one window |
//! | `PROCESS-N/lock` | locked as long as that window lives |
//! | `PROCESS-N/KEY.json` | a draft |
//!
//! Two windows therefore never write the same draft, and a window takes drafts only from closed or crashed windows.
//! Drafts older than 90 days are removed, and the oldest beyond 200.

use super::storage;
use crate::exercise::MOST_AGE_OF_DRAFTS;
use gonio_language::tr;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Most drafts of closed windows that are kept.
const MOST_LEFT: usize = 200;
const LOCK: &str = "lock";

/// The folder of all windows' drafts.
pub struct DraftFolder {
    root: PathBuf,
    own: Option<WindowFolder>,
    is_pruned: bool,
}

/// The folder of one window's drafts, locked by the window.
struct WindowFolder {
    folder: PathBuf,
    _lock: File,
}

/// A draft that was left.
struct Left {
    path: PathBuf,
    written: SystemTime,
    /// Keeps the folder of its window locked.
    _session: std::rc::Rc<WindowFolder>,
}

impl DraftFolder {
    /// Uses this folder, which is created with the first draft.
    pub fn new(root: PathBuf) -> Self {
        DraftFolder { root, own: None, is_pruned: false }
    }

    /// Keeps a draft. An error is one sentence.
    pub fn keep(&mut self, key: &str, text: &str) -> Result<(), String> {
        self.prune();
        let file = format!("{key}.json");
        // Another window may have removed the folder before it was locked.
        if self.own.as_ref().is_some_and(|own| !own.folder.is_dir()) {
            self.own = None;
        }
        let place = self.session()?.folder.join(file);
        storage::write_atomically(&place, text.as_bytes())
    }

    /// Removes this window's draft.
    pub fn remove(&mut self, key: &str) {
        if let Some(own) = &self.own {
            // A draft that cannot be removed is offered again later.
            let _ = fs::remove_file(own.folder.join(format!("{key}.json")));
        }
    }

    /// Takes over the newest draft under this key of a closed window.
    pub fn take(&mut self, key: &str) -> Option<String> {
        self.prune();
        let is_meant = |path: &Path| {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            // A window may have left several texts of one file: KEY-2, KEY-3.
            stem.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        };
        let left = self.left();
        let newest = left.iter().filter(|left| is_meant(&left.path)).max_by_key(|left| left.written)?;
        let text = fs::read_to_string(&newest.path).ok()?;
        let own = self.session().ok()?.folder.join(format!("{key}.json"));
        // Renaming never leaves the text without a draft.
        fs::rename(&newest.path, own).ok()?;
        Some(text)
    }

    /// This window's folder, which is created on first use.
    fn session(&mut self) -> Result<&WindowFolder, String> {
        let failed = |error: Error| tr!("window-a-folder-in-could-not-be", root = self.root.display(), error = error);
        match &mut self.own {
            Some(own) => Ok(own),
            own => Ok(own.insert(WindowFolder::new(&self.root).map_err(failed)?)),
        }
    }

    /// All drafts of closed windows.
    fn left(&self) -> Vec<Left> {
        let own = self.own.as_ref().map(|own| own.folder.as_path());
        let mut left = Vec::new();
        for folder in entries(&self.root).into_iter().filter(|path| path.is_dir() && Some(path.as_path()) != own) {
            let Some(session) = WindowFolder::of_closed_window(folder) else { continue };
            let session = std::rc::Rc::new(session);
            for path in entries(&session.folder).into_iter().filter(|path| path.extension() == Some(OsStr::new("json")))
            {
                let written = fs::metadata(&path).and_then(|data| data.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
                left.push(Left { path, written, _session: session.clone() });
            }
        }
        left
    }

    /// Removes drafts that are too old or too many, and empty folders. Runs once, because it reads every folder.
    fn prune(&mut self) {
        if std::mem::replace(&mut self.is_pruned, true) {
            return;
        }
        let mut left = self.left();
        left.sort_by_key(|left| std::cmp::Reverse(left.written));
        let is_old = |left: &Left| left.written.elapsed().is_ok_and(|age| age > MOST_AGE_OF_DRAFTS);
        for (index, left) in left.iter().enumerate() {
            if index >= MOST_LEFT || is_old(left) {
                // If this fails, the next window tries again.
                let _ = fs::remove_file(&left.path);
            }
        }
        drop(left);
        let own = self.own.as_ref().map(|own| own.folder.as_path());
        for folder in entries(&self.root).into_iter().filter(|path| path.is_dir() && Some(path.as_path()) != own) {
            if let Some(session) = WindowFolder::of_closed_window(folder) {
                session.remove_if_empty();
            }
        }
    }
}

impl Drop for DraftFolder {
    fn drop(&mut self) {
        if let Some(own) = self.own.take() {
            own.remove_if_empty();
        }
    }
}

impl WindowFolder {
    fn new(root: &Path) -> Result<Self, Error> {
        fs::create_dir_all(root)?;
        let process = std::process::id();
        for number in 0_u32.. {
            let folder = root.join(format!("{process}-{number}"));
            match fs::create_dir(&folder) {
                // It belongs to an earlier process with the same number, or to another window of this one.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                made => {
                    made?;
                    let lock = File::create(folder.join(LOCK))?;
                    // On a file system without locks another window may take these drafts; none is lost.
                    let _ = lock.lock();
                    return Ok(WindowFolder { folder, _lock: lock });
                }
            }
        }
        Err(ErrorKind::AlreadyExists.into())
    }

    /// Locks the folder of a closed window; `None` while that window is open.
    fn of_closed_window(folder: PathBuf) -> Option<Self> {
        let lock = File::options().write(true).open(folder.join(LOCK)).ok()?;
        match lock.try_lock() {
            Ok(()) => Some(WindowFolder { folder, _lock: lock }),
            Err(fs::TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
                Some(WindowFolder { folder, _lock: lock })
            }
            Err(_) => None,
        }
    }

    fn remove_if_empty(self) {
        let is_empty = entries(&self.folder).iter().all(|path| path.file_name() == Some(OsStr::new(LOCK)));
        if is_empty {
            // If this fails, the next window removes the folder.
            let _ = fs::remove_file(self.folder.join(LOCK)).and_then(|()| fs::remove_dir(&self.folder));
        }
    }
}

/// The entries of a folder; none if it cannot be read.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    paths
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::time::Duration;

    struct Root(PathBuf);

    impl Root {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("gonio-drafts-{name}-{}", std::process::id()));
            let _ = fs::remove_dir_all(&path);
            Root(path)
        }

        fn window(&self) -> DraftFolder {
            DraftFolder::new(self.0.clone())
        }

        /// A window that keeps these drafts and is then killed, which releases its lock.
        fn killed(&self, drafts: &[(&str, &str)]) -> PathBuf {
            let mut window = self.window();
            for (key, text) in drafts {
                window.keep(key, text).unwrap();
            }
            let own = window.own.take().unwrap();
            own.folder.clone()
        }

        fn folders(&self) -> usize {
            entries(&self.0).len()
        }
    }

    impl Drop for Root {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn drafts_are_taken_once_and_only_from_closed_windows() {
        let root = Root::new("taken");
        let mut alive = root.window();
        alive.keep("a", "of the living").unwrap();
        let mut other = root.window();
        assert_eq!(other.take("a"), None);
        root.killed(&[("a", "of the dead"), ("b", "another")]);
        assert_eq!(other.take("a").as_deref(), Some("of the dead"));
        assert_eq!((other.take("a"), root.window().take("a")), (None, None));
        assert_eq!(root.window().take("b").as_deref(), Some("another"));
        // It belongs to the other window now, and is left when that closes.
        drop(other);
        assert_eq!(root.window().take("a").as_deref(), Some("of the dead"));
        drop(alive);
        assert_eq!(root.window().take("a").as_deref().map(|_| ()), Some(()));
    }

    #[test]
    fn the_newest_draft_comes_first_and_none_is_lost() {
        let root = Root::new("newest");
        let set_age = |folder: &Path, name: &str, age: u64| {
            let time = SystemTime::now() - Duration::from_secs(age);
            File::options().write(true).open(folder.join(name)).unwrap().set_modified(time).unwrap();
        };
        let first = root.killed(&[("a", "older"), ("a-2", "oldest")]);
        set_age(&first, "a.json", 100);
        set_age(&first, "a-2.json", 200);
        let second = root.killed(&[("a", "newer"), ("ab", "of another file")]);
        set_age(&second, "a.json", 50);
        for text in ["newer", "older", "oldest"] {
            let mut window = root.window();
            assert_eq!(window.take("a").as_deref(), Some(text));
            window.remove("a");
        }
        assert_eq!(root.window().take("a"), None);
        assert_eq!(root.window().take("ab").as_deref(), Some("of another file"));
    }

    #[test]
    fn saved_text_leaves_no_draft_folder() {
        let root = Root::new("saved");
        let mut window = root.window();
        for text in ["one", "two"] {
            window.keep("a", text).unwrap();
        }
        assert_eq!(root.folders(), 1);
        window.remove("a");
        drop(window);
        assert_eq!(root.folders(), 0);
    }

    #[test]
    fn drafts_that_are_too_old_or_too_many_are_removed() {
        let root = Root::new("old");
        let old = root.killed(&[("old", "text")]);
        let time = SystemTime::now() - MOST_AGE_OF_DRAFTS - Duration::from_secs(60);
        File::options().write(true).open(old.join("old.json")).unwrap().set_modified(time).unwrap();
        assert_eq!(root.window().take("old"), None);
        assert!(!old.exists(), "a folder without drafts is removed");
        let keys: Vec<String> = (0..MOST_LEFT + 3).map(|number| format!("{number:04}")).collect();
        let many = root.killed(&keys.iter().map(|key| (key.as_str(), "text")).collect::<Vec<_>>());
        for (number, key) in keys.iter().enumerate() {
            let time = SystemTime::now() - Duration::from_secs(number as u64 + 1);
            File::options().write(true).open(many.join(format!("{key}.json"))).unwrap().set_modified(time).unwrap();
        }
        assert_eq!(root.window().take(&keys[MOST_LEFT]), None);
        assert_eq!(entries(&many).len(), MOST_LEFT + 1, "and the lock");
        assert_eq!(root.window().take(&keys[MOST_LEFT - 1]).as_deref(), Some("text"));
    }

    #[test]
    fn a_folder_that_cannot_be_created_is_an_error() {
        let root = Root::new("file");
        fs::write(&root.0, "a file").unwrap();
        let error = root.window().keep("a", "text").unwrap_err();
        assert!(error.contains("could not be created") && !error.contains('\n'), "{error}");
        assert_eq!(root.window().take("a"), None);
        fs::remove_file(&root.0).unwrap();
    }
}
