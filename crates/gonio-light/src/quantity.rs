//! The vectors and scalars of the equation by name: what a debug view shows and a probe prints.

use crate::equation::Terms;
use crate::vector;
use glam::{DVec2, DVec3};

named_enum! {
    /// A value of the equation that can be shown alone.
    pub enum Quantity {
        /// `N`, the shading normal, world space.
        Normal = "normal",
        /// The triangle's own normal, world space.
        GeometricNormal = "geometric-normal",
        /// The tangent, world space.
        Tangent = "tangent",
        /// The point, world space.
        Position = "position",
        /// Distance from the eye along the viewing direction, world units.
        Depth = "depth",
        /// Texture coordinates.
        Uv = "uv",
        /// `V`, to the eye.
        View = "view",
        /// `L`, to the light.
        Light = "light",
        /// `R = 2 (N.L) N - L`.
        Reflection = "reflection",
        /// `H = (L + V) / |L + V|`.
        Half = "half",
        /// `T`, the view direction refracted into the material (R' = 2 (N.V) N - V where reflection is total).
        Refraction = "refraction",
        /// `2 (N.V) N - V`: where a mirror looks.
        ViewReflection = "view-reflection",
        /// `d`, distance to the light, world units (0 for directional lights).
        Distance = "distance",
        /// `att`.
        Attenuation = "attenuation",
        /// `spot`.
        Spot = "spot",
        /// `v`, the share of the light that reaches the point: 0 in a shadow; 1 where shadows are off.
        Visibility = "visibility",
        /// `<N.L>`.
        CosTheta = "cos-theta",
        /// `spec`.
        Spec = "spec",
        /// `F` of the view, without a Fresnel factor 0; 1 where reflection is total.
        Fresnel = "fresnel",
        /// `k_d`, the material's diffuse colour with its texture.
        Albedo = "albedo",
        /// `A`.
        Ambient = "ambient",
        /// `E`.
        Emitted = "emitted",
        /// The diffuse term: summed over the lights, or one light's.
        Diffuse = "diffuse",
        /// The specular term: summed over the lights, or one light's.
        Specular = "specular",
        /// Diffuse light of the environment, times `k_d`.
        EnvironmentDiffuse = "environment-diffuse",
        /// Glossy reflection of the environment, times `k_s`.
        EnvironmentSpecular = "environment-specular",
        /// `E(R)`, what a mirror would show.
        Reflected = "reflected",
        /// `(1 - F) tint E(T)`, what clear glass would show through.
        Transmitted = "transmitted",
        /// `L_o`, before exposure and tone mapping.
        Total = "total",
    }
    default Total;
    what "debug view";
}

/// The mapping of a quantity's numbers to a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// A direction: [-1, 1] is mapped to [0, 1].
    Direction,
    /// A position: the scene's bounds are mapped to [0, 1].
    Position,
    /// A distance: the scene's range of distances is mapped to [0, 1].
    Distance,
    /// A factor in [0, 1], shown clamped.
    Factor,
    /// A colour of light: shown like the picture itself.
    Color,
}

impl Quantity {
    /// Its encoding as a colour.
    pub const fn encoding(self) -> Encoding {
        use Quantity::*;
        match self {
            Normal | GeometricNormal | Tangent | View | Light | Reflection | ViewReflection | Half | Refraction => {
                Encoding::Direction
            }
            Position => Encoding::Position,
            Depth | Distance => Encoding::Distance,
            Uv | Attenuation | Spot | Visibility | CosTheta | Spec | Fresnel => Encoding::Factor,
            Albedo | Ambient | Emitted | Diffuse | Specular | EnvironmentDiffuse | EnvironmentSpecular | Reflected
            | Transmitted | Total => Encoding::Color,
        }
    }

    /// Whether it belongs to one light (and `NAME:INDEX` chooses which).
    pub const fn per_light(self) -> bool {
        use Quantity::*;
        matches!(self, Light | Reflection | Half | Distance | Attenuation | Spot | Visibility | CosTheta | Spec)
    }

    /// Whether one light's share can be chosen (else the sum is shown).
    pub const fn summed_over_lights(self) -> bool {
        matches!(self, Quantity::Diffuse | Quantity::Specular)
    }

