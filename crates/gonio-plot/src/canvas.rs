//! Shapes and text, drawn as SVG or as pixels.
//!
//! A [`PlotFigure`] collects shapes in pixels, y downwards; [`PlotFigure::shapes`] gives them to other painters. The SVG is written in eighths of a pixel; the pixels are computed
//! at three times the size and averaged, because the plotting library smooths lines but no edges of areas. Text comes last.

use crate::palette::{Palette, Rgb8, palette};
use crate::shape::{PlacedPicture, PlotShape, PolarPlace, TextAlign};
use crate::text::{self, PaintedPixels, PlotText};
use crate::{PlotError, PlotTheme};
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{ColorTag, encode8};
use plotters::prelude::*;
use plotters::style::FontTransform;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use serde::{Deserialize, Serialize};

/// The font, and those that a viewer of an SVG without it takes.
const FONT: &str = "Inter, Helvetica, Arial, sans-serif";

/// Units of the SVG for each pixel: the plotting library has whole coordinates.
const SVG_UNITS: f64 = 8.0;
/// Computed pixels for each pixel, each way.
const OVERSAMPLING: usize = 3;

/// Whether the plotting library draws the texts: as SVG it names the font, as pixels it would need one of the system.
#[derive(Clone, Copy, PartialEq, Eq)]
enum WithText {
    Yes,
    No,
}

/// A plot: shapes over pictures over paper. Written by serde, it has no pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlotFigure {
    size: [u32; 2],
    /// The colours.
    pub palette: Palette,
    /// The half circle of a polar plot.
    pub polar: Option<PolarPlace>,
    shapes: Vec<PlotShape>,
    #[serde(skip)]
    pictures: Vec<PlacedPicture>,
}

