//! Running the same command again in a process of its own, which a shader may crash.

use crate::report::{CliError, Outcome};
use gonio_app::platform::desktop::{child, worker};
use std::ffi::OsString;
use std::process::Stdio;
use std::time::Duration;

/// Seconds that it may take; an endless loop takes more.
const PATIENCE_S: u64 = 30;

/// Runs this program with its own arguments and `flag` after the command's name of two words. The process prints and writes by
/// itself; the error here is that it was stopped or crashed.
pub fn run_again(flag: &str) -> Result<Outcome, CliError> {
    let not_started = |error| CliError::io("gonio cannot start itself", &error);
    let mut arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    arguments.insert(arguments.len().min(2), flag.into());
    let mut command = child::command(&super::own_program()?).map_err(not_started)?;
    command.env_remove("LP_NUM_THREADS").args(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::inherit()).stderr(Stdio::inherit());
    let mut child = command.spawn().map_err(not_started)?;
    // Its stdin stays open as long as this process waits.
    let ended = child::wait(&mut child, Duration::from_secs(PATIENCE_S), || false);
    match ended.map_err(|error| CliError::io("cannot wait for gonio's own process", &error))? {
        child::Ended::ByItself(status) => match status.code() {
            Some(0) => Ok(Outcome::Done),
            Some(1) => Ok(Outcome::CheckFailed),
            Some(2) => Err(CliError::AlreadyReported),
            _ => Err(CliError::new("drawing crashed: the graphics driver cannot compile or run this shader")),
        },
        child::Ended::TooLong => Err(CliError::new(format!(
            "drawing did not finish within {PATIENCE_S} seconds; does a shader contain an endless loop?"
        ))),
        child::Ended::TooLarge => Err(CliError::new(
            "drawing took more than a gigabyte of memory and was stopped; does a shader contain a giant array?",
        )),
        child::Ended::GivenUp => Err(CliError::new("drawing was stopped")),
    }
}

/// Ends this process when the one that waits for it has ended.
pub fn end_with_the_caller() {
    std::thread::spawn(|| worker::end_with(std::io::stdin()));
}
