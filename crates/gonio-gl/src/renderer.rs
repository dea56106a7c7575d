//! Draws a scene.

use crate::GlError;
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{Frame, LoadedScene, Picture, ViewSpec};
use std::rc::Rc;

/// The driver, in its own words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DriverInfo {
    /// `GL_RENDERER`
    pub renderer: String,
    /// `GL_VERSION`
    pub version: String,
    /// `GL_SHADING_LANGUAGE_VERSION`
    pub glsl: String,
    /// Most samples per pixel of a float target.
    pub max_samples: u32,
    /// Largest picture, pixels along one side.
    pub max_size: u32,
}

/// What the GPU counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuStatistics {
    /// Vertex shader invocations; `None` where the driver cannot count them.
    pub vertices: Option<u64>,
    /// Fragment shader invocations, whole 2x2 blocks included.
    pub fragments: Option<u64>,
    /// Draw calls.
    pub draw_calls: u32,
}

/// Draws scenes with one OpenGL context.
pub struct Renderer {
    _gl: Rc<glow::Context>,
    info: DriverInfo,
}

/// A scene's buffers and textures on the GPU; freed when dropped.
pub struct GpuScene {}

/// A frame on the GPU, finished. Reading it back is a separate step.
pub struct Drawn {
    /// What the GPU counted.
    pub statistics: GpuStatistics,
    /// Notes on what the driver could not do as asked, for example fewer samples.
    pub notes: Vec<String>,
}

impl Renderer {
    /// For a current context.
    pub fn new(_gl: Rc<glow::Context>) -> Result<Self, GlError> {
        Err(GlError::new("not written yet"))
    }

    /// The driver.
    pub fn info(&self) -> &DriverInfo {
        &self.info
    }

    /// Uploads geometry and textures.
    pub fn upload(&mut self, scene: &LoadedScene) -> Result<GpuScene, GlError> {
        let _ = scene;
        Err(GlError::new("not written yet"))
    }

    /// Draws the picture, or a debug view, and waits for it.
    pub fn render(&mut self, scene: &GpuScene, frame: &Frame, view: Option<ViewSpec>) -> Result<Drawn, GlError> {
        let _ = (scene, frame, view);
        Err(GlError::new("not written yet"))
    }
}

impl Drawn {
    /// The linear values (for debug views: the raw vectors and scalars), premultiplied alpha.
    pub fn linear(&self) -> Picture {
        unimplemented!()
    }

    /// As displayed, 8 bits, encoded by the GPU.
    pub fn encoded8(&self) -> EncodedPicture<u8> {
        unimplemented!()
    }

    /// As displayed, 16 bits, encoded by the GPU.
    pub fn encoded16(&self) -> EncodedPicture<u16> {
        unimplemented!()
    }
}
