//! Light sources: which one to sample, and where.
//!
//! | source | strength | sampled by |
//! |---|---|---|
//! | point, spot | radiant intensity, W/sr; falls with the square of the distance | its one direction |
//! | directional | irradiance perpendicular to the rays, W/m^2 | its one direction |
//! | triangle | radiance of its material, on both sides | a point of its area |
//! | environment | radiance | brightness |
//!
//! One source is chosen for each point, with a probability proportional to its power.

use crate::color::Tint;
use crate::environment::Environment;
use crate::geometry::{Geometry, Triangle, offset};
use crate::sampling::{self, Discrete};
use glam::{DVec3, Vec2, Vec3};
use gonio_light::{Attenuation, Light, LightKind, light};
use std::f64::consts::PI;

/// A source of light.
#[derive(Clone, Copy, Debug)]
pub(crate) enum LightSource {
    /// Intensity per trace unit; `cone`: axis, cosines of outer and inner half angle.
    Point {
        position: Vec3,
        intensity: Tint,
        cone: Option<(Vec3, f32, f32)>,
    },
    /// `direction`: unit, to the light.
    Directional {
        direction: Vec3,
        irradiance: Tint,
    },
    /// Index of the triangle, its area.
    Triangle {
        triangle: u32,
        area: f32,
    },
    Environment,
}

/// All sources.
pub(crate) struct Lights {
    pub sources: Vec<LightSource>,
    choice: Discrete,
    pub environment: Option<Environment>,
    environment_index: usize,
}

/// Light that may reach a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample {
    /// Unit, to the light.
    pub direction: Vec3,
    /// The end of the shadow ray; infinitely far where none.
    pub end: Option<Vec3>,
    pub light: Strength,
    /// In 1/sr, the choice of the source included; infinite for a single direction.
    pub density: f32,
    /// The probability of the source.
    pub probability: f32,
}

/// The light of a sample.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Strength {
    /// Irradiance perpendicular to the one direction: a colour and its factor.
    Irradiance(Tint, f32),
    /// Radiance, linear RGB.
    Radiance(Vec3),
    /// The radiance of a triangle's material at these weights of its corners.
    Emitted(u32, Vec3),
}

impl Lights {
    /// `emitted`: the radiance of a material without its texture. `reference`: where lights with another falloff than
    /// the inverse square law shine as brightly as they do in the light equation, world space.
    pub fn new(
        lights: &[Light],
        strength: f64,
        reference: DVec3,
        geometry: &mut Geometry,
        emitted: impl Fn(&Triangle) -> DVec3,
        environment: Option<Environment>,
    ) -> Self {
        let mut sources = Vec::new();
        let mut powers = Vec::new();
        let space = geometry.space;
        for light in lights {
            let color = light.color.max(DVec3::ZERO) * strength;
            if !color.is_finite() || color == DVec3::ZERO {
                continue;
            }
            match light.kind {
                LightKind::Ambient => {}
                LightKind::Directional { direction } => {
                    let irradiance = Tint::of_light(color.as_vec3());
                    sources.push(LightSource::Directional {
                        direction: -direction.as_vec3().normalize_or(-Vec3::Y),
                        irradiance,
                    });
                    powers.push(mean(color) * PI);
                }
                LightKind::Point { position } | LightKind::Spot { position, .. } => {
                    let intensity = color * inverse_square_factor(&light.attenuation, position.distance(reference));
                    // Distances are scaled, so is their square.
                    let intensity = intensity * space.scale * space.scale;
                    let (cone, share) = match light.kind {
                        LightKind::Spot { axis, inner_rad, outer_rad, .. } => {
                            let (outer, inner) = (outer_rad.cos(), inner_rad.cos());
                            let axis = axis.as_vec3().normalize_or(-Vec3::Y);
                            (Some((axis, outer as f32, inner as f32)), 0.5 * (1.0 - 0.5 * (outer + inner)))
                        }
                        _ => (None, 1.0),
                    };
                    let position = space.point(position);
                    sources.push(LightSource::Point { position, intensity: Tint::of_light(intensity.as_vec3()), cone });
                    powers.push(4.0 * PI * share * mean(intensity));
                }
            }
        }
        for index in 0..geometry.triangles.len() {
            let triangle = geometry.triangles[index];
            let radiance = emitted(&triangle);
            let area = geometry.area(&triangle);
            if area > 0.0 && radiance.max_element() > 0.0 && radiance.is_finite() {
                geometry.triangles[index].light = Some(sources.len() as u32);
                sources.push(LightSource::Triangle { triangle: index as u32, area });
                powers.push(2.0 * PI * f64::from(area) * mean(radiance));
            }
        }
        let environment_index = sources.len();
        if let Some(environment) = environment.as_ref().filter(|e| e.mean.max_element() > 0.0) {
            sources.push(LightSource::Environment);
            powers.push(PI * PI * mean(environment.mean));
        }
        Lights { sources, choice: Discrete::new(powers), environment, environment_index }
    }

