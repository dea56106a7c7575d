//! The problem of least squares: the numbers that vary, their starting points, and the residuals.

use super::fittable::{Fittable, FittedNumber};
use super::matrix_lobe::{MatrixLobe, best_lobes};
use super::target::Point;
use crate::bsdf::mean;
use crate::model_spec::ModelSpec;
use crate::models::BsdfModel;
use crate::parameter::ParameterKind;
use gonio_light::DVec3;
use rmpfit::{MPConfig, MPFitter, MPPar, MPResult};
use std::f64::consts::PI;

/// A number that varies: the parameters that it sets, and its range in the coordinate of the fit.
pub(super) struct Free {
    pub names: Vec<&'static str>,
    /// The channel of a colour; all for a number.
    pub channel: Option<usize>,
    pub range: [f64; 2],
    is_logarithmic: bool,
}

impl Free {
    fn value(&self, x: f64) -> f64 {
        if self.is_logarithmic { x.exp() } else { x }
    }

    /// The inverse of [`Free::value`], held in the range.
    pub fn coordinate(&self, value: f64) -> f64 {
        (if self.is_logarithmic { value.ln() } else { value }).clamp(self.range[0], self.range[1])
    }
}

/// The problem of least squares.
pub(super) struct Problem<'a> {
    points: &'a [Point],
    pub spec: ModelSpec,
    pub free: Vec<Free>,
    /// Whether the three channels are fitted by their mean.
    is_grey: bool,
    limits: Vec<MPPar>,
}

impl<'a> Problem<'a> {
    pub fn new(
        points: &'a [Point],
        spec: &ModelSpec,
        entry: &Fittable,
        numbers: &[FittedNumber],
        is_grey: bool,
    ) -> Self {
        let free = free(entry, numbers, spec.model, is_grey);
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
    pub fn solve(&mut self, x: &mut [f64]) -> Option<(f64, usize)> {
        let status = self.mpfit(x).ok()?;
        status.best_norm.is_finite().then_some((status.best_norm, status.n_iter))
    }

    /// Sets the model to `x`.
    pub fn set(&mut self, x: &[f64]) {
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

/// What varies: colours, as one or as three channels, then the numbers.
fn free(entry: &Fittable, numbers: &[FittedNumber], model: &BsdfModel, is_grey: bool) -> Vec<Free> {
    let channels: &[Option<usize>] = if is_grey { &[None] } else { &[Some(0), Some(1), Some(2)] };
    let colors = entry.colors.iter().flat_map(|name| {
        channels.iter().map(|channel| Free {
            names: vec![*name],
            channel: *channel,
            range: [0.0, 1.0],
            is_logarithmic: false,
        })
    });
    let numbers = numbers.iter().map(|number| {
        let parameter = model.parameters.iter().find(|parameter| number.names.contains(&parameter.name.as_ref()));
        let range = parameter.map_or([0.0, 1.0], |parameter| match parameter.kind {
            ParameterKind::Number { min, max, .. } => [min, max],
            _ => [0.0, 1.0],
        });
        // A matrix element keeps its sign; widths and exponents vary by factors.
        let is_logarithmic = range[0] > 0.0 && range[1] / range[0] >= 50.0;
        let range = if is_logarithmic { range.map(f64::ln) } else { range };
        Free { names: number.names.to_vec(), channel: None, range, is_logarithmic }
    });
    colors.chain(numbers).collect()
}

/// The starting points of the grey fit: the diffuse part from the darkest values, and each number at several places of its
/// range.
pub(super) fn starting_points(
    entry: &Fittable,
    numbers: &[FittedNumber],
    model: &BsdfModel,
    points: &[Point],
) -> Vec<Vec<f64>> {
    let mut dark: Vec<f64> =
        points.iter().map(|point| mean(point.target * point.target * point.target) / point.wi.z * PI).collect();
    dark.sort_by(f64::total_cmp);
    let darkest = |share: usize| dark[dark.len() * share / 100].clamp(0.0, 0.95);
    let free = free(entry, numbers, model, true);
    if !entry.matrix.is_empty() {
        return matrix_starts(entry, numbers, &free, points, &[0, 3, 10, 25].map(darkest));
    }
    let diffuse = darkest(25);
    let colors: Vec<f64> = (0..entry.colors.len()).map(|index| if index == 0 { diffuse } else { 0.3 }).collect();
    let free = &free[entry.colors.len()..];
    let places: Vec<[f64; 3]> = free.iter().zip(numbers).map(|(free, number)| number.places(free)).collect();
    let numbers: Vec<Vec<f64>> = match places.len() {
        // Many numbers, as of several lobes: each start gives them other places in turn, in two orders.
        4.. => (0..6)
            .map(|turn| {
                let at = |(index, place): (usize, &[f64; 3])| place[(index * (1 + turn / 3) + turn) % 3];
                places.iter().enumerate().map(at).collect()
            })
            .collect(),
        count => {
            let mut starts = vec![Vec::new()];
            for place in &places {
                let several: &[f64] = if count > 2 { &[place[0], place[2]] } else { place };
                let with = |start: &Vec<f64>| several.iter().map(|x| [&start[..], &[*x]].concat()).collect::<Vec<_>>();
                starts = starts.iter().flat_map(with).collect();
            }
            starts
        }
    };
    numbers.into_iter().map(|numbers| [&colors[..], &numbers].concat()).collect()
}

/// The starting points of a lobe with a matrix.
fn matrix_starts(
    entry: &Fittable,
    numbers: &[FittedNumber],
    free: &[Free],
    points: &[Point],
    diffuse: &[f64],
) -> Vec<Vec<f64>> {
    let row = |free: &Free| entry.matrix.iter().position(|name| free.names.contains(name));
    let is_isotropic =
        numbers.iter().filter(|number| number.names.iter().any(|n| entry.matrix.contains(n))).count() < 3;
    let start = |lobe: MatrixLobe| {
        let value = |(index, free): (usize, &Free)| match (index, row(free)) {
            (0, _) => lobe.a,
            (1, _) => lobe.b,
            (_, Some(row)) => lobe.matrix[row],
            (_, None) => lobe.k,
        };
        free.iter().enumerate().map(|(index, free)| free.coordinate(value((index, free)))).collect()
    };
    best_lobes(points, diffuse, is_isotropic).into_iter().map(start).collect()
}
