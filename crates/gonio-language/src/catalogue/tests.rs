//! Every language has the same texts with the same arguments.

use super::*;
use fluent_syntax::ast::{Entry, Expression, InlineExpression, Pattern, PatternElement, Resource};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The names of the variables of each text.
type Variables = BTreeMap<String, BTreeSet<String>>;

fn parsed(file: &'static str) -> Resource<&'static str> {
    fluent_syntax::parser::parse(file).unwrap_or_else(|(_, errors)| {
        let at = errors.first().map_or(0, |error| error.pos.start);
        panic!("{:?}: {:?}", &file[at..(at + 80).min(file.len())], errors.first())
    })
}

fn of_inline(inline: &InlineExpression<&str>, found: &mut BTreeSet<String>) {
    match inline {
        InlineExpression::VariableReference { id } => {
            found.insert(id.name.to_owned());
        }
        InlineExpression::Placeable { expression } => of_expression(expression, found),
        InlineExpression::FunctionReference { arguments, .. } => {
            arguments.positional.iter().for_each(|argument| of_inline(argument, found));
        }
        _ => {}
    }
}

fn of_expression(expression: &Expression<&str>, found: &mut BTreeSet<String>) {
    match expression {
        Expression::Inline(inline) => of_inline(inline, found),
        Expression::Select { selector, variants } => {
            of_inline(selector, found);
            variants.iter().for_each(|variant| of_pattern(&variant.value, found));
        }
    }
}

fn of_pattern(pattern: &Pattern<&str>, found: &mut BTreeSet<String>) {
    for element in &pattern.elements {
        if let PatternElement::Placeable { expression } = element {
            of_expression(expression, found);
        }
    }
}

fn variables(file: &'static str) -> Variables {
    let mut found = Variables::new();
    for entry in parsed(file).body {
        let Entry::Message(message) = entry else { continue };
        let mut add = |id: String, pattern: &Pattern<&str>| {
            let mut names = BTreeSet::new();
            of_pattern(pattern, &mut names);
            assert!(found.insert(id.clone(), names).is_none(), "{id} occurs twice");
        };
        if let Some(pattern) = &message.value {
            add(message.id.name.to_owned(), pattern);
        }
        for attribute in &message.attributes {
            add(format!("{}.{}", message.id.name, attribute.id.name), &attribute.value);
        }
    }
    found
}

#[test]
fn every_language_has_the_same_texts_with_the_same_arguments() {
    // The code has English names.
    for (index, name) in NAMES.iter().enumerate().filter(|(_, name)| **name != "names") {
        let english = variables(files(Language::English)[index]);
        for language in Language::ALL {
            let others = variables(files(language)[index]);
            for (id, names) in &english {
                assert_eq!(others.get(id), Some(names), "{}/{name}.ftl: {id}", language.code());
            }
            let unknown: Vec<&String> = others.keys().filter(|id| !english.contains_key(*id)).collect();
            assert!(unknown.is_empty(), "{}/{name}.ftl: {unknown:?}", language.code());
        }
    }
}

#[test]
fn ids_are_those_that_the_parser_finds() {
    for file in Language::ALL.into_iter().flat_map(files) {
        let found: BTreeSet<String> = ids(file).into_iter().collect();
        let missing: Vec<String> = variables(file).into_keys().filter(|id| !found.contains(id)).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}

#[test]
fn no_file_of_a_language_is_left_out() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("locales");
    for language in Language::ALL {
        let files = std::fs::read_dir(folder.join(language.code())).unwrap();
        let names: BTreeSet<String> = files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
        assert_eq!(names, NAMES.iter().map(|name| format!("{name}.ftl")).collect(), "{language:?}");
    }
}

#[test]
fn an_unknown_text_is_its_id() {
    assert_eq!(text(Language::French, "no-such-text"), "no-such-text");
    assert_eq!(formatted(Language::French, "no-such-text", &FluentArgs::new()), "no-such-text");
}

#[test]
fn a_number_selects_a_plural() {
    let text = |count| {
        let mut arguments = FluentArgs::new();
        arguments.set("count", count);
        [Language::English, Language::French].map(|language| formatted(language, "test-scenes", &arguments))
    };
    assert_eq!(text("1"), ["1 test scene", "1 scène de test"]);
    assert_eq!(text("0"), ["0 test scenes", "0 scène de test"]);
    assert_eq!(text("12"), ["12 test scenes", "12 scènes de test"]);
}

#[test]
fn every_message_is_found_and_none_refers_to_another() {
    for language in Language::ALL {
        for file in files(language) {
            let all: Vec<(&str, &str)> = messages(file).collect();
            let of_messages: Vec<String> = all.iter().flat_map(|(_, source)| ids(source)).collect();
            assert_eq!(of_messages, ids(file));
            for (id, source) in all {
                assert!(source.starts_with(id), "{id}: {source}");
                let is_alone = |inline: &InlineExpression<&str>| {
                    !matches!(
                        inline,
                        InlineExpression::MessageReference { .. } | InlineExpression::TermReference { .. }
                    )
                };
                let mut elements = Vec::new();
                for entry in parsed(source).body {
                    let Entry::Message(message) = entry else { panic!("{id} is not a message: {entry:?}") };
                    elements.extend(message.value.into_iter().flat_map(|pattern| pattern.elements));
                    elements.extend(message.attributes.into_iter().flat_map(|attribute| attribute.value.elements));
                }
                for element in elements {
                    let PatternElement::Placeable { expression: Expression::Inline(inline) } = element else {
                        continue;
                    };
                    assert!(is_alone(&inline), "{id} refers to another message: {inline:?}");
                }
            }
        }
    }
}
