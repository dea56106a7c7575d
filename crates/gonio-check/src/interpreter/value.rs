//! Values at many points at once, and the GLSL functions on them (GLSL 3.30, chapter 8).

use glam::{Mat3, Mat4};
use std::ops::Range;

/// Up to four numbers, or a matrix, at every point.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// The same at all points of a test scene: the number of components, and the components.
    Same(usize, Vec<[f32; 4]>),
    /// Different at each point: one plane for each component.
    Each(Vec<Vec<f32>>),
    /// A matrix for each test scene; with three columns, the upper left part is used.
    Matrix(usize, Vec<Mat4>),
}

/// The range of points of each test scene.
pub type Spans = [Range<usize>];

/// A component over a span: one number, or a slice.
enum Part<'a> {
    One(f32),
    Many(&'a [f32]),
}

impl Value {
    /// Number of components.
    pub fn width(&self) -> usize {
        match self {
            Value::Same(width, _) | Value::Matrix(width, _) => *width,
            Value::Each(planes) => planes.len(),
        }
    }

    /// Creates a number that is the same in all test scenes.
    pub fn number(number: f32, test_scenes: usize) -> Self {
        Value::Same(1, vec![[number; 4]; test_scenes])
    }

    /// Returns a component over a range; a single number is repeated.
    fn part(&self, component: usize, test_scene: usize, span: &Range<usize>) -> Part<'_> {
        match self {
            Value::Same(width, numbers) => {
                let component = if *width == 1 { 0 } else { component.min(3) };
                Part::One(numbers.get(test_scene).map_or(0.0, |n| n[component]))
            }
            Value::Each(planes) => {
                let component = if planes.len() == 1 { 0 } else { component };
                Part::Many(planes.get(component).and_then(|plane| plane.get(span.clone())).unwrap_or_default())
            }
            Value::Matrix(..) => Part::One(0.0),
        }
    }

    /// Returns a component over all points.
    pub fn plane(&self, component: usize, spans: &Spans) -> Vec<f32> {
        if let Value::Each(planes) = self
            && let Some(plane) = planes.get(if planes.len() == 1 { 0 } else { component })
        {
            return plane.clone();
        }
        let mut plane = vec![0.0; spans.last().map_or(0, |last| last.end)];
        for (test_scene, span) in spans.iter().enumerate() {
            if let Part::One(number) = self.part(component, test_scene, span) {
                plane[span.clone()].fill(number);
            }
        }
        plane
    }

    /// Returns these components, in this order.
    pub fn swizzle(&self, components: &[usize]) -> Value {
        match self {
            Value::Same(_, numbers) => {
                let pick = |n: &[f32; 4]| std::array::from_fn(|i| components.get(i).map_or(0.0, |&c| n[c.min(3)]));
                Value::Same(components.len(), numbers.iter().map(pick).collect())
            }
            Value::Each(planes) => {
                Value::Each(components.iter().map(|&c| planes.get(c).cloned().unwrap_or_default()).collect())
            }
            Value::Matrix(..) => self.clone(),
        }
    }

    /// Applies a function to each component.
    pub fn map(&self, f: impl Fn(f32) -> f32 + Copy) -> Value {
        match self {
            Value::Same(width, numbers) => Value::Same(*width, numbers.iter().map(|n| n.map(f)).collect()),
            Value::Each(planes) => {
                Value::Each(planes.iter().map(|plane| plane.iter().map(|&x| f(x)).collect()).collect())
            }
            Value::Matrix(..) => self.clone(),
        }
    }

    /// Combines two values component by component; a single number is repeated.
    pub fn zip(&self, other: &Value, spans: &Spans, f: impl Fn(f32, f32) -> f32 + Copy) -> Value {
        let width = self.width().max(other.width());
        if let (Value::Same(wa, a), Value::Same(wb, b)) = (self, other) {
            let at = |n: &[f32; 4], width: usize, c: usize| n[if width == 1 { 0 } else { c }];
            let both = a.iter().zip(b).map(|(a, b)| std::array::from_fn(|c| f(at(a, *wa, c), at(b, *wb, c))));
            return Value::Same(width, both.collect());
        }
        let plane = |component: usize| {
            let mut plane = Vec::with_capacity(spans.last().map_or(0, |last| last.end));
            for (test_scene, span) in spans.iter().enumerate() {
                match (self.part(component, test_scene, span), other.part(component, test_scene, span)) {
                    (Part::Many(a), Part::Many(b)) => plane.extend(a.iter().zip(b).map(|(&a, &b)| f(a, b))),
                    (Part::Many(a), Part::One(b)) => plane.extend(a.iter().map(|&a| f(a, b))),
                    (Part::One(a), Part::Many(b)) => plane.extend(b.iter().map(|&b| f(a, b))),
                    (Part::One(a), Part::One(b)) => plane.extend(span.clone().map(|_| f(a, b))),
                }
            }
            plane
        };
        Value::Each((0..width).map(plane).collect())
    }

    /// Returns the dot product.
    pub fn dot(&self, other: &Value, spans: &Spans) -> Value {
        let product = self.zip(other, spans, |a, b| a * b);
        match product {
            Value::Same(width, numbers) => {
                let sum = |n: &[f32; 4]| [n.iter().take(width).sum::<f32>(); 4];
                Value::Same(1, numbers.iter().map(sum).collect())
            }
            Value::Each(planes) => {
                let mut planes = planes.into_iter();
                let mut sum = planes.next().unwrap_or_default();
                for plane in planes {
                    for (sum, x) in sum.iter_mut().zip(plane) {
                        *sum += x;
                    }
                }
                Value::Each(vec![sum])
            }
            Value::Matrix(..) => product,
        }
    }

    /// Multiplies a matrix by a matrix or a vector; `None` if `self` is not a matrix.
    pub fn transform(&self, other: &Value, spans: &Spans) -> Option<Value> {
        let Value::Matrix(size, matrices) = self else { return None };
        Some(match other {
            Value::Matrix(_, others) => {
                Value::Matrix(*size, matrices.iter().zip(others).map(|(a, b)| *a * *b).collect())
            }
            Value::Same(width, numbers) => {
                let times = |(m, n): (&Mat4, &[f32; 4])| {
                    let mut n = *n;
                    n.iter_mut().skip(*width).for_each(|x| *x = 0.0);
                    (*m * glam::Vec4::from_array(n)).to_array()
                };
                Value::Same(*width, matrices.iter().zip(numbers).map(times).collect())
            }
            Value::Each(planes) => {
                let width = planes.len();
                let row = |row: usize| {
                    let mut out = Vec::with_capacity(spans.last().map_or(0, |last| last.end));
                    for (matrix, span) in matrices.iter().zip(spans) {
                        let m = matrix.row(row).to_array();
                        let part = |c: usize| planes.get(c).and_then(|p| p.get(span.clone())).unwrap_or_default();
                        let (x, y, z, w) = (part(0), part(1), part(2), part(3));
                        for (i, x) in x.iter().enumerate() {
                            let rest = |part: &[f32], factor: f32| part.get(i).map_or(0.0, |p| p * factor);
                            out.push(m[0] * x + rest(y, m[1]) + rest(z, m[2]) + rest(w, m[3]));
                        }
                    }
                    out
                };
                Value::Each((0..width).map(row).collect())
            }
        })
    }

    /// Selects `then` where the condition is not 0, and `otherwise` elsewhere.
    pub fn select(&self, then: &Value, otherwise: &Value, spans: &Spans) -> Value {
        // Both are evaluated before the choice, because NaN must not spread to the other one.
        let width = then.width().max(otherwise.width());
        let plane = |component: usize| {
            let condition = self.plane(0, spans);
            let (a, b) = (then.plane(component, spans), otherwise.plane(component, spans));
            condition.iter().zip(a.iter().zip(b)).map(|(c, (a, b))| if *c != 0.0 { *a } else { b }).collect()
        };
        Value::Each((0..width).map(plane).collect())
    }
}

