//! A panorama as six faces: whether each is what it should be, and what is wrong with it.
//!
//! Six pictures are held against gonio's own, drawn from the same panorama. What is wrong with all of them at once (the
//! panorama upside down, a wrong angle) is a hypothesis of the bank, as in other exercises. What is wrong with one (turned,
//! mirrored, in another's place) is found face by face: each is compared with all six in all eight ways.

mod explain;
mod images;
mod stage;
mod tiles;
mod verdict;

pub use images::is_picture;

use crate::bank::{Hypothesis, Model};
use crate::check::{Checker, Evidence, Prepared};
use crate::exercise::Exercise;
use crate::names::{self, Kind, Role};
use crate::stage::TILE;
use crate::submission::SourceFile;
use crate::verdict::{Outcome, Verdict};
use explain::{Explanation, Task};
use gonio_gl::GlError;
use gonio_render::user_program::UserProgram;
use images::Handed;
use stage::FaceStage;
pub(crate) use tiles::Tiles;
use tiles::Tolerance;

/// Pixels along a face that pictures are held against: fine enough for the lines of a panorama of usual size.
const FINE: u32 = 128;

/// Checks a program that draws the faces, one draw each.
pub fn program(
    checker: &mut Checker,
    exercise: &str,
    program: &UserProgram,
    prepared: &Prepared,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let bindings = names::bind(&crate::check::declared(program), &prepared.names);
    let bound = crate::check::bound(&bindings);
    let unsure = |sentence: &str| {
        let mut verdict = Verdict::new(exercise, Outcome::Unsure, sentence);
        verdict.bound.clone_from(&bound);
        Ok((verdict, None))
    };
    let has = |role: Role| bindings.bound.iter().any(|known| known.role == role);
    if !bindings.bound.iter().any(|b| b.declared.kind == Kind::Attribute && b.role == Role::Position) {
        return unsure(
            "no attribute was found that could be the position; call it `position`, or say in names.toml which it is",
        );
    }
    if !bindings.bound.iter().any(|b| b.declared.glsl_type == "sampler2D") {
        return unsure("the shaders read no panorama: a sampler2D called `panorama` is wanted");
    }
    let stage = FaceStage::smooth(checker.gl(), TILE)?;
    // With a face's number one draws a square; with a view matrix a cube around the camera.
    let is_cube = !has(Role::Face) && (has(Role::View) || has(Role::ViewProjection) || has(Role::ModelViewProjection));
    let fixed = crate::check::fixed(&bindings);
    let drawn = crate::check::drawn_unless_endless(program, &fixed, &[1, 6], |fixed, faces| {
        stage.draw_student(program, &bindings, fixed, is_cube, faces)
    })?;
    let Some(seen) = drawn else {
        let mut verdict = crate::check::endless_verdict(exercise);
        verdict.bound = bound;
        return Ok((verdict, None));
    };
    let model = checker.model(Model::Panorama);
    let task = Task { hypotheses: &model.hypotheses, tolerance: Tolerance::DRAWN, looks_like: &prepared.looks_like };
    let mut predict = |hypothesis: &Hypothesis| stage.draw_model(model, hypothesis);
    let explanation = Explanation::of(&task, &seen, &mut predict)?;
    let (mut verdict, evidence) = verdict::verdict(exercise, &explanation, &seen, |tiles| tiles.sheet());
    verdict.bound = bound;
    Ok((verdict, Some(evidence)))
}

/// Checks six pictures, in as many files or in one.
pub fn pictures(
    checker: &mut Checker,
    exercise: &Exercise,
    files: &[SourceFile],
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let handed = match Handed::read(exercise, files) {
        Ok(handed) => handed,
        Err(sentence) => return Ok((Verdict::new(&exercise.id, Outcome::Unsure, sentence), None)),
    };
    let stage = FaceStage::of_panorama(checker.gl(), FINE, &handed.panorama)?;
    let model = checker.model(Model::Panorama);
    let seen = handed.tiles(TILE as usize).encoded().softened();
    let silent: crate::check::LooksLike = Box::new(|id, _| if id == "layout-photographic" { 0.6 } else { 0.5 });
    let task = Task { hypotheses: &model.hypotheses, tolerance: Tolerance::FILES, looks_like: &silent };
    let draw = |hypothesis: &Hypothesis| Ok::<Tiles, GlError>(stage.draw_model(model, hypothesis)?.held_to_screens());
    let mut predict = |hypothesis: &Hypothesis| Ok(draw(hypothesis)?.smaller(TILE as usize).encoded().softened());
    let explanation = Explanation::of(&task, &seen, &mut predict)?;
    let (mut verdict, evidence) = verdict::verdict(&exercise.id, &explanation, &seen, |tiles| tiles.decoded().sheet());
    if verdict.verdict == Outcome::Correct {
        let reference = draw(&Hypothesis::default())?;
        verdict::blur(&mut verdict, handed.sharpness(&reference));
    }
    verdict.warnings.extend(handed.warnings);
    Ok((verdict, Some(evidence)))
}
