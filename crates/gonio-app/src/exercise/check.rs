//! The check of the files in the editor, and trials of its shaders.
//!
//! One trial runs at a time. Outcomes are remembered, so that undoing a change shows its picture at once.

use super::work::{ExercisePage, Judged, Work};
use crate::platform::{CheckRequest, CheckResult, Pending, Platform, TrialOutcome};
use egui::Context;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Outcome;
use gonio_exercises::buffers;
use gonio_exercises::exercise::ExerciseKind;
use std::collections::{HashMap, VecDeque};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::Duration;
use web_time::Instant;

/// The running check, with the texts that it checks.
#[derive(Default)]
pub struct Check {
    /// Whether the platform knows that checks may follow.
    is_expected: bool,
    running: Option<(Vec<SourceFile>, Box<dyn Pending<CheckResult>>)>,
}

impl Check {
    /// Announces to the platform, once, that checks may follow.
    pub fn expect(&mut self, platform: &mut dyn Platform) {
        if !std::mem::replace(&mut self.is_expected, true) {
            platform.expect_check();
        }
    }

    /// Starts a check of the files in the editor.
    pub fn start(&mut self, ctx: &Context, work: &mut Work, platform: &mut dyn Platform) {
        let content = work.content();
        self.running = Some((content.clone(), platform.check(request(work, &content), ctx)));
        work.checking = true;
        work.page = ExercisePage::Verdict;
    }

    /// Stops waiting for the verdict.
    pub fn stop(&mut self, work: &mut Work) {
        self.running = None;
        work.checking = false;
    }

    /// Shows the verdict once it has arrived. Returns its outcome then.
    pub fn poll(&mut self, work: &mut Work) -> Option<Outcome> {
        if let Some((_, pending)) = &mut self.running
            && let Some(verdict) = pending.poll()
            && let Some((of, _)) = self.running.take()
        {
            let outcome = verdict.as_ref().ok().map(|verdict| verdict.verdict);
            work.take_verdict(Judged { verdict, of });
            return outcome;
        }
        None
    }
}

/// The files that a check or a trial gets.
pub fn request(work: &Work, content: &[SourceFile]) -> CheckRequest {
    // If there are several OpenGL programs or buffers, the one in the editor is checked.
    let endings: &[&str] = match work.exercise.kind {
        ExerciseKind::GlProgram => &[".txt"],
        ExerciseKind::Buffers => &buffers::ENDINGS,
        ExerciseKind::Shaders | ExerciseKind::Faces | ExerciseKind::Baking => &[],
    };
    let is_one = |name: &str| endings.iter().any(|ending| name.to_ascii_lowercase().ends_with(ending));
    let in_editor = work.files.get(work.current).map(|file| file.name.as_str()).filter(|name| is_one(name));
    let is_meant = |name: &str| in_editor.is_none_or(|meant| meant == name || !is_one(name));
    // A submission of pictures alone may consist of one picture.
    let is_paper = |name: &str| name.ends_with(".svg") && work.exercise.file(name).is_some();
    let meant = content.iter().filter(|file| is_meant(&file.name) && !is_paper(&file.name));
    let files = meant.map(|file| (file.name.clone(), file.bytes.clone())).collect();
    CheckRequest { exercise: work.exercise.id.clone(), files, as_the_lab: work.as_the_lab }
}

/// Outcomes that are remembered.
const MOST_KNOWN: usize = 256;
/// A trial that takes longer is announced over the picture.
const SLOW: Duration = Duration::from_millis(1000);

/// The texts of a pair, by their hash.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ContentKey(u64);

impl ContentKey {
    /// The key of these files.
    pub fn new(files: &[SourceFile]) -> Self {
        let mut hasher = DefaultHasher::new();
        for file in files {
            (&file.name, &file.bytes).hash(&mut hasher);
        }
        ContentKey(hasher.finish())
    }
}

