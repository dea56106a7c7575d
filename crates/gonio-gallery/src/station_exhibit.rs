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
}

/// A computed picture.
pub struct ComputedStation {
    image: Image,
    picture: &'static StationPicture,
}

impl StationExhibit {
    /// Width over height, for which the pictures are composed.
    pub const ASPECT: f64 = 4.0 / 3.0;
    /// Samples of each pixel.
    pub const SAMPLES: u32 = 4;

    /// The main picture of a station; `None` if there is no such station.
    pub fn of(name: &str) -> Option<Self> {
        let station = gonio_beyond::station(name)?;
        Some(Self { station, picture: station.pictures.first()? })
    }

    /// The name of the picture's file without an extension, as `gonio beyond` names it.
    pub fn file_stem(self) -> String {
        format!("{}-{}", self.station.name, self.picture.name)
    }

    /// Computes the picture.
    pub fn compute(self, width: u32, height: u32) -> ComputedStation {
        let plane = (self.picture.image_plane)(&self.station.defaults());
        let mut refined = PictureRefinement::of_pixels(plane, [width, height], 0);
        refined.complete(Self::SAMPLES, &|_| true);
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
        let mut samples =
            PictureRefinement::of_pixels((exhibit.picture.image_plane)(&exhibit.station.defaults()), [40, 30], 0);
        samples.complete(StationExhibit::SAMPLES, &|_| true);
        assert_eq!(png::rows8(&samples.picture(), &exhibit.picture.output)[..3], picture.rgba[..3]);
        assert!(StationExhibit::of("nothing").is_none());
    }
}
