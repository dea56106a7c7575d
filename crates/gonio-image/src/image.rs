//! Images in memory, the limits on that memory, and the error of reading and writing image files.

use std::fmt;

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

/// Describes why an image could not be read or written: one sentence with the fault and the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageError {
    /// The name of the file as the user knows it, if the error concerns one.
    pub file: Option<String>,
    /// One sentence without a final full stop.
    pub message: String,
    /// Whether a larger limit on memory would help.
    pub over_limit: bool,
}

impl ImageError {
    /// Creates an error that does not name a file yet.
    pub fn new(message: impl Into<String>) -> Self {
        ImageError { file: None, message: message.into(), over_limit: false }
    }

    /// Names the file, unless one is named already.
    pub fn in_file(mut self, file: &str) -> Self {
        self.file.get_or_insert_with(|| file.to_owned());
        self
    }
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for ImageError {}

/// The memory that a file may use before it is rejected. Sizes are checked as the header gives them, before anything is
/// allocated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DecodeLimits {
    /// Bytes of all decoded pixels together, 16 each.
    pub max_bytes: u64,
}

impl Default for DecodeLimits {
    /// 2 GiB, enough for a panorama of 16384 x 8192; on 32 bits, where no more than 4 GiB can be addressed, 1 GiB. A
    /// program that knows the memory of its machine gives a share of it instead.
    fn default() -> Self {
        DecodeLimits { max_bytes: if usize::BITS >= 64 { 2 << 30 } else { 1 << 30 } }
    }
}

impl DecodeLimits {
    /// Returns the number of pixels of `pictures` pictures of a size.
    ///
    /// # Errors
    ///
    /// No pixels, or too many.
    pub fn pixels(&self, width: u64, height: u64, pictures: u64) -> Result<usize, ImageError> {
        if width == 0 || height == 0 {
            return Err(ImageError::new(format!(
                "the picture is {width} x {height} pixels; an environment needs at least one"
            )));
        }
        let pixels = width.checked_mul(height).and_then(|n| n.checked_mul(pictures));
        let bytes = pixels.and_then(|n| n.checked_mul(size_of::<Pixel>() as u64));
        match (bytes, pixels.and_then(|n| usize::try_from(n).ok())) {
            (Some(bytes), Some(pixels)) if bytes <= self.max_bytes => Ok(pixels),
            _ => {
                let many = if pictures == 1 { String::new() } else { format!("{pictures} times ") };
                let needed = bytes.map_or_else(|| "more than can be counted".to_owned(), gibibytes);
                let message = format!(
                    "{many}{width} x {height} pixels are {needed} when decoded, and the limit is {}; make the picture \
                     smaller",
                    gibibytes(self.max_bytes)
                );
                Err(ImageError { over_limit: true, ..ImageError::new(message) })
            }
        }
    }

    /// Returns a picture with room for its pixels, but none yet. Readers fill it row by row, so that a wrong header
    /// costs no memory.
    pub(crate) fn unfilled(&self, width: u32, height: u32) -> Result<Image, ImageError> {
        let count = self.pixels(width.into(), height.into(), 1)?;
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| {
            let size = gibibytes(count as u64 * size_of::<Pixel>() as u64);
            ImageError::new(format!(
                "not enough memory for {width} x {height} pixels ({size}); make the picture smaller"
            ))
        })?;
        Ok(Image { width, height, pixels })
    }
}

fn gibibytes(bytes: u64) -> String {
    const UNITS: [&str; 4] = ["bytes", "KiB", "MiB", "GiB"];
    let unit = (0..3).find(|i| bytes < 1 << (10 * (i + 1))).unwrap_or(3);
    if unit == 0 {
        return format!("{bytes} bytes");
    }
    format!("{:.1} {}", bytes as f64 / (1_u64 << (10 * unit)) as f64, UNITS[unit])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_panorama_fits_and_one_row_more_does_not() {
        let limits = DecodeLimits { max_bytes: 8 << 30 };
        assert_eq!(limits.pixels(32768, 16384, 1), Ok(1 << 29));
        let refused = limits.pixels(32768, 16385, 1).map_err(|e| e.message);
        let expected =
            "32768 x 16385 pixels are 8.0 GiB when decoded, and the limit is 8.0 GiB; make the picture smaller";
        assert_eq!(refused, Err(expected.to_owned()));
        assert!(limits.pixels(u64::MAX, 3, 6).is_err());
        assert!(limits.pixels(0, 3, 1).is_err());
    }
}
