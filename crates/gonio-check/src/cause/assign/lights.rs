//! Finds out in which space a program expects its lights, and whether it uses their positions as directions.

use super::{Program, Scorer};
use crate::cause::ModelSolutions;
use crate::cause::model::{Mistakes, Model};
use crate::cause::samples::SceneSamples;
use crate::roles::{Bound, How, Role, VariableKind};
use crate::testbench::TestLight;

/// Whether it is a light of OpenGL's old pipeline, whose positions are in view space.
fn is_fixed_function(bound: &Bound) -> bool {
    bound.declared.name.starts_with("gl_")
}

/// Whether it is a light's position or direction, which has a space.
fn has_space(bound: &Bound) -> bool {
    bound.role.light().is_some() && bound.role.in_space(false).is_some()
}

/// Whether the name leaves the space of a light open.
pub(in crate::cause) fn is_open(bound: &Bound) -> bool {
    bound.declared.kind == VariableKind::Uniform
        && bound.how != How::NamesFile
        && has_space(bound)
        && !is_fixed_function(bound)
}

/// Whether a program reads a light of the old pipeline, whose position is a direction if its w is 0.
pub(super) fn may_be_directions(program: &Program) -> bool {
    program.bindings.bound.iter().any(|bound| is_fixed_function(bound) && has_space(bound))
}

/// The roles of inputs as they are, and with all lights in the other space if the names leave that open.
pub(super) fn in_spaces(bound: &[Bound]) -> Vec<Vec<Bound>> {
    let mut all = vec![bound.to_vec()];
    for is_in_view in [false, true] {
        let mut other = bound.to_vec();
        for bound in other.iter_mut().filter(|bound| is_open(bound)) {
            bound.role = bound.role.in_space(is_in_view).unwrap_or(bound.role);
        }
        if !all.contains(&other) {
            all.push(other);
        }
    }
    all
}

/// Chooses one space for all lights: another one than that of the names only if it makes more values right.
pub(super) fn choose_space(program: &mut Program, scorer: &Scorer<'_>) {
    let mut best = (scorer.score(program), program.bindings.bound.clone());
    for bound in in_spaces(&best.1).into_iter().skip(1) {
        program.bindings.bound = bound;
        let score = scorer.score(program);
        if score > best.0 {
            best = (score, program.bindings.bound.clone());
        }
    }
    program.bindings.bound = best.1;
}

/// Treats the positions of the old pipeline's lights as directions if that makes more values right. Returns the scenes
/// and models with a sun in that case.
pub(super) fn choose_suns(
    solutions: &ModelSolutions,
    program: &mut Program,
    samples: &[SceneSamples],
    models: &[Model],
) -> Option<(Vec<SceneSamples>, Vec<Model>)> {
    let in_sun = |samples: &SceneSamples| {
        let mut scene = samples.scene.clone();
        let centre = scene.world_from_model.w_axis.truncate();
        scene.light = TestLight { points_to_light: true, ..scene.light.as_sun(centre) };
        SceneSamples { scene, ..samples.clone() }
    };
    let in_sun: Vec<SceneSamples> = samples.iter().map(in_sun).collect();
    let models_in_sun =
        models.iter().map(|model| Model::new(solutions, model.method, model.space, &in_sun, 1.0, Mistakes::These(&[])));
    let models_in_sun = models_in_sun.collect::<Result<Vec<_>, _>>().ok()?;
    let of_lamps = (Scorer::new(samples.first()?, models).score(program), program.bindings.bound.clone());
    for bound in program.bindings.bound.iter_mut().filter(|bound| is_fixed_function(bound)) {
        if let Role::LightPosInView(light) = bound.role {
            bound.role = Role::LightDirectionInView(light);
        }
    }
    if Scorer::new(in_sun.first()?, &models_in_sun).score(program) <= of_lamps.0 {
        program.bindings.bound = of_lamps.1;
        return None;
    }
    program.declared.adopt(&program.bindings);
    Some((in_sun, models_in_sun))
}
