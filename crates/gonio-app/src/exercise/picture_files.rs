//! The pictures among the files of an exercise that draws nothing itself, such as a baked texture and the goal, side by side.

use super::pictures::{part, written};
use super::work::{OpenFile, Work};
use crate::exported::{self, WidgetRole};
use crate::widgets;
use egui::{Align2, Color32, ColorImage, Rect, Sense, TextureHandle, TextureOptions, Ui, pos2};
use gonio_language::tr;
use gonio_scene::Texture;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Pictures that are shown at most.
const MOST: usize = 4;
/// Larger pictures are reduced to about this many pixels along a side.
const LARGEST: usize = 1024;

/// Shows the pictures, the student's before the exercise's. Returns whether there are any of the student's.
pub fn show(ui: &mut Ui, room: Rect, work: &Work) -> bool {
    let is_given = |file: &OpenFile| work.exercise.given.iter().any(|given| given.ends_with(&file.name));
    let is_goal = |file: &OpenFile| file.name == "goal.png";
    let mut files: Vec<&OpenFile> =
        work.files.iter().filter(|file| is_picture(&file.name) && !is_given(file)).collect();
    files.sort_by_key(|file| is_goal(file));
    let shown: Vec<(&OpenFile, TextureHandle)> =
        files.into_iter().filter_map(|file| Some((file, texture(ui, file)?))).take(MOST).collect();
    if shown.iter().all(|(file, _)| is_goal(file)) {
        return false;
    }
    for (index, (file, texture)) in shown.iter().enumerate() {
        let place = part(room, index, shown.len(), ui.ctx().pixels_per_point());
        let size = texture.size_vec2();
        let size = size * (place.shrink(8.0).size() / size).min_elem().max(0.0);
        let rect = Rect::from_center_size(place.center(), size);
        ui.painter().image(texture.id(), rect, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)), Color32::WHITE);
        let response = ui.interact(rect, file.id().with("picture"), Sense::hover());
        let id = format!("picture-{}", widgets::slug(&file.name));
        exported::note(ui, &response, &id, WidgetRole::Picture, &file.name, "");
        written(ui, rect, Align2::LEFT_BOTTOM, &file.name, super::pictures::GROUND);
    }
    true
}

fn is_picture(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    [".png", ".jpg", ".jpeg"].iter().any(|end| name.ends_with(end))
}

#[derive(Clone)]
struct ShownPicture {
    content: u64,
    /// `None` if it cannot be read.
    texture: Option<TextureHandle>,
}

/// The file on the GPU, decoded again if it has changed.
fn texture(ui: &Ui, file: &OpenFile) -> Option<TextureHandle> {
    let id = file.id().with(tr!("exercise-decoded-picture"));
    let mut hasher = DefaultHasher::new();
    // Pictures end with checksums, or with compressed pixels.
    (file.saved.len(), &file.saved[file.saved.len().saturating_sub(4096)..]).hash(&mut hasher);
    let content = hasher.finish();
    let known: Option<ShownPicture> = ui.data(|data| data.get_temp(id));
    if let Some(known) = known.filter(|known| known.content == content) {
        return known.texture;
    }
    let image = Texture::decode(&file.name, &file.saved).ok().map(|texture| reduced(&texture));
    let texture = image.map(|image| ui.ctx().load_texture(&file.name, image, TextureOptions::LINEAR));
    ui.data_mut(|data| data.insert_temp(id, ShownPicture { content, texture: texture.clone() }));
    texture
}

/// Every n-th pixel of a large picture, and all of a small one.
pub(super) fn reduced(texture: &Texture) -> ColorImage {
    let (width, height) = (texture.width as usize, texture.height as usize);
    let step = width.max(height).div_ceil(LARGEST).max(1);
    let (columns, rows) = (width.div_ceil(step), height.div_ceil(step));
    let at = |x: usize, y: usize| {
        let pixel = texture.rgba.get(4 * (y * width + x)..).and_then(|rest| rest.first_chunk::<4>());
        pixel.map_or(Color32::TRANSPARENT, |&[r, g, b, a]| Color32::from_rgba_unmultiplied(r, g, b, a))
    };
    let pixels =
        (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).map(|(x, y)| at(step * x, step * y)).collect();
    ColorImage::new([columns, rows], pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::ColorSpace;

    #[test]
    fn large_pictures_are_reduced_and_keep_their_shape() {
        let rgba = (0..3000_u32).flat_map(|i| [(i % 3000 / 12) as u8, 0, 0, 255]).collect();
        let image = reduced(&Texture::new("wide", 3000, 1, rgba, ColorSpace::Srgb));
        assert_eq!(image.size, [1000, 1]);
        assert_eq!(image.pixels[999], Color32::from_rgb((2997 / 12) as u8, 0, 0));
        let small = reduced(&Texture::new("small", 2, 1, vec![1, 2, 3, 255, 4, 5, 6, 255], ColorSpace::Srgb));
        assert_eq!((small.size, small.pixels[1]), ([2, 1], Color32::from_rgb(4, 5, 6)));
    }
}
