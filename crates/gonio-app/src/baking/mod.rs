//! Baking: textures for new texture coordinates of the open scene, and the atlas beside the model.
//!
//! | file | contents |
//! |---|---|
//! | `task` | the interface to the platform: a request, its progress and its result |
//! | `result` | a baked atlas with what its views need: places, outlines, the scene with the baked textures |
//! | `places` | from a texel to the surface, and back |
//! | `panel` | the settings, the progress and the figures |
//! | `view` | the atlas, to zoom and to point at |
//! | `mark` | the place of a texel in the picture of the scene |
//! | `state_json` | its part of the exported state |
//!
//! The work is `gonio-bake`'s, in a thread or in a worker of the page.

mod mark;
mod panel;
mod places;
mod result;
mod state_json;
mod task;
mod view;

pub use mark::show as mark;
pub use panel::show as panel;
pub use places::AtlasPlace;
pub use result::{AtlasBackground, BakedResult};
pub use state_json::build as state;
pub use task::{BakeReply, BakeRequest, BakeTask};
pub use view::show as view;

use crate::bench::Job;
use crate::platform::Platform;
use crate::session::Session;
use crate::session::probing::Probing;
use gonio_bake::BakeJob;
use gonio_language::tr;
use gonio_scene::Scene;
use std::sync::Arc;
use view::AtlasView;
use web_time::Instant;

/// Whether the atlas belongs on the screen.
pub fn shows_atlas(session: &Session) -> bool {
    session.baking.is_open && session.baking.result.is_some()
}

/// Everything about baking the open scene.
#[derive(Default)]
pub struct Baking {
    /// Whether its tab is there.
    pub is_open: bool,
    was_open: bool,
    /// The settings of the next bake.
    pub job: BakeJob,
    /// The page of a narrow window: the atlas, or the settings.
    pub shows_atlas: bool,
    /// The atlas as it is looked at.
    pub view: AtlasView,
    /// The place that was picked in the atlas.
    pub picked: Option<AtlasPlace>,
    /// The place under the pointer in the atlas.
    hovered: Option<AtlasPlace>,
    running: Option<Running>,
    preparing: Option<Job<BakedResult>>,
    result: Option<Arc<BakedResult>>,
    /// Why the last bake failed, in one sentence.
    failed: Option<String>,
    serial: u64,
}

/// A bake at work.
struct Running {
    task: Box<dyn BakeTask>,
    scene: Arc<Scene>,
    generation: u64,
    job: BakeJob,
    /// The step at work, and the share of the whole that is done.
    step: (String, f64),
    start: Instant,
}

impl Baking {
    /// Shows the tab, at first with kept settings (JSON). Ones that the panel does not offer are replaced by defaults.
    pub fn open(&mut self, kept: Option<&str>) {
        if !self.was_open {
            let job = kept.and_then(|kept| serde_json::from_str(kept).ok());
            self.job = job.filter(panel::is_offered).unwrap_or_default();
        }
        (self.is_open, self.was_open) = (true, true);
    }

    /// The newest baked atlas.
    pub fn result(&self) -> Option<&Arc<BakedResult>> {
        self.result.as_ref()
    }

    /// Whether a bake is at work.
    pub fn is_running(&self) -> bool {
        self.running.is_some() || self.preparing.is_some()
    }

    /// Starts a bake of the scene; `generation` changes with its geometry and materials. One that is at work is cancelled.
    pub fn start(&mut self, platform: &mut dyn Platform, ctx: &egui::Context, request: BakeRequest, generation: u64) {
        let (scene, job) = (request.scene.clone(), request.job.clone());
        (self.preparing, self.failed) = (None, None);
        let (step, start) = (("starting".to_owned(), 0.0), Instant::now());
        self.running = Some(Running { task: platform.bake(request, ctx), scene, generation, job, step, start });
    }

    /// Cancels the bake at work. Returns whether there was one.
    pub fn cancel(&mut self) -> bool {
        let was_running = self.is_running();
        (self.running, self.preparing) = (None, None);
        was_running
    }

    /// Forgets everything about the scene, because another one was opened. Returns whether a bake was at work.
    pub fn forget(&mut self) -> bool {
        let was_running = self.cancel();
        let (is_open, was_open, serial) = (self.is_open, self.was_open, self.serial);
        *self = Baking { is_open, was_open, serial, job: std::mem::take(&mut self.job), ..Baking::default() };
        was_running
    }

    /// Begins a frame: takes progress and results. Returns sentences for the user, and whether each is an error.
    pub fn follow(&mut self, platform: &mut dyn Platform, ctx: &egui::Context) -> Vec<(bool, String)> {
        let mut sentences = Vec::new();
        self.hovered = None;
        while let Some(running) = &mut self.running {
            match running.task.poll() {
                None => break,
                Some(BakeReply::Progress(step, share)) => running.step = (step, share),
                Some(BakeReply::Failed(error)) => {
                    self.running = None;
                    sentences.push((true, error.clone()));
                    self.failed = Some(error);
                }
                Some(BakeReply::Finished(atlas)) => {
                    let Some(running) = self.running.take() else { break };
                    sentences.extend(atlas.warnings.iter().map(|warning| (false, warning.clone())));
                    self.serial += 1;
                    let (scene, job, serial) = (running.scene, running.job, self.serial);
                    let seconds = running.start.elapsed().as_secs_f64();
                    let facts = result::ResultFacts { serial, generation: running.generation, seconds };
                    let prepare = move || BakedResult::new(scene, job, *atlas, facts);
                    self.preparing = Some(Job::start(platform, ctx, prepare));
                }
            }
        }
        if let Some(prepared) = self.preparing.as_ref().and_then(Job::poll) {
            self.preparing = None;
            (self.picked, self.hovered) = (None, None);
            match prepared {
                Some(result) => {
                    self.view.forget(result.first_background());
                    self.result = Some(Arc::new(result));
                    self.shows_atlas = true;
                }
                None => sentences.push((true, tr!("bench-the-baked-atlas-could-not-be").to_owned())),
            }
        }
        sentences
    }

    /// The place to mark: under the pointer in the atlas, else that of the probe, else the one picked in the atlas.
    pub fn place(&self, probing: &Probing) -> Option<AtlasPlace> {
        let probed = || {
            let reading = probing.reading()?;
            self.result.as_ref()?.place_of_probe(&reading.loaded, reading.probe.as_ref()?)
        };
        self.hovered.or_else(probed).or(self.picked)
    }

    /// Frees what is on the GPU, because its context is lost.
    pub fn release(&mut self) {
        self.view.release();
    }
}
