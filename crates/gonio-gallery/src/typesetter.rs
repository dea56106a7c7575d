//! Text on images, in the fonts of the window.

use crate::GalleryError;
use crate::markup::{Emphasis, TextRun};
use crate::rgb_image::{Rgb, RgbImage};
use harfrust::{ShapeOptions, ShaperData, UnicodeBuffer};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use vello_cpu::kurbo::{Affine, BezPath};
use vello_cpu::{Pixmap, RenderContext, Resources};

/// How a line of text is aligned with its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The line begins at the position.
    Left,
    /// The line ends at the position.
    Right,
    /// The position is the middle of the line.
    Center,
}

/// The colours of each [`Emphasis`].
#[derive(Clone, Copy, Debug)]
pub struct TextColors {
    /// The colour of plain text.
    pub plain: Rgb,
    /// The colour of stressed text.
    pub stressed: Rgb,
    /// The colour of faded text.
    pub faded: Rgb,
}

impl TextColors {
    fn of(self, emphasis: Emphasis) -> Rgb {
        match emphasis {
            Emphasis::Plain => self.plain,
            Emphasis::Stressed => self.stressed,
            Emphasis::Faded | Emphasis::Struck => self.faded,
        }
    }
}

/// Sets lines of text. A character is taken from the first font that has it.
pub struct Typesetter {
    fonts: Vec<FontRef<'static>>,
}

/// The fonts of the window's text, in the order in which they are searched: the text's own, then those of formulas.
const FONTS: [(&str, &[u8]); 3] = [
    ("Inter", include_bytes!("../../../assets/fonts/Inter-Regular.ttf")),
    ("KaTeX Main", include_bytes!("../../../assets/fonts/KaTeX-Main.ttf")),
    ("KaTeX Math", include_bytes!("../../../assets/fonts/KaTeX-Math-Italic.ttf")),
];

/// Pixels of a font's em for a line of size 1: sizes count from the highest ascender to the lowest descender.
const EM: f32 = 0.83;

/// A glyph on its line: its font, its size in pixels of an em, its origin from the beginning of the line, y downwards.
struct PlacedGlyph {
    font: usize,
    glyph: GlyphId,
    em: f32,
    x: f32,
    y: f32,
    emphasis: Emphasis,
}

impl Typesetter {
    /// Reads the fonts.
    ///
    /// # Errors
    ///
    /// A built-in font that cannot be read.
    pub fn new() -> Result<Self, GalleryError> {
        let read = |(name, bytes)| FontRef::new(bytes).map_err(|_| GalleryError::Font(name));
        Ok(Typesetter { fonts: FONTS.into_iter().map(read).collect::<Result<_, _>>()? })
    }

    /// The first font that has the character.
    fn font_of(&self, character: char) -> Option<usize> {
        self.fonts.iter().position(|font| font.charmap().map(character).is_some_and(|glyph| glyph != GlyphId::NOTDEF))
    }

    /// Places the glyphs of a line and returns its width in pixels.
    fn shape(&self, runs: &[TextRun], size: f32) -> (Vec<PlacedGlyph>, f32) {
        let (mut glyphs, mut x) = (Vec::new(), 0.0);
        for run in runs {
            let em = size * run.size * EM;
            for (index, text) in self.pieces(&run.text) {
                let font = &self.fonts[index];
                let scale = em / f32::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em.max(1));
                let data = ShaperData::new(font);
                let mut buffer = UnicodeBuffer::new();
                buffer.push_str(&text);
                buffer.guess_segment_properties();
                let shaped = data.shaper(font).build().shape(buffer, ShapeOptions::new());
                for (info, position) in shaped.glyph_infos().iter().zip(shaped.glyph_positions()) {
                    glyphs.push(PlacedGlyph {
                        font: index,
                        glyph: GlyphId::new(info.glyph_id),
                        em,
                        x: x + scale * position.x_offset as f32,
                        y: -size * run.rise - scale * position.y_offset as f32,
                        emphasis: run.emphasis,
                    });
                    x += scale * position.x_advance as f32;
                }
            }
        }
        (glyphs, x)
    }

    /// Splits text into pieces of one font each. A character without a glyph stays in the first font.
    fn pieces(&self, text: &str) -> Vec<(usize, String)> {
        let mut pieces: Vec<(usize, String)> = Vec::new();
        for character in text.chars() {
            let font = self.font_of(character).unwrap_or(0);
            match pieces.last_mut() {
                Some((last, piece)) if *last == font => piece.push(character),
                _ => pieces.push((font, character.into())),
            }
        }
        pieces
    }

    /// Draws a line of text with its baseline at `y`. A line wider than `max_width` is set smaller.
    #[allow(clippy::too_many_arguments)]
    pub fn draw(
        &self,
        image: &mut RgbImage,
        (x, y): (f32, f32),
        align: Align,
        runs: &[TextRun],
        size: f32,
        max_width: f32,
        colors: TextColors,
    ) {
        let (mut glyphs, mut width) = self.shape(runs, size);
        if width > max_width && width > 0.0 {
            (glyphs, width) = self.shape(runs, size * max_width / width);
        }
        let left = match align {
            Align::Left => x,
            Align::Right => x - width,
            Align::Center => x - 0.5 * width,
        };
        for glyph in glyphs {
            self.draw_glyph(image, &glyph, (left + glyph.x, y + glyph.y), colors.of(glyph.emphasis));
        }
    }

    fn draw_glyph(&self, image: &mut RgbImage, glyph: &PlacedGlyph, origin: (f32, f32), color: Rgb) {
        let Some(outline) = self.fonts[glyph.font].outline_glyphs().get(glyph.glyph) else { return };
        let mut pen = PathPen { path: BezPath::new(), origin };
        let settings = DrawSettings::unhinted(Size::new(glyph.em), LocationRef::default());
        if outline.draw(settings, &mut pen).is_err() {
            return;
        }
        let bounds = pen.path.control_box();
        let (left, top) = (bounds.x0.floor(), bounds.y0.floor());
        let side = |from: f64, to: f64| ((to - from).ceil() + 1.0).clamp(0.0, f64::from(u16::MAX)) as u16;
        let (width, height) = (side(left, bounds.x1), side(top, bounds.y1));
        let mut context = RenderContext::new(width, height);
        context.set_transform(Affine::translate((-left, -top)));
        context.fill_path(&pen.path);
        let mut pixmap = Pixmap::new(width, height);
        context.render(&mut pixmap, &mut Resources::new());
        let coverage = pixmap.data_as_u8_slice().as_chunks::<4>().0;
        for (row, line) in (0_i64..).zip(coverage.chunks_exact(usize::from(width).max(1))) {
            for (column, pixel) in (0_i64..).zip(line).filter(|(_, pixel)| pixel[3] > 0) {
                image.blend(left as i64 + column, top as i64 + row, color, f32::from(pixel[3]) / 255.0);
            }
        }
    }
}

