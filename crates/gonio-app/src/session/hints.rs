//! Hints for first-time users, which go away with use.

use gonio_language::tr;
use serde::{Deserialize, Serialize};

/// Something that users may not find by themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UsageHint {
    /// Clicking a pixel probes it.
    Probe,
    /// Lamps can be dragged.
    Lamp,
    /// Terms are switches.
    Term,
}

impl UsageHint {
    /// All hints, in the order in which they are shown.
    pub const ALL: [UsageHint; 3] = [UsageHint::Probe, UsageHint::Lamp, UsageHint::Term];

    /// The hint in one sentence.
    pub fn sentence(self) -> &'static str {
        match self {
            UsageHint::Probe => tr!("window-tip-click-the-picture-to-see"),
            UsageHint::Lamp => tr!("window-tip-drag-a-lamp-in-the"),
            UsageHint::Term => tr!("window-tip-click-a-term-of-the"),
        }
    }
}
