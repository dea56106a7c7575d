//! Fits of models to measured BRDFs by least squares.
//!
//! The residual of a cell of the table and a channel is `w [(f_model cos theta_i)^(1/3) - (f_table cos theta_i)^(1/3)]`: the
//! cosine weights light as a surface receives it, the cube root keeps highlights from hiding everything else (M. M. Bagher,
//! C. Soler, N. Holzschuch, *Accurate Fitting of Measured Reflectances Using a Shifted Gamma Micro-facet Distribution*, EGSR
//! 2012, compare powers), and `w` is the root of the cell's share of all. Cells with a direction within 10 degrees of the
//! horizon are left out: measured tables are unreliable there.
//!
//! Levenberg and Marquardt's method (J. J. Moré, *The Levenberg-Marquardt Algorithm*, 1977) runs from several starting
//! points on grey values, and from the best of them in colour. Widths and exponents vary by their logarithm.

use crate::bsdf::{Bsdf, BsdfSample, mean, weighted};
use crate::merl::{CELLS, MerlTable, PHI_D, THETA_D, THETA_H, cell_middle};
use crate::model_spec::ModelSpec;
use crate::models::{BsdfModel, model};
use crate::parameter::ParameterKind;
use crate::sampling::cosine_hemisphere;
use gonio_light::DVec3;
use rmpfit::{MPConfig, MPFitter, MPPar, MPResult};
use std::f64::consts::PI;
use std::fmt;

/// The smallest cosine of the directions that count: 10 degrees above the horizon.
const LEAST_COSINE: f64 = 0.173_6;

/// The parameters that a table of an isotropic surface determines. Parameters in one group have the same value.
#[derive(Clone, Copy, Debug)]
struct Fittable {
    model: &'static str,
    colors: &'static [&'static str],
    numbers: &'static [&'static [&'static str]],
}

const FITTABLE: &[Fittable] = &[
    Fittable { model: "lambert", colors: &["a"], numbers: &[] },
    Fittable { model: "phong", colors: &["a", "b"], numbers: &[&["c"]] },
    Fittable { model: "phong-normalised", colors: &["a", "b"], numbers: &[&["c"]] },
    Fittable { model: "blinn", colors: &["a", "b"], numbers: &[&["c"]] },
    Fittable { model: "blinn-normalised", colors: &["a", "b"], numbers: &[&["c"]] },
    // The scale of the matrix and b are the same for one lobe, so the matrix gives the shape only.
    Fittable { model: "lafortune-normalised", colors: &["a", "b"], numbers: &[&["k"], &["az"]] },
    Fittable { model: "lafortune-2", colors: &["a", "b1", "b2"], numbers: &[&["k1"], &["z1"], &["k2"], &["z2"]] },
    Fittable {
        model: "lafortune-3",
        colors: &["a", "b1", "b2", "b3"],
        numbers: &[&["k1"], &["z1"], &["k2"], &["z2"], &["k3"], &["z3"]],
    },
    Fittable { model: "ward", colors: &["a", "b"], numbers: &[&["c"]] },
    Fittable { model: "ward-normalised", colors: &["a", "b"], numbers: &[&["c"]] },
    Fittable { model: "cook-torrance", colors: &["a", "f0"], numbers: &[&["m"]] },
    Fittable { model: "beckmann", colors: &["a", "f0"], numbers: &[&["alpha"]] },
    Fittable { model: "ggx", colors: &["a", "f0"], numbers: &[&["alpha"]] },
    Fittable { model: "oren-nayar", colors: &["a"], numbers: &[&["sigma"]] },
    Fittable { model: "ashikhmin-shirley", colors: &["rd", "rs"], numbers: &[&["nu", "nv"]] },
    Fittable { model: "disney", colors: &["baseColor"], numbers: &[&["metallic"], &["specular"], &["roughness"]] },
];

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
    /// Starting points.
    pub starts: usize,
    /// Names of parameters that ended at a limit of their range.
    pub at_limit: Vec<String>,
}

/// The absolute difference of a table and a model: the residual of a fit as a function, to be plotted like one.
pub struct FitResidual<'a> {
    /// The table.
    pub table: &'a MerlTable,
    /// The model.
    pub fitted: &'a dyn Bsdf,
}

impl Bsdf for FitResidual<'_> {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        (self.table.evaluate(wi, wo) - self.fitted.evaluate(wi, wo)).abs()
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.table.density(wi, wo)
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        weighted(self, cosine_hemisphere([u[0], u[1]]), wo)
    }

    fn samples_follow_function(&self) -> bool {
        false
    }
}

/// A fit that is not possible.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FitError {
    /// A table of an isotropic surface does not determine the model's parameters.
    NotFittable {
        /// The model.
        model: &'static str,
    },
    /// Too many cells of the table are missing.
    TooFewValues {
        /// Cells with a value.
        cells: usize,
    },
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
                write!(
                    f,
                    "an isotropic table does not determine the parameters of `{model}`: expected one of {}",
                    known.join(", ")
                )
            }
            Self::TooFewValues { cells } => {
                write!(f, "the table has only {cells} values between the normal and 10 degrees above the horizon")
            }
            Self::Failed { model } => {
                write!(f, "the fit of `{model}` failed: the model has no finite value at the start")
            }
        }
    }
}

