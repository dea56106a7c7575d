//! The outline of the selected part in a pane: a mark on a texture of its own over the picture. What reads the picture (saving, the
//! difference of panes, the probe, a recorded frame) never sees it.

use super::PaneRenderer;
use super::pane::PaneDrawing;
use crate::session::Session;
use crate::theme::colors;
use gonio_gl::{Gl, GlError};
use gonio_render::{DisplayTexture, OutlinedPart, Presentation, Renderer};
use gonio_scene::Camera;

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

impl PaneDrawing {
    fn outline(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        part: OutlinedPart,
    ) -> Result<Option<&DisplayTexture>, GlError> {
        let (Some((scene, uploaded)), Some((frame, _))) = (&self.uploaded, &self.drawn) else { return Ok(None) };
        let drawn = Drawn {
            size: [frame.width, frame.height],
            camera: frame.camera,
            part,
            scene: (std::sync::Arc::as_ptr(scene) as usize, frame.time),
        };
        let layer = match &mut self.outline.layer {
            Some(layer) => layer,
            none => none.insert(DisplayTexture::new(gl, drawn.size)?),
        };
        if self.outline.drawn.as_ref() != Some(&drawn) {
            renderer.paint_outline(uploaded, frame, &part, layer)?;
            self.outline.drawn = Some(drawn);
            self.outline.serial += 1;
        }
        Ok(self.outline.layer.as_ref())
    }
}

impl PaneRenderer {
    /// The outline of the selected part, to be shown over a pane's picture. `None` if no part is selected. `dark` is the theme.
    pub fn outline(&mut self, index: usize, session: &Session, dark: bool) -> Result<Option<Presentation>, GlError> {
        let (Some([object, part]), Some(pane)) = (session.selection.part(), self.panes.get_mut(index)) else {
            return Ok(None);
        };
        let color = colors::ACCENT.in_theme(dark).to_normalized_gamma_f32();
        let layer = pane.outline(&self.gl, &mut self.renderer, OutlinedPart { object, part, color })?;
        Ok(layer.map(|layer| self.presenter.presentation(layer.texture())))
    }
}
