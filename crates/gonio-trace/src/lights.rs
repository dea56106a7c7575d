//! Light sources: which one to sample, and where.
//!
//! | source | strength | sampled by |
//! |---|---|---|
//! | point, spot | radiant intensity, W/sr; falls with the square of the distance | its one direction |
//! | directional | irradiance perpendicular to the rays, W/m^2 | its one direction |
//! | lamp | radiance | its visible part, see `lamps` |
//! | triangle | radiance of its material, on both sides | a point of its area |
//! | environment | radiance | brightness |
//!
//! One source is chosen for each place, see `choice`. Where points replace all other sources (`Simplification::Sum`) the first
//! surface of a path adds up all of them.

use crate::choice::{Reach, SourceChoice, SourceGroup, Vantage};
use crate::color::Tint;
use crate::environment::Environment;
use crate::geometry::{Geometry, Triangle, offset};
use crate::lamps::{Cone, Falloff, Lamp, LampShape, LightRules, facing_irradiance};
use crate::overlap::overlapping_triangles;
use crate::sampling;
use glam::{DVec3, Vec2, Vec3};
use gonio_light::{Light, LightKind};
use gonio_scene::LightShape;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightOrigin {
    /// A light: its index in the frame.
    Light(usize),
    /// An object that emits light: its index in the scene.
    Object(usize),
    /// The environment.
    Environment,
    /// The ambient term, of all ambient lights together; only with [`Simplification::Ambient`](crate::Simplification::Ambient).
    Ambient,
}

/// A light of the light equation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedLight {
    pub light: Light,
    pub shape: LightShape,
    pub origin: LightOrigin,
    /// The table of its spectrum, and that table's luminance.
    pub spectrum: Option<(u32, f64)>,
}

impl PlacedLight {
    /// `rgb` with the light's spectrum.
    pub fn tint(&self, rgb: DVec3) -> Tint {
        let tint = Tint::of_light(rgb.as_vec3());
        self.spectrum.map_or(tint, |(table, luminance)| tint.with_light(table, luminance))
    }
}

/// A source of light.
#[derive(Clone, Debug)]
pub(crate) enum LightSource {
    /// Intensity per trace unit.
    Point {
        position: Vec3,
        intensity: Tint,
        cone: Option<Cone>,
        falloff: Falloff,
    },
    /// `direction`: unit, to the light.
    Directional {
        direction: Vec3,
        irradiance: Tint,
    },
    /// Index into the lamps.
    Lamp(usize),
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
    /// Of each source.
    pub origins: Vec<LightOrigin>,
    choice: SourceChoice,
    /// With the index of each among the sources.
    pub lamps: Vec<(Lamp, usize)>,
    pub environment: Option<Arc<Environment>>,
    environment_index: usize,
    /// Of [`overlapping_triangles`].
    pub overlapping: Vec<u32>,
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
    pub source: usize,
}

/// The light of a sample.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Strength {
    /// Irradiance perpendicular to the one direction: a colour and its factor.
    Irradiance(Tint, f32),
    /// Radiance: a colour and its factor.
    Radiance(Tint, f32),
    /// The radiance of a triangle's material at these weights of its corners.
    Emitted(u32, Vec3),
}

/// What lights of a frame are turned into sources with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightUnits {
    /// Lights of colour 1 give this irradiance, or intensity.
    pub strength: f64,
    /// Where lights with another falloff than the inverse square law shine as brightly as they do in the light equation,
    /// world space.
    pub reference: DVec3,
    /// Lights count as at least so far from there, world units, so that one of constant brightness at the reference has
    /// an intensity: the distance of the nearest sides of the box around the objects, or 5 % of its diagonal where it is flat.
    pub least_distance: f64,
}

impl Lights {
    /// Those of a frame; triangles and environment are added by [`Self::add_triangles`] and [`Self::add_environment`], and
    /// [`Self::finish`] ends it.
    pub fn new(lights: &[PlacedLight], units: &LightUnits, geometry: &Geometry) -> (Self, Vec<f64>) {
        let mut built = Lights {
            sources: Vec::new(),
            origins: Vec::new(),
            choice: SourceChoice::default(),
            lamps: Vec::new(),
            environment: None,
            environment_index: usize::MAX,
            overlapping: Vec::new(),
        };
        let mut powers = Vec::new();
        for placed in lights {
            let color = placed.light.color.max(DVec3::ZERO) * units.strength;
            if !color.is_finite() || color == DVec3::ZERO {
                continue;
            }
            if let Some((source, power)) = built.source_of(placed, color, units, geometry) {
                built.sources.push(source);
                built.origins.push(placed.origin);
                powers.push(power);
            }
        }
        (built, powers)
    }

