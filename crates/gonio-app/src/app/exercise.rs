//! The exercise and the user's own shaders within the application.

use super::App;
use crate::exercise::{ExerciseView, Start};
use crate::files::{ExerciseFile, ShaderFiles, short};
use crate::panels;
use crate::platform::Purpose;
use crate::session::{MessageCause, MessageSeverity, OwnShaders, Tab};
use crate::step;
use egui::Ui;
use gonio_language::tr;
use gonio_scene::files::FileSource;
use std::path::PathBuf;
use std::sync::Arc;

impl App {
    /// The exercise view.
    pub fn exercise(&self) -> &ExerciseView {
        &self.exercise
    }

    /// Shows an exercise with a student's files. Errors become messages in the window.
    pub fn begin_exercise(&mut self, ctx: &egui::Context, start: Start) {
        self.session.messages.clear(MessageCause::ExerciseFiles);
        if let Err(error) = self.exercise.begin(start) {
            self.session.messages.report(MessageSeverity::Error, error);
        }
        self.watch(ctx);
    }

    /// The purpose of files that are opened now.
    pub(super) fn purpose(&self) -> Purpose {
        if self.exercise.is_open {
            Purpose::Exercise
        } else if self.bench.is_open {
            Purpose::Bench
        } else {
            Purpose::Scene
        }
    }

    /// Opens a student's files in place of those for the same purpose. Reports files that were ignored.
    pub(super) fn open_exercise_files(&mut self, files: Vec<ExerciseFile>) {
        let taken = self.exercise.take(files);
        let severity = if taken.announcement.is_some() { MessageSeverity::Warning } else { MessageSeverity::Error };
        if let Some(announcement) = taken.announcement {
            self.session.messages.clear(MessageCause::ExerciseFiles);
            self.session.announcement = announcement;
        }
        if let Some(ignored) = taken.ignored {
            self.session.messages.report_about(MessageCause::ExerciseFiles, severity, None, ignored);
        }
    }

