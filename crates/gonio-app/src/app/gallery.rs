//! The gallery within the application.

use super::App;
use crate::app::loader::SceneOpening;
use crate::files::{Layered, MemoryFiles};
use crate::gallery::ChosenExhibit;
use crate::panels;
use crate::session::MessageSeverity;
use egui::Ui;
use std::sync::Arc;

impl App {
    /// Shows the gallery.
    pub(super) fn show_gallery(&mut self) {
        if let Err(error) = self.gallery.open() {
            self.session.messages.report(MessageSeverity::Error, error);
        }
    }

    /// A frame that shows the gallery in place of the scene.
    pub(super) fn gallery_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        panels::messages(ui, &self.session.messages, &mut actions);
        let panes = self.pane_renderer.as_mut();
        let (chosen, errors) = self.gallery.ui(ui, self.platform.as_mut(), panes, &mut actions);
        for error in errors {
            self.session.messages.report(MessageSeverity::Error, error);
        }
        for action in actions {
            self.act(&ctx, action);
        }
        if let Some(chosen) = chosen {
            self.open_exhibit(&ctx, chosen);
        }
        self.publish(&ctx);
    }

    /// Opens a scene of the gallery, at its time and in its view.
    fn open_exhibit(&mut self, ctx: &egui::Context, chosen: ChosenExhibit) {
        self.gallery.leave();
        let name = format!("{}.toml", chosen.name);
        let mut memory = MemoryFiles::default();
        memory.insert(&name, chosen.toml.into_bytes());
        let files = Arc::new(Layered { first: Arc::new(memory), then: self.platform.files() });
        let opening = SceneOpening {
            inputs: vec![name],
            limits: self.opened.limits,
            view: chosen.view,
            time: chosen.time,
            is_sample: true,
            ..SceneOpening::default()
        };
        self.start(ctx, opening, files);
    }
}
