//! One moment of a scene: the input of a renderer.

use crate::camera::Camera;
use crate::environment::{Surroundings, world_from_environment};
use crate::scene::{Extent, Scene};
use crate::scene_file::LightSourceKind;
use crate::settings::{EquationSettings, LightSettings, Motion, MotionPath};
use crate::texture::TextureFilter;
use glam::{DQuat, DVec3};
use gonio_light::brdf::BrdfSettings;
use gonio_light::color::OutputTransform;
use gonio_light::vector::unit;
use gonio_light::{Attenuation, Equation, Light, LightKind, TermSwitches};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::OnceLock;

/// The background: linear radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Background {
    /// The colour at the picture's top edge.
    pub top: DVec3,
    /// The colour at its bottom edge.
    pub bottom: DVec3,
    /// Whether it is transparent: alpha 0.
    pub transparent: bool,
}

impl Background {
    /// Premultiplied RGBA at height `y` in [0, 1], 0 the top edge.
    pub fn at(&self, y: f64) -> [f64; 4] {
        if self.transparent {
            return [0.0; 4];
        }
        let c = self.top.lerp(self.bottom, y);
        [c.x, c.y, c.z, 1.0]
    }
}

/// The extent of a lamp around the position of its light. Its radiance is uniform.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LightShape {
    /// No extent; ambient and directional lights too.
    #[default]
    Point,
    /// A sphere that shines outwards.
    Sphere {
        /// World units, > 0.
        radius: f64,
    },
    /// A rectangle that shines to one side, along `half_right x half_up`.
    Rectangle {
        /// From the centre to the middle of the edge that is on the right of what it shines at, world space; perpendicular
        /// to the scene's up direction.
        half_right: DVec3,
        /// From the centre to the middle of the upper edge, world space.
        half_up: DVec3,
    },
}

/// The input of a renderer besides geometry and materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Pixels, > 0.
    pub width: u32,
    /// Pixels, > 0.
    pub height: u32,
    /// Samples per pixel, >= 1.
    pub samples: u32,
    /// Seconds.
    pub time: f64,
    /// The eye.
    pub camera: Camera,
    /// The lights at `time`, in the scene's order.
    pub lights: Vec<Light>,
    /// The extent of each of `lights`, around its position: what the light equation leaves out. Where it is shorter, the
    /// others are points.
    pub light_shapes: Vec<LightShape>,
    /// The form of the equation.
    pub equation: Equation,
    /// Whether objects cast shadows.
    pub shadows: bool,
    /// Whether the normal is turned to the viewer on back faces.
    pub two_sided: bool,
    /// The background.
    pub background: Background,
    /// The part of the environment; `None` where the scene has none.
    pub surroundings: Option<Surroundings>,
    /// The conversion of light to the picture's numbers.
    pub output: OutputTransform,
    /// The filter of textures.
    pub texture_filter: TextureFilter,
    /// Box around all objects, world space.
    pub bounds_min: DVec3,
    /// Box around all objects, world space.
    pub bounds_max: DVec3,
}

impl Scene {
    /// Whether an object moves, so that [`Scene::at`] has other places at other times.
    pub fn has_moving_objects(&self) -> bool {
        self.settings.objects.iter().any(|object| object.motion.is_some())
    }

    /// The scene with every object where its motion takes it by `time`, seconds. The settings stay, so another time can be
    /// taken from the result. Geometry, textures and environment are shared.
    pub fn at(&self, time: f64) -> Scene {
        let mut moved = self.clone();
        for (object, spec) in moved.objects.iter_mut().zip(&self.settings.objects) {
            let Some(motion) = spec.motion.clone() else { continue };
            let position = position_at(&motion.into(), spec.translate.into(), time);
            object.world_from_model.w_axis = position.extend(1.0);
            moved.known_bounds = OnceLock::new();
        }
        moved
    }

