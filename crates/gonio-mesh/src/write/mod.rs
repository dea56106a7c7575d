//! Writes models as OBJ with MTL, as PLY and as GLB.
//!
//! Writers take a model and return bytes; they open no files. Numbers have as many digits as needed to read the same
//! `f32` again. Diagnostics list the properties that a format cannot store.

pub mod glb;
mod mtl;
pub mod obj;
pub mod ply;
mod text;

use crate::weld::{Table, mix};
use crate::{Material, Model, TextureMap};

/// An image to write to a file beside the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageFile {
    /// Its name in the written model.
    pub name: String,
    /// Index into [`crate::Model::images`].
    pub image: usize,
}

/// Returns unique names, `STEM_NAME.png`, for the images inside the model that its textures use.
fn image_files(model: &Model, stem: &str) -> Vec<ImageFile> {
    let is_used = |image: usize| textures(model).any(|texture| texture.embedded == Some(image));
    let mut files: Vec<ImageFile> = Vec::new();
    for (image, embedded) in model.images.iter().enumerate().filter(|(image, _)| is_used(*image)) {
        let extension = picture_extension(&embedded.bytes);
        let base = embedded.name.rsplit(['/', '\\']).next().unwrap_or_default();
        let base = base.strip_suffix(extension).and_then(|b| b.strip_suffix('.')).unwrap_or(base);
        let base: String = base.chars().map(|c| if is_plain(c) { c } else { '_' }).take(80).collect();
        let base = if base.is_empty() { image.to_string() } else { base };
        let mut name = format!("{stem}_{base}.{extension}");
        let mut number = 1;
        while files.iter().any(|file| file.name.eq_ignore_ascii_case(&name)) {
            number += 1;
            name = format!("{stem}_{base}_{number}.{extension}");
        }
        files.push(ImageFile { name, image });
    }
    files
}

fn is_plain(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '-' | '_' | '.')
}

/// Returns the file name extension for an image by its first bytes.
fn picture_extension(bytes: &[u8]) -> &'static str {
    const SIGNATURES: [(&[u8], &str); 6] = [
        (b"\x89PNG", "png"),
        (b"\xFF\xD8\xFF", "jpg"),
        (b"GIF8", "gif"),
        (b"BM", "bmp"),
        (b"\xABKTX", "ktx2"),
        (b"\x76\x2F\x31\x01", "exr"),
    ];
    let is_webp = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP");
    let known = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)).map(|(_, extension)| *extension);
    known.unwrap_or(if is_webp { "webp" } else { "img" })
}

fn textures(model: &Model) -> impl Iterator<Item = &TextureMap> {
    model.materials.iter().flat_map(Material::textures)
}

/// Returns the path of a texture in a written file.
fn texture_path<'a>(texture: &'a TextureMap, images: &'a [ImageFile]) -> &'a str {
    let file = texture.embedded.and_then(|index| images.iter().find(|file| file.image == index));
    file.map_or(texture.path.as_str(), |file| file.name.as_str())
}

/// Formats a count: `1 light`, `2 lights`.
fn counted(count: usize, one: &str) -> String {
    format!("{count} {one}{}", if count == 1 { "" } else { "s" })
}

/// Values without repetition, in the order of their first use.
struct Distinct {
    /// For each value the number of the equal distinct one.
    number_of: Vec<u32>,
    /// For each distinct value its first index.
    firsts: Vec<u32>,
}

impl Distinct {
    /// Finds the distinct ones of `count` values (below 2^32), `N` numbers each: values are equal if they have the same
    /// bits.
    fn from_values<const N: usize>(count: usize, value: impl Fn(usize) -> [f32; N]) -> Distinct {
        let bits = |index: usize| value(index).map(f32::to_bits);
        let mut table = Table::with_room_for(count);
        let mut distinct = Distinct { number_of: Vec::with_capacity(count), firsts: Vec::new() };
        for index in 0..count {
            let key = bits(index);
            let hash = key.iter().fold(0, |hash, &part| mix(hash ^ u64::from(part)));
            let firsts = &mut distinct.firsts;
            let found = table.find(hash, |number| bits(firsts[number as usize] as usize) == key);
            distinct.number_of.push(found.unwrap_or_else(|slot| {
                let number = firsts.len() as u32;
                table.fill(slot, number);
                firsts.push(index as u32);
                number
            }));
        }
        distinct
    }

    /// Returns the indices of the distinct values.
    fn indices(&self) -> impl Iterator<Item = usize> {
        self.firsts.iter().map(|&first| first as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_bits_are_one_value() {
        let values = [[0.0], [1.0], [-0.0], [1.0], [0.0]];
        let distinct = Distinct::from_values(values.len(), |i| values[i]);
        assert_eq!(distinct.number_of, [0, 1, 2, 1, 0]);
        assert_eq!(distinct.firsts, [0, 1, 2]);
    }
}
