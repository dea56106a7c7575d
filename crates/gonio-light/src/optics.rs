//! Reflection and refraction of the environment: mirrors, glass, and everything between them and the lit surface.
//!
//! ```text
//! L = (1 - t) [(1 - w) L_o + w E(R)]  +  t [F E(R) + (1 - F) tint E(T)]
//! ```
//!
//! | symbol | what | range | default |
//! |---|---|---|---|
//! | `L_o` | the light equation | | |
//! | `E(D)` | the environment's radiance from the direction D | | |
//! | `R`, `T` | [`vector::reflection`] and [`vector::refraction`] of `V` | unit | |
//! | `t` | [`Optics::transmission`] | 0 to 1 | 0 |
//! | `w` | [`Optics::reflectivity`], times `F` where there is a Fresnel factor | 0 to 1 | 0 |
//! | `F` | [`reflectance`]: exact, Schlick's, or none (then 0); 1 where reflection is total | 0 to 1 | none |
//! | `tint` | colour of what is let through, once | 0 to 1 | white |
//!
//! The Fresnel factors are functions of `eta = eta_L / eta_T`, as in [`vector::refraction`]: the index of refraction on
//! the light's side over the one on the other side.
//!
//! With two refracting surfaces ([`Surfaces::Two`]), `E(T)` is the radiance through the body: [`through_body`].

use crate::color::unit_interval;
use crate::shading_point::ShadingPoint;
use crate::vector;
use glam::DVec3;

named_enum! {
    /// Materials of the lab's table of refraction indices.
    pub enum Medium {
        /// Index 1.00
        Air = "air",
        /// Index 1.33
        Water = "water",
        /// Index 1.309
        Ice = "ice",
        /// Index 1.52
        Glass = "glass",
        /// Index 2.42
        Diamond = "diamond",
    }
    default Glass;
    what "medium";
}

impl Medium {
    /// The index of refraction by the lab's table (for yellow light, about 589 nm).
    pub const fn refraction_index(self) -> f64 {
        match self {
            Medium::Air => 1.00,
            Medium::Water => 1.33,
            Medium::Ice => 1.309,
            Medium::Glass => 1.52,
            Medium::Diamond => 2.42,
        }
    }
}

named_enum! {
    /// The Fresnel factor of a boundary.
    pub enum Fresnel {
        /// Independent of the angle, as in the lab; reflection is total where there is no refraction.
        None = "none",
        /// Fresnel's equations for unpolarised light and a dielectric.
        Exact = "exact",
        /// Schlick's approximation.
        Schlick = "schlick",
    }
    default None;
    what "Fresnel factor";
}

named_enum! {
    /// The number of surfaces of a body at which a view ray is refracted.
    pub enum Surfaces {
        /// The first one only, as in the lab.
        One = "one",
        /// The surfaces where the ray enters and leaves, with total reflections between; needs a closed body.
        Two = "two",
    }
    default One;
    what "number of refracting surfaces";
}

/// The most surfaces that a view ray meets inside a body before it leaves in its direction. Each partial reflection
/// inside carries a few per cent on; total ones may be many, and look alike after some.
pub const MOST_MEETINGS: usize = 4;

/// Reflection and refraction of the environment by a surface. See the head of the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optics {
    /// The share of the mirror, from the lit surface (0) to a mirror (1), for the part that does not transmit.
    pub reflectivity: f64,
    /// The share of the clear surface, from opaque (0) to clear (1), which shows nothing of its own light.
    pub transmission: f64,
    /// The Fresnel factor.
    pub fresnel: Fresnel,
    /// The factor of transmitted light, applied once for any number of surfaces. Linear RGB, 0 to 1.
    pub tint: DVec3,
    /// The absorption of the body, per world unit: light is weakened by `exp(-absorption d)` over the distance `d`.
    /// Counts between two surfaces. Linear RGB, not negative.
    pub absorption: DVec3,
    /// The index of blue light (486 nm, the green channel has the index itself) less that of red light (656 nm).
    pub dispersion: f64,
    /// The refracting surfaces.
    pub surfaces: Surfaces,
}

