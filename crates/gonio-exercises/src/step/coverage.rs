//! Determines which triangle each pixel of a picture shows, as OpenGL does: perspective, clipping and the depth test.

use gonio_interpreter::Fragment;

/// A triangle after the vertex shader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triangle {
    pub object: usize,
    /// Its vertices in the object's mesh.
    pub corners: [u32; 3],
    /// `gl_Position` of each.
    pub clip: [[f32; 4]; 3],
}

/// A place on a triangle's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Barycentric coordinates in space; their sum is 1.
    pub shares: [f64; 3],
    /// -1 (near) to 1 (far).
    pub depth: f64,
    /// The fourth component of the interpolated `gl_Position`.
    pub w: f64,
}

/// A triangle's plane in homogeneous coordinates (Olano and Greer 1997, *Triangle Scan Conversion using 2D Homogeneous
/// Coordinates*): no triangle has to be clipped.
pub(super) struct Plane {
    /// The inverse of the matrix with the columns (x, y, w) of the corners.
    inverse: [[f64; 3]; 3],
    depths: [f64; 3],
    /// Whether its corners are counter-clockwise in the picture.
    pub is_front: bool,
}

/// Depths this far outside of -1 to 1 are rounding errors: a sky is drawn exactly on the farthest plane.
const DEPTH_TOLERANCE: f64 = 1e-6;

impl Plane {
    /// Returns nothing for a triangle without area in the picture.
    pub fn new(clip: &[[f32; 4]; 3]) -> Option<Self> {
        let [a, b, c] = clip.map(|[x, y, _, w]| [f64::from(x), f64::from(y), f64::from(w)]);
        let cross = |p: [f64; 3], q: [f64; 3]| {
            [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        };
        let rows = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = a[0] * rows[0][0] + a[1] * rows[0][1] + a[2] * rows[0][2];
        if !determinant.is_finite() || determinant == 0.0 {
            return None;
        }
        Some(Self {
            inverse: rows.map(|row| row.map(|x| x / determinant)),
            depths: clip.map(|corner| f64::from(corner[2])),
            is_front: determinant > 0.0,
        })
    }

    /// The triangle's plane behind a place of the picture, in normalized device coordinates.
    pub fn at(&self, ndc: [f64; 2]) -> Place {
        let over_w = self.inverse.map(|row| row[0] * ndc[0] + row[1] * ndc[1] + row[2]);
        let sum: f64 = over_w.iter().sum();
        let depth = (0..3).map(|corner| over_w[corner] * self.depths[corner]).sum();
        Place { shares: over_w.map(|x| x / sum), depth, w: 1.0 / sum }
    }

    /// The same within the triangle and between the near and the far plane.
    pub fn covered(&self, ndc: [f64; 2]) -> Option<Place> {
        let inside = self.inverse.iter().all(|row| row[0] * ndc[0] + row[1] * ndc[1] + row[2] >= 0.0);
        inside.then(|| self.at(ndc)).filter(|place| place.depth.abs() <= 1.0 + DEPTH_TOLERANCE)
    }
}

/// The triangle at each pixel of a picture, the top row first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Coverage {
    /// Width and height in pixels.
    pub size: [u32; 2],
    pub triangles: Vec<Triangle>,
    pixels: Vec<u32>,
}

const NOTHING: u32 = u32::MAX;

impl Coverage {
    pub fn new(size: [u32; 2], triangles: Vec<Triangle>) -> Self {
        let width = size[0] as usize;
        let count = width * size[1] as usize;
        let (mut pixels, mut depths) = (vec![NOTHING; count], vec![f32::INFINITY; count]);
        for (number, triangle) in triangles.iter().enumerate() {
            let Some(plane) = Plane::new(&triangle.clip) else { continue };
            let [columns, rows] = bounds(&triangle.clip, size);
            for y in rows {
                for x in columns.clone() {
                    let at = y as usize * width + x as usize;
                    // As in OpenGL's test "less or equal".
                    if let Some(place) = plane.covered(ndc([x, y], size))
                        && place.depth as f32 <= depths[at]
                    {
                        (depths[at], pixels[at]) = (place.depth as f32, number as u32);
                    }
                }
            }
        }
        Self { size, triangles, pixels }
    }

    /// The triangle at a pixel.
    pub fn at(&self, [x, y]: [u32; 2]) -> Option<&Triangle> {
        let number = self.number([x, y])?;
        self.triangles.get(number)
    }

    pub fn number(&self, [x, y]: [u32; 2]) -> Option<usize> {
        let [width, height] = self.size;
        let at = (x < width && y < height).then_some(y as usize * width as usize + x as usize)?;
        self.pixels.get(at).filter(|number| **number != NOTHING).map(|number| *number as usize)
    }

    /// The covered pixels, row by row.
    pub fn covered(&self) -> impl Iterator<Item = [u32; 2]> {
        let width = self.size[0] as usize;
        let place = move |at: usize| [(at % width) as u32, (at / width) as u32];
        self.pixels.iter().enumerate().filter(|(_, number)| **number != NOTHING).map(move |(at, _)| place(at))
    }
}

/// The middle of a pixel in normalized device coordinates; y of the pixel is downwards.
pub(super) fn ndc([x, y]: [u32; 2], size: [u32; 2]) -> [f64; 2] {
    let [right, down] = ndc_from_bottom([x, y], size);
    [right, -down]
}

