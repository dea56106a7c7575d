//! Parameters: names, ranges, values.

use gonio_light::DVec3;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// The range and the default of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ParameterKind {
    /// A number in `[min, max]`.
    Number {
        /// The smallest value.
        min: f64,
        /// The largest value.
        max: f64,
        /// The value without another one.
        default: f64,
    },
    /// Linear RGB, each channel in `[0, 1]`.
    Color {
        /// The value without another one.
        default: [f64; 3],
    },
    /// On (1) or off (0).
    Switch {
        /// The value without another one.
        default: bool,
    },
}

/// A parameter of a BSDF, or of anything else that sliders and options set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// The name, as in the notation of models and in GLSL.
    pub name: Cow<'static, str>,
    /// The unit; empty if it has none.
    pub unit: Cow<'static, str>,
    /// The meaning, in a few words; empty for parameters of files, which state none.
    pub description: Cow<'static, str>,
    /// The range and the default.
    pub kind: ParameterKind,
}

impl Parameter {
    /// A number without a unit.
    pub const fn number(name: &'static str, [min, max]: [f64; 2], default: f64, description: &'static str) -> Self {
        Self::of(name, description, ParameterKind::Number { min, max, default })
    }

    /// A colour.
    pub const fn color(name: &'static str, default: f64, description: &'static str) -> Self {
        Self::of(name, description, ParameterKind::Color { default: [default; 3] })
    }

    /// A switch.
    pub const fn switch(name: &'static str, default: bool, description: &'static str) -> Self {
        Self::of(name, description, ParameterKind::Switch { default })
    }

    const fn of(name: &'static str, description: &'static str, kind: ParameterKind) -> Self {
        Self { name: Cow::Borrowed(name), unit: Cow::Borrowed(""), description: Cow::Borrowed(description), kind }
    }

    /// The same with a unit.
    pub const fn in_unit(mut self, unit: &'static str) -> Self {
        // Nothing is lost: it is borrowed. Constants cannot drop.
        std::mem::forget(std::mem::replace(&mut self.unit, Cow::Borrowed(unit)));
        self
    }

    /// The default, in all three channels for anything but a colour.
    pub fn default_value(&self) -> DVec3 {
        match self.kind {
            ParameterKind::Number { default, .. } => DVec3::splat(default),
            ParameterKind::Color { default } => DVec3::from_array(default),
            ParameterKind::Switch { default } => DVec3::splat(f64::from(u8::from(default))),
        }
    }

    /// The smallest and the largest value of a channel.
    pub fn range(&self) -> [f64; 2] {
        match self.kind {
            ParameterKind::Number { min, max, .. } => [min, max],
            ParameterKind::Color { .. } | ParameterKind::Switch { .. } => [0.0, 1.0],
        }
    }

    /// Reads a value: a number, `on` or `off` for a switch, `red/green/blue` or one number for a colour.
    ///
    /// # Errors
    ///
    /// Text that is no such value, or a value beyond the range.
    pub fn parse(&self, text: &str) -> Result<DVec3, ParameterError> {
        let invalid = || ParameterError::Invalid {
            name: self.name.to_string(),
            value: text.to_owned(),
            expected: self.expected(),
        };
        let text = text.trim();
        let parsed: Vec<f64> = match (&self.kind, text) {
            (ParameterKind::Switch { .. }, "on" | "true") => vec![1.0],
            (ParameterKind::Switch { .. }, "off" | "false") => vec![0.0],
            _ => text.split('/').map(|part| part.trim().parse().map_err(|_| invalid())).collect::<Result<_, _>>()?,
        };
        let value = match (&self.kind, parsed.as_slice()) {
            (_, [one]) => DVec3::splat(*one),
            (ParameterKind::Color { .. }, [red, green, blue]) => DVec3::new(*red, *green, *blue),
            _ => return Err(invalid()),
        };
        let [min, max] = self.range();
        let fits = value.to_array().iter().all(|channel| (min..=max).contains(channel));
        let is_switch = matches!(self.kind, ParameterKind::Switch { .. });
        if fits && (!is_switch || value.x == 0.0 || value.x == 1.0) { Ok(value) } else { Err(invalid()) }
    }

