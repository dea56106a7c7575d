//! The camera that frames the objects, and the lights of a scene that has none: a three-point rig.

use crate::camera::Camera;
use crate::color_value::Color;
use crate::defaults;
use crate::frame::position_at;
use crate::scene::{Extent, Scene};
use crate::scene_file::{CameraSpec, LightSourceKind, ObjectSpec};
use crate::settings::{Aim, CameraSettings, EquationSettings, LightSettings, Motion};
use glam::{DQuat, DVec3};
use gonio_light::Convention;
use gonio_light::vector::unit;

/// The share of the picture's half width or height that the objects fill.
const FILLED: f64 = 0.92;
/// Largest ratio of far to near: beyond it a 24-bit depth buffer is too coarse.
const FAR_OVER_NEAR: f64 = 1e4;
/// Moments of a period at which the place of a moving object is computed.
const DRIFT_STEPS: u32 = 64;
/// The default view: from the right of the front (+Z) ...
const AZIMUTH_DEG: f64 = 25.0;
/// ... and from above: a little for upright objects, more for flat ones, so that a table top is
/// seen as one. Between height / width of 0.6 and 0.2 the angle goes from the first to the second.
const ELEVATION_DEG: (f64, f64) = (12.0, 27.0);

/// The sphere around the box of all objects; of radius 1 where there is no extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundingSphere {
    pub center: DVec3,
    pub radius: f64,
    /// How far moving objects go from where they are at time 0.
    pub drift: f64,
}

impl BoundingSphere {
    /// The sphere around the box from `min` to `max` that `objects` have at time 0.
    pub fn new(min: DVec3, max: DVec3, objects: &[ObjectSpec]) -> Self {
        let radius = 0.5 * (max - min).length();
        let drift = objects.iter().map(drift).fold(0.0, f64::max);
        BoundingSphere { center: 0.5 * (min + max), radius: if radius > 1e-12 { radius } else { 1.0 }, drift }
    }

    /// Rounded to about a thousandth of the radius: numbers that a person likes to read.
    fn tidy(&self, v: DVec3) -> [f64; 3] {
        let decimals = 3 - self.radius.log10().floor() as i32;
        v.to_array().map(|c| round_decimals(c, decimals))
    }
}

/// The camera of a scene file with every default filled in: where its position is free, all objects are in a picture of
/// this `aspect` (width over height).
pub(crate) fn complete_camera(
    spec: &CameraSpec,
    around: BoundingSphere,
    objects: &dyn Extent,
    aspect: f64,
) -> CameraSettings {
    let world_up = spec.up.unwrap_or(defaults::UP);
    let up = unit(world_up.into()).unwrap_or(DVec3::Y);
    let fov_y = spec.fov_y.unwrap_or(defaults::FOV_Y);
    let angles = (spec.yaw.is_some() || spec.pitch.is_some())
        .then(|| (spec.yaw.unwrap_or(defaults::YAW), spec.pitch.unwrap_or(defaults::PITCH)));
    let front = match (angles, spec.position) {
        (Some((yaw, pitch)), _) => Camera::direction_of(yaw, pitch),
        (None, Some(position)) => {
            let target = spec.target.map_or(around.center, DVec3::from);
            unit(target - DVec3::from(position)).unwrap_or(DVec3::NEG_Z)
        }
        (None, None) => -(DQuat::from_rotation_arc(DVec3::Y, up) * direction_to_eye(up, around, objects)),
    };
    let (position, target) = match (spec.position, spec.target) {
        (Some(position), Some(target)) => (position, target),
        (Some(position), None) => {
            let eye = DVec3::from(position);
            let target = if unit(around.center - eye).is_some() { around.center } else { eye + front };
            (position, target.to_array())
        }
        (None, Some(target)) => {
            let fit = Fit::new(front, up, fov_y, aspect, around.center, objects);
            let at = DVec3::from(target);
            (around.tidy(at - front * fit.distance_from(at, around.radius)), target)
        }
        (None, None) => {
            let fit = Fit::new(front, up, fov_y, aspect, around.center, objects);
            let (position, target) = fit.whole(around.radius);
            (around.tidy(position), around.tidy(target))
        }
    };
    let aim = angles.map_or(Aim::Target(target), |(yaw, pitch)| Aim::Angles { yaw, pitch });
    let distance = DVec3::from(position).distance(around.center);
    let (near, far) = planes((spec.near, spec.far), distance, around.radius + around.drift);
    CameraSettings { position, aim, up: world_up, fov_y, near, far }
}

/// The farthest that an object goes from where it is at time 0.
fn drift(object: &ObjectSpec) -> f64 {
    let Some(motion) = object.motion.clone().map(Motion::from) else { return 0.0 };
    let start = DVec3::from(object.translate);
    let times = (1..DRIFT_STEPS).map(|step| motion.period * f64::from(step) / f64::from(DRIFT_STEPS));
    times.map(|time| position_at(&motion, start, time).distance(start)).fold(0.0, f64::max)
}

