//! The moments of an animation: time passes, the camera may go around.

use gonio_scene::{Frame, Scene};

/// The frames of one run.
pub struct Frames<'a> {
    scene: &'a Scene,
    start: f64,
    fps: f64,
    /// Radians from one frame to the next, where the camera goes around.
    step: Option<f64>,
}

impl<'a> Frames<'a> {
    /// `count` frames from `start` seconds on; `orbit` degrees in all.
    pub fn new(scene: &'a Scene, start: f64, count: u32, fps: f64, orbit: Option<f64>) -> Self {
        // Whole turns loop: the last frame stands one step before the first. A part of a turn is seen
        // from end to end.
        let steps = |degrees: f64| if degrees % 360.0 == 0.0 { count } else { count.saturating_sub(1).max(1) };
        let step = orbit.map(|degrees| degrees.to_radians() / f64::from(steps(degrees)));
        Frames { scene, start, fps, step }
    }

    /// Frame `index`, from 0.
    pub fn at(&self, index: u32) -> Frame {
        let frame = self.scene.frame(self.start + f64::from(index) / self.fps);
        match self.step {
            Some(step) => self.scene.orbit(&self.scene.orbit_start(&frame), step * f64::from(index)),
            None => frame,
        }
    }
}
