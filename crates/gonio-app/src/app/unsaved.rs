//! Edits of the scene that were not saved: another scene replaces them only until they are restored.

use super::App;
use super::loader::{LoadRequest, SceneOpening};
use crate::document::{Document, History};
use crate::session::{MessageAnswer, MessageCause, MessageSeverity, UsageHint};
use gonio_language::tr;
use gonio_scene::SceneSettings;
use gonio_scene::files::FileSource;
use gonio_scene::settings::CameraSettings;
use std::sync::Arc;

/// An edited scene that another one has replaced, with all steps to undo.
#[derive(Clone)]
pub struct ReplacedScene {
    /// The document.
    pub document: Document,
    history: History,
    saved: SceneSettings,
    /// The source of its files.
    pub files: Arc<dyn FileSource>,
    opened: SceneOpening,
    opened_camera: CameraSettings,
    title: String,
}

/// Whether lights, objects or surroundings differ. Switches of the equation, the camera and the picture's settings are ways to
/// look at a scene, not work on it.
fn differ(a: &SceneSettings, b: &SceneSettings) -> bool {
    a.lights != b.lights || a.objects != b.objects || a.environment != b.environment || a.background != b.background
}

impl App {
    /// Whether the scene was edited since it was opened or saved.
    pub(super) fn is_scene_edited(&self) -> bool {
        self.session.loaded.is_some() && differ(&self.document.scene, &self.saved)
    }

    /// Notes what the user has found out, so that its hint goes away.
    pub(super) fn note_learned(&mut self) {
        if self.session.loaded.is_none() || self.session.settings.hint().is_none() {
            return;
        }
        let scene = &self.document.scene;
        let done = [
            (UsageHint::Probe, self.session.probing.pinned.is_some()),
            (UsageHint::Lamp, scene.lights != self.saved.lights),
            (UsageHint::Term, scene.equation != self.saved.equation),
        ];
        let learned = &mut self.session.settings.learned;
        let before = learned.len();
        learned.extend(done.into_iter().filter(|(_, done)| *done).map(|(hint, _)| hint));
        if learned.len() > before {
            self.platform.keep(&self.session.settings);
        }
    }

    /// Keeps the edited scene that is about to be replaced, and offers to restore it.
    pub(super) fn keep_replaced(&mut self) {
        if !self.is_scene_edited() {
            return;
        }
        self.replaced = Some(Box::new(ReplacedScene {
            document: self.document.clone(),
            history: self.history.clone(),
            saved: self.saved.clone(),
            files: self.files.clone(),
            opened: self.opened.clone(),
            opened_camera: self.opened_camera.clone(),
            title: self.session.title.clone(),
        }));
        let messages = &mut self.session.messages;
        messages.clear(MessageCause::Replaced);
        let sentence = tr!("window-replaced-unsaved", title = self.session.title);
        messages.report_about(MessageCause::Replaced, MessageSeverity::Note, None, sentence);
        messages.answer_last(MessageAnswer::RestoreScene);
    }

    /// Opens the replaced scene again.
    pub(super) fn restore_scene(&mut self, ctx: &egui::Context) {
        let Some(replaced) = self.replaced.take() else { return };
        self.session.messages.clear(MessageCause::Replaced);
        self.session.busy = Some(tr!("window-reading", inputs = replaced.title));
        let (files, limits) = (replaced.files.clone(), replaced.opened.limits);
        self.loader.start(LoadRequest::Restore(replaced), files, limits, ctx);
    }

    /// Takes the replaced scene back, after its files were read again.
    pub(super) fn take_restored(&mut self, replaced: ReplacedScene) {
        self.session.announcement = tr!("window-restored", title = replaced.title);
        self.session.title = replaced.title;
        self.session.clock = Default::default();
        self.session.selection = Default::default();
        self.session.probing.forget();
        self.forget_bake();
        (self.document, self.history) = (replaced.document, replaced.history);
        (self.opened, self.opened_camera) = (replaced.opened, replaced.opened_camera);
        self.saved = replaced.saved;
        self.begin_scene_draft();
        self.session.unframed = false;
    }
}
