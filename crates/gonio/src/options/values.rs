//! Parsers for the values of options: sizes, vectors, colours. `gonio-scene` parses lights and materials, whose keys are
//! those of scene files.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use gonio_atlas::raster::MOST_TEXELS;
use gonio_bsdf::{MODELS, ModelSpec, ModelSpecError};
use gonio_light::brdf::BrdfKind;
use gonio_scene::color_value::Color;
use gonio_scene::validate::{MAX_CUBEMAP_SIZE, MAX_PIXELS, MAX_SIDE};
use gonio_scene::{SpecialView, ViewSpec, nearest_word};
use std::str::FromStr;

/// A parser for an enum by the names of its variants.
pub fn named<T>(all: &'static [T], name: fn(T) -> &'static str) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    PossibleValuesParser::new(all.iter().map(move |&v| PossibleValue::new(name(v)))).map(move |text| {
        // The parser before accepts known names only.
        all.iter().copied().find(|&v| name(v).eq_ignore_ascii_case(&text)).unwrap_or(all[0])
    })
}

/// The value of `--brdf`.
#[derive(Clone, Debug, PartialEq)]
pub enum BrdfValue {
    /// A BRDF of the equation, with the colours of the materials.
    Equation(BrdfKind),
    /// A model with parameters, in place of all materials.
    Model(String),
}

/// Parses the name of a BRDF of the equation, or a model with its parameters.
pub fn brdf(text: &str) -> Result<BrdfValue, String> {
    if let Some(kind) = BrdfKind::ALL.iter().find(|kind| kind.name().eq_ignore_ascii_case(text)) {
        return Ok(BrdfValue::Equation(*kind));
    }
    match ModelSpec::parse(text) {
        Ok(_) => Ok(BrdfValue::Model(text.to_owned())),
        Err(ModelSpecError::UnknownModel { name }) => {
            let known: Vec<&str> = MODELS.iter().map(|model| model.name).collect();
            let meant = nearest_word(&name, known.iter().copied());
            let meant = meant.map_or(String::new(), |meant| format!("; did you mean `{meant}`?"));
            let file = if name.contains(['.', '/']) { " (a file is named by --brdf-file)" } else { "" };
            Err(format!("unknown BRDF `{name}`{file}: expected one of {}{meant}", known.join(", ")))
        }
        Err(error) => Err(error.to_string()),
    }
}

/// Parses `WIDTHxHEIGHT`, at most the size of the largest picture.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong = || format!("invalid size `{text}`: expected WIDTHxHEIGHT, for example 1024x768");
    let (w, h) = text.split_once(['x', 'X', '*']).ok_or_else(wrong)?;
    let side = |t: &str| {
        let t = t.trim();
        // A number that does not fit into an integer is too large, not malformed.
        if !t.is_empty() && t.bytes().all(|b| b.is_ascii_digit()) {
            Ok(t.parse().unwrap_or(u64::MAX))
        } else {
            Err(wrong())
        }
    };
    let (w, h) = (side(w)?, side(h)?);
    check_size(w, h)?;
    Ok((w as u32, h as u32))
}

/// Parses a finite number.
pub fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(v) if v.is_finite() => Ok(v),
        Ok(_) => Err(format!("invalid number `{text}`: expected a finite number")),
        Err(_) => Err(format!("invalid number `{text}`")),
    }
}

/// Parses a number in a range; `expected` describes it.
fn number_in(text: &str, is_in: impl Fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    match number(text)? {
        value if is_in(value) => Ok(value),
        _ => Err(format!("invalid number `{text}`: expected {expected}")),
    }
}

/// Parses a number that is not negative.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number_in(text, |value| value >= 0.0, "0 or more")
}

/// Parses a number greater than 0.
pub fn positive(text: &str) -> Result<f64, String> {
    number_in(text, |value| value > 0.0, "more than 0")
}

/// Parses a number from 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    number_in(text, |value| (0.0..=1.0).contains(&value), "0 to 1")
}

/// Parses the number of texels along an edge of a cubemap.
pub fn cubemap_size(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if (1..=MAX_CUBEMAP_SIZE).contains(&n) => Ok(n),
        _ => Err(format!("invalid cubemap size `{text}`: expected 1 to {MAX_CUBEMAP_SIZE}")),
    }
}

/// Parses the number of texels along a side of an atlas.
pub fn texture_size(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if (1..=MOST_TEXELS).contains(&n) => Ok(n),
        _ => Err(format!("invalid size `{text}`: expected texels along a side, 1 to {MOST_TEXELS}")),
    }
}