    fn source_of(
        &mut self,
        placed: &PlacedLight,
        color: DVec3,
        units: &LightUnits,
        geometry: &Geometry,
    ) -> Option<(LightSource, f64)> {
        let PlacedLight { light, shape, .. } = placed;
        let space = geometry.space;
        let (position, cone) = match light.kind {
            LightKind::Ambient => return None,
            LightKind::Directional { direction } => {
                let irradiance = placed.tint(color);
                let direction = -direction.as_vec3().normalize_or(-Vec3::Y);
                return Some((LightSource::Directional { direction, irradiance }, mean(color) * PI));
            }
            LightKind::Point { position } => (position, None),
            LightKind::Spot { position, axis, inner_rad, outer_rad } => {
                let axis = axis.as_vec3().normalize_or(-Vec3::Y);
                (position, Some(Cone { axis, outer: outer_rad.cos() as f32, inner: inner_rad.cos() as f32 }))
            }
        };
        let distance = position.distance(units.reference).max(units.least_distance);
        // As bright at the reference as the attenuation says; a light that obeys the inverse square law is itself.
        let a = light.attenuation;
        let at_reference = if a.constant == 0.0 && a.linear == 0.0 && a.quadratic > 0.0 {
            1.0 / a.quadratic
        } else {
            a.at(distance) * distance * distance
        };
        let falloff = Falloff { attenuation: a, norm: 1.0 / at_reference };
        let intensity = color * at_reference;
        let share = cone.map_or(1.0, |c| 0.5 * (1.0 - 0.5 * f64::from(c.outer + c.inner)));
        let power = 4.0 * PI * share * mean(intensity) * space.scale * space.scale;
        let center = space.point(position);
        let scaled = |v: DVec3| (v * space.scale).as_vec3();
        let lamp = match *shape {
            LightShape::Sphere { radius } if radius > 0.0 => {
                // E = L pi r^2 / d^2 = I / d^2
                let radiance = intensity / (PI * radius * radius);
                Some((LampShape::Sphere { center, radius: (radius * space.scale) as f32 }, radiance, cone))
            }
            LightShape::Rectangle { half_right, half_up } => {
                let (right, up) = (half_right.length(), half_up.length());
                let normal = half_right.cross(half_up).normalize_or_zero();
                // Turned to the reference it is as bright there as the spot that stands for it; turned aside, nearly.
                let cos = normal.dot((units.reference - position).normalize_or(normal)).clamp(0.25, 1.0);
                let gain = cos * (3.0 - 2.0 * cos);
                let radiance = intensity * gain / (distance * distance * facing_irradiance(right, up, distance));
                let half = Vec2::new((right * space.scale) as f32, (up * space.scale) as f32);
                let (right, up) = (scaled(half_right).normalize_or_zero(), scaled(half_up).normalize_or_zero());
                Some((LampShape::Rectangle { center, right, up, half }, radiance, None))
            }
            _ => None,
        };
        Some(match lamp {
            Some((shape, radiance, cone)) => {
                let lamp = Lamp { shape, radiance: placed.tint(radiance), cone, falloff };
                if !(shape.area() > 0.0 && shape.area().is_finite() && radiance.is_finite()) {
                    return None;
                }
                self.lamps.push((lamp, self.sources.len()));
                (LightSource::Lamp(self.lamps.len() - 1), power)
            }
            None => {
                // Distances are scaled, so is their square.
                let intensity = placed.tint(intensity * space.scale * space.scale);
                (LightSource::Point { position: center, intensity, cone, falloff }, power)
            }
        })
    }

    /// Adds the triangles that emit light. `emitted`: the radiance of a material without its texture.
    pub fn add_triangles(
        &mut self,
        powers: &mut Vec<f64>,
        geometry: &mut Geometry,
        emitted: impl Fn(&Triangle) -> DVec3,
    ) {
        for index in 0..geometry.triangles.len() {
            let triangle = geometry.triangles[index];
            let radiance = emitted(&triangle);
            let area = geometry.area(index as u32);
            if area > 0.0 && radiance.max_element() > 0.0 && radiance.is_finite() {
                geometry.triangles[index].light = Some(self.sources.len() as u32);
                self.sources.push(LightSource::Triangle { triangle: index as u32, area });
                self.origins.push(LightOrigin::Object(triangle.object as usize));
                powers.push(2.0 * PI * f64::from(area) * mean(radiance));
            }
        }
        self.overlapping = overlapping_triangles(geometry, &self.sources);
    }

