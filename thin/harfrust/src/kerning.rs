//! Kerning: the pairs of glyphs of a font's GPOS table (OpenType 1.9, "GPOS", lookup type 2) under its feature `kern`.

use skrifa::raw::tables::gpos::{PairPos, PositionLookupList, PositionSubtables};
use skrifa::raw::types::Tag;
use skrifa::raw::{FontRef, TableProvider};
use skrifa::{GlyphId, GlyphId16};

/// The kerning of a font. Tables that cannot be read count as 0: text is legible without kerning.
pub struct Kerning<'a> {
    lookups: Option<PositionLookupList<'a>>,
    /// Indices of the lookups that are kerning, in the order in which they apply.
    kern_lookups: Vec<u16>,
}

impl<'a> Kerning<'a> {
    /// Reads the kerning of a font; empty if it has none.
    pub fn of(font: &FontRef<'a>) -> Self {
        let Ok(table) = font.gpos() else { return Kerning { lookups: None, kern_lookups: Vec::new() } };
        let mut kern_lookups = Vec::new();
        if let Ok(features) = table.feature_list() {
            let data = features.offset_data();
            for record in features.feature_records().iter().filter(|record| record.feature_tag() == Tag::new(b"kern")) {
                if let Ok(feature) = record.feature(data) {
                    kern_lookups.extend(feature.lookup_list_indices().iter().map(|index| index.get()));
                }
            }
        }
        // Scripts and languages repeat the same lookups.
        kern_lookups.sort_unstable();
        kern_lookups.dedup();
        Kerning { lookups: table.lookup_list().ok(), kern_lookups }
    }

    /// The amount added to the advance of `left` before `right`, in font units.
    pub fn between(&self, left: GlyphId, right: GlyphId) -> i32 {
        let (Ok(left), Ok(right)) = (GlyphId16::try_from(left), GlyphId16::try_from(right)) else { return 0 };
        let Some(lookups) = self.lookups.as_ref().filter(|_| !self.kern_lookups.is_empty()).map(|list| list.lookups())
        else {
            return 0;
        };
        let of_lookup = |index: &u16| {
            let Ok(PositionSubtables::Pair(subtables)) = lookups.get(usize::from(*index)).ok()?.subtables() else {
                return None;
            };
            // The first subtable that contains the pair counts.
            subtables.iter().find_map(|pairs| in_pairs(&pairs.ok()?, left, right))
        };
        self.kern_lookups.iter().filter_map(of_lookup).map(i32::from).sum()
    }
}

/// The value of a pair; `None` if this subtable does not contain it.
fn in_pairs(pairs: &PairPos<'_>, left: GlyphId16, right: GlyphId16) -> Option<i16> {
    match pairs {
        PairPos::Format1(pairs) => {
            let index = pairs.coverage().ok()?.get(left)?;
            let set = pairs.pair_sets().get(usize::from(index)).ok()?;
            let found = set.pair_value_records().iter().find_map(|record| {
                let record = record.ok()?;
                (record.second_glyph() == right).then(|| record.value_record1().x_advance())
            })?;
            Some(found.unwrap_or(0))
        }
        PairPos::Format2(classes) => {
            classes.coverage().ok()?.get(left)?;
            let (first, second) = (classes.class_def1().ok()?.get(left), classes.class_def2().ok()?.get(right));
            let row = classes.class1_records().get(usize::from(first)).ok()?;
            let record = row.class2_records().get(usize::from(second)).ok()?;
            Some(record.value_record1().x_advance().unwrap_or(0))
        }
    }
}
