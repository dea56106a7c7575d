//! `gonio brdf plot`: lobes, curves, slices and spheres as SVG or PNG.

use super::functions::{extension, finish, open};
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, values};
use crate::output::{OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use clap::Args;
use gonio_plot::{
    PlotError, PlotFigure, PlotKind, PlotScale, PlotSettings, PlotTheme, PlottedAngle, PlottedBsdf, default_size,
    figure,
};
use serde_json::json;

/// Plot one or several functions.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio brdf plot phong-normalised blinn-normalised:c=128 ward -o lobes.svg
      Values in the plane of incidence, as distances from the point.
  gonio brdf plot ggx:alpha=0.1 ggx:alpha=0.3 -o curves.png --kind cartesian --scale log --theta 60
  gonio brdf plot rough-dielectric -o lobe.svg --kind lobe
      Reflection above the surface and transmission below it.
  gonio brdf plot measured.binary fit.toml -o slice.png --kind slice --scale cube-root
      A measured BRDF beside its fit.
  gonio brdf plot ward:b=1 ward-normalised:b=1 -o albedo.svg --kind albedo --theme dark
  gonio brdf plot dielectric:ior=1.52 -o fresnel.svg --kind fresnel
      With Brewster's angle.

Kinds:
  polar        values in the plane of incidence, as distances from the point.
  cartesian    values over an angle (--over).
  lobe         values of all directions, as a surface.
  slice        values over half and difference angle, the image slice of measured BRDFs.
  sphere       a sphere lit by one light.
  albedo       the share of light that is scattered, over the angle of incidence.
  reciprocity  the difference when light and viewer change places.
  fresnel      reflectance of the first model that has an index of refraction.
  samples      directions drawn by importance sampling.")]
pub struct PlotArgs {
    /// Models or files, with values of their parameters; at most seven.
    #[arg(required = true, value_name = "MODEL")]
    pub models: Vec<String>,
    /// File to write: .svg or .png; - is stdout.
    #[arg(long, short, required = true, value_name = "FILE", help_heading = "Output options")]
    pub output: OutputPath,
    /// Format; by default that of the file name.
    #[arg(long, value_name = "FORMAT", value_parser = values::named(PlotFormat::ALL, PlotFormat::name),
          help_heading = "Output options")]
    pub format: Option<PlotFormat>,
    /// Kind of plot.
    #[arg(long, help_heading = "Drawing options", default_value = "polar",
          value_parser = values::named(PlotKind::ALL, PlotKind::name))]
    pub kind: PlotKind,
    /// Angle of incidence in degrees; of the viewer for samples.
    #[arg(long, help_heading = "Drawing options", value_name = "DEGREES", default_value = "45",
          value_parser = values::number, allow_negative_numbers = true)]
    pub theta: f64,
    /// Azimuth of the light in degrees, for anisotropic functions.
    #[arg(long, help_heading = "Drawing options", value_name = "DEGREES", default_value = "0",
          value_parser = values::number, allow_negative_numbers = true)]
    pub phi: f64,
    /// Angle along the horizontal axis of a Cartesian plot.
    #[arg(long, help_heading = "Drawing options", default_value = "theta-o",
          value_parser = values::named(PlottedAngle::ALL, PlottedAngle::name))]
    pub over: PlottedAngle,
    /// Scale of the values.
    #[arg(long, help_heading = "Drawing options", default_value = "linear",
          value_parser = values::named(PlotScale::ALL, PlotScale::name))]
    pub scale: PlotScale,
    /// Multiply the values by the cosine of the angle of incidence.
    #[arg(long, help_heading = "Drawing options")]
    pub cosine: bool,
    /// Colours of the paper.
    #[arg(long, help_heading = "Drawing options", default_value = "light",
          value_parser = values::named(PlotTheme::ALL, PlotTheme::name))]
    pub theme: PlotTheme,
    /// Size in pixels; by default as the kind needs it.
    #[arg(long, help_heading = "Drawing options", value_name = "WIDTHxHEIGHT", value_parser = values::size)]
    pub size: Option<(u32, u32)>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlotFormat {
    Svg,
    Png,
}

impl PlotFormat {
    const ALL: &'static [PlotFormat] = &[PlotFormat::Svg, PlotFormat::Png];

    /// The name, which is also the end of a file's name.
    fn name(self) -> &'static str {
        match self {
            PlotFormat::Svg => "svg",
            PlotFormat::Png => "png",
        }
    }

    /// The format of a file's name.
    pub fn of_output(output: &OutputPath) -> Result<PlotFormat, CliError> {
        let end = extension(output);
        let found = PlotFormat::ALL.iter().copied().find(|format| end.as_deref() == Some(format.name()));
        found.ok_or_else(|| {
            let message =
                format!("unknown format of `{output}`: expected a file that ends with .svg or .png, or --format");
            CliError::new(message)
        })
    }

    /// Whether a terminal can show it.
    pub fn output_kind(self) -> OutputKind {
        match self {
            PlotFormat::Svg => OutputKind::Text,
            PlotFormat::Png => OutputKind::Binary,
        }
    }

    /// Draws a plot.
    pub fn draw(self, functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<Vec<u8>, CliError> {
        self.write(figure(functions, settings))
    }

    /// Writes a plot.
    pub fn write(self, figure: Result<PlotFigure, PlotError>) -> Result<Vec<u8>, CliError> {
        let bytes = figure.and_then(|figure| match self {
            PlotFormat::Svg => figure.svg().map(String::into_bytes),
            PlotFormat::Png => figure.png(),
        });
        bytes.map_err(|error| CliError::new(error.to_string()))
    }
}

pub fn run(args: &PlotArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let format = args.format.map_or_else(|| PlotFormat::of_output(&args.output), Ok)?;
    check_stdout([(&args.output, format.output_kind())], reporter)?;
    args.output.check_writable()?;
    let named = args.models.iter().map(|text| open(text, reporter)).collect::<Result<Vec<_>, _>>()?;
    let functions: Vec<PlottedBsdf<'_>> = named
        .iter()
        .map(|named| PlottedBsdf { label: &named.name, bsdf: named.bsdf.as_ref(), ior: named.refraction_index() })
        .collect();
    let settings = PlotSettings {
        kind: args.kind,
        theta_i_deg: args.theta,
        phi_i_deg: args.phi,
        over: args.over,
        scale: args.scale,
        with_cosine: args.cosine,
        theme: args.theme,
        size: args.size.map_or_else(|| default_size(args.kind, functions.len()), |(width, height)| [width, height]),
        ..PlotSettings::default()
    };
    let busy = reporter.busy("plotting");
    let bytes = format.draw(&functions, &settings)?;
    drop(busy);
    let names: Vec<&str> = named.iter().map(|named| named.name.as_str()).collect();
    let warnings: Vec<&String> = named.iter().flat_map(|named| &named.warnings).collect();
    let report = json!({
        "command": "brdf plot",
        "kind": args.kind,
        "names": names,
        "format": format.name(),
        "output": args.output.to_string(),
        "size": settings.size,
        "warnings": warnings,
    });
    finish(&args.output, &bytes, &report, reporter)?;
    Ok(CommandOutcome::Done)
}
