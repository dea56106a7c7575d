//! Lines of text as pixels, in a font from memory.

use crate::palette::Rgb8;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, MetadataProvider};
use vello_cpu::kurbo::{Affine, BezPath};
use vello_cpu::{Pixmap, RenderContext, Resources};

/// The font of the plots, a TrueType file. It has the characters of Latin-1 and some signs; others are drawn as a question mark.
/// A static, so that a program that uses the font elsewhere too contains it once.
pub static INTER: &[u8] = include_bytes!("../../../assets/fonts/Inter-Regular.ttf");
/// Half of the height of a capital, in the size of the font.
const HALF_CAPITAL: f64 = 0.364;
/// The width of a character without a font, in its size.
const USUAL_ADVANCE: f64 = 0.6;

/// An opaque picture of RGBA bytes.
pub struct PaintedPixels<'a> {
    /// Pixels.
    pub width: usize,
    /// `4 width height` bytes, first row the top one.
    pub rgba: &'a mut [u8],
}

/// A line of text with its place.
pub struct PlotText<'a> {
    /// The middle of its left end, or of the end where it begins if it runs upwards, in pixels.
    pub start: [f64; 2],
    /// The text.
    pub text: &'a str,
    /// The size of the font in pixels.
    pub size: f64,
    /// Its colour.
    pub color: Rgb8,
    /// Whether it runs upwards.
    pub is_upright: bool,
}

/// The width of a line in pixels.
pub fn text_width(text: &str, size: f64) -> f64 {
    let Ok(font) = FontRef::new(INTER) else { return USUAL_ADVANCE * size * text.chars().count() as f64 };
    glyphs(&font, text, size).last().map_or(0.0, |(_, x, advance)| x + advance)
}

/// The glyphs of a line with their origins and advances in pixels.
fn glyphs(font: &FontRef<'_>, text: &str, size: f64) -> Vec<(skrifa::GlyphId, f64, f64)> {
    let (charmap, metrics) = (font.charmap(), font.glyph_metrics(Size::new(size as f32), LocationRef::default()));
    let mut x = 0.0;
    let place = |character: char| {
        let glyph = charmap.map(character).or_else(|| charmap.map('?')).unwrap_or_default();
        let advance = metrics.advance_width(glyph).map_or(USUAL_ADVANCE * size, f64::from);
        x += advance;
        (glyph, x - advance, advance)
    };
    text.chars().map(place).collect()
}

/// Draws a line of text.
pub fn draw(pixels: &mut PaintedPixels<'_>, line: &PlotText<'_>) {
    let Ok(font) = FontRef::new(INTER) else { return };
    let [x, y] = line.start;
    let baseline = HALF_CAPITAL * line.size;
    let mut pen = LinePen { path: BezPath::new(), origin: 0.0, is_upright: line.is_upright, start: [x, y], baseline };
    let outlines = font.outline_glyphs();
    for (glyph, origin, _) in glyphs(&font, line.text, line.size) {
        let Some(outline) = outlines.get(glyph) else { continue };
        pen.origin = origin;
        let settings = DrawSettings::unhinted(Size::new(line.size as f32), LocationRef::default());
        // A glyph that cannot be drawn is left out, like one that the font does not have.
        let _ = outline.draw(settings, &mut pen);
    }
    fill(pixels, &pen.path, line.color);
}

/// Fills a path with a colour, by the share of each pixel that it covers.
fn fill(pixels: &mut PaintedPixels<'_>, path: &BezPath, color: Rgb8) {
    let bounds = path.control_box();
    let (left, top) = (bounds.x0.floor(), bounds.y0.floor());
    let side = |from: f64, to: f64| ((to - from).ceil() + 1.0).clamp(0.0, f64::from(u16::MAX)) as u16;
    let (width, height) = (side(left, bounds.x1), side(top, bounds.y1));
    if !bounds.x0.is_finite() || bounds.x1 <= bounds.x0 || bounds.y1 <= bounds.y0 {
        return;
    }
    let mut context = RenderContext::new(width, height);
    context.set_transform(Affine::translate((-left, -top)));
    context.fill_path(path);
    let mut pixmap = Pixmap::new(width, height);
    context.render(&mut pixmap, &mut Resources::new());
    let rows = pixels.rgba.len() / (4 * pixels.width).max(1);
    let coverage = pixmap.data_as_u8_slice().as_chunks::<4>().0;
    for (row, covered) in (top as i64..).zip(coverage.chunks_exact(usize::from(width))) {
        for (column, pixel) in (left as i64..).zip(covered).filter(|(_, pixel)| pixel[3] > 0) {
            let is_inside = (0..pixels.width as i64).contains(&column) && (0..rows as i64).contains(&row);
            if is_inside {
                let at = 4 * (row as usize * pixels.width + column as usize);
                let share = u32::from(pixel[3]);
                for (old, new) in pixels.rgba[at..at + 3].iter_mut().zip(color) {
                    *old = ((u32::from(new) * share + u32::from(*old) * (255 - share) + 127) / 255) as u8;
                }
            }
        }
    }
}

/// Collects the outlines of a line in pixels, y downwards.
struct LinePen {
    path: BezPath,
    /// The origin of the glyph along the line.
    origin: f64,
    is_upright: bool,
    start: [f64; 2],
    /// The distance from the middle of capitals to their feet.
    baseline: f64,
}

impl LinePen {
    fn point(&self, x: f32, y: f32) -> (f64, f64) {
        let (along, up) = (self.origin + f64::from(x), f64::from(y) - self.baseline);
        let [start_x, start_y] = self.start;
        if self.is_upright { (start_x - up, start_y - along) } else { (start_x + along, start_y - up) }
    }
}

impl OutlinePen for LinePen {
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
    use super::*;

    /// The smallest rectangle around the ink: left, top, right, bottom.
    fn ink(is_upright: bool) -> [usize; 4] {
        let mut rgba = vec![255; 4 * 200 * 200];
        let line = PlotText { start: [100.0, 100.0], text: "HHHH", size: 20.0, color: [0; 3], is_upright };
        draw(&mut PaintedPixels { width: 200, rgba: &mut rgba }, &line);
        let inked = rgba.as_chunks::<4>().0.iter().enumerate().filter(|(_, pixel)| pixel[0] < 128);
        inked.fold([200, 200, 0, 0], |[left, top, right, bottom], (index, _)| {
            let (x, y) = (index % 200, index / 200);
            [left.min(x), top.min(y), right.max(x), bottom.max(y)]
        })
    }

    #[test]
    fn text_begins_at_its_place_and_is_centred_across() {
        let width = text_width("HHHH", 20.0);
        assert!((50.0..70.0).contains(&width), "{width}");
        let [left, top, right, bottom] = ink(false);
        assert!((100..104).contains(&left) && (right as f64 - 100.0 - width).abs() < 4.0, "{left} {right} {width}");
        assert!((198..=202).contains(&(top + bottom)) && (13..17).contains(&(bottom - top)), "{top} {bottom}");
        let [left, top, right, bottom] = ink(true);
        assert!((96..=100).contains(&bottom) && (100.0 - width - top as f64).abs() < 4.0, "{top} {bottom}");
        assert!((198..=202).contains(&(left + right)), "{left} {right}");
    }
}
