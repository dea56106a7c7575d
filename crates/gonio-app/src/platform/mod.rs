//! Everything that differs between desktop and web.

#[cfg(not(target_arch = "wasm32"))]
pub mod desktop;
#[cfg(target_arch = "wasm32")]
pub mod web;

use crate::baking::{BakeRequest, BakeTask};
use crate::files::link::StationLink;
use crate::files::{ExerciseFile, GatheredInputs, ShaderFiles, gather};
use crate::saving::Product;
use crate::session::Settings;
use crate::stations::StationTask;
use crate::truth::Tracer;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_gl::{Gl, GlError};
use gonio_language::{Language, tr};
use gonio_scene::files::FileSource;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use web_time::Instant;

/// Files to open as a scene, chosen or dropped by the user.
#[derive(Clone)]
pub struct SceneInput {
    /// Models or scenes to open; empty if there is only an environment.
    pub inputs: Vec<String>,
    /// The environment.
    pub environment: Option<String>,
    /// The user's own shaders.
    pub shaders: Option<ShaderFiles>,
    /// The names of all files, which may be sidecars that the open scene lacks.
    pub names: Vec<String>,
    /// The reason why none of them is opened by itself, in one sentence.
    pub problem: Option<String>,
    /// The source of these files and of those beside them.
    pub files: Arc<dyn FileSource>,
}

impl SceneInput {
    /// Finds the inputs among files of `files`.
    pub fn gathered(names: Vec<String>, files: Arc<dyn FileSource>) -> Self {
        let (GatheredInputs { inputs, environment, shaders }, problem) = match gather(&names, &*files) {
            Ok(gathered) => (gathered, None),
            Err(problem) => (GatheredInputs::default(), Some(problem)),
        };
        SceneInput { inputs, environment, shaders, names, problem, files }
    }
}

/// The purpose of opened files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Models and scenes.
    Scene,
    /// A student's files for the open exercise.
    Exercise,
    /// Functions for the BRDF bench.
    Bench,
}

/// An event of the platform.
pub enum Event {
    /// Files to open.
    Open(Box<SceneInput>),
    /// Files for the exercise, including those in folders and zip files.
    ExerciseFiles(Vec<ExerciseFile>),
    /// Files of functions for the BRDF bench: names and contents.
    BenchFiles(Vec<(String, Vec<u8>)>),
    /// The place to save something to.
    SaveTo(Product, String),
    /// Watched files changed.
    Changed(Vec<PathBuf>),
    /// A request failed, with one sentence on why.
    Failed(String),
}

/// Result of showing a file dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileDialog {
    /// The dialog is open; [`Platform::poll`] returns the choice.
    Opened,
    /// There is no dialog: the window shows a path field.
    Unavailable,
}

/// Whether this process can capture frames for RenderDoc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CaptureAccess {
    /// RenderDoc does not run on this platform.
    #[default]
    Unsupported,
    /// RenderDoc was not loaded when the program started, and cannot be loaded later.
    NotLoaded,
    /// RenderDoc records the window's OpenGL.
    Ready,
}

impl CaptureAccess {
    /// Why there are no captures, and what to do, in one sentence; `None` if there are.
    pub fn obstacle(self) -> Option<&'static str> {
        match self {
            CaptureAccess::Ready => None,
            CaptureAccess::Unsupported => Some(tr!("window-renderdoc-does-not-run-here")),
            CaptureAccess::NotLoaded if cfg!(windows) => Some(tr!("window-renderdoc-is-not-loaded-launch")),
            CaptureAccess::NotLoaded => Some(tr!("window-renderdoc-is-not-loaded-preload")),
        }
    }
}

/// State of a search for fonts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FontSearch {
    /// The search goes on; the window is repainted when it has ended.
    Running,
    /// Fonts were found. They draw the characters from the next frame on, as far as they have them.
    Installed,
    /// There is no font with these characters.
    NotFound {
        /// How to get one, as the end of a sentence, without a full stop.
        advice: String,
    },
}

/// Time after which a painted picture counts as being on the screen.
const MOMENT: Duration = Duration::from_millis(100);

/// Tells whether a painted frame is on the screen. Requests a repaint when it is.
pub type FrameShown = Box<dyn Fn(&egui::Context) -> bool>;

