//! Lights and motions with every default filled in.

use crate::color_value::Color;
use crate::defaults;
use crate::light_spec::{LightSourceKind, LightSpec, MotionKind, MotionSpec};
use gonio_light::Spectrum;
use std::sync::Arc;

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSettings {
    /// Ambient, directional, point, spot or rectangle.
    pub kind: LightSourceKind,
    /// The name in reports; may be empty.
    pub name: String,
    /// Whether it shines. A light that is off keeps its number.
    pub enabled: bool,
    /// World space, the centre of a rectangle; `None` for ambient and directional lights.
    pub position: Option<[f64; 3]>,
    /// The way the light travels, world space, of any length; `None` for ambient and point lights.
    pub direction: Option<[f64; 3]>,
    /// The radius of its sphere, world units, >= 0, for point lights and spots.
    pub radius: f64,
    /// Width and height, world units, > 0, for rectangles.
    pub size: [f64; 2],
    /// `L_i` is `color` times `intensity`.
    pub color: Color,
    /// The spectrum that `color` is derived from. A light whose colour is another loses it.
    pub spectrum: Option<Arc<Spectrum>>,
    /// `L_i` is `color` times `intensity`.
    pub intensity: f64,
    /// `k_c`, for lights with a position.
    pub constant: f64,
    /// `k_l`, for lights with a position.
    pub linear: f64,
    /// `k_q`, for lights with a position.
    pub quadratic: f64,
    /// Half angle of the fully lit cone, degrees, for spots.
    pub inner_angle: f64,
    /// Half angle at which the light ends, degrees, for spots.
    pub outer_angle: f64,
    /// Its motion; `None` where it does not move.
    pub motion: Option<Motion>,
}

impl LightSettings {
    /// A white light that does not move; at the origin where it has a position, shining downwards where it has a
    /// direction.
    pub fn new(kind: LightSourceKind) -> Self {
        let position = kind.has_position().then_some([0.0; 3]);
        let direction = kind.has_direction().then_some([0.0, -1.0, 0.0]);
        LightSpec { kind, position, direction, ..LightSpec::default() }.into()
    }
}

impl LightSettings {
    /// Removes the spectrum if the colour was edited.
    pub(crate) fn keep_spectrum(&mut self) {
        let derived = self.spectrum.as_ref().and_then(|s| s.color_of_light());
        if derived.is_none_or(|c| c.to_array() != self.color.0) {
            self.spectrum = None;
        }
    }
}

impl From<LightSpec> for LightSettings {
    fn from(spec: LightSpec) -> Self {
        let has_position = spec.kind.has_position();
        let start = spec.motion.as_ref().and_then(|m| m.points.as_ref()).and_then(|points| points.first().copied());
        let [constant, linear, quadratic] = defaults::ATTENUATION;
        // Where one of the angles is left out, the default must not contradict the other.
        let inner_given = spec.inner_angle.unwrap_or(0.0);
        let outer_angle = spec.outer_angle.unwrap_or(defaults::OUTER_ANGLE.max(inner_given));
        let spectrum = spec.spectrum.map(|samples| Arc::new(Spectrum::new(samples)));
        let own_color = spectrum.as_ref().and_then(|s| s.color_of_light()).map(|c| Color(c.to_array()));
        LightSettings {
            kind: spec.kind,
            name: spec.name,
            enabled: spec.enabled != Some(false),
            position: spec.position.or(start.filter(|_| has_position)),
            direction: spec.direction,
            radius: spec.radius.unwrap_or(defaults::LIGHT_RADIUS),
            size: spec.size.unwrap_or(defaults::LIGHT_SIZE),
            spectrum,
            color: own_color.or(spec.color).unwrap_or(defaults::LIGHT_COLOR),
            intensity: spec.intensity.unwrap_or(defaults::LIGHT_INTENSITY),
            constant: spec.constant.unwrap_or(constant),
            linear: spec.linear.unwrap_or(linear),
            quadratic: spec.quadratic.unwrap_or(quadratic),
            inner_angle: spec.inner_angle.unwrap_or(defaults::INNER_ANGLE.min(outer_angle)),
            outer_angle,
            motion: spec.motion.map(Motion::from),
        }
    }
}

/// The motion of a light or an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Seconds until it is back, > 0.
    pub period: f64,
    /// The path.
    pub path: MotionPath,
}

/// The path of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionPath {
    /// position + amplitude * sin(2 pi time / period)
    Oscillate {
        /// The largest displacement, world space.
        amplitude: [f64; 3],
    },
    /// Around `center` about `axis`, starting at the position.
    Circle {
        /// World space.
        center: [f64; 3],
        /// World space, of any length.
        axis: [f64; 3],
    },
    /// Along the points at constant speed, and back to the first.
    Path {
        /// World space.
        points: Vec<[f64; 3]>,
    },
}

impl MotionPath {
    /// Its kind.
    pub fn kind(&self) -> MotionKind {
        match self {
            MotionPath::Oscillate { .. } => MotionKind::Oscillate,
            MotionPath::Circle { .. } => MotionKind::Circle,
            MotionPath::Path { .. } => MotionKind::Path,
        }
    }
}

impl From<MotionSpec> for Motion {
    fn from(spec: MotionSpec) -> Self {
        let path = match spec.kind {
            MotionKind::Oscillate => MotionPath::Oscillate { amplitude: spec.amplitude.unwrap_or_default() },
            MotionKind::Circle => MotionPath::Circle {
                center: spec.center.unwrap_or_default(),
                axis: spec.axis.unwrap_or(defaults::MOTION_AXIS),
            },
            MotionKind::Path => MotionPath::Path { points: spec.points.unwrap_or_default() },
        };
        Motion { period: spec.period, path }
    }
}

impl From<&LightSettings> for LightSpec {
    /// Sets only the keys of this kind of light.
    fn from(light: &LightSettings) -> Self {
        let (has_position, has_direction) = (light.kind.has_position(), light.kind.has_direction());
        let is_spot = light.kind == LightSourceKind::Spot;
        LightSpec {
            kind: light.kind,
            name: light.name.clone(),
            enabled: (!light.enabled).then_some(false),
            position: light.position.filter(|_| has_position),
            direction: light.direction.filter(|_| has_direction),
            radius: light.kind.has_radius().then_some(light.radius),
            size: (light.kind == LightSourceKind::Rectangle).then_some(light.size),
            color: light.spectrum.is_none().then_some(light.color),
            spectrum: light.spectrum.as_ref().map(|s| s.samples().to_vec()),
            intensity: Some(light.intensity),
            constant: has_position.then_some(light.constant),
            linear: has_position.then_some(light.linear),
            quadratic: has_position.then_some(light.quadratic),
            inner_angle: is_spot.then_some(light.inner_angle),
            outer_angle: is_spot.then_some(light.outer_angle),
            motion: light.motion.as_ref().filter(|_| has_position).map(MotionSpec::from),
        }
    }
}

impl From<&Motion> for MotionSpec {
    fn from(motion: &Motion) -> Self {
        let spec = MotionSpec { kind: motion.path.kind(), period: motion.period, ..MotionSpec::default() };
        match &motion.path {
            MotionPath::Oscillate { amplitude } => MotionSpec { amplitude: Some(*amplitude), ..spec },
            MotionPath::Circle { center, axis } => MotionSpec { center: Some(*center), axis: Some(*axis), ..spec },
            MotionPath::Path { points } => MotionSpec { points: Some(points.clone()), ..spec },
        }
    }
}
