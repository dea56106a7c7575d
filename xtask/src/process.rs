//! Runs other programs and captures their output.

use std::io::{PipeReader, Read};
use std::path::Path;
use std::process::{Child, Command};
use std::sync::mpsc;
use std::time::{Duration, Instant};

/// The outcome of a program.
pub struct Outcome {
    /// Whether it ran and exited with 0.
    pub success: bool,
    /// Its stdout and stderr in order, or the reason why it could not be started.
    pub text: String,
}

/// The cargo that runs this program, in the repository's root folder.
pub fn cargo(root: &Path) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root);
    // `cargo run` sets variables about its own package. Build scripts would see them as changes and run again.
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        if text.starts_with("CARGO_PKG_") || text.starts_with("CARGO_MANIFEST_") || text == "CARGO_PRIMARY_PACKAGE" {
            command.env_remove(&name);
        }
    }
    command.env("CARGO_TERM_COLOR", "never");
    command
}

/// Runs a program to its end, with stdout and stderr in one text in the order they were written.
pub fn run(command: &mut Command) -> Outcome {
    match run_or_error(command) {
        Ok(outcome) => outcome,
        Err(error) => not_run(command, &error),
    }
}

/// Runs a program like [`run`], for at most `limit`. Then it is ended, which is a failure. With it ends every program that it has
/// started, also when it ends by itself: one that it leaves behind would hold its stdout open, and be waited for without end.
pub fn run_within(command: &mut Command, limit: Duration) -> Outcome {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    match run_within_or_error(command, limit) {
        Ok(outcome) => outcome,
        Err(error) => not_run(command, &error),
    }
}

fn not_run(command: &Command, error: &std::io::Error) -> Outcome {
    let program = command.get_program().to_string_lossy().into_owned();
    Outcome { success: false, text: format!("cannot run `{program}`: {error}{}\n", how_to_install(&program)) }
}

fn run_within_or_error(command: &mut Command, limit: Duration) -> std::io::Result<Outcome> {
    let (mut reader, mut child) = started(command)?;
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut piece = [0; 4096];
        while let Ok(count @ 1..) = reader.read(&mut piece) {
            if sender.send(piece[..count].to_vec()).is_err() {
                break;
            }
        }
    });
    let end = Instant::now() + limit;
    let status = loop {
        match child.try_wait()? {
            None if Instant::now() < end => std::thread::sleep(Duration::from_millis(50)),
            status => break status,
        }
    };
    end_group(&mut child);
    let mut bytes = Vec::new();
    // What was written before the end is in the pipe.
    let is_closed = loop {
        match receiver.recv_timeout(Duration::from_secs(5)) {
            Ok(piece) => bytes.extend(piece),
            Err(error) => break error == mpsc::RecvTimeoutError::Disconnected,
        }
    };
    let mut text = String::from_utf8_lossy(&bytes).into_owned();
    if status.is_none() {
        text.push_str(&format!("\nended after {} s, its limit\n", limit.as_secs()));
    }
    if !is_closed {
        text.push_str("\na program that it started still holds its stdout open\n");
    }
    Ok(Outcome { success: status.is_some_and(|status| status.success()), text })
}

/// Ends a program, and on Unix its whole group, which it leads.
fn end_group(child: &mut Child) {
    #[cfg(unix)]
    // An error only says that nothing was left.
    let _ = Command::new("kill")
        .args(["-KILL", "--", &format!("-{}", child.id())])
        .stderr(std::process::Stdio::null())
        .status();
    let _ = child.kill();
    let _ = child.wait();
}

/// Starts a program with stdout and stderr in one pipe.
fn started(command: &mut Command) -> std::io::Result<(PipeReader, Child)> {
    let (reader, writer) = std::io::pipe()?;
    command.stdin(std::process::Stdio::null()).stdout(writer.try_clone()?).stderr(writer);
    let child = command.spawn()?;
    // The command holds the writing ends of the pipe, and reading ends only when they are closed.
    command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null());
    Ok((reader, child))
}

fn run_or_error(command: &mut Command) -> std::io::Result<Outcome> {
    let (mut reader, mut child) = started(command)?;
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes)?;
    let status = child.wait()?;
    Ok(Outcome { success: status.success(), text: String::from_utf8_lossy(&bytes).into_owned() })
}

/// Runs a program to its end. Returns its stdout, or its stderr as the error if it failed.
pub fn stdout_of(command: &mut Command) -> Result<String, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command
        .stdin(std::process::Stdio::null())
        .output()
        .map_err(|error| format!("cannot run `{program}`: {error}{}", how_to_install(&program)))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(format!("`{program}` failed: {}", String::from_utf8_lossy(&output.stderr).trim()))
}

/// How to install a missing program.
fn how_to_install(program: &str) -> String {
    let advice = match Path::new(program).file_name().and_then(|n| n.to_str()).unwrap_or(program) {
        "cargo" | "rustup" => "install it from https://rustup.rs",
        "git" => "install the package `git`",
        "apt-get" | "dpkg-query" => "this system is not Debian",
        "node" | "npm" => "install the packages `nodejs npm`",
        "python3" => "install the packages `python3 python3-venv`",
        _ => return String::new(),
    };
    format!("; {advice}")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_missing_program_is_a_failure_that_names_it() {
        let outcome = run(&mut Command::new("no-such-program-of-gonio"));
        assert!(!outcome.success);
        assert!(outcome.text.contains("no-such-program-of-gonio"), "{}", outcome.text);
        assert!(stdout_of(&mut Command::new("no-such-program-of-gonio")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn both_streams_and_the_exit_code_are_kept() {
        let outcome = run(Command::new("sh").args(["-c", "echo one; echo two >&2; exit 3"]));
        assert!(!outcome.success);
        assert_eq!(outcome.text, "one\ntwo\n");
        assert_eq!(stdout_of(Command::new("sh").args(["-c", "echo one; echo two >&2"])).unwrap(), "one\n");
    }

    #[cfg(unix)]
    #[test]
    fn a_program_that_hangs_is_ended_with_those_that_it_started() {
        let hung = run_within(Command::new("sh").args(["-c", "echo one; sleep 1000"]), Duration::from_millis(300));
        assert!(!hung.success);
        assert_eq!(hung.text, "one\n\nended after 0 s, its limit\n");
        // The sleeper holds stdout open after its parent has ended.
        let left = run_within(Command::new("sh").args(["-c", "sleep 1000 & echo one"]), Duration::from_secs(100));
        assert!(left.success);
        assert_eq!(left.text, "one\n");
    }
}
