//! gonio's own program in a process of its own, with limits on time and memory: what the window and the command line both
//! check submissions in, whatever a shader does.

use std::io::Error;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Address space of a child, in kilobytes: a software driver reserves two gigabytes of it without using them.
const MOST_ADDRESSES_KB: u64 = 6 * 1024 * 1024;
/// Resident memory of a child. A check uses 0.2 gigabytes, and a submission has no reason for more than a few images.
const MOST_RESIDENT_KB: u64 = 1024 * 1024;
/// Interval at which a child is polled.
const LOOK: Duration = Duration::from_millis(5);
/// Interval at which its memory is measured.
const LOOK_AT_MEMORY: Duration = Duration::from_millis(10);

/// The end of a child process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// It exited, successfully or not.
    ByItself(ExitStatus),
    /// It was stopped after the time it had.
    TooLong,
    /// It was stopped because of the memory it took.
    TooLarge,
    /// It was stopped because its answer is no longer needed.
    GivenUp,
}

/// Our own program, with one core, and with a limit on its addresses where nothing tells what it really uses and the system has
/// a shell to set one: the drivers of some graphics cards reserve more than any limit without using it. Nothing is read, and
/// what it complains of goes nowhere. An error where there is no such program: a shell would start all the same.
pub fn command(program: &Path) -> Result<Command, Error> {
    std::fs::metadata(program)?;
    let mut command = if cfg!(all(unix, not(target_os = "linux"))) {
        // By its place: where a window is started from a menu, PATH may hold anything.
        let mut command = Command::new("/bin/sh");
        let script = format!("ulimit -v {MOST_ADDRESSES_KB} 2>/dev/null; exec \"$0\" \"$@\"");
        command.args(["-c", &script]).arg(program);
        command
    } else {
        Command::new(program)
    };
    // A core each: drivers on the CPU otherwise start as many threads as there are cores in every child.
    command.env("LP_NUM_THREADS", "1").stdin(Stdio::null()).stderr(Stdio::null());
    Ok(command)
}

/// Waits for its end, or for the end of what it may take: this time, a gigabyte, and nobody's having `given_up` on it. An
/// error is the system's, which does not say what became of the child; it is ended then too.
pub fn wait(child: &mut Child, patience: Duration, given_up: impl Fn() -> bool) -> Result<Ended, Error> {
    let begun = Instant::now();
    let mut next_look = begun + LOOK_AT_MEMORY;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(Ended::ByItself(status)),
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
        } else if looks_at_memory && resident_kb(child.id()).is_some_and(|kb| kb > MOST_RESIDENT_KB) {
            Ended::TooLarge
        } else {
            std::thread::sleep(LOOK);
            continue;
        };
        stop(child);
        return Ok(ended);
    }
}

/// It may have ended between the question and now: that is as good.
fn stop(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

/// Resident memory of a process; `None` if the system has no file for it.
fn resident_kb(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// How a program of the system's ended.
    fn run(program: &str, words: &[&str], patience: Duration, given_up: bool) -> Ended {
        let mut child = command(Path::new(program)).and_then(|mut command| command.args(words).spawn()).unwrap();
        wait(&mut child, patience, || given_up).unwrap()
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn too_much_memory_or_time_stops_the_process() {
        const MINUTE: Duration = Duration::from_secs(60);
        // A shell that doubles a word until it is stopped.
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
