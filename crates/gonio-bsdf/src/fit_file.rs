//! Fits as TOML, which can be read as models.
//!
//! ```toml
//! [[fit]]
//! model = "ggx"
//! rms = 0.0012
//! signal_rms = 0.41
//! [fit.parameters]
//! a = [0.2, 0.1, 0.05]
//! alpha = 0.3
//! ```
//!
//! The fits are ordered by their error; the first one stands for the file.

use crate::fit::BsdfFit;
use crate::model_spec::{ModelSpec, ModelSpecError};
use crate::models::model;
use crate::parameter::{ParameterError, ParameterKind};
use gonio_light::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Fits {
    fit: Vec<Entry>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    model: String,
    rms: Option<f64>,
    signal_rms: Option<f64>,
    parameters: BTreeMap<String, Value>,
}

/// The value of a parameter.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Value {
    Switch(bool),
    Number(f64),
    Color([f64; 3]),
}

/// A file of fits that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FitFileError {
    /// TOML that cannot be parsed, or keys that do not belong there.
    Toml {
        /// One sentence.
        message: String,
        /// Line and column, from 1, if they are known.
        place: Option<(u32, u32)>,
    },
    /// No fit in the file.
    Empty,
    /// A model that does not exist.
    UnknownModel(String),
    /// A parameter that the model does not have, or a value beyond its range.
    Parameter(ParameterError),
}

impl fmt::Display for FitFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Toml { message, place: Some((line, column)) } => write!(f, "{line}:{column}: {message}"),
            Self::Toml { message, place: None } => f.write_str(message),
            Self::Empty => write!(f, "the file has no `[[fit]]`"),
            Self::UnknownModel(name) => ModelSpecError::UnknownModel { name: name.clone() }.fmt(f),
            Self::Parameter(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for FitFileError {}

/// Writes fits, best first.
pub fn write(fits: &[BsdfFit]) -> String {
    let entry = |fit: &BsdfFit| Entry {
        model: fit.spec.model.name.to_owned(),
        rms: Some(fit.rms),
        signal_rms: Some(fit.signal_rms),
        parameters: fit
            .spec
            .values
            .iter()
            .map(|(parameter, value)| {
                let value = match parameter.kind {
                    ParameterKind::Switch { .. } => Value::Switch(value.x != 0.0),
                    ParameterKind::Number { .. } => Value::Number(value.x),
                    ParameterKind::Color { .. } => Value::Color(value.to_array()),
                };
                (parameter.name.to_string(), value)
            })
            .collect(),
    };
    // Numbers, names and booleans always have a form in TOML.
    toml::to_string(&Fits { fit: fits.iter().map(entry).collect() }).unwrap_or_default()
}

/// Reads the models of a file, best first.
///
/// # Errors
///
/// Text that is no such file, an unknown model or parameter, or a value beyond its range.
pub fn read(text: &str) -> Result<Vec<ModelSpec>, FitFileError> {
    let fits: Fits = toml::from_str(text).map_err(|error| {
        let place = error.span().map(|span| place(text, span.start));
        FitFileError::Toml { message: error.message().to_owned(), place }
    })?;
    if fits.fit.is_empty() {
        return Err(FitFileError::Empty);
    }
    fits.fit.iter().map(spec).collect()
}

/// Line and column of a byte.
fn place(text: &str, byte: usize) -> (u32, u32) {
    let before = text.get(..byte).unwrap_or_default();
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    (before.matches('\n').count() as u32 + 1, column as u32)
}

fn spec(entry: &Entry) -> Result<ModelSpec, FitFileError> {
    let model = model(&entry.model).ok_or_else(|| FitFileError::UnknownModel(entry.model.clone()))?;
    let mut spec = ModelSpec::new(model);
    for (name, value) in &entry.parameters {
        let text = match value {
            Value::Switch(is_on) => if *is_on { "on" } else { "off" }.to_owned(),
            Value::Number(number) => number.to_string(),
            Value::Color(color) => {
                let [red, green, blue] = DVec3::from_array(*color).to_array();
                format!("{red}/{green}/{blue}")
            }
        };
        spec.values.set(name, &text).map_err(FitFileError::Parameter)?;
    }
    Ok(spec)
}
