//! Named checks of a step that uses a program as a person would.

use crate::report::Findings;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// The outcome of each check.
#[derive(Default)]
pub struct Cases {
    passed: usize,
    failures: Vec<String>,
}

impl Cases {
    /// Runs a check. Its error says what was wrong.
    pub fn case(&mut self, name: &str, check: impl FnOnce() -> Result<(), String>) {
        match check() {
            Ok(()) => self.passed += 1,
            Err(error) => self.failures.push(format!("{name}: {}", error.trim_end())),
        }
    }

    /// All of them.
    pub fn findings(self) -> Findings {
        let failed = self.failures.len();
        Findings { passed: self.passed, failed, details: self.failures.join("\n"), ..Findings::default() }
    }
}

/// What a program did.
#[derive(Debug)]
pub struct Ran {
    /// Its exit code; -1 if it was ended by a signal.
    pub code: i32,
    /// Its stdout.
    pub out: String,
    /// Its stderr.
    pub err: String,
}

/// A program that waits for ever is ended after this time. No check depends on it.
const PATIENCE: Duration = Duration::from_secs(300);

/// Runs a program to its end. What it prints goes to files, because a program that it started and left, such as Wine's desktop, would keep
/// a pipe open.
pub fn run(command: &mut Command) -> Result<Ran, String> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let shown = shown(command);
    let failed = |error| format!("cannot run {shown}: {error}");
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let place = |name: &str| std::env::temp_dir().join(format!("gonio-{}-{number}-{name}", std::process::id()));
    let (out, err) = (place("out"), place("err"));
    let ended =
        File::create(&out).and_then(|out| Ok((out, File::create(&err)?))).map_err(failed).and_then(|(out, err)| {
            wait(command.stdin(Stdio::null()).stdout(out).stderr(err).spawn().map_err(failed)?, &shown)
        });
    let text = |path| {
        let text = std::fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        // If it stays, it is a small file among temporary ones.
        let _ = std::fs::remove_file(path);
        text.map_err(failed)
    };
    let (out, err) = (text(&out), text(&err));
    Ok(Ran { code: ended?.code().unwrap_or(-1), out: out?, err: err? })
}

fn wait(mut child: Child, shown: &str) -> Result<ExitStatus, String> {
    let start = Instant::now();
    loop {
        match child.try_wait() {
            Ok(None) if start.elapsed() < PATIENCE => std::thread::sleep(Duration::from_millis(20)),
            Ok(Some(status)) => return Ok(status),
            ended => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("{shown} did not end in {} s: {ended:?}", PATIENCE.as_secs()));
            }
        }
    }
}

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    format!("`{}`", words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" "))
}

impl Ran {
    /// The run, if it ended with this code.
    pub fn with_code(self, code: i32) -> Result<Ran, String> {
        if self.code == code { Ok(self) } else { Err(format!("exit code {} instead of {code}: {self}", self.code)) }
    }

    /// The run, if each of these pieces is in its stdout.
    pub fn printing(self, pieces: &[&str]) -> Result<Ran, String> {
        match pieces.iter().find(|piece| !self.out.contains(**piece)) {
            None => Ok(self),
            Some(piece) => Err(format!("`{piece}` is not printed: {self}")),
        }
    }

    /// Its stdout as JSON.
    pub fn json(&self) -> Result<serde_json::Value, String> {
        serde_json::from_str(&self.out).map_err(|error| format!("{error}: {self}"))
    }
}

impl std::fmt::Display for Ran {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}\n{}", self.out.trim_end(), self.err.trim_end())
    }
}

/// The answer of a server to a request for its first page. The server, which prints its address, is started for it and ended.
pub fn first_page(command: &mut Command) -> Result<String, String> {
    let failed = |error: std::io::Error| error.to_string();
    let mut server =
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().map_err(failed)?;
    let answer = server.stdout.take().map_or_else(|| Ok(String::new()), request);
    let _ = server.kill();
    let _ = server.wait();
    answer.map_err(failed)
}

fn request(out: impl Read) -> std::io::Result<String> {
    let mut url = String::new();
    BufReader::new(out).read_line(&mut url)?;
    let address = url.trim().trim_end_matches('/').trim_start_matches("http://").to_owned();
    let mut socket = TcpStream::connect(&address)?;
    socket.set_read_timeout(Some(PATIENCE))?;
    write!(socket, "GET / HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n")?;
    let mut answer = Vec::new();
    socket.read_to_end(&mut answer)?;
    Ok(String::from_utf8_lossy(&answer).into_owned())
}

/// An error unless the condition holds.
pub fn ensure(condition: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if condition { Ok(()) } else { Err(otherwise()) }
}

/// An error unless the file begins with these bytes.
pub fn begins_with(path: &Path, start: &[u8]) -> Result<(), String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    ensure(bytes.starts_with(start), || format!("{} begins with {:?}", path.display(), &bytes[..bytes.len().min(8)]))
}

/// The first bytes of a PNG file.
pub const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// An empty folder of this name; what lay there is removed.
pub fn empty_folder(path: &Path) -> Result<(), String> {
    let failed = |error| format!("cannot empty {}: {error}", path.display());
    if path.exists() {
        std::fs::remove_dir_all(path).map_err(failed)?;
    }
    std::fs::create_dir_all(path).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_are_counted_and_named() {
        let mut cases = Cases::default();
        cases.case("good", || Ok(()));
        cases.case("bad", || ensure(false, || "it is not so".into()));
        let findings = cases.findings();
        assert_eq!((findings.passed, findings.failed, findings.details.as_str()), (1, 1, "bad: it is not so"));
    }

    #[cfg(unix)]
    #[test]
    fn code_and_both_streams_are_returned() {
        let run = || run(Command::new("sh").args(["-c", "echo one; echo two >&2; exit 3"]));
        let ran = run().and_then(|ran| ran.with_code(3)).and_then(|ran| ran.printing(&["one"]));
        assert!(matches!(ran, Ok(Ran { ref err, .. }) if err == "two\n"), "{ran:?}");
        assert!(run().and_then(|ran| ran.with_code(0)).is_err());
        assert!(run().and_then(|ran| ran.printing(&["two"])).is_err());
    }
}
