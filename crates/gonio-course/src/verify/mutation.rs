//! Mistakes made in a reference: one operator, argument, constant or name at a time (mutation analysis: DeMillo, Lipton and
//! Sayward, *Hints on Test Data Selection*, 1978).

use super::source::{Source, range, replaced};
use gonio_glsl::ast::{BinaryOp, Call, ExprKind, Literal, UnaryOp};
use gonio_glsl::{Expr, Stage, Type};
use std::ops::Range;

/// A reference with one mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The shaders.
    pub shaders: [String; 2],
    /// The stage that was changed.
    pub stage: Stage,
    /// The line, from 1.
    pub line: u32,
    /// The text that was replaced.
    pub before: String,
    /// The text in its place.
    pub after: String,
}

/// All mutants of a reference, in the order of its text, vertex shader first.
#[must_use]
pub fn mutants(reference: &[String; 2]) -> Vec<Mutant> {
    let mut all: Vec<Mutant> = Vec::new();
    for (index, stage) in [Stage::Vertex, Stage::Fragment].into_iter().enumerate() {
        let source = Source::new(stage, &reference[index]);
        for expr in source.expressions() {
            for (at, after) in changes(&source, &expr) {
                let before = source.slice(at.clone()).to_owned();
                if before.is_empty() || before == after {
                    continue;
                }
                let line = source.text[..at.start].matches('\n').count() as u32 + 1;
                let mut shaders = reference.clone();
                shaders[index] = replaced(source.text, vec![(at, after.clone())]);
                if all.iter().all(|known| known.shaders != shaders) {
                    all.push(Mutant { shaders, stage, line, before, after });
                }
            }
        }
    }
    all
}

/// At most `most` of them, spread evenly.
#[must_use]
pub fn spread<T>(all: Vec<T>, most: usize) -> Vec<T> {
    let count = all.len();
    if count <= most {
        return all;
    }
    let is_taken = |at: usize| at * most / count != (at + 1) * most / count;
    all.into_iter().enumerate().filter(|(at, _)| is_taken(*at)).map(|(_, one)| one).collect()
}

/// The changes of one expression.
fn changes(source: &Source<'_>, expr: &Expr) -> Vec<(Range<usize>, String)> {
    let of = |expr: &Expr| source.of(expr).to_owned();
    let whole = |text: String| (range(expr), text);
    match &expr.kind {
        ExprKind::Binary { op, left, right } => {
            let mut changes = Vec::new();
            let gap = range(left).end..range(right).start;
            let other = match op {
                BinaryOp::Add => Some("-"),
                BinaryOp::Subtract => Some("+"),
                BinaryOp::Divide => Some("*"),
                BinaryOp::Multiply if is_scalar(right) => Some("/"),
                BinaryOp::Less | BinaryOp::LessEqual => Some(">"),
                BinaryOp::Greater | BinaryOp::GreaterEqual => Some("<"),
                _ => None,
            };
            // Comments between operands, and macros, are left alone.
            if let Some(other) = other.filter(|_| source.slice(gap.clone()).trim() == op.mark()) {
                changes.push((gap, format!(" {other} ")));
            }
            if matches!(op, BinaryOp::Add | BinaryOp::Subtract | BinaryOp::Multiply | BinaryOp::Divide) {
                let same = |operand: &Expr| operand.ty.is_some() && operand.ty == expr.ty;
                let kept = [left, right].into_iter().filter(|operand| same(operand));
                changes.extend(kept.map(|operand| whole(format!("({})", of(operand)))));
            }
            if *op == BinaryOp::Multiply && is_matrix(left) && is_matrix(right) {
                changes.push(whole(format!("({} * {})", of(right), of(left))));
            }
            changes
        }
        ExprKind::Unary { op: UnaryOp::Minus, operand } => vec![whole(format!("({})", of(operand)))],
        ExprKind::Call(call) => of_call(source, expr, call),
        ExprKind::Literal(Literal::Float(number)) => {
            let other = if *number == 0.0 { 0.5 } else { number * 0.5 };
            vec![whole(format!("{other:?}"))]
        }
        ExprKind::Name(name) => other_name(source, name).map(whole).into_iter().collect(),
        ExprKind::Field { name, name_span, .. } if is_components(name) && name.len() > 1 => {
            let mut reversed: Vec<char> = name.chars().collect();
            reversed.rotate_left(1);
            let at = name_span.start as usize..name_span.end as usize;
            vec![(at, reversed.into_iter().collect())]
        }
        _ => Vec::new(),
    }
}

