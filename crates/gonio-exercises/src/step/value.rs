//! Values of shader variables as people read them.

use gonio_glsl::{Checked, Scalar, Type, builtin_structs};
use gonio_language::tr;
use serde_json::{Map, json};
use std::collections::HashMap;
use std::fmt;

/// A value of any type of GLSL.
#[derive(Clone, Debug, PartialEq)]
pub enum ShownValue {
    /// `float`
    Float(f32),
    /// `int`
    Int(i32),
    /// `uint`, or the texture unit of a sampler.
    UInt(u32),
    /// `bool`
    Bool(bool),
    /// A component that was never written, or was computed from one that was not.
    Unwritten,
    /// The components of a vector.
    Vector(Vec<ShownValue>),
    /// The rows of a matrix.
    Matrix(Vec<Vec<ShownValue>>),
    /// The elements of an array, at most 16, and their number.
    Array(Vec<ShownValue>, u32),
    /// The members of a struct.
    Struct(Vec<(String, ShownValue)>),
}

/// Elements of an array that are shown.
const MOST_ELEMENTS: u32 = 16;

/// The members of each struct that a shader knows.
#[derive(Clone, Debug, Default)]
pub(super) struct StructTypes(HashMap<String, Vec<(String, Option<Type>)>>);

impl StructTypes {
    pub fn new(checked: &Checked) -> Self {
        let all = builtin_structs().iter().chain(&checked.interface.structs);
        Self(all.map(|found| (found.name.clone(), found.members.clone())).collect())
    }

    /// A value from its scalars in the order of OpenGL: matrices by columns, arrays and structs member by member.
    pub fn value(&self, ty: &Type, bits: &[u32], is_written: impl Fn(usize) -> bool) -> ShownValue {
        self.read(ty, bits, &mut 0, &is_written, 0)
    }

    fn read(
        &self,
        ty: &Type,
        bits: &[u32],
        at: &mut usize,
        is_written: &dyn Fn(usize) -> bool,
        nested: u32,
    ) -> ShownValue {
        let mut scalar = |scalar: Scalar| {
            let value = match bits.get(*at).filter(|_| is_written(*at)) {
                None => ShownValue::Unwritten,
                Some(bits) => match scalar {
                    Scalar::Float | Scalar::Double => ShownValue::Float(f32::from_bits(*bits)),
                    Scalar::Int => ShownValue::Int(*bits as i32),
                    Scalar::UInt => ShownValue::UInt(*bits),
                    Scalar::Bool => ShownValue::Bool(*bits != 0),
                },
            };
            *at += 1;
            value
        };
        match ty {
            Type::Scalar(of) => scalar(*of),
            Type::Vector(of, size) => ShownValue::Vector((0..*size).map(|_| scalar(*of)).collect()),
            Type::Matrix { scalar: of, columns, rows } => {
                let mut shown = vec![Vec::new(); usize::from(*rows)];
                for _ in 0..*columns {
                    shown.iter_mut().for_each(|row| row.push(scalar(*of)));
                }
                ShownValue::Matrix(shown)
            }
            Type::Opaque(_) => scalar(Scalar::UInt),
            Type::Array(of, count) if nested < 80 => {
                let count = count.unwrap_or(1);
                let elements = (0..count.min(MOST_ELEMENTS)).map(|_| self.read(of, bits, at, is_written, nested + 1));
                ShownValue::Array(elements.collect(), count)
            }
            Type::Struct(name) if nested < 80 => {
                let members = self.0.get(name).into_iter().flatten();
                let member = |(name, ty): &(String, Option<Type>)| {
                    let value = ty.as_ref().map(|ty| self.read(ty, bits, at, is_written, nested + 1));
                    (name.clone(), value.unwrap_or(ShownValue::Unwritten))
                };
                ShownValue::Struct(members.map(member).collect())
            }
            _ => ShownValue::Unwritten,
        }
    }
}

impl ShownValue {
    /// Its parts; none if it is a scalar.
    fn parts(&self) -> Vec<&ShownValue> {
        match self {
            Self::Vector(parts) | Self::Array(parts, _) => parts.iter().collect(),
            Self::Matrix(rows) => rows.iter().flatten().collect(),
            Self::Struct(members) => members.iter().map(|(_, value)| value).collect(),
            _ => Vec::new(),
        }
    }

    /// Whether every part of it is [`ShownValue::Unwritten`].
    #[must_use]
    pub fn is_unwritten(&self) -> bool {
        let parts = self.parts();
        if parts.is_empty() { *self == Self::Unwritten } else { parts.into_iter().all(Self::is_unwritten) }
    }

    /// Whether a part of it is [`ShownValue::Unwritten`].
    #[must_use]
    pub fn is_partly_unwritten(&self) -> bool {
        *self == Self::Unwritten || self.parts().into_iter().any(Self::is_partly_unwritten)
    }

    /// Whether a part of it is infinite or NaN.
    #[must_use]
    pub fn is_non_finite(&self) -> bool {
        match self {
            Self::Float(x) => !x.is_finite(),
            _ => self.parts().into_iter().any(Self::is_non_finite),
        }
    }

