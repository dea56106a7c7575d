//! The pictures of all steps, with the time that each takes.

use crate::comparison::{
    AmbientFit, LargestDifference, PictureComparison, compare, fit_ambient, flip_map, mean_luminance,
};
use glam::DVec3;
use gonio_image::flip;
use gonio_light::{Light, LightKind, Quantity};
use gonio_reference::ReferenceScene;
use gonio_scene::{Frame, LightShape, Picture, Scene, ViewSpec};
use gonio_trace::{
    Film, LightOrigin, PixelContributions, Simplification, Simplifications, TraceGoal, TraceScene, TraceSettings,
};
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
    /// Traced with different random numbers.
    pub halves: [Film; 2],
    /// Seconds by the clock of the caller.
    pub seconds: f64,
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
/// The most paths of a pixel for a requested error.
const MOST_PATHS: u32 = 1 << 16;

impl TracedPicture {
    /// The error of the picture's luminance, relative to its mean: the mean of two independent halves.
    pub fn error(&self) -> f64 {
        error_of(&self.halves).0
    }

    /// Paths of a pixel, at least.
    pub fn paths(&self) -> u32 {
        self.halves.iter().map(Film::least_samples).sum()
    }

    /// Seconds that the method takes until the error is `error`: it falls with the square root of the paths. At least those of
    /// one path per pixel.
    pub fn seconds_at(&self, error: f64) -> f64 {
        let paths = f64::from(self.paths().max(1));
        let own = self.error();
        let needed = if own.is_finite() { (own / error).powi(2) * paths } else { paths };
        self.seconds / paths * needed.max(1.0)
    }

    /// The mean luminance.
    pub fn mean(&self) -> f64 {
        mean_luminance(&self.picture)
    }
}

/// Estimate and bound of the error of both halves together.
fn error_of(halves: &[Film; 2]) -> (f64, f64) {
    let [a, b] = halves.each_ref().map(Film::error);
    (0.5 * a.relative.hypot(b.relative), 0.5 * a.upper.hypot(b.upper))
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

/// Traces and compares everything. `clock` gives seconds of computing time; `progress` is called with the share of the work done and
/// what is being drawn, and returns whether to go on. None where it said no.
pub fn build(
    scene: &Scene,
    frame: &Frame,
    settings: &StaircaseSettings,
    clock: &dyn Fn() -> f64,
    progress: &(dyn Fn(f64, &str) -> bool + Sync),
) -> Option<Staircase> {
    let ready = TraceScene::new(scene, frame);
    let alone: &[Simplification] = if settings.alone && settings.steps.len() > 1 { &settings.steps } else { &[] };
    // The first step alone is the first step of the staircase.
    let count = 1 + settings.steps.len() + alone.len().saturating_sub(1);
    let tracer = Tracer { ready: &ready, frame, settings, clock, progress, count };
    let truth = tracer.trace(0, Simplifications::NONE, "truth")?;
    let unit = truth.mean();
    let mut steps: Vec<SimplifiedPicture> = Vec::new();
    let mut simplified = Simplifications::NONE;
    for (index, &step) in settings.steps.iter().enumerate() {
        simplified = simplified.with(step);
        let traced = tracer.trace(1 + index, simplified, step.name())?;
        let before = steps.last().map_or(&truth, |before| &before.traced);
        let to_before = compare(before, &traced, frame, unit);
        let to_truth = compare(&truth, &traced, frame, unit);
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
                let to_truth = compare(&truth, &traced, frame, unit);
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
        EquationPicture { rms: rms(against, &picture, unit), flip: flip::mean(&map), picture, seconds, map }
    };
    let last = steps.last().filter(|last| last.traced.simplified == Simplifications::ALL);
    let light_equation = last.map(|last| {
        let (scene, frame) = light_equation_scene(scene, frame, &ready, settings.trace.points_per_light);
        draw(&scene, &frame, &last.traced.picture)
    });
    let with_mirrors = scene.environment.is_some() && scene.materials.iter().any(|m| !m.optics.is_plain());
    let cubemap = with_mirrors.then(|| draw(scene, frame, &truth.picture));
    let ambient = match &steps[..] {
        [.., base, last] if last.step == Simplification::Ambient => {
            let coefficients = ambient_coefficients(scene, frame);
            fit_ambient(&truth.picture, &base.traced.picture, &coefficients, own_ambient(frame), unit)
        }
        _ => None,
    };
    Some(Staircase { truth, steps, alone: by_itself, light_equation, ambient, cubemap })
}

/// The root of the mean square of all channels' differences, relative to `unit`.
fn rms(a: &Picture, b: &Picture, unit: f64) -> f64 {
    let squares = a.pixels.iter().zip(&b.pixels);
    let squares = squares.map(|(&a, &b)| (crate::comparison::light(a) - crate::comparison::light(b)).length_squared());
    let mean = squares.sum::<f64>() / (3.0 * a.pixels.len().max(1) as f64);
    mean.sqrt() / if unit > 0.0 { unit } else { 1.0 }
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
    frame: &'a Frame,
    settings: &'a StaircaseSettings,
    clock: &'a dyn Fn() -> f64,
    progress: &'a (dyn Fn(f64, &str) -> bool + Sync),
    /// Pictures altogether.
    count: usize,
}

impl Tracer<'_> {
    /// Traces a picture until it is finished; `index` of all pictures.
    fn trace(&self, index: usize, simplified: Simplifications, name: &str) -> Option<TracedPicture> {
        let Frame { width, height, .. } = *self.frame;
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
        Some(TracedPicture { simplified, picture: combined(&halves), halves, seconds })
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
            LightOrigin::Light(index) => format!("light {index}"),
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
            TraceGoal::Error(error) => match error_of(halves).1 {
                _ if 2 * least < FIRST_PATHS => Some(FIRST_PATHS / 2 - least),
                upper if upper <= error || 2 * least >= MOST_PATHS => None,
                upper => {
                    let needed = f64::from(least) * (upper / error).powi(2);
                    Some((needed as u32).saturating_sub(least).clamp(1, 2 * least))
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
                let now = error_of(halves).1;
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
