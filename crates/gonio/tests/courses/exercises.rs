//! `gonio lab` with the exercises of a course.

use crate::common::{Lab, Run};
use crate::{edit, hand_in, light_equation, read, rim_light};
use std::process::Stdio;

const COURSE: [&str; 2] = ["--course", "course"];

fn check(lab: &Lab, exercise: &str, folder: &str, options: &[&str]) -> Run {
    lab.run(&[&["lab", "check", exercise, folder], COURSE.as_slice(), options].concat())
}

#[test]
fn an_exercise_of_ones_own_is_listed_shown_started_checked_and_stepped_through() {
    let lab = rim_light();
    let list = lab.run(&[&["lab", "list"], COURSE.as_slice()].concat()).good();
    assert!(list.text().contains("Rim light") && !list.text().contains("ex04  "), "{}", list.text());
    assert!(lab.run(&["lab", "show", "rim-light", "--course", "course"]).good().text().contains("## The equation"));
    lab.run(&["lab", "start", "rim-light", "mine", "--course", "course"]).good();
    let started = crate::all_files(&lab.path("mine")).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
    assert_eq!(
        started,
        ["start.frag", "start.vert", "text.md"],
        "the course hides references, so there is no goal.png"
    );
    let unchanged = check(&lab, "rim-light", "mine", &["--json"]).json();
    assert!(
        unchanged["verdict"] == "wrong" && unchanged["summary"].as_str().unwrap().contains("unchanged start files")
    );
    let step = lab.run(&["lab", "step", "rim-light", "mine", "--course", "course"]).good();
    assert!(step.text().contains("FragColor"), "{}", step.text());
    lab.run(&["lab", "draw", "rim-light", "mine", "-o", "mine.png", "--size", "64", "--course", "course"]).good();
    lab.run(&["lab", "reference", "rim-light", "--course", "course"])
        .refused(&["rim-light", "not shown in this course"]);
}

#[test]
fn a_course_around_the_current_folder_is_found_and_mentioned_in_one_line() {
    let lab = rim_light();
    let run = |args: &[&str]| Run::of(lab.command(args).current_dir(lab.path("course/rim-light")).output().unwrap());
    let run = run(&["lab", "list"]).good();
    assert!(run.text().contains("Rim light"), "{}", run.text());
    let notes: Vec<&str> = run.stderr.lines().collect();
    assert!(notes.len() == 1 && notes[0].contains("\"My course\""), "{notes:?}");
    // The built-in exercises are still there, under their own ids.
    let ex04 = Run::of(lab.command(&["lab", "show", "ex04"]).current_dir(lab.path("course")).output().unwrap());
    assert!(ex04.good().text().contains("gonio lab check ex04"));
}

#[test]
fn mistakes_of_the_teachers_list_are_named_at_their_lines_and_cost_their_points() {
    let lab = rim_light();
    hand_in(&lab, "rim-light", "right", &[("reference.frag", "dot(N, V)", "dot(V, N)")]);
    let right = check(&lab, "rim-light", "right", &["--json"]).good().json();
    assert_eq!((&right["verdict"], &right["points"]["earned"]), (&"correct".into(), &10.0.into()), "{right}");
    for (from, to, id, earned, at) in [
        ("pow(1.0 - facing,", "pow(facing,", "rim-not-inverted", 7.0, Some("float rim =")),
        ("dot(N, V)", "dot( N , L )", "rim-by-light", 7.0, Some("float facing =")),
        // Written in another way than in the list: it is named, and has no line.
        ("materialColour * diffuse + vec3(rim)", "materialColour * (rim + diffuse)", "rim-coloured", 8.0, None),
        ("normalize(v_normal)", "v_normal", "normal-not-renormalised", 8.0, Some("vec3 N =")),
    ] {
        hand_in(&lab, "rim-light", id, &[("reference.frag", from, to)]);
        let verdict = check(&lab, "rim-light", id, &["--json"]).json();
        assert_eq!(
            (&verdict["mistakes"][0]["id"], &verdict["points"]["earned"]),
            (&id.into(), &earned.into()),
            "{verdict}"
        );
        let text = read(&lab, &format!("{id}/mine.frag"));
        let line = at.map(|at| text.lines().position(|line| line.contains(at)).unwrap() + 1);
        assert_eq!(verdict["mistakes"][0]["line"].as_u64(), line.map(|line| line as u64), "{verdict}");
    }
    // The diffuse light is right beside a wrong rim, and the reference has no other term.
    let wrong = check(&lab, "rim-light", "rim-by-light", &["--json"]).json();
    assert_eq!(wrong["terms"], serde_json::json!([{ "term": "diffuse", "state": "right" }]), "{wrong}");
    hand_in(&lab, "rim-light", "halved", &[("reference.frag", "diffuse_strength *", "0.5 * diffuse_strength *")]);
    let halved = check(&lab, "rim-light", "halved", &["--json"]).json();
    assert_eq!(halved["terms"], serde_json::json!([{ "term": "diffuse", "state": "wrong" }]), "{halved}");
    let wrong = check(&lab, "rim-light", "rim-by-light", &[]);
    assert!(wrong.text().contains("7 of 10 points") && wrong.code == 1, "{}", wrong.text());
    // Something that is on no list.
    hand_in(&lab, "rim-light", "other", &[("reference.frag", "rim_strength *", "0.4 * rim_strength *")]);
    let verdict = check(&lab, "rim-light", "other", &["--json"]).json();
    assert!(verdict["verdict"] == "wrong" && verdict["mistakes"] == serde_json::json!([]), "{verdict}");
}

