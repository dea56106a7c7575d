//! Mistakes with the angles of a panorama and with single faces of a cubemap.

use super::{Answer, At, Not, Silent};
use crate::dataflow::Reading;
use crate::dataflow::{Graph, Id, Op, component};
use crate::mistakes::faces::FACES;
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;
use std::f64::consts::{PI, TAU};

/// The support for mistakes that only pictures show: the source shows where they would be made, but not whether they
/// are.
const WHERE: f32 = 0.45;

pub(super) fn answer(reading: &Reading, id: &str) -> Answer {
    let there = |found: Option<Id>| Answer::at_or(found, WHERE, Silent);
    match id {
        "longitude-z-not-negated" => arctangent(reading, |_, y, x| y == (0, 1.0) && x == (2, 1.0)),
        "longitude-arguments-swapped" => arctangent(reading, |_, y, x| y.0 == 2 && x.0 == 0 && y.1 != x.1),
        "panorama-turned-quarter" => arctangent(reading, |_, y, x| y.0 == 2 && x.0 == 0 && y.1 == x.1),
        "panorama-mirrored" => arctangent(reading, |_, y, x| y == (0, -1.0) && x == (2, -1.0))
            .or(|| there(scaled(reading, "atan", |_| true))),
        "panorama-turned-half" => arctangent(reading, |_, y, x| y == (0, -1.0) && x == (2, 1.0))
            .or(|| there(scaled(reading, "atan", |_| true))),
        "longitude-of-quotient" => match call(reading, "atan") {
            Some(id) if reading.graph.call(id, "atan").is_some_and(|arguments| arguments.len() == 1) => At(id, 1.0),
            _ => Not,
        },
        "longitude-divided-by-pi" => Answer::at_or(scaled(reading, "atan", |by| near(by, PI)), 1.0, Not),
        "latitude-divided-by-two-pi" => match latitude_by_two_pi(reading) {
            Some(at) => At(at, 1.0),
            // Among two angles from atan, the latitude is the later one.
            None => there(scaled(reading, "atan", |by| near(by, TAU))),
        },
        "panorama-upside-down" | "latitude-asin-acos" => {
            there(scaled(reading, "asin", |_| true).or(scaled(reading, "acos", |_| true)).or_else(|| height(reading)))
        }
        "latitude-without-arcsine" => {
            let is_height = |id: &Id| {
                let is_product = matches!(reading.graph.op(*id), Op::Binary(BinaryOp::Multiply, ..));
                is_product && side(&reading.graph, *id).is_some_and(|(axis, _)| axis == 1)
            };
            let place = reading.lookups().first().map(|(_, place)| *place);
            there(reading.lit.iter().copied().find(is_height).or(place))
        }
        "direction-not-normalised" => match reading.lit.iter().any(|id| reading.graph.call(*id, "normalize").is_some())
        {
            true => Not,
            false => there(direction(reading).or_else(|| height(reading)).or_else(|| call(reading, "atan"))),
        },
        "layout-photographic" => Answer::at_or(mirrored_in_z(reading), 1.0, Silent),
        "face-from-zero-to-one" | "face-from-minus-half" => there(coordinate(reading)),
        "faces-flipped" => there(turned_component(reading, 1).or_else(|| coordinate(reading))),
        "faces-mirrored" | "faces-turned-half" => there(turned_component(reading, 0).or_else(|| coordinate(reading))),
        "faces-too-bright" | "faces-too-dark" => there(call(reading, "pow")),
        "faces-red-and-blue-swapped" => there(reading.put_out()),
        _ if id.starts_with("face") => there(face(reading, id)),
        _ => Silent,
    }
}

fn near(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 0.01
}

fn call(reading: &Reading, name: &str) -> Option<Id> {
    reading.lit.iter().copied().find(|id| matches!(reading.graph.op(*id), Op::Call(called, _) if called == name))
}

/// Returns the call that computes the latitude.
fn height(reading: &Reading) -> Option<Id> {
    call(reading, "asin").or_else(|| call(reading, "acos"))
}

fn latitude_by_two_pi(reading: &Reading) -> Option<Id> {
    let by = |by: f64| near(by, TAU);
    scaled(reading, "asin", by).or_else(|| scaled(reading, "acos", by))
}

/// Returns the vector whose latitude is computed.
fn direction(reading: &Reading) -> Option<Id> {
    let graph = &reading.graph;
    let mut id = height(reading)?;
    for _ in 0..20 {
        id = match graph.op(id) {
            Op::Call(_, parts) => *parts.first()?,
            Op::Copy(inner, _) | Op::Neg(inner) => *inner,
            Op::Swizzle(base, _) => return Some(*base),
            _ => return None,
        };
    }
    None
}

/// Finds a direction multiplied by (1, 1, -1).
fn mirrored_in_z(reading: &Reading) -> Option<Id> {
    let graph = &reading.graph;
    let is = |id: Id| graph.number(id).is_some_and(|number| number.as_slice() == [1.0, 1.0, -1.0]);
    reading.lit.iter().copied().find(|id| match graph.op(*id) {
        Op::Binary(BinaryOp::Multiply, a, b) => is(*a) || is(*b),
        _ => false,
    })
}

/// Returns the first use of the position on the face in the fragment shader.
fn coordinate(reading: &Reading) -> Option<Id> {
    let is = |id: &Id| matches!(reading.graph.op(*id), Op::Interpolated(_)) && reading.graph.node(*id).width == 2;
    reading.lit.iter().copied().find(is)
}

