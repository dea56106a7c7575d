//! BRDFs: their values, their properties, fits.

use crate::array::{NativeArray, Numbers};
use crate::error::{Failure, bug, without_lock};
use crate::json;
use glam::DVec3;
use gonio_bsdf::models::model;
use gonio_bsdf::{
    BsdfFit, BsdfSource, FitTarget, MODELS, ModelSpec, ModelSpecError, NamedBsdf, NamedBsdfError, check, fit,
    model_spec,
};
use gonio_scene::files::Disk;
use gonio_scene::read_brdf_file;
use pyo3::buffer::PyBuffer;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::path::Path;

/// A model, a measured table or a function of a file.
#[pyclass(frozen, module = "gonio._native")]
pub struct NativeBrdf(NamedBsdf);

#[pymethods]
impl NativeBrdf {
    /// `NAME:KEY=VALUE,...` of a model or a file.
    #[new]
    fn new(py: Python<'_>, text: &str) -> PyResult<Self> {
        without_lock(py, || open(text).map(NativeBrdf))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings.clone()
    }

    /// The parameters with their values, as JSON.
    fn parameters(&self) -> PyResult<String> {
        let all: Vec<Value> = self
            .0
            .values
            .iter()
            .map(|(parameter, value)| {
                let [min, max] = parameter.range();
                let value = match parameter.kind {
                    gonio_bsdf::ParameterKind::Color { .. } => json!(value.to_array()),
                    gonio_bsdf::ParameterKind::Switch { .. } => json!(value.x != 0.0),
                    gonio_bsdf::ParameterKind::Number { .. } => json!(value.x),
                };
                json!({
                    "name": parameter.name, "value": value, "min": min, "max": max, "unit": parameter.unit,
                    "description": parameter.description,
                })
            })
            .collect();
        json(&all)
    }

    /// Values in 1/sr for pairs of directions, each an array of (n, 3) float64.
    fn evaluate(&self, py: Python<'_>, wi: PyBuffer<f64>, wo: PyBuffer<f64>) -> PyResult<NativeArray> {
        let (wi, wo) = (wi.to_vec(py)?, wo.to_vec(py)?);
        let values = without_lock(py, || {
            let pairs = pairs(&wi, &wo)?;
            let values = self.0.bsdf.evaluate_all(&pairs);
            Ok(values.iter().flat_map(DVec3::to_array).collect::<Vec<f64>>())
        })?;
        array(values, [1, wi.len() / 3, 3])
    }

    /// The density of the samples in 1/sr, for the same pairs.
    fn density(&self, py: Python<'_>, wi: PyBuffer<f64>, wo: PyBuffer<f64>) -> PyResult<NativeArray> {
        let (wi, wo) = (wi.to_vec(py)?, wo.to_vec(py)?);
        let values = without_lock(py, || {
            Ok(pairs(&wi, &wo)?.iter().map(|(wi, wo)| self.0.bsdf.density(*wi, *wo)).collect::<Vec<f64>>())
        })?;
        array(values, [1, 1, wi.len() / 3])
    }

    /// Reciprocity, energy and so on, as JSON.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let properties = without_lock(py, || Ok(check(self.0.bsdf.as_ref())))?;
        let direction = |w: Option<DVec3>| w.map(|w| w.to_array());
        let all: Vec<Value> = properties
            .iter()
            .map(|p| {
                json!({
                    "property": p.property, "passed": p.passed, "value": p.value, "light": direction(p.wi),
                    "viewer": direction(p.wo), "explanation": p.explanation,
                })
            })
            .collect();
        json(&all)
    }

    /// Fits models (all that suit, if none is named), best first, as JSON.
    fn fit(&self, py: Python<'_>, models: Vec<String>) -> PyResult<String> {
        let fits = without_lock(py, || self.fits(&models))?;
        let all: Vec<Value> = fits
            .iter()
            .map(|fit| {
                json!({
                    "model": fit.spec.model.name,
                    "spec": fit.spec.text(),
                    "rms": fit.rms,
                    "relative": fit.rms / fit.signal_rms.max(f64::MIN_POSITIVE),
                    "at_limit": fit.at_limit,
                })
            })
            .collect();
        json(&all)
    }
}

impl NativeBrdf {
    fn fits(&self, models: &[String]) -> Result<Vec<BsdfFit>, Failure> {
        let target = match &self.0.source {
            BsdfSource::Table(table) => FitTarget::of_table(table),
            BsdfSource::Model(_) | BsdfSource::Glsl(_) => FitTarget::of_function(self.0.bsdf.as_ref()),
        };
        let of_target = |error: gonio_bsdf::FitError| Failure(format!("{}: {error}", self.0.name));
        let target = target.map_err(of_target)?;
        let spec = |name: &String| match model(name.trim()) {
            Some(model) => Ok(ModelSpec::new(model)),
            None => Err(Failure::new(ModelSpecError::UnknownModel { name: name.clone() })),
        };
        let mut specs = models.iter().map(spec).collect::<Result<Vec<_>, _>>()?;
        if specs.is_empty() {
            specs =
                gonio_bsdf::fit::default_models(&target).iter().filter_map(|n| model(n)).map(ModelSpec::new).collect();
        }
        let mut fits = specs.iter().map(|spec| fit(&target, spec)).collect::<Result<Vec<_>, _>>().map_err(of_target)?;
        fits.sort_by(|a, b| a.rms.total_cmp(&b.rms));
        Ok(fits)
    }
}

fn array(values: Vec<f64>, shape: [usize; 3]) -> PyResult<NativeArray> {
    NativeArray::new(Numbers::Values(values), shape).ok_or_else(|| bug(&"an array has another shape than its values"))
}

/// Pairs of unit vectors.
fn pairs(wi: &[f64], wo: &[f64]) -> Result<Vec<(DVec3, DVec3)>, Failure> {
    let (wi, wo) = (wi.as_chunks::<3>().0, wo.as_chunks::<3>().0);
    if wi.len() != wo.len() {
        return Err(Failure(format!("{} directions to the light, and {} to the viewer", wi.len(), wo.len())));
    }
    let unit = |index: usize, w: &[f64; 3]| {
        let direction = DVec3::from_array(*w).try_normalize();
        direction.ok_or_else(|| Failure(format!("direction {index}, {w:?}, has no length or is not finite")))
    };
    wi.iter().zip(wo).enumerate().map(|(index, (wi, wo))| Ok((unit(index, wi)?, unit(index, wo)?))).collect()
}

/// A model, or a file.
fn open(text: &str) -> Result<NamedBsdf, Failure> {
    let (name, settings) = model_spec::split(text);
    let names_a_file = name.contains(['.', '/', '\\']) || Path::new(name).exists();
    if model(name).is_some() || !names_a_file {
        let spec = ModelSpec::parse(text).map_err(Failure::new)?;
        return Ok(NamedBsdf::of_model(&spec));
    }
    let bytes =
        read_brdf_file(Path::new(name), &Disk).map_err(|error| Failure(format!("cannot read `{name}`: {error}")))?;
    NamedBsdf::of_file(name, &bytes, settings).map_err(|error| match error {
        NamedBsdfError::Brdf(error) => Failure(format!("{name}:{error}")),
        error => Failure(format!("{name}: {error}")),
    })
}

/// The names of all models, each with one line about it.
#[pyfunction]
pub fn brdf_models() -> Vec<(&'static str, &'static str)> {
    MODELS.iter().map(|model| (model.name, model.title)).collect()
}
