//! The known mistakes, each with the readers that make it.

use super::reader::{Axes, From, Negative, Numbers, Order, Polygons, Reader, SlotUse, Which};
use gonio_language::tr;
use serde::Serialize;

/// The texts of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct MistakeName {
    /// Stable id, in kebab-case.
    pub id: &'static str,
    /// The title.
    pub name: &'static str,
    /// The behaviour of the program, and the consequence.
    pub explanation: &'static str,
    /// The change that fixes it.
    pub how_to_fix: &'static str,
}

/// A mistake with the readers that make it: each variant sets the switches for one way to make it.
pub(super) struct Mistake {
    /// Stable id, in kebab-case.
    pub(super) id: &'static str,
    /// The ids of its texts: its title, the behaviour of the program, the change that fixes it.
    texts: [&'static str; 3],
    pub(super) variants: &'static [fn(&mut Reader)],
    /// Whether it is a peculiarity that is fine as long as the rest of the program takes it into account.
    pub(super) is_harmless: bool,
}

/// All mistakes that can be recognised in a buffer, the likely ones first.
pub fn names() -> impl Iterator<Item = MistakeName> {
    MISTAKES.iter().map(Mistake::words)
}

/// A reader that makes mistakes.
#[derive(Clone, Debug)]
pub(super) struct WrongReader {
    /// Indices in [`MISTAKES`], in ascending order.
    pub(super) mistakes: Vec<usize>,
    pub(super) reader: Reader,
}

/// Every variant of every single mistake, with both ways of cutting polygons.
pub(super) fn singles() -> Vec<WrongReader> {
    let variants = |(number, mistake): (usize, &Mistake)| -> Vec<WrongReader> {
        let made = mistake.variants.iter().map(|variant| {
            let mut reader = Reader::default();
            variant(&mut reader);
            WrongReader { mistakes: vec![number], reader }
        });
        made.collect()
    };
    with_other_diagonals(MISTAKES.iter().enumerate().flat_map(variants).collect())
}

/// Pairs of mistakes of which neither hides the other.
pub(super) fn pairs(allowed: impl Fn(usize, usize) -> bool) -> Vec<WrongReader> {
    let mut pairs = Vec::new();
    for (first, a) in MISTAKES.iter().enumerate() {
        for (second, b) in MISTAKES.iter().enumerate().skip(first + 1).filter(|(second, _)| allowed(first, *second)) {
            for variant_a in a.variants {
                for variant_b in b.variants {
                    let [mut ab, mut ba] = [Reader::default(), Reader::default()];
                    variant_a(&mut ab);
                    let only_a = ab.clone();
                    variant_b(&mut ab);
                    variant_b(&mut ba);
                    let only_b = ba.clone();
                    variant_a(&mut ba);
                    if ab == ba && ab != only_a && ab != only_b {
                        pairs.push(WrongReader { mistakes: vec![first, second], reader: ab });
                    }
                }
            }
        }
    }
    with_other_diagonals(pairs)
}

/// Adds readers that cut quads along the other diagonal: a student may do so and make a mistake besides.
fn with_other_diagonals(readers: Vec<WrongReader>) -> Vec<WrongReader> {
    let others: Vec<WrongReader> = readers
        .iter()
        .filter(|wrong| wrong.reader.polygons == Default::default() && wrong.reader.order == Default::default())
        .map(|wrong| {
            let reader = Reader { other_diagonals: true, ..wrong.reader.clone() };
            WrongReader { mistakes: wrong.mistakes.clone(), reader }
        })
        .collect();
    readers.into_iter().chain(others).collect()
}

impl Mistake {
    /// Its texts in the current language.
    pub(super) fn words(&self) -> MistakeName {
        let [name, explanation, how_to_fix] = self.texts.map(|id| tr!(id));
        MistakeName { id: self.id, name, explanation, how_to_fix }
    }
}

/// A mistake that is wrong, with the readers that make it.
macro_rules! mistake {
    ($id:literal, $variants:expr $(,)?) => {
        Mistake {
            id: $id,
            texts: [
                concat!("check-buffer-", $id),
                concat!("check-buffer-", $id, ".explanation"),
                concat!("check-buffer-", $id, ".fix"),
            ],
            variants: $variants,
            is_harmless: false,
        }
    };
}

/// The likely ones first: if two explain a buffer equally well, the first is named.
pub(super) static MISTAKES: [Mistake; 38] = [
    mistake!("indices-from-0", &[|r| r.from_zero = [true; 3]],),
    mistake!("tex-coord-and-normal-swapped", &[|r| r.slots = SlotUse::Swapped],),
    Mistake { is_harmless: true, ..mistake!("v-flipped", &[|r| r.flip_v = true],) },
    mistake!("quads-first-triangle-only", &[|r| r.polygons = Polygons::FirstTriangle],),
    mistake!("quads-lost", &[|r| r.polygons = Polygons::Lost],),
    mistake!("quads-as-triangles", &[|r| r.polygons = Polygons::Stream],),
    mistake!("large-polygons-cut-short", &[|r| r.polygons = Polygons::FirstQuad],),
    mistake!("large-polygons-lost", &[|r| r.polygons = Polygons::LargeLost],),
    mistake!("concave-polygon-as-fan", &[|r| r.polygons = Polygons::Fan],),
    mistake!("normals-by-position", &[|r| r.normal = From::Position],),
    mistake!("tex-coords-by-position", &[|r| r.tex_coord = From::Position],),
    mistake!("vertices-not-split", &[|r| r.unsplit = Some(Which::Last), |r| r.unsplit = Some(Which::First)],),
    mistake!(
        "normals-missing",
        &[
            |r| r.normal = From::Constant([0.0; 3]),
            |r| r.normal = From::Constant([0.0, 0.0, 1.0]),
            |r| r.normal = From::Constant([0.0, 1.0, 0.0]),
        ],
    ),
    mistake!("tex-coords-missing", &[|r| r.tex_coord = From::Constant([0.0; 3])],),
    mistake!("negative-as-positive", &[|r| r.negative = Negative::Positive],),
    mistake!("negative-faces-lost", &[|r| r.negative = Negative::FacesLost],),
    mistake!("negative-from-the-end-of-the-file", &[|r| r.negative = Negative::FromEnd],),
    mistake!("negative-one-too-far", &[|r| r.negative = Negative::OneTooFar],),
    mistake!("normal-indices-from-0", &[|r| r.from_zero[2] = true],),
    mistake!("tex-coord-indices-from-0", &[|r| r.from_zero[1] = true],),
    mistake!("position-indices-from-0", &[|r| r.from_zero[0] = true],),
    mistake!("u-and-v-swapped", &[|r| r.swap_uv = true],),
    mistake!("y-and-z-swapped", &[|r| r.axes = Axes::SwappedYz],),
    mistake!("turned-to-z-up", &[|r| r.axes = Axes::ZUp],),
    mistake!("winding-reversed", &[|r| r.turned_over = true],),
    mistake!("faces-ignored", &[|r| r.order = Order::FacesIgnored],),
    mistake!("indices-not-applied", &[|r| r.order = Order::EachOnce],),
    mistake!("one-normal-per-face", &[|r| r.normal = From::FirstCorner],),
    mistake!("normals-computed", &[|r| r.normal = From::Geometry],),
    mistake!("last-object-only", &[|r| r.objects = Some(Which::Last)],),
    mistake!("first-object-only", &[|r| r.objects = Some(Which::First)],),
    mistake!("indices-anew-in-each-object", &[|r| r.anew = true],),
    mistake!("first-lines-skipped", &[|r| r.skips_first = true],),
    mistake!("last-face-lost", &[|r| r.loses_last_face = true],),
    mistake!("numbers-truncated", &[|r| r.numbers = Numbers::Truncated],),
    mistake!("decimal-comma", &[|r| r.numbers = Numbers::StoppedAtPoint],),
    mistake!("empty-slot-passed-over", &[|r| r.slots = SlotUse::EmptyPassedOver],),
    mistake!("short-corners-lost", &[|r| r.loses_partial = true],),
];