/// Finds the negation of a component of the position on the face.
fn turned_component(reading: &Reading, expected: usize) -> Option<Id> {
    let graph = &reading.graph;
    let is_place = |id: Id| graph.node(id).width == 2 || matches!(reading.role(graph.plain(id)), Some(Role::Position));
    reading.lit.iter().copied().find(|id| match graph.op(*id) {
        Op::Neg(inner) => match graph.op(graph.plain(*inner)) {
            Op::Swizzle(base, letters) => {
                letters.len() == 1 && letters.chars().next().and_then(component) == Some(expected) && is_place(*base)
            }
            _ => false,
        },
        _ => false,
    })
}

/// Returns the component of a direction that a number is, and its sign.
fn side(graph: &Graph, id: Id) -> Option<(usize, f64)> {
    match graph.op(graph.plain(id)) {
        Op::Neg(inner) => side(graph, *inner).map(|(axis, sign)| (axis, -sign)),
        Op::Swizzle(_, letters) if letters.len() == 1 => Some((component(letters.chars().next()?)?, 1.0)),
        Op::Binary(BinaryOp::Multiply, a, b) => match (graph.scalar(*a), graph.scalar(*b)) {
            (Some(number), _) => side(graph, *b).map(|(axis, sign)| (axis, sign * number.signum())),
            (_, Some(number)) => side(graph, *a).map(|(axis, sign)| (axis, sign * number.signum())),
            _ => None,
        },
        _ => None,
    }
}

/// Returns the call that computes the longitude, by its two arguments.
fn arctangent(reading: &Reading, is: impl Fn(Id, (usize, f64), (usize, f64)) -> bool) -> Answer {
    let graph = &reading.graph;
    let Some(id) = call(reading, "atan") else { return Silent };
    let Some([y, x]) = graph.call(id, "atan") else { return Silent };
    match (side(graph, *y), side(graph, *x)) {
        (Some(y), Some(x)) if is(id, y, x) => At(id, 1.0),
        (Some(_), Some(_)) => Not,
        _ => Silent,
    }
}

/// Returns the division of an angle by a number that satisfies the condition.
fn scaled(reading: &Reading, angle: &str, is: impl Fn(f64) -> bool) -> Option<Id> {
    let graph = &reading.graph;
    let is_angle = |id: Id| graph.call(id, angle).is_some();
    reading.lit.iter().copied().find(|id| match graph.op(*id) {
        Op::Binary(BinaryOp::Divide, a, b) => is_angle(*a) && graph.scalar(*b).is_some_and(&is),
        Op::Binary(BinaryOp::Multiply, a, b) => {
            let by = |number: Id| graph.scalar(number).is_some_and(|by| is(1.0 / by));
            is_angle(*a) && by(*b) || is_angle(*b) && by(*a)
        }
        _ => false,
    })
}

/// Returns the first case of the face that an id names: `if (face == 2) return ...`.
fn face(reading: &Reading, id: &str) -> Option<Id> {
    let is_named = |word: &str| id.split('-').any(|part| part == word);
    (0..6).filter(|&number| is_named(FACES[number].0)).find_map(|number| case(reading, number))
}

/// A branch on the number of the face.
struct Chosen {
    /// The numbers that the face is compared with.
    numbers: Vec<f64>,
    test: Id,
    /// The value for these faces.
    then: Id,
    other: Id,
}

fn case(reading: &Reading, number: usize) -> Option<Id> {
    let graph = &reading.graph;
    let mut chosen: Vec<Chosen> = Vec::new();
    for id in &reading.lit {
        if let Op::Select(test, then, other) = graph.op(*id) {
            let numbers = compared(reading, *test);
            if !numbers.is_empty() {
                chosen.push(Chosen { numbers, test: *test, then: *then, other: *other });
            }
        }
    }
    // If a case assigns several variables, the direction, otherwise the first changed one.
    let of = |number: usize| {
        let fitting = chosen.iter().filter(|chosen| chosen.numbers.contains(&(number as f64)));
        fitting.min_by_key(|chosen| {
            let then = graph.node(chosen.then);
            (then.span.start < graph.node(chosen.test).span.start, then.width != 3, then.span.start)
        })
    };
    let is_choice = |id: Id| matches!(graph.op(graph.plain(id)), Op::Select(..));
    // The last case is the other branch of the previous one.
    let left_over = || of(number.checked_sub(1)?).map(|chosen| chosen.other).filter(|other| !is_choice(*other));
    // In another order of cases, the remaining one: `default`.
    let last = || {
        let is_only_one = (0..6).all(|other| of(other).is_some() != (other == number));
        chosen.iter().map(|chosen| chosen.other).find(|other| is_only_one && !is_choice(*other))
    };
    of(number).map(|chosen| chosen.then).or_else(left_over).or_else(last)
}

/// Returns the numbers that a test compares the face with: `face == 2`, `face == 2 || face == 3`.
fn compared(reading: &Reading, test: Id) -> Vec<f64> {
    let graph = &reading.graph;
    // `int(face)` is the face too.
    let is_face = |id: Id| reading.role(graph.core(id)) == Some(Role::Face);
    let mut numbers = Vec::new();
    let mut open = vec![test];
    while let Some(test) = open.pop() {
        match graph.op(graph.plain(test)) {
            Op::Binary(BinaryOp::Or, a, b) => open.extend([*a, *b]),
            Op::Binary(BinaryOp::Equal, a, b) if is_face(*a) => numbers.extend(graph.scalar(*b)),
            Op::Binary(BinaryOp::Equal, a, b) if is_face(*b) => numbers.extend(graph.scalar(*a)),
            _ => {}
        }
    }
    numbers
}
