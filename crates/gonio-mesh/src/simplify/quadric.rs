//! Sums of squared distances from planes.

use glam::{DMat3, DVec3};
use std::ops::Add;

/// The sum of weighted squared distances of a point p from planes: `p^T A p + 2 b.p + c` (Garland and Heckbert 1997,
/// section 4).
#[derive(Clone, Copy, Debug, Default)]
pub struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// Creates the quadric of the plane through `point` with the unit normal `normal`.
    pub fn of_plane(normal: DVec3, point: DVec3, weight: f64) -> Self {
        let d = -normal.dot(point);
        let a = DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        Quadric { a: a * weight, b: normal * (d * weight), c: d * d * weight }
    }

    /// Returns the weighted sum of squares at a point; not below 0 in spite of rounding.
    pub fn error_at(&self, p: DVec3) -> f64 {
        (p.dot(self.a * p) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }
}

impl Add for Quadric {
    type Output = Quadric;
    fn add(self, other: Quadric) -> Quadric {
        Quadric { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c }
    }
}
