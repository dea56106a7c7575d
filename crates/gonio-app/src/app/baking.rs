//! Baking within the application.

use super::App;
use crate::baking::BakeRequest;
use crate::saving::{BAKED, Product};
use crate::session::{MessageSeverity, Tab};
use gonio_language::tr;
use std::path::Path;

const NOTHING_BAKED: &str = "window-nothing-is-baked-yet-press-bake";

impl App {
    /// Shows the settings.
    pub(super) fn show_bake(&mut self) {
        self.session.baking.open(self.session.settings.bake.as_deref());
        self.session.tab = Tab::Bake;
    }

    /// Hides settings and atlas, and shows the scene's own materials. The result is kept.
    pub(super) fn close_bake(&mut self) {
        self.session.baking.is_open = false;
        self.document.panes.list.iter_mut().for_each(|pane| pane.show_baked(None));
        self.session.tab = Tab::default();
    }

    /// Bakes the open scene as it is now.
    pub(super) fn start_bake(&mut self, ctx: &egui::Context) {
        let Some(scene) = self.session.loaded.clone() else { return };
        let job = self.session.baking.job.clone();
        self.session.settings.bake = serde_json::to_string(&job).ok();
        self.platform.keep(&self.session.settings);
        let request = BakeRequest {
            scene,
            time: self.session.clock.time,
            job,
            stem: Product::stem(&self.session.title) + BAKED,
            files: self.files.clone(),
            paths: self.read.clone(),
        };
        self.session.baking.start(self.platform.as_mut(), ctx, request, self.session.generation);
    }

    pub(super) fn cancel_bake(&mut self) {
        if self.session.baking.cancel() {
            self.session.announcement = tr!("window-baking-was-cancelled").into();
        }
    }

    /// Another scene was opened.
    pub(super) fn forget_bake(&mut self) {
        if self.session.baking.forget() {
            let sentence = tr!("window-baking-was-cancelled-because-another-scene");
            self.session.messages.report(MessageSeverity::Warning, sentence);
        }
    }

    /// Takes progress and results.
    pub(super) fn follow_bake(&mut self, ctx: &egui::Context) {
        let was_running = self.session.baking.is_running();
        for (is_error, sentence) in self.session.baking.follow(self.platform.as_mut(), ctx) {
            let severity = if is_error { MessageSeverity::Error } else { MessageSeverity::Warning };
            self.session.messages.report(severity, sentence);
        }
        if was_running && !self.session.baking.is_running() && self.session.baking.result().is_some() {
            self.session.announcement = tr!("window-the-textures-are-baked").into();
        }
    }

    /// The bytes of a product of the newest bake. Files that belong beside an OBJ file are saved there; one that cannot be
    /// saved is an error.
    pub(super) fn baked_product(&mut self, product: Product, folder: Option<&Path>) -> Result<Vec<u8>, String> {
        let result = self.session.baking.result().cloned().ok_or(tr!(NOTHING_BAKED))?;
        let files = &result.atlas.files;
        if product == Product::BakedZip {
            let files: Vec<(&str, &[u8])> =
                files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
            return Ok(crate::files::pack(&files));
        }
        let is_product = |name: &str| Path::new(name).extension().is_some_and(|e| e == product.extension());
        let beside = files.iter().filter(|(name, _)| product == Product::BakedObj && !is_product(name));
        // The GLB file stands for itself.
        for (name, bytes) in beside.filter(|(name, _)| !name.ends_with(".glb")) {
            let place = folder.unwrap_or(Path::new("")).join(name);
            self.platform.write(&place.to_string_lossy(), bytes)?;
        }
        let found = files.iter().find(|(name, _)| is_product(name)).map(|(_, bytes)| bytes.clone());
        found.ok_or_else(|| tr!(NOTHING_BAKED).to_owned())
    }
}