/// Parses the number of samples of a texel: a square, so that they form a grid.
pub fn texel_samples(text: &str) -> Result<u32, String> {
    match text.trim().parse::<u32>() {
        Ok(n) if (1..=256).contains(&n) && n.isqrt().pow(2) == n => Ok(n),
        _ => {
            Err(format!("invalid number of samples `{text}`: expected a square number, 1 to 256, for example 4 or 16"))
        }
    }
}

/// Parses a number of rays.
pub fn rays(text: &str) -> Result<u32, String> {
    whole(text, 1..=65_536)
}

/// The value of `--density`.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    /// Of parts or a material.
    pub name: String,
    /// Relative to all others.
    pub factor: f64,
}

/// Parses a name and its texel density.
pub fn density(text: &str) -> Result<Density, String> {
    let expected = "expected NAME=FACTOR with a factor of 0.01 to 100, for example head=2";
    let (name, factor) = text.rsplit_once('=').ok_or_else(|| format!("invalid density `{text}`: {expected}"))?;
    match factor.trim().parse::<f64>() {
        Ok(factor) if (0.01..=100.0).contains(&factor) => Ok(Density { name: name.to_owned(), factor }),
        _ => Err(format!("invalid density `{text}`: {expected}")),
    }
}

/// Parses the distance between charts as a share of the side.
pub fn margin(text: &str) -> Result<f64, String> {
    number_in(text, |value| (0.0..=0.25).contains(&value), "a share of the side, 0 to 0.25")
}

/// Parses the largest angle between a triangle and the axis of its chart, in degrees.
pub fn chart_angle(text: &str) -> Result<f64, String> {
    number_in(text, |value| (1.0..=89.0).contains(&value), "1 to 89 degrees")
}

/// Parses a full field of view in degrees.
pub fn field_of_view(text: &str) -> Result<f64, String> {
    number_in(text, |value| value > 0.0 && value < 180.0, "more than 0 and less than 180 degrees")
}

/// Parses the angle between the normals of two faces, in degrees.
pub fn crease_angle(text: &str) -> Result<f64, String> {
    number_in(text, |value| (0.0..=180.0).contains(&value), "0 to 180 degrees")
}

/// Parses a number of frames per second.
pub fn frame_rate(text: &str) -> Result<f64, String> {
    number_in(text, |value| (0.02..=1000.0).contains(&value), "0.02 to 1000 frames per second")
}

/// Parses a number of bytes with an optional unit: KiB, MiB or GiB (K, M, G, KB, MB and GB mean the same).
pub fn bytes(text: &str) -> Result<u64, String> {
    let wrong = || format!("invalid size `{text}`: expected a number of bytes, for example 512MiB");
    let trimmed = text.trim();
    let digits = trimmed.len() - trimmed.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let (number, unit) = trimmed.split_at(digits);
    let shift = match unit.trim().to_ascii_lowercase().as_str() {
        "" | "b" => 0,
        "k" | "kb" | "kib" => 10,
        "m" | "mb" | "mib" => 20,
        "g" | "gb" | "gib" => 30,
        _ => return Err(wrong()),
    };
    let number: u64 = number.parse().map_err(|_| wrong())?;
    number.checked_mul(1 << shift).ok_or_else(wrong)
}

/// Parses `x,y,z`.
pub fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    numbers.try_into().map_err(|_| format!("invalid vector `{text}`: expected three numbers x,y,z"))
}

/// Parses `yaw,pitch,roll` in degrees.
pub fn angles(text: &str) -> Result<[f64; 3], String> {
    vector(text)
        .map_err(|_| format!("invalid rotation `{text}`: expected yaw,pitch,roll in degrees, for example 90,0,0"))
}

/// Parses `N` or `WxH`, each 1 to 32768.
pub fn environment_size(text: &str) -> Result<(u32, Option<u32>), String> {
    let wrong = || format!("invalid size `{text}`: expected N or WxH, 1 to 32768 each");
    let side = |text: &str| match text.trim().parse() {
        Ok(side @ 1..=32768) => Ok(side),
        _ => Err(wrong()),
    };
    match text.split_once(['x', 'X']) {
        Some((width, height)) => Ok((side(width)?, Some(side(height)?))),
        None => Ok((side(text)?, None)),
    }
}

/// Parses the bits per channel of a PNG.
pub fn bits(text: &str) -> Result<u8, String> {
    match text {
        "8" => Ok(8),
        "16" => Ok(16),
        _ => Err(format!("invalid bit depth `{text}`: expected 8 or 16 (.exr always has 32-bit floats)")),
    }
}

