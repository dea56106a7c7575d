//! The models, one file each, and their list.
//!
//! A file opens with the table of its parameters, the formula, the source and the limits. A model of the seed's Appendix 6
//! comes in three forms: the paper's, a normalised one whose lobe has an albedo of at most 1, and the formula exactly as
//! Appendix 6 prints it.

pub mod ashikhmin_shirley;
pub mod beckmann;
pub mod blinn;
pub mod cook_torrance;
pub mod dielectric;
pub mod disney;
mod facets;
pub mod ggx;
pub mod lafortune;
pub mod lafortune_lobes;
pub mod lambert;
pub mod oren_nayar;
pub mod phong;
mod printed;
pub mod rough_dielectric;
pub mod ward;
pub mod ward_anisotropic;

use crate::bsdf::Bsdf;
use crate::parameter::{Parameter, ParameterValues};
use gonio_light::{DVec3, ShadingPoint};

/// A model: its description, its parameters, and its function in Rust and GLSL.
#[derive(Debug)]
pub struct BsdfModel {
    /// The name in the notation of models.
    pub name: &'static str,
    /// One line.
    pub title: &'static str,
    /// The formula in plain text.
    pub formula: &'static str,
    /// Author, year, title, equation.
    pub source: &'static str,
    /// Limits of the model; for a formula as printed, the slips in the print.
    pub remark: &'static str,
    /// The parameters.
    pub parameters: &'static [Parameter],
    /// The same function in GLSL: `vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)`, the parameters as uniforms. `None`
    /// for a smooth boundary, whose function is 0 for every pair but one.
    pub glsl: Option<&'static str>,
    /// Makes the function for given values.
    pub build: fn(&ParameterValues) -> Box<dyn Bsdf>,
}

/// All models.
pub static MODELS: &[&BsdfModel] = &[
    &lambert::LAMBERT,
    &phong::PHONG,
    &phong::PHONG_NORMALISED,
    &phong::PHONG_PRINTED,
    &blinn::BLINN,
    &blinn::BLINN_NORMALISED,
    &blinn::BLINN_PRINTED,
    &lafortune::LAFORTUNE,
    &lafortune::LAFORTUNE_NORMALISED,
    &lafortune::LAFORTUNE_PRINTED,
    &lafortune_lobes::LAFORTUNE_2,
    &lafortune_lobes::LAFORTUNE_3,
    &ward::WARD,
    &ward::WARD_NORMALISED,
    &ward::WARD_PRINTED,
    &ward_anisotropic::WARD_ANISOTROPIC,
    &cook_torrance::COOK_TORRANCE,
    &beckmann::BECKMANN,
    &ggx::GGX,
    &oren_nayar::OREN_NAYAR,
    &ashikhmin_shirley::ASHIKHMIN_SHIRLEY,
    &disney::DISNEY,
    &dielectric::DIELECTRIC,
    &rough_dielectric::ROUGH_DIELECTRIC,
];

/// The model of this name.
pub fn model(name: &str) -> Option<&'static BsdfModel> {
    MODELS.iter().copied().find(|model| model.name == name)
}

/// The point of the light equation that is seen from `wo` in the local frame.
fn local_point(wo: DVec3) -> ShadingPoint {
    ShadingPoint { position: DVec3::ZERO, normal: DVec3::Z, view: wo, tangent: DVec3::X }
}

/// `a` and `b` of Appendix 6.
const A: Parameter = Parameter::color("a", 0.0, "diffuse albedo");
const B: Parameter = Parameter::color("b", 0.5, "colour of the lobe");
/// The exponent of Phong's and Blinn's lobes.
const EXPONENT: Parameter = Parameter::number("c", [1.0, 1000.0], 32.0, "exponent, a larger one is glossier");
