//! Checks a panorama that was converted to six faces.
//!
//! Six pictures are compared with gonio's own, drawn from the same panorama. A mistake with all of them (the panorama
//! upside down, a wrong angle) is a hypothesis of the catalogue, as in other exercises. A mistake with one (rotated,
//! mirrored, in the place of another) is found face by face: each is compared with all six in all eight orientations.

mod bench;
mod explain;
mod tiles;

pub use bench::FaceBench;
pub use explain::{Explanation, FaceTask};
pub use tiles::{Tiles, Tolerance};

use crate::comparison::{Evidence, Prepared, ShaderChecker};
use crate::mistakes::{
    self,
    faces::{FACES, LECTURE_SECTION},
};
use crate::mistakes::{Hypothesis, ModelSolution};
use crate::roles::{self, Role, VariableKind};
use crate::testbench::TILE;
use crate::verdict::{FoundMistake, Outcome, SceneVerdict, Verdict, join_names};
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_render::user_program::UserProgram;

/// Checks a program that draws the faces, with one draw call each.
pub(crate) fn check(
    checker: &mut ShaderChecker,
    exercise: &str,
    program: &UserProgram,
    prepared: &Prepared,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let bindings = roles::bind(&crate::comparison::declared(program), &prepared.names);
    let bound = crate::comparison::bound(&bindings);
    let unsure = |sentence: &str| {
        let mut verdict = Verdict::new(exercise, Outcome::Unsure, sentence);
        verdict.bound.clone_from(&bound);
        Ok((verdict, None))
    };
    let has = |role: Role| bindings.bound.iter().any(|known| known.role == role);
    if !bindings.bound.iter().any(|b| b.declared.kind == VariableKind::Attribute && b.role == Role::Position) {
        return unsure(tr!("check-no-attribute-looks-like-the-position"));
    }
    if !bindings.bound.iter().any(|b| b.declared.glsl_type == "sampler2D") {
        return unsure(tr!("check-panorama-the-shaders-do-not-read-a"));
    }
    let bench = FaceBench::smooth(checker.gl()?, TILE)?;
    // A program with a face number draws a square, one with a view matrix a cube around the camera.
    let is_cube = !has(Role::Face) && (has(Role::View) || has(Role::ViewProjection) || has(Role::ModelViewProjection));
    let fixed = crate::comparison::fixed(&bindings);
    let drawn = crate::comparison::drawn_unless_endless(program, &fixed, &[1, 6], |fixed, faces| {
        bench.draw_student(program, &bindings, fixed, is_cube, faces)
    })?;
    let Some(seen) = drawn else {
        let mut verdict = crate::comparison::endless_verdict(exercise);
        verdict.bound = bound;
        return Ok((verdict, None));
    };
    let model = checker.model(ModelSolution::Panorama)?;
    let task = FaceTask {
        hypotheses: &model.hypotheses,
        tolerance: Tolerance::DRAWN,
        source_support: &prepared.source_support,
    };
    let mut predict = |hypothesis: &Hypothesis| bench.draw_model(model, hypothesis);
    let explanation = Explanation::find(&task, &seen, &mut predict)?;
    let (mut verdict, evidence) = verdict(exercise, &explanation, &seen, |tiles| tiles.atlas());
    verdict.bound = bound;
    Ok((verdict, Some(evidence)))
}

/// Faces with less than this share of the possible sharpness are blurred.
const BLURRED: f64 = 0.45;

fn found(id: &str, share: f64) -> FoundMistake {
    match mistakes::find(id) {
        Some(mistake) => {
            FoundMistake { or: mistake.looks_the_same_as.clone(), ..FoundMistake::from_catalogue(mistake, share) }
        }
        None => {
            // `face-posx-shows-negx`
            let name = |word: &str| FACES.iter().find(|(known, _)| *known == word).map_or("?", |(_, name)| name);
            let mut words = id.split('-').skip(1);
            let (face, shown) = (words.next().unwrap_or_default(), words.nth(1).unwrap_or_default());
            let sentence = tr!("check-panorama-face-shows-what-belongs-on", face = name(face), shown = name(shown));
            let fix = tr!("check-panorama-the-order-of-opengl-s-faces");
            FoundMistake::new(id, sentence, share).taught("", fix, LECTURE_SECTION)
        }
    }
}

