//! A colour as a person writes it.

use gonio_light::color::srgb_decode;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

/// Linear RGB. Written as three linear numbers `[r, g, b]`, or as sRGB `"#rrggbb"`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Color(pub [f64; 3]);

impl Color {
    /// The same value in all three channels.
    pub const fn grey(v: f64) -> Color {
        Color([v, v, v])
    }
}

impl From<Color> for glam::DVec3 {
    fn from(c: Color) -> Self {
        glam::DVec3::from_array(c.0)
    }
}

impl FromStr for Color {
    type Err = String;

    /// `#rrggbb`, `#rgb`, `r,g,b` or one number for grey.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("invalid colour `{text}`: expected #rrggbb (sRGB), r,g,b (linear) or one linear number");
        let text = text.trim();
        if let Some(hex) = text.strip_prefix('#') {
            if !hex.is_ascii() {
                return Err(wrong());
            }
            let digits: Vec<f64> = match hex.len() {
                3 => hex.chars().map(|c| c.to_digit(16).map(|d| f64::from(d * 17))).collect::<Option<_>>(),
                6 => (0..3)
                    .map(|i| u8::from_str_radix(&hex[2 * i..2 * i + 2], 16).ok().map(f64::from))
                    .collect::<Option<_>>(),
                _ => None,
            }
            .ok_or_else(wrong)?;
            return Ok(Color([0, 1, 2].map(|i| srgb_decode(digits[i] / 255.0))));
        }
        let numbers: Vec<f64> =
            text.split(',').map(|t| t.trim().parse::<f64>()).collect::<Result<_, _>>().map_err(|_| wrong())?;
        if numbers.iter().any(|v| !v.is_finite() || *v < 0.0) {
            return Err(format!("invalid colour `{text}`: its numbers must be finite and not negative"));
        }
        match numbers[..] {
            [v] => Ok(Color::grey(v)),
            [r, g, b] => Ok(Color([r, g, b])),
            _ => Err(wrong()),
        }
    }
}

impl Serialize for Color {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(s)
    }
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        struct V;
        impl<'de> Visitor<'de> for V {
            type Value = Color;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a colour: [r, g, b] in linear light or \"#rrggbb\" in sRGB")
            }
            fn visit_str<E: de::Error>(self, v: &str) -> Result<Color, E> {
                v.parse().map_err(E::custom)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Color, A::Error> {
                let mut c = [0.0; 3];
                for (i, channel) in c.iter_mut().enumerate() {
                    *channel = seq.next_element()?.ok_or_else(|| de::Error::invalid_length(i, &self))?;
                }
                if seq.next_element::<f64>()?.is_some() {
                    return Err(de::Error::invalid_length(4, &self));
                }
                if c.iter().any(|v: &f64| !v.is_finite() || *v < 0.0) {
                    return Err(de::Error::custom("a colour's numbers must be finite and not negative"));
                }
                Ok(Color(c))
            }
        }
        d.deserialize_any(V)
    }
}

impl JsonSchema for Color {
    fn schema_name() -> Cow<'static, str> {
        "Color".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A colour: [r, g, b] in linear light, or \"#rrggbb\" in sRGB",
            "oneOf": [
                { "type": "array", "items": { "type": "number", "minimum": 0 }, "minItems": 3, "maxItems": 3 },
                { "type": "string", "pattern": "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$" }
            ]
        })
    }
}
