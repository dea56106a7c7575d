//! The scene's time.

/// The animation's time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Seconds of the scene.
    pub time: f64,
    /// Whether it runs.
    pub playing: bool,
}

impl Clock {
    /// Lets `seconds` pass. A long pause (a hidden window, a slow frame) counts as a tenth of a second.
    pub fn advance(&mut self, seconds: f64) {
        if self.playing && seconds.is_finite() {
            self.time += seconds.clamp(0.0, 0.1);
        }
    }
}
