//! Loading scenes without blocking the window: in a thread, or on the web between two frames.

use crate::app::unsaved::ReplacedScene;
use crate::files::{ReadRecorder, ShaderFiles, short};
use gonio_mesh::{Limits, ReadError};
use gonio_scene::edit::{self, Edited};
use gonio_scene::files::{Budgeted, FileSource};
use gonio_scene::{Scene, SceneFile, SceneSettings, ViewSpec, load};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

/// Changes to a scene file before its files are read: options of the command line.
pub type Adjust = Arc<dyn Fn(&mut SceneFile) + Send + Sync>;

/// Inputs and options of a scene to open.
#[derive(Clone, Default)]
pub struct SceneOpening {
    /// Models and scene files.
    pub inputs: Vec<String>,
    /// An environment that replaces theirs.
    pub environment: Option<String>,
    /// Changes to the scene file.
    pub adjust: Option<Adjust>,
    /// Limits on memory that files may claim.
    pub limits: Limits,
    /// The user's shaders, which stay for scenes that are opened later.
    pub shaders: Option<ShaderFiles>,
    /// The view of the scene in place of the picture.
    pub view: Option<ViewSpec>,
    /// The time at which it is shown, seconds.
    pub time: f64,
    /// A sample: its own camera is moved back where the window would cut off objects.
    pub is_sample: bool,
}

/// A request to load a scene.
#[derive(Clone)]
pub enum LoadRequest {
    /// A new document.
    Open(SceneOpening),
    /// The same again, because the scene file has changed.
    Again(SceneOpening),
    /// This scene in place of the document's: an edit needs files.
    Scene(Box<SceneSettings>),
    /// The document's scene again, because its files have changed.
    Refresh(Box<SceneSettings>),
    /// An edited scene that another one has replaced.
    Restore(Box<ReplacedScene>),
    /// This scene file in place of the document's: the edits of an earlier window.
    Draft(Box<SceneFile>),
}

/// The result of a request.
pub struct LoadOutcome {
    /// The request.
    pub requested: LoadRequest,
    /// The source of its files.
    pub files: Arc<dyn FileSource>,
    /// The paths that were read.
    pub paths: Vec<PathBuf>,
    /// Those at which there is no file.
    pub missing: Vec<PathBuf>,
    /// The scene, or an error in one sentence.
    pub result: Result<Scene, String>,
}

struct Job {
    number: u64,
    requested: LoadRequest,
    files: Arc<dyn FileSource>,
    recording: Arc<ReadRecorder>,
    limits: Limits,
}

/// Loads one scene at a time; the last request wins.
pub struct Loader {
    sender: Sender<(u64, LoadOutcome)>,
    receiver: Receiver<(u64, LoadOutcome)>,
    /// Number of the last request: results of older ones are dropped.
    latest: u64,
    /// The files of the running request.
    running: Option<Arc<ReadRecorder>>,
    #[cfg(target_arch = "wasm32")]
    waiting: Option<Job>,
}

impl Default for Loader {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Loader {
            sender,
            receiver,
            latest: 0,
            running: None,
            #[cfg(target_arch = "wasm32")]
            waiting: None,
        }
    }
}

impl Loader {
    /// Starts to load within `limits`; `ctx` is repainted when that is done.
    pub fn start(&mut self, requested: LoadRequest, files: Arc<dyn FileSource>, limits: Limits, ctx: &egui::Context) {
        self.latest += 1;
        let recording = Arc::new(ReadRecorder::new(files.clone()));
        self.running = Some(recording.clone());
        let job = Job { number: self.latest, requested, files, recording, limits };
        #[cfg(target_arch = "wasm32")]
        {
            self.waiting = Some(job);
        }
        #[cfg(not(target_arch = "wasm32"))]
        {
            let (sender, ctx) = (self.sender.clone(), ctx.clone());
            std::thread::spawn(move || {
                let result = job.read();
                // The window may be closed by now.
                let _ = sender.send(job.finished(result));
                ctx.request_repaint();
            });
        }
        ctx.request_repaint();
    }

