//! Six small square pictures, and their comparison in all orientations.

use crate::comparison::{PIXEL_TOLERANCE, PIXELS_TOLERANCE};
use crate::testbench::Atlas;
use gonio_environment::Face;
use gonio_light::color::{srgb_decode, srgb_encode};

/// Number of orientations of a square picture: the right one and seven others.
pub const WAYS: usize = 8;

/// Six pictures, rows from the top (t = -1), in OpenGL's order of faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiles {
    /// Side length in pixels.
    pub side: usize,
    /// `side * side` pixels of each face.
    pub faces: [Vec<[f32; 3]>; 6],
}

/// The tolerance of the comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The tolerance of a channel.
    pub pixel: f32,
    /// The share of pixels that may differ by more.
    pub share: f64,
}

impl Tolerance {
    /// The tolerance for pictures drawn here, as in all exercises.
    pub const DRAWN: Tolerance = Tolerance { pixel: PIXEL_TOLERANCE, share: PIXELS_TOLERANCE };
    /// The tolerance for files, which other programs filter and JPEG rounds, after both pictures are reduced.
    /// Measured on nearest, bilinear and bicubic conversions of the exercise's panorama.
    pub const FILES: Tolerance = Tolerance { pixel: 0.1, share: 0.1 };
}

/// The comparison of two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The share of pixels beyond the tolerance.
    pub beyond: f64,
    /// The mean of the squared differences.
    pub square: f64,
    /// The largest difference, at most 1.
    pub worst: f32,
}

/// Returns the column and row that an orientation reads a pixel from.
fn source(way: usize, side: usize, x: usize, y: usize) -> (usize, usize) {
    let last = side - 1;
    // In the order of `mistakes::faces::TURNS`, after the right orientation.
    match way {
        0 => (x, y),
        1 => (last - y, x),
        2 => (last - x, last - y),
        3 => (y, last - x),
        4 => (last - x, y),
        5 => (x, last - y),
        6 => (y, x),
        _ => (last - y, last - x),
    }
}

fn difference(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    let channel = |(&a, &b): (&f32, &f32)| match (a.is_nan(), b.is_nan()) {
        (true, true) => 0.0,
        (false, false) => (a.min(1.0) - b.min(1.0)).abs().min(1.0),
        _ => 1.0,
    };
    a.iter().zip(b).map(channel).fold(0.0, f32::max)
}

impl Tiles {
    /// Compares a face with another one in a given orientation.
    pub fn fit(&self, face: usize, other: &Tiles, of: usize, way: usize, tolerance: Tolerance) -> Fit {
        let side = self.side;
        let (mut beyond, mut square, mut worst) = (0_usize, 0.0, 0.0_f32);
        for y in 0..side {
            for x in 0..side {
                let (from_x, from_y) = source(way, side, x, y);
                let difference = difference(&self.faces[face][y * side + x], &other.faces[of][from_y * side + from_x]);
                beyond += usize::from(difference > tolerance.pixel);
                square += f64::from(difference).powi(2);
                worst = worst.max(difference);
            }
        }
        let count = (side * side).max(1) as f64;
        Fit { beyond: beyond as f64 / count, square: square / count, worst }
    }

    /// Rearranges the pictures: for each face, the face to show and its orientation.
    pub fn rearranged(&self, placed: &[Option<(usize, usize)>; 6]) -> Tiles {
        let side = self.side;
        let face = |face: usize| {
            let (of, way) = placed[face].unwrap_or((face, 0));
            let pixel = |index: usize| {
                let (x, y) = source(way, side, index % side, index / side);
                self.faces[of][y * side + x]
            };
            (0..side * side).map(pixel).collect()
        };
        Tiles { side, faces: std::array::from_fn(face) }
    }

    fn map(&self, change: impl Fn(f32) -> f32) -> Tiles {
        let faces = self.faces.each_ref().map(|face| face.iter().map(|pixel| pixel.map(&change)).collect());
        Tiles { side: self.side, faces }
    }

    /// Encodes the pictures as sRGB, so that differences of dark colours count as they are seen.
    pub fn encoded(&self) -> Tiles {
        self.map(|linear| srgb_encode(linear.into()) as f32)
    }

    /// Decodes the result of [`Tiles::encoded`].
    pub fn decoded(&self) -> Tiles {
        self.map(|encoded| srgb_decode(encoded.into()) as f32)
    }

    /// Clamps the pictures to the range of 8 bits.
    pub fn clamped(&self) -> Tiles {
        self.map(|linear| linear.clamp(0.0, 1.0))
    }

