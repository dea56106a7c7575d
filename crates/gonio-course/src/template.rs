//! A course to start from, which verifies as it is.

use crate::course::{COURSE_FILE, CourseFile, EXERCISE_FILE};
use gonio_check::comparison::Task;
use gonio_exercises::exercise::{self, Exercise, InputVariable};
use gonio_language::Language;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The word for a template that is judged by its own reference.
pub const OWN_REFERENCE: &str = "reference";

macro_rules! rim_light {
    ($name:literal) => {
        include_str!(concat!("../template/rim-light/", $name))
    };
}

/// The files of a course with one exercise: a copy of the built-in exercise `from`, or for [`OWN_REFERENCE`] one about rim light
/// that is judged by its own reference. `None` if the built-in exercise is not one for shaders that a model solution judges.
#[must_use]
pub fn files(from: &str, language: Language) -> Option<Vec<CourseFile>> {
    let (folder, own) = match from {
        OWN_REFERENCE => ("rim-light".to_owned(), rim_light_files(language)),
        _ => {
            let built_in = exercise::built_in().iter().find(|known| known.id == from)?;
            copied(built_in, language)?
        }
    };
    let mut files = vec![CourseFile::new(COURSE_FILE, course_file(language))];
    files.extend(own.into_iter().map(|(name, text)| CourseFile::new(format!("{folder}/{name}"), text)));
    Some(files)
}

/// The ids that [`files`] accepts.
pub fn sources() -> impl Iterator<Item = &'static str> {
    let built_in = exercise::built_in().iter().filter(|known| copied(known, Language::English).is_some());
    built_in.map(|known| known.id.as_str()).chain([OWN_REFERENCE])
}

fn course_file(language: Language) -> String {
    let (name, [languages, feedback, reference, exercises, built_in]) = match language {
        Language::English => (
            "My course",
            [
                "The first is that of texts without another: text.md, then text.fr.md.",
                "What a verdict shows: verdict, name, line or fix.",
                "Whether students may see references, their values and their pictures.",
                "Without this line: every folder with an exercise.toml, by name.",
                "Built-in exercises that belong to the course too.",
            ],
        ),
        Language::French => (
            "Mon cours",
            [
                "La première est celle des textes qui n'en ont pas d'autre : text.md, puis text.en.md.",
                "Ce que montre un verdict : verdict, name, line ou fix.",
                "Si les étudiants peuvent voir les références, leurs valeurs et leurs images.",
                "Sans cette ligne : chaque dossier qui a un exercise.toml, par nom.",
                "Les exercices intégrés qui font aussi partie du cours.",
            ],
        ),
    };
    let code = language.code();
    format!(
        "name = \"{name}\"\n\n# {languages}\nlanguages = [\"{code}\"]\n\n# {feedback}\nfeedback = \"line\"\n\n\
         # {reference}\nshow_reference = false\n\n# {exercises}\n# exercises = [\"rim-light\"]\n\n\
         # {built_in}\n# builtin = [\"ex03\", \"ex04\"]\n"
    )
}

fn rim_light_files(language: Language) -> Vec<(String, String)> {
    let (toml, mistakes, text) = match language {
        Language::English => (rim_light!("exercise.toml.en"), rim_light!("mistakes.toml.en"), rim_light!("text.md.en")),
        Language::French => (rim_light!("exercise.toml.fr"), rim_light!("mistakes.toml.fr"), rim_light!("text.md.fr")),
    };
    let files = [
        (EXERCISE_FILE, toml),
        ("mistakes.toml", mistakes),
        ("text.md", text),
        ("start.vert", rim_light!("start.vert")),
        ("start.frag", rim_light!("start.frag")),
        ("reference.vert", rim_light!("reference.vert")),
        ("reference.frag", rim_light!("reference.frag")),
    ];
    files.into_iter().map(|(name, text)| (name.to_owned(), text.to_owned())).collect()
}

/// The folder's name and the files of a copy.
fn copied(built_in: &Exercise, language: Language) -> Option<(String, Vec<(String, String)>)> {
    Task::find(&built_in.id).filter(|task| task.exercise != "s1")?;
    let folder = built_in.folder.split_once('-').map_or(built_in.folder, |(_, name)| name).to_owned();
    let mut files = vec![
        (EXERCISE_FILE.to_owned(), exercise_file(built_in, language)),
        (
            "text.md".to_owned(),
            built_in.text_in(language).replace(&format!(" {} ", built_in.id), &format!(" {folder} ")),
        ),
    ];
    let start = built_in.start_files().filter(|(name, _)| *name != "text.md");
    let reference =
        ["reference.vert", "reference.frag"].into_iter().filter_map(|name| Some((name, built_in.file(name)?)));
    files.extend(start.chain(reference).map(|(name, text)| (name.to_owned(), text.to_owned())));
    Some((folder, files))
}

/// The `exercise.toml` of a copy.
fn exercise_file(built_in: &Exercise, language: Language) -> String {
    let texts = built_in.texts_in(language);
    let comment = match language {
        Language::English => {
            "Judged by the model solution of this built-in exercise, with the names and lines of its mistakes."
        }
        Language::French => {
            "Jugé d'après la solution modèle de cet exercice intégré, avec les noms et les lignes de ses erreurs."
        }
    };
    let mut toml = format!(
        "title = {}\nsummary = {}\nlecture_section = {}\n# {comment}\njudge = {}\n",
        quoted(&texts.title),
        quoted(&texts.summary),
        quoted(&built_in.lecture_section),
        quoted(&built_in.id)
    );
    for detail in &texts.look_for {
        let _ = write!(toml, "\n[[look_for]]\ntext = {}\n", quoted(&detail.text));
    }
    variables(&mut toml, "attributes", &texts.inputs.attributes);
    variables(&mut toml, "uniforms", &texts.inputs.uniforms);
    let _ = write!(toml, "\n[points]\ntotal = 20\nother_mistake = 5\n");
    toml
}

fn variables(toml: &mut String, kind: &str, variables: &BTreeMap<String, InputVariable>) {
    if !variables.is_empty() {
        let _ = write!(toml, "\n[inputs.{kind}]\n");
    }
    for (name, variable) in variables {
        let [ty, meaning, value] = [&variable.glsl_type, &variable.meaning, &variable.value].map(|text| quoted(text));
        let _ = writeln!(toml, "{} = {{ type = {ty}, meaning = {meaning}, value = {value} }}", quoted(name));
    }
}

/// A text as a basic string of TOML, whose escapes those of JSON are.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default().replace('\u{7f}', "\\u007F")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;

    #[test]
    fn every_template_is_a_course_in_every_language() {
        assert!(sources().count() >= 10, "{:?}", sources().collect::<Vec<_>>());
        for from in sources() {
            for language in Language::ALL {
                let course = Course::read(&files(from, language).unwrap()).unwrap_or_else(|e| panic!("{from}: {e}"));
                let only = &course.exercises[0];
                assert!(only.unused.is_empty() && only.reference.is_some(), "{from}: {:?}", only.unused);
                assert_eq!(course.policy.languages, [language]);
            }
        }
        assert!(files("ex02", Language::English).is_none() && files("ex99", Language::English).is_none());
    }
}
