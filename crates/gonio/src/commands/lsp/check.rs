//! Checks in the background: one at a time, in a worker process, given up when its text changes.

use super::LspOptions;
use super::sources::Sources;
use gonio_app::platform::desktop::worker::{self, WorkerRequest};
use gonio_check::CheckOptions;
use gonio_check::feedback::Feedback;
use gonio_check::verdict::{CompilerMessage, Verdict};
use gonio_exercises::step::RightAnswer;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The result of a check.
pub enum CheckResult {
    /// The verdict, reduced to what may be shown.
    Verdict(Box<Verdict>),
    /// There is no verdict, because OpenGL is missing for example: the reason, and causes that were found without it.
    Unavailable { reason: String, causes: Vec<CompilerMessage> },
}

/// A check that waits or runs; dropping it gives it up.
pub struct RunningCheck(Arc<AtomicBool>);

impl Drop for RunningCheck {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Starts a check; `done` is called with its result, unless it was given up. The texts of the reasons are in the server's language.
///
/// # Errors
/// Those of starting a thread.
pub fn start(
    options: &LspOptions,
    sources: &Sources,
    turn: &Arc<Mutex<()>>,
    done: impl FnOnce(CheckResult) + Send + 'static,
) -> std::io::Result<Option<RunningCheck>> {
    let Some(exercise) = sources.exercise else { return Ok(None) };
    let given_up = Arc::new(AtomicBool::new(false));
    let (stop, turn, sources) = (Arc::clone(&given_up), Arc::clone(turn), sources.clone());
    let (program, patience, feedback) = (options.program.clone(), options.patience, options.feedback);
    std::thread::Builder::new().stack_size(64 << 20).spawn(move || {
        let _turn = turn.lock().unwrap_or_else(PoisonError::into_inner);
        let stops = || stop.load(Ordering::Relaxed);
        if stops() {
            return;
        }
        let request = WorkerRequest {
            exercise: exercise.id.clone(),
            files: sources.files.clone(),
            options: CheckOptions { pair: sources.pair.clone(), as_the_lab: false },
            feedback,
            ..WorkerRequest::default()
        };
        // One core: the editor and its user need the others.
        let answer = worker::start(&program, request, true)
            .map_err(|error| error.to_string())
            .and_then(|mut worker| worker.wait(patience, stops));
        if stops() {
            return;
        }
        done(match answer {
            Ok(answer) => CheckResult::Verdict(Box::new(answer.verdict)),
            Err(reason) => {
                let may_place = feedback.unwrap_or(exercise.feedback) >= Feedback::Line && !sources.has_errors();
                let pair = sources.submitted.as_ref().filter(|_| may_place);
                let right = pair.and_then(|pair| Some((RightAnswer::new(exercise, pair)?, pair)));
                let causes = right.map(|(right, pair)| right.messages(pair)).unwrap_or_default();
                CheckResult::Unavailable { reason, causes }
            }
        });
    })?;
    Ok(Some(RunningCheck(given_up)))
}
