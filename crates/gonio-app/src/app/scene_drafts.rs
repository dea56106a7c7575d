//! Drafts of the scene: edits that were not saved, kept for the next window.
//!
//! A draft is a scene file. It is written at most a second after an edit, and removed when the scene is saved or the edits
//! are undone. When the same scene is opened again, its draft is offered in a message: restoring it is a step that can be
//! undone.

use super::App;
use super::loader::LoadRequest;
use crate::drafting::{DraftWriting, fingerprint, hexadecimal, in_words, now};
use crate::saving;
use crate::session::{MessageAnswer, MessageCause, MessageSeverity};
use gonio_language::tr;
use gonio_scene::{SceneFile, SceneSettings, toml_file};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// A draft as it is stored.
#[derive(Serialize, Deserialize)]
struct StoredDraft {
    /// Seconds since 1970.
    written: u64,
    /// The text of a scene file with absolute paths.
    scene: String,
}

/// The draft of the open scene.
#[derive(Default)]
pub struct SceneDraft {
    /// Key of the open scene's draft; empty before the first scene.
    key: String,
    /// What was written last, with its key.
    kept: Option<(String, SceneSettings)>,
    writing: DraftWriting,
    /// The draft of an earlier window, which is offered.
    offered: Option<SceneFile>,
}

impl SceneDraft {
    /// The key to write to: the draft that is offered is not overwritten.
    fn key_to_write(&self) -> String {
        if self.offered.is_some() { format!("{}-2", self.key) } else { self.key.clone() }
    }
}

impl App {
    /// Turns to the draft of the scene that was just opened. The draft of the scene before it stays.
    pub(super) fn begin_scene_draft(&mut self) {
        self.session.messages.clear(MessageCause::Draft);
        self.scene_draft = SceneDraft { key: self.scene_key(), ..SceneDraft::default() };
    }

    /// Offers the draft that an earlier window left of this scene.
    pub(super) fn offer_scene_draft(&mut self) {
        let Some(stored) = self.platform.take_draft(&self.scene_draft.key) else { return };
        let title = self.session.title.clone();
        let read = serde_json::from_str::<StoredDraft>(&stored).map_err(|error| error.to_string());
        let read =
            read.and_then(|draft| Ok((draft.written, toml_file::read(&draft.scene).map_err(|e| e.to_string())?)));
        let messages = &mut self.session.messages;
        match read {
            Ok((written, scene)) => {
                let age = in_words(Duration::from_secs(now().saturating_sub(written)));
                let sentence = tr!("window-unsaved-changes-were-kept", title = title, age = age);
                messages.report_about(MessageCause::Draft, MessageSeverity::Note, None, sentence);
                messages.answer_last(MessageAnswer::RestoreDraft);
                self.scene_draft.offered = Some(scene);
            }
            Err(error) => {
                let sentence = tr!("exercise-the-draft-of-is-damaged-and", name = title, error = error);
                messages.report_about(MessageCause::Draft, MessageSeverity::Warning, None, sentence);
            }
        }
    }

    /// Keeps edits after a moment, and removes the draft when there are none; called in every frame.
    pub(super) fn follow_scene_draft(&mut self, ctx: &egui::Context) {
        if !self.is_scene_edited() {
            self.scene_draft.writing.rest();
            if let Some((key, _)) = self.scene_draft.kept.take() {
                self.platform.remove_draft(&key);
            }
            return;
        }
        if self.scene_draft.kept.as_ref().is_some_and(|(_, kept)| *kept == self.document.scene) {
            self.scene_draft.writing.rest();
            return;
        }
        if !self.scene_draft.writing.is_due(ctx) {
            return;
        }
        let failure = self.flush_scene_draft();
        if self.scene_draft.writing.is_news(failure.as_ref())
            && let Some(error) = &failure
        {
            let title = &self.session.title;
            let sentence = tr!("exercise-the-unsaved-changes-to-could-not", name = title, error = error);
            self.session.messages.report(MessageSeverity::Error, sentence);
        }
    }

    /// Keeps edits now. Returns why they could not be kept.
    pub(super) fn flush_scene_draft(&mut self) -> Option<String> {
        self.scene_draft.writing.rest();
        if !self.is_scene_edited() || self.scene_draft.key.is_empty() {
            return None;
        }
        let scene = saving::scene_file_anywhere(&self.document.scene);
        let draft = StoredDraft { written: now(), scene };
        let key = self.scene_draft.key_to_write();
        let text = match serde_json::to_string(&draft) {
            Ok(text) => text,
            Err(error) => return Some(error.to_string()),
        };
        let failure = self.platform.keep_draft(&key, &text).err();
        if failure.is_none() {
            self.scene_draft.kept = Some((key, self.document.scene.clone()));
        }
        failure
    }

    /// Reads the scene of the draft that is offered.
    pub(super) fn restore_scene_draft(&mut self, ctx: &egui::Context) {
        let Some(scene) = self.scene_draft.offered.clone() else { return };
        self.session.busy = Some(tr!("window-reading-the-scene-s-files").into());
        self.loader.start(LoadRequest::Draft(Box::new(scene)), self.files.clone(), self.opened.limits, ctx);
    }

    /// Shows the draft after its files were read: a step that can be undone.
    pub(super) fn take_scene_draft(&mut self, scene: SceneSettings) {
        self.session.announcement = tr!("window-restored", title = self.session.title);
        self.session.messages.clear(MessageCause::Draft);
        self.scene_draft.offered = None;
        // It is kept under its own key from now on, and edits from before can be undone.
        if let Some((key, _)) = self.scene_draft.kept.take().filter(|(key, _)| *key != self.scene_draft.key) {
            self.platform.remove_draft(&key);
        }
        self.scene_draft.kept = Some((self.scene_draft.key.clone(), scene.clone()));
        self.document.scene = scene;
    }

    /// Removes the draft that is offered.
    pub(super) fn discard_scene_draft(&mut self) {
        self.session.messages.clear(MessageCause::Draft);
        if self.scene_draft.offered.take().is_some() {
            self.platform.remove_draft(&self.scene_draft.key);
        }
    }

    /// The key of the open scene's draft: it depends on the paths of its inputs. For scenes that no path leads to later, it
    /// depends on their names and on what was opened.
    fn scene_key(&self) -> String {
        let mut bytes = b"scene".to_vec();
        let mut is_lasting = true;
        for input in &self.opened.inputs {
            let lasting = self.platform.lasting(input);
            is_lasting &= lasting.is_some();
            bytes.push(0);
            bytes.extend(lasting.as_ref().unwrap_or(input).as_bytes());
        }
        if !is_lasting {
            bytes.push(0);
            bytes.extend(SceneFile::from(&self.saved).to_toml_string().as_bytes());
        }
        hexadecimal(fingerprint(&bytes))
    }
}
