//! What the desktop and the web do each in their own way.

#[cfg(not(target_arch = "wasm32"))]
pub mod desktop;
mod pending;
mod trial;
#[cfg(target_arch = "wasm32")]
pub mod web;

pub use pending::{CheckRequest, CheckResult, Pending, Ready};
pub use trial::{ByCheck, TrialOutcome};

use crate::files::ExerciseFile;
use crate::saving::Product;
use crate::session::Settings;
use gonio_scene::files::FileSource;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use web_time::Instant;

/// Files that a person gave: chosen or dropped.
#[derive(Clone)]
pub struct SceneInput {
    /// Models or scenes to open; none where there is only an environment.
    pub inputs: Vec<String>,
    /// The environment.
    pub environment: Option<String>,
    /// Where they are, with what lies beside them.
    pub files: Arc<dyn FileSource>,
}

/// What files are wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Models and scenes, to be looked at.
    Scene,
    /// A student's own files, for the exercise that is worked on.
    Exercise,
}

/// What came from outside since it was last asked.
pub enum Event {
    /// Files to open.
    Open(SceneInput),
    /// Files for the exercise, as they are: those in folders and zips too.
    ExerciseFiles(Vec<ExerciseFile>),
    /// Where something is to be saved.
    SaveTo(Product, String),
    /// Files that were read are others now.
    Changed(Vec<PathBuf>),
    /// What was asked for could not be done: one sentence.
    Failed(String),
}

/// Whom a person is asked by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileDialog {
    /// A dialog of the system: the answer comes by [`Platform::poll`].
    Opened,
    /// Nobody: the window is to ask itself.
    Unavailable,
}

/// How long a picture is left alone that somebody is to see: by then the window has come to show it.
const MOMENT: Duration = Duration::from_millis(100);

/// Whether what was painted is on the screen, and has been for a moment. Paints again when it is.
pub type FrameShown = Box<dyn Fn(&egui::Context) -> bool>;

/// The outer world of the application.
pub trait Platform {
    /// Where files lie that are named by hand: the disk, or nothing but what is built in.
    fn files(&self) -> Arc<dyn FileSource>;
    /// What is to be opened at the start, where the inputs say nothing: the scene of a link. An error is one sentence.
    fn first(&self) -> Option<Result<SceneInput, String>> {
        None
    }
    /// Asks a person for files.
    fn choose_files(&mut self, purpose: Purpose, ctx: &egui::Context) -> FileDialog;
    /// Opens files that a person named by hand.
    fn open_paths(&mut self, paths: Vec<String>, purpose: Purpose, ctx: &egui::Context);
    /// Asks a person where to save; `name` is proposed.
    fn choose_place(&mut self, product: Product, name: &str, ctx: &egui::Context) -> FileDialog;
    /// What came since; files that were dropped in this frame are wanted for `purpose`.
    fn poll(&mut self, purpose: Purpose, ctx: &egui::Context) -> Vec<Event>;
    /// Hands a file out: where it went, or one sentence.
    fn write(&mut self, place: &str, bytes: &[u8]) -> Result<String, String>;
    /// The address of this page with another part after `#`, or a text that says where to put it.
    fn link(&self, fragment: &str) -> String;
    /// Tells ([`Event::Changed`]) when one of these files becomes another; those that were watched no longer are.
    fn watch(&mut self, paths: Vec<PathBuf>, ctx: &egui::Context) {
        let _ = (paths, ctx);
    }
    /// Whether there are folders to save into; otherwise what is written goes to where downloads go.
    fn has_folders(&self) -> bool {
        cfg!(not(target_arch = "wasm32"))
    }
    /// How an input can be opened again another day; `None` where it cannot.
    fn lasting(&self, input: &str) -> Option<String> {
        let _ = input;
        None
    }
    /// What was kept of the last time.
    fn settings(&self) -> Settings;
    /// Keeps it for the next time: what cannot be kept is forgotten, for nothing of a scene is in it.
    fn keep(&mut self, settings: &Settings);
    /// Keeps a draft, a text of unsaved changes, in place of the one that this window kept under this key. An error is one
    /// sentence without a full stop.
    fn keep_draft(&mut self, key: &str, text: &str) -> Result<(), String> {
        let _ = (key, text);
        Ok(())
    }
    /// Removes the draft that this window keeps under this key.
    fn remove_draft(&mut self, key: &str) {
        let _ = key;
    }
    /// The newest draft that was left under this key by a window that is gone. From now on this window keeps it.
    fn take_draft(&mut self, key: &str) -> Option<String> {
        let _ = key;
        None
    }
    /// Whether the frame that is being painted has been shown: to be asked in those after it.
    fn shown(&mut self, ctx: &egui::Context) -> FrameShown {
        let then = Instant::now() + MOMENT;
        let shown = move |ctx: &egui::Context| {
            let left = then.saturating_duration_since(Instant::now());
            if !left.is_zero() {
                ctx.request_repaint_after(left);
            }
            left.is_zero()
        };
        shown(ctx);
        Box::new(shown)
    }
    /// Begins to check a student's files, where nothing that they do can harm or hold up the window.
    fn check(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<CheckResult>> {
        let _ = (request, ctx);
        Box::new(Ready::new(Err("checks are not available here: run `gonio lab check` on the command line".into())))
    }
    /// Whether [`Platform::trial`] runs in a process of its own and is cheap. Then every pair of shaders is tried before the
    /// window's OpenGL gets it; otherwise only those that may never end.
    fn tries_every_pair(&self) -> bool {
        false
    }
    /// Begins to compile and draw a pair of shaders where a crash does not end the window.
    fn trial(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<TrialOutcome>> {
        Box::new(ByCheck::new(self.check(request, ctx)))
    }
    /// The state after a frame, for whoever watches it.
    fn publish(&mut self, state: &dyn Fn() -> Value) {
        let _ = state;
    }
}
