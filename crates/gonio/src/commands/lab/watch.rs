//! `gonio lab check --watch`: checks again whenever a file changes.
//!
//! Files are polled, as in the window: a submission has few, and no notifications of a system cover network folders.

use crate::error::{CliError, CommandOutcome};
use crate::report::Reporter;
use gonio_exercises::class::is_noise;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

/// Interval at which files are polled.
const PERIOD: Duration = Duration::from_millis(200);
/// Most files that are watched.
const MOST_FILES: usize = 2000;
/// Folders within one another.
const MOST_DEPTH: usize = 32;

/// The modification time and size of each file.
type Stamps = BTreeMap<PathBuf, (Option<SystemTime>, u64)>;

/// Runs `check` now and after each change of the files at `paths`, until Ctrl-C. It is given whether to stop. Files that it
/// writes itself are `outputs`.
///
/// # Errors
/// That of the first check. Later ones are printed: a file may be missing for a moment.
pub fn run(
    paths: &[PathBuf],
    outputs: impl Iterator<Item = PathBuf>,
    reporter: &Reporter,
    check: impl Fn(&dyn Fn() -> bool) -> Result<CommandOutcome, CliError>,
) -> Result<CommandOutcome, CliError> {
    let stop = Arc::new(AtomicBool::new(false));
    catch_interrupt(&stop)?;
    let stops = || stop.load(Ordering::Relaxed);
    let own: Vec<PathBuf> = outputs.filter_map(|path| std::path::absolute(path).ok()).collect();
    let look = || stamps(paths, &own);
    let mut known = look();
    let mut result = check(&stops);
    if let (Err(error), false) = (result, stops()) {
        return Err(error);
    }
    reporter.note("checking again whenever a file changes; press Ctrl-C to stop");
    let mut seen = known.clone();
    while !stops() {
        std::thread::sleep(PERIOD);
        let now = look();
        // A file that is still being written to changes again.
        let is_settled = now == seen;
        seen = now;
        if !is_settled || seen == known {
            continue;
        }
        known = seen.clone();
        reporter.begin_again()?;
        result = check(&stops);
        match result {
            Err(error @ CliError::ClosedPipe) => return Err(error),
            Err(error) if !stops() => reporter.error(&error),
            _ => {}
        }
    }
    Ok(CommandOutcome::Done)
}

/// Sets `stop` at the first Ctrl-C; the second one ends the process at once.
fn catch_interrupt(stop: &Arc<AtomicBool>) -> Result<(), CliError> {
    use signal_hook::consts::SIGINT;
    signal_hook::flag::register_conditional_shutdown(SIGINT, 2, Arc::clone(stop))
        .and_then(|_| signal_hook::flag::register(SIGINT, Arc::clone(stop)))
        .map(drop)
        .map_err(|error| CliError::io("Ctrl-C cannot be received", &error))
}

fn stamps(paths: &[PathBuf], own: &[PathBuf]) -> Stamps {
    let mut stamps = Stamps::new();
    paths.iter().for_each(|path| add(path, own, 0, &mut stamps));
    stamps
}

fn add(path: &Path, own: &[PathBuf], depth: usize, stamps: &mut Stamps) {
    let is_own = || std::path::absolute(path).is_ok_and(|path| own.contains(&path));
    let Ok(metadata) = std::fs::metadata(path) else { return };
    if stamps.len() >= MOST_FILES || depth > MOST_DEPTH || is_own() {
        return;
    }
    if !metadata.is_dir() {
        stamps.insert(path.to_owned(), (metadata.modified().ok(), metadata.len()));
        return;
    }
    for entry in std::fs::read_dir(path).into_iter().flatten().flatten() {
        if !is_noise(&entry.file_name().to_string_lossy()) {
            add(&entry.path(), own, depth + 1, stamps);
        }
    }
}
