//! A pinhole camera and shapes that rays meet, for the pictures.

use glam::{DVec2, DVec3};

/// A ray in world space.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// The origin.
    pub origin: DVec3,
    /// The direction, unit.
    pub direction: DVec3,
}

impl Ray {
    /// The point at a distance.
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }

    /// The distance to the plane through `point` across `normal`, if it lies ahead.
    pub fn plane(&self, point: DVec3, normal: DVec3) -> Option<f64> {
        let distance = (point - self.origin).dot(normal) / self.direction.dot(normal);
        (distance.is_finite() && distance > 1e-9).then_some(distance)
    }

    /// The distances at which the line of the ray enters and leaves a sphere.
    pub fn sphere(&self, center: DVec3, radius: f64) -> Option<[f64; 2]> {
        let to_center = center - self.origin;
        let along = to_center.dot(self.direction);
        let square = radius * radius - (to_center - along * self.direction).length_squared();
        (square >= 0.0).then(|| [along - square.sqrt(), along + square.sqrt()])
    }
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole {
    eye: DVec3,
    /// Along the picture's x and y, per unit of the image plane; and forward, unit.
    axes: [DVec3; 3],
}

impl Pinhole {
    /// A camera at `eye` that looks at `target`, with y up and a vertical field of view.
    pub fn new(eye: DVec3, target: DVec3, field_of_view_deg: f64) -> Self {
        let forward = (target - eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let half = (0.5 * field_of_view_deg.to_radians()).tan();
        Self { eye, axes: [right * half, up * half, forward] }
    }

    /// The ray through a point of the image plane.
    pub fn ray(&self, at: DVec2) -> Ray {
        let [right, up, forward] = self.axes;
        Ray { origin: self.eye, direction: (forward + right * at.x + up * at.y).normalize() }
    }
}
