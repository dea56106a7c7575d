//! Further pictures of a pane's scene: one pixel for the probe, and the observer's view.

use super::PaneRenderer;
use gonio_gl::GlError;
use gonio_render::{DisplayOptions, DisplayTexture, Presentation};
use gonio_scene::{Camera, Frame, Scene};
use std::sync::Arc;

/// The observer's picture, and the frame that it shows.
pub struct ObserverPicture {
    canvas: DisplayTexture,
    drawn: Option<(Frame, Arc<Scene>)>,
}

impl PaneRenderer {
    /// What OpenGL draws at a pixel of a pane's picture with one sample: linear, premultiplied RGBA. None where nothing
    /// was drawn yet, or it cannot be read.
    pub fn pixel(&mut self, pane: usize, x: u32, y: u32) -> Option<[f32; 4]> {
        let pane = self.panes.get(pane)?;
        let ((_, uploaded), (frame, _)) = (pane.uploaded.as_ref()?, pane.drawn.as_ref()?);
        self.renderer.pixel(uploaded, frame, x, y).ok()
    }

    /// A pane's scene as another camera sees it, `size` pixels; drawn if anything changed since.
    pub fn seen_by(&mut self, pane: usize, camera: Camera, size: [u32; 2]) -> Result<Option<Presentation>, GlError> {
        let Some(pane) = self.panes.get(pane) else { return Ok(None) };
        let (Some((_, uploaded)), Some((frame, _)), Some(loaded)) = (&pane.uploaded, &pane.drawn, &pane.loaded) else {
            return Ok(None);
        };
        let [width, height] = size;
        let wanted = Frame { width, height, camera, ..frame.clone() };
        let observer = match &mut self.observer {
            Some(kept) => kept,
            none => none.insert(ObserverPicture { canvas: DisplayTexture::new(&self.gl, size)?, drawn: None }),
        };
        let is_drawn = |(frame, of): &(Frame, Arc<Scene>)| *frame == wanted && Arc::ptr_eq(of, loaded);
        if !observer.drawn.as_ref().is_some_and(is_drawn) {
            self.renderer.paint(uploaded, &wanted, &DisplayOptions::default(), &mut observer.canvas)?;
            observer.drawn = Some((wanted, loaded.clone()));
        }
        Ok(Some(self.presenter.presentation(observer.canvas.texture())))
    }
}
