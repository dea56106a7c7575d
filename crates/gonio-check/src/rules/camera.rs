//! Mistakes with the camera: the order of the matrices, and the view matrix where the program builds it.

use super::{Answer, At, Not, Silent};
use crate::dataflow::Reading;
use crate::dataflow::camera::{Axis, Entry, Value, factors, is_of_camera};
use crate::dataflow::matrix::Base;
use crate::dataflow::{Id, Op};
use gonio_glsl::ast::BinaryOp;

/// The confidence of a place that is only the matrix as a whole.
const SOMEWHERE: f32 = 0.4;

pub(super) fn answer(reading: &Reading, id: &str) -> Answer {
    use Base::{Model as M, Projection as P, View as V};
    let Some(product) = Product::find(reading) else { return Silent };
    let bases = product.bases();
    let screen = |is: bool| if is { At(product.at, 1.0) } else { Not };
    let count = |base: Base| bases.iter().filter(|known| **known == base).count();
    let right = !product.is_reversed;
    match id {
        "matrix-order" => screen(right && bases == [P, M, V]),
        "matrix-order-reversed" => {
            screen(right && [[M, V, P], [V, P, M], [V, M, P], [M, P, V]].iter().any(|order| bases == *order))
        }
        "vector-on-the-left" => screen(product.is_reversed),
        "model-matrix-missing" => screen(bases == [P, V]),
        "view-matrix-missing" => screen(bases == [P, M]),
        "projection-matrix-missing" => screen(bases == [V, M]),
        "only-model-matrix" => screen(bases == [M]),
        "all-matrices-missing" => screen(bases.is_empty()),
        "model-matrix-twice" => screen(count(M) > 1),
        "view-matrix-twice" => screen(count(V) > 1),
        "position-w-zero" => product.point_without_w(reading),
        "perspective-divided-by-hand" => divided(reading),
        "perspective-lost" => w_set(reading),
        _ => match product.view {
            Some(_) => View { reading, product: &product }.answer(id),
            None if bases.contains(&V) => Not,
            None => Silent,
        },
    }
}

/// The expression for the position on the screen.
struct Product {
    at: Id,
    /// The factors from left to right with their meaning; a view matrix in two factors counts once.
    parts: Vec<(Id, Option<Base>)>,
    /// The factors of a view matrix that the program builds.
    view: Option<Vec<Id>>,
    is_reversed: bool,
}

impl Product {
    fn find(reading: &Reading) -> Option<Self> {
        let graph = &reading.graph;
        let mut at = graph.core(reading.position?);
        // `P * V * M * p / w`, and later assignments to components.
        while let Op::Binary(BinaryOp::Divide, inner, _) | Op::Write(inner, ..) = graph.op(at) {
            at = graph.core(*inner);
        }
        let all = factors(graph, at);
        let is_matrix = |id: &Id| graph.node(*id).is_matrix;
        let is_reversed = all.len() > 1 && all.first().is_some_and(|first| !is_matrix(first));
        let mut product = Product { at, parts: Vec::new(), view: None, is_reversed };
        for id in all {
            if let Some(known) = reading.matrix(id).and_then(|matrix| matrix.bases()).filter(|known| !known.is_empty())
            {
                product.parts.extend(known.into_iter().map(|base| (id, Some(base))));
            } else if is_matrix(&id) && is_of_camera(reading, id) {
                let view = product.view.get_or_insert_default();
                let is_known = view.contains(&id);
                view.push(id);
                // Rotation and translation are one matrix; a repeated factor is another one.
                if is_known || product.parts.last().is_none_or(|(_, last)| *last != Some(Base::View)) {
                    product.parts.push((id, Some(Base::View)));
                }
            } else {
                product.parts.push((id, None));
            }
        }
        Some(product)
    }

    fn bases(&self) -> Vec<Base> {
        self.parts.iter().filter_map(|(_, base)| *base).collect()
    }

    fn point_without_w(&self, reading: &Reading) -> Answer {
        let graph = &reading.graph;
        let point = self.parts.iter().map(|(id, _)| *id).find(|id| !graph.node(*id).is_matrix);
        match point.map(|id| (id, graph.op(graph.plain(id)))) {
            Some((id, Op::Construct(parts))) => match parts.last().and_then(|last| graph.scalar(*last)) {
                Some(0.0) => At(id, 1.0),
                _ => Not,
            },
            _ => Silent,
        }
    }
}

