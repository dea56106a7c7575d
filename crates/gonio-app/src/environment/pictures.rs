//! The unfolded cube and the panorama.

use super::study::{EnvironmentStudy, SmallPicture};
use crate::exported::{self, WidgetRole};
use egui::{
    Align2, Color32, ColorImage, CornerRadius, Image, Rect, Sense, TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo,
    vec2,
};
use gonio_environment::Face;
use gonio_language::tr;

/// The longest edge of a face, points.
const MOST_CELL: f32 = 88.0;
/// The gap between two faces, points.
const GAP: f32 = 1.0;

/// The pictures of a study on the GPU.
#[derive(Default)]
pub struct StudyPictures {
    textures: Option<([TextureHandle; 6], TextureHandle)>,
}

impl StudyPictures {
    /// Frees the textures.
    pub fn release(&mut self) {
        self.textures = None;
    }

    fn textures(&mut self, ui: &Ui, study: &EnvironmentStudy) -> &([TextureHandle; 6], TextureHandle) {
        self.textures.get_or_insert_with(|| {
            let load = |name: &str, picture: &SmallPicture| {
                ui.ctx().load_texture(name, ColorImage::from_rgb(picture.size, &picture.rgb), TextureOptions::LINEAR)
            };
            let faces = std::array::from_fn(|index| load(tr!("environment-environment-face"), &study.faces[index]));
            (faces, load(tr!("environment-environment-panorama"), &study.panorama))
        })
    }
}

/// OpenGL's name of a face, and where it is.
fn named(face: Face) -> (&'static str, &'static str) {
    match face {
        Face::PosX => ("+X", tr!("environment-face-x-to-the-right")),
        Face::NegX => ("-X", tr!("environment-face-x-to-the-left")),
        Face::PosY => ("+Y", tr!("environment-face-y-above")),
        Face::NegY => ("-Y", tr!("environment-face-y-below")),
        Face::PosZ => ("+Z", tr!("environment-face-z-behind")),
        Face::NegZ => ("-Z", tr!("environment-face-z-straight-ahead")),
    }
}

/// Column and row of a face in the unfolded cube.
fn cell(face: Face) -> Vec2 {
    match face {
        Face::NegX => vec2(0.0, 1.0),
        Face::NegZ => vec2(1.0, 1.0),
        Face::PosX => vec2(2.0, 1.0),
        Face::PosZ => vec2(3.0, 1.0),
        Face::PosY => vec2(1.0, 0.0),
        Face::NegY => vec2(1.0, 2.0),
    }
}

/// Shows the cube, unfolded about the face ahead.
pub fn cube(ui: &mut Ui, study: &EnvironmentStudy, pictures: &mut StudyPictures) {
    let side = ((ui.available_width() - 3.0 * GAP) / 4.0).floor().clamp(24.0, MOST_CELL);
    let (room, _) = ui.allocate_exact_size(vec2(4.0, 3.0) * (side + GAP) - Vec2::splat(GAP), Sense::hover());
    let textures = &pictures.textures(ui, study).0;
    for (face, texture) in Face::ALL.into_iter().zip(textures) {
        let rect = Rect::from_min_size(room.min + cell(face) * (side + GAP), Vec2::splat(side));
        Image::new(texture).corner_radius(CornerRadius::same(2)).paint_at(ui, rect);
        let (name, title) = named(face);
        let font = egui::FontId::proportional(11.0);
        let galley = ui.painter().layout_no_wrap(name.to_owned(), font, Color32::WHITE);
        let plate = Align2::LEFT_TOP.anchor_size(rect.min + vec2(2.0, 2.0), galley.size() + vec2(6.0, 1.0));
        // A plate, because a face may have any colour.
        ui.painter().rect_filled(plate, 3.0, Color32::from_black_alpha(150));
        ui.painter().galley(plate.min + vec2(3.0, 0.5), galley, Color32::WHITE);
        let response = ui.interact(rect, ui.scope_id().with(("face", face.name())), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, title));
        exported::note(ui, &response, &format!("environment-face-{}", face.name()), WidgetRole::Picture, title, "");
        response.on_hover_text(title);
    }
}

/// Shows the panorama.
pub fn panorama(ui: &mut Ui, study: &EnvironmentStudy, pictures: &mut StudyPictures) {
    let width = ui.available_width().min(4.0 * MOST_CELL + 3.0 * GAP);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 0.5 * width), Sense::hover());
    Image::new(&pictures.textures(ui, study).1).corner_radius(CornerRadius::same(2)).paint_at(ui, rect);
    let title = tr!("environment-panorama-360-degrees-from-left-to");
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, title));
    exported::note(ui, &response, "environment-panorama-picture", WidgetRole::Picture, title, "");
    response.on_hover_text(title);
}
