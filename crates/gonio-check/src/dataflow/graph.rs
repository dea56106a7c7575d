//! The values of a program as a graph: each node refers to earlier ones and to its position in the source. Nodes with
//! values that are known without running the shader are folded.

use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;
use gonio_glsl::{Components, Scalar, Span, Stage, Type};

/// The index of a node. Operands have smaller indices, so that one pass can derive properties of all nodes from those
/// of their operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Id(pub u32);

/// The operation of a node.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Op {
    /// An unknown value.
    Unknown,
    /// A value that is known without running the shader.
    Number(Components),
    /// An attribute, a uniform, or a part of one: `light.light_pos`.
    Input {
        name: String,
        role: Option<Role>,
    },
    /// An output of the vertex shader, interpolated.
    Interpolated(Id),
    /// The value of a variable of this name.
    Copy(Id, String),
    Neg(Id),
    Binary(BinaryOp, Id, Id),
    /// A call of a built-in function.
    Call(String, Vec<Id>),
    /// A vector or matrix constructed from parts.
    Construct(Vec<Id>),
    /// `.xyz`
    Swizzle(Id, String),
    /// `[..]` of a vector, a matrix or an unknown array.
    Index(Id, Option<usize>),
    /// A choice: condition, value if true, value if false.
    Select(Id, Id, Id),
    /// A vector with some components replaced, or a matrix with a column replaced, `[3]`.
    Write(Id, String, Id),
    Struct(Vec<(String, Id)>),
    Array(Vec<Id>),
}

#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub op: Op,
    pub stage: Stage,
    pub span: Span,
    /// Number of components: 1 to 4, or those of a matrix; 0 if it has none or they are unknown.
    pub width: u8,
    pub is_matrix: bool,
    pub is_integer: bool,
    /// Its value, if it is known without running the shader.
    pub number: Option<Components>,
}

/// Far above the size of any real program.
const MOST_NODES: usize = 40_000;

#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    nodes: Vec<Node>,
}

impl Graph {
    pub fn new() -> Self {
        let mut graph = Graph::default();
        graph.push(Op::Unknown, Stage::Vertex, Span::default(), None);
        graph
    }

    /// The node of all unknown values.
    pub const UNKNOWN: Id = Id(0);

    pub fn push(&mut self, op: Op, stage: Stage, span: Span, ty: Option<&Type>) -> Id {
        if self.nodes.len() >= MOST_NODES {
            return Self::UNKNOWN;
        }
        let number = folded(self, &op, ty);
        let width = ty.and_then(Type::components).unwrap_or(0).min(16) as u8;
        let is_matrix = matches!(ty, Some(Type::Matrix { .. }));
        let is_integer = matches!(ty.and_then(Type::scalar), Some(Scalar::Int | Scalar::UInt));
        self.nodes.push(Node { op, stage, span, width, is_matrix, is_integer, number });
        Id(self.nodes.len() as u32 - 1)
    }

    /// Adds a node with the type of another node.
    pub fn push_like(&mut self, op: Op, like: Id, stage: Stage, span: Span) -> Id {
        let Node { width, is_matrix, is_integer, .. } = *self.node(like);
        let id = self.push(op, stage, span, None);
        if id != Self::UNKNOWN
            && let Some(node) = self.nodes.get_mut(id.0 as usize)
        {
            (node.width, node.is_matrix, node.is_integer) = (width, is_matrix, is_integer);
        }
        id
    }

    pub fn node(&self, id: Id) -> &Node {
        // Ids come only from `push`.
        &self.nodes[id.0 as usize]
    }

    pub fn op(&self, id: Id) -> &Op {
        &self.node(id).op
    }

    pub fn number(&self, id: Id) -> Option<&Components> {
        self.node(id).number.as_ref()
    }

    /// Returns the number, if the node has one component or several equal ones.
    pub fn scalar(&self, id: Id) -> Option<f64> {
        let number = self.number(id)?;
        let first = *number.first()?;
        number.iter().all(|n| *n == first).then_some(first)
    }

    pub fn ids(&self) -> impl DoubleEndedIterator<Item = Id> + use<> {
        (0..self.nodes.len() as u32).map(Id)
    }

    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    pub fn parts(&self, id: Id) -> Vec<Id> {
        match self.op(id) {
            Op::Unknown | Op::Number(_) | Op::Input { .. } => Vec::new(),
            Op::Interpolated(a) | Op::Copy(a, _) | Op::Neg(a) | Op::Swizzle(a, _) | Op::Index(a, _) => vec![*a],
            Op::Binary(_, a, b) | Op::Write(a, _, b) => vec![*a, *b],
            Op::Select(a, b, c) => vec![*a, *b, *c],
            Op::Call(_, parts) | Op::Construct(parts) | Op::Array(parts) => parts.clone(),
            Op::Struct(fields) => fields.iter().map(|(_, id)| *id).collect(),
        }
    }

