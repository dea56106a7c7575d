//! Measures gonio: `gonio-bench render|render-large|frame|lights|obj|environment|trace|unwrap|interpret|bench|window|python|ray`. `cargo xtask bench` builds
//! everything and runs it. Each benchmark prints a table and writes `target/bench/NAME.json`.
//!
//! Times are medians of alternating runs, so that other load on the machine affects all sides alike.

mod bench_redraw;
mod environment;
mod frame;
mod interpret;
mod measure;
mod models;
mod obj;
mod obj_readers;
mod peers;
mod python;
mod python_package;
mod ray;
mod render;
mod screen;
mod trace;
mod unwrap;
mod window;
mod window_process;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Paths that every benchmark needs.
pub struct Places {
    /// The release build of the command line.
    pub gonio: PathBuf,
    /// The folder of models, pictures and results: `target/bench`.
    pub out: PathBuf,
}

/// A benchmark returns whether its requirements are met, or why it could not run.
type Bench = fn(&Places) -> Result<bool, String>;

const BENCHES: &[(&str, Bench)] = &[
    ("render", render::run),
    ("render-large", render::run_large),
    ("frame", frame::run),
    ("lights", render::run_lights),
    ("obj", obj::run),
    ("environment", environment::run),
    ("trace", trace::run),
    ("unwrap", unwrap::run),
    ("interpret", interpret::run),
    ("bench", bench_redraw::run),
    ("window", window::run),
    ("python", python::run),
    ("ray", ray::run),
];

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    // Parts of a benchmark that run in a separate process.
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

/// Prints the error of such a process as its last line.
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
    let here = std::env::current_exe().map_err(|e| format!("cannot find this program: {e}"))?;
    let gonio = here.with_file_name(format!("gonio{}", std::env::consts::EXE_SUFFIX));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(PathBuf::from).unwrap_or_default();
    let out = root.join("target/bench");
    std::fs::create_dir_all(&out).map_err(|e| format!("cannot create {}: {e}", out.display()))?;
    Ok(Places { gonio, out })
}
