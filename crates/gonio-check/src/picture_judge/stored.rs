//! The pictures of a reference as bytes, for places where its source must not be.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `GONIOPIC` |
//! | 4 | version, 1 |
//! | 8 | a hash of the test scenes: pictures of other scenes are refused |
//! | 4, 4 | number of test scenes, number of mistakes |
//! | | for each mistake, the length of its id in 4 bytes, and the id |
//! | | the pictures of the reference, then those of each mistake |
//!
//! A picture of a scene is a bit for each of its pixels, set where something was drawn, and four `f32` for each of those. All
//! numbers are little-endian.

use crate::testbench::{Atlas, TILE, TestScene};
use gonio_language::tr;
use gonio_render::user_program::NOT_DRAWN;
use std::fmt;

const MAGIC: &[u8; 8] = b"GONIOPIC";
const VERSION: u32 = 1;
const PIXELS: usize = (TILE * TILE) as usize;
/// Most scenes and most mistakes of a file: a reader allocates no more.
const MOST: usize = 1000;

/// The pictures of a reference and of its mistakes.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredPictures {
    /// The test scenes.
    pub scenes: Vec<TestScene>,
    /// The right pictures.
    pub reference: Atlas,
    /// The pictures of mistakes by their ids.
    pub mistakes: Vec<(String, Atlas)>,
}

/// The reason why stored pictures cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoredPicturesError {
    /// They are something else, or damaged.
    Damaged,
    /// They were made for other test scenes: by another version of gonio, or before the exercise changed.
    OtherScenes,
}

impl fmt::Display for StoredPicturesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            StoredPicturesError::Damaged => tr!("check-stored-pictures-damaged"),
            StoredPicturesError::OtherScenes => tr!("check-stored-pictures-other-scenes"),
        })
    }
}

impl std::error::Error for StoredPicturesError {}

impl StoredPictures {
    /// Writes them.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX).to_le_bytes();
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(hash(&self.scenes).to_le_bytes());
        bytes.extend(number(self.scenes.len()));
        bytes.extend(number(self.mistakes.len()));
        for (id, _) in &self.mistakes {
            bytes.extend(number(id.len()));
            bytes.extend(id.as_bytes());
        }
        for atlas in std::iter::once(&self.reference).chain(self.mistakes.iter().map(|(_, atlas)| atlas)) {
            for tile in 0..self.scenes.len() {
                write_tile(&mut bytes, atlas.tile(tile));
            }
        }
        bytes
    }

    /// Reads pictures of these test scenes.
    ///
    /// # Errors
    /// The bytes are something else, or pictures of other scenes.
    pub fn from_bytes(bytes: &[u8], scenes: &[TestScene]) -> Result<Self, StoredPicturesError> {
        let mut reader = Reader { rest: bytes };
        if reader.take(8) != Some(MAGIC.as_slice()) {
            return Err(StoredPicturesError::Damaged);
        }
        let header = |reader: &mut Reader<'_>| {
            let version = reader.number()?;
            let hash = u64::from_le_bytes(reader.take(8)?.try_into().ok()?);
            Some((version, hash, reader.number()? as usize, reader.number()? as usize))
        };
        let (version, made_for, tiles, mistakes) = header(&mut reader).ok_or(StoredPicturesError::Damaged)?;
        if version != VERSION || made_for != hash(scenes) || tiles != scenes.len() {
            return Err(StoredPicturesError::OtherScenes);
        }
        let read = |reader: &mut Reader<'_>| {
            if mistakes > MOST || tiles > MOST {
                return None;
            }
            let ids = (0..mistakes).map(|_| {
                let length = reader.number()? as usize;
                String::from_utf8(reader.take(length)?.to_vec()).ok()
            });
            let ids = ids.collect::<Option<Vec<String>>>()?;
            let reference = reader.atlas(tiles)?;
            let mistakes = ids.into_iter().map(|id| Some((id, reader.atlas(tiles)?))).collect::<Option<Vec<_>>>()?;
            reader.rest.is_empty().then(|| StoredPictures { scenes: scenes.to_vec(), reference, mistakes })
        };
        read(&mut reader).ok_or(StoredPicturesError::Damaged)
    }
}

/// A hash of everything in the scenes that a picture depends on.
fn hash(scenes: &[TestScene]) -> u64 {
    // Their own texts state every number with all its digits.
    super::fnv(format!("{scenes:?}").as_bytes())
}

fn write_tile(bytes: &mut Vec<u8>, tile: &[[f32; 4]]) {
    let is_drawn = |at: usize| tile.get(at).is_some_and(Atlas::is_drawn);
    for first in (0..PIXELS).step_by(8) {
        bytes.push((0..8).filter(|bit| is_drawn(first + bit)).fold(0, |byte, bit| byte | 1 << bit));
    }
    for pixel in tile.iter().take(PIXELS).filter(|pixel| Atlas::is_drawn(pixel)) {
        bytes.extend(pixel.iter().flat_map(|channel| channel.to_le_bytes()));
    }
}

struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        Some(taken)
    }

    fn number(&mut self) -> Option<u32> {
        Some(u32::from_le_bytes(self.take(4)?.try_into().ok()?))
    }

    fn atlas(&mut self, tiles: usize) -> Option<Atlas> {
        let mut pixels = Vec::new();
        for _ in 0..tiles {
            let drawn = self.take(PIXELS / 8)?;
            for at in 0..PIXELS {
                pixels.push(match drawn[at / 8] >> (at % 8) & 1 {
                    0 => NOT_DRAWN,
                    _ => {
                        let mut pixel = [0.0; 4];
                        for channel in &mut pixel {
                            *channel = f32::from_le_bytes(self.take(4)?.try_into().ok()?);
                        }
                        pixel
                    }
                });
            }
        }
        Some(Atlas { pixels })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testbench::scene;

    fn stored() -> StoredPictures {
        let scenes = scene::skies();
        let atlas = |light: f32| {
            let pixel = |at: usize| if at.is_multiple_of(3) { NOT_DRAWN } else { [light, at as f32, -1.5, 1.0] };
            Atlas { pixels: (0..scenes.len() * PIXELS).map(pixel).collect() }
        };
        StoredPictures { reference: atlas(0.25), mistakes: vec![("upside-down".to_owned(), atlas(0.5))], scenes }
    }

    #[test]
    fn pictures_survive_a_round_trip_and_damaged_ones_are_refused() {
        let stored = stored();
        let bytes = stored.to_bytes();
        assert_eq!(StoredPictures::from_bytes(&bytes, &stored.scenes), Ok(stored.clone()));
        for length in (0..bytes.len()).step_by(97) {
            assert!(StoredPictures::from_bytes(&bytes[..length], &stored.scenes).is_err(), "cut at {length}");
        }
        let longer = [bytes.as_slice(), b"x"].concat();
        assert_eq!(StoredPictures::from_bytes(&longer, &stored.scenes), Err(StoredPicturesError::Damaged));
    }

    #[test]
    fn pictures_of_other_scenes_are_refused() {
        let stored = stored();
        let mut scenes = stored.scenes.clone();
        scenes[1].shininess += 1.0;
        assert_eq!(StoredPictures::from_bytes(&stored.to_bytes(), &scenes), Err(StoredPicturesError::OtherScenes));
    }
}
