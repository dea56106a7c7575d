//! The six faces of a cubemap, the direction of each point on them, and the solid angle of each texel.
//!
//! The world is right-handed, Y is up. Directions need not be of unit length.

use glam::DVec3;
use gonio_light::named_enum;
use gonio_threads::prelude::*;

/// A face, named after the axis through its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Face {
    /// `posx`
    PosX,
    /// `negx`
    NegX,
    /// `posy`
    PosY,
    /// `negy`
    NegY,
    /// `posz`
    PosZ,
    /// `negz`
    NegZ,
}

named_enum! {
    /// The orientation of six pictures on the faces of a cube.
    pub enum Layout {
        /// The layout that OpenGL samples: `texture(samplerCube, direction_in_world)` is right. The faces are left-handed
        /// (OpenGL 4.6, table 8.19), so that a viewer of images shows each as the mirror image of what is seen.
        OpenGl = "opengl",
        /// The layout of most published faces, which look right in an image viewer: sampled at (x, y, -z). `posx` is
        /// to the right (+X), `posz` straight ahead (-Z).
        Photographic = "photographic",
    }
    default OpenGl;
    what "layout of faces";
}

impl Face {
    /// All faces in the order of OpenGL's and KTX2's layers.
    pub const ALL: [Face; 6] = [Face::PosX, Face::NegX, Face::PosY, Face::NegY, Face::PosZ, Face::NegZ];

    /// Returns the name of the face: `posx` and so on.
    pub fn name(self) -> &'static str {
        ["posx", "negx", "posy", "negy", "posz", "negz"][self as usize]
    }

    /// The middle of the face in OpenGL's table, and the directions of `s` (columns, to the right) and `t` (rows,
    /// downwards).
    fn axes(self) -> [DVec3; 3] {
        const X: DVec3 = DVec3::X;
        const Y: DVec3 = DVec3::Y;
        const Z: DVec3 = DVec3::Z;
        match self {
            Face::PosX => [X, -Z, -Y],
            Face::NegX => [-X, Z, -Y],
            Face::PosY => [Y, X, Z],
            Face::NegY => [-Y, X, -Z],
            Face::PosZ => [Z, X, -Y],
            Face::NegZ => [-Z, -X, -Y],
        }
    }

    /// The direction of columns in OpenGL's layout.
    pub(crate) fn along_s(self) -> DVec3 {
        self.axes()[1]
    }

    /// The direction of rows in OpenGL's layout.
    pub(crate) fn along_t(self) -> DVec3 {
        self.axes()[2]
    }

    /// Returns the position of this face's picture of a layout in OpenGL's layout: the face, and whether columns and
    /// rows are reversed. The mapping is its own inverse.
    pub fn in_open_gl(self, layout: Layout) -> (Face, bool, bool) {
        match (layout, self) {
            (Layout::OpenGl, _) => (self, false, false),
            (Layout::Photographic, Face::PosX | Face::NegX) => (self, true, false),
            (Layout::Photographic, Face::PosY | Face::NegY) => (self, false, true),
            (Layout::Photographic, Face::PosZ) => (Face::NegZ, true, false),
            (Layout::Photographic, Face::NegZ) => (Face::PosZ, true, false),
        }
    }

    /// Returns the direction of a point of a face: `s` and `t` from -1 to 1, from the first column to the last and from
    /// the first row to the last. Its largest component is 1.
    pub fn direction(self, s: f64, t: f64, layout: Layout) -> DVec3 {
        let [middle, along_s, along_t] = self.axes();
        layout.turn(middle + s * along_s + t * along_t)
    }

    /// Returns the face that a direction meets, and the point on it: the inverse of [`Self::direction`]. Where two
    /// faces meet, the earlier one of X, Y, Z counts. `None` for a direction of no length.
    pub fn from_direction(direction: DVec3, layout: Layout) -> Option<(Face, f64, f64)> {
        let d = layout.turn(direction);
        let size = d.abs();
        let largest = size.max_element();
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        let face = if size.x == largest {
            if d.x > 0.0 { Face::PosX } else { Face::NegX }
        } else if size.y == largest {
            if d.y > 0.0 { Face::PosY } else { Face::NegY }
        } else if d.z > 0.0 {
            Face::PosZ
        } else {
            Face::NegZ
        };
        let [_, along_s, along_t] = face.axes();
        Some((face, d.dot(along_s) / largest, d.dot(along_t) / largest))
    }
}

impl Layout {
    /// Converts a direction between the world and OpenGL's table: it is its own inverse.
    fn turn(self, d: DVec3) -> DVec3 {
        match self {
            Layout::OpenGl => d,
            Layout::Photographic => DVec3::new(d.x, d.y, -d.z),
        }
    }
}

/// The solid angle in steradians that a texel covers, seen from the cube's middle; all of a cubemap are `4 pi`.
pub fn solid_angle(x: u32, y: u32, size: u32) -> f64 {
    // Of the rectangle from the face's middle to (s, t): its corners' areas are added and subtracted.
    let corner = |s: f64, t: f64| (s * t).atan2((s * s + t * t + 1.0).sqrt());
    let edge = |v: u32| 2.0 * f64::from(v) / f64::from(size) - 1.0;
    let (s0, s1, t0, t1) = (edge(x), edge(x + 1), edge(y), edge(y + 1));
    corner(s0, t0) - corner(s0, t1) - corner(s1, t0) + corner(s1, t1)
}

