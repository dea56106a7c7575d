//! Formulas as a textbook sets them: TeX's rules, in the fonts of [`crate::theme`].
//!
//! A [`Node`] is a formula; [`Laid`] has the position of each piece, in points from the start of its baseline;
//! [`paint`] draws it and gives the rectangles of tagged parts, to be clicked. Layout knows no window: it asks a
//! [`Measure`] how large a piece of text is.
//!
//! Distances are those of Computer Modern in TeX (D. E. Knuth, *The TeXbook*, 1986, appendix G), in ems.

mod fonts;
mod layout;
mod node;

pub use fonts::{EguiFonts, paint};
pub use layout::{Laid, Piece, Shape, broken, lay};
pub use node::{Face, Node, Tag};

/// Measures text.
pub trait Measure {
    /// The size of `text` on one line, with `size` points per em.
    fn measure(&mut self, text: &str, face: Face, size: f32) -> Extent;
}

/// The size of a piece of text, points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// To where the next piece begins.
    pub width: f32,
    /// Ink above the baseline.
    pub ascent: f32,
    /// Ink below the baseline.
    pub descent: f32,
}
