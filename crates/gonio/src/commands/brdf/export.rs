//! `gonio brdf export`: a function as a MERL table, GLSL, a .brdf file or comma-separated values.

use super::functions::{extension, finish, open};
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, values};
use crate::output::{OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use clap::Args;
use gonio_bsdf::{MerlTable, NamedBsdf};
use serde_json::json;

/// Write a function as a MERL table, as GLSL, as a .brdf file of BRDF Explorer, or as a table of numbers.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf export ggx:alpha=0.2 -o ggx.binary
      A table in the format of the MERL database, 90 x 90 x 180.
  gonio brdf export ward:c=0.3 -o ward.glsl
      A GLSL function with the parameters as constants.
  gonio brdf export disney -o disney.brdf
      For BRDF Explorer, with a slider for each parameter.
  gonio brdf export measured.binary -o measured.csv
      Comma-separated values: polar angles every 5 degrees, azimuths every 15.

  gonio brdf export ggx -o - --format csv

Tables hold isotropic reflection only.")]
pub struct ExportArgs {
    /// A model or a file, with values of its parameters.
    #[arg(value_name = "MODEL")]
    pub model: String,
    /// File to write: .binary, .glsl, .brdf or .csv; - is stdout.
    #[arg(long, short, required = true, value_name = "FILE", help_heading = "Output options")]
    pub output: OutputPath,
    /// Format; by default that of the file name.
    #[arg(long, value_name = "FORMAT", value_parser = values::named(ExportFormat::ALL, ExportFormat::name),
          help_heading = "Output options")]
    pub format: Option<ExportFormat>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The formats, by the end of the file's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportFormat {
    /// MERL
    Binary,
    Glsl,
    Brdf,
    Csv,
}

impl ExportFormat {
    const ALL: &'static [ExportFormat] =
        &[ExportFormat::Binary, ExportFormat::Glsl, ExportFormat::Brdf, ExportFormat::Csv];

    /// The name, which is also the end of a file's name.
    fn name(self) -> &'static str {
        match self {
            ExportFormat::Binary => "binary",
            ExportFormat::Glsl => "glsl",
            ExportFormat::Brdf => "brdf",
            ExportFormat::Csv => "csv",
        }
    }

    fn of_output(output: &OutputPath) -> Result<ExportFormat, CliError> {
        let end = extension(output);
        let found = ExportFormat::ALL.iter().copied().find(|format| end.as_deref() == Some(format.name()));
        found.ok_or_else(|| {
            CliError::new(format!(
                "unknown format of `{output}`: expected a file that ends with .binary, .glsl, .brdf or .csv, or --format"
            ))
        })
    }

    fn bytes(self, named: &NamedBsdf) -> Result<Vec<u8>, CliError> {
        let no_glsl = || CliError::new(format!("`{}` has no GLSL function; .csv holds its values", named.name));
        match self {
            ExportFormat::Binary => {
                let table = MerlTable::tabulate(named.bsdf.as_ref());
                Ok(table.map_err(|error| CliError::new(format!("{}: {error}", named.name)))?.write())
            }
            ExportFormat::Glsl => named.to_glsl().map(String::into_bytes).ok_or_else(no_glsl),
            ExportFormat::Brdf => named.to_brdf().map(String::into_bytes).ok_or_else(no_glsl),
            ExportFormat::Csv => Ok(named.to_csv().into_bytes()),
        }
    }
}

pub fn run(args: &ExportArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let format = args.format.map_or_else(|| ExportFormat::of_output(&args.output), Ok)?;
    let kind = if format == ExportFormat::Binary { OutputKind::Binary } else { OutputKind::Text };
    check_stdout([(&args.output, kind)], reporter)?;
    args.output.check_writable()?;
    let named = open(&args.model, reporter)?;
    let busy = reporter.busy("computing the values");
    let bytes = format.bytes(&named)?;
    drop(busy);
    let report = json!({
        "command": "brdf export",
        "name": named.name,
        "format": format.name(),
        "output": args.output.to_string(),
        "bytes": bytes.len(),
        "warnings": named.warnings,
    });
    finish(&args.output, &bytes, &report, reporter)?;
    Ok(CommandOutcome::Done)
}
