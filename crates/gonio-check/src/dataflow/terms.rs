//! Classifies the numbers of a program: terms of the light equation, and the products whose sum is the colour.

use super::graph::{Graph, Id, Op, is_leading};
use super::vector::{Vector, VectorKind};
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;

/// The factors that a number contains, one bit each.
pub(crate) type Bits = u16;
/// The cosine between normal and light.
pub(crate) const DIFFUSE: Bits = 1;
/// The cosine of the highlight, or a power of it.
pub(crate) const SPECULAR: Bits = 2;
/// The ambient strength.
pub(crate) const AMBIENT: Bits = 4;
/// A distance.
pub(crate) const ATTENUATION: Bits = 8;
pub(crate) const ALBEDO: Bits = 16;
pub(crate) const DIFFUSE_STRENGTH: Bits = 32;
pub(crate) const SPECULAR_STRENGTH: Bits = 64;
/// A uniform of unknown meaning.
pub(crate) const OTHER: Bits = 128;

/// A product.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Product {
    pub bits: Bits,
    /// Number of factors that are the material's colour.
    pub albedo: u8,
    pub factors: Vec<Id>,
}

/// Most products of a sum that is expanded.
const MOST_PRODUCTS: usize = 40;

/// Whether the operands of this node are numbers that the colour is computed from, not vectors.
pub(crate) fn is_open(graph: &Graph, vectors: &[Option<Vector>], id: Id) -> bool {
    let vector = vectors.get(id.0 as usize).copied().flatten();
    if vector.is_some_and(|vector| vector.kind != VectorKind::Constant && graph.number(id).is_none()) {
        return false;
    }
    match graph.op(id) {
        Op::Call(name, _) => {
            let is_leaf = matches!(name.as_str(), "dot" | "length" | "distance" | "normalize" | "reflect" | "refract");
            !is_leaf && !name.starts_with("texture")
        }
        _ => true,
    }
}

/// Returns the operands that a number is computed from, without conditions.
pub(crate) fn value_parts(graph: &Graph, id: Id) -> Vec<Id> {
    match graph.op(id) {
        Op::Select(_, a, b) => vec![*a, *b],
        Op::Binary(BinaryOp::Multiply, a, b) if [a, b].iter().any(|side| graph.scalar(**side) == Some(0.0)) => {
            Vec::new()
        }
        // Without the lengths that normalise a dot product.
        Op::Binary(BinaryOp::Divide, a, b) if is_cosine_by_lengths(graph, *a, *b).is_some() => vec![*a],
        _ => graph.parts(id),
    }
}

/// Returns the factors that each node contains.
pub(crate) fn bits(graph: &Graph, vectors: &[Option<Vector>]) -> Vec<Bits> {
    let mut found: Vec<Bits> = Vec::with_capacity(graph.len());
    for id in graph.ids() {
        let of = |id: Id| found.get(id.0 as usize).copied().unwrap_or(0);
        let all = || value_parts(graph, id).into_iter().fold(0, |bits, part| bits | of(part));
        let vector = |id: Id| vectors.get(id.0 as usize).copied().flatten();
        let bits = match graph.op(id) {
            Op::Input { name, role } => role.map_or_else(|| by_name(name, OTHER), by_role),
            Op::Copy(a, name) if graph.number(*a).is_some() => by_name(name, 0),
            Op::Call(name, parts) => match (name.as_str(), &parts[..]) {
                ("dot", [a, b]) if graph.is_same(*a, *b) => ATTENUATION,
                ("dot", [a, b]) => dot(vector(*a), vector(*b)),
                ("length" | "distance", _) => ATTENUATION,
                ("pow", [base, exponent]) => power(graph, of(*base), *base, *exponent),
                (name, _) if name.starts_with("texture") => 0,
                _ if is_open(graph, vectors, id) => all(),
                _ => 0,
            },
            Op::Binary(BinaryOp::Divide, a, b) if is_cosine_by_lengths(graph, *a, *b).is_some() => of(*a),
            Op::Binary(BinaryOp::Multiply, a, b) => match (vector(*a), vector(*b)) {
                // Written component by component.
                (Some(a), Some(b)) if a.is_normal() && b.is_light() || b.is_normal() && a.is_light() => DIFFUSE,
                _ => all(),
            },
            _ if is_open(graph, vectors, id) => all(),
            _ => 0,
        };
        found.push(bits);
    }
    found
}

/// If a dot product is divided by the lengths of its vectors, `dot(a, b) / (length(a) * length(b))`, returns the
/// vectors.
pub(crate) fn is_cosine_by_lengths(graph: &Graph, dot: Id, by: Id) -> Option<Vec<Id>> {
    let operands = graph.call(dot, "dot")?;
    let mut open = vec![by];
    let mut found = Vec::new();
    while let Some(id) = open.pop() {
        match graph.op(graph.plain(id)) {
            Op::Binary(BinaryOp::Multiply, a, b) if open.len() < 4 => open.extend([*a, *b]),
            Op::Call(name, parts) if name == "length" => {
                let of = *parts.first()?;
                found.push(*operands.iter().find(|operand| graph.is_same(**operand, of))?);
            }
            _ => return None,
        }
    }
    Some(found)
}

