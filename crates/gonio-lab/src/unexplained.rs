//! What is said where pictures name no mistake: a picture without light on it, a mirror that is tinted, and what stands in the
//! source all the same.

use crate::bank;
use crate::check::{Evidence, PIXEL_TOLERANCE, PIXELS_TOLERANCE, Task, named};
use crate::locate::Source;
use crate::stage::Sheet;
use crate::student::SURE;
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
    "light-position-as-direction",
    "diffuse-floor",
    "diffuse-half-lambert",
    "specular-without-power",
    "specular-exponent-wrong",
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
];

/// A picture that says nothing about mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Blank {
    Nothing,
    Black,
    NoNumber,
    Flat,
}

impl Blank {
    fn of(seen: &Sheet, situations: usize) -> Option<Blank> {
        let pixels = || (0..situations).flat_map(|tile| seen.tile(tile)).filter(|pixel| Sheet::is_drawn(pixel));
        let all = |is: &dyn Fn(f32) -> bool| pixels().all(|pixel| pixel.iter().take(3).all(|channel| is(*channel)));
        if pixels().next().is_none() {
            Some(Blank::Nothing)
        } else if all(&|channel| channel.abs() <= PIXEL_TOLERANCE) {
            Some(Blank::Black)
        } else if all(&f32::is_nan) {
            Some(Blank::NoNumber)
        } else {
            (0..situations).all(|tile| is_flat(seen.tile(tile))).then_some(Blank::Flat)
        }
    }

    fn sentence(self) -> &'static str {
        match self {
            Blank::Nothing => "nothing is drawn; is gl_Position what the exercise asks for?",
            Blank::Black => "it is black in every scene; some vector, colour or strength is 0 where it should not be",
            Blank::NoNumber => {
                "it is no number (NaN) in every scene; somewhere 0 is divided by 0, or a vector of length 0 is normalised"
            }
            Blank::Flat => "it has one colour all over in every scene; no term depends on the place or on the normal",
        }
    }
}

fn is_flat(tile: &[[f32; 4]]) -> bool {
    let mut drawn = tile.iter().filter(|pixel| Sheet::is_drawn(pixel));
    let Some(first) = drawn.next() else { return true };
    drawn.all(|pixel| pixel.iter().zip(first).take(3).all(|(a, b)| (a - b).abs() <= PIXEL_TOLERANCE))
}

/// A verdict without a name, or with one that any picture without light would get, is told what the source shows.
pub fn mend(verdict: &mut Verdict, evidence: Option<&Evidence>, source: &Source, task: &Task) {
    if verdict.verdict != Outcome::Wrong {
        return;
    }
    let model = task.model;
    let blank = evidence.and_then(|evidence| Blank::of(&evidence.seen, evidence.scenes.len()));
    if let Some(blank) = blank.filter(|_| task.model.is_lit()) {
        let is_supported = |id: &str| source.looks_like(id, model) >= SUPPORTED_FROM;
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
    if let Some(found) =
        evidence.filter(|evidence| !task.model.is_lit() && is_mixed(evidence)).and(named("lookup-mixed", 1.0))
    {
        verdict.summary = found.name.clone();
        verdict.mistakes = vec![found];
        return;
    }
    let is_shown = |id: &str| BEYOND_DOUBT.contains(&id) && source.looks_like(id, model) >= SURE;
    let shown: Vec<_> = bank::of(model)
        .filter(|mistake| is_shown(&mistake.id) && source.line(&mistake.id, model).is_some())
        .map(|mistake| FoundMistake::of_bank(mistake, 0.0))
        .take(MOST_NAMES)
        .collect();
    if !shown.is_empty() {
        let names: Vec<&str> = shown.iter().map(|found| found.name.as_str()).collect();
        verdict.summary = format!("{}; the source shows that, and more is wrong in the picture", names.join("; and: "));
        verdict.mistakes = shown;
    }
}

/// Whether the picture is the right one, each channel times a number plus a number: `mix(lookup, colour, 0.3)`.
fn is_mixed(evidence: &Evidence) -> bool {
    let both = || {
        let pairs = evidence.seen.pixels.iter().zip(&evidence.reference.pixels);
        pairs.filter(|(a, b)| Sheet::is_drawn(a) && Sheet::is_drawn(b))
    };
    (0..3).all(|channel| {
        let (mut n, mut x, mut y, mut xx, mut xy) = (0.0_f64, 0.0, 0.0, 0.0, 0.0);
        for (seen, right) in both() {
            let (a, b) = (f64::from(right[channel]), f64::from(seen[channel]));
            (n, x, y, xx, xy) = (n + 1.0, x + a, y + b, xx + a * a, xy + a * b);
        }
        let spread = n * xx - x * x;
        let factor = (n * xy - x * y) / spread;
        let offset = (y - factor * x) / n;
        // A share of what was looked up must be left, and no more.
        if !(spread > 1e-6 && (0.02..=1.0).contains(&factor) && offset.is_finite()) {
            return false;
        }
        let beyond = both().filter(|(seen, right)| {
            let rest = f64::from(seen[channel]) - factor * f64::from(right[channel]) - offset;
            rest.abs() > 2.0 * f64::from(PIXEL_TOLERANCE)
        });
        beyond.count() as f64 <= 2.0 * PIXELS_TOLERANCE * n
    })
}
