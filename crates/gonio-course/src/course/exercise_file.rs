//! The folder of an exercise.
//!
//! | file | content |
//! |---|---|
//! | `exercise.toml` | title, texts, policy, points, how it is judged |
//! | `text.md`, `text.fr.md` | the exercise, in the first language of the course and in the others |
//! | `start.vert`, `start.frag` | what students start from |
//! | `reference.vert`, `reference.frag` | the right answer |
//! | `mistakes.toml` | mistakes with names, if it is judged by its own reference |
//! | pictures | handed out if a text names them |
//! | others | handed out if `hand_out` names them |
//!
//! Nothing else is handed out, so a forgotten solution in the folder stays there.

use super::mistake_file::{self, MistakeDefinition, is_kebab_case};
use super::points_table::read_points;
use super::scene_table::read_scenes;
use super::text_tables::{read_first, read_translation};
use super::{
    CourseExercise, CourseFile, CoursePolicy, EXERCISE_FILE, JudgeKind, PICTURES_FILE, REFERENCE_FILES, START_FILES,
    read_feedback, text_of,
};
use gonio_check::comparison::TASKS;
use gonio_check::picture_judge::{JudgePictures, JudgeScenes, OwnMistake, PictureJudge, SceneFamily, StoredPictures};
use gonio_check::roles::{Meaning, NamesFile};
use gonio_exercises::exercise::{Exercise, ExerciseDefinition, ShaderJudge, Texts};
use gonio_language::Language;
use gonio_mesh::ReadError;
use gonio_scene::toml_table::{Entry, Fault, TableReader, Value, nearest_word, parse_toml};

const FAMILY_WORDS: &[&str] = &["lit", "mirrored", "sky", "camera"];
/// The built-in exercises in whose scenes an exercise of each family is shown.
const SHOWN_LIKE: [&str; 4] = ["ex07", "ex09", "ex08", "ex01"];
const KIND_WORDS: &[&str] = &["shaders"];
const PICTURE_ENDS: [&str; 4] = [".svg", ".png", ".jpg", ".jpeg"];
const MISTAKES_FILE: &str = "mistakes.toml";

/// What `exercise.toml` states.
struct Declared {
    id: String,
    texts: Vec<(Language, Texts)>,
    lecture_section: String,
    builds_on: Vec<String>,
    hand_out: Vec<String>,
    feedback: gonio_check::feedback::Feedback,
    show_reference: bool,
    points: Option<gonio_exercises::points::PointScheme>,
    judge: JudgeKind,
    family: SceneFamily,
    scenes: Vec<gonio_check::testbench::TestScene>,
    names: NamesFile,
}

