//! Many submissions at once: each in a process of its own, so that none can harm the others.

use super::check::CheckArgs;
use super::{files, text};
use crate::output::atomic;
use crate::report::{CliError, Outcome, Reporter};
use gonio_app::platform::desktop::child::{self, Ended};
use gonio_lab::exercise::Exercise;
use gonio_lab::formats::{self, Fingerprint, Row, page_name};
use gonio_lab::submission::Submission;
use gonio_lab::verdict::{Outcome as Word, Verdict};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// From this share on two submissions are called similar.
const SIMILAR: f64 = 0.85;

/// What was found before, and of which content.
#[derive(Serialize, Deserialize)]
struct Kept {
    content: u64,
    row: Row,
}

/// Checks all, and writes pages, table and overview.
pub fn run(
    args: &CheckArgs,
    exercise: &Exercise,
    folder: &Path,
    submissions: &[PathBuf],
    reporter: &Reporter,
) -> Result<Outcome, CliError> {
    let results = args.output.clone().unwrap_or_else(|| PathBuf::from(format!("{}-results", folder.display())));
    let kept = results.join("kept");
    std::fs::create_dir_all(&kept)
        .map_err(|error| CliError::io(format!("the folder `{}` cannot be made", kept.display()), &error))?;
    let program = std::env::current_exe().map_err(|error| CliError::io("gonio's own program was not found", &error))?;
    let next = AtomicUsize::new(0);
    let rows = Mutex::new(Vec::new());
    let progress = reporter.progress("checking");
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(submission) = submissions.get(index) else { return };
                    let row = one(args, exercise, submission, &results, &program);
                    if let Ok(mut rows) = rows.lock() {
                        rows.push(row);
                        progress.set(rows.len() as f64 / submissions.len() as f64);
                    }
                }
            });
        }
    });
    drop(progress);
    let mut rows = rows.into_inner().unwrap_or_default().into_iter().collect::<Result<Vec<Row>, CliError>>()?;
    rows.sort_by(|a, b| a.submission.cmp(&b.submission));
    let similar = similar(exercise, submissions);
    let title = format!("{}: {}", exercise.id, exercise.title);
    atomic::write(&results.join("index.html"), formats::overview(&title, &rows, &similar).as_bytes())?;
    atomic::write(&results.join("table.csv"), formats::csv(&rows).as_bytes())?;
    if reporter.json() {
        reporter.report(&rows)?;
    } else {
        reporter.text(&text::table(&rows, &similar))?;
        reporter.note(format!(
            "{} is the overview, {} the table",
            results.join("index.html").display(),
            results.join("table.csv").display()
        ));
    }
    let right = rows.iter().all(|row| row.verdict == Word::Correct);
    Ok(if right { Outcome::Done } else { Outcome::CheckFailed })
}

fn label(submission: &Path) -> String {
    let name = if submission.is_dir() { submission.file_name() } else { submission.file_stem() };
    name.map_or_else(|| "submission".to_owned(), |name| name.to_string_lossy().into_owned())
}