    /// Camera, lights and switches at `time`, seconds. Objects do not move: see [`Scene::at`].
    pub fn frame(&self, time: f64) -> Frame {
        let scene = &self.settings;
        let (bounds_min, bounds_max) = self.bounds();
        Frame {
            width: scene.picture.width,
            height: scene.picture.height,
            samples: scene.picture.samples,
            time,
            camera: scene.camera.to_camera(),
            lights: scene.lights.iter().map(|light| light_at(light, time)).collect(),
            light_shapes: scene.lights.iter().map(|light| shape_of(light, scene.camera.up.into())).collect(),
            equation: Equation::from(&scene.equation),
            shadows: scene.equation.shadows,
            two_sided: scene.equation.two_sided,
            background: Background {
                top: scene.background.top.into(),
                bottom: scene.background.bottom.into(),
                transparent: scene.background.transparent,
            },
            surroundings: self.surroundings(),
            output: OutputTransform {
                exposure: scene.picture.exposure,
                tone_map: scene.picture.tone_map,
                encoding: scene.picture.color,
            },
            texture_filter: scene.picture.texture_filter,
            bounds_min,
            bounds_max,
        }
    }

    /// The part of the environment; `None` where there is none.
    pub fn surroundings(&self) -> Option<Surroundings> {
        self.environment.as_ref()?;
        let settings = self.settings.environment.clone().unwrap_or_default();
        Some(Surroundings {
            environment_from_world: world_from_environment(settings.rotate).transpose(),
            intensity: settings.intensity,
            lights: settings.light,
            visible: settings.visible,
            blur: settings.blur,
        })
    }

    /// `frame` at the start of an orbit: a camera that was chosen to frame the objects from one side
    /// is moved back until they are in the picture from every side. Other cameras stay.
    pub fn orbit_start(&self, frame: &Frame) -> Frame {
        if !self.camera_was_framed {
            return frame.clone();
        }
        let camera = frame.camera;
        let pivot = self.orbit_pivot(frame);
        // Directions all around (a Fibonacci lattice); between two of them a corner may reach a little
        // farther, which the margin covers.
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let directions: Vec<DVec3> = (0..200)
            .map(|i| {
                let y = (2.0 * f64::from(i) + 1.0) / 200.0 - 1.0;
                let (sin, cos) = (golden * f64::from(i)).sin_cos();
                let r = (1.0 - y * y).sqrt();
                DVec3::new(r * cos, y, r * sin)
            })
            .collect();
        let reach = self.support(&directions);
        let radius = reach.iter().zip(&directions).map(|(r, d)| r - pivot.dot(*d)).fold(0.0, f64::max);
        if !radius.is_finite() {
            return frame.clone();
        }
        let half_y = 0.5 * camera.fov_y_rad;
        let half_x = (half_y.tan() * f64::from(frame.width) / f64::from(frame.height)).atan();
        let distance = 1.05 * radius / half_y.min(half_x).sin();
        let position = pivot - camera.front * distance;
        let near = camera.near.min(0.5 * (distance - radius)).max(1e-4 * (distance + radius));
        let far = camera.far.max(distance + 2.0 * radius);
        Frame { camera: Camera { position, near, far, ..camera }, ..frame.clone() }
    }

    /// The centre of an orbit: the target, or the centre of the objects if the camera looks along angles.
    fn orbit_pivot(&self, frame: &Frame) -> DVec3 {
        self.settings.camera.target().map_or(0.5 * (frame.bounds_min + frame.bounds_max), DVec3::from)
    }

    /// `frame` with its camera turned by `angle_rad` about the vertical axis (the scene's `up`)
    /// through its target, or through the centre of the objects if it looks along angles.
    /// Positive angles move the eye to the right, as seen from the eye. The lights stay.
    pub fn orbit(&self, frame: &Frame, angle_rad: f64) -> Frame {
        let axis = unit(self.settings.camera.up.into()).unwrap_or(DVec3::Y);
        let pivot = self.orbit_pivot(frame);
        let turn = DQuat::from_axis_angle(axis, angle_rad);
        let camera = Camera {
            position: pivot + turn * (frame.camera.position - pivot),
            front: turn * frame.camera.front,
            up: turn * frame.camera.up,
            right: turn * frame.camera.right,
            ..frame.camera
        };
        Frame { camera, ..frame.clone() }
    }
}

