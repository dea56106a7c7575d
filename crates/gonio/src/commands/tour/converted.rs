//! Pictures that no scene draws: built-in environments laid out on the plane, exactly as `gonio environment convert`
//! writes them.

use crate::report::CliError;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::convert::{Conversion, From};
use gonio_environment::{Builtin, CubeMips, Cubemap, Layout};
use gonio_image::decode::{Shape, decode};
use gonio_image::encode::{ktx2, png};
use gonio_image::{Image, Limits};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_scene::environment_file::{self, Reading, Source};
use gonio_scene::files::BuiltinOnly;
use gonio_scene::picture::EncodedPicture;
use std::path::Path;

/// An environment, and what is made of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Converted {
    /// What it is made from.
    pub from: Builtin,
    /// What is made.
    pub to: Target,
}

/// What an environment becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// An equirectangular picture, twice as wide as high.
    Panorama,
    /// First a cubemap of so many texels an edge, then a panorama of that.
    PanoramaBack(u32),
    /// Six faces in one picture: a cross or a strip.
    Faces(Arrangement, Layout),
}

/// A picture of an environment.
pub struct LaidOut {
    image: Image,
    transform: OutputTransform,
    /// Columns and rows of faces, and which of them have one; none of a panorama.
    cells: Option<Image>,
}

impl Converted {
    /// Width over height.
    pub fn aspect(self) -> f64 {
        match self.to {
            Target::Panorama | Target::PanoramaBack(_) => 2.0,
            Target::Faces(arrangement, _) => {
                arrangement.grid().map_or(1.0, |(columns, rows)| f64::from(columns) / f64::from(rows))
            }
        }
    }

    /// The number after `--size` for a picture that is at least `width` pixels wide: a panorama's width (even, so that
    /// it is half as high), or that of one face.
    fn size(self, width: u32) -> u32 {
        match self.to {
            Target::Panorama | Target::PanoramaBack(_) => width.max(2).next_multiple_of(2),
            Target::Faces(arrangement, _) => {
                width.div_ceil(arrangement.grid().map_or(1, |(columns, _)| columns)).max(1)
            }
        }
    }

    /// Light above 1 is brought into range; the debug cubemap has none, and keeps its colours.
    fn tone_map(self) -> ToneMap {
        if self.from == Builtin::Debug { ToneMap::None } else { ToneMap::Aces }
    }

    /// Makes the picture, at least `width` pixels wide.
    pub fn lay_out(self, width: u32) -> Result<LaidOut, CliError> {
        let size = self.size(width);
        let conversion = Conversion::default();
        let panorama = |from: From<'_>| conversion.panorama(from, size, size / 2).image;
        let (image, cells) = match self.to {
            Target::Panorama => (panorama(self.open(None, None)?.as_from()), None),
            Target::PanoramaBack(face) => {
                let there = cubemap(self.open(Some(face), None)?, face);
                // Through a file, as the command does it: half floats.
                let bytes = CubeMips::new(there).to_ktx2(ktx2::Format::Half).bytes;
                let faces = match decode("cubemap.ktx2", &bytes, &Limits::default()).map_err(failed)?.shape {
                    Shape::Faces(faces) => *faces,
                    Shape::Picture(_) => return Err(CliError::new("a KTX2 cubemap was read as one picture")),
                };
                let there = Cubemap::from_faces(faces, Layout::OpenGl).map_err(failed)?;
                (panorama(From::Cubemap(&there)), None)
            }
            Target::Faces(arrangement, layout) => {
                let map = cubemap(self.open(Some(size), Some(layout))?, size);
                let cells = arrange::from_cubemap(&Cubemap::new(1, [1.0; 4]), arrangement, layout).map_err(failed)?;
                (arrange::from_cubemap(&map, arrangement, layout).map_err(failed)?, Some(cells))
            }
        };
        let transform = OutputTransform { exposure: 0.0, tone_map: self.tone_map(), encoding: ColorEncoding::Srgb };
        Ok(LaidOut { image, transform, cells })
    }

    fn open(self, size: Option<u32>, layout: Option<Layout>) -> Result<Source, CliError> {
        // Names of files stand on the debug cubemap only.
        let layout = layout.filter(|_| self.from == Builtin::Debug);
        let reading = Reading { layout, arrangement: None, size };
        let limits = gonio_mesh::Limits::default();
        let opened = environment_file::open(self.from.name(), reading, Path::new(""), &BuiltinOnly, &limits)?;
        Ok(opened.source)
    }