/// Finds a division by w before the output.
fn divided(reading: &Reading) -> Answer {
    let graph = &reading.graph;
    let is_w = |id: Id| match graph.op(graph.plain(id)) {
        Op::Swizzle(_, letters) => matches!(letters.as_str(), "w" | "a" | "q"),
        Op::Index(_, Some(3)) => true,
        _ => false,
    };
    let is = |id: &Id| match graph.op(*id) {
        Op::Binary(BinaryOp::Divide, _, by) => is_w(*by),
        Op::Binary(BinaryOp::Multiply, a, b) => [a, b].iter().any(|side| match graph.op(graph.plain(**side)) {
            Op::Binary(BinaryOp::Divide, _, by) => is_w(*by),
            _ => false,
        }),
        _ => false,
    };
    Answer::at_or(reading.placed.iter().copied().find(is), 1.0, Not)
}

/// Finds `vec4(clip.xyz, 1.0)` as the output position.
fn w_set(reading: &Reading) -> Answer {
    let graph = &reading.graph;
    let Some(position) = reading.position else { return Silent };
    let w = match graph.op(graph.plain(position)) {
        Op::Construct(parts) => parts.last().and_then(|last| graph.scalar(*last)),
        Op::Write(_, letters, value) if letters == "w" => graph.scalar(*value),
        _ => None,
    };
    if w == Some(1.0) { At(position, 0.9) } else { Not }
}

/// A view matrix that the program builds.
struct View<'a> {
    reading: &'a Reading,
    product: &'a Product,
}