#[test]
fn other_names_for_the_inputs_are_understood() {
    let lab = rim_light();
    let rename = |file, from, to| (file, from, to);
    let names = [
        rename("reference.vert", "position", "aPos"),
        rename("reference.vert", "itM", "normalMatrix"),
        rename("reference.frag", "u_view_pos", "cameraPosition"),
        rename("reference.frag", "light_pos", "lampPosition"),
        rename("reference.frag", "materialColour", "objectColor"),
    ];
    hand_in(&lab, "rim-light", "renamed", &names);
    check(&lab, "rim-light", "renamed", &[]).good();
    // A name that says nothing is stated by the student, as for other exercises.
    hand_in(&lab, "rim-light", "stated", &[("reference.frag", "rim_strength", "q")]);
    let unsure = check(&lab, "rim-light", "stated", &["--json"]).json();
    assert!(unsure["verdict"] == "unsure" && unsure["summary"].as_str().unwrap().contains("`q`"), "{unsure}");
    lab.write("stated/names.toml", "[names]\nq = 0.6\n");
    check(&lab, "rim-light", "stated", &[]).good();
}

#[test]
fn a_copy_of_a_built_in_exercise_has_its_names_and_lines() {
    let lab = light_equation();
    hand_in(&lab, "light-equation", "wrong", &[("reference.vert", "mat3(itM)", "mat3(M)")]);
    let verdict = check(&lab, "light-equation", "wrong", &["--json"]).json();
    assert_eq!(verdict["exercise"], "light-equation");
    assert_eq!(verdict["mistakes"][0]["id"], "normal-by-model-matrix");
    let quoted = verdict["mistakes"][0]["quoted"].as_str().unwrap();
    assert!(quoted.contains("mat3(M)"), "{quoted}");
    assert_eq!(verdict["points"], serde_json::json!({ "earned": 15.0, "most": 20.0 }));
    // The course decides what is shown, and what is hidden counts.
    edit(&lab, "course/course.toml", "feedback = \"line\"", "feedback = \"verdict\"");
    let hidden = check(&lab, "light-equation", "wrong", &["--json"]).json();
    assert_eq!((&hidden["mistakes"], &hidden["points"]["earned"]), (&serde_json::json!([]), &15.0.into()));
}

#[test]
fn a_table_of_many_submissions_has_the_points_of_the_course() {
    let lab = rim_light();
    hand_in(&lab, "rim-light", "all/ann", &[]);
    hand_in(&lab, "rim-light", "all/ben", &[("reference.frag", "dot(N, V)", "dot(N, L)")]);
    let batch = || check(&lab, "rim-light", "all", &["-o", "results"]);
    assert_eq!(batch().code, 1);
    let row = |name: &str| {
        let table = read(&lab, "results/table.csv");
        table.lines().find(|line| line.starts_with(name)).unwrap().split(',').map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(row("ann")[..4], ["ann", "correct", "10", "10"]);
    assert_eq!(row("ben")[..4], ["ben", "wrong", "7", "10"]);
    let overview = read(&lab, "results/index.html");
    assert!(overview.contains("what their mistakes or their wrong terms cost"), "{overview}");
    assert!(read(&lab, "results/ben.html").contains("7 of 10 points"));
    // Other points are other verdicts, although no submission changed.
    edit(&lab, "course/rim-light/exercise.toml", "rim-by-light = 3", "rim-by-light = 6");
    batch();
    assert_eq!(row("ben")[2], "4");
}

#[test]
fn a_course_that_cannot_be_read_is_refused_with_its_place() {
    let lab = rim_light();
    lab.run(&["lab", "list", "--course", "nowhere"]).refused(&["nowhere", "no course.toml"]);
    let cases = [
        ("course/course.toml", "feedback =", "fedback =", ["course/course.toml:7:1:", "did you mean `feedback`?"]),
        (
            "course/rim-light/exercise.toml",
            "judge =",
            "judg =",
            ["course/rim-light/exercise.toml:1:1:", "how it is judged"],
        ),
        ("course/rim-light/mistakes.toml", "dot(N, V)", "dot(N, W)", ["mistakes.toml:17:", "occurs 0 times"]),
        (
            "course/rim-light/exercise.toml",
            "rim-by-light = 3",
            "rim-by-lite = 3",
            ["exercise.toml:", "did you mean `rim-by-light`?"],
        ),
    ];
    for (file, from, to, expected) in cases {
        let before = read(&lab, file);
        edit(&lab, file, from, to);
        lab.run(&["lab", "list", "--course", "course"]).refused(&expected);
        lab.write(file, before);
    }
    std::fs::remove_file(lab.path("course/rim-light/start.frag")).unwrap();
    lab.run(&["lab", "list", "--course", "course"]).refused(&["rim-light/start.frag", "no such file"]);
}

#[test]
fn a_new_course_overwrites_nothing() {
    let lab = rim_light();
    lab.run(&["course", "new", "course", "--from", "reference"]).refused(&["exists", "never overwritten"]);
    lab.run(&["course", "new", "other", "--from", "ex2"]).refused(&["ex2", "did you mean `ex", "reference"]);
    assert!(!lab.path("other").exists());
    let french = lab.run(&["course", "new", "cours", "--from", "reference", "--language", "fr"]).good();
    assert!(french.text().contains("gonio course verify cours"), "{}", french.text());
    assert!(read(&lab, "cours/rim-light/text.md").contains("Le liseré"));
    let wrong = lab
        .command(&[
            "lab",
            "check",
            "rim-light",
            "cours/rim-light/start.vert",
            "cours/rim-light/start.frag",
            "--course",
            "cours",
            "--language",
            "fr",
        ])
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert!(String::from_utf8(wrong.stdout).unwrap().contains("points sur 10"));
}