/// Collects an outline in pixels, y downwards.
struct PathPen {
    path: BezPath,
    origin: (f32, f32),
}

impl PathPen {
    fn point(&self, x: f32, y: f32) -> (f64, f64) {
        ((self.origin.0 + x).into(), (self.origin.1 - y).into())
    }
}

impl OutlinePen for PathPen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.point(x, y));
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.point(x, y));
    }
    fn quad_to(&mut self, control_x: f32, control_y: f32, x: f32, y: f32) {
        self.path.quad_to(self.point(control_x, control_y), self.point(x, y));
    }
    fn curve_to(&mut self, first_x: f32, first_y: f32, second_x: f32, second_y: f32, x: f32, y: f32) {
        self.path.curve_to(self.point(first_x, first_y), self.point(second_x, second_y), self.point(x, y));
    }
    fn close(&mut self) {
        self.path.close_path();
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::markup;

    #[test]
    fn every_character_of_the_gallery_has_a_glyph() {
        let typesetter = Typesetter::new().unwrap();
        for section in crate::sections::all().unwrap() {
            let texts = section.rows.iter().flatten().flat_map(|e| [e.caption.clone(), e.remark.clone()]);
            let signs = section.rows.iter().flatten().filter_map(|e| e.joiner).map(String::from);
            for text in texts.chain(signs).chain([section.title.into(), section.equation.into()]) {
                for character in text.chars() {
                    assert!(typesetter.font_of(character).is_some(), "{character:?} of {text}");
                }
            }
        }
    }

    #[test]
    fn text_is_drawn_where_it_belongs() {
        const COLORS: TextColors = TextColors { plain: [255; 3], stressed: [255, 0, 0], faded: [0, 0, 255] };
        let typesetter = Typesetter::new().unwrap();
        let drawn = |align, text: &str| {
            let mut image = RgbImage::new(100, 40, [0; 3]);
            typesetter.draw(&mut image, (50.0, 30.0), align, &markup::runs(text), 20.0, 45.0, COLORS);
            let rgba = image.encoded().rgba;
            let inked = (0..4000_usize).filter(|i| rgba[4 * i..4 * i + 3].iter().any(|v| *v > 64));
            let columns: Vec<usize> = inked.map(|i| i % 100).collect();
            (*columns.iter().min().unwrap(), *columns.iter().max().unwrap())
        };
        assert!(drawn(Align::Left, "Hxm").0 >= 50);
        assert!(drawn(Align::Right, "Hxm").1 < 50);
        let (left, right) = drawn(Align::Center, "HxmΣ");
        assert!((98..=101).contains(&(left + right)), "{left} {right}");
        // Shrunk to the 45 pixels that it may take.
        let (left, right) = drawn(Align::Left, "a line of text that is far too long");
        assert!(left >= 50 && (90..=95).contains(&right), "{left} {right}");
        // A subscript is smaller and lower, and does not overlap what is before it.
        let (glyphs, width) = typesetter.shape(&markup::runs("k_d"), 20.0);
        assert!(glyphs[1].em < glyphs[0].em && glyphs[1].y > glyphs[0].y && glyphs[1].x > 0.0 && width > glyphs[1].x);
    }
}
