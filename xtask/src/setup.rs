//! Installs missing system packages, toolchain components and targets.

use crate::process;
use crate::report::Findings;
use std::path::Path;
use std::process::Command;

/// Debian packages that the tests need: OpenGL on the CPU; RenderDoc, its Python module and the X server that opening a
/// capture requires; libraries for a window under X, simulated input, and a font with Cyrillic letters; D-Bus and the registry of
/// accessible programs; the browser; an editor.
const PACKAGES: &[&str] = &[
    "libegl1",
    "libgl1-mesa-dri",
    "librenderdoc",
    "python3-renderdoc",
    "xvfb",
    "xauth",
    "libxcursor1",
    "libxi6",
    "libxkbcommon-x11-0",
    "xdotool",
    "libfontconfig1",
    "fonts-dejavu-core",
    "dbus-daemon",
    "at-spi2-core",
    "chromium",
    "neovim",
];

/// Programs that need not come from a Debian package, each with its package.
const PROGRAMS: &[(&str, &str)] = &[("node", "nodejs"), ("npm", "npm")];

/// The browser's target.
pub const WASM: &str = "wasm32-unknown-unknown";

const COMPONENTS: &[&str] = &["rustfmt", "clippy"];

/// Installs the packages that every test run needs: see [`install`].
pub fn packages() -> Findings {
    install(PACKAGES, PROGRAMS)
}

/// Installs missing packages as root on Debian; otherwise prints the command that installs them. Each of `programs` is a program that
/// need not come from a package, and its package.
pub fn install(packages: &[&'static str], programs: &[(&str, &'static str)]) -> Findings {
    if !cfg!(target_os = "linux") {
        return Findings::default()
            .remarking("skipped: only Linux packages are known; the tests look for OpenGL themselves");
    }
    if !Path::new("/etc/debian_version").exists() {
        return Findings::default().remarking("not Debian: install OpenGL (EGL) and RenderDoc yourself");
    }
    let mut missing: Vec<&str> = packages.iter().copied().filter(|package| !is_installed(package)).collect();
    let runs = |program: &str| process::stdout_of(Command::new(program).arg("--version")).is_ok();
    missing.extend(programs.iter().filter(|(program, _)| !runs(program)).map(|(_, package)| *package));
    if missing.is_empty() {
        return Findings::pass();
    }
    let by_hand = format!("apt-get update && apt-get install -y --no-install-recommends {}", missing.join(" "));
    if !is_root() {
        return Findings::fail(format!("packages are missing; run: sudo sh -c '{by_hand}'"));
    }
    for arguments in [vec!["update"], [vec!["install", "-y", "--no-install-recommends"], missing.clone()].concat()] {
        let outcome = process::run(
            Command::new("apt-get").args(["-q"]).args(&arguments).env("DEBIAN_FRONTEND", "noninteractive"),
        );
        // An update that cannot reach every mirror may suffice; a failing installation is reported.
        if !outcome.success && arguments[0] == "install" {
            return Findings::fail(format!("{}\nrun: {by_hand}", outcome.text));
        }
    }
    Findings::pass().remarking(format!("installed {}", missing.join(" ")))
}

fn is_installed(package: &str) -> bool {
    process::stdout_of(Command::new("dpkg-query").args(["-W", "-f", "${db:Status-Status}", package]))
        .is_ok_and(|status| status == "installed")
}

fn is_root() -> bool {
    process::stdout_of(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0")
}

/// The version of cargo-deny that reads `deny.toml`.
const CARGO_DENY: &str = "0.20.2";

/// Installs cargo-deny if it is missing. A debug build suffices and takes a third of the time.
pub fn cargo_deny(root: &Path) -> Result<(), String> {
    if process::stdout_of(process::cargo(root).args(["deny", "--version"])).is_ok() {
        return Ok(());
    }
    let arguments = ["install", "--locked", "--debug", "--no-default-features", "cargo-deny", "--version", CARGO_DENY];
    let outcome = process::run(process::cargo(root).args(arguments));
    if outcome.success { Ok(()) } else { Err(format!("{}\nrun: cargo {}", outcome.text, arguments.join(" "))) }
}

/// Adds missing components and targets to the pinned toolchain, which rustup reads from `rust-toolchain.toml`.
pub fn toolchain(root: &Path, targets: &[&str]) -> Findings {
    let rustup = |arguments: &[&str]| {
        let mut command = Command::new("rustup");
        command.current_dir(root).args(arguments);
        command
    };
    let mut added = Vec::new();
    for (kind, required) in [("component", COMPONENTS), ("target", targets)] {
        let installed = match process::stdout_of(&mut rustup(&[kind, "list", "--installed"])) {
            Ok(list) => list,
            Err(error) => return Findings::fail(error),
        };
        let missing = missing_from(&installed, required);
        if missing.is_empty() {
            continue;
        }
        let outcome = process::run(&mut rustup(&[&[kind, "add"], missing.as_slice()].concat()));
        if !outcome.success {
            return Findings::fail(format!("{}\nrun: rustup {kind} add {}", outcome.text, missing.join(" ")));
        }
        added.extend(missing);
    }
    if added.is_empty() { Findings::pass() } else { Findings::pass().remarking(format!("added {}", added.join(" "))) }
}

/// `rustup component list` appends the host's name to a component's: `clippy-x86_64-unknown-linux-gnu`.
fn missing_from<'a>(installed: &str, required: &[&'a str]) -> Vec<&'a str> {
    let has = |name: &str| {
        installed.lines().any(|line| line == name || line.strip_prefix(name).is_some_and(|rest| rest.starts_with('-')))
    };
    required.iter().copied().filter(|name| !has(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_components_and_targets_are_named() {
        let installed = "clippy-x86_64-unknown-linux-gnu\nrustc-x86_64-unknown-linux-gnu\nwasm32-unknown-unknown\n";
        assert_eq!(missing_from(installed, &["rustfmt", "clippy"]), ["rustfmt"]);
        let targets = ["x86_64-pc-windows-msvc", "aarch64-apple-darwin", WASM];
        assert_eq!(missing_from(installed, &targets), targets[..2]);
    }
}
