//! Output files: their paths, and how they are written: completely or not at all.

pub mod atomic;

pub use atomic::OutputFiles;

use crate::error::CliError;
use crate::report::{self, Reporter};
use gonio_image::encode::png::ColorTag;
use gonio_light::color::ColorEncoding;
use gonio_scene::DisplayMap;
use std::ffi::OsString;
use std::fmt::{Display, Formatter};
use std::path::{Path, PathBuf};

/// The colour tag of a picture's PNG file: encoded light is tagged, the numbers of a debug view are not.
pub fn color_tag(map: &DisplayMap) -> ColorTag {
    match map {
        DisplayMap::Light(transform) if transform.encoding == ColorEncoding::Srgb => ColorTag::Srgb,
        _ => ColorTag::Untagged,
    }
}

/// A file, or stdout, which is written `-`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputPath {
    Stdout,
    File(PathBuf),
}

impl From<OsString> for OutputPath {
    fn from(text: OsString) -> Self {
        if text == "-" { OutputPath::Stdout } else { OutputPath::File(text.into()) }
    }
}

impl Display for OutputPath {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            OutputPath::Stdout => f.write_str("-"),
            OutputPath::File(path) => path.display().fmt(f),
        }
    }
}

impl OutputPath {
    pub fn is_stdout(&self) -> bool {
        *self == OutputPath::Stdout
    }

    /// The file, unless the output goes to stdout.
    pub fn file(&self) -> Option<&Path> {
        match self {
            OutputPath::Stdout => None,
            OutputPath::File(path) => Some(path),
        }
    }

    /// Finds out, before any work, whether the file can be written.
    pub fn check_writable(&self) -> Result<(), CliError> {
        self.file().map_or(Ok(()), atomic::check_writable)
    }

    /// Replaces or creates the file, or writes to stdout.
    pub fn write(&self, bytes: &[u8]) -> Result<(), CliError> {
        match self {
            OutputPath::Stdout => report::write_stdout(bytes),
            OutputPath::File(path) => atomic::write(path, bytes),
        }
    }
}

/// Whether a terminal can show an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    Text,
    Binary,
}

/// Finds out, before any work, whether stdout can take the one of these outputs that goes there, if one does. Returns whether one
/// does.
pub fn check_stdout<'a>(
    outputs: impl IntoIterator<Item = (&'a OutputPath, OutputKind)>,
    reporter: &Reporter,
) -> Result<bool, CliError> {
    let on_stdout: Vec<OutputKind> =
        outputs.into_iter().filter(|(output, _)| output.is_stdout()).map(|(_, content)| content).collect();
    let [content] = on_stdout[..] else {
        return match on_stdout.len() {
            0 => Ok(false),
            _ => Err(CliError::new("`-` is given more than once; stdout takes one file")),
        };
    };
    if reporter.json() {
        return Err(CliError::new("`-` and --json both write to stdout; name a file, or leave out --json"));
    }
    if content == OutputKind::Binary && reporter.stdout_is_terminal() {
        return Err(CliError::new("`-` would write binary data to the terminal; redirect stdout, or name a file"));
    }
    Ok(true)
}

/// Refuses `-` for a command that writes several files into a folder.
pub fn check_folder(folder: &Path, command: &str) -> Result<(), CliError> {
    if folder.as_os_str() == "-" {
        return Err(CliError::new(format!("{command} writes several files, and stdout takes one; name a folder")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::GeneralOptions;

    fn check(outputs: &[&str], json: bool) -> Result<bool, String> {
        let outputs: Vec<OutputPath> = outputs.iter().map(|text| OsString::from(text).into()).collect();
        let reporter = Reporter::new(&GeneralOptions { json, ..GeneralOptions::default() });
        let outputs = outputs.iter().map(|output| (output, OutputKind::Text));
        check_stdout(outputs, &reporter).map_err(|error| error.to_string())
    }

    #[test]
    fn stdout_takes_one_output() {
        assert_eq!(check(&["a.png", "b"], true), Ok(false));
        assert_eq!(check(&["a.png", "-"], false), Ok(true));
        assert!(check(&["-", "-"], false).is_err_and(|error| error.contains("more than once")));
        assert!(check(&["-"], true).is_err_and(|error| error.contains("--json")));
        // A file in this folder may be called so.
        assert_eq!(OutputPath::from(OsString::from("./-")), OutputPath::File("./-".into()));
    }
}
