//! A pinhole camera and shapes that rays meet, for the pictures.

use glam::{DVec2, DVec3};

/// A ray in world space.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// The origin.
    pub origin: DVec3,
    /// The direction: unit where nothing else is stated. Distances are multiples of its length.
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

    /// The distance at which the ray enters a box with sides along the axes, and the normal there; none from inside.
    pub fn block(&self, low: DVec3, high: DVec3) -> Option<(f64, DVec3)> {
        let (a, b) = ((low - self.origin) / self.direction, (high - self.origin) / self.direction);
        let (near, far) = (a.min(b), a.max(b));
        let (enter, leave) = (near.max_element(), far.min_element());
        if !(enter < leave && enter > 0.0) {
            return None;
        }
        let axis = near.max_position();
        let mut normal = DVec3::ZERO;
        normal[axis] = -self.direction[axis].signum();
        Some((enter, normal))
    }

    /// The distances at which the line of the ray enters and leaves a vertical cylinder around `center` (x and z).
    pub fn cylinder(&self, center: DVec2, radius: f64) -> Option<[f64; 2]> {
        let [origin, direction] = [self.origin, self.direction].map(|v| DVec2::new(v.x, v.z));
        let to_center = center - origin;
        let (a, b) = (direction.length_squared(), to_center.dot(direction));
        let root = b * b - a * (to_center.length_squared() - radius * radius);
        (root > 0.0 && a > 1e-12).then(|| [(b - root.sqrt()) / a, (b + root.sqrt()) / a])
    }

    /// The distances at which the line of the ray, whose direction is unit, enters and leaves a sphere.
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
