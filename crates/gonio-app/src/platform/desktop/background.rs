//! Work in a thread, with a result that is polled.

use crate::platform::Pending;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Work that runs in a thread. It is asked to stop when this is dropped.
pub struct Background<T> {
    results: Receiver<T>,
    stop: Arc<AtomicBool>,
    /// The result if the thread ends without one; `None` once there is a result.
    lost: Option<T>,
}

impl<T: Send + 'static> Background<T> {
    /// Starts `work`, which is given a function that tells whether to stop, and calls `done` when there is a result. `lost` is
    /// the result if the thread ends without one.
    pub fn start(
        work: impl FnOnce(&dyn Fn() -> bool) -> T + Send + 'static,
        done: impl FnOnce() + Send + 'static,
        lost: T,
    ) -> Self {
        let (sender, results) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let is_stopped = stop.clone();
        std::thread::spawn(move || {
            let result = work(&|| is_stopped.load(Ordering::Relaxed));
            // The receiver is gone if the work was stopped.
            let _ = sender.send(result);
            done();
        });
        Background { results, stop, lost: Some(lost) }
    }
}

impl<T> Pending<T> for Background<T> {
    fn poll(&mut self) -> Option<T> {
        self.lost.as_ref()?;
        match self.results.try_recv() {
            Ok(result) => {
                self.lost = None;
                Some(result)
            }
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => self.lost.take(),
        }
    }
}

impl<T> Drop for Background<T> {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<T>(mut pending: impl Pending<T>) -> T {
        loop {
            if let Some(result) = pending.poll() {
                assert!(pending.poll().is_none(), "there is one result");
                return result;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_result_comes_once_and_a_lost_one_is_replaced() {
        assert_eq!(wait(Background::start(|_| 1, || (), 2)), 1);
        let (sender, results) = channel();
        drop(sender);
        assert_eq!(wait(Background { results, stop: Arc::default(), lost: Some(2) }), 2);
    }

    #[test]
    fn work_is_asked_to_stop_when_it_is_dropped() {
        let (sender, ended) = channel();
        let work = Background::start(
            move |is_stopped| {
                while !is_stopped() {
                    std::thread::yield_now();
                }
                let _ = sender.send(());
            },
            || (),
            (),
        );
        drop(work);
        assert_eq!(ended.recv(), Ok(()));
    }
}
