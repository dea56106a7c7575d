//! Where everything stands on the sheet.

use super::exhibit::Section;

/// Lengths at the sheet's full size, in pixels.
pub const WIDTH: f64 = 1920.0;
/// On every side.
pub const MARGIN: f64 = 64.0;
/// Between pictures.
const GAP: f64 = 18.0;
/// Between pictures with a sign between them.
const JOINED_GAP: f64 = 58.0;
/// The title above everything.
const TITLE: f64 = 214.0;
/// From the end of a section to the baseline of the next heading.
const ABOVE_HEADING: f64 = 88.0;
/// From a heading's baseline to its pictures.
const BELOW_HEADING: f64 = 30.0;
/// Caption and remark below a picture.
const CAPTION: f64 = 80.0;
/// Between rows, beyond the caption.
const BETWEEN_ROWS: f64 = 12.0;
/// Below the last section.
const FOOT: f64 = 84.0;

/// A picture's place, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Of the left edge.
    pub x: u32,
    /// Of the upper edge.
    pub y: u32,
    /// At least 1.
    pub width: u32,
    /// At least 1.
    pub height: u32,
    /// Width of the gap to its left, for the sign in it.
    pub gap: f64,
}

/// The whole sheet.
pub struct Layout {
    /// All lengths are multiplied by this.
    pub scale: f64,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Baseline of each section's heading; none for a section without a title.
    pub headings: Vec<Option<f64>>,
    /// Of every exhibit, in order.
    pub places: Vec<Place>,
}

impl Layout {
    /// Rows that are filled from margin to margin.
    pub fn new(sections: &[Section], scale: f64) -> Self {
        let content = WIDTH - 2.0 * MARGIN;
        let mut y = TITLE;
        let (mut headings, mut places) = (Vec::new(), Vec::new());
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
                    places.push(Place {
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
        Layout { scale, width: (WIDTH * scale).round() as u32, height: (y * scale).ceil() as u32, headings, places }
    }
}
