//! Identifies matrices: products of M, V and P, each possibly inverted or transposed.

use super::graph::{Graph, Id, Op};
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Base {
    Model,
    View,
    Projection,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Factor {
    pub base: Base,
    pub is_inverse: bool,
    pub is_transposed: bool,
}

/// A product from left to right; an empty one is the identity.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Matrix {
    pub factors: Vec<Factor>,
    /// Whether its translation was removed: `mat3(M)`.
    pub is_turn: bool,
}

const MOST_FACTORS: usize = 16;

impl Matrix {
    fn product(bases: &[Base]) -> Self {
        let factor = |base: &Base| Factor { base: *base, is_inverse: false, is_transposed: false };
        Matrix { factors: bases.iter().map(factor).collect(), is_turn: false }
    }

    fn normal_of(bases: &[Base]) -> Self {
        let factor = |base: &Base| Factor { base: *base, is_inverse: true, is_transposed: true };
        Matrix { factors: bases.iter().map(factor).collect(), is_turn: true }
    }

    fn turned_round(mut self, change: impl Fn(&mut Factor)) -> Self {
        self.factors.reverse();
        self.factors.iter_mut().for_each(change);
        self
    }

    pub fn transposed(self) -> Self {
        self.turned_round(|factor| factor.is_transposed ^= true)
    }

    pub fn has(&self, base: Base) -> bool {
        self.factors.iter().any(|factor| factor.base == base)
    }

    /// Returns the bases in order, if none is inverted or transposed.
    pub fn bases(&self) -> Option<Vec<Base>> {
        let plain = self.factors.iter().all(|f| !f.is_inverse && !f.is_transposed);
        plain.then(|| self.factors.iter().map(|f| f.base).collect())
    }
}

/// Returns the matrix of each node, if it is known.
pub(crate) fn matrices(graph: &Graph) -> Vec<Option<Matrix>> {
    let mut found: Vec<Option<Matrix>> = Vec::with_capacity(graph.len());
    for id in graph.ids() {
        let matrix = matrix(graph, &found, id);
        found.push(matrix.filter(|matrix| matrix.factors.len() <= MOST_FACTORS));
    }
    found
}

fn matrix(graph: &Graph, found: &[Option<Matrix>], id: Id) -> Option<Matrix> {
    use Base::{Model, Projection, View};
    let of = |id: &Id| found.get(id.0 as usize)?.clone();
    match graph.op(id) {
        Op::Input { role, .. } => Some(match (*role)? {
            Role::Model => Matrix::product(&[Model]),
            Role::View => Matrix::product(&[View]),
            Role::Projection => Matrix::product(&[Projection]),
            Role::ModelView => Matrix::product(&[View, Model]),
            Role::ViewProjection => Matrix::product(&[Projection, View]),
            Role::ModelViewProjection => Matrix::product(&[Projection, View, Model]),
            Role::NormalMatrix => Matrix::normal_of(&[Model]),
            Role::NormalMatrixOfModelView => Matrix::normal_of(&[View, Model]),
            _ => return None,
        }),
        Op::Copy(a, _) | Op::Interpolated(a) => of(a),
        Op::Binary(BinaryOp::Multiply, a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            let is_turn = a.is_turn || b.is_turn;
            Some(Matrix { factors: [a.factors, b.factors].concat(), is_turn })
        }
        Op::Call(name, parts) => match name.as_str() {
            "inverse" => Some(of(parts.first()?)?.turned_round(|factor| factor.is_inverse ^= true)),
            "transpose" => Some(of(parts.first()?)?.transposed()),
            _ => None,
        },
        Op::Construct(parts) if graph.node(id).is_matrix => {
            if graph.number(id).is_some() {
                return Some(Matrix::default());
            }
            // Also `mat3(M[0].xyz, M[1].xyz, M[2].xyz)`.
            let mut of_parts = parts.iter().filter_map(|part| of_columns(graph, found, *part));
            let mut matrix = of_parts.next()?;
            matrix.is_turn |= graph.node(id).width == 9 || parts.len() > 1;
            Some(matrix)
        }
        // The last column is the translation.
        Op::Write(base, letters, _) if letters == "[3]" => Some(Matrix { is_turn: true, ..of(base)? }),
        _ => None,
    }
}

pub(crate) fn of_columns(graph: &Graph, found: &[Option<Matrix>], mut id: Id) -> Option<Matrix> {
    loop {
        id = match graph.op(id) {
            Op::Swizzle(inner, _) | Op::Copy(inner, _) => *inner,
            Op::Construct(parts) if !graph.node(id).is_matrix => *parts.first()?,
            Op::Index(base, _) if graph.node(*base).is_matrix => *base,
            _ => return found.get(id.0 as usize)?.clone(),
        }
    }
}
