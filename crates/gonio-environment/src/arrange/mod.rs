//! Six faces in one picture: crosses and strips.
//!
//! ```text
//! cross                          vertical-cross             strip
//!        posy                           posy                posx negx posy negy posz negz
//!  negx  posz  posx  negz         negx  posz  posx
//!        negy                           negy                vertical-strip: the same downwards
//!                                       negz (turned)
//! ```
//!
//! - A **cross** is the cube unfolded: every two cells that touch are continuous. It is the same arrangement in both
//!   layouts. In the photographic one it looks as the world does: straight ahead in the middle, what is to the right to
//!   the right. In OpenGL's it is the cross of the world in a mirror, with +Z in the middle; it is continuous all the
//!   same, since the two layouts differ by mirroring the whole world.
//! - Some programs put `negz` first in the row instead of last, and `posy`, `negy` over and under the third cell then.
//!   Which one a picture is shows in the cells that are empty; gonio writes the one drawn above.
//! - In the **vertical cross** the lowest cell is the face behind, turned by 180 degrees, so that it is continuous with
//!   the cell above it (as HDRShop writes it, and P. Debevec's light probes have it).
//! - A **strip** has the faces in OpenGL's order, none turned: what ffmpeg's `v360` calls `c6x1`, and what Cycles, Godot
//!   and OpenEXR (downwards) have. Its cells are not continuous.
//!
//! Grids of 3 x 2 are not read: those in use (ffmpeg's `c3x2`, video platforms) differ in order and in turned faces, and
//! nothing in the picture says which one it is.

mod recognise;

use crate::face::{Face, Layout};
use crate::{Cubemap, EnvironmentError};
use gonio_image::Image;
use gonio_light::named_enum;
pub use recognise::{Recognised, recognise};

named_enum! {
    /// The arrangement of an environment in files.
    pub enum Arrangement {
        /// Six files, one a face.
        Faces = "faces",
        /// One picture, 4 by 3 faces: the cube unfolded, four sides in a row.
        Cross = "cross",
        /// One picture, 3 by 4 faces: the cube unfolded, the face behind at the bottom and turned by 180 degrees.
        VerticalCross = "vertical-cross",
        /// One picture, the six faces side by side in OpenGL's order.
        Strip = "strip",
        /// One picture, the six faces below one another in OpenGL's order.
        VerticalStrip = "vertical-strip",
        /// One picture of the whole sphere, 360 degrees wide and 180 high.
        Equirectangular = "equirectangular",
    }
    default Faces;
    what "arrangement of an environment";
}

/// The position of a face: column and row of its cell, and whether it is turned by 180 degrees there.
type Cell = (Face, u32, u32, bool);

const CROSS: [Cell; 6] = [
    (Face::PosX, 2, 1, false),
    (Face::NegX, 0, 1, false),
    (Face::PosY, 1, 0, false),
    (Face::NegY, 1, 2, false),
    (Face::PosZ, 1, 1, false),
    (Face::NegZ, 3, 1, false),
];

/// The cross that begins with the face behind.
const CROSS_BACK_FIRST: [Cell; 6] = [
    (Face::PosX, 3, 1, false),
    (Face::NegX, 1, 1, false),
    (Face::PosY, 2, 0, false),
    (Face::NegY, 2, 2, false),
    (Face::PosZ, 2, 1, false),
    (Face::NegZ, 0, 1, false),
];

const VERTICAL_CROSS: [Cell; 6] = [
    (Face::PosX, 2, 1, false),
    (Face::NegX, 0, 1, false),
    (Face::PosY, 1, 0, false),
    (Face::NegY, 1, 2, false),
    (Face::PosZ, 1, 1, false),
    (Face::NegZ, 1, 3, true),
];

impl Arrangement {
    /// Width and height of the picture in faces; `None` unless it is one picture of six faces.
    pub fn grid(self) -> Option<(u32, u32)> {
        match self {
            Arrangement::Faces | Arrangement::Equirectangular => None,
            Arrangement::Cross => Some((4, 3)),
            Arrangement::VerticalCross => Some((3, 4)),
            Arrangement::Strip => Some((6, 1)),
            Arrangement::VerticalStrip => Some((1, 6)),
        }
    }

    /// The cells of the six faces; empty unless the arrangement is one picture of six faces.
    fn cells(self) -> Vec<Cell> {
        match self {
            Arrangement::Faces | Arrangement::Equirectangular => Vec::new(),
            Arrangement::Cross => CROSS.to_vec(),
            Arrangement::VerticalCross => VERTICAL_CROSS.to_vec(),
            Arrangement::Strip => Face::ALL.map(|f| (f, f as u32, 0, false)).to_vec(),
            Arrangement::VerticalStrip => Face::ALL.map(|f| (f, 0, f as u32, false)).to_vec(),
        }
    }
}

