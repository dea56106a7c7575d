//! Exercises of a teacher's course, which are read while the program runs.

use super::{Exercise, ExerciseKind, Texts};
use crate::points::PointScheme;
use gonio_check::comparison::Task;
use gonio_check::feedback::Feedback;
use gonio_check::picture_judge::PictureJudge;
use gonio_language::Language;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// How the shaders of an exercise are judged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ShaderJudge {
    /// As a built-in exercise, by its own model solution.
    #[default]
    Own,
    /// By the model solution of a built-in exercise.
    Like(&'static CourseTask),
    /// By pictures, those of the exercise's own reference.
    Pictures {
        /// The id of the built-in exercise in whose scenes it is shown.
        like: &'static str,
        /// The pictures.
        judge: &'static PictureJudge,
    },
}

/// The task of a built-in exercise, set by an exercise with another id.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseTask {
    /// The task.
    pub task: Task,
    /// The id of the built-in exercise.
    pub like: &'static str,
}

impl ShaderJudge {
    /// The judge of the exercise `id`, by the model solution of a built-in exercise; `None` if that has none.
    #[must_use]
    pub fn like(id: &str, built_in: &str) -> Option<Self> {
        let task = Task::find(built_in)?;
        let own = Task { exercise: leaked(id), ..*task };
        Some(ShaderJudge::Like(Box::leak(Box::new(CourseTask { task: own, like: task.exercise }))))
    }

    /// The judge by pictures.
    #[must_use]
    pub fn pictures(like: &'static str, judge: PictureJudge) -> Self {
        ShaderJudge::Pictures { like, judge: Box::leak(Box::new(judge)) }
    }
}

/// Everything that an exercise of a course consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct ExerciseDefinition {
    /// See [`Exercise::id`].
    pub id: String,
    /// See [`Exercise::folder`].
    pub folder: String,
    /// See [`Exercise::lecture_section`].
    pub lecture_section: String,
    /// See [`Exercise::builds_on`].
    pub builds_on: Vec<String>,
    /// See [`Exercise::given`].
    pub given: Vec<String>,
    /// See [`Exercise::feedback`].
    pub feedback: Feedback,
    /// See [`Exercise::shows_reference`].
    pub shows_reference: bool,
    /// See [`Exercise::points`].
    pub points: Option<PointScheme>,
    /// Texts by language, at least one.
    pub texts: Vec<(Language, Texts)>,
    /// Text files: those to hand out, the reference, and the texts of other languages.
    pub files: Vec<(String, String)>,
    /// Pictures to hand out.
    pub pictures: Vec<(String, Vec<u8>)>,
    /// How answers are judged.
    pub judge: ShaderJudge,
}

impl Exercise {
    /// An exercise of a course. Its texts live as long as the process, like those of the built-in ones: a process reads one
    /// course.
    #[must_use]
    pub fn of_course(definition: ExerciseDefinition) -> Exercise {
        let files: Vec<(&'static str, &'static str)> =
            definition.files.into_iter().map(|(name, text)| (leaked(&name), leaked(&text))).collect();
        let pictures: Vec<(&'static str, &'static [u8])> = (definition.pictures.into_iter())
            .map(|(name, bytes)| (leaked(&name), &*Box::leak(bytes.into_boxed_slice())))
            .collect();
        let texts =
            if definition.texts.is_empty() { vec![(Language::English, Texts::default())] } else { definition.texts };
        Exercise {
            id: definition.id,
            folder: leaked(&definition.folder),
            kind: ExerciseKind::Shaders,
            lecture_section: definition.lecture_section,
            builds_on: definition.builds_on,
            given: definition.given,
            feedback: definition.feedback,
            shows_reference: definition.shows_reference,
            points: definition.points,
            texts,
            files: Vec::leak(files),
            pictures: Vec::leak(pictures),
            judge: definition.judge,
        }
    }
}

fn leaked(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

/// The course of this process.
struct Installed {
    folder: PathBuf,
    exercises: Vec<Exercise>,
}

static INSTALLED: OnceLock<Installed> = OnceLock::new();

/// Makes the exercises of a course those of this process, before any is looked up. `folder` is the course's, for processes that
/// this one starts. Returns false if there is a course already, which stays.
pub fn install(folder: PathBuf, exercises: Vec<Exercise>) -> bool {
    INSTALLED.set(Installed { folder, exercises }).is_ok()
}

/// The folder of the course of this process.
#[must_use]
pub fn course_folder() -> Option<&'static Path> {
    INSTALLED.get().map(|course| course.folder.as_path())
}

/// The exercises of the course of this process.
pub(super) fn exercises() -> Option<&'static [Exercise]> {
    INSTALLED.get().map(|course| course.exercises.as_slice())
}
