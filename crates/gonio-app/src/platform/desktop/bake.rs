//! Bakes of the window: in a thread, with a pool of threads that leaves a core to the interface.

use crate::baking::{BakeReply, BakeRequest, BakeTask};
use gonio_bake::BakeJobError;
use gonio_language::tr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Least time between two replies about the progress.
const INTERVAL: Duration = Duration::from_millis(60);

/// A bake in a thread.
pub struct ThreadBake {
    replies: Receiver<BakeReply>,
    stop: Arc<AtomicBool>,
    has_ended: bool,
}

impl ThreadBake {
    /// Starts the thread; `ctx` is repainted with each reply.
    pub fn start(request: BakeRequest, ctx: &egui::Context) -> Self {
        let (sender, replies) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let (stopped, ctx) = (stop.clone(), ctx.clone());
        std::thread::spawn(move || {
            let work = || run(&request, &sender, &stopped, &ctx);
            match super::thread_pool() {
                Some(pool) => pool.install(work),
                None => work(),
            }
        });
        ThreadBake { replies, stop, has_ended: false }
    }
}

impl BakeTask for ThreadBake {
    fn poll(&mut self) -> Option<BakeReply> {
        match self.replies.try_recv() {
            Ok(reply) => {
                self.has_ended |= !matches!(reply, BakeReply::Progress(..));
                Some(reply)
            }
            Err(TryRecvError::Disconnected) if !self.has_ended => {
                self.has_ended = true;
                Some(BakeReply::Failed(tr!("window-the-textures-could-not-be-baked").to_owned()))
            }
            Err(_) => None,
        }
    }
}

impl Drop for ThreadBake {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

fn run(request: &BakeRequest, replies: &Sender<BakeReply>, stop: &AtomicBool, ctx: &egui::Context) {
    let last: Mutex<Option<Instant>> = Mutex::new(None);
    let progress = |step: &str, share: f64| {
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.is_none_or(|last| last.elapsed() >= INTERVAL) {
            *last = Some(Instant::now());
            let _ = replies.send(BakeReply::Progress(step.to_owned(), share));
            ctx.request_repaint();
        }
        !stop.load(Ordering::Relaxed)
    };
    let reply = match request.job.run(&request.scene, request.time, &request.stem, &progress) {
        Ok(atlas) => BakeReply::Finished(Box::new(atlas)),
        // Nobody waits for it.
        Err(BakeJobError::Stopped) => return,
        Err(error) => BakeReply::Failed(error.to_string()),
    };
    let _ = replies.send(reply);
    ctx.request_repaint();
}
