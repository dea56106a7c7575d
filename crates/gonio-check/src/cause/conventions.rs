//! The space in which a program is given its light and its normals: world or view space is a convention between the
//! shaders and the program that sends the uniforms, and names do not tell it.

use super::assign::{has_open_normals, lights};
use super::program::Program;

/// The program with its lights, its normal matrix, or both given in the other space; without those that are the same.
pub(super) fn other_conventions(program: &Program) -> Vec<Program> {
    let mut all: Vec<Program> = Vec::new();
    for (has_other_lights, has_other_normals) in [(false, true), (true, false), (true, true)] {
        let mut other = program.clone();
        for bound in &mut other.bindings.bound {
            let is_open = has_other_lights && lights::is_open(bound) || has_other_normals && has_open_normals(bound);
            let mut spaces = [false, true].into_iter().filter_map(|is_in_view| bound.role.in_space(is_in_view));
            if let Some(role) = spaces.find(|role| is_open && *role != bound.role) {
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
