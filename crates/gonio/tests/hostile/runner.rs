//! Runs a case as a user would, and checks exit code, output, memory and leftovers.

use crate::case::{Case, Fill};
use crate::common::faults;
use std::collections::BTreeMap;
use std::io::Read;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::FileTypeExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Time limit of a check in seconds, for `--patience`.
const PATIENCE: &str = "3";
/// A case that takes longer has hung. Far above the time limit, because other tests use the same cores.
const HUNG: Duration = Duration::from_secs(60);
/// The memory that all processes of a case may use together.
const MOST_RESIDENT_KB: u64 = 1536 * 1024;
/// Size limit of the output.
const MOST_OUTPUT: usize = 1 << 20;
const VERDICTS: [&str; 4] = ["correct", "wrong", "does not compile", "unsure"];

/// The result of a case.
pub struct Report {
    pub name: String,
    /// The first line of the output, or the exit status.
    pub outcome: String,
    /// The faults; empty if the case passed.
    pub faults: Vec<String>,
    pub seconds: f64,
    pub most_kb: u64,
}

pub fn run(case: &Case) -> Report {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("input");
    std::fs::create_dir(&input).unwrap();
    case.files.iter().for_each(|file| file.make(&input));
    let before = listing(&input);
    let start = Instant::now();
    let mut command = Command::new("setsid");
    command.arg(env!("CARGO_BIN_EXE_gonio")).args(["lab", "check", case.exercise]);
    match &case.paths {
        None => drop(command.arg("input")),
        // Names that begin with `-` are files after `--`.
        Some(paths) => drop(command.args(["--patience", PATIENCE, "--"]).args(paths).current_dir(&input)),
    }
    if case.paths.is_none() {
        command.args(["--patience", PATIENCE]).current_dir(folder.path());
    }
    command.env("LP_NUM_THREADS", "1").stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("`setsid` of util-linux starts the cases");
    let (stdout, stderr) = (reader(child.stdout.take().unwrap()), reader(child.stderr.take().unwrap()));
    let mut faults = Vec::new();
    let mut most_kb = 0;
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break Some(status);
        }
        most_kb = most_kb.max(session(child.id()).iter().map(|(_, kb)| kb).sum());
        if start.elapsed() > HUNG || most_kb > 2 * MOST_RESIDENT_KB {
            break None;
        }
        std::thread::sleep(Duration::from_millis(25));
    };
    let seconds = start.elapsed().as_secs_f64();
    if status.is_none() {
        faults.push(format!("stopped by the test after {seconds:.0} s with {} MB", most_kb / 1024));
    }
    faults.extend(left_behind(&mut child));
    let (stdout, stderr) = (stdout.join().unwrap(), stderr.join().unwrap());
    if most_kb > MOST_RESIDENT_KB {
        faults.push(format!("it used {} MB", most_kb / 1024));
    }
    let code = status.and_then(|status| status.code());
    match (code, status.and_then(|status| status.signal())) {
        (Some(0), _) if !case.may_be_right => faults.push("it was called correct".to_owned()),
        (Some(0..=2), _) => {}
        (Some(code), _) => faults.push(format!("exit code {code}")),
        (None, Some(signal)) => faults.push(format!("it died of signal {signal}")),
        (None, None) => {}
    }
    if status.is_some() {
        faults.extend(words(case, code, &stdout, &stderr));
    }
    if listing(&input) != before {
        faults.push("it changed its input".to_owned());
    }
    let first = String::from_utf8_lossy(if stdout.is_empty() { &stderr } else { &stdout });
    let first: String = first.lines().next().unwrap_or_default().chars().take(110).collect();
    Report { name: case.name.clone(), outcome: first, faults, seconds, most_kb }
}

/// The faults of the output.
fn words(case: &Case, code: Option<i32>, stdout: &[u8], stderr: &[u8]) -> Vec<String> {
    let mut wrong: Vec<String> = [("stdout", stdout), ("stderr", stderr)]
        .into_iter()
        .flat_map(|(name, bytes)| faults(bytes, false).into_iter().take(2).map(move |fault| format!("{name}: {fault}")))
        .collect();
    if stdout.len() + stderr.len() > MOST_OUTPUT {
        wrong.push(format!("{} bytes were printed", stdout.len() + stderr.len()));
    }
    let (stdout, stderr) = (String::from_utf8_lossy(stdout), String::from_utf8_lossy(stderr));
    if stderr.contains("panicked") {
        wrong.push(format!("a panic: {}", stderr.chars().take(300).collect::<String>()));
    }
    let verdict = |line: &str| {
        let message = line.strip_prefix(case.exercise)?.strip_prefix("  ")?;
        VERDICTS.into_iter().find(|verdict| message.starts_with(&format!("{verdict}: ")))
    };
    let message: Vec<&str> = stdout.lines().filter_map(verdict).collect();
    match code {
        Some(2) => {
            let errors = stderr.lines().filter(|line| line.starts_with("error: ")).count();
            if errors != 1 || !stdout.is_empty() {
                wrong.push(format!("an error is one sentence on stderr alone: {stdout}{stderr}"));
            }
        }
        Some(code) if !case.is_batch => {
            let first = stdout.lines().next().and_then(verdict);
            if first.is_none() || message.len() != 1 || (first == Some("correct")) != (code == 0) {
                wrong.push(format!("the first line is the one verdict, as exit code {code} has it: {stdout}"));
            }
        }
        _ => {}
    }
    wrong
}

