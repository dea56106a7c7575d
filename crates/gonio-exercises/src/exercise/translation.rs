//! An exercise's texts in other languages than English.

use super::{Inputs, LookFor};
use serde::Deserialize;
use std::collections::BTreeMap;

/// An exercise's texts in one language, except the long one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Texts {
    /// The title.
    pub title: String,
    /// The task in one sentence.
    pub summary: String,
    /// Details to look for in the picture.
    pub look_for: Vec<LookFor>,
    /// The inputs.
    pub inputs: Inputs,
}

/// The table of a language in `exercise.toml`, such as `[fr]`.
#[derive(Deserialize)]
pub(super) struct Translation {
    title: String,
    summary: String,
    /// In the order of the English ones.
    #[serde(default)]
    look_for: Vec<String>,
    /// Attributes and uniforms by name.
    #[serde(default)]
    inputs: BTreeMap<String, TranslatedInput>,
}

#[derive(Deserialize)]
struct TranslatedInput {
    meaning: String,
    value: String,
}

impl Translation {
    /// The texts, in English where the translation has none.
    pub(super) fn of(self, english: &Texts) -> Texts {
        let Texts { mut look_for, mut inputs, .. } = english.clone();
        for (detail, text) in look_for.iter_mut().zip(self.look_for) {
            detail.text = text;
        }
        let variables = inputs.attributes.iter_mut().chain(&mut inputs.uniforms);
        let mut own = self.inputs;
        for (name, variable) in variables {
            if let Some(TranslatedInput { meaning, value }) = own.remove(name) {
                (variable.meaning, variable.value) = (meaning, value);
            }
        }
        Texts { title: self.title, summary: self.summary, look_for, inputs }
    }
}

#[cfg(test)]
mod tests;
