//! The line of each mistake in the corpus of submissions.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_check::dataflow::Shader;
use gonio_check::mistakes::{self, Model};
use gonio_check::roles::NamesFile;
use gonio_check::rules::Analysis;
use gonio_check::submission::Submission;
use gonio_glsl::Stage;
use std::collections::BTreeMap;
use submissions::submissions;

struct Case {
    name: String,
    expected: toml::Table,
    submission: Submission,
    model: Model,
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

    /// `file:line` of an answer.
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

fn model(exercise: &str) -> Model {
    match exercise {
        "ex01" => Model::Camera,
        "s1" => Model::Panorama,
        "ex03" | "ex05" => Model::Gouraud,
        "ex04" | "ex06" | "ex07" => Model::Phong,
        "ex08" => Model::Skybox,
        "ex09" => Model::Reflection,
        _ => Model::Refraction,
    }
}

fn cases(sort: &str) -> Vec<Case> {
    let read = |case: submissions::Submission| {
        let submission = Submission::gather(case.files).unwrap_or_else(|error| panic!("{}: {error}", case.name));
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

/// Of the ids of the model, those that the source is sure of.
fn sure(case: &Case) -> Vec<String> {
    let source = case.read();
    let ids = mistakes::for_model(case.model).filter(|mistake| !mistake.harmless).map(|mistake| mistake.id.clone());
    ids.filter(|id| source.support(id, case.model) > 0.95).collect()
}

#[test]
fn what_is_right_does_not_look_wrong() {
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
fn constants_where_uniforms_could_be_are_found() {
    for case in cases("correct") {
        let written = case.read().written();
        let peculiarities = case.words("peculiarities");
        let says = |word: &str| peculiarities.iter().any(|peculiarity| peculiarity == word);
        assert_eq!(written.light_position.is_some(), says("light-position-written"), "{}: {written:?}", case.name);
        assert_eq!(written.shininess.is_some(), says("exponent-written"), "{}: {written:?}", case.name);
        assert_eq!(written.refraction_index.is_some(), says("index-written"), "{}: {written:?}", case.name);
    }
}
