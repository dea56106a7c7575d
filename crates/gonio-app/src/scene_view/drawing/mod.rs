//! The pictures of the panes: drawn by `gonio-render` into textures, only when something changed.
//!
//! Everything on the GPU follows from document and session: after a lost context a new [`PaneRenderer`] draws the same.

mod comparison;
mod details;
mod ground;
mod outline;
mod pane;
#[cfg(test)]
mod tests;

use crate::document::Document;
use crate::saving::DisplayedPicture;
use crate::session::{FrameFacts, OwnShaders, Session, Tab};
use comparison::{CurveRun, PairDrawing};
use details::Details;
use gonio_gl::trace::FrameRecord;
use gonio_gl::{Gl, GlError};
use gonio_light::color::ColorEncoding;
use gonio_render::{DisplayOptions, DisplayTexture, Presentation, Presenter, Renderer, View};
use gonio_scene::{Camera, Frame, Picture, Scene};
use pane::PaneDrawing;
use std::sync::Arc;

/// Draws the panes with the window's own context.
pub struct PaneRenderer {
    gl: Gl,
    renderer: Renderer,
    presenter: Presenter,
    panes: Vec<PaneDrawing>,
    pair: PairDrawing,
    details: Details,
    curve: Option<CurveRun>,
    observer: Option<ObserverPicture>,
}

impl PaneRenderer {
    /// Creates the renderer for the window's context, which must be current.
    pub fn new(gl: Gl) -> Result<Self, GlError> {
        let renderer = Renderer::new(gl.clone())?;
        let presenter = Presenter::new(&gl)?;
        Ok(PaneRenderer {
            gl,
            renderer,
            presenter,
            panes: Vec::new(),
            pair: PairDrawing::default(),
            details: Details::default(),
            curve: None,
            observer: None,
        })
    }

    /// The renderer, which also draws students' programs.
    pub fn renderer(&mut self) -> &mut Renderer {
        &mut self.renderer
    }

    /// The window's OpenGL.
    pub fn gl(&self) -> &Gl {
        &self.gl
    }

    /// An opaque canvas, for a paint callback.
    pub fn presented(&self, canvas: &DisplayTexture) -> Presentation {
        self.presenter.presentation(canvas.texture()).opaque()
    }

    /// The name of the driver.
    pub fn driver(&self) -> &str {
        &self.renderer.info().renderer
    }

    /// Whether first pictures are sketches: with software drivers only.
    pub fn sketches(&self) -> bool {
        self.renderer.info().is_software()
    }

    /// The scene of a pane as last drawn.
    pub fn loaded(&self, pane: usize) -> Option<&Arc<Scene>> {
        self.panes.get(pane)?.loaded.as_ref()
    }

    /// The frame of a pane as last drawn.
    pub fn frame(&self, pane: usize) -> Option<&Frame> {
        self.panes.get(pane)?.drawn.as_ref().map(|(frame, _)| frame)
    }

    /// Whether the user's own shaders have drawn a pane.
    pub fn is_users(&self, pane: usize) -> bool {
        self.panes.get(pane).is_some_and(PaneDrawing::is_users)
    }

    /// Whether a pane's picture, as last drawn, hides everything below it.
    pub fn is_opaque(&self, pane: usize) -> bool {
        self.panes.get(pane).is_some_and(PaneDrawing::is_opaque)
    }

    /// The displayed pixels of a pane, four bytes each, the top row first, and its width and height; `None` if nothing was drawn
    /// yet. Waits for the GPU.
    pub fn pixels(&self, pane: usize) -> Option<(Vec<u8>, [u32; 2])> {
        let canvas = self.panes.get(pane)?.canvas.as_ref()?;
        Some((canvas.read8(), canvas.size()))
    }

    /// Records the OpenGL calls of a pane's picture as last drawn, with thumbnails of all textures. `None` if nothing was drawn.
    pub fn record(&mut self, pane: usize) -> Result<Option<FrameRecord>, GlError> {
        let Some(pane) = self.panes.get(pane) else { return Ok(None) };
        let (Some((_, uploaded)), Some((frame, show))) = (&pane.uploaded, &pane.drawn) else { return Ok(None) };
        // A special view is recorded as the normal picture.
        let view = if let View::Quantity(view) = show.view { Some(view) } else { None };
        self.renderer.record_with_thumbnails(uploaded, frame, view).map(Some)
    }

