//! `gonio diff`: two pictures compared.

mod digits;
mod map;
mod measure;
mod read;
mod sheets;

use crate::cli::WordOptions;
use crate::output::{FileSet, atomic};
use crate::page::Page;
use crate::report::{CliError, Outcome, Reporter};
use crate::values;
use clap::Args;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{self, ColorTag};
use measure::Numbers;
use read::Pixels;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Compare two pictures: numbers, difference map, side by side, wipe.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio diff a.png b.png
      Mean, RMS and largest difference, share of differing pixels, SSIM.
  gonio diff a.png b.png -o map.png
      Where they differ, in heat colours with their scale below.
  gonio diff a.png b.png --side-by-side sheet.png --wipe wipe.png
  gonio diff gpu.exr cpu.exr --max-linear 0.001
      Linear light; exit code 1 where any pixel differs by more than 0.001, absolute or relative.
  gonio diff old.png new.png --tolerance 1 --max-differing 0.5
      At most 0.5 % of the pixels may differ by more than one 8-bit step.

8-bit steps are 1/255 of the encoded (sRGB) value; EXR is encoded for them. Linear numbers are of decoded light.
Alpha counts as a channel where a picture has one that is not 1; colours are premultiplied by it.

Exit codes: 0 done, 1 a --max-... or --min-... does not hold, 2 error.")]
pub struct DiffArgs {
    /// A picture: .png, .jpg or .exr; - for stdin.
    #[arg(value_name = "A")]
    pub a: PathBuf,
    /// The picture to compare it with.
    #[arg(value_name = "B")]
    pub b: PathBuf,

    /// Write the difference map.
    #[arg(long, short, help_heading = "Pictures", value_name = "MAP.png")]
    pub output: Option<PathBuf>,
    /// The difference, in 8-bit steps, that the map's brightest colour stands for; the largest one by default.
    #[arg(long, help_heading = "Pictures", value_name = "STEPS", value_parser = values::positive)]
    pub scale: Option<f64>,
    /// The map without its scale below: as large as the pictures.
    #[arg(long, help_heading = "Pictures")]
    pub no_legend: bool,
    /// Write A, B and the map beside each other.
    #[arg(long, help_heading = "Pictures", value_name = "FILE.png")]
    pub side_by_side: Option<PathBuf>,
    /// Write a picture that is A on the left and B on the right.
    #[arg(long, help_heading = "Pictures", value_name = "FILE.png")]
    pub wipe: Option<PathBuf>,
    /// Where A ends in the wipe, share of the width.
    #[arg(long, help_heading = "Pictures", value_name = "SHARE", value_parser = share, default_value = "0.5")]
    pub wipe_at: f64,

    /// Pixels count as differing from more than so many 8-bit steps on.
    #[arg(long, help_heading = "Comparison", value_name = "STEPS", value_parser = values::not_negative,
          default_value = "0")]
    pub tolerance: f64,
    /// The layer of an .exr file; the first by default.
    #[arg(long, help_heading = "Comparison", value_name = "NAME")]
    pub layer: Option<String>,

    /// Fail where any channel differs by more 8-bit steps.
    #[arg(long, help_heading = "Checks", value_name = "STEPS", value_parser = values::not_negative)]
    pub max_difference: Option<f64>,
    /// Fail where the RMS is more 8-bit steps.
    #[arg(long, help_heading = "Checks", value_name = "STEPS", value_parser = values::not_negative)]
    pub max_rms: Option<f64>,
    /// Fail where linear light differs by more, absolute or (above 1) relative.
    #[arg(long, help_heading = "Checks", value_name = "X", value_parser = values::not_negative)]
    pub max_linear: Option<f64>,
    /// Fail where a larger share of the pixels differs by more than the tolerance.
    #[arg(long, help_heading = "Checks", value_name = "PERCENT", value_parser = values::not_negative)]
    pub max_differing: Option<f64>,
    /// Fail where SSIM is less.
    #[arg(long, help_heading = "Checks", value_name = "X", value_parser = values::number)]
    pub min_ssim: Option<f64>,

    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

