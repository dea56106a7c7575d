//! The `names.toml` beside a user's shaders.

use crate::roles::NamesFile;
use crate::submission::SourceFile;
use crate::verdict::CompilerMessage;
use gonio_language::tr;
use std::path::{Path, PathBuf};

/// The paths where a `names.toml` for these shaders may be: the folder of each, once.
pub fn names_beside<'a>(shaders: impl IntoIterator<Item = &'a str>) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for shader in shaders {
        let path = Path::new(shader).with_file_name("names.toml");
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    paths
}

/// The entries of the files beside the shaders. Of two with the same name, the later file's counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct OwnNames {
    /// The entries.
    pub(super) file: NamesFile,
    /// The file of each name.
    files: Vec<(String, String)>,
}

impl OwnNames {
    /// Reads the files. An error is one sentence with file and line.
    pub(super) fn read(files: &[SourceFile]) -> Result<Self, String> {
        let mut all = OwnNames::default();
        for file in files {
            let name = &file.name;
            let text = std::str::from_utf8(&file.bytes).map_err(|error| {
                let line = file.bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count() + 1;
                tr!("check-inputs-the-file-is-not-text-in", name = name, line = line)
            })?;
            let text = text.strip_prefix('\u{feff}').unwrap_or(text);
            let read = NamesFile::parse(text)
                .map_err(|error| format!("{name}:{}: {}", error.line, error.message.trim_end().replace('\n', " ")))?;
            all.files.retain(|(known, _)| !read.names.contains_key(known));
            all.files.extend(read.names.keys().map(|known| (known.clone(), name.clone())));
            all.file.names.extend(read.names);
            all.file.lines.extend(read.lines);
        }
        Ok(all)
    }

    /// The file and line of the entry for a name; `lights[0]` and `lights` are the same.
    pub(super) fn place(&self, name: &str) -> Option<(&str, u32)> {
        let known = [Some(name), name.strip_suffix("[0]")];
        let (known, file) = self.files.iter().find(|(entry, _)| known.contains(&Some(entry.as_str())))?;
        Some((file, self.file.lines.get(known).copied().unwrap_or(1)))
    }

    /// An error at the entry for a name.
    pub(super) fn error(&self, name: &str, text: String) -> CompilerMessage {
        let (file, line) = self.place(name).unwrap_or(("names.toml", 1));
        CompilerMessage { file: file.to_owned(), line: Some(line), column: None, text, quoted: None, explanation: None }
    }

    /// The entries with those of another file, which has other names.
    pub(super) fn with(&self, other: NamesFile) -> NamesFile {
        let mut both = self.file.clone();
        both.names.extend(other.names);
        both
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::roles::{Meaning, Role};

    #[test]
    fn errors_name_file_and_line_and_the_later_file_counts() {
        let file = |name: &str, text: &str| SourceFile::new(name, text.as_bytes().to_vec());
        let [a, b] =
            [file("a/names.toml", "[names]\nk = 1\nm = 2\n"), file("b/names.toml", "\n[names]\nk = \"time\"\n")];
        let both = OwnNames::read(&[a.clone(), b]).unwrap();
        assert_eq!(both.file.get("k"), Some(&Meaning::Role(Role::Time)));
        assert_eq!((both.place("k"), both.place("m[0]")), (Some(("b/names.toml", 3)), Some(("a/names.toml", 3))));
        for (text, expected) in [
            ("[names]\nk = \"tmie\"\n", "c/names.toml:2: unknown role `tmie`: did you mean `time`?"),
            ("[names]\n\nk = \"\u{fc}\n", "c/names.toml:3: "),
        ] {
            let error = OwnNames::read(&[a.clone(), file("c/names.toml", text)]).unwrap_err();
            assert!(error.starts_with(expected) && !error.contains('\n'), "{error}");
        }
        let binary = SourceFile::new("names.toml", b"[names]\nk = \"\xff\"\n".to_vec());
        assert_eq!(OwnNames::read(&[binary]).unwrap_err(), "names.toml:2: the file is not text in UTF-8");
    }

    #[test]
    fn the_folder_of_each_shader_is_looked_at_once() {
        let beside = |shaders: &[&str]| names_beside(shaders.iter().copied());
        assert_eq!(beside(&["a.vert", "a.frag"]), [Path::new("names.toml")]);
        assert_eq!(beside(&["x/a.vert", "y/a.frag"]), [Path::new("x/names.toml"), Path::new("y/names.toml")]);
    }
}
