//! Infers the roles of matrices with unclear names from the way the position is multiplied with them.

use super::graph::{Id, Op};
use super::reading::Reading;
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;

/// The names of uniforms and what they must be. Empty where names say it all, or where the position is no plain product.
pub(crate) fn matrices(reading: &Reading) -> Vec<(String, Role)> {
    let Some(position) = reading.position else { return Vec::new() };
    let mut factors = Vec::new();
    if !product(reading, position, &mut factors, 0) || factors.iter().all(|(_, role)| role.is_some()) {
        return Vec::new();
    }
    let known: Vec<Option<Role>> = factors.iter().map(|(_, role)| *role).collect();
    let projects = |role: &Role| matches!(role, Role::Projection | Role::ViewProjection | Role::ModelViewProjection);
    let others_project = known[1..].iter().flatten().any(projects);
    let meant: &[Role] = match known[..] {
        _ if others_project => return Vec::new(),
        [None] => &[Role::ModelViewProjection],
        [Some(Role::Projection), None] => &[Role::Projection, Role::ModelView],
        // `camera * transform`: with nothing to project with, it is in the first.
        [None | Some(Role::View | Role::ViewProjection), None] | [None, Some(Role::Model)] => {
            &[Role::ViewProjection, Role::Model]
        }
        [None, Some(Role::ModelView)] => &[Role::Projection, Role::ModelView],
        [_, _, _] => &[Role::Projection, Role::View, Role::Model],
        _ => return Vec::new(),
    };
    let contradicts = |((_, known), meant): (&(String, Option<Role>), &Role)| {
        known.is_some_and(|known| known != *meant && !(known == Role::View && *meant == Role::ViewProjection))
    };
    if factors.iter().zip(meant).any(contradicts) {
        return Vec::new();
    }
    let changed =
        |((name, known), meant): ((String, Option<Role>), &Role)| (known != Some(*meant)).then_some((name, *meant));
    factors.into_iter().zip(meant).filter_map(changed).collect()
}

/// The uniforms of a product from left to right, without the vector at its end; whether it is one.
fn product(reading: &Reading, id: Id, factors: &mut Vec<(String, Option<Role>)>, depth: usize) -> bool {
    let graph = &reading.graph;
    if depth > 16 || factors.len() > 3 {
        return false;
    }
    match graph.op(graph.core(id)) {
        Op::Input { name, role } if graph.node(graph.core(id)).is_matrix => {
            factors.push((name.clone(), *role));
            true
        }
        Op::Input { .. } => true,
        Op::Binary(BinaryOp::Multiply, a, b) => {
            graph.node(*a).is_matrix
                && product(reading, *a, factors, depth + 1)
                && product(reading, *b, factors, depth + 1)
        }
        // `vec4(position, 1.0)`
        Op::Construct(_) => !graph.node(graph.core(id)).is_matrix,
        _ => false,
    }
}
