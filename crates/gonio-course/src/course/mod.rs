//! A course: `course.toml` and a folder for each exercise.
//!
//! ```toml
//! name = "Computer graphics 1"
//! languages = ["en", "fr"]   # the first is that of texts without another; ["en"] if it is left out
//! feedback = "name"          # of every exercise that states no other; "line" if it is left out
//! show_reference = false     # the same; true if it is left out
//! exercises = ["rim-light"]  # folders, in order; all folders with an exercise.toml if it is left out
//! builtin = ["ex04"]         # built-in exercises that belong to the course
//!
//! [points]                   # of every exercise that states no other
//! total = 20
//! ```

mod exercise_file;
pub(crate) mod mistake_file;
mod points_table;
mod scene_table;
mod text_tables;

pub use mistake_file::{MistakeDefinition, ReferenceChange};

use gonio_check::feedback::Feedback;
use gonio_exercises::exercise::{self, Exercise};
use gonio_exercises::points::PointScheme;
use gonio_language::Language;
use gonio_mesh::ReadError;
use gonio_scene::toml_table::{Fault, TableReader, TomlItem, nearest_word, parse_toml};
use points_table::read_points;
use std::collections::BTreeSet;

/// The name of the file that makes a folder a course.
pub const COURSE_FILE: &str = "course.toml";
/// The name of the file that makes a folder an exercise.
pub const EXERCISE_FILE: &str = "exercise.toml";
/// The name of the pictures that stand for a reference where its source must not be.
pub const PICTURES_FILE: &str = "reference.pictures";
/// The names of a reference's files.
pub const REFERENCE_FILES: [&str; 2] = ["reference.vert", "reference.frag"];
/// The names of the files that students start from.
pub const START_FILES: [&str; 2] = ["start.vert", "start.frag"];

const FEEDBACK_WORDS: &[&str] = &["verdict", "name", "line", "fix"];

/// A file of a course in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CourseFile {
    /// Its path in the course's folder, with `/`.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl CourseFile {
    /// A file.
    #[must_use]
    pub fn new(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        CourseFile { path: path.into(), bytes: bytes.into() }
    }
}

/// What a course states for all its exercises.
#[derive(Clone, Debug, PartialEq)]
pub struct CoursePolicy {
    /// Languages of the texts; at least one.
    pub languages: Vec<Language>,
    /// How much of a verdict is shown.
    pub feedback: Feedback,
    /// Whether references may be shown.
    pub show_reference: bool,
    /// Points.
    pub points: Option<PointScheme>,
}

/// How an exercise of a course is judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JudgeKind {
    /// By the model solution of a built-in exercise, whose mistakes have names and lines.
    Like(String),
    /// By the pictures of its own reference.
    Reference,
}

/// An exercise of a course.
#[derive(Clone, Debug, PartialEq)]
pub struct CourseExercise {
    /// The exercise as the checker and the window take it.
    pub exercise: Exercise,
    /// Its folder in the course; `None` for a built-in one.
    pub folder: Option<String>,
    /// How it is judged.
    pub judge: JudgeKind,
    /// The vertex and the fragment shader of the reference, if they are in the folder.
    pub reference: Option<[String; 2]>,
    /// The mistakes that the teacher expects.
    pub mistakes: Vec<MistakeDefinition>,
    /// Files of the folder that are neither used nor handed out.
    pub unused: Vec<String>,
}

/// A course.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Its name.
    pub name: String,
    /// What it states for all exercises.
    pub policy: CoursePolicy,
    /// The exercises, in order.
    pub exercises: Vec<CourseExercise>,
}

impl Course {
    /// Reads a course from all files of its folder.
    ///
    /// # Errors
    /// The first thing that is wrong, in one sentence, with file, line and column.
    pub fn read(files: &[CourseFile]) -> Result<Course, ReadError> {
        let text = text_of(files, COURSE_FILE)?
            .ok_or_else(|| ReadError::new(format!("there is no {COURSE_FILE} in this folder")))?;
        let (name, policy, listed, built_in) =
            read_course_file(&text).map_err(|fault| fault.in_text(&text).in_file(COURSE_FILE))?;
        let folders = match listed {
            Some(listed) => listed,
            None => folders_with_exercises(files),
        };
        let mut exercises = Vec::new();
        for folder in &folders {
            exercises.push(exercise_file::read(files, folder, &policy)?);
        }
        for built_in in built_in {
            exercises.push(with_policy(built_in, &policy));
        }
        if exercises.is_empty() {
            let message =
                format!("the course has no exercise: add a folder with an {EXERCISE_FILE}, or builtin = [\"ex04\"]");
            return Err(ReadError::new(message).in_file(COURSE_FILE));
        }
        let mut seen = BTreeSet::new();
        if let Some(twice) = exercises.iter().find(|one| !seen.insert(one.exercise.id.clone())) {
            return Err(
                ReadError::new(format!("two exercises have the id `{}`", twice.exercise.id)).in_file(COURSE_FILE)
            );
        }
        Ok(Course { name, policy, exercises })
    }

    /// Finds an exercise by its id or folder.
    #[must_use]
    pub fn find(&self, word: &str) -> Option<&CourseExercise> {
        let is_it = |one: &&CourseExercise| one.exercise.id == word || one.folder.as_deref() == Some(word);
        self.exercises.iter().find(is_it).or_else(|| {
            let built_in = exercise::built_in().iter().find(|known| known.folder == word || is_number(known, word))?;
            self.exercises.iter().find(|one| one.exercise.id == built_in.id)
        })
    }

