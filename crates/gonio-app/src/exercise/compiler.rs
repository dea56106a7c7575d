//! Compiles the shaders in the editor while they are being written.

use super::check::{ContentKey, Trials, request};
use super::preview::Preview;
use super::work::{ProgramFacts, Work};
use crate::platform::{Platform, TrialOutcome};
use crate::scene_view::drawing::PaneRenderer;
use egui::Context;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::ExerciseKind;
use gonio_exercises::preview::{Note, NoteKind, SubmittedPair};
use gonio_exercises::step::endless_loop;
use gonio_language::tr;
use std::time::Duration;
use web_time::Instant;

/// Time after the last key until a pair is compiled. With less, half-written words would be reported as errors.
const PAUSE: Duration = Duration::from_millis(300);

/// Compiles the pair of shaders, after a trial if needed.
#[derive(Default)]
pub struct Compiler {
    preview: Option<Preview>,
    /// The last texts, and when they changed.
    seen: Option<(Vec<SourceFile>, Instant)>,
    /// The texts that were compiled.
    compiled: Option<Vec<SourceFile>>,
    trials: Trials,
    failed: bool,
}

impl Compiler {
    /// The preview.
    pub fn preview(&self) -> Option<&Preview> {
        self.preview.as_ref()
    }

    /// The preview, for drawing.
    pub fn preview_mut(&mut self) -> Option<&mut Preview> {
        self.preview.as_mut()
    }

    /// Drops everything on the GPU; it is created again in the next context.
    pub fn release(&mut self) {
        (self.preview, self.compiled, self.failed) = (None, None, false);
    }

    /// Compiles at once, without a pause: other files were opened.
    pub fn restart(&mut self) {
        self.seen = None;
    }

    /// Compiles texts that have not changed for a moment; called in every frame.
    pub fn follow(
        &mut self,
        ctx: &Context,
        work: &mut Work,
        pane_renderer: Option<&PaneRenderer>,
        platform: &mut dyn Platform,
        failures: &mut Vec<String>,
    ) {
        if let (None, Some(pane_renderer), false) = (&self.preview, pane_renderer, self.failed) {
            match Preview::new(pane_renderer.gl(), work) {
                Ok(preview) => self.preview = Some(preview),
                Err(reason) => {
                    // Reported once, not in every frame.
                    self.failed = true;
                    failures.push(reason.to_string());
                }
            }
        }
        work.downloads = !platform.has_folders();
        self.take_outcome(work);
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
            // Opened or undone texts are compiled at once, typed ones after a pause.
            seen => {
                let is_first = seen.is_none();
                self.seen = Some((content.clone(), Instant::now()));
                // The running trial is of an older text.
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

    /// Announces a trial only if it takes long, so that the caption does not flash at each change.
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
        if let Some(TrialOutcome::Refused(reason)) = outcome {
            let pair = SubmittedPair::gather(work.exercise, content.clone()).ok();
            let found = pair.and_then(|pair| endless_loop(work.exercise, &pair));
            self.compiled = Some(content);
            let Some(found) = found else { return refuse(work, reason) };
            refuse(work, tr!("exercise-not-drawn", found = found));
            work.program.notes.push(Note { kind: NoteKind::Error, message: found.message() });
            return;
        }
        // The exercise's own files are harmless.
        if outcome.is_none() && platform.tries_every_pair() && !is_start(work, &content) {
            return self.try_first(ctx, work, key, &content, platform);
        }
        let source = match SubmittedPair::gather(work.exercise, content.clone()) {
            Ok(source) => source,
            Err(reason) => {
                self.compiled = Some(content);
                return refuse(work, reason);
            }
        };
        match outcome {
            None if source.is_risky() => return self.try_first(ctx, work, key, &content, platform),
            Some(TrialOutcome::Unavailable(reason)) if source.is_risky() => {
                self.compiled = Some(content);
                return refuse(work, tr!("exercise-this-shader-is-not-drawn-because", reason = reason));
            }
            Some(_) | None => {}
        }
        // It is compiled once there is a preview.
        let Some(preview) = &mut self.preview else {
            self.compiled = None;
            return;
        };
        let content: &[SourceFile] = self.compiled.insert(content);
        let variables = std::mem::take(&mut work.program.variables);
        work.program = match preview.compile(work.exercise, source, content) {
            Ok(pair) => ProgramFacts {
                notes: pair.notes.clone(),
                warnings: pair.warnings.clone(),
                unusable: (!pair.has_position()).then(|| tr!("exercise-nothing-is-drawn-no-attribute-was").to_owned()),
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

    /// Starts a trial, unless it is running; the pair is compiled when it has ended.
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

    /// Takes the outcome of the trial.
    fn take_outcome(&mut self, work: &mut Work) {
        self.trials.poll();
        work.program.is_tried = self.trials.slow().is_some();
    }
}

/// Notes why the pair cannot be drawn; the last drawn one stays visible.
fn refuse(work: &mut Work, reason: String) {
    let is_drawn = work.program.is_drawn;
    let variables = std::mem::take(&mut work.program.variables);
    work.program =
        ProgramFacts { unusable: Some(reason), is_drawn, is_old: is_drawn, variables, ..ProgramFacts::default() };
}

/// Whether these are the original files of the exercise, unchanged.
fn is_start(work: &Work, content: &[SourceFile]) -> bool {
    let start = work.exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    start.eq(content.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())))
}

/// Removes messages that both compilers report.
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
