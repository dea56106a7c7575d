//! What is done with the work: pairs compiled as they are written, checks begun and heard, files saved and read again.

use super::check::request;
use super::preview::Preview;
use super::trials::{ContentKey, Trials};
use super::work::{ProgramFacts, Work};
use crate::platform::{Platform, TrialOutcome};
use crate::scene_view::drawing::PaneRenderer;
use egui::Context;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::ExerciseKind;
use gonio_exercises::preview::{Note, NoteKind, SubmittedPair};
use std::time::Duration;
use web_time::Instant;

/// After the last key a pair is compiled: sooner, and half-written words would be errors.
const PAUSE: Duration = Duration::from_millis(300);

/// What is under way.
#[derive(Default)]
pub struct Compiler {
    preview: Option<Preview>,
    /// The texts as they were seen last, and since when they are these.
    seen: Option<(Vec<SourceFile>, Instant)>,
    /// Those that were compiled.
    compiled: Option<Vec<SourceFile>>,
    trials: Trials,
    failed: bool,
}

impl Compiler {
    /// What is on the GPU.
    pub fn preview(&self) -> Option<&Preview> {
        self.preview.as_ref()
    }

    /// What is on the GPU, to be drawn.
    pub fn preview_mut(&mut self) -> Option<&mut Preview> {
        self.preview.as_mut()
    }

    /// Forgets what lay on the GPU; it is made anew when there is one.
    pub fn release(&mut self) {
        (self.preview, self.compiled, self.failed) = (None, None, false);
    }

    /// Other files are open: they are compiled at once, not after a pause.
    pub fn begin_anew(&mut self) {
        self.seen = None;
    }

    /// To be called in every frame: compiles what was written a moment ago, and hears what came of checks.
    pub fn follow(
        &mut self,
        ctx: &Context,
        work: &mut Work,
        pane_renderer: Option<&PaneRenderer>,
        platform: &mut dyn Platform,
        said: &mut Vec<String>,
    ) {
        if let (None, Some(pane_renderer), false) = (&self.preview, pane_renderer, self.failed) {
            match Preview::new(pane_renderer.gl(), work) {
                Ok(preview) => self.preview = Some(preview),
                Err(why) => {
                    // Told once, not in every frame.
                    self.failed = true;
                    said.push(why.to_string());
                }
            }
        }
        work.downloads = !platform.has_folders();
        self.hear(work);
        self.announce_trial(ctx, work);
        let content = work.content();
        match &self.seen {
            Some((seen, since)) if *seen == content => {
                let waited = since.elapsed();
                if self.compiled.as_ref() != Some(&content) && waited < PAUSE && !self.is_tried(&content) {
                    ctx.request_repaint_after(PAUSE - waited);
                    return;
                }
            }
            // What was opened, or undone, is compiled at once; what is being written, after a pause.
            seen => {
                let is_first = seen.is_none();
                self.seen = Some((content.clone(), Instant::now()));
                // The one that is running is of a text that was changed.
                self.trials.cancel();
                work.program.is_tried = false;
                if !is_first && !self.is_tried(&content) {
                    ctx.request_repaint_after(PAUSE);
                    return;
                }
            }
        }
        if self.compiled.as_ref() != Some(&content) {
            self.compile(ctx, work, content, platform);
        }
    }

    fn is_tried(&self, content: &[SourceFile]) -> bool {
        self.trials.known(ContentKey::new(content)).is_some()
    }

    /// Says that a trial is running only if it takes long: otherwise the words would flash up at each change.
    fn announce_trial(&self, ctx: &Context, work: &mut Work) {
        let slow = self.trials.slow();
        work.program.is_trial_slow = slow == Some(Ok(()));
        if let Some(Err(left)) = slow {
            ctx.request_repaint_after(left);
        }
    }

    fn compile(&mut self, ctx: &Context, work: &mut Work, content: Vec<SourceFile>, platform: &mut dyn Platform) {
        if work.exercise.kind != ExerciseKind::Shaders {
            self.compiled = Some(content);
            return;
        }
        let key = ContentKey::new(&content);
        let outcome = self.trials.known(key).cloned();
        if let Some(TrialOutcome::Refused(why)) = outcome {
            self.compiled = Some(content);
            return refuse(work, why);
        }
        // The exercise's own files are harmless.
        if outcome.is_none() && platform.tries_every_pair() && !is_start(work, &content) {
            return self.try_first(ctx, work, key, &content, platform);
        }
        let source = match SubmittedPair::gather(work.exercise, content.clone()) {
            Ok(source) => source,
            Err(why) => {
                self.compiled = Some(content);
                return refuse(work, why);
            }
        };
        match outcome {
            None if source.is_risky() => return self.try_first(ctx, work, key, &content, platform),
            Some(TrialOutcome::Unavailable(why)) if source.is_risky() => {
                self.compiled = Some(content);
                return refuse(work, format!("This shader is not drawn because it could not be tested: {why}"));
            }
            Some(_) | None => {}
        }
        self.compiled = Some(content);
        let Some(preview) = &mut self.preview else {
            // To be compiled when there is something to draw with.
            self.compiled = None;
            return;
        };
        let variables = std::mem::take(&mut work.program.variables);
        work.program = match preview.compile(&source) {
            Ok(pair) => ProgramFacts {
                notes: pair.notes.clone(),
                warnings: pair.warnings.clone(),
                unusable: (!pair.has_position()).then(|| {
                    "Nothing is drawn: no attribute was recognised as the position. Name it `position`, or declare it in \
                     names.toml"
                        .to_owned()
                }),
                is_drawn: true,
                ..ProgramFacts::default()
            },
            Err(notes) => {
                let is_drawn = work.program.is_drawn;
                ProgramFacts {
                    notes: without_repeats(notes),
                    is_drawn,
                    is_old: is_drawn,
                    variables,
                    ..ProgramFacts::default()
                }
            }
        };
    }

    /// Begins a trial, unless it is running already; the pair is compiled when that has ended.
    fn try_first(
        &mut self,
        ctx: &Context,
        work: &mut Work,
        key: ContentKey,
        content: &[SourceFile],
        platform: &mut dyn Platform,
    ) {
        if !self.trials.is_running(key) {
            self.trials.start(key, platform.trial(request(work, content), ctx));
            work.program.is_tried = true;
            work.trials += 1;
        }
    }

    /// What came of the trial and of the check.
    fn hear(&mut self, work: &mut Work) {
        self.trials.poll();
        work.program.is_tried = self.trials.slow().is_some();
    }
}

/// There is no pair, or none that may be drawn here: the last one that was drawn stays.
fn refuse(work: &mut Work, why: String) {
    let is_drawn = work.program.is_drawn;
    let variables = std::mem::take(&mut work.program.variables);
    work.program =
        ProgramFacts { unusable: Some(why), is_drawn, is_old: is_drawn, variables, ..ProgramFacts::default() };
}

/// Whether these are the files that the exercise is begun with, unchanged.
fn is_start(work: &Work, content: &[SourceFile]) -> bool {
    let start = work.exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    start.eq(content.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())))
}

/// What both compilers say of a line is said once.
fn without_repeats(notes: Vec<Note>) -> Vec<Note> {
    let mut kept: Vec<Note> = Vec::new();
    for note in notes {
        let is_known = kept.iter().any(|known| known.kind == NoteKind::Error && known.message == note.message);
        if !is_known {
            kept.push(note);
        }
    }
    kept
}