    /// Returns the node without the variables that it was assigned to.
    pub fn plain(&self, mut id: Id) -> Id {
        while let Op::Copy(inner, _) = self.op(id) {
            id = *inner;
        }
        id
    }

    /// Returns the node without variables, stages, and changes of the number of components.
    pub fn core(&self, mut id: Id) -> Id {
        loop {
            id = match self.op(id) {
                Op::Copy(inner, _) | Op::Interpolated(inner) => *inner,
                Op::Swizzle(inner, letters) if is_leading(letters) => *inner,
                Op::Write(_, letters, value) if is_leading(letters) => *value,
                Op::Write(before, letters, _) if letters == "a" || letters == "w" => *before,
                Op::Construct(parts) if !self.node(id).is_matrix => match parts[..] {
                    [one] => one,
                    [first, last] if self.node(first).width == 3 && self.number(last).is_some() => first,
                    _ => match self.repeated(parts) {
                        Some(first) => first,
                        None => return id,
                    },
                },
                _ => return id,
            }
        }
    }

    /// Whether two nodes have the same value, perhaps read twice.
    pub fn is_same(&self, a: Id, b: Id) -> bool {
        let (a, b) = (self.plain(a), self.plain(b));
        a == b
            || a != Self::UNKNOWN
                && matches!(self.op(a), Op::Input { .. } | Op::Interpolated(_))
                && self.op(a) == self.op(b)
    }

    /// Returns the node that the first three components share: `vec4(i, i, i, 1.0)`.
    pub fn repeated(&self, parts: &[Id]) -> Option<Id> {
        let first = *parts.first()?;
        let is_grey = parts.len() >= 3 && parts[1..3].iter().all(|part| self.is_same(*part, first));
        (is_grey && self.node(first).width == 1).then_some(first)
    }

    /// Returns the arguments if the node is a call of this function, without variables around it.
    pub fn call(&self, id: Id, name: &str) -> Option<&[Id]> {
        match self.op(self.plain(id)) {
            Op::Call(called, parts) if called == name => Some(parts),
            _ => None,
        }
    }

    /// Returns all nodes that these depend on, including themselves, in order of their indices.
    pub fn reachable(&self, from: &[Id], into: impl Fn(Id) -> bool) -> Vec<Id> {
        let mut seen = vec![false; self.len()];
        let mut open: Vec<Id> = from.to_vec();
        while let Some(id) = open.pop() {
            if !std::mem::replace(&mut seen[id.0 as usize], true) && into(id) {
                open.extend(self.parts(id));
            }
        }
        self.ids().filter(|id| seen[id.0 as usize]).collect()
    }
}

/// Whether a swizzle selects the first components in order: `.xyz`, `.rgb`, `.xyzw`.
pub(crate) fn is_leading(letters: &str) -> bool {
    letters.len() >= 3 && ["xyzw", "rgba", "stpq"].iter().any(|set| set.starts_with(letters))
}

/// Returns the component that a letter names.
pub(crate) fn component(letter: char) -> Option<usize> {
    ["xyzw", "rgba", "stpq"].iter().find_map(|set| set.find(letter))
}

/// Returns the value of a node that is about to be created, if it is known.
fn folded(graph: &Graph, op: &Op, ty: Option<&Type>) -> Option<Components> {
    let of = |id: &Id| graph.number(*id);
    match op {
        Op::Number(number) => Some(number.clone()),
        // Unknown switches are off: `if (useNormalMap)`.
        Op::Input { role: None, .. } if ty == Some(&Type::Scalar(Scalar::Bool)) => Some(vec![0.0]),
        Op::Copy(a, _) | Op::Interpolated(a) => of(a).cloned(),
        Op::Neg(a) => Some(of(a)?.iter().map(|x| -x).collect()),
        Op::Binary(op, a, b) => {
            let is_matrix = |id: &Id| graph.node(*id).is_matrix;
            if *op == BinaryOp::Multiply && (is_matrix(a) || is_matrix(b)) {
                return None;
            }
            let is_integer = graph.node(*a).is_integer && graph.node(*b).is_integer;
            binary(*op, of(a)?, of(b)?, is_integer)
        }
        Op::Construct(parts) => construct(graph, parts, ty?),
        Op::Swizzle(a, letters) => {
            let number = of(a)?;
            letters.chars().map(|letter| number.get(component(letter)?).copied()).collect()
        }
        Op::Index(a, Some(index)) if !graph.node(*a).is_matrix => Some(vec![*of(a)?.get(*index)?]),
        Op::Select(_, a, b) => of(a).filter(|a| of(b) == Some(a)).cloned(),
        Op::Write(base, letters, value) => {
            let (mut number, value) = (of(base)?.clone(), of(value)?);
            for (i, letter) in letters.chars().enumerate() {
                *number.get_mut(component(letter)?)? = *value.get(i.min(value.len() - 1))?;
            }
            Some(number)
        }
        Op::Call(name, parts) => call(name, &parts.iter().map(of).collect::<Option<Vec<_>>>()?),
        _ => None,
    }
}

