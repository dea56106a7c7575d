//! The exercises: texts, start files and references, all of them built into the program.

mod of_course;
mod translation;

pub use of_course::{CourseTask, ExerciseDefinition, ShaderJudge, course_folder, install};
pub use translation::Texts;

use crate::gl_program;
use crate::points::PointScheme;
use gonio_check::comparison::Task;
use gonio_check::feedback::Feedback;
use gonio_check::picture_judge::PictureJudge;
use gonio_language::Language;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use translation::Translation;

/// The kind of answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExerciseKind {
    /// A pair of shaders.
    Shaders,
    /// The vertex buffer that a program of any language writes.
    Buffers,
    /// A GL program's OpenGL calls.
    GlProgram,
    /// Six faces of a cubemap, or a shader that makes them.
    Faces,
    /// A model with a baked texture.
    Baking,
}

/// The inputs of an exercise.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct Inputs {
    /// Attributes by name.
    #[serde(default)]
    pub attributes: BTreeMap<String, InputVariable>,
    /// Uniforms by OpenGL's name.
    #[serde(default)]
    pub uniforms: BTreeMap<String, InputVariable>,
}

/// A given attribute or uniform.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct InputVariable {
    /// The GLSL type.
    #[serde(rename = "type")]
    pub glsl_type: String,
    /// Its meaning, with space and unit.
    pub meaning: String,
    /// Its value in the lab.
    pub value: String,
}

/// Details to look for in the picture.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct LookFor {
    /// The detail, in one sentence.
    pub text: String,
}

#[derive(Deserialize)]
struct Declaration {
    id: String,
    title: String,
    #[serde(default)]
    summary: String,
    kind: ExerciseKind,
    #[serde(default)]
    lecture_section: String,
    #[serde(default)]
    builds_on: Vec<String>,
    #[serde(default)]
    look_for: Vec<LookFor>,
    #[serde(default)]
    inputs: Inputs,
    #[serde(default)]
    given: Vec<String>,
    #[serde(default)]
    feedback: Feedback,
    #[serde(default = "shown")]
    show_reference: bool,
    fr: Option<Translation>,
}

fn shown() -> bool {
    true
}

/// An exercise.
#[derive(Clone, Debug, PartialEq)]
pub struct Exercise {
    /// The id, for example `ex04`.
    pub id: String,
    /// Its folder in `exercises/`, or in its course.
    pub folder: &'static str,
    /// The kind of answer.
    pub kind: ExerciseKind,
    /// The section of the lecture that teaches it.
    pub lecture_section: String,
    /// Ids of the exercises that should be done before.
    pub builds_on: Vec<String>,
    /// Built-in files that are handed out, by their paths below `assets`: those of a model, which is the first.
    pub given: Vec<String>,
    /// How much of a verdict is shown, unless the command line asks for another level.
    pub feedback: Feedback,
    /// Whether students may see the reference solution, its values and its pictures.
    pub shows_reference: bool,
    /// Points, if a teacher states some.
    pub points: Option<PointScheme>,
    /// Texts by language; those of the first one are shown in languages that have none.
    texts: Vec<(Language, Texts)>,
    files: &'static [(&'static str, &'static str)],
    pictures: &'static [(&'static str, &'static [u8])],
    judge: ShaderJudge,
}

/// Texts are in the current language, unless one is given, and in the exercise's first language where another has none.
impl Exercise {
    fn texts(&self, language: Language) -> &Texts {
        let own = self.texts.iter().find(|(known, _)| *known == language);
        // There is at least one.
        &own.unwrap_or(&self.texts[0]).1
    }

    /// Title, summary, details and inputs in a language.
    pub fn texts_in(&self, language: Language) -> &Texts {
        self.texts(language)
    }

    /// The id of the built-in exercise in whose scenes it is shown: its own, or that of the exercise of its kind.
    pub fn like(&self) -> &str {
        match self.judge {
            ShaderJudge::Own => &self.id,
            ShaderJudge::Like(task) => task.like,
            ShaderJudge::Pictures { like, .. } => like,
        }
    }