impl PlotFigure {
    /// Empty paper of a size in pixels.
    pub fn new(size: [u32; 2], theme: PlotTheme) -> Self {
        Self { size, palette: palette(theme), polar: None, shapes: Vec::new(), pictures: Vec::new() }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [f64; 2] {
        self.size.map(f64::from)
    }

    /// The parts, the lowest first.
    pub fn shapes(&self) -> &[PlotShape] {
        &self.shapes
    }

    /// The pictures below the shapes.
    pub fn pictures(&self) -> &[PlacedPicture] {
        &self.pictures
    }

    /// This plot with another one of the same width below it.
    pub fn above(mut self, below: Self) -> Self {
        let [_, down] = self.size();
        self.shapes.extend(below.shapes.into_iter().map(|shape| shape.lowered(down)));
        let lowered = |mut placed: PlacedPicture| {
            placed.place[1] += down;
            placed
        };
        self.pictures.extend(below.pictures.into_iter().map(lowered));
        self.size[1] += below.size[1];
        self
    }

    /// A line through points.
    pub fn line(&mut self, points: Vec<[f64; 2]>, color: Rgb8, width: f64) {
        if points.len() > 1 {
            self.shapes.push(PlotShape::Line { points, color, width });
        }
    }

    /// A line of dashes.
    pub fn dashed(&mut self, from: [f64; 2], to: [f64; 2], color: Rgb8, width: f64) {
        const PERIOD: f64 = 8.0;
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let at = |distance: f64| {
            let share = (distance / length).min(1.0);
            [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]
        };
        for dash in 0..(length / PERIOD).ceil() as usize {
            let start = dash as f64 * PERIOD;
            self.line(vec![at(start), at(start + 0.55 * PERIOD)], color, width);
        }
    }

    /// A line with an arrowhead at its end.
    pub fn arrow(&mut self, from: [f64; 2], to: [f64; 2], color: Rgb8, width: f64) {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]).max(1e-9);
        let [x, y] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
        let head = 5.0 * width;
        let base = [to[0] - head * x, to[1] - head * y];
        self.line(vec![from, base], color, width);
        let side = 0.4 * head;
        let points = vec![to, [base[0] - side * y, base[1] + side * x], [base[0] + side * y, base[1] - side * x]];
        self.area(points, color);
    }

    /// A filled polygon.
    pub fn area(&mut self, points: Vec<[f64; 2]>, color: Rgb8) {
        self.shapes.push(PlotShape::Area { points, color });
    }

    /// A filled circle.
    pub fn dot(&mut self, center: [f64; 2], radius: f64, color: Rgb8, opacity: f64) {
        self.shapes.push(PlotShape::Dot { center, radius, color, opacity });
    }

    /// A line of text, vertically centred at its position.
    pub fn text(&mut self, at: [f64; 2], text: &str, size: f64, color: Rgb8, align: TextAlign) {
        // Names of files may contain characters that XML cannot.
        let text = text.replace(|c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'), "?");
        self.shapes.push(PlotShape::Text { at, text, size, color, align, is_upright: false });
    }

    /// A centred line of text that fits between both sides of the paper, as [`PlotFigure::text_within`].
    pub fn fitted_text(&mut self, at: [f64; 2], text: &str, size: f64, color: Rgb8) {
        const MARGIN: f64 = 8.0;
        let [width, _] = self.size();
        self.text_within(at, text, size, color, 2.0 * (at[0].min(width - at[0]) - MARGIN).max(0.0));
    }

    /// A centred line of text that is made smaller, down to 9 pixels, and then cut, to be at most `most` pixels wide.
    pub fn text_within(&mut self, at: [f64; 2], text: &str, size: f64, color: Rgb8, most: f64) {
        const SMALLEST: f64 = 9.0;
        let size = (size * (most / self.text_width(text, size).max(1.0)).min(1.0)).max(SMALLEST);
        let text = self.shortened(text, size, most);
        self.text(at, &text, size, color, TextAlign::Middle);
    }

    /// A line of text that runs upwards, centred at its position.
    pub fn text_upwards(&mut self, at: [f64; 2], text: &str, size: f64, color: Rgb8) {
        let align = TextAlign::Middle;
        self.shapes.push(PlotShape::Text { at, text: text.to_owned(), size, color, align, is_upright: true });
    }

    /// A picture below all shapes: left, top, width and height in pixels.
    pub fn picture(&mut self, place: [f64; 4], picture: EncodedPicture<u8>) {
        self.pictures.push(PlacedPicture { place, picture });
    }

    /// The width of a text in pixels.
    pub fn text_width(&self, text: &str, size: f64) -> f64 {
        text::text_width(text, size)
    }

    /// The text, cut with an ellipsis where it is wider than `most` pixels.
    pub fn shortened(&self, text: &str, size: f64, most: f64) -> String {
        if self.text_width(text, size) <= most {
            return text.to_owned();
        }
        let mut cut: String = text.to_owned();
        while !cut.is_empty() && self.text_width(&format!("{cut}…"), size) > most {
            cut.pop();
        }
        cut + "…"
    }

    /// Pairs of texts that overlap, and texts that leave the paper.
    #[cfg(test)]
    pub(crate) fn text_faults(&self) -> Vec<String> {
        let mut boxes: Vec<(String, [f64; 4])> = Vec::new();
        for shape in &self.shapes {
            let PlotShape::Text { at: [x, y], text, size, align, is_upright, .. } = shape else { continue };
            let (width, half) = (self.text_width(text, *size), 0.5 * size);
            let left = match align {
                TextAlign::Start => *x,
                TextAlign::Middle => x - 0.5 * width,
                TextAlign::End => x - width,
            };
            let place = if *is_upright {
                [x - half, y - 0.5 * width, x + half, y + 0.5 * width]
            } else {
                [left, y - half, left + width, y + half]
            };
            boxes.push((text.clone(), place));
        }
        let [width, height] = self.size();
        let mut faults = Vec::new();
        for (index, (text, a)) in boxes.iter().enumerate() {
            if a[0] < 0.0 || a[1] < 0.0 || a[2] > width || a[3] > height {
                faults.push(format!("`{text}` leaves the paper: {a:?}"));
            }
            for (other, b) in &boxes[..index] {
                if a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3] {
                    faults.push(format!("`{text}` overlaps `{other}`"));
                }
            }
        }
        faults
    }

    /// The lines of a colour.
    #[cfg(test)]
    pub(crate) fn lines(&self, wanted: Rgb8) -> Vec<Vec<[f64; 2]>> {
        let lines = self.shapes.iter().filter_map(|shape| match shape {
            PlotShape::Line { points, color, .. } if *color == wanted => Some(points.clone()),
            _ => None,
        });
        lines.collect()
    }

    /// The plot as SVG.
    ///
    /// # Errors
    ///
    /// A failure of the plotting library.
    pub fn svg(&self) -> Result<String, PlotError> {
        let [width, height] = self.size;
        let units = self.size.map(|side| side * SVG_UNITS as u32);
        let mut text = String::new();
        {
            let mut backend = SVGBackend::with_string(&mut text, (units[0], units[1]));
            self.emit(&mut backend, SVG_UNITS, WithText::Yes)?;
            backend.present().map_err(failed)?;
        }
        let start = text.find("<svg").and_then(|at| text[at..].find('>').map(|end| at + end + 1));
        let body = start.map_or("", |start| &text[start..]);
        let [red, green, blue] = self.palette.background;
        let mut head = format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {} {}\" stroke-linejoin=\"round\" \
             stroke-linecap=\"round\" xmlns=\"http://www.w3.org/2000/svg\">\n\
             <rect width=\"{}\" height=\"{}\" fill=\"rgb({red},{green},{blue})\"/>\n",
            units[0], units[1], units[0], units[1]
        );
        for PlacedPicture { place, picture } in &self.pictures {
            let png = encode8(picture, ColorTag::Srgb).map_err(|error| PlotError::Drawing(error.to_string()))?;
            let [x, y, w, h] = place.map(|value| value * SVG_UNITS);
            head += &format!(
                "<image x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" preserveAspectRatio=\"none\" \
                 href=\"data:image/png;base64,{}\"/>\n",
                base64(&png)
            );
        }
        Ok(head + body.trim_start())
    }

    /// The plot as PNG.
    ///
    /// # Errors
    ///
    /// A failure of the plotting library.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let [width, height] = self.size.map(|side| side as usize);
        let (wide, high) = (width * OVERSAMPLING, height * OVERSAMPLING);
        let mut pixels = self.palette.background.repeat(wide * high);
        for picture in &self.pictures {
            picture.paint(&mut pixels, wide, high);
        }
        {
            let mut backend = BitMapBackend::with_buffer(&mut pixels, (wide as u32, high as u32));
            self.emit(&mut backend, OVERSAMPLING as f64, WithText::No)?;
            backend.present().map_err(failed)?;
        }
        let mut rgba = Vec::with_capacity(4 * width * height);
        let count = (OVERSAMPLING * OVERSAMPLING) as u32;
        for y in 0..height {
            for x in 0..width {
                let mut sum = [0_u32; 3];
                for row in 0..OVERSAMPLING {
                    let start = 3 * ((y * OVERSAMPLING + row) * wide + x * OVERSAMPLING);
                    for pixel in pixels[start..start + 3 * OVERSAMPLING].as_chunks::<3>().0 {
                        for (sum, channel) in sum.iter_mut().zip(pixel) {
                            *sum += u32::from(*channel);
                        }
                    }
                }
                rgba.extend(sum.map(|sum| ((sum + count / 2) / count) as u8));
                rgba.push(255);
            }
        }
        self.paint_text(&mut PaintedPixels { width, rgba: &mut rgba });
        let [width, height] = self.size;
        encode8(&EncodedPicture { width, height, rgba }, ColorTag::Srgb)
            .map_err(|error| PlotError::Drawing(error.to_string()))
    }

    /// Paints all texts over the finished pixels.
    fn paint_text(&self, pixels: &mut PaintedPixels<'_>) {
        for shape in &self.shapes {
            let PlotShape::Text { at: [x, y], text, size, color, align, is_upright } = shape else { continue };
            let width = self.text_width(text, *size);
            let before = match align {
                TextAlign::Start => 0.0,
                TextAlign::Middle => 0.5 * width,
                TextAlign::End => width,
            };
            let start = if *is_upright { [*x, y + before] } else { [x - before, *y] };
            text::draw(pixels, &PlotText { start, text, size: *size, color: *color, is_upright: *is_upright });
        }
    }

    /// Draws the shapes with `units` for each pixel.
    fn emit<B: DrawingBackend>(&self, backend: &mut B, units: f64, with_text: WithText) -> Result<(), PlotError> {
        let point = |[x, y]: [f64; 2]| ((x * units).round() as i32, (y * units).round() as i32);
        let opaque = |[red, green, blue]: Rgb8| RGBColor(red, green, blue);
        for shape in &self.shapes {
            match shape {
                PlotShape::Line { points, color, width } => {
                    let style = opaque(*color).stroke_width((width * units).round().max(1.0) as u32);
                    backend.draw_path(points.iter().copied().map(point), &style).map_err(failed)?;
                }
                PlotShape::Area { points, color } => {
                    backend.fill_polygon(points.iter().copied().map(point), &opaque(*color)).map_err(failed)?;
                }
                PlotShape::Dot { center, radius, color, opacity } => {
                    let radius = (radius * units).round().max(1.0) as u32;
                    let style = opaque(*color).mix(*opacity).filled();
                    backend.draw_circle(point(*center), radius, &style, true).map_err(failed)?;
                }
                PlotShape::Text { .. } if with_text == WithText::No => {}
                PlotShape::Text { at, text, size, color, align, is_upright } => {
                    let horizontal = match align {
                        TextAlign::Start => HPos::Left,
                        TextAlign::Middle => HPos::Center,
                        TextAlign::End => HPos::Right,
                    };
                    let font = (FONT, size * units).into_font();
                    let font = if *is_upright { font.transform(FontTransform::Rotate270) } else { font };
                    let ink = opaque(*color);
                    let style = TextStyle::from(font).color(&ink).pos(Pos::new(horizontal, VPos::Center));
                    backend.draw_text(text, &style, point(*at)).map_err(failed)?;
                }
            }
        }
        Ok(())
    }
}

