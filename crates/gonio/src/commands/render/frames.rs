//! The moments of an animation: time passes, the camera may go around.

use glam::{DQuat, DVec3};
use gonio_scene::{Camera, Frame, LoadedScene};

/// The frames of one run.
pub struct Frames<'a> {
    scene: &'a LoadedScene,
    start: f64,
    fps: f64,
    /// Radians from one frame to the next.
    step: f64,
    center: DVec3,
    axis: DVec3,
}

impl<'a> Frames<'a> {
    /// `count` frames from `start` seconds on; `orbit` degrees in all.
    pub fn new(scene: &'a LoadedScene, start: f64, count: u32, fps: f64, orbit: Option<f64>) -> Self {
        let degrees = orbit.unwrap_or(0.0);
        // Whole turns loop: the last frame stands one step before the first. A part of a turn is seen
        // from end to end.
        let steps = if degrees % 360.0 == 0.0 { count } else { count.saturating_sub(1).max(1) };
        let spec = &scene.scene.camera;
        let up = spec.up.map_or(DVec3::Y, DVec3::from_array);
        let first = scene.frame(start);
        Frames {
            scene,
            start,
            fps,
            step: degrees.to_radians() / f64::from(steps),
            center: orbit_center(&first, spec.target),
            axis: up.try_normalize().unwrap_or(DVec3::Y),
        }
    }

    /// Frame `index`, from 0.
    pub fn at(&self, index: u32) -> Frame {
        let mut frame = self.scene.frame(self.start + f64::from(index) / self.fps);
        let angle = self.step * f64::from(index);
        if angle != 0.0 {
            frame.camera = turned(&frame.camera, self.center, self.axis, angle);
        }
        frame
    }
}

/// What the camera goes around: its target; else the point on its axis nearest to the scene's middle.
fn orbit_center(frame: &Frame, target: Option<[f64; 3]>) -> DVec3 {
    let camera = &frame.camera;
    target.map(DVec3::from_array).unwrap_or_else(|| {
        let middle = 0.5 * (frame.bounds_min + frame.bounds_max);
        camera.position + camera.front * camera.depth_of(middle).max(0.0)
    })
}

fn turned(camera: &Camera, center: DVec3, axis: DVec3, angle: f64) -> Camera {
    let turn = DQuat::from_axis_angle(axis, angle);
    Camera {
        position: center + turn * (camera.position - center),
        front: turn * camera.front,
        up: turn * camera.up,
        right: turn * camera.right,
        ..*camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_keeps_the_distance_and_the_direction_to_the_center() {
        let camera =
            Camera::looking_along(DVec3::new(0.0, 1.0, 5.0), DVec3::new(0.0, -0.2, -1.0), DVec3::Y, 0.7, 0.1, 9.0);
        let center = DVec3::new(0.0, 0.0, 0.0);
        let quarter = turned(&camera, center, DVec3::Y, std::f64::consts::FRAC_PI_2);
        // A right-handed quarter turn about +Y takes +Z to +X. 1e-12: rounding of f64.
        assert!((quarter.position - DVec3::new(5.0, 1.0, 0.0)).length() < 1e-12);
        let seen = |c: &Camera| {
            let v = center - c.position;
            DVec3::new(v.dot(c.right), v.dot(c.up), v.dot(c.front))
        };
        assert!((seen(&quarter) - seen(&camera)).length() < 1e-12);
    }
}
