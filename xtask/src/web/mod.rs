//! `cargo xtask web`: builds the page from gonio-web and `web/` into `dist/`.
//!
//! ```text
//! crates/gonio-web-first   cargo, profile `web-first`   the module that draws the first picture
//! crates/gonio-web   cargo, profile `web`    the application; the checker and the path tracer for workers
//!                    web/bindgen             their JavaScript bindings
//!                    binaryen's wasm-opt     optimises them
//! web/page           web/build/pack.mjs      bundles, hashes names, compresses with brotli and gzip: dist/
//! ```

pub mod browser;
mod sizes;

use crate::process;
use crate::root;
use crate::setup;
use crate::target::target_folder;
use sizes::Sizes;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

/// The kind of build.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Build {
    /// The page that users get.
    Shipped,
    /// Built in a fraction of the time and several times the size, for development.
    Dev,
}

/// Builds the page and prints its size.
pub fn run(words: &[&str]) -> ExitCode {
    let build = match words {
        [] => Build::Shipped,
        ["--dev"] => Build::Dev,
        _ => {
            eprintln!("xtask: web: unknown option `{}`; the only option is --dev", words.join(" "));
            return ExitCode::from(2);
        }
    };
    match build_page(&root(), build, &mut |step| println!("{step}")) {
        Ok(sizes) => {
            print!("\n{}", sizes.table());
            println!("\nThe page is in dist. To see it: cargo run --release -- serve --from dist");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("xtask: web: {}", error.trim_end());
            ExitCode::from(2)
        }
    }
}

/// Builds the page into `dist`. `say` receives each step before it begins.
pub fn build_page(root: &Path, build: Build, say: &mut dyn FnMut(&str)) -> Result<Sizes, String> {
    let web = root.join("web");
    let toolchain = setup::toolchain(root, &[setup::WASM]);
    if toolchain.failed > 0 {
        return Err(toolchain.details);
    }
    if !toolchain.remark.is_empty() {
        say(&toolchain.remark);
    }
    install_packages(&web, say)?;
    let profiles = if build == Build::Shipped { ["web-first", "web"] } else { ["web-dev", "web-dev"] };
    let target = setup::WASM;
    for (package, profile) in ["gonio-web-first", "gonio-web"].into_iter().zip(profiles) {
        say(&format!("building {package} for wasm32"));
        let cargo = &mut process::cargo(root);
        checked(cargo.args(["build", "--locked", "--package", package, "--profile", profile, "--target", target]))?;
    }
    say("generating JavaScript bindings");
    let folder = target_folder(root);
    let stage = folder.join("web-page");
    std::fs::create_dir_all(&stage).map_err(|e| format!("cannot make {}: {e}", stage.display()))?;
    let bindgen = bindgen(root)?;
    let [first, rest] = profiles;
    let programs = [
        ("gonio-web-first", first, "gonio_first", "-O3"),
        // -O3 takes five times as long for a module of this size and makes it no smaller.
        ("gonio-web", rest, "gonio", "-O2"),
        ("gonio-web-check", rest, "gonio_check", "-O2"),
        ("gonio-web-trace", rest, "gonio_trace", "-O2"),
    ];
    for (program, profile, name, _) in programs {
        let module = folder.join(target).join(profile).join(format!("{program}.wasm"));
        checked(Command::new(&bindgen).args([&module, &stage]).arg(name))?;
    }
    if build == Build::Shipped {
        say("optimising the modules (wasm-opt)");
        for (_, _, name, level) in programs {
            optimise(&web, &stage.join(format!("{name}_bg.wasm")), level)?;
        }
    }
    say("bundling the page");
    let packed = process::stdout_of(node(&web).arg("build/pack.mjs").arg(&stage).arg(root.join("dist")))?;
    let sizes = Sizes::read(&packed)?;
    write(&sizes_file(root), packed.as_bytes())?;
    // The build script of gonio watches this file's folder: see crates/gonio/build.rs.
    let mark = web.join("page/.built");
    write(&mark, sizes.version.as_bytes())?;
    Ok(sizes)
}

/// Where the sizes of the page that was built last are, as `Sizes::read` takes them.
fn sizes_file(root: &Path) -> PathBuf {
    target_folder(root).join("web-page/sizes.json")
}

/// Builds our tool that makes JavaScript bindings; returns its path.
fn bindgen(root: &Path) -> Result<PathBuf, String> {
    let package = "gonio-web-bindgen";
    checked(process::cargo(root).args(["build", "--locked", "--package", package]))?;
    Ok(target_folder(root).join("debug").join(format!("{package}{}", std::env::consts::EXE_SUFFIX)))
}

/// Node, in `web/`, where its packages are.
pub fn node(web: &Path) -> Command {
    let mut command = Command::new("node");
    command.current_dir(web);
    command
}

/// Runs wasm-opt on a file, in place. It takes minutes and is deterministic, so input and output are cached.
fn optimise(web: &Path, module: &Path, level: &str) -> Result<(), String> {
    let (input, output) = (module.with_extension("unoptimised.wasm"), module.with_extension("optimised.wasm"));
    let fresh = read(module)?;
    let known = output.is_file() && std::fs::read(&input).is_ok_and(|bytes| bytes == fresh);
    if !known {
        let _ = std::fs::remove_file(&output);
        write(&input, &fresh)?;
        let start = Instant::now();
        checked(
            node(web)
                .arg("node_modules/binaryen/bin/wasm-opt")
                .arg(&input)
                .arg(level)
                .args(WASM_OPT)
                .arg("-o")
                .arg(&output),
        )?;
        println!("  {:.0} s", start.elapsed().as_secs_f64());
    }
    write(module, &read(&output)?)
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|e| format!("cannot read {}: {e}", path.display()))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

/// Little is inlined. Brotli compresses better when related functions are neighbours and large
/// functions are not inlined into their only caller.
const WASM_OPT: &[&str] = &["--one-caller-inline-max-function-size", "20", "--reorder-functions-by-name"];

/// Runs a command. Its output is the error if it fails.
fn checked(command: &mut Command) -> Result<(), String> {
    let outcome = process::run(command);
    if outcome.success { Ok(()) } else { Err(outcome.text) }
}

/// Runs `npm ci` in `web/` or another folder with a lock file, unless its packages are installed.
pub fn install_packages(web: &Path, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let lock = web.join("package-lock.json");
    let locked = std::fs::read(&lock).map_err(|e| format!("cannot read {}: {e}", lock.display()))?;
    // Written last, so an interrupted installation is repeated.
    let stamp = web.join("node_modules/.gonio-installed");
    if std::fs::read(&stamp).is_ok_and(|installed| installed == locked) {
        return Ok(());
    }
    say("installing Node packages (npm ci)");
    // None of the packages needs its install script.
    checked(Command::new("npm").current_dir(web).args(["ci", "--ignore-scripts", "--no-fund", "--no-audit"]))?;
    write(&stamp, &locked)
}