/// Reads a pipe to its end, so that the program never waits; a limited part is kept.
fn reader(mut pipe: impl Read + Send + 'static) -> std::thread::JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let (mut kept, mut buffer) = (Vec::new(), vec![0; 1 << 16]);
        while let Ok(count @ 1..) = pipe.read(&mut buffer) {
            if kept.len() <= MOST_OUTPUT {
                kept.extend_from_slice(&buffer[..count]);
            }
        }
        kept
    })
}

/// The processes of a session that still run, with what each uses in kilobytes.
fn session(leader: u32) -> Vec<(u32, u64)> {
    let number = |name: &std::ffi::OsStr| name.to_str()?.parse::<u32>().ok();
    let processes = std::fs::read_dir("/proc").unwrap().filter_map(|entry| number(&entry.ok()?.file_name()));
    let of_session = |process: u32| {
        let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        // After the name, which may hold anything: state, parent, group, session; the 24th field is resident pages.
        let fields: Vec<&str> = stat[stat.rfind(')')? + 1..].split_whitespace().collect();
        let is_ours = fields.get(3)?.parse() == Ok(leader) && !matches!(*fields.first()?, "Z" | "X");
        is_ours.then_some((process, fields.get(21)?.parse::<u64>().ok()? * 4))
    };
    processes.filter_map(of_session).collect()
}

/// Stops processes that still run and reports them. Those that end shortly after their parent do not count.
fn left_behind(child: &mut Child) -> Vec<String> {
    let leader = child.id();
    let is_stopped = child.try_wait().unwrap().is_none();
    let deadline = Instant::now() + Duration::from_secs(10);
    let mut left = session(leader);
    while !is_stopped && !left.is_empty() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(20));
        left = session(leader);
    }
    for (process, _) in &left {
        let _ = Command::new("kill").args(["-KILL", &process.to_string()]).status();
    }
    let _ = child.wait();
    match left.is_empty() || is_stopped {
        true => Vec::new(),
        false => vec![format!("{} processes were left behind", left.len())],
    }
}

/// Everything in a folder: names, kinds, lengths, link targets, and the content of small files.
fn listing(folder: &Path) -> BTreeMap<PathBuf, (String, Vec<u8>)> {
    let mut all = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).unwrap().map(Result::unwrap) {
            let (path, kind) = (entry.path(), entry.file_type().unwrap());
            let length = std::fs::symlink_metadata(&path).unwrap().len();
            let content = match kind.is_file() && length < 1 << 20 {
                true => std::fs::read(&path).unwrap(),
                false => Vec::new(),
            };
            let link = std::fs::read_link(&path).map(|to| to.as_os_str().as_bytes().to_vec()).unwrap_or_default();
            if kind.is_dir() {
                open.push(path.clone());
            }
            let kind = format!("{kind:?} {length} {}", kind.is_fifo());
            all.insert(path, (kind, [content, link].concat()));
        }
    }
    all
}

impl crate::case::File {
    /// Makes it in the folder.
    fn make(&self, folder: &Path) {
        let path = folder.join(&self.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        match &self.fill {
            Fill::Bytes(bytes) => std::fs::write(path, bytes).unwrap(),
            Fill::Repeat(before, piece, count, after) => {
                let mut bytes = before.clone();
                bytes.reserve(piece.len() * count + after.len());
                (0..*count).for_each(|_| bytes.extend_from_slice(piece));
                bytes.extend_from_slice(after);
                std::fs::write(path, bytes).unwrap();
            }
            Fill::Sparse(length) => std::fs::File::create(path).unwrap().set_len(*length).unwrap(),
            Fill::Link(to) => std::os::unix::fs::symlink(to, path).unwrap(),
            Fill::Pipe => assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
        }
    }
}
