//! From a scene's description to a loaded scene.

use crate::description::Scene;
use crate::files::FileSource;
use crate::frame::Frame;
use crate::loaded::LoadedScene;
use gonio_mesh::ReadError;
use std::path::Path;

/// Reads what `input` names: a scene file (`.toml`) or a bare model, which becomes a scene of one
/// object. Only the description: no model is opened. Several inputs become one scene.
pub fn describe(inputs: &[&str], files: &dyn FileSource) -> Result<Scene, ReadError> {
    let _ = (inputs, files);
    Err(ReadError::new("not written yet"))
}

/// Reads the files of `scene`, relative to `base`, and fills in every default.
pub fn load(scene: Scene, base: &Path, files: &dyn FileSource) -> Result<LoadedScene, ReadError> {
    let _ = (scene, base, files);
    Err(ReadError::new("not written yet"))
}

impl LoadedScene {
    /// The scene at `time`, seconds. The effective scene has every default filled in, so nothing can
    /// be missing.
    pub fn frame(&self, time: f64) -> Frame {
        let _ = time;
        unimplemented!("by the scene's author")
    }
}
