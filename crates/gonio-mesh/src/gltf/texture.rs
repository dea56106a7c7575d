//! Textures: their images, transforms and wrap modes.

use super::buffer::Buffers;
use super::json::JsonRef;
use super::uri::Uri;
use crate::diagnostic::Reports;
use crate::{Cause, Diagnostic, EmbeddedImage, ReadError, Severity, TextureMap, Wrap};
use std::collections::HashMap;

/// The images of a file, read on demand.
pub(super) struct Textures<'v> {
    root: JsonRef<'v>,
    /// Images inside the file.
    pub images: Vec<EmbeddedImage>,
    /// By index in the file.
    known: HashMap<usize, Picture>,
    bytes: u64,
    max_bytes: u64,
    nearest_is_said: bool,
}

#[derive(Clone)]
struct Picture {
    path: String,
    embedded: Option<usize>,
}

/// A texture and its set TEXCOORD_n of texture coordinates.
pub(super) struct TextureUse {
    pub map: TextureMap,
    pub tex_coord_set: usize,
}

impl<'v> Textures<'v> {
    /// Creates the textures of a file. Images inside the file may take `max_bytes` together.
    pub fn new(root: JsonRef<'v>, max_bytes: u64) -> Self {
        let (images, known) = (Vec::new(), HashMap::new());
        Textures { root, images, known, bytes: 0, max_bytes, nearest_is_said: false }
    }

    /// Reads the texture of a textureInfo; reports one that is invalid and returns `None`.
    pub fn map(
        &mut self,
        info: JsonRef<'v>,
        buffers: &mut Buffers<'v, '_>,
        reports: &mut Reports,
    ) -> Option<TextureUse> {
        match self.try_map(info, buffers, reports) {
            Ok(placed) => Some(placed),
            Err(error) => {
                let message = || format!("{}: the texture is left out", error.message);
                reports.add_without_line("textures that are left out", Severity::Warning, message);
                None
            }
        }
    }

    fn try_map(
        &mut self,
        info: JsonRef<'v>,
        buffers: &mut Buffers<'v, '_>,
        reports: &mut Reports,
    ) -> Result<TextureUse, ReadError> {
        let Some((_, texture)) = info.target(self.root, "index", "textures")? else {
            return Err(info.missing("index"));
        };
        let picture = self.picture(texture, buffers)?;
        let mut map = TextureMap { embedded: picture.embedded, ..TextureMap::new(picture.path) };
        if let Some((_, sampler)) = texture.target(self.root, "sampler", "samplers")? {
            map.wrap = [wrap(sampler, "wrapS")?, wrap(sampler, "wrapT")?];
            // 9728: NEAREST.
            if sampler.unsigned("magFilter")? == Some(9728) && !std::mem::replace(&mut self.nearest_is_said, true) {
                let note = format!(
                    "{} asks for nearest-neighbor filtering: textures are always filtered linearly",
                    sampler.path()
                );
                reports.push(0, Diagnostic::note(note));
            }
        }
        let mut tex_coord_set = info.index("texCoord")?.unwrap_or(0);
        if let Some(transform) = info.extension("KHR_texture_transform") {
            set_transform(&mut map, transform)?;
            tex_coord_set = transform.index("texCoord")?.unwrap_or(tex_coord_set);
        }
        Ok(TextureUse { map, tex_coord_set })
    }

