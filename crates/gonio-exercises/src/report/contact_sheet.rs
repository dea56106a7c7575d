//! A sheet of small pictures as one picture.

use super::picture::{Picture, Pictures};
use gonio_check::search::Evidence;
use gonio_check::testbench::TILE;
use gonio_check::verdict::Verdict;

/// A pixel of a test scene is a square of so many.
const ENLARGED: usize = 3;
/// Between two pictures, and around them all.
const GAP: usize = 6;
/// Behind everything, and where nothing is drawn.
const BACKGROUND: [u8; 4] = [46, 48, 54, 255];

/// A PNG with a column a scene and the rows yours, reference, difference and, where a mistake is named, what that draws (of a right answer: what the
/// reference draws in its own way).
/// Differences are colours from near black (none) to pale yellow, on the scale that the page of the same verdict states;
/// what is no number is magenta. Empty where there is nothing to show.
pub fn contact_sheet(evidence: &Evidence, verdict: &Verdict) -> Vec<u8> {
    let pictures = Pictures::new(evidence, verdict);
    let kinds = pictures.kinds();
    if pictures.count() == 0 {
        return Vec::new();
    }
    let side = TILE as usize * ENLARGED;
    let length = |count: usize| GAP + count * (side + GAP);
    let (width, height) = (length(pictures.count()), length(kinds.len()));
    let (Ok(wide), Ok(high)) = (u32::try_from(width), u32::try_from(height)) else { return Vec::new() };
    let mut sheet = Picture { width: wide, height: high, pixels: vec![BACKGROUND; width * height] };
    for column in 0..pictures.count() {
        for (row, kind) in kinds.iter().enumerate() {
            let Some(picture) = pictures.nth(column, *kind) else { continue };
            for y in 0..side {
                let start = (length(row) + y) * width + length(column);
                let from = &picture.pixels[(y / ENLARGED) * TILE as usize..];
                for (x, pixel) in sheet.pixels[start..start + side].iter_mut().enumerate() {
                    let drawn = from[x / ENLARGED];
                    if drawn[3] > 0 {
                        *pixel = drawn;
                    }
                }
            }
        }
    }
    sheet.png()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use gonio_check::testbench::Atlas;
    use gonio_check::verdict::Outcome;

    #[test]
    fn each_picture_has_its_place() {
        let size = (TILE * TILE) as usize;
        let flat = |grey: [f32; 2]| Atlas {
            pixels: grey.iter().flat_map(|grey| vec![[*grey, *grey, *grey, 1.0]; size]).collect(),
        };
        let evidence = Evidence {
            seen: flat([0.0, f32::NAN]),
            reference: flat([1.0, 1.0]),
            predicted: Some(flat([0.5, 0.5])),
            scenes: vec!["one".to_owned(), "two".to_owned()],
        };
        let file = contact_sheet(&evidence, &Verdict::new("ex04", Outcome::Correct, ""));
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        let side = TILE * ENLARGED as u32 + GAP as u32;
        assert_eq!((info.width, info.height), (2 * side + GAP as u32, 4 * side + GAP as u32));
        let at = |column: u32, row: u32| {
            let (x, y) = (column * side + side / 2, row * side + side / 2);
            let start = (y * info.width + x) as usize * 4;
            [bytes[start], bytes[start + 1], bytes[start + 2]]
        };
        assert_eq!(at(0, 0), [0, 0, 0]);
        assert_eq!(at(1, 0), [255, 0, 255]);
        assert_eq!([at(0, 1), at(1, 1)], [[255; 3]; 2]);
        assert_eq!(at(0, 2), super::super::picture::heat(1.0));
        assert_eq!(at(1, 3), [188; 3]);
        assert_eq!(bytes[..4], BACKGROUND);
    }
}
