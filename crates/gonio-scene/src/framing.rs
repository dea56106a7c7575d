//! A scene without camera or lights gets pleasant ones.

use crate::camera::Camera;
use crate::color_value::Color;
use crate::load::camera_of;
use crate::scene::Scene;
use crate::scene_file::{CameraSpec, EquationSpec, LightSourceKind, LightSpec, MotionSpec};
use glam::{DQuat, DVec3};
use gonio_light::Convention;
use gonio_light::vector::unit;

/// Full vertical field of view where none is given, degrees: near what a portrait lens sees.
pub const DEFAULT_FOV_Y: f64 = 40.0;
/// Half angles of a spot where none are given, degrees.
pub const DEFAULT_SPOT_ANGLES: (f64, f64) = (20.0, 30.0);
/// The share of the picture's half width or height that the objects fill.
const FILLED: f64 = 0.92;
/// Most that far may be of near: beyond, a 24-bit depth buffer gets coarse.
const FAR_OVER_NEAR: f64 = 1e4;
/// The default view: from the right of the front (+Z) ...
const AZIMUTH_DEG: f64 = 25.0;
/// ... and from above: a little for what stands upright, more for what lies flat, so that a table top is
/// seen as one. Between height / width of 0.6 and 0.2 the angle goes from the first to the second.
const ELEVATION_DEG: (f64, f64) = (12.0, 27.0);

/// All objects, seen through one question: how far they reach along a direction.
pub(crate) trait Extent {
    /// For each direction (any length) the largest `direction . p` over all points `p`, world space.
    fn support(&self, directions: &[DVec3]) -> Vec<f64>;
}

/// The objects' box, as centre and half diagonal; something usable where there is no extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around {
    pub center: DVec3,
    pub radius: f64,
}

impl Around {
    pub fn new(min: DVec3, max: DVec3) -> Self {
        let radius = 0.5 * (max - min).length();
        Around { center: 0.5 * (min + max), radius: if radius > 1e-12 { radius } else { 1.0 } }
    }

    /// Rounded to about a thousandth of the radius: numbers that a person likes to read.
    fn tidy(&self, v: DVec3) -> [f64; 3] {
        let decimals = 3 - self.radius.log10().floor() as i32;
        v.to_array().map(|c| round_decimals(c, decimals))
    }
}

/// Fills in what `camera` lacks, so that all objects are in a picture of this `aspect` (width over
/// height) where the camera's place is free.
pub(crate) fn fill_camera(camera: &mut CameraSpec, around: Around, objects: &dyn Extent, aspect: f64) {
    let up = unit(camera.up.map_or(DVec3::Y, DVec3::from)).unwrap_or(DVec3::Y);
    camera.up.get_or_insert(DVec3::Y.to_array());
    let fov_y = *camera.fov_y.get_or_insert(DEFAULT_FOV_Y);
    let by_angles = camera.yaw.is_some() || camera.pitch.is_some();
    if by_angles {
        camera.yaw.get_or_insert(-90.0);
        camera.pitch.get_or_insert(0.0);
    }
    let front = match (camera.position, camera.target) {
        _ if by_angles => Camera::direction_of(camera.yaw.unwrap_or(-90.0), camera.pitch.unwrap_or(0.0)),
        (Some(position), target) => {
            let position = DVec3::from(position);
            let target = target.map_or(around.center, DVec3::from);
            unit(target - position).unwrap_or(DVec3::NEG_Z)
        }
        (None, _) => -(DQuat::from_rotation_arc(DVec3::Y, up) * pleasant_direction(up, around, objects)),
    };
    if camera.position.is_none() {
        let fit = Fit::new(front, up, fov_y, aspect, around.center, objects);
        let (position, target) = match camera.target {
            Some(target) => {
                let target = DVec3::from(target);
                (target - front * fit.distance_from(target, around.radius), target)
            }
            None => fit.whole(around.radius),
        };
        camera.position = Some(around.tidy(position));
        if !by_angles && camera.target.is_none() {
            camera.target = Some(around.tidy(target));
        }
    } else if !by_angles && camera.target.is_none() {
        let position = camera.position.map_or(DVec3::ZERO, DVec3::from);
        let target = if unit(around.center - position).is_some() { around.center } else { position + front };
        camera.target = Some(target.to_array());
    }
    let distance = camera.position.map_or(0.0, |p| DVec3::from(p).distance(around.center));
    fill_planes(camera, distance, around.radius);
}

/// For a camera that moves: where it has to stand, and what it must not cut off.
impl Scene {
    /// `camera` at the place from which all objects are in a picture of this `aspect` (width over height); it looks the
    /// same way as before, with the same field of view.
    pub fn framed(&self, camera: &CameraSpec, aspect: f64) -> CameraSpec {
        let (min, max) = self.bounds();
        let around = Around::new(min, max);
        let now = camera_of(camera);
        let fov_y = camera.fov_y.unwrap_or(DEFAULT_FOV_Y);
        let up = camera.up.and_then(|up| unit(up.into())).unwrap_or(DVec3::Y);
        let (position, target) = Fit::new(now.front, up, fov_y, aspect, around.center, self).whole(around.radius);
        let framed = CameraSpec {
            position: Some(position.to_array()),
            target: Some(target.to_array()),
            yaw: None,
            pitch: None,
            ..camera.clone()
        };
        self.with_planes(framed)
    }

    /// `camera` with near and far planes for the place where it stands: no object is cut off, if the depth buffer
    /// allows it.
    pub fn with_planes(&self, camera: CameraSpec) -> CameraSpec {
        let (min, max) = self.bounds();
        let around = Around::new(min, max);
        let distance = camera.position.map_or(0.0, |p| DVec3::from(p).distance(around.center));
        let mut camera = CameraSpec { near: None, far: None, ..camera };
        fill_planes(&mut camera, distance, around.radius);
        camera
    }
}

