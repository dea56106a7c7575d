//! The small bright lights of an environment, apart from all the rest: a sun, a lamp.
//!
//! A few directions over which the rest is averaged represent it well; a sun that is ten thousand times brighter they would
//! count up to twice or not at all. *Limits*: each is a point, so only lobes much wider than [`RADIUS_RAD`] may use them.

use crate::cubemap::{solid_angle, texel_direction};
use crate::face::Face;
use crate::panorama::color;
use crate::{CubeMips, Cubemap};
use glam::DVec3;
use std::f64::consts::PI;

/// Most lights that are separated.
pub const MOST_LIGHTS: usize = 8;

/// Light within this angle belongs to one light.
pub const RADIUS_RAD: f64 = 2.0 * PI / 180.0;

/// Texels count as bright above this many times the mean radiance.
const BRIGHT: f64 = 8.0;

/// A light with a smaller share of all light of the environment is left where it is.
const LEAST_SHARE: f64 = 0.002;

/// Texels along an edge of the rest at most, as for glossy reflection: lobes that are wide enough need no more.
const SIZE: u32 = 256;

/// A small bright light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallLight {
    /// Unit vector towards its middle, in the environment.
    pub direction: DVec3,
    /// Radiance beyond that of the rest, times solid angle: the irradiance of a surface that faces it.
    pub irradiance: DVec3,
}

/// An environment in two parts, whose sum it is.
#[derive(Clone, Debug)]
pub struct SeparatedLights {
    /// The brightest first, at most [`MOST_LIGHTS`].
    pub lights: Vec<SmallLight>,
    /// The environment without them.
    pub rest: CubeMips,
}

/// What is too bright in a texel.
struct BrightTexel {
    index: usize,
    direction: DVec3,
    excess: DVec3,
    solid_angle: f64,
}

impl SeparatedLights {
    /// Separates an environment.
    pub fn new(environment: &CubeMips) -> Self {
        let map = environment.levels().iter().find(|level| level.size() <= SIZE).unwrap_or(environment.full());
        let brightness = |light: DVec3| light.element_sum() / 3.0;
        let mean = brightness(map.mean_radiance());
        let limit = BRIGHT * mean;
        let mut texels = Vec::new();
        if mean > 0.0 && mean.is_finite() {
            for face in Face::ALL {
                for (at, pixel) in map.face(face).iter().enumerate() {
                    let radiance = color(*pixel);
                    let above = brightness(radiance) - limit;
                    if above > 0.0 && radiance.is_finite() {
                        let (x, y) = (at as u32 % map.size(), at as u32 / map.size());
                        texels.push(BrightTexel {
                            index: face as usize * map.face(face).len() + at,
                            direction: texel_direction(face, x, y, map.size()).normalize(),
                            excess: radiance * (above / brightness(radiance)),
                            solid_angle: solid_angle(x, y, map.size()),
                        });
                    }
                }
            }
        }
        texels.sort_by(|a, b| brightness(b.excess).total_cmp(&brightness(a.excess)));
        let mut rest: Option<Cubemap> = None;
        let mut lights = Vec::new();
        while let Some(brightest) = texels.first().map(|texel| texel.direction).filter(|_| lights.len() < MOST_LIGHTS) {
            let is_near = |texel: &BrightTexel| texel.direction.dot(brightest) > RADIUS_RAD.cos();
            let (near, far): (Vec<_>, Vec<_>) = texels.into_iter().partition(is_near);
            texels = far;
            let irradiance: DVec3 = near.iter().map(|texel| texel.excess * texel.solid_angle).sum();
            if brightness(irradiance) < LEAST_SHARE * 4.0 * PI * mean {
                continue;
            }
            let middle: DVec3 =
                near.iter().map(|texel| texel.direction * (brightness(texel.excess) * texel.solid_angle)).sum();
            lights.push(SmallLight { direction: middle.normalize_or(brightest), irradiance });
            let pixels = rest.get_or_insert_with(|| map.clone()).pixels_mut();
            for texel in near {
                if let Some([r, g, b, _]) = pixels.get_mut(texel.index) {
                    *r -= texel.excess.x as f32;
                    *g -= texel.excess.y as f32;
                    *b -= texel.excess.z as f32;
                }
            }
        }
        let rest = rest.map_or_else(
            || CubeMips::from_levels(environment.levels().iter().filter(|l| l.size() <= map.size()).cloned().collect()),
            CubeMips::new,
        );
        lights.sort_by(|a, b| brightness(b.irradiance).total_cmp(&brightness(a.irradiance)));
        SeparatedLights { lights, rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sky::Sky;

    #[test]
    fn the_sun_is_separated_and_no_light_is_lost() {
        let sky = CubeMips::new(Sky::default().cubemap(128));
        let separated = SeparatedLights::new(&sky);
        assert_eq!(separated.lights.len(), 1);
        let sun = separated.lights[0];
        assert!(sun.direction.angle_between(Sky::default().sun) < 0.3_f64.to_radians(), "{sun:?}");
        let sum = separated.rest.full().mean_radiance() + sun.irradiance / (4.0 * PI);
        let whole = sky.full().mean_radiance();
        assert!((sum - whole).abs().max_element() < 1e-4 * whole.max_element(), "{sum} of {whole}");
        let brightest = separated.rest.full().pixels().iter().fold(0.0_f32, |most, p| most.max(p[0]));
        assert!(f64::from(brightest) < 20.0 * whole.max_element(), "{brightest}");
    }

    #[test]
    fn even_light_and_darkness_have_no_lights() {
        for value in [0.0, 1.0] {
            let map = CubeMips::new(Cubemap::from_function(16, |_| DVec3::splat(value)));
            let separated = SeparatedLights::new(&map);
            assert!(separated.lights.is_empty() && separated.rest == map, "{value}");
        }
    }

    /// Beyond the limit the weakest stay in the rest.
    #[test]
    fn many_lamps_are_no_more_than_the_limit() {
        let lamps: Vec<DVec3> =
            (0..12).map(|i| DVec3::from_array([f64::from(i).sin(), f64::from(i).cos(), 0.3])).collect();
        let radiance = |d: DVec3| {
            let near = |lamp: &DVec3| d.angle_between(*lamp) < 0.03;
            DVec3::splat(if lamps.iter().any(near) { 400.0 } else { 0.5 })
        };
        let separated = SeparatedLights::new(&CubeMips::new(Cubemap::from_function(128, radiance)));
        assert_eq!(separated.lights.len(), MOST_LIGHTS);
    }
}
