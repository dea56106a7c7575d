//! The models' up axis: a hint where their format's convention differs from the world's, and the answer to it.

use super::App;
use crate::session::{MessageAnswer, MessageCause, MessageSeverity};
use gonio_language::tr;
use gonio_scene::scene_file::{ObjectSpec, UpAxis};

/// Whether a model most likely has z up, and the scene does not say which axis is. STL files come from CAD and go to 3D printers,
/// whose z is up; no other format without a convention of its own has one in use (OBJ and PLY have both).
fn may_be_lying(object: &ObjectSpec) -> bool {
    let name = object.model.to_ascii_lowercase();
    let name = name.strip_suffix(".gz").or(name.strip_suffix(".zst")).unwrap_or(&name);
    name.ends_with(".stl") && object.up == UpAxis::Y && object.rotate == [0.0; 3]
}

impl App {
    /// Says that the models of a scene that was just opened may lie on their side. A scene file says itself how its models are
    /// turned.
    pub(super) fn hint_at_up_axis(&mut self) {
        let is_scene_file = self.opened.inputs.iter().any(|input| input.to_ascii_lowercase().ends_with(".toml"));
        let Some(object) = self.document.scene.objects.iter().find(|object| may_be_lying(object)) else { return };
        if is_scene_file {
            return;
        }
        let name = object.model.rsplit(['/', '\\']).next().unwrap_or_default();
        let text = tr!("window-z-may-be-up", file = name);
        self.session.messages.report_about(MessageCause::UpAxis, MessageSeverity::Note, None, text);
        self.session.messages.answer_last(MessageAnswer::TurnZUp);
    }

    /// Turns those models upright, and frames them: one step to undo.
    pub(super) fn turn_z_up(&mut self, ctx: &egui::Context) {
        for object in self.document.scene.objects.iter_mut().filter(|object| may_be_lying(object)) {
            object.up = UpAxis::Z;
        }
        self.session.messages.clear(MessageCause::UpAxis);
        self.follow_document(ctx);
        if let Some(loaded) = &self.session.loaded {
            let [width, height] = self.session.facts.size.map(f64::from);
            self.document.scene.camera = loaded.framed(&self.document.scene.camera, width / height.max(1.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_stl_files_without_a_turn_may_be_lying() {
        let object = |model: &str| ObjectSpec { model: model.into(), ..ObjectSpec::default() };
        for (model, expected) in
            [("a/Part.STL", true), ("part.stl.gz", true), ("part.ply", false), ("part.obj", false), ("stl", false)]
        {
            assert_eq!(may_be_lying(&object(model)), expected, "{model}");
        }
        assert!(!may_be_lying(&ObjectSpec { up: UpAxis::Z, ..object("part.stl") }));
        assert!(!may_be_lying(&ObjectSpec { rotate: [-90.0, 0.0, 0.0], ..object("part.stl") }));
    }
}
