//! Hands the built web page (`dist/`, by `cargo xtask web`) to `gonio serve`, if it is there.
//!
//! It copies the page's files and writes the list `embedded_page.rs`: `(name, bytes)` for each. Without a page the
//! list is empty, and `gonio serve` says how to get one.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let top = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default()).join("../..");
    // Not `dist` itself: where it is missing, Cargo would run this, and build the crate, each time. A build of the
    // page leaves its mark in this folder, which is always there.
    println!("cargo:rerun-if-changed=../../web/page");
    println!("cargo:rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    if let Err(error) = embed(&top.join("dist"), &out) {
        println!("cargo:warning=the web page is not embedded: {error}");
        // An empty list can be compiled, and says the same at run time.
        let _ = fs::write(out.join("embedded_page.rs"), "&[]\n");
    }
}

/// Copies the page's files to `out`, so that a page that is built anew or deleted spoils no later compilation.
fn embed(dist: &Path, out: &Path) -> std::io::Result<()> {
    let copies = out.join("page");
    if copies.exists() {
        fs::remove_dir_all(&copies)?;
    }
    fs::create_dir_all(&copies)?;
    let mut list = String::from("&[\n");
    // The page is whole only with its first file, which a build writes last.
    if dist.join("index.html").is_file() {
        for name in file_names(dist, "")? {
            // Where there is a gzip file beside it, the bytes themselves would be there twice.
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

/// Every file below the folder, from its top and with `/`, sorted.
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