/// The interface between the application and the platform.
pub trait Platform {
    /// The source of files named by path: the disk, or only built-in files.
    fn files(&self) -> Arc<dyn FileSource>;
    /// The scene to open if no input is named: that of a link. An error is one sentence.
    fn first(&self) -> Option<Result<SceneInput, String>> {
        None
    }
    /// The station to open at the start: that of a link.
    fn linked_station(&self) -> Option<StationLink> {
        None
    }
    /// Shows the dialog for opening files.
    fn choose_files(&mut self, purpose: Purpose, ctx: &egui::Context) -> FileDialog;
    /// Opens files by path.
    fn open_paths(&mut self, paths: Vec<String>, purpose: Purpose, ctx: &egui::Context);
    /// Shows the dialog for saving, with `name` proposed.
    fn choose_place(&mut self, product: Product, name: &str, ctx: &egui::Context) -> FileDialog;
    /// Returns the events since the last call; files dropped in this frame have this purpose.
    fn poll(&mut self, purpose: Purpose, ctx: &egui::Context) -> Vec<Event>;
    /// Writes a file. Returns its place, or an error in one sentence.
    fn write(&mut self, place: &str, bytes: &[u8]) -> Result<String, String>;
    /// Whether [`Platform::capture`] is possible.
    fn capture_access(&self) -> CaptureAccess {
        #[cfg(not(target_arch = "wasm32"))]
        return desktop::capture::access();
        #[cfg(target_arch = "wasm32")]
        CaptureAccess::Unsupported
    }
    /// Writes a RenderDoc capture of what `draw` does with `gl`. Returns its place, or an error in one sentence.
    fn capture(
        &mut self,
        place: &str,
        gl: &Gl,
        draw: &mut dyn FnMut() -> Result<(), GlError>,
    ) -> Result<String, String> {
        #[cfg(not(target_arch = "wasm32"))]
        return desktop::capture::write(std::path::Path::new(place), gl, draw).map(|()| place.to_owned());
        #[cfg(target_arch = "wasm32")]
        {
            let _ = (place, gl, draw);
            Err(CaptureAccess::Unsupported.obstacle().unwrap_or_default().into())
        }
    }
    /// The address of this page with this fragment, or the fragment alone.
    fn link(&self, fragment: &str) -> String;
    /// Reports changes of these files ([`Event::Changed`]), and no longer of those watched before.
    fn watch(&mut self, paths: Vec<PathBuf>, ctx: &egui::Context) {
        let _ = (paths, ctx);
    }
    /// Whether files can be saved to folders; otherwise they are downloaded.
    fn has_folders(&self) -> bool {
        cfg!(not(target_arch = "wasm32"))
    }
    /// The path by which an input can be reopened later, if any.
    fn lasting(&self, input: &str) -> Option<String> {
        let _ = input;
        None
    }
    /// The language that was asked for at the start: by an option or the page's address. It precedes the settings.
    fn asked_language(&self) -> Option<Language> {
        None
    }
    /// The language that the user prefers in the system or the browser.
    fn preferred_language(&self) -> Language {
        Language::current()
    }
    /// Tells the system the language of the texts that follow.
    fn announce_language(&self, language: Language) {
        let _ = language;
    }
    /// The settings of the last session.
    fn settings(&self) -> Settings;
    /// Keeps the settings for the next session. Failures are ignored, because they contain nothing of a scene.
    fn keep(&mut self, settings: &Settings);
    /// Keeps a draft of unsaved text, replacing the one that this window keeps under this key. An error is one sentence without
    /// a full stop.
    fn keep_draft(&mut self, key: &str, text: &str) -> Result<(), String> {
        let _ = (key, text);
        Ok(())
    }
    /// Removes the draft that this window keeps under this key.
    fn remove_draft(&mut self, key: &str) {
        let _ = key;
    }
    /// Takes over the newest draft that a closed window left under this key.
    fn take_draft(&mut self, key: &str) -> Option<String> {
        let _ = key;
        None
    }
    /// Looks for fonts with characters that no installed font has. Called after each frame until it answers
    /// [`FontSearch::NotFound`]. On the page the browser has been asked before.
    fn find_fonts(&mut self, characters: &BTreeSet<char>, ctx: &egui::Context) -> FontSearch {
        let _ = (characters, ctx);
        FontSearch::NotFound { advice: tr!("window-install-a-font-of-this-script-3").into() }
    }
    /// Returns a function that tells whether the current frame is on the screen.
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
    /// Announces that checks may follow, so that a platform that has to load the checker does so now.
    fn expect_check(&mut self) {}
    /// Starts a check of a student's files, isolated from the window.
    fn check(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<CheckResult>> {
        let _ = (request, ctx);
        Box::new(Ready::new(Err(tr!("window-checks-are-not-available-here-run").into())))
    }
    /// Whether [`Platform::trial`] runs in a process of its own and is cheap. Then every pair of shaders is tried before the
    /// window's OpenGL gets it; otherwise only those that may never end.
    fn tries_every_pair(&self) -> bool {
        false
    }
    /// Starts a trial of a pair of shaders, isolated from the window.
    fn trial(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<TrialOutcome>> {
        Box::new(ByCheck::new(self.check(request, ctx)))
    }
    /// Starts a trial of the user's own shaders, isolated from the window.
    fn shader_trial(&mut self, files: &ShaderFiles, ctx: &egui::Context) -> Box<dyn Pending<TrialOutcome>> {
        let _ = (files, ctx);
        Box::new(Ready::new(TrialOutcome::Unavailable(tr!("window-there-are-no-processes-here").into())))
    }
    /// Runs work beside the interface, in a thread; here at once, because the page has one. The work is short then.
    fn run(&mut self, work: Box<dyn FnOnce() + Send>) {
        work();
    }
    /// Makes a tracer for the pictures of one pane, which repaints `ctx`.
    #[cfg(not(target_arch = "wasm32"))]
    fn tracer(&mut self, ctx: &egui::Context) -> Box<dyn Tracer> {
        Box::new(desktop::trace::ThreadTracer::start(ctx))
    }
    /// Makes a tracer for the pictures of one pane, which repaints `ctx`.
    #[cfg(target_arch = "wasm32")]
    fn tracer(&mut self, ctx: &egui::Context) -> Box<dyn Tracer>;
    /// Starts to bake a scene, beside the interface; repaints `ctx`.
    #[cfg(not(target_arch = "wasm32"))]
    fn bake(&mut self, request: BakeRequest, ctx: &egui::Context) -> Box<dyn BakeTask> {
        Box::new(desktop::bake::ThreadBake::start(request, ctx))
    }
    /// Starts to bake a scene, beside the interface; repaints `ctx`.
    #[cfg(target_arch = "wasm32")]
    fn bake(&mut self, request: BakeRequest, ctx: &egui::Context) -> Box<dyn BakeTask>;
    /// Starts to compute stations, beside the interface; repaints `ctx`.
    #[cfg(not(target_arch = "wasm32"))]
    fn stations(&mut self, ctx: &egui::Context) -> Box<dyn StationTask> {
        Box::new(desktop::stations::ThreadStations::start(ctx))
    }
    /// Starts to compute stations, beside the interface; repaints `ctx`.
    #[cfg(target_arch = "wasm32")]
    fn stations(&mut self, ctx: &egui::Context) -> Box<dyn StationTask>;
    /// Publishes the state after a frame, for tests.
    fn publish(&mut self, state: &dyn Fn() -> Value) {
        let _ = state;
    }
}

/// A student's files to check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckRequest {
    /// The id of the exercise: `ex04`.
    pub exercise: String,
    /// The student's files: names with `/` between folders, and contents.
    pub files: Vec<(String, Vec<u8>)>,
    /// Accept what the lab's own solutions do too, where they differ from the textbook.
    pub as_the_lab: bool,
}

/// The verdict, or one sentence on why there is none.
pub type CheckResult = Result<Verdict, String>;

/// A result that is on its way. Dropping it ends the work.
pub trait Pending<T> {
    /// Returns the result once, when it has arrived, and `None` before and after that. The window is repainted when it arrives.
    fn poll(&mut self) -> Option<T>;
}

/// A result that is known from the start.
pub struct Ready<T>(Option<T>);

impl<T> Ready<T> {
    /// Creates the result.
    pub fn new(result: T) -> Self {
        Ready(Some(result))
    }
}

impl<T> Pending<T> for Ready<T> {
    fn poll(&mut self) -> Option<T> {
        self.0.take()
    }
}

/// The result of a trial.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TrialOutcome {
    /// The shaders were compiled and drawn, or the compiler refused them: the window may do the same.
    Harmless,
    /// They crashed the trial, or took too much time or memory. One sentence for the student.
    Refused(String),
    /// The trial was not possible, with the reason in one sentence. The shaders are untested.
    Unavailable(String),
}

/// A trial by a complete check, for platforms that have no processes.
pub struct ByCheck(Box<dyn Pending<CheckResult>>);

impl ByCheck {
    /// Derives the outcome from this check.
    pub fn new(checking: Box<dyn Pending<CheckResult>>) -> Self {
        ByCheck(checking)
    }
}

impl Pending<TrialOutcome> for ByCheck {
    fn poll(&mut self) -> Option<TrialOutcome> {
        let reason = match self.0.poll()? {
            Ok(Verdict { verdict: Outcome::Correct | Outcome::Wrong | Outcome::DoesNotCompile, .. }) => {
                return Some(TrialOutcome::Harmless);
            }
            Ok(verdict) => verdict.summary,
            Err(reason) => reason,
        };
        Some(TrialOutcome::Refused(tr!("window-this-shader-is-not-drawn-because", reason = reason)))
    }
}