impl std::error::Error for FitError {}

/// The models that can be fitted.
pub fn fittable_models() -> impl Iterator<Item = &'static BsdfModel> {
    FITTABLE.iter().filter_map(|entry| model(entry.model))
}

/// A measured value.
struct Point {
    wi: DVec3,
    wo: DVec3,
    /// `(f cos)^(1/3)`
    target: DVec3,
}

/// The cells that take part, `step` apart in each coordinate.
fn points(table: &MerlTable, [step_h, step_d, step_p]: [usize; 3]) -> Vec<Point> {
    let mut points = Vec::new();
    for h in (0..THETA_H).step_by(step_h) {
        for d in (0..THETA_D).step_by(step_d) {
            // Other cells in every row, so that all values of phi_d take part.
            for p in ((h * 7 + d * 3) % step_p..PHI_D).step_by(step_p) {
                let cell = (h * THETA_D + d) * PHI_D + p;
                debug_assert!(cell < CELLS);
                let (wi, wo) = cell_middle(cell).directions();
                if wi.z < LEAST_COSINE || wo.z < LEAST_COSINE {
                    continue;
                }
                let Some(f) = table.at_cell(cell) else { continue };
                points.push(Point { wi, wo, target: (f * wi.z).map(f64::cbrt) });
            }
        }
    }
    points
}

/// A fitted number: the parameters that it sets, and its range in the coordinate of the fit.
struct Free {
    names: Vec<String>,
    /// The channel of a colour; all for a number.
    channel: Option<usize>,
    range: [f64; 2],
    is_logarithmic: bool,
}

impl Free {
    fn value(&self, x: f64) -> f64 {
        if self.is_logarithmic { x.exp() } else { x }
    }
}

/// The problem of least squares.
struct Problem<'a> {
    points: &'a [Point],
    spec: ModelSpec,
    free: Vec<Free>,
    /// Whether the three channels are fitted by their mean.
    is_grey: bool,
    limits: Vec<MPPar>,
}

impl<'a> Problem<'a> {
    fn new(points: &'a [Point], spec: &ModelSpec, entry: &Fittable, is_grey: bool) -> Self {
        let free = free(entry, spec.model, is_grey);
        let limits = free.iter().map(|free| MPPar {
            limited_low: true,
            limited_up: true,
            limit_low: free.range[0],
            limit_up: free.range[1],
            // The cube root of values near 0 is steep: a step of the machine's epsilon would measure its rounding.
            step: 1e-6 * (free.range[1] - free.range[0]),
            ..MPPar::new()
        });
        let limits = limits.collect();
        Self { points, spec: spec.clone(), free, is_grey, limits }
    }

    /// Minimises from `x`, which receives the solution. Returns the sum of squares and the iterations.
    fn solve(&mut self, x: &mut [f64]) -> Option<(f64, usize)> {
        let status = self.mpfit(x).ok()?;
        status.best_norm.is_finite().then_some((status.best_norm, status.n_iter))
    }

    fn set(&mut self, x: &[f64]) {
        for (free, x) in self.free.iter().zip(x) {
            let value = free.value(*x);
            for name in &free.names {
                let mut all = self.spec.values.color(name);
                match free.channel {
                    Some(channel) => all[channel] = value,
                    None => all = DVec3::splat(value),
                }
                self.spec.values.set_value(name, all);
            }
        }
    }
}

impl MPFitter for Problem<'_> {
    fn eval(&mut self, x: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        self.set(x);
        let bsdf = self.spec.build();
        let channels = if self.is_grey { 1 } else { 3 };
        let weight = 1.0 / ((self.points.len() * channels) as f64).sqrt();
        for (point, deviates) in self.points.iter().zip(deviates.chunks_exact_mut(channels)) {
            let model = (bsdf.evaluate(point.wi, point.wo) * point.wi.z).map(f64::cbrt);
            if self.is_grey {
                deviates[0] = weight * (mean(model) - mean(point.target));
            } else {
                for channel in 0..3 {
                    deviates[channel] = weight * (model[channel] - point.target[channel]);
                }
            }
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.points.len() * if self.is_grey { 1 } else { 3 }
    }

    fn config(&self) -> &MPConfig {
        static CONFIG: MPConfig = MPConfig { ftol: 1e-9, xtol: 1e-9, max_iter: 60, ..MPConfig::new() };
        &CONFIG
    }

    fn parameters(&self) -> &[MPPar] {
        &self.limits
    }
}

