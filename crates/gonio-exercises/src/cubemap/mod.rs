//! A cubemap as six pictures: whether each face is what it should be, and what is wrong with it.
//!
//! The pictures are compared with gonio's own, drawn from the same panorama. A mistake with all of them at once (the panorama
//! upside down, a wrong angle) is a hypothesis of the catalogue, as in other exercises. A mistake with one (rotated, mirrored, in
//! another's place) is found face by face: each is compared with all six in all eight orientations.

mod images;

pub use images::is_picture;

use crate::exercise::Exercise;
use gonio_check::ShaderChecker;
use gonio_check::mistakes::{Hypothesis, Model};
use gonio_check::panorama::{Explanation, FaceBench, FaceTask, Tiles, Tolerance, blur, verdict};
use gonio_check::search::{Evidence, SourceSupport};
use gonio_check::submission::SourceFile;
use gonio_check::testbench::TILE;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_gl::GlError;
use images::SubmittedFaces;

/// Pixels along a face that pictures are held against: fine enough for the lines of a panorama of usual size.
const FINE: u32 = 128;

/// Checks six pictures, in as many files or in one.
pub fn check(
    checker: &mut ShaderChecker,
    exercise: &Exercise,
    files: &[SourceFile],
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let submitted = match SubmittedFaces::read(exercise, files) {
        Ok(submitted) => submitted,
        Err(sentence) => return Ok((Verdict::new(&exercise.id, Outcome::Unsure, sentence), None)),
    };
    let bench = FaceBench::of_panorama(checker.gl(), FINE, &submitted.panorama)?;
    let model = checker.model(Model::Panorama);
    let seen = submitted.tiles(TILE as usize).encoded().softened();
    let silent: SourceSupport = Box::new(|id, _| if id == "layout-photographic" { 0.6 } else { 0.5 });
    let task = FaceTask { hypotheses: &model.hypotheses, tolerance: Tolerance::FILES, source_support: &silent };
    let draw = |hypothesis: &Hypothesis| Ok::<Tiles, GlError>(bench.draw_model(model, hypothesis)?.held_to_screens());
    let mut predict = |hypothesis: &Hypothesis| Ok(draw(hypothesis)?.smaller(TILE as usize).encoded().softened());
    let explanation = Explanation::find(&task, &seen, &mut predict)?;
    let (mut verdict, evidence) = verdict(&exercise.id, &explanation, &seen, |tiles| tiles.decoded().atlas());
    if verdict.verdict == Outcome::Correct {
        let reference = draw(&Hypothesis::default())?;
        blur(&mut verdict, submitted.sharpness(&reference));
    }
    verdict.warnings.extend(submitted.warnings);
    Ok((verdict, Some(evidence)))
}
