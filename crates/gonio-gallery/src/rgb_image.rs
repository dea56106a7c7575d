//! Opaque images in sRGB: rectangles, images with round corners, and reduction in linear light.

use gonio_image::EncodedPicture;
use gonio_image::srgb::LINEAR_FROM_8;
use gonio_light::color::srgb_encode;

/// A colour in sRGB.
pub type Rgb = [u8; 3];

/// An opaque image in sRGB.
pub struct RgbImage {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    rgb: Vec<Rgb>,
}

impl RgbImage {
    /// Creates an image of one colour.
    pub fn new(width: u32, height: u32, color: Rgb) -> Self {
        RgbImage { width, height, rgb: vec![color; width as usize * height as usize] }
    }

    /// Blends `color` into a pixel; positions outside of the image are ignored.
    pub fn blend(&mut self, x: i64, y: i64, color: Rgb, share: f32) {
        if x < 0 || y < 0 || x >= i64::from(self.width) || y >= i64::from(self.height) {
            return;
        }
        let pixel = &mut self.rgb[y as usize * self.width as usize + x as usize];
        for (to, from) in pixel.iter_mut().zip(color) {
            *to = (f32::from(*to) + (f32::from(from) - f32::from(*to)) * share.clamp(0.0, 1.0) + 0.5) as u8;
        }
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, x: u32, y: u32, width: u32, height: u32, color: Rgb) {
        for y in y..y.saturating_add(height) {
            for x in x..x.saturating_add(width) {
                self.blend(x.into(), y.into(), color, 1.0);
            }
        }
    }

    /// Draws `picture` with its upper left corner at (`x`, `y`) and round corners of this radius, in pixels.
    pub fn draw_rounded(&mut self, x: u32, y: u32, picture: &RgbImage, radius: f32) {
        let (w, h) = (picture.width as f32, picture.height as f32);
        for (row, line) in (0u32..).zip(picture.rgb.chunks_exact(picture.width.max(1) as usize)) {
            for (column, &color) in (0u32..).zip(line) {
                // The distance from the centre of the corner's arc.
                let into = |at: f32, side: f32| (radius - at).max(at - (side - radius)).max(0.0);
                let distance = into(column as f32 + 0.5, w).hypot(into(row as f32 + 0.5, h));
                self.blend((x + column).into(), (y + row).into(), color, radius + 0.5 - distance);
            }
        }
    }

    /// Returns the image with an opaque alpha channel.
    pub fn encoded(&self) -> EncodedPicture<u8> {
        let rgba = self.rgb.iter().flat_map(|&[r, g, b]| [r, g, b, u8::MAX]).collect();
        EncodedPicture { width: self.width, height: self.height, rgba }
    }
}

/// Reduces `picture` to a smaller size: the mean over each new pixel's area, in linear light, over the colour `behind`.
pub fn reduced(picture: &EncodedPicture<u8>, width: u32, height: u32, behind: Rgb) -> RgbImage {
    let decode = &*LINEAR_FROM_8;
    const STEPS: usize = 1 << 14;
    let encode: Vec<u8> = (0..=STEPS).map(|i| (srgb_encode(i as f64 / STEPS as f64) * 255.0 + 0.5) as u8).collect();
    let (source_width, source_height) = (picture.width as usize, picture.height as usize);
    let columns = spans(source_width, width as usize);
    let mut image = RgbImage::new(width, height, behind);
    let mut narrow = vec![[0f32; 3]; width as usize * source_height];
    for (line, to) in picture.rgba.chunks_exact(4 * source_width).zip(narrow.chunks_exact_mut(width as usize)) {
        for (to, span) in to.iter_mut().zip(&columns) {
            for &(index, share) in span {
                let pixel = &line[4 * index..4 * index + 4];
                let alpha = f32::from(pixel[3]) / 255.0;
                for ((sum, &value), &behind) in to.iter_mut().zip(pixel).zip(&behind) {
                    let value = alpha * decode[usize::from(value)] + (1.0 - alpha) * decode[usize::from(behind)];
                    *sum += share * value;
                }
            }
        }
    }
    for (line, span) in image.rgb.chunks_exact_mut(width as usize).zip(spans(source_height, height as usize)) {
        for (x, to) in line.iter_mut().enumerate() {
            let mut sum = [0f32; 3];
            for &(index, share) in &span {
                for (sum, value) in sum.iter_mut().zip(narrow[index * width as usize + x]) {
                    *sum += share * value;
                }
            }
            *to = sum.map(|v| encode[((v * STEPS as f32 + 0.5) as usize).min(STEPS)]);
        }
    }
    image
}

/// For each of `to` pixels in a row, the `from` pixels that it covers, with their shares.
fn spans(from: usize, to: usize) -> Vec<Vec<(usize, f32)>> {
    let step = from as f64 / to.max(1) as f64;
    (0..to)
        .map(|i| {
            let (start, end) = (i as f64 * step, ((i + 1) as f64 * step).min(from as f64));
            (start as usize..(end.ceil() as usize).min(from))
                .map(|j| (j, (((j + 1) as f64).min(end) - (j as f64).max(start)) / (end - start)))
                .filter(|(_, share)| *share > 1e-9)
                .map(|(j, share)| (j, share as f32))
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_of_light() {
        // Black and white beside each other: half of the light is sRGB 188, not 128.
        let rgba = vec![0, 0, 0, 255, 255, 255, 255, 255];
        let half = reduced(&EncodedPicture { width: 2, height: 1, rgba }, 1, 1, [0; 3]);
        assert_eq!(half.rgb, [[188; 3]]);
        let see_through = EncodedPicture { width: 1, height: 1, rgba: vec![255, 255, 255, 0] };
        assert_eq!(reduced(&see_through, 1, 1, [10, 20, 30]).rgb, [[10, 20, 30]]);
    }

    #[test]
    fn shares_of_a_pixel_add_up() {
        for (from, to) in [(7, 3), (10, 10), (1, 1), (100, 33)] {
            let spans = spans(from, to);
            assert_eq!(spans.len(), to);
            assert!(spans.iter().all(|s| (s.iter().map(|(_, share)| share).sum::<f32>() - 1.0).abs() < 1e-5));
        }
    }
}
