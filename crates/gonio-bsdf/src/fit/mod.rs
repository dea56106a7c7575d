//! Fits of models to measured BRDFs, or to other functions, by least squares.
//!
//! The residual of a pair of directions and a channel is `w [(f_model cos theta_i)^(1/3) - (f_target cos theta_i)^(1/3)]`: the
//! cosine weights light as a surface receives it, the cube root keeps highlights from hiding everything else (M. M. Bagher,
//! C. Soler, N. Holzschuch, *Accurate Fitting of Measured Reflectances Using a Shifted Gamma Micro-facet Distribution*, EGSR
//! 2012, compare powers), and `w` is the root of the pair's share of all. The pairs are the middles of cells of a MERL table;
//! pairs with a direction within 10 degrees of the horizon are left out: measured tables are unreliable there.
//!
//! Levenberg and Marquardt's method (J. J. Moré, *The Levenberg-Marquardt Algorithm*, 1977) runs from several starting
//! points on grey values, and from the best of them in colour. Widths and exponents vary by their logarithm.
//!
//! An isotropic target, as every MERL table is, determines no anisotropy: both widths of an anisotropic model are equal then.
//!
//! | module | contents |
//! |---|---|
//! | `fittable` | the models, and which of their parameters vary |
//! | `matrix_lobe` | starting points of Lafortune's lobe |
//! | `target` | the values that a fit compares with |
//! | `problem` | starting points and residuals |

mod fittable;
mod matrix_lobe;
mod problem;
mod target;

pub use fittable::fittable_models;
pub use target::FitTarget;

use crate::bsdf::{Bsdf, BsdfSample, weighted};
use crate::model_spec::ModelSpec;
use crate::sampling::cosine_hemisphere;
use fittable::{Fittable, fittable};
use gonio_light::DVec3;
use problem::{Free, Problem, starting_points};
use std::fmt;
use target::Point;

/// The share of the signal's mean square below which no other starting point is tried: the model is the function.
const PERFECT: f64 = 1e-10;

/// A fitted model.
#[derive(Clone, Debug)]
pub struct BsdfFit {
    /// The model with its fitted parameters.
    pub spec: ModelSpec,
    /// The root mean square of the residuals.
    pub rms: f64,
    /// The root mean square of `(f cos)^(1/3)` itself, with which to compare.
    pub signal_rms: f64,
    /// Iterations from all starting points together.
    pub iterations: usize,
    /// Starting points that were tried.
    pub starts: usize,
    /// Names of parameters that ended at a limit of their range.
    pub at_limit: Vec<String>,
}

/// The models that are fitted to a target where nobody names others: those of its kind that measured materials follow best.
pub fn default_models(target: &FitTarget) -> &'static [&'static str] {
    if target.is_isotropic() {
        &["blinn-normalised", "ward", "beckmann", "ggx"]
    } else {
        &["ward-anisotropic", "ashikhmin-shirley", "disney"]
    }
}

/// The absolute difference of two functions, times a factor: the residual of a fit as a function, to be plotted like one.
pub struct FitResidual<'a> {
    /// The measured table, or another function.
    pub target: &'a dyn Bsdf,
    /// The model.
    pub fitted: &'a dyn Bsdf,
    /// The factor, to make small differences visible.
    pub factor: f64,
}

impl Bsdf for FitResidual<'_> {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        (self.target.evaluate(wi, wo) - self.fitted.evaluate(wi, wo)).abs() * self.factor
    }

    fn evaluate_all(&self, pairs: &[(DVec3, DVec3)]) -> Vec<DVec3> {
        let fitted = self.fitted.evaluate_all(pairs);
        self.target.evaluate_all(pairs).into_iter().zip(fitted).map(|(a, b)| (a - b).abs() * self.factor).collect()
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.target.density(wi, wo)
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        weighted(self, cosine_hemisphere([u[0], u[1]]), wo)
    }

    fn samples_follow_function(&self) -> bool {
        false
    }

    fn is_isotropic(&self) -> bool {
        self.target.is_isotropic() && self.fitted.is_isotropic()
    }
}

