//! The models that can be fitted, and which of their parameters.

use super::problem::Free;
use crate::model_spec::ModelSpec;
use crate::models::{BsdfModel, model};
use gonio_light::DVec3;

/// Where the grey fits of a number begin, as shares of its range.
const SHARES: [f64; 3] = [0.2, 0.5, 0.8];

/// A fitted number, or several that are equal for an isotropic surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct FittedNumber {
    pub names: &'static [&'static str],
    /// The values where grey fits begin; `None` for shares of the range.
    starts: Option<[f64; 3]>,
}

impl FittedNumber {
    /// Where the grey fits begin, in the coordinate of the fit.
    pub fn places(&self, free: &Free) -> [f64; 3] {
        match self.starts {
            Some(values) => values.map(|value| free.coordinate(value)),
            None => SHARES.map(|share| free.range[0] + share * (free.range[1] - free.range[0])),
        }
    }
}

const fn number(names: &'static [&'static str]) -> FittedNumber {
    FittedNumber { names, starts: None }
}

/// The matrix along the normal of one of several lobes.
const fn lean(names: &'static [&'static str]) -> FittedNumber {
    FittedNumber { names, starts: Some([-1.0, -0.8, -1.1]) }
}

/// What a fit varies; other parameters keep their values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fittable {
    pub model: &'static str,
    pub colors: &'static [&'static str],
    pub numbers: &'static [FittedNumber],
    /// A number that only an anisotropic surface has; 0 for an isotropic one.
    pub anisotropy: Option<FittedNumber>,
    /// The diagonal of a matrix whose factor has no effect: the largest element becomes 1.
    pub matrix: &'static [&'static str],
    /// Lobes that may change places, each with its colour and its numbers, the one to order by first.
    pub lobes: &'static [&'static [&'static str]],
}

const fn entry(model: &'static str, colors: &'static [&'static str], numbers: &'static [FittedNumber]) -> Fittable {
    Fittable { model, colors, numbers, anisotropy: None, matrix: &[], lobes: &[] }
}

const FITTABLE: &[Fittable] = &[
    entry("lambert", &["a"], &[]),
    entry("phong", &["a", "b"], &[number(&["c"])]),
    entry("phong-normalised", &["a", "b"], &[number(&["c"])]),
    entry("blinn", &["a", "b"], &[number(&["c"])]),
    entry("blinn-normalised", &["a", "b"], &[number(&["c"])]),
    Fittable {
        matrix: &["ax", "ay", "az"],
        ..entry("lafortune-normalised", &["a", "b"], &[number(&["k"]), number(&["ax", "ay"]), number(&["az"])])
    },
    Fittable {
        lobes: &[&["k1", "z1", "b1"], &["k2", "z2", "b2"]],
        ..entry("lafortune-2", &["a", "b1", "b2"], &[number(&["k1"]), lean(&["z1"]), number(&["k2"]), lean(&["z2"])])
    },
    Fittable {
        lobes: &[&["k1", "z1", "b1"], &["k2", "z2", "b2"], &["k3", "z3", "b3"]],
        ..entry(
            "lafortune-3",
            &["a", "b1", "b2", "b3"],
            &[number(&["k1"]), lean(&["z1"]), number(&["k2"]), lean(&["z2"]), number(&["k3"]), lean(&["z3"])],
        )
    },
    entry("ward", &["a", "b"], &[number(&["c"])]),
    entry("ward-normalised", &["a", "b"], &[number(&["c"])]),
    entry("ward-anisotropic", &["a", "b"], &[number(&["cx", "cy"])]),
    entry("cook-torrance", &["a", "f0"], &[number(&["m"])]),
    entry("beckmann", &["a", "f0"], &[number(&["alpha"])]),
    entry("ggx", &["a", "f0"], &[number(&["alpha"])]),
    entry("oren-nayar", &["a"], &[number(&["sigma"])]),
    entry("ashikhmin-shirley", &["rd", "rs"], &[number(&["nu", "nv"])]),
    Fittable {
        anisotropy: Some(number(&["anisotropic"])),
        ..entry("disney", &["baseColor"], &[number(&["metallic"]), number(&["specular"]), number(&["roughness"])])
    },
];

/// The entry of a model.
pub(super) fn fittable(name: &str) -> Option<&'static Fittable> {
    FITTABLE.iter().find(|entry| entry.model == name)
}

/// The models that can be fitted.
pub fn fittable_models() -> impl Iterator<Item = &'static BsdfModel> {
    FITTABLE.iter().filter_map(|entry| model(entry.model))
}

impl Fittable {
    /// The numbers of a fit, each with the parameters that have its value.
    pub fn groups(&self, is_isotropic: bool) -> Vec<FittedNumber> {
        if is_isotropic {
            return self.numbers.to_vec();
        }
        let split = self.numbers.iter().flat_map(|number| {
            number.names.iter().map(|name| FittedNumber { names: std::slice::from_ref(name), ..*number })
        });
        split.chain(self.anisotropy).collect()
    }

    /// The same function in the form that fits report: the largest element of a matrix is 1, and the exponents of several
    /// lobes ascend.
    pub fn in_order(&self, mut spec: ModelSpec) -> ModelSpec {
        let elements: Vec<f64> = self.matrix.iter().map(|name| spec.values.number(name)).collect();
        let largest = elements.iter().fold(0.0_f64, |largest, element| largest.max(element.abs()));
        if largest > 0.0 {
            for (name, element) in self.matrix.iter().zip(elements) {
                spec.values.set_value(name, DVec3::splat(element / largest));
            }
        }
        let mut lobes: Vec<Vec<DVec3>> =
            self.lobes.iter().map(|lobe| lobe.iter().map(|name| spec.values.color(name)).collect()).collect();
        lobes.sort_by(|a, b| a[0].x.total_cmp(&b[0].x));
        for (names, values) in self.lobes.iter().zip(lobes) {
            for (name, value) in names.iter().zip(values) {
                spec.values.set_value(name, value);
            }
        }
        spec
    }
}
