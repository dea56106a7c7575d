//! The Python package: its wheel is built, installed into an environment of its own, and tested there with its documentation.

use crate::report::Findings;
use crate::target::{build_program, debug_program, target_folder};
use crate::{process, setup};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Debian packages: OpenGL on the CPU.
const PACKAGES: &[&str] = &["libegl1", "libgl1-mesa-dri"];
/// Programs that need not come from a Debian package, each with its package.
const PROGRAMS: &[(&str, &str)] = &[("python3", "python3")];

/// A wheel to test instead of building one, such as that of a release.
const WHEEL_VARIABLE: &str = "GONIO_WHEEL";

/// Builds the wheel as the tests are built, and tests it. It needs the command line, with which it is compared.
pub fn step(root: &Path) -> Findings {
    let installed = setup::install(PACKAGES, PROGRAMS);
    if installed.failed > 0 {
        return installed;
    }
    // As in the step for Windows, that of the tests: without their features, building it takes as long as they do.
    let program = Some(debug_program(root)).filter(|program| program.is_file());
    let program = program.map_or_else(|| build_program(root), Ok);
    let tested = program.and_then(|program| Environment::new(root)?.test(&program));
    tested.unwrap_or_else(Findings::fail)
}

/// An environment of Python's, below `target/python`.
pub struct Environment<'r> {
    root: &'r Path,
    /// `target/python`
    folder: PathBuf,
}

/// The packages with their versions.
const REQUIREMENTS: &str = "python/tests/requirements.txt";

impl<'r> Environment<'r> {
    /// The environment with all packages that the tests need.
    pub fn new(root: &'r Path) -> Result<Self, String> {
        Environment::with(root, &["--requirement", REQUIREMENTS])
    }

    /// The environment with what builds wheels.
    pub fn for_wheels(root: &'r Path) -> Result<Self, String> {
        let path = root.join(REQUIREMENTS);
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        // pip takes no file with extras, such as `ray[data]`, for versions alone.
        let maturin = text.lines().find(|line| line.starts_with("maturin=="));
        Environment::with(root, &[maturin.ok_or_else(|| format!("{}: no version of maturin", path.display()))?])
    }

    /// Makes the environment, or brings it up to date.
    fn with(root: &'r Path, packages: &[&str]) -> Result<Self, String> {
        let folder = target_folder(root).join("python");
        let environment = Environment { root, folder };
        if !environment.program("python").is_file() {
            let venv = environment.folder.join("venv");
            let made = process::run(Command::new("python3").args(["-m", "venv"]).arg(&venv));
            if !made.success {
                // Half an environment would be taken for a whole one.
                let _ = std::fs::remove_dir_all(&venv);
                return Err(format!(
                    "{}\ninstall the packages `python3 python3-venv`, Python 3.11 or later",
                    made.text
                ));
            }
        }
        environment.pip(packages)?;
        Ok(environment)
    }

    /// A program of the environment.
    pub fn program(&self, name: &str) -> PathBuf {
        self.folder.join(if cfg!(windows) { "venv/Scripts" } else { "venv/bin" }).join(name)
    }

    fn run(&self, command: &mut Command) -> Result<String, String> {
        let outcome = process::run(command.current_dir(self.root));
        if outcome.success { Ok(outcome.text) } else { Err(outcome.text) }
    }

    fn pip(&self, arguments: &[&str]) -> Result<(), String> {
        let mut pip = Command::new(self.program("python"));
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(arguments);
        self.run(&mut pip).map(drop)
    }

    /// Builds the wheel with a profile of Cargo's, and installs it. [`WHEEL_VARIABLE`] names one to install instead.
    pub fn install(&self, profile: &str) -> Result<PathBuf, String> {
        let wheel = match std::env::var_os(WHEEL_VARIABLE) {
            Some(wheel) => self.root.join(wheel),
            // Little for debuggers, as in the program for Windows.
            None => self.wheel(profile, &[], &[("CARGO_PROFILE_DEV_DEBUG", "0"), ("CARGO_INCREMENTAL", "0")])?,
        };
        self.pip(&["--force-reinstall", "--no-deps", &wheel.to_string_lossy()])?;
        Ok(wheel)
    }

