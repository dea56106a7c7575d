//! The contact sheet.

use super::canvas::{Align, Canvas, Ink, Rgb, Type};
use super::draw::Shown;
use super::exhibit::Section;
use super::layout::{Layout, MARGIN, WIDTH};
use super::maths;
use crate::report::CliError;

/// The sheet's ground.
pub const GROUND: Rgb = [18, 20, 25];
const LINE: Rgb = [44, 48, 58];
const BRIGHT: Ink = Ink { plain: [238, 236, 230], stressed: [255, 190, 110], faded: [120, 126, 138] };
const SOFT: Ink = Ink { plain: [150, 156, 168], stressed: [255, 190, 110], faded: [100, 106, 118] };
const TITLE_INK: Ink = Ink { plain: [255, 190, 110], ..BRIGHT };
/// Of the pictures' corners, at full size.
const RADIUS: f64 = 9.0;

/// Puts the pictures and their words together. `foot` stands at the lower edge.
pub fn compose(sections: &[Section], layout: &Layout, shown: &[Shown], foot: &str) -> Result<Canvas, CliError> {
    let fonts = Type::new()?;
    let mut canvas = Canvas::new(layout.width, layout.height, GROUND);
    let scale = layout.scale;
    let content = (WIDTH - 2.0 * MARGIN) * scale;
    let write = |canvas: &mut Canvas, x: f64, y: f64, align, text: &str, size: f64, widest: f64, ink| {
        let at = (x as f32, y as f32);
        fonts.write(canvas, at, align, &maths::runs(text), (size * scale) as f32, widest as f32, ink);
    };
    let (left, right) = (MARGIN * scale, (WIDTH - MARGIN) * scale);

    write(&mut canvas, left - 5.0 * scale, 116.0 * scale, Align::Left, "gonio", 132.0, content, TITLE_INK);
    let tagline = "the light lab: every technique on several models";
    write(&mut canvas, left, 184.0 * scale, Align::Left, tagline, 32.0, content, SOFT);
    let whole = sections.first().map_or("", |s| s.equation);
    write(&mut canvas, right, 112.0 * scale, Align::Right, whole, 44.0, 0.66 * content, BRIGHT);
    let legend = "ambient + emitted + for every light: diffuse and specular, times its light and its fading";
    write(&mut canvas, right, 184.0 * scale, Align::Right, legend, 27.0, 0.6 * content, SOFT);

    for (section, &baseline) in sections.iter().zip(&layout.headings) {
        let Some(y) = baseline else { continue };
        let line_y = (y - 58.0 * scale).max(0.0) as u32;
        canvas.fill(left as u32, line_y, content as u32, scale.max(1.0) as u32, LINE);
        write(&mut canvas, left, y, Align::Left, section.title, 44.0, 0.5 * content, BRIGHT);
        write(&mut canvas, right, y, Align::Right, section.equation, 31.0, 0.48 * content, SOFT);
    }

    for (shown, place) in shown.iter().zip(&layout.places) {
        canvas.picture(place.x, place.y, &shown.small, (RADIUS * scale) as f32);
        let (x, bottom) = (f64::from(place.x), f64::from(place.y + place.height));
        let width = f64::from(place.width);
        write(&mut canvas, x, bottom + 33.0 * scale, Align::Left, &shown.exhibit.caption, 28.0, width, BRIGHT);
        write(&mut canvas, x, bottom + 61.0 * scale, Align::Left, &shown.remark(), 23.0, width, SOFT);
        if let Some(sign) = shown.exhibit.joiner {
            let middle = f64::from(place.y) + 0.5 * f64::from(place.height) + 15.0 * scale;
            write(&mut canvas, x - 0.5 * place.gap, middle, Align::Center, sign, 54.0, place.gap, SOFT);
        }
    }
    let bottom = f64::from(layout.height) - 36.0 * scale;
    write(&mut canvas, left, bottom, Align::Left, foot, 23.0, 0.7 * content, SOFT);
    write(&mut canvas, right, bottom, Align::Right, "gonio tour -o tour", 23.0, 0.28 * content, SOFT);
    Ok(canvas)
}
