//! The functions of GLSL that models are written with (GLSL 3.30, chapter 8).

use super::value::{Spans, Value};
use glam::{Mat3, Mat4};

/// A function that a model's text may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Length 1.
    Normalize,
    /// The square root of the sum of squares.
    Length,
    /// The length of the difference.
    Distance,
    /// The sum of products.
    Dot,
    /// Mirrored at a plane.
    Reflect,
    /// The larger.
    Max,
    /// The smaller.
    Min,
    /// Without sign.
    Abs,
    /// A power.
    Pow,
    /// A square root.
    Sqrt,
    /// Between two limits.
    Clamp,
    /// The inverse of a matrix.
    Inverse,
    /// Rows for columns.
    Transpose,
}

impl Function {
    /// By its name.
    pub fn by_name(name: &str) -> Option<Self> {
        Some(match name {
            "normalize" => Self::Normalize,
            "length" => Self::Length,
            "distance" => Self::Distance,
            "dot" => Self::Dot,
            "reflect" => Self::Reflect,
            "max" => Self::Max,
            "min" => Self::Min,
            "abs" => Self::Abs,
            "pow" => Self::Pow,
            "sqrt" => Self::Sqrt,
            "clamp" => Self::Clamp,
            "inverse" => Self::Inverse,
            "transpose" => Self::Transpose,
            _ => return None,
        })
    }

    /// How many arguments it takes.
    pub fn arguments(self) -> usize {
        match self {
            Self::Normalize | Self::Length | Self::Abs | Self::Sqrt | Self::Inverse | Self::Transpose => 1,
            Self::Distance | Self::Dot | Self::Reflect | Self::Max | Self::Min | Self::Pow => 2,
            Self::Clamp => 3,
        }
    }

    /// What it gives of these, of which there must be as many as it takes.
    pub fn call(self, arguments: &[std::rc::Rc<Value>], spans: &Spans) -> Option<Value> {
        let a: &Value = arguments.first()?;
        let length = |a: &Value| a.dot(a, spans).map(f32::sqrt);
        Some(match (self, arguments.get(1)) {
            (Self::Normalize, _) => {
                let inverse = length(a).map(|l| 1.0 / l);
                a.zip(&inverse, spans, |a, l| a * l)
            }
            (Self::Length, _) => length(a),
            (Self::Abs, _) => a.map(f32::abs),
            (Self::Sqrt, _) => a.map(f32::sqrt),
            (Self::Inverse, _) => matrices(a, Mat4::inverse)?,
            (Self::Transpose, _) => matrices(a, |m| m.transpose())?,
            (Self::Distance, Some(b)) => length(&a.zip(b, spans, |a, b| a - b)),
            (Self::Dot, Some(b)) => a.dot(b, spans),
            (Self::Reflect, Some(n)) => {
                let twice = a.dot(n, spans).map(|d| 2.0 * d);
                a.zip(&n.zip(&twice, spans, |n, d| n * d), spans, |a, n| a - n)
            }
            // As drivers have it, what is no number loses against one.
            (Self::Max, Some(b)) => a.zip(b, spans, f32::max),
            (Self::Min, Some(b)) => a.zip(b, spans, f32::min),
            // As drivers have it: the power of a negative number is no number.
            (Self::Pow, Some(b)) => a.zip(b, spans, |a, b| (b * a.log2()).exp2()),
            (Self::Clamp, Some(low)) => a.zip(low, spans, f32::max).zip(arguments.get(2)?, spans, f32::min),
            _ => return None,
        })
    }
}

fn matrices(value: &Value, f: impl Fn(&Mat4) -> Mat4) -> Option<Value> {
    let Value::Matrix(size, matrices) = value else { return None };
    Some(Value::Matrix(*size, matrices.iter().map(f).collect()))
}

/// `mat3(m)` or `mat4(m)`: the upper left part, filled up with 1.
pub fn resized(value: &Value, size: usize) -> Option<Value> {
    let Value::Matrix(_, matrices) = value else { return None };
    let resize = |m: &Mat4| if size == 3 { Mat4::from_mat3(Mat3::from_mat4(*m)) } else { *m };
    Some(Value::Matrix(size, matrices.iter().map(resize).collect()))
}
