//! Files that are added to an exercise: the use of each, and the files that it replaces.

use crate::baking;
use crate::buffers;
use crate::cubemap;
use crate::exercise::{Exercise, ExerciseKind};
use crate::gl_program::GlProgram;
use gonio_check::submission::{self, Holds, SourceFile};
use gonio_language::tr;
use gonio_mesh::Format;

/// The use of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FileUse {
    /// Whether it contains a vertex shader.
    pub vertex: bool,
    /// Whether it contains a fragment shader.
    pub fragment: bool,
    /// Whether it is `names.toml`, which defines the roles of names.
    pub names: bool,
    /// Whether it is a vertex buffer.
    pub buffer: bool,
    /// Whether it is a GL program.
    pub gl_program: bool,
    /// Whether it is a picture of one or several faces.
    pub picture: bool,
    /// Whether it is a model with a baked texture.
    pub model: bool,
    /// Whether it belongs to such a model: its materials, a texture.
    pub model_part: bool,
}

/// Files sorted by their use.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SortedFiles {
    /// Indices of the files that the exercise can use, each with its use.
    pub taken: Vec<(usize, FileUse)>,
    /// The ignored files and the reason, in one sentence. Always present if no file was taken.
    pub aside: Option<String>,
}

/// Maximum number of files that a sentence lists.
const MOST_NAMED: usize = 3;

/// Whether a file could be an answer to the exercise, by its content: a shader, a vertex buffer, a GL program or a picture of
/// a face.
pub fn is_answer(exercise: &Exercise, file: &SourceFile) -> bool {
    let Ok(Some(found)) = use_of(exercise, file) else { return false };
    match exercise.kind {
        // Any text could be meant as a GL program: it counts if most of its lines can be read.
        ExerciseKind::GlProgram => found.gl_program && is_gl_program(file),
        ExerciseKind::Buffers => found.buffer && buffers::read_buffer(&file.name, &file.bytes).is_ok(),
        ExerciseKind::Baking => found.model,
        ExerciseKind::Shaders | ExerciseKind::Faces => found.vertex || found.fragment || found.picture,
    }
}

/// Whether these files are a whole answer: both stages of a program, or one file of another kind.
pub fn is_complete(exercise: &Exercise, files: &[SourceFile]) -> bool {
    let of_files = files.iter().filter(|file| is_answer(exercise, file));
    let all = of_files.filter_map(|file| use_of(exercise, file).ok()?).fold(FileUse::default(), FileUse::with);
    all.vertex && all.fragment || all.buffer || all.gl_program || all.picture || all.model
}

fn is_gl_program(file: &SourceFile) -> bool {
    let lines = file.bytes.split(|byte| *byte == b'\n').filter(|line| !line.trim_ascii().is_empty()).count();
    GlProgram::parse_bytes(&file.bytes, &file.name).map_or_else(|errors| 2 * errors.len() < lines, |_| true)
}

/// Sorts files by their use. Start files that cannot be an answer are ignored silently if there are other files.
pub fn sort_files(exercise: &Exercise, files: &[SourceFile]) -> SortedFiles {
    let mut sorted = SortedFiles::default();
    let mut aside: Vec<(&str, String)> = Vec::new();
    for (index, file) in files.iter().enumerate() {
        match use_of(exercise, file) {
            Ok(Some(of_file)) => sorted.taken.push((index, of_file)),
            Ok(None) => {}
            Err(reason) => aside.push((base(&file.name), reason)),
        }
    }
    sorted.aside = match aside.as_slice() {
        [] if sorted.taken.is_empty() => {
            Some(tr!("check-preview-none-of-these-files-is-an", id = exercise.id, kind = what_it_reads(exercise.kind)))
        }
        [] => None,
        [(_, reason)] => Some(reason.clone()),
        several => {
            let named: Vec<&str> = several.iter().take(MOST_NAMED).map(|(name, _)| *name).collect();
            let more = match several.len().saturating_sub(MOST_NAMED) {
                0 => String::new(),
                more => tr!("check-preview-and-more", more = more),
            };
            let reads = what_it_reads(exercise.kind);
            Some(tr!(
                "check-preview-ignored-reads",
                names = named.join(", "),
                more = more,
                id = exercise.id,
                reads = reads
            ))
        }
    };
    sorted
}