/// Fits a model to a table.
///
/// # Errors
///
/// A model whose parameters a table does not determine, or a table with too few values.
pub fn fit(table: &MerlTable, start: &ModelSpec) -> Result<BsdfFit, FitError> {
    let name = start.model.name;
    let entry = FITTABLE.iter().find(|entry| entry.model == name).ok_or(FitError::NotFittable { model: name })?;
    let coarse = points(table, [4, 6, 22]);
    let fine = points(table, [3, 4, 14]);
    if coarse.len() < 50 {
        return Err(FitError::TooFewValues { cells: coarse.len() });
    }
    let mut iterations = 0;
    let mut best: Option<(f64, Vec<f64>)> = None;
    let starts = starting_points(entry, start.model, &coarse);
    for x in &starts {
        let mut x = x.clone();
        let Some((norm, steps)) = Problem::new(&coarse, start, entry, true).solve(&mut x) else { continue };
        iterations += steps;
        if best.as_ref().is_none_or(|(least, _)| norm < *least) {
            best = Some((norm, x));
        }
    }
    let (_, grey) = best.ok_or(FitError::Failed { model: name })?;
    // Colours first, each channel from the grey value; then the numbers.
    let mut x: Vec<f64> = grey[..entry.colors.len()].iter().flat_map(|value| [*value; 3]).collect();
    x.extend(&grey[entry.colors.len()..]);
    let mut problem = Problem::new(&fine, start, entry, false);
    let (norm, steps) = problem.solve(&mut x).ok_or(FitError::Failed { model: name })?;
    problem.set(&x);
    let at_limit = problem.free.iter().zip(&x).filter(|(free, x)| is_at_limit(free, **x)).map(|(free, _)| {
        let channel = free.channel.and_then(|channel| ["red", "green", "blue"].get(channel));
        channel.map_or_else(|| free.names[0].clone(), |channel| format!("{} ({channel})", free.names[0]))
    });
    let at_limit = at_limit.collect();
    let signal: f64 = fine.iter().map(|point| point.target.length_squared() / 3.0).sum();
    Ok(BsdfFit {
        spec: problem.spec,
        rms: norm.sqrt(),
        signal_rms: (signal / fine.len() as f64).sqrt(),
        iterations: iterations + steps,
        starts: starts.len(),
        at_limit,
    })
}

/// Whether a number ended at a limit. A colour of 0 is no limit of the model, but a surface without that part.
fn is_at_limit(free: &Free, x: f64) -> bool {
    let [min, max] = free.range;
    let near = 1e-6 * (max - min);
    x >= max - near || (free.channel.is_none() && x <= min + near)
}

/// The fitted numbers: colours, as one or as three channels, then the others.
fn free(entry: &Fittable, model: &BsdfModel, is_grey: bool) -> Vec<Free> {
    let channels: &[Option<usize>] = if is_grey { &[None] } else { &[Some(0), Some(1), Some(2)] };
    let colors = entry.colors.iter().flat_map(|name| {
        let names = vec![(*name).to_owned()];
        channels.iter().map(move |channel| Free {
            names: names.clone(),
            channel: *channel,
            range: [0.0, 1.0],
            is_logarithmic: false,
        })
    });
    let numbers = entry.numbers.iter().map(|group| {
        let parameter = model.parameters.iter().find(|parameter| parameter.name == group[0]);
        let range = parameter.map_or([0.0, 1.0], |parameter| match parameter.kind {
            ParameterKind::Number { min, max, .. } => [min, max],
            _ => [0.0, 1.0],
        });
        // A matrix element towards the normal keeps its sign; widths and exponents vary by factors.
        let is_logarithmic = range[0] > 0.0 && range[1] / range[0] >= 50.0;
        let range = if is_logarithmic { range.map(f64::ln) } else { range };
        Free { names: group.iter().map(|name| (*name).to_owned()).collect(), channel: None, range, is_logarithmic }
    });
    colors.chain(numbers).collect()
}

/// The starting points of the grey fit: the diffuse part from the darkest values, and each number at several places of its
/// range.
fn starting_points(entry: &Fittable, model: &BsdfModel, points: &[Point]) -> Vec<Vec<f64>> {
    let mut dark: Vec<f64> =
        points.iter().map(|point| mean(point.target * point.target * point.target) / point.wi.z * PI).collect();
    dark.sort_by(f64::total_cmp);
    let diffuse = dark[dark.len() / 4].clamp(0.0, 0.95);
    let free = free(entry, model, true);
    let colors: Vec<f64> = (0..entry.colors.len()).map(|index| if index == 0 { diffuse } else { 0.3 }).collect();
    let numbers = &free[entry.colors.len()..];
    let at = |number: &Free, share: f64| number.range[0] + share * (number.range[1] - number.range[0]);
    // Several lobes: each start gives their exponents, every second number, different places.
    const SHARES: [f64; 3] = [0.2, 0.5, 0.8];
    if numbers.len() > 3 {
        let start = |turn: usize| {
            let numbers = numbers.iter().enumerate().map(|(index, number)| at(number, SHARES[(index + turn) % 3]));
            colors.iter().copied().chain(numbers).collect()
        };
        return (0..3).map(start).collect();
    }
    let shares: &[f64] = if numbers.len() > 2 { &[0.25, 0.75] } else { &SHARES };
    let mut starts = vec![colors];
    for number in numbers {
        let extended =
            starts.iter().flat_map(|start| shares.iter().map(|share| [&start[..], &[at(number, *share)]].concat()));
        starts = extended.collect();
    }
    starts
}
