//! Unsaved edits of scenes and of exercises: the time at which they are written, and the keys and ages of drafts.

use egui::Context;
use gonio_language::tr;
use std::time::Duration;
use web_time::{Instant, SystemTime, UNIX_EPOCH};

/// A crash loses at most the edits of this time.
const DELAY: Duration = Duration::from_secs(1);

/// The writing of drafts: at most [`DELAY`] after an edit, and at once when the window loses the focus.
#[derive(Default)]
pub struct DraftWriting {
    /// The time at which edits are written.
    pub(crate) due: Option<Instant>,
    /// The failure that was reported last, so that it is not reported every second.
    reported: Option<String>,
}

impl DraftWriting {
    /// Nothing is to be written any more.
    pub fn rest(&mut self) {
        self.due = None;
    }

    /// Whether edits are to be written now; called in every frame in which there are some. `ctx` is repainted when they are.
    pub fn is_due(&mut self, ctx: &Context) -> bool {
        let now = Instant::now();
        let due = *self.due.get_or_insert(now + DELAY);
        let waits = now < due && ctx.input(|input| input.focused);
        if waits {
            ctx.request_repaint_after(due - now);
        }
        !waits
    }

    /// Notes the failure of writing, if it failed. Returns whether it has to be reported.
    pub fn is_news(&mut self, failure: Option<&String>) -> bool {
        let is_news = failure != self.reported.as_ref();
        self.reported = failure.cloned();
        is_news && failure.is_some()
    }
}

/// FNV-1a, 64 bits: the same in every version of gonio and on every machine.
pub fn fingerprint(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
}

/// Sixteen digits.
pub fn hexadecimal(number: u64) -> String {
    format!("{number:016x}")
}

/// Seconds since 1970.
pub fn now() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs())
}

/// An age in words: "5 minutes ago".
pub fn in_words(age: Duration) -> String {
    let minutes = age.as_secs() / 60;
    match minutes {
        0 => tr!("exercise-less-than-a-minute-ago").to_owned(),
        1..60 => tr!("exercise-minutes-ago", count = minutes),
        60..1440 => tr!("exercise-hours-ago", count = minutes / 60),
        _ => tr!("exercise-days-ago", count = minutes / 1440),
    }
}
