//! One pane's scene, its GPU data and its picture.

use super::details::Details;
use super::ground::GroundDrawing;
use super::outline::OutlineDrawing;
use crate::baking::{AtlasBackground, BakedResult, Baking};
use crate::document::{BakedLook, Pane};
use crate::session::comparison::PaneFacts;
use crate::session::{FrameFacts, OwnShaders};
use gonio_gl::{Gl, GlError, GpuStatistics};
use gonio_mesh::Mesh;
use gonio_render::{DisplayOptions, DisplayTexture, GpuScene, Painted, Renderer, View, wants_unshared};
use gonio_scene::edit::{self, Edited};
use gonio_scene::{Frame, Picture, Scene, detail};
use std::sync::Arc;

/// Above this time for all panes, in milliseconds, a drag is not smooth: fewer than 20 pictures per second.
pub const SLOW_MS: f64 = 50.0;

/// Speed and detail of drawing, and by what.
#[derive(Clone, Copy)]
pub struct Pace<'a> {
    /// Something is being dragged, or time runs: drawing does not wait for the GPU.
    pub moving: bool,
    /// Pictures have one sample while something moves.
    pub reduced: bool,
    /// Fragments are counted, even if that needs another picture.
    pub counted: bool,
    /// The user's shaders, if there are any.
    pub shaders: Option<&'a OwnShaders>,
}

/// State of one pane between pictures.
#[derive(Default)]
pub struct PaneDrawing {
    /// The document's scene that `loaded` is derived from.
    from: Option<Arc<Scene>>,
    generation: u64,
    settings: Pane,
    /// Seconds; counts only where objects move.
    time: f64,
    pub loaded: Option<Arc<Scene>>,
    /// The baked textures on the model.
    bake: Option<ShownBake>,
    /// Meshes at the pane's level of detail, with the generation of their scene; shown while others are created.
    detailed: Option<(u64, Vec<Arc<Mesh>>)>,
    pub uploaded: Option<(Arc<Scene>, GpuScene)>,
    pub canvas: Option<DisplayTexture>,
    /// The frame on the canvas.
    pub drawn: Option<(Frame, DisplayOptions)>,
    /// Whether that is only sketched ([`Renderer::paint_sketch`]).
    sketched: bool,
    /// The traced picture on the canvas, with its number ([`crate::truth::TracedPane::serial`]); `None` if OpenGL's is there.
    pub traced: Option<(u64, Arc<Picture>)>,
    /// [`OwnShaders::serial`] of the shaders that drew the canvas; `None` for gonio's.
    shaders: Option<u64>,
    /// The ground below the objects.
    pub ground: GroundDrawing,
    /// The outline of the selected part.
    pub outline: OutlineDrawing,
    /// Counts the pictures.
    pub serial: u64,
    pub facts: PaneFacts,
}

/// A baked atlas on the model.
#[derive(Clone)]
struct ShownBake {
    result: Arc<BakedResult>,
    look: BakedLook,
    /// The picture, for [`BakedLook::Picture`].
    background: AtlasBackground,
}

impl ShownBake {
    fn is_same(&self, other: &ShownBake) -> bool {
        let is_same_picture = self.look == BakedLook::Materials || self.background == other.background;
        Arc::ptr_eq(&self.result, &other.result) && self.look == other.look && is_same_picture
    }
}

impl PaneDrawing {
    /// Takes over the baked textures that the pane's settings ask for.
    pub fn follow_bake(&mut self, baking: &Baking, settings: &Pane) {
        let shown = settings.baked.zip(baking.result()).map(|(look, result)| ShownBake {
            result: result.clone(),
            look,
            background: baking.view.background,
        });
        let is_same = match (&self.bake, &shown) {
            (None, None) => true,
            (Some(before), Some(now)) => before.is_same(now),
            _ => false,
        };
        if !is_same {
            (self.bake, self.uploaded) = (shown, None);
        }
    }

    /// Updates the pane's scene to the document's at `time`, with the pane's settings. GPU data are kept unless geometry or
    /// materials changed, so that moving a light uploads nothing. An object that moves gets another matrix.
    pub fn follow(
        &mut self,
        renderer: &mut Renderer,
        details: &mut Details,
        base: &Arc<Scene>,
        generation: u64,
        settings: &Pane,
        time: f64,
    ) -> Result<(), GlError> {
        let same_base = self.from.as_ref().is_some_and(|from| Arc::ptr_eq(from, base));
        let same_places = self.time == time || !base.has_moving_objects();
        if same_base && same_places && self.settings == *settings && self.uploaded.is_some() && !self.facts.preparing {
            return Ok(());
        }
        let loaded = with_settings(base, settings);
        let baked = self.bake.as_ref().and_then(|bake| bake.result.scene(&loaded, bake.look, bake.background));
        let loaded = baked.map_or(loaded, Arc::new);
        let loaded = at_time(self.with_detail(loaded, details, generation, settings), time);
        let known = self.uploaded.as_ref().filter(|_| self.generation == generation);
        if !known.is_some_and(|(uploaded, _)| is_same_on_gpu(uploaded, &loaded)) {
            self.uploaded = Some((loaded.clone(), renderer.upload(&loaded)?));
            self.drawn = None;
        }
        self.facts.triangles = triangles(&loaded);
        self.loaded = Some(loaded);
        self.from = Some(base.clone());
        self.generation = generation;
        self.settings = settings.clone();
        self.time = time;
        Ok(())
    }

