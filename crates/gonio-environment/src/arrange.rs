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
//! nothing in the picture shows which one it is.

use crate::face::{Face, Layout};
use crate::panorama::color;
use crate::{Cubemap, EnvironmentError};
use gonio_image::Image;
use gonio_light::named_enum;

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
/// A size that is not such a grid of square cells; [`Arrangement::Faces`] and [`Arrangement::Equirectangular`], which
/// are not six faces in one picture.
pub fn to_cubemap(image: &Image, arrangement: Arrangement, layout: Layout) -> Result<Arranged, EnvironmentError> {
    let size = cell_size(image, arrangement)?;
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let mut cells = arrangement.cells();
    match arrangement {
        Arrangement::Cross => {
            let (back_first, clear) = is_back_first(image, size);
            if back_first {
                cells = CROSS_BACK_FIRST.to_vec();
                notes.push("the cross begins with the face behind, `negz`".to_owned());
            }
            if !clear {
                warnings.push(CELLS_NOT_EMPTY.to_owned());
            }
        }
        Arrangement::VerticalCross if !has_empty_corners(image, size) => {
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
/// Those of [`to_cubemap`], and a picture that would be too wide or too high for its size to be counted.
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

/// The arrangement guessed from a size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recognised {
    /// Never [`Arrangement::Faces`].
    pub arrangement: Arrangement,
    /// A warning if no arrangement has this size.
    pub warning: Option<String>,
}

/// Guesses the arrangement of a picture from its size: 4:3 a cross, 3:4 a vertical one, 6:1 and 1:6 strips, 2:1
/// equirectangular. All other sizes are equirectangular too, with a warning that explains their width and height.
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
/// Of the second and the third column, the one whose upper and lower cell look more like that is empty too.
fn is_back_first(image: &Image, size: u32) -> (bool, bool) {
    let corners = [(0, 0), (0, 2), (3, 0), (3, 2)];
    let empty = CellStatistics::of_cells(image, size, &corners);
    let second = CellStatistics::of_cells(image, size, &[(1, 0), (1, 2)]).distance(&empty);
    let third = CellStatistics::of_cells(image, size, &[(2, 0), (2, 2)]).distance(&empty);
    let back_first = second < third;
    (back_first, empty.spread < ALMOST_ONE_COLOUR && second.min(third) < ALMOST_ONE_COLOUR)
}

/// Whether the six cells beside a vertical cross are (almost) of one colour.
fn has_empty_corners(image: &Image, size: u32) -> bool {
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

    /// The distance of the pixels from another's mean.
    fn distance(&self, other: &CellStatistics) -> f64 {
        (self.mean - other.mean).abs().element_sum() / 3.0 + self.spread
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use gonio_image::Pixel;

    const PICTURES: [Arrangement; 4] =
        [Arrangement::Cross, Arrangement::VerticalCross, Arrangement::Strip, Arrangement::VerticalStrip];
    const LAYOUTS: [Layout; 2] = [Layout::OpenGl, Layout::Photographic];

    /// Smooth, and different in every direction.
    fn smooth(size: u32) -> Cubemap {
        Cubemap::from_function(size, |d| DVec3::new(1.5 + d.x, 1.5 + d.y, 1.5 + d.z))
    }

    fn distance(a: Pixel, b: Pixel) -> f32 {
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt()
    }

    fn arranged(image: &Image, arrangement: Arrangement, layout: Layout) -> Arranged {
        to_cubemap(image, arrangement, layout).unwrap_or_else(|e| panic!("{e}"))
    }

    fn picture(map: &Cubemap, arrangement: Arrangement, layout: Layout) -> Image {
        from_cubemap(map, arrangement, layout).unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn every_arrangement_comes_back() {
        let map = smooth(5);
        for arrangement in PICTURES {
            for layout in LAYOUTS {
                let image = picture(&map, arrangement, layout);
                let back = arranged(&image, arrangement, layout);
                assert_eq!(back.cubemap, map, "{arrangement} {layout}");
                assert!(back.notes.is_empty() && back.warnings.is_empty(), "{back:?}");
                assert_eq!(recognise(image.width, image.height).arrangement, arrangement);
            }
        }
    }

    /// The definition of a cross: cells that touch are continuous, in both layouts.
    #[test]
    fn crosses_are_continuous_across_every_border() {
        let size = 16;
        let map = smooth(size);
        for arrangement in [Arrangement::Cross, Arrangement::VerticalCross] {
            let (across, down) = arrangement.grid().unwrap_or_default();
            for layout in LAYOUTS {
                let image = picture(&map, arrangement, layout);
                let filled = |column: u32, row: u32| arrangement.cells().iter().any(|c| (c.1, c.2) == (column, row));
                let mut borders = 0;
                for (column, row) in
                    (0..across).flat_map(|c| (0..down).map(move |r| (c, r))).filter(|c| filled(c.0, c.1))
                {
                    for i in 0..size {
                        let beside = (column + 1 < across && filled(column + 1, row)).then(|| {
                            let (x, y) = ((column + 1) * size, row * size + i);
                            distance(image.at(x - 1, y), image.at(x, y))
                        });
                        let below = (row + 1 < down && filled(column, row + 1)).then(|| {
                            let (x, y) = (column * size + i, (row + 1) * size);
                            distance(image.at(x, y - 1), image.at(x, y))
                        });
                        for step in [beside, below].into_iter().flatten() {
                            // Directions of neighbouring texels are at most 2 / 16 apart.
                            assert!(step < 0.125, "{arrangement} {layout}: cell {column} {row}: {step}");
                            borders += 1;
                        }
                    }
                }
                // Five borders join six cells.
                assert_eq!(borders, 5 * size, "{arrangement}");
            }
        }
    }

    /// In the photographic layout the middle is straight ahead, right is right and up is up.
    #[test]
    fn photographic_crosses_look_as_the_world_does() {
        let map = smooth(4);
        let image = picture(&map, Arrangement::Cross, Layout::Photographic);
        let near = |x: u32, y: u32, d: DVec3| {
            let expected = d.normalize() + 1.5;
            let found = crate::panorama::color(image.at(x, y));
            // Stored as f32.
            assert!(found.abs_diff_eq(expected, 1e-6), "{x} {y}: {found} is not {expected}");
        };
        // Of a size of 4 the middles of texels are at -3/4, -1/4, 1/4, 3/4. Ahead is -Z.
        near(4, 4, DVec3::new(-0.75, 0.75, -1.0));
        near(7, 6, DVec3::new(0.75, -0.25, -1.0));
        // To the right of it +X, where columns go on to +Z; above it +Y, whose lowest row is next to -Z.
        near(8, 4, DVec3::new(1.0, 0.75, -0.75));
        near(7, 3, DVec3::new(0.75, 1.0, -0.75));
        // The last cell is behind.
        near(15, 5, DVec3::new(-0.75, 0.25, 1.0));
    }

    #[test]
    fn a_cross_that_begins_with_the_face_behind_is_recognised_by_its_empty_cells() {
        let map = smooth(8);
        let cross = picture(&map, Arrangement::Cross, Layout::Photographic);
        // One cell further to the right, the last one first.
        let mut turned = cross.clone();
        turned.pixels.chunks_exact_mut(32).for_each(|row| row.rotate_right(8));
        let back = arranged(&turned, Arrangement::Cross, Layout::Photographic);
        assert_eq!(back.cubemap, map);
        assert_eq!(back.notes, ["the cross begins with the face behind, `negz`"]);
        assert!(back.warnings.is_empty());
        // White instead of black, and a sky of one colour: the corners show what empty is.
        let mut plain = Cubemap::new(8, [0.1, 0.2, 0.9, 1.0]);
        plain.face_mut(Face::NegY).fill([0.0, 0.0, 0.0, 1.0]);
        let mut white = picture(&plain, Arrangement::Cross, Layout::Photographic);
        for (column, row) in [(0, 0), (2, 0), (3, 0), (0, 2), (2, 2), (3, 2)] {
            for y in 0..8 {
                let start = (row * 8 + y) * 32 + column * 8;
                white.pixels[start..start + 8].fill([1.0; 4]);
            }
        }
        assert_eq!(arranged(&white, Arrangement::Cross, Layout::Photographic).cubemap, plain);
        white.pixels.chunks_exact_mut(32).for_each(|row| row.rotate_right(8));
        assert_eq!(arranged(&white, Arrangement::Cross, Layout::Photographic).cubemap, plain);
    }

    #[test]
    fn a_picture_without_empty_cells_is_reported() {
        let mut image = Image::new(32, 24, [0.0; 4]);
        for (i, pixel) in image.pixels.iter_mut().enumerate() {
            *pixel = [(i % 32) as f32 / 32.0, (i / 32) as f32 / 24.0, 0.5, 1.0];
        }
        assert_eq!(arranged(&image, Arrangement::Cross, Layout::OpenGl).warnings.len(), 1);
        let upright = Image { width: 24, height: 32, ..image };
        assert_eq!(arranged(&upright, Arrangement::VerticalCross, Layout::OpenGl).warnings.len(), 1);
    }

    #[test]
    fn sizes_have_the_documented_meaning() {
        let kind = |width, height| {
            let found = recognise(width, height);
            (found.arrangement, found.warning.is_some())
        };
        assert_eq!(kind(4096, 2048), (Arrangement::Equirectangular, false));
        assert_eq!(kind(4096, 3072), (Arrangement::Cross, false));
        assert_eq!(kind(768, 1024), (Arrangement::VerticalCross, false));
        assert_eq!(kind(6, 1), (Arrangement::Strip, false));
        assert_eq!(kind(1, 6), (Arrangement::VerticalStrip, false));
        // Square, 3:2, and the largest there is.
        for (width, height) in [(512, 512), (600, 400), (u32::MAX, u32::MAX)] {
            assert_eq!(kind(width, height), (Arrangement::Equirectangular, true), "{width} {height}");
        }
        let warning = recognise(600, 400).warning.unwrap_or_default();
        assert!(warning.contains("360 degrees") && warning.contains("180"), "{warning}");
    }

    #[test]
    fn sizes_that_are_no_grid_are_refused() {
        for arrangement in PICTURES {
            let refused = to_cubemap(&Image::new(10, 7, [0.0; 4]), arrangement, Layout::OpenGl).map_err(|e| e.message);
            let message = refused.err().unwrap_or_default();
            assert!(message.contains("10 x 7") && message.contains(arrangement.name()), "{message}");
            assert!(to_cubemap(&Image::default(), arrangement, Layout::OpenGl).is_err());
        }
        for arrangement in [Arrangement::Faces, Arrangement::Equirectangular] {
            assert!(to_cubemap(&Image::new(12, 6, [0.0; 4]), arrangement, Layout::OpenGl).is_err());
            assert!(from_cubemap(&smooth(1), arrangement, Layout::OpenGl).is_err());
        }
    }
}
