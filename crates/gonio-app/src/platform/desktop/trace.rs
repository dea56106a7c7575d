//! Traced pictures of the window: by a thread per pane, and a pool of threads that leaves a core to the interface.

use crate::truth::{
    ERROR_GOAL, PixelLight, REPAINT_DELAY, TraceFacts, TraceReply, TraceRequest, Tracer, picture_interval,
};
use gonio_language::tr;
use gonio_trace::{Refinement, TraceScene, TraceSettings};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The time of one step of the work.
const STEP: Duration = Duration::from_millis(40);

/// The number of a request.
type Number = u64;

/// The pixel that is probed, for both threads.
type Probed = Arc<Mutex<Option<[u32; 2]>>>;

/// A message to the thread: a picture, or `None` if the probed pixel is another one.
type Order = Option<(Number, TraceRequest)>;

/// Traces in a thread. A new request stops the work within a row of the picture.
pub struct ThreadTracer {
    requests: Sender<Order>,
    replies: Receiver<(Number, TraceReply)>,
    /// The newest request: the thread stops working on others.
    newest: Arc<AtomicU64>,
    probed: Probed,
    number: Number,
    is_lost: bool,
}

impl ThreadTracer {
    /// Starts the thread; `ctx` is repainted with each picture.
    pub fn start(ctx: &egui::Context) -> Self {
        let (requests, received) = channel();
        let (sender, replies) = channel();
        let newest = Arc::new(AtomicU64::new(0));
        let probed = Probed::default();
        let worker = Worker { newest: newest.clone(), probed: probed.clone(), replies: sender, ctx: ctx.clone() };
        std::thread::spawn(move || worker.run(&received));
        ThreadTracer { requests, replies, newest, probed, number: 0, is_lost: false }
    }
}

impl Tracer for ThreadTracer {
    fn trace(&mut self, request: TraceRequest) {
        self.number += 1;
        self.newest.store(self.number, Ordering::Relaxed);
        *self.probed.lock().unwrap_or_else(PoisonError::into_inner) = request.pixel;
        // If the thread has ended, `poll` says so.
        let _ = self.requests.send(Some((self.number, request)));
    }

    fn probe(&mut self, pixel: Option<[u32; 2]>) {
        *self.probed.lock().unwrap_or_else(PoisonError::into_inner) = pixel;
        let _ = self.requests.send(None);
    }

