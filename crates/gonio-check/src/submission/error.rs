//! Errors in files that should be a pair of shaders.

use gonio_glsl::Stage;
use gonio_language::tr;
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
    let text = names.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => text,
        more => tr!("check-submission-list-and-more", names = text, more = more),
    }
}

impl fmt::Display for IntakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::NoFiles => tr!("check-submission-no-files").to_owned(),
            Self::Empty { file } => tr!("check-submission-empty-file", file = file),
            Self::Binary { file, because } => tr!("check-submission-binary-file", file = file, because = because),
            Self::RichText { file } => tr!("check-submission-rich-text", file = file),
            Self::TooLarge { file, bytes } => {
                tr!("check-submission-too-large", file = file, bytes = bytes, most = super::text::LARGEST)
            }
            Self::NoShader { files } => tr!("check-submission-no-shader", files = list(files)),
            Self::MissingStage { missing, found } => tr!(
                "check-submission-missing-stage",
                missing = missing.to_string(),
                found = list(found),
                stage = missing.other().to_string()
            ),
            Self::SameStageTwice { stage, found } => tr!(
                "check-submission-same-stage-twice",
                found = list(found),
                stage = stage.to_string(),
                missing = stage.other().to_string()
            ),
            Self::MissingInclude { file, line, included } => {
                tr!("check-submission-missing-include", file = file, line = line, included = included)
            }
            Self::NotFound { requested, candidates } => {
                tr!("check-submission-no-such-pair", requested = requested, candidates = list(candidates))
            }
        };
        f.write_str(&text)
    }
}

impl std::error::Error for IntakeError {}
