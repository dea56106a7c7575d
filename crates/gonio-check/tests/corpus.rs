//! Checks the submissions of crates/gonio-check/corpus: the mistake that is named, and its line in the source.
//!
//! Tolerances: no false alarm at all; 97 % of single mistakes and 85 % of pairs are named. The project set them.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_check::ShaderChecker;
use gonio_check::dataflow::Shader;
use gonio_check::mistakes::{self, ModelSolution};
use gonio_check::roles::NamesFile;
use gonio_check::rules::Analysis;
use gonio_check::submission;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_fixtures::selected;
use gonio_gl::HeadlessContext;
use gonio_glsl::Stage;
use std::collections::BTreeMap;
use submissions::{Submission, submissions};

/// Returns a list of `expected.toml`.
fn list(submission: &Submission, key: &str) -> Vec<String> {
    let words = submission.expected.get(key).and_then(toml::Value::as_array).cloned().unwrap_or_default();
    words.iter().map(|word| word.as_str().unwrap().to_owned()).collect()
}

fn checker() -> (HeadlessContext, ShaderChecker) {
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let checker = ShaderChecker::new(context.gl());
    (context, checker)
}

#[test]
fn right_submissions_are_never_wrong() {
    let (_context, mut checker) = checker();
    let all = submissions("correct");
    assert!(all.len() > 160, "{}", all.len());
    for submission in selected(all, |submission| &submission.name) {
        let verdict = submission.check(&mut checker);
        assert_eq!(verdict.verdict, Outcome::Correct, "{}: {}", submission.name, verdict.summary);
    }
}

/// Whether the named mistakes are the expected ones, or ones that no picture distinguishes from them.
fn is_named(submission: &Submission, verdict: &Verdict) -> bool {
    let (expected, also) = (list(submission, "mistakes"), list(submission, "also_right"));
    let answers = |want: &String| {
        verdict.mistakes.iter().any(|found| found.id == *want || found.or.contains(want) || also.contains(&found.id))
    };
    verdict.mistakes.len() == expected.len() && expected.iter().all(answers)
}

#[test]
fn mistakes_are_named() {
    let (_context, mut checker) = checker();
    let (mut single, mut pairs, mut called) = ((0, 0), (0, 0), (0, 0));
    let mut missed = Vec::new();
    let all = submissions("wrong");
    let compiling: Vec<&Submission> = all.iter().filter(|s| s.expected.get("verdict").is_none()).collect();
    let pairs_found = compiling.iter().filter(|s| list(s, "mistakes").len() > 1).count();
    assert!(pairs_found > 30 && compiling.len() - pairs_found > 310, "{pairs_found} pairs of {}", compiling.len());
    for submission in selected(all, |submission| &submission.name) {
        let verdict = submission.check(&mut checker);
        let does_not_compile = submission.expected.get("verdict").is_some();
        let expected = if does_not_compile { Outcome::DoesNotCompile } else { Outcome::Wrong };
        called = (called.0 + usize::from(verdict.verdict == expected), called.1 + 1);
        if does_not_compile {
            continue;
        }
        let count = if list(&submission, "mistakes").len() > 1 { &mut pairs } else { &mut single };
        let named = is_named(&submission, &verdict);
        *count = (count.0 + usize::from(named), count.1 + 1);
        if !named {
            let found: Vec<&str> = verdict.mistakes.iter().map(|found| found.id.as_str()).collect();
            missed.push(format!("{}: {:?} {found:?}", submission.name, verdict.verdict));
        }
    }
    let reaches = |least: f64, (right, all): (usize, usize)| right as f64 >= least * all as f64;
    let report = format!("single {single:?}, pairs {pairs:?}, verdicts {called:?}\n{}", missed.join("\n"));
    assert!(reaches(0.95, called), "{report}");
    assert!(reaches(0.97, single), "{report}");
    assert!(reaches(0.85, pairs), "{report}");
}

#[test]
fn compiler_errors_are_reported_at_their_line() {
    let (_context, mut checker) = checker();
    let (mut right, mut all) = (0, 0);
    let mut missed = Vec::new();
    let broken: Vec<Submission> =
        submissions("wrong").into_iter().filter(|s| s.expected.get("verdict").is_some()).collect();
    assert!(broken.len() >= 15, "{}", broken.len());
    for submission in selected(broken, |submission| &submission.name) {
        let verdict = submission.check(&mut checker);
        let line = |key: &str| submission.expected.get(key).and_then(toml::Value::as_integer);
        let lines: Vec<i64> = verdict.messages.iter().filter_map(|m| m.line).map(i64::from).collect();
        let is_right = line("line").or(line("reported_line")).is_none()
            || [line("line"), line("reported_line")].into_iter().flatten().any(|line| lines.contains(&line));
        all += 1;
        right += usize::from(is_right);
        if !is_right {
            missed.push(format!("{}: {lines:?} {}", submission.name, verdict.summary));
        }
    }
    assert!(right * 100 >= all * 85, "{right} of {all}\n{}", missed.join("\n"));
}

struct Case {
    name: String,
    expected: toml::Table,
    submission: submission::Submission,
    model: ModelSolution,
}

impl Case {
    fn words(&self, key: &str) -> Vec<String> {
        let list = self.expected.get(key).and_then(toml::Value::as_array);
        list.into_iter().flatten().map(|word| word.as_str().expect("a word").to_owned()).collect()
    }

