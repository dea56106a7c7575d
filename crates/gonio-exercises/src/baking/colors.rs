//! With which mistakes is a picture the right one?

use super::expected::{Encoded, Expected, JudgedTexel, difference};
use super::picture::{SquarePicture, Tone, Turn};

/// Tolerance of a channel: 4 steps of 8 bits.
const TOLERANCE: f32 = 4.0 / 255.0;
/// Tolerance of a channel of a JPEG.
const TOLERANCE_LOSSY: f32 = 14.0 / 255.0;
/// The least share of a channel that is right too: 0.92 of the light, encoded. From version 4.0 on, Blender's diffuse colour is what its specular
/// layer lets through: 0.97 of the dough's, 0.94 of the icing's.
const LEAST_SHARE: f32 = 0.965;
/// The share of right texels from which a picture is the right one. Blender's margins of 16 texels overwrite charts that are
/// nearer than that: 5 % of a picture of 512 x 512 texels.
const RIGHT: f64 = 0.9;
/// The share of right texels from which a part of the surface is right: small parts have more borders.
const RIGHT_PART: f64 = 0.7;
/// The share of a part's texels that are one colour from which it was not baked.
const UNBAKED: f64 = 0.9;
/// Most texels by which mistakes are tried.
const TRIED: usize = 30_000;

/// The texels of one part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartColors {
    /// Judged texels.
    pub texels: usize,
    /// Those with the right colour.
    pub right: usize,
    /// Those with the background's colour that want another.
    pub background: usize,
}

impl PartColors {
    /// The share of right texels; 1 without any.
    pub fn share(&self) -> f64 {
        if self.texels == 0 { 1.0 } else { self.right as f64 / self.texels as f64 }
    }

    /// Whether the part is right.
    pub fn is_right(&self) -> bool {
        self.share() >= RIGHT_PART
    }

    /// Whether nothing was baked for this part.
    pub fn is_unbaked(&self) -> bool {
        self.texels > 0 && self.background as f64 >= UNBAKED * self.texels as f64
    }
}

/// A picture, as it is once mistakes are undone.
pub struct Undone<'a> {
    pub picture: &'a SquarePicture,
    pub turn: Turn,
    pub tone: Tone,
}

impl Undone<'_> {
    fn color(&self, index: usize) -> (Encoded, f32) {
        let stored = self.picture.colors[self.turn.source(index, self.picture.side as usize)];
        let (mut color, mut rounding) = (stored, 0.0_f32);
        for channel in &mut color {
            let (undone, slack) = self.tone.undo(*channel);
            (*channel, rounding) = (undone, rounding.max(slack));
        }
        let lossy = if self.picture.is_lossy { TOLERANCE_LOSSY } else { TOLERANCE };
        (color, lossy + rounding)
    }

    /// Whether a texel has a colour that the right picture has there or next to it.
    fn is_right(&self, expected: &Expected, index: usize) -> bool {
        let (color, tolerance) = self.color(index);
        let [low, high] = expected.range[index];
        (0..3).all(|k| (LEAST_SHARE * low[k] - tolerance..=high[k] + tolerance).contains(&color[k]))
    }

    /// The colours of all parts.
    pub fn parts(
        &self,
        expected: &Expected,
        texels: &[JudgedTexel],
        parts: usize,
        background: Encoded,
    ) -> Vec<PartColors> {
        let mut counts = vec![PartColors::default(); parts];
        for texel in texels {
            let index = texel.index as usize;
            let Some(count) = counts.get_mut(usize::from(texel.part)) else { continue };
            count.texels += 1;
            if self.is_right(expected, index) {
                count.right += 1;
            } else {
                let stored = self.picture.colors[self.turn.source(index, self.picture.side as usize)];
                count.background += usize::from(is_background(stored, background));
            }
        }
        counts
    }
}

