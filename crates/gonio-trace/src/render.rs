//! Samples of all pixels, on all threads.

use crate::film::{Film, PixelSums, TileMask};
use crate::path::{Recorder, Technique, World};
use crate::posed::{Posed, Timeless};
use crate::sampler::Sampler;
use crate::tree::Ray;
use crate::wavelengths::Wavelengths;
use crate::{Simplification, Simplifications, sampling};
use glam::{DVec3, Vec3};
use gonio_light::Light;
use gonio_scene::{Camera, Frame, Scene};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// When a trace ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TraceGoal {
    /// Paths of each pixel.
    Paths(u32),
    /// Wall time, of all pictures together where there are several.
    Time(Duration),
    /// Error of a pixel's luminance relative to the mean luminance, with 95 % confidence; > 0.
    Error(f64),
}

/// How a scene is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceSettings {
    /// What is left out of the rendering equation.
    pub simplified: Simplifications,
    /// Points that replace a lamp or an object that emits light where [`Simplification::Sum`] is on, >= 1; 1: its centre.
    pub points_per_light: u32,
    /// Surfaces that a path meets, at most, >= 1. With 1 only light sources are seen, with 2 they light surfaces.
    pub most_depth: u32,
    /// Which samples of light count.
    pub technique: Technique,
    /// Pictures with other seeds have independent noise.
    pub seed: u64,
    /// Radius of the lens, world units, >= 0; 0 is a pinhole.
    pub aperture: f64,
    /// Distance from the eye at which a lens is in focus, along the viewing direction, world units, > 0.
    pub focus: f64,
    /// How long the shutter is open from the frame's moment on, seconds, >= 0. Closed with
    /// [`Simplification::Time`].
    pub shutter: f64,
}

impl Default for TraceSettings {
    fn default() -> Self {
        TraceSettings {
            simplified: Simplifications::NONE,
            points_per_light: 1,
            most_depth: 64,
            technique: Technique::Both,
            seed: 0,
            aperture: 0.0,
            focus: 1.0,
            shutter: 0.0,
        }
    }
}

/// A scene at one moment, ready to be traced.
pub struct TraceScene {
    pub(crate) frame: Frame,
    /// At the frame's moment.
    pub(crate) posed: Arc<Posed>,
    timeless: Arc<Timeless>,
    /// Other moments, by the bits of their time; the last ones only.
    moments: Mutex<Vec<(u64, Arc<Posed>)>>,
}

/// Moments that are remembered: a pass over a part of a picture is followed by the same pass over its next part.
const MOST_MOMENTS: usize = 16;

/// The moment of sample `index` of every pixel, from 0, when the shutter opens, to 1: the sequence of van der Corput, moved by
/// a number that depends on the seed.
fn moment(seed: u64, index: u32) -> f64 {
    // The constants of SplitMix64 (G. Steele, D. Lea and C. Flood, *Fast Splittable Pseudorandom Number Generators*, 2014).
    let mut bits = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let start = (bits >> 11) as f64 / (1_u64 << 53) as f64;
    (start + f64::from(index.reverse_bits()) / f64::from(u32::MAX)).fract()
}

impl TraceScene {
    /// Builds the tree, finds the lights, prepares the environment. Objects that move must be where they are at the frame's
    /// moment ([`Scene::at`]).
    ///
    /// A light of colour `L` in the lab's convention gives the irradiance `pi L`, so that a diffuse surface is as bright as
    /// the light equation makes it. Point and spot lights obey the inverse square law; at the centre of the objects they
    /// are as strong as their attenuation says. Nearer to the centre than half the shortest edge of the box around the objects
    /// (5 % of its diagonal where that is more) they are as strong at that distance. Ambient lights have no place in the rendering
    /// equation.
    ///
    /// A light with a shape is a lamp: a surface of uniform radiance that shines outwards, or to the front of a rectangle, as
    /// brightly at the centre of the objects as the light does in the light equation. The eye and mirrors see it, and it
    /// blocks light. The material of an object that emits light does so on both sides.
    pub fn new(scene: &Scene, frame: &Frame) -> Self {
        let timeless = Arc::new(Timeless::new(scene, frame));
        let posed = Arc::new(Posed::new(scene.clone(), &frame.lights, &frame.light_shapes, timeless.clone()));
        TraceScene { frame: frame.clone(), posed, timeless, moments: Mutex::default() }
    }

