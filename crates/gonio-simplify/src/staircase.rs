//! The pictures of all steps, with the time that each takes.

use crate::comparison::{AmbientFit, LargestDifference, PictureComparison, PictureMeasure, fit_ambient, flip_map};
use glam::DVec3;
use gonio_image::flip;
use gonio_light::{Light, LightKind, Quantity};
use gonio_reference::ReferenceScene;
use gonio_scene::{Frame, LightShape, Picture, Scene, ViewSpec};
use gonio_trace::{
    Features, Film, LightOrigin, PixelContributions, Simplification, Simplifications, TraceGoal, TraceScene,
    TraceSettings,
};
use std::cell::OnceCell;
use std::time::Instant;

/// What is traced.
#[derive(Clone, Debug)]
pub struct StaircaseSettings {
    /// The simplifications, one after the other; at least one.
    pub steps: Vec<Simplification>,
    /// Whether each is also made by itself.
    pub alone: bool,
    /// When a picture is finished.
    pub goal: TraceGoal,
    /// Everything else; `simplified` and `seed + 1` are chosen here.
    pub trace: TraceSettings,
}

/// A traced picture.
#[derive(Clone, Debug)]
pub struct TracedPicture {
    /// What was left out.
    pub simplified: Simplifications,
    /// The mean of both halves.
    pub picture: Picture,
    /// The picture without most of its noise, to look at: no number is measured in it. None where it is not shown, or has too few
    /// paths to tell noise from light.
    pub denoised: Option<Picture>,
    /// Traced with different random numbers.
    pub halves: [Film; 2],
    /// The mean luminance of the pixels that count.
    pub mean: f64,
    /// Error of a pixel's luminance, relative to the mean of the truth: measured by the difference of the halves.
    pub error: f64,
    /// Seconds by the clock of the caller.
    pub seconds: f64,
    /// Whether the error that was asked for is not reached with the most paths of a pixel.
    pub missed: bool,
}

/// A traced picture that follows from another one by simplifications.
#[derive(Clone, Debug)]
pub struct SimplifiedPicture {
    /// The simplification that is new.
    pub step: Simplification,
    /// The picture.
    pub traced: TracedPicture,
    /// Compared with the picture before.
    pub to_before: PictureComparison,
    /// Compared with the truth.
    pub to_truth: PictureComparison,
    /// The source of most of the change where the picture before and this one differ most, as text; none where no source has most.
    pub source: Option<String>,
}

/// A picture by the light equation on the CPU, as `gonio render` draws it.
#[derive(Clone, Debug)]
pub struct EquationPicture {
    /// The picture.
    pub picture: Picture,
    /// Seconds by the clock of the caller.
    pub seconds: f64,
    /// RMS of linear light to the picture that it is compared with, relative to the mean luminance of the truth.
    pub rms: f64,
    /// Mean FLIP.
    pub flip: f64,
    /// FLIP of each pixel.
    pub map: Vec<f32>,
}

/// All pictures.
#[derive(Clone, Debug)]
pub struct Staircase {
    /// The share of the pixels that no number but FLIP counts, because a lamp brighter than white is seen in them.
    pub left_out: f64,
    /// The rendering equation.
    pub truth: TracedPicture,
    /// In order, each with all simplifications before it.
    pub steps: Vec<SimplifiedPicture>,
    /// Each simplification alone; compared with the truth. Empty where not asked for.
    pub alone: Vec<SimplifiedPicture>,
    /// The light equation's picture of the same lights, compared with the last step, if that has all simplifications.
    pub light_equation: Option<EquationPicture>,
    /// The ambient light that loses least, if a step adds ambient light and a material reflects it.
    pub ambient: Option<AmbientFit>,
    /// The light equation with the environment as a cubemap, compared with the truth, if the scene has mirrors or glass and an
    /// environment.
    pub cubemap: Option<EquationPicture>,
}

/// Paths of each pixel, in both halves together, before errors are estimated.
const FIRST_PATHS: u32 = 16;
/// Paths that find the source of a change.
const SOURCE_PATHS: u32 = 256;
/// Paths of a pixel without which its noise is not known.
const LEAST_DENOISED: u32 = 8;
/// Points of a pixel at which its surfaces are looked at.
const FEATURE_SAMPLES: u32 = 16;
/// The most paths of a pixel for a requested error.
const MOST_PATHS: u32 = 1 << 16;

impl TracedPicture {
    /// The bound that the error stays below with a probability of 95 %.
    pub fn error_bound(&self) -> f64 {
        bound_of(&self.halves)
    }

    /// Paths of a pixel, at least.
    pub fn paths(&self) -> u32 {
        self.halves.iter().map(Film::least_samples).sum()
    }

