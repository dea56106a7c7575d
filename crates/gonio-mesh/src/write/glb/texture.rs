//! Writes textures and images.

use super::buffer::Buffer;
use crate::report::Reports;
use crate::{EmbeddedImage, Severity, TextureMap, Wrap};
use serde_json::{Value, json};
use std::collections::HashMap;

/// An image: its index in the model, or its path.
pub(super) type PictureKey = (Option<usize>, String);

/// The written textures, samplers and images.
pub(super) struct TextureLists {
    pub textures: Vec<Value>,
    pub samplers: Vec<Value>,
    pub images: Vec<Value>,
}

/// Writes each image, texture and sampler once.
pub(super) struct TextureWriter<'m, 'i> {
    embedded: &'m [EmbeddedImage],
    ask: &'i mut dyn FnMut(&TextureMap) -> Option<Vec<u8>>,
    written: TextureLists,
    known_images: HashMap<PictureKey, Option<usize>>,
    known_samplers: HashMap<[Wrap; 2], usize>,
    known_textures: HashMap<(usize, usize), usize>,
}

impl<'m, 'i> TextureWriter<'m, 'i> {
    pub fn new(embedded: &'m [EmbeddedImage], ask: &'i mut dyn FnMut(&TextureMap) -> Option<Vec<u8>>) -> Self {
        TextureWriter {
            embedded,
            ask,
            written: TextureLists { textures: Vec::new(), samplers: Vec::new(), images: Vec::new() },
            known_images: HashMap::new(),
            known_samplers: HashMap::new(),
            known_textures: HashMap::new(),
        }
    }

    pub fn finish(&mut self) -> TextureLists {
        let TextureLists { textures, samplers, images } = &mut self.written;
        let take = std::mem::take::<Vec<Value>>;
        TextureLists { textures: take(textures), samplers: take(samplers), images: take(images) }
    }

    /// Returns a textureInfo; `None` if its image is not available.
    pub fn info(&mut self, map: &TextureMap, buffer: &mut Buffer, reports: &mut Reports) -> Option<Value> {
        let image = self.image(map, buffer, reports)?;
        let samplers = &mut self.written.samplers;
        let sampler = *self.known_samplers.entry(map.wrap).or_insert_with(|| {
            let [s, t] = map.wrap.map(|wrap| match wrap {
                Wrap::Repeat => 10497,
                Wrap::Clamp => 33071,
                Wrap::Mirror => 33648,
            });
            // Linear, and linear between mipmaps.
            samplers.push(json!({ "wrapS": s, "wrapT": t, "magFilter": 9729, "minFilter": 9987 }));
            samplers.len() - 1
        });
        let textures = &mut self.written.textures;
        let texture = *self.known_textures.entry((image, sampler)).or_insert_with(|| {
            textures.push(json!({ "source": image, "sampler": sampler }));
            textures.len() - 1
        });
        let mut info = json!({ "index": texture });
        if let Some(transform) = transform(map) {
            info["extensions"] = json!({ "KHR_texture_transform": transform });
        }
        Some(info)
    }

    fn image(&mut self, map: &TextureMap, buffer: &mut Buffer, reports: &mut Reports) -> Option<usize> {
        let key = key(map);
        if let Some(known) = self.known_images.get(&key) {
            return *known;
        }
        let inside = map.embedded.and_then(|index| self.embedded.get(index));
        let asked = if inside.is_none() { (self.ask)(map) } else { None };
        let bytes = inside.map(|image| image.bytes.as_slice()).or(asked.as_deref());
        let kind = bytes.and_then(mime_type);
        let image = bytes.zip(kind).map(|(bytes, kind)| {
            let view = buffer.file(bytes);
            self.written.images.push(json!({ "name": map.path, "mimeType": kind, "bufferView": view }));
            self.written.images.len() - 1
        });
        if image.is_none() {
            let why = if bytes.is_some() { "is neither PNG nor JPEG" } else { "was not found" };
            let message = || format!("the texture {:?} {why}: it is not written", map.path);
            reports.add_without_line("textures that are not written", Severity::Warning, message);
        }
        self.known_images.insert(key, image);
        image
    }
}

pub(super) fn key(map: &TextureMap) -> PictureKey {
    (map.embedded, if map.embedded.is_some() { String::new() } else { map.path.clone() })
}

fn mime_type(bytes: &[u8]) -> Option<&'static str> {
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some("image/png")
    } else if bytes.starts_with(b"\xFF\xD8\xFF") {
        Some("image/jpeg")
    } else {
        None
    }
}

/// Returns `KHR_texture_transform`: the reader's formula solved for its offset.
fn transform(map: &TextureMap) -> Option<Value> {
    if map.scale == [1.0; 2] && map.rotation == 0.0 && map.offset == [0.0; 2] {
        return None;
    }
    let (sin, cos) = f64::from(map.rotation).sin_cos();
    let [u, v] = map.offset.map(f64::from);
    let scale_v = f64::from(map.scale[1]);
    let offset = [u - scale_v * sin, 1.0 - v - scale_v * cos];
    Some(json!({ "offset": offset, "rotation": map.rotation, "scale": map.scale }))
}
