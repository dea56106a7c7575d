//! The thread with the OpenGL context: one for each process.
//!
//! A context belongs to one thread, and Python calls from any. So work is sent to that thread, and the caller waits without Python's
//! lock. The thread lives as long as the process: making a context takes longer than drawing most pictures.

use crate::draw::GlDrawer;
use crate::error::Failure;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Mutex, PoisonError};

type Work = Box<dyn FnOnce(&mut GlDrawer) + Send>;

/// What all scenes of a process share. The package makes one.
#[pyclass(frozen, module = "gonio._native")]
pub struct NativeSession(Arc<DrawingThread>);

/// The thread, if it has been needed.
#[derive(Default)]
pub struct DrawingThread {
    thread: Mutex<Option<Sender<Work>>>,
    /// The process that first worked with it.
    process: Mutex<Option<u32>>,
    scenes: AtomicU64,
}

#[pymethods]
impl NativeSession {
    #[new]
    fn new() -> Self {
        NativeSession(Arc::default())
    }
}

impl NativeSession {
    /// The session, for a scene.
    pub fn shared(&self) -> Arc<DrawingThread> {
        self.0.clone()
    }
}

impl DrawingThread {
    /// The number of a new scene.
    pub fn new_scene(&self) -> u64 {
        self.scenes.fetch_add(1, Ordering::Relaxed)
    }

    /// Refuses to work in a process that was forked from one that has worked: threads do not survive that, and waiting for them
    /// would never end.
    pub fn check_process(&self) -> Result<(), Failure> {
        let this = std::process::id();
        let mut first = self.process.lock().unwrap_or_else(PoisonError::into_inner);
        match *first.get_or_insert(this) {
            first if first == this => Ok(()),
            _ => Err(Failure::new(
                "this process was forked from one that had used gonio, and its threads are missing here; start processes with \
                 multiprocessing.get_context(\"spawn\")",
            )),
        }
    }

    /// Runs `work` on the thread, and waits for it. A panic is a failure.
    pub fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut GlDrawer) -> Result<T, Failure> + Send + 'static,
    ) -> Result<T, Failure> {
        let (answer, answered) = mpsc::channel();
        self.send(Box::new(move |drawer| {
            let result = catch_unwind(AssertUnwindSafe(|| work(drawer)));
            // Nobody waits if the caller has gone.
            let _ = answer.send(result.unwrap_or_else(|panic| Err(Failure::of_panic(panic.as_ref()))));
        }))?;
        answered.recv().unwrap_or_else(|_| Err(ended()))
    }

    /// Frees what the GPU has of a scene.
    pub fn forget(&self, scene: u64) {
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(thread) = &*thread {
            // If the thread has ended, so has what it had.
            let _ = thread.send(Box::new(move |drawer| drawer.forget(scene)));
        }
    }

    fn send(&self, work: Work) -> Result<(), Failure> {
        let mut thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner);
        let sender = match &*thread {
            Some(sender) => sender,
            None => thread.insert(start()?),
        };
        sender.send(work).map_err(|_| ended())
    }
}

fn ended() -> Failure {
    Failure::new("the thread that draws has ended; this is a bug in gonio, please report it")
}

fn start() -> Result<Sender<Work>, Failure> {
    let (sender, receiver) = mpsc::channel::<Work>();
    let draw = move || {
        let mut drawer = GlDrawer::default();
        while let Ok(work) = receiver.recv() {
            work(&mut drawer);
        }
        // The process ends, and the system frees contexts faster.
        std::mem::forget(drawer);
    };
    let thread = std::thread::Builder::new().name("gonio OpenGL".to_owned()).spawn(draw);
    thread.map(|_| sender).map_err(|error| Failure(format!("cannot start the thread that draws: {error}")))
}