struct Running {
    key: ContentKey,
    since: Instant,
    trial: Box<dyn Pending<TrialOutcome>>,
}

/// The trial that is running, and the outcomes of earlier ones.
#[derive(Default)]
pub struct Trials {
    running: Option<Running>,
    known: HashMap<ContentKey, TrialOutcome>,
    /// The keys in `known`, the oldest first.
    order: VecDeque<ContentKey>,
}

impl Trials {
    /// The outcome for these files, if they were tried.
    pub fn known(&self, key: ContentKey) -> Option<&TrialOutcome> {
        self.known.get(&key)
    }

    /// Whether these files are being tried now.
    pub fn is_running(&self, key: ContentKey) -> bool {
        self.running.as_ref().is_some_and(|running| running.key == key)
    }

    /// `Ok` if the trial takes so long that it should be announced; otherwise the time until then. `None` without a trial.
    pub fn slow(&self) -> Option<Result<(), Duration>> {
        let left = SLOW.saturating_sub(self.running.as_ref()?.since.elapsed());
        Some(if left.is_zero() { Ok(()) } else { Err(left) })
    }

    /// Waits for this trial and ends the one before.
    pub fn start(&mut self, key: ContentKey, trial: Box<dyn Pending<TrialOutcome>>) {
        self.running = Some(Running { key, since: Instant::now(), trial });
    }

    /// Ends the trial: its files were changed.
    pub fn cancel(&mut self) {
        self.running = None;
    }

    /// Remembers the outcome if the trial has one.
    pub fn poll(&mut self) {
        let Some(running) = &mut self.running else { return };
        let Some(outcome) = running.trial.poll() else { return };
        let key = running.key;
        self.running = None;
        if self.known.insert(key, outcome).is_none() {
            self.order.push_back(key);
        }
        if self.order.len() > MOST_KNOWN
            && let Some(oldest) = self.order.pop_front()
        {
            self.known.remove(&oldest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::platform::Ready;

    fn key(number: usize) -> ContentKey {
        ContentKey::new(&[SourceFile::new("a.frag", number.to_string())])
    }

    #[test]
    fn outcomes_are_remembered_and_the_oldest_forgotten() {
        let mut trials = Trials::default();
        for number in 0..=MOST_KNOWN {
            trials.start(key(number), Box::new(Ready::new(TrialOutcome::Refused(number.to_string()))));
            assert!(trials.is_running(key(number)) && trials.known(key(number)).is_none());
            trials.poll();
            assert!(!trials.is_running(key(number)));
        }
        assert_eq!(trials.known(key(0)), None);
        assert_eq!(trials.known(key(1)), Some(&TrialOutcome::Refused("1".into())));
        assert_eq!((trials.known.len(), trials.order.len()), (MOST_KNOWN, MOST_KNOWN));
    }

    #[test]
    fn names_and_contents_make_a_key() {
        let file = |name: &str, text: &str| SourceFile::new(name, text);
        let keys = [
            vec![file("a", "bc")],
            vec![file("ab", "c")],
            vec![file("a", "b"), file("c", "")],
            vec![file("c", ""), file("a", "b")],
        ]
        .map(|files| ContentKey::new(&files));
        for (index, key) in keys.iter().enumerate() {
            assert!(!keys[..index].contains(key), "{index}");
        }
    }

    #[test]
    fn a_new_trial_ends_the_one_before() {
        let mut trials = Trials::default();
        trials.start(key(1), Box::new(Ready::new(TrialOutcome::Harmless)));
        trials.start(key(2), Box::new(Ready::new(TrialOutcome::Harmless)));
        assert!(!trials.is_running(key(1)));
        trials.poll();
        assert_eq!((trials.known(key(1)), trials.known(key(2))), (None, Some(&TrialOutcome::Harmless)));
        trials.start(key(3), Box::new(Ready::new(TrialOutcome::Harmless)));
        trials.cancel();
        trials.poll();
        assert_eq!(trials.known(key(3)), None);
    }
}
