//! Shaders that were written for another program than the exercise's: what that program sends is not known.

use crate::roles::Role;
use crate::rules::Analysis;
use crate::verdict::{Outcome, Verdict};

/// The interface of exercise 08. Whoever takes these names has its word that V comes as the camera has it.
const GIVEN: [&str; 4] = ["position", "V", "P", "cubemapSampler"];
const MOVES: &str = "skybox-keeps-translation";

/// Many programs take the translation out of V before they send it, and their shaders are right to leave it as it comes: where names
/// show that a shader was written for another program than ours, that is taken for granted, and said.
pub(super) fn trust(verdict: &mut Verdict, source: &Analysis) {
    let of_another = verdict.bound.iter().any(|bound| bound.role.is_some() && !GIVEN.contains(&bound.name.as_str()));
    let moves = |verdict: &Verdict| verdict.mistakes.iter().any(|found| found.id == MOVES);
    // Whoever makes a V without translation knows that it comes with one.
    if verdict.verdict != Outcome::Wrong || !of_another || !moves(verdict) || source.turns_only() {
        return;
    }
    let is_view = |role: &str| [Role::View, Role::ViewProjection].iter().any(|view| view.to_string() == role);
    let view = verdict.bound.iter().find(|bound| bound.role.as_deref().is_some_and(is_view));
    let view = view.map_or("V", |bound| bound.name.as_str()).to_owned();
    verdict.warnings.push(format!(
        "this is right if the program sends `{view}` without its translation, `glm::mat4(glm::mat3({view}))`; \
         otherwise the sky moves with the camera, and the shader must remove the translation: \
         `mat4(mat3({view}))`"
    ));
    verdict.mistakes.retain(|found| found.id != MOVES);
    if verdict.mistakes.is_empty() {
        verdict.verdict = Outcome::Correct;
        verdict.score = 1.0;
        verdict.summary = format!("right, provided that the program sends `{view}` without its translation");
        verdict.runner_up = None;
    } else {
        verdict.summary = verdict.mistake_names();
    }
}