/// Parses `+Z`, `-x`, `y`, or a vector that is not 0.
pub fn up(text: &str) -> Result<[f64; 3], String> {
    let lower = text.trim().to_ascii_lowercase();
    let (sign, axis) = match lower.strip_prefix('-') {
        Some(axis) => (-1.0, axis),
        None => (1.0, lower.strip_prefix('+').unwrap_or(&lower)),
    };
    match axis {
        "x" => Ok([sign, 0.0, 0.0]),
        "y" => Ok([0.0, sign, 0.0]),
        "z" => Ok([0.0, 0.0, sign]),
        _ => match vector(text) {
            Ok([0.0, 0.0, 0.0]) => Err(format!("invalid axis `{text}`: the zero vector has no direction")),
            Ok(v) => Ok(v),
            Err(_) => Err(format!("invalid axis `{text}`: expected +X, -Z or a vector x,y,z")),
        },
    }
}

/// Parses the column and row of a pixel, from the top left.
pub fn pixel(text: &str) -> Result<(u32, u32), String> {
    let wrong = || format!("invalid pixel `{text}`: expected COLUMN,ROW, counted from 0 at the top left");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    Ok((x.trim().parse().map_err(|_| wrong())?, y.trim().parse().map_err(|_| wrong())?))
}

/// Parses the number of samples per pixel.
pub fn samples(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n @ (1 | 2 | 4 | 8 | 16)) => Ok(n),
        _ => Err(format!("invalid number of samples `{text}`: expected 1, 2, 4, 8 or 16")),
    }
}

/// Parses the number of paths per pixel.
pub fn paths(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if (1..=MAX_PATHS).contains(&n) => Ok(n),
        _ => Err(format!("invalid number of paths `{text}`: expected 1 to {MAX_PATHS}")),
    }
}

/// Parses a whole number in a range.
fn whole(text: &str, range: std::ops::RangeInclusive<u32>) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if range.contains(&n) => Ok(n),
        _ => Err(format!("invalid number `{text}`: expected a whole number from {} to {}", range.start(), range.end())),
    }
}

/// Parses the most surfaces that a path meets.
pub fn depth(text: &str) -> Result<u32, String> {
    whole(text, 1..=100_000)
}

/// Parses a number of points that replace a lamp.
pub fn points(text: &str) -> Result<u32, String> {
    whole(text, 1..=4096)
}

/// Parses a number of threads.
pub fn threads(text: &str) -> Result<u16, String> {
    whole(text, 1..=1024).map(|n| n as u16)
}

/// Parses a seed of random numbers.
pub fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("invalid seed `{text}`: expected a whole number from 0 to {}", u64::MAX))
}

/// Parses a duration in seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    number_in(text, |v| v > 0.0 && v <= 1e9, "seconds above 0, at most 1e9")
}

/// Parses a percentage.
pub fn percent(text: &str) -> Result<f64, String> {
    number_in(text.trim_end_matches('%'), |v| v > 0.0 && v <= 100.0, "a percentage above 0, at most 100")
}

/// Parses a radius in world units.
pub fn radius(text: &str) -> Result<f64, String> {
    number_in(text, |v| v >= 0.0, "0 or more")
}

/// Parses a distance in world units.
pub fn distance(text: &str) -> Result<f64, String> {
    number_in(text, |v| v > 0.0, "a number above 0")
}

/// Parses a number of frames.
pub fn frames(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if (1..=MAX_FRAMES).contains(&n) => Ok(n),
        _ => Err(format!("invalid number of frames `{text}`: expected 1 to {}", MAX_FRAMES)),
    }
}

/// Parses a debug view: `NAME`, `NAME:LIGHT` or a symbol.
pub fn view(text: &str) -> Result<ViewSpec, String> {
    ViewSpec::from_str(text).map_err(|message| {
        let name = text.split(':').next().unwrap_or(text).trim().to_lowercase();
        match nearest_word(&name, gonio_light::Quantity::ALL.iter().map(|q| q.name())) {
            Some(known) if known != name => format!("{message}; did you mean `{known}`?"),
            _ => message,
        }
    })
}

/// A value of `--debug`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DebugView {
    /// A quantity of the light equation.
    Quantity(ViewSpec),
    /// A view that only OpenGL draws.
    Special(SpecialView),
}

impl std::fmt::Display for DebugView {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            DebugView::Quantity(view) => view.fmt(f),
            DebugView::Special(view) => f.write_str(view.name()),
        }
    }
}

impl DebugView {
    pub fn quantity(self) -> Option<ViewSpec> {
        if let DebugView::Quantity(view) = self { Some(view) } else { None }
    }
}