    /// The task of its model solution, if it is judged by one.
    pub fn task(&self) -> Option<&'static Task> {
        match self.judge {
            ShaderJudge::Own => Task::find(&self.id),
            ShaderJudge::Like(task) => Some(&task.task),
            ShaderJudge::Pictures { .. } => None,
        }
    }

    /// The pictures that it is judged by, if it has no model solution.
    pub fn picture_judge(&self) -> Option<&'static PictureJudge> {
        match self.judge {
            ShaderJudge::Pictures { judge, .. } => Some(judge),
            _ => None,
        }
    }

    /// The title.
    pub fn title(&self) -> &str {
        self.title_in(Language::current())
    }

    /// The title in a language.
    pub fn title_in(&self, language: Language) -> &str {
        &self.texts(language).title
    }

    /// The task in one sentence.
    pub fn summary(&self) -> &str {
        self.summary_in(Language::current())
    }

    /// The task in one sentence, in a language.
    pub fn summary_in(&self, language: Language) -> &str {
        &self.texts(language).summary
    }

    /// Details to look for in the picture.
    pub fn look_for(&self) -> &[LookFor] {
        &self.texts(Language::current()).look_for
    }

    /// The inputs.
    pub fn inputs(&self) -> &Inputs {
        &self.texts(Language::current()).inputs
    }

    /// Returns its text, in Markdown.
    pub fn text(&self) -> &'static str {
        self.text_in(Language::current())
    }

    /// Returns its text in a language, in Markdown.
    pub fn text_in(&self, language: Language) -> &'static str {
        let own = self.file(&format!("text.{}.md", language.code()));
        own.or_else(|| self.file("text.md")).unwrap_or_default()
    }

    /// Returns one of its files, by its name in the folder.
    pub fn file(&self, name: &str) -> Option<&'static str> {
        self.files.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
    }

    /// The start files: all files except the reference and `exercise.toml`. Names include folders; `text.md` is the text
    /// in the current language.
    pub fn start_files(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let is_answer = |name: &str| {
            name.split('/').any(|part| part.starts_with("reference"))
                || ["exercise.toml", "mistakes.toml"].contains(&name)
        };
        let is_text = |name: &str| Language::ALL.iter().any(|language| name == format!("text.{}.md", language.code()));
        let text = self.text();
        (self.files.iter().copied())
            .filter(move |(name, _)| !is_answer(name) && !is_text(name))
            .map(move |(name, file)| (name, if name == "text.md" { text } else { file }))
    }

    /// Returns the start pictures, by name.
    pub fn pictures(&self) -> impl Iterator<Item = (&'static str, &'static [u8])> {
        self.pictures.iter().copied()
    }

    /// The name under which a built-in file is handed out: its path below the model's folder.
    pub fn given_name(path: &str) -> &str {
        path.strip_prefix("models/").unwrap_or(path)
    }

    /// Built-in files that a check reads, by their paths below `assets`. A web page fetches them first.
    pub fn needed_files(&self) -> Vec<String> {
        match self.kind {
            ExerciseKind::GlProgram => {
                gl_program::IMAGES.iter().map(|name| format!("{}{name}", gl_program::IMAGE_FOLDER)).collect()
            }
            _ => self.given.clone(),
        }
    }

    /// The files of the reference solution.
    ///
    /// # Errors
    /// The exercise hides it; one sentence.
    pub fn reference_files(&self) -> Result<impl Iterator<Item = (&'static str, &'static str)>, String> {
        match self.shows_reference {
            true => Ok(self.answer_files()),
            false => Err(format!(
                "the reference solution of {} is not shown in this course, as its exercise.toml states",
                self.id
            )),
        }
    }

    /// The same files, also if students may not see them.
    pub(crate) fn answer_files(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.files.iter().copied().filter(|(name, _)| name.split('/').any(|part| part.starts_with("reference")))
    }
}

/// All exercises, in order: those of the course that is installed, or the built-in ones.
pub fn all() -> &'static [Exercise] {
    of_course::exercises().unwrap_or_else(|| built_in())
}

/// The built-in exercises, in order.
pub fn built_in() -> &'static [Exercise] {
    static ALL: LazyLock<Vec<Exercise>> =
        LazyLock::new(|| FOLDERS.iter().filter_map(|(folder, files)| read(folder, files).ok()).collect());
    &ALL
}

/// Finds an exercise by its id, number or folder: `ex04`, `4`, `04`, `EX4`, `s1`. Those of a course precede the built-in ones.
pub fn find(word: &str) -> Option<&'static Exercise> {
    of_course::exercises().and_then(|own| find_in(own, word)).or_else(|| find_in(built_in(), word))
}

fn find_in<'a>(exercises: &'a [Exercise], word: &str) -> Option<&'a Exercise> {
    let word = word.to_ascii_lowercase();
    let number = word.trim_start_matches("ex").trim_start_matches('0');
    exercises.iter().find(|exercise| {
        exercise.id == word
            || exercise.folder == word
            || (!number.is_empty() && exercise.id.trim_start_matches("ex").trim_start_matches('0') == number)
    })
}

