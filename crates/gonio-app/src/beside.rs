//! Work in steps beside the interface: in a thread of the desktop, a step in each frame on the page, which has one thread.

use crate::platform::Platform;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Work that is divided into steps, each as short as the work allows.
pub trait Steps: Send + 'static {
    /// The result.
    type Output: Send + 'static;
    /// Does the next step. Returns the result after the last one; it is not called again then.
    fn step(&mut self) -> Option<Self::Output>;
}

/// Work that goes on. Dropping it ends the work after the step at hand.
pub struct Beside<W: Steps> {
    place: Place<W>,
}

enum Place<W: Steps> {
    Thread {
        receiver: Receiver<W::Output>,
        /// The thread goes on while this exists.
        _wanted: Arc<()>,
    },
    Frames(Option<W>),
}

impl<W: Steps> Beside<W> {
    /// Starts the work; `ctx` is repainted when it has ended.
    pub fn start(platform: &mut dyn Platform, ctx: &egui::Context, work: W) -> Self {
        ctx.request_repaint();
        if cfg!(target_arch = "wasm32") {
            return Beside { place: Place::Frames(Some(work)) };
        }
        let (sender, receiver) = channel();
        let wanted = Arc::new(());
        let (still_wanted, ctx, mut work) = (Arc::downgrade(&wanted), ctx.clone(), work);
        platform.run(Box::new(move || {
            while still_wanted.strong_count() > 0 {
                if let Some(result) = work.step() {
                    // Nobody waits for it if the window is closed by now.
                    let _ = sender.send(result);
                    break;
                }
            }
            drop(sender);
            ctx.request_repaint();
        }));
        Beside { place: Place::Thread { receiver, _wanted: wanted } }
    }

    /// The result, once: `None` while the work goes on, `Some(None)` if it ended without one. Called in every frame.
    pub fn poll(&mut self, ctx: &egui::Context) -> Option<Option<W::Output>> {
        match &mut self.place {
            Place::Thread { receiver, .. } => match receiver.try_recv() {
                Ok(result) => Some(Some(result)),
                Err(TryRecvError::Empty) => None,
                Err(TryRecvError::Disconnected) => Some(None),
            },
            Place::Frames(work) => {
                let Some(at_work) = work else { return Some(None) };
                ctx.request_repaint();
                let result = at_work.step()?;
                *work = None;
                Some(Some(result))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts down.
    struct Countdown(u32);

    impl Steps for Countdown {
        type Output = &'static str;
        fn step(&mut self) -> Option<&'static str> {
            self.0 -= 1;
            (self.0 == 0).then_some("done")
        }
    }

    #[test]
    fn a_page_does_one_step_in_each_frame() {
        let ctx = egui::Context::default();
        let mut work = Beside { place: Place::Frames(Some(Countdown(3))) };
        assert_eq!([work.poll(&ctx), work.poll(&ctx)], [None, None]);
        assert_eq!(work.poll(&ctx), Some(Some("done")));
        assert_eq!(work.poll(&ctx), Some(None), "the result is given once");
    }
}