    /// Returns a function that draws a pane's picture by OpenGL as it was drawn last, into a canvas of its own, and waits for the
    /// GPU. `None` if nothing was drawn. In place of a traced picture it draws OpenGL's.
    pub fn redraw<'a>(
        &'a mut self,
        index: usize,
        shaders: Option<&'a OwnShaders>,
    ) -> Result<Option<impl FnMut() -> Result<(), GlError>>, GlError> {
        let Some(pane) = self.panes.get(index) else { return Ok(None) };
        let Some((loaded, uploaded, frame, show)) = pane.to_save(None) else { return Ok(None) };
        let mut canvas = DisplayTexture::new(&self.gl, [frame.width, frame.height])?;
        let renderer = &mut self.renderer;
        Ok(Some(move || {
            pane::paint(renderer, shaders, (loaded, uploaded), &frame, &show, &mut canvas)?;
            canvas.wait();
            Ok(())
        }))
    }

    /// Prepares a frame: keeps the first `panes` panes, and takes meshes that were simplified in a thread. `ctx` is repainted when
    /// another one is finished.
    pub fn begin(&mut self, ctx: &egui::Context, panes: usize) {
        self.panes.truncate(panes);
        self.details.begin(ctx);
    }

    /// The picture of a pane, `size` pixels, for a paint callback. It is drawn only if something has changed.
    ///
    /// While something moves ([`Session::moving`]) the call does not wait for the GPU, and if the panes were slow to draw last
    /// time, they are drawn with one sample per pixel until nothing moves. The first pictures of a scene are drawn in the same
    /// way while it is sketched ([`Session::sketching`]).
    pub fn picture(
        &mut self,
        index: usize,
        document: &Document,
        session: &Session,
        size: [u32; 2],
        facts: &mut FrameFacts,
    ) -> Result<Option<Presentation>, GlError> {
        let (Some(base), Some(settings)) = (&session.loaded, document.panes.list.get(index)) else { return Ok(None) };
        if size.contains(&0) {
            return Ok(None);
        }
        while self.panes.len() <= index {
            self.panes.push(PaneDrawing::default());
        }
        let all_ms: f64 = self.panes.iter().map(|pane| pane.facts.ms).sum();
        let pace = pane::Pace {
            moving: session.moving || session.sketching,
            reduced: session.adaptive && (session.sketching || all_ms > pane::SLOW_MS),
            counted: session.tab == Tab::Compare,
            shaders: session.shaders.as_ref(),
        };
        let pane = &mut self.panes[index];
        let time = session.clock.time;
        pane.follow_bake(&session.baking, settings);
        pane.follow(&mut self.renderer, &mut self.details, base, session.generation, settings, time)?;
        let traced = settings.truth.and_then(|_| session.traced.get(index));
        // OpenGL's picture stands in until there is a traced one.
        match traced.and_then(|traced| Some((traced.serial, traced.picture.as_ref()?))) {
            Some(traced) => pane.show_traced(&self.gl, &mut self.renderer, traced, time, size, facts)?,
            None => pane.draw(&self.gl, &mut self.renderer, time, size, pace, facts)?,
        }
        let picture = pane.canvas.as_ref().map(|canvas| self.presenter.presentation(canvas.texture()));
        Ok(picture.map(|picture| if pane.is_opaque() { picture.opaque() } else { picture }))
    }

    /// The difference map of the pair of panes, which were drawn before in this frame. Its statistics are stored in `session`
    /// when nothing moves. `None` until both pictures have the same size.
    pub fn difference(&mut self, document: &Document, session: &mut Session) -> Result<Option<Presentation>, GlError> {
        let [first, second] = document.panes.pair;
        let (Some(a), Some(b)) = (self.panes.get(first), self.panes.get(second)) else { return Ok(None) };
        // OpenGL's picture that stands in for a traced one would be compared with itself.
        let waits = |index: usize, pane: &PaneDrawing| {
            pane.traced.is_none() && document.panes.list.get(index).is_some_and(|pane| pane.truth.is_some())
        };
        if waits(first, a) || waits(second, b) {
            session.comparison.difference = None;
            return Ok(None);
        }
        let settings = document.panes.difference;
        let drawn = self.pair.draw(&self.gl, &mut self.renderer, [a, b], document.panes.pair, settings)?;
        if !drawn {
            session.comparison.difference = None;
            return Ok(None);
        }
        if !session.moving {
            session.comparison.difference = self.pair.measured([a, b], document.panes.pair);
        }
        Ok(self.pair.map.as_ref().map(|map| self.presenter.presentation(map.texture())))
    }

    /// Stores the measurements of the panes in the session, and draws the next picture of the error curve if it is running.
    /// Returns whether there is more to do in the next frame.
    pub fn measure(&mut self, document: &Document, session: &mut Session) -> Result<bool, GlError> {
        let facts: Vec<_> = self.panes.iter().map(|pane| pane.facts.clone()).collect();
        if session.comparison.panes != facts {
            session.comparison.panes = facts;
        }
        if !session.comparison.curve.running {
            self.curve = None;
            return Ok(false);
        }
        let run = match self.curve.take() {
            Some(run) => Some(run),
            None => CurveRun::new(document, session, self.frame(document.panes.current)),
        };
        let Some(mut run) = run else {
            session.comparison.curve.running = false;
            return Ok(false);
        };
        let before = session.comparison.curve.progress;
        let more = run.step(&self.gl, &mut self.renderer, &mut self.details, &mut session.comparison.curve)?;
        session.comparison.curve.running = more;
        if more {
            self.curve = Some(run);
        }
        // A mesh that is created in a thread repaints the window when it is finished.
        Ok(more && session.comparison.curve.progress != before)
    }
}

