//! Mistakes with reflection, refraction and the sky.

use super::{Answer, At, Not, Silent, ambient};
use crate::dataflow::vector::{Incoming, Space, Vector, VectorKind};
use crate::dataflow::{Id, Op, Reading};
use crate::mistakes::ModelSolution;
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;

pub(super) fn answer(reading: &Reading, id: &str, model: ModelSolution) -> Option<Answer> {
    Some(match id {
        "reflection-vector-reversed" | "refraction-view-reversed" => reversed(reading),
        "reflection-normal-only" => looked_up(reading, |kind| matches!(kind, VectorKind::Normal(_))),
        "reflection-by-position" => looked_up(reading, |kind| matches!(kind, VectorKind::Point(_)))
            .or(|| looked_up(reading, |kind| matches!(kind, VectorKind::ToEye(_) | VectorKind::Eye))),
        "reflection-by-view" => looked_up(reading, |kind| matches!(kind, VectorKind::ToEye(_) | VectorKind::Eye)),
        "refraction-instead-of-reflection" => called(reading, "refract", "reflect"),
        "reflection-instead-of-refraction" => called(reading, "reflect", "refract"),
        "refraction-ratio-inverted" => ratio(reading, is_inverted),
        "refraction-ratio-missing" => {
            ratio(reading, |reading, id| reading.graph.scalar(id).is_some_and(|n| (n - 1.0).abs() < 1e-6))
        }
        "lookup-mirrored" => negated(reading, &[0], model),
        "lookup-flipped" => negated(reading, &[1], model),
        "lookup-depth-mirrored" => negated(reading, &[2], model),
        "skybox-wrong-direction" => sky_direction(reading),
        _ => return None,
    })
}

/// Finds a direction from the surface to the eye as an argument of `reflect` or `refract`.
fn reversed(reading: &Reading) -> Answer {
    let looked_up: Vec<Vector> = reading
        .lookups()
        .into_iter()
        .filter_map(|(_, id)| reading.vector(id))
        .filter(|v| matches!(v.kind, VectorKind::Reflected(Incoming::Eye) | VectorKind::Refracted(Incoming::Eye)))
        .collect();
    let Some(vector) = looked_up.iter().find(|v| v.sign > 0.0) else {
        return if looked_up.is_empty() { Silent } else { Not };
    };
    let Some(id) = vector.incoming else { return At(vector.at, 1.0) };
    // A variable named after the direction from the eye was computed the wrong way; one named after the eye needs a
    // sign where it is used.
    let name = reading.variable(id).map(|(_, name)| name.to_lowercase()).unwrap_or_default();
    let is_ray = name == "i" || ["inc", "ray", "regard", "from", "look", "in_"].iter().any(|word| name.contains(word));
    let made = reading.vector(id).map(|v| v.turned_at.unwrap_or(v.at));
    let used = Some(vector.turned_at.unwrap_or(vector.at));
    let place = if is_ray { made } else { used.or(made) };
    Answer::at_or(place, 1.0, Silent)
}

fn looked_up(reading: &Reading, is_match: impl Fn(VectorKind) -> bool) -> Answer {
    let lookups = reading.lookups();
    let found = lookups.iter().find(|(_, id)| reading.vector(*id).is_some_and(|v| is_match(v.kind)));
    match found {
        // A variable that is right elsewhere is not at fault.
        Some((lookup, direction)) => match reading.graph.op(*direction) {
            Op::Copy(inner, _) if matches!(reading.graph.op(*inner), Op::Call(..) | Op::Binary(..)) => At(*lookup, 1.0),
            _ => At(*direction, 1.0),
        },
        None if lookups.is_empty() => Silent,
        None => Not,
    }
}

fn called(reading: &Reading, wrong: &str, right: &str) -> Answer {
    let call = |function: &str| {
        let is = |id: &Id| matches!(reading.graph.op(*id), Op::Call(name, _) if name == function);
        reading.lit.iter().copied().find(is)
    };
    match (call(wrong), call(right)) {
        (Some(id), None) => At(id, 1.0),
        (Some(id), Some(_)) => At(id, 0.6),
        (None, Some(_)) => Not,
        (None, None) => {
            let is_formula = |id: &Id| {
                reading.vector(*id).is_some_and(|v| v.at == *id && matches!(v.kind, VectorKind::Reflected(_)))
            };
            Answer::at_or(reading.lit.iter().copied().find(is_formula).filter(|_| wrong == "reflect"), 0.9, Silent)
        }
    }
}

