//! The functions that a command line names: models and files, with values of their parameters.

use crate::error::CliError;
use crate::options::LimitOptions;
use crate::output::OutputPath;
use crate::report::Reporter;
use gonio_bsdf::models::model;
use gonio_bsdf::{ModelSpec, NamedBsdf, NamedBsdfError, ParameterKind, ParameterValues, model_spec};
use gonio_scene::read_brdf_file;
use serde_json::{Value, json};
use std::path::Path;

/// Opens a model or a file, and prints warnings about it.
pub fn open(text: &str, reporter: &Reporter) -> Result<NamedBsdf, CliError> {
    let (name, settings) = model_spec::split(text);
    if model(name).is_some() || !names_a_file(name) {
        let spec = ModelSpec::parse(text).map_err(|error| CliError::new(error.to_string()))?;
        return Ok(NamedBsdf::of_model(&spec));
    }
    let bytes = read(name, reporter)?;
    let named = NamedBsdf::of_file(name, &bytes, settings).map_err(|error| file_error(name, &error))?;
    named.warnings.iter().for_each(|warning| reporter.warning(format!("{name}: {warning}")));
    Ok(named)
}

/// Whether a name that is no model's is meant as a file.
fn names_a_file(name: &str) -> bool {
    name == "-" || name.contains(['.', '/', '\\']) || Path::new(name).exists()
}

/// Reads a file, or stdin for `-`.
pub fn read(name: &str, reporter: &Reporter) -> Result<Vec<u8>, CliError> {
    let files = LimitOptions::default().files([name], reporter);
    let bytes = read_brdf_file(Path::new(name), &files);
    let bytes = bytes.map_err(|error| CliError::io(format!("cannot read `{name}`"), &error))?;
    Ok(bytes.into_vec())
}

/// An error of a file, as `FILE:LINE:COLUMN: MESSAGE` where the place is known.
pub fn file_error(name: &str, error: &NamedBsdfError) -> CliError {
    match error {
        NamedBsdfError::Brdf(error) => CliError::new(format!("{name}:{error}")),
        error => CliError::new(format!("{name}: {error}")),
    }
}

/// Writes the file of a command, and prints the report if that is asked for.
pub fn finish(output: &OutputPath, bytes: &[u8], report: &Value, reporter: &Reporter) -> Result<(), CliError> {
    output.write(bytes)?;
    if reporter.json() { reporter.report(report) } else { Ok(()) }
}

/// The end of an output's name, in small letters.
pub fn extension(output: &OutputPath) -> Option<String> {
    Some(output.file()?.extension()?.to_string_lossy().to_ascii_lowercase())
}

/// The parameters with their values, for reports.
pub fn parameters_json(values: &ParameterValues) -> Value {
    let all = values.iter().map(|(parameter, value)| {
        let [min, max] = parameter.range();
        let (kind, value) = match parameter.kind {
            ParameterKind::Number { .. } => ("number", json!(value.x)),
            ParameterKind::Color { .. } => ("color", json!(value.to_array())),
            ParameterKind::Switch { .. } => ("switch", json!(value.x != 0.0)),
        };
        json!({
            "name": parameter.name,
            "kind": kind,
            "value": value,
            "min": min,
            "max": max,
            "unit": parameter.unit,
            "description": parameter.description,
        })
    });
    all.collect()
}