/// Returns the verdict and its pictures; `atlas` converts the compared pictures to linear light.
pub fn verdict(
    exercise: &str,
    explanation: &Explanation,
    seen: &Tiles,
    atlas: impl Fn(&Tiles) -> crate::testbench::Atlas,
) -> (Verdict, Evidence) {
    let scenes = scenes(explanation);
    let evidence = Evidence {
        seen: atlas(seen),
        reference: atlas(&explanation.reference),
        predicted: (!explanation.is_right() && explanation.unexplained.is_empty())
            .then(|| atlas(&explanation.predicted)),
        scenes: scenes.iter().map(|scene| scene.scene.clone()).collect(),
    };
    let right = scenes.iter().filter(|scene| scene.right).count();
    let mut verdict = Verdict::new(exercise, Outcome::Wrong, "");
    verdict.score = (right as f64 / 6.0).min(0.9);
    verdict.scenes = scenes;
    if explanation.is_right() {
        verdict.verdict = Outcome::Correct;
        verdict.score = 1.0;
        verdict.summary = tr!("check-panorama-all-six-faces-are-right").to_owned();
        return (verdict, evidence);
    }
    let names = |faces: &[usize]| -> String {
        let names: Vec<&str> = faces.iter().map(|&face| FACES[face % 6].1).collect();
        names.join(", ")
    };
    let unexplained = &explanation.unexplained;
    // A hypothesis that explains only a few faces is not an explanation.
    if unexplained.len() <= 2 {
        let share = 1.0 - unexplained.len() as f64 / 6.0;
        let ids = explanation.global.iter().chain(&explanation.local);
        verdict.mistakes = ids.map(|id| found(id, share)).collect();
        if let [only] = verdict.mistakes.as_mut_slice() {
            only.or.extend(explanation.or.iter().filter(|id| !only.or.contains(id)).cloned().collect::<Vec<_>>());
            only.or.retain(|id| *id != only.id);
        }
    }
    let mut sentences: Vec<String> = verdict.mistakes.iter().map(|mistake| mistake.name.clone()).collect();
    match unexplained.len() {
        0 => {}
        6 => sentences.push(tr!("check-panorama-no-face-is-right-and-no").to_owned()),
        _ => {
            sentences.push(tr!(
                "check-panorama-no-known-mistake-explains-the",
                count = unexplained.len(),
                faces = names(unexplained)
            ));
        }
    }
    verdict.summary = join_names(sentences.iter().map(String::as_str));
    (verdict, evidence)
}

fn scenes(explanation: &Explanation) -> Vec<SceneVerdict> {
    const SHOWS: [&str; 6] = [
        "check-panorama-shows-posx",
        "check-panorama-shows-negx",
        "check-panorama-shows-posy",
        "check-panorama-shows-negy",
        "check-panorama-shows-posz",
        "check-panorama-shows-negz",
    ];
    let is_wrong = |face: usize| {
        let word = FACES[face].0;
        !explanation.global.is_empty()
            || explanation.unexplained.contains(&face)
            || explanation.local.iter().any(|id| match id.split_once("-shows-") {
                Some((who, _)) => who.ends_with(word),
                None => id.contains(word),
            })
    };
    let scene = |(face, fit): (usize, &tiles::Fit)| SceneVerdict {
        scene: format!("{} {}", FACES[face].1, FACES[face].0),
        shows: tr!(SHOWS[face]).into(),
        right: !is_wrong(face),
        pixels_beyond: fit.beyond,
        worst: fit.worst,
    };
    explanation.fits.iter().enumerate().map(scene).collect()
}

/// Reports blurred faces; `sharpness` is relative to the possible sharpness.
pub fn blur(verdict: &mut Verdict, sharpness: f64) {
    if sharpness >= BLURRED {
        return;
    }
    let mut mistake = found("faces-blurred", 1.0);
    mistake.name = tr!(
        "check-panorama-they-have-of-the-panorama-s",
        name = mistake.name,
        sharpness = format!("{:.0}", 100.0 * sharpness)
    );
    verdict.verdict = Outcome::Wrong;
    verdict.score = 0.8;
    verdict.summary.clone_from(&mistake.name);
    verdict.mistakes.push(mistake);
}
