//! Child processes of gonio's own program, with limits on time and memory. The window and the command line check submissions
//! in them, so that no shader can harm either.

use std::convert::Infallible;
use std::io::Error;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Address space of a child, in kilobytes: a software driver reserves two gigabytes of it without using them.
const MOST_ADDRESSES_KB: u64 = 6 * 1024 * 1024;
/// Resident memory of a child. A check uses 0.2 gigabytes, and a submission has no reason for more than a few images.
pub const MOST_RESIDENT_KB: u64 = 1024 * 1024;
/// Interval at which a child is polled.
const LOOK: Duration = Duration::from_millis(5);
/// Interval at which its memory is measured.
const LOOK_AT_MEMORY: Duration = Duration::from_millis(10);

/// The end of a child process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// It exited, successfully or not.
    ByItself(ExitStatus),
    /// It was stopped because it took too long.
    TooLong,
    /// It was stopped because it used too much memory.
    TooLarge,
    /// It was stopped because its answer is no longer needed.
    GivenUp,
}

/// A command that runs gonio's own `program` on one core, without input, and with its error output discarded.
///
/// On systems without a way to measure its memory ([`wait`]), a shell limits its address space. Linux has one; a limit would
/// be wrong there, because some graphics drivers reserve a large address space without using it.
///
/// # Errors
/// `program` does not exist; the shell would start nevertheless.
pub fn command(program: &Path) -> Result<Command, Error> {
    std::fs::metadata(program)?;
    let mut command = if cfg!(all(unix, not(target_os = "linux"))) {
        // An absolute path, because PATH may contain anything if the window was started from a menu.
        let mut command = Command::new("/bin/sh");
        let script = format!("ulimit -v {MOST_ADDRESSES_KB} 2>/dev/null; exec \"$0\" \"$@\"");
        command.args(["-c", &script]).arg(program);
        command
    } else {
        Command::new(program)
    };
    // Software drivers would start a thread per core in every child.
    command.env("LP_NUM_THREADS", "1").stdin(Stdio::null()).stderr(Stdio::null());
    Ok(command)
}

/// Waits for the child to end, and stops it if it takes longer than `patience` or more than a gigabyte, or if `given_up`
/// returns true.
///
/// # Errors
/// Those of the system while waiting; the child is stopped then.
pub fn wait(child: &mut Child, patience: Duration, given_up: impl Fn() -> bool) -> Result<Ended, Error> {
    wait_within(child, patience, MOST_RESIDENT_KB, given_up)
}

/// [`wait`] with another limit on resident memory, in kilobytes.
///
/// # Errors
/// Those of the system while waiting; the child is stopped then.
pub fn wait_within(
    child: &mut Child,
    patience: Duration,
    most_resident_kb: u64,
    given_up: impl Fn() -> bool,
) -> Result<Ended, Error> {
    let never = |interval| {
        std::thread::sleep(interval);
        None::<Infallible>
    };
    match wait_for(child, patience, most_resident_kb, given_up, never)? {
        Waited::Ended(ended) => Ok(ended),
        Waited::Answered(answer) => match answer {},
    }
}

/// What a wait for an answer brought.
#[derive(Debug, PartialEq, Eq)]
pub enum Waited<T> {
    /// The answer; the child goes on.
    Answered(T),
    /// The child ended without one, or was stopped.
    Ended(Ended),
}

/// [`wait_within`], but only until the child answers: `answer` waits for that as long as it is told.
///
/// # Errors
/// Those of the system while waiting; the child is stopped then.
pub fn wait_for<T>(
    child: &mut Child,
    patience: Duration,
    most_resident_kb: u64,
    given_up: impl Fn() -> bool,
    answer: impl Fn(Duration) -> Option<T>,
) -> Result<Waited<T>, Error> {
    let begun = Instant::now();
    let mut next_look = begun + LOOK_AT_MEMORY;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(Waited::Ended(Ended::ByItself(status))),
            Ok(None) => {}
            Err(error) => {
                stop(child);
                return Err(error);
            }
        }
        let now = Instant::now();
        let looks_at_memory = now >= next_look;
        if looks_at_memory {
            next_look = now + LOOK_AT_MEMORY;
        }
        let ended = if now.duration_since(begun) >= patience {
            Ended::TooLong
        } else if given_up() {
            Ended::GivenUp
        } else if looks_at_memory && resident_kb(child.id()).is_some_and(|kb| kb > most_resident_kb) {
            Ended::TooLarge
        } else {
            match answer(LOOK) {
                Some(answer) => return Ok(Waited::Answered(answer)),
                None => continue,
            }
        };
        stop(child);
        return Ok(Waited::Ended(ended));
    }
}

/// Stops the child. Errors are ignored, because it may have ended in the meantime.
pub(super) fn stop(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

/// Resident memory of a process; `None` if the system has no file for it.
fn resident_kb(process: u32) -> Option<u64> {
    // A path like this could be anything on another system.
    if !cfg!(target_os = "linux") {
        return None;
    }
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The end of a system program.
    fn run(program: &str, words: &[&str], patience: Duration, given_up: bool) -> Ended {
        let mut child = command(Path::new(program)).and_then(|mut command| command.args(words).spawn()).unwrap();
        wait(&mut child, patience, || given_up).unwrap()
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn too_much_memory_or_time_stops_the_process() {
        const MINUTE: Duration = Duration::from_secs(60);
        // A shell that doubles a string until it is stopped.
        let doubles = "a=xxxxxxxx; while :; do a=$a$a; done";
        assert_eq!(run("/bin/sh", &["-c", doubles], MINUTE, false), Ended::TooLarge);
        assert_eq!(run("/bin/sleep", &["60"], Duration::from_millis(50), false), Ended::TooLong);
        assert_eq!(run("/bin/sleep", &["60"], MINUTE, true), Ended::GivenUp);
        let Ended::ByItself(status) = run("/bin/sh", &["-c", "exit 3"], MINUTE, false) else {
            panic!("it was stopped")
        };
        assert_eq!(status.code(), Some(3));
    }

    #[test]
    fn a_missing_program_is_not_started() {
        let found = command(Path::new("/nowhere/gonio")).map_err(|error| error.kind());
        assert_eq!(found.err(), Some(std::io::ErrorKind::NotFound));
    }
}