    /// Seconds that the method takes until the error is `error`: it falls with the square root of the paths. At least those of
    /// one path per pixel.
    pub fn seconds_at(&self, error: f64) -> f64 {
        let paths = f64::from(self.paths().max(1));
        let needed = (self.error / error).powi(2) * paths;
        self.seconds / paths * needed.max(1.0)
    }
}

/// The bound of the error of both halves together, with a probability of 95 %.
fn bound_of(halves: &[Film; 2]) -> f64 {
    let [a, b] = halves.each_ref().map(|half| half.error().upper);
    0.5 * a.hypot(b)
}

/// Both halves, weighted by their paths.
fn combined(halves: &[Film; 2]) -> Picture {
    let [mut a, b] = halves.each_ref().map(Film::picture);
    for (a, b) in a.pixels.iter_mut().zip(&b.pixels) {
        for (a, b) in a.iter_mut().zip(b) {
            *a = 0.5 * (*a + *b);
        }
    }
    a
}

/// Traces and compares everything. `ready` is made of scene and frame. `clock` gives seconds of computing time; `progress` is called with the share of the work done and
/// what is being drawn, and returns whether to go on. None where it said no.
pub fn build(
    scene: &Scene,
    frame: &Frame,
    ready: &TraceScene,
    settings: &StaircaseSettings,
    clock: &dyn Fn() -> f64,
    progress: &(dyn Fn(f64, &str) -> bool + Sync),
) -> Option<Staircase> {
    let alone: &[Simplification] = if settings.alone && settings.steps.len() > 1 { &settings.steps } else { &[] };
    // The first step alone is the first step of the staircase.
    let count = 1 + settings.steps.len() + alone.len().saturating_sub(1);
    let measure = PictureMeasure::new(frame.output, &seen_sources(ready, settings));
    let mut tracer = Tracer { ready, measure, settings, clock, progress, count, features: Default::default() };
    let mut truth = tracer.trace(0, Simplifications::NONE, "truth")?;
    tracer.denoise(&mut truth);
    if truth.mean > 0.0 {
        tracer.measure.unit = truth.mean;
        truth.error /= truth.mean;
    }
    let measure = &tracer.measure;
    let mut steps: Vec<SimplifiedPicture> = Vec::new();
    let mut simplified = Simplifications::NONE;
    for (index, &step) in settings.steps.iter().enumerate() {
        simplified = simplified.with(step);
        let mut traced = tracer.trace(1 + index, simplified, step.name())?;
        tracer.denoise(&mut traced);
        let before = steps.last().map_or(&truth, |before| &before.traced);
        let mut to_before = measure.compare(before, &traced);
        let mut to_truth = measure.compare(&truth, &traced);
        for (against, comparison) in [(before, &mut to_before), (&truth, &mut to_truth)] {
            if let (Some(a), Some(b)) = (&against.denoised, &traced.denoised) {
                comparison.map = flip_map(a, b, frame.output);
            }
        }
        let source = tracer.source(scene, step, simplified, to_before.most.as_ref());
        steps.push(SimplifiedPicture { step, traced, to_before, to_truth, source });
    }
    let mut by_itself: Vec<SimplifiedPicture> = Vec::new();
    for (index, &step) in alone.iter().enumerate() {
        match steps.first() {
            Some(first) if index == 0 => by_itself.push(first.clone()),
            _ => {
                let only = Simplifications::NONE.with(step);
                let traced = tracer.trace(settings.steps.len() + index, only, step.name())?;
                let to_truth = measure.compare(&truth, &traced);
                let source = tracer.source(scene, step, only, to_truth.most.as_ref());
                by_itself.push(SimplifiedPicture { step, traced, to_before: to_truth.clone(), to_truth, source });
            }
        }
    }
    let draw = |scene: &Scene, frame: &Frame, against: &Picture| {
        let reference = ReferenceScene::new(scene);
        let start = clock();
        let picture = reference.render(frame, None, &|_| ()).picture;
        let seconds = clock() - start;
        let map = flip_map(against, &picture, frame.output);
        EquationPicture { rms: measure.rms(against, &picture), flip: flip::mean(&map), picture, seconds, map }
    };
    let last = steps.last().filter(|last| last.traced.simplified == Simplifications::ALL);
    let light_equation = last.map(|last| {
        let (scene, frame) = light_equation_scene(scene, frame, ready, settings.trace.points_per_light);
        draw(&scene, &frame, &last.traced.picture)
    });
    let with_mirrors = scene.environment.is_some() && scene.materials.iter().any(|m| !m.optics.is_plain());
    let cubemap = with_mirrors.then(|| draw(scene, frame, &truth.picture));
    let ambient = match &steps[..] {
        [.., base, last] if last.step == Simplification::Ambient => {
            let coefficients = ambient_coefficients(scene, frame);
            fit_ambient(&truth.picture, &base.traced.picture, &coefficients, own_ambient(frame), measure)
        }
        _ => None,
    };
    Some(Staircase { left_out: measure.left_out(), truth, steps, alone: by_itself, light_equation, ambient, cubemap })
}