    /// The scene at the pane's level of detail, or at the last one while another is created.
    fn with_detail(
        &mut self,
        loaded: Arc<Scene>,
        details: &mut Details,
        generation: u64,
        settings: &Pane,
    ) -> Arc<Scene> {
        self.facts.preparing = false;
        let Some(requested) = settings.detail else {
            self.detailed = None;
            return loaded;
        };
        match details.meshes(&loaded, requested) {
            Some(meshes) => self.detailed = Some((generation, meshes)),
            None => self.facts.preparing = true,
        }
        match &self.detailed {
            Some((of, meshes)) if *of == generation => Arc::new(detail::with_meshes(&loaded, meshes)),
            _ => loaded,
        }
    }

    /// Whether the picture, as last drawn, has no holes. Debug views may have some.
    pub fn is_opaque(&self) -> bool {
        let is_whole =
            |(frame, show): &(Frame, DisplayOptions)| !frame.background.transparent && show.view == View::Picture;
        self.drawn.as_ref().is_some_and(is_whole)
    }

    /// Whether the user's own shaders have drawn it.
    pub fn is_users(&self) -> bool {
        self.shaders.is_some() && self.traced.is_none()
    }

    /// Shows the traced picture with the frame's exposure and tone mapping, if anything changed.
    pub fn show_traced(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        traced: (u64, &Arc<Picture>),
        time: f64,
        size: [u32; 2],
        facts: &mut FrameFacts,
    ) -> Result<(), GlError> {
        let Some(loaded) = &self.loaded else { return Ok(()) };
        let frame = Frame { width: size[0], height: size[1], ..loaded.frame(time) };
        let (serial, picture) = traced;
        let is_same = |drawn: &Frame| {
            let look = |frame: &Frame| (frame.width, frame.height, frame.output, frame.background);
            look(drawn) == look(&frame)
        };
        let is_shown = self.traced.as_ref().is_some_and(|(shown, _)| *shown == serial)
            && self.drawn.as_ref().is_some_and(|(drawn, _)| is_same(drawn));
        if !is_shown {
            let canvas = match &mut self.canvas {
                Some(canvas) => canvas,
                none => none.insert(DisplayTexture::new(gl, size)?),
            };
            renderer.paint_picture(picture, &frame, canvas)?;
            self.traced = Some((serial, picture.clone()));
            self.serial += 1;
            facts.pictures += 1;
        }
        // Its noise is not a matter of samples: the picture counts as complete.
        facts.samples = frame.samples;
        self.drawn = Some((frame, DisplayOptions::default()));
        Ok(())
    }

    /// Draws the picture if anything changed.
    pub fn draw(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        time: f64,
        size: [u32; 2],
        pace: Pace<'_>,
        facts: &mut FrameFacts,
    ) -> Result<(), GlError> {
        let (Some(loaded), Some((_, uploaded))) = (&self.loaded, &self.uploaded) else { return Ok(()) };
        if self.traced.take().is_some() {
            self.drawn = None;
        }
        let full = Frame { width: size[0], height: size[1], ..loaded.frame(time) };
        let show = self.settings.show();
        let shaders = pace.shaders.filter(|shaders| draws(shaders, &show));
        let serial = shaders.map(OwnShaders::serial);
        if let Some((drawn, shown)) = &self.drawn
            && *shown == show
            && self.shaders == serial
        {
            // If only something else moves, drawing with fewer samples would make the picture worse.
            let samples_alone = Frame { samples: full.samples, ..drawn.clone() } == full;
            if samples_alone && (pace.moving || drawn.samples == full.samples && !self.sketched) {
                return Ok(());
            }
        }
        let samples = if pace.moving && pace.reduced { 1 } else { full.samples };
        let frame = Frame { samples, ..full };
        let canvas = match &mut self.canvas {
            Some(canvas) => canvas,
            none => none.insert(DisplayTexture::new(gl, size)?),
        };
        self.shaders = serial;
        // A graphics card draws the picture itself in time.
        let sketches = pace.moving && shaders.is_none() && (samples == 1 || renderer.info().is_software());
        let painted = if sketches {
            renderer.paint_sketch(uploaded, &frame, &show, canvas)?
        } else if pace.moving {
            paint(renderer, shaders, (loaded, uploaded), &frame, &show, canvas)?
        } else {
            let start = web_time::Instant::now();
            let painted = match shaders {
                Some(_) => paint(renderer, shaders, (loaded, uploaded), &frame, &show, canvas)?,
                None => renderer.paint_counted(uploaded, &frame, &show, canvas)?,
            };
            canvas.wait();
            self.facts.ms = start.elapsed().as_secs_f64() * 1e3;
            count(&mut self.facts, painted.statistics, loaded);
            if self.facts.fragments.is_none() && pace.counted {
                // Without counters, as on the web, fragments are counted by drawing once more.
                self.facts.fragments = renderer.count_fragments(uploaded, &frame).ok();
            }
            painted
        };
        facts.draw_ms = self.facts.ms;
        facts.samples = frame.samples;
        facts.pictures += 1;
        facts.notes = painted.notes;
        self.sketched = painted.is_sketch;
        self.serial += 1;
        self.drawn = Some((frame, show));
        Ok(())
    }
}