impl Default for Optics {
    fn default() -> Self {
        Optics {
            reflectivity: 0.0,
            transmission: 0.0,
            fresnel: Fresnel::None,
            tint: DVec3::ONE,
            absorption: DVec3::ZERO,
            dispersion: 0.0,
            surfaces: Surfaces::One,
        }
    }
}

impl Optics {
    /// Whether the surface shows nothing of its surroundings.
    pub fn is_plain(&self) -> bool {
        self.reflectivity <= 0.0 && self.transmission <= 0.0
    }

    /// The indices of refraction for red, green and blue about that of the material, each at least
    /// [`SMALLEST_INDEX`].
    pub fn indices(&self, index: f64) -> [f64; 3] {
        [index - 0.5 * self.dispersion, index, index + 0.5 * self.dispersion].map(|n| n.max(SMALLEST_INDEX))
    }

    /// `w`: the share of the lit surface that the environment's reflection replaces, where the boundary has the
    /// Fresnel factor `f`.
    pub fn mirror_share(&self, f: f64) -> f64 {
        match self.fresnel {
            Fresnel::None => self.reflectivity,
            Fresnel::Exact | Fresnel::Schlick => self.reflectivity * f,
        }
    }

    /// `L`, from the value of the light equation and the visible surroundings.
    pub fn compose(&self, lit: DVec3, sight: &Sight) -> DVec3 {
        let share = self.mirror_share(sight.fresnel.y);
        let opaque = lit * (1.0 - share) + sight.reflected * share;
        let clear = sight.fresnel * sight.reflected + sight.transmitted;
        opaque * (1.0 - self.transmission) + clear * self.transmission
    }
}

/// Dispersion brings no index below this: no material is a vacuum in which light is twice as fast.
pub const SMALLEST_INDEX: f64 = 0.1;

/// The reflected and the refracted ray at a boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// `R`, unit.
    pub reflected: DVec3,
    /// `T`, unit; none where reflection is total.
    pub transmitted: Option<DVec3>,
    /// `F` in [0, 1]: 1 where reflection is total.
    pub reflectance: f64,
}

/// The view ray at a boundary between the outside (index 1) and a material. `n`: unit normal, outwards; `v`: unit,
/// back along the ray. Seen from inside (`n.v < 0`) the ray goes out.
pub fn boundary(n: DVec3, v: DVec3, index: f64, kind: Fresnel) -> Boundary {
    let (n, eta) = if n.dot(v) >= 0.0 { (n, 1.0 / index) } else { (-n, index) };
    let reflected = vector::reflection(n, v);
    let transmitted = vector::refraction(n, v, eta);
    Boundary { reflected, transmitted, reflectance: reflectance(kind, n.dot(v), eta) }
}

/// `F`: the share of light that a boundary reflects, in [0, 1]; without a Fresnel factor 0, and by every kind 1 where
/// reflection is total. `cos_i` is the cosine on the side of the ray, `eta` the index there over the one beyond.
///
/// Schlick's approximation takes the cosine on the thinner side, or else it would know nothing of the critical angle.
pub fn reflectance(kind: Fresnel, cos_i: f64, eta: f64) -> f64 {
    let cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    if cos2_t < 0.0 {
        return 1.0;
    }
    match kind {
        Fresnel::None => 0.0,
        Fresnel::Exact => dielectric(cos_i, eta),
        Fresnel::Schlick => {
            let cos = if eta > 1.0 { cos2_t.sqrt() } else { cos_i };
            schlick(cos, f0_from_index(eta))
        }
    }
}

/// The environment that a point shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sight {
    /// `R`, unit.
    pub reflection: DVec3,
    /// `E(R)`
    pub reflected: DVec3,
    /// `(1 - F) tint E(T)`, of each channel by its own index; 0 where reflection is total.
    pub transmitted: DVec3,
    /// `F` of each channel.
    pub fresnel: DVec3,
}