/// Reads the exercise in a folder of a course.
pub(super) fn read(files: &[CourseFile], folder: &str, policy: &CoursePolicy) -> Result<CourseExercise, ReadError> {
    let path = |name: &str| format!("{folder}/{name}");
    let missing =
        |name: &str, what: &str| ReadError::new(format!("there is no such file: {what}")).in_file(&path(name));
    let text = |name: &str| text_of(files, &path(name));
    let toml = text(EXERCISE_FILE)?
        .ok_or_else(|| missing(EXERCISE_FILE, "each folder that course.toml lists is an exercise"))?;
    let [vertex, fragment] = REFERENCE_FILES.map(text);
    let reference = match (vertex?, fragment?) {
        (Some(vertex), Some(fragment)) => Some([vertex, fragment]),
        (None, None) => None,
        (Some(_), None) => return Err(missing(REFERENCE_FILES[1], "the other half of the reference")),
        (None, Some(_)) => return Err(missing(REFERENCE_FILES[0], "the other half of the reference")),
    };
    let mistakes_text = text(MISTAKES_FILE)?;
    let mistakes = match &mistakes_text {
        None => Vec::new(),
        Some(text) => mistake_file::read(text, &policy.languages, reference.as_ref())
            .map_err(|fault| fault.in_text(text).in_file(&path(MISTAKES_FILE)))?,
    };
    let ids: Vec<String> = mistakes.iter().map(|mistake| mistake.id.clone()).collect();
    let declared = read_declared(&toml, folder, policy, &ids)
        .map_err(|fault| fault.in_text(&toml).in_file(&path(EXERCISE_FILE)))?;
    if let (JudgeKind::Like(built_in), Some(_)) = (&declared.judge, &mistakes_text) {
        let message = format!(
            "it is for exercises with judge = \"reference\"; {built_in} has the mistakes of the catalogue (`gonio lab mistakes`)"
        );
        return Err(ReadError::new(message).in_file(&path(MISTAKES_FILE)));
    }
    let judge = judge(files, folder, &declared, &mistakes, reference.as_ref())?;

    let mut own: Vec<(String, String)> = Vec::new();
    for (index, language) in policy.languages.iter().enumerate() {
        let name = if index == 0 { "text.md".to_owned() } else { format!("text.{}.md", language.code()) };
        let content =
            text(&name)?.ok_or_else(|| missing(&name, "the text of the exercise in a language of the course"))?;
        own.push((name, content));
    }
    let texts: String = own.iter().map(|(_, text)| text.as_str()).collect();
    for name in START_FILES {
        own.push((name.to_owned(), text(name)?.ok_or_else(|| missing(name, "what students start from"))?));
    }
    for (name, text) in REFERENCE_FILES.iter().zip(reference.iter().flatten()) {
        own.push(((*name).to_owned(), text.clone()));
    }
    let mut pictures = Vec::new();
    for name in &declared.hand_out {
        let file = files.iter().find(|file| file.path == path(name));
        let file = file.ok_or_else(|| missing(name, "`hand_out` of exercise.toml names it"))?;
        match std::str::from_utf8(&file.bytes) {
            Ok(text) => own.push((name.clone(), text.to_owned())),
            Err(_) => pictures.push((name.clone(), file.bytes.clone())),
        }
    }
    let mut unused = Vec::new();
    for file in files {
        let Some(name) = file.path.strip_prefix(folder).and_then(|rest| rest.strip_prefix('/')) else { continue };
        let is_known = [EXERCISE_FILE, PICTURES_FILE, MISTAKES_FILE].contains(&name)
            || own.iter().any(|(known, _)| known == name)
            || pictures.iter().any(|(known, _)| known == name);
        let is_figure = PICTURE_ENDS.iter().any(|end| name.ends_with(end)) && texts.contains(name);
        match (is_known, is_figure, std::str::from_utf8(&file.bytes)) {
            (true, ..) => {}
            (false, true, Ok(text)) => own.push((name.to_owned(), text.to_owned())),
            (false, true, Err(_)) => pictures.push((name.to_owned(), file.bytes.clone())),
            (false, false, _) => unused.push(name.to_owned()),
        }
    }
    let exercise = Exercise::of_course(ExerciseDefinition {
        id: declared.id,
        folder: folder.to_owned(),
        lecture_section: declared.lecture_section,
        builds_on: declared.builds_on,
        given: Vec::new(),
        feedback: declared.feedback,
        // There is nothing to show of a reference that is not there.
        shows_reference: declared.show_reference && reference.is_some(),
        points: declared.points,
        texts: declared.texts,
        files: own,
        pictures,
        judge,
    });
    Ok(CourseExercise { exercise, folder: Some(folder.to_owned()), judge: declared.judge, reference, mistakes, unused })
}