    /// Reduces the pictures; each pixel is the mean of those that it covers, weighted by area.
    pub fn reduced(&self, side: usize) -> Tiles {
        let from = self.side;
        let side = side.clamp(1, from.max(1));
        let covered: Vec<Vec<(usize, f64)>> = (0..side)
            .map(|i| {
                let (start, end) = ((i * from) as f64 / side as f64, ((i + 1) * from) as f64 / side as f64);
                let pixels = start.floor() as usize..(end.ceil() as usize).min(from);
                pixels.map(|at| (at, (end.min(at as f64 + 1.0) - start.max(at as f64)).max(0.0))).collect()
            })
            .collect();
        let face = |face: &Vec<[f32; 3]>| {
            let pixel = |index: usize| {
                let mut sum = [0.0_f64; 3];
                let mut count = 0.0;
                for (y, of_row) in &covered[index / side] {
                    for (x, of_column) in &covered[index % side] {
                        for (sum, channel) in sum.iter_mut().zip(face[y * from + x]) {
                            *sum += of_row * of_column * f64::from(channel);
                        }
                        count += of_row * of_column;
                    }
                }
                sum.map(|sum| (sum / count) as f32)
            };
            (0..side * side).map(pixel).collect()
        };
        Tiles { side, faces: self.faces.each_ref().map(face) }
    }

    /// Blurs the pictures (1 2 1 along both axes) to remove the differences between other programs' filters.
    pub fn blurred(&self) -> Tiles {
        let side = self.side;
        let face = |face: &Vec<[f32; 3]>| {
            let at = |x: usize, y: usize| face[y.min(side - 1) * side + x.min(side - 1)];
            let near = |i: usize| [(i.saturating_sub(1), 0.25), (i, 0.5), (i + 1, 0.25_f32)];
            let pixel = |index: usize| {
                let mut sum = [0.0_f32; 3];
                for (y, of_row) in near(index / side) {
                    for (x, of_column) in near(index % side) {
                        for (sum, channel) in sum.iter_mut().zip(at(x, y)) {
                            *sum += of_row * of_column * channel;
                        }
                    }
                }
                sum
            };
            (0..side * side).map(pixel).collect()
        };
        Tiles { side, faces: self.faces.each_ref().map(face) }
    }

    /// Returns the mean of the squared differences of neighbouring pixels.
    pub fn sharpness(&self) -> f64 {
        let side = self.side;
        let (mut sum, mut count) = (0.0, 0.0);
        for face in &self.faces {
            for y in 1..side {
                for x in 1..side {
                    let pixel = face[y * side + x];
                    for other in [face[y * side + x - 1], face[(y - 1) * side + x]] {
                        sum += f64::from(difference(&pixel, &other)).powi(2);
                        count += 1.0;
                    }
                }
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// Whether two faces show the same picture, which is not a single colour.
    pub fn are_all_equal(&self, tolerance: Tolerance) -> bool {
        let same = (1..6).all(|face| self.fit(face, self, 0, 0, tolerance).beyond <= tolerance.share);
        let first = self.faces[0].first().copied().unwrap_or_default();
        same && self.faces[0].iter().any(|pixel| difference(pixel, &first) > 2.0 * tolerance.pixel)
    }

    /// Converts the pictures to an atlas for reports, in the orientation of image viewers.
    pub fn atlas(&self) -> Atlas {
        let rows = |face: &Vec<[f32; 3]>| -> Vec<[f32; 4]> {
            let rows = face.chunks_exact(self.side.max(1)).rev().flatten();
            rows.map(|[r, g, b]| [*r, *g, *b, 1.0]).collect()
        };
        Atlas { pixels: Face::ALL.into_iter().flat_map(|face| rows(&self.faces[face as usize])).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::faces::TURNS;

    /// Creates pictures in which each pixel has a different colour.
    fn numbered() -> Tiles {
        let face = |face: usize| (0..16).map(|i| [face as f32, (i % 4) as f32, (i / 4) as f32]).collect();
        Tiles { side: 4, faces: std::array::from_fn(face) }
    }

    #[test]
    fn orientations_match_those_of_the_catalogue() {
        let tiles = numbered();
        for (turn, (word, _, formulas)) in TURNS.iter().enumerate() {
            let rearranged = tiles.rearranged(&[Some((0, turn + 1)), None, None, None, None, None]);
            for (index, [_, x, y]) in rearranged.faces[0].iter().enumerate() {
                let (s, t) = ((index % 4) as f32, (index / 4) as f32);
                let expected = formulas.map(|formula| match formula {
                    "s" => s,
                    "-s" => 3.0 - s,
                    "t" => t,
                    _ => 3.0 - t,
                });
                assert_eq!([*x, *y], expected, "{word}");
            }
        }
    }

    #[test]
    fn a_picture_fits_itself_in_one_orientation_only() {
        let tiles = numbered();
        let turned = tiles.rearranged(&[None, None, Some((2, 3)), None, None, None]);
        assert_eq!(turned.fit(2, &tiles, 2, 3, Tolerance::DRAWN).square, 0.0);
        assert!(turned.fit(2, &tiles, 2, 0, Tolerance::DRAWN).beyond > 0.2);
    }

    #[test]
    fn reduced_pictures_keep_their_mean() {
        let tiles = numbered();
        let small = tiles.reduced(2);
        assert_eq!(small.faces[5][0], [5.0, 0.5, 0.5]);
        assert_eq!(tiles.reduced(3).side, 3);
        assert!(small.sharpness() > 0.0);
    }
}