fn by_role(role: Role) -> Bits {
    match role {
        Role::AmbientStrength(_) | Role::AmbientColor(_) => AMBIENT,
        Role::MaterialAmbient => AMBIENT | ALBEDO,
        Role::DiffuseStrength(_) | Role::DiffuseColor(_) => DIFFUSE_STRENGTH,
        Role::SpecularStrength(_) | Role::SpecularColor(_) => SPECULAR_STRENGTH,
        Role::AttenuationConstant(_)
        | Role::AttenuationLinear(_)
        | Role::AttenuationQuadratic(_)
        | Role::Attenuation(_) => ATTENUATION,
        Role::MaterialColor | Role::MaterialDiffuse => ALBEDO,
        _ => 0,
    }
}

fn by_name(name: &str, otherwise: Bits) -> Bits {
    let name = name.to_lowercase();
    if name.contains("amb") {
        AMBIENT
    } else if ["objectcol", "objcol", "material", "albedo"].iter().any(|word| name.contains(word)) {
        ALBEDO
    } else {
        otherwise
    }
}

fn dot(a: Option<Vector>, b: Option<Vector>) -> Bits {
    let (Some(a), Some(b)) = (a, b) else {
        // An unknown vector in a highlight is the position of the eye.
        return match a.or(b) {
            Some(v) if matches!(v.kind, VectorKind::Reflected(_) | VectorKind::Half) => SPECULAR,
            Some(v) if v.is_normal() || v.is_light() => DIFFUSE,
            _ => 0,
        };
    };
    let either = |is: &dyn Fn(&Vector) -> bool| is(&a) || is(&b);
    // The cone of a spot light: the cosine of its axis and the direction to it.
    if a.is_light() && b.is_light() {
        return 0;
    }
    if either(&|v| matches!(v.kind, VectorKind::Reflected(_) | VectorKind::Refracted(_) | VectorKind::Half))
        || either(&Vector::is_eye)
    {
        SPECULAR
    } else if either(&Vector::is_light) || either(&Vector::is_normal) {
        DIFFUSE
    } else {
        0
    }
}

/// Returns the factors of a power: a power of a cosine is a highlight, of a colour a gamma curve, of a half Lambert
/// term still diffuse.
fn power(graph: &Graph, base_bits: Bits, base: Id, exponent: Id) -> Bits {
    let is_cosine = base_bits & (DIFFUSE | SPECULAR) == base_bits && graph.node(base).width == 1;
    let is_half = matches!(graph.op(graph.plain(base)), Op::Binary(BinaryOp::Add, ..));
    if base_bits == 0 || !is_cosine || is_half && graph.scalar(exponent) == Some(2.0) { base_bits } else { SPECULAR }
}

/// Returns for each of these nodes, sorted by index, the products whose sum it is.
pub(crate) fn products(graph: &Graph, vectors: &[Option<Vector>], bits: &[Bits], tree: &[Id]) -> Vec<Vec<Product>> {
    let mut found: Vec<Vec<Product>> = vec![Vec::new(); graph.len()];
    for id in tree {
        let node = |id: Id| found[id.0 as usize].clone();
        let leaf = || {
            let bits = bits[id.0 as usize];
            vec![Product { bits, albedo: u8::from(bits & ALBEDO != 0), factors: vec![*id] }]
        };
        let made = if !is_open(graph, vectors, *id) || graph.number(*id).is_some() {
            if graph.number(*id).is_some_and(|n| n.iter().all(|x| *x == 0.0)) { Vec::new() } else { leaf() }
        } else {
            match graph.op(*id) {
                Op::Copy(a, _) | Op::Interpolated(a) | Op::Neg(a) => node(*a),
                Op::Swizzle(a, letters) if letters.len() >= 3 => node(*a),
                Op::Write(_, letters, value) if is_leading(letters) => node(*value),
                Op::Write(before, letters, _) if letters == "a" || letters == "w" => node(*before),
                Op::Construct(parts) => match parts[..] {
                    [one] => node(one),
                    [first, _] if graph.node(first).width == 3 => node(first),
                    _ => graph.repeated(parts).map_or_else(leaf, node),
                },
                Op::Binary(BinaryOp::Add | BinaryOp::Subtract, a, b) => [node(*a), node(*b)].concat(),
                Op::Binary(BinaryOp::Multiply, a, b) => times(&node(*a), &node(*b)),
                Op::Binary(BinaryOp::Divide, a, b) if is_cosine_by_lengths(graph, *a, *b).is_some() => leaf(),
                Op::Binary(BinaryOp::Divide, a, b) => {
                    let by = bits[b.0 as usize];
                    times(&node(*a), &[Product { bits: by, albedo: 0, factors: vec![*b] }])
                }
                Op::Select(_, a, b) => [node(*a), node(*b)].concat(),
                Op::Call(name, parts) if matches!(name.as_str(), "max" | "min" | "clamp" | "abs" | "mix") => {
                    let is_sum = parts.iter().any(|part| node(*part).len() > 1);
                    let terms =
                        parts.iter().filter(|part| graph.number(**part).is_none() && bits[part.0 as usize] != 0);
                    if is_sum || terms.clone().count() > 1 {
                        terms.flat_map(|part| node(*part)).collect()
                    } else {
                        leaf()
                    }
                }
                _ => leaf(),
            }
        };
        found[id.0 as usize] = if made.len() > MOST_PRODUCTS { leaf() } else { made };
    }
    found
}

fn times(a: &[Product], b: &[Product]) -> Vec<Product> {
    let mut made = Vec::new();
    for a in a {
        for b in b {
            if made.len() > MOST_PRODUCTS || a.factors.len() + b.factors.len() > 24 {
                return made;
            }
            made.push(Product {
                bits: a.bits | b.bits,
                albedo: a.albedo.saturating_add(b.albedo),
                factors: [&a.factors[..], &b.factors[..]].concat(),
            });
        }
    }
    made
}