/// Whether new files replace an open one: they have the same use, or one has the same name.
pub fn is_replaced(exercise: &Exercise, open: &SourceFile, taken: &[(&SourceFile, FileUse)], all: &[&str]) -> bool {
    if taken.iter().any(|(file, _)| base(&file.name) == base(&open.name)) {
        return true;
    }
    let Ok(Some(old)) = use_of(exercise, open) else { return false };
    // A picture with the name of an open face is a corrected face; other pictures are another answer.
    let is_open = |file: &SourceFile| all.iter().any(|name| base(name) == base(&file.name));
    let other_pictures = taken.iter().any(|(file, new)| new.picture && !is_open(file));
    let new = taken.iter().fold(FileUse::default(), |all, (_, new)| all.with(*new));
    let (old_shader, new_shader) = (old.vertex || old.fragment, new.vertex || new.fragment);
    (old.vertex && new.vertex)
        || (old.fragment && new.fragment)
        || (old.names && new.names)
        || (old.buffer && new.buffer)
        || (old.model && new.model)
        || (old.model_part && new.model)
        || (old_shader && new.picture)
        || (old.picture && (new_shader || other_pictures))
}

impl FileUse {
    fn with(self, other: FileUse) -> FileUse {
        FileUse {
            vertex: self.vertex || other.vertex,
            fragment: self.fragment || other.fragment,
            names: self.names || other.names,
            buffer: self.buffer || other.buffer,
            gl_program: self.gl_program || other.gl_program,
            picture: self.picture || other.picture,
            model: self.model || other.model,
            model_part: self.model_part || other.model_part,
        }
    }
}

/// Returns the use of one file; `None` for start files that cannot be an answer.
///
/// # Errors
/// The reason why the exercise cannot use the file, in one sentence.
fn use_of(exercise: &Exercise, file: &SourceFile) -> Result<Option<FileUse>, String> {
    let name = base(&file.name);
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    if is_handed_out(exercise, file) {
        return Ok(None);
    }
    if exercise.kind == ExerciseKind::Baking && baking::is_part(name) {
        let model = baking::is_model(name);
        return Ok(Some(FileUse { model, model_part: !model, ..FileUse::default() }));
    }
    let is_model = |format: &Format| format.extension() == ending;
    if Format::ALL.iter().any(is_model) || (ending == "toml" && !name.eq_ignore_ascii_case("names.toml")) {
        let what = if ending == "toml" { tr!("check-preview-a-scene") } else { tr!("check-preview-a-model") };
        return Err(tr!("check-preview-is-leave-the-exercises-with-the", name = name, what = what));
    }
    let is_buffer = || buffers::ENDINGS.iter().any(|known| known.strip_prefix('.') == Some(ending.as_str()));
    let found = match exercise.kind {
        ExerciseKind::Buffers if is_buffer() => Some(FileUse { buffer: true, ..FileUse::default() }),
        // The program that wrote the buffer, in any language.
        ExerciseKind::Buffers if is_text(file) => Some(FileUse::default()),
        ExerciseKind::GlProgram if ending == "txt" && is_text(file) => {
            Some(FileUse { gl_program: true, ..FileUse::default() })
        }
        ExerciseKind::Faces if cubemap::is_picture(file) => Some(FileUse { picture: true, ..FileUse::default() }),
        ExerciseKind::Shaders | ExerciseKind::Faces => {
            match submission::holds(file).map_err(|error| error.to_string())? {
                Holds { vertex: false, fragment: false, names: false } => None,
                Holds { vertex, fragment, names } => Some(FileUse { vertex, fragment, names, ..FileUse::default() }),
            }
        }
        ExerciseKind::Buffers | ExerciseKind::GlProgram | ExerciseKind::Baking => None,
    };
    found.map(Some).ok_or_else(|| {
        let reads = what_it_reads(exercise.kind);
        match exercise.kind {
            ExerciseKind::Shaders | ExerciseKind::Faces if is_text(file) => {
                tr!("check-preview-there-is-no-shader-in-reads", name = name, id = exercise.id, reads = reads)
            }
            _ => tr!("check-preview-does-not-read-it-reads", id = exercise.id, name = name, reads = reads),
        }
    })
}

/// Returns a description of the files that an exercise reads.
fn what_it_reads(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Shaders => {
            tr!("check-preview-reads-shaders")
        }
        ExerciseKind::Faces => tr!("check-preview-reads-shaders-or-faces"),
        ExerciseKind::Buffers => tr!("check-preview-a-vertex-buffer-csv-tsv-json"),
        ExerciseKind::GlProgram => tr!("check-preview-gl-programs-txt"),
        ExerciseKind::Baking => tr!("check-preview-a-model-with-its-materials-and"),
    }
}

