//! `gonio lab check --format`.

use crate::common::{EVIL, Lab, faults};
use crate::hand_in;
use serde_json::json;

#[test]
fn mistakes_are_lines_of_a_compiler_with_paths_from_the_current_folder() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "mine/shaders", "mat3(itM)", "mat3(M)");
    let run = lab.run(&["lab", "check", "ex04", "mine", "--format", "gcc"]);
    let line = 1 + String::from_utf8(lab.read("mine/shaders/reference.vert"))
        .unwrap()
        .lines()
        .position(|l| l.contains("mat3(M)"))
        .unwrap();
    let lines: Vec<&str> = run.text().lines().collect();
    let place = format!("mine/shaders/reference.vert:{line}: ");
    assert!(
        lines[0].starts_with(&format!("{place}error: ")) && lines[0].ends_with("[normal-by-model-matrix]"),
        "{lines:?}"
    );
    assert!(lines[1].starts_with(&format!("{place}note: ")) && run.code == 1, "{lines:?}");
    // A compiler says nothing about what is right.
    hand_in(&lab, "ex04", "right", "mat3(itM)", "mat3(itM)");
    assert_eq!(lab.run(&["lab", "check", "ex04", "right", "--format", "gcc"]).good().text(), "");
    // Files keep the paths that they were given by, and compilers' messages have columns.
    hand_in(&lab, "ex04", "broken", "mat3(itM) * normal", "mat3(itM) * norml");
    let files = ["./broken/reference.vert", "broken/reference.frag"];
    let run = lab.run(&["lab", "check", "ex04", files[0], files[1], "--format", "gcc"]);
    let first = run.text().lines().next().unwrap();
    let parts: Vec<&str> = first.split(':').collect();
    assert!(
        parts[0] == "broken/reference.vert" && parts[2].parse::<u32>().is_ok() && first.contains("norml"),
        "{first}"
    );
}

#[test]
fn github_gets_the_text_and_a_command_for_each_message() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "mine", "mat3(itM)", "mat3(M)");
    let run = lab.run(&["lab", "check", "ex04", "mine", "--format", "github"]);
    let (commands, text): (Vec<&str>, Vec<&str>) = run.text().lines().partition(|line| line.starts_with("::"));
    let is_it = |line: &&str| {
        line.starts_with("::error file=mine/reference.vert,line=") && line.contains(",title=normal-by-model-matrix::")
    };
    assert!(commands.iter().any(is_it) && run.code == 1, "{}", run.text());
    assert!(text.iter().any(|line| line.contains("normal-by-model-matrix")), "{}", run.text());
    // A file's name cannot become a command of its own.
    let evil = format!("{EVIL}.vert");
    std::fs::rename(lab.path("mine/reference.vert"), lab.path(&format!("mine/{}", evil.replace('/', "")))).unwrap();
    let run = lab.run(&["lab", "check", "ex04", "mine", "--format", "github"]);
    let others: Vec<&str> = run.text().lines().filter(|line| !line.starts_with("::error file=mine/\\x1b")).collect();
    assert_eq!(faults(others.join("\n").as_bytes(), false), Vec::<String>::new(), "{}", run.text());
    assert!(others.len() < run.text().lines().count(), "{}", run.text());
}

#[test]
fn sarif_has_a_rule_and_a_place_for_each_mistake() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "my work", "mat3(itM)", "mat3(M)");
    let check = |more: &[&str]| {
        lab.run(&[&["lab", "check", "ex04", "my work", "--format", "sarif"], more].concat()).json()["runs"][0].clone()
    };
    let run = check(&[]);
    assert_eq!(run["tool"]["driver"]["rules"][0], json!({ "id": "normal-by-model-matrix" }));
    let result = &run["results"][0];
    assert_eq!((&result["ruleId"], &result["level"]), (&"normal-by-model-matrix".into(), &"error".into()));
    let place = &result["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "my%20work/reference.vert");
    assert!(place["region"]["startLine"].as_u64().unwrap() > 1 && result.get("fixes").is_none(), "{result}");
    let fixes = &check(&["--feedback", "fix"])["results"][0]["fixes"];
    let replacement = &fixes[0]["artifactChanges"][0]["replacements"][0];
    assert_eq!(replacement["deletedRegion"]["startLine"], place["region"]["startLine"]);
    assert!(check(&["--feedback", "verdict"])["results"][0].get("locations").is_none());
}

#[test]
fn formats_that_exclude_each_other_are_refused() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "all/ann", "mat3(itM)", "mat3(M)");
    hand_in(&lab, "ex04", "all/ben", "mat3(itM)", "mat3(itM)");
    let check = |args: &[&str]| lab.run(&[&["lab", "check", "ex04"], args].concat());
    check(&["all/ann", "--json", "--format", "gcc"]).refused(&["--json", "--format gcc"]);
    check(&["all/ann", "--format", "sarif", "--junit", "-"]).refused(&["`-`", "--format sarif"]);
    check(&["all", "--format", "github"]).refused(&["--format", "2 submissions"]);
    check(&["all", "--watch"]).refused(&["--watch", "2 submissions"]);
    assert!(!lab.path("all-results").exists());
    // The same as --json, also for errors.
    let [long, short] = [&["all/ann", "--format", "json"][..], &["all/ann", "--json"]].map(|args| check(args).json());
    assert_eq!(long, short);
    assert!(check(&["nowhere", "--format", "json"]).json()["error"].as_str().unwrap().contains("nowhere"));
}