/// The terms that an environment adds to the light equation at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnvironmentTerms {
    /// Diffuse light, times `k_d`.
    pub diffuse: DVec3,
    /// Glossy reflection, times `k_s`.
    pub specular: DVec3,
    /// The environment in mirrors and glass; all zero where the surface is neither.
    pub sight: Sight,
}

/// The point where a view ray inside a body meets its surface again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// World space.
    pub position: DVec3,
    /// Unit shading normal, outwards: away from where the ray comes from.
    pub normal: DVec3,
    /// World units along the ray.
    pub distance: f64,
}

/// A surface nearer to a ray's origin inside an object than this share of the diagonal of the object's box is the
/// surface that the ray starts from: more than the rounding of positions in f32, and far below what is visible.
pub const NEAREST_MEETING: f64 = 1e-6;

/// The body that a point belongs to, as rays inside of it find it.
pub trait Body {
    /// The next point at which a ray from `origin` (world space) along `direction` (unit) meets the body's surface from
    /// inside; `None` if the body is open there.
    fn next_meeting(&self, origin: DVec3, direction: DVec3) -> Option<Meeting>;
}

/// The environment that a point shows. `environment` is `E`: linear radiance from a unit direction. `body` matters
/// where two surfaces count and the point is seen from outside.
pub fn sight(
    point: &ShadingPoint,
    index: f64,
    optics: &Optics,
    environment: &dyn Fn(DVec3) -> DVec3,
    body: Option<&dyn Body>,
) -> Sight {
    let (n, v) = (point.normal, point.view);
    let body = body.filter(|_| optics.surfaces == Surfaces::Two && n.dot(v) >= 0.0);
    let mut seen = Sight { reflection: boundary(n, v, index, optics.fresnel).reflected, ..Sight::default() };
    seen.reflected = environment(seen.reflection);
    let indices = optics.indices(index);
    let mut known: Option<(f64, DVec3, f64)> = None;
    for (channel, index) in indices.into_iter().enumerate() {
        // Without dispersion one ray serves all three channels.
        let (transmitted, reflectance) = match known {
            Some((same, transmitted, reflectance)) if same == index => (transmitted, reflectance),
            _ => {
                let at = boundary(n, v, index, optics.fresnel);
                let transmitted = at.transmitted.map_or(DVec3::ZERO, |t| match body {
                    Some(body) => through_body(point.position, t, index, optics, environment, body),
                    None => environment(t),
                });
                (transmitted, at.reflectance)
            }
        };
        known = Some((index, transmitted, reflectance));
        seen.fresnel[channel] = reflectance;
        seen.transmitted[channel] = (1.0 - reflectance) * optics.tint[channel] * transmitted[channel];
    }
    seen
}

/// The radiance along a view ray that has entered a body at `origin` along `direction`.
///
/// At each meeting the part that is not reflected leaves and shows the environment there; the reflected part continues,
/// at most [`MOST_MEETINGS`] times, and then leaves in its direction. Absorption weakens every part along its way
/// inside.
pub fn through_body(
    origin: DVec3,
    direction: DVec3,
    index: f64,
    optics: &Optics,
    environment: &dyn Fn(DVec3) -> DVec3,
    body: &dyn Body,
) -> DVec3 {
    let (mut origin, mut direction) = (origin, direction);
    let mut sum = DVec3::ZERO;
    let mut weight = DVec3::ONE;
    for _ in 0..MOST_MEETINGS {
        let Some(meeting) = body.next_meeting(origin, direction) else { break };
        weight *= (-optics.absorption * meeting.distance).map(f64::exp);
        let at = boundary(meeting.normal, -direction, index, optics.fresnel);
        if let Some(out) = at.transmitted {
            sum += weight * (1.0 - at.reflectance) * environment(out);
        }
        weight *= at.reflectance;
        if weight.max_element() < WEIGHT_THAT_COUNTS {
            return sum;
        }
        (origin, direction) = (meeting.position, at.reflected);
    }
    sum + weight * environment(direction)
}

