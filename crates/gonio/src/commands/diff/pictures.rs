//! The pictures of a comparison: the difference map with its scale, both pictures side by side, a wipe from A to B.

use super::read::Pixels;
use gonio_scene::difference::heat;
use gonio_scene::picture::EncodedPicture;

/// Height of the scale below a map.
const LEGEND: usize = 32;
/// The first row of its labels.
const LABELS: usize = 18;
const _: () = assert!(LABELS + TEXT_HEIGHT <= LEGEND);

/// The difference map. `full_scale`, in 8-bit steps and greater than 0, gets the brightest colour.
pub fn difference_map(a: &Pixels, b: &Pixels, full_scale: f64) -> EncodedPicture<u8> {
    let rgba = (0..a.len())
        .flat_map(|i| {
            let (ea, eb) = (a.encoded(i), b.encoded(i));
            let largest = (0..4).map(|c| 255.0 * (ea[c] - eb[c]).abs()).fold(0.0, f64::max);
            let finite = |p: [f64; 4]| p.iter().all(|v| v.is_finite());
            // NaN or infinity in only one of the two counts as the full difference.
            let share = if finite(a.linear(i)) == finite(b.linear(i)) { largest / full_scale } else { 1.0 };
            let [r, g, b] = heat(share);
            [r, g, b, 255]
        })
        .collect();
    EncodedPicture { width: a.width, height: a.height, rgba }
}

/// The map with its scale below: 0, half and full scale, in steps of 255.
pub fn with_legend(map: &EncodedPicture<u8>, full_scale: f64) -> EncodedPicture<u8> {
    let (width, height) = (map.width as usize, map.height as usize);
    let margin = 8;
    if width < 96 {
        return map.clone();
    }
    let mut rgba = map.rgba.clone();
    rgba.extend(std::iter::repeat_n([24, 24, 24, 255], width * LEGEND).flatten());
    let mut put = |x: usize, y: usize, color: [u8; 3]| {
        if x < width && y < LEGEND {
            let at = 4 * ((height + y) * width + x);
            rgba[at..at + 3].copy_from_slice(&color);
        }
    };
    let bar = width - 2 * margin;
    for x in 0..bar {
        for y in 6..14 {
            put(margin + x, y, heat(x as f64 / (bar - 1) as f64));
        }
    }
    let label = |steps: f64| {
        let text = if full_scale < 10.0 { format!("{steps:.2}") } else { format!("{steps:.0}") };
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    let labels = ["0".to_owned(), label(0.5 * full_scale), format!("{}/255", label(full_scale))];
    for (text, place) in labels.iter().zip([0.0, 0.5, 1.0]) {
        // The first label starts with the bar, the second is centred, the last ends with it.
        let left = margin as f64 + place * bar as f64 - place * text_width(text) as f64;
        draw_text(text, |x, y| put(left as usize + x, LABELS + y, [220, 220, 220]));
    }
    EncodedPicture { width: map.width, height: map.height + LEGEND as u32, rgba }
}

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

/// A digit of three by five pixels, for the scale below a difference map: five rows of three bits, the top row first.
fn glyph(c: char) -> Option<[u8; 5]> {
    Some(match c {
        '0' => [0b111, 0b101, 0b101, 0b101, 0b111],
        '1' => [0b010, 0b110, 0b010, 0b010, 0b111],
        '2' => [0b111, 0b001, 0b111, 0b100, 0b111],
        '3' => [0b111, 0b001, 0b111, 0b001, 0b111],
        '4' => [0b101, 0b101, 0b111, 0b001, 0b001],
        '5' => [0b111, 0b100, 0b111, 0b001, 0b111],
        '6' => [0b111, 0b100, 0b111, 0b101, 0b111],
        '7' => [0b111, 0b001, 0b010, 0b010, 0b010],
        '8' => [0b111, 0b101, 0b111, 0b101, 0b111],
        '9' => [0b111, 0b101, 0b111, 0b001, 0b111],
        '.' => [0b000, 0b000, 0b000, 0b000, 0b010],
        '/' => [0b001, 0b001, 0b010, 0b100, 0b100],
        _ => return None,
    })
}

/// Size of a pixel of a glyph.
const ZOOM: usize = 2;

/// Height of a line of text in pixels.
const TEXT_HEIGHT: usize = 5 * ZOOM;

/// Width of `text` in pixels.
fn text_width(text: &str) -> usize {
    (text.chars().count() * 4 * ZOOM).saturating_sub(ZOOM)
}

/// Calls `dot(x, y)` for every pixel of `text`, from its top left corner.
fn draw_text(text: &str, mut dot: impl FnMut(usize, usize)) {
    for (place, rows) in text.chars().map(glyph).enumerate() {
        for (y, row) in rows.into_iter().flatten().enumerate() {
            for x in (0..3).filter(|x| row >> (2 - x) & 1 == 1) {
                for (dx, dy) in (0..ZOOM).flat_map(|dy| (0..ZOOM).map(move |dx| (dx, dy))) {
                    dot((place * 4 + x) * ZOOM + dx, y * ZOOM + dy);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_legend_is_below_the_map_and_leaves_it_unchanged() {
        let map = EncodedPicture { width: 128, height: 4, rgba: vec![9; 128 * 4 * 4] };
        let with = with_legend(&map, 24.0);
        assert_eq!((with.width, with.height), (128, 4 + LEGEND as u32));
        assert_eq!(with.rgba.len(), 4 * 128 * (4 + LEGEND));
        assert_eq!(with.rgba[..map.rgba.len()], map.rgba[..]);
        assert!(with.rgba[map.rgba.len()..].chunks_exact(4).any(|p| p == [220, 220, 220, 255]));
    }
}
