//! Packages: what is uploaded to a grader, and what students get.
//!
//! No package contains a reference. An exercise that is judged by a built-in one needs none, and for one that is judged by its own
//! reference, the reference and its mistakes are drawn beforehand ([`StoredPictures`]): the grader compares pictures.

mod classroom;
mod coderunner;
mod docker;
mod gradescope;
mod moodle;
mod sealed;
mod xml;

pub use sealed::sealed;

use crate::course::{Course, CourseExercise, CourseFile};
use gonio_check::picture_judge::StoredPictures;
use gonio_language::Language;

/// A platform that grades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GradingPlatform {
    /// Gradescope's autograder.
    Gradescope,
    /// CodeRunner, a question type of Moodle with a Jobe server.
    CodeRunner,
    /// GitHub Classroom.
    GithubClassroom,
    /// Moodle without CodeRunner.
    Moodle,
    /// A container of one's own.
    Docker,
}

impl GradingPlatform {
    /// All of them.
    pub const ALL: [GradingPlatform; 5] = [
        GradingPlatform::Gradescope,
        GradingPlatform::CodeRunner,
        GradingPlatform::GithubClassroom,
        GradingPlatform::Moodle,
        GradingPlatform::Docker,
    ];

    /// The word for an option.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            GradingPlatform::Gradescope => "gradescope",
            GradingPlatform::CodeRunner => "coderunner",
            GradingPlatform::GithubClassroom => "github-classroom",
            GradingPlatform::Moodle => "moodle",
            GradingPlatform::Docker => "docker",
        }
    }

    /// Whether the package contains gonio's own program, if one is given.
    #[must_use]
    pub fn carries_program(self) -> bool {
        matches!(self, GradingPlatform::Gradescope | GradingPlatform::Docker)
    }
}

/// A file of a package.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PackagedFile {
    /// Its path in the package, with `/`.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Whether it is a program.
    pub is_executable: bool,
}

impl PackagedFile {
    fn text(path: impl Into<String>, text: impl Into<String>) -> Self {
        PackagedFile { path: path.into(), bytes: text.into().into_bytes(), is_executable: false }
    }

    fn script(path: impl Into<String>, text: impl Into<String>) -> Self {
        PackagedFile { is_executable: true, ..PackagedFile::text(path, text) }
    }
}

/// A package.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Package {
    /// What is uploaded; for Gradescope and Docker, students do not see it.
    pub upload: Vec<PackagedFile>,
    /// What students get, apart from the upload.
    pub students: Vec<PackagedFile>,
    /// Steps for the teacher, in Markdown.
    pub readme: String,
}

/// What a package is made of.
pub struct PackageRequest<'a> {
    /// The course.
    pub course: &'a Course,
    /// Its files.
    pub files: &'a [CourseFile],
    /// The exercise.
    pub of: &'a CourseExercise,
    /// The pictures of the reference, if the exercise is judged by it.
    pub pictures: Option<&'a StoredPictures>,
    /// gonio's own program, for the packages that carry it.
    pub program: Option<Vec<u8>>,
    /// The address of an archive with gonio's program, for a machine that downloads it.
    pub program_url: String,
    /// gonio's version.
    pub version: &'a str,
    /// Packs files into a zip file.
    pub zip: fn(&[PackagedFile]) -> Vec<u8>,
    /// The language of the verdicts and of the texts for students.
    pub language: Language,
}

impl PackageRequest<'_> {
    fn id(&self) -> &str {
        &self.of.exercise.id
    }

    /// Points of a right answer.
    fn points(&self) -> f64 {
        self.of.exercise.points.as_ref().map_or(100.0, |scheme| scheme.total)
    }

    /// The sealed course below a folder.
    fn course_in(&self, folder: &str) -> Vec<PackagedFile> {
        let file = |file: CourseFile| PackagedFile {
            path: format!("{folder}/{}", file.path),
            bytes: file.bytes,
            is_executable: false,
        };
        sealed(self.course, self.files, self.of, self.pictures).into_iter().map(file).collect()
    }

    /// What students start from, in a folder.
    fn start_in(&self, folder: &str) -> Vec<PackagedFile> {
        let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        let exercise = &self.of.exercise;
        let text = exercise.text_in(self.language);
        let texts = exercise.start_files().map(|(name, own)| {
            PackagedFile::text(format!("{prefix}{name}"), if name == "text.md" { text } else { own })
        });
        let pictures = exercise.pictures().map(|(name, bytes)| PackagedFile {
            path: format!("{prefix}{name}"),
            bytes: bytes.to_vec(),
            is_executable: false,
        });
        texts.chain(pictures).collect()
    }

    /// The options that every grader gives to `gonio lab check`.
    fn options(&self) -> String {
        format!("--submissions one --language {}", self.language.code())
    }
}

/// Makes a package.
#[must_use]
pub fn package(platform: GradingPlatform, request: &PackageRequest<'_>) -> Package {
    match platform {
        GradingPlatform::Gradescope => gradescope::package(request),
        GradingPlatform::CodeRunner => coderunner::package(request),
        GradingPlatform::GithubClassroom => classroom::package(request),
        GradingPlatform::Moodle => moodle::package(request),
        GradingPlatform::Docker => docker::package(request),
    }
}

/// A word in single quotes for a POSIX shell.
fn shell_quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}
