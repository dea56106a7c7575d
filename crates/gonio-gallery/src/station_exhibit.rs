//! Small pictures of the stations beyond the rendering equation, as `gonio beyond` computes them.

use gonio_beyond::{PictureRefinement, Station, StationPicture};
use gonio_image::encode::png::{self, Depth};
use gonio_image::{EncodedPicture, Image, ImageError};

/// A picture of a station with its defaults.
#[derive(Clone, Copy, Debug)]
pub struct StationExhibit {
    /// The station.
    pub station: &'static Station,
    /// One of its pictures.
    pub picture: &'static StationPicture,
    /// Samples of each pixel.
    pub samples: u32,
}

/// A computed picture.
pub struct ComputedStation {
    image: Image,
    picture: &'static StationPicture,
}

impl StationExhibit {
    /// Width over height, for which the pictures are composed.
    pub const ASPECT: f64 = 4.0 / 3.0;
    /// Size as a multiple of the size on the sheet: computing these pictures takes long.
    pub const SCALE: f64 = 0.5;

    /// The main picture of a station; `None` if there is no such station.
    pub fn of(name: &str) -> Option<Self> {
        let station = gonio_beyond::station(name)?;
        // Each sample of light that leaves a body is the mean of several walks.
        let samples = if name == "subsurface" { 1 } else { 4 };
        Some(Self { station, picture: station.pictures.first()?, samples })
    }

    /// The name of the picture's file without an extension, as `gonio beyond` names it.
    pub fn file_stem(self) -> String {
        format!("{}-{}", self.station.name, self.picture.name)
    }

    /// Computes the picture.
    pub fn compute(self, width: u32, height: u32) -> ComputedStation {
        let plane = (self.picture.image_plane)(&self.station.defaults());
        let mut refined = PictureRefinement::of_pixels(plane, [width, height], 0);
        refined.complete(self.samples, &|_| true);
        ComputedStation { image: refined.picture(), picture: self.picture }
    }
}

impl ComputedStation {
    /// The picture as displayed.
    pub fn encoded(&self) -> EncodedPicture<u8> {
        let rgb = png::rows8(&self.image, &self.picture.output);
        let rgba = rgb.as_chunks::<3>().0.iter().flat_map(|[red, green, blue]| [*red, *green, *blue, 255]).collect();
        EncodedPicture { width: self.image.width, height: self.image.height, rgba }
    }

    /// The picture in another size, interpolated linearly.
    pub fn resized(&self, width: u32, height: u32) -> EncodedPicture<u8> {
        let last = |side: u32| side.saturating_sub(1);
        let place = |to: u32, of: u32, from: u32| {
            let at = ((f64::from(to) + 0.5) * f64::from(from) / f64::from(of) - 0.5).clamp(0.0, f64::from(last(from)));
            (at as u32, (at as u32 + 1).min(last(from)), at.fract() as f32)
        };
        let mut image = Image::new(width, height, [0.0; 4]);
        for (index, pixel) in image.pixels.iter_mut().enumerate() {
            let (left, right, across) = place(index as u32 % width, width, self.image.width);
            let (top, bottom, down) = place(index as u32 / width, height, self.image.height);
            let mixed = |a: [f32; 4], b: [f32; 4], share: f32| std::array::from_fn(|i| a[i] + share * (b[i] - a[i]));
            let row = |y: u32| mixed(self.image.at(left, y), self.image.at(right, y), across);
            *pixel = mixed(row(top), row(bottom), down);
        }
        ComputedStation { image, picture: self.picture }.encoded()
    }

    /// The picture as PNG.
    ///
    /// # Errors
    ///
    /// A picture that is too large.
    pub fn png(&self) -> Result<Vec<u8>, ImageError> {
        png::encode(&self.image, &self.picture.output, Depth::Eight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_the_mean_of_its_samples() {
        let Some(exhibit) = StationExhibit::of("interference") else { panic!("no such station") };
        let picture = exhibit.compute(40, 30).encoded();
        assert_eq!((picture.width, picture.height, picture.rgba.len()), (40, 30, 4 * 1200));
        assert_eq!(exhibit.compute(40, 30).resized(40, 30), picture);
        let larger = exhibit.compute(40, 30).resized(120, 90);
        // The middle of a pixel is the middle of nine.
        assert_eq!(larger.rgba[4 * (31 * 120 + 61)..][..4], picture.rgba[4 * (10 * 40 + 20)..][..4]);
        let mut samples =
            PictureRefinement::of_pixels((exhibit.picture.image_plane)(&exhibit.station.defaults()), [40, 30], 0);
        samples.complete(exhibit.samples, &|_| true);
        assert_eq!(png::rows8(&samples.picture(), &exhibit.picture.output)[..3], picture.rgba[..3]);
        assert!(StationExhibit::of("nothing").is_none());
    }
}
