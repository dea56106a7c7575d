//! Analyses a view matrix that a program builds itself: the meaning of each of its components.

use super::graph::{Graph, Id, Op, component};
use super::reading::Reading;
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;

/// A vector that a view matrix is built from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    Right,
    Up,
    Front,
    /// The given up vector, which is only roughly upwards.
    GivenUp,
    /// The position of the camera.
    Eye,
    /// The point that the camera looks at.
    Target,
    /// The sum of Front and a position.
    Mixed,
}

/// A component of a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value {
    /// A component of an axis, with its sign.
    Of(Axis, f64, usize),
    /// The dot product of an axis with the camera's position, with its sign.
    Dot(Axis, f64),
    Number(f64),
}

/// A component of a matrix and the node that determines it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    pub at: Id,
    pub value: Value,
}

/// Most levels of recursion.
const DEEPEST: usize = 60;

impl Reading {
    /// Returns the axis that a node is, and its sign.
    pub(crate) fn axis(&self, id: Id) -> Option<(Axis, f64)> {
        self.axis_within(id, DEEPEST)
    }

    fn axis_within(&self, id: Id, depth: usize) -> Option<(Axis, f64)> {
        let depth = depth.checked_sub(1)?;
        let of = |id: &Id| self.axis_within(*id, depth);
        let graph = &self.graph;
        match graph.op(id) {
            Op::Input { role, .. } => Some((
                match (*role)? {
                    Role::ViewPos => Axis::Eye,
                    Role::ViewFront => Axis::Front,
                    Role::WorldUp => Axis::GivenUp,
                    Role::ViewUp => Axis::Up,
                    Role::ViewRight => Axis::Right,
                    Role::ViewTarget => Axis::Target,
                    _ => return None,
                },
                1.0,
            )),
            Op::Copy(inner, _) | Op::Interpolated(inner) => of(inner),
            Op::Swizzle(inner, letters) if super::graph::is_leading(letters) => of(inner),
            Op::Neg(inner) => of(inner).map(|(axis, sign)| (axis, -sign)),
            Op::Binary(BinaryOp::Multiply | BinaryOp::Divide, a, b) if !graph.node(*a).is_matrix => {
                let (axis, number) = if graph.node(*b).width == 1 { (a, b) } else { (b, a) };
                let (found, sign) = of(axis)?;
                match graph.scalar(*number) {
                    Some(number) => Some((found, sign * number.signum())),
                    // It may be divided by its own length.
                    None => Some((found, sign)),
                }
            }
            Op::Binary(BinaryOp::Subtract, a, b) => match (of(a)?, of(b)?) {
                ((Axis::Target, _), (Axis::Eye, _)) => Some((Axis::Front, 1.0)),
                ((Axis::Eye, _), (Axis::Target, _)) => Some((Axis::Front, -1.0)),
                ((Axis::Front, _), (Axis::Eye, _)) => Some((Axis::Mixed, 1.0)),
                ((Axis::Eye, _), (Axis::Front, _)) => Some((Axis::Mixed, -1.0)),
                // Gram-Schmidt: up without its part along Front.
                ((Axis::GivenUp, sign), _) => Some((Axis::Up, sign)),
                _ => None,
            },
            Op::Binary(BinaryOp::Add, a, b) => match (of(a)?.0, of(b)?.0) {
                (Axis::Eye, Axis::Front) | (Axis::Front, Axis::Eye) => Some((Axis::Mixed, 1.0)),
                _ => None,
            },
            Op::Call(name, parts) => match (name.as_str(), parts.as_slice()) {
                ("normalize", [inner]) => of(inner),
                ("cross", [a, b]) => cross(of(a)?, of(b)?),
                _ => None,
            },
            Op::Construct(parts) if !graph.node(id).is_matrix => match parts.as_slice() {
                [one] => of(one),
                [first, last] if graph.node(*first).width == 3 && graph.node(*last).width == 1 => of(first),
                _ => self.made_of_angles(id),
            },
            _ => None,
        }
    }

    /// Returns Front if it is computed from yaw and pitch.
    fn made_of_angles(&self, id: Id) -> Option<(Axis, f64)> {
        let mistakes = self.graph.reachable(&[id], |_| true);
        mistakes.iter().any(|id| self.role(*id) == Some(Role::Yaw)).then_some((Axis::Front, 1.0))
    }

