//! Checks of the window: each in a process of its own, which can be ended whatever a shader does, and which a thread waits
//! for.

use super::worker::{self, WorkerRequest};
use crate::platform::{CheckRequest, CheckResult, Pending};
use gonio_check::CheckOptions;
use gonio_check::submission::SourceFile;
use gonio_language::tr;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Duration;

/// A check that takes longer is stopped, with a verdict on that.
const PATIENCE: Duration = Duration::from_secs(25);

/// Starts `program` on the files. An error is one sentence.
pub fn begin(
    program: &Path,
    request: &CheckRequest,
    ctx: &egui::Context,
) -> Result<BackgroundTask<CheckResult>, String> {
    let file = |(name, bytes): &(String, Vec<u8>)| SourceFile { name: name.clone(), bytes: bytes.clone() };
    let request = WorkerRequest {
        exercise: request.exercise.clone(),
        files: request.files.iter().map(file).collect(),
        options: CheckOptions { pair: None, as_the_lab: request.as_the_lab },
        ..WorkerRequest::default()
    };
    let mut worker = worker::start(program, request, true)
        .map_err(|error| tr!("window-the-check-could-not-be-started", error = error))?;
    let ctx = ctx.clone();
    Ok(BackgroundTask::start(
        move |is_stopped| worker.wait(PATIENCE, is_stopped).map(|answer| answer.verdict),
        move || ctx.request_repaint(),
        Err(tr!("window-the-check-ended-without-an-answer").into()),
    ))
}

/// Work that runs in a thread. It is asked to stop when this is dropped.
pub struct BackgroundTask<T> {
    results: Receiver<T>,
    stop: Arc<AtomicBool>,
    /// The result to return if the thread ends without one; `None` once there is a result.
    lost: Option<T>,
}

impl<T: Send + 'static> BackgroundTask<T> {
    /// Starts `work`, which is given a function that tells whether to stop, and calls `done` when there is a result. `lost` is
    /// the result if the thread ends without one.
    pub fn start(
        work: impl FnOnce(&dyn Fn() -> bool) -> T + Send + 'static,
        done: impl FnOnce() + Send + 'static,
        lost: T,
    ) -> Self {
        let (sender, results) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let is_stopped = stop.clone();
        std::thread::spawn(move || {
            let result = work(&|| is_stopped.load(Ordering::Relaxed));
            // The receiver is gone if the work was stopped.
            let _ = sender.send(result);
            done();
        });
        BackgroundTask { results, stop, lost: Some(lost) }
    }
}

impl<T> Pending<T> for BackgroundTask<T> {
    fn poll(&mut self) -> Option<T> {
        self.lost.as_ref()?;
        match self.results.try_recv() {
            Ok(result) => {
                self.lost = None;
                Some(result)
            }
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => self.lost.take(),
        }
    }
}

impl<T> Drop for BackgroundTask<T> {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::platform::Pending;
    use gonio_check::verdict::Verdict;

    /// The answer of another program in place of gonio.
    fn ask(program: &str) -> Result<Verdict, String> {
        let files = vec![("a.vert".into(), b"x".to_vec())];
        let request = CheckRequest { exercise: "ex04".into(), files, as_the_lab: false };
        let mut process = begin(Path::new(program), &request, &egui::Context::default())?;
        loop {
            if let Some(answer) = process.poll() {
                assert_eq!(process.poll(), None, "it answers once");
                return answer;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    #[test]
    fn a_check_without_a_verdict_is_an_error_of_one_sentence() {
        let message = |program| ask(program).map_err(|error| error.split(':').next().unwrap_or("").to_owned());
        assert_eq!(message("/nowhere/gonio"), Err("the check could not be started".into()));
        assert_eq!(message("/bin/echo"), Err("the answer of the check could not be understood".into()));
    }

    fn wait<T>(mut pending: impl Pending<T>) -> T {
        loop {
            if let Some(result) = pending.poll() {
                assert!(pending.poll().is_none(), "there is one result");
                return result;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_result_comes_once_and_a_lost_one_is_replaced() {
        assert_eq!(wait(BackgroundTask::start(|_| 1, || (), 2)), 1);
        let (sender, results) = channel();
        drop(sender);
        assert_eq!(wait(BackgroundTask { results, stop: Arc::default(), lost: Some(2) }), 2);
    }

    #[test]
    fn dropping_the_task_stops_its_work() {
        let (sender, ended) = channel();
        let work = BackgroundTask::start(
            move |is_stopped| {
                while !is_stopped() {
                    std::thread::yield_now();
                }
                let _ = sender.send(());
            },
            || (),
            (),
        );
        drop(work);
        assert_eq!(ended.recv(), Ok(()));
    }
}
