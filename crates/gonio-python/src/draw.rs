//! DrawnPictures by OpenGL, on the thread of the context.

use crate::error::Failure;
use gonio_gl::HeadlessContext;
use gonio_render::{GpuScene, Renderer};
use gonio_scene::{Frame, Picture, Scene, ViewSpec};
use std::sync::Arc;

/// Scenes that stay on the GPU; of more, the one that was drawn longest ago leaves it.
const MOST_SCENES: usize = 8;

/// The context with its renderer, and the scenes that were drawn.
#[derive(Default)]
pub struct GlDrawer {
    // The order matters: objects are freed while the context exists.
    scenes: Vec<KeptScene>,
    opened: Option<Result<Open, Failure>>,
}

struct Open {
    renderer: Renderer,
    _context: HeadlessContext,
}

struct KeptScene {
    scene: u64,
    /// Its moment in seconds, by its bits.
    time: u64,
    gpu: GpuScene,
}

/// What is drawn: a scene at one moment.
#[derive(Clone)]
pub struct Drawn {
    /// Its number.
    pub number: u64,
    /// With its objects where they are at time 0.
    pub scene: Arc<Scene>,
    /// The frame.
    pub frame: Frame,
    /// The picture (`None`) and quantities.
    pub views: Vec<Option<ViewSpec>>,
}

/// DrawnPictures, and the notes about what could not be drawn exactly.
pub struct DrawnPictures {
    /// One for each view.
    pub pictures: Vec<Picture>,
    /// Sentences.
    pub notes: Vec<String>,
}

impl GlDrawer {
    /// Opens the context, once. The error is why it cannot draw pictures of this size.
    pub fn open_for(&mut self, width: u32, height: u32) -> Result<(), Failure> {
        let opened = self.opened.get_or_insert_with(|| {
            let context = HeadlessContext::new()?;
            Ok(Open { renderer: Renderer::new(context.gl().clone())?, _context: context })
        });
        match opened {
            Ok(open) if width.max(height) > open.renderer.info().max_size => {
                let most = open.renderer.info().max_size;
                Err(Failure(format!("this driver draws at most {most} pixels along a side")))
            }
            Ok(_) => Ok(()),
            Err(failure) => Err(failure.clone()),
        }
    }

    /// The driver's name.
    pub fn driver(&self) -> String {
        match &self.opened {
            Some(Ok(open)) => open.renderer.info().renderer.clone(),
            _ => String::new(),
        }
    }

    /// Draws all views.
    pub fn draw(&mut self, drawn: &Drawn) -> Result<DrawnPictures, Failure> {
        let Some(Ok(open)) = &mut self.opened else {
            return Err(Failure::new("there is no OpenGL context"));
        };
        let time = drawn.frame.time.to_bits();
        let at = self.scenes.iter().position(|kept| kept.scene == drawn.number && kept.time == time);
        let kept = match at {
            Some(at) => self.scenes.remove(at),
            None => {
                KeptScene { scene: drawn.number, time, gpu: open.renderer.upload(&drawn.scene.at(drawn.frame.time))? }
            }
        };
        // Another moment of the same scene is not drawn again, as a rule.
        self.scenes.retain(|other| other.scene != drawn.number);
        let mut result = DrawnPictures { pictures: Vec::with_capacity(drawn.views.len()), notes: Vec::new() };
        for &view in &drawn.views {
            let rendered = open.renderer.render(&kept.gpu, &drawn.frame, view)?;
            for note in &rendered.notes {
                if !result.notes.contains(note) {
                    result.notes.push(note.clone());
                }
            }
            result.pictures.push(rendered.linear()?);
        }
        if self.scenes.len() >= MOST_SCENES {
            self.scenes.remove(0);
        }
        self.scenes.push(kept);
        Ok(result)
    }

    /// Frees a scene.
    pub fn forget(&mut self, number: u64) {
        self.scenes.retain(|kept| kept.scene != number);
    }
}
