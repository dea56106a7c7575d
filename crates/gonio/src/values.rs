//! What stands after an option: sizes, vectors, colours. Lights and materials are read by
//! `gonio-scene`, whose keys they have.

use crate::limits;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use gonio_scene::color_value::Color;
use gonio_scene::validate::MAX_CUBEMAP_SIZE;
use gonio_scene::{SpecialView, ViewSpec};
use std::str::FromStr;

/// A parser for one of gonio's named enums: names, help texts and "did you mean" from one place.
pub fn named<T>(all: &'static [T], name: fn(T) -> &'static str) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    PossibleValuesParser::new(all.iter().map(move |&v| PossibleValue::new(name(v)))).map(move |text| {
        // The parser before has let only known names through.
        all.iter().copied().find(|&v| name(v).eq_ignore_ascii_case(&text)).unwrap_or(all[0])
    })
}

/// `WxH`, checked against the largest picture.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong = || format!("`{text}` is no size; WIDTHxHEIGHT is wanted, 1024x768 for example");
    let (w, h) = text.split_once(['x', 'X', '*']).ok_or_else(wrong)?;
    let side = |t: &str| {
        let t = t.trim();
        // A number that does not fit is a large size, not a wrong one.
        if !t.is_empty() && t.bytes().all(|b| b.is_ascii_digit()) {
            Ok(t.parse().unwrap_or(u64::MAX))
        } else {
            Err(wrong())
        }
    };
    let (w, h) = (side(w)?, side(h)?);
    limits::check_size(w, h)?;
    Ok((w as u32, h as u32))
}

/// A finite number.
pub fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(v) if v.is_finite() => Ok(v),
        Ok(_) => Err(format!("`{text}` is not finite")),
        Err(_) => Err(format!("`{text}` is no number")),
    }
}

/// A finite number, not negative.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| if v >= 0.0 { Ok(v) } else { Err(format!("`{text}` must not be negative")) })
}

/// A finite number greater than 0.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| if v > 0.0 { Ok(v) } else { Err(format!("`{text}` must be greater than 0")) })
}

/// A number from 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| if (0.0..=1.0).contains(&v) { Ok(v) } else { Err(format!("`{text}` must be 0 to 1")) })
}

/// Texels along an edge of a cubemap.
pub fn cubemap_size(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if (1..=MAX_CUBEMAP_SIZE).contains(&n) => Ok(n),
        _ => Err(format!("`{text}` is no size of a cubemap; 1 to {MAX_CUBEMAP_SIZE} is wanted")),
    }
}

/// A full field of view in degrees.
pub fn field_of_view(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| {
        if v > 0.0 && v < 180.0 { Ok(v) } else { Err(format!("`{text}` must be greater than 0 and less than 180")) }
    })
}

/// An angle between the normals of two faces, in degrees.
pub fn crease_angle(text: &str) -> Result<f64, String> {
    number(text)
        .and_then(|v| if (0.0..=180.0).contains(&v) { Ok(v) } else { Err(format!("`{text}` must be from 0 to 180")) })
}

/// A number of bytes, perhaps with KiB, MiB or GiB (also K, M, G, KB, MB, GB, which mean the same).
pub fn bytes(text: &str) -> Result<u64, String> {
    let wrong = || format!("`{text}` is no size; a number of bytes is wanted, 512MiB for example");
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

/// `x,y,z`.
pub fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    numbers.try_into().map_err(|_| format!("`{text}` is no vector; three numbers x,y,z are wanted"))
}

/// `yaw,pitch,roll` in degrees.
pub fn angles(text: &str) -> Result<[f64; 3], String> {
    vector(text).map_err(|_| format!("`{text}` is no rotation; yaw,pitch,roll in degrees are wanted, such as 90,0,0"))
}

