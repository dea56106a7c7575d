//! Pictures to be saved, at the pane's size or another one.

use super::PaneRenderer;
use super::pane::PaneDrawing;
use crate::saving::png::DisplayedPicture;
use gonio_gl::GlError;
use gonio_light::color::ColorEncoding;
use gonio_render::{DisplayOptions, DisplayTexture, GpuScene, View};
use gonio_scene::{Frame, Picture};

impl PaneRenderer {
    /// The picture as displayed; `None` if the pane has not been drawn. Waits for the GPU.
    pub fn shown(&mut self, index: usize, size: Option<[u32; 2]>) -> Result<Option<DisplayedPicture>, GlError> {
        let Some((uploaded, frame, show)) = self.panes.get(index).and_then(|pane| pane.to_save(size)) else {
            return Ok(None);
        };
        let mut canvas = DisplayTexture::new(&self.gl, [frame.width, frame.height])?;
        self.renderer.paint(uploaded, &frame, &show, &mut canvas)?;
        let is_srgb = show.view == View::Picture && frame.output.encoding == ColorEncoding::Srgb;
        Ok(Some(DisplayedPicture { size: canvas.size(), rgba: canvas.read8(), is_srgb }))
    }

    /// The light, linear and premultiplied (of a quantity, its numbers; of a view that is none, the picture's); `None`
    /// where the pane has not been drawn. Waits for the GPU.
    pub fn light(&mut self, index: usize, size: Option<[u32; 2]>) -> Result<Option<Picture>, GlError> {
        let Some((uploaded, frame, show)) = self.panes.get(index).and_then(|pane| pane.to_save(size)) else {
            return Ok(None);
        };
        let view = if let View::Quantity(view) = show.view { Some(view) } else { None };
        self.renderer.paint_linear(uploaded, &frame, view).map(Some)
    }
}

impl PaneDrawing {
    /// The frame with all of the scene's samples.
    fn to_save(&self, size: Option<[u32; 2]>) -> Option<(&GpuScene, Frame, DisplayOptions)> {
        let (frame, show) = self.drawn.as_ref()?;
        let [width, height] = size.unwrap_or([frame.width, frame.height]);
        let samples = self.loaded.as_ref()?.settings.picture.samples;
        let (_, uploaded) = self.uploaded.as_ref()?;
        Some((uploaded, Frame { width, height, samples, ..frame.clone() }, *show))
    }
}
