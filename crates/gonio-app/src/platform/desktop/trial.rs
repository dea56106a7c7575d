//! A trial in a process of its own: `gonio lab trial`. It may crash or be stopped without harm to the window.
//!
//! The process reads the files from its standard input ([`worker::read_request`]) and answers with JSON ([`TrialAnswer`]). Its
//! input stays open until its answer is known: it ends by itself when the window is gone.

use super::check::BackgroundTask;
use super::child::{self, Ended};
use super::worker::{self, WorkerRequest};
use crate::files::ShaderFiles;
use crate::platform::{CheckRequest, TrialOutcome};
use gonio_check::submission::SourceFile;
use gonio_language::{Language, tr};
use serde::{Deserialize, Serialize};
use std::io::{Error, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::channel;
use std::time::Duration;

/// Time limit of a trial. A correct answer takes a fraction of a second.
const MOST_TIME: Duration = Duration::from_secs(15);
/// The exit code of gonio for errors of its own, such as an invalid command line.
const CODE_OF_ERRORS: i32 = 2;

/// The answer of the process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "answer")]
pub enum TrialAnswer {
    /// The pair was compiled and drawn, or refused by the compiler.
    Harmless,
    /// The window would hang for this many seconds at each picture.
    Slow {
        /// Estimated from a small picture.
        seconds: f64,
    },
    /// OpenGL reported an error while the pair was drawn.
    Failed {
        /// OpenGL's message.
        why: String,
    },
    /// OpenGL is not available.
    Unavailable {
        /// One sentence.
        why: String,
    },
}

/// Starts the trial; `done` is called when there is an outcome. An error is one sentence.
pub fn begin(
    program: &Path,
    request: &CheckRequest,
    done: impl FnOnce() + Send + 'static,
) -> Result<BackgroundTask<TrialOutcome>, String> {
    let failed = |why: Error| tr!("window-the-shader-test-could-not-be-2", why = why);
    let mut command = child::command(program).map_err(failed)?;
    command.args(["lab", "trial", &request.exercise, "--language", Language::current().code()]);
    command.args(worker::course_options());
    run(command, &request.files, done).map_err(failed)
}

/// Starts a trial of the user's own shaders: `gonio render` draws a small picture with them. Its input stays open until it has
/// ended. An error is one sentence.
pub fn begin_own(
    program: &Path,
    files: &ShaderFiles,
    done: impl FnOnce() + Send + 'static,
) -> Result<BackgroundTask<TrialOutcome>, String> {
    let failed = |why: Error| tr!("window-the-shader-test-could-not-be-2", why = why);
    let mut command = child::command(program).map_err(failed)?;
    command.args(["render", "builtin:cube", "--in-this-process", "--quiet", "--size", "128x128", "-o", "-"]);
    for (option, file) in [("--vertex", &files.vertex), ("--fragment", &files.fragment)] {
        command.args(file.iter().map(|file| format!("{option}={file}")));
    }
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().map_err(failed)?;
    let mut finish = move |is_stopped: &dyn Fn() -> bool| match child::wait(&mut child, MOST_TIME, is_stopped) {
        // The window compiles them too, and reports the errors.
        Ok(Ended::ByItself(status)) if status.code() == Some(CODE_OF_ERRORS) => TrialOutcome::Harmless,
        Ok(Ended::ByItself(status)) if status.success() => TrialOutcome::Harmless,
        Ok(Ended::ByItself(status)) => answered(status, ""),
        Ok(other) => stopped(other),
        Err(why) => TrialOutcome::Unavailable(tr!("window-the-shader-test-could-not-be", why = why)),
    };
    let lost = TrialOutcome::Unavailable(tr!("window-the-test-of-these-shaders-ended").into());
    Ok(BackgroundTask::start(move |is_stopped| finish(is_stopped), done, lost))
}

fn run(
    mut command: Command,
    files: &[(String, Vec<u8>)],
    done: impl FnOnce() + Send + 'static,
) -> Result<BackgroundTask<TrialOutcome>, Error> {
    let file = |(name, bytes): &(String, Vec<u8>)| SourceFile { name: name.clone(), bytes: bytes.clone() };
    let input =
        worker::encoded(&WorkerRequest { files: files.iter().map(file).collect(), ..WorkerRequest::default() })?;
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
    Ok(BackgroundTask::start(
        move |is_stopped| finish(&mut child, input, is_stopped),
        done,
        TrialOutcome::Unavailable(tr!("window-the-test-of-this-shader-ended").into()),
    ))
}

/// Writes the input, waits for the end, and reads the answer. Each pipe has a thread, so that a process that neither reads nor
/// answers is stopped in time.
fn finish(child: &mut Child, input: Vec<u8>, given_up: impl Fn() -> bool) -> TrialOutcome {
    let (done, is_done) = channel::<()>();
    if let Some(mut pipe) = child.stdin.take() {
        std::thread::spawn(move || {
            // A process that ended early has not read it all. The pipe is closed when `done` is dropped.
            let _ = pipe.write_all(&input).and_then(|()| pipe.flush());
            let _ = is_done.recv();
        });
    }
    let (sender, output) = channel();
    if let Some(pipe) = child.stdout.take() {
        std::thread::spawn(move || {
            let mut text = String::new();
            // Output that is not UTF-8 is not an answer.
            let _ = pipe.take(1 << 16).read_to_string(&mut text);
            let _ = sender.send(text);
        });
    }
    let ended = child::wait(child, MOST_TIME, given_up);
    drop(done);
    match ended {
        Ok(Ended::ByItself(status)) => answered(status, &output.recv().unwrap_or_default()),
        Ok(other) => stopped(other),
        Err(why) => TrialOutcome::Unavailable(tr!("window-the-shader-test-could-not-be", why = why)),
    }
}

fn answered(status: ExitStatus, output: &str) -> TrialOutcome {
    if status.code() == Some(CODE_OF_ERRORS) {
        return TrialOutcome::Unavailable(tr!("window-the-shader-could-not-be-tested").into());
    }
    if !status.success() {
        return TrialOutcome::Refused(tr!("window-this-shader-crashed-the-process-that").into());
    }
    match serde_json::from_str(output) {
        Ok(TrialAnswer::Harmless) => TrialOutcome::Harmless,
        Ok(TrialAnswer::Slow { seconds }) => {
            TrialOutcome::Refused(tr!("window-this-shader-needs-about-seconds-for", seconds = format!("{seconds:.0}")))
        }
        Ok(TrialAnswer::Failed { why }) => TrialOutcome::Refused(tr!("window-this-shader-failed-in-a-test", why = why)),
        Ok(TrialAnswer::Unavailable { why }) => TrialOutcome::Unavailable(why),
        Err(_) => TrialOutcome::Unavailable(tr!("window-the-process-that-tests-shaders-gave").into()),
    }
}

fn stopped(ended: Ended) -> TrialOutcome {
    match ended {
        Ended::TooLong => {
            TrialOutcome::Refused(tr!("window-this-shader-did-not-finish-within", seconds = MOST_TIME.as_secs()))
        }
        Ended::TooLarge => TrialOutcome::Refused(tr!("window-this-shader-took-more-than-1").into()),
        Ended::GivenUp | Ended::ByItself(_) => {
            TrialOutcome::Unavailable(tr!("window-the-test-of-this-shader-was").into())
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::platform::Pending;
    use std::time::Instant;

    /// The outcome of a shell script in place of gonio.
    #[cfg(unix)]
    fn outcome(script: &str, files: &[(String, Vec<u8>)]) -> TrialOutcome {
        let mut command = child::command(Path::new("/bin/sh")).unwrap();
        command.args(["-c", script]);
        wait(run(command, files, || ()).unwrap())
    }

    fn wait(mut process: BackgroundTask<TrialOutcome>) -> TrialOutcome {
        loop {
            if let Some(outcome) = process.poll() {
                assert_eq!(process.poll(), None, "it answers once");
                return outcome;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    #[cfg(unix)]
    fn refused(script: &str) -> String {
        match outcome(script, &[]) {
            TrialOutcome::Refused(why) => why,
            other => panic!("{script}: {other:?}"),
        }
    }

    #[test]
    #[cfg(unix)]
    fn only_crashes_are_reported_as_crashes() {
        for script in ["kill -SEGV $$", "kill -ABRT $$", "exit 101"] {
            let why = refused(script);
            assert!(why.contains("crashed the process that tests it") && !why.contains('\n'), "{why}");
        }
        assert!(
            refused(r#"echo '{"answer":"slow","seconds":12.3}'"#).contains("about 12 seconds for a single picture")
        );
        assert!(refused(r#"echo '{"answer":"failed","why":"out of memory"}'"#).ends_with(": out of memory"));
        assert_eq!(outcome(r#"echo '{"answer":"harmless"}'"#, &[]), TrialOutcome::Harmless);
        for script in ["exit 2", "true", "echo words", r#"echo '{"answer":"unavailable","why":"no OpenGL"}'"#] {
            assert!(matches!(outcome(script, &[]), TrialOutcome::Unavailable(_)), "{script}");
        }
    }

    /// A pipe holds 64 kB; neither side may wait for the other forever.
    #[test]
    #[cfg(unix)]
    fn a_process_that_does_not_read_its_input_still_ends() {
        let large = [("a.frag".to_owned(), vec![b' '; 1 << 20])];
        assert!(matches!(outcome("exit 3", &large), TrialOutcome::Refused(_)));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_trial_that_uses_too_much_memory_is_refused() {
        assert!(refused("a=xxxxxxxx; while :; do a=$a$a; done").contains("more than 1 GB of memory"));
    }

    #[test]
    fn a_stopped_process_has_an_outcome() {
        let TrialOutcome::Refused(why) = stopped(Ended::TooLong) else { panic!("it is not refused") };
        assert!(why.contains("within 15 seconds"), "{why}");
        assert!(matches!(stopped(Ended::GivenUp), TrialOutcome::Unavailable(_)));
    }

    #[test]
    #[cfg(unix)]
    fn a_trial_that_is_dropped_ends_its_process() {
        let folder = std::env::temp_dir().join(format!("gonio-trial-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("pid");
        let mut command = child::command(Path::new("/bin/sh")).unwrap();
        command.args(["-c", "echo $$ > \"$0\"; exec sleep 600"]).arg(&file);
        let process = run(command, &[], || ()).unwrap();
        let start = Instant::now();
        let number = loop {
            let text = std::fs::read_to_string(&file).unwrap_or_default();
            if text.ends_with('\n') {
                break text.trim().to_owned();
            }
            assert!(start.elapsed() < Duration::from_secs(60), "it was not started");
        };
        let script = format!("kill -0 {number} 2>/dev/null");
        let is_alive = || Command::new("/bin/sh").args(["-c", &script]).status().unwrap().success();
        assert!(is_alive());
        drop(process);
        while is_alive() {
            assert!(start.elapsed() < Duration::from_secs(60), "it was not ended");
            std::thread::sleep(Duration::from_millis(5));
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
