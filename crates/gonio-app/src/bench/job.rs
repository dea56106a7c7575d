//! Work beside the interface, with its result in a later frame.

use crate::platform::Platform;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// A running piece of work. Dropping it forgets the result.
pub struct Job<T>(Receiver<T>);

impl<T: Send + 'static> Job<T> {
    /// Starts the work: in a thread, or at once on a page. The window is repainted when it ends.
    pub fn start(platform: &mut dyn Platform, ctx: &egui::Context, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        platform.run(Box::new(move || {
            // Nobody waits for it if the bench has moved on.
            let _ = sender.send(work());
            ctx.request_repaint();
        }));
        Job(receiver)
    }

    /// The result: `None` while the work goes on, `Some(None)` if it ended without one.
    pub fn poll(&self) -> Option<Option<T>> {
        match self.0.try_recv() {
            Ok(result) => Some(Some(result)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(None),
        }
    }
}