/// The light at `time`, seconds.
fn light_at(light: &LightSettings, time: f64) -> Light {
    let position = DVec3::from(light.position.unwrap_or_default());
    let position = light.motion.as_ref().map_or(position, |motion| position_at(motion, position, time));
    let direction = direction_of(light);
    let kind = match light.kind {
        LightSourceKind::Ambient => LightKind::Ambient,
        LightSourceKind::Directional => LightKind::Directional { direction },
        LightSourceKind::Point => LightKind::Point { position },
        LightSourceKind::Spot => LightKind::Spot {
            position,
            axis: direction,
            inner_rad: light.inner_angle.to_radians(),
            outer_rad: light.outer_angle.to_radians(),
        },
        // The smoothstep of the cosine is close to the cosine of a flat lamp.
        LightSourceKind::Rectangle => {
            LightKind::Spot { position, axis: direction, inner_rad: 0.0, outer_rad: FRAC_PI_2 }
        }
    };
    Light {
        kind,
        // A light that is off keeps its place, so that the others keep their numbers.
        color: if light.enabled { DVec3::from(light.color) * light.intensity } else { DVec3::ZERO },
        attenuation: Attenuation { constant: light.constant, linear: light.linear, quadratic: light.quadratic },
    }
}

/// The unit vector along which the light shines.
fn direction_of(light: &LightSettings) -> DVec3 {
    light.direction.and_then(|d| unit(d.into())).unwrap_or(DVec3::NEG_Y)
}

/// The extent of a light in a scene with this up direction, of any length.
fn shape_of(light: &LightSettings, up: DVec3) -> LightShape {
    match light.kind {
        LightSourceKind::Point | LightSourceKind::Spot if light.radius > 0.0 => {
            LightShape::Sphere { radius: light.radius }
        }
        LightSourceKind::Rectangle => {
            let direction = direction_of(light);
            // A lamp that shines straight up or down has its width along x, or, where that is up, along z.
            let up = unit(up).unwrap_or(DVec3::Y);
            let right = unit_across(up.cross(direction))
                .or_else(|| unit_across(DVec3::X - direction.x * direction))
                .unwrap_or(DVec3::Z);
            let [width, height] = light.size;
            LightShape::Rectangle { half_right: 0.5 * width * right, half_up: 0.5 * height * direction.cross(right) }
        }
        _ => LightShape::Point,
    }
}

/// The unit vector along `v`; `None` where `v` is 0 but for rounding.
fn unit_across(v: DVec3) -> Option<DVec3> {
    (v.length() > 1e-9).then(|| v.normalize())
}

/// The position at `time`, seconds, of a light or an object whose motion starts at `position`.
///
/// All motions repeat after `period`. At time 0 it is at `position`, on a path at its first point.
pub fn position_at(motion: &Motion, position: DVec3, time: f64) -> DVec3 {
    let turns = time / motion.period;
    if !turns.is_finite() {
        return position;
    }
    match &motion.path {
        MotionPath::Oscillate { amplitude } => position + DVec3::from(*amplitude) * (TAU * turns).sin(),
        MotionPath::Circle { center, axis } => {
            let center = DVec3::from(*center);
            let axis = unit(DVec3::from(*axis)).unwrap_or(DVec3::Y);
            center + DQuat::from_axis_angle(axis, TAU * turns) * (position - center)
        }
        MotionPath::Path { points } => along(points, turns - turns.floor(), position),
    }
}

/// The point at `share` in [0, 1) of the closed path's length: constant speed.
fn along(points: &[[f64; 3]], share: f64, position: DVec3) -> DVec3 {
    let point = |i: usize| DVec3::from(points[i % points.len()]);
    let lengths: Vec<f64> = (0..points.len()).map(|i| point(i).distance(point(i + 1))).collect();
    let mut left = share * lengths.iter().sum::<f64>();
    for (i, &length) in lengths.iter().enumerate() {
        if left < length {
            return point(i).lerp(point(i + 1), left / length);
        }
        left -= length;
    }
    points.first().map_or(position, |&p| p.into())
}

impl From<&EquationSettings> for Equation {
    fn from(settings: &EquationSettings) -> Self {
        Equation {
            convention: settings.convention,
            specular: settings.specular,
            brdf: settings.brdf.map(|kind| BrdfSettings {
                kind,
                normalised: settings.brdf_normalised,
                lafortune: settings.lafortune.into(),
            }),
            gated: settings.gated,
            cosine_weighted: settings.cosine_weighted,
            terms: TermSwitches {
                ambient: settings.ambient,
                emitted: settings.emitted,
                diffuse: settings.diffuse,
                specular: settings.specular_term,
                attenuation: settings.attenuation,
                spot: settings.spot,
            },
        }
    }
}
