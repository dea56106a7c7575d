//! The wheel of the Python package for one system: `cargo xtask dist --wheel`.

use super::{packages_folder, without_paths};
use crate::test::python::Environment;
use std::path::{Path, PathBuf};

/// Systems that wheels are built for. One wheel serves every version of Python from 3.11 on.
pub const TARGETS: &[&str] = &["x86_64-unknown-linux-gnu", "x86_64-pc-windows-gnu"];

/// Builds a target's wheel with the profile `dist`; returns its path. maturin names the oldest glibc that the library runs with.
pub fn build(root: &Path, target: &str, say: &mut dyn FnMut(&str)) -> Result<PathBuf, String> {
    if !TARGETS.contains(&target) {
        return Err(format!("wheels are built for {}, not for {target}", TARGETS.join(" and ")));
    }
    let environment = Environment::for_wheels(root)?;
    say(&format!("building the wheel for {target}"));
    let flags = format!("target.{target}.rustflags=[{}]", without_paths(root).join(", "));
    let built = environment.wheel("dist", &["--target", target, "--config", &flags], &[])?;
    let wheel = packages_folder(root).join(built.file_name().unwrap_or_default());
    std::fs::copy(&built, &wheel).map_err(|error| format!("cannot write {}: {error}", wheel.display()))?;
    Ok(wheel)
}
