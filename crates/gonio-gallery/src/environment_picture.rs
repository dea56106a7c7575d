//! Built-in environments laid out on the plane. They are converted on the CPU, and no scene is drawn.

use crate::GalleryError;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::convert::{Conversion, EnvironmentRef};
use gonio_environment::{Builtin, CubeMips, Cubemap, Layout};
use gonio_image::decode::{DecodedContent, decode};
use gonio_image::encode::{ktx2, png};
use gonio_image::{DecodeLimits, EncodedPicture, Image, ImageError};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_scene::environment_file::{self, EnvironmentMap, EnvironmentReadOptions};
use gonio_scene::files::BuiltinOnly;
use std::path::Path;

/// A picture of a built-in environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnvironmentPicture {
    /// The environment.
    pub from: Builtin,
    /// The layout on the plane.
    pub form: PictureForm,
}

/// The layout of an environment on the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureForm {
    /// An equirectangular picture, twice as wide as high.
    Panorama,
    /// A panorama of a cubemap with so many texels along an edge, through a KTX2 file.
    PanoramaOfCubemap(u32),
    /// Six faces in one picture: a cross or a strip.
    Faces(Arrangement, Layout),
}

/// A converted environment.
pub struct ConvertedEnvironment {
    image: Image,
    transform: OutputTransform,
    /// One pixel for each cell of an arrangement of faces: black where a cell is empty. `None` for panoramas.
    cells: Option<Image>,
}

impl EnvironmentPicture {
    /// Width over height.
    pub fn aspect(self) -> f64 {
        match self.form {
            PictureForm::Panorama | PictureForm::PanoramaOfCubemap(_) => 2.0,
            PictureForm::Faces(arrangement, _) => {
                arrangement.grid().map_or(1.0, |(columns, rows)| f64::from(columns) / f64::from(rows))
            }
        }
    }

    /// The size to convert to for a picture that is at least `width` pixels wide: a panorama's width (even, so that its
    /// height is half of it), or the width of one face.
    pub fn size(self, width: u32) -> u32 {
        match self.form {
            PictureForm::Panorama | PictureForm::PanoramaOfCubemap(_) => width.max(2).next_multiple_of(2),
            PictureForm::Faces(arrangement, _) => {
                width.div_ceil(arrangement.grid().map_or(1, |(columns, _)| columns)).max(1)
            }
        }
    }

    /// The tone map that brings light above 1 into range. The debug cubemap has none, and keeps its colours.
    pub fn tone_map(self) -> ToneMap {
        if self.from == Builtin::Debug { ToneMap::None } else { ToneMap::Aces }
    }

    /// Converts the environment to a picture that is at least `width` pixels wide.
    ///
    /// # Errors
    ///
    /// A built-in environment that cannot be read or converted.
    pub fn convert(self, width: u32) -> Result<ConvertedEnvironment, GalleryError> {
        let size = self.size(width);
        let conversion = Conversion::default();
        let panorama = |from: EnvironmentRef<'_>| conversion.panorama(from, size, size / 2).image;
        let (image, cells) = match self.form {
            PictureForm::Panorama => (panorama(self.open(None, None)?.as_environment()), None),
            PictureForm::PanoramaOfCubemap(face) => {
                let there = cubemap(self.open(Some(face), None)?, face);
                // Through a file, as a person converts it: half floats.
                let bytes = CubeMips::new(there).to_ktx2(ktx2::Ktx2Format::Half).bytes;
                let faces = match decode("cubemap.ktx2", &bytes, &DecodeLimits::default())?.shape {
                    DecodedContent::Faces(faces) => *faces,
                    DecodedContent::Picture(_) => {
                        return Err(GalleryError::Incomplete("a KTX2 cubemap was read as one picture".into()));
                    }
                };
                let there = Cubemap::from_faces(faces, Layout::OpenGl)?;
                (panorama(EnvironmentRef::Cubemap(&there)), None)
            }
            PictureForm::Faces(arrangement, layout) => {
                let map = cubemap(self.open(Some(size), Some(layout))?, size);
                let cells = arrange::from_cubemap(&Cubemap::new(1, [1.0; 4]), arrangement, layout)?;
                (arrange::from_cubemap(&map, arrangement, layout)?, Some(cells))
            }
        };
        let transform = OutputTransform { exposure: 0.0, tone_map: self.tone_map(), encoding: ColorEncoding::Srgb };
        Ok(ConvertedEnvironment { image, transform, cells })
    }

