//! `gonio course verify`.

use crate::common::Run;
use crate::{edit, light_equation, read, rim_light};
use serde_json::Value;

/// The measurement of the only exercise.
fn measured(run: &Run) -> Value {
    run.json()[0].clone()
}

#[test]
fn new_courses_verify_as_they_are() {
    for lab in [rim_light(), light_equation()] {
        let run = lab.run(&["course", "verify", "course", "--mutants", "30", "--json"]);
        let found = measured(&run);
        assert_eq!(run.code, 0, "{found}");
        assert_eq!((&found["reference"], &found["start"]), (&"correct".into(), &"wrong".into()));
        let number = |key: &str| found[key].as_u64().unwrap();
        assert!(number("visible") >= 20 && number("called_wrong") * 20 >= number("visible") * 19, "{found}");
        assert!(number("rewrites") >= 8 && found["false_alarms"] == serde_json::json!([]), "{found}");
        for mistake in found["own_mistakes"].as_array().unwrap() {
            assert!(mistake["is_named"] == true && mistake["has_line"] == true, "{mistake}");
        }
    }
}

#[test]
fn a_mutant_of_a_model_solution_has_a_name_or_the_right_line() {
    let lab = light_equation();
    let found = measured(&lab.run(&["course", "verify", "course", "--mutants", "30", "--json"]));
    let number = |key: &str| found[key].as_u64().unwrap();
    // Most mutants are no mistake of the catalogue; their line is found nevertheless.
    assert!(number("right_line") * 10 >= number("called_wrong") * 8, "{found}");
    assert!(number("named") * 3 >= number("called_wrong"), "{found}");
}

#[test]
fn what_is_wrong_with_an_exercise_is_said_and_fails() {
    let lab = rim_light();
    let verify = || lab.run(&["course", "verify", "course", "rim-light", "--mutants", "8"]);
    // Two mistakes that no picture tells apart are both named; one that changes nothing is not.
    let before = read(&lab, "course/rim-light/mistakes.toml");
    edit(&lab, "course/rim-light/mistakes.toml", "write = \"v_normal\"", "write = \"normalize(normalize(v_normal))\"");
    let run = verify();
    assert!(run.code == 1 && run.text().contains("not named: normal-not-renormalised"), "{}", run.text());
    lab.write("course/rim-light/mistakes.toml", before);
    // Start files that are the answer.
    let start = read(&lab, "course/rim-light/start.frag");
    lab.write("course/rim-light/start.frag", read(&lab, "course/rim-light/reference.frag"));
    lab.write("course/rim-light/start.vert", read(&lab, "course/rim-light/reference.vert"));
    let run = verify();
    assert!(run.code == 1 && run.text().contains("bad   the files to start from are not"), "{}", run.text());
    lab.write("course/rim-light/start.frag", start);
    lab.write("course/rim-light/solution.frag", "void main() {}");
    let run = verify();
    assert!(run.text().contains("not used and not handed out: solution.frag"), "{}", run.text());
}

#[test]
fn a_reference_that_is_wrong_for_its_judge_fails() {
    let lab = light_equation();
    edit(
        &lab,
        "course/light-equation/reference.frag",
        "attenuation * (diffuse + specular)",
        "attenuation * diffuse + specular",
    );
    let run = lab.run(&["course", "verify", "course", "--mutants", "1", "--json"]);
    let found = measured(&run);
    assert!(run.code == 1 && found["reference"] == "wrong", "{found}");
    assert!(!found["reference_summary"].as_str().unwrap().is_empty());
}

#[test]
fn an_exercise_is_found_from_within_its_course() {
    let lab = rim_light();
    let run = |args: &[&str]| Run::of(lab.command(args).current_dir(lab.path("course")).output().unwrap());
    run(&["course", "verify", "rim-light", "--mutants", "2"]).good();
    run(&["course", "verify", "rim-lite"]).refused(&["no exercise `rim-lite`", "rim-light"]);
    lab.run(&["course", "verify", "nowhere"]).refused(&["no course.toml in `nowhere`"]);
}
