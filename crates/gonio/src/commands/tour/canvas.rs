//! The sheet's pixels: areas, pictures with round corners, words.

use super::maths::{Run, Style};
use crate::report::CliError;
use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};
use gonio_light::color::{srgb_decode, srgb_encode};
use gonio_scene::picture::EncodedPicture;

/// sRGB.
pub type Rgb = [u8; 3];

/// An opaque picture, sRGB.
pub struct Canvas {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    rgb: Vec<Rgb>,
}

impl Canvas {
    /// Of one colour.
    pub fn new(width: u32, height: u32, color: Rgb) -> Self {
        Canvas { width, height, rgb: vec![color; width as usize * height as usize] }
    }

    /// Mixes `color` in; places outside are ignored.
    fn blend(&mut self, x: i64, y: i64, color: Rgb, share: f32) {
        if x < 0 || y < 0 || x >= i64::from(self.width) || y >= i64::from(self.height) {
            return;
        }
        let pixel = &mut self.rgb[y as usize * self.width as usize + x as usize];
        for (to, from) in pixel.iter_mut().zip(color) {
            *to = (f32::from(*to) + (f32::from(from) - f32::from(*to)) * share.clamp(0.0, 1.0) + 0.5) as u8;
        }
    }

    /// A rectangle.
    pub fn fill(&mut self, x: u32, y: u32, width: u32, height: u32, color: Rgb) {
        for y in y..y.saturating_add(height) {
            for x in x..x.saturating_add(width) {
                self.blend(x.into(), y.into(), color, 1.0);
            }
        }
    }

    /// A picture with its upper left corner at (`x`, `y`) and corners of this radius, in pixels.
    pub fn picture(&mut self, x: u32, y: u32, picture: &Canvas, radius: f32) {
        let (w, h) = (picture.width as f32, picture.height as f32);
        for (row, line) in (0u32..).zip(picture.rgb.chunks_exact(picture.width.max(1) as usize)) {
            for (column, &color) in (0u32..).zip(line) {
                // How far into the square of a corner, from that corner's centre.
                let into = |at: f32, side: f32| (radius - at).max(at - (side - radius)).max(0.0);
                let distance = into(column as f32 + 0.5, w).hypot(into(row as f32 + 0.5, h));
                self.blend((x + column).into(), (y + row).into(), color, radius + 0.5 - distance);
            }
        }
    }

    /// For the PNG writer.
    pub fn encoded(&self) -> EncodedPicture<u8> {
        let rgba = self.rgb.iter().flat_map(|&[r, g, b]| [r, g, b, u8::MAX]).collect();
        EncodedPicture { width: self.width, height: self.height, rgba }
    }
}

/// `picture` at another, smaller size: the mean over each new pixel's area, in linear light; what is
/// transparent shows `behind`.
pub fn reduced(picture: &EncodedPicture<u8>, width: u32, height: u32, behind: Rgb) -> Canvas {
    let decode: Vec<f32> = (0..=255u8).map(|v| srgb_decode(f64::from(v) / 255.0) as f32).collect();
    const STEPS: usize = 1 << 14;
    let encode: Vec<u8> = (0..=STEPS).map(|i| (srgb_encode(i as f64 / STEPS as f64) * 255.0 + 0.5) as u8).collect();
    let (source_width, source_height) = (picture.width as usize, picture.height as usize);
    let columns = spans(source_width, width as usize);
    let mut canvas = Canvas::new(width, height, behind);
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
    for (line, span) in canvas.rgb.chunks_exact_mut(width as usize).zip(spans(source_height, height as usize)) {
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
    canvas
}

/// For each of `to` pixels in a row, which of `from` pixels it covers, and with which shares.
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

/// Where a line of words begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// At the place given.
    Left,
    /// Ends at the place given.
    Right,
    /// Around the place given.
    Center,
}