/// A cubemap read from one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Arranged {
    /// The six faces.
    pub cubemap: Cubemap,
    /// Notes, for example on which of the two crosses the picture is.
    pub notes: Vec<String>,
    /// A warning about cells of a cross that should be empty.
    pub warnings: Vec<String>,
}

/// Reads the six faces of a picture, which are in `layout`.
///
/// # Errors
///
/// A size that is not such a grid of square cells; [`Arrangement::Faces`] and [`Arrangement::Equirectangular`], which are
/// not six faces in one picture.
pub fn to_cubemap(image: &Image, arrangement: Arrangement, layout: Layout) -> Result<Arranged, EnvironmentError> {
    let size = cell_size(image, arrangement)?;
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let mut cells = arrangement.cells();
    match arrangement {
        Arrangement::Cross => {
            let (back_first, clear) = recognise::is_back_first(image, size);
            if back_first {
                cells = CROSS_BACK_FIRST.to_vec();
                notes.push("the cross begins with the face behind, `negz`".to_owned());
            }
            if !clear {
                warnings.push(CELLS_NOT_EMPTY.to_owned());
            }
        }
        Arrangement::VerticalCross if !recognise::has_empty_corners(image, size) => {
            warnings.push(CELLS_NOT_EMPTY.to_owned());
        }
        _ => {}
    }
    let face_of = |face: Face| {
        let (column, row, turned) = cells.iter().find(|c| c.0 == face).map_or((0, 0, false), |c| (c.1, c.2, c.3));
        cell(image, size, column, row, turned)
    };
    let cubemap = Cubemap::from_faces(Face::ALL.map(face_of), layout)?;
    Ok(Arranged { cubemap, notes, warnings })
}

const CELLS_NOT_EMPTY: &str =
    "cells of the cross that should be empty are not; if the picture is not a cross, give its arrangement";

/// Writes the six faces, in a layout, into one picture; empty cells are black.
///
/// # Errors
///
/// As of [`to_cubemap`], and where the picture would be wider or higher than can be counted.
pub fn from_cubemap(map: &Cubemap, arrangement: Arrangement, layout: Layout) -> Result<Image, EnvironmentError> {
    let (across, down) = arrangement.grid().ok_or_else(|| no_grid(arrangement))?;
    let size = map.size();
    let side = |n: u32| {
        n.checked_mul(size)
            .ok_or_else(|| EnvironmentError::new("the picture would be too large; choose a smaller size"))
    };
    let mut image = Image::new(side(across)?, side(down)?, [0.0, 0.0, 0.0, 1.0]);
    let faces = map.faces(layout);
    let width = image.width as usize;
    for (face, column, row, turned) in arrangement.cells() {
        let from = &faces[face as usize];
        for y in 0..size {
            let start = (row * size + y) as usize * width + (column * size) as usize;
            let to = &mut image.pixels[start..][..size as usize];
            to.copy_from_slice(from.row(if turned { size - 1 - y } else { y }));
            if turned {
                to.reverse();
            }
        }
    }
    Ok(image)
}

/// One cell as a picture.
fn cell(image: &Image, size: u32, column: u32, row: u32, turned: bool) -> Image {
    let mut pixels = Vec::with_capacity(size as usize * size as usize);
    for y in 0..size {
        let line = image.row(row * size + y);
        pixels.extend_from_slice(&line[(column * size) as usize..][..size as usize]);
    }
    if turned {
        pixels.reverse();
    }
    Image { width: size, height: size, pixels }
}

/// Pixels along a cell's edge.
fn cell_size(image: &Image, arrangement: Arrangement) -> Result<u32, EnvironmentError> {
    let (across, down) = arrangement.grid().ok_or_else(|| no_grid(arrangement))?;
    let size = image.width / across;
    if size == 0 || u64::from(size) * u64::from(across) != u64::from(image.width) || size * down != image.height {
        return Err(EnvironmentError::new(format!(
            "a {arrangement} is {across} by {down} square faces, and {} x {} pixels are not; cut the picture to such a \
             size",
            image.width, image.height
        )));
    }
    Ok(size)
}

fn no_grid(arrangement: Arrangement) -> EnvironmentError {
    EnvironmentError::new(format!(
        "`{arrangement}` is not six faces in one picture: expected cross, vertical-cross, strip or vertical-strip"
    ))
}

#[cfg(test)]
mod tests;
