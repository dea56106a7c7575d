//! Cargo's target folder, and the program in it.

use crate::process;
use std::path::{Path, PathBuf};

/// Cargo's target folder.
pub fn target_folder(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}

/// The program that is built with the tests.
pub fn debug_program(root: &Path) -> PathBuf {
    target_folder(root).join("debug").join(format!("gonio{}", std::env::consts::EXE_SUFFIX))
}

/// Builds that program, with the workspace's others: building it alone would select other features, and build most of it again.
pub fn build_program(root: &Path) -> Result<PathBuf, String> {
    let built = process::run(process::cargo(root).args(["build", "--locked", "--workspace", "--bins"]));
    if built.success { Ok(debug_program(root)) } else { Err(built.text) }
}
