//! The light that arrives at a point of a surface, for lightmaps: paths that start there instead of at the eye.

use crate::film::PixelSums;
use crate::geometry::{Place, Space};
use crate::render::{TraceScene, TraceSettings};
use crate::sampler::Sampler;
use glam::{DVec3, Vec2, Vec3};

/// A point of a surface, world space.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The position.
    pub position: DVec3,
    /// Unit normal of the triangle, on either side.
    pub geometric_normal: DVec3,
    /// Unit normal that the light equation would use, on the side whose light counts.
    pub normal: DVec3,
}

/// The light at a point of a surface, estimated by paths.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceLight {
    /// `E / pi`, linear RGB, where `E` is the irradiance of the surface: the radiance of a white surface (`k_d = 1`) there, and so
    /// what `k_d` is multiplied by.
    pub radiance: DVec3,
    /// Variance of the luminance of `radiance`, the square of its standard error; 0 with fewer than two paths.
    pub variance: f64,
    /// Paths that were not finite and count as black.
    pub lost: u32,
}

impl TraceScene {
    /// Estimates the light at a point of a surface with paths that start there: with directions whose density is the cosine by
    /// pi, samples of the lights, and everything after as in pictures. The surface need not be one of the scene's; its own
    /// material does not matter, nor does light that it emits. The shutter is closed.
    ///
    /// `number` selects the random numbers, as a pixel does in a picture: equal numbers give equal results on any thread.
    pub fn light_at(&self, settings: &TraceSettings, point: &SurfacePoint, number: u32, paths: u32) -> SurfaceLight {
        let posed = &self.posed;
        let summed = posed.summed(self.frame(), settings);
        let world = posed.world(self.frame(), settings, summed.as_deref());
        let place = place(point, &posed.geometry.space);
        let mode = world.materials.mode;
        let mut sums = PixelSums::default();
        for index in 0..paths {
            let mut sampler = Sampler::new(settings.seed, number, index);
            let mut wavelengths = mode.wavelengths(&mut sampler, world.materials.spectra);
            let light = world.follow_from_white(&place, &mut sampler, &mut wavelengths);
            sums.add(mode.rgb(light, &wavelengths).as_dvec3(), 1.0);
        }
        let radiance = sums.light / f64::from(paths.max(1));
        SurfaceLight { radiance, variance: sums.variance().0, lost: sums.lost }
    }
}

fn place(point: &SurfacePoint, space: &Space) -> Place {
    let normal = point.normal.as_vec3().normalize_or(Vec3::Z);
    let geometric_normal = point.geometric_normal.as_vec3().normalize_or(normal);
    let geometric_normal = if geometric_normal.dot(normal) < 0.0 { -geometric_normal } else { geometric_normal };
    // Rounding of the scene's triangles, as in `Facet`, and of world positions, which may be f32 too.
    let of_world = point.position.abs().max_element() * space.scale;
    Place {
        position: space.point(point.position),
        error: f32::EPSILON * (9.0 * 0.5 * 0.5 + of_world as f32),
        geometric_normal,
        normal,
        normal_turned: false,
        flat: false,
        tangent: None,
        uv: Vec2::ZERO,
        color: Vec3::ONE,
    }
}
