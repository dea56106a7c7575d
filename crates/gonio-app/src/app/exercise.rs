//! The exercise within the application.

use super::App;
use crate::exercise::{ExerciseView, Start};
use crate::files::ExerciseFile;
use crate::panels;
use crate::platform::Purpose;
use crate::session::MessageSeverity;
use egui::Ui;
use std::path::PathBuf;

impl App {
    /// The exercise view.
    pub fn exercise(&self) -> &ExerciseView {
        &self.exercise
    }

    /// Shows an exercise with a student's files. Errors become messages in the window.
    pub fn begin_exercise(&mut self, ctx: &egui::Context, start: Start) {
        if let Err(error) = self.exercise.begin(start) {
            self.session.messages.report(MessageSeverity::Error, error);
        }
        self.watch(ctx);
    }

    /// The purpose of files that are opened now.
    pub(super) fn purpose(&self) -> Purpose {
        if self.exercise.is_open { Purpose::Exercise } else { Purpose::Scene }
    }

    /// Opens a student's files in place of those for the same purpose. Reports files that were ignored.
    pub(super) fn open_exercise_files(&mut self, files: Vec<ExerciseFile>) {
        let taken = self.exercise.take(files);
        let severity = if taken.announcement.is_some() { MessageSeverity::Warning } else { MessageSeverity::Error };
        if let Some(announcement) = taken.announcement {
            self.session.announcement = announcement;
        }
        if let Some(ignored) = taken.ignored {
            self.session.messages.report(severity, ignored);
        }
    }

    /// A frame that shows the exercise in place of the scene.
    pub(super) fn exercise_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        let mut failures = self.exercise.restore_drafts(&ctx, self.platform.as_mut());
        failures.extend(self.exercise.ui(ui, self.pane_renderer.as_mut(), self.platform.as_mut(), &mut actions));
        failures.extend(self.exercise.follow_drafts(&ctx, self.platform.as_mut()));
        for sentence in failures {
            self.session.messages.report(MessageSeverity::Error, sentence);
        }
        panels::messages(ui, &self.session, &mut actions);
        panels::path_field(ui, &mut self.session, Purpose::Exercise, &mut actions);
        for action in actions {
            self.act(&ctx, action);
        }
        self.asked_to_close &= self.exercise.works().any(|work| work.is_changed() || work.has_unsaved_before());
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
        if self.asked_to_close {
            return;
        }
        let end = match failures.first() {
            Some(error) => format!("closing again discards it, because {error}"),
            None => "closing again keeps it as a draft, which is restored when you open these files again".to_owned(),
        };
        let changed = self.exercise.works().find(|work| work.is_changed());
        let before = || self.exercise.works().find(|work| work.has_unsaved_before());
        let sentence = match (changed, before()) {
            (Some(work), _) => {
                format!("your changes to {} are not saved: Ctrl + S saves them, and {end}", work.exercise.id)
            }
            (None, Some(work)) => format!(
                "your changes to the previous files of {} are not saved: `Put back` restores them, and {end}",
                work.exercise.id
            ),
            (None, None) => return,
        };
        ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
        self.asked_to_close = true;
        self.exercise.is_open = true;
        self.session.messages.report(MessageSeverity::Warning, sentence);
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
}
