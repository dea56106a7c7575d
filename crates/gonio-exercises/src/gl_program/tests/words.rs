//! The words of the mistakes.

use crate::gl_program::{name_of, names};
use std::collections::BTreeSet;

const SUSPECTS: [&str; 5] = [
    include_str!("../suspects/arrays.rs"),
    include_str!("../suspects/picture.rs"),
    include_str!("../suspects/samplers.rs"),
    include_str!("../suspects/textures.rs"),
    include_str!("../suspects/vertices.rs"),
];
const TESTS: [&str; 2] = [include_str!("broken.rs"), include_str!("exercise.rs")];

#[test]
fn each_id_is_a_word_with_all_that_is_said_of_it() {
    let ids: BTreeSet<_> = names().iter().map(|name| name.id).collect();
    assert_eq!(ids.len(), names().len(), "no id stands twice");
    assert!(ids.len() >= 55, "{}", ids.len());
    for name in names() {
        assert!(name.id.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", name.id);
        for words in [name.name, name.explanation, name.looks_like, name.fix] {
            assert!(words.len() > 4 && !words.ends_with(' '), "{}: `{words}`", name.id);
        }
        assert!(!name.name.ends_with('.') && name.explanation.ends_with('.'), "{}", name.id);
    }
    assert_eq!(name_of("wrong-target").map(|name| name.id), Some("wrong-target"));
    assert_eq!(name_of("Wrong-Target"), None);
}

#[test]
fn each_id_is_suspected_somewhere_and_named_in_a_test() {
    let is_in = |texts: &[&str], id: &str| texts.iter().any(|text| text.contains(&format!("\"{id}\"")));
    let not_in = |texts: &[&str]| names().iter().map(|name| name.id).filter(|id| !is_in(texts, id)).collect::<Vec<_>>();
    assert_eq!(not_in(&SUSPECTS), [""; 0], "never suspected");
    assert_eq!(not_in(&TESTS), [""; 0], "in no test");
    // Kebab-case words in the suspicions are ids.
    let words = SUSPECTS.iter().flat_map(|text| text.split('"'));
    let is_id = |word: &&str| word.contains('-') && word.chars().all(|c| c.is_ascii_lowercase() || c == '-');
    let used: BTreeSet<&str> = words.filter(is_id).collect();
    assert!(used.len() >= 55);
    for id in used {
        assert!(name_of(id).is_some(), "{id} has no words");
    }
}