    /// Adds the environment.
    pub fn add_environment(&mut self, powers: &mut Vec<f64>, environment: Option<Arc<Environment>>) {
        if let Some(environment) = environment.as_ref().filter(|e| e.mean.max_element() > 0.0) {
            self.environment_index = self.sources.len();
            self.sources.push(LightSource::Environment);
            self.origins.push(LightOrigin::Environment);
            powers.push(PI * PI * mean(environment.mean));
        }
        self.environment = environment;
    }

    /// Ends the list, with the power of each source.
    pub fn finish(mut self, powers: &[f64], geometry: &Geometry) -> Self {
        let mut groups: Vec<SourceGroup> = Vec::new();
        let mut first = 0;
        for sources in self.origins.chunk_by(|a, b| a == b && matches!(a, LightOrigin::Object(_))) {
            let range = first..first + sources.len();
            first = range.end;
            let powers = powers[range.clone()].to_vec();
            let reach = self.reach(range.clone(), powers.iter().sum(), geometry);
            groups.push(SourceGroup { first: range.start, powers, reach });
        }
        self.choice = SourceChoice::new(groups);
        self
    }

    /// Where the light of some sources, a light or the triangles of an object, comes from.
    fn reach(&self, sources: Range<usize>, power: f64, geometry: &Geometry) -> Reach {
        let ball = |center, radius, intensity| Reach::Ball {
            center,
            radius,
            intensity,
            cone: None,
            front: Vec3::ZERO,
            falloff: None,
        };
        match &self.sources[sources.start] {
            LightSource::Point { position, intensity, cone, falloff } => Reach::Ball {
                center: *position,
                radius: 0.0,
                intensity: mean_of(intensity),
                cone: *cone,
                front: Vec3::ZERO,
                falloff: Some(*falloff),
            },
            LightSource::Directional { direction, irradiance } => {
                Reach::Directional { direction: *direction, irradiance: mean_of(irradiance) }
            }
            LightSource::Lamp(lamp) => {
                let Lamp { shape, radiance, falloff, .. } = &self.lamps[*lamp].0;
                let (center, radius, seen, front) = match *shape {
                    LampShape::Sphere { center, radius } => (center, radius, 0.25, Vec3::ZERO),
                    LampShape::Rectangle { center, right, up, half } => (center, half.length(), 1.0, right.cross(up)),
                };
                let intensity = mean_of(radiance) * shape.area() * seen;
                Reach::Ball { center, radius, intensity, cone: None, front, falloff: Some(*falloff) }
            }
            LightSource::Triangle { .. } => {
                let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
                for source in &self.sources[sources] {
                    if let LightSource::Triangle { triangle, .. } = source {
                        for corner in geometry.corners(*triangle) {
                            (low, high) = (low.min(corner), high.max(corner));
                        }
                    }
                }
                ball(0.5 * (low + high), 0.5 * (high - low).length(), (power / (4.0 * PI)) as f32)
            }
            LightSource::Environment => Reach::Everywhere { irradiance: (power / PI) as f32 },
        }
    }

    /// A source at `choice` in `[0, 1)`, and a direction to it.
    #[inline]
    pub fn sample(
        &self,
        geometry: &Geometry,
        rules: &LightRules,
        vantage: &Vantage,
        choice: f32,
        u: Vec2,
    ) -> Option<LightSample> {
        let (index, probability) = self.choice.sample(vantage, rules, choice)?;
        let from = vantage.position;
        match self.sources[index] {
            LightSource::Triangle { triangle, area } => {
                sample_triangle(index, triangle, area, probability, geometry, from, u)
            }
            _ => self.sample_source(index, probability, geometry, rules, from, u),
        }
    }

