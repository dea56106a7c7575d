//! The difference map: the largest difference of a pixel's channels as a heat colour.

use super::digits;
use super::read::Pixels;
use gonio_scene::difference::heat;
use gonio_scene::picture::EncodedPicture;

/// Height of the scale below a map.
const LEGEND: usize = 32;
/// The first row of its labels.
const LABELS: usize = 18;
const _: () = assert!(LABELS + digits::HEIGHT <= LEGEND);

/// The difference map. `full_scale`, in 8-bit steps and greater than 0, gets the brightest colour.
pub fn map(a: &Pixels, b: &Pixels, full_scale: f64) -> EncodedPicture<u8> {
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
        let left = margin as f64 + place * bar as f64 - place * digits::width(text) as f64;
        digits::draw(text, |x, y| put(left as usize + x, LABELS + y, [220, 220, 220]));
    }
    EncodedPicture { width: map.width, height: map.height + LEGEND as u32, rgba }
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
