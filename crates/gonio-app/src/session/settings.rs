//! Settings that are kept between sessions.

use super::UsageHint;
use gonio_check::verdict::Outcome;
use gonio_language::Language;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// Settings on disk, or in the browser's storage.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Whether the theme is dark; `None` follows the system.
    pub dark: Option<bool>,
    /// The language; `None` follows the system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub language: Option<Language>,
    /// Whether the ground below the objects is switched off.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub hides_ground: bool,
    /// Recently opened files, the latest first.
    pub recent: Vec<String>,
    /// The settings of the last bake as JSON, which is parsed when they are shown; `None` before the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bake: Option<String>,
    /// The outcome of the last check of each exercise, by id.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub outcomes: BTreeMap<String, Outcome>,
    /// The hints that are not shown any more, because the user has done what they say.
    #[serde(skip_serializing_if = "BTreeSet::is_empty")]
    pub learned: BTreeSet<UsageHint>,
}

impl Settings {
    /// Largest number of recent files.
    pub const MOST_RECENT: usize = 8;

    /// Adds a file at the front.
    pub fn opened(&mut self, input: String) {
        self.recent.retain(|known| *known != input);
        self.recent.insert(0, input);
        self.recent.truncate(Self::MOST_RECENT);
    }

    /// The hint to show now, if any is left.
    pub fn hint(&self) -> Option<UsageHint> {
        UsageHint::ALL.into_iter().find(|hint| !self.learned.contains(hint))
    }

    /// Parses stored settings; damaged ones are replaced by defaults.
    pub fn from_text(text: &str) -> Self {
        serde_json::from_str(text).unwrap_or_default()
    }

    /// Serialises the settings.
    pub fn to_text(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_files_are_listed_once_latest_first() {
        let mut settings = Settings::default();
        for number in 0..20 {
            settings.opened(format!("{}.obj", number % 10));
        }
        assert_eq!(settings.recent.len(), Settings::MOST_RECENT);
        assert_eq!(settings.recent[..2], ["9.obj", "8.obj"]);
    }

    #[test]
    fn settings_survive_a_round_trip_and_damaged_ones_are_defaults() {
        let outcomes = BTreeMap::from([("ex04".to_owned(), Outcome::Wrong)]);
        let learned = BTreeSet::from([UsageHint::Probe]);
        let settings = Settings {
            dark: Some(true),
            language: Some(Language::French),
            hides_ground: true,
            recent: vec!["a b.obj".into()],
            bake: Some("{}".into()),
            outcomes,
            learned,
        };
        assert_eq!(Settings::from_text(&settings.to_text()), settings);
        assert_eq!((Settings::default().hint(), settings.hint()), (Some(UsageHint::Probe), Some(UsageHint::Lamp)));
        assert_eq!(Settings::from_text("{\"dark\": 3}"), Settings::default());
        assert_eq!(Settings::from_text("{}"), Settings::default());
    }
}