    /// A direction to one source, which is chosen with `probability`.
    #[inline(never)]
    pub fn sample_source(
        &self,
        index: usize,
        probability: f32,
        geometry: &Geometry,
        rules: &LightRules,
        from: Vec3,
        u: Vec2,
    ) -> Option<LightSample> {
        let one = |direction, end, irradiance: Tint, factor: f32| LightSample {
            direction,
            end,
            light: Strength::Irradiance(irradiance, factor),
            density: f32::INFINITY,
            probability,
            source: index,
        };
        match &self.sources[index] {
            &LightSource::Directional { direction, irradiance } => Some(one(direction, None, irradiance, 1.0)),
            LightSource::Point { position, intensity, cone, falloff } => {
                let way = *position - from;
                let distance2 = way.length_squared();
                let direction = way.try_normalize()?;
                let spot = cone.filter(|_| rules.has_cones).map_or(1.0, |cone| cone.at(-direction));
                let strength = if rules.attenuation {
                    spot * falloff.gain(rules, distance2.sqrt()) / distance2
                } else {
                    spot / distance2
                };
                (spot > 0.0).then(|| one(direction, Some(*position), *intensity, strength))
            }
            LightSource::Lamp(lamp) => {
                let (lamp, _) = &self.lamps[*lamp];
                let (direction, distance, density) = lamp.shape.sample(from, u)?;
                let strength = lamp.strength(rules, direction, Some(distance));
                (strength > 0.0).then(|| LightSample {
                    direction,
                    // Before a surface that the lamp lies on.
                    end: Some(from + direction * (distance - lamp.shape.rounding(direction, distance))),
                    light: Strength::Radiance(lamp.radiance, strength),
                    density: density * probability,
                    probability,
                    source: index,
                })
            }
            &LightSource::Triangle { triangle, area } => {
                sample_triangle(index, triangle, area, probability, geometry, from, u)
            }
            LightSource::Environment => {
                let environment = self.environment.as_ref()?;
                let (direction, density) = environment.sample(u)?;
                (density > 0.0).then(|| LightSample {
                    direction,
                    end: None,
                    light: Strength::Radiance(Tint::of_light(environment.radiance(direction)), 1.0),
                    density: density * probability,
                    probability,
                    source: index,
                })
            }
        }
    }

    /// The density with which [`Self::sample`] finds a direction that meets a lamp at `distance`, in 1/sr.
    pub fn lamp_density(&self, rules: &LightRules, lamp: usize, from: &Vantage, direction: Vec3, distance: f32) -> f32 {
        let (lamp, source) = &self.lamps[lamp];
        lamp.shape.density(from.position, direction, distance) * self.choice.probability(*source, from, rules)
    }

    /// The density with which [`Self::sample`] finds the point of a triangle light that lies at `distance` from where it is
    /// sampled, at an angle with this cosine; in 1/sr.
    pub fn triangle_density(&self, rules: &LightRules, source: u32, from: &Vantage, distance: f32, cos: f32) -> f32 {
        match self.sources[source as usize] {
            LightSource::Triangle { triangle, .. } if self.overlaps(triangle) => f32::INFINITY,
            LightSource::Triangle { area, .. } => {
                let density = distance * distance / (cos * area);
                if density.is_finite() {
                    density * self.choice.probability(source as usize, from, rules)
                } else {
                    f32::INFINITY
                }
            }
            _ => 0.0,
        }
    }

    /// The density with which [`Self::sample`] finds a direction of the environment, in 1/sr.
    pub fn environment_density(&self, rules: &LightRules, from: &Vantage, direction: Vec3) -> f32 {
        match &self.environment {
            Some(environment) if self.environment_index < self.sources.len() => {
                environment.density(direction) * self.choice.probability(self.environment_index, from, rules)
            }
            _ => 0.0,
        }
    }
}

/// A direction to a triangle, source `index`, which is chosen with `probability`.
#[inline(always)]
fn sample_triangle(
    index: usize,
    triangle: u32,
    area: f32,
    probability: f32,
    geometry: &Geometry,
    from: Vec3,
    u: Vec2,
) -> Option<LightSample> {
    let weights = sampling::triangle(u);
    let (point, error) = geometry.point(triangle, weights);
    let normal = geometry.geometric_normal(triangle);
    let way = point - from;
    let distance2 = way.length_squared();
    let direction = way * (1.0 / distance2.sqrt());
    let cos = normal.dot(direction).abs();
    let density = distance2 / (cos * area);
    // Not where the light is seen from the side, or so near that the direction is lost.
    (density.is_finite() && density > 0.0 && distance2 >= f32::MIN_POSITIVE).then(|| LightSample {
        direction,
        end: Some(offset(point, error, normal, -direction)),
        light: Strength::Emitted(triangle, weights),
        density: density * probability,
        probability,
        source: index,
    })
}

impl Lamp {
    /// The radiance along a ray that meets the lamp where it shines, relative to [`Lamp::radiance`]; `distance` from where
    /// light is scattered, none to the eye.
    pub fn strength(&self, rules: &LightRules, direction: Vec3, distance: Option<f32>) -> f32 {
        let spot = self.cone.filter(|_| rules.has_cones).map_or(1.0, |cone| cone.at(-direction));
        spot * distance.map_or(1.0, |distance| self.falloff.gain(rules, distance))
    }
}

fn mean(color: DVec3) -> f64 {
    color.element_sum() / 3.0
}

fn mean_of(tint: &Tint) -> f32 {
    tint.rgb().element_sum() / 3.0
}