/// [`solid_angle`] of every texel of a face, in steradians: a quarter of them, of which the others are mirror images.
///
/// An arc tangent per texel is expensive; a table of a quarter of one face serves all six.
#[derive(Clone, Debug)]
pub(crate) struct SolidAngles {
    size: usize,
    /// Columns (and rows) of the quarter: half of the size, rounded up.
    half: usize,
    /// `half * half`, rows from the top.
    quarter: Vec<f64>,
}

impl SolidAngles {
    /// Computes the table for faces of `size` texels an edge.
    pub fn new(size: u32) -> Self {
        let half = size.div_ceil(2);
        let row = |y: u32| (0..half).map(move |x| solid_angle(x, y, size));
        let quarter = (0..half).into_par_iter().flat_map_iter(row).collect();
        SolidAngles { size: size as usize, half: half as usize, quarter }
    }

    /// Returns the solid angles of row `y`, from the left.
    pub fn row(&self, y: usize) -> impl Iterator<Item = f64> + Clone + '_ {
        let held = y.min(self.size - 1 - y);
        let left = &self.quarter[held * self.half..][..self.half];
        left.iter().chain(left[..self.size - self.half].iter().rev()).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The project's definition of each face.
    #[test]
    fn the_layouts_are_as_defined() {
        let gl = |face: Face, s, t| face.direction(s, t, Layout::OpenGl);
        let photo = |face: Face, s, t| face.direction(s, t, Layout::Photographic);
        // "Face +X has s running towards -Z and t (rows downwards) towards -Y."
        assert_eq!(gl(Face::PosX, 1.0, 0.0), DVec3::new(1.0, 0.0, -1.0));
        assert_eq!(gl(Face::PosX, 0.0, 1.0), DVec3::new(1.0, -1.0, 0.0));
        // "posx stays at +X, posz is straight ahead (-Z), nothing is mirrored."
        assert_eq!(photo(Face::PosX, 0.0, 0.0), DVec3::X);
        assert_eq!(photo(Face::PosZ, 0.0, 0.0), -DVec3::Z);
        // Looking along -Z with Y up, +X is to the right, and on the face to the right -Z is to the left.
        assert_eq!(photo(Face::PosZ, 1.0, 0.0), DVec3::new(1.0, 0.0, -1.0));
        assert_eq!(photo(Face::PosX, -1.0, 0.0), DVec3::new(1.0, 0.0, -1.0));
        for face in Face::ALL {
            let handed = |layout| {
                let d = |s, t| face.direction(s, t, layout);
                let (middle, s, t) = (d(0.0, 0.0), d(1.0, 0.0) - d(0.0, 0.0), d(0.0, 1.0) - d(0.0, 0.0));
                // Columns to the right, rows down: seen from inside, an image that is not mirrored.
                s.cross(t).dot(middle)
            };
            assert_eq!((handed(Layout::OpenGl), handed(Layout::Photographic)), (-1.0, 1.0), "{face:?}");
        }
    }

    #[test]
    fn directions_and_points_are_inverses() {
        for layout in [Layout::OpenGl, Layout::Photographic] {
            for face in Face::ALL {
                for (s, t) in [(0.0, 0.0), (0.5, -0.25), (-0.9, 0.7), (0.99, 0.99)] {
                    let found = Face::from_direction(3.0 * face.direction(s, t, layout), layout);
                    let (same, there_s, there_t) = found.unwrap_or((Face::PosX, 9.0, 9.0));
                    assert_eq!(same, face);
                    assert!((there_s - s).abs() < 1e-15 && (there_t - t).abs() < 1e-15, "{face:?} {s} {t}");
                }
            }
            assert_eq!(Face::from_direction(DVec3::ZERO, layout), None);
            assert_eq!(Face::from_direction(DVec3::NAN, layout), None);
        }
    }

    #[test]
    fn the_other_layout_is_the_same_pictures_elsewhere() {
        for face in Face::ALL {
            let (other, flips_s, flips_t) = face.in_open_gl(Layout::Photographic);
            assert_eq!(other.in_open_gl(Layout::Photographic), (face, flips_s, flips_t));
            for (s, t) in [(0.3, -0.6), (-0.8, 0.1)] {
                let there =
                    other.direction(if flips_s { -s } else { s }, if flips_t { -t } else { t }, Layout::Photographic);
                assert_eq!(face.direction(s, t, Layout::OpenGl), there, "{face:?}");
            }
        }
    }

    #[test]
    fn every_texel_has_its_own() {
        for size in [1, 2, 5, 8] {
            let table = SolidAngles::new(size);
            for y in 0..size {
                let row: Vec<f64> = table.row(y as usize).collect();
                assert_eq!(row.len(), size as usize);
                for (x, got) in row.into_iter().enumerate() {
                    // The mirror image rounds differently in the last place.
                    assert!((got - solid_angle(x as u32, y, size)).abs() < 1e-15, "{size}: {x} {y}");
                }
            }
        }
    }
}
