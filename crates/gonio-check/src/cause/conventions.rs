//! Conventions between the shaders and the program that sends the uniforms, which names do not tell: the space of the light
//! and of the normals, and whether the matrix of a sky has the translation of the camera.

use super::assign::{has_open_normals, lights};
use super::program::Program;
use crate::roles::{Bound, How, Role};

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
            // The inverse transpose is often called an inverse.
            if has_other_normals && bound.role == Role::ModelInverse {
                bound.role = Role::NormalMatrix;
            }
        }
        let is_new = |known: &Program| known.bindings != other.bindings;
        if is_new(program) && all.iter().all(is_new) {
            all.push(other);
        }
    }
    all
}

/// The names of the exercise, in which V has the translation of the camera.
const EXERCISE_NAMES: [&str; 4] = ["position", "V", "P", "cubemapSampler"];

/// A sky whose view matrix has no translation: many programs remove it before they set the matrix. `None` if the matrices have
/// the names of the exercise, which sets V as it is.
pub(super) fn without_translation(program: &Program) -> Option<Program> {
    let is_own = |bound: &Bound| EXERCISE_NAMES.contains(&bound.declared.name.as_str());
    let is_matrix = |bound: &&Bound| bound.declared.glsl_type.starts_with("mat");
    let mut other = program.clone();
    for bound in other.bindings.bound.iter_mut().filter(|bound| bound.how != How::NamesFile) {
        bound.role = match bound.role {
            Role::View | Role::ModelView => Role::ViewRotation,
            Role::ViewProjection | Role::ModelViewProjection => Role::ViewProjectionRotation,
            role => role,
        };
    }
    (other.bindings != program.bindings && !program.bindings.bound.iter().filter(is_matrix).all(is_own))
        .then_some(other)
}