    /// A source at `choice` in `[0, 1)`, and a direction to it from `from`.
    pub fn sample(&self, geometry: &Geometry, from: Vec3, choice: f32, u: Vec2) -> Option<LightSample> {
        let (index, probability, _) = self.choice.sample(choice)?;
        let one = |direction, end, irradiance: Tint, factor: f32| LightSample {
            direction,
            end,
            light: Strength::Irradiance(irradiance, factor),
            density: f32::INFINITY,
            probability,
        };
        match self.sources[index] {
            LightSource::Directional { direction, irradiance } => Some(one(direction, None, irradiance, 1.0)),
            LightSource::Point { position, intensity, cone } => {
                let way = position - from;
                let distance2 = way.length_squared();
                let direction = way.try_normalize()?;
                let spot = cone.map_or(1.0, |(axis, outer, inner)| {
                    light::smoothstep_or_step(outer.into(), inner.into(), (-direction.dot(axis)).into()) as f32
                });
                (spot > 0.0).then(|| one(direction, Some(position), intensity, spot / distance2))
            }
            LightSource::Triangle { triangle, area } => {
                let t = &geometry.triangles[triangle as usize];
                let weights = sampling::triangle(u);
                let (point, error) = geometry.point(t, weights);
                let normal = geometry.geometric_normal(triangle);
                let way = point - from;
                let direction = way.try_normalize()?;
                let cos = normal.dot(direction).abs();
                let density = way.length_squared() / (cos * area);
                (density.is_finite() && density > 0.0).then(|| LightSample {
                    direction,
                    end: Some(offset(point, error, normal, -direction)),
                    light: Strength::Emitted(triangle, weights),
                    density: density * probability,
                    probability,
                })
            }
            LightSource::Environment => {
                let environment = self.environment.as_ref()?;
                let (direction, density) = environment.sample(u)?;
                (density > 0.0).then(|| LightSample {
                    direction,
                    end: None,
                    light: Strength::Radiance(environment.radiance(direction)),
                    density: density * probability,
                    probability,
                })
            }
        }
    }

    /// The density with which [`Self::sample`] finds the point of a triangle light that lies at `distance` from where it is
    /// sampled, at an angle with this cosine; in 1/sr.
    pub fn triangle_density(&self, source: u32, distance: f32, cos: f32) -> f32 {
        match self.sources[source as usize] {
            LightSource::Triangle { area, .. } => {
                let density = distance * distance / (cos * area);
                if density.is_finite() { density * self.choice.probability(source as usize) } else { f32::INFINITY }
            }
            _ => 0.0,
        }
    }

    /// The density with which [`Self::sample`] finds a direction of the environment, in 1/sr.
    pub fn environment_density(&self, direction: Vec3) -> f32 {
        match &self.environment {
            Some(environment) if self.environment_index < self.sources.len() => {
                environment.density(direction) * self.choice.probability(self.environment_index)
            }
            _ => 0.0,
        }
    }
}

/// The intensity of a light under the inverse square law that has the given attenuation at `distance`, for a colour of 1.
/// Without the cap of the light equation: a light with `k_q` alone has the intensity `1 / k_q` wherever it is.
fn inverse_square_factor(attenuation: &Attenuation, distance: f64) -> f64 {
    let Attenuation { constant, linear, quadratic } = *attenuation;
    if constant == 0.0 && linear == 0.0 && quadratic > 0.0 {
        return 1.0 / quadratic;
    }
    attenuation.at(distance) * distance * distance
}

fn mean(color: DVec3) -> f64 {
    color.element_sum() / 3.0
}