    /// Returns the outcome of the last request, once. On the web this loads the scene, after a frame that announces it
    /// was shown, and loads it again when missing built-in files have arrived.
    pub fn poll(&mut self) -> Option<LoadOutcome> {
        #[cfg(target_arch = "wasm32")]
        if let Some(job) = self.waiting.take_if(|job| !job.recording.is_waiting()) {
            job.recording.forget();
            let result = job.read();
            // A file that has not arrived over the network yet is not an error of the scene.
            if job.recording.is_waiting() {
                self.waiting = Some(job);
            } else {
                let _ = self.sender.send(job.finished(result));
            }
        }
        while let Ok((number, finished)) = self.receiver.try_recv() {
            if number == self.latest {
                self.running = None;
                return Some(finished);
            }
        }
        None
    }

    /// Whether a scene is being loaded.
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Number of files and bytes read so far.
    pub fn progress(&self) -> Option<(usize, u64)> {
        self.running.as_ref().map(|recording| recording.amount())
    }
}

impl Job {
    fn read(&self) -> Result<Scene, String> {
        read(&self.requested, &*self.recording, &self.limits)
    }

    fn finished(self, result: Result<Scene, String>) -> (u64, LoadOutcome) {
        let (paths, missing) = (self.recording.paths(), self.recording.missing());
        (self.number, LoadOutcome { requested: self.requested, files: self.files, paths, missing, result })
    }
}

fn read(requested: &LoadRequest, files: &dyn FileSource, limits: &Limits) -> Result<Scene, String> {
    let sentence = |error: ReadError| error.to_string();
    match requested {
        LoadRequest::Open(opening) | LoadRequest::Again(opening) => {
            let inputs: Vec<&str> = opening.inputs.iter().map(String::as_str).collect();
            let within = Budgeted::new(files, limits.max_bytes);
            let mut scene = load::describe(&inputs, &within).map_err(sentence)?;
            if let Some(adjust) = &opening.adjust {
                adjust(&mut scene);
            }
            if let Some(image) = &opening.environment {
                scene.set_environment(image);
            }
            load::load_within(scene, Path::new(""), files, limits).map_err(sentence)
        }
        LoadRequest::Scene(scene) | LoadRequest::Refresh(scene) => read_edited((&**scene).into(), files, limits),
        LoadRequest::Restore(replaced) => read_edited((&replaced.document.scene).into(), files, limits),
        LoadRequest::Draft(scene) => read_edited((**scene).clone(), files, limits),
    }
}

/// Loads a scene that was edited.
fn read_edited(scene: SceneFile, files: &dyn FileSource, limits: &Limits) -> Result<Scene, String> {
    let is_dark = scene.lights.is_empty();
    let loaded = load::load_within(scene, Path::new(""), files, limits).map_err(|e| e.to_string())?;
    // Loading adds lights to a scene without any; here the user removed them.
    if !is_dark || loaded.settings.lights.is_empty() {
        return Ok(loaded);
    }
    let mut dark = loaded.settings.clone();
    dark.lights.clear();
    match edit::apply(&loaded, dark).map_err(|error| error.to_string())? {
        Edited::Done(applied) => Ok(applied.loaded),
        Edited::NeedsFiles(_) => Ok(loaded),
    }
}

/// File names without folders, for a message.
pub(super) fn names(paths: &[PathBuf]) -> String {
    short(&paths.iter().map(|path| path.to_string_lossy().into_owned()).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::files::BuiltinOnly;

    fn opened(opening: SceneOpening) -> Scene {
        read(&LoadRequest::Open(opening), &BuiltinOnly, &Limits::default()).unwrap_or_else(|e| panic!("{e}"))
    }

    fn cube() -> SceneOpening {
        SceneOpening { inputs: vec!["builtin:cube".into()], ..SceneOpening::default() }
    }

    #[test]
    fn removed_lights_stay_removed() {
        let mut scene = opened(cube()).settings;
        assert!(!scene.lights.is_empty());
        scene.lights.clear();
        let requested = LoadRequest::Refresh(Box::new(scene));
        let again = read(&requested, &BuiltinOnly, &Limits::default()).unwrap_or_else(|e| panic!("{e}"));
        assert!(again.settings.lights.is_empty());
    }

    #[test]
    fn options_and_environment_override_the_opened_scene() {
        let adjust: Adjust = Arc::new(|scene: &mut SceneFile| scene.picture.exposure = 2.0);
        let loaded = opened(SceneOpening { environment: Some("debug".into()), adjust: Some(adjust), ..cube() });
        assert_eq!(loaded.settings.picture.exposure, 2.0);
        assert_eq!(loaded.settings.environment.map(|e| e.image).as_deref(), Some("debug"));
    }
}
