use super::super::{Exercise, all};
use super::Translation;
use gonio_language::Language;
use std::collections::BTreeSet;

/// The parts of a Markdown text that do not depend on its language.
#[derive(Debug, Default, PartialEq, Eq)]
struct Shape<'a> {
    /// The number signs of each heading.
    headings: Vec<usize>,
    /// The number of lines of each block of code between fences.
    code_blocks: Vec<usize>,
    /// The indented lines of code.
    indented: Vec<&'a str>,
    /// The number of columns of each row of a table.
    rows: Vec<usize>,
    /// The number of items of lists.
    items: usize,
    /// Addresses of links and pictures.
    addresses: Vec<&'a str>,
    /// Commands: lines between fences that start with `gonio`.
    commands: Vec<&'a str>,
    /// Code within lines.
    code: BTreeSet<String>,
}

fn shape(text: &str) -> Shape<'_> {
    let mut shape = Shape::default();
    let mut prose = String::new();
    let mut is_code = false;
    for line in text.lines() {
        if line.starts_with("```") {
            is_code = !is_code;
            if is_code {
                shape.code_blocks.push(0);
            }
        } else if is_code {
            *shape.code_blocks.last_mut().unwrap() += 1;
            shape.commands.extend(line.starts_with("gonio").then_some(line));
        } else if line.starts_with("    ") {
            shape.indented.push(line);
        } else {
            let item = line.trim_start().split(' ').next().unwrap_or_default();
            let is_number = item.strip_suffix('.').is_some_and(|digits| digits.parse::<u32>().is_ok());
            shape.items += usize::from(item == "-" || is_number);
            if line.starts_with('#') {
                shape.headings.push(line.chars().take_while(|c| *c == '#').count());
            }
            if line.starts_with('|') {
                shape.rows.push(line.matches('|').count());
            }
            shape.addresses.extend(line.split("](").skip(1).filter_map(|rest| rest.split(')').next()));
            prose.push_str(line.trim_start());
            prose.push(' ');
        }
    }
    shape.code = prose.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    shape
}

/// Paragraphs, items and headings outside of blocks of code, each on one line.
fn sentences(text: &str) -> BTreeSet<String> {
    let without_code = text.lines().filter(|line| !line.starts_with("    ")).collect::<Vec<_>>().join("\n");
    let outside = without_code.split("```").step_by(2);
    let paragraphs = outside.flat_map(|part| part.split("\n\n")).flat_map(|paragraph| paragraph.split("\n- "));
    let joined = paragraphs.map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
    joined.filter(|paragraph| paragraph.split(' ').count() > 3).collect()
}

fn of_each(check: impl Fn(&Exercise, &str, &str)) {
    let mut checked = 0;
    for exercise in all() {
        let [english, french] = Language::ALL.map(|language| exercise.text_in(language));
        assert_ne!(english, french, "{}", exercise.id);
        check(exercise, english, french);
        checked += 1;
    }
    assert_eq!(checked, 14);
}

#[test]
fn a_french_text_has_the_structure_and_the_code_of_the_english_one() {
    of_each(|exercise, english, french| assert_eq!(shape(english), shape(french), "{}", exercise.id));
}

#[test]
fn no_sentence_of_a_french_text_is_english() {
    of_each(|exercise, english, french| {
        // Articles that are quoted are the same in every language, and so is a line of code.
        let is_quoted = |text: &String| {
            text.contains("Communications of the ACM") || text.contains("SIGGRAPH") || text.contains("IEEE")
        };
        let english = sentences(english);
        assert!(english.len() > 10, "{}: {}", exercise.id, english.len());
        for sentence in sentences(french).iter().filter(|text| !is_quoted(text) && !text.starts_with("gonio ")) {
            assert!(!english.contains(sentence), "{}: {sentence}", exercise.id);
            for word in [" the ", " and ", " which ", " with "] {
                let outside: String = sentence.split(['`', '"', '*']).step_by(2).collect();
                assert!(!outside.contains(word), "{}: {sentence}", exercise.id);
            }
        }
    });
}

#[test]
fn french_signs_have_a_no_break_space_before_them() {
    of_each(|exercise, _, french| {
        for line in french.split("```").step_by(2).flat_map(str::lines) {
            let prose: String = line.split('`').step_by(2).collect();
            for sign in [" : ", " ;", " !", " ?", "« "] {
                assert!(!format!("{prose} ").contains(sign), "{}: {line}", exercise.id);
            }
        }
    });
}

#[test]
fn every_exercise_has_its_short_texts_in_french() {
    for exercise in all() {
        let declared: toml::Table = toml::from_str(exercise.file("exercise.toml").unwrap()).unwrap();
        let own: Translation = declared["fr"].clone().try_into().unwrap_or_else(|error| panic!("{error}"));
        let [english, french] = Language::ALL.map(|language| exercise.texts_in(language));
        assert_ne!(english, french, "{}", exercise.id);
        for [one, other] in [[&english.title, &french.title], [&english.summary, &french.summary]] {
            // Baking is baking.
            assert!(one != other || one == "Baking", "{}: {one}", exercise.id);
        }
        assert_eq!(own.look_for.len(), english.look_for.len(), "{}", exercise.id);
        assert!(english.look_for.iter().zip(&french.look_for).all(|(one, other)| one != other), "{}", exercise.id);
        let names: BTreeSet<&String> = english.inputs.attributes.keys().chain(english.inputs.uniforms.keys()).collect();
        assert_eq!(own.inputs.keys().collect::<BTreeSet<_>>(), names, "{}", exercise.id);
        let meanings = |inputs: &super::Inputs| -> Vec<String> {
            inputs.attributes.values().chain(inputs.uniforms.values()).map(|input| input.meaning.clone()).collect()
        };
        let [english, french] = [english, french].map(|texts| meanings(&texts.inputs));
        assert!(english.iter().zip(&french).all(|(one, other)| one != other), "{}", exercise.id);
    }
}
