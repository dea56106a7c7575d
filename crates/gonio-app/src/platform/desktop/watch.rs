//! Watches files for changes.
//!
//! It polls them twice a second. A scene has few files, and a few dozen `stat`s are cheaper than packages for the notifications
//! of three systems, none of which covers network folders.

use crate::platform::Event;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

const PERIOD: Duration = Duration::from_millis(500);

/// Modification time and size; `None` for a missing file.
type Stamp = Option<(SystemTime, u64)>;

#[derive(Clone, Copy)]
struct Looked {
    /// The stamp of the content that was read.
    known: Stamp,
    /// The last stamp.
    seen: Stamp,
}

/// A thread that polls files, until this is dropped.
pub struct Watcher {
    files: Arc<Mutex<BTreeMap<PathBuf, Looked>>>,
}

impl Watcher {
    /// Starts to poll; `ctx` is repainted when files change.
    pub fn start(sender: Sender<Event>, ctx: egui::Context) -> Self {
        let files = Arc::new(Mutex::new(BTreeMap::new()));
        let shared = Arc::downgrade(&files);
        std::thread::spawn(move || {
            loop {
                std::thread::sleep(PERIOD);
                // The window was closed.
                let Some(files) = shared.upgrade() else { return };
                let changed = look(&mut files.lock().unwrap_or_else(PoisonError::into_inner));
                if !changed.is_empty() {
                    if sender.send(Event::Changed(changed)).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        });
        Watcher { files }
    }

    /// Watches these files from now on. Files that were watched before keep their stamps.
    pub fn set(&self, paths: Vec<PathBuf>) {
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let before = std::mem::take(&mut *files);
        *files = paths
            .into_iter()
            .map(|path| {
                let looked = before.get(&path).copied().unwrap_or_else(|| {
                    let stamp = stamp(&path);
                    Looked { known: stamp, seen: stamp }
                });
                (path, looked)
            })
            .collect();
    }
}

/// Returns files that changed and have stopped changing. Files that are still being written follow later.
fn look(files: &mut BTreeMap<PathBuf, Looked>) -> Vec<PathBuf> {
    let mut settled = Vec::new();
    let mut moving = false;
    for (path, looked) in files.iter_mut() {
        let now = stamp(path);
        moving |= now != looked.seen;
        looked.seen = now;
        // A file may be missing for a moment: many programs write another file and rename it.
        if now != looked.known && now.is_some() {
            settled.push(path.clone());
        }
    }
    // Several files are often written one after the other, and are reported together.
    if moving {
        return Vec::new();
    }
    for path in &settled {
        if let Some(looked) = files.get_mut(path) {
            looked.known = looked.seen;
        }
    }
    settled
}

fn stamp(path: &Path) -> Stamp {
    let metadata = std::fs::metadata(path).ok().filter(|metadata| metadata.is_file())?;
    Some((metadata.modified().ok()?, metadata.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_file_is_reported_once_it_has_settled() {
        let folder = std::env::temp_dir().join(format!("gonio-watch-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap_or_else(|e| panic!("{e}"));
        let [old, new] = ["old.mtl", "new.mtl"].map(|name| folder.join(name));
        let write = |path: &Path, text: &str| std::fs::write(path, text).unwrap_or_else(|e| panic!("{e}"));
        write(&old, "1");
        let (sender, _receiver) = std::sync::mpsc::channel();
        let watcher = Watcher::start(sender, egui::Context::default());
        watcher.set(vec![old.clone(), new.clone()]);
        // The test polls a copy, without waiting for the thread.
        let mut files = watcher.files.lock().unwrap_or_else(PoisonError::into_inner).clone();
        drop(watcher);
        assert!(look(&mut files).is_empty());
        write(&old, "12");
        assert!(look(&mut files).is_empty(), "it may still be written to");
        assert_eq!(look(&mut files), std::slice::from_ref(&old));
        assert!(look(&mut files).is_empty(), "it was reported once");
        std::fs::remove_file(&old).unwrap_or_else(|e| panic!("{e}"));
        assert!(look(&mut files).is_empty() && look(&mut files).is_empty(), "a missing file is not a change");
        write(&old, "12345");
        write(&new, "1");
        assert!(look(&mut files).is_empty());
        assert_eq!(look(&mut files), [new, old]);
        std::fs::remove_dir_all(&folder).unwrap_or_else(|e| panic!("{e}"));
    }
}
