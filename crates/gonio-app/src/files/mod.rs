//! Files from the user: dropped, chosen, in a zip file or in a link.
//!
//! | file | contents |
//! |---|---|
//! | `memory` | files in memory, with folders |
//! | `sources` | one source before another; a record of the files that were read |
//! | `zip` | reading and writing zip files |
//! | `gathered` | finds the model among several files |
//! | `link` | a scene in the address of a page |

mod gathered;
pub mod link;
mod memory;
mod sources;
pub mod zip;

pub use gathered::{GatheredInputs, gather};
pub use memory::MemoryFiles;
pub use sources::{Adopted, Layered, ReadRecorder};
pub use zip::{PackedFile, pack, pack_all};

use gonio_check::submission::SourceFile;
use gonio_check::user_shaders::names_beside;
use gonio_language::tr;
use gonio_scene::files::FileSource;
use std::io::ErrorKind;
use std::path::PathBuf;

/// The largest shader that is read, in bytes.
pub const MOST_SHADER_BYTES: u64 = 10 << 20;

/// A file of an exercise, with its path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExerciseFile {
    /// The name in the exercise.
    pub name: String,
    /// The path on disk; `None` for a file in memory.
    pub path: Option<PathBuf>,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// The files of the user's shaders, and the first values of their uniforms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShaderFiles {
    /// The path of the vertex shader.
    pub vertex: Option<String>,
    /// The path of the fragment shader.
    pub fragment: Option<String>,
    /// The path of a `names.toml` that is not [beside them](names_beside).
    pub names: Option<String>,
    /// Values of uniforms.
    pub uniforms: Vec<(String, Vec<f32>)>,
    /// Samplers, and the paths of the pictures that they read.
    pub textures: Vec<(String, String)>,
}

impl ShaderFiles {
    /// The paths of all files that the user named.
    pub fn named(&self) -> impl Iterator<Item = &String> {
        self.vertex.iter().chain(&self.fragment).chain(self.textures.iter().map(|(_, path)| path))
    }

    /// The paths of all files, those of `names.toml` included, which need not exist.
    pub fn paths(&self) -> impl Iterator<Item = PathBuf> {
        self.named().map(PathBuf::from).chain(self.names())
    }

    /// Whether it has a shader.
    pub fn any(&self) -> bool {
        self.vertex.is_some() || self.fragment.is_some()
    }

    /// These files with others in the place of those for the same purpose.
    pub fn replaced_by(self, newer: ShaderFiles) -> Self {
        ShaderFiles {
            vertex: newer.vertex.or(self.vertex),
            fragment: newer.fragment.or(self.fragment),
            names: newer.names.or(self.names),
            ..self
        }
    }

    fn names(&self) -> Vec<PathBuf> {
        match &self.names {
            Some(names) => vec![PathBuf::from(names)],
            None => names_beside(self.vertex.iter().chain(&self.fragment).map(String::as_str)),
        }
    }

    /// Reads `names.toml`, where there is one.
    ///
    /// # Errors
    /// A file cannot be read; one sentence.
    pub fn read_names(&self, files: &dyn FileSource) -> Result<Vec<SourceFile>, String> {
        let read = |path: PathBuf| match files.read_within(&path, MOST_SHADER_BYTES) {
            Ok(bytes) => Ok(Some(SourceFile::new(path.display().to_string(), bytes.into_vec()))),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(tr!("window-cannot-read", path = path.display(), error = error)),
        };
        self.names().into_iter().filter_map(|path| read(path).transpose()).collect()
    }
}

/// The last part of a path with either separator.
pub fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The title of what was opened: the file's name without its folder.
pub fn short(inputs: &[String]) -> String {
    let name = |input: &String| {
        let input = input.strip_prefix(gonio_scene::files::BUILTIN).unwrap_or(input);
        base_name(input).to_owned()
    };
    match inputs {
        [] => String::new(),
        [one] => name(one),
        [first, rest @ ..] => tr!("window-and-more", first = name(first), count = rest.len()),
    }
}