    /// The exercises as the checker and the window take them.
    #[must_use]
    pub fn installed(&self) -> Vec<Exercise> {
        self.exercises.iter().map(|one| one.exercise.clone()).collect()
    }
}

/// Whether a word is the number of a built-in exercise: `4` and `ex4` for `ex04`.
fn is_number(exercise: &Exercise, word: &str) -> bool {
    let number = |word: &str| word.trim_start_matches("ex").trim_start_matches('0').to_owned();
    exercise.id.starts_with("ex") && !number(word).is_empty() && number(&exercise.id) == number(word)
}

/// A built-in exercise under the policy of a course.
#[must_use]
pub fn with_policy(built_in: &Exercise, policy: &CoursePolicy) -> CourseExercise {
    let mut exercise = built_in.clone();
    exercise.feedback = policy.feedback;
    exercise.shows_reference = policy.show_reference;
    exercise.points = policy.points.clone();
    let reference = REFERENCE_FILES.map(|name| built_in.file(name).map(str::to_owned));
    let [vertex, fragment] = reference;
    CourseExercise {
        judge: JudgeKind::Like(built_in.id.clone()),
        folder: None,
        reference: vertex.zip(fragment).map(|(vertex, fragment)| [vertex, fragment]),
        mistakes: Vec::new(),
        unused: Vec::new(),
        exercise,
    }
}

type CourseHead = (String, CoursePolicy, Option<Vec<String>>, Vec<&'static Exercise>);

fn read_course_file(text: &str) -> Result<CourseHead, Fault> {
    let root: TomlItem = parse_toml(text)?;
    let mut t = TableReader::new("a course", &root)?;
    let name = t.text("name")?.ok_or_else(|| Fault::at(&(0..0), "the course has no name: add name = \"...\""))?;
    let languages = match t.texts("languages")? {
        None => vec![Language::English],
        Some(codes) if codes.is_empty() => return Err(Fault::at(&t.place("languages"), "`languages` is empty")),
        Some(codes) => codes.iter().map(|code| language(code, &t)).collect::<Result<Vec<_>, _>>()?,
    };
    let feedback = read_feedback(&mut t)?.unwrap_or_default();
    let show_reference = t.truth("show_reference")?.unwrap_or(true);
    let listed = t.texts("exercises")?;
    if let Some(bad) = listed.iter().flatten().find(|folder| !is_folder_name(folder)) {
        let message = format!("`exercises`: `{bad}` is not the name of a folder in the course");
        return Err(Fault::at(&t.place("exercises"), message));
    }
    let mut built_in = Vec::new();
    for id in t.texts("builtin")?.unwrap_or_default() {
        let known = || exercise::built_in().iter().map(|known| known.id.as_str());
        let Some(found) = exercise::built_in().iter().find(|known| known.id == id) else {
            let meant = nearest_word(&id, known()).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
            let message = format!("`builtin`: there is no built-in exercise `{id}`{meant}");
            return Err(Fault::at(&t.place("builtin"), message));
        };
        built_in.push(found);
    }
    let points = read_points(&mut t, None)?;
    t.finish()?;
    Ok((name, CoursePolicy { languages, feedback, show_reference, points }, listed, built_in))
}

fn language(code: &str, t: &TableReader<'_>) -> Result<Language, Fault> {
    let found = Language::ALL.into_iter().find(|language| language.code() == code);
    found.ok_or_else(|| {
        let known: Vec<&str> = Language::ALL.iter().map(|language| language.code()).collect();
        let message = format!("`languages`: unknown language `{code}`, expected {}", known.join(" or "));
        Fault::at(&t.place("languages"), message)
    })
}

/// `feedback = "name"`
fn read_feedback(t: &mut TableReader<'_>) -> Result<Option<Feedback>, Fault> {
    Ok(t.choice("feedback", FEEDBACK_WORDS)?.and_then(|at| Feedback::ALL.get(at).copied()))
}

fn is_folder_name(name: &str) -> bool {
    !name.is_empty() && !matches!(name, "." | "..") && !name.contains(['/', '\\'])
}

fn folders_with_exercises(files: &[CourseFile]) -> Vec<String> {
    let folder = |file: &CourseFile| {
        let folder = file.path.strip_suffix(EXERCISE_FILE)?.strip_suffix('/')?;
        is_folder_name(folder).then(|| folder.to_owned())
    };
    let mut folders: Vec<String> = files.iter().filter_map(folder).collect();
    folders.sort();
    folders
}

/// The text of a file; `None` if there is none.
fn text_of(files: &[CourseFile], path: &str) -> Result<Option<String>, ReadError> {
    let Some(file) = files.iter().find(|file| file.path == path) else { return Ok(None) };
    match std::str::from_utf8(&file.bytes) {
        Ok(text) => Ok(Some(text.strip_prefix('\u{feff}').unwrap_or(text).replace("\r\n", "\n"))),
        Err(error) => {
            let message = format!("it is not UTF-8 text from byte {} on: save it as UTF-8", error.valid_up_to());
            Err(ReadError::new(message).in_file(path))
        }
    }
}

#[cfg(test)]
mod tests;
