//! What a scene promises: messages, round trips, framing, motion, textures.

#![allow(clippy::unwrap_used)]

mod camera;
mod edit;
mod environments;
mod from_models;
mod lamps;
mod limits;
mod messages;
mod own_brdfs;
mod parts;
mod readers;
mod round_trip;
mod textures;

use gonio_scene::files::{FileBytes, FileSource, within};
use std::collections::BTreeMap;
use std::io::{Cursor, Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Files that exist only in a test, by path. Letters count in their case, as on most Unix disks.
#[derive(Default)]
pub struct Memory(BTreeMap<PathBuf, Vec<u8>>);

impl Memory {
    /// Adds a file.
    pub fn with(mut self, path: &str, bytes: impl Into<Vec<u8>>) -> Self {
        self.0.insert(path.into(), bytes.into());
        self
    }
}

impl FileSource for Memory {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        let bytes = self.0.get(path).cloned().ok_or(ErrorKind::NotFound)?;
        within(bytes.into(), most)
    }
    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let below =
            |p: &PathBuf| p.strip_prefix(folder).ok()?.components().next().map(|c| PathBuf::from(c.as_os_str()));
        let mut names: Vec<PathBuf> = self.0.keys().filter_map(below).collect();
        names.dedup();
        names
    }
}

/// One triangle with texture coordinates and the material `m`.
pub const TRIANGLE: &str = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nusemtl m\n\
                            f 1/1/1 2/2/1 3/3/1\n";

/// A PNG of RGBA texels, top row first.
pub fn png(width: u32, height: u32, texels: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let picture = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texels(x, y)));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}