/// One of them: as it was found before, or by a child.
fn one(
    args: &CheckArgs,
    exercise: &Exercise,
    submission: &Path,
    results: &Path,
    program: &Path,
) -> Result<Row, CliError> {
    let label = label(submission);
    let page = results.join(page_name(&label));
    let kept_path = results.join("kept").join(format!("{}.json", page_name(&label)));
    let content = match files::read(&[submission.to_owned()]) {
        Ok(files) => {
            let asked = [exercise.id.as_str(), if args.as_the_lab { "lab" } else { "book" }, env!("CARGO_PKG_VERSION")];
            let asked = asked.iter().map(|word| word.as_bytes());
            fingerprint(asked.chain(files.iter().flat_map(|file| [file.name.as_bytes(), &file.bytes])))
        }
        // A damaged zip, say: that is this submission's verdict and nobody else's.
        Err(error) => {
            let verdict = Verdict::new(&exercise.id, Word::Unsure, error.to_string());
            atomic::write(&page, formats::page(&label, &verdict, None).as_bytes())?;
            return Ok(Row::of(&label, &verdict, 0.0));
        }
    };
    let known = std::fs::read(&kept_path).ok().and_then(|bytes| serde_json::from_slice::<Kept>(&bytes).ok());
    if let Some(known) = known.filter(|known| known.content == content && page.exists()) {
        return Ok(known.row);
    }
    let start = Instant::now();
    let row_path = results.join("kept").join(format!("{}.row", page_name(&label)));
    // Left by a run that was stopped.
    let _ = std::fs::remove_file(&row_path);
    let ended = checked(args, exercise, submission, &label, &page, &row_path, program)?;
    let row = std::fs::read(&row_path).ok().and_then(|bytes| serde_json::from_slice::<Row>(&bytes).ok());
    let _ = std::fs::remove_file(&row_path);
    let row = match row {
        Some(row) => row,
        None => {
            let verdict = match ended {
                Ended::ByItself(_) | Ended::GivenUp => Verdict::new(
                    &exercise.id,
                    Word::Unsure,
                    "checking it ended the program that checks: a driver's fault, or too much memory",
                ),
                Ended::TooLong => Verdict::endless(&exercise.id, args.patience),
                Ended::TooLarge => Verdict::too_large(&exercise.id),
            };
            atomic::write(&page, formats::page(&label, &verdict, None).as_bytes())?;
            Row::of(&label, &verdict, start.elapsed().as_secs_f64())
        }
    };
    let kept = serde_json::to_vec(&Kept { content, row: row.clone() })
        .map_err(|error| CliError::new(format!("{} could not be written: {error}", kept_path.display())))?;
    atomic::write(&kept_path, &kept)?;
    Ok(row)
}

/// Checks in a child, which leaves a page and a row.
fn checked(
    args: &CheckArgs,
    exercise: &Exercise,
    submission: &Path,
    label: &str,
    page: &Path,
    row: &Path,
    program: &Path,
) -> Result<Ended, CliError> {
    let not_started = |error| CliError::io("gonio could not start itself for a check", &error);
    let mut command = child::command(program).map_err(not_started)?;
    command.args(["lab", "check", &exercise.id]).arg(submission).arg("--page").arg(page).arg("--row").arg(row);
    command.args(["--label", label, "--quiet", "--patience", &args.patience.to_string()]);
    if args.as_the_lab {
        command.arg("--as-the-lab");
    }
    // The child gives up by itself; this is for one that cannot.
    let mut child = command.stdout(Stdio::null()).spawn().map_err(not_started)?;
    child::wait(&mut child, Duration::from_secs(args.patience + 10), || false)
        .map_err(|error| CliError::io("gonio lost sight of a check", &error))
}

/// The same for the same pieces, on every machine and with every compiler: what was found stays known (FNV-1a, 64 bits).
fn fingerprint<'a>(pieces: impl Iterator<Item = &'a [u8]>) -> u64 {
    let mut sum: u64 = 0xcbf2_9ce4_8422_2325;
    let mut take = |bytes: &[u8]| {
        for byte in bytes {
            sum = (sum ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        }
    };
    for piece in pieces {
        take(&(piece.len() as u64).to_le_bytes());
        take(piece);
    }
    sum
}

/// Submissions that are alike, apart from what the exercise hands out.
fn similar(exercise: &Exercise, submissions: &[PathBuf]) -> Vec<(String, String, f64)> {
    let known: Vec<&str> = exercise.start_files().map(|(_, text)| text).collect();
    let fingerprints: Vec<(String, Fingerprint)> = submissions
        .iter()
        .filter_map(|path| {
            let files = files::read(std::slice::from_ref(path)).ok()?;
            let gathered = Submission::gather(files).ok()?;
            let sources = [gathered.vertex.text.as_str(), gathered.fragment.text.as_str()];
            Some((label(path), Fingerprint::of(&sources, &known)))
        })
        .collect();
    formats::similar_pairs(&fingerprints, SIMILAR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fingerprint_knows_where_a_piece_ends_and_stays_what_it_was() {
        let of = |pieces: &[&str]| fingerprint(pieces.iter().map(|piece| piece.as_bytes()));
        assert_ne!(of(&["ab", "c"]), of(&["a", "bc"]));
        assert_ne!(of(&["ab"]), of(&["ab", ""]));
        // FNV-1a of no byte is its offset basis: Fowler, Noll, Vo (draft-eastlake-fnv), section 5.
        assert_eq!(of(&[]), 0xcbf2_9ce4_8422_2325);
    }
}
