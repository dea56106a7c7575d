//! A panorama as six faces: whether each is what it should be, and what is wrong with it.
//!
//! Six pictures are held against gonio's own, drawn from the same panorama. What is wrong with all of them at once (the
//! panorama upside down, a wrong angle) is a hypothesis of the catalogue, as in other exercises. What is wrong with one (turned,
//! mirrored, in another's place) is found face by face: each is compared with all six in all eight ways.

mod bench;
mod conclusion;
mod explain;
mod tiles;

pub use bench::FaceBench;
pub use conclusion::{blur, verdict};
pub use explain::{Explanation, FaceTask};
pub use tiles::{Tiles, Tolerance};

use crate::mistakes::{Hypothesis, Model};
use crate::roles::{self, Role, VariableKind};
use crate::search::{Evidence, Prepared, ShaderChecker};
use crate::testbench::TILE;
use crate::verdict::{Outcome, Verdict};
use gonio_gl::GlError;
use gonio_render::user_program::UserProgram;

/// Checks a program that draws the faces, one draw each.
pub(crate) fn check(
    checker: &mut ShaderChecker,
    exercise: &str,
    program: &UserProgram,
    prepared: &Prepared,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let bindings = roles::bind(&crate::search::declared(program), &prepared.names);
    let bound = crate::search::bound(&bindings);
    let unsure = |sentence: &str| {
        let mut verdict = Verdict::new(exercise, Outcome::Unsure, sentence);
        verdict.bound.clone_from(&bound);
        Ok((verdict, None))
    };
    let has = |role: Role| bindings.bound.iter().any(|known| known.role == role);
    if !bindings.bound.iter().any(|b| b.declared.kind == VariableKind::Attribute && b.role == Role::Position) {
        return unsure("no attribute looks like the position: name it `position`, or assign its role in names.toml");
    }
    if !bindings.bound.iter().any(|b| b.declared.glsl_type == "sampler2D") {
        return unsure("the shaders do not read a panorama: declare `uniform sampler2D panorama;`");
    }
    let bench = FaceBench::smooth(checker.gl(), TILE)?;
    // With a face's number one draws a square; with a view matrix a cube around the camera.
    let is_cube = !has(Role::Face) && (has(Role::View) || has(Role::ViewProjection) || has(Role::ModelViewProjection));
    let fixed = crate::search::fixed(&bindings);
    let drawn = crate::search::drawn_unless_endless(program, &fixed, &[1, 6], |fixed, faces| {
        bench.draw_student(program, &bindings, fixed, is_cube, faces)
    })?;
    let Some(seen) = drawn else {
        let mut verdict = crate::search::endless_verdict(exercise);
        verdict.bound = bound;
        return Ok((verdict, None));
    };
    let model = checker.model(Model::Panorama);
    let task = FaceTask {
        hypotheses: &model.hypotheses,
        tolerance: Tolerance::DRAWN,
        source_support: &prepared.source_support,
    };
    let mut predict = |hypothesis: &Hypothesis| bench.draw_model(model, hypothesis);
    let explanation = Explanation::find(&task, &seen, &mut predict)?;
    let (mut verdict, evidence) = conclusion::verdict(exercise, &explanation, &seen, |tiles| tiles.atlas());
    verdict.bound = bound;
    Ok((verdict, Some(evidence)))
}
