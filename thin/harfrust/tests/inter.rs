//! Text in gonio's own font, as egui shapes it.
#![allow(missing_docs)]

use harfrust::{BufferFlags, ShapeOptions, ShaperData, UnicodeBuffer};
use skrifa::FontRef;

const INTER: &[u8] = include_bytes!("../../../assets/fonts/Inter-Regular.ttf");

/// Glyph, cluster and advance of each character.
fn shaped(text: &str) -> Vec<(u32, u32, i32)> {
    let font = FontRef::new(INTER).unwrap_or_else(|e| panic!("{e}"));
    let data = ShaperData::new(&font);
    let mut buffer = UnicodeBuffer::new();
    buffer.set_flags(BufferFlags::empty());
    buffer.push_str(text);
    buffer.guess_segment_properties();
    let shaped = data.shaper(&font).instance(None).build().shape(buffer, ShapeOptions::new());
    let glyphs = shaped.glyph_infos().iter().zip(shaped.glyph_positions());
    glyphs.map(|(info, position)| (info.glyph_id, info.cluster, position.x_advance)).collect()
}

fn advances(text: &str) -> Vec<i32> {
    shaped(text).iter().map(|glyph| glyph.2).collect()
}

#[test]
fn pairs_are_kerned_and_others_are_not() {
    let (a, v, h) = (advances("A")[0], advances("V")[0], advances("H")[0]);
    assert!(a > 0 && v > 0 && h > 0);
    assert_eq!(advances("HH"), [h, h]);
    // A and V are kerned by about a twentieth of their width; the last glyph keeps its advance.
    let pair = advances("AV");
    assert!(pair[0] < a && pair[0] > a * 8 / 10, "{} of {a}", pair[0]);
    assert_eq!(pair[1], v);
    // The same in both orders, because both letters are symmetric.
    assert_eq!(a - pair[0], v - advances("VA")[0]);
}

#[test]
fn clusters_are_bytes_and_what_the_font_lacks_is_glyph_nought() {
    let glyphs = shaped("aé\u{5d0}b");
    let clusters: Vec<u32> = glyphs.iter().map(|glyph| glyph.1).collect();
    assert_eq!(clusters, [0, 1, 3, 5]);
    assert_eq!(glyphs[2].0, 0);
    assert!([0, 1, 3].iter().all(|&index| glyphs[index].0 != 0));
}
