//! The picture from below: Snell's window in the surface of a pool.

use super::{ABSORBED, meet};
use crate::camera::{Pinhole, Ray};
use crate::noise::{WaveTrain, cell, fractal, gathered_light, step, wave_slope};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3, IVec2};
use gonio_bsdf::ParameterValues;
use gonio_trace::Sampler;

/// A camera below the water that looks up.
pub struct Diver {
    camera: Pinhole,
    index: f64,
    absorption: DVec3,
    ripples: f64,
    to_sun: DVec3,
}

/// The pool's depth and half its sides, and the eye's depth; m. The water's surface is at y = 0.
const DEPTH: f64 = 3.0;
const HALF: DVec2 = DVec2::new(9.0, 13.0);
const EYE: DVec3 = DVec3::new(0.0, -1.7, 0.0);

impl Diver {
    /// The picture with values of the parameters.
    pub fn new(values: &ParameterValues) -> Self {
        Self {
            camera: Pinhole::new(EYE, EYE + DVec3::new(0.0, 1.0, -0.42), 110.0),
            index: values.number("index"),
            absorption: ABSORBED * values.number("absorption"),
            ripples: values.number("ripples"),
            to_sun: DVec3::new(0.35, 0.80, -0.48).normalize(),
        }
    }

    fn normal(&self, at: DVec2, distance: f64) -> DVec3 {
        const WAVES: [WaveTrain; 5] =
            [(0.2, 2.1, 0.022), (1.4, 1.3, 0.020), (-0.9, 0.8, 0.016), (2.3, 0.47, 0.012), (0.9, 0.31, 0.009)];
        let visible = |length: f64| step(90.0 * length, 12.0 * length, distance);
        let slope = wave_slope(at, &WAVES, 600, visible) * self.ripples;
        DVec3::new(-slope.x, -1.0, -slope.y).normalize()
    }

    /// The sky with palms around the pool.
    fn sky(&self, direction: DVec3) -> DVec3 {
        let up = direction.y.max(0.0);
        let mut color = DVec3::new(0.16, 0.36, 0.95).lerp(DVec3::new(0.95, 1.05, 1.12), (1.0 - up).powi(4));
        let at = DVec2::new(direction.x, direction.z) / (up + 0.12);
        let cloud = step(0.52, 0.80, fractal(at * 1.3 + 7.7, 5, 610));
        color = color.lerp(DVec3::splat(1.35), 0.9 * cloud);
        let sun = direction.dot(self.to_sun);
        color += DVec3::new(1.0, 0.93, 0.80) * (60.0 * step(0.9985, 0.9993, sun) + 0.9 * sun.max(0.0).powi(160));
        let azimuth = direction.x.atan2(-direction.z);
        let mut shade = step(0.075, 0.06, up + 0.03 * fractal(DVec2::new(azimuth * 6.0, up * 8.0), 4, 611));
        for palm in 0..9 {
            shade = shade.max(palm_cover(direction, palm));
        }
        color.lerp(DVec3::new(0.022, 0.045, 0.018) + 0.02 * fractal(at * 4.0, 2, 612), shade)
    }

