//! A rendered picture.

use crate::display::DisplayMap;
use crate::mip::srgb_byte;
use glam::DVec3;
pub use gonio_image::EncodedPicture;
use gonio_light::color::{ColorEncoding, OutputTransform};
use rayon::prelude::*;

/// Linear RGBA with premultiplied alpha, first row the top one.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// A picture of one colour.
    pub fn new(width: u32, height: u32, pixel: [f32; 4]) -> Self {
        Picture { width, height, pixels: vec![pixel; width as usize * height as usize] }
    }

    /// The pixel in column `x` of row `y`, both from the top left.
    pub fn at(&self, x: u32, y: u32) -> [f32; 4] {
        self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// 8 bits a channel, rounded to nearest.
    pub fn encode8(&self, map: &DisplayMap) -> EncodedPicture<u8> {
        match map {
            DisplayMap::Light(transform @ OutputTransform { encoding: ColorEncoding::Srgb, .. }) => {
                let to_display = OutputTransform { encoding: ColorEncoding::Direct, ..*transform };
                self.encode_with(|p| srgb8(p, &to_display))
            }
            _ => self.encode_with(|p| map.apply(p).map(|v| (v * 255.0 + 0.5) as u8)),
        }
    }

    /// 16 bits a channel, rounded to nearest.
    pub fn encode16(&self, map: &DisplayMap) -> EncodedPicture<u16> {
        self.encode_with(|p| map.apply(p).map(|v| (v * 65535.0 + 0.5) as u16))
    }

    fn encode_with<T: Copy + Default + Send>(&self, pixel: impl Fn([f32; 4]) -> [T; 4] + Sync) -> EncodedPicture<T> {
        let mut rgba = vec![T::default(); self.pixels.len() * 4];
        // Rows at a time: a pixel alone is too little work for a thread to fetch.
        let row = self.width.max(1) as usize;
        rgba.par_chunks_mut(4 * row).zip(self.pixels.par_chunks(row)).for_each(|(to, from)| {
            for (to, &from) in to.as_chunks_mut::<4>().0.iter_mut().zip(from) {
                *to = pixel(from);
            }
        });
        EncodedPicture { width: self.width, height: self.height, rgba }
    }
}

/// [`DisplayMap::apply`] with a table in place of the sRGB power. `to_display` is the
/// transform without its encoding.
fn srgb8(pixel: [f32; 4], to_display: &OutputTransform) -> [u8; 4] {
    let alpha = f64::from(pixel[3]).clamp(0.0, 1.0);
    if alpha <= 0.0 {
        return [0; 4];
    }
    let value = DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into()) / alpha;
    let display = to_display.encode(value);
    [srgb_byte(display.x), srgb_byte(display.y), srgb_byte(display.z), (alpha * 255.0 + 0.5) as u8]
}
