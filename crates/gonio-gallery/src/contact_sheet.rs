//! The contact sheet: the positions of headings and pictures, and the sheet itself.

use crate::GalleryError;
use crate::drawing::DrawnExhibit;
use crate::exhibit::Section;
use crate::markup;
use crate::rgb_image::{Rgb, RgbImage};
use crate::typesetter::{Align, TextColors, Typesetter};

/// The background of the sheet.
pub const BACKGROUND: Rgb = [18, 20, 25];
const LINE: Rgb = [44, 48, 58];
const BRIGHT: TextColors = TextColors { plain: [238, 236, 230], stressed: [255, 190, 110], faded: [120, 126, 138] };
const SOFT: TextColors = TextColors { plain: [150, 156, 168], stressed: [255, 190, 110], faded: [100, 106, 118] };
const TITLE_COLORS: TextColors = TextColors { plain: [255, 190, 110], ..BRIGHT };
/// Radius of the pictures' corners at full size.
const RADIUS: f64 = 9.0;

/// Puts the pictures and their texts together. `foot` is the text at the lower edge, `command` the command that makes the sheet.
///
/// # Errors
///
/// A built-in font that cannot be read.
pub fn compose(
    sections: &[Section],
    layout: &SheetLayout,
    drawn: &[DrawnExhibit<'_>],
    foot: &str,
    command: &str,
) -> Result<RgbImage, GalleryError> {
    let typesetter = Typesetter::new()?;
    let mut image = RgbImage::new(layout.width, layout.height, BACKGROUND);
    let scale = layout.scale;
    let content = (WIDTH - 2.0 * MARGIN) * scale;
    let write = |image: &mut RgbImage, x: f64, y: f64, align, text: &str, size: f64, max_width: f64, colors| {
        let at = (x as f32, y as f32);
        let runs = markup::runs(text);
        typesetter.draw(image, at, align, &runs, (size * scale) as f32, max_width as f32, colors);
    };
    let (left, right) = (MARGIN * scale, (WIDTH - MARGIN) * scale);

    write(&mut image, left - 5.0 * scale, 116.0 * scale, Align::Left, "gonio", 132.0, content, TITLE_COLORS);
    let tagline = "the light lab: every technique on several models";
    write(&mut image, left, 184.0 * scale, Align::Left, tagline, 32.0, content, SOFT);
    let whole = sections.first().map_or("", |s| s.equation);
    write(&mut image, right, 112.0 * scale, Align::Right, whole, 44.0, 0.66 * content, BRIGHT);
    let legend = "ambient + emitted + for every light: diffuse and specular, times its light and attenuation";
    write(&mut image, right, 184.0 * scale, Align::Right, legend, 27.0, 0.6 * content, SOFT);

    for (section, &baseline) in sections.iter().zip(&layout.headings) {
        let Some(y) = baseline else { continue };
        let line_y = (y - 58.0 * scale).max(0.0) as u32;
        image.fill(left as u32, line_y, content as u32, scale.max(1.0) as u32, LINE);
        write(&mut image, left, y, Align::Left, section.title, 44.0, 0.5 * content, BRIGHT);
        write(&mut image, right, y, Align::Right, section.equation, 31.0, 0.48 * content, SOFT);
    }

    for (drawn, place) in drawn.iter().zip(&layout.placements) {
        image.draw_rounded(place.x, place.y, &drawn.small, (RADIUS * scale) as f32);
        let (x, bottom) = (f64::from(place.x), f64::from(place.y + place.height));
        let width = f64::from(place.width);
        write(&mut image, x, bottom + 33.0 * scale, Align::Left, &drawn.exhibit.caption, 28.0, width, BRIGHT);
        write(&mut image, x, bottom + 61.0 * scale, Align::Left, &drawn.remark(), 23.0, width, SOFT);
        if let Some(sign) = drawn.exhibit.joiner {
            let middle = f64::from(place.y) + 0.5 * f64::from(place.height) + 15.0 * scale;
            write(&mut image, x - 0.5 * place.gap, middle, Align::Center, sign, 54.0, place.gap, SOFT);
        }
    }
    let bottom = f64::from(layout.height) - 36.0 * scale;
    write(&mut image, left, bottom, Align::Left, foot, 23.0, 0.7 * content, SOFT);
    write(&mut image, right, bottom, Align::Right, command, 23.0, 0.28 * content, SOFT);
    Ok(image)
}

/// Width of the sheet. All lengths here are pixels at full size.
const WIDTH: f64 = 1920.0;
/// Margin on every side.
const MARGIN: f64 = 64.0;
/// Gap between pictures.
const GAP: f64 = 18.0;
/// Gap between pictures with a sign between them.
const JOINED_GAP: f64 = 58.0;
/// Height of the title.
const TITLE_HEIGHT: f64 = 214.0;
/// Distance from the end of a section to the baseline of the next heading.
const ABOVE_HEADING: f64 = 88.0;
/// Distance from a heading's baseline to its pictures.
const BELOW_HEADING: f64 = 30.0;
/// Height of caption and remark below a picture.
const CAPTION: f64 = 80.0;
/// Gap between rows, beyond the caption.
const BETWEEN_ROWS: f64 = 12.0;
/// Height of the foot below the last section.
const FOOT: f64 = 84.0;

/// The position and size of a picture in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The left edge.
    pub x: u32,
    /// The upper edge.
    pub y: u32,
    /// At least 1.
    pub width: u32,
    /// At least 1.
    pub height: u32,
    /// Width of the gap to its left, which may hold a sign.
    pub gap: f64,
}

/// The layout of a contact sheet.
pub struct SheetLayout {
    /// The factor of all lengths.
    pub scale: f64,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Baseline of each section's heading; none for a section without a title.
    pub headings: Vec<Option<f64>>,
    /// The placement of every exhibit, in order.
    pub placements: Vec<Placement>,
}

impl SheetLayout {
    /// Lays out rows that are filled from margin to margin.
    pub fn new(sections: &[Section], scale: f64) -> Self {
        let content = WIDTH - 2.0 * MARGIN;
        let mut y = TITLE_HEIGHT;
        let (mut headings, mut placements) = (Vec::new(), Vec::new());
        for section in sections {
            if section.title.is_empty() {
                headings.push(None);
            } else {
                y += ABOVE_HEADING;
                headings.push(Some(y * scale));
                y += BELOW_HEADING;
            }
            for (index, row) in section.rows.iter().enumerate() {
                if index > 0 {
                    y += BETWEEN_ROWS;
                }
                let gaps: Vec<f64> = row
                    .iter()
                    .enumerate()
                    .map(|(i, e)| match (i, e.joiner) {
                        (0, _) => 0.0,
                        (_, Some(_)) => JOINED_GAP,
                        _ => GAP,
                    })
                    .collect();
                let aspects: f64 = row.iter().map(|e| e.aspect).sum();
                let height = (content - gaps.iter().sum::<f64>()) / aspects.max(1e-3);
                let mut x = MARGIN;
                for (exhibit, gap) in row.iter().zip(gaps) {
                    x += gap;
                    let right = x + height * exhibit.aspect;
                    let pixel = |v: f64| (v * scale).round() as u32;
                    placements.push(Placement {
                        x: pixel(x),
                        y: pixel(y),
                        width: (pixel(right) - pixel(x)).max(1),
                        height: pixel(height).max(1),
                        gap: gap * scale,
                    });
                    x = right;
                }
                y += height + CAPTION;
            }
        }
        y += FOOT;
        SheetLayout {
            scale,
            width: (WIDTH * scale).round() as u32,
            height: (y * scale).ceil() as u32,
            headings,
            placements,
        }
    }
}