/// Whether a texel has the colour of the background, or is black.
fn is_background(stored: Encoded, background: Encoded) -> bool {
    difference(stored, background) < 0.03 || difference(stored, [0.0; 3]) < 0.03
}

/// The share of right texels over the parts that were baked; `None` if too few were for a proof.
fn share_of_baked(parts: &[PartColors], is_turned: bool) -> Option<f64> {
    let all: usize = parts.iter().map(|part| part.texels).sum();
    let baked: Vec<&PartColors> = parts.iter().filter(|part| !part.is_unbaked()).collect();
    let (texels, right) = baked.iter().fold((0, 0), |(t, r), part| (t + part.texels, r + part.right));
    let least = if is_turned { all / 4 } else { all / 100 };
    (texels > 0 && texels >= least).then(|| right as f64 / texels as f64)
}

/// The mistakes with which a picture is the right one.
#[derive(Clone, Debug)]
pub struct ColorFinding {
    /// How the picture is turned.
    pub turn: Turn,
    /// How its numbers are changed.
    pub tone: Tone,
    /// All parts, with these mistakes undone.
    pub parts: Vec<PartColors>,
    /// Whether the picture is then right, apart from parts that were not baked.
    pub is_explained: bool,
}

impl ColorFinding {
    /// Finds the fewest mistakes with which the picture is right; without any, the picture as it is.
    pub fn find(expected: &Expected, picture: &SquarePicture, parts: usize) -> ColorFinding {
        let step = expected.judged.len().div_ceil(TRIED).max(1);
        let some: Vec<JudgedTexel> = expected.judged.iter().step_by(step).copied().collect();
        let mut best: Option<(usize, f64, Turn, Tone)> = None;
        for turn in Turn::all() {
            let background = background(expected, picture, turn);
            for tone in Tone::ALL {
                let undone = Undone { picture, turn, tone };
                let counts = undone.parts(expected, &some, parts, background);
                let mistakes = usize::from(turn != Turn::default()) + usize::from(tone != Tone::Plain);
                let Some(share) = share_of_baked(&counts, mistakes > 0).filter(|share| *share >= RIGHT) else {
                    continue;
                };
                let is_better = |&(least, most, ..): &(usize, f64, Turn, Tone)| {
                    mistakes < least || mistakes == least && share > most
                };
                if best.as_ref().is_none_or(is_better) {
                    best = Some((mistakes, share, turn, tone));
                }
            }
        }
        let (turn, tone) = best.map_or((Turn::default(), Tone::Plain), |(_, _, turn, tone)| (turn, tone));
        let background = background(expected, picture, turn);
        let parts = Undone { picture, turn, tone }.parts(expected, &expected.judged, parts, background);
        ColorFinding { turn, tone, parts, is_explained: best.is_some() }
    }

    /// Whether the picture is right as it is.
    pub fn is_right(&self) -> bool {
        self.is_explained
            && self.turn == Turn::default()
            && self.tone == Tone::Plain
            && self.parts.iter().all(PartColors::is_right)
    }
}

/// The most frequent colour beside the surface.
pub fn background(expected: &Expected, picture: &SquarePicture, turn: Turn) -> Encoded {
    let side = picture.side as usize;
    let free = expected.is_touched.iter().enumerate().filter(|(_, touched)| !**touched);
    most_frequent(free.map(|(index, _)| picture.colors[turn.source(index, side)])).unwrap_or_default()
}

/// The most frequent colour, in steps of a 64th.
pub fn most_frequent(colors: impl Iterator<Item = Encoded>) -> Option<Encoded> {
    let mut counts: std::collections::BTreeMap<[u8; 3], (usize, Encoded)> = std::collections::BTreeMap::new();
    for color in colors {
        counts.entry(color.map(|c| (c * 63.0).round() as u8)).or_insert((0, color)).0 += 1;
    }
    counts.into_values().max_by_key(|(count, _)| *count).map(|(_, color)| color)
}
