//! A check in a process of its own, with limits on time and memory.

use crate::report::CliError;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Address space of a child, in kilobytes: a software driver reserves two gigabytes of it without using them.
const MOST_ADDRESSES_KB: u64 = 6 * 1024 * 1024;
/// What a child may really use. A check uses 0.2 gigabytes; the largest a submission has any reason for is a few more images.
const MOST_RESIDENT_KB: u64 = 1024 * 1024;
/// How often a child is looked at.
const LOOK: Duration = Duration::from_millis(5);
/// How often its memory is.
const LOOK_AT_MEMORY: Duration = Duration::from_millis(50);

/// How a child ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// By itself, well or not.
    ByItself,
    /// It was stopped after the time it had.
    TooLong,
    /// It was stopped because of the memory it took.
    TooLarge,
}

/// Our own program, with one core and a limit on its memory where the system has a shell to set one.
pub fn command(program: &Path) -> Command {
    let mut command = if cfg!(unix) {
        let mut command = Command::new("sh");
        let script = format!("ulimit -v {MOST_ADDRESSES_KB} 2>/dev/null; exec \"$0\" \"$@\"");
        command.args(["-c", &script]).arg(program);
        command
    } else {
        Command::new(program)
    };
    // A core each: drivers on the CPU otherwise start as many threads as there are cores in every child.
    command.env("LP_NUM_THREADS", "1").stdin(Stdio::null()).stderr(Stdio::null());
    command
}

/// Runs it to its end, or to the end of what it may take.
pub fn run(command: &mut Command, patience: Duration) -> Result<Ended, CliError> {
    let mut child =
        command.spawn().map_err(|error| CliError::io("gonio could not start itself for a check", &error))?;
    let end = Instant::now() + patience;
    let mut next_look = Instant::now() + LOOK_AT_MEMORY;
    loop {
        if !matches!(child.try_wait(), Ok(None)) {
            return Ok(Ended::ByItself);
        }
        let now = Instant::now();
        if now >= end {
            stop(&mut child);
            return Ok(Ended::TooLong);
        }
        if now >= next_look {
            next_look = now + LOOK_AT_MEMORY;
            if resident_kb(child.id()).is_some_and(|kb| kb > MOST_RESIDENT_KB) {
                stop(&mut child);
                return Ok(Ended::TooLarge);
            }
        }
        std::thread::sleep(LOOK);
    }
}

/// It may have ended between the question and now: that is as good.
fn stop(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

/// What a process really uses; `None` where the system does not tell it in a file.
fn resident_kb(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn what_takes_too_much_memory_or_time_is_stopped() {
        // A shell that doubles a word until it is stopped.
        let mut large = Command::new("sh");
        large.args(["-c", "a=xxxxxxxx; while :; do a=$a$a; done"]);
        assert_eq!(run(&mut large, Duration::from_secs(60)).ok(), Some(Ended::TooLarge));
        let mut long = Command::new("sleep");
        assert_eq!(run(long.arg("60"), Duration::from_millis(50)).ok(), Some(Ended::TooLong));
        let mut short = Command::new("true");
        assert_eq!(run(&mut short, Duration::from_secs(60)).ok(), Some(Ended::ByItself));
    }
}