    /// Builds a wheel with a profile of Cargo's, and further arguments of maturin and variables.
    pub fn wheel(&self, profile: &str, more: &[&str], variables: &[(&str, &str)]) -> Result<PathBuf, String> {
        // A folder of its own shows which wheel is new.
        let wheels = self.folder.join("wheels").join(profile);
        if wheels.exists() {
            std::fs::remove_dir_all(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
        }
        let mut maturin = Command::new(self.program("maturin"));
        maturin.args(["build", "--locked", "--quiet", "--profile", profile]).arg("--out").arg(&wheels).args(more);
        self.run(maturin.envs(variables.iter().copied()))?;
        let built = std::fs::read_dir(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
        let mut built = built.flatten().map(|entry| entry.path());
        built.find(|path| path.extension().is_some_and(|end| end == "whl")).ok_or("maturin built no wheel".to_owned())
    }

    fn test(&self, program: &Path) -> Result<Findings, String> {
        let wheel = self.install("dev")?;
        let types = self.run(Command::new(self.program("mypy")).args(["--strict", "python/gonio"]));
        // Ray's sockets want a short path.
        let ray = std::env::temp_dir().join(format!("gonio-ray-{}", std::process::id()));
        let mut pytest = Command::new(self.program("python"));
        pytest.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "python/tests"]);
        pytest.env("GONIO_PROGRAM", program).env("RAY_TMPDIR", &ray).env("RAY_USAGE_STATS_ENABLED", "0");
        let outcome = process::run(pytest.current_dir(self.root));
        let _ = std::fs::remove_dir_all(&ray);
        let mut findings = findings(outcome.success, &outcome.text);
        match types {
            Ok(_) => findings.passed += 1,
            Err(errors) => {
                findings.failed += 1;
                findings.details = format!("{errors}{}", findings.details);
            }
        }
        let size = std::fs::metadata(&wheel).map_or(0, |metadata| metadata.len());
        let name = wheel.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(findings.remarking(format!("{name}, {:.1} MB", size as f64 / 1e6)))
    }
}

/// The numbers of the last line of pytest, `2 failed, 50 passed, 1 warning in 3.21s`. A skipped test is a failure.
fn findings(success: bool, text: &str) -> Findings {
    let last = text.trim_end().lines().last().unwrap_or_default();
    let count = |word: &str| {
        let words: Vec<&str> = last.split([' ', ',']).filter(|word| !word.is_empty()).collect();
        let at = words.iter().position(|other| other.trim_end_matches('s') == word);
        at.and_then(|at| words.get(at.checked_sub(1)?)?.parse::<usize>().ok()).unwrap_or(0)
    };
    let (passed, failed) = (count("passed"), count("failed") + count("error") + count("skipped"));
    if success && failed == 0 && passed > 0 {
        return Findings { passed, ..Findings::default() };
    }
    Findings { passed, failed: failed.max(1), details: text.to_owned(), ..Findings::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_line_of_pytest_is_counted() {
        assert_eq!(
            findings(true, "....\n4 passed, 1 warning in 0.1s\n"),
            Findings { passed: 4, ..Findings::default() }
        );
        let counts = |success, text| (findings(success, text).passed, findings(success, text).failed);
        assert_eq!(counts(false, "x\n2 failed, 3 passed, 1 error in 1.2s"), (3, 3));
        assert_eq!(counts(true, "1 passed, 2 skipped in 1.2s"), (1, 2));
        // Neither a crash nor an empty folder passes.
        assert_eq!(counts(false, "Segmentation fault"), (0, 1));
        assert_eq!(counts(true, "no tests ran in 0.01s"), (0, 1));
    }
}