impl PaneDrawing {
    /// The frame to save, at `size` or at its own, with all of the scene's samples.
    pub fn to_save(&self, size: Option<[u32; 2]>) -> Option<(&Scene, &GpuScene, Frame, DisplayOptions)> {
        let (frame, show) = self.drawn.as_ref()?;
        let [width, height] = size.unwrap_or([frame.width, frame.height]);
        let loaded = self.loaded.as_ref()?;
        let samples = loaded.settings.picture.samples;
        let (_, uploaded) = self.uploaded.as_ref()?;
        Some((loaded, uploaded, Frame { width, height, samples, ..frame.clone() }, *show))
    }
}

/// Whether the user's shaders draw this view: the picture, if they have been compiled.
fn draws(shaders: &OwnShaders, show: &DisplayOptions) -> bool {
    show.view == View::Picture && shaders.program().is_some()
}

/// Draws the picture, by the user's shaders if there are any.
pub fn paint(
    renderer: &mut Renderer,
    shaders: Option<&OwnShaders>,
    (scene, uploaded): (&Scene, &GpuScene),
    frame: &Frame,
    show: &DisplayOptions,
    canvas: &mut DisplayTexture,
) -> Result<Painted, GlError> {
    match shaders.filter(|shaders| draws(shaders, show)).and_then(OwnShaders::program) {
        Some(program) => program
            .with_pass(scene, frame, |pass| renderer.paint_user_pass(uploaded, frame, pass, show.overlays, canvas)),
        None => renderer.paint(uploaded, frame, show, canvas),
    }
}

/// The scene with a pane's settings, except the level of detail.
pub fn with_settings(base: &Arc<Scene>, settings: &Pane) -> Arc<Scene> {
    let scene = settings.applied_to(&base.settings);
    if scene == base.settings {
        return base.clone();
    }
    match edit::apply(base, scene) {
        Ok(Edited::Done(applied)) => Arc::new(applied.loaded),
        // A pane's settings need no files.
        Ok(Edited::NeedsFiles(_)) | Err(_) => base.clone(),
    }
}

/// The scene at `time`, seconds.
pub fn at_time(loaded: Arc<Scene>, time: f64) -> Arc<Scene> {
    if loaded.has_moving_objects() { Arc::new(loaded.at(time)) } else { loaded }
}

/// Triangles of all objects.
pub fn triangles(loaded: &Scene) -> usize {
    let of = |object: &gonio_scene::Object| loaded.meshes.get(object.mesh).map_or(0, |mesh| mesh.triangle_count());
    loaded.objects.iter().map(of).sum()
}

/// Stores the GPU's counts, or else the number of submitted vertices.
fn count(facts: &mut PaneFacts, statistics: Option<GpuStatistics>, loaded: &Scene) {
    let statistics = statistics.unwrap_or_default();
    facts.counted = statistics.vertices.is_some();
    facts.fragments = statistics.fragments;
    facts.vertices = statistics.vertices.or_else(|| Some(vertices(loaded)));
}

fn vertices(loaded: &Scene) -> u64 {
    let of = |object: &gonio_scene::Object| {
        let mesh = loaded.meshes.get(object.mesh)?;
        Some(if wants_unshared(object.shading) { mesh.indices.len() } else { mesh.positions.len() } as u64)
    };
    loaded.objects.iter().filter_map(of).sum()
}

/// Whether the GPU data of one scene can be used for another of the same generation: the same meshes, places, shadings and
/// environment.
fn is_same_on_gpu(uploaded: &Scene, loaded: &Scene) -> bool {
    let environment = |scene: &Scene| scene.environment.as_ref().map(Arc::as_ptr);
    uploaded.objects.len() == loaded.objects.len()
        && environment(uploaded) == environment(loaded)
        && uploaded.objects.iter().zip(&loaded.objects).all(|(a, b)| {
            let mesh = |scene: &Scene, index: usize| scene.meshes.get(index).map(Arc::as_ptr);
            a.shading == b.shading
                && a.world_from_model == b.world_from_model
                && mesh(uploaded, a.mesh) == mesh(loaded, b.mesh)
        })
}