    /// The short symbol of the lecture, where it has one: `N`, `L`, `att`...
    pub const fn symbol(self) -> Option<&'static str> {
        use Quantity::*;
        match self {
            Normal => Some("N"),
            View => Some("V"),
            Light => Some("L"),
            Reflection => Some("R"),
            Half => Some("H"),
            Refraction => Some("T"),
            Fresnel => Some("F"),
            Attenuation => Some("att"),
            Visibility => Some("v"),
            Distance => Some("d"),
            Ambient => Some("A"),
            Emitted => Some("E"),
            _ => None,
        }
    }
}

/// The geometry of a shading point besides the equation's terms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Unit, world space.
    pub geometric_normal: DVec3,
    /// Unit, world space.
    pub tangent: DVec3,
    /// Texture coordinates, v up.
    pub uv: DVec2,
    /// Distance from the eye along the viewing direction, world units.
    pub depth: f64,
}

/// A quantity's value. Scalars fill all three components; `uv` has 0 in the third.
pub type Value = DVec3;

impl Terms {
    /// The value of `quantity`; `light` is an index into the scene's lights.
    ///
    /// Quantities of one light default to the first light that is not ambient, and are 0 where there
    /// is no such light. `diffuse` and `specular` default to the sum.
    pub fn quantity(&self, quantity: Quantity, light: Option<usize>, geometry: &Geometry) -> Value {
        let chosen = match light {
            Some(index) => self.lights.iter().find(|t| t.light == index),
            None => self.lights.first(),
        };
        let vector_of = |f: fn(&crate::LightTerms) -> DVec3| chosen.map_or(DVec3::ZERO, f);
        let scalar_of = |f: fn(&crate::LightTerms) -> f64| DVec3::splat(chosen.map_or(0.0, f));
        match quantity {
            Quantity::Normal => self.point.normal,
            Quantity::GeometricNormal => geometry.geometric_normal,
            Quantity::Tangent => geometry.tangent,
            Quantity::Position => self.point.position,
            Quantity::Depth => DVec3::splat(geometry.depth),
            Quantity::Uv => geometry.uv.extend(0.0),
            Quantity::View => self.point.view,
            Quantity::Light => vector_of(|t| t.l),
            Quantity::Reflection => vector_of(|t| t.r),
            Quantity::Half => vector_of(|t| t.h),
            Quantity::Refraction => {
                let (n, v) = (self.point.normal, self.point.view);
                // From outside into the material; seen from inside, the other way round.
                let (n, eta) = if n.dot(v) >= 0.0 {
                    (n, 1.0 / self.surface.refraction_index)
                } else {
                    (-n, self.surface.refraction_index)
                };
                vector::refraction(n, v, eta).unwrap_or_else(|| vector::reflection(n, v))
            }
            Quantity::ViewReflection => vector::reflection(self.point.normal, self.point.view),
            Quantity::Fresnel => self.environment.sight.fresnel,
            Quantity::EnvironmentDiffuse => self.environment.diffuse,
            Quantity::EnvironmentSpecular => self.environment.specular,
            Quantity::Reflected => self.environment.sight.reflected,
            Quantity::Transmitted => self.environment.sight.transmitted,
            Quantity::Distance => scalar_of(|t| if t.distance.is_finite() { t.distance } else { 0.0 }),
            Quantity::Attenuation => scalar_of(|t| t.attenuation),
            Quantity::Spot => scalar_of(|t| t.spot),
            Quantity::Visibility => scalar_of(|t| t.visibility),
            Quantity::CosTheta => scalar_of(|t| t.cos_theta.max(0.0)),
            Quantity::Spec => scalar_of(|t| t.spec),
            Quantity::Albedo => self.surface.diffuse,
            Quantity::Ambient => self.ambient,
            Quantity::Emitted => self.emitted,
            Quantity::Diffuse => match light {
                Some(_) => vector_of(|t| t.diffuse),
                None => self.diffuse,
            },
            Quantity::Specular => match light {
                Some(_) => vector_of(|t| t.specular),
                None => self.specular,
            },
            Quantity::Total => self.total,
        }
    }
}

/// Magnitude below which a number is noise. Rounding errors of terms of about 1 are smaller in f64 (2e-16 each), and so
/// is what remains of a term that vanishes, such as a cosine to a high power.
const NOISE: f64 = 1e-12;

/// Whether a number is displayed as 0: its magnitude is below 1e-12.
pub fn is_noise(number: f64) -> bool {
    number.abs() < NOISE
}
