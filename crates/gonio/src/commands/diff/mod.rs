//! `gonio diff`: a comparison of two pictures.

mod measure;
mod pictures;
mod read;

use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, values};
use crate::output::{OutputFiles, OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{self, ColorTag};
use gonio_light::is_noise;
use measure::PictureDifference;
use read::Pixels;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Compare two pictures: numbers, difference map, side by side, wipe.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio diff a.png b.png
      Mean, RMS and largest difference, share of differing pixels, SSIM, FLIP.
  gonio diff a.png b.png -o map.png
      A map of the differences in heat colours, with its scale below.
  gonio diff a.png b.png --side-by-side sheet.png --wipe wipe.png
  gonio diff gpu.exr cpu.exr --max-linear 0.001
      Exit code 1 if linear light differs anywhere by more than 0.001, absolute or relative.
  gonio diff old.png new.png --tolerance 1 --max-differing 0.5
      At most 0.5 % of the pixels may differ by more than one 8-bit step.

An 8-bit step is 1/255 of the encoded (sRGB) value; EXR is encoded first. Linear numbers compare decoded light. Alpha counts as a \
channel if a picture has any that is not 1; colours are premultiplied by it.

Exit codes: 0 success, 1 a --max-... or --min-... check failed, 2 error.")]
pub struct DiffArgs {
    /// Picture: .png, .jpg or .exr; - is stdin.
    #[arg(value_name = "A")]
    pub a: PathBuf,
    /// Picture to compare it with.
    #[arg(value_name = "B")]
    pub b: PathBuf,

    /// Write the difference map; - is stdout.
    #[arg(long, short, help_heading = "Output options", value_name = "MAP.png")]
    pub output: Option<OutputPath>,
    /// Difference, in 8-bit steps, shown in the map's brightest colour; by default the largest difference.
    #[arg(long, help_heading = "Output options", value_name = "STEPS", value_parser = values::positive)]
    pub scale: Option<f64>,
    /// Leave out the scale below the map, which then has the size of the pictures.
    #[arg(long, help_heading = "Output options")]
    pub no_legend: bool,
    /// Write A, B and the map side by side; - is stdout.
    #[arg(long, help_heading = "Output options", value_name = "FILE.png")]
    pub side_by_side: Option<OutputPath>,
    /// Write a picture that shows A on the left and B on the right; - is stdout.
    #[arg(long, help_heading = "Output options", value_name = "FILE.png")]
    pub wipe: Option<OutputPath>,
    /// End of A in the wipe, as a share of the width.
    #[arg(long, help_heading = "Output options", value_name = "SHARE", value_parser = values::share,
          default_value = "0.5")]
    pub wipe_at: f64,

    /// Largest difference, in 8-bit steps, of pixels that count as equal.
    #[arg(long, help_heading = "Comparison options", value_name = "STEPS", value_parser = values::not_negative,
          default_value = "0")]
    pub tolerance: f64,
    /// Layer of an .exr file; the first by default.
    #[arg(long, help_heading = "Comparison options", value_name = "NAME")]
    pub layer: Option<String>,

    /// Fail if any channel differs by more than this number of 8-bit steps.
    #[arg(long, help_heading = "Check options", value_name = "STEPS", value_parser = values::not_negative)]
    pub max_difference: Option<f64>,
    /// Fail if the RMS exceeds this number of 8-bit steps.
    #[arg(long, help_heading = "Check options", value_name = "STEPS", value_parser = values::not_negative)]
    pub max_rms: Option<f64>,
    /// Fail if linear light differs by more than this, absolute or (above 1) relative.
    #[arg(long, help_heading = "Check options", value_name = "X", value_parser = values::not_negative)]
    pub max_linear: Option<f64>,
    /// Fail if more than this percentage of the pixels differs by more than the tolerance.
    #[arg(long, help_heading = "Check options", value_name = "PERCENT", value_parser = values::not_negative)]
    pub max_differing: Option<f64>,
    /// Fail if the SSIM is below this.
    #[arg(long, help_heading = "Check options", value_name = "X", value_parser = values::number)]
    pub min_ssim: Option<f64>,

    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The result of a check.
#[derive(Clone, Debug, Serialize)]
struct Check {
    option: &'static str,
    limit: f64,
    value: f64,
    held: bool,
}

#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    a: &'a Path,
    b: &'a Path,
    #[serde(flatten)]
    numbers: &'a PictureDifference,
    checks: &'a [Check],
    held: bool,
    outputs: Vec<String>,
}

