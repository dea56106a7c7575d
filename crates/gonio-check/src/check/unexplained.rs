//! What is said where pictures name no mistake: a picture without light on it, and what stands in the source all the same.

use super::SURE;
use crate::mistakes;
use crate::rules::Analysis;
use crate::search::{Evidence, PIXEL_TOLERANCE, Task, named};
use crate::testbench::Atlas;
use crate::verdict::{FoundMistake, Outcome, Verdict};

/// More names at once than a student can use.
const MOST_NAMES: usize = 4;
/// Where a picture fits everything that puts the light out, a name needs this support by the source.
const SUPPORTED_FROM: f32 = 0.85;

/// What the source shows beyond doubt, whatever else a program does. The rules for other mistakes take a fog's distance, a
/// shadow's cosine or a second light for the exercise's.
const BEYOND_DOUBT: &[&str] = &[
    "normal-by-model-matrix",
    "normal-by-model-view",
    "normal-by-whole-matrix",
    "normal-not-transformed",
    "normal-translated",
    "normal-not-normalised-in-vertex",
    "normal-not-renormalised",
    "position-in-clip-space",
    "light-direction-minus-normal",
    "light-direction-reversed",
    "light-position-as-direction",
    "diffuse-floor",
    "diffuse-half-lambert",
    "specular-without-power",
    "ambient-attenuated",
    "ambient-twice",
    "albedo-squared",
    "gamma-applied",
    "attenuation-without-constant",
    "attenuation-inverse-square",
    "attenuation-added",
    "attenuation-distance-of-direction",
    "attenuation-plus-view-distance",
    "refraction-ratio-inverted",
    "skybox-keeps-translation",
    "matrix-order",
    "terms-not-put-out",
    "position-not-transformed",
    "position-without-translation",
    "view-position-at-origin",
    "output-normal",
];

/// Mistakes that no model of the catalogue has, and the source shows.
const WITHOUT_MODEL: &[&str] = &["ambient-in-cone", "attenuation-other-formula"];

/// A picture that says nothing about mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Blank {
    Nothing,
    Black,
    NoNumber,
    Flat,
}

impl Blank {
    fn recognise(seen: &Atlas, test_scenes: usize) -> Option<Blank> {
        let pixels = || (0..test_scenes).flat_map(|tile| seen.tile(tile)).filter(|pixel| Atlas::is_drawn(pixel));
        let all = |is: &dyn Fn(f32) -> bool| pixels().all(|pixel| pixel.iter().take(3).all(|channel| is(*channel)));
        if pixels().next().is_none() {
            Some(Blank::Nothing)
        } else if all(&|channel| channel.abs() <= PIXEL_TOLERANCE) {
            Some(Blank::Black)
        } else if all(&f32::is_nan) {
            Some(Blank::NoNumber)
        } else {
            (0..test_scenes).all(|tile| is_flat(seen.tile(tile))).then_some(Blank::Flat)
        }
    }

    fn sentence(self) -> &'static str {
        match self {
            Blank::Nothing => "nothing is drawn; is gl_Position what the exercise asks for?",
            Blank::Black => {
                "the picture is black in every scene; some vector, colour or strength is 0 that should \
                             not be"
            }
            Blank::NoNumber => {
                "every pixel is NaN in every scene; look for a division of 0 by 0, or for a normalised vector of \
                 length 0"
            }
            Blank::Flat => {
                "the picture has a single colour in every scene; no term depends on the position or the \
                            normal"
            }
        }
    }
}

fn is_flat(tile: &[[f32; 4]]) -> bool {
    let mut drawn = tile.iter().filter(|pixel| Atlas::is_drawn(pixel));
    let Some(first) = drawn.next() else { return true };
    drawn.all(|pixel| pixel.iter().zip(first).take(3).all(|(a, b)| (a - b).abs() <= PIXEL_TOLERANCE))
}

/// A verdict without a name, or with one that any picture without light would get, is told what the source shows.
pub(super) fn name_from_source(verdict: &mut Verdict, evidence: Option<&Evidence>, source: &Analysis, task: &Task) {
    if verdict.verdict != Outcome::Wrong {
        return;
    }
    let model = task.model;
    let blank = evidence.and_then(|evidence| Blank::recognise(&evidence.seen, evidence.scenes.len()));
    if let Some(blank) = blank.filter(|_| task.model.is_lit()) {
        let is_supported = |id: &str| source.support(id, model) >= SUPPORTED_FROM;
        // Everything that puts the light out explains it, so only the source can name it.
        if !verdict.mistakes.iter().all(|found| is_supported(&found.id)) || verdict.mistakes.is_empty() {
            verdict.mistakes.clear();
            verdict.peculiarities.clear();
            verdict.summary = blank.sentence().to_owned();
            verdict.runner_up = None;
        }
    }
    if !verdict.mistakes.is_empty() {
        return;
    }
    let is_shown = |id: &str| BEYOND_DOUBT.contains(&id) && source.support(id, model) >= SURE;
    let shown: Vec<_> = mistakes::for_model(model)
        .filter(|mistake| is_shown(&mistake.id) && source.line(&mistake.id, model).is_some())
        .map(|mistake| FoundMistake::from_catalogue(mistake, 0.0))
        .chain(without_model(source, task))
        .take(MOST_NAMES)
        .collect();
    if !shown.is_empty() {
        verdict.mistakes = shown;
        verdict.summary =
            format!("{}; the source shows this, and the picture has further errors", verdict.mistake_names());
    }
}

/// Of programs that do more than any exercise asks.
fn without_model<'a>(source: &'a Analysis, task: &'a Task) -> impl Iterator<Item = FoundMistake> + 'a {
    let is_asked = |id: &str| task.model.is_lit() && (task.attenuated || !id.starts_with("attenuation"));
    let is_shown = |id: &str| source.support(id, task.model) >= SURE && source.line(id, task.model).is_some();
    WITHOUT_MODEL.iter().filter(move |id| is_asked(id) && is_shown(id)).filter_map(|id| named(id, 0.0))
}
