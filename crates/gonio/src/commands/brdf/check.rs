//! `gonio brdf check`: reciprocity, energy, positivity, normalisation, sampling.

use super::functions::open;
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_bsdf::check::{CheckedProperty, angles_deg, check};
use gonio_bsdf::{DVec3, NamedBsdf};
use serde_json::{Value, json};

/// Check properties that every physically plausible function has: reciprocity, energy, positivity, normalisation, sampling.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf check ggx
  gonio brdf check ward:b=1,c=0.5
      Reflects more light than arrives where the light grazes the surface.
  gonio brdf check phong-printed blinn-printed ward-printed lafortune-printed
      The formulas as the lecture's appendix prints them.
  gonio brdf check mine.glsl
      A function of your own: vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
  gonio brdf check measured.binary --json

Normalisation and sampling belong to the importance sampling of the models, which files do not have.

Exit codes: 0 every function has all properties, 1 one has not, 2 error.")]
pub struct CheckArgs {
    /// Models or files, with values of their parameters.
    #[arg(required = true, value_name = "MODEL")]
    pub models: Vec<String>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &CheckArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let functions = args.models.iter().map(|text| open(text, reporter)).collect::<Result<Vec<_>, _>>()?;
    let busy = reporter.busy("checking");
    let checked: Vec<(&NamedBsdf, Vec<CheckedProperty>)> =
        functions.iter().map(|named| (named, check(named.bsdf.as_ref()))).collect();
    drop(busy);
    let all_passed = checked.iter().all(|(_, properties)| has_all(properties));
    if reporter.json() {
        let functions: Vec<Value> = checked.iter().map(|(named, properties)| report(named, properties)).collect();
        reporter.report(&json!({ "command": "brdf check", "passed": all_passed, "functions": functions }))?;
    } else {
        let mut page = TerminalPage::new();
        for (named, properties) in &checked {
            page.line(format_args!("{}: {}", named.name, named.title));
            for property in properties {
                let verdict = if property.passed { "pass" } else { "FAIL" };
                page.line(format_args!("  {verdict}  {:13}  {}", property.property, property.explanation));
            }
        }
        reporter.text(&page)?;
    }
    Ok(if all_passed { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

fn has_all(properties: &[CheckedProperty]) -> bool {
    properties.iter().all(|property| property.passed)
}

fn report(named: &NamedBsdf, properties: &[CheckedProperty]) -> Value {
    let direction =
        |w: Option<DVec3>| w.map(angles_deg).map(|(theta, phi)| json!({ "theta_deg": theta, "phi_deg": phi }));
    let properties = properties.iter().map(|property| {
        json!({
            "property": property.property,
            "passed": property.passed,
            "value": property.value,
            "light": direction(property.wi),
            "viewer": direction(property.wo),
            "explanation": property.explanation,
        })
    });
    let properties: Vec<Value> = properties.collect();
    json!({ "name": named.name, "title": named.title, "properties": properties, "warnings": named.warnings })
}
