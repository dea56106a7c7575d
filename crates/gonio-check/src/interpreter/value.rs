//! Values at many points at once.

use glam::Mat4;
use std::ops::Range;

/// Up to four numbers, or a matrix, at every point.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// The same at all points of a test scene: numbers, and how many of them count.
    Same(usize, Vec<[f32; 4]>),
    /// Others at every point: one plane a component.
    Each(Vec<Vec<f32>>),
    /// A matrix in each test scene; one of three columns is the upper left part.
    Matrix(usize, Vec<Mat4>),
}

/// Where the points of each test scene lie.
pub type Spans = [Range<usize>];

/// A component over a span: one number, or a slice.
enum Part<'a> {
    One(f32),
    Many(&'a [f32]),
}

impl Value {
    /// How many components there are.
    pub fn width(&self) -> usize {
        match self {
            Value::Same(width, _) | Value::Matrix(width, _) => *width,
            Value::Each(planes) => planes.len(),
        }
    }

    /// A number of every test scene.
    pub fn number(number: f32, test_scenes: usize) -> Self {
        Value::Same(1, vec![[number; 4]; test_scenes])
    }

    /// A single number stands for all components.
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

    /// A component over all points.
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

    /// These components, in this order.
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

    /// One number for each, component by component.
    pub fn map(&self, f: impl Fn(f32) -> f32 + Copy) -> Value {
        match self {
            Value::Same(width, numbers) => Value::Same(*width, numbers.iter().map(|n| n.map(f)).collect()),
            Value::Each(planes) => {
                Value::Each(planes.iter().map(|plane| plane.iter().map(|&x| f(x)).collect()).collect())
            }
            Value::Matrix(..) => self.clone(),
        }
    }

    /// Of two, component by component; a single number goes with each.
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

    /// The sum of the products of the components.
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

    /// A matrix times a matrix or a vector; `None` where this is no matrix.
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

    /// Where the condition is not 0 the one, else the other.
    pub fn select(&self, then: &Value, otherwise: &Value, spans: &Spans) -> Value {
        // No number stays no number: so the choice is made where both are known.
        let width = then.width().max(otherwise.width());
        let plane = |component: usize| {
            let condition = self.plane(0, spans);
            let (a, b) = (then.plane(component, spans), otherwise.plane(component, spans));
            condition.iter().zip(a.iter().zip(b)).map(|(c, (a, b))| if *c != 0.0 { *a } else { b }).collect()
        };
        Value::Each((0..width).map(plane).collect())
    }
}
