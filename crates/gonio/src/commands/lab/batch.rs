//! Checking many submissions, each in a process of its own, so that none can harm the others.

use super::check::CheckArgs;
use super::intake::{ClassMember, ClassSubmissions, GatheredFiles};
use super::{child_process, text};
use crate::backend;
use crate::error::{CliError, CommandOutcome, io_reason};
use crate::output::{OutputFiles, OutputPath, atomic};
use crate::report::Reporter;

use gonio_app::platform::desktop::worker::{self, Worker, WorkerAnswer, WorkerRequest};
use gonio_check::submission::{self, SourceFile};
use gonio_check::verdict::{Outcome as Word, Verdict};
use gonio_exercises::content_hash;
use gonio_exercises::exercise::{Exercise, course_folder};
use gonio_exercises::report::{self, Fingerprint, Row, SubmissionThumbnail, page_name};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::Instant;

/// Two submissions are similar from this share on.
const SIMILAR: f64 = 0.85;
/// The format of pages: those of another one are made again.
const PAGE_FORMAT: &str = "2";
/// Most bytes of a pair of shaders that is compared with others.
const MAX_COMPARED_BYTES: usize = 256 << 10;

/// The verdict of an earlier run, with a hash of the content that was checked.
#[derive(Serialize, Deserialize)]
struct StoredVerdict {
    content: u64,
    seconds: f64,
    verdict: Verdict,
    thumbnail: Option<SubmissionThumbnail>,
}

/// A submission that was checked.
struct Checked {
    label: String,
    verdict: Verdict,
    seconds: f64,
    thumbnail: Option<SubmissionThumbnail>,
    fingerprint: Option<Fingerprint>,
}

/// Checks all submissions, and writes pages, table and overview.
pub fn run(
    args: &CheckArgs,
    exercise: &Exercise,
    class: &ClassSubmissions,
    reporter: &Reporter,
) -> Result<CommandOutcome, CliError> {
    let results = results_folder(args)?;
    let kept = results.join("kept");
    std::fs::create_dir_all(&kept)
        .map_err(|error| CliError::io(format!("cannot create the folder `{}`", kept.display()), &error))?;
    let program = child_process::own_program()?;
    let next = AtomicUsize::new(0);
    let checked = Mutex::new(Vec::new());
    let progress = reporter.progress("checking");
    backend::report_driver(reporter);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                let mut process = ClassProcess { program: &program, worker: None, checks: 0 };
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(submission) = class.submissions.get(index) else { return };
                    let one = one(args, exercise, submission, &results, &mut process);
                    if let Ok(mut checked) = checked.lock() {
                        checked.push(one);
                        progress.set(checked.len() as f64 / class.submissions.len() as f64);
                    }
                }
            });
        }
    });
    drop(progress);
    let checked = checked.into_inner().unwrap_or_default().into_iter().collect::<Result<Vec<Checked>, CliError>>()?;
    let outcome = report(args, exercise, checked, class, &results, reporter)?;
    for skipped in &class.skipped {
        reporter.note(format!("skipped: {skipped}"));
    }
    Ok(outcome)
}