    fn picture(&mut self, texture: JsonRef<'v>, buffers: &mut Buffers<'v, '_>) -> Result<Picture, ReadError> {
        let mut source = texture.target(self.root, "source", "images")?;
        for name in ["EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"] {
            if let (None, Some(extension)) = (source, texture.extension(name)) {
                source = extension.target(self.root, "source", "images")?;
            }
        }
        let (index, image) = source.ok_or_else(|| texture.missing("source"))?;
        if let Some(picture) = self.known.get(&index) {
            return Ok(picture.clone());
        }
        let name = if image.name().is_empty() { image.path() } else { image.name().to_owned() };
        let picture = match (image.text("uri")?, buffers.view(image, "bufferView")?) {
            (Some(uri), _) => match Uri::parse(uri) {
                Uri::File(path) => Picture { path: path.into_owned(), embedded: None },
                Uri::Data(Ok(bytes)) => self.embed(name, bytes, image)?,
                Uri::Data(Err(reason)) => {
                    return Err(ReadError::new(format!("invalid data in {}.uri: {reason}", image.path())));
                }
                Uri::Elsewhere => return Err(ReadError::new(format!("{} is not fetched", image.written("uri")))),
            },
            (None, Some(view)) => {
                self.check_bytes(view.bytes().len(), image)?;
                self.embed(name, view.bytes().to_vec(), image)?
            }
            (None, None) => return Err(image.missing("uri and no bufferView")),
        };
        self.known.insert(index, picture.clone());
        Ok(picture)
    }

    fn check_bytes(&self, more: usize, image: JsonRef<'_>) -> Result<(), ReadError> {
        let most = self.max_bytes;
        if self.bytes.saturating_add(more as u64) <= most {
            return Ok(());
        }
        let message = format!("{} makes the images larger than {most} bytes, which is the limit", image.path());
        Err(ReadError::new(message).caused_by(Cause::MemoryLimit))
    }

    fn embed(&mut self, name: String, bytes: Vec<u8>, image: JsonRef<'_>) -> Result<Picture, ReadError> {
        self.check_bytes(bytes.len(), image)?;
        self.bytes += bytes.len() as u64;
        self.images.push(EmbeddedImage { name: name.clone(), bytes });
        Ok(Picture { path: name, embedded: Some(self.images.len() - 1) })
    }
}

fn wrap(sampler: JsonRef<'_>, key: &'static str) -> Result<Wrap, ReadError> {
    match sampler.unsigned(key)? {
        None | Some(10497) => Ok(Wrap::Repeat),
        Some(33071) => Ok(Wrap::Clamp),
        Some(33648) => Ok(Wrap::Mirror),
        Some(_) => {
            let what = "which is not 10497 (repeat), 33071 (clamp) or 33648 (mirror)";
            Err(ReadError::new(format!("{}, {what}", sampler.written(key))))
        }
    }
}

/// Applies `KHR_texture_transform`, whose v points down, to coordinates with v up.
///
/// With v down and a counter-clockwise rotation as seen, s = scale, t = rotation, o = offset:
///
/// ```text
/// u' =  cos t (s_u u) + sin t (s_v v) + o_u
/// v' = -sin t (s_u u) + cos t (s_v v) + o_v
/// ```
///
/// With V = 1 - v and V' = 1 - v' (V up):
///
/// ```text
/// u' = cos t (s_u u) - sin t (s_v V) + (o_u + s_v sin t)
/// V' = sin t (s_u u) + cos t (s_v V) + (1 - o_v - s_v cos t)
/// ```
///
/// which is `R(t) * (s * uv) + offset` with the same scale and the same angle.
fn set_transform(map: &mut TextureMap, transform: JsonRef<'_>) -> Result<(), ReadError> {
    let offset = transform.numbers("offset")?.unwrap_or([0.0; 2]);
    let scale = transform.numbers("scale")?.unwrap_or([1.0; 2]);
    let rotation = transform.number("rotation")?.unwrap_or(0.0);
    let (sin, cos) = rotation.sin_cos();
    map.scale = scale.map(|s| s as f32);
    map.rotation = rotation as f32;
    map.offset = [(offset[0] + scale[1] * sin) as f32, (1.0 - offset[1] - scale[1] * cos) as f32];
    let numbers = [map.scale, map.offset].concat();
    if numbers.iter().all(|n| n.is_finite()) && map.rotation.is_finite() {
        return Ok(());
    }
    Err(ReadError::new(format!("{} has numbers that are too large", transform.path())))
}
