//! Running the program in a folder of its own.
#![allow(dead_code, clippy::unwrap_used, missing_docs)]

pub mod visible;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

pub struct Lab {
    folder: tempfile::TempDir,
}

/// The result of a run.
#[derive(Debug)]
pub struct Run {
    pub code: i32,
    pub stdout: Vec<u8>,
    pub stderr: String,
}

impl Run {
    pub fn of(output: Output) -> Run {
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(!stderr.contains("panicked"), "a panic: {stderr}");
        Run { code: output.status.code().unwrap_or(-1), stdout: output.stdout, stderr }
    }

    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap()
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.stdout).unwrap_or_else(|e| panic!("{e}: {}", self.text()))
    }

    /// Exit code 0.
    #[track_caller]
    pub fn good(self) -> Run {
        assert_eq!(self.code, 0, "{}", self.stderr);
        self
    }

    /// Exit code 2, and exactly one sentence on stderr that has all these pieces.
    #[track_caller]
    pub fn refused(self, pieces: &[&str]) -> Run {
        assert_eq!(self.code, 2, "{}", self.stderr);
        let errors: Vec<&str> = self.stderr.lines().filter(|l| l.starts_with("error: ")).collect();
        assert_eq!(errors.len(), 1, "expected one sentence: {}", self.stderr);
        for piece in pieces {
            assert!(self.stderr.contains(piece), "`{piece}` is not in: {}", self.stderr);
        }
        assert!(!self.stderr.contains("os error"), "{}", self.stderr);
        self
    }
}

pub fn asset(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/models").join(name);
    assert!(path.is_file(), "{}", path.display());
    path.to_string_lossy().into_owned()
}

impl Lab {
    pub fn new() -> Lab {
        Lab { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}; there are {:?}", self.names()))
    }

    /// All files, sorted: also those whose names begin with a dot.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(self.folder.path())
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
        command.args(args).current_dir(self.folder.path()).stdin(Stdio::null());
        command
    }

    pub fn run(&self, args: &[&str]) -> Run {
        Run::of(self.command(args).output().unwrap())
    }

    /// A small picture by the CPU: `render ARGS --size 48x32 --samples 1 --backend cpu`.
    pub fn render(&self, args: &[&str]) -> Run {
        let mut all = vec!["render"];
        all.extend(args);
        if !args.contains(&"--size") {
            all.extend(["--size", "48x32"]);
        }
        all.extend(["--samples", "1", "--backend", "cpu"]);
        self.run(&all)
    }

    /// Width, height and the decoded picture.
    pub fn picture(&self, name: &str) -> image::DynamicImage {
        image::load_from_memory(&self.read(name)).unwrap()
    }
}