impl Scene {
    /// `camera` moved so that all objects are in a picture of this `aspect` (width over height). Its direction and its
    /// field of view stay.
    pub fn framed(&self, camera: &CameraSettings, aspect: f64) -> CameraSettings {
        let (min, max) = self.bounds();
        let around = BoundingSphere::new(min, max, &self.settings.objects);
        let front = camera.to_camera().front;
        let up = unit(camera.up.into()).unwrap_or(DVec3::Y);
        let fit = Fit::new(front, up, camera.fov_y, aspect, around.center, self);
        let (position, target) = fit.whole(around.radius);
        let aim = Aim::Target(target.to_array());
        self.with_planes(CameraSettings { position: position.to_array(), aim, ..camera.clone() })
    }

    /// `camera` moved back until a picture of this `aspect` shows what the scene's own picture shows: all objects, or the same
    /// width where that leaves out a part on purpose.
    pub fn with_all_in(&self, camera: &CameraSettings, aspect: f64) -> CameraSettings {
        let (min, max) = self.bounds();
        let around = BoundingSphere::new(min, max, &self.settings.objects);
        let eye = camera.to_camera();
        let up = unit(camera.up.into()).unwrap_or(DVec3::Y);
        let middle = if let Aim::Target(target) = camera.aim { target.into() } else { around.center };
        let distance = (middle - eye.position).dot(eye.front);
        let target = eye.position + distance * eye.front;
        let needed = |aspect: f64, filled: f64| {
            let fit = Fit::filling(filled, (eye.front, up), camera.fov_y, aspect, around.center, self);
            fit.distance_from(target, around.radius)
        };
        let picture = &self.settings.picture;
        let own_aspect = f64::from(picture.width) / f64::from(picture.height.max(1));
        let shows_all = needed(own_aspect, 1.0) <= distance;
        let wanted = match shows_all {
            true if needed(aspect, 1.0) > distance => needed(aspect, FILLED),
            true => distance,
            false => distance * (own_aspect / aspect).max(1.0),
        };
        if distance <= 0.0 || wanted <= distance {
            return camera.clone();
        }
        let position = around.tidy(eye.position - (wanted - distance) * eye.front);
        self.with_planes(CameraSettings { position, ..camera.clone() })
    }

    /// `camera` with near and far planes that suit its position: no object is cut off, if the depth buffer allows it.
    pub fn with_planes(&self, camera: CameraSettings) -> CameraSettings {
        let (min, max) = self.bounds();
        let around = BoundingSphere::new(min, max, &self.settings.objects);
        let distance = DVec3::from(camera.position).distance(around.center);
        let (near, far) = planes((None, None), distance, around.radius + around.drift);
        CameraSettings { near, far, ..camera }
    }
}

/// Unit vector from the objects to the eye, for Y up.
fn direction_to_eye(up: DVec3, around: BoundingSphere, objects: &dyn Extent) -> DVec3 {
    let height: f64 = objects.support(&[up, -up]).iter().sum();
    let width = (4.0 * around.radius * around.radius - height * height).max(0.0).sqrt();
    let flatness = if height > 0.0 { ((0.6 - height / width) / 0.4).clamp(0.0, 1.0) } else { 1.0 };
    let (upright, flat) = ELEVATION_DEG;
    let (azimuth, elevation) = (AZIMUTH_DEG.to_radians(), (upright + flatness * (flat - upright)).to_radians());
    DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos())
}

/// The distance of the eye at which all objects are in the picture, for one viewing direction.
///
/// A point at `x` to the right of the axis and `z` along it is in the picture if
/// `x k <= distance + z`, with `k = 1 / (tan(fov / 2) aspect filled)`: so the distance is at least the
/// largest `k x - z` of all points, and the same to the left, upwards and downwards.
struct Fit {
    front: DVec3,
    right: DVec3,
    up: DVec3,
    center: DVec3,
    k_x: f64,
    k_y: f64,
    /// Largest `k x - z` to the right, left, up and down, and largest `-z`, from `center`.
    reach: [f64; 5],
}

impl Fit {
    fn new(front: DVec3, up: DVec3, fov_y: f64, aspect: f64, center: DVec3, objects: &dyn Extent) -> Self {
        Fit::filling(FILLED, (front, up), fov_y, aspect, center, objects)
    }

    fn filling(
        filled: f64,
        (front, up): (DVec3, DVec3),
        fov_y: f64,
        aspect: f64,
        center: DVec3,
        objects: &dyn Extent,
    ) -> Self {
        let c = Camera::looking_along(DVec3::ZERO, front, up, 1.0, 1.0, 2.0);
        let tan = (0.5 * fov_y.to_radians()).tan() * filled;
        let (k_x, k_y) = (1.0 / (tan * aspect), 1.0 / tan);
        let directions =
            [k_x * c.right - c.front, -k_x * c.right - c.front, k_y * c.up - c.front, -k_y * c.up - c.front, -c.front];
        let support = objects.support(&directions);
        let reach = std::array::from_fn(|i| support[i] - directions[i].dot(center));
        Fit { front: c.front, right: c.right, up: c.up, center, k_x, k_y, reach }
    }