impl PlacedPicture {
    /// Paints the picture into pixels, each with the nearest one of the picture.
    fn paint(&self, pixels: &mut [u8], wide: usize, high: usize) {
        let [left, top, width, height] = self.place.map(|value| value * OVERSAMPLING as f64);
        let (columns, rows) = (self.picture.width as usize, self.picture.height as usize);
        for y in top.max(0.0) as usize..((top + height).max(0.0) as usize).min(high) {
            for x in left.max(0.0) as usize..((left + width).max(0.0) as usize).min(wide) {
                let column = (((x as f64 + 0.5 - left) / width * columns as f64).max(0.0) as usize).min(columns - 1);
                let row = (((y as f64 + 0.5 - top) / height * rows as f64).max(0.0) as usize).min(rows - 1);
                let from = 4 * (row * columns + column);
                let Some([rgb @ .., alpha]) = self.picture.rgba.get(from..from + 4) else { continue };
                let to = 3 * (y * wide + x);
                for (pixel, channel) in pixels[to..to + 3].iter_mut().zip(rgb) {
                    let alpha = u32::from(*alpha);
                    *pixel = ((u32::from(*channel) * alpha + u32::from(*pixel) * (255 - alpha) + 127) / 255) as u8;
                }
            }
        }
    }
}

fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::Drawing(error.to_string())
}

/// Bytes in base 64. Source: RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |index: usize| u32::from(three.get(index).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            let is_used = digit <= three.len();
            text.push(if is_used { char::from(DIGITS[(bits >> (18 - 6 * digit) & 63) as usize]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        // RFC 4648, section 10.
        for (bytes, text) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg==")] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn text_is_measured_and_cut() {
        let figure = PlotFigure::new([300, 200], PlotTheme::Light);
        let (short, long) = (figure.text_width("ill", 12.0), figure.text_width("WWW", 12.0));
        assert!(short > 4.0 && long > 2.0 * short && long < 60.0, "{short} {long}");
        let cut = figure.shortened("a label that is far too long", 12.0, 80.0);
        assert!(cut.ends_with('…') && figure.text_width(&cut, 12.0) <= 80.0, "{cut}");
    }
}
