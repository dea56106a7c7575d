//! The analysis of a program: the meaning of its vectors, matrices and numbers, and which of them its colour depends
//! on.

use super::Shader;
use super::graph::{Graph, Id, Op};
use super::matrix;
use super::run::Program;
use super::terms::{self, Bits, DIFFUSE, Product, SPECULAR};
use super::vector::{self, Incoming, Vector, VectorKind};
use crate::roles::{NamesFile, Role};
use gonio_glsl::ast::BinaryOp;

pub(crate) struct Reading {
    pub graph: Graph,
    pub position: Option<Id>,
    pub colour: Option<Id>,
    vectors: Vec<Option<Vector>>,
    bits: Vec<Bits>,
    products: Vec<Vec<Product>>,
    /// All nodes that the colour depends on.
    pub lit: Vec<Id>,
    /// All nodes that the value of the colour is computed from, except those within vectors.
    pub tree: Vec<Id>,
    /// For each node, the nodes of `tree` that it is an operand of.
    parents: Vec<Vec<Id>>,
    /// All conditions that choose the colour.
    tests: Vec<Id>,
}

/// Marks the vectors of cosines that are divided by their lengths as normalised.
fn normalise_by_division(graph: &Graph, vectors: &mut [Option<Vector>]) {
    for id in graph.ids() {
        if let Op::Binary(BinaryOp::Divide, dot, by) = graph.op(id) {
            for operand in terms::is_cosine_by_lengths(graph, *dot, *by).into_iter().flatten() {
                if let Some(Some(vector)) = vectors.get_mut(operand.0 as usize) {
                    (vector.is_unit, vector.is_between) = (true, false);
                }
            }
        }
    }
}

impl Reading {
    pub fn new(vertex: &Shader, fragment: &Shader, names: &NamesFile) -> Self {
        let Program { graph, position, colour } = Program::new(vertex, fragment, names);
        let matrices = matrix::matrices(&graph);
        let mut vectors = vector::vectors(&graph, &matrices);
        normalise_by_division(&graph, &mut vectors);
        let bits = terms::bits(&graph, &vectors);
        let outputs: Vec<Id> = colour.into_iter().collect();
        let lit = graph.reachable(&outputs, |_| true);
        let all = graph.reachable(&outputs, |id| terms::is_open(&graph, &vectors, id));
        // Without the conditions that choose a value.
        let mut is_value = vec![false; graph.len()];
        for id in &outputs {
            is_value[id.0 as usize] = true;
        }
        let mut parents = vec![Vec::new(); graph.len()];
        let mut tree = Vec::new();
        for id in all.into_iter().rev().filter(|id| *id != Graph::UNKNOWN) {
            if !is_value[id.0 as usize] {
                continue;
            }
            tree.push(id);
            if terms::is_open(&graph, &vectors, id) {
                for part in terms::value_parts(&graph, id) {
                    is_value[part.0 as usize] = true;
                    parents[part.0 as usize].push(id);
                }
            }
        }
        tree.reverse();
        let is_select = |id: &Id| match graph.op(*id) {
            Op::Select(test, ..) => Some(*test),
            _ => None,
        };
        let tests: Vec<Id> = tree.iter().filter_map(is_select).collect();
        let tests = graph.reachable(&tests, |_| true);
        let products = terms::products(&graph, &vectors, &bits, &tree);
        Reading { graph, position, colour, vectors, bits, products, lit, tree, parents, tests }
    }

    pub fn vector(&self, id: Id) -> Option<Vector> {
        self.vectors.get(id.0 as usize).copied().flatten()
    }

    pub fn bits(&self, id: Id) -> Bits {
        self.bits.get(id.0 as usize).copied().unwrap_or(0)
    }

    pub fn products(&self, id: Id) -> &[Product] {
        self.products.get(id.0 as usize).map_or(&[], Vec::as_slice)
    }

    pub fn parents(&self, id: Id) -> &[Id] {
        self.parents.get(id.0 as usize).map_or(&[], Vec::as_slice)
    }

