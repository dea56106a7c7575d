//! Checks of submissions. A shader may crash a driver, so the package calls this in a process of its own.

use crate::error::{Failure, without_lock};
use crate::json;
use gonio_check::CheckOptions;
use gonio_check::feedback::Feedback;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Verdict;
use gonio_exercises::exercise::{self, Exercise};
use gonio_exercises::{Checker, report};
use gonio_gl::HeadlessContext;
use pyo3::prelude::*;
use serde_json::{Map, Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Stack of the thread that reads, compiles and draws: drivers recurse along the shader. The system commits only what is used.
const STACK_BYTES: usize = 256 << 20;
/// Most bytes of a file that the page may show.
const MAX_SHOWN_BYTES: usize = 1 << 20;

/// Checks the files (name and bytes) of one submission. Returns the verdict as JSON, and as a web page.
#[pyfunction]
#[pyo3(signature = (exercise, files, label, pair, as_the_lab, feedback))]
pub fn check_submission(
    py: Python<'_>,
    exercise: &str,
    files: Vec<(String, Vec<u8>)>,
    label: String,
    pair: Option<String>,
    as_the_lab: bool,
    feedback: Option<String>,
) -> PyResult<(String, String)> {
    let exercise = find(exercise)?;
    let feedback = match feedback {
        None => exercise.feedback,
        Some(word) => *Feedback::ALL.iter().find(|level| level.word() == word).ok_or_else(|| {
            let words = Feedback::ALL.map(Feedback::word).join(", ");
            Failure(format!("invalid feedback `{word}`: expected {words}"))
        })?,
    };
    let files: Vec<SourceFile> = files.into_iter().map(|(name, bytes)| SourceFile { name, bytes }).collect();
    let options = CheckOptions { pair, as_the_lab };
    let (verdict, page) = without_lock(py, move || {
        let work = move || {
            let checked = AssertUnwindSafe(|| check(exercise, files, &label, &options, feedback));
            catch_unwind(checked).unwrap_or_else(|panic| Err(Failure::of_panic(panic.as_ref())))
        };
        let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(work);
        let thread = thread.map_err(|error| Failure(format!("cannot start the check: {error}")))?;
        thread.join().unwrap_or_else(|panic| Err(Failure::of_panic(panic.as_ref())))
    })?;
    Ok((json(&verdict)?, page))
}

/// The verdict on a check that was stopped after `seconds`, or whose process crashed; as [`check_submission`] returns it.
#[pyfunction]
#[pyo3(signature = (exercise, label, seconds))]
pub fn stopped_check(exercise: &str, label: &str, seconds: Option<u64>) -> PyResult<(String, String)> {
    let exercise = find(exercise)?;
    let verdict = match seconds {
        Some(seconds) => Verdict::endless(&exercise.id, seconds),
        None => Verdict::crashed(&exercise.id),
    };
    Ok((json(&verdict)?, report::page(label, &verdict, None, &[])))
}

fn check(
    exercise: &Exercise,
    files: Vec<SourceFile>,
    label: &str,
    options: &CheckOptions,
    feedback: Feedback,
) -> Result<(Verdict, String), Failure> {
    let context = HeadlessContext::new()?;
    let mut checker = Checker::new(context.gl());
    let sources: Vec<SourceFile> = files.iter().filter(|file| file.bytes.len() <= MAX_SHOWN_BYTES).cloned().collect();
    let (verdict, evidence) = gonio_exercises::check(&mut checker, exercise, files, options, feedback)?;
    let page = report::page(label, &verdict, evidence.as_ref(), &sources);
    Ok((verdict, page))
}

fn find(word: &str) -> Result<&'static Exercise, Failure> {
    exercise::find(word).ok_or_else(|| {
        let ids: Vec<&str> = exercise::all().iter().map(|exercise| exercise.id.as_str()).collect();
        Failure(format!("there is no exercise `{word}`; the exercises are {}", ids.join(", ")))
    })
}

/// All exercises with the files to start from, as JSON.
#[pyfunction]
pub fn exercises() -> PyResult<String> {
    let one = |exercise: &Exercise| {
        let files: Map<String, Value> =
            exercise.start_files().map(|(name, text)| (Exercise::given_name(name).to_owned(), text.into())).collect();
        json!({ "id": exercise.id, "title": exercise.title(), "summary": exercise.summary(), "files": files })
    };
    json(&exercise::all().iter().map(one).collect::<Vec<Value>>())
}
