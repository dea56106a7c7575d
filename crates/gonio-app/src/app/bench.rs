//! The BRDF bench within the application.

use super::App;
use crate::baking;
use crate::bench::{BenchFunctions, BenchView};
use crate::environment;
use crate::panels;
use crate::platform::Purpose;
use crate::session::{MessageCause, MessageSeverity, Session};
use egui::Ui;
use gonio_bsdf::NamedBsdf;

impl App {
    /// The BRDF bench.
    pub fn bench(&self) -> &BenchView {
        &self.bench
    }

    /// Shows the bench with these functions, or without any those of a new bench.
    pub fn begin_bench(&mut self, functions: Vec<NamedBsdf>) {
        self.bench.open();
        if !functions.is_empty() {
            self.bench.functions = BenchFunctions::of(functions);
        }
    }

    /// Adds the functions of files to the bench: names and contents.
    pub(super) fn open_bench_files(&mut self, ctx: &egui::Context, files: Vec<(String, Vec<u8>)>) {
        for (name, _) in &files {
            self.session.messages.clear_of_file(MessageCause::BenchFiles, name);
        }
        self.bench.open_files(files, self.platform.as_mut(), ctx);
    }

    /// A frame that shows the bench in place of the scene.
    pub(super) fn bench_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        panels::messages(ui, &self.session.messages, &mut actions);
        for (is_error, sentence) in self.bench.ui(ui, self.platform.as_mut(), &mut actions) {
            let severity = if is_error { MessageSeverity::Error } else { MessageSeverity::Warning };
            self.session.messages.report_about(MessageCause::BenchFiles, severity, None, sentence);
        }
        panels::path_field(ui, &mut self.session, Purpose::Bench, &mut actions);
        for action in actions {
            self.act(&ctx, action);
        }
        self.publish(&ctx);
    }
}

/// The state with the parts of the exercise, the bench and the stations, and of baking.
pub(super) fn with_places(
    mut state: serde_json::Value,
    session: &Session,
    [exercise, bench, stations, gallery]: [serde_json::Value; 4],
) -> serde_json::Value {
    state["exercise"] = exercise;
    state["bench"] = bench;
    state["stations"] = stations;
    state["gallery"] = gallery;
    state["bake"] = baking::state(session);
    state["file"] = session.inspector.state();
    state["environment"] = environment::state(session);
    state
}