    /// The eye and its target, with the objects in the middle of the picture.
    fn whole(&self, radius: f64) -> (DVec3, DVec3) {
        let [right, left, up, down, nearest] = self.reach;
        let target =
            self.center + self.right * (right - left) / (2.0 * self.k_x) + self.up * (up - down) / (2.0 * self.k_y);
        let distance = (0.5 * (right + left)).max(0.5 * (up + down)).max(nearest + 0.05 * radius);
        (target - self.front * distance, target)
    }

    /// The distance from `target` at which everything is in a picture that has `target` in its middle.
    fn distance_from(&self, target: DVec3, radius: f64) -> f64 {
        let offset = target - self.center;
        let (x, y, z) = (offset.dot(self.right), offset.dot(self.up), offset.dot(self.front));
        let [right, left, up, down, nearest] = self.reach;
        let (k_x, k_y) = (self.k_x, self.k_y);
        [right - k_x * x, left + k_x * x, up - k_y * y, down + k_y * y, nearest + 0.05 * radius]
            .into_iter()
            .fold(0.0, |most: f64, reach| most.max(reach + z))
            .max(0.05 * radius)
    }
}

/// Near and far planes around all objects, with room for moving the camera, unless they are `given`.
fn planes(given: (Option<f64>, Option<f64>), distance: f64, radius: f64) -> (f64, f64) {
    let far = round_significant(1.5 * (distance + radius), f64::ceil);
    let far = given.1.unwrap_or_else(|| far.max(given.0.unwrap_or(0.0) * 1e3));
    let near = round_significant((0.5 * (distance - 1.2 * radius)).max(far / FAR_OVER_NEAR), f64::ceil);
    let near = given.0.unwrap_or(if near < far { near } else { far / FAR_OVER_NEAR });
    (near, far)
}

/// Key from the upper left front, fill from the right, rim from behind, and a little from everywhere.
///
/// In the lab's convention a white wall facing the key is lit by 0.84 in all, so that nothing but
/// highlights reaches the display's limit; where `diff` is 1/pi the lights are pi times as strong.
pub(crate) fn three_point_lights(
    camera: &Camera,
    around: BoundingSphere,
    equation: &EquationSettings,
) -> Vec<LightSettings> {
    let unit_light = match (equation.convention, equation.brdf) {
        (Convention::Lab, None) => 1.0,
        _ => std::f64::consts::PI,
    };
    let (right, up, back) = (camera.right, camera.up, -camera.front);
    let way = |r: f64, u: f64, b: f64| unit(r * right + u * up + b * back).unwrap_or(DVec3::Y);
    let strength = |s: f64| round_decimals(s * unit_light, 3);
    let color = |r: f64, g: f64, b: f64| Color([r, g, b]);
    let coming_from = |d: DVec3| Some((-d).to_array().map(|c| round_decimals(c, 3)));
    vec![
        LightSettings {
            name: "key".into(),
            position: Some(around.tidy(around.center + 4.0 * around.radius * way(-0.6, 0.7, 0.8))),
            color: color(1.0, 0.95, 0.88),
            intensity: strength(0.78),
            ..LightSettings::new(LightSourceKind::Point)
        },
        LightSettings {
            name: "fill".into(),
            direction: coming_from(way(0.9, 0.1, 0.6)),
            color: color(0.75, 0.87, 1.0),
            intensity: strength(0.2),
            ..LightSettings::new(LightSourceKind::Directional)
        },
        LightSettings {
            name: "rim".into(),
            direction: coming_from(way(0.35, 0.65, -0.9)),
            color: color(0.95, 0.97, 1.0),
            intensity: strength(0.35),
            ..LightSettings::new(LightSourceKind::Directional)
        },
        LightSettings {
            name: "ambient".into(),
            color: color(0.9, 0.95, 1.0),
            // Ambient light has no pi in either convention.
            intensity: 0.08,
            ..LightSettings::new(LightSourceKind::Ambient)
        },
    ]
}

/// Rounds to a number of decimals (negative: tens, hundreds).
fn round_decimals(v: f64, decimals: i32) -> f64 {
    let power = 10f64.powi(decimals.abs());
    let rounded = if decimals >= 0 { (v * power).round() / power } else { (v / power).round() * power };
    // A zero without sign prints better.
    if !rounded.is_finite() { v } else { rounded + 0.0 }
}

/// A positive number to three significant digits.
fn round_significant(v: f64, round: impl Fn(f64) -> f64) -> f64 {
    let decimals = 2 - v.log10().floor() as i32;
    let power = 10f64.powi(decimals.abs());
    let rounded = if decimals >= 0 { round(v * power) / power } else { round(v / power) * power };
    if rounded.is_finite() && rounded > 0.0 { rounded } else { v }
}