    /// Returns the component of a matrix in a column and a row.
    pub(crate) fn entry(&self, matrix: Id, column: usize, row: usize) -> Option<Entry> {
        self.entry_within(matrix, column, row, DEEPEST)
    }

    fn entry_within(&self, id: Id, column: usize, row: usize, depth: usize) -> Option<Entry> {
        let depth = depth.checked_sub(1)?;
        let graph = &self.graph;
        match graph.op(id) {
            Op::Copy(inner, _) => self.entry_within(*inner, column, row, depth),
            Op::Call(name, parts) if name == "transpose" => self.entry_within(*parts.first()?, row, column, depth),
            Op::Write(before, index, value) if graph.node(id).is_matrix => match *index == format!("[{column}]") {
                true => self.part(*value, row, depth),
                false => self.entry_within(*before, column, row, depth),
            },
            Op::Construct(parts) if graph.node(id).is_matrix => {
                let side = match graph.node(id).width {
                    9 => 3,
                    16 => 4,
                    _ => return None,
                };
                if let [one] = parts.as_slice() {
                    let inner = graph.node(*one);
                    let number = |value| Some(Entry { at: id, value: Value::Number(value) });
                    if inner.is_matrix {
                        let inner_side = if inner.width == 9 { 3 } else { 4 };
                        let is_within = column < inner_side && row < inner_side;
                        let one = if column == row { 1.0 } else { 0.0 };
                        return if is_within {
                            self.entry_within(*one_of(parts)?, column, row, depth)
                        } else {
                            number(one)
                        };
                    }
                    let diagonal = graph.scalar(*one)?;
                    return number(if column == row { diagonal } else { 0.0 });
                }
                // The parts of a constructor fill the columns in order.
                let mut place = column * side + row;
                for part in parts {
                    let width = usize::from(graph.node(*part).width);
                    match width {
                        0 => return None,
                        width if place < width => {
                            return self.part(*part, place, depth).map(|e| self.within(id, *part, e));
                        }
                        width => place -= width,
                    }
                }
                None
            }
            _ => None,
        }
    }

    /// A component that is only read from a variable is located at the construction of the matrix.
    fn within(&self, matrix: Id, part: Id, entry: Entry) -> Entry {
        let is_variable = |id: Id| matches!(self.graph.op(id), Op::Copy(..));
        let is_read = is_variable(part) || entry.at != part && is_variable(entry.at);
        if is_read { Entry { at: matrix, ..entry } } else { entry }
    }

    /// Returns a component of a vector, or the number itself.
    fn part(&self, id: Id, row: usize, depth: usize) -> Option<Entry> {
        let depth = depth.checked_sub(1)?;
        let graph = &self.graph;
        if let Some(number) = graph.number(id) {
            return Some(Entry { at: id, value: Value::Number(*number.get(row.min(number.len() - 1))?) });
        }
        if graph.node(id).width <= 1 {
            return self.scalar_entry(id, depth);
        }
        if let Some((axis, sign)) = self.axis(id).filter(|_| row < 3) {
            return Some(Entry { at: id, value: Value::Of(axis, sign, row) });
        }
        match graph.op(id) {
            Op::Copy(inner, _) => self.part(*inner, row, depth).map(|entry| Entry { at: id, ..entry }),
            Op::Neg(inner) => self.part(*inner, row, depth).map(|entry| Entry { at: id, value: negated(entry.value) }),
            Op::Construct(parts) => {
                let mut place = row;
                for part in parts {
                    let width = usize::from(graph.node(*part).width).max(1);
                    if place < width {
                        return self.part(*part, place, depth);
                    }
                    place -= width;
                }
                None
            }
            Op::Write(before, letters, value) => match letters.chars().position(|l| component(l) == Some(row)) {
                Some(place) => self.part(*value, place, depth),
                None => self.part(*before, row, depth),
            },
            Op::Index(matrix, Some(column)) if graph.node(*matrix).is_matrix => {
                self.entry_within(*matrix, *column, row, depth).map(|entry| Entry { at: id, ..entry })
            }
            Op::Swizzle(inner, letters) => {
                let letter = letters.chars().nth(row)?;
                self.part(*inner, component(letter)?, depth)
            }
            // Three dot products at once.
            Op::Binary(BinaryOp::Multiply, a, b) => {
                let (matrix, vector, is_row) = match (graph.node(*a).is_matrix, graph.node(*b).is_matrix) {
                    (true, false) => (*a, *b, true),
                    (false, true) => (*b, *a, false),
                    _ => return None,
                };
                let (Axis::Eye, sign) = self.axis(vector)? else { return None };
                let (axis, turned) = self.line(matrix, row, is_row, depth)?;
                Some(Entry { at: id, value: Value::Dot(axis, sign * turned) })
            }
            _ => None,
        }
    }

