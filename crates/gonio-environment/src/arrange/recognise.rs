//! Guesses the arrangement of a picture from its size, and which of the two crosses it is.

use super::{Arrangement, cell};
use crate::panorama::color;
use gonio_image::Image;

/// The arrangement guessed from a size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recognised {
    /// Never [`Arrangement::Faces`].
    pub arrangement: Arrangement,
    /// A warning if no arrangement has this size.
    pub warning: Option<String>,
}

/// Guesses the arrangement of a picture from its size: 4:3 a cross, 3:4 a vertical one, 6:1 and 1:6 strips, 2:1 equirectangular.
/// Everything else is equirectangular too, with a warning that says what its width and height then mean.
pub fn recognise(width: u32, height: u32) -> Recognised {
    let (w, h) = (u64::from(width), u64::from(height));
    let is = |across: u64, down: u64| w * down == h * across && w.is_multiple_of(across);
    for arrangement in [Arrangement::Cross, Arrangement::VerticalCross, Arrangement::Strip, Arrangement::VerticalStrip]
    {
        if arrangement.grid().is_some_and(|(across, down)| is(across.into(), down.into())) {
            return Recognised { arrangement, warning: None };
        }
    }
    let warning = (w != 2 * h).then(|| {
        format!(
            "{width} x {height} pixels are not the size of a cross, a strip or a 2:1 panorama; the picture is read as an \
             equirectangular panorama, 360 degrees across its width and 180 along its height"
        )
    });
    Recognised { arrangement: Arrangement::Equirectangular, warning }
}

/// Whether a cross begins with the face behind; and whether the cells that are empty then are (almost) of one colour.
///
/// The first and the last column are empty above and below the sides in both crosses, and show what empty looks like.
/// Of the second and the third column the one whose upper and lower cell look more like that is empty too.
pub(super) fn is_back_first(image: &Image, size: u32) -> (bool, bool) {
    let corners = [(0, 0), (0, 2), (3, 0), (3, 2)];
    let empty = CellStatistics::of_cells(image, size, &corners);
    let second = CellStatistics::of_cells(image, size, &[(1, 0), (1, 2)]).distance(&empty);
    let third = CellStatistics::of_cells(image, size, &[(2, 0), (2, 2)]).distance(&empty);
    let back_first = second < third;
    (back_first, empty.spread < ALMOST_ONE_COLOUR && second.min(third) < ALMOST_ONE_COLOUR)
}

/// Whether the six cells beside a vertical cross are (almost) of one colour.
pub(super) fn has_empty_corners(image: &Image, size: u32) -> bool {
    CellStatistics::of_cells(image, size, &[(0, 0), (2, 0), (0, 2), (2, 2), (0, 3), (2, 3)]).spread < ALMOST_ONE_COLOUR
}

/// The mean difference of encoded light below which pixels count as of one colour. JPEG's noise beside an edge is some
/// 0.01 on average over a cell; the sky of a photograph is above 0.03.
const ALMOST_ONE_COLOUR: f64 = 0.02;

/// Statistics of cells: their mean, and how far pixels are from it. In roots of light, which are near to what is seen,
/// and in which one bright lamp does not hide everything else.
struct CellStatistics {
    mean: glam::DVec3,
    spread: f64,
}

impl CellStatistics {
    fn of_cells(image: &Image, size: u32, cells: &[(u32, u32)]) -> CellStatistics {
        let seen: Vec<glam::DVec3> = cells
            .iter()
            .flat_map(|(column, row)| cell(image, size, *column, *row, false).pixels)
            .map(|p| color(p).map(f64::sqrt))
            .collect();
        let count = seen.len().max(1) as f64;
        let mean = seen.iter().sum::<glam::DVec3>() / count;
        let spread = seen.iter().map(|c| (c - mean).abs().element_sum() / 3.0).sum::<f64>() / count;
        CellStatistics { mean, spread }
    }

    /// How far the pixels are from another's mean.
    fn distance(&self, other: &CellStatistics) -> f64 {
        (self.mean - other.mean).abs().element_sum() / 3.0 + self.spread
    }
}