/// A function that model solutions may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinFunction {
    /// `normalize(v)`
    Normalize,
    /// `length(v)`
    Length,
    /// `distance(a, b)`
    Distance,
    /// `dot(a, b)`
    Dot,
    /// `reflect(i, n)`
    Reflect,
    /// `max(a, b)`
    Max,
    /// `min(a, b)`
    Min,
    /// `abs(x)`
    Abs,
    /// `pow(x, y)`
    Pow,
    /// `sqrt(x)`
    Sqrt,
    /// `clamp(x, low, high)`
    Clamp,
    /// `inverse(m)`
    Inverse,
    /// `transpose(m)`
    Transpose,
}

impl BuiltinFunction {
    /// Finds a function by its name.
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

    /// Number of arguments.
    pub fn arguments(self) -> usize {
        match self {
            Self::Normalize | Self::Length | Self::Abs | Self::Sqrt | Self::Inverse | Self::Transpose => 1,
            Self::Distance | Self::Dot | Self::Reflect | Self::Max | Self::Min | Self::Pow => 2,
            Self::Clamp => 3,
        }
    }

    /// Evaluates the function; `None` if the number of arguments is wrong.
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
            // Like drivers, prefer a number to NaN.
            (Self::Max, Some(b)) => a.zip(b, spans, f32::max),
            (Self::Min, Some(b)) => a.zip(b, spans, f32::min),
            // Like on drivers, the power of a negative number is NaN.
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

/// Evaluates `mat3(m)` or `mat4(m)`: the upper left part, extended by the identity.
pub fn resized(value: &Value, size: usize) -> Option<Value> {
    let Value::Matrix(_, matrices) = value else { return None };
    let resize = |m: &Mat4| if size == 3 { Mat4::from_mat3(Mat3::from_mat4(*m)) } else { *m };
    Some(Value::Matrix(size, matrices.iter().map(resize).collect()))
}
