//! The environment in which the Python package is installed.

use crate::Places;
use std::path::PathBuf;

/// The interpreter of the environment, which `cargo xtask bench` makes with the package in it.
pub fn interpreter(places: &Places) -> Result<PathBuf, String> {
    let bin = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
    let python = places.out.with_file_name("python").join("venv").join(bin);
    if python.is_file() {
        Ok(python)
    } else {
        Err(format!("{} is missing; `cargo xtask bench python` makes it", python.display()))
    }
}