fn read_declared(text: &str, folder: &str, policy: &CoursePolicy, mistakes: &[String]) -> Result<Declared, Fault> {
    let root = parse_toml(text)?;
    let mut t = TableReader::new("an exercise", &root)?;
    let id = t.text("id")?.unwrap_or_else(|| folder.to_owned());
    if !is_kebab_case(&id) {
        let message = format!("`id`: `{id}` is not in kebab-case: small letters, digits and single hyphens");
        return Err(Fault::at(&t.place("id"), message));
    }
    let first = read_first(&mut t)?;
    t.choice("kind", KIND_WORDS)?;
    let lecture_section = t.text("lecture_section")?.unwrap_or_default();
    let builds_on = t.texts("builds_on")?.unwrap_or_default();
    let hand_out = t.texts("hand_out")?.unwrap_or_default();
    if let Some(bad) = hand_out.iter().find(|name| !may_be_handed_out(name)) {
        let message = format!("`hand_out`: `{bad}` is part of the answer, or not a file of this folder");
        return Err(Fault::at(&t.place("hand_out"), message));
    }
    let feedback = read_feedback(&mut t)?.unwrap_or(policy.feedback);
    let show_reference = t.truth("show_reference")?.unwrap_or(policy.show_reference);
    let judge = read_judge(&mut t)?;
    let family = t.choice("scenes", FAMILY_WORDS)?;
    let named = read_names(t.entries("names", "[names]")?)?;
    let family_place = t.place("scenes");
    let chosen = SceneFamily::ALL[family.unwrap_or(0)];
    let scenes = read_scenes(&mut t, chosen)?;
    if let JudgeKind::Like(built_in) = &judge {
        if family.is_some() || !scenes.is_empty() {
            let place = if family.is_some() { family_place } else { t.place("scene") };
            let message = format!("the scenes of {built_in} are the checker's; others need judge = \"reference\"");
            return Err(Fault::at(&place, message));
        }
        if !named.names.is_empty() {
            let message = "[names] needs judge = \"reference\"; a names.toml in `hand_out` does the same for others";
            return Err(Fault::at(&t.place("names"), message));
        }
    }
    let own_mistakes = (judge == JudgeKind::Reference).then_some(mistakes);
    let points = read_points(&mut t, own_mistakes)?.or_else(|| policy.points.clone());
    let mut texts = vec![(policy.languages.first().copied().unwrap_or(Language::English), first.clone())];
    for language in policy.languages.iter().skip(1) {
        let code = language.code();
        let translated = read_translation(&mut t, *language, &first)?.ok_or_else(|| {
            Fault::at(
                &(0..0),
                format!("course.toml lists the language `{code}`: expected a table [{code}] with `title`"),
            )
        })?;
        texts.push((*language, translated));
    }
    t.finish()?;
    Ok(Declared {
        id,
        texts,
        lecture_section,
        builds_on,
        hand_out,
        feedback,
        show_reference,
        points,
        judge,
        family: chosen,
        scenes,
        names: named,
    })
}

fn may_be_handed_out(name: &str) -> bool {
    let parts: Vec<&str> = name.split('/').collect();
    let is_part = |part: &&str| !part.is_empty() && !matches!(*part, "." | "..") && !part.contains('\\');
    parts.iter().all(is_part)
        && !parts.iter().any(|part| part.starts_with("reference"))
        && ![EXERCISE_FILE, MISTAKES_FILE].contains(&name)
}

fn read_judge(t: &mut TableReader<'_>) -> Result<JudgeKind, Fault> {
    let Some(word) = t.text("judge")? else {
        let message = "the exercise does not state how it is judged: add judge = \"ex07\", for a built-in exercise that sets the \
                       same task, or judge = \"reference\"";
        return Err(Fault::at(&(0..0), message));
    };
    if word == "reference" {
        return Ok(JudgeKind::Reference);
    }
    // The faces of a panorama are another kind of answer.
    let known = || TASKS.iter().map(|task| task.exercise).filter(|id| *id != "s1").chain(["reference"]);
    if known().any(|id| id == word) {
        return Ok(JudgeKind::Like(word));
    }
    let meant = nearest_word(&word, known()).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
    let message =
        format!("`judge`: unknown judge `{word}`, expected {}{meant}", known().collect::<Vec<_>>().join(", "));
    Err(Fault::at(&t.place("judge"), message))
}

