//! The frames of an animation: lights move with time, the camera may orbit its target.

use gonio_scene::{Frame, Scene};

/// The frames of an animation.
pub struct Frames<'a> {
    scene: &'a Scene,
    start: f64,
    fps: f64,
    /// Radians from one frame to the next, if the camera orbits.
    step: Option<f64>,
}

impl<'a> Frames<'a> {
    /// `count` frames from `start` seconds on, over which the camera orbits by `orbit` degrees.
    pub fn new(scene: &'a Scene, start: f64, count: u32, fps: f64, orbit: Option<f64>) -> Self {
        // Whole turns loop: the last frame is one step before the first. Part of a turn is shown from end to end.
        let steps = |degrees: f64| if degrees % 360.0 == 0.0 { count } else { count.saturating_sub(1).max(1) };
        let step = orbit.map(|degrees| degrees.to_radians() / f64::from(steps(degrees)));
        Frames { scene, start, fps, step }
    }

    /// The frame with this index, from 0.
    pub fn at(&self, index: u32) -> Frame {
        let frame = self.scene.frame(self.start + f64::from(index) / self.fps);
        match self.step {
            Some(step) => self.scene.orbit(&self.scene.orbit_start(&frame), step * f64::from(index)),
            None => frame,
        }
    }
}
