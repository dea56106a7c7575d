//! A recorded frame: the OpenGL calls of a picture, and the selected draw.

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use gonio_gl::trace::{Finding, FrameRecord, lint};
use std::collections::HashMap;

/// A record of a picture.
pub struct RecordedFrame {
    /// The record.
    pub record: FrameRecord,
    /// The problems found in it.
    pub findings: Vec<Finding>,
    /// The recorded picture: [`super::FrameFacts::pictures`] at the time.
    pub picture: u64,
    /// The selected draw.
    pub draw: usize,
    /// Whether the fragment shader's source is shown, not the vertex shader's.
    pub fragment_source: bool,
    thumbnails: HashMap<u32, TextureHandle>,
}

impl RecordedFrame {
    /// Checks a record. The draw that was selected in `before` stays selected.
    pub fn new(ctx: &Context, record: FrameRecord, picture: u64, before: Option<&RecordedFrame>) -> Self {
        let show = |id: u32| {
            let thumbnail = record.texture(id)?.thumbnail.as_ref()?;
            let size = [thumbnail.width as usize, thumbnail.height as usize];
            let image = ColorImage::from_rgba_unmultiplied(size, &thumbnail.rgba);
            Some((id, ctx.load_texture(format!("thumbnail {id}"), image, TextureOptions::LINEAR)))
        };
        let thumbnails = record.textures.iter().filter_map(|texture| show(texture.id)).collect();
        let last = record.draws.len().saturating_sub(1);
        RecordedFrame {
            findings: lint(&record),
            picture,
            draw: before.map_or(0, |before| before.draw.min(last)),
            fragment_source: before.is_none_or(|before| before.fragment_source),
            thumbnails,
            record,
        }
    }

    /// A small picture of a texture, by id.
    pub fn thumbnail(&self, id: u32) -> Option<&TextureHandle> {
        self.thumbnails.get(&id)
    }
}
