//! A check in a process of its own: `gonio lab check`, which may be ended whatever a shader does.

use super::child::{self, Ended};
use crate::platform::{CheckRequest, Checking};
use gonio_lab::verdict::Verdict;
use std::fs::File;
use std::io::Error;
use std::path::{Component, Path, PathBuf};
use std::process::Child;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, mpsc::TryRecvError};
use std::time::Duration;

/// Seconds after which the process gives up by itself, and says so in a verdict.
const PATIENCE_S: u64 = 25;
/// After which it is ended.
const MOST: Duration = Duration::from_secs(30);

/// A process that checks, and the thread that waits for it.
pub struct Process {
    answers: Receiver<Result<Verdict, String>>,
    given_up: Arc<AtomicBool>,
    answered: bool,
}

/// Begins: writes the files into a folder of their own and starts `program` on them. An error is one sentence.
pub fn begin(program: &Path, request: &CheckRequest, ctx: &egui::Context) -> Result<Process, String> {
    let folder = Folder::new().map_err(|why| format!("a folder for the check could not be made: {why}"))?;
    for (name, bytes) in &request.files {
        folder.put(name, bytes).map_err(|why| format!("`{name}` could not be written for the check: {why}"))?;
    }
    let mut child = start(program, request, &folder).map_err(|why| format!("the check could not be started: {why}"))?;
    let (sender, answers) = channel();
    let given_up = Arc::new(AtomicBool::new(false));
    let (stop, ctx, exercise) = (given_up.clone(), ctx.clone(), request.exercise.clone());
    std::thread::spawn(move || {
        let ended = child::wait(&mut child, MOST, || stop.load(Ordering::Relaxed));
        // Nobody may listen any more.
        let _ = sender.send(answer(ended, &exercise, &folder));
        ctx.request_repaint();
    });
    Ok(Process { answers, given_up, answered: false })
}

impl Checking for Process {
    fn poll(&mut self) -> Option<Result<Verdict, String>> {
        if self.answered {
            return None;
        }
        let answer = match self.answers.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err("the check ended without a word; try it again".into()),
        };
        self.answered = true;
        Some(answer)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.given_up.store(true, Ordering::Relaxed);
    }
}

fn start(program: &Path, request: &CheckRequest, folder: &Folder) -> Result<Child, Error> {
    let mut command = child::command(program)?;
    command.args(["lab", "check", &request.exercise, "--json", "--patience", &PATIENCE_S.to_string()]);
    if request.as_the_lab {
        command.arg("--as-the-lab");
    }
    // By their names in their folder: they are called so in what is said.
    command.arg("--").args(request.files.iter().map(|(name, _)| name)).current_dir(folder.files());
    let [said, complained] = [folder.said(), folder.complained()].map(File::create);
    command.stdout(said?).stderr(complained?).spawn()
}

fn answer(ended: Result<Ended, Error>, exercise: &str, folder: &Folder) -> Result<Verdict, String> {
    let ended = match ended.map_err(|why| format!("what became of the check is not known: {why}"))? {
        Ended::ByItself(status) => status,
        Ended::TooLong => {
            return Err(format!("the check did not end within {} seconds and was stopped", MOST.as_secs()));
        }
        Ended::TooLarge => return Ok(Verdict::too_large(exercise)),
        Ended::GivenUp => return Err("the check was given up".into()),
    };
    let read = |path: PathBuf| std::fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    match ended.code() {
        Some(0 | 1) => {
            let said = read(folder.said()).map_err(|why| format!("the verdict could not be read: {why}"))?;
            serde_json::from_str(&said).map_err(|why| format!("the verdict could not be understood: {why}"))
        }
        Some(_) => {
            let complained = read(folder.complained()).unwrap_or_default();
            let last = complained.lines().rev().find_map(|line| line.strip_prefix("error: "));
            Err(last.unwrap_or("the check failed and did not say why").to_owned())
        }
        None => Err("checking it ended the program that checks: too much memory, or a driver's fault".into()),
    }
}

/// A folder that goes when the check does.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, Error> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("gonio-check-{}-{number}", std::process::id()));
        // Not `create_dir_all`: a folder that is there already is somebody else's.
        std::fs::create_dir(&path)?;
        let folder = Folder(path);
        std::fs::create_dir(folder.files())?;
        Ok(folder)
    }

    fn files(&self) -> PathBuf {
        self.0.join("files")
    }

    fn said(&self) -> PathBuf {
        self.0.join("said")
    }

    fn complained(&self) -> PathBuf {
        self.0.join("complained")
    }

    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let name = Path::new(name);
        let is_within = name.components().all(|part| matches!(part, Component::Normal(_)));
        if !is_within || name.components().next().is_none() {
            return Err("its name leads out of the folder".into());
        }
        let path = self.files().join(name);
        let parent = path.parent().unwrap_or(&self.0);
        std::fs::create_dir_all(parent).and_then(|()| std::fs::write(&path, bytes)).map_err(|why| why.to_string())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What cannot be removed is the system's to tidy.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(name: &str, bytes: &[u8]) -> CheckRequest {
        CheckRequest { exercise: "ex04".into(), files: vec![(name.into(), bytes.to_vec())], as_the_lab: false }
    }

    /// A program that is there everywhere that these tests run, and is not gonio.
    fn ask(program: &str, name: &str, bytes: &[u8]) -> Result<Verdict, String> {
        let mut process = begin(Path::new(program), &request(name, bytes), &egui::Context::default())?;
        loop {
            if let Some(answer) = process.poll() {
                assert_eq!(process.poll(), None, "it answers once");
                return answer;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// The memory is the process's own: the limit that the command line sets holds here too.
    #[test]
    #[cfg(target_os = "linux")]
    fn what_takes_too_much_memory_is_stopped_and_said() {
        // Asked to `lab check`, a shell runs the file `lab`: it doubles a word until it is stopped.
        let doubles = b"a=xxxxxxxx; while :; do a=$a$a; done\n";
        assert_eq!(ask("/bin/sh", "lab", doubles), Ok(Verdict::too_large("ex04")));
    }

    #[test]
    fn what_is_no_verdict_is_a_sentence() {
        let said =
            |program, name| ask(program, name, b"x").map_err(|why| why.split(':').next().unwrap_or("").to_owned());
        assert_eq!(said("/nowhere/gonio", "a.vert"), Err("the check could not be started".into()));
        assert_eq!(said("/bin/echo", "a.vert"), Err("the verdict could not be understood".into()));
        for name in ["../a.vert", "/etc/a.vert", ""] {
            assert_eq!(said("/bin/echo", name), Err(format!("`{name}` could not be written for the check")));
        }
    }
}
