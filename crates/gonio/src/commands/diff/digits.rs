//! Digits of three by five pixels, for the scale below a difference map.

/// Five rows of three bits, the top row first.
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
pub const HEIGHT: usize = 5 * ZOOM;

/// Width of `text` in pixels.
pub fn width(text: &str) -> usize {
    (text.chars().count() * 4 * ZOOM).saturating_sub(ZOOM)
}

/// Calls `dot(x, y)` for every pixel of `text`, from its top left corner.
pub fn draw(text: &str, mut dot: impl FnMut(usize, usize)) {
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