/// A fit that is not possible.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FitError {
    /// The model's parameters are not determined by the values of a reflection.
    NotFittable {
        /// The model.
        model: &'static str,
    },
    /// The target transmits light.
    Transmits,
    /// Too many values of the target are missing.
    TooFewValues {
        /// Pairs of directions with a value.
        values: usize,
    },
    /// The target is 0 everywhere.
    Black,
    /// The method did not start: the model has no finite value.
    Failed {
        /// The model.
        model: &'static str,
    },
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFittable { model } => {
                let known: Vec<&str> = fittable_models().map(|model| model.name).collect();
                write!(f, "`{model}` cannot be fitted: expected one of {}", known.join(", "))
            }
            Self::Transmits => write!(f, "a function that transmits light cannot be fitted"),
            Self::TooFewValues { values } => {
                write!(f, "only {values} finite values between the normal and 10 degrees above the horizon")
            }
            Self::Black => write!(f, "all values are 0: there is nothing to fit"),
            Self::Failed { model } => {
                write!(f, "the fit of `{model}` failed: the model has no finite value at the start")
            }
        }
    }
}

impl std::error::Error for FitError {}

/// Fits a model to a target.
///
/// # Errors
///
/// A model that cannot be fitted, or without finite values.
pub fn fit(target: &FitTarget, start: &ModelSpec) -> Result<BsdfFit, FitError> {
    let name = start.model.name;
    let entry = fittable(name).ok_or(FitError::NotFittable { model: name })?;
    let numbers = entry.groups(target.is_isotropic);
    let mut start = start.clone();
    if let Some(anisotropy) = entry.anisotropy.filter(|_| target.is_isotropic) {
        anisotropy.names.iter().for_each(|name| _ = start.values.set_value(name, DVec3::ZERO));
    }
    let (mut iterations, mut starts_used) = (0, 0);
    let mut best: Option<(f64, Vec<f64>)> = None;
    // A narrow lobe is seen at few pairs of directions, and may be at none of the coarse ones.
    let points = if entry.matrix.is_empty() { &target.coarse } else { &target.fine };
    let signal = mean_square(points);
    for mut x in starting_points(entry, &numbers, start.model, points) {
        let mut problem = Problem::new(points, &start, entry, &numbers, true);
        let Some((norm, steps)) = problem.solve(&mut x) else { continue };
        iterations += steps;
        if best.as_ref().is_none_or(|(least, _)| norm < *least) {
            best = Some((norm, x));
        }
        starts_used += 1;
        if norm < signal * PERFECT {
            break;
        }
    }
    let (_, grey) = best.ok_or(FitError::Failed { model: name })?;
    // Colours first, each channel from the grey value; then the numbers.
    let mut x: Vec<f64> = grey[..entry.colors.len()].iter().flat_map(|value| [*value; 3]).collect();
    x.extend(&grey[entry.colors.len()..]);
    let mut problem = Problem::new(&target.fine, &start, entry, &numbers, false);
    let (norm, steps) = problem.solve(&mut x).ok_or(FitError::Failed { model: name })?;
    problem.set(&x);
    let spec = entry.in_order(problem.spec);
    let at_limit = at_limit(&problem.free, &spec, entry);
    Ok(BsdfFit {
        spec,
        rms: norm.sqrt(),
        signal_rms: mean_square(&target.fine).sqrt(),
        iterations: iterations + steps,
        starts: starts_used,
        at_limit,
    })
}

/// The mean square of `(f cos)^(1/3)`.
fn mean_square(points: &[Point]) -> f64 {
    points.iter().map(|point| point.target.length_squared() / 3.0).sum::<f64>() / points.len() as f64
}

/// The names of numbers that ended at a limit. Limits of a matrix say nothing: its factor is free.
fn at_limit(free: &[Free], spec: &ModelSpec, entry: &Fittable) -> Vec<String> {
    let mut at_limit = Vec::new();
    for free in free {
        let Some(first) = free.names.first().filter(|name| !entry.matrix.contains(name)) else { continue };
        if is_at_limit(free, free.coordinate(spec.values.color(first)[free.channel.unwrap_or(0)])) {
            let names = free.names.join(", ");
            let channel = free.channel.and_then(|channel| ["red", "green", "blue"].get(channel));
            at_limit.push(channel.map_or_else(|| names.clone(), |channel| format!("{names} ({channel})")));
        }
    }
    at_limit
}

/// Whether a number ended at a limit. A colour of 0 is no limit of the model, but a surface without that part.
fn is_at_limit(free: &Free, x: f64) -> bool {
    let [min, max] = free.range;
    let near = 1e-6 * (max - min);
    x >= max - near || (free.channel.is_none() && x <= min + near)
}
