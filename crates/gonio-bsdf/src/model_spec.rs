//! `name:key=value,...`: the notation of a model with its parameters.

use crate::bsdf::Bsdf;
use crate::models::{BsdfModel, MODELS, model};
use crate::parameter::{ParameterError, ParameterValues};
use std::fmt;

/// A model with a value for each parameter.
#[derive(Clone, Debug)]
pub struct ModelSpec {
    /// The model.
    pub model: &'static BsdfModel,
    /// The values.
    pub values: ParameterValues,
}

impl ModelSpec {
    /// A model with its defaults.
    pub fn new(model: &'static BsdfModel) -> Self {
        Self { model, values: ParameterValues::defaults(model.parameters) }
    }

    /// Reads `name` or `name:key=value,...`.
    ///
    /// # Errors
    ///
    /// An unknown model or parameter, a value beyond its range, or a part without `=`.
    pub fn parse(text: &str) -> Result<Self, ModelSpecError> {
        let (name, settings) = split(text);
        let Some(model) = model(name) else { return Err(ModelSpecError::UnknownModel { name: name.to_owned() }) };
        let mut spec = Self::new(model);
        set_all(&mut spec.values, settings)?;
        Ok(spec)
    }

    /// The BSDF.
    pub fn build(&self) -> Box<dyn Bsdf> {
        (self.model.build)(&self.values)
    }

    /// The notation, with every parameter that differs from its default.
    pub fn text(&self) -> String {
        let changed: Vec<String> = self
            .values
            .iter()
            .filter(|(parameter, value)| *value != parameter.default_value())
            .map(|(parameter, value)| format!("{}={}", parameter.name, parameter.format(value)))
            .collect();
        if changed.is_empty() {
            self.model.name.to_owned()
        } else {
            format!("{}:{}", self.model.name, changed.join(","))
        }
    }
}

/// Splits the notation into the name, or the path of a file, and the settings. The colon of a drive, as in `C:\a.brdf`,
/// belongs to the path.
pub fn split(text: &str) -> (&str, &str) {
    match text.rsplit_once(':') {
        Some((name, settings)) if settings.contains('=') && !settings.contains(['\\']) => (name, settings),
        Some((name, "")) => (name, ""),
        _ => (text, ""),
    }
}

/// Sets parameters from `key=value,...`.
///
/// # Errors
///
/// As [`ModelSpec::parse`].
pub fn set_all(values: &mut ParameterValues, settings: &str) -> Result<(), ModelSpecError> {
    for setting in settings.split(',').map(str::trim).filter(|setting| !setting.is_empty()) {
        let Some((key, value)) = setting.split_once('=') else {
            return Err(ModelSpecError::NoValue { setting: setting.to_owned() });
        };
        values.set(key.trim(), value).map_err(ModelSpecError::Parameter)?;
    }
    Ok(())
}

/// An error in the notation of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ModelSpecError {
    /// No model has this name.
    UnknownModel {
        /// The name.
        name: String,
    },
    /// A setting without `=`.
    NoValue {
        /// The setting.
        setting: String,
    },
    /// A parameter that could not be set.
    Parameter(ParameterError),
}

impl fmt::Display for ModelSpecError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownModel { name } => {
                let known: Vec<&str> = MODELS.iter().map(|model| model.name).collect();
                write!(f, "unknown model `{name}`: expected one of {}, or a .binary or .brdf file", known.join(", "))
            }
            Self::NoValue { setting } => {
                write!(f, "invalid setting `{setting}`: expected key=value, for example c=0.2")
            }
            Self::Parameter(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ModelSpecError {}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_light::DVec3;

    #[test]
    fn the_notation_round_trips() {
        let spec = ModelSpec::parse("ward:b=0.8/0.6/0.4,c=0.2").unwrap();
        assert_eq!(spec.values.color("b"), DVec3::new(0.8, 0.6, 0.4));
        assert_eq!(spec.values.number("c"), 0.2);
        assert_eq!(spec.text(), "ward:b=0.8/0.6/0.4,c=0.2");
        assert_eq!(ModelSpec::parse("ward").unwrap().text(), "ward");
        assert_eq!(ModelSpec::parse("ggx:correlated=off").unwrap().text(), "ggx:correlated=off");
    }

    #[test]
    fn errors_name_the_value_and_the_expected_ones() {
        let message = |text: &str| ModelSpec::parse(text).unwrap_err().to_string();
        assert!(message("wart").starts_with("unknown model `wart`: expected one of lambert, "));
        assert_eq!(message("ward:d=1"), "unknown parameter `d`: expected one of a, b, c");
        assert_eq!(message("ward:c=2"), "invalid value `2` of parameter `c`: expected a number from 0.01 to 1");
        assert_eq!(message("ward:c=nan"), "invalid value `nan` of parameter `c`: expected a number from 0.01 to 1");
        assert_eq!(message("ward:c=0.1,b"), "invalid setting `b`: expected key=value, for example c=0.2");
        assert_eq!(message("ggx:correlated=0.5"), "invalid value `0.5` of parameter `correlated`: expected on or off");
        assert_eq!(
            message("ward:b=1/2"),
            "invalid value `1/2` of parameter `b`: expected a grey from 0 to 1, or red/green/blue"
        );
    }

    #[test]
    fn the_colon_of_a_drive_belongs_to_the_path() {
        assert_eq!(split(r"C:\brdfs\ward.brdf"), (r"C:\brdfs\ward.brdf", ""));
        assert_eq!(split(r"C:\ward.brdf:c=1"), (r"C:\ward.brdf", "c=1"));
        assert_eq!(split(r"C:\a=b\ward.brdf"), (r"C:\a=b\ward.brdf", ""));
        assert_eq!(split("ward:"), ("ward", ""));
    }
}
