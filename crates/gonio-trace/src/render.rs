//! Samples of all pixels, on all threads.

use crate::color::ColorMode;
use crate::environment::Environment;
use crate::film::{Film, PixelSums, TileMask};
use crate::geometry::Geometry;
use crate::lights::Lights;
use crate::material::{Constants, Materials, bare_emitted, normalised_lobe};
use crate::path::{Technique, World};
use crate::sampler::Sampler;
use crate::tree::Ray;
use crate::{Simplification, Simplifications, sampling};
use glam::{DVec3, Vec3};
use gonio_light::equation::Convention;
use gonio_scene::{Camera, Frame, Scene, TextureFilter};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

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
    /// How long the shutter is open from the frame's moment on, seconds, >= 0. Closed with [`Simplification::Time`].
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
    pub(crate) scene: Scene,
    pub(crate) frame: Frame,
    pub(crate) geometry: Geometry,
    pub(crate) lights: Lights,
    has_holes: bool,
    constants: Vec<Constants>,
}

impl TraceScene {
    /// Builds the tree, finds the lights, prepares the environment.
    ///
    /// A light of colour `L` in the lab's convention gives the irradiance `pi L`, so that a diffuse surface is as bright as
    /// the light equation makes it. Point and spot lights obey the inverse square law; at the centre of the objects they
    /// are as strong as their attenuation says. Ambient lights have no place in the rendering equation.
    pub fn new(scene: &Scene, frame: &Frame) -> Self {
        let mut geometry = Geometry::new(scene);
        let strength = match frame.equation.convention {
            Convention::Lab => std::f64::consts::PI,
            Convention::Physical => 1.0,
        };
        let environment = match (&scene.environment, frame.surroundings) {
            (Some(loaded), Some(surroundings)) => Some(Environment::new(loaded.clone(), surroundings)),
            _ => None,
        };
        let center = 0.5 * (frame.bounds_min + frame.bounds_max);
        let emitted = |t: &crate::geometry::Triangle| bare_emitted(scene, t.material);
        let lights = Lights::new(&frame.lights, strength, center, &mut geometry, emitted, environment);
        let has_holes = scene.materials.iter().any(|m| m.material.opacity < 1.0 || m.maps.opacity.is_some());
        let constants = Constants::of_scene(scene, normalised_lobe(&frame.equation));
        TraceScene { scene: scene.clone(), frame: frame.clone(), geometry, lights, has_holes, constants }
    }

    /// Looks at the same scene at the same moment with another camera or in another size, in pixels: nothing is built again.
    pub fn look(&mut self, camera: Camera, width: u32, height: u32) {
        self.frame = Frame { camera, width, height, ..self.frame.clone() };
    }

    /// The frame that is traced.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Triangles that can be hit.
    pub fn triangles(&self) -> usize {
        self.geometry.triangles.len()
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
        let world = World {
            geometry: &self.geometry,
            materials: self.materials(ColorMode::of(settings.simplified)),
            lights: &self.lights,
            technique: settings.technique,
            simplified: settings.simplified,
            most_depth: if settings.simplified.contains(Simplification::Interreflection) {
                settings.most_depth.clamp(1, 2)
            } else {
                settings.most_depth.max(1)
            },
        };
        let width = film.width.max(1) as usize;
        let done = AtomicU64::new(0);
        let stopped = std::sync::atomic::AtomicBool::new(false);
        let Some(pixels) = film.pixels.get_mut(rows.start as usize * width..rows.end as usize * width) else {
            return true;
        };
        let mut added = pixels.to_vec();
        let (first, rows) = (rows.start, u64::from(rows.len().max(1) as u32));
        added.par_chunks_mut(width).enumerate().for_each(|(row_index, row)| {
            if stopped.load(Ordering::Relaxed) {
                return;
            }
            for (x, sums) in row.iter_mut().enumerate() {
                let (x, y) = (x as u32, first + row_index as u32);
                if tiles.is_none_or(|tiles| tiles.contains(x, y)) {
                    for _ in 0..samples {
                        self.add_sample(&world, settings, x, y, sums);
                    }
                }
            }
            let rows_done = done.fetch_add(1, Ordering::Relaxed) + 1;
            if !progress(rows_done as f64 / rows as f64) {
                stopped.store(true, Ordering::Relaxed);
            }
        });
        if stopped.load(Ordering::Relaxed) && done.load(Ordering::Relaxed) < rows {
            return false;
        }
        pixels.copy_from_slice(&added);
        true
    }

    /// The scene's materials, read for paths of this mode.
    pub(crate) fn materials(&self, mode: ColorMode) -> Materials<'_> {
        Materials {
            scene: &self.scene,
            mode,
            brdf: normalised_lobe(&self.frame.equation),
            filter: match self.frame.texture_filter {
                TextureFilter::Nearest => TextureFilter::Nearest,
                _ => TextureFilter::Linear,
            },
            has_holes: self.has_holes,
            constants: &self.constants,
        }
    }

    fn add_sample(&self, world: &World, settings: &TraceSettings, x: u32, y: u32, sums: &mut PixelSums) {
        let frame = &self.frame;
        let mut sampler = Sampler::new(settings.seed, y.wrapping_mul(frame.width).wrapping_add(x), sums.samples);
        let at = sampler.next_2d();
        let mut wavelengths = world.materials.mode.wavelengths(&mut sampler);
        let (px, py) = (f64::from(x) + f64::from(at.x), f64::from(y) + f64::from(at.y));
        let ray = self.eye_ray(settings, px, py, &mut sampler);
        let found = world.follow(ray, &mut sampler, &mut wavelengths);
        let rgb = world.materials.mode.rgb(found.light, &wavelengths).as_dvec3();
        let behind =
            if found.hit || found.light != glam::Vec4::ZERO { [0.0; 4] } else { self.background(ray.direction, py) };
        let light = rgb + DVec3::new(behind[0], behind[1], behind[2]);
        sums.add(light, if found.hit { 1.0 } else { behind[3] });
    }

    /// What is seen where there is nothing.
    fn background(&self, direction: Vec3, py: f64) -> [f64; 4] {
        match (&self.lights.environment, self.frame.surroundings) {
            (Some(environment), Some(surroundings)) if surroundings.visible => {
                let seen = match &self.scene.environment {
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
    pub(crate) fn eye_ray(&self, settings: &TraceSettings, px: f64, py: f64, sampler: &mut Sampler) -> Ray {
        let Frame { camera, width, height, .. } = &self.frame;
        let mut eye = camera.position;
        let mut direction = camera.ray_direction(px, py, *width, *height);
        if settings.aperture > 0.0 {
            let on_lens = sampling::disc(sampler.next_2d()).as_dvec2() * settings.aperture;
            let focused = eye + direction * (settings.focus / direction.dot(camera.front));
            eye += camera.right * on_lens.x + camera.up * on_lens.y;
            direction = (focused - eye).normalize_or(camera.front);
        }
        let cos = direction.dot(camera.front);
        let space = &self.geometry.space;
        let start = eye + direction * (camera.near / cos);
        Ray {
            origin: space.point(start),
            direction: direction.as_vec3().normalize(),
            reach: ((camera.far - camera.near) / cos * space.scale) as f32,
        }
    }
}