/// `N` or `WxH`, each 1 to 32768.
pub fn environment_size(text: &str) -> Result<(u32, Option<u32>), String> {
    let wrong = || format!("`{text}` is no size; N or WxH is wanted, 1 to 32768");
    let side = |text: &str| match text.trim().parse() {
        Ok(side @ 1..=32768) => Ok(side),
        _ => Err(wrong()),
    };
    match text.split_once(['x', 'X']) {
        Some((width, height)) => Ok((side(width)?, Some(side(height)?))),
        None => Ok((side(text)?, None)),
    }
}

/// Bits a channel of PNG.
pub fn bits(text: &str) -> Result<u8, String> {
    match text {
        "8" => Ok(8),
        "16" => Ok(16),
        _ => Err(format!("`{text}` is no depth of .png; 8 or 16 is wanted (.exr always has 32-bit floats)")),
    }
}

/// `+Z`, `-x`, `y`, or a vector that is not 0.
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
            Ok([0.0, 0.0, 0.0]) => Err(format!("`{text}` is no direction")),
            Ok(v) => Ok(v),
            Err(_) => Err(format!("`{text}` is no axis; +X, -Z or a vector x,y,z is wanted")),
        },
    }
}

/// `X,Y` of a pixel, from the top left.
pub fn pixel(text: &str) -> Result<(u32, u32), String> {
    let wrong = || format!("`{text}` is no pixel; COLUMN,ROW is wanted, from 0 at the top left");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    Ok((x.trim().parse().map_err(|_| wrong())?, y.trim().parse().map_err(|_| wrong())?))
}

/// Samples per pixel.
pub fn samples(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n @ (1 | 2 | 4 | 8 | 16)) => Ok(n),
        _ => Err(format!("`{text}` is no number of samples; 1, 2, 4, 8 or 16 is wanted")),
    }
}

/// A number of frames.
pub fn frames(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if (1..=limits::MAX_FRAMES).contains(&n) => Ok(n),
        _ => Err(format!("`{text}` is no number of frames; 1 to {} is wanted", limits::MAX_FRAMES)),
    }
}

/// A debug view: `NAME`, `NAME:LIGHT` or a symbol.
pub fn view(text: &str) -> Result<ViewSpec, String> {
    ViewSpec::from_str(text).map_err(|message| {
        let name = text.split(':').next().unwrap_or(text).trim().to_lowercase();
        match nearest(&name, gonio_light::Quantity::ALL.iter().map(|q| q.name())) {
            Some(known) if known != name => format!("{message}; did you mean `{known}`?"),
            _ => message,
        }
    })
}

/// What `--debug` takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DebugView {
    /// A quantity of the equation.
    Quantity(ViewSpec),
    /// Another view.
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
    /// The quantity, where it is one.
    pub fn quantity(self) -> Option<ViewSpec> {
        if let DebugView::Quantity(view) = self { Some(view) } else { None }
    }
}

/// A debug view: what [`view`] takes, or the name of a special one.
pub fn debug_view(text: &str) -> Result<DebugView, String> {
    let name = text.trim().to_lowercase();
    match SpecialView::ALL.iter().find(|special| special.name() == name) {
        Some(&special) => Ok(DebugView::Special(special)),
        None => view(text).map(DebugView::Quantity),
    }
}

/// What `--background` takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackgroundValue {
    /// At the top and at the bottom.
    Colors(Color, Color),
    /// Nothing.
    Transparent,
}

/// `COLOR`, `TOP:BOTTOM` or `transparent`.
pub fn background(text: &str) -> Result<BackgroundValue, String> {
    if text.eq_ignore_ascii_case("transparent") {
        return Ok(BackgroundValue::Transparent);
    }
    let (top, bottom) = text.split_once(':').unwrap_or((text, text));
    let color = |t: &str| t.parse::<Color>().map_err(|e| format!("{e}; or the word transparent"));
    Ok(BackgroundValue::Colors(color(top)?, color(bottom)?))
}

/// The known word that `given` was probably meant to be: a letter in three may be wrong, or the end
/// missing.
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    let allowed = (given.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|word| (strsim::damerau_levenshtein(&given, word), word))
        .filter(|(distance, word)| *distance <= allowed || (given.len() >= 3 && word.starts_with(&given)))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word)
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
}
