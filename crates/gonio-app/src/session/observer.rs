//! The observer: a second camera that shows the first one.

/// The second camera.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observer {
    /// Whether it is shown.
    pub open: bool,
    /// Whether it rotates automatically.
    pub turning: bool,
    /// Azimuth and elevation, radians. `None` until it is opened.
    pub(crate) angles: Option<(f64, f64)>,
}

impl Observer {
    /// Shows or hides it, and resets its position.
    pub fn toggle(&mut self) {
        *self = Observer { open: !self.open, ..Observer::default() };
    }
}
