//! A rendered picture.

use crate::display::DisplayMap;

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

/// A picture in the numbers of a file: not premultiplied.
#[derive(Clone, Debug, PartialEq)]
pub struct EncodedPicture<T> {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height * 4` values, first row the top one.
    pub rgba: Vec<T>,
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
        self.encode(|v| (v * 255.0 + 0.5) as u8, map)
    }

    /// 16 bits a channel, rounded to nearest.
    pub fn encode16(&self, map: &DisplayMap) -> EncodedPicture<u16> {
        self.encode(|v| (v * 65535.0 + 0.5) as u16, map)
    }

    fn encode<T>(&self, quantise: impl Fn(f64) -> T, map: &DisplayMap) -> EncodedPicture<T> {
        let rgba = self.pixels.iter().flat_map(|&p| map.apply(p)).map(quantise).collect();
        EncodedPicture { width: self.width, height: self.height, rgba }
    }
}
