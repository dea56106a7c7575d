//! Traced pictures of the window: by a thread per pane, and a pool of threads that leaves a core to the interface.

use crate::truth::{ERROR_GOAL, TraceFacts, TraceReply, TraceRequest, Tracer};
use gonio_trace::{Refinement, TraceScene, TraceSettings};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

/// The time between two pictures, except of new stages.
const BETWEEN: Duration = Duration::from_millis(150);
/// The time of one step of the work.
const STEP: Duration = Duration::from_millis(40);

/// The number of a request.
type Number = u64;

/// Traces in a thread. A new request stops the work within a row of the picture.
pub struct ThreadTracer {
    requests: Sender<(Number, TraceRequest)>,
    replies: Receiver<(Number, TraceReply)>,
    /// The newest request: the thread stops working on others.
    newest: Arc<AtomicU64>,
    number: Number,
    is_lost: bool,
}

impl ThreadTracer {
    /// Starts the thread; `ctx` is repainted with each picture.
    pub fn start(ctx: &egui::Context) -> Self {
        let (requests, received) = channel();
        let (sender, replies) = channel();
        let newest = Arc::new(AtomicU64::new(0));
        let worker = Worker { newest: newest.clone(), replies: sender, ctx: ctx.clone() };
        std::thread::spawn(move || worker.run(&received));
        ThreadTracer { requests, replies, newest, number: 0, is_lost: false }
    }
}

impl Tracer for ThreadTracer {
    fn trace(&mut self, request: TraceRequest) {
        self.number += 1;
        self.newest.store(self.number, Ordering::Relaxed);
        // If the thread has ended, `poll` says so.
        let _ = self.requests.send((self.number, request));
    }

    fn poll(&mut self) -> Option<Result<TraceReply, String>> {
        let mut newest = None;
        loop {
            match self.replies.try_recv() {
                Ok((number, reply)) if number == self.number => newest = Some(Ok(reply)),
                Ok(_) => {}
                Err(TryRecvError::Empty) => return newest,
                Err(TryRecvError::Disconnected) if self.is_lost => return newest,
                Err(TryRecvError::Disconnected) => {
                    self.is_lost = true;
                    return Some(Err("the scene could not be traced: the path tracer ended unexpectedly".to_owned()));
                }
            }
        }
    }
}

impl Drop for ThreadTracer {
    fn drop(&mut self) {
        self.newest.store(Number::MAX, Ordering::Relaxed);
    }
}

struct Worker {
    newest: Arc<AtomicU64>,
    replies: Sender<(Number, TraceReply)>,
    ctx: egui::Context,
}

impl Worker {
    fn run(&self, requests: &Receiver<(Number, TraceRequest)>) {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build();
        let mut kept: Option<(TraceRequest, Refinement)> = None;
        while let Ok(mut next) = requests.recv() {
            while let Ok(newer) = requests.try_recv() {
                next = newer;
            }
            let (number, request) = next;
            let trace = || {
                let mut refinement = started(kept.take(), &request);
                self.refine(number, &mut refinement);
                kept = Some((request, refinement));
            };
            match &pool {
                Ok(pool) => pool.install(trace),
                Err(_) => trace(),
            }
        }
    }

    /// Refines a picture until it is finished or another one is requested.
    fn refine(&self, number: Number, refinement: &mut Refinement) {
        let goes_on = || self.newest.load(Ordering::Relaxed) == number;
        let (mut rows, mut sent) = (16, Instant::now());
        loop {
            let start = Instant::now();
            if !refinement.advance(rows, &goes_on) {
                return;
            }
            let taken = start.elapsed().max(Duration::from_micros(100));
            rows = (f64::from(rows) * STEP.as_secs_f64() / taken.as_secs_f64()).clamp(4.0, 4096.0) as u32;
            let status = refinement.status();
            let is_stage = status.pass == 0.0 && status.paths <= 2.0;
            if is_stage || status.done || sent.elapsed() >= BETWEEN {
                let facts =
                    TraceFacts { paths: status.paths, error: status.error, pass: status.pass, done: status.done };
                // The pane may be closed by now.
                let _ = self.replies.send((number, TraceReply { picture: refinement.picture(), facts }));
                self.ctx.request_repaint();
                sent = Instant::now();
            }
            if status.done {
                return;
            }
        }
    }
}

/// The beginning of a request's picture. The scene of the last one is used again if only the camera has moved.
fn started(kept: Option<(TraceRequest, Refinement)>, request: &TraceRequest) -> Refinement {
    let frame = &request.frame;
    match kept {
        Some((before, mut refinement)) if before.is_same_but_camera(request) => {
            refinement.restart(frame.camera, [frame.width, frame.height]);
            refinement
        }
        _ => {
            let settings = request.settings;
            let settings = TraceSettings {
                simplified: settings.simplified,
                points_per_light: settings.points_per_light,
                ..TraceSettings::default()
            };
            Refinement::new(TraceScene::new(&request.scene, frame), settings, ERROR_GOAL)
        }
    }
}
