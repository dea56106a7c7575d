//! What stands after an option: sizes, vectors, colours, lights, materials.

use crate::limits;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use gonio_scene::ViewSpec;
use gonio_scene::color_value::Color;
use gonio_scene::description::{LightSpec, MaterialOverride};
use serde::de::DeserializeOwned;
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

/// A full field of view in degrees.
pub fn field_of_view(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| {
        if v > 0.0 && v < 180.0 { Ok(v) } else { Err(format!("`{text}` must be greater than 0 and less than 180")) }
    })
}

/// `x,y,z`.
pub fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    numbers.try_into().map_err(|_| format!("`{text}` is no vector; three numbers x,y,z are wanted"))
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

/// `KIND key=value ...`: the keys of a `[[light]]` in a scene file, `-` or `_` alike.
///
/// A motion is written `motion=circle` with its keys beside it: `period`, `amplitude`, `center`,
/// `axis`, `points=x,y,z;x,y,z;...`.
pub fn light(text: &str) -> Result<LightSpec, String> {
    const OF_MOTION: [&str; 5] = ["period", "amplitude", "center", "axis", "points"];
    let (kind, pairs) = key_values(text, char::is_whitespace)?;
    let kind = kind
        .ok_or_else(|| format!("`{text}` does not begin with a kind of light: ambient, directional, point or spot"))?;
    let mut table = toml::Table::new();
    table.insert("kind".into(), kind.into());
    let mut motion = toml::Table::new();
    for (key, value) in pairs {
        if key == "motion" {
            motion.insert("kind".into(), value.into());
        } else if OF_MOTION.contains(&key.as_str()) {
            motion.insert(key, toml_value(value));
        } else if key == "name" {
            table.insert(key, value.into());
        } else {
            table.insert(key, toml_value(value));
        }
    }
    if !motion.is_empty() {
        if !motion.contains_key("kind") {
            return Err("a light that moves needs motion=oscillate, motion=circle or motion=path".into());
        }
        table.insert("motion".into(), motion.into());
    }
    deserialized(table)
}

/// `key=value,...`: the keys of an object's `material` in a scene file.
pub fn material(text: &str) -> Result<MaterialOverride, String> {
    let (stray, pairs) = key_values(text, |c: char| c.is_whitespace() || c == ',')?;
    if let Some(stray) = stray {
        return Err(format!("`{stray}` has no value; key=value is wanted, shininess=32 for example"));
    }
    deserialized(pairs.into_iter().map(|(key, value)| (key, toml_value(value))).collect())
}

/// Splits into `key=value` pairs; a piece without `=` belongs to the value before it (`1,2,3`), or
/// comes back as the first result where none is before it.
#[allow(clippy::type_complexity)]
fn key_values(text: &str, separator: impl Fn(char) -> bool) -> Result<(Option<String>, Vec<(String, String)>), String> {
    let mut first = None;
    let mut pairs: Vec<(String, String)> = Vec::new();
    for piece in text.split(separator).filter(|p| !p.is_empty()) {
        match piece.split_once('=') {
            Some((key, value)) => {
                let key = key.trim().replace('-', "_");
                if pairs.iter().any(|(known, _)| *known == key) {
                    return Err(format!("`{key}` is given twice"));
                }
                pairs.push((key, value.trim().to_owned()));
            }
            None => match pairs.last_mut() {
                Some((_, value)) => {
                    if !value.is_empty() && !value.ends_with(',') && !piece.starts_with(',') {
                        value.push(',');
                    }
                    value.push_str(piece);
                }
                None if first.is_none() => first = Some(piece.to_owned()),
                None => return Err(format!("`{piece}` has no value; key=value is wanted")),
            },
        }
    }
    if let Some((key, _)) = pairs.iter().find(|(_, value)| value.is_empty()) {
        return Err(format!("`{key}` has no value"));
    }
    Ok((first, pairs))
}

/// `1` a number, `1,2,3` an array, `a;b` an array of arrays, `true`/`false`, else text.
fn toml_value(text: String) -> toml::Value {
    if text.contains(';') {
        return toml::Value::Array(
            text.split(';').filter(|t| !t.is_empty()).map(|t| toml_value(t.to_owned())).collect(),
        );
    }
    if let Ok(flag) = text.parse::<bool>() {
        return flag.into();
    }
    let numbers: Option<Vec<f64>> = text.split(',').map(|t| t.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some([number]) => (*number).into(),
        Some(numbers) => numbers.iter().copied().map(toml::Value::from).collect::<Vec<_>>().into(),
        None => text.into(),
    }
}

