use super::*;
use crate::template;
use gonio_check::picture_judge::WrittenMark;

/// A course with the files of a template, some of them replaced or added.
fn course(changes: &[(&str, &str)]) -> Result<Course, ReadError> {
    let mut files = template::files("ex07", Language::English).unwrap();
    for (path, text) in changes {
        files.retain(|file| file.path != *path);
        files.push(CourseFile::new(*path, text.as_bytes()));
    }
    Course::read(&files)
}

fn message(changes: &[(&str, &str)]) -> String {
    course(changes).unwrap_err().to_string()
}

const OWN: &str = "title = \"Rim light\"\njudge = \"reference\"\n";
const MISTAKE: &str = "[[mistake]]\nid = \"too-bright\"\nname = \"It is too bright\"\n";

#[test]
fn a_template_is_a_course() {
    let course = course(&[]).unwrap();
    let exercise = course.find("light-equation").unwrap();
    assert_eq!(exercise.judge, JudgeKind::Like("ex07".to_owned()));
    assert!(exercise.reference.is_some() && exercise.unused.is_empty(), "{:?}", exercise.unused);
    let handed_out: Vec<&str> = exercise.exercise.start_files().map(|(name, _)| name).collect();
    assert_eq!(handed_out, ["text.md", "start.vert", "start.frag", "attenuation.svg"]);
    assert_eq!(exercise.exercise.like(), "ex07");
}

#[test]
fn errors_have_a_place_and_the_nearest_key() {
    let toml = "light-equation/exercise.toml";
    for (path, text, expected) in [
        (
            "course.toml",
            "name = \"x\"\nfedback = \"name\"\n",
            "course.toml:2:1: unknown key `fedback` in a course; did you mean `feedback`?",
        ),
        (
            "course.toml",
            "name = \"x\"\nfeedback = \"nam\"\n",
            "course.toml:2:12: `feedback`: unknown word `nam`, expected verdict, name, line, fix; did you mean `name`?",
        ),
        (
            "course.toml",
            "name = \"x\"\nlanguages = [\"en\", \"xx\"]\n",
            "course.toml:2:13: `languages`: unknown language `xx`, expected en or fr",
        ),
        (
            "course.toml",
            "name = \"x\"\nbuiltin = [\"ex4\"]\n",
            "course.toml:2:11: `builtin`: there is no built-in exercise `ex4`; did you mean `ex",
        ),
        (
            "course.toml",
            "name = \"x\"\nexercises = [\"../x\"]\n",
            "course.toml:2:13: `exercises`: `../x` is not the name of a folder in the course",
        ),
        (
            "course.toml",
            "name = \"x\"\nlanguages = [\"en\", \"fr\"]\n",
            "light-equation/exercise.toml:1:1: course.toml lists the language `fr`: expected a table [fr] with `title`",
        ),
        (
            "course.toml",
            "name = \"x\"\n[points]\ntotal = -3\n",
            "course.toml:3:9: `total`: expected a positive number, found -3",
        ),
        (
            toml,
            "title = \"x\"\njudge = \"ex77\"\n",
            "exercise.toml:2:9: `judge`: unknown judge `ex77`, expected ex01, ",
        ),
        (toml, "title = \"x\"\n", "exercise.toml:1:1: the exercise does not state how it is judged"),
        (
            toml,
            "title = \"x\"\njudge = \"ex07\"\n[points]\ntotal = 5\n[points.mistakes]\nnormal-by-modl-matrix = 1\n",
            "exercise.toml:6:1: unknown mistake `normal-by-modl-matrix`; did you mean `normal-by-model-matrix`?",
        ),
        (
            toml,
            "title = \"x\"\njudge = \"ex07\"\n[points]\ntotal = 5\n[points.terms]\ndifuse = 1\n",
            "exercise.toml:6:1: unknown term `difuse`; did you mean `diffuse`?",
        ),
        (
            toml,
            "title = \"x\"\njudge = \"ex07\"\nhand_out = [\"reference.frag\"]\n",
            "exercise.toml:3:12: `hand_out`: `reference.frag` is part of the answer",
        ),
        (
            toml,
            "title = \"x\"\njudge = \"reference\"\n[[scene]]\nname = \"low\"\nlike = \"strechd\"\n",
            "exercise.toml:5:8: `like`: there is no scene `strechd`",
        ),
        (
            toml,
            "title = \"x\"\njudge = \"reference\"\n[names]\nsun = \"lihgt-pos\"\n",
            "exercise.toml:4:7: `sun`: unknown role `lihgt-pos`",
        ),
    ] {
        let found = message(&[(path, text)]);
        assert!(found.contains(expected), "{found}\ndoes not contain\n{expected}");
    }
}

#[test]
fn a_change_of_the_reference_has_to_apply_once() {
    let change = |find: &str| {
        format!("{MISTAKE}change = [{{ file = \"reference.frag\", find = \"{find}\", write = \"2.0\" }}]\n")
    };
    let read =
        |mistakes: &str| course(&[("light-equation/exercise.toml", OWN), ("light-equation/mistakes.toml", mistakes)]);
    let course = read(&change("max(dot(N, L), 0.0)")).unwrap();
    let mistake = &course.find("light-equation").unwrap().mistakes[0];
    assert_eq!(mistake.written, [WrittenMark::new("2.0").unwrap()]);
    let wrong = mistake.applied(course.find("light-equation").unwrap().reference.as_ref().unwrap());
    assert!(wrong[1].contains("light.diffuse_strength * 2.0"), "{}", wrong[1]);
    for (find, count) in [("vec3", 9), ("nowhere", 0)] {
        let error = read(&change(find)).unwrap_err().to_string();
        assert!(error.contains("mistakes.toml:4:") && error.contains(&format!("occurs {count} times")), "{error}");
    }
}

#[test]
fn a_forgotten_solution_is_not_handed_out() {
    let forgotten = [("light-equation/solution.frag", "void main() {}"), ("light-equation/notes.txt", "x")];
    let course = course(&forgotten).unwrap();
    let exercise = course.find("light-equation").unwrap();
    assert_eq!(exercise.unused, ["solution.frag", "notes.txt"]);
    assert!(exercise.exercise.start_files().all(|(name, _)| name != "solution.frag" && name != "notes.txt"));
}

#[test]
fn built_in_exercises_follow_the_course() {
    let text =
        "name = \"x\"\nfeedback = \"verdict\"\nshow_reference = false\nbuiltin = [\"ex04\"]\n[points]\ntotal = 8\n";
    let course = course(&[("course.toml", text)]).unwrap();
    let ex04 = &course.find("4").unwrap().exercise;
    assert_eq!((ex04.id.as_str(), ex04.feedback, ex04.shows_reference), ("ex04", Feedback::Verdict, false));
    assert_eq!(ex04.points, Some(PointScheme::of_total(8.0)));
    assert_eq!(exercise::built_in().iter().find(|e| e.id == "ex04").unwrap().feedback, Feedback::Line);
}

#[test]
fn a_course_that_is_cut_anywhere_is_an_error_or_a_course() {
    let files = template::files(template::OWN_REFERENCE, Language::French).unwrap();
    let mut errors = 0;
    for at in 0..files.len() {
        let whole = files[at].bytes.clone();
        for length in (0..whole.len()).step_by(41) {
            let mut files = files.clone();
            files[at].bytes.truncate(length);
            match Course::read(&files) {
                Ok(course) => assert_eq!(course.exercises.len(), 1),
                Err(error) => {
                    errors += 1;
                    assert!(error.place.file.is_some(), "{error}");
                }
            }
        }
    }
    assert!(errors > 100, "{errors}");
}
