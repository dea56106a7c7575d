//! A course with one exercise and without its reference.

use crate::course::mistake_file::written_mark;
use crate::course::{
    COURSE_FILE, Course, CourseExercise, CourseFile, EXERCISE_FILE, MistakeDefinition, PICTURES_FILE, START_FILES,
};
use gonio_check::feedback::Feedback;
use gonio_check::picture_judge::StoredPictures;
use gonio_exercises::points::PointScheme;
use std::fmt::Write as _;

/// The files of a course with one exercise, which judges as the whole one does and contains no line of the reference. Texts of
/// mistakes that the exercise never shows are left out too, because some graders run where students can read.
#[must_use]
pub fn sealed(
    course: &Course,
    files: &[CourseFile],
    of: &CourseExercise,
    pictures: Option<&StoredPictures>,
) -> Vec<CourseFile> {
    let codes: Vec<String> = course.policy.languages.iter().map(|language| quoted(language.code())).collect();
    let mut toml = format!(
        "name = {}\nlanguages = [{}]\nfeedback = {}\nshow_reference = false\n",
        quoted(&course.name),
        codes.join(", "),
        quoted(of.exercise.feedback.word())
    );
    let Some(folder) = &of.folder else {
        let _ = writeln!(toml, "exercises = []\nbuiltin = [{}]", quoted(&of.exercise.id));
        toml += &points_table(of.exercise.points.as_ref());
        return vec![CourseFile::new(COURSE_FILE, toml)];
    };
    let _ = writeln!(toml, "exercises = [{}]", quoted(folder));
    toml += &points_table(course.policy.points.as_ref());
    let mut sealed = vec![CourseFile::new(COURSE_FILE, toml)];
    let path = |name: &str| format!("{folder}/{name}");
    let own = |name: &str| files.iter().find(|file| file.path == path(name));
    if let Some(file) = own(EXERCISE_FILE) {
        let text = String::from_utf8_lossy(&file.bytes);
        sealed.push(CourseFile::new(path(EXERCISE_FILE), without_comments(&text)));
    }
    let texts = std::iter::once("text.md".to_owned())
        .chain(course.policy.languages.iter().map(|language| format!("text.{}.md", language.code())));
    let kept = texts.chain(START_FILES.map(str::to_owned));
    sealed.extend(kept.filter_map(|name| own(&name).cloned()));
    let handed_out =
        of.exercise.start_files().map(|(name, _)| name).chain(of.exercise.pictures().map(|(name, _)| name));
    for name in handed_out {
        if !sealed.iter().any(|file| file.path == path(name)) {
            sealed.extend(own(name).cloned());
        }
    }
    if let Some(pictures) = pictures {
        sealed.push(CourseFile::new(path(PICTURES_FILE), pictures.to_bytes()));
        if !of.mistakes.is_empty() {
            sealed.push(CourseFile::new(path("mistakes.toml"), mistakes_file(&of.mistakes, of.exercise.feedback)));
        }
    }
    sealed
}

/// Comments may say what the answer is. Lines in the middle of a text keep their marks: the text would change otherwise.
fn without_comments(toml: &str) -> String {
    if toml.contains("\"\"\"") || toml.contains("'''") {
        return toml.to_owned();
    }
    toml.lines().filter(|line| !line.trim_start().starts_with('#')).map(|line| format!("{line}\n")).collect()
}

fn points_table(points: Option<&PointScheme>) -> String {
    let Some(points) = points else { return String::new() };
    let mut toml = format!("\n[points]\ntotal = {}\n", points.total);
    if let Some(other) = points.other_mistake {
        let _ = writeln!(toml, "other_mistake = {other}");
    }
    for (heading, costs) in [("terms", &points.terms), ("mistakes", &points.mistakes)] {
        if !costs.is_empty() {
            let _ = writeln!(toml, "\n[points.{heading}]");
        }
        for (key, cost) in costs {
            let _ = writeln!(toml, "{} = {cost}", quoted(key));
        }
    }
    toml
}

fn mistakes_file(mistakes: &[MistakeDefinition], feedback: Feedback) -> String {
    let mut toml = String::new();
    for mistake in mistakes {
        let _ = writeln!(toml, "[[mistake]]\nid = {}", quoted(&mistake.id));
        let marks: Vec<String> = mistake.written.iter().map(|mark| quoted(&written_mark(mark))).collect();
        let mut written = String::new();
        if feedback >= Feedback::Line {
            written = format!("written = [{}]\n", marks.join(", "));
        }
        for (index, (language, texts)) in mistake.texts.iter().enumerate() {
            if index == 0 {
                let _ = writeln!(toml, "lecture_section = {}", quoted(&mistake.lecture_section));
                toml += &written;
            } else {
                let _ = writeln!(toml, "\n[mistake.{}]", language.code());
            }
            // A name is needed; below this level it is never shown.
            let name = if feedback >= Feedback::Name { texts.name.as_str() } else { mistake.id.as_str() };
            let _ = writeln!(toml, "name = {}", quoted(name));
            if feedback >= Feedback::Name {
                let _ = writeln!(toml, "looks_like = {}", quoted(&texts.looks_like));
            }
            if feedback >= Feedback::Line {
                let _ = writeln!(toml, "fix = {}", quoted(&texts.fix));
            }
        }
        toml.push('\n');
    }
    toml
}

/// A text as a basic string of TOML, whose escapes those of JSON are.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default().replace('\u{7f}', "\\u007F")
}