pub fn run(args: &DiffArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let outputs: Vec<&OutputPath> = [&args.output, &args.side_by_side, &args.wipe].into_iter().flatten().collect();
    for output in &outputs {
        if let Some(path) = output.file()
            && !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"))
        {
            return Err(CliError::new(format!("`{output}`: diff writes pictures as .png only")));
        }
        output.check_writable()?;
    }
    let is_stdout_taken = check_stdout(outputs.iter().map(|output| (*output, OutputKind::Binary)), reporter)?;
    let busy = reporter.busy("comparing");
    let a = read::read(&args.a, args.layer.as_deref(), reporter)?;
    let b = read::read(&args.b, args.layer.as_deref(), reporter)?;
    if (a.width, a.height) != (b.width, b.height) {
        return Err(CliError::new(format!(
            "`{}` is {}x{} and `{}` is {}x{}: pictures must have the same size to be compared",
            args.a.display(),
            a.width,
            a.height,
            args.b.display(),
            b.width,
            b.height
        )));
    }
    let numbers = measure::measure(&a, &b, args.tolerance)?;
    write_pictures(args, &a, &b, &numbers)?;
    drop(busy);

    let checks = checks(args, &numbers);
    let held = checks.iter().all(|c| c.held);
    if reporter.json() {
        let outputs = outputs.iter().map(ToString::to_string).collect();
        let report =
            Report { command: "diff", a: &args.a, b: &args.b, numbers: &numbers, checks: &checks, held, outputs };
        reporter.report(&report)?;
    } else if is_stdout_taken {
        reporter.text_on_stderr(&text(args, &a, &b, &numbers));
    } else if !args.general.quiet {
        reporter.text(&text(args, &a, &b, &numbers))?;
    }
    for check in checks.iter().filter(|c| !c.held) {
        reporter.check_failed(format!(
            "{} {} is not met: the value is {}",
            check.option,
            number(check.limit),
            number(check.value)
        ));
    }
    Ok(if held { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

fn write_pictures(args: &DiffArgs, a: &Pixels, b: &Pixels, numbers: &PictureDifference) -> Result<(), CliError> {
    let full_scale = args.scale.unwrap_or(numbers.steps.max.max(1.0));
    let difference = pictures::difference_map(a, b, full_scale);
    let mut files = OutputFiles::new();
    let mut add = |output: &OutputPath, picture: &EncodedPicture<u8>| {
        files.add_output(output, png::encode8(picture, ColorTag::Srgb)?)
    };
    if let Some(output) = &args.side_by_side {
        add(output, &pictures::side_by_side(a, b, &difference))?;
    }
    if let Some(output) = &args.wipe {
        add(output, &pictures::wipe(a, b, args.wipe_at))?;
    }
    if let Some(output) = &args.output {
        let picture = if args.no_legend { difference } else { pictures::with_legend(&difference, full_scale) };
        add(output, &picture)?;
    }
    files.commit()
}

fn checks(args: &DiffArgs, numbers: &PictureDifference) -> Vec<Check> {
    let most = |option, limit: Option<f64>, value: f64| {
        limit.map(|limit| Check { option, limit, value, held: measure::within(value, limit) })
    };
    let mut checks: Vec<Check> = [
        most("--max-difference", args.max_difference, numbers.steps.max),
        most("--max-rms", args.max_rms, numbers.steps.rms),
        most("--max-linear", args.max_linear, numbers.linear_absolute_or_relative),
        most("--max-differing", args.max_differing, numbers.differing_percent),
        args.min_ssim.map(|limit| Check {
            option: "--min-ssim",
            limit,
            value: numbers.ssim,
            held: numbers.ssim >= limit,
        }),
    ]
    .into_iter()
    .flatten()
    .collect();
    // A pixel that is NaN in only one picture exceeds every limit.
    if numbers.not_finite > 0 {
        for check in &mut checks {
            check.held = false;
        }
    }
    checks
}

fn text(args: &DiffArgs, a: &Pixels, b: &Pixels, n: &PictureDifference) -> TerminalPage {
    let mut page = TerminalPage::new();
    let names = [args.a.display().to_string(), args.b.display().to_string()];
    let width = names[0].len().max(names[1].len());
    for (name, pixels) in names.iter().zip([a, b]) {
        page.line(format_args!("{name:width$}  {}x{}, {}", pixels.width, pixels.height, pixels.depth()));
    }
    page.blank();
    page.line(format_args!("{:18}{:>14}{:>14}", "", "8-bit steps", "linear"));
    for (name, steps, linear) in [
        ("mean", n.steps.mean, n.linear.mean),
        ("RMS", n.steps.rms, n.linear.rms),
        ("maximum", n.steps.max, n.linear.max),
    ] {
        page.line(format_args!("{name:18}{:>14}{:>14}", number(steps), number(linear)));
    }
    page.line(format_args!(
        "{:18}{:>14}   {} of {} pixels, by more than {} steps",
        "differing",
        format!("{} %", number(n.differing_percent)),
        n.differing_pixels,
        n.pixels,
        number(n.tolerance)
    ));
    page.line(format_args!("{:18}{:>14}", "SSIM", number(n.ssim)));
    page.line(format_args!("{:18}{:>14}", "FLIP", number(n.flip)));
    if let Some(worst) = &n.worst {
        page.blank();
        page.line(format_args!("largest at {},{}: {} and {}", worst.x, worst.y, worst.a, worst.b));
    }
    if n.not_finite > 0 {
        page.line(format_args!("{} pixels are NaN or infinite in one picture and not in the other", n.not_finite));
    }
    page
}

/// Formats a number with six significant digits and no trailing zeros; noise is 0.
fn number(v: f64) -> String {
    if is_noise(v) {
        return "0".into();
    }
    if !(1e-4..1e6).contains(&v.abs()) {
        return format!("{v:.3e}");
    }
    let decimals = (5 - v.abs().log10().floor() as i32).clamp(0, 9) as usize;
    let text = format!("{v:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!((number(0.0), number(-3e-17)), ("0".into(), "0".into()));
        assert_eq!(number(3.0), "3");
        assert_eq!(number(0.125), "0.125");
        assert_eq!(number(99.9999994), "100");
        assert_eq!(number(1.0 / 3.0), "0.333333");
        assert_eq!(number(1e-7), "1.000e-7");
    }
}
