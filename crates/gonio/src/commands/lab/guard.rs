//! The same command once more, in a process that a shader may crash.

use crate::report::{CliError, Outcome};
use gonio_app::platform::desktop::{child, worker};
use std::ffi::OsString;
use std::process::Stdio;
use std::time::Duration;

/// Seconds that it may take: a loop that never ends takes more.
const PATIENCE_S: u64 = 30;

/// Runs this program with its own arguments and `flag` behind the name of the command, two words. It prints and writes
/// by itself; where it is ended or crashes, that is the error here.
pub fn run_again(flag: &str) -> Result<Outcome, CliError> {
    let not_started = |error| CliError::io("gonio could not start itself", &error);
    let mut arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    arguments.insert(arguments.len().min(2), flag.into());
    let mut command = child::command(&super::own_program()?).map_err(not_started)?;
    command.env_remove("LP_NUM_THREADS").args(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::inherit()).stderr(Stdio::inherit());
    let mut child = command.spawn().map_err(not_started)?;
    // Its input is open as long as somebody waits here.
    let ended = child::wait(&mut child, Duration::from_secs(PATIENCE_S), || false);
    match ended.map_err(|error| CliError::io("gonio lost sight of its own process", &error))? {
        child::Ended::ByItself(status) => match status.code() {
            Some(0) => Ok(Outcome::Done),
            Some(1) => Ok(Outcome::CheckFailed),
            Some(2) => Err(CliError::AlreadySaid),
            _ => Err(CliError::new("drawing crashed: the graphics driver here cannot compile or run this shader")),
        },
        child::Ended::TooLong => Err(CliError::new(format!(
            "it did not finish within {PATIENCE_S} seconds; is there a loop in a shader that never ends?"
        ))),
        child::Ended::TooLarge => Err(CliError::new(
            "drawing it took more than a gigabyte of memory, and was stopped; is there a giant array?",
        )),
        child::Ended::GivenUp => Err(CliError::new("it was given up")),
    }
}

/// In that process: ends it when whoever waits for it has ended.
pub fn end_with_the_caller() {
    std::thread::spawn(|| worker::end_with(std::io::stdin()));
}