/// The columns and rows that a triangle may cover.
pub(super) fn bounds(clip: &[[f32; 4]; 3], size: [u32; 2]) -> [std::ops::Range<u32>; 2] {
    if clip.iter().any(|corner| corner[3] <= 0.0) {
        return size.map(|side| 0..side);
    }
    [(0, 1.0), (1, -1.0)].map(|(axis, sign)| {
        let size = size[axis];
        let places = clip.map(|c| (sign * f64::from(c[axis]) / f64::from(c[3]) * 0.5 + 0.5) * f64::from(size));
        let least = places.iter().copied().fold(f64::INFINITY, f64::min).floor().max(0.0) as u32;
        let greatest = places.iter().copied().fold(f64::NEG_INFINITY, f64::max).ceil().max(0.0) as u32;
        least.min(size)..greatest.min(size)
    })
}

/// A point of a triangle's plane that the fragment shader runs at.
pub(super) struct SurfacePoint<'a> {
    pub triangle: &'a Triangle,
    /// Whether the triangle's corners are counter-clockwise in the picture.
    pub is_front: bool,
    /// Column and row from the bottom left.
    pub pixel: [u32; 2],
    pub place: Place,
}

/// The middle of a pixel in normalized device coordinates; its row is counted from the bottom.
pub(super) fn ndc_from_bottom([x, row]: [u32; 2], size: [u32; 2]) -> [f64; 2] {
    let along = |i: u32, side: u32| (f64::from(i) + 0.5) / f64::from(side) * 2.0 - 1.0;
    [along(x, size[0]), along(row, size[1])]
}

/// The four pixels of the quad around a pixel, column and row from the bottom left; a row beyond the picture is only a helper
/// for derivatives.
pub(super) fn quad_of([x, row]: [u32; 2]) -> [[u32; 2]; 4] {
    [0, 1, 2, 3].map(|at| [(x & !1) + at % 2, (row & !1) + at / 2])
}

/// A place on a triangle for the interpolation of varyings.
pub(super) fn fragment_at(triangle: &Triangle, place: &Place) -> Fragment {
    let on_screen: [f64; 3] = std::array::from_fn(|i| place.shares[i] * f64::from(triangle.clip[i][3]));
    let sum: f64 = on_screen.iter().sum();
    Fragment {
        corners: triangle.corners,
        screen: on_screen.map(|weight| (weight / sum) as f32),
        weights: place.shares.map(|share| share as f32),
    }
}

/// The point of a pixel among the four of its quad, in a picture of this height.
pub(super) fn lane_in_quad([x, y]: [u32; 2], height: u32) -> usize {
    ((x & 1) + 2 * ((height - 1 - y) & 1)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(object: usize, clip: [[f32; 4]; 3]) -> Triangle {
        Triangle { object, corners: [0, 1, 2], clip }
    }

    #[test]
    fn the_nearer_triangle_is_visible_and_the_later_one_of_two_at_the_same_depth() {
        let whole = |object, z: f32| triangle(object, [[-3.0, -1.0, z, 1.0], [3.0, -1.0, z, 1.0], [0.0, 4.0, z, 1.0]]);
        let at = |triangles: Vec<Triangle>| Coverage::new([5; 2], triangles).at([2, 2]).map(|found| found.object);
        assert_eq!(at(vec![whole(1, 0.5), whole(2, 0.2), whole(3, 0.4)]), Some(2));
        assert_eq!(at(vec![whole(1, 0.5), whole(2, 0.5)]), Some(2));
        // The farthest plane is visible, and what is beyond it is not.
        assert_eq!(at(vec![whole(1, 1.0)]), Some(1));
        assert_eq!(at(vec![whole(1, 1.01)]), None);
        assert_eq!(at(vec![whole(1, -1.01)]), None);
    }

    #[test]
    fn a_triangle_covers_pixels_whose_middle_it_contains_also_if_it_reaches_behind_the_eye() {
        // The lower left half of four pixels by four.
        let half = [[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [-1.0, 0.99, 0.0, 1.0]];
        let covered: Vec<_> = Coverage::new([4; 2], vec![triangle(0, half)]).covered().collect();
        assert_eq!(covered, [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]]);
        // A floor that begins behind the eye and ends at a tenth of the way to the horizon.
        let floor = [[-90.0, -1.0, 0.0, 10.0], [90.0, -1.0, 0.0, 10.0], [0.0, -1.0, 0.0, -1.0]];
        let covered = Coverage::new([4; 2], vec![triangle(0, floor)]);
        assert!(covered.covered().eq((0..8).map(|i| [i % 4, 2 + i / 4])));
    }

    #[test]
    fn shares_are_linear_in_space() {
        // Between a corner at distance 1 and one at distance 3, the middle of the picture shows a quarter of the way.
        let plane = Plane::new(&[[-1.0, 0.0, 0.0, 1.0], [3.0, 0.0, 0.0, 3.0], [0.0, 1.0, 0.0, 1.0]]).unwrap();
        let place = plane.at([0.0, 0.0]);
        assert!((place.shares[0] - 0.75).abs() < 1e-12 && (place.shares[1] - 0.25).abs() < 1e-12);
        assert!((place.w - 1.5).abs() < 1e-12 && plane.is_front);
    }
}