/// A ray with a smaller weight is not followed: a quarter of a step of 8 bits.
pub const WEIGHT_THAT_COUNTS: f64 = 1e-3;

/// The share of unpolarised light that a smooth boundary of two dielectrics reflects, in `[0, 1]`.
///
/// ```text
/// r_s = (eta cos_i - cos_t) / (eta cos_i + cos_t)
/// r_p = (cos_i - eta cos_t) / (cos_i + eta cos_t)     F = (r_s^2 + r_p^2) / 2
/// ```
///
/// `cos_i` is the cosine between the incoming direction and the normal on its side, held in `[0, 1]`;
/// `eta > 0`. 1 where reflection is total, and for an `eta` that is not a positive number; 0 for
/// `eta = 1` (no boundary). Source: M. Born and E. Wolf, *Principles of Optics*, section 1.5.2, (21).
pub fn dielectric(cos_i: f64, eta: f64) -> f64 {
    let [s, p] = polarised_dielectric(cos_i, eta);
    unit_interval(0.5 * (s + p))
}

/// The shares `r_s^2` and `r_p^2` of light that is polarised across the plane of incidence and in it; see [`dielectric`].
/// At [`brewster_angle_rad`] the second one is 0.
pub fn polarised_dielectric(cos_i: f64, eta: f64) -> [f64; 2] {
    if eta == 1.0 {
        return [0.0; 2];
    }
    let cos_i = unit_interval(cos_i);
    let cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    // Conditions that hold, not ones that fail: NaN then ends at the 1 below.
    if eta > 0.0 && cos2_t >= 0.0 {
        let cos_t = cos2_t.sqrt();
        let (s_sum, p_sum) = (eta * cos_i + cos_t, cos_i + eta * cos_t);
        if s_sum > 0.0 && p_sum > 0.0 && s_sum.is_finite() && p_sum.is_finite() {
            let r_s = (eta * cos_i - cos_t) / s_sum;
            let r_p = (cos_i - eta * cos_t) / p_sum;
            return [r_s * r_s, r_p * r_p];
        }
    }
    [1.0; 2]
}

/// The angle of incidence in radians at which light polarised in the plane of incidence is not reflected, `atan(1 / eta)`.
/// Source: D. Brewster 1815; M. Born and E. Wolf, *Principles of Optics*, section 1.5.3.
pub fn brewster_angle_rad(eta: f64) -> f64 {
    (1.0 / eta).atan()
}

/// Schlick's approximation `f0 + (1 - f0)(1 - cos)^5`, `cos` held in `[0, 1]`.
///
/// It holds for light that enters the denser medium; from inside it needs the cosine on the outer
/// side, and it lacks total reflection. Source: C. Schlick, *An Inexpensive BRDF Model for
/// Physically-based Rendering*, Computer Graphics Forum 13(3), 1994, eq. (15).
pub fn schlick(cos: f64, f0: f64) -> f64 {
    let x = 1.0 - unit_interval(cos);
    let x2 = x * x;
    f0 + (1.0 - f0) * x2 * x2 * x
}

/// `F` at normal incidence, `((1 - eta) / (1 + eta))^2`, for a relative index `eta` > 0. The same for
/// `eta` and `1 / eta`: against air it is enough to give the material's own index.
pub fn f0_from_index(eta: f64) -> f64 {
    let r = (1.0 - eta) / (1.0 + eta);
    r * r
}

/// The angle of incidence in radians from which reflection is total, `asin(1 / eta)`; `None` where
/// it never is (`eta <= 1`, from the thinner medium into the denser one).
pub fn critical_angle_rad(eta: f64) -> Option<f64> {
    (eta > 1.0).then(|| (1.0 / eta).asin())
}
