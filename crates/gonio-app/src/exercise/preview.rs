//! The pictures of the student's pair and of the correct answer, drawn when something changes.

use super::work::{PictureMode, Work};
use crate::scene_view::drawing::PaneRenderer;
use crate::step::source::DrawnProgram;
use gonio_check::submission::SourceFile;
use gonio_check::testbench::TestScene;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::{self, CompiledPair, Eye, Note, PreviewRenderer, PreviewShape, SubmittedPair};
use gonio_gl::{Gl, GlError};
use gonio_render::{DifferenceScale, DisplayTexture, Presentation};
use std::sync::Arc;

/// Background colour, a dark grey as in the lab's programs.
const BACKGROUND: [f32; 3] = [0.13, 0.14, 0.16];
/// 8-bit steps that get the last colour of the map of differences.
const FULL_SCALE: f64 = 48.0;

/// One of the pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PreviewPicture {
    /// The student's picture.
    Yours = 0,
    /// The picture of the correct answer.
    Reference = 1,
    /// The difference of both.
    Difference = 2,
}

impl PreviewPicture {
    /// A stable name for programs.
    pub const fn id(self) -> &'static str {
        match self {
            PreviewPicture::Yours => "yours",
            PreviewPicture::Reference => "reference",
            PreviewPicture::Difference => "difference",
        }
    }
}

/// Everything that a picture depends on.
type Drawn = ([u32; 2], Vec<(PreviewShape, TestScene)>, u64);

/// The GPU resources of an exercise, which follow from the work and its sources.
pub struct Preview {
    gl: Gl,
    stage: PreviewRenderer,
    pairs: [Option<CompiledPair>; 2],
    program: Option<Arc<DrawnProgram>>,
    sky: Option<CompiledPair>,
    canvases: [Option<DisplayTexture>; 3],
    drawn: [Option<Drawn>; 2],
    /// Counts programs that were compiled.
    serial: u64,
    /// Number of pictures drawn.
    pub pictures: u64,
}

impl Preview {
    /// Creates the preview of an exercise in the window's context.
    pub fn new(gl: &Gl, work: &Work) -> Result<Self, GlError> {
        let stage = PreviewRenderer::new(gl)?;
        let compiled = |source: Result<SubmittedPair, String>| source.ok().and_then(|source| source.compile(gl).ok());
        let reference =
            if preview::is_drawn(work.exercise) { compiled(preview::reference(work.exercise)) } else { None };
        let has_sky = work.scenes.iter().any(|scene| scene.has_sky);
        let sky = if has_sky { compiled(preview::sky()) } else { None };
        let none = || None;
        Ok(Preview {
            gl: gl.clone(),
            stage,
            pairs: [None, reference],
            program: None,
            sky,
            canvases: [none(), none(), none()],
            drawn: [None, None],
            serial: 0,
            pictures: 0,
        })
    }

    /// Compiles the student's pair. If it compiles, it is drawn from now on; otherwise the previous pair is.
    pub fn compile(
        &mut self,
        exercise: &'static Exercise,
        source: SubmittedPair,
        content: &[SourceFile],
    ) -> Result<&CompiledPair, Vec<Note>> {
        let pair = source.compile(&self.gl)?;
        self.serial += 1;
        let bindings = pair.bindings.clone();
        self.program = Some(Arc::new(DrawnProgram { exercise, content: content.to_vec(), source, bindings }));
        Ok(self.pairs[0].insert(pair))
    }

    /// The student's pair that is drawn, if any.
    pub fn pair(&self) -> Option<&CompiledPair> {
        self.pairs[0].as_ref()
    }

    /// The student's program that is drawn, if any.
    pub fn program(&self) -> Option<&Arc<DrawnProgram>> {
        self.program.as_ref()
    }

    /// Whether there is a picture of the correct answer.
    pub fn has_reference(&self) -> bool {
        self.pairs[1].is_some()
    }

