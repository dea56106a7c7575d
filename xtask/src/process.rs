//! Runs other programs and captures their output.

use std::io::Read;
use std::path::Path;
use std::process::Command;

/// The outcome of a program.
pub struct Outcome {
    /// Whether it ran and exited with 0.
    pub success: bool,
    /// Its stdout and stderr in order, or the reason why it could not be started.
    pub text: String,
}

/// The cargo that runs this program, in the repository's root folder.
pub fn cargo(root: &Path) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root);
    // `cargo run` sets variables about its own package. Build scripts would see them as changes and run again.
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        if text.starts_with("CARGO_PKG_") || text.starts_with("CARGO_MANIFEST_") || text == "CARGO_PRIMARY_PACKAGE" {
            command.env_remove(&name);
        }
    }
    command.env("CARGO_TERM_COLOR", "never");
    command
}

/// Runs a program to its end, with stdout and stderr in one text in the order they were written.
pub fn run(command: &mut Command) -> Outcome {
    match run_or_error(command) {
        Ok(outcome) => outcome,
        Err(error) => {
            let program = command.get_program().to_string_lossy().into_owned();
            Outcome { success: false, text: format!("cannot run `{program}`: {error}{}\n", how_to_install(&program)) }
        }
    }
}

fn run_or_error(command: &mut Command) -> std::io::Result<Outcome> {
    let (mut reader, writer) = std::io::pipe()?;
    command.stdin(std::process::Stdio::null()).stdout(writer.try_clone()?).stderr(writer);
    let mut child = command.spawn()?;
    // The command holds the writing ends of the pipe, and reading ends only when they are closed.
    command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null());
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes)?;
    let status = child.wait()?;
    Ok(Outcome { success: status.success(), text: String::from_utf8_lossy(&bytes).into_owned() })
}

/// Runs a program to its end. Returns its stdout, or its stderr as the error if it failed.
pub fn stdout_of(command: &mut Command) -> Result<String, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command
        .stdin(std::process::Stdio::null())
        .output()
        .map_err(|error| format!("cannot run `{program}`: {error}{}", how_to_install(&program)))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(format!("`{program}` failed: {}", String::from_utf8_lossy(&output.stderr).trim()))
}

/// How to install a missing program.
fn how_to_install(program: &str) -> String {
    let advice = match Path::new(program).file_name().and_then(|n| n.to_str()).unwrap_or(program) {
        "cargo" | "rustup" => "install it from https://rustup.rs",
        "git" => "install the package `git`",
        "apt-get" | "dpkg-query" => "this system is not Debian",
        "node" | "npm" => "install the packages `nodejs npm`",
        "python3" => "install the packages `python3 python3-venv`",
        _ => return String::new(),
    };
    format!("; {advice}")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_missing_program_is_a_failure_that_names_it() {
        let outcome = run(&mut Command::new("no-such-program-of-gonio"));
        assert!(!outcome.success);
        assert!(outcome.text.contains("no-such-program-of-gonio"), "{}", outcome.text);
        assert!(stdout_of(&mut Command::new("no-such-program-of-gonio")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn both_streams_and_the_exit_code_are_kept() {
        let outcome = run(Command::new("sh").args(["-c", "echo one; echo two >&2; exit 3"]));
        assert!(!outcome.success);
        assert_eq!(outcome.text, "one\ntwo\n");
        assert_eq!(stdout_of(Command::new("sh").args(["-c", "echo one; echo two >&2"])).unwrap(), "one\n");
    }
}
