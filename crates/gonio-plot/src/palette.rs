//! The colours of the two themes.

use crate::PlotTheme;
use serde::{Deserialize, Serialize};

/// A colour in 8-bit sRGB.
pub type Rgb8 = [u8; 3];

/// The colours of a theme.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Palette {
    /// The paper.
    pub background: Rgb8,
    /// Text and axes.
    pub ink: Rgb8,
    /// Less important text.
    pub soft: Rgb8,
    /// Grid lines.
    pub grid: Rgb8,
    /// The functions, distinguishable with any colour vision. Source: M. Okabe and K. Ito, *Color Universal Design*, 2008;
    /// lightened where the paper is dark.
    pub series: [Rgb8; crate::MOST_FUNCTIONS],
}

/// The colours of a theme.
pub fn palette(theme: PlotTheme) -> Palette {
    match theme {
        PlotTheme::Light => Palette {
            background: [255, 255, 255],
            ink: [26, 26, 26],
            soft: [90, 90, 90],
            grid: [216, 216, 216],
            series: [
                [0, 114, 178],
                [213, 94, 0],
                [0, 158, 115],
                [204, 121, 167],
                [60, 60, 60],
                [230, 159, 0],
                [86, 180, 233],
            ],
        },
        PlotTheme::Dark => Palette {
            background: [22, 24, 28],
            ink: [232, 232, 232],
            soft: [170, 170, 170],
            grid: [62, 66, 74],
            series: [
                [86, 180, 233],
                [240, 134, 60],
                [46, 196, 152],
                [224, 151, 192],
                [220, 220, 220],
                [240, 196, 60],
                [110, 140, 240],
            ],
        },
    }
}