    /// A frame that shows the exercise in place of the scene.
    pub(super) fn exercise_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        panels::messages(ui, &self.session.messages, &mut actions);
        let mut failures = self.exercise.restore_drafts(&ctx, self.platform.as_mut());
        failures.extend(self.exercise.ui(ui, self.pane_renderer.as_mut(), self.platform.as_mut(), &mut actions));
        failures.extend(self.exercise.follow_drafts(&ctx, self.platform.as_mut()));
        for sentence in failures {
            self.session.messages.report(MessageSeverity::Error, sentence);
        }
        if let Some(announcement) = self.exercise.announcement.take() {
            self.session.announcement = announcement;
        }
        if self.exercise.outcomes != self.session.settings.outcomes {
            self.session.settings.outcomes.clone_from(&self.exercise.outcomes);
            self.platform.keep(&self.session.settings);
        }
        panels::path_field(ui, &mut self.session, Purpose::Exercise, &mut actions);
        for action in actions {
            self.act(&ctx, action);
        }
        if !self.exercise.works().any(|work| work.is_changed() || work.has_unsaved_before()) {
            self.asked_to_close &= self.is_scene_edited();
            self.session.messages.clear(MessageCause::Closing);
        }
        let paths = self.exercise.paths();
        if paths != self.watched {
            self.watch(&ctx);
        }
        self.publish(&ctx);
    }

    /// Refuses to close a window with unsaved text once. The text is kept as a draft.
    pub(super) fn before_closing(&mut self, ctx: &egui::Context) {
        if !ctx.input(|i| i.viewport().close_requested()) {
            return;
        }
        let failures = self.exercise.flush_drafts(self.platform.as_mut());
        let scene_failure = self.flush_scene_draft();
        if self.asked_to_close {
            return;
        }
        let end = match failures.first() {
            Some(error) => tr!("window-close-again-to-discard-your-changes", error = error),
            None => tr!("window-close-again-to-keep-them-as").to_owned(),
        };
        let changed = self.exercise.works().find(|work| work.is_changed());
        let before = || self.exercise.works().find(|work| work.has_unsaved_before());
        let sentence = match (changed, before()) {
            (Some(work), _) => {
                tr!("window-your-changes-to-are-not-saved", id = work.exercise.id, end = end)
            }
            (None, Some(work)) => tr!("window-your-changes-to-the-previous-files", id = work.exercise.id, end = end),
            (None, None) if self.is_scene_edited() => {
                let end = match scene_failure {
                    Some(error) => tr!("window-close-again-to-discard-your-changes", error = error),
                    None => tr!("window-close-again-to-keep-the-scene").to_owned(),
                };
                tr!("window-your-changes-to-the-scene-are", title = self.session.title, end = end)
            }
            (None, None) => return,
        };
        let is_of_exercise = changed.is_some() || before().is_some();
        ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
        self.asked_to_close = true;
        self.exercise.is_open |= is_of_exercise;
        self.session.messages.report_about(MessageCause::Closing, MessageSeverity::Warning, None, sentence);
    }

    /// Watches the files of the scene and of the exercises.
    pub(super) fn watch(&mut self, ctx: &egui::Context) {
        self.watched = self.exercise.paths();
        let shaders = self.session.shaders.iter().flat_map(|shaders| shaders.files().paths());
        let all = self.read.iter().chain(&self.watched).cloned().chain(shaders).collect();
        self.platform.watch(all, ctx);
    }

    /// Reloads changed files of the exercises, and notes those of the scene.
    pub(super) fn changed_on_disk(&mut self, ctx: &egui::Context, paths: Vec<PathBuf>) {
        for sentence in self.exercise.changed(ctx, &paths) {
            self.session.messages.report(MessageSeverity::Error, sentence);
        }
        if let Some(shaders) = &mut self.session.shaders {
            shaders.changed(&paths);
        }
        self.changed.extend(paths.into_iter().filter(|path| self.read.contains(path)));
    }

    /// Draws with the user's shaders; they replace open ones for the same stage.
    pub(super) fn open_shaders(&mut self, ctx: &egui::Context, files: ShaderFiles, from: Arc<dyn FileSource>) {
        let named = files.fragment.iter().chain(&files.vertex).chain(&files.names).cloned().collect::<Vec<_>>();
        match &mut self.session.shaders {
            Some(shaders) => shaders.open(files, from, self.platform.as_ref()),
            None if !files.any() => {
                let error = tr!("window-belongs-to-shaders-open-it-together", named = short(&named));
                return self.session.messages.report(MessageSeverity::Error, error);
            }
            None => self.session.shaders = Some(OwnShaders::new(files, Some(from))),
        }
        self.session.tab = Tab::Shaders;
        self.session.announcement = tr!("window-opened", named = short(&named));
        self.watch(ctx);
        ctx.request_repaint();
    }

    /// Reads and compiles the user's shaders if they have changed.
    pub(super) fn follow_shaders(&mut self, ctx: &egui::Context) {
        let (Some(shaders), Some(renderer)) = (&mut self.session.shaders, &self.pane_renderer) else { return };
        let scene = self.session.loaded.as_deref();
        shaders.follow(renderer.gl(), scene, self.platform.as_mut(), &mut self.session.messages, ctx);
    }

    /// Steps through the user's shaders by the keys of this frame.
    pub(super) fn step_by_keys(&mut self, ui: &Ui) {
        if let Some(shaders) = self.session.shaders.as_mut().filter(|_| self.session.asking.is_none()) {
            let was_pinned = shaders.stepper.is_pinned();
            step::bar::keys(ui, &mut shaders.stepper);
            if !was_pinned {
                shaders.pane = self.document.panes.current;
            }
        }
    }

    /// Computes the values of the user's shaders at the pinned pixel, for the pane as it was just drawn.
    pub(super) fn step(&mut self, ctx: &egui::Context) {
        let Some(shaders) = &mut self.session.shaders else { return };
        if shaders.stepper.is_new() {
            // The values are those of one moment.
            (self.session.clock.playing, self.session.tab) = (false, Tab::Shaders);
        }
        let (seen, renderer) = (self.document.panes.seen(), self.pane_renderer.as_ref());
        shaders.step(ctx, self.platform.as_mut(), |pane| {
            let renderer = renderer.filter(|renderer| seen.contains(&pane) && renderer.is_users(pane))?;
            Some((renderer.loaded(pane)?.clone(), renderer.frame(pane)?.clone()))
        });
    }
}