fn each(a: &[f64], b: &[f64], of: impl Fn(f64, f64) -> f64) -> Option<Components> {
    let count = a.len().max(b.len());
    if a.is_empty() || b.is_empty() || [a.len(), b.len()].iter().any(|n| *n != 1 && *n != count) {
        return None;
    }
    Some((0..count).map(|i| of(a[i % a.len()], b[i % b.len()])).collect())
}

fn binary(op: BinaryOp, a: &[f64], b: &[f64], is_integer: bool) -> Option<Components> {
    let truth = |value: bool| Some(vec![f64::from(u8::from(value))]);
    match op {
        BinaryOp::Add => each(a, b, |a, b| a + b),
        BinaryOp::Subtract => each(a, b, |a, b| a - b),
        BinaryOp::Multiply => each(a, b, |a, b| a * b),
        BinaryOp::Divide if is_integer && b.contains(&0.0) => None,
        BinaryOp::Divide if is_integer => each(a, b, |a, b| (a / b).trunc()),
        BinaryOp::Divide => each(a, b, |a, b| a / b),
        BinaryOp::Remainder if !b.contains(&0.0) => each(a, b, |a, b| a % b),
        BinaryOp::Equal => truth(a == b),
        BinaryOp::NotEqual => truth(a != b),
        _ => {
            let (a, b) = (*a.first()?, *b.first()?);
            match op {
                BinaryOp::Less => truth(a < b),
                BinaryOp::Greater => truth(a > b),
                BinaryOp::LessEqual => truth(a <= b),
                BinaryOp::GreaterEqual => truth(a >= b),
                BinaryOp::And => truth(a != 0.0 && b != 0.0),
                BinaryOp::Or => truth(a != 0.0 || b != 0.0),
                _ => None,
            }
        }
    }
}

fn construct(graph: &Graph, parts: &[Id], ty: &Type) -> Option<Components> {
    let mut values = Components::new();
    for part in parts {
        values.extend(graph.number(*part)?);
    }
    let count = ty.components()? as usize;
    if let Type::Matrix { rows, .. } = ty {
        let rows = usize::from(*rows);
        let diagonal = |i: usize| if i.is_multiple_of(rows + 1) { values[0] } else { 0.0 };
        return match values.len() {
            1 => Some((0..count).map(diagonal).collect()),
            given => (given == count).then_some(values),
        };
    }
    if values.len() == 1 {
        values = vec![values[0]; count];
    }
    (values.len() >= count).then(|| values[..count].to_vec())
}

fn call(name: &str, parts: &[&Components]) -> Option<Components> {
    let one = |of: fn(f64) -> f64| Some(parts.first()?.iter().map(|x| of(*x)).collect());
    let two = |of: fn(f64, f64) -> f64| each(parts.first()?, parts.get(1)?, of);
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    match name {
        "abs" => one(f64::abs),
        "sign" => one(|x| if x == 0.0 { 0.0 } else { x.signum() }),
        "floor" => one(f64::floor),
        "ceil" => one(f64::ceil),
        "sqrt" => one(f64::sqrt),
        "inversesqrt" => one(|x| 1.0 / x.sqrt()),
        "exp" => one(f64::exp),
        "exp2" => one(f64::exp2),
        "log" => one(f64::ln),
        "log2" => one(f64::log2),
        "radians" => one(f64::to_radians),
        "degrees" => one(f64::to_degrees),
        "sin" => one(f64::sin),
        "cos" => one(f64::cos),
        "tan" => one(f64::tan),
        "pow" => two(f64::powf),
        "min" => two(f64::min),
        "max" => two(f64::max),
        "clamp" => each(&each(parts.first()?, parts.get(1)?, f64::max)?, parts.get(2)?, f64::min),
        "length" => Some(vec![length(parts.first()?)]),
        "normalize" => {
            let length = length(parts.first()?);
            Some(parts.first()?.iter().map(|x| x / length).collect())
        }
        "dot" => Some(vec![parts.first()?.iter().zip(parts.get(1)?.iter()).map(|(a, b)| a * b).sum()]),
        _ => None,
    }
}
