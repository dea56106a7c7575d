//! The analysis of a program: the meaning of its vectors, matrices and numbers, and which of them its colour depends
//! on.

use super::Shader;
use super::graph::{Graph, Id, Op};
use super::matrix::{self, Matrix};
use super::run::Program;
use super::terms::{self, Bits, DIFFUSE, Product, SPECULAR};
use super::vector::{self, Incoming, Space, Vector, VectorKind};
use crate::roles::{NamesFile, Role};
use gonio_glsl::ast::BinaryOp;

pub(crate) struct Reading {
    pub graph: Graph,
    pub position: Option<Id>,
    pub colour: Option<Id>,
    matrices: Vec<Option<Matrix>>,
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
    /// All nodes that the position on the screen depends on.
    pub placed: Vec<Id>,
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
        let placed = graph.reachable(&position.into_iter().collect::<Vec<_>>(), |_| true);
        Reading { graph, position, colour, matrices, vectors, bits, products, lit, tree, parents, tests, placed }
    }

    pub fn vector(&self, id: Id) -> Option<Vector> {
        self.vectors.get(id.0 as usize).copied().flatten()
    }

    pub fn matrix(&self, id: Id) -> Option<&Matrix> {
        self.matrices.get(id.0 as usize)?.as_ref()
    }

    pub fn bits(&self, id: Id) -> Bits {
        self.bits.get(id.0 as usize).copied().unwrap_or(0)
    }

    pub fn products(&self, id: Id) -> &[Product] {
        self.products.get(id.0 as usize).map_or(&[], Vec::as_slice)
    }

    /// Returns the products whose sum is the colour.
    pub fn sum(&self) -> &[Product] {
        self.colour.map_or(&[], |colour| self.products(colour))
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

    /// Whether a cosine with these bits is computed but does not flow into the colour.
    pub fn computes_unused(&self, bits: Bits) -> bool {
        let is_of_light = |id: Id| {
            let Some(parts) = self.graph.call(id, "dot") else { return false };
            parts.iter().all(|part| self.vector(*part).is_some()) && self.bits(id) & bits != 0
        };
        // `lit` is sorted by index.
        self.graph.ids().any(|id| is_of_light(id) && self.lit.binary_search_by_key(&id.0, |lit| lit.0).is_err())
    }

    /// Returns for each node whether a cosine between the axis of a spot light and the direction to it flows into it.
    pub fn of_cones(&self) -> Vec<bool> {
        let is = |id: Id, is_match: &dyn Fn(VectorKind) -> bool| self.vector(id).is_some_and(|v| is_match(v.kind));
        let is_cone = |id: Id| match self.graph.call(id, "dot") {
            Some(&[a, b]) => [(a, b), (b, a)].into_iter().any(|(axis, light)| {
                is(axis, &|kind| kind == VectorKind::LightDirection)
                    && is(light, &|kind| matches!(kind, VectorKind::ToLight(..)))
            }),
            _ => false,
        };
        let mut found = Vec::with_capacity(self.graph.len());
        // Operands precede the nodes that use them.
        for id in self.graph.ids() {
            let has = |part: Id| found.get(part.0 as usize).copied().unwrap_or(false);
            found.push(is_cone(id) || self.graph.parts(id).into_iter().any(has));
        }
        found
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

    /// Returns the node that negates a cosine, if there is one.
    pub fn turned_after(&self, dot: Id) -> Option<Id> {
        self.around(dot).into_iter().find(|id| match self.graph.op(*id) {
            Op::Neg(inner) => self.graph.plain(*inner) == dot,
            _ => false,
        })
    }

    /// Whether the light is computed in view space, or a direction reflected there is transformed back to world
    /// space.
    pub fn is_in_view(&self) -> bool {
        let ends = |ids: Vec<Id>| ids.into_iter().filter_map(|id| self.vector(id)).any(|v| v.end == Space::View);
        let back = || {
            let lookups = self.lookups();
            let mut looked_up = lookups.iter().filter_map(|(_, id)| self.vector(*id));
            looked_up
                .any(|v| matches!(v.kind, VectorKind::Reflected(_) | VectorKind::Refracted(_)) && v.end == Space::World)
        };
        // The direction of a mirror must be transformed back to world space; that of a highlight need not be.
        ends(self.lights()) || self.lights().is_empty() && ends(self.eyes()) && (!self.looks_up_cube() || back())
    }

    /// Whether both vectors of the diffuse cosine are negated, or a refracted direction and its normal.
    pub fn signs_cancel(&self) -> bool {
        let is_turned = |id: Id| self.vector(id).is_some_and(|v| v.sign < 0.0);
        let cosine = self.diffuse_dots().iter().any(|(dot, a, b)| {
            let turned = [is_turned(*a), is_turned(*b), self.turned_after(*dot).is_some()];
            turned.iter().filter(|turned| **turned).count() == 2
        });
        cosine
            || self.lookups().iter().any(|(_, id)| {
                self.vector(*id).is_some_and(|v| {
                    let incoming = v.incoming.and_then(|id| self.vector(id));
                    matches!(v.kind, VectorKind::Refracted(_))
                        && incoming.is_some_and(|incoming| incoming.sign != v.sign)
                })
            })
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

    /// Returns the nodes that are used as the direction to the eye.
    pub fn eyes(&self) -> Vec<Id> {
        let mut found: Vec<Id> = Vec::new();
        for (_, a, b) in self.specular_dots() {
            for (one, other) in [(a, b), (b, a)] {
                let is_other = self
                    .vector(other)
                    .is_some_and(|v| v.is_normal() || v.is_light() || matches!(v.kind, VectorKind::Reflected(_)));
                let is_eye = self.vector(one).is_some_and(|v| {
                    v.is_eye()
                        || matches!(
                            v.kind,
                            VectorKind::Constant | VectorKind::Point(_) | VectorKind::Reflected(Incoming::Eye)
                        )
                });
                if is_eye && (is_other || self.vector(one).is_some_and(|v| v.is_eye())) {
                    found.push(one);
                }
            }
        }
        found.extend(self.reflections(Incoming::Eye));
        found
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

    /// Whether one of the lookups samples a cubemap.
    fn looks_up_cube(&self) -> bool {
        self.lookups().into_iter().any(|(call, _)| match self.graph.op(call) {
            Op::Call(_, parts) => {
                parts.first().is_some_and(|sampler| self.role(self.graph.plain(*sampler)) == Some(Role::Cubemap))
            }
            _ => false,
        })
    }

    /// Returns the last variable with this word in its name, among those that the colour is computed from, whose
    /// value satisfies the condition.
    pub fn named(&self, word: &str, is: impl Fn(Id) -> bool) -> Option<Id> {
        self.tree.iter().copied().rfind(|id| match self.graph.op(*id) {
            Op::Copy(inner, name) => name.to_lowercase().contains(word) && is(*inner),
            _ => false,
        })
    }

    /// Returns a variable with this word in its name that holds 0.
    pub fn dark(&self, word: &str) -> Option<Id> {
        self.named(word, |inner| self.graph.scalar(inner) == Some(0.0))
    }

    /// Returns the outermost variable that a value was assigned to.
    pub fn variable(&self, id: Id) -> Option<(Id, &str)> {
        match self.graph.op(id) {
            Op::Copy(_, name) => Some((id, name)),
            _ => None,
        }
    }

    /// Returns the colour before it is output: without variables, stages and alpha.
    pub fn shade(&self) -> Option<Id> {
        self.colour.map(|colour| self.graph.core(colour))
    }

    /// Returns the node where the terms of the light are combined: a sum, or what is written in its place.
    pub fn meeting(&self) -> Option<Id> {
        let mut id = self.colour?;
        let mut best = None;
        let given_up = self.put_out();
        loop {
            id = self.graph.core(id);
            let next = match self.graph.op(id) {
                Op::Binary(BinaryOp::Add, a, b) => {
                    // The sum starts with 0.
                    match [a, b].iter().find(|part| self.graph.scalar(***part) == Some(0.0)) {
                        Some(zero) => {
                            if *zero == a {
                                *b
                            } else {
                                *a
                            }
                        }
                        None => return Some(id),
                    }
                }
                Op::Binary(BinaryOp::Multiply | BinaryOp::Divide, a, b) => {
                    best = best.or(Some(id));
                    let has = |id: Id| self.bits(id) & (DIFFUSE | SPECULAR | terms::AMBIENT) != 0;
                    match (has(*a), has(*b)) {
                        (true, false) => *a,
                        (false, true) => *b,
                        _ => return best.or(given_up),
                    }
                }
                _ => return best.or(given_up),
            };
            id = next;
        }
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
