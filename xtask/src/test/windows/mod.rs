//! The program for Windows, cross-compiled and run under Wine.
//!
//! Wine shows that the program starts, finds its files by Windows' names, draws by WGL and opens its window. It does not show what
//! belongs to Windows itself: drivers of graphics cards and their compilers, the console's and the desktop's own behaviour (dialogs,
//! scaling, accessibility, the clipboard), virus scanners, file systems with other rules, and speed. `docs/install.md` says so.

mod cases;
// Shared with the benchmarks and the window's tests.
#[path = "../../../../benches/src/screen.rs"]
mod screen;
mod wine;

use crate::cases::Cases;
use crate::fixtures;
use crate::report::Findings;
use crate::target::{debug_program, target_folder};
use crate::{process, setup};
use std::path::{Path, PathBuf};
use wine::Wine;

/// The target that Debian has a linker for.
pub const TARGET: &str = "x86_64-pc-windows-gnu";

/// Debian packages: the linker, Wine with what its OpenGL loads, and a screen.
const PACKAGES: &[&str] =
    &["gcc-mingw-w64-x86-64", "wine", "wine64", "libgl1", "libgl1-mesa-dri", "libegl1", "xvfb", "xdotool"];

/// A program for Windows to use instead of building one, such as that of a release.
const PROGRAM_VARIABLE: &str = "GONIO_WINDOWS_PROGRAM";

/// Installs what is missing, builds the program and uses it.
pub fn step(root: &Path) -> Findings {
    for setup in [setup::install(PACKAGES, &[]), setup::toolchain(root, &[TARGET])] {
        if setup.failed > 0 {
            return setup;
        }
    }
    let windows = match std::env::var_os(PROGRAM_VARIABLE) {
        Some(program) => Ok(root.join(program)),
        None => build(root),
    };
    windows.and_then(|windows| try_program(root, &windows)).unwrap_or_else(Findings::fail)
}

/// The program for Windows, built as the tests are, with little for debuggers.
fn build(root: &Path) -> Result<PathBuf, String> {
    let mut cargo = process::cargo(root);
    cargo.args(["build", "--locked", "--package", "gonio", "--target", TARGET]);
    let outcome = process::run(cargo.env("CARGO_PROFILE_DEV_DEBUG", "0").env("CARGO_INCREMENTAL", "0"));
    if outcome.success { Ok(target_folder(root).join(TARGET).join("debug/gonio.exe")) } else { Err(outcome.text) }
}

/// Uses a program for Windows, and compares it with the one for this machine that the workspace's tests have built.
fn try_program(root: &Path, windows: &Path) -> Result<Findings, String> {
    let native = debug_program(root);
    if !native.is_file() {
        return Err(format!("{} is missing; `cargo build` makes it", native.display()));
    }
    let wine = Wine::new(&target_folder(root).join("wine"), windows)?;
    copy_files(root, &wine.work)?;
    let mut cases = Cases::default();
    cases::all(&cases::Programs { wine: &wine, windows, native: &native }, &mut cases);
    Ok(cases.findings())
}

/// The files of the cases.
fn copy_files(root: &Path, work: &Path) -> Result<(), String> {
    let copy = |from: &Path, to: PathBuf| {
        let made = to.parent().map_or(Ok(()), std::fs::create_dir_all).and_then(|()| std::fs::copy(from, &to));
        made.map(drop).map_err(|error| format!("cannot copy {} to {}: {error}", from.display(), to.display()))
    };
    let models = root.join("assets/models");
    for name in ["cube.obj", "cube.mtl", "suzanne.obj", "suzanne.mtl"] {
        copy(&models.join(name), work.join("models").join(name))?;
    }
    copy(&models.join("textures/tiles.png"), work.join("textures/tiles.png"))?;
    let table = gonio_fixtures::FixtureTable::read(root.join("xtask/src/test/windows/files.txt"));
    let unpacked = table.map_err(|error| error.to_string())?.unpack(work);
    unpacked.map_err(|error| format!("cannot write the files of the cases: {error}"))?;
    // Submissions of exercise 4: a right one, a wrong one, and the wrong one with Windows' line ends.
    let corpus = fixtures::unpack(root, "crates/gonio-check/corpus/ex04", "windows")?;
    for (from, to) in [("correct/block", "block"), ("wrong/absolute", "absolute"), ("wrong/absolute", "absolute crlf")]
    {
        for path in std::fs::read_dir(corpus.join(from)).map_err(|error| format!("{from}: {error}"))?.flatten() {
            let name = path.file_name();
            if name == "expected.toml" {
                continue;
            }
            let place = work.join("class").join(to).join(&name);
            copy(&path.path(), place.clone())?;
            if to.ends_with("crlf") {
                let text = std::fs::read_to_string(&place).map(|text| text.replace('\n', "\r\n"));
                text.and_then(|text| std::fs::write(&place, text)).map_err(|error| format!("{to}: {error}"))?;
            }
        }
    }
    Ok(())
}
