//! A picture of linear light.

/// Linear RGB, and a fourth number that makes a pixel 16 bytes: 1, or what a file had as alpha.
pub type Pixel = [f32; 4];

/// A picture of linear light, first row the top one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<Pixel>,
}

impl Image {
    /// A picture of one colour.
    pub fn new(width: u32, height: u32, pixel: Pixel) -> Self {
        Image { width, height, pixels: vec![pixel; width as usize * height as usize] }
    }

    /// The pixel in column `x` of row `y`, both from the top left.
    pub fn at(&self, x: u32, y: u32) -> Pixel {
        self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// One row.
    pub fn row(&self, y: u32) -> &[Pixel] {
        let width = self.width as usize;
        &self.pixels[y as usize * width..][..width]
    }
}

/// A picture in the numbers of a file, RGBA: 8 or 16 bits a channel, alpha not multiplied into the colours.
#[derive(Clone, Debug, PartialEq)]
pub struct EncodedPicture<T> {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height * 4` values, first row the top one.
    pub rgba: Vec<T>,
}
