//! `gonio brdf list` and `gonio brdf show`.

use super::functions::{open, parameters_json};
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_bsdf::models::model;
use gonio_bsdf::{MODELS, NamedBsdf, ParameterValues, model_spec};
use serde_json::json;

/// List the models.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf list
  gonio brdf list --json
      With the parameters of each model.")]
pub struct ListArgs {
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn list(reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if reporter.json() {
        let models = MODELS.iter().map(|model| {
            json!({
                "name": model.name,
                "title": model.title,
                "formula": model.formula,
                "source": model.source,
                "remark": model.remark,
                "parameters": parameters_json(&ParameterValues::defaults(model.parameters)),
                "has_glsl": model.glsl.is_some(),
            })
        });
        reporter.report(&json!({ "command": "brdf list", "models": models.collect::<Vec<_>>() }))?;
    } else {
        let mut page = TerminalPage::new();
        let width = MODELS.iter().map(|model| model.name.len()).max().unwrap_or(0);
        MODELS.iter().for_each(|model| page.line(format_args!("{:width$}  {}", model.name, model.title)));
        reporter.text(&page)?;
    }
    Ok(CommandOutcome::Done)
}

/// Show a model's formula, parameters and source.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf show ward
  gonio brdf show blinn-printed
      What is wrong with the formula that the lecture's appendix prints.
  gonio brdf show ggx:alpha=0.1 --glsl
      Also its GLSL function, with the parameters as constants.
  gonio brdf show mine.brdf")]
pub struct ShowArgs {
    /// A model or a file, with values of its parameters.
    #[arg(value_name = "MODEL")]
    pub model: String,
    /// Print the GLSL function too.
    #[arg(long, help_heading = "Output options")]
    pub glsl: bool,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn show(args: &ShowArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let named = open(&args.model, reporter)?;
    let known = model(model_spec::split(&args.model).0);
    let glsl = if args.glsl { named.to_glsl() } else { None };
    if args.glsl && glsl.is_none() {
        return Err(CliError::new(format!("`{}` has no GLSL function", named.name)));
    }
    if reporter.json() {
        reporter.report(&json!({
            "command": "brdf show",
            "name": named.name,
            "title": named.title,
            "formula": known.map(|model| model.formula),
            "source": known.map(|model| model.source),
            "remark": known.map(|model| model.remark),
            "parameters": parameters_json(&named.values),
            "transmits": named.bsdf.transmits(),
            "isotropic": named.bsdf.is_isotropic(),
            "glsl": glsl,
            "warnings": named.warnings,
        }))?;
        return Ok(CommandOutcome::Done);
    }
    let mut page = TerminalPage::new();
    page.line(format_args!("{}: {}", named.name, named.title));
    if let Some(model) = known {
        page.line(format_args!("  {}", model.formula));
        page.line(format_args!("  Source: {}", model.source));
        page.line(format_args!("  {}", model.remark));
    }
    parameters(&mut page, &named);
    if let Some(glsl) = glsl {
        page.heading("GLSL");
        page.text(&glsl);
    }
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

fn parameters(page: &mut TerminalPage, named: &NamedBsdf) {
    let rows: Vec<[String; 4]> = named
        .values
        .iter()
        .map(|(parameter, value)| {
            let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
            let [name, description] = [parameter.name.to_string(), parameter.description.to_string()];
            [name, parameter.format(value) + &unit, parameter.expected(), description]
        })
        .collect();
    if rows.is_empty() {
        return;
    }
    page.heading("Parameters");
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let (names, values, ranges) = (width(0), width(1), width(2));
    for [name, value, range, description] in &rows {
        let line = format!("  {name:names$}  {value:values$}  {range:ranges$}  {description}");
        page.line(line.trim_end());
    }
}