/// The colours of [`Style`].
#[derive(Clone, Copy, Debug)]
pub struct Ink {
    /// Of plain words.
    pub plain: Rgb,
    /// Of what is stressed.
    pub stressed: Rgb,
    /// Of what is faded.
    pub faded: Rgb,
}

/// The fonts, in the order in which a character is looked for.
pub struct Type {
    fonts: [FontRef<'static>; 2],
}

/// The second font, for the few signs that the first lacks, is drawn for code and is wide.
const FONT_SIZES: [f32; 2] = [1.0, 0.86];

impl Type {
    /// Ubuntu Light and Hack: the fonts of the window.
    pub fn new() -> Result<Self, CliError> {
        let font = |bytes| {
            FontRef::try_from_slice(bytes).map_err(|e| CliError::new(format!("a built-in font cannot be read: {e}")))
        };
        Ok(Type { fonts: [font(epaint_default_fonts::UBUNTU_LIGHT)?, font(epaint_default_fonts::HACK_REGULAR)?] })
    }

    /// Whether any font has the character.
    #[cfg(test)]
    pub fn has(&self, c: char) -> bool {
        self.fonts.iter().any(|f| f.glyph_id(c).0 != 0)
    }

    /// Calls `each` with every glyph and returns the width in pixels.
    fn set(&self, runs: &[Run], size: f32, mut each: impl FnMut(usize, ab_glyph::Glyph, Style)) -> f32 {
        let mut x = 0.0;
        for run in runs {
            let mut previous = None;
            for c in run.text.chars() {
                let which = usize::from(self.fonts[0].glyph_id(c).0 == 0 && self.fonts[1].glyph_id(c).0 != 0);
                let scale = PxScale::from(size * run.size * FONT_SIZES[which]);
                let font = self.fonts[which].as_scaled(scale);
                let id = font.glyph_id(c);
                if let Some((before, last)) = previous
                    && before == which
                {
                    x += font.kern(last, id);
                }
                each(which, id.with_scale_and_position(scale, point(x, -size * run.rise)), run.style);
                x += font.h_advance(id);
                previous = Some((which, id));
            }
        }
        x
    }

    /// Writes a line with its baseline at `y`; a line wider than `widest` is set smaller.
    #[allow(clippy::too_many_arguments)]
    pub fn write(
        &self,
        canvas: &mut Canvas,
        (x, y): (f32, f32),
        align: Align,
        runs: &[Run],
        size: f32,
        widest: f32,
        ink: Ink,
    ) {
        let width = self.set(runs, size, |_, _, _| {});
        let shrink = if width > widest && width > 0.0 { widest / width } else { 1.0 };
        let (size, width) = (size * shrink, width * shrink);
        let left = match align {
            Align::Left => x,
            Align::Right => x - width,
            Align::Center => x - 0.5 * width,
        };
        self.set(runs, size, |which, mut glyph, style| {
            glyph.position.x += left;
            glyph.position.y += y;
            let color = match style {
                Style::Plain => ink.plain,
                Style::Stressed => ink.stressed,
                Style::Faded => ink.faded,
            };
            if let Some(outline) = self.fonts[which].outline_glyph(glyph) {
                let corner = outline.px_bounds().min;
                outline.draw(|x, y, share| {
                    canvas.blend(corner.x as i64 + i64::from(x), corner.y as i64 + i64::from(y), color, share);
                });
            }
        });
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
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

    #[test]
    fn every_character_of_the_tour_can_be_written() {
        let fonts = Type::new().unwrap();
        for section in super::super::sections::all().unwrap() {
            let texts = section.rows.iter().flatten().flat_map(|e| [e.caption.clone(), e.remark.clone()]);
            let signs = section.rows.iter().flatten().filter_map(|e| e.joiner).map(String::from);
            for text in texts.chain(signs).chain([section.title.into(), section.equation.into()]) {
                assert!(text.chars().all(|c| fonts.has(c)), "{text}");
            }
        }
    }
}
