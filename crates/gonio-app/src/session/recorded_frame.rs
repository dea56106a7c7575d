//! The frame taken apart: what OpenGL was told for a picture, and what is looked at of it.

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use gonio_gl::trace::{Finding, FrameRecord, lint};
use std::collections::HashMap;

/// A record of a picture.
pub struct RecordedFrame {
    /// What was done.
    pub record: FrameRecord,
    /// What is wrong with it.
    pub findings: Vec<Finding>,
    /// Which picture it is of: [`super::FrameFacts::pictures`] when it was recorded.
    pub picture: u64,
    /// The draw that is looked at.
    pub draw: usize,
    /// Which of a program's shaders is read.
    pub fragment_source: bool,
    thumbnails: HashMap<u32, TextureHandle>,
}

impl RecordedFrame {
    /// Looks through a record. `before` is what was looked at until now: the same draw stays chosen.
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
