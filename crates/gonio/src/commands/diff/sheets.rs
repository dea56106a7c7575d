//! Both pictures in one: side by side, or as a wipe from A to B.

use super::read::Pixels;
use gonio_scene::picture::EncodedPicture;

/// Pixels between the pictures.
const GAP: usize = 6;
const GAP_COLOR: [u8; 4] = [24, 24, 24, 255];

/// A, B and the map, from left to right.
pub fn side_by_side(a: &Pixels, b: &Pixels, map: &EncodedPicture<u8>) -> EncodedPicture<u8> {
    let (width, height) = (a.width as usize, a.height as usize);
    let mut rgba = Vec::with_capacity(4 * (3 * width + 2 * GAP) * height);
    let gap = || std::iter::repeat_n(GAP_COLOR, GAP).flatten();
    for y in 0..height {
        let row = y * width..(y + 1) * width;
        for pixels in [a, b] {
            rgba.extend(row.clone().flat_map(|i| opaque(pixels.displayed(i))));
            rgba.extend(gap());
        }
        rgba.extend_from_slice(&map.rgba[4 * row.start..4 * row.end]);
    }
    EncodedPicture { width: (3 * width + 2 * GAP) as u32, height: a.height, rgba }
}

/// A up to `share` of the width, a thin line, then B.
pub fn wipe(a: &Pixels, b: &Pixels, share: f64) -> EncodedPicture<u8> {
    let width = a.width as usize;
    let line = (share * width as f64).round() as usize;
    let rgba = (0..a.len())
        .flat_map(|i| match (i % width).cmp(&line) {
            std::cmp::Ordering::Less => opaque(a.displayed(i)),
            std::cmp::Ordering::Equal if line > 0 => [255; 4],
            _ => opaque(b.displayed(i)),
        })
        .collect();
    EncodedPicture { width: a.width, height: a.height, rgba }
}

fn opaque([r, g, b]: [u8; 3]) -> [u8; 4] {
    [r, g, b, 255]
}