fn of_call(source: &Source<'_>, expr: &Expr, call: &Call) -> Vec<(Range<usize>, String)> {
    let args: Vec<&str> = call.args.iter().map(|arg| source.of(arg)).collect();
    let whole = |text: String| (range(expr), text);
    let name = call.name.as_str();
    let mut changes = Vec::new();
    if call.is_constructor {
        return changes;
    }
    match (name, args.as_slice()) {
        ("normalize" | "abs" | "transpose" | "inverse", [only]) => changes.push(whole(format!("({only})"))),
        ("max" | "min" | "pow" | "clamp", [first, ..]) if call.args[0].ty == expr.ty => {
            changes.push(whole(format!("({first})")));
        }
        _ => {}
    }
    if let [a, b, rest @ ..] = args.as_slice()
        && matches!(name, "reflect" | "refract" | "cross" | "pow" | "mix" | "step")
        && call.args[0].ty == call.args[1].ty
    {
        let all: Vec<&str> = [*b, *a].into_iter().chain(rest.iter().copied()).collect();
        changes.push(whole(format!("{name}({})", all.join(", "))));
    }
    if let [a, rest @ ..] = args.as_slice()
        && matches!(name, "dot" | "reflect" | "refract")
    {
        changes.push(whole(format!("{name}(-({a}), {})", rest.join(", "))));
    }
    changes
}

/// Another input of the same type: the next one in the source.
fn other_name(source: &Source<'_>, name: &str) -> Option<String> {
    let interface = &source.checked.interface;
    let all: Vec<_> = interface.uniforms.iter().chain(&interface.inputs).collect();
    let at = all.iter().position(|variable| variable.name == name)?;
    let ty = all[at].ty.as_ref().filter(|ty| !matches!(ty, Type::Struct(_) | Type::Opaque(_) | Type::Array(..)))?;
    let later = all.iter().skip(at + 1).chain(all.iter().take(at));
    later.into_iter().find(|other| other.ty.as_ref() == Some(ty)).map(|other| other.name.clone())
}

fn is_components(name: &str) -> bool {
    ["xyzw", "rgba", "stpq"].iter().any(|set| name.chars().all(|c| set.contains(c)))
}

fn is_scalar(expr: &Expr) -> bool {
    matches!(expr.ty, Some(Type::Scalar(_)))
}

fn is_matrix(expr: &Expr) -> bool {
    matches!(expr.ty, Some(Type::Matrix { .. }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTEX: &str = "#version 330 core\nin vec3 position;\nuniform mat4 P, V;\nvoid main() {\n    gl_Position = P * V * vec4(position, 1.0);\n}\n";
    const FRAGMENT: &str = "#version 330 core\nuniform vec3 a, b;\nout vec4 c;\nvoid main() {\n    c = vec4(max(dot(a, b), 0.0) - 2.0);\n}\n";

    #[test]
    fn each_mutant_differs_in_one_place_and_states_its_line() {
        let reference = [VERTEX.to_owned(), FRAGMENT.to_owned()];
        let all = mutants(&reference);
        let written: Vec<(u32, &str, &str)> =
            all.iter().map(|m| (m.line, m.before.as_str(), m.after.as_str())).collect();
        for expected in [
            (5, "P * V", "(V * P)"),
            (5, "P", "V"),
            (5, "1.0", "0.5"),
            (5, " - ", " + "),
            (5, "max(dot(a, b), 0.0)", "(dot(a, b))"),
            (5, "dot(a, b)", "dot(-(a), b)"),
            (5, "0.0", "0.5"),
            (5, "a", "b"),
        ] {
            assert!(written.contains(&expected), "{expected:?} is not in {written:?}");
        }
        for mutant in &all {
            let index = usize::from(mutant.stage == Stage::Fragment);
            assert_eq!(mutant.shaders[1 - index], reference[1 - index]);
            let lines = mutant.shaders[index].lines().zip(reference[index].lines());
            let changed: Vec<usize> = lines.enumerate().filter(|(_, (a, b))| a != b).map(|(at, _)| at + 1).collect();
            assert_eq!(changed, [mutant.line as usize], "{mutant:?}");
        }
    }

    #[test]
    fn a_spread_keeps_the_order_and_the_number() {
        assert_eq!(spread((0..10).collect(), 3).len(), 3);
        assert_eq!(spread((0..3).collect::<Vec<_>>(), 10), [0, 1, 2]);
        assert!(spread((0..100).collect(), 7).is_sorted());
    }
}