/// A light as the scene's file calls it, in backticks, or by its number.
pub(crate) fn light_name(scene: &Scene, index: usize) -> String {
    match scene.settings.lights.get(index) {
        Some(light) if !light.name.is_empty() => format!("`{}`", light.name),
        _ => format!("light {index}"),
    }
}

/// What emits light itself, and the background, without the light that surfaces scatter.
fn seen_sources(ready: &TraceScene, settings: &StaircaseSettings) -> Picture {
    let frame = ready.frame();
    let mut film = Film::new(frame.width, frame.height);
    let simplified = Simplifications::NONE.with(Simplification::Wavelengths);
    let settings = TraceSettings { simplified, most_depth: 1, ..settings.trace };
    ready.add_samples(&mut film, &settings, FIRST_PATHS, None, &|_| true);
    film.picture()
}

/// The sum of the scene's ambient lights.
pub fn own_ambient(frame: &Frame) -> DVec3 {
    let ambient = frame.lights.iter().filter(|light| light.kind == LightKind::Ambient);
    if frame.equation.terms.ambient { ambient.map(|light| light.color).sum() } else { DVec3::ZERO }
}

/// The picture of `k_a`: the ambient term under a white ambient light.
fn ambient_coefficients(scene: &Scene, frame: &Frame) -> Picture {
    let white = Light { kind: LightKind::Ambient, color: DVec3::ONE, attenuation: gonio_light::Attenuation::NONE };
    let mut frame = Frame { lights: vec![white], ..frame.clone() };
    frame.equation.terms.ambient = true;
    let view = ViewSpec { quantity: Quantity::Ambient, light: None };
    ReferenceScene::new(scene).render(&frame, Some(view), &|_| ()).picture
}

struct Tracer<'a> {
    ready: &'a TraceScene,
    measure: PictureMeasure,
    settings: &'a StaircaseSettings,
    clock: &'a dyn Fn() -> f64,
    progress: &'a (dyn Fn(f64, &str) -> bool + Sync),
    /// Pictures altogether.
    count: usize,
    /// What the denoiser knows about the surfaces: while they move, at one moment, and after [`Simplification::Brdf`].
    features: [OnceCell<Features>; 3],
}

