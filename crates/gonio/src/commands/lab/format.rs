//! The forms of a verdict on stdout.

use super::text;
use crate::commands::about::VERSION;
use crate::error::CliError;
use crate::report::{Reporter, write_stdout};
use gonio_check::verdict::Verdict;
use gonio_exercises::report;
use std::path::{Path, PathBuf};

/// A value of `--format`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CheckFormat {
    /// For people.
    #[default]
    Text,
    /// One JSON object, as with `--json`.
    Json,
    /// The text, and a workflow command of GitHub Actions for each message.
    Github,
    /// Static Analysis Results Interchange Format 2.1.0.
    Sarif,
    /// `FILE:LINE:COLUMN: error: MESSAGE`
    Gcc,
}

impl CheckFormat {
    /// All of them.
    pub const ALL: [CheckFormat; 5] =
        [CheckFormat::Text, CheckFormat::Json, CheckFormat::Github, CheckFormat::Sarif, CheckFormat::Gcc];

    /// The word on the command line.
    pub fn word(self) -> &'static str {
        match self {
            CheckFormat::Text => "text",
            CheckFormat::Json => "json",
            CheckFormat::Github => "github",
            CheckFormat::Sarif => "sarif",
            CheckFormat::Gcc => "gcc",
        }
    }

    /// Whether it lists places in the files of one submission.
    pub fn lists_places(self) -> bool {
        matches!(self, CheckFormat::Github | CheckFormat::Sarif | CheckFormat::Gcc)
    }

    /// Refuses another form beside it on stdout.
    pub fn check(self, json: bool, is_stdout_taken: bool) -> Result<(), CliError> {
        let other = match (json, is_stdout_taken) {
            (true, _) => "--json",
            (false, true) => "`-`",
            (false, false) => return Ok(()),
        };
        match self.lists_places() {
            true => {
                Err(CliError::new(format!("{other} and --format {} both write to stdout; choose one", self.word())))
            }
            false => Ok(()),
        }
    }
}

/// Prints a verdict on the files at the paths `given` on the command line.
pub fn print(
    format: CheckFormat,
    given: &[PathBuf],
    verdict: &Verdict,
    is_stdout_taken: bool,
    reporter: &Reporter,
) -> Result<(), CliError> {
    let path_of = |file: &str| path_of(given, file);
    let text = || text::verdict(verdict);
    match format {
        CheckFormat::Sarif => reporter.report(&report::sarif(verdict, VERSION, path_of)),
        CheckFormat::Gcc => write_stdout(report::gcc(&report::annotations(verdict), path_of).as_bytes()),
        CheckFormat::Github => {
            reporter.text(&text())?;
            write_stdout(report::github(&report::annotations(verdict), path_of).as_bytes())
        }
        CheckFormat::Text | CheckFormat::Json if reporter.json() => reporter.report(verdict),
        CheckFormat::Text | CheckFormat::Json if is_stdout_taken => {
            reporter.text_on_stderr(&text());
            Ok(())
        }
        CheckFormat::Text | CheckFormat::Json => reporter.text(&text()),
    }
}

/// The path, from the current folder, of a file as a verdict names it: within the folder that was given, or as it was given. A
/// file of an archive has the archive's path before its own.
fn path_of(given: &[PathBuf], file: &str) -> String {
    let within = |path: &Path| match given.len() {
        1 => Some(path.join(file)),
        _ => {
            let rest = file.strip_prefix(&*path.file_name()?.to_string_lossy())?.strip_prefix('/')?;
            Some(path.join(rest))
        }
    };
    let is_itself = |path: &&PathBuf| path.is_file() && path.as_os_str() == file;
    let found = match given.iter().find(is_itself) {
        Some(itself) => Some(itself.clone()),
        None => given.iter().find_map(|path| within(path)),
    };
    let path = found.unwrap_or_else(|| file.into());
    let shown = path.to_string_lossy().replace('\\', if cfg!(windows) { "/" } else { "\\" });
    shown.strip_prefix("./").map_or(shown.clone(), str::to_owned)
}