/// Parses a debug view: like [`view`], or the name of a special view.
pub fn debug_view(text: &str) -> Result<DebugView, String> {
    let name = text.trim().to_lowercase();
    match SpecialView::ALL.iter().find(|special| special.name() == name) {
        Some(&special) => Ok(DebugView::Special(special)),
        None => view(text).map(DebugView::Quantity),
    }
}

/// A value of `--background`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackgroundValue {
    /// The colours at the top and at the bottom.
    Colors(Color, Color),
    Transparent,
}

/// Parses `COLOR`, `TOP:BOTTOM` or `transparent`.
pub fn background(text: &str) -> Result<BackgroundValue, String> {
    if text.eq_ignore_ascii_case("transparent") {
        return Ok(BackgroundValue::Transparent);
    }
    let (top, bottom) = text.split_once(':').unwrap_or((text, text));
    let color = |t: &str| t.parse::<Color>().map_err(|e| format!("{e}; or the word transparent"));
    Ok(BackgroundValue::Colors(color(top)?, color(bottom)?))
}

/// Checks the size of a picture. The error names the largest size.
fn check_size(width: u64, height: u64) -> Result<(), String> {
    if width == 0 || height == 0 {
        return Err(format!("a picture of {width}x{height} has no pixels: both sides must be at least 1"));
    }
    let side = u64::from(MAX_SIDE);
    if width > side || height > side || width * height > MAX_PIXELS {
        return Err(format!(
            "{width}x{height} is too large: a picture has at most {MAX_SIDE} pixels along a side and {MAX_PIXELS} \
             altogether, for example 8192x8192"
        ));
    }
    Ok(())
}

/// Most frames of an animation: as many as four digits can number.
const MAX_FRAMES: u32 = 9999;
/// The most paths per pixel.
const MAX_PATHS: u32 = 1_000_000_000;

/// A parser for a list of debug views.
pub fn view_list() -> clap::builder::ValueParser {
    clap::builder::ValueParser::from(view as fn(&str) -> Result<ViewSpec, String>)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(size("1024x768"), Ok((1024, 768)));
        assert!(size("1024").unwrap_err().contains("WIDTHxHEIGHT"));
        assert!(size("-1x5").unwrap_err().contains("WIDTHxHEIGHT"));
        assert!(size("99999999999999999999x2").unwrap_err().contains("16384"));
        assert!(size("0x5").unwrap_err().contains("no pixels"));
    }

    #[test]
    fn axes() {
        assert_eq!((up("+Z"), up("-x"), up("y")), (Ok([0.0, 0.0, 1.0]), Ok([-1.0, 0.0, 0.0]), Ok([0.0, 1.0, 0.0])));
        assert_eq!(up("0,1,1"), Ok([0.0, 1.0, 1.0]));
        assert!(["", "w", "0,0,0", "1,2"].iter().all(|wrong| up(wrong).is_err()));
    }

    #[test]
    fn sizes_in_bytes() {
        assert_eq!((bytes("7"), bytes("512MiB"), bytes("2 G")), (Ok(7), Ok(512 << 20), Ok(2 << 30)));
        for wrong in ["", "GiB", "-1", "1.5G", "1 parsec", "99999999999999999999", "99999999999999999G"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn backgrounds() {
        assert_eq!(background("0.5"), Ok(BackgroundValue::Colors(Color::grey(0.5), Color::grey(0.5))));
        assert_eq!(background("1,0,0:0"), Ok(BackgroundValue::Colors(Color([1.0, 0.0, 0.0]), Color::grey(0.0))));
        assert_eq!(background("Transparent"), Ok(BackgroundValue::Transparent));
        assert!(background("redd").unwrap_err().contains("transparent"));
    }

    #[test]
    fn views_and_their_nearest_names() {
        assert!(view("N").is_ok() && view("diffuse:1").is_ok());
        assert!(view("normals").unwrap_err().contains("did you mean `normal`"));
    }

    #[test]
    fn vectors_must_be_finite_and_three() {
        assert_eq!(vector("1,-2,3e1"), Ok([1.0, -2.0, 30.0]));
        assert!(vector("1,2").is_err() && vector("1,2,nan").is_err() && vector("a,b,c").is_err());
    }

    #[test]
    fn pictures_have_limits() {
        assert!(check_size(1, 1).is_ok());
        assert!(check_size(8192, 8192).is_ok());
        assert!(check_size(16384, 4096).is_ok());
        assert!(check_size(0, 10).is_err());
        assert!(check_size(8193, 8192).is_err());
        assert!(check_size(16385, 1).is_err());
        assert!(check_size(u64::from(u32::MAX), u64::from(u32::MAX)).is_err());
        assert!(check_size(100_000, 100_000).is_err_and(|e| e.contains("16384")));
    }
}
