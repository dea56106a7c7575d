//! The student's picture at the size of the comparison, and what it would be without a mistake.

use super::expected::Encoded;
use gonio_light::color::{srgb_decode_f32, srgb_encode};
use gonio_scene::Texture;

/// Sides between which pictures are compared; others are reduced or enlarged.
const SIDES: std::ops::RangeInclusive<u32> = 64..=1024;

/// How a picture is turned back before it is compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turn {
    /// Whether u and v are exchanged, first.
    pub transposed: bool,
    /// Whether u runs to the left.
    pub flip_u: bool,
    /// Whether v runs downwards.
    pub flip_v: bool,
}

impl Turn {
    /// All eight, the identity first and the likely ones before the others.
    pub fn all() -> impl Iterator<Item = Turn> {
        [false, true].into_iter().flat_map(|transposed| {
            [(false, false), (false, true), (true, false), (true, true)].map(|(flip_u, flip_v)| Turn {
                transposed,
                flip_u,
                flip_v,
            })
        })
    }

    /// The index of the texel that is shown at a texel.
    pub fn source(self, index: usize, side: usize) -> usize {
        let (x, y) = (index % side, index / side);
        let (x, y) = if self.transposed { (y, x) } else { (x, y) };
        let x = if self.flip_u { side - 1 - x } else { x };
        let y = if self.flip_v { side - 1 - y } else { y };
        y * side + x
    }
}

/// How a picture's numbers are changed back before they are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Not at all.
    #[default]
    Plain,
    /// They were encoded twice.
    Decoded,
    /// They were not encoded.
    Encoded,
}

impl Tone {
    /// All of them.
    pub const ALL: [Tone; 3] = [Tone::Plain, Tone::Decoded, Tone::Encoded];

    /// Changes a number back; the second value is how far the rounding to 8 bits may move the result.
    pub fn undo(self, value: f32) -> (f32, f32) {
        const HALF_A_STEP: f32 = 0.6 / 255.0;
        match self {
            Tone::Plain => (value, 0.0),
            Tone::Decoded => (srgb_decode_f32(value), HALF_A_STEP),
            Tone::Encoded => {
                let encode = |value: f32| srgb_encode(f64::from(value.clamp(0.0, 1.0))) as f32;
                (encode(value), encode(value + HALF_A_STEP) - encode(value - HALF_A_STEP))
            }
        }
    }
}

/// A picture as a square, the first row at the **bottom**.
pub struct SquarePicture {
    /// Texels along a side.
    pub side: u32,
    /// The numbers of the file, 0 to 1.
    pub colors: Vec<Encoded>,
    /// Whether its numbers are near those that were saved rather than equal.
    pub is_lossy: bool,
}

impl SquarePicture {
    /// The side at which a picture of this size is compared.
    pub fn side_for(texture: &Texture) -> u32 {
        texture.width.max(texture.height).clamp(*SIDES.start(), *SIDES.end())
    }

    /// Reduces a picture by the mean over each texel's area, or enlarges it.
    pub fn new(texture: &Texture, side: u32, is_lossy: bool) -> SquarePicture {
        let [columns, rows] = [texture.width, texture.height].map(|size| spans(size, side));
        let mut colors = Vec::with_capacity(side as usize * side as usize);
        for y in &rows {
            for x in &columns {
                let (mut sum, mut weight) = ([0.0_f32; 3], 0.0_f32);
                for (row, of_row) in y.texels() {
                    for (column, of_column) in x.texels() {
                        let share = of_row * of_column;
                        let color = texel(texture, column, row);
                        (0..3).for_each(|k| sum[k] += share * color[k]);
                        weight += share;
                    }
                }
                colors.push(sum.map(|sum| sum / weight.max(1e-9)));
            }
        }
        SquarePicture { side, colors, is_lossy }
    }

    /// The colour of the texel at a place, 0 to 1, as if the picture had `size` texels along a side.
    pub fn nearest(&self, u: f64, v: f64, size: u32) -> Encoded {
        let axis = |c: f64| {
            let middle = ((c * f64::from(size)).floor() + 0.5) / f64::from(size);
            ((middle * f64::from(self.side)) as usize).min(self.side as usize - 1)
        };
        self.colors[axis(v) * self.side as usize + axis(u)]
    }
}

/// A texel, row 0 at the bottom.
pub fn texel(texture: &Texture, column: u32, row: u32) -> Encoded {
    let at = 4 * ((texture.height - 1 - row) as usize * texture.width as usize + column as usize);
    [0, 1, 2].map(|k| f32::from(texture.rgba[at + k]) / 255.0)
}

/// The texels that one texel of another size covers.
struct Span {
    start: f64,
    end: f64,
    size: u32,
}

impl Span {
    /// Each with its share.
    fn texels(&self) -> impl Iterator<Item = (u32, f32)> + '_ {
        let last = (self.end.ceil() as u32).min(self.size);
        (self.start as u32..last.max(self.start as u32 + 1)).map(|texel| {
            let covered = self.end.min(f64::from(texel + 1)) - self.start.max(f64::from(texel));
            (texel.min(self.size - 1), covered.max(1e-6) as f32)
        })
    }
}

fn spans(size: u32, side: u32) -> Vec<Span> {
    let extent = f64::from(size) / f64::from(side);
    (0..side).map(|i| Span { start: f64::from(i) * extent, end: f64::from(i + 1) * extent, size }).collect()
}