impl Tracer<'_> {
    /// Traces a picture until it is finished; `index` of all pictures.
    fn trace(&self, index: usize, simplified: Simplifications, name: &str) -> Option<TracedPicture> {
        let Frame { width, height, .. } = *self.ready.frame();
        let seed = self.settings.trace.seed;
        let mut halves = [Film::new(width, height), Film::new(width, height)];
        let (begun, started) = (Instant::now(), (self.clock)());
        let mut done = 0.0;
        while let Some(paths) = self.next_pass(&halves, begun) {
            let after = self.share_after(&halves, paths, begun);
            for (half, film) in (0_u32..).zip(&mut halves) {
                let settings =
                    TraceSettings { simplified, seed: seed.wrapping_add(u64::from(half)), ..self.settings.trace };
                let (progress, count) = (self.progress, self.count as f64);
                let from = done + (after - done) * 0.5 * f64::from(half);
                let tell = |share: f64| {
                    let here = from + (after - done) * 0.5 * share;
                    progress((index as f64 + here) / count, name)
                };
                if !self.ready.add_samples(film, &settings, paths, None, &tell) {
                    return None;
                }
            }
            done = after;
        }
        let seconds = (self.clock)() - started;
        let missed = matches!(self.settings.goal, TraceGoal::Error(error) if bound_of(&halves) > error);
        let picture = combined(&halves);
        let (mean, error) = (self.measure.mean(&picture), self.measure.error(&halves.each_ref().map(Film::picture)));
        Some(TracedPicture { simplified, picture, denoised: None, halves, mean, error, seconds, missed })
    }

    /// Adds the picture without noise.
    fn denoise(&self, traced: &mut TracedPicture) {
        if traced.paths() >= LEAST_DENOISED {
            let settings = TraceSettings { simplified: traced.simplified, ..self.settings.trace };
            let has = |one| traced.simplified.contains(one);
            // Both steps are made in this order.
            let kind = usize::from(has(Simplification::Time)) + usize::from(has(Simplification::Brdf));
            let features = &self.features[kind];
            let features = features.get_or_init(|| self.ready.features(&settings, FEATURE_SAMPLES));
            traced.denoised = Some(Film::denoised_together(&traced.halves, features));
        }
    }

    /// Which source of light changed most in the middle of a square, if it did as the square.
    fn source(
        &self,
        scene: &Scene,
        step: Simplification,
        simplified: Simplifications,
        most: Option<&LargestDifference>,
    ) -> Option<String> {
        let most = most?;
        let parts = |simplified| {
            let settings = TraceSettings { simplified, ..self.settings.trace };
            self.ready.contributions(&settings, most.x, most.y, SOURCE_PATHS, &|_| true)
        };
        let (before, after) = (parts(simplified.without(step)), parts(simplified));
        let change = after.total - before.total;
        let expected = most.after - most.before;
        if change.dot(expected) < 0.3 * expected.length_squared() {
            return None;
        }
        let from = |parts: &PixelContributions, origin: LightOrigin| {
            parts.direct.iter().find(|(known, _)| *known == origin).map_or(DVec3::ZERO, |(_, light)| *light)
        };
        let origins = before.direct.iter().chain(&after.direct).map(|(origin, _)| *origin);
        let name = |origin| match origin {
            LightOrigin::Light(index) => light_name(scene, index),
            LightOrigin::Object(index) => {
                scene.objects.get(index).map_or_else(|| "an object".to_owned(), |object| format!("`{}`", object.name))
            }
            LightOrigin::Environment => "the environment".to_owned(),
            LightOrigin::Ambient => "the ambient term".to_owned(),
        };
        let of_sources = origins.map(|origin| (name(origin), from(&after, origin) - from(&before, origin)));
        let others = after.first_bounce + after.rest - before.first_bounce - before.rest;
        let all = of_sources.chain([("other surfaces".to_owned(), others)]);
        // Most of it: more than half, in the direction of the change.
        let half = 0.5 * change.length_squared();
        all.map(|(name, part)| (name, part.dot(change)))
            .filter(|part| part.1 > half)
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|part| part.0)
    }

    /// Paths that each half gets next; none at the goal.
    fn next_pass(&self, halves: &[Film; 2], begun: Instant) -> Option<u32> {
        let least = halves[0].least_samples();
        match self.settings.goal {
            TraceGoal::Paths(paths) => Some(paths.div_ceil(2).saturating_sub(least)).filter(|&n| n > 0),
            TraceGoal::Time(time) => {
                let time = time.as_secs_f64() / self.count as f64;
                if least == 0 {
                    return Some(1);
                }
                let spent = begun.elapsed().as_secs_f64();
                // The last pass should end in time.
                let fitting = (time - spent) / (spent / f64::from(least));
                (fitting >= 0.5).then(|| (fitting.round() as u32).clamp(1, 2 * least))
            }
            TraceGoal::Error(error) => match bound_of(halves) {
                _ if 2 * least < FIRST_PATHS => Some(FIRST_PATHS / 2 - least),
                upper if upper <= error || 2 * least >= MOST_PATHS => None,
                upper => {
                    let needed = f64::from(least) * (upper / error).powi(2);
                    Some((needed as u32).saturating_sub(least).clamp(1, 2 * least).min(MOST_PATHS / 2 - least))
                }
            },
        }
    }

    /// The share of a picture that is done after the next pass, as far as one can tell.
    fn share_after(&self, halves: &[Film; 2], paths: u32, begun: Instant) -> f64 {
        let least = halves[0].least_samples();
        let after = f64::from(least + paths);
        match self.settings.goal {
            TraceGoal::Paths(all) => after / f64::from(all.div_ceil(2).max(1)),
            TraceGoal::Time(time) => {
                let per_path = begun.elapsed().as_secs_f64() / f64::from(least.max(1));
                (after * per_path * self.count as f64 / time.as_secs_f64().max(1e-9)).min(1.0)
            }
            TraceGoal::Error(error) => {
                let now = bound_of(halves);
                let needed = f64::from(least) * (now / error).powi(2);
                if needed.is_finite() { (after / needed.max(after)).min(1.0) } else { 0.0 }
            }
        }
    }
}

/// The scene and the frame of which the light equation's picture is that with all simplifications: lamps, objects that emit light
/// and the environment are point lights or nothing, mirrors and glass are surfaces like others.
pub fn light_equation_scene(scene: &Scene, frame: &Frame, ready: &TraceScene, points: u32) -> (Scene, Frame) {
    let mut scene = scene.clone();
    for material in &mut scene.materials {
        material.optics = gonio_light::Optics::default();
    }
    let ambient = frame.lights.iter().filter(|light| light.kind == LightKind::Ambient);
    let others = ready.point_lights(points).into_iter().filter(|light| light.kind != LightKind::Ambient);
    let lights: Vec<Light> = others.chain(ambient.copied()).collect();
    let light_shapes = vec![LightShape::Point; lights.len()];
    let mut frame = Frame { lights, light_shapes, shadows: false, ..frame.clone() };
    if let Some(surroundings) = &mut frame.surroundings {
        surroundings.lights = false;
    }
    (scene, frame)
}
