//! The interface to the platform: a bake beside the interface.

use gonio_bake::{BakeJob, BakedAtlas};
use gonio_scene::Scene;
use gonio_scene::files::FileSource;
use std::path::PathBuf;
use std::sync::Arc;

/// A scene to bake.
#[derive(Clone)]
pub struct BakeRequest {
    /// The scene.
    pub scene: Arc<Scene>,
    /// Its time, seconds.
    pub time: f64,
    /// The maps and how they are baked.
    pub job: BakeJob,
    /// The beginning of the files' names.
    pub stem: String,
    /// The source of the scene's files, for a worker that has to read them again.
    pub files: Arc<dyn FileSource>,
    /// The paths that were read from it.
    pub paths: Vec<PathBuf>,
}

/// News of a bake.
pub enum BakeReply {
    /// The step at work, and the share of the whole that is done, 0 to 1.
    Progress(String, f64),
    /// The result; nothing follows.
    Finished(Box<BakedAtlas>),
    /// Why there is none, in one sentence; nothing follows.
    Failed(String),
}

/// A bake at work. Dropping it ends the work.
pub trait BakeTask {
    /// Returns the next reply, once. The window is repainted when there is one.
    fn poll(&mut self) -> Option<BakeReply>;
}
