//! The positions of headings and pictures on the contact sheet.

use crate::exhibit::Section;

/// Width of the sheet. All lengths here are pixels at full size.
pub const WIDTH: f64 = 1920.0;
/// Margin on every side.
pub const MARGIN: f64 = 64.0;
/// Gap between pictures.
const GAP: f64 = 18.0;
/// Gap between pictures with a sign between them.
const JOINED_GAP: f64 = 58.0;
/// Height of the title.
const TITLE: f64 = 214.0;
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
        let mut y = TITLE;
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