/// Unit vector from the objects to the eye, for Y up.
fn pleasant_direction(up: DVec3, around: Around, objects: &dyn Extent) -> DVec3 {
    let height: f64 = objects.support(&[up, -up]).iter().sum();
    let width = (4.0 * around.radius * around.radius - height * height).max(0.0).sqrt();
    let flatness = if height > 0.0 { ((0.6 - height / width) / 0.4).clamp(0.0, 1.0) } else { 1.0 };
    let (upright, flat) = ELEVATION_DEG;
    let (azimuth, elevation) = (AZIMUTH_DEG.to_radians(), (upright + flatness * (flat - upright)).to_radians());
    DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos())
}

/// How far back the eye must stand, for one viewing direction.
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
        let c = Camera::looking_along(DVec3::ZERO, front, up, 1.0, 1.0, 2.0);
        let tan = (0.5 * fov_y.to_radians()).tan() * FILLED;
        let (k_x, k_y) = (1.0 / (tan * aspect), 1.0 / tan);
        let directions =
            [k_x * c.right - c.front, -k_x * c.right - c.front, k_y * c.up - c.front, -k_y * c.up - c.front, -c.front];
        let support = objects.support(&directions);
        let reach = std::array::from_fn(|i| support[i] - directions[i].dot(center));
        Fit { front: c.front, right: c.right, up: c.up, center, k_x, k_y, reach }
    }

    /// Eye and point looked at, with the objects in the middle of the picture.
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

/// Near and far around everything, with room for turning and flying.
fn fill_planes(camera: &mut CameraSpec, distance: f64, radius: f64) {
    let far = round_significant(1.5 * (distance + radius), f64::ceil);
    let far = camera.far.unwrap_or_else(|| far.max(camera.near.unwrap_or(0.0) * 1e3));
    let near = round_significant((0.5 * (distance - 1.2 * radius)).max(far / FAR_OVER_NEAR), f64::ceil);
    let near = camera.near.unwrap_or(if near < far { near } else { far / FAR_OVER_NEAR });
    (camera.near, camera.far) = (Some(near), Some(far));
}

/// Key from the upper left front, fill from the right, rim from behind, and a little from everywhere.
///
/// In the lab's convention a white wall facing the key is lit by 0.84 in all, so that nothing but
/// highlights reaches the display's limit; where `diff` is 1/pi the lights are pi times as strong.
pub(crate) fn portrait_lights(camera: &Camera, around: Around, equation: &EquationSpec) -> Vec<LightSpec> {
    let unit_light = match (equation.convention, equation.brdf) {
        (Convention::Lab, None) => 1.0,
        _ => std::f64::consts::PI,
    };
    let (right, up, back) = (camera.right, camera.up, -camera.front);
    let way = |r: f64, u: f64, b: f64| unit(r * right + u * up + b * back).unwrap_or(DVec3::Y);
    let strength = |s: f64| Some(round_decimals(s * unit_light, 3));
    let color = |r: f64, g: f64, b: f64| Some(Color([r, g, b]));
    let coming_from = |d: DVec3| Some((-d).to_array().map(|c| round_decimals(c, 3)));
    vec![
        LightSpec {
            kind: LightSourceKind::Point,
            name: "key".into(),
            position: Some(around.tidy(around.center + 4.0 * around.radius * way(-0.6, 0.7, 0.8))),
            color: color(1.0, 0.95, 0.88),
            intensity: strength(0.78),
            ..LightSpec::default()
        },
        LightSpec {
            kind: LightSourceKind::Directional,
            name: "fill".into(),
            direction: coming_from(way(0.9, 0.1, 0.6)),
            color: color(0.75, 0.87, 1.0),
            intensity: strength(0.2),
            ..LightSpec::default()
        },
        LightSpec {
            kind: LightSourceKind::Directional,
            name: "rim".into(),
            direction: coming_from(way(0.35, 0.65, -0.9)),
            color: color(0.95, 0.97, 1.0),
            intensity: strength(0.35),
            ..LightSpec::default()
        },
        LightSpec {
            kind: LightSourceKind::Ambient,
            name: "ambient".into(),
            color: color(0.9, 0.95, 1.0),
            // Ambient light has no pi in either convention.
            intensity: Some(0.08),
            ..LightSpec::default()
        },
    ]
}

/// Fills in what a light lacks.
pub(crate) fn fill_light(light: &mut LightSpec) {
    use LightSourceKind::{Point, Spot};
    light.color.get_or_insert(Color::grey(1.0));
    light.intensity.get_or_insert(1.0);
    if matches!(light.kind, Point | Spot) {
        light.linear.get_or_insert(0.0);
        light.quadratic.get_or_insert(0.0);
        light.constant.get_or_insert(1.0);
        let path = light.motion.as_ref().and_then(|m| m.points.as_ref());
        light.position = light.position.or_else(|| path.and_then(|points| points.first().copied()));
    }
    if light.kind == Spot {
        let (inner, outer) = DEFAULT_SPOT_ANGLES;
        let outer = *light.outer_angle.get_or_insert(outer.max(light.inner_angle.unwrap_or(0.0)));
        light.inner_angle.get_or_insert(inner.min(outer));
    }
    if let Some(MotionSpec { center: Some(_), axis, .. }) = &mut light.motion {
        axis.get_or_insert(DVec3::Y.to_array());
    }
}

/// To so many decimals (negative: tens, hundreds); the nearest number that prints that short.
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