    /// One of the pictures for a paint callback, drawn if anything changed; `None` if there is none.
    pub fn picture(
        &mut self,
        picture: PreviewPicture,
        work: &Work,
        size: [u32; 2],
        pane_renderer: &mut PaneRenderer,
    ) -> Result<Option<Presentation>, GlError> {
        if size.contains(&0) {
            return Ok(None);
        }
        if picture != PreviewPicture::Difference {
            self.draw(picture as usize, work, size, pane_renderer)?;
            return Ok(self.presented(picture, pane_renderer));
        }
        for which in [PreviewPicture::Yours, PreviewPicture::Reference] {
            self.draw(which as usize, work, size, pane_renderer)?;
        }
        let [Some(yours), Some(reference), map] = &mut self.canvases else { return Ok(None) };
        let map = match map {
            Some(map) => map,
            none => none.insert(DisplayTexture::new(&self.gl, size)?),
        };
        let scale = DifferenceScale { full_scale: FULL_SCALE, signed: false };
        pane_renderer.renderer().paint_difference(yours, reference, scale, map)?;
        Ok(self.presented(picture, pane_renderer))
    }

    fn presented(&self, picture: PreviewPicture, pane_renderer: &PaneRenderer) -> Option<Presentation> {
        let canvas = self.canvases.get(picture as usize)?.as_ref()?;
        Some(pane_renderer.presented(canvas))
    }

    fn draw(
        &mut self,
        which: usize,
        work: &Work,
        size: [u32; 2],
        pane_renderer: &mut PaneRenderer,
    ) -> Result<(), GlError> {
        let (Some(scene), Some(pair)) = (work.scene(), self.pairs[which].as_ref()) else { return Ok(()) };
        let bodies = situations(work, size);
        let requested = (size, bodies, if which == 0 { self.serial } else { 0 });
        if self.drawn[which].as_ref() == Some(&requested) {
            return Ok(());
        }
        let (_, bodies, _) = &requested;
        self.stage.prepare(scene)?;
        let canvas = match &mut self.canvases[which] {
            Some(canvas) => canvas,
            none => none.insert(DisplayTexture::new(&self.gl, size)?),
        };
        let sky = self.sky.as_ref().filter(|_| scene.has_sky);
        paint(&self.stage, pair, sky, bodies, canvas, size, pane_renderer)?;
        self.pictures += 1;
        self.drawn[which] = Some(requested);
        Ok(())
    }

    /// The pixels of a picture as last drawn: RGBA, the top row first; and its width and height. Waits for the GPU.
    pub fn pixels(&self, picture: PreviewPicture) -> Option<(Vec<u8>, [u32; 2])> {
        let canvas = self.canvases.get(picture as usize)?.as_ref()?;
        Some((canvas.read8(), canvas.size()))
    }
}

/// Paints a prepared scene with a program, in front of the sky if there is one.
pub fn paint(
    stage: &PreviewRenderer,
    pair: &CompiledPair,
    sky: Option<&CompiledPair>,
    objects: &[(PreviewShape, TestScene)],
    canvas: &mut DisplayTexture,
    size: [u32; 2],
    panes: &mut PaneRenderer,
) -> Result<(), GlError> {
    panes.renderer().paint_user_program(canvas, size, BACKGROUND, || {
        if let (Some(sky), Some((_, first))) = (sky, objects.first()) {
            stage.draw(sky, &[(PreviewShape::Cube, first.clone())]);
        }
        stage.draw(pair, objects);
    })
}

/// The inputs of programs for each body of the scene at this moment.
pub fn situations(work: &Work, size: [u32; 2]) -> Vec<(PreviewShape, TestScene)> {
    let Some(scene) = work.scene() else { return Vec::new() };
    let camera = work.camera.to_camera();
    let target = work.camera.target().map_or(camera.position + camera.front, glam::DVec3::from);
    let eye = Eye {
        position: camera.position.as_vec3(),
        target: target.as_vec3(),
        up: camera.up.as_vec3(),
        fov_rad: scene.eye.fov_rad,
    };
    let mut objects = scene.test_scenes(&eye, work.clock.time as f32, size);
    for (_, values) in objects.iter_mut().filter(|_| scene.has_lamp) {
        values.light.position += work.lamp_offset;
    }
    objects
}

impl PictureMode {
    /// The pictures that are shown side by side.
    pub fn pictures(self) -> &'static [PreviewPicture] {
        match self {
            PictureMode::Yours => &[PreviewPicture::Yours],
            PictureMode::Reference => &[PreviewPicture::Reference],
            PictureMode::Both => &[PreviewPicture::Yours, PreviewPicture::Reference],
            PictureMode::Difference => &[PreviewPicture::Difference],
        }
    }
}
