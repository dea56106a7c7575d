//! What a picture shows without its light: colour, direction and distance of the first surface behind each pixel.

use crate::Simplification;
use crate::color::ColorMode;
use crate::path::World;
use crate::render::{TraceScene, TraceSettings};
use crate::sampler::Sampler;
use crate::tree::Ray;
use crate::wavelengths::Wavelengths;
use glam::Vec3;
use rayon::prelude::*;

/// Means over each pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Features {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Share of light that the first surface reflects, linear RGB in `[0, 1]`: 1 for mirrors and glass, and where there is
    /// no surface.
    pub albedo: Vec<[f32; 3]>,
    /// Normal of the first surface towards the eye, world space; at outlines shorter than 1; 0 where there is no surface.
    pub normal: Vec<[f32; 3]>,
    /// Distance of the first surface from the near plane, relative to the largest extent of the scene; 0 where there is no
    /// surface.
    pub depth: Vec<f32>,
}

/// One pixel, or the sum of some of its points.
#[derive(Clone, Copy, Default)]
struct Feature {
    albedo: Vec3,
    normal: Vec3,
    depth: f32,
}

/// Holes in a row that count, at most.
const MOST_HOLES: u32 = 64;

impl TraceScene {
    /// The features of each pixel of the frame, from `samples` >= 1 points of it. Points that paths go through, holes, show what is
    /// behind them.
    pub fn features(&self, settings: &TraceSettings, samples: u32) -> Features {
        let (width, height) = (self.frame.width, self.frame.height);
        let count = width as usize * height as usize;
        let samples = samples.max(1);
        let rgb = TraceSettings { simplified: settings.simplified.with(Simplification::Wavelengths), ..*settings };
        let mut pixels = vec![Feature::default(); count];
        for sample in 0..samples {
            // Where something moves, at the moment of the film's sample: what is blurred has blurred features.
            let posed = self.posed_for(settings, sample);
            let world = posed.world(&self.frame, &rgb, None);
            pixels.par_iter_mut().enumerate().for_each(|(i, sum)| {
                let one = self.feature(&world, settings, i as u32 % width, i as u32 / width, sample);
                sum.albedo += one.albedo;
                sum.normal += one.normal;
                sum.depth += one.depth;
            });
        }
        let scale = 1.0 / samples as f32;
        for pixel in &mut pixels {
            *pixel = Feature { albedo: pixel.albedo * scale, normal: pixel.normal * scale, depth: pixel.depth * scale };
        }
        Features {
            width,
            height,
            albedo: pixels.iter().map(|p| p.albedo.to_array()).collect(),
            normal: pixels.iter().map(|p| p.normal.to_array()).collect(),
            depth: pixels.iter().map(|p| p.depth).collect(),
        }
    }

    fn feature(&self, world: &World, settings: &TraceSettings, x: u32, y: u32, sample: u32) -> Feature {
        // The points of the film's samples, so that outlines have the same shares.
        let mut sampler = Sampler::new(settings.seed, y.wrapping_mul(self.frame.width).wrapping_add(x), sample);
        let at = sampler.next_2d();
        ColorMode::of(settings.simplified).wavelengths(&mut sampler, world.materials.spectra);
        let mut wavelengths = Wavelengths::NONE;
        let (materials, geometry) = (&world.materials, world.geometry);
        let (px, py) = (f64::from(x) + f64::from(at.x), f64::from(y) + f64::from(at.y));
        let mut ray = self.eye_ray(world, settings, px, py, &mut sampler);
        let mut travelled = 0.0;
        for _ in 0..MOST_HOLES {
            let hit = geometry.tree.nearest(&ray);
            let reach = hit.as_ref().map_or(ray.reach, |hit| hit.distance);
            if let Some((_, distance, _)) = world.lights.nearest_lamp(&Ray { reach, ..ray }) {
                return Feature { albedo: Vec3::ONE, normal: -ray.direction, depth: travelled + distance };
            }
            let Some(hit) = hit else { break };
            let place = geometry.place(materials.scene, &hit);
            let triangle = &geometry.triangles[hit.triangle as usize];
            let material = triangle.material;
            travelled += hit.distance;
            if sampler.next_1d() >= materials.opacity(material, place.uv) {
                ray.origin = place.leave(ray.direction);
                ray.reach = f32::INFINITY;
                continue;
            }
            let view = -ray.direction;
            let normal = materials.normal(material, &place);
            let parts = materials.parts(material, &place, normal, view, &mut wavelengths);
            let through = (parts.mirror.max(parts.clear)).clamp(0.0, 1.0);
            let rough = (parts.diffuse + parts.glossy).truncate().clamp(Vec3::ZERO, Vec3::ONE);
            let albedo = match materials.own_brdf(material) {
                Some(brdf) => brdf.albedo.as_vec3(),
                None => rough.lerp(Vec3::ONE, through),
            };
            let emits = materials.emitted(triangle, place.uv);
            let albedo =
                if materials.mode.light(&emits, &wavelengths) == glam::Vec4::ZERO { albedo } else { Vec3::ONE };
            let normal = if normal.dot(view) < 0.0 { -normal } else { normal };
            if !(albedo.is_finite() && normal.is_finite() && travelled.is_finite()) {
                break;
            }
            return Feature { albedo, normal, depth: travelled };
        }
        Feature { albedo: Vec3::ONE, normal: Vec3::ZERO, depth: 0.0 }
    }
}