    /// The commands that make the picture again.
    pub fn command(self, name: &str, width: u32) -> String {
        let (from, size) = (self.from.name(), self.size(width));
        let tone_map = match self.tone_map() {
            ToneMap::None => String::new(),
            other => format!(" --tone-map {other}"),
        };
        match self.to {
            Target::Panorama => format!("gonio environment convert {from} {name}.png --size {size}{tone_map}"),
            Target::PanoramaBack(face) => format!(
                "gonio environment convert {from} {from}.ktx2 --size {face} && \
                 gonio environment convert {from}.ktx2 {name}.png --size {size}{tone_map}"
            ),
            Target::Faces(arrangement, layout) => format!(
                "gonio environment convert {from} {name}.png --to {arrangement} --layout {layout} --size \
                 {size}{tone_map}"
            ),
        }
    }
}

/// Six faces of a size.
fn cubemap(source: Source, size: u32) -> Cubemap {
    match source {
        Source::Cubemap(map) if map.size() == size => map,
        other => Conversion::default().cubemap(other.as_from(), size),
    }
}

impl LaidOut {
    /// The file's bytes; empty cells are black.
    pub fn png(&self) -> Result<Vec<u8>, CliError> {
        png::encode(&self.image, &self.transform, png::Depth::Eight).map_err(failed)
    }

    /// For the sheet; empty cells are transparent.
    pub fn encoded(&self) -> EncodedPicture<u8> {
        let (width, height) = (self.image.width, self.image.height);
        let is_empty = |index: usize| {
            self.cells.as_ref().is_some_and(|cells| {
                let (x, y) = (index as u64 % u64::from(width), index as u64 / u64::from(width));
                let cell = |at: u64, cells: u32, pixels: u32| (at * u64::from(cells) / u64::from(pixels)) as u32;
                cells.at(cell(x, cells.width, width), cell(y, cells.height, height))[0] == 0.0
            })
        };
        let rgb = png::rows8(&self.image, &self.transform);
        let pixels = rgb.as_chunks::<3>().0.iter().enumerate();
        let rgba = pixels.flat_map(|(i, &[r, g, b])| [r, g, b, if is_empty(i) { 0 } else { u8::MAX }]).collect();
        EncodedPicture { width, height, rgba }
    }
}

fn failed(error: impl std::fmt::Display) -> CliError {
    CliError::new(error.to_string())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn sizes_are_as_asked_or_a_little_more() {
        let cross = Converted { from: Builtin::Debug, to: Target::Faces(Arrangement::Cross, Layout::OpenGl) };
        let picture = cross.lay_out(41).unwrap().encoded();
        assert_eq!((picture.width, picture.height), (44, 33));
        let panorama = Converted { from: Builtin::Room, to: Target::Panorama }.lay_out(41).unwrap().encoded();
        assert_eq!((panorama.width, panorama.height), (42, 21));
        assert_eq!(Converted { from: Builtin::Room, to: Target::PanoramaBack(8) }.lay_out(0).unwrap().image.width, 2);
    }

    #[test]
    fn empty_cells_are_see_through_and_no_others() {
        let cross = Converted { from: Builtin::Sky, to: Target::Faces(Arrangement::Cross, Layout::Photographic) };
        let picture = cross.lay_out(32).unwrap().encoded();
        let alphas: Vec<u8> = picture.rgba.iter().skip(3).step_by(4).copied().collect();
        let row = |y: usize| (0..4).map(|c| alphas[y * 32 + c * 8 + 4] / 255).collect::<Vec<u8>>();
        assert_eq!([row(4), row(12), row(20)], [vec![0, 1, 0, 0], vec![1; 4], vec![0, 1, 0, 0]]);
        assert_eq!(alphas.iter().filter(|a| **a == 0).count(), 6 * 64);
    }

    #[test]
    fn there_and_back_is_the_same_world() {
        let direct = Converted { from: Builtin::Room, to: Target::Panorama }.lay_out(64).unwrap();
        let back = Converted { from: Builtin::Room, to: Target::PanoramaBack(128) }.lay_out(64).unwrap();
        let pixels = || direct.image.pixels.iter().zip(&back.image.pixels);
        // Means over 8 x 8 texels; what is lost is a little sharpness and 11 bits of each number.
        let mean = pixels().map(|(a, b)| (a[1] - b[1]).abs() / (0.05 + a[1])).sum::<f32>() / pixels().count() as f32;
        assert!(mean < 0.05, "{mean}");
    }
}