    fn open(self, size: Option<u32>, layout: Option<Layout>) -> Result<EnvironmentMap, GalleryError> {
        // Only the debug cubemap shows the names of files.
        let layout = layout.filter(|_| self.from == Builtin::Debug);
        let reading = EnvironmentReadOptions { layout, arrangement: None, size };
        let limits = gonio_mesh::Limits::default();
        let opened = environment_file::open(self.from.name(), reading, Path::new(""), &BuiltinOnly, &limits)?;
        Ok(opened.map)
    }
}

fn cubemap(source: EnvironmentMap, size: u32) -> Cubemap {
    match source {
        EnvironmentMap::Cubemap(map) if map.size() == size => map,
        other => Conversion::default().cubemap(other.as_environment(), size),
    }
}

impl ConvertedEnvironment {
    /// Encodes the picture as PNG; empty cells are black.
    ///
    /// # Errors
    ///
    /// A picture without pixels.
    pub fn png(&self) -> Result<Vec<u8>, ImageError> {
        png::encode(&self.image, &self.transform, png::Depth::Eight)
    }

    /// Encodes the picture for a screen; empty cells are transparent.
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn sizes_are_as_asked_or_a_little_more() {
        let cross =
            EnvironmentPicture { from: Builtin::Debug, form: PictureForm::Faces(Arrangement::Cross, Layout::OpenGl) };
        let picture = cross.convert(41).unwrap().encoded();
        assert_eq!((picture.width, picture.height), (44, 33));
        let panorama =
            EnvironmentPicture { from: Builtin::Room, form: PictureForm::Panorama }.convert(41).unwrap().encoded();
        assert_eq!((panorama.width, panorama.height), (42, 21));
        assert_eq!(
            EnvironmentPicture { from: Builtin::Room, form: PictureForm::PanoramaOfCubemap(8) }
                .convert(0)
                .unwrap()
                .image
                .width,
            2
        );
    }

    #[test]
    fn empty_cells_are_see_through_and_no_others() {
        let cross = EnvironmentPicture {
            from: Builtin::Sky,
            form: PictureForm::Faces(Arrangement::Cross, Layout::Photographic),
        };
        let picture = cross.convert(32).unwrap().encoded();
        let alphas: Vec<u8> = picture.rgba.iter().skip(3).step_by(4).copied().collect();
        let row = |y: usize| (0..4).map(|c| alphas[y * 32 + c * 8 + 4] / 255).collect::<Vec<u8>>();
        assert_eq!([row(4), row(12), row(20)], [vec![0, 1, 0, 0], vec![1; 4], vec![0, 1, 0, 0]]);
        assert_eq!(alphas.iter().filter(|a| **a == 0).count(), 6 * 64);
    }

    #[test]
    fn there_and_back_is_the_same_world() {
        let direct = EnvironmentPicture { from: Builtin::Room, form: PictureForm::Panorama }.convert(64).unwrap();
        let back =
            EnvironmentPicture { from: Builtin::Room, form: PictureForm::PanoramaOfCubemap(128) }.convert(64).unwrap();
        let pixels = || direct.image.pixels.iter().zip(&back.image.pixels);
        // Means over 8 x 8 texels; what is lost is a little sharpness and 11 bits of each number.
        let mean = pixels().map(|(a, b)| (a[1] - b[1]).abs() / (0.05 + a[1])).sum::<f32>() / pixels().count() as f32;
        assert!(mean < 0.05, "{mean}");
    }
}
