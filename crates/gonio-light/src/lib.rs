//! The light equation, as plain functions in `f64`.
//!
//! ```text
//! L_o = A + E + sum_i [ diff * k_d * <N.L_i>  +  k_s * spec_i ] * L_i * att_i * spot_i
//! ```
//!
//! Directions are unit vectors in world space, colours are linear RGB, `<x>` means `max(x, 0)`.
//! [`equation::Equation::evaluate`] gives every term of one shading point at once, by name; the
//! probe, the debug views, the checker and the plots all read those values. Nothing here opens a
//! file or knows OpenGL.
//!
//! | module | contents |
//! |---|---|
//! | [`equation`] | the switches of the equation, its terms, and their sum |
//! | [`light`] | light kinds, attenuation, the spot's cone |
//! | [`brdf`] | Lambert, Phong, Blinn, Lafortune, Ward |
//! | [`microfacet`] | rough mirrors (GGX), their integral over an environment, exponents of roughnesses |
//! | [`function_light`] | an environment on a surface whose BRDF is any function |
//! | [`shading_point`] | geometry and material of one point |
//! | [`vector`] | reflection, refraction, half vector |
//! | [`optics`] | mirrors and glass: how a surface shows its surroundings; Fresnel factors |
//! | [`color`] | sRGB, exposure, tone mapping |
//! | [`observer`], [`spectrum`] | the CIE observer and daylight; spectra and their colours |
//! | [`simplification`] | the steps from the rendering equation to this one |
//! | [`quantity`] | the vectors and scalars of the equation by name |

#[macro_use]
pub mod names;
pub mod brdf;
pub mod color;
pub mod equation;
pub mod function_light;
pub mod light;
pub mod microfacet;
pub mod observer;
pub mod optics;
pub mod quantity;
pub mod shading_point;
pub mod simplification;
pub mod spectrum;
pub mod vector;

pub use equation::{Convention, Equation, LightSums, LightTerms, MaterialFunction, Specular, TermSwitches, Terms};
pub use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};
pub use light::{Attenuation, Incident, Light, LightKind};
pub use optics::{Fresnel, Optics, Sight, Surfaces};
pub use quantity::{Quantity, Value, is_noise};
pub use shading_point::{ShadingPoint, Surface};
pub use simplification::{Simplification, Simplifications};
pub use spectrum::Spectrum;