/// Whether a file came with the exercise and cannot be an answer.
fn is_handed_out(exercise: &Exercise, file: &SourceFile) -> bool {
    let name = base(&file.name);
    let is_paper = |name: &str| [".md", ".svg", ".obj"].iter().any(|end| name.ends_with(end));
    let has = |known: &str| is_paper(known) && base(known) == name;
    name == crate::GOAL
        || exercise.start_files().any(|(known, _)| has(known))
        || exercise.pictures().any(|(_, bytes)| file.bytes == bytes)
        || (exercise.kind == ExerciseKind::GlProgram && exercise.start_files().any(|(known, _)| known == name))
}

fn is_text(file: &SourceFile) -> bool {
    std::str::from_utf8(&file.bytes).is_ok_and(|text| !text.contains('\0'))
}

/// The name without its folders.
fn base(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise;

    const VERTEX: &str = "#version 330 core\nin vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";
    const FRAGMENT: &str = "#version 330 core\nout vec4 FragColor;\nvoid main() { FragColor = vec4(1.0); }\n";
    const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

    fn file(name: &str, bytes: impl AsRef<[u8]>) -> SourceFile {
        SourceFile::new(name, bytes.as_ref())
    }

    /// The use of a file as letters: v, f, n, b, h, p, m, t; `-` for other text, nothing for a file that was handed out.
    fn letters(exercise: &str, name: &str, bytes: impl AsRef<[u8]>) -> String {
        let exercise = exercise::find(exercise).unwrap();
        match use_of(exercise, &file(name, bytes)) {
            Ok(Some(FileUse::NOTHING)) => "-".into(),
            Ok(Some(u)) => [u.vertex, u.fragment, u.names, u.buffer, u.gl_program, u.picture, u.model, u.model_part]
                .iter()
                .zip("vfnbhpmt".chars())
                .filter_map(|(is, letter)| is.then_some(letter))
                .collect(),
            Ok(None) => String::new(),
            Err(reason) => reason,
        }
    }

    impl FileUse {
        const NOTHING: FileUse = FileUse {
            vertex: false,
            fragment: false,
            names: false,
            buffer: false,
            gl_program: false,
            picture: false,
            model: false,
            model_part: false,
        };
    }

    #[test]
    fn the_kind_of_a_file_decides_its_use() {
        let cpp = format!("const char* v = R\"({VERTEX})\";\nconst char* f = R\"({FRAGMENT})\";\n");
        for (exercise, name, bytes, expected) in [
            ("ex04", "my light.txt", VERTEX.as_bytes(), "v"),
            ("ex04", "a/b/light", FRAGMENT.as_bytes(), "f"),
            // It does not compile, but its name tells the stage.
            ("ex04", "light.frag", b"void", "f"),
            ("ex04", "main.cpp", cpp.as_bytes(), "vf"),
            ("ex04", "names.toml", b"[uniforms]\n", "n"),
            ("ex04", "mine/text.md", b"# Phong", ""),
            ("ex04", "goal.png", PNG, ""),
            ("s1", "posx.png", PNG, "p"),
            ("s1", "start.vert", VERTEX.as_bytes(), "v"),
            ("ex02", "cube.csv", b"0,0,0\n", "b"),
            ("ex02", "cube.bin", b"\0\0\0\0", "b"),
            ("ex02", "reader.lua", b"print(1)", "-"),
            ("ex02", "models/cube.obj", b"v 0 0 0", ""),
            ("ex13", "mine/baked.obj", b"v 0 0 0", "m"),
            ("ex13", "baked.glb", b"glTF", "m"),
            ("ex13", "baked.mtl", b"newmtl a", "t"),
            ("ex13", "baked.png", PNG, "t"),
            ("ex11", "mine.txt", b"glDrawArrays", "h"),
            ("ex11", "start.vert", VERTEX.as_bytes(), ""),
        ] {
            assert_eq!(letters(exercise, name, bytes), expected, "{exercise}: {name}");
        }
    }

    #[test]
    fn unusable_files_get_one_sentence() {
        for (exercise, name, bytes, expected) in [
            ("ex04", "notes.txt", &b"to do"[..], "there is no shader in notes.txt: ex04 reads a vertex and"),
            ("ex04", "photo.png", PNG, "ex04 does not read photo.png"),
            ("ex04", "cow.obj", b"v 0 0 0", "cow.obj is a model: leave the exercises"),
            ("ex04", "room.toml", b"[camera]", "room.toml is a scene: leave the exercises"),
            ("ex04", "light.vert", b"void main\0", "light.vert is not a text file (a zero byte at offset 9)"),
            ("ex04", "light.frag", b"", "light.frag is empty"),
            ("ex02", "cube.dat", b"\0\xff", "ex02 does not read cube.dat: it reads a vertex buffer (.csv"),
            ("ex11", "mine.c", b"glDrawArrays", "ex11 does not read mine.c: it reads GL programs (.txt)"),
            ("s1", "movie.mp4", b"\0\0", "s1 does not read movie.mp4"),
        ] {
            let found = letters(exercise, name, bytes);
            assert!(found.starts_with(expected), "{exercise}: {name}: {found}");
        }
        let ex04 = exercise::find("ex04").unwrap();
        let many: Vec<SourceFile> = (0..5).map(|n| file(&format!("{n}.txt"), "words")).collect();
        let aside = sort_files(ex04, &many).aside.unwrap();
        assert!(aside.starts_with("ignored: 0.txt, 1.txt, 2.txt and 2 more; ex04 reads"), "{aside}");
        let paper = sort_files(ex04, &[file("text.md", "# Phong")]);
        assert!(paper.taken.is_empty() && paper.aside.unwrap().starts_with("none of these files is an answer"));
        let both = sort_files(ex04, &[file("text.md", "# Phong"), file("a.vert", VERTEX)]);
        assert_eq!((both.taken.len(), both.aside), (1, None));
    }

    #[test]
    fn new_files_replace_open_ones_with_the_same_use() {
        let left = |id: &str, open: &[SourceFile], new: &[SourceFile]| -> Vec<String> {
            let exercise = exercise::find(id).unwrap();
            let taken: Vec<(&SourceFile, FileUse)> =
                sort_files(exercise, new).taken.iter().map(|(index, of)| (&new[*index], *of)).collect();
            let all: Vec<&str> = open.iter().map(|file| file.name.as_str()).collect();
            let stays = |open: &&SourceFile| !is_replaced(exercise, open, &taken, &all);
            open.iter().filter(stays).map(|file| file.name.clone()).collect()
        };
        let pair = [file("text.md", "#"), file("start.vert", VERTEX), file("start.frag", FRAGMENT)];
        assert_eq!(left("ex04", &pair, &[file("mine", FRAGMENT)]), ["text.md", "start.vert"]);
        assert_eq!(left("ex04", &pair, &[file("a", FRAGMENT), file("b", VERTEX)]), ["text.md"]);
        assert_eq!(left("ex04", &pair, &[file("names.toml", "")]).len(), 3, "an empty one is rejected");
        assert_eq!(left("ex04", &pair, &[file("names.toml", "[uniforms]")]).len(), 3);
        // Pictures and shaders are two ways to answer; a single face replaces that face.
        assert_eq!(left("s1", &pair, &[file("posx.png", PNG)]), ["text.md"]);
        let faces = ["posx.png", "negx.png"].map(|name| file(name, PNG));
        assert_eq!(left("s1", &faces, &[file("new/posx.png", PNG)]), ["negx.png"]);
        assert_eq!(left("s1", &faces, &[file("cross.png", PNG)]), [""; 0]);
        assert_eq!(left("s1", &faces, &[file("a.frag", FRAGMENT)]), [""; 0]);
        // A new model replaces the open one with its picture; a new picture alone replaces the one of its name.
        let baked = ["baked.obj", "baked.mtl", "baked.png"].map(|name| file(name, "x"));
        assert_eq!(left("ex13", &baked, &[file("other.glb", "x")]), [""; 0]);
        assert_eq!(left("ex13", &baked, &[file("new/baked.png", "y")]), ["baked.obj", "baked.mtl"]);
        // Only one buffer is checked at a time, but many GL programs can be open.
        let buffers = [file("start/obj_reader.py", "print()"), file("cube.csv", "1")];
        assert_eq!(left("ex02", &buffers, &[file("gem.json", "[]")]), ["start/obj_reader.py"]);
        let programs = [file("host/one.txt", "gl"), file("host/two.txt", "gl")];
        assert_eq!(left("ex11", &programs, &[file("two.txt", "gl"), file("three.txt", "gl")]), ["host/one.txt"]);
    }
}
