//! Comparisons of pictures: the difference of two panes, and the error curve.
//!
//! The difference is a map drawn on the GPU, with its statistics. The curve is drawn one picture per frame, so that the
//! window stays responsive.

use super::details::Details;
use super::pane::{PaneDrawing, at_time, triangles, with_settings};
use crate::document::{DifferenceSettings, Document, Pane};
use crate::session::Session;
use crate::session::comparison::{Curve, CurvePoint, DifferenceFacts};
use gonio_gl::{Gl, GlError};
use gonio_language::tr;
use gonio_render::{DifferenceScale, DisplayTexture, Renderer};
use gonio_scene::detail::{self, LevelOfDetail};
use gonio_scene::scene_file::Shading;
use gonio_scene::{Frame, Scene, difference};
use std::sync::Arc;

/// A pixel differs if a channel differs by more than this number of 8-bit steps.
const TOLERANCE: f64 = 1.0;

/// Identifies a pair of pictures: panes and picture numbers.
type PictureIds = ([usize; 2], [u64; 2]);

/// State of the pair between pictures.
#[derive(Default)]
pub struct PairDrawing {
    pub map: Option<DisplayTexture>,
    drawn: Option<(PictureIds, DifferenceSettings)>,
    measured: Option<(PictureIds, DifferenceFacts)>,
}

impl PairDrawing {
    /// Draws the map if anything changed. Returns whether there is one: both pictures exist and have the same size.
    pub fn draw(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        panes: [&PaneDrawing; 2],
        pair: [usize; 2],
        settings: DifferenceSettings,
    ) -> Result<bool, GlError> {
        let [Some(a), Some(b)] = panes.map(|pane| pane.canvas.as_ref()) else { return Ok(false) };
        if a.size() != b.size() {
            return Ok(false);
        }
        let requested = ((pair, panes.map(|pane| pane.serial)), settings);
        if self.drawn != Some(requested) {
            let map = match &mut self.map {
                Some(map) => map,
                none => none.insert(DisplayTexture::new(gl, a.size())?),
            };
            let scale = DifferenceScale { full_scale: settings.full_scale, signed: settings.signed };
            renderer.paint_difference(a, b, scale, map)?;
            self.drawn = Some(requested);
        }
        Ok(true)
    }

    /// The statistics. Both pictures are read back if they changed.
    pub fn measured(&mut self, panes: [&PaneDrawing; 2], pair: [usize; 2]) -> Option<DifferenceFacts> {
        let made = (pair, panes.map(|pane| pane.serial));
        if let Some((of, facts)) = &self.measured
            && *of == made
        {
            return Some(facts.clone());
        }
        let [Some(a), Some(b)] = panes.map(|pane| pane.canvas.as_ref()) else { return None };
        let tally = difference::of_bytes(&a.read8(), &b.read8(), TOLERANCE);
        let facts = DifferenceFacts::new(&tally, a.size());
        self.measured = Some((made, facts.clone()));
        Some(facts)
    }
}

/// Longest side of the pictures, pixels: large enough to measure the error, and fast on a software driver.
const SIDE: u32 = 480;
/// Frequencies of the spheres: 8 to 8192 triangles.
const SPHERES: [usize; 10] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32];
/// Frequency of the reference sphere: 32768 triangles.
const FINEST_SPHERE: usize = 64;
/// Smallest number of triangles of a simplified model.
const FEWEST: f64 = 16.0;
/// Largest number of levels of a model, each with half the triangles of the next.
const MOST_LEVELS: i32 = 10;

/// The pictures that are drawn for a curve.
pub struct CurveRun {
    base: Arc<Scene>,
    settings: Pane,
    frame_size: [u32; 2],
    time: f64,
    /// The finest comes first, in Phong shading; all others are compared with it.
    requested: Vec<(Shading, Option<LevelOfDetail>)>,
    next: usize,
    finest: Vec<u8>,
    canvas: Option<DisplayTexture>,
}

impl CurveRun {
    /// Starts the curve for the scene as the current pane shows it, at the size of its picture `frame` or smaller; `None` if no
    /// scene is open.
    pub fn new(document: &Document, session: &mut Session, frame: Option<&Frame>) -> Option<Self> {
        let (base, frame) = (session.loaded.clone()?, frame?);
        let settings = document.panes.current().cloned().unwrap_or_default();
        let longest = frame.width.max(frame.height).max(1);
        let shrink = |side: u32| (side * SIDE.min(longest) / longest).max(1);
        let spheres = base.settings.objects.iter().any(detail::is_sphere);
        let (levels, finest): (Vec<Option<LevelOfDetail>>, Option<LevelOfDetail>) = if spheres {
            let of = |frequency: usize| Some(LevelOfDetail::Sphere(8 * frequency * frequency));
            (SPHERES.iter().map(|&f| of(f)).collect(), of(FINEST_SPHERE))
        } else {
            let count = triangles(&base) as f64;
            let shares = (0..MOST_LEVELS).map(|level| 0.5_f64.powi(level)).filter(|s| *s == 1.0 || s * count >= FEWEST);
            let mut levels: Vec<_> = shares.map(|s| (s < 1.0).then_some(LevelOfDetail::Share(s))).collect();
            levels.reverse();
            (levels, None)
        };
        let mut requested = vec![(Shading::Phong, finest)];
        for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
            // The finest picture does not differ from itself.
            let same = |level: &Option<LevelOfDetail>| shading == Shading::Phong && *level == finest;
            requested.extend(levels.iter().filter(|level| !same(level)).map(|&level| (shading, level)));
        }
        session.comparison.curve = Curve { running: true, progress: [0, requested.len()], ..Curve::default() };
        Some(CurveRun {
            base,
            settings,
            frame_size: [shrink(frame.width), shrink(frame.height)],
            time: session.clock.time,
            requested,
            next: 0,
            finest: Vec::new(),
            canvas: None,
        })
    }

    /// Draws the next picture. Returns whether there are more. While a mesh is being simplified nothing is drawn; the window is
    /// repainted when it is finished.
    pub fn step(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        details: &mut Details,
        curve: &mut Curve,
    ) -> Result<bool, GlError> {
        let Some(&(shading, level)) = self.requested.get(self.next) else { return Ok(false) };
        let settings = Pane { shading: Some(shading), detail: None, ..self.settings.clone() };
        let mut loaded = with_settings(&self.base, &settings);
        if let Some(level) = level {
            let Some(meshes) = details.meshes(&loaded, level) else { return Ok(true) };
            loaded = Arc::new(detail::with_meshes(&loaded, &meshes));
        }
        let loaded = at_time(loaded, self.time);
        let uploaded = renderer.upload(&loaded)?;
        let [width, height] = self.frame_size;
        let frame = Frame { width, height, ..loaded.frame(self.time) };
        let canvas = match &mut self.canvas {
            Some(canvas) => canvas,
            none => none.insert(DisplayTexture::new(gl, self.frame_size)?),
        };
        let painted = renderer.paint_counted(&uploaded, &frame, &settings.show(), canvas)?;
        let pixels = canvas.read8();
        let count = triangles(&loaded);
        if self.next == 0 {
            self.finest = pixels;
            curve.against = tr!("scene-triangles-phong", count = count);
        } else {
            let statistics = painted.statistics.unwrap_or_default();
            curve.points.push(CurvePoint {
                shading,
                triangles: count,
                rms: difference::of_bytes(&self.finest, &pixels, 0.0).spread().rms,
                vertices: statistics.vertices,
                fragments: statistics.fragments,
            });
        }
        self.next += 1;
        curve.progress = [self.next, self.requested.len()];
        Ok(self.next < self.requested.len())
    }
}
