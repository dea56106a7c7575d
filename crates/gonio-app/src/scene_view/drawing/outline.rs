//! The outline of the selected part in a pane: a mark on a texture of its own over the picture. What reads the picture (saving, the
//! difference of panes, the probe, a recorded frame) never sees it.

use super::PaneRenderer;
use crate::session::Session;
use crate::theme::colors;
use gonio_gl::{Gl, GlError};
use gonio_render::{DisplayTexture, GpuScene, OutlinedPart, Presentation, Renderer};
use gonio_scene::{Camera, Frame, Scene};
use std::sync::Arc;

/// The outline of one pane.
#[derive(Default)]
pub struct OutlineDrawing {
    layer: Option<DisplayTexture>,
    drawn: Option<Drawn>,
    /// Counts the layers that were drawn.
    pub serial: u64,
}

/// The input of the layer as drawn last.
#[derive(Clone, PartialEq)]
struct Drawn {
    size: [u32; 2],
    camera: Camera,
    part: OutlinedPart,
    /// Address of the uploaded scene, and the time of its objects.
    scene: (usize, f64),
}

impl OutlineDrawing {
    /// The texture with the outline in a frame of the uploaded scene.
    fn layer(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        (scene, uploaded): &(Arc<Scene>, GpuScene),
        frame: &Frame,
        part: OutlinedPart,
    ) -> Result<&DisplayTexture, GlError> {
        let drawn = Drawn {
            size: [frame.width, frame.height],
            camera: frame.camera,
            part,
            scene: (Arc::as_ptr(scene) as usize, frame.time),
        };
        let layer = match &mut self.layer {
            Some(layer) => layer,
            none => none.insert(DisplayTexture::new(gl, drawn.size)?),
        };
        if self.drawn.as_ref() != Some(&drawn) {
            renderer.paint_outline(uploaded, frame, &part, layer)?;
            self.drawn = Some(drawn);
            self.serial += 1;
        }
        Ok(layer)
    }
}

impl PaneRenderer {
    /// The outline of the selected part, to be shown over a pane's picture. `None` if no part is selected. `dark` is the theme.
    pub fn outline(&mut self, index: usize, session: &Session, dark: bool) -> Result<Option<Presentation>, GlError> {
        let (Some([object, part]), Some(pane)) = (session.selection.part(), self.panes.get_mut(index)) else {
            return Ok(None);
        };
        let color = colors::ACCENT.in_theme(dark).to_normalized_gamma_f32();
        let (Some(uploaded), Some((frame, _))) = (&pane.uploaded, &pane.drawn) else { return Ok(None) };
        let part = OutlinedPart { object, part, color };
        let layer = pane.outline.layer(&self.gl, &mut self.renderer, uploaded, frame, part)?;
        Ok(Some(self.presenter.presentation(layer.texture())))
    }
}
