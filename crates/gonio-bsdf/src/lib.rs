//! Bidirectional scattering distribution functions as functions of two directions.
//!
//! Directions are unit vectors in the local frame: tangent +X, bitangent +Y, normal +Z. `wi` points to the light, `wo` to
//! the viewer; both point away from the surface. `f` is in 1/sr, per channel of linear RGB.
//!
//! | module | contents |
//! |---|---|
//! | [`bsdf`] | the [`Bsdf`] trait: value, sampling, density |
//! | [`parameter`] | parameters with ranges, and their values |
//! | [`models`] | the models, one file each, and their list |
//! | [`model_spec`] | `name:key=value,...`, the notation of a model with parameters |
//! | [`integrate`], [`mod@check`] | albedos; reciprocity, energy, positivity, normalisation, chi-square |
//! | [`glsl`], [`mod@embedded_glsl`] | BRDFs written as GLSL functions, run on the CPU; as parts of other shaders |
//! | [`merl`], [`half_angles`] | the tables of the MERL database |
//! | [`explorer`] | the `.brdf` files of BRDF Explorer |
//! | [`named_bsdf`] | any of them with its name; exports |
//! | [`mod@fit`], [`fit_file`] | fits of models to tables and other functions, and their files |
//! | [`lobe_width`] | the lobe by which a few directions represent a function |
//! | [`sampling`] | directions from random numbers, with their densities |
//!
//! Nothing here opens a file or prints.
#![forbid(unsafe_code)]

pub mod bsdf;
pub mod check;
pub mod embedded_glsl;
pub mod explorer;
pub mod fit;
pub mod fit_file;
pub mod glsl;
pub mod half_angles;
pub mod integrate;
pub mod lobe_width;
pub mod merl;
pub mod model_spec;
pub mod models;
pub mod named_bsdf;
pub mod parameter;
pub mod sampling;

pub use bsdf::{Bsdf, BsdfSample};
pub use check::{CheckedProperty, check};
pub use embedded_glsl::embedded_glsl;
pub use fit::{BsdfFit, FitError, FitResidual, FitTarget, fit};
pub use glsl::{GlslBrdf, GlslBrdfError};
pub use gonio_light::DVec3;
pub use lobe_width::function_lobe;
pub use merl::{MerlError, MerlTable};
pub use model_spec::{ModelSpec, ModelSpecError};
pub use models::{BsdfModel, MODELS};
pub use named_bsdf::{BsdfSource, NamedBsdf, NamedBsdfError};
pub use parameter::{Parameter, ParameterError, ParameterKind, ParameterValues};
