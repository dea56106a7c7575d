//! The window's checks: each in a process of its own, which may be ended whatever a shader does.

use super::worker::{self, Request, Worker};
use crate::platform::{CheckRequest, Checking};
use gonio_check::CheckOptions;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Verdict;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Duration;

/// After which a check is ended, and its verdict says so.
const PATIENCE: Duration = Duration::from_secs(25);

/// A process that checks, and the thread that waits for it.
pub struct Process {
    answers: Receiver<Result<Verdict, String>>,
    given_up: Arc<AtomicBool>,
    answered: bool,
}

/// Starts `program` on the files. An error is one sentence.
pub fn begin(program: &Path, request: &CheckRequest, ctx: &egui::Context) -> Result<Process, String> {
    let file = |(name, bytes): &(String, Vec<u8>)| SourceFile { name: name.clone(), bytes: bytes.clone() };
    let asked = Request {
        exercise: request.exercise.clone(),
        files: request.files.iter().map(file).collect(),
        options: CheckOptions { pair: None, as_the_lab: request.as_the_lab },
        ..Request::default()
    };
    let worker = worker::start(program, asked, true).map_err(|why| format!("the check could not be started: {why}"))?;
    let (sender, answers) = channel();
    let given_up = Arc::new(AtomicBool::new(false));
    let (stop, ctx) = (given_up.clone(), ctx.clone());
    std::thread::spawn(move || {
        // Nobody may listen any more.
        let _ = sender.send(answer(worker, &stop));
        ctx.request_repaint();
    });
    Ok(Process { answers, given_up, answered: false })
}

fn answer(worker: Worker, stop: &AtomicBool) -> Result<Verdict, String> {
    worker.wait(PATIENCE, || stop.load(Ordering::Relaxed)).map(|answer| answer.verdict)
}

impl Checking for Process {
    fn poll(&mut self) -> Option<Result<Verdict, String>> {
        if self.answered {
            return None;
        }
        let answer = match self.answers.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err("the check ended without an answer: try again".into()),
        };
        self.answered = true;
        Some(answer)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.given_up.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that is there everywhere that these tests run, and is not gonio.
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
    fn a_check_without_a_verdict_is_a_sentence() {
        let said = |program| ask(program).map_err(|why| why.split(':').next().unwrap_or("").to_owned());
        assert_eq!(said("/nowhere/gonio"), Err("the check could not be started".into()));
        assert_eq!(said("/bin/echo"), Err("the answer of the check could not be understood".into()));
    }
}