    /// Returns the meaning of a scalar.
    fn scalar_entry(&self, id: Id, depth: usize) -> Option<Entry> {
        let depth = depth.checked_sub(1)?;
        let graph = &self.graph;
        let value = match graph.op(id) {
            Op::Copy(inner, _) => self.scalar_entry(*inner, depth)?.value,
            Op::Neg(inner) => negated(self.scalar_entry(*inner, depth)?.value),
            Op::Swizzle(inner, letters) => self.part(*inner, component(letters.chars().next()?)?, depth)?.value,
            Op::Index(inner, Some(row)) => self.part(*inner, *row, depth)?.value,
            Op::Call(name, parts) if name == "dot" => match (self.axis(*parts.first()?)?, self.axis(*parts.get(1)?)?) {
                ((Axis::Eye, a), (axis, b)) | ((axis, a), (Axis::Eye, b)) => Value::Dot(axis, a * b),
                _ => return None,
            },
            _ => return None,
        };
        Some(Entry { at: id, value })
    }

    /// Returns the axis that a row or column of a matrix holds.
    fn line(&self, matrix: Id, index: usize, is_row: bool, depth: usize) -> Option<(Axis, f64)> {
        let of = |along: usize| {
            let (column, row) = if is_row { (along, index) } else { (index, along) };
            match self.entry_within(matrix, column, row, depth)?.value {
                Value::Of(axis, sign, place) if place == along => Some((axis, sign)),
                _ => None,
            }
        };
        let first = of(0)?;
        (of(1)? == first && of(2)? == first).then_some(first)
    }
}

fn one_of(parts: &[Id]) -> Option<&Id> {
    parts.first()
}

fn negated(value: Value) -> Value {
    match value {
        Value::Of(axis, sign, place) => Value::Of(axis, -sign, place),
        Value::Dot(axis, sign) => Value::Dot(axis, -sign),
        Value::Number(number) => Value::Number(-number),
    }
}

fn cross((a, sign_a): (Axis, f64), (b, sign_b): (Axis, f64)) -> Option<(Axis, f64)> {
    let sign = sign_a * sign_b;
    Some(match (a, b) {
        (Axis::Front | Axis::Mixed, Axis::GivenUp | Axis::Up) => (Axis::Right, sign),
        (Axis::GivenUp | Axis::Up, Axis::Front | Axis::Mixed) => (Axis::Right, -sign),
        (Axis::Right, Axis::Front | Axis::Mixed) => (Axis::Up, sign),
        (Axis::Front | Axis::Mixed, Axis::Right) => (Axis::Up, -sign),
        (Axis::Right, Axis::GivenUp | Axis::Up) => (Axis::Front, -sign),
        (Axis::GivenUp | Axis::Up, Axis::Right) => (Axis::Front, sign),
        _ => return None,
    })
}

/// Whether a node depends on anything of a camera.
pub(crate) fn is_of_camera(reading: &Reading, id: Id) -> bool {
    let is = |id: &Id| {
        matches!(
            reading.role(*id),
            Some(
                Role::ViewPos
                    | Role::ViewFront
                    | Role::WorldUp
                    | Role::ViewUp
                    | Role::ViewRight
                    | Role::ViewTarget
                    | Role::Yaw
                    | Role::Pitch
            )
        )
    };
    reading.graph.reachable(&[id], |_| true).iter().any(is)
}

/// Returns the factors of a product of matrices and a vector, from left to right; anything else is one factor.
pub(crate) fn factors(graph: &Graph, id: Id) -> Vec<Id> {
    let (mut open, mut found) = (vec![id], Vec::new());
    while let Some(id) = open.pop() {
        let inner = graph.plain(id);
        match graph.op(inner) {
            Op::Binary(BinaryOp::Multiply, a, b)
                if found.len() < 12 && (graph.node(*a).is_matrix || graph.node(*b).is_matrix) =>
            {
                open.extend([*b, *a]);
            }
            _ => found.push(id),
        }
    }
    found
}
