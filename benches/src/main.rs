//! Measures gonio: `gonio-bench render|render-large|frame|lights|obj|environment|window`, best through `cargo xtask bench`, which builds
//! everything first. Each prints a table and writes `target/bench/NAME.json`.
//!
//! Times are medians of alternating runs, so that a busy minute of the machine hits all sides alike.

mod environment;
mod frame;
mod lights;
mod measure;
mod models;
mod obj;
mod obj_models;
mod obj_readers;
mod peers;
mod render;
mod screen;
mod table;
mod window;
mod window_process;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Where things are.
pub struct Places {
    /// The release build of the command line.
    pub gonio: PathBuf,
    /// For models, pictures and results: `target/bench`.
    pub out: PathBuf,
}

/// A benchmark: whether its bars were held, or why it could not be run.
type Bench = fn(&Places) -> Result<bool, String>;

const BENCHES: &[(&str, Bench)] = &[
    ("render", render::run),
    ("render-large", render::run_large),
    ("frame", frame::run),
    ("lights", lights::run),
    ("obj", obj::run),
    ("environment", environment::run),
    ("window", window::run),
];

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    // Parts of a benchmark that need a process of their own.
    match names.as_slice() {
        [first, rest @ ..] if first == obj_readers::READ => return ended(obj_readers::child(rest)),
        [first, rest @ ..] if first == window_process::NAME => return ended(window_process::run(rest)),
        [first, file] if first == obj_readers::MAKE => return ended(places().and_then(|p| obj::make(&p, file))),
        _ => {}
    }
    if let Some(unknown) = names.iter().find(|name| !BENCHES.iter().any(|(known, _)| known == name)) {
        let known: Vec<&str> = BENCHES.iter().map(|(name, _)| *name).collect();
        eprintln!("bench: `{unknown}` is none of {}", known.join(", "));
        return ExitCode::from(2);
    }
    let places = match places() {
        Ok(places) => places,
        Err(error) => {
            eprintln!("bench: {error}");
            return ExitCode::from(2);
        }
    };
    measure::warn_if_busy();
    let mut code = 0;
    for (name, bench) in BENCHES.iter().filter(|(name, _)| names.is_empty() || names.iter().any(|n| n == name)) {
        match bench(&places) {
            Ok(true) => {}
            Ok(false) => code = code.max(1),
            Err(error) => {
                eprintln!("bench {name}: {error}");
                code = 2;
            }
        }
        println!();
    }
    ExitCode::from(code)
}

/// The last line that such a process says is its error.
fn ended(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            println!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn places() -> Result<Places, String> {
    let here = std::env::current_exe().map_err(|e| format!("where this program lies is not known: {e}"))?;
    let gonio = here.with_file_name(format!("gonio{}", std::env::consts::EXE_SUFFIX));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(PathBuf::from).unwrap_or_default();
    let out = root.join("target/bench");
    std::fs::create_dir_all(&out).map_err(|e| format!("cannot make {}: {e}", out.display()))?;
    Ok(Places { gonio, out })
}
