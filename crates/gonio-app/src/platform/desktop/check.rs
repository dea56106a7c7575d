//! Checks of the window: each in a process of its own, which can be ended whatever a shader does.

use super::background::Background;
use super::worker::{self, Request};
use crate::platform::{CheckRequest, CheckResult};
use gonio_check::CheckOptions;
use gonio_check::submission::SourceFile;
use std::path::Path;
use std::time::Duration;

/// A check that takes longer is ended, and its verdict says so.
const PATIENCE: Duration = Duration::from_secs(25);

/// Starts `program` on the files. An error is one sentence.
pub fn begin(program: &Path, request: &CheckRequest, ctx: &egui::Context) -> Result<Background<CheckResult>, String> {
    let file = |(name, bytes): &(String, Vec<u8>)| SourceFile { name: name.clone(), bytes: bytes.clone() };
    let request = Request {
        exercise: request.exercise.clone(),
        files: request.files.iter().map(file).collect(),
        options: CheckOptions { pair: None, as_the_lab: request.as_the_lab },
        ..Request::default()
    };
    let worker =
        worker::start(program, request, true).map_err(|why| format!("the check could not be started: {why}"))?;
    let ctx = ctx.clone();
    Ok(Background::start(
        move |is_stopped| worker.wait(PATIENCE, is_stopped).map(|answer| answer.verdict),
        move || ctx.request_repaint(),
        Err("the check ended without an answer: try again".into()),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::platform::Pending;
    use gonio_check::verdict::Verdict;

    /// The answer of a program that exists wherever these tests run, and is not gonio.
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
