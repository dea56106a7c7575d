//! Projection from world to window, and back.

use egui::{Pos2, Rect, pos2};
use glam::{DMat4, DVec3};
use gonio_scene::Camera;

/// Maps points of the world to a pane.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    camera: Camera,
    clip_from_world: DMat4,
    rect: Rect,
}

impl Projection {
    /// The projection of a camera whose picture fills `rect` (points of the window).
    pub fn new(camera: &Camera, rect: Rect) -> Self {
        let aspect = f64::from(rect.width().max(1.0)) / f64::from(rect.height().max(1.0));
        let clip_from_world = camera.clip_from_view(aspect) * camera.view_from_world();
        Projection { camera: *camera, clip_from_world, rect }
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The pane, points of the window.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// The window position of a point of the world; `None` behind the eye.
    pub fn to_window(&self, point: DVec3) -> Option<Pos2> {
        let clip = self.clip_from_world * point.extend(1.0);
        if clip.w <= 1e-9 {
            return None;
        }
        let (x, y) = (clip.x / clip.w, clip.y / clip.w);
        let center = self.rect.center();
        Some(pos2(center.x + 0.5 * self.rect.width() * x as f32, center.y - 0.5 * self.rect.height() * y as f32))
    }

    /// The unit direction from the eye through a place of the window, world space.
    pub fn direction(&self, place: Pos2) -> DVec3 {
        let local = place - self.rect.min;
        let (width, height) = (f64::from(self.rect.width().max(1.0)), f64::from(self.rect.height().max(1.0)));
        let tan = (0.5 * self.camera.fov_y_rad).tan();
        let x = (2.0 * f64::from(local.x) / width - 1.0) * tan * width / height;
        let y = (1.0 - 2.0 * f64::from(local.y) / height) * tan;
        (self.camera.front + x * self.camera.right + y * self.camera.up).normalize()
    }

    /// World units that one point of the window covers at `point`.
    pub fn units_per_point(&self, point: DVec3) -> f64 {
        let depth = self.camera.depth_of(point).max(self.camera.near);
        2.0 * depth * (0.5 * self.camera.fov_y_rad).tan() / f64::from(self.rect.height().max(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A projected point is on the ray through its place.
    #[test]
    fn projection_and_rays_agree() {
        let camera =
            Camera::looking_along(DVec3::new(3.0, 2.0, 5.0), DVec3::new(-0.5, -0.3, -1.0), DVec3::Y, 0.7, 0.1, 100.0);
        let projection = Projection::new(&camera, Rect::from_min_max(pos2(40.0, 30.0), pos2(680.0, 430.0)));
        for point in [DVec3::ZERO, DVec3::new(0.4, -0.3, 1.0), DVec3::new(-1.0, 0.5, -2.0)] {
            let place = projection.to_window(point).unwrap_or_else(|| panic!("{point} is in front of the eye"));
            let along = (point - camera.position).normalize();
            // Places are f32.
            assert!((projection.direction(place) - along).length() < 1e-5, "{point}");
        }
        assert_eq!(projection.to_window(camera.position - camera.front), None);
    }
}