/// The observer's picture, and the frame that it shows.
struct ObserverPicture {
    canvas: DisplayTexture,
    drawn: Option<(Frame, Arc<Scene>)>,
}

impl PaneRenderer {
    /// The value that OpenGL draws at a pixel of a pane's picture with one sample: linear, premultiplied RGBA. `None` if nothing
    /// was drawn yet, or the value cannot be read.
    pub fn pixel(&mut self, pane: usize, x: u32, y: u32) -> Option<[f32; 4]> {
        let pane = self.panes.get(pane)?;
        let ((_, uploaded), (frame, _)) = (pane.uploaded.as_ref()?, pane.drawn.as_ref()?);
        self.renderer.pixel(uploaded, frame, x, y).ok()
    }

    /// A pane's scene from another camera, `size` pixels; drawn if anything changed.
    pub fn seen_by(&mut self, pane: usize, camera: Camera, size: [u32; 2]) -> Result<Option<Presentation>, GlError> {
        let Some(pane) = self.panes.get(pane) else { return Ok(None) };
        let (Some((_, uploaded)), Some((frame, _)), Some(loaded)) = (&pane.uploaded, &pane.drawn, &pane.loaded) else {
            return Ok(None);
        };
        let [width, height] = size;
        let requested = Frame { width, height, camera, ..frame.clone() };
        let observer = match &mut self.observer {
            Some(kept) => kept,
            none => none.insert(ObserverPicture { canvas: DisplayTexture::new(&self.gl, size)?, drawn: None }),
        };
        let is_drawn = |(frame, of): &(Frame, Arc<Scene>)| *frame == requested && Arc::ptr_eq(of, loaded);
        if !observer.drawn.as_ref().is_some_and(is_drawn) {
            self.renderer.paint(uploaded, &requested, &DisplayOptions::default(), &mut observer.canvas)?;
            observer.drawn = Some((requested, loaded.clone()));
        }
        Ok(Some(self.presenter.presentation(observer.canvas.texture())))
    }
}

impl PaneRenderer {
    /// The picture as displayed; `None` if the pane has not been drawn. Waits for the GPU. A traced picture of another size is
    /// stretched.
    pub fn shown(
        &mut self,
        index: usize,
        size: Option<[u32; 2]>,
        shaders: Option<&OwnShaders>,
    ) -> Result<Option<DisplayedPicture>, GlError> {
        let Some(pane) = self.panes.get(index) else { return Ok(None) };
        let Some((loaded, uploaded, frame, show)) = pane.to_save(size) else { return Ok(None) };
        let mut canvas = DisplayTexture::new(&self.gl, [frame.width, frame.height])?;
        match &pane.traced {
            Some((_, picture)) => self.renderer.paint_picture(picture, &frame, &mut canvas)?,
            None => {
                pane::paint(&mut self.renderer, shaders, (loaded, uploaded), &frame, &show, &mut canvas)?;
            }
        }
        let is_srgb = show.view == View::Picture && frame.output.encoding == ColorEncoding::Srgb;
        Ok(Some(DisplayedPicture { size: canvas.size(), rgba: canvas.read8(), is_srgb }))
    }

    /// The light, linear and premultiplied: the values of the quantity shown, or else those of the picture. `None` if the pane has
    /// not been drawn. Waits for the GPU. A traced picture has the size that it was traced in.
    pub fn light(&mut self, index: usize, size: Option<[u32; 2]>) -> Result<Option<Picture>, GlError> {
        let Some(pane) = self.panes.get(index) else { return Ok(None) };
        if let Some((_, picture)) = &pane.traced {
            return Ok(Some(Picture::clone(picture)));
        }
        let Some((_, uploaded, frame, show)) = pane.to_save(size) else { return Ok(None) };
        let view = if let View::Quantity(view) = show.view { Some(view) } else { None };
        self.renderer.paint_linear(uploaded, &frame, view).map(Some)
    }
}