/// The same types and the same words as in a scene file.
fn deserialized<T: DeserializeOwned>(mut table: toml::Table) -> Result<T, String> {
    // A colour of one number is grey here, as in every other option.
    for key in ["color", "ambient", "diffuse", "specular", "emitted"] {
        if let Some(value) = table.get_mut(key)
            && let Some(grey) = value.as_float()
        {
            *value = vec![toml::Value::from(grey); 3].into();
        }
    }
    T::deserialize(toml::Value::Table(table)).map_err(|error: toml::de::Error| {
        let message = error.message().trim().to_owned();
        let mut quoted = message.split('`').skip(1).step_by(2);
        match (message.starts_with("unknown"), quoted.next()) {
            (true, Some(given)) => match nearest(given, quoted) {
                Some(known) => format!("{message}; did you mean `{known}`?"),
                None => message,
            },
            _ => message,
        }
    })
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
    use gonio_scene::description::{LightSourceKind, MotionKind};

    #[test]
    fn a_light_takes_the_keys_of_a_scene_file() {
        let spec = light(
            "spot name=key position=1,2,3 direction=0,-1,0 color=#ffffff intensity=2 inner-angle=10 quadratic=0.5",
        )
        .unwrap();
        assert_eq!(spec.kind, LightSourceKind::Spot);
        assert_eq!(spec.name, "key");
        assert_eq!(spec.position, Some([1.0, 2.0, 3.0]));
        assert_eq!(spec.color, Some(Color([1.0; 3])));
        assert_eq!(spec.intensity, Some(2.0));
        assert_eq!(spec.inner_angle, Some(10.0));
        assert_eq!(spec.quadratic, Some(0.5));
    }

    #[test]
    fn blanks_after_commas_and_grey_colours_are_understood() {
        let spec = light("point position=1, -2, 3 color=0.5").unwrap();
        assert_eq!(spec.position, Some([1.0, -2.0, 3.0]));
        assert_eq!(spec.color, Some(Color::grey(0.5)));
    }

    #[test]
    fn a_motion_stands_beside_its_light() {
        let spec = light("point position=1,0,0 motion=path period=4 points=0,0,0;1,0,0;1,1,0").unwrap();
        let motion = spec.motion.unwrap();
        assert_eq!(motion.kind, MotionKind::Path);
        assert_eq!(motion.period, 4.0);
        assert_eq!(motion.points.unwrap().len(), 3);
        assert!(light("point position=1,0,0 period=4").unwrap_err().contains("motion=circle"));
    }

    #[test]
    fn a_wrong_key_is_told_the_right_one() {
        assert!(light("point colour=1,1,1").unwrap_err().contains("did you mean `color`"));
        assert!(light("pont position=1,1,1").unwrap_err().contains("did you mean `point`"));
        assert!(light("position=1,1,1").unwrap_err().contains("kind of light"));
        assert!(light("point position=1,1,1 position=1,1,1").unwrap_err().contains("twice"));
        assert!(light("point position=").unwrap_err().contains("no value"));
        assert!(material("shinyness=3").unwrap_err().contains("did you mean `shininess`"));
    }

    #[test]
    fn a_material_takes_several_keys() {
        let m = material("diffuse=1,0.5,0,shininess=32, textures=false").unwrap();
        assert_eq!(m.diffuse, Some(Color([1.0, 0.5, 0.0])));
        assert_eq!(m.shininess, Some(32.0));
        assert_eq!(m.textures, Some(false));
        assert_eq!(material("specular=0.3").unwrap().specular, Some(Color::grey(0.3)));
    }

    #[test]
    fn sizes() {
        assert_eq!(size("1024x768"), Ok((1024, 768)));
        assert!(size("1024").unwrap_err().contains("WIDTHxHEIGHT"));
        assert!(size("-1x5").unwrap_err().contains("WIDTHxHEIGHT"));
        assert!(size("99999999999999999999x2").unwrap_err().contains("16384"));
        assert!(size("0x5").unwrap_err().contains("no pixels"));
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
