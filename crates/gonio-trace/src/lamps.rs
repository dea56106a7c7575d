//! Lamps: light sources of the scene with the shape of a sphere or a rectangle.
//!
//! | shape | shines | sampled by | density, 1/sr |
//! |---|---|---|---|
//! | sphere | outwards | its visible cone, uniformly (P. Shirley, C. Wang and K. Zimmerman, *Monte Carlo Techniques for Direct Lighting Calculations*, 1996) | `1 / (2 pi (1 - cos a))`, `sin a = r / d` |
//! | rectangle | from its front | its solid angle `S`, uniformly (C. Ureña, M. Fajardo and A. King, *An Area-Preserving Parametrization for Spherical Rectangles*, 2013); a tiny one by area | `1 / S`; `d^2 / (cos area)` |
//!
//! Lamps are surfaces: the eye and mirrors see them, they reflect nothing, and they block light. From inside, a sphere can be left
//! and gives no light. The back of a rectangle is black.

use crate::color::Tint;
use crate::tree::Ray;
use glam::{DVec2, DVec3, Vec2, Vec3};
use gonio_light::{Attenuation, light};
use std::f32::consts::TAU;

/// The cone of a spot light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    /// Unit, along the light.
    pub axis: Vec3,
    /// Cosines of the half angles.
    pub outer: f32,
    pub inner: f32,
}

impl Cone {
    /// The spot factor for light that travels along `direction`, unit.
    pub fn at(&self, direction: Vec3) -> f32 {
        light::smoothstep_or_step(self.outer.into(), self.inner.into(), direction.dot(self.axis).into()) as f32
    }
}

/// How a light falls with the distance when [`Simplification::Attenuation`](crate::Simplification::Attenuation) is on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Falloff {
    pub attenuation: Attenuation,
    /// `1 / (att(d) d^2)` at the distance where it is as bright as by the inverse square law, world units.
    pub norm: f64,
}

/// What the simplifications change about lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightRules {
    /// The attenuation replaces the inverse square law.
    pub attenuation: bool,
    /// The equation's attenuation, and its spot factor, are not switched off.
    pub attenuates: bool,
    pub has_cones: bool,
    /// Units of trace space per world unit.
    pub scale: f64,
}

impl Falloff {
    /// The light at `distance`, in trace space, relative to that by the inverse square law.
    pub fn gain(&self, rules: &LightRules, distance: f32) -> f32 {
        if !rules.attenuation {
            return 1.0;
        }
        let d = f64::from(distance) / rules.scale;
        let factor = if rules.attenuates { self.attenuation.at(d) } else { 1.0 };
        (factor * d * d * self.norm) as f32
    }
}

/// A lamp.
#[derive(Clone, Debug)]
pub(crate) struct Lamp {
    pub shape: LampShape,
    pub radiance: Tint,
    pub cone: Option<Cone>,
    pub falloff: Falloff,
}

/// The shape of a lamp, in trace space.
#[derive(Clone, Copy, Debug)]
pub(crate) enum LampShape {
    Sphere {
        center: Vec3,
        radius: f32,
    },
    /// `right` and `up`: unit; `right x up` is the way it shines. `half`: half width and height.
    Rectangle {
        center: Vec3,
        right: Vec3,
        up: Vec3,
        half: Vec2,
    },
}

/// Rectangles with a smaller solid angle, sr, are sampled by area: the sum of angles that gives it cancels.
const LEAST_SOLID_ANGLE: f64 = 1e-7;

impl LampShape {
    /// Surface that shines, in units of trace space squared.
    pub fn area(&self) -> f32 {
        match self {
            LampShape::Sphere { radius, .. } => 2.0 * TAU * radius * radius,
            LampShape::Rectangle { half, .. } => 4.0 * half.x * half.y,
        }
    }

    /// The distance at which a ray meets the lamp, and whether where it shines.
    pub fn hit(&self, ray: &Ray) -> Option<(f32, bool)> {
        match *self {
            LampShape::Sphere { center, radius } => {
                let way = center - ray.origin;
                let along = way.dot(ray.direction);
                let across2 = (way - along * ray.direction).length_squared();
                let half2 = radius * radius - across2;
                if half2 <= 0.0 || along <= 0.0 || way.length_squared() <= radius * radius {
                    return None;
                }
                let distance = along - half2.sqrt();
                (distance > 0.0 && distance < ray.reach).then_some((distance, true))
            }
            LampShape::Rectangle { center, right, up, half } => {
                let normal = right.cross(up);
                let cos = normal.dot(ray.direction);
                let distance = normal.dot(center - ray.origin) / cos;
                // Written so that a ray in the rectangle's plane, whose distance is not a number, misses it.
                if !(distance > 0.0 && distance < ray.reach) {
                    return None;
                }
                let p = ray.origin + distance * ray.direction - center;
                let inside = p.dot(right).abs() <= half.x && p.dot(up).abs() <= half.y;
                inside.then_some((distance, cos < 0.0))
            }
        }
    }

