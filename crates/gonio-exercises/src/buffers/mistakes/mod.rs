//! The mistakes that are known, each with the readers that make it.

mod table;

use super::reader::Reader;
use serde::Serialize;
pub(super) use table::MISTAKES;

/// A mistake, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct MistakeName {
    /// Stable, in kebab-case.
    pub id: &'static str,
    /// The title.
    pub name: &'static str,
    /// What the program does, and the consequence.
    pub explanation: &'static str,
    /// The change that fixes it.
    pub how_to_fix: &'static str,
}

/// A mistake with the readers that make it: the switch it sets, in each of the ways it is usually made.
pub(super) struct Mistake {
    pub(super) words: MistakeName,
    pub(super) variants: &'static [fn(&mut Reader)],
    /// A peculiarity that is fine as long as the rest of the program knows of it.
    pub(super) is_harmless: bool,
}

/// All mistakes that a buffer can be recognised to have, the likely ones first.
pub fn names() -> impl Iterator<Item = MistakeName> {
    MISTAKES.iter().map(|mistake| mistake.words)
}

/// A reader that makes mistakes.
#[derive(Clone, Debug)]
pub(super) struct WrongReader {
    /// Places in [`MISTAKES`], rising.
    pub(super) mistakes: Vec<usize>,
    pub(super) reader: Reader,
}

/// Every variant of every mistake alone, with both ways of cutting polygons.
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

/// Two mistakes at once, where neither hides the other: both switches can be set.
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

/// A student may well cut a quad along the other diagonal, and make a mistake besides.
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