fn read(folder: &'static str, files: &'static [(&'static str, &'static str)]) -> Result<Exercise, String> {
    let declared = files.iter().find(|(name, _)| *name == "exercise.toml").map_or("", |(_, text)| text);
    let declared: Declaration = toml::from_str(declared).map_err(|error| format!("{folder}/exercise.toml: {error}"))?;
    let english = Texts {
        title: declared.title,
        summary: declared.summary,
        look_for: declared.look_for,
        inputs: declared.inputs,
    };
    Ok(Exercise {
        id: declared.id,
        folder,
        kind: declared.kind,
        lecture_section: declared.lecture_section,
        builds_on: declared.builds_on,
        given: declared.given,
        feedback: declared.feedback,
        shows_reference: declared.show_reference,
        points: None,
        texts: std::iter::once((Language::English, english.clone()))
            .chain(declared.fr.map(|fr| (Language::French, fr.of(&english))))
            .collect(),
        files,
        pictures: PICTURES.iter().find(|(of, _)| *of == folder).map_or(&[], |(_, pictures)| pictures),
        judge: ShaderJudge::Own,
    })
}

type Folder = (&'static str, &'static [(&'static str, &'static str)]);

macro_rules! folder {
    ($folder:literal: $($name:literal)*) => {
        folder!($folder: $($name)*; not_on_the_web)
    };
    // References that only the command line shows are left out of the page.
    ($folder:literal: $($name:literal)*; not_on_the_web $($beside:literal)*) => {
        ($folder, &[
            $(($name, include_str!(concat!("../../../exercises/", $folder, "/", $name))),)*
            $(#[cfg(not(target_arch = "wasm32"))]
            ($beside, include_str!(concat!("../../../exercises/", $folder, "/", $beside))),)*
        ])
    };
}