/// Returns the third argument of `refract`: the variable that holds it, or the expression.
fn ratio(reading: &Reading, is_match: impl Fn(&Reading, Id) -> bool) -> Answer {
    let ratios: Vec<Id> = reading
        .lit
        .iter()
        .filter_map(|id| match reading.graph.op(*id) {
            Op::Call(name, parts) if name == "refract" => parts.get(2).copied(),
            _ => None,
        })
        .collect();
    match ratios.iter().find(|id| is_match(reading, **id)) {
        Some(id) => At(*id, 1.0),
        None if ratios.is_empty() => Silent,
        None => Not,
    }
}

fn is_inverted(reading: &Reading, id: Id) -> bool {
    let graph = &reading.graph;
    if let Some(number) = graph.scalar(id) {
        return number > 1.0;
    }
    let plain = graph.plain(id);
    let role = |id: Id| reading.role(graph.plain(id));
    match graph.op(plain) {
        Op::Input { .. } => role(plain) == Some(Role::RefractionIndex),
        Op::Binary(BinaryOp::Divide, a, _) => role(*a) == Some(Role::RefractionIndex),
        // 1 / (1 / n)
        Op::Binary(..) => false,
        _ => false,
    }
}

/// Finds the node that negates a component of the lookup's direction.
fn negated(reading: &Reading, components: &[usize], model: ModelSolution) -> Answer {
    let graph = &reading.graph;
    let is_negative = |id: Id| match graph.op(graph.plain(id)) {
        Op::Neg(_) => true,
        Op::Binary(BinaryOp::Multiply, a, b) => [a, b].iter().any(|side| graph.scalar(**side).is_some_and(|n| n < 0.0)),
        Op::Binary(BinaryOp::Subtract, a, _) => graph.scalar(*a) == Some(0.0),
        _ => false,
    };
    let lookups = reading.lookups();
    for (_, direction) in &lookups {
        let mut id = *direction;
        for _ in 0..64 {
            let next = match graph.op(id) {
                Op::Copy(inner, _) | Op::Interpolated(inner) | Op::Swizzle(inner, _) => *inner,
                Op::Construct(parts) => {
                    let firsts = component_of(graph, parts, components);
                    if firsts.is_some_and(is_negative) {
                        return At(id, 1.0);
                    }
                    match parts.first() {
                        Some(first) if parts.len() <= 2 => *first,
                        _ => break,
                    }
                }
                Op::Write(inner, letters, value) => {
                    let component = letters.chars().next().and_then(crate::dataflow::component);
                    if component.is_some_and(|c| components.contains(&c)) && is_negative(*value) {
                        return At(id, 1.0);
                    }
                    *inner
                }
                Op::Binary(BinaryOp::Multiply, a, b) => {
                    let signs = [a, b].into_iter().find_map(|side| graph.number(*side));
                    let is_meant =
                        |signs: &&Vec<f64>| components.iter().any(|c| signs.get(*c).is_some_and(|n| *n < 0.0));
                    if signs.filter(is_meant).is_some() {
                        return At(id, 1.0);
                    }
                    if graph.number(*a).is_some() || graph.node(*a).is_matrix { *b } else { *a }
                }
                // All three components, in a skybox.
                Op::Neg(inner) => {
                    if model == ModelSolution::Skybox && components == [1] {
                        return At(id, 0.8);
                    }
                    *inner
                }
                Op::Call(name, parts) if name == "normalize" => match parts.first() {
                    Some(first) => *first,
                    None => break,
                },
                _ => break,
            };
            id = next;
        }
    }
    if lookups.is_empty() { Silent } else { Not }
}

/// Returns the argument of a constructor that gives one of these components.
fn component_of(graph: &crate::dataflow::Graph, parts: &[Id], components: &[usize]) -> Option<Id> {
    let mut at = 0;
    for part in parts {
        let width = usize::from(graph.node(*part).width.max(1));
        if width == 1 && components.contains(&at) {
            return Some(*part);
        }
        at += width;
    }
    None
}

/// Finds a skybox lookup in a direction other than the position on the box.
fn sky_direction(reading: &Reading) -> Answer {
    for (_, direction) in reading.lookups() {
        let Some(vector) = reading.vector(direction) else { continue };
        if vector.kind == VectorKind::Point(Space::Model) && vector.sign > 0.0 {
            return Not;
        }
        // The value that is passed between the stages is wrong.
        let mut id = direction;
        while let Op::Copy(inner, _) | Op::Swizzle(inner, _) = reading.graph.op(id) {
            id = *inner;
        }
        return match reading.graph.op(id) {
            Op::Interpolated(inner) => At(*inner, 1.0),
            _ => At(vector.turned_at.unwrap_or(vector.at), 0.9),
        };
    }
    if ambient::puts_out(reading, |kind| matches!(kind, VectorKind::Point(_))) { Not } else { Silent }
}
