//! The ground below the objects of a pane: an aid on a texture of its own over the picture. What reads the picture (saving, the
//! difference of panes, the probe, a recorded frame) never sees it.

use super::PaneRenderer;
use super::pane::PaneDrawing;
use crate::session::Session;
use crate::theme::colors;
use glam::DVec3;
use gonio_gl::{Gl, GlError};
use gonio_render::{DisplayTexture, GroundLook, Presentation, Renderer};
use gonio_scene::{Camera, Frame, GroundPlane, Scene};
use std::sync::Arc;

/// Linear background above which lines are dark.
const BRIGHT: f64 = 0.42;
/// Opacity of strong lines.
const LINES: f32 = 0.28;

/// The ground of one pane.
#[derive(Default)]
pub struct GroundDrawing {
    /// The plane, and the scene and the direction up that it is of.
    plane: Option<(Arc<Scene>, DVec3, Option<GroundPlane>)>,
    pub layer: Option<DisplayTexture>,
    drawn: Option<Drawn>,
    /// Counts the layers that were drawn.
    pub serial: u64,
}

/// The input of the layer as drawn last.
#[derive(Clone, PartialEq)]
struct Drawn {
    size: [u32; 2],
    samples: u32,
    camera: Camera,
    look: GroundLook,
    /// Address of the uploaded scene, which [`GroundDrawing::plane`] keeps alive.
    scene: usize,
}

impl GroundDrawing {
    fn plane(&mut self, scene: &Arc<Scene>, up: DVec3) -> Option<GroundPlane> {
        match &self.plane {
            Some((of, known, plane)) if Arc::ptr_eq(of, scene) && *known == up => *plane,
            _ => {
                let plane = GroundPlane::below(scene, up);
                self.plane = Some((scene.clone(), up, plane));
                plane
            }
        }
    }
}

impl PaneDrawing {
    /// The texture with the ground below the picture as last drawn; `None` if there is nothing to show.
    fn ground(&mut self, gl: &Gl, renderer: &mut Renderer, dark: bool) -> Result<Option<&DisplayTexture>, GlError> {
        if self.is_users() || self.traced.is_some() {
            return Ok(None);
        }
        let (Some((scene, uploaded)), Some((frame, show))) = (&self.uploaded, &self.drawn) else { return Ok(None) };
        let up = self.loaded.as_ref().map_or(DVec3::Y, |loaded| loaded.settings.camera.up.into());
        let plane = self.ground.plane(scene, up).filter(|plane| plane.is_seen_from(frame.camera.position));
        let Some(plane) = plane.filter(|_| show.view == gonio_render::View::Picture) else { return Ok(None) };
        let look = look(frame, dark);
        let drawn = Drawn {
            size: [frame.width, frame.height],
            samples: frame.samples,
            camera: frame.camera,
            look,
            scene: Arc::as_ptr(scene) as usize,
        };
        let layer = match &mut self.ground.layer {
            Some(layer) => layer,
            none => none.insert(DisplayTexture::new(gl, drawn.size)?),
        };
        if self.ground.drawn.as_ref() != Some(&drawn) {
            renderer.paint_ground(uploaded, frame, &plane, &look, layer)?;
            self.ground.drawn = Some(drawn);
            self.ground.serial += 1;
        }
        Ok(self.ground.layer.as_ref())
    }
}

impl PaneRenderer {
    /// The ground below a pane's objects, to be shown over its picture. `None` if it is switched off or does not help: where an
    /// object is a floor, seen from below, over a debug view, and over pictures that have other light or other vertices (a traced
    /// one, or one of the user's shaders). `dark` is the theme, for pictures without a background.
    pub fn ground(&mut self, index: usize, session: &Session, dark: bool) -> Result<Option<Presentation>, GlError> {
        let pane = self.panes.get_mut(index).filter(|_| !session.settings.hides_ground);
        let Some(pane) = pane else { return Ok(None) };
        let layer = pane.ground(&self.gl, &mut self.renderer, dark)?;
        Ok(layer.map(|layer| self.presenter.presentation(layer.texture())))
    }
}

/// Lines that are seen on the frame's background. Without shadows of the equation there is a contact shadow.
fn look(frame: &Frame, dark: bool) -> GroundLook {
    let shows_environment = frame.surroundings.is_some_and(|around| around.visible);
    let background = frame.background.bottom.dot(DVec3::new(0.2126, 0.7152, 0.0722));
    let is_bright = match (shows_environment, frame.background.transparent) {
        (true, _) => false,
        (false, true) => !dark,
        (false, false) => background * frame.output.exposure.exp2() > BRIGHT,
    };
    let [r, g, b] = if is_bright { [0.0; 3] } else { [1.0; 3] };
    let axis = |tint: colors::Tint| {
        let [r, g, b, _] = tint.in_theme(!is_bright).to_normalized_gamma_f32();
        [r, g, b]
    };
    GroundLook {
        line_color: [r, g, b, LINES],
        axis_colors: [colors::AXIS_X, colors::AXIS_Y, colors::AXIS_Z].map(axis),
        contact_shadow: !frame.shadows,
    }
}
