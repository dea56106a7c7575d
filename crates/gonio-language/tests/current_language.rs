//! The current language is one per process, so this test has a process of its own.

use gonio_language::{Language, tr};

#[test]
fn texts_are_in_the_current_language() {
    assert_eq!(tr!("language-name"), "English");
    Language::French.make_current();
    assert_eq!(tr!("language-name"), "français");
    assert_eq!(Language::English.own_name(), "English");
}
