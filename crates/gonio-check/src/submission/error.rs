//! Errors in files that should be a pair of shaders.

use gonio_glsl::Stage;
use std::fmt;

/// An error in files that should be a pair of shaders. Each message tells what is wrong, where, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum IntakeError {
    /// There are no files.
    NoFiles,
    /// A file without text.
    Empty {
        /// The file.
        file: String,
    },
    /// A file that is not text.
    Binary {
        /// The file.
        file: String,
        /// The reason, for example "a zero byte at offset 8".
        because: String,
    },
    /// A file of a word processor.
    RichText {
        /// The file.
        file: String,
    },
    /// A file above the limit.
    TooLarge {
        /// The file.
        file: String,
        /// Its size in bytes.
        bytes: usize,
    },
    /// No file holds a shader.
    NoShader {
        /// The names of the files.
        files: Vec<String>,
    },
    /// One stage only.
    MissingStage {
        /// The stage that no file holds.
        missing: Stage,
        /// The shaders of the other stage.
        found: Vec<String>,
    },
    /// Two or more of one stage and none of the other.
    SameStageTwice {
        /// The stage that was found.
        stage: Stage,
        /// The names of the shaders.
        found: Vec<String>,
    },
    /// A file that a shader includes is not among the files.
    MissingInclude {
        /// The file with the `#include`.
        file: String,
        /// Its line, from 1.
        line: u32,
        /// The name of the included file.
        included: String,
    },
    /// No pair has the requested name.
    NotFound {
        /// The requested name.
        requested: String,
        /// The names of the pairs.
        candidates: Vec<String>,
    },
}

/// Lists names for a sentence: the first eight, and the number of others.
pub(super) fn list(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let mut text = names.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > SHOWN {
        text.push_str(&format!(" and {} more", names.len() - SHOWN));
    }
    text
}

impl fmt::Display for IntakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoFiles => write!(f, "there are no files: hand in a vertex and a fragment shader"),
            Self::Empty { file } => write!(f, "{file} is empty: save the shader in your editor and hand it in again"),
            Self::Binary { file, because } => {
                write!(f, "{file} is not a text file ({because}): hand in the shader's source as plain text")
            }
            Self::RichText { file } => write!(
                f,
                "{file} is a word processor's document, not plain text: save it as plain text (.txt) and hand that in"
            ),
            Self::TooLarge { file, bytes } => write!(
                f,
                "{file} has {bytes} bytes, more than the limit of {}: hand in only the shader's source",
                super::text::LARGEST
            ),
            Self::NoShader { files } => write!(
                f,
                "there is no shader in {}: hand in a vertex and a fragment shader, or the program that holds both as \
                 strings",
                list(files)
            ),
            Self::MissingStage { missing, found } => write!(
                f,
                "the {missing} shader is missing; found only {} ({}): hand in both stages",
                list(found),
                missing.other()
            ),
            Self::SameStageTwice { stage, found } => write!(
                f,
                "{} are all {stage} shaders, and there is no {} shader: hand in one of each",
                list(found),
                stage.other()
            ),
            Self::MissingInclude { file, line, included } => write!(
                f,
                "{file}:{line}: `{included}` is included and is not among the files: hand it in too, or paste its text \
                 here"
            ),
            Self::NotFound { requested, candidates } => {
                write!(f, "no pair of shaders is called `{requested}`: choose one of {}", list(candidates))
            }
        }
    }
}

impl std::error::Error for IntakeError {}