fn share(text: &str) -> Result<f64, String> {
    values::number(text).and_then(|v| {
        if (0.0..=1.0).contains(&v) { Ok(v) } else { Err(format!("`{text}` is no share; 0 to 1 is wanted")) }
    })
}

/// One check that was asked for.
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
    numbers: &'a Numbers,
    checks: &'a [Check],
    held: bool,
    outputs: Vec<&'a Path>,
}

/// Compares.
pub fn run(args: &DiffArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let outputs: Vec<&Path> =
        [&args.output, &args.side_by_side, &args.wipe].into_iter().flatten().map(PathBuf::as_path).collect();
    for path in &outputs {
        if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
            return Err(CliError::new(format!("`{}`: diff writes its pictures as .png", path.display())));
        }
        atomic::check_writable(path)?;
    }
    let busy = reporter.busy("comparing");
    let a = read::read(&args.a, args.layer.as_deref())?;
    let b = read::read(&args.b, args.layer.as_deref())?;
    if (a.width, a.height) != (b.width, b.height) {
        return Err(CliError::new(format!(
            "`{}` is {}x{} and `{}` is {}x{}; only pictures of one size can be compared",
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
        let report =
            Report { command: "diff", a: &args.a, b: &args.b, numbers: &numbers, checks: &checks, held, outputs };
        reporter.report(&report)?;
    } else if !args.words.quiet {
        reporter.text(&text(args, &a, &b, &numbers))?;
    }
    for check in checks.iter().filter(|c| !c.held) {
        reporter.check_failed(format!(
            "{} is {}, and {} was the limit",
            check.option,
            number(check.value),
            number(check.limit)
        ));
    }
    Ok(if held { Outcome::Done } else { Outcome::CheckFailed })
}

fn write_pictures(args: &DiffArgs, a: &Pixels, b: &Pixels, numbers: &Numbers) -> Result<(), CliError> {
    let full_scale = args.scale.unwrap_or(numbers.steps.max.max(1.0));
    let difference = map::map(a, b, full_scale);
    let mut set = FileSet::new();
    let mut write = |path: &Path, picture: &EncodedPicture<u8>| set.add(path, &png::encode8(picture, ColorTag::Srgb)?);
    if let Some(path) = &args.side_by_side {
        write(path, &sheets::side_by_side(a, b, &difference))?;
    }
    if let Some(path) = &args.wipe {
        write(path, &sheets::wipe(a, b, args.wipe_at))?;
    }
    if let Some(path) = &args.output {
        let picture = if args.no_legend { difference } else { map::with_legend(&difference, full_scale) };
        write(path, &picture)?;
    }
    set.commit()
}

fn checks(args: &DiffArgs, numbers: &Numbers) -> Vec<Check> {
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
    // A pixel that is NaN in one picture only is as different as can be, whatever the limit.
    if numbers.not_finite > 0 {
        for check in &mut checks {
            check.held = false;
        }
    }
    checks
}

fn text(args: &DiffArgs, a: &Pixels, b: &Pixels, n: &Numbers) -> Page {
    let mut page = Page::new();
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
    if let Some(worst) = &n.worst {
        page.blank();
        page.line(format_args!("largest at {},{}: {} and {}", worst.x, worst.y, worst.a, worst.b));
    }
    if n.not_finite > 0 {
        page.line(format_args!("{} pixels are NaN or infinite in one picture and not in the other", n.not_finite));
    }
    page
}

/// Six significant digits, no trailing zeros.
fn number(v: f64) -> String {
    if v == 0.0 {
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
        assert_eq!(number(0.0), "0");
        assert_eq!(number(3.0), "3");
        assert_eq!(number(0.125), "0.125");
        assert_eq!(number(99.9999994), "100");
        assert_eq!(number(1.0 / 3.0), "0.333333");
        assert_eq!(number(1e-7), "1.000e-7");
    }
}
