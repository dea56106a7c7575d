//! `gonio brdf fit`: models fitted to a measured BRDF or another function.

use super::functions::{open, parameters_json};
use super::plot::PlotFormat;
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::output::{OutputFiles, OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_bsdf::fit::default_models;
use gonio_bsdf::models::model;
use gonio_bsdf::{BsdfFit, BsdfSource, FitError, FitTarget, ModelSpec, ModelSpecError, NamedBsdf, fit, fit_file};
use gonio_plot::{PlotTheme, PlottedBsdf, residuals};
use serde_json::{Value, json};

/// Fit models to a measured BRDF or to another function, best first.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf fit measured.binary -o fit.toml
  gonio brdf fit measured.binary --model ward,ggx,disney -o fit.toml
  gonio brdf fit measured.binary -o fit.toml --residuals residuals.png
      Also image slices and lit spheres of the measured BRDF, the best fit, and their difference.
  gonio brdf fit brushed.brdf:roughness=0.3 --model ward-anisotropic,disney -o fit.toml
      A function of BRDF Explorer as the target: it may be anisotropic, which measured tables are not.
  gonio brdf plot measured.binary fit.toml -o sphere.png --kind sphere
      Spheres of the measured BRDF and of the best fit.

The error is the root mean square of the difference of (f cos)^(1/3), over all directions at least 10 degrees above the \
horizon; the percentage compares it with (f cos)^(1/3) itself. The method is Levenberg and Marquardt's, from several starting \
points.

Models: lambert, phong, phong-normalised, blinn, blinn-normalised, lafortune-normalised, lafortune-2, lafortune-3, ward, \
ward-normalised, ward-anisotropic, cook-torrance, beckmann, ggx, oren-nayar, ashikhmin-shirley, disney.

A MERL table is isotropic by its format, so an anisotropic model gets two equal widths from it. An anisotropic function \
determines both. Without --model, models that suit the target are fitted.")]
pub struct FitArgs {
    /// The target: a measured BRDF (MERL .binary), or another file or model, with values of its parameters.
    #[arg(value_name = "TARGET")]
    pub target: String,
    /// Models to fit; by default blinn-normalised, ward, beckmann and ggx, or for an anisotropic target ward-anisotropic,
    /// ashikhmin-shirley and disney.
    #[arg(long, value_name = "MODEL,...", value_delimiter = ',', help_heading = "Comparison options")]
    pub model: Vec<String>,
    /// File to write, .toml; as a MODEL of other commands it stands for the best fit. - is stdout.
    #[arg(long, short, required = true, value_name = "FILE", help_heading = "Output options")]
    pub output: OutputPath,
    /// Draw slices and spheres of the target, the best fit and their difference to this file, .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output options")]
    pub residuals: Option<OutputPath>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &FitArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let residual_format = args.residuals.as_ref().map(PlotFormat::of_output).transpose()?;
    let residuals_kind = residual_format.map_or(OutputKind::Text, PlotFormat::output_kind);
    let outputs = args.residuals.iter().map(|file| (file, residuals_kind)).chain([(&args.output, OutputKind::Text)]);
    check_stdout(outputs, reporter)?;
    args.output.check_writable()?;
    args.residuals.iter().try_for_each(OutputPath::check_writable)?;
    let mut specs = specs(&args.model)?;
    let named = open(&args.target, reporter)?;
    let of_target = |error: FitError| CliError::new(format!("{}: {error}", named.name));
    let busy = reporter.busy("fitting");
    let target = match &named.source {
        BsdfSource::Table(table) => FitTarget::of_table(table),
        _ => FitTarget::of_function(named.bsdf.as_ref()),
    };
    let target = target.map_err(of_target)?;
    if specs.is_empty() {
        specs = default_models(&target).iter().filter_map(|name| model(name)).map(ModelSpec::new).collect();
    }
    let mut fits = specs.iter().map(|spec| fit(&target, spec)).collect::<Result<Vec<_>, _>>().map_err(of_target)?;
    drop(busy);
    fits.sort_by(|a, b| a.rms.total_cmp(&b.rms));
    let mut files = OutputFiles::new();
    if let (Some(output), Some(format), Some(best)) = (&args.residuals, residual_format, fits.first()) {
        files.add_output(output, draw_residuals(&named, best, format)?)?;
    }
    files.add_output(&args.output, fit_file::write(&fits).into_bytes())?;
    files.commit()?;
    if reporter.json() {
        reporter.report(&json!({
            "command": "brdf fit",
            "target": named.name,
            "isotropic": target.is_isotropic(),
            "fits": fits.iter().map(fit_report).collect::<Vec<_>>(),
            "output": args.output.to_string(),
            "residuals": args.residuals.as_ref().map(ToString::to_string),
            "warnings": named.warnings,
        }))?;
    } else {
        let page = page(&fits);
        if args.output.is_stdout() || args.residuals.as_ref().is_some_and(OutputPath::is_stdout) {
            reporter.text_on_stderr(&page);
        } else if !args.general.quiet {
            reporter.text(&page)?;
        }
    }
    Ok(CommandOutcome::Done)
}

fn page(fits: &[BsdfFit]) -> TerminalPage {
    let mut page = TerminalPage::new();
    for fit in fits {
        page.line(format_args!("{:6.2} %  {}", percent(fit), rounded(fit)));
        if !fit.at_limit.is_empty() {
            page.line(format_args!("          at the limit of its range: {}", fit.at_limit.join(", ")));
        }
    }
    page
}

/// The models that are named.
fn specs(names: &[String]) -> Result<Vec<ModelSpec>, CliError> {
    let one = |name: &String| match model(name.trim()) {
        Some(model) => Ok(ModelSpec::new(model)),
        None => Err(CliError::new(ModelSpecError::UnknownModel { name: name.clone() }.to_string())),
    };
    names.iter().map(one).collect()
}

/// Draws the target, the fit and their difference.
fn draw_residuals(named: &NamedBsdf, fit: &BsdfFit, format: PlotFormat) -> Result<Vec<u8>, CliError> {
    let (fitted, label) = (fit.spec.build(), rounded(fit));
    let plotted = |label, bsdf| PlottedBsdf { label, bsdf, ior: None };
    let figure =
        residuals(plotted(&named.name, named.bsdf.as_ref()), plotted(&label, fitted.as_ref()), PlotTheme::Light);
    format.write(figure)
}

/// The error relative to the measured values.
fn percent(fit: &BsdfFit) -> f64 {
    100.0 * fit.rms / fit.signal_rms.max(f64::MIN_POSITIVE)
}

/// The model with its values to four digits.
fn rounded(fit: &BsdfFit) -> String {
    let mut spec = fit.spec.clone();
    for (parameter, value) in fit.spec.values.iter() {
        spec.values.set_value(&parameter.name, value.map(four_digits));
    }
    spec.text()
}

/// A number to four digits, of which at most eight decimals.
fn four_digits(value: f64) -> f64 {
    let power = 10_f64.powi((3 - value.abs().max(1e-8).log10().floor() as i32).clamp(0, 8));
    (value * power).round() / power
}

fn fit_report(fit: &BsdfFit) -> Value {
    json!({
        "model": fit.spec.model.name,
        "notation": rounded(fit),
        "rms": fit.rms,
        "relative_percent": percent(fit),
        "iterations": fit.iterations,
        "starts": fit.starts,
        "at_limit": fit.at_limit,
        "parameters": parameters_json(&fit.spec.values),
    })
}
