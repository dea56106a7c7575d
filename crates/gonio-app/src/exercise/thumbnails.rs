//! Small pictures of the goals of exercises about shaders, for the list.

use super::preview::paint;
use crate::scene_view::drawing::PaneRenderer;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::{self, CompiledPair, Eye, PreviewRenderer, SubmittedPair};
use gonio_gl::{Gl, GlError};
use gonio_render::{DisplayTexture, Presentation};
use std::collections::BTreeMap;

/// The field of view, as a share of the scene's own.
const ZOOM: f32 = 0.72;

/// The pictures that were drawn, in one OpenGL context.
pub struct Thumbnails {
    gl: Gl,
    renderer: PreviewRenderer,
    sky: Option<CompiledPair>,
    /// By the exercise's id; `None` for an exercise without a picture.
    drawn: BTreeMap<String, Option<DisplayTexture>>,
}

impl Thumbnails {
    /// Creates an empty set in the window's context.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let compiled = |pair: Result<SubmittedPair, String>| pair.ok().and_then(|pair| pair.compile(gl).ok());
        let sky = compiled(preview::sky());
        Ok(Thumbnails { gl: gl.clone(), renderer: PreviewRenderer::new(gl)?, sky, drawn: BTreeMap::new() })
    }

    /// Whether the exercise's picture was drawn, or there is none.
    pub fn is_done(&self, exercise: &Exercise) -> bool {
        self.drawn.contains_key(&exercise.id)
    }

    /// Draws the picture of the right answer in the exercise's first scene; `size` in pixels.
    pub fn draw(&mut self, exercise: &Exercise, size: [u32; 2], panes: &mut PaneRenderer) -> Result<(), GlError> {
        let drawn = self.drawing(exercise, size, panes);
        let (texture, result) = match drawn {
            Ok(texture) => (texture, Ok(())),
            Err(error) => (None, Err(error)),
        };
        // One that cannot be drawn is not tried in every frame.
        self.drawn.insert(exercise.id.clone(), texture);
        result
    }

    fn drawing(
        &self,
        exercise: &Exercise,
        size: [u32; 2],
        panes: &mut PaneRenderer,
    ) -> Result<Option<DisplayTexture>, GlError> {
        if !preview::is_drawn(exercise) {
            return Ok(None);
        }
        let pair = preview::reference(exercise).ok().and_then(|pair| pair.compile(&self.gl).ok());
        let (Some(pair), Some(scene)) = (pair, preview::scenes(exercise).into_iter().next()) else { return Ok(None) };
        self.renderer.prepare(&scene)?;
        // Objects fill more of a small picture than of a large one.
        let zoom = if scene.looks_around { 1.0 } else { ZOOM };
        let eye = Eye { fov_rad: scene.eye.fov_rad * zoom, ..scene.eye };
        let objects = scene.test_scenes(&eye, 0.0, size);
        let mut texture = DisplayTexture::new(&self.gl, size)?;
        let sky = self.sky.as_ref().filter(|_| scene.has_sky);
        paint(&self.renderer, &pair, sky, &objects, &mut texture, size, panes)?;
        Ok(Some(texture))
    }

    /// The exercise's picture, if it has one and it was drawn.
    pub fn picture(&self, exercise: &Exercise, panes: &PaneRenderer) -> Option<Presentation> {
        self.drawn.get(&exercise.id)?.as_ref().map(|texture| panes.presented(texture))
    }
}
