//! A case: the files of a submission, and the verdicts that are acceptable.

use std::ffi::OsString;

/// One submission.
pub struct Case {
    pub name: String,
    pub exercise: &'static str,
    pub files: Vec<File>,
    /// The paths on the command line, relative to the folder; the folder itself if `None`.
    pub paths: Option<Vec<OsString>>,
    /// Whether it contains the right answer. No other case may be called correct.
    pub may_be_right: bool,
    /// Whether it is a folder of folders, for which a table is printed instead of a verdict.
    pub is_batch: bool,
}

/// A file of a submission.
pub struct File {
    pub name: OsString,
    pub fill: Fill,
}

pub enum Fill {
    Bytes(Vec<u8>),
    /// A beginning, a repeated piece, the number of repetitions, an end.
    Repeat(Vec<u8>, Vec<u8>, usize, Vec<u8>),
    /// A sparse file of this many bytes.
    Sparse(u64),
    Link(OsString),
    Pipe,
}

impl Case {
    pub fn new(family: &str, name: impl std::fmt::Display, exercise: &'static str) -> Case {
        Case {
            name: format!("{family}: {name}"),
            exercise,
            files: Vec::new(),
            paths: None,
            may_be_right: false,
            is_batch: false,
        }
    }

    /// Adds a vertex and a fragment shader.
    pub fn pair(self, vertex: impl Into<Vec<u8>>, fragment: impl Into<Vec<u8>>) -> Case {
        self.file("a.vert", Fill::Bytes(vertex.into())).file("a.frag", Fill::Bytes(fragment.into()))
    }

    pub fn file(mut self, name: impl Into<OsString>, fill: Fill) -> Case {
        self.files.push(File { name: name.into(), fill });
        self
    }

    pub fn named(mut self, paths: &[&str]) -> Case {
        self.paths = Some(paths.iter().map(OsString::from).collect());
        self
    }

    pub fn of_many(mut self) -> Case {
        self.is_batch = true;
        self
    }

    pub fn may_be_right(mut self) -> Case {
        self.may_be_right = true;
        self
    }
}

/// An answer to an exercise. Cases start from one with a mistake, so that it is never correct, and may break it further.
pub struct Answer {
    pub exercise: &'static str,
    pub vertex: String,
    pub fragment: String,
}

impl Answer {
    /// The reference solution of an exercise with one mistake: the normal is transformed by the wrong matrix.
    pub fn wrong(exercise: &'static str) -> Answer {
        let Answer { vertex, fragment, .. } = Answer::right(exercise);
        let wrong = vertex.replace("mat3(itM)", "mat3(M)");
        assert_ne!(vertex, wrong);
        Answer { exercise, vertex: wrong, fragment }
    }

    /// The reference solution of an exercise.
    pub fn right(exercise: &'static str) -> Answer {
        let found = gonio_exercises::exercise::find(exercise).unwrap();
        let text = |end: &str| {
            let (_, text) = found.reference_files().unwrap().find(|(name, _)| name.ends_with(end)).unwrap();
            text.to_owned()
        };
        Answer { exercise, vertex: text(".vert"), fragment: text(".frag") }
    }

    /// The fragment shader with a statement at the end of `main`, and declarations before `main`.
    pub fn fragment_with(&self, declarations: &str, statement: &str) -> String {
        with(&self.fragment, declarations, statement)
    }

    /// The same for the vertex shader.
    pub fn vertex_with(&self, declarations: &str, statement: &str) -> String {
        with(&self.vertex, declarations, statement)
    }
}

fn with(text: &str, declarations: &str, statement: &str) -> String {
    let text = text.replacen("void main() {", &format!("{declarations}\nvoid main() {{"), 1);
    let end = text.rfind('}').unwrap();
    format!("{}{statement}\n{}", &text[..end], &text[end..])
}
