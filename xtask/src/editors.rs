//! The extension for VS Code: its package, and its test with the program.

use crate::process;
use crate::report::Findings;
use crate::target::debug_program;
use crate::web::{install_packages, node};
use std::path::Path;
use std::process::ExitCode;

/// Writes the package into `editors/vscode/dist`.
pub fn run(root: &Path) -> ExitCode {
    let folder = root.join("editors/vscode");
    let built = install_packages(&folder, &mut |text| println!("{text}"))
        .and_then(|()| process::stdout_of(node(&folder).arg("build.mjs")));
    match built {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("xtask: {error}");
            ExitCode::from(2)
        }
    }
}

/// Runs the extension's tests with the program that the workspace's tests have built.
pub fn test(root: &Path) -> Findings {
    let folder = root.join("editors/vscode");
    if let Err(error) = install_packages(&folder, &mut |_| {}) {
        return Findings::fail(error);
    }
    let program = debug_program(root);
    let outcome = process::run(node(&folder).arg("test.mjs").env("GONIO_PROGRAM", program));
    if outcome.success { Findings::pass() } else { Findings::fail(outcome.text) }
}