    fn poll(&mut self) -> Option<Result<TraceReply, String>> {
        let mut newest: Option<TraceReply> = None;
        loop {
            match self.replies.try_recv() {
                Ok((number, reply)) if number == self.number => {
                    newest = Some(match newest {
                        Some(before) => before.and(reply),
                        None => reply,
                    });
                }
                // Nothing of the newest request has come yet.
                Ok((_, TraceReply { picture: Some(picture), .. })) => {
                    newest = Some(TraceReply { picture: Some(picture), facts: None, light: None });
                }
                Ok(_) => {}
                Err(TryRecvError::Empty) => return newest.map(Ok),
                Err(TryRecvError::Disconnected) if self.is_lost => return newest.map(Ok),
                Err(TryRecvError::Disconnected) => {
                    self.is_lost = true;
                    return Some(Err(tr!("window-the-scene-could-not-be-traced").to_owned()));
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
    probed: Probed,
    replies: Sender<(Number, TraceReply)>,
    ctx: egui::Context,
}

impl Worker {
    fn run(&self, requests: &Receiver<Order>) {
        let pool = super::thread_pool();
        let mut kept: Option<(Number, TraceRequest, Refinement)> = None;
        while let Ok(mut next) = requests.recv() {
            while let Ok(newer) = requests.try_recv() {
                next = newer.or(next);
            }
            let trace = || {
                let (number, request, mut refinement) = match (next, kept.take()) {
                    (Some((number, request)), before) => {
                        let refinement = started(before, &request);
                        (number, request, refinement)
                    }
                    (None, Some(before)) => before,
                    (None, None) => return,
                };
                self.refine(number, &mut refinement);
                kept = Some((number, request, refinement));
            };
            match &pool {
                Some(pool) => pool.install(trace),
                None => trace(),
            }
        }
    }

    /// Refines a picture and the light of the probed pixel until both are finished or another picture is requested.
    fn refine(&self, number: Number, refinement: &mut Refinement) {
        let (mut rows, begun) = (16, Instant::now());
        let mut sent = begun;
        let milliseconds = |from: Instant| 1e3 * from.elapsed().as_secs_f64();
        let is_due = |sent| milliseconds(sent) >= picture_interval(milliseconds(begun));
        loop {
            let (was_done, is_covered) = (refinement.status().done, refinement.is_covered());
            let goes_on = || match self.newest.load(Ordering::Relaxed) {
                Number::MAX => false,
                newest => newest == number || !is_covered,
            };
            if !goes_on() {
                return;
            }
            let start = Instant::now();
            if !refinement.advance(rows, &goes_on) {
                return;
            }
            let taken = start.elapsed().max(Duration::from_micros(100));
            rows = (f64::from(rows) * STEP.as_secs_f64() / taken.as_secs_f64()).clamp(4.0, 4096.0) as u32;
            let status = refinement.status();
            let is_stage = status.pass == 0.0 && status.paths <= 2.0;
            // Before, places would be black: the picture before stays.
            let is_sent = !was_done && refinement.is_covered() && (is_stage || status.done || is_due(sent));
            let picture = is_sent.then(|| refinement.picture());
            let light = self.light(refinement, &goes_on);
            let is_finished = status.done && light.is_none();
            if picture.is_some() || light.is_some() {
                let facts =
                    Some(TraceFacts { paths: status.paths, error: status.error, pass: status.pass, done: status.done });
                sent = if is_sent { Instant::now() } else { sent };
                // The pane may be closed by now.
                let _ = self.replies.send((number, TraceReply { picture, facts, light }));
                self.ctx.request_repaint_after(REPAINT_DELAY);
            }
            if is_finished {
                return;
            }
        }
    }

    /// The light of the probed pixel, if there is something new about it.
    fn light(&self, refinement: &mut Refinement, goes_on: &dyn Fn() -> bool) -> Option<PixelLight> {
        let probed = || *self.probed.lock().unwrap_or_else(PoisonError::into_inner);
        let pixel = probed()?;
        let paths = refinement.probe(pixel, &|| goes_on() && probed() == Some(pixel))?;
        PixelLight::from_numbers(pixel, &paths.contributions().to_numbers())
    }
}

/// The beginning of a request's picture. The scene of the last one is used again if only the camera has moved.
fn started(kept: Option<(Number, TraceRequest, Refinement)>, request: &TraceRequest) -> Refinement {
    let frame = &request.frame;
    match kept {
        Some((_, before, mut refinement)) if before.is_same_but_camera(request) => {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::TruthSettings;
    use gonio_scene::files::BuiltinOnly;
    use gonio_scene::{Frame, load};
    use std::path::Path;

    /// While something is dragged, each frame asks for another picture, and each is seen.
    #[test]
    fn pictures_are_seen_while_requests_follow_each_other() {
        let described = load::describe(&["builtin:still-life"], &BuiltinOnly).unwrap_or_else(|error| panic!("{error}"));
        let scene = load::load(described, Path::new(""), &BuiltinOnly).unwrap_or_else(|error| panic!("{error}"));
        let scene = Arc::new(scene);
        let mut tracer = ThreadTracer::start(&egui::Context::default());
        let mut turn = 0.0;
        let mut seen = 0;
        while seen < 3 {
            turn += 1e-4;
            assert!(turn < 2.0, "no picture in 20 000 requests");
            let mut frame = Frame { width: 900, height: 600, ..scene.frame(0.0) };
            frame.camera.position.x += turn;
            tracer.trace(TraceRequest {
                scene: scene.clone(),
                frame,
                settings: TruthSettings::default(),
                generation: 1,
                pixel: None,
                files: Arc::new(BuiltinOnly),
                paths: Vec::new(),
            });
            std::thread::sleep(Duration::from_millis(1));
            match tracer.poll() {
                Some(Ok(TraceReply { picture: Some(picture), .. })) => {
                    assert!(picture.pixels.iter().all(|pixel| pixel[3] > 0.0), "it does not cover the pane");
                    seen += 1;
                }
                Some(Err(error)) => panic!("{error}"),
                _ => {}
            }
        }
    }
}