    /// The values that the parameter accepts, with their unit.
    pub fn expected(&self) -> String {
        match self.kind {
            ParameterKind::Number { min, max, .. } if self.unit.is_empty() => format!("a number from {min} to {max}"),
            ParameterKind::Number { min, max, .. } => format!("a number from {min} to {max} {}", self.unit),
            ParameterKind::Color { .. } => "a grey from 0 to 1, or red/green/blue".to_owned(),
            ParameterKind::Switch { .. } => "on or off".to_owned(),
        }
    }

    /// A value as [`Parameter::parse`] reads it.
    pub fn format(&self, value: DVec3) -> String {
        match self.kind {
            ParameterKind::Switch { .. } => if value.x == 0.0 { "off" } else { "on" }.to_owned(),
            ParameterKind::Color { .. } if value != DVec3::splat(value.x) => {
                format!("{}/{}/{}", value.x, value.y, value.z)
            }
            _ => value.x.to_string(),
        }
    }
}

/// A parameter that could not be set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterError {
    /// No parameter has this name.
    Unknown {
        /// The name.
        name: String,
        /// All names.
        known: Vec<String>,
    },
    /// The value cannot be read, or is beyond the range.
    Invalid {
        /// The parameter.
        name: String,
        /// The value.
        value: String,
        /// The values that the parameter accepts.
        expected: String,
    },
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name, known } if known.is_empty() => {
                write!(f, "unknown parameter `{name}`: there are no parameters")
            }
            Self::Unknown { name, known } => {
                write!(f, "unknown parameter `{name}`: expected one of {}", known.join(", "))
            }
            Self::Invalid { name, value, expected } => {
                write!(f, "invalid value `{value}` of parameter `{name}`: expected {expected}")
            }
        }
    }
}

impl std::error::Error for ParameterError {}

/// Parameters with a value each.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterValues {
    parameters: Cow<'static, [Parameter]>,
    values: Vec<DVec3>,
}

impl ParameterValues {
    /// The defaults.
    pub fn defaults(parameters: impl Into<Cow<'static, [Parameter]>>) -> Self {
        let parameters = parameters.into();
        let values = parameters.iter().map(Parameter::default_value).collect();
        Self { parameters, values }
    }

    /// The parameters.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Each parameter with its value.
    pub fn iter(&self) -> impl Iterator<Item = (&Parameter, DVec3)> {
        self.parameters.iter().zip(self.values.iter().copied())
    }

    fn position(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|parameter| parameter.name == name)
    }

    /// The value of a colour; black if there is no such parameter.
    pub fn color(&self, name: &str) -> DVec3 {
        self.position(name).map_or(DVec3::ZERO, |at| self.values[at])
    }

    /// The value of a number; 0 if there is no such parameter.
    pub fn number(&self, name: &str) -> f64 {
        self.color(name).x
    }

    /// Whether a switch is on.
    pub fn is_on(&self, name: &str) -> bool {
        self.number(name) != 0.0
    }

    /// Sets a parameter from text.
    ///
    /// # Errors
    ///
    /// As [`Parameter::parse`], or an unknown name.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        let Some(at) = self.position(name) else {
            let known = self.parameters.iter().map(|parameter| parameter.name.to_string()).collect();
            return Err(ParameterError::Unknown { name: name.to_owned(), known });
        };
        self.values[at] = self.parameters[at].parse(text)?;
        Ok(())
    }

    /// Sets a parameter, held in its range; returns whether there is one of this name.
    pub fn set_value(&mut self, name: &str, value: DVec3) -> bool {
        let Some(at) = self.position(name) else { return false };
        let [min, max] = self.parameters[at].range();
        self.values[at] = value.clamp(DVec3::splat(min), DVec3::splat(max));
        true
    }
}
