//! Runs the program in a folder of its own, and checks that it prints hostile text harmlessly.
#![allow(dead_code, clippy::unwrap_used, missing_docs)]

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

    /// All files, sorted, including those whose names begin with a dot.
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

/// A layer of an .exr file: its name, and R, G, B, A of each pixel.
pub type ExrLayer = (String, Vec<[f32; 4]>);

/// All layers of an .exr file.
#[track_caller]
pub fn exr_layers(bytes: &[u8]) -> Vec<ExrLayer> {
    use exr::prelude::*;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(bytes))
        .unwrap();
    let layer = |layer: &Layer<AnyChannels<FlatSamples>>| {
        let channel = |name: &str| {
            let found = layer.channel_data.list.iter().find(|c| c.name.to_string() == name);
            found.unwrap().sample_data.values_as_f32().collect::<Vec<f32>>()
        };
        let [r, g, b, a] = ["R", "G", "B", "A"].map(channel);
        let pixels = (0..r.len()).map(|i| [r[i], g[i], b[i], a[i]]).collect();
        (layer.attributes.layer_name.clone().map_or_else(String::new, |name| name.to_string()), pixels)
    };
    image.layer_data.iter().map(layer).collect()
}

/// Everything that moves the cursor, recolours, hides or reorders text, begins a line of its own, or commands a build server.
/// It is valid in a file's name.
pub const EVIL: &str = "\u{1b}[2K\u{1b}[1A\rex07  \u{1b}[1m\u{1b}[32mcorrect\u{1b}[0m\u{8}\u{7}\u{1b}]8;;x\u{7}\u{9b}2J\u{202e}\u{2066}\u{200f}\u{2028}\u{feff}\u{7f}\n::error::x\n##[error]y";

/// [`EVIL`] for a place within a line.
pub fn evil_line() -> String {
    EVIL.replace(['\n', '\r'], " ")
}

/// The faults of an output. With `styled`, it may contain our own sequences for colours and weights.
pub fn faults(output: &[u8], styled: bool) -> Vec<String> {
    let Ok(text) = std::str::from_utf8(output) else { return vec!["it is not UTF-8".to_owned()] };
    let mut faults = Vec::new();
    for line in text.split('\n') {
        let bare = if styled { without_styles(line) } else { line.to_owned() };
        // Independent of the program's own table: Unicode's control characters, and those that change the direction of text.
        let acts = |c: char| {
            c.is_control()
                || matches!(c, '\u{ad}' | '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
                || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff0}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}' | '\u{e0000}'..='\u{e0fff}')
        };
        if let Some(c) = bare.chars().find(|&c| acts(c)) {
            faults.push(format!("{c:?} in {bare:?}"));
        }
        if bare.trim_start().starts_with("::") || bare.contains("##[") || bare.trim_start().starts_with("ex07  correct")
        {
            faults.push(format!("a forged line: {bare:?}"));
        }
    }
    faults
}

/// A line without the sequences that the program and its option parser write: weights, underlines and plain colours. A style
/// that is begun ends in its line.
fn without_styles(line: &str) -> String {
    let mut bare = String::new();
    let mut rest = line;
    let mut is_styled = false;
    while let Some(start) = rest.find("\u{1b}[") {
        let (before, sequence) = rest.split_at(start);
        bare.push_str(before);
        let end = sequence.find('m').unwrap_or(0);
        let codes = sequence.get(2..end).unwrap_or("x");
        if !matches!(codes, "0" | "1" | "2" | "4" | "31" | "32" | "33" | "36") {
            break;
        }
        is_styled = codes != "0";
        rest = &sequence[end + 1..];
    }
    assert!(!is_styled || !rest.is_empty(), "a style does not end: {line:?}");
    bare + rest
}