    fn places(&self) -> Vec<String> {
        let one = self.expected.get("file").zip(self.expected.get("line"));
        let one = one.map(|(file, line)| format!("{}:{line}", file.as_str().expect("a name")));
        one.into_iter().chain(self.words("places")).collect()
    }

    fn read(&self) -> Analysis {
        let mut vertex = gonio_glsl::parse(&self.submission.vertex.text);
        let mut fragment = gonio_glsl::parse(&self.submission.fragment.text);
        let vertex_checked = gonio_glsl::check(&mut vertex, Stage::Vertex);
        let fragment_checked = gonio_glsl::check(&mut fragment, Stage::Fragment);
        let names = self
            .submission
            .names
            .as_deref()
            .map_or_else(NamesFile::default, |text| NamesFile::parse(text).expect("names.toml"));
        Analysis::new(
            &Shader { parsed: &vertex, checked: &vertex_checked },
            &Shader { parsed: &fragment, checked: &fragment_checked },
            &names,
        )
    }

    /// Returns the `file:line` of a mistake.
    fn found(&self, source: &Analysis, id: &str) -> Option<String> {
        let place = source.line(id, self.model)?;
        let text = match place.stage {
            Stage::Vertex => &self.submission.vertex,
            Stage::Fragment => &self.submission.fragment,
        };
        let (file, line, _) = text.place(place.span.line, place.span.column);
        Some(format!("{file}:{line}"))
    }
}

fn model(exercise: &str) -> ModelSolution {
    match exercise {
        "ex01" => ModelSolution::Camera,
        "s1" => ModelSolution::Panorama,
        "ex03" | "ex05" => ModelSolution::Gouraud,
        "ex04" | "ex06" | "ex07" => ModelSolution::Phong,
        "ex08" => ModelSolution::Skybox,
        "ex09" => ModelSolution::Reflection,
        _ => ModelSolution::Refraction,
    }
}

fn cases(sort: &str) -> Vec<Case> {
    let read = |case: submissions::Submission| {
        let submission =
            submission::Submission::gather(case.files).unwrap_or_else(|error| panic!("{}: {error}", case.name));
        Case { name: case.name, expected: case.expected, submission, model: model(&case.exercise) }
    };
    submissions(sort).into_iter().map(read).collect()
}

fn wrong() -> Vec<Case> {
    cases("wrong").into_iter().filter(|case| !case.expected.contains_key("verdict")).collect()
}

#[test]
fn single_mistakes_are_found_at_their_lines() {
    let (mut right, mut silent, mut wrong_ones) = (0, Vec::new(), Vec::new());
    let cases: Vec<Case> = wrong().into_iter().filter(|case| case.words("mistakes").len() == 1).collect();
    for case in &cases {
        let id = &case.words("mistakes")[0];
        match case.found(&case.read(), id) {
            Some(found) if case.places().contains(&found) => right += 1,
            Some(found) => wrong_ones.push(format!("{} {id}: {found}, not {:?}", case.name, case.places())),
            None => silent.push(format!("{} {id}", case.name)),
        }
    }
    let report = format!("{right} right\nsilent: {silent:#?}\nwrong: {wrong_ones:#?}");
    let share = |count: usize| count as f64 / cases.len() as f64;
    assert!(cases.len() >= 200, "{}", cases.len());
    assert!(share(right) >= 0.96, "{report}");
    assert!(share(wrong_ones.len()) <= 0.02, "{report}");
}

#[test]
fn pairs_are_found_at_their_lines() {
    let (mut right, mut wrong_ones, mut all) = (0, Vec::new(), 0);
    for case in wrong().into_iter().filter(|case| case.words("mistakes").len() == 2) {
        let source = case.read();
        for id in case.words("mistakes") {
            all += 1;
            match case.found(&source, &id) {
                Some(found) if case.places().contains(&found) => right += 1,
                found => wrong_ones.push(format!("{} {id}: {found:?}, not {:?}", case.name, case.places())),
            }
        }
    }
    assert!(all >= 50, "{all}");
    assert!(right as f64 >= 0.9 * all as f64, "{right} of {all}: {wrong_ones:#?}");
}

/// Returns the mistakes of the model solution that the source supports most.
fn sure(case: &Case) -> Vec<String> {
    let source = case.read();
    let ids = mistakes::for_model(case.model).filter(|mistake| !mistake.harmless).map(|mistake| mistake.id.clone());
    ids.filter(|id| source.support(id, case.model) > 0.95).collect()
}

#[test]
fn the_source_of_right_submissions_shows_no_mistake() {
    let mut blamed: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let cases = cases("correct");
    assert!(cases.len() >= 60, "{}", cases.len());
    let mut right = 0;
    for case in &cases {
        let ids = sure(case);
        right += usize::from(ids.is_empty());
        for id in ids {
            blamed.entry(id).or_default().push(case.name.clone());
        }
    }
    assert!(right as f64 >= 0.9 * cases.len() as f64, "{right} of {}: {blamed:#?}", cases.len());
}

#[test]
fn constants_in_the_source_are_found() {
    for case in cases("correct") {
        let constants = case.read().constants();
        let peculiarities = case.words("peculiarities");
        let says = |word: &str| peculiarities.iter().any(|peculiarity| peculiarity == word);
        assert_eq!(constants.light_position.is_some(), says("light-position-written"), "{}: {constants:?}", case.name);
        assert_eq!(constants.shininess.is_some(), says("exponent-written"), "{}: {constants:?}", case.name);
        assert_eq!(constants.refraction_index.is_some(), says("index-written"), "{}: {constants:?}", case.name);
    }
}