    /// Bound of the rounding error of the distance at which a ray meets the lamp, or a surface in the same place.
    pub fn rounding(&self, direction: Vec3, distance: f32) -> f32 {
        let cos = match self {
            LampShape::Sphere { .. } => 1.0,
            LampShape::Rectangle { right, up, .. } => right.cross(*up).dot(direction).abs(),
        };
        // Scenes have the size 1.
        (8.0 * f32::EPSILON * (1.0 + distance) / cos).min(0.01 * distance)
    }

    /// A ray, its origin and direction, that meets a place of the lamp's shining side at a right angle.
    pub fn looked_at(&self, u: Vec2) -> (Vec3, Vec3) {
        match *self {
            LampShape::Sphere { center, radius } => {
                let outward = crate::sampling::from_polar(2.0 * u.x - 1.0, u.y);
                (center + 2.0 * radius * outward, -outward)
            }
            LampShape::Rectangle { center, right, up, half } => {
                let normal = right.cross(up);
                let p = half * (2.0 * u - Vec2::ONE);
                (center + right * p.x + up * p.y + normal * half.max_element(), -normal)
            }
        }
    }

    /// A direction from a point to the lamp, the distance, and the density, in 1/sr. `None` where the lamp does not shine on
    /// the point.
    pub fn sample(&self, from: Vec3, u: Vec2) -> Option<(Vec3, f32, f32)> {
        match *self {
            LampShape::Sphere { center, radius } => {
                let way = center - from;
                let distance2 = way.length_squared();
                let one_minus_cos = one_minus_cos(distance2, radius)?;
                let axis = way / distance2.sqrt();
                let (t, b) = crate::sampling::frame(axis);
                let x = u.x * one_minus_cos;
                let sin2 = x * (2.0 - x);
                let (s, c) = (TAU * u.y).sin_cos();
                let direction = ((t * c + b * s) * sin2.max(0.0).sqrt() + axis * (1.0 - x)).normalize();
                let distance = distance2.sqrt() * (1.0 - x) - (radius * radius - distance2 * sin2).max(0.0).sqrt();
                Some((direction, distance.max(0.0), 1.0 / (TAU * one_minus_cos)))
            }
            LampShape::Rectangle { center, right, up, half } => {
                let seen = SphericalRectangle::new(from, center, right, up, half)?;
                let to_lamp = if seen.solid_angle > LEAST_SOLID_ANGLE {
                    seen.sample(u)
                } else {
                    let p = half * (2.0 * u - Vec2::ONE);
                    (center + right * p.x + up * p.y - from).as_dvec3()
                };
                let distance = to_lamp.length();
                let direction = (to_lamp / distance).as_vec3();
                let density = self.rectangle_density(&seen, direction, distance as f32);
                (distance > 0.0 && density > 0.0).then_some((direction, distance as f32, density))
            }
        }
    }

    /// The density with which [`Self::sample`] finds a direction that meets the lamp at `distance`, in 1/sr.
    pub fn density(&self, from: Vec3, direction: Vec3, distance: f32) -> f32 {
        match *self {
            LampShape::Sphere { center, radius } => {
                one_minus_cos(center.distance_squared(from), radius).map_or(0.0, |x| 1.0 / (TAU * x))
            }
            LampShape::Rectangle { center, right, up, half } => SphericalRectangle::new(from, center, right, up, half)
                .map_or(0.0, |seen| self.rectangle_density(&seen, direction, distance)),
        }
    }

    fn rectangle_density(&self, seen: &SphericalRectangle, direction: Vec3, distance: f32) -> f32 {
        if seen.solid_angle > LEAST_SOLID_ANGLE {
            return (1.0 / seen.solid_angle) as f32;
        }
        let LampShape::Rectangle { right, up, .. } = *self else { return 0.0 };
        let density = distance * distance / (-right.cross(up).dot(direction) * self.area());
        if density.is_finite() { density.max(0.0) } else { 0.0 }
    }
}

/// The irradiance of a surface from a rectangle of radiance 1 and these half edges, in front of its centre and facing it (J. H.
/// Lambert, *Photometria*, 1760).
pub(crate) fn facing_irradiance(half_width: f64, half_height: f64, distance: f64) -> f64 {
    let one = |a: f64, b: f64| {
        let slant = a.hypot(distance);
        a / slant * (b / slant).atan()
    };
    2.0 * (one(half_width, half_height) + one(half_height, half_width))
}

