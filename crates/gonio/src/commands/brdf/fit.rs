//! `gonio brdf fit`: models fitted to a measured BRDF.

use super::functions::{file_error, parameters_json, read};
use super::plot::PlotFormat;
use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::output::{OutputFiles, OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_bsdf::models::model;
use gonio_bsdf::{BsdfFit, FitResidual, MerlTable, ModelSpec, ModelSpecError, NamedBsdfError, fit, fit_file};
use gonio_plot::{PlotKind, PlotScale, PlotSettings, PlottedBsdf, default_size};
use serde_json::{Value, json};

/// Fit models to a measured BRDF, best first.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf fit measured.binary -o fit.toml
  gonio brdf fit measured.binary --model ward,ggx,disney -o fit.toml
  gonio brdf fit measured.binary -o fit.toml --residuals residuals.png
      Also image slices of the measured BRDF, the best fit, and their difference.
  gonio brdf plot measured.binary fit.toml -o sphere.png --kind sphere
      Spheres of the measured BRDF and of the best fit.

The error is the root mean square of the difference of (f cos)^(1/3), over all directions at least 10 degrees above the \
horizon; the percentage compares it with (f cos)^(1/3) itself. The method is Levenberg and Marquardt's, from several starting \
points.

Models: lambert, phong, phong-normalised, blinn, blinn-normalised, lafortune-normalised, lafortune-2, lafortune-3, ward, ward-normalised, cook-torrance, \
beckmann, ggx, oren-nayar, ashikhmin-shirley, disney.")]
pub struct FitArgs {
    /// A measured BRDF: MERL .binary.
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Models to fit.
    #[arg(
        long,
        value_name = "MODEL,...",
        value_delimiter = ',',
        help_heading = "Comparison options",
        default_value = "blinn-normalised,ward,beckmann,ggx"
    )]
    pub model: Vec<String>,
    /// File to write, .toml; as a MODEL of other commands it stands for the best fit. - is stdout.
    #[arg(long, short, required = true, value_name = "FILE", help_heading = "Output options")]
    pub output: OutputPath,
    /// Draw image slices of the table, the best fit and their difference to this file, .svg or .png.
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
    let specs = args.model.iter().map(|name| match model(name.trim()) {
        Some(model) => Ok(ModelSpec::new(model)),
        None => Err(CliError::new(ModelSpecError::UnknownModel { name: name.clone() }.to_string())),
    });
    let specs: Vec<ModelSpec> = specs.collect::<Result<_, _>>()?;
    let bytes = read(&args.file, reporter)?;
    let table = MerlTable::read(&bytes).map_err(|error| file_error(&args.file, &NamedBsdfError::Merl(error)))?;
    let warning = table.scale_warning();
    warning.iter().for_each(|warning| reporter.warning(format!("{}: {warning}", args.file)));
    let busy = reporter.busy("fitting");
    let fits = specs.iter().map(|spec| fit(&table, spec)).collect::<Result<Vec<_>, _>>();
    let mut fits = fits.map_err(|error| CliError::new(format!("{}: {error}", args.file)))?;
    drop(busy);
    fits.sort_by(|a, b| a.rms.total_cmp(&b.rms));
    let mut files = OutputFiles::new();
    if let (Some(output), Some(format), Some(best)) = (&args.residuals, residual_format, fits.first()) {
        files.add_output(output, residuals(&table, &args.file, best, format)?)?;
    }
    files.add_output(&args.output, fit_file::write(&fits).into_bytes())?;
    files.commit()?;
    if reporter.json() {
        reporter.report(&json!({
            "command": "brdf fit",
            "file": args.file,
            "fits": fits.iter().map(fit_report).collect::<Vec<_>>(),
            "output": args.output.to_string(),
            "residuals": args.residuals.as_ref().map(ToString::to_string),
            "warnings": warning,
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

/// Draws the table, the fit and their difference.
fn residuals(table: &MerlTable, name: &str, fit: &BsdfFit, format: PlotFormat) -> Result<Vec<u8>, CliError> {
    let fitted = fit.spec.build();
    let residual = FitResidual { table, fitted: fitted.as_ref() };
    let label = rounded(fit);
    let plotted = |label, bsdf| PlottedBsdf { label, bsdf, ior: None };
    let functions = [plotted(name, table), plotted(&label, fitted.as_ref()), plotted("absolute difference", &residual)];
    let kind = PlotKind::Slice;
    let size = default_size(kind, functions.len());
    let settings = PlotSettings { kind, scale: PlotScale::CubeRoot, size, ..PlotSettings::default() };
    format.draw(&functions, &settings)
}

/// The error relative to the measured values.
fn percent(fit: &BsdfFit) -> f64 {
    100.0 * fit.rms / fit.signal_rms.max(f64::MIN_POSITIVE)
}

/// The model with its values to four decimals.
fn rounded(fit: &BsdfFit) -> String {
    let mut spec = fit.spec.clone();
    for (parameter, value) in fit.spec.values.iter() {
        spec.values.set_value(&parameter.name, value.map(|channel| (channel * 1e4).round() / 1e4));
    }
    spec.text()
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
