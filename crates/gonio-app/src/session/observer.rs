//! The observer: a second camera that shows the first one from outside.

/// The second eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observer {
    /// Whether it is shown.
    pub open: bool,
    /// Whether it goes around by itself.
    pub turning: bool,
    /// Where it stands: around the vertical and above the ground, radians. None until it is opened.
    pub(crate) angles: Option<(f64, f64)>,
}

impl Observer {
    /// Shows or hides it. It stands beside the first camera again.
    pub fn toggle(&mut self) {
        *self = Observer { open: !self.open, ..Observer::default() };
    }
}
