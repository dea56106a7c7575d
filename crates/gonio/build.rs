//! Embeds the web page (`dist/`, built by `cargo xtask web`) for `gonio serve`, and the commit for `gonio --version`.
//!
//! The page's files are copied and listed in `embedded_page.rs`: `(name, bytes)` for each. Without a page the list is
//! empty, and `gonio serve` explains how to build one.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() {
    let top = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default()).join("../..");
    // Not `dist` itself: if it is missing, Cargo would run this script and build the crate each time. A build of the page changes
    // a file in this folder, which always exists.
    println!("cargo:rerun-if-changed=../../web/page");
    println!("cargo:rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    if let Err(error) = embed(&top.join("dist"), &out) {
        println!("cargo:warning=the web page is not embedded: {error}");
        // An empty list compiles, and `gonio serve` then reports the missing page.
        let _ = fs::write(out.join("embedded_page.rs"), "&[]\n");
    }
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    let commit = commit(&top).map_or(String::new(), |commit| format!(" ({commit})"));
    println!("cargo:rustc-env=GONIO_VERSION={version}{commit}");
}

/// The commit and its date, `4616af2b01 2026-11-22`. It contains nothing about the machine or the time of the build, so that builds
/// are reproducible. `None` outside gonio's own repository, or without git.
fn commit(top: &Path) -> Option<String> {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").arg("-C").arg(top).args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    // A copy of gonio's files may lie in somebody else's repository.
    if !git(&["rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    // `HEAD` names a branch, whose own file changes with each commit.
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]).unwrap_or_default();
    for name in ["HEAD", branch.as_str(), "packed-refs"] {
        let file = git(&["rev-parse", "--path-format=absolute", "--git-path", name]);
        // A file that does not exist would make Cargo run this each time.
        if let Some(file) = file.filter(|file| Path::new(file).is_file()) {
            println!("cargo:rerun-if-changed={file}");
        }
    }
    git(&["log", "-1", "--abbrev=10", "--format=%h %cd", "--date=format:%Y-%m-%d"])
}

/// Copies the page's files to `out`, so that a page that is built anew or deleted later breaks no compilation.
fn embed(dist: &Path, out: &Path) -> std::io::Result<()> {
    let copies = out.join("page");
    if copies.exists() {
        fs::remove_dir_all(&copies)?;
    }
    fs::create_dir_all(&copies)?;
    let mut list = String::from("&[\n");
    // A build writes this file last: without it the page is incomplete.
    if dist.join("index.html").is_file() {
        for name in file_names(dist, "")? {
            // A gzip file beside it holds the same bytes.
            if dist.join(format!("{name}.gz")).is_file() {
                continue;
            }
            let copy = copies.join(name.replace('/', "__"));
            fs::copy(dist.join(&name), &copy)?;
            let _ = writeln!(list, "    ({name:?}, include_bytes!({:?}).as_slice()),", copy.display().to_string());
        }
    }
    list.push_str("]\n");
    fs::write(out.join("embedded_page.rs"), list)
}

/// The names of all files below the folder, relative to it, with `/`, sorted.
fn file_names(folder: &Path, above: &str) -> std::io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let Ok(name) = entry.file_name().into_string() else { continue };
        let name = format!("{above}{name}");
        if entry.file_type()?.is_dir() {
            names.extend(file_names(&entry.path(), &format!("{name}/"))?);
        } else {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}