    pub fn role(&self, id: Id) -> Option<Role> {
        match self.graph.op(id) {
            Op::Input { role, .. } => *role,
            _ => None,
        }
    }

    /// Returns the operands if the node is this operation.
    pub fn sides(&self, id: Id, operator: BinaryOp) -> Option<(Id, Id)> {
        match self.graph.op(id) {
            Op::Binary(op, a, b) if *op == operator => Some((*a, *b)),
            _ => None,
        }
    }

    /// Returns the calls of a function that the value of the colour is computed from.
    pub fn calls<'s>(&'s self, function: &'s str) -> impl Iterator<Item = (Id, &'s [Id])> + 's {
        self.tree.iter().filter_map(move |id| match self.graph.op(*id) {
            Op::Call(name, parts) if name == function => Some((*id, parts.as_slice())),
            _ => None,
        })
    }

    /// Returns the dot products with these bits, with their operands.
    pub fn dots(&self, bits: Bits) -> Vec<(Id, Id, Id)> {
        self.calls("dot")
            .filter_map(|(id, parts)| match parts {
                [a, b] if self.bits(id) & bits != 0 => Some((id, *a, *b)),
                _ => None,
            })
            .collect()
    }

    /// Returns the powers of cosines.
    pub fn powers(&self) -> Vec<(Id, Id, Id)> {
        self.calls("pow")
            .filter_map(|(id, parts)| match parts {
                [base, exponent] if self.bits(id) == SPECULAR => Some((id, *base, *exponent)),
                _ => None,
            })
            .collect()
    }

    /// Returns the operations on a cosine until it meets anything but numbers: clamps, absolute values, added
    /// numbers, powers.
    pub fn around(&self, id: Id) -> Vec<Id> {
        let mut found: Vec<Id> = Vec::new();
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            for parent in self.parents(id) {
                let is_around = match self.graph.op(*parent) {
                    Op::Copy(..) | Op::Interpolated(_) | Op::Neg(_) | Op::Select(..) => true,
                    Op::Call(name, parts) => {
                        matches!(name.as_str(), "max" | "min" | "clamp" | "abs" | "pow" | "smoothstep" | "step")
                            && parts.iter().all(|part| *part == id || self.bits(*part) & (DIFFUSE | SPECULAR) == 0)
                    }
                    Op::Binary(BinaryOp::Divide, a, b)
                        if terms::is_cosine_by_lengths(&self.graph, *a, *b).is_some() =>
                    {
                        true
                    }
                    Op::Binary(_, a, b) => {
                        let other = if *a == id { *b } else { *a };
                        self.graph.number(other).is_some()
                    }
                    _ => false,
                };
                if is_around && !found.contains(parent) {
                    found.push(*parent);
                    open.push(*parent);
                }
            }
        }
        found
    }

    /// Whether a cosine of this kind chooses a value, as in `if (dot(N, L) > 0.0)`.
    pub fn is_tested(&self, bits: Bits) -> bool {
        self.tests.iter().any(|id| self.bits(*id) & bits != 0)
    }

    /// Whether a node is within a power of a cosine.
    pub fn is_in_power(&self, id: Id) -> bool {
        self.around(id).iter().any(|around| self.graph.call(*around, "pow").is_some() && self.bits(*around) == SPECULAR)
    }

    /// Returns the dot products of normal and light that are not within a power.
    pub fn diffuse_dots(&self) -> Vec<(Id, Id, Id)> {
        self.dots(DIFFUSE).into_iter().filter(|(id, ..)| !self.is_in_power(*id)).collect()
    }

    /// Returns the dot products that the highlight is computed from.
    pub fn specular_dots(&self) -> Vec<(Id, Id, Id)> {
        self.dots(DIFFUSE | SPECULAR)
            .into_iter()
            .filter(|(id, ..)| self.bits(*id) == SPECULAR || self.is_in_power(*id))
            .collect()
    }

    /// Returns the nodes that are used as a normal.
    pub fn normals(&self) -> Vec<Id> {
        let mut found = Vec::new();
        for (_, a, b) in self.diffuse_dots() {
            match (self.vector(a), self.vector(b)) {
                (_, Some(v)) if v.is_light() => found.push(a),
                (Some(v), _) if v.is_light() => found.push(b),
                (Some(v), _) if v.is_normal() => found.push(a),
                (_, Some(v)) if v.is_normal() => found.push(b),
                _ => {}
            }
        }
        for id in &self.lit {
            match self.graph.op(*id) {
                Op::Call(name, parts) if matches!(name.as_str(), "reflect" | "refract") => found.extend(parts.get(1)),
                // 2 (N.L) N in the formula of the reflection.
                Op::Binary(BinaryOp::Multiply, a, b)
                    if self.vector(*id).is_some_and(|v| v.kind == VectorKind::AlongNormal) =>
                {
                    found.extend([a, b].into_iter().filter(|id| self.vector(**id).is_some_and(|v| v.is_normal())));
                }
                _ => {}
            }
        }
        for (_, a, b) in self.specular_dots() {
            found.extend([a, b].iter().filter(|id| self.vector(**id).is_some_and(|v| v.is_normal())));
        }
        // Written component by component.
        for id in self.tree.iter().filter(|id| self.bits(**id) == DIFFUSE) {
            if let Some((a, b)) = self.sides(*id, BinaryOp::Multiply) {
                found.extend([a, b].iter().filter(|id| self.vector(**id).is_some_and(|v| v.is_normal())));
            }
        }
        found
    }

    /// Returns the nodes that are used as the direction to the light.
    pub fn lights(&self) -> Vec<Id> {
        let mut found = Vec::new();
        for (_, a, b) in self.diffuse_dots() {
            found.extend([a, b].into_iter().filter(|id| self.vector(*id).is_some_and(|v| v.is_light())));
        }
        found.extend(self.reflections(Incoming::Light));
        found
    }

    /// Returns the incident vectors of reflections (and refractions) of a vector.
    pub fn reflections(&self, of: Incoming) -> Vec<Id> {
        let made = self.lit.iter().filter_map(|id| self.vector(*id).filter(|vector| vector.at == *id));
        made.filter(|v| matches!(v.kind, VectorKind::Reflected(kind) | VectorKind::Refracted(kind) if kind == of))
            .filter_map(|vector| vector.incoming)
            .collect()
    }

    /// Returns the cubemap lookups: the call and the direction.
    pub fn lookups(&self) -> Vec<(Id, Id)> {
        self.lit
            .iter()
            .filter_map(|id| match self.graph.op(*id) {
                Op::Call(name, parts) if name.starts_with("texture") && parts.len() >= 2 => Some((*id, parts[1])),
                _ => None,
            })
            .collect()
    }

    /// Returns the statement that determines the colour: the last one that does more than pass it on.
    pub fn put_out(&self) -> Option<Id> {
        let graph = &self.graph;
        let mut id = self.colour?;
        loop {
            let inner = graph.plain(id);
            let handed_on = match graph.op(inner) {
                Op::Interpolated(next) => Some(*next),
                // `FragColor = vec4(v_col, 1.0)`
                Op::Construct(parts) if parts.len() <= 2 => match graph.op(graph.plain(parts[0])) {
                    Op::Interpolated(next) => Some(*next),
                    _ => Some(parts[0]),
                },
                _ => match graph.op(id) {
                    Op::Copy(next, _) => Some(*next),
                    _ => None,
                },
            };
            match handed_on {
                // A normal or position is output here, not where it was passed on.
                Some(next) if next != Graph::UNKNOWN && is_colour(graph, next) => id = next,
                _ => return Some(id),
            }
        }
    }
}

/// Whether the name of a varying is that of a colour or a part of one.
fn is_colour(graph: &Graph, id: Id) -> bool {
    match graph.op(id) {
        Op::Copy(_, name) => {
            let name = name.to_lowercase();
            ["col", "coul", "diff", "light", "lum"].iter().any(|word| name.contains(word))
        }
        _ => false,
    }
}