    /// The value for JSON: numbers, booleans, arrays (matrices by rows) and objects; `null` where it is undefined, and
    /// `"NaN"`, `"inf"` and `"-inf"`, which JSON has no numbers for.
    #[must_use]
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            // The shortest decimal number that is this float.
            Self::Float(x) if x.is_finite() => json!(x.to_string().parse::<f64>().unwrap_or(f64::from(*x))),
            Self::Float(x) => json!(x.to_string()),
            Self::Int(x) => json!(x),
            Self::UInt(x) => json!(x),
            Self::Bool(x) => json!(x),
            Self::Unwritten => serde_json::Value::Null,
            Self::Vector(parts) | Self::Array(parts, _) => parts.iter().map(Self::to_json).collect(),
            Self::Matrix(rows) => {
                rows.iter().map(|row| row.iter().map(Self::to_json).collect::<serde_json::Value>()).collect()
            }
            Self::Struct(members) => {
                let members = members.iter().map(|(name, value)| (name.clone(), value.to_json()));
                serde_json::Value::Object(members.collect::<Map<_, _>>())
            }
        }
    }
}

/// Five significant digits.
pub(super) fn float_text(x: f32) -> String {
    if !x.is_finite() || x == 0.0 {
        return if x == 0.0 { "0".to_owned() } else { x.to_string() };
    }
    let magnitude = x.abs().log10().floor() as i32;
    if !(-4..=6).contains(&magnitude) {
        return format!("{x:.4e}");
    }
    let text = format!("{x:.*}", (4 - magnitude).clamp(0, 8) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

impl fmt::Display for ShownValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_unwritten() {
            return f.write_str("undefined");
        }
        self.write(f)
    }
}

impl ShownValue {
    fn write(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |f: &mut fmt::Formatter<'_>, parts: &[ShownValue]| {
            for (index, part) in parts.iter().enumerate() {
                f.write_str(if index == 0 { "" } else { ", " })?;
                part.write(f)?;
            }
            Ok(())
        };
        match self {
            Self::Float(x) => f.write_str(&float_text(*x)),
            Self::Int(x) => write!(f, "{x}"),
            Self::UInt(x) => write!(f, "{x}"),
            Self::Bool(x) => write!(f, "{x}"),
            Self::Unwritten => f.write_str("?"),
            Self::Vector(parts) => {
                f.write_str("(")?;
                list(f, parts)?;
                f.write_str(")")
            }
            Self::Matrix(rows) => {
                for (index, row) in rows.iter().enumerate() {
                    f.write_str(if index == 0 { "[" } else { "; " })?;
                    list(f, row)?;
                }
                f.write_str("]")
            }
            Self::Array(parts, count) => {
                f.write_str("{")?;
                list(f, parts)?;
                let left = (*count as usize).saturating_sub(parts.len());
                if left > 0 {
                    f.write_str(&tr!("check-step-and-more", left = left))?;
                }
                f.write_str("}")
            }
            Self::Struct(members) => {
                for (index, (name, value)) in members.iter().enumerate() {
                    write!(f, "{}{name}: ", if index == 0 { "{" } else { ", " })?;
                    value.write(f)?;
                }
                f.write_str("}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_all_types_are_written_as_people_read_them() {
        let structs = StructTypes(
            [("S".to_owned(), vec![("a".to_owned(), Some(Type::FLOAT)), ("b".to_owned(), Some(Type::BOOL))])].into(),
        );
        let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let shown = |ty: &Type, bits: &[u32]| structs.value(ty, bits, |_| true);
        // Columns in memory, rows on paper.
        let matrix = shown(&Type::Matrix { scalar: Scalar::Float, columns: 2, rows: 2 }, &bits(&[1.0, 2.0, 3.0, 4.0]));
        assert_eq!(matrix.to_string(), "[1, 3; 2, 4]");
        assert_eq!(matrix.to_json(), json!([[1.0, 3.0], [2.0, 4.0]]));
        let some = structs.value(&Type::floats(3), &bits(&[0.1, 0.0, f32::NAN]), |at| at != 1);
        assert_eq!((some.to_string(), some.to_json()), ("(0.1, ?, NaN)".to_owned(), json!([0.1, null, "NaN"])));
        assert!(some.is_non_finite() && some.is_partly_unwritten() && !some.is_unwritten());
        assert!(!matrix.is_partly_unwritten());
        let object = shown(&Type::Struct("S".into()), &[2.5_f32.to_bits(), 1]);
        assert_eq!(
            (object.to_string(), object.to_json()),
            ("{a: 2.5, b: true}".to_owned(), json!({"a": 2.5, "b": true}))
        );
        let long = shown(&Type::Array(Box::new(Type::INT), Some(18)), &(0..18).collect::<Vec<_>>());
        assert!(long.to_string().ends_with("14, 15, and 2 more}"), "{long}");
        assert_eq!(structs.value(&Type::floats(2), &[0, 0], |_| false).to_string(), "undefined");
        for (x, text) in
            [(-1.5, "-1.5"), (0.577_350_26, "0.57735"), (1e-9, "1.0000e-9"), (123_456.0, "123456"), (32.0, "32")]
        {
            assert_eq!(float_text(x), text);
        }
        assert_eq!(float_text(f32::NEG_INFINITY), "-inf");
    }
}