/// `[names]`: roles and values, as in a `names.toml`.
fn read_names(entries: &[Entry]) -> Result<NamesFile, Fault> {
    let mut names = NamesFile::default();
    for entry in entries {
        let key = &entry.key;
        let number = |value: &Value| match value {
            Value::Number(number) if number.is_finite() => Some(*number as f32),
            Value::Truth(truth) => Some(f32::from(u8::from(*truth))),
            _ => None,
        };
        let meaning = match &entry.item.value {
            Value::Text(role) => {
                let role =
                    role.parse().map_err(|unknown| Fault::at(&entry.item.span, format!("`{key}`: {unknown}")))?;
                Some(Meaning::Role(role))
            }
            Value::List(items) if (1..=16).contains(&items.len()) => {
                items.iter().map(|item| number(&item.value)).collect::<Option<Vec<f32>>>().map(Meaning::Value)
            }
            other => number(other).map(|number| Meaning::Value(vec![number])),
        };
        let meaning = meaning.ok_or_else(|| {
            let message = format!("`{key}`: expected a role such as \"light-pos\", a number or a list of numbers");
            Fault::at(&entry.item.span, message)
        })?;
        names.names.insert(key.clone(), meaning);
    }
    Ok(names)
}

/// The judge that the exercise states.
fn judge(
    files: &[CourseFile],
    folder: &str,
    declared: &Declared,
    mistakes: &[MistakeDefinition],
    reference: Option<&[String; 2]>,
) -> Result<ShaderJudge, ReadError> {
    if let JudgeKind::Like(built_in) = &declared.judge {
        let none = || ReadError::new(format!("{built_in} has no model solution"));
        return ShaderJudge::like(&declared.id, built_in).ok_or_else(none);
    }
    let scenes = JudgeScenes::new(declared.family, declared.scenes.clone());
    let path = format!("{folder}/{PICTURES_FILE}");
    let stored = files.iter().find(|file| file.path == path).map(|file| {
        let read = StoredPictures::from_bytes(&file.bytes, &scenes.all);
        read.map_err(|error| ReadError::new(error.to_string()).in_file(&path))
    });
    let of_shaders = |mistake: Option<&MistakeDefinition>| {
        reference.map(|shaders| JudgePictures::Shaders(mistake.map_or_else(|| shaders.clone(), |m| m.applied(shaders))))
    };
    // A reference that was packaged has no source beside it.
    let stored = if reference.is_some() { None } else { stored.transpose()? };
    let pictures = |mistake: Option<&MistakeDefinition>| match (&stored, mistake) {
        (Some(stored), None) => Some(JudgePictures::Drawn(stored.reference.clone())),
        (Some(stored), Some(mistake)) => {
            let atlas = stored.mistakes.iter().find(|(id, _)| *id == mistake.id)?;
            Some(JudgePictures::Drawn(atlas.1.clone()))
        }
        (None, mistake) => of_shaders(mistake),
    };
    let right = pictures(None).ok_or_else(|| {
        ReadError::new("there is no such file: judge = \"reference\" compares with it")
            .in_file(&format!("{folder}/{}", REFERENCE_FILES[0]))
    })?;
    let mut own = Vec::new();
    for mistake in mistakes {
        let pictures = pictures(Some(mistake)).ok_or_else(|| {
            ReadError::new(format!("it has no pictures of the mistake `{}`; package the exercise again", mistake.id))
                .in_file(&path)
        })?;
        own.push(OwnMistake {
            id: mistake.id.clone(),
            lecture_section: mistake.lecture_section.clone(),
            texts: mistake.texts.clone(),
            pictures,
            written: mistake.written.clone(),
        });
    }
    let like =
        SceneFamily::ALL.iter().position(|family| *family == declared.family).map_or("ex07", |at| SHOWN_LIKE[at]);
    let judge = PictureJudge { scenes, names: declared.names.clone(), reference: right, mistakes: own };
    Ok(ShaderJudge::pictures(like, judge))
}