    /// The lights that replace lamps, objects that emit light, and the environment where [`Sum`](Simplification::Sum) is on: those
    /// of the frame, in its order, a lamp divided into `points_per_light` points, and as many points for each object that
    /// emits light. With 1 a lamp is the light at its centre.
    pub fn point_lights(&self, points_per_light: u32) -> Vec<Light> {
        self.posed.point_lights(&self.frame, points_per_light).iter().map(|placed| placed.light).collect()
    }

    /// Looks at the same scene at the same moment with another camera or in another size, in pixels: nothing is built again.
    pub fn look(&mut self, camera: Camera, width: u32, height: u32) {
        self.frame = Frame { camera, width, height, ..self.frame.clone() };
    }

    /// The frame that is traced.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The scene at the moment of sample `index` of every pixel.
    pub(crate) fn posed_for(&self, settings: &TraceSettings, index: u32) -> Arc<Posed> {
        if !self.moves(settings) {
            return self.posed.clone();
        }
        let time = self.frame.time + settings.shutter * moment(settings.seed, index);
        let mut known = self.moments.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, posed)) = known.iter().find(|(bits, _)| *bits == time.to_bits()) {
            return posed.clone();
        }
        let scene = self.posed.scene.at(time);
        let posed = if self.lights_move() {
            let Frame { lights, light_shapes, .. } = scene.frame(time);
            Posed::new(scene, &lights, &light_shapes, self.timeless.clone())
        } else {
            Posed::new(scene, &self.frame.lights, &self.frame.light_shapes, self.timeless.clone())
        };
        let posed = Arc::new(posed);
        if known.len() >= MOST_MOMENTS {
            known.remove(0);
        }
        known.push((time.to_bits(), posed.clone()));
        posed
    }

    /// Whether samples happen at different moments, and something moves between them.
    fn moves(&self, settings: &TraceSettings) -> bool {
        settings.shutter > 0.0
            && settings.shutter.is_finite()
            && !settings.simplified.contains(Simplification::Time)
            && (self.posed.scene.has_moving_objects() || self.lights_move())
    }

    fn lights_move(&self) -> bool {
        self.posed.scene.settings.lights.iter().any(|light| light.motion.is_some())
    }

    /// Triangles that can be hit.
    pub fn triangles(&self) -> usize {
        self.posed.geometry.triangles.len()
    }

    /// Adds `samples` to each pixel of the film, which has the frame's size, or only to those of some tiles. `progress` is
    /// called with the share done, from any thread; it returns whether to go on. Where it says no the film is left as it
    /// was, and `false` is returned.
    ///
    /// Samples depend on nothing but scene, settings, pixel and number: neither on the number of threads, nor on how
    /// many samples are added at once.
    pub fn add_samples(
        &self,
        film: &mut Film,
        settings: &TraceSettings,
        samples: u32,
        tiles: Option<&TileMask>,
        progress: &(dyn Fn(f64) -> bool + Sync),
    ) -> bool {
        let rows = 0..film.height;
        self.add_to_rows(film, settings, samples, rows, tiles, progress)
    }

    /// [`Self::add_samples`] to some rows of the film, which must be below its height.
    pub(crate) fn add_to_rows(
        &self,
        film: &mut Film,
        settings: &TraceSettings,
        samples: u32,
        rows: Range<u32>,
        tiles: Option<&TileMask>,
        progress: &(dyn Fn(f64) -> bool + Sync),
    ) -> bool {
        let width = film.width.max(1) as usize;
        let Some(pixels) = film.pixels.get_mut(rows.start as usize * width..rows.end as usize * width) else {
            return true;
        };
        let mut added = pixels.to_vec();
        let first = rows.start;
        let is_wanted = |index: usize| {
            tiles.is_none_or(|tiles| tiles.contains((index % width) as u32, first + (index / width) as u32))
        };
        // All samples at once, or, where something moves, one index of all pixels after the other.
        let steps: Vec<Range<u32>> = if self.moves(settings) {
            let counts = pixels.iter().enumerate().filter(|(index, _)| is_wanted(*index)).map(|(_, sums)| sums.samples);
            let all: BTreeSet<u32> = counts.flat_map(|count| count..count.saturating_add(samples)).collect();
            all.into_iter().map(|index| index..index + 1).collect()
        } else {
            std::iter::once(0..u32::MAX).collect()
        };
        let work = steps.len() as u64 * rows.len() as u64;
        let done = AtomicU64::new(0);
        let stopped = AtomicBool::new(false);
        for indices in steps {
            let posed = self.posed_for(settings, indices.start);
            let summed = posed.summed(&self.frame, settings);
            let world = posed.world(&self.frame, settings, summed.as_deref());
            added.par_chunks_mut(width).zip(pixels.par_chunks(width)).enumerate().for_each(|(y, (row, before))| {
                if stopped.load(Ordering::Relaxed) {
                    return;
                }
                for (x, (sums, before)) in row.iter_mut().zip(before).enumerate() {
                    if is_wanted(y * width + x) {
                        let end = before.samples.saturating_add(samples).min(indices.end);
                        while sums.samples >= indices.start && sums.samples < end {
                            self.add_sample(&world, settings, x as u32, first + y as u32, sums);
                        }
                    }
                }
                let rows_done = done.fetch_add(1, Ordering::Relaxed) + 1;
                if !progress(rows_done as f64 / work as f64) {
                    stopped.store(true, Ordering::Relaxed);
                }
            });
        }
        if stopped.load(Ordering::Relaxed) && done.load(Ordering::Relaxed) < work {
            return false;
        }
        pixels.copy_from_slice(&added);
        true
    }

    fn add_sample(&self, world: &World, settings: &TraceSettings, x: u32, y: u32, sums: &mut PixelSums) {
        let (light, alpha, _) = self.sample(world, settings, x, y, sums.samples, &mut ());
        sums.add(light, alpha);
    }

    /// Sample `index` of a pixel: linear RGB, alpha, and the wavelengths of the path.
    pub(crate) fn sample<'w>(
        &self,
        world: &'w World,
        settings: &TraceSettings,
        x: u32,
        y: u32,
        index: u32,
        recorder: &mut impl Recorder,
    ) -> (DVec3, f64, Wavelengths<'w>) {
        let frame = &self.frame;
        let mut sampler = Sampler::new(settings.seed, y.wrapping_mul(frame.width).wrapping_add(x), index);
        let at = sampler.next_2d();
        let mode = world.materials.mode;
        let mut wavelengths = mode.wavelengths(&mut sampler, world.materials.spectra);
        let (px, py) = (f64::from(x) + f64::from(at.x), f64::from(y) + f64::from(at.y));
        let ray = self.eye_ray(world, settings, px, py, &mut sampler);
        let found = world.follow(ray, &mut sampler, &mut wavelengths, recorder);
        let rgb = mode.rgb(found.light, &wavelengths).as_dvec3();
        let behind = if found.hit { [0.0; 4] } else { self.background(world, ray.direction, py) };
        let light = rgb + DVec3::new(behind[0], behind[1], behind[2]);
        (light, if found.hit { 1.0 } else { behind[3] }, wavelengths)
    }

    /// What is seen where there is nothing.
    fn background(&self, world: &World, direction: Vec3, py: f64) -> [f64; 4] {
        match (&world.lights.environment, self.frame.surroundings) {
            (Some(environment), Some(surroundings)) if surroundings.visible => {
                let seen = match &world.materials.scene.environment {
                    Some(loaded) if loaded.background.is_some() => {
                        let d = surroundings.environment_from_world * direction.as_dvec3();
                        loaded.seen().full().sample(d) * surroundings.intensity
                    }
                    _ => environment.radiance(direction).as_dvec3(),
                };
                seen.extend(1.0).to_array()
            }
            _ => self.frame.background.at(py / f64::from(self.frame.height)),
        }
    }

    /// The ray through a point of the picture, from the near plane to the far plane.
    pub(crate) fn eye_ray(
        &self,
        world: &World,
        settings: &TraceSettings,
        px: f64,
        py: f64,
        sampler: &mut Sampler,
    ) -> Ray {
        if settings.aperture <= 0.0 || settings.aperture.is_nan() {
            return world.eye.ray(px, py);
        }
        let Frame { camera, width, height, .. } = &self.frame;
        let mut eye = camera.position;
        let mut direction = camera.ray_direction(px, py, *width, *height);
        let on_lens = sampling::disc(sampler.next_2d()).as_dvec2() * settings.aperture;
        let focused = eye + direction * (settings.focus / direction.dot(camera.front));
        eye += camera.right * on_lens.x + camera.up * on_lens.y;
        direction = (focused - eye).normalize_or(camera.front);
        let cos = direction.dot(camera.front);
        let space = &world.geometry.space;
        let start = eye + direction * (camera.near / cos);
        Ray {
            origin: space.point(start),
            direction: direction.as_vec3().normalize(),
            reach: ((camera.far - camera.near) / cos * space.scale) as f32,
        }
    }
}
