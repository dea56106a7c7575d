//! `cargo xtask bench`: builds the program and the benchmarks, and runs `gonio-bench`.

use crate::test::python;
use crate::web::{self, Build};
use crate::{process, root};
use std::path::PathBuf;
use std::process::{Command, ExitCode};

/// Builds the page and measures it in a browser against a three.js page.
pub fn web() -> ExitCode {
    let root = root();
    if let Err(error) = web::build_page(&root, Build::Shipped, &mut |step| println!("{step}")) {
        eprintln!("xtask: bench web: {}", error.trim_end());
        return ExitCode::from(2);
    }
    match web::node(&root.join("web")).arg("bench/run.mjs").status() {
        Ok(status) => ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(2)),
        Err(error) => {
            eprintln!("xtask: cannot run node: {error}");
            ExitCode::from(2)
        }
    }
}

/// Builds the command line and the benchmarks with the `release` profile, and runs the named benchmarks or all.
pub fn run(names: &[&str]) -> ExitCode {
    let root = root();
    println!("building the release programs");
    let arguments = ["build", "--release", "--locked", "--package", "gonio", "--package", "gonio-bench"];
    let built = process::run(process::cargo(&root).args(arguments));
    if !built.success {
        eprint!("{}", built.text);
        return ExitCode::from(2);
    }
    if names.is_empty() || names.iter().any(|name| matches!(*name, "python" | "ray")) {
        println!("building the Python package");
        let installed = python::Environment::new(&root).and_then(|python| python.install("release"));
        if let Err(error) = installed {
            eprintln!("xtask: bench: {}", error.trim_end());
            return ExitCode::from(2);
        }
    }
    // Not `cargo run`, which selects other features for a single package and would build again.
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let program = target.join("release").join(format!("gonio-bench{}", std::env::consts::EXE_SUFFIX));
    match Command::new(&program).args(names).status() {
        Ok(status) => ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(2)),
        Err(error) => {
            eprintln!("xtask: cannot run {}: {error}", program.display());
            ExitCode::from(2)
        }
    }
}
