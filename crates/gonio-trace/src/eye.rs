//! The camera in trace space, prepared once for all rays.

use crate::geometry::Space;
use crate::tree::Ray;
use glam::DVec3;
use gonio_scene::Frame;

/// The rays of a pinhole camera. In f64, because the eye may be far from a near plane that is close to the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Eye {
    position: DVec3,
    front: DVec3,
    /// From the middle of the picture plane, at distance 1, to its right and its upper edge.
    right: DVec3,
    up: DVec3,
    /// Picture widths and heights per pixel, times two.
    step: [f64; 2],
    /// Distances of the planes along the viewing direction, in trace space.
    near: f64,
    far: f64,
}

impl Eye {
    pub fn new(frame: &Frame, space: &Space) -> Self {
        let Frame { camera, width, height, .. } = frame;
        let tan = (0.5 * camera.fov_y_rad).tan();
        let (width, height) = (f64::from(*width), f64::from(*height));
        Eye {
            position: (camera.position - space.center) * space.scale,
            front: camera.front,
            right: camera.right * (tan * width / height),
            up: camera.up * tan,
            step: [2.0 / width, 2.0 / height],
            near: camera.near * space.scale,
            far: camera.far * space.scale,
        }
    }

    /// The ray through a point of the picture, pixels, from the near plane to the far plane.
    #[inline]
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let (x, y) = (x * self.step[0] - 1.0, 1.0 - y * self.step[1]);
        // To the plane at distance 1 along the viewing direction.
        let way = self.front + x * self.right + y * self.up;
        let origin = (self.position + way * self.near).as_vec3();
        let reach = (self.far - self.near) as f32;
        let way = way.as_vec3();
        let length = way.length();
        Ray { origin, direction: way / length, reach: reach * length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::{Camera, Scene};

    /// The camera's own rays, seen from 100,000 times the size of the scene.
    #[test]
    fn rays_are_those_of_the_camera() {
        let space = Space { center: DVec3::new(3.0, -2.0, 5.0), scale: 0.5 };
        let away = DVec3::new(1.0, 2.0, -2.0) / 3.0;
        let (near, far) = (2e5 - 3.0, 2e5 + 3.0);
        let mut frame = Scene::default().frame(0.0);
        frame.camera = Camera::looking_along(space.center + 2e5 * away, -away, DVec3::Y, 1e-5, near, far);
        (frame.width, frame.height) = (640, 480);
        let eye = Eye::new(&frame, &space);
        for (x, y) in [(0.0, 0.0), (639.7, 0.3), (320.0, 240.0), (17.25, 400.5)] {
            let direction = frame.camera.ray_direction(x, y, frame.width, frame.height);
            let per_depth = 1.0 / direction.dot(frame.camera.front);
            let origin = space.point(frame.camera.position + direction * (near * per_depth));
            let ray = eye.ray(x, y);
            assert!(ray.origin.abs_diff_eq(origin, 1e-6), "{x}, {y}: {} instead of {origin}", ray.origin);
            assert!(ray.direction.abs_diff_eq(direction.as_vec3(), 2e-7), "{x}, {y}: {}", ray.direction);
            let reach = ((far - near) * per_depth * space.scale) as f32;
            assert!((ray.reach - reach).abs() < 1e-6, "{x}, {y}: {} instead of {reach}", ray.reach);
        }
    }
}