/// Folders and their files, in order.
const FOLDERS: &[Folder] = &[
    folder!("ex01-camera": "camera.svg" "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex02-object-reader": "exercise.toml" "models/bracket.obj" "models/cube.obj" "models/fence.obj" "models/gem.obj" "models/house.obj" "models/objects.obj" "models/pyramid.obj" "models/tent.obj" "models/wedge.obj" "start/obj_reader.cpp" "start/obj_reader.py" "text.fr.md" "text.md"; not_on_the_web "reference/obj_reader.cpp" "reference/obj_reader.py"),
    folder!("ex03-gouraud-diffuse": "exercise.toml" "normal.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex04-phong-diffuse": "exercise.toml" "gouraud-and-phong.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex05-gouraud-specular": "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md" "vectors.svg"),
    folder!("ex06-phong-specular": "exercise.toml" "highlight.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex07-light-equation": "attenuation.svg" "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex08-skybox": "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex09-reflection": "exercise.toml" "reference.frag" "reference.vert" "reflection.svg" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex10-refraction": "exercise.toml" "reference.frag" "reference.vert" "refraction.svg" "start.frag" "start.vert" "text.fr.md" "text.md"),
    folder!("ex11-texture-unit": "exercise.toml" "host/attribute-not-enabled.txt" "host/mipmaps-missing.txt" "host/offset-wrong.txt" "host/reference.txt" "host/stride-wrong.txt" "host/texture-name-as-unit.txt" "host/unbound-unit.txt" "host/uniform-before-use-program.txt" "host/wrong-target.txt" "start.frag" "start.vert" "text.fr.md" "text.md" "texture-units.svg"),
    folder!("ex12-which-brdf": "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md" "ward.svg"),
    folder!("ex13-baking": "exercise.toml" "text.fr.md" "text.md"; not_on_the_web "reference.py"),
    folder!("s1-panorama-to-cubemap": "exercise.toml" "faces.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.fr.md" "text.md"),
];

type Pictures = (&'static str, &'static [(&'static str, &'static [u8])]);

/// Pictures by folder: name and bytes.
const PICTURES: &[Pictures] = &[(
    "s1-panorama-to-cubemap",
    &[("panorama.png", include_bytes!("../../../exercises/s1-panorama-to-cubemap/panorama.png"))],
)];

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_folder_is_an_exercise_and_all_its_files_are_built_in() {
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../exercises");
        let mut folders: Vec<String> = std::fs::read_dir(&top)
            .unwrap()
            .map(|entry| entry.unwrap())
            .filter(|entry| entry.path().join("exercise.toml").exists())
            .map(|entry| entry.file_name().into_string().unwrap())
            .collect();
        folders.sort();
        let built_in: Vec<&str> = FOLDERS.iter().map(|(folder, _)| *folder).collect();
        assert_eq!(folders, built_in);
        for (folder, files) in FOLDERS {
            let exercise = read(folder, files).unwrap();
            assert!(exercise.text().len() > 1000, "{folder}");
            for (name, text) in *files {
                assert_eq!(std::fs::read_to_string(top.join(folder).join(name)).unwrap(), *text, "{folder}/{name}");
            }
            for name in ["text.md", "text.fr.md", "start.vert", "start.frag", "reference.vert", "reference.frag"] {
                let on_disk = top.join(folder).join(name).exists();
                assert_eq!(exercise.file(name).is_some(), on_disk, "{folder}/{name}");
            }
        }
    }

    #[test]
    fn an_exercise_is_found_by_what_people_type() {
        for word in ["ex04", "EX04", "ex4", "4", "04", "ex04-phong-diffuse"] {
            assert_eq!(find(word).map(|e| e.id.as_str()), Some("ex04"), "{word}");
        }
        assert_eq!(find("10").map(|e| e.id.as_str()), Some("ex10"));
        assert_eq!(find("s1").map(|e| e.id.as_str()), Some("s1"));
        assert!(find("ex99").is_none() && find("").is_none() && find("ex").is_none());
    }

    /// A line of a program without spaces and comment.
    fn code(line: &str) -> String {
        line.split("//").next().unwrap_or_default().split_whitespace().collect()
    }

    /// The lines of a program that compute something.
    fn statements(text: &str) -> Vec<String> {
        let lines = text.lines().map(code);
        lines.filter(|line| line.len() >= 12 && line.contains(['=', '('])).collect()
    }

    #[test]
    fn nothing_that_is_handed_out_contains_the_answer() {
        let mut compared = 0;
        for exercise in all() {
            let handed_out: Vec<(&str, &str)> = exercise.start_files().collect();
            assert!(handed_out.len() + exercise.given.len() >= 2, "{}", exercise.id);
            for (name, _) in &handed_out {
                assert!(!name.contains("reference") && !name.ends_with(".toml"), "{}: {name}", exercise.id);
            }
            // The answer is what the solution has and the files to start from lack.
            let is_program = |name: &str| [".vert", ".frag", ".cpp", ".py"].iter().any(|end| name.ends_with(end));
            let given: Vec<String> = (handed_out.iter().filter(|(name, _)| is_program(name)))
                .flat_map(|(_, text)| text.lines().map(code))
                .collect();
            let texts: Vec<(&str, String)> =
                handed_out.iter().map(|(name, text)| (*name, text.lines().map(code).collect())).collect();
            for (file, text) in exercise.answer_files().filter(|(name, _)| is_program(name)) {
                let answer: Vec<String> = statements(text).into_iter().filter(|line| !given.contains(line)).collect();
                compared += answer.len();
                for line in &answer {
                    for (name, text) in &texts {
                        assert!(!text.contains(line), "{}: {name} contains `{line}` of {file}", exercise.id);
                    }
                }
            }
            // The lists of calls to repair differ from the right one in a line or more.
            for (_, right) in exercise.answer_files().filter(|(name, _)| name.ends_with(".txt")) {
                let calls = |text: &str| text.lines().map(code).filter(|line| !line.is_empty()).collect::<Vec<_>>();
                for (name, text) in handed_out.iter().filter(|(name, _)| name.ends_with(".txt")) {
                    compared += 1;
                    assert_ne!(calls(text), calls(right), "{}: {name}", exercise.id);
                }
            }
        }
        assert!(compared > 100, "only {compared} lines were compared");
    }

    #[test]
    fn an_exercise_states_how_much_is_shown() {
        const FILES: &[(&str, &str)] = &[
            (
                "exercise.toml",
                "id = \"ex98\"\ntitle = \"x\"\nkind = \"shaders\"\nfeedback = \"name\"\nshow_reference = false",
            ),
            ("reference.frag", "void main() {}"),
        ];
        let exercise = read("ex98", FILES).unwrap();
        assert_eq!((exercise.feedback, exercise.shows_reference), (Feedback::Name, false));
        let refused = exercise.reference_files().map(Iterator::count).unwrap_err();
        assert!(refused.contains("reference solution of ex98 is not shown in this course"), "{refused}");
        assert!(crate::preview::reference(&exercise).is_err());
        assert_eq!(exercise.answer_files().count(), 1);
        const UNKNOWN: &[(&str, &str)] =
            &[("exercise.toml", "id = \"ex98\"\ntitle = \"x\"\nkind = \"shaders\"\nfeedback = \"all\"")];
        assert!(read("ex98", UNKNOWN).unwrap_err().contains("expected one of `verdict`, `name`, `line`, `fix`"));
        for exercise in all() {
            assert_eq!((exercise.feedback, exercise.shows_reference), (Feedback::Line, true), "{}", exercise.id);
            assert!(exercise.reference_files().is_ok_and(|mut files| files.next().is_some()), "{}", exercise.id);
        }
    }
}