    /// The pool below the water.
    fn pool(&self, ray: &Ray) -> DVec3 {
        let walls = [
            ray.plane(DVec3::NEG_Y * DEPTH, DVec3::Y),
            ray.plane(DVec3::X * HALF.x * ray.direction.x.signum(), DVec3::X),
            ray.plane(DVec3::Z * HALF.y * ray.direction.z.signum(), DVec3::Z),
        ];
        let nearest = walls.iter().enumerate().filter_map(|(wall, distance)| Some((wall, (*distance)?)));
        let Some((wall, distance)) = nearest.min_by(|a, b| a.1.total_cmp(&b.1)) else { return DVec3::ZERO };
        let point = ray.at(distance);
        let face = [DVec2::new(point.x, point.z), DVec2::new(point.z, point.y), DVec2::new(point.x, point.y)][wall];
        let tile = face / 0.42;
        let within = (tile - tile.floor() - 0.5).abs().max_element();
        let fine = step(30.0, 6.0, distance);
        let number = tile.floor().as_ivec2();
        let tone = 0.86 + 0.22 * cell(number, 613);
        let mut albedo = DVec3::new(0.30, 0.66, 0.72) * tone;
        if cell(number, 614) > 0.93 {
            albedo = DVec3::new(0.10, 0.32, 0.52);
        }
        // A lane on the bottom.
        if wall == 0 && (point.x.abs() - 2.6).abs() < 0.22 {
            albedo = DVec3::new(0.03, 0.09, 0.22);
        }
        let joint = 1.0 - 0.35 * step(0.44, 0.47, within) * fine;
        // The sun's light, gathered into lines by the ripples.
        let caustic = gathered_light(0.5 * face, 615) * self.ripples.min(1.0);
        let facing = if wall == 0 { 0.80 } else { 0.30 };
        let light = facing * (0.62 + 2.6 * caustic) + 0.22;
        albedo * joint * light * (-self.absorption * (distance + 0.7 * -point.y)).exp()
    }
}

/// Whether a palm covers a direction, 0 to 1.
fn palm_cover(direction: DVec3, palm: i32) -> f64 {
    let random = |seed: u32| cell(IVec2::new(palm, 3), 620 + seed);
    let azimuth = f64::from(palm) / 9.0 * std::f64::consts::TAU + 0.5 * random(1);
    let away = DVec3::new(azimuth.sin(), 0.0, -azimuth.cos());
    let forward = direction.dot(away);
    if forward < 0.1 {
        return 0.0;
    }
    // The plane at distance 1: to the right and up, in its own units.
    let place = DVec2::new(direction.dot(DVec3::Y.cross(-away)) / forward, direction.y / forward);
    let height = 0.42 + 0.30 * random(2);
    let lean = 0.16 * (random(3) - 0.5);
    let trunk_x = lean * (place.y / height).powi(2);
    let trunk = step(0.016, 0.012, (place.x - trunk_x).abs()) * step(height, height - 0.01, place.y);
    let crown = place - DVec2::new(lean, height);
    let mut cover = trunk;
    for leaf in 0..9 {
        let angle = -0.5 + 0.52 * f64::from(leaf) + 0.2 * random(4 + leaf as u32);
        let length = 0.24 + 0.07 * random(20 + leaf as u32);
        let along = DVec2::from_angle(angle);
        let x = crown.dot(along);
        // Leaves bend down under their weight.
        let y = crown.perp_dot(along) + 0.66 * x * x * along.x.signum();
        let width = 0.034 * (1.0 - x / length) * (0.45 + 0.55 * (x * 190.0).sin().abs());
        if x > 0.0 && x < length && y.abs() < width {
            cover = 1.0;
        }
    }
    cover
}

impl ImagePlane for Diver {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y).filter(|_| ray.direction.y > 0.0) else {
            return self.pool(&ray);
        };
        let point = ray.at(distance);
        if point.x.abs() > HALF.x || point.z.abs() > HALF.y {
            return self.pool(&ray);
        }
        let normal = self.normal(DVec2::new(point.x, point.z), distance);
        let at_surface = meet(ray.direction, normal, self.index, 1.0);
        let mut down = at_surface.reflected;
        down.y = -down.y.abs();
        let mut light = at_surface.reflectance * self.pool(&Ray { origin: point, direction: down });
        if let Some(out) = at_surface.transmitted {
            // Radiance is larger in the denser medium: the same light from a smaller cone.
            let sky = self.sky(DVec3::new(out.x, out.y.abs(), out.z));
            light += (1.0 - at_surface.reflectance) * self.index * self.index * 0.6 * sky;
        }
        light * (-self.absorption * distance).exp()
    }
}