/// `1 - cos a` of the cone in which a sphere is seen; `None` from inside.
fn one_minus_cos(distance2: f32, radius: f32) -> Option<f32> {
    let sin2 = radius * radius / distance2;
    // `1 - cos = sin^2 / (1 + cos)`, which does not cancel for a small sphere.
    (sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
}

/// A rectangle as a point sees it (Ureña, Fajardo and King). In f64: differences of angles cancel.
struct SphericalRectangle {
    right: DVec3,
    up: DVec3,
    /// From the point to its plane; negative along `right x up` as the point is in front.
    z: DVec3,
    z0: f64,
    low: DVec2,
    high: DVec2,
    b0: f64,
    b1: f64,
    k: f64,
    solid_angle: f64,
}

impl SphericalRectangle {
    /// `None` from behind and from its plane.
    fn new(from: Vec3, center: Vec3, right: Vec3, up: Vec3, half: Vec2) -> Option<Self> {
        let (right, up, half) = (right.as_dvec3(), up.as_dvec3(), half.as_dvec2());
        let z = right.cross(up);
        let way = center.as_dvec3() - from.as_dvec3();
        let z0 = way.dot(z);
        // A surface in the plane of the lamp may be on either side by rounding. Scenes have the size 1.
        if z0 >= -8.0 * f64::from(f32::EPSILON) {
            return None;
        }
        let middle = DVec2::new(way.dot(right), way.dot(up));
        let (low, high) = (middle - half, middle + half);
        let corner = |x: f64, y: f64| DVec3::new(x, y, z0);
        let [v00, v01, v10, v11] =
            [corner(low.x, low.y), corner(low.x, high.y), corner(high.x, low.y), corner(high.x, high.y)];
        let n = [v00.cross(v10), v10.cross(v11), v11.cross(v01), v01.cross(v00)].map(|n| n.normalize_or_zero());
        let angle = |a: usize, b: usize| (-n[a].dot(n[b])).clamp(-1.0, 1.0).acos();
        let [g0, g1, g2, g3] = [angle(0, 1), angle(1, 2), angle(2, 3), angle(3, 0)];
        let k = std::f64::consts::TAU - g2 - g3;
        let solid_angle = g0 + g1 - k;
        Some(SphericalRectangle { right, up, z, z0, low, high, b0: n[0].z, b1: n[2].z, k, solid_angle })
    }

    /// The way from the point to a point of the rectangle.
    fn sample(&self, u: Vec2) -> DVec3 {
        let au = f64::from(u.x) * self.solid_angle + self.k;
        let fu = (au.cos() * self.b0 - self.b1) / au.sin();
        let cu = (fu.signum() / (fu * fu + self.b0 * self.b0).sqrt()).clamp(-1.0, 1.0);
        let x = (-(cu * self.z0) / (1.0 - cu * cu).max(1e-30).sqrt()).clamp(self.low.x, self.high.x);
        let d = (x * x + self.z0 * self.z0).sqrt();
        let [h0, h1] = [self.low.y, self.high.y].map(|y| y / (d * d + y * y).sqrt());
        let h = h0 + f64::from(u.y) * (h1 - h0);
        let y = (h * d / (1.0 - h * h).max(1e-30).sqrt()).clamp(self.low.y, self.high.y);
        self.right * x + self.up * y + self.z * self.z0
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use crate::sampling::{frame, from_polar};

    const SPHERE: LampShape = LampShape::Sphere { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.25 };
    const RECTANGLE: LampShape = LampShape::Rectangle {
        center: Vec3::new(0.1, 0.2, 0.3),
        right: Vec3::X,
        up: Vec3::NEG_Z,
        half: Vec2::new(0.5, 0.1),
    };

    /// Points that a lamp shines on: far, aside, near, all but touching.
    fn cases() -> Vec<(LampShape, Vec3)> {
        let mut cases = Vec::new();
        for way in [Vec3::new(0.3, 5.0, 1.0), Vec3::new(1.0, 0.2, 0.4), Vec3::new(0.0, 0.26, 0.0)] {
            cases.push((SPHERE, Vec3::new(0.1, 0.2, 0.3) + way));
            cases.push((RECTANGLE, Vec3::new(0.1, 0.2, 0.3) + way));
        }
        cases.push((SPHERE, Vec3::new(0.1, 0.2 + 0.2501, 0.3)));
        cases.push((RECTANGLE, Vec3::new(0.3, 0.2 + 0.002, 0.3)));
        cases
    }

    fn toward(direction: Vec3, from: Vec3) -> Ray {
        Ray { origin: from, direction, reach: f32::INFINITY }
    }

    /// The counts of samples in cells of all directions fit the integrals of the density over them.
    #[test]
    fn samples_follow_their_density() {
        const CELLS: usize = 24;
        const FINE: usize = 40;
        const SAMPLES: u32 = 1 << 15;
        for (shape, from) in cases() {
            // Cells lie in a cone about the lamp's middle that just holds it.
            let axis = (Vec3::new(0.1, 0.2, 0.3) - from).normalize();
            let (t, b) = frame(axis);
            let mut narrowest = 1.0_f32;
            for i in 0..SAMPLES {
                if let Some((d, _, _)) = shape.sample(from, Sampler::new(3, 0, i).next_2d()) {
                    narrowest = narrowest.min(d.dot(axis));
                }
            }
            let widest = (1.0 - narrowest) * 1.02;
            let cell = |d: Vec3| {
                let row = (((1.0 - d.dot(axis)) / widest) * CELLS as f32) as usize;
                let turn = d.dot(b).atan2(d.dot(t)) / TAU + 0.5;
                row.min(CELLS - 1) * CELLS + ((turn * CELLS as f32) as usize).min(CELLS - 1)
            };
            let (mut counts, mut expected) = ([0.0_f64; CELLS * CELLS], [0.0_f64; CELLS * CELLS]);
            for i in 0..SAMPLES {
                let (d, distance, density) = shape.sample(from, Sampler::new(7, 1, i).next_2d()).unwrap();
                counts[cell(d)] += 1.0;
                let again = shape.density(from, d, distance);
                assert!((again / density - 1.0).abs() < 1e-3, "{shape:?} {from}: {again} {density}");
            }
            for i in 0..(CELLS * FINE) * (CELLS * FINE) {
                let (row, column) = (i / (CELLS * FINE), i % (CELLS * FINE));
                let fine = (CELLS * FINE) as f32;
                let local = from_polar(1.0 - widest * (row as f32 + 0.5) / fine, (column as f32 + 0.5) / fine - 0.5);
                let d = t * local.x + b * local.y + axis * local.z;
                if let Some((distance, true)) = shape.hit(&toward(d, from)) {
                    let solid_angle = f64::from(TAU * widest) / f64::from(fine * fine);
                    expected[cell(d)] += f64::from(shape.density(from, d, distance)) * solid_angle * f64::from(SAMPLES);
                }
            }
            let total: f64 = expected.iter().sum();
            // The grid's cells at the outline are in or out as a whole.
            assert!((total / f64::from(SAMPLES) - 1.0).abs() < 0.01, "{shape:?} {from}: density integrates to {total}");
            let (mut statistic, mut freedom) = (0.0, -1.0);
            for (count, expected) in counts.iter().zip(&expected).filter(|(_, e)| **e >= 20.0) {
                statistic += (count - expected).powi(2) / expected;
                freedom += 1.0;
            }
            // Stratified samples vary less than chance would; the outline adds a little. Wilson and Hilferty, p = 5e-6.
            let v = 2.0 / (9.0 * freedom);
            let z = ((statistic / freedom).cbrt() - (1.0 - v)) / f64::sqrt(v);
            assert!(freedom > 10.0 && z < 4.4, "{shape:?} {from}: {statistic:.0} for {freedom} degrees, z = {z:.1}");
        }
    }

    #[test]
    fn lamps_shine_to_one_side() {
        let center = Vec3::new(0.1, 0.2, 0.3);
        assert!(SPHERE.sample(center + Vec3::X * 0.2, Vec2::splat(0.5)).is_none());
        assert!(SPHERE.hit(&toward(Vec3::X, center)).is_none());
        assert!(RECTANGLE.sample(center - Vec3::Y, Vec2::splat(0.5)).is_none());
        assert_eq!(RECTANGLE.hit(&toward(Vec3::Y, center - Vec3::Y)), Some((1.0, false)));
        assert_eq!(RECTANGLE.hit(&toward(Vec3::NEG_Y, center + Vec3::Y)), Some((1.0, true)));
    }

    /// A lamp so far away that its solid angle cancels is sampled by area.
    #[test]
    fn far_lamps_keep_their_light() {
        let from = Vec3::new(0.1, 4000.2, 0.3);
        let (_, distance, density) = RECTANGLE.sample(from, Vec2::splat(0.3)).unwrap();
        let expected = distance * distance / RECTANGLE.area();
        assert!((density / expected - 1.0).abs() < 1e-4, "{density} {expected}");
        let (_, distance, density) = SPHERE.sample(from, Vec2::splat(0.3)).unwrap();
        let expected = distance * distance / (0.5 * TAU * 0.0625);
        assert!((density / expected - 1.0).abs() < 1e-2, "{density} {expected}");
    }
}