/// Writes the files about the whole class, and reports them.
fn report(
    args: &CheckArgs,
    exercise: &Exercise,
    mut checked: Vec<Checked>,
    class: &ClassSubmissions,
    results: &Path,
    reporter: &Reporter,
) -> Result<CommandOutcome, CliError> {
    checked.sort_by(|a, b| a.label.cmp(&b.label));
    link_pages(&checked, results)?;
    let row = |one: &mut Checked| Row::new(&one.label, &one.verdict, one.seconds).with_thumbnail(one.thumbnail.take());
    let rows: Vec<Row> = checked.iter_mut().map(row).collect();
    let fingerprints: Vec<(String, Fingerprint)> =
        checked.iter_mut().filter_map(|one| Some((one.label.clone(), one.fingerprint.take()?))).collect();
    let similar = report::similar_groups(&report::similar_pairs(&fingerprints, SIMILAR));
    let overview = report::overview(&report::Overview {
        title: exercise.title(),
        rows: &rows,
        similar: &similar,
        skipped: &class.skipped,
        most_points: args.most_points(exercise),
        has_scheme: exercise.points.is_some(),
    });
    let mut files = OutputFiles::new();
    files.add(&results.join("index.html"), overview.as_bytes())?;
    files.add(&results.join("table.csv"), report::csv(&rows, args.most_points(exercise)).as_bytes())?;
    let is_stdout_taken = args.junit.as_ref().is_some_and(OutputPath::is_stdout);
    if let Some(output) = &args.junit {
        let verdicts: Vec<(String, Verdict)> = checked.into_iter().map(|one| (one.label, one.verdict)).collect();
        files.add_output(output, report::junit(&verdicts).into_bytes())?;
    }
    files.commit()?;
    if reporter.json() {
        reporter.report(&rows)?;
    } else {
        let table = text::table(&rows, &similar);
        if is_stdout_taken {
            reporter.text_on_stderr(&table);
        } else {
            reporter.text(&table)?;
        }
        reporter.note(format!(
            "wrote the overview to {} and the table to {}",
            results.join("index.html").display(),
            results.join("table.csv").display()
        ));
    }
    let right = rows.iter().all(|row| row.verdict == Word::Correct);
    Ok(if right { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

/// Links each page to the overview and to the pages before and after it, which another run may have added or removed.
fn link_pages(checked: &[Checked], results: &Path) -> Result<(), CliError> {
    let mut labels: Vec<&str> = checked.iter().map(|one| one.label.as_str()).collect();
    report::in_page_order(&mut labels);
    for (at, label) in labels.iter().enumerate() {
        let path = results.join(page_name(label));
        let bytes = std::fs::read(&path)
            .map_err(|error| CliError::io(format!("cannot read the page `{}` again", path.display()), &error))?;
        let page = String::from_utf8_lossy(&bytes);
        let before = at.checked_sub(1).map(|before| labels[before]);
        let linked = report::with_neighbours(&page, before, labels.get(at + 1).copied());
        if linked != page {
            atomic::write(&path, linked.as_bytes())?;
        }
    }
    Ok(())
}

/// The folder for the results, which is never inside the submissions.
fn results_folder(args: &CheckArgs) -> Result<PathBuf, CliError> {
    let absolute = |path: &Path| {
        std::path::absolute(path)
            .and_then(|path| existing_part_resolved(&path))
            .map_err(|error| CliError::new(format!("{}: {}", path.display(), io_reason(&error))))
    };
    let inputs = args.files.iter().map(|path| absolute(path)).collect::<Result<Vec<PathBuf>, CliError>>()?;
    let results = match &args.output {
        Some(folder) => folder.clone(),
        None => {
            // For several inputs, their common folder counts: `check ex04 submissions/*`.
            let place = match inputs.as_slice() {
                [only] => Some(only.as_path()),
                [first, rest @ ..] => first.parent().filter(|parent| rest.iter().all(|p| p.parent() == Some(parent))),
                [] => None,
            };
            let beside = place.and_then(|place| {
                let name = if place.is_dir() { place.file_name() } else { place.file_stem() };
                Some(place.with_file_name(format!("{}-results", name?.to_string_lossy())))
            });
            beside.ok_or_else(|| CliError::new("name a folder for the results with -o FOLDER"))?
        }
    };
    let place = absolute(&results)?;
    match inputs.iter().find(|input| place.starts_with(input)) {
        Some(input) => Err(CliError::new(format!(
            "`{}` is inside `{}`, and nothing is written into submissions; name a folder outside with -o FOLDER",
            results.display(),
            input.display()
        ))),
        None => Ok(results),
    }
}

/// An absolute path without links and `..`, whose end may not exist yet.
fn existing_part_resolved(path: &Path) -> std::io::Result<PathBuf> {
    match (path.canonicalize(), path.parent(), path.file_name()) {
        (Ok(resolved), ..) => Ok(resolved),
        (Err(error), Some(parent), Some(name)) if error.kind() == std::io::ErrorKind::NotFound => {
            Ok(existing_part_resolved(parent)?.join(name))
        }
        (Err(error), ..) => Err(error),
    }
}

/// Checks one submission, or reads the verdict of an earlier run.
fn one(
    args: &CheckArgs,
    exercise: &Exercise,
    submission: &ClassMember,
    results: &Path,
    process: &mut ClassProcess<'_>,
) -> Result<Checked, CliError> {
    let label = submission.label.clone();
    let page = results.join(page_name(&label));
    let kept_path = results.join("kept").join(format!("{}.json", page_name(&label)));
    let gathered = submission.gather();
    let content = content(args, exercise, &gathered.files, &gathered.left_out);
    let fingerprint = fingerprint_of(exercise, &gathered.files);
    let known = std::fs::read(&kept_path).ok().and_then(|bytes| serde_json::from_slice::<StoredVerdict>(&bytes).ok());
    if let Some(StoredVerdict { verdict, seconds, thumbnail, .. }) =
        known.filter(|known| known.content == content && page.exists())
    {
        return Ok(Checked { label, verdict, seconds, thumbnail, fingerprint });
    }
    let start = Instant::now();
    let WorkerAnswer { verdict, page: made, thumbnail, .. } = match gathered.left_out.first() {
        // A damaged zip, say, is the verdict about this submission alone.
        Some(reason) if gathered.files.is_empty() => unsure(exercise, reason.clone()),
        _ => checked(args, exercise, gathered, &label, process)?,
    };
    let seconds = start.elapsed().as_secs_f64();
    let made = made.unwrap_or_else(|| report::page(&label, &verdict, None, &submission.gather().files).into_bytes());
    atomic::write(&page, &made)?;
    let stored = StoredVerdict { content, seconds, verdict: verdict.clone(), thumbnail: thumbnail.clone() };
    let kept = serde_json::to_vec(&stored)
        .map_err(|error| CliError::new(format!("cannot write {}: {error}", kept_path.display())))?;
    atomic::write(&kept_path, &kept)?;
    Ok(Checked { label, verdict, seconds, thumbnail, fingerprint })
}

/// The answer about a submission that could not be checked.
fn unsure(exercise: &Exercise, reason: String) -> WorkerAnswer {
    let verdict = Verdict::new(&exercise.id, Word::Unsure, reason);
    WorkerAnswer { verdict, page: None, thumbnail: None, sheet: None }
}

/// Checks in one process: what a driver or the checker keeps of them must not grow without end.
const MOST_CHECKS: usize = 50;

/// A process that checks one submission after the other, until one of them ends it.
struct ClassProcess<'a> {
    program: &'a Path,
    worker: Option<Worker>,
    checks: usize,
}

impl ClassProcess<'_> {
    /// The process with a request.
    fn asked(&mut self, request: WorkerRequest) -> Result<&mut Worker, std::io::Error> {
        let worker = match self.worker.take().filter(|worker| worker.is_alive() && self.checks < MOST_CHECKS) {
            Some(mut worker) => {
                worker.ask(request);
                worker
            }
            None => {
                self.checks = 0;
                worker::start(self.program, request, true)?
            }
        };
        self.checks += 1;
        Ok(self.worker.insert(worker))
    }
}

/// The verdict, and the page and its thumbnail if the process got as far as making them.
fn checked(
    args: &CheckArgs,
    exercise: &Exercise,
    gathered: GatheredFiles,
    label: &str,
    process: &mut ClassProcess<'_>,
) -> Result<WorkerAnswer, CliError> {
    let mut request = args.request(exercise, gathered);
    request.page = Some(label.to_owned());
    let not_started = |error| CliError::io("gonio cannot start itself for a check", &error);
    let worker = process.asked(request).map_err(not_started)?;
    Ok(match worker.wait(args.patience(), || false) {
        Ok(answer) => answer,
        Err(reason) => unsure(exercise, reason),
    })
}

/// A hash of everything that a verdict depends on.
fn content(args: &CheckArgs, exercise: &Exercise, files: &[SourceFile], left_out: &[String]) -> u64 {
    let convention = if args.as_the_lab { "lab" } else { "book" };
    let api = if args.es { "es" } else { "core" };
    let pair = args.pair.as_deref().unwrap_or_default();
    let feedback = args.feedback.unwrap_or(exercise.feedback).word();
    let course = course_key(exercise);
    let options =
        [exercise.id.as_str(), convention, api, pair, feedback, course, env!("CARGO_PKG_VERSION"), PAGE_FORMAT];
    let options = options.into_iter().chain(left_out.iter().map(String::as_str)).map(str::as_bytes);
    content_hash(options.chain(files.iter().flat_map(|file| [file.name.as_bytes(), &file.bytes])))
}

/// What a course states about the exercise of this batch that changes verdicts and points; nothing for a built-in one.
fn course_key(exercise: &Exercise) -> &'static str {
    // Stored pictures have millions of digits.
    static KEY: OnceLock<String> = OnceLock::new();
    KEY.get_or_init(|| match (course_folder(), &exercise.points) {
        (None, None) => String::new(),
        (_, points) => {
            let bytes = exercise.picture_judge().map(|judge| format!("{judge:?}")).unwrap_or_default();
            format!("{points:?} {} {:016x}", exercise.like(), content_hash(std::iter::once(bytes.as_bytes())))
        }
    })
}

/// The fingerprint of a submission for comparisons, without the text that the exercise provides.
fn fingerprint_of(exercise: &Exercise, files: &[SourceFile]) -> Option<Fingerprint> {
    let known: Vec<&str> = exercise.start_files().map(|(_, text)| text).collect();
    let gathered = submission::Submission::gather(files.to_vec()).ok()?;
    let sources = [gathered.vertex.text.as_str(), gathered.fragment.text.as_str()];
    let is_small = sources.iter().map(|text| text.len()).sum::<usize>() <= MAX_COMPARED_BYTES;
    is_small.then(|| Fingerprint::new(&sources, &known))
}
