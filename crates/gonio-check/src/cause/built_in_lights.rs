//! The lights of the old pipeline that a program uses.

use super::program::{Program, Runner};
use super::samples::SceneSamples;
use super::seeing::see;
use crate::roles::Bound;
use crate::testbench::TestScene;

/// Places at which two pictures are compared.
const PLACES: usize = 40;

/// Whether it belongs to `gl_LightSource[1]` or a later one.
fn is_of_later(bound: &Bound) -> bool {
    bound.declared.name.starts_with("gl_") && bound.role.light().is_some_and(|light| light > 0)
}

/// Leaves out the later lights of the old pipeline if they change no picture. A program that reads them by a variable index has
/// all of them, and may only ever use the first.
pub(super) fn without_unused(program: Program, scenes: &[TestScene]) -> Program {
    let lit_by_two = scenes.iter().find(|scene| scene.other.is_some());
    let Some(scene) = lit_by_two.filter(|_| program.bindings.bound.iter().any(is_of_later)) else { return program };
    let samples = [SceneSamples::new(scene.clone()).few(PLACES)];
    let mut without = program.clone();
    for bindings in [&mut without.bindings, &mut without.declared] {
        bindings.bound.retain(|bound| !is_of_later(bound));
    }
    let picture = |program: &Program| see(&Runner::new(program, &samples), &[], 0..samples.len());
    match (picture(&program), picture(&without)) {
        (Some(whole), Some(first)) if whole.colour.is_same(&first.colour) => without,
        _ => program,
    }
}