impl View<'_> {
    fn factors(&self) -> &[Id] {
        self.product.view.as_deref().unwrap_or_default()
    }

    /// Returns the first factor whose component at these positions satisfies the condition.
    fn find(&self, places: &[(usize, usize)], is: impl Fn(Value) -> bool) -> Option<Id> {
        let entries =
            self.factors().iter().flat_map(|id| places.iter().filter_map(|(c, r)| self.reading.entry(*id, *c, *r)));
        entries.into_iter().find(|Entry { value, .. }| is(*value)).map(|entry| entry.at)
    }

    /// Returns the cross product in the matrix that gives this axis with this sign.
    fn cross(&self, expected: Axis, sign: f64) -> Option<Id> {
        let reading = self.reading;
        reading.placed.iter().copied().find(|id| {
            matches!(reading.graph.op(*id), Op::Call(name, _) if name == "cross")
                && reading.axis(*id).is_some_and(|(axis, s)| axis == expected && s == sign)
        })
    }

    fn answer(&self, id: &str) -> Answer {
        const TURN: [(usize, usize); 9] = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];
        const SHIFT: [(usize, usize); 3] = [(3, 0), (3, 1), (3, 2)];
        let is_transposed = self.find(&[(0, 1), (0, 2)], |value| matches!(value, Value::Of(Axis::Right, ..)));
        let sideways = |value: Value| matches!(value, Value::Dot(Axis::Right | Axis::Up | Axis::GivenUp, s) if s > 0.0);
        let in_last_row = self.find(&[(0, 3), (1, 3), (2, 3)], |value| !matches!(value, Value::Number(_)));
        let eye = |expected: f64| move |value: Value| matches!(value, Value::Of(Axis::Eye, s, _) if s == expected);
        let found = match id {
            "view-translation-not-negated" => self.find(&SHIFT, sideways).or_else(|| self.find(&SHIFT, eye(1.0))),
            "view-translation-not-rotated" if self.factors().len() == 1 => self.find(&SHIFT, eye(-1.0)),
            "view-translation-not-rotated" => self.translation_first(),
            "view-translation-missing" if in_last_row.is_none() && self.factors().len() == 1 => {
                self.find(&SHIFT[..1], |value| value == Value::Number(0.0))
            }
            "view-translation-front-sign" => {
                self.find(&SHIFT[2..], |value| matches!(value, Value::Dot(Axis::Front, s) if s < 0.0))
            }
            "view-translation-in-the-last-row" if is_transposed.is_none() => in_last_row,
            "view-rows-and-columns-swapped" if in_last_row.is_some() => is_transposed.and(self.whole()),
            "view-not-inverted" if is_transposed.is_some() => self.find(&SHIFT, eye(1.0)).and(self.whole()),
            "view-rotation-transposed" if in_last_row.is_none() => is_transposed,
            "view-front-not-negated" => {
                let places = if is_transposed.is_some() { [(2, 0), (2, 1)] } else { [(0, 2), (1, 2)] };
                self.find(&places, |value| matches!(value, Value::Of(Axis::Front, s, _) if s > 0.0))
            }
            "view-right-mirrored" => self.cross(Axis::Right, -1.0),
            "view-up-reversed" => self.cross(Axis::Up, -1.0),
            "view-up-not-orthogonal" => self.find(&TURN, |value| matches!(value, Value::Of(Axis::GivenUp, ..))),
            "view-right-not-normalised" => self.right_not_normalised(),
            "view-front-is-target" => self.mixed(),
            "view-axes-in-wrong-order" => {
                self.find(&TURN[..1], |value| !matches!(value, Value::Of(Axis::Right, ..) | Value::Number(_)))
            }
            _ => None,
        };
        match found {
            Some(at) => At(at, 1.0),
            None if id == "view-front-reversed" => self.backwards().map_or(Silent, |at| At(at, SOMEWHERE)),
            None if self.is_right() => Not,
            None => self.whole().map_or(Silent, |at| At(at, SOMEWHERE)),
        }
    }

    fn whole(&self) -> Option<Id> {
        self.factors().first().map(|id| self.reading.graph.plain(*id))
    }

    /// Whether all components are known and right.
    fn is_right(&self) -> bool {
        let [matrix] = self.factors() else { return false };
        let axes = [(Axis::Right, 1.0), (Axis::Up, 1.0), (Axis::Front, -1.0)];
        let is = |column: usize, row: usize, expected: Value| {
            self.reading.entry(*matrix, column, row).is_some_and(|entry| entry.value == expected)
        };
        axes.iter().enumerate().all(|(row, (axis, sign))| {
            (0..3).all(|column| is(column, row, Value::Of(*axis, *sign, column)))
                && is(3, row, Value::Dot(*axis, -sign))
        })
    }

    /// Finds a product with the translation to the left of the rotation.
    fn translation_first(&self) -> Option<Id> {
        let first = *self.factors().first()?;
        let reading = self.reading;
        reading.entry(first, 3, 0).filter(|entry| matches!(entry.value, Value::Of(Axis::Eye, ..)))?;
        let is_both = |id: &Id| match reading.graph.op(*id) {
            Op::Binary(BinaryOp::Multiply, a, _) => reading.graph.plain(*a) == reading.graph.plain(first),
            _ => false,
        };
        reading.placed.iter().copied().find(is_both).or(Some(self.product.at))
    }

    /// Finds a cross product for Right that is not normalised.
    fn right_not_normalised(&self) -> Option<Id> {
        let reading = self.reading;
        let is_right = |id: Id| reading.axis(id).is_some_and(|(axis, _)| axis == Axis::Right);
        let normalised: Vec<Id> = reading
            .placed
            .iter()
            .filter_map(|id| Some(reading.graph.plain(*reading.graph.call(*id, "normalize")?.first()?)))
            .collect();
        reading.placed.iter().copied().find(|id| {
            matches!(reading.graph.op(*id), Op::Call(name, _) if name == "cross")
                && is_right(*id)
                && !normalised.contains(id)
        })
    }

    /// Finds a Front that is negated or points from the target to the camera, which is right for the third axis.
    fn backwards(&self) -> Option<Id> {
        let reading = self.reading;
        let is = |id: &Id| {
            matches!(reading.graph.op(*id), Op::Binary(BinaryOp::Subtract | BinaryOp::Multiply, ..) | Op::Neg(_))
                && reading.axis(*id) == Some((Axis::Front, -1.0))
        };
        reading.placed.iter().copied().find(is)
    }

    /// Finds the sum of Front and the camera's position, or the position alone in the place of Front.
    fn mixed(&self) -> Option<Id> {
        let reading = self.reading;
        let is = |id: &Id| {
            matches!(reading.graph.op(*id), Op::Binary(..))
                && reading.axis(*id).is_some_and(|(axis, _)| axis == Axis::Mixed)
        };
        reading.placed.iter().copied().find(is)
    }
}
