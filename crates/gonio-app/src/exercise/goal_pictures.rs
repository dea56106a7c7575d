//! The goals of exercises whose answer is not a pair of shaders: pictures that were drawn ahead, as built-in files.

use super::picture_files::reduced;
use crate::exported::{self, WidgetRole};
use egui::{Color32, Rect, Sense, TextureHandle, TextureOptions, Ui, pos2};
use gonio_exercises::exercise::Exercise;
use gonio_scene::Texture;
use gonio_scene::files::FileSource;
use std::collections::BTreeMap;

/// The decoded pictures.
#[derive(Default)]
pub struct GoalPictures {
    /// By the exercise's id; `None` for an exercise without a picture.
    known: BTreeMap<String, Option<TextureHandle>>,
}

impl GoalPictures {
    /// Shows the goal's picture in `place`, if there is one and it has arrived.
    pub fn show(&mut self, ui: &Ui, place: Rect, exercise: &Exercise, files: &dyn FileSource) {
        if !self.known.contains_key(&exercise.id) {
            let name = format!("goals/{}.png", exercise.id);
            let bytes = files.builtin(&name);
            if bytes.is_none() && files.is_coming(&name) {
                ui.ctx().request_repaint_after(std::time::Duration::from_millis(100));
                return;
            }
            let picture = bytes.and_then(|bytes| Texture::decode(&name, &bytes).ok());
            let texture =
                picture.map(|picture| ui.ctx().load_texture(&name, reduced(&picture), TextureOptions::LINEAR));
            self.known.insert(exercise.id.clone(), texture);
        }
        let Some(Some(texture)) = self.known.get(&exercise.id) else { return };
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture.id(), place, whole, Color32::WHITE);
        let id = format!("goal-{}", exercise.id);
        let response = ui.interact(place, ui.scope_id().with(&id), Sense::hover());
        exported::note(ui, &response, &id, WidgetRole::Picture, exercise.title(), "");
    }
}
