//! Mistakes with the position, for lighting and on the screen.

use super::{Answer, At, Not, Silent};
use crate::dataflow::Reading;
use crate::dataflow::matrix::Base;
use crate::dataflow::vector::{Space, VectorKind};
use crate::dataflow::{Graph, Id, Op};
use crate::mistakes::ModelSolution;
use gonio_glsl::ast::BinaryOp;

pub(super) fn answer(reading: &Reading, id: &str, model: ModelSolution) -> Option<Answer> {
    use Base::{Model as M, Projection as P, View as V};
    Some(match id {
        "position-not-transformed" => in_space(reading, Space::Model, model),
        "position-without-translation" => in_space(reading, Space::Untranslated, model),
        "position-in-view-space" if reading.is_in_view() => Not,
        "position-in-view-space" => in_space(reading, Space::View, model),
        "position-in-clip-space" => in_space(reading, Space::Clip, model),
        "matrix-order" => screen(reading, |bases| *bases == [P, M, V]),
        "matrix-order-reversed" => screen(reading, |bases| *bases == [M, V, P] || *bases == [V, P, M]),
        "model-matrix-missing" => screen(reading, |bases| !bases.contains(&M)),
        "view-matrix-missing" => screen(reading, |bases| !bases.contains(&V)),
        "projection-matrix-missing" => screen(reading, |bases| !bases.contains(&P)),
        "skybox-keeps-translation" => sky(reading),
        "skybox-not-turned" => screen(reading, |bases| !bases.contains(&V)),
        _ => return None,
    })
}

/// A position that a direction or distance is computed from.
struct Place {
    read: Id,
    made: Id,
    space: Space,
}

fn places(reading: &Reading) -> Vec<Place> {
    let mut found = Vec::new();
    // A position used as the normal is a different mistake.
    let normals: Vec<Id> = reading.normals().into_iter().filter_map(|id| Some(reading.vector(id)?.at)).collect();
    let mut add = |id: Id| {
        if let Some(vector) = reading.vector(id)
            && let VectorKind::Point(space) = vector.kind
        {
            found.push(Place { read: id, made: behind_screen(reading, id, vector.at), space });
        }
    };
    for id in &reading.lit {
        match reading.graph.op(*id) {
            Op::Binary(BinaryOp::Subtract | BinaryOp::Add, a, b) => {
                let is_direction = reading.vector(*id).is_some_and(|v| v.at == *id && (v.is_light() || v.is_eye()));
                if is_direction {
                    add(*a);
                    add(*b);
                }
            }
            Op::Call(name, parts) if name == "distance" => parts.iter().for_each(|id| add(*id)),
            Op::Call(name, parts) if name == "normalize" => {
                parts
                    .iter()
                    .filter(|id| !reading.vector(**id).is_some_and(|v| normals.contains(&v.at)))
                    .for_each(|id| add(*id));
            }
            _ => {}
        }
    }
    found
}

/// Returns the node that computes a position; for a position on the screen, the node that uses it.
fn behind_screen(reading: &Reading, mut id: Id, at: Id) -> Id {
    loop {
        let inner = match reading.graph.op(id) {
            Op::Copy(inner, name) if name != "gl_Position" => *inner,
            Op::Interpolated(inner) | Op::Swizzle(inner, _) | Op::Neg(inner) => *inner,
            Op::Construct(parts) => match parts.first() {
                Some(first) => *first,
                None => return at,
            },
            Op::Binary(BinaryOp::Divide, inner, _) => *inner,
            _ => return at,
        };
        if matches!(reading.graph.op(inner), Op::Copy(_, name) if name == "gl_Position") {
            return id;
        }
        id = inner;
    }
}

fn in_space(reading: &Reading, expected: Space, model: ModelSolution) -> Answer {
    let mut found = places(reading);
    if found.is_empty() && !model.is_lit() {
        let looked_up = reading.lookups().into_iter().filter_map(|(_, id)| Some((reading.vector(id)?, id)));
        found = looked_up
            .filter_map(|(vector, id)| match vector.kind {
                VectorKind::Point(space) => {
                    Some(Place { read: id, made: behind_screen(reading, id, vector.at), space })
                }
                _ => None,
            })
            .collect();
    }
    // If a position in world space is available, the other one is used by mistake.
    let has_both = expected == Space::Model && found.iter().any(|place| place.space == Space::World);
    match found.iter().find(|place| place.space == expected) {
        Some(place) => At(if has_both { place.read } else { place.made }, 1.0),
        None if found.is_empty() => Silent,
        None => Not,
    }
}

/// Returns the product that computes the position on the screen, with its matrices from left to right.
fn product(reading: &Reading) -> Option<(Id, Vec<Base>)> {
    let graph = &reading.graph;
    let mut id = reading.position?;
    let (mut first, mut bases) = (None, Vec::new());
    loop {
        id = core(graph, id);
        match graph.op(id) {
            Op::Binary(BinaryOp::Multiply, a, b) if reading.matrix(*a).is_some() => {
                first.get_or_insert(id);
                bases.extend(reading.matrix(*a)?.bases()?);
                id = *b;
            }
            _ => return first.map(|first| (first, bases)),
        }
        if bases.len() > 8 {
            return None;
        }
    }
}

fn core(graph: &Graph, id: Id) -> Id {
    match graph.op(graph.core(id)) {
        // `.xyww`
        Op::Swizzle(inner, letters) if letters.len() == 4 => graph.core(*inner),
        Op::Write(inner, letters, _) if letters.len() == 1 => graph.core(*inner),
        _ => graph.core(id),
    }
}

fn screen(reading: &Reading, is_match: impl Fn(&[Base]) -> bool) -> Answer {
    match product(reading) {
        Some((id, bases)) if is_match(&bases) => At(id, 1.0),
        Some(_) => Not,
        None => Silent,
    }
}

/// Returns the product of a position with the complete V.
fn sky(reading: &Reading) -> Answer {
    let is_whole = |id: Id| reading.matrix(id).is_some_and(|m| m.has(Base::View) && !m.is_turn);
    let found = reading.placed.iter().copied().find(|id| match reading.sides(*id, BinaryOp::Multiply) {
        Some((a, b)) => {
            let w = reading.vector(b).and_then(|v| v.w);
            is_whole(a) && reading.vector(b).is_some() && w != Some(0.0)
        }
        None => false,
    });
    Answer::at_or(found, 1.0, if reading.position.is_some() { Not } else { Silent })
}
