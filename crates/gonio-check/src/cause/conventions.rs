//! The space in which a program is given its light and its normals: world or view space is a convention between the
//! shaders and the program that sends the uniforms, and names do not tell it.

use super::assign::is_of_model;
use super::program::Program;
use crate::roles::Role;

/// The same quantity as the other convention gives it.
fn other_space(role: Role) -> Option<Role> {
    Some(match role {
        Role::LightPos(light) => Role::LightPosInView(light),
        Role::LightPosInView(light) => Role::LightPos(light),
        Role::NormalMatrix => Role::NormalMatrixOfModelView,
        Role::NormalMatrixOfModelView => Role::NormalMatrix,
        _ => return None,
    })
}

/// The program with its lights, its normal matrix, or both given in the other space; without those that are the same.
pub(super) fn other_conventions(program: &Program) -> Vec<Program> {
    let is_light = |role: Role| matches!(role, Role::LightPos(_) | Role::LightPosInView(_));
    let mut all: Vec<Program> = Vec::new();
    for (lights, matrices) in [(false, true), (true, false), (true, true)] {
        let mut other = program.clone();
        for bound in &mut other.bindings.bound {
            let is_open = if is_light(bound.role) { lights } else { matrices && !is_of_model(&bound.declared.name) };
            if let Some(role) = other_space(bound.role).filter(|_| is_open) {
                bound.role = role;
            }
        }
        let is_new = |known: &Program| known.bindings != other.bindings;
        if is_new(program) && all.iter().all(is_new) {
            all.push(other);
        }
    }
    all
}
