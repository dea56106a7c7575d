//! The stations beyond the rendering equation within the application.

use super::App;
use crate::files::link::StationLink;
use crate::panels;
use crate::session::MessageSeverity;
use crate::stations::StationRoom;
use egui::Ui;

impl App {
    /// The stations.
    pub fn stations(&self) -> &StationRoom {
        &self.stations
    }

    /// Shows a station; without a name the first one.
    pub fn begin_stations(&mut self, link: StationLink) {
        self.stations.open_link(link);
    }

    /// A frame that shows the stations in place of the scene.
    pub(super) fn stations_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        panels::messages(ui, &self.session.messages, &mut actions);
        for error in self.stations.ui(ui, self.platform.as_mut(), &mut actions) {
            self.session.messages.report(MessageSeverity::Error, error);
        }
        for action in actions {
            self.act(&ctx, action);
        }
        self.publish(&ctx);
    }
}
