//! What a lookup at the border of a chart reads: the chart, the background, or another chart.

use super::answer::Answer;
use super::colors::most_frequent;
use super::expected::{Encoded, Expected, NONE, difference};
use super::layout::UvLayout;
use super::picture::{Turn, texel};
use gonio_scene::Texture;
use std::collections::HashMap;

/// A texel shows the background if it is this near its colour, and the right one is farther from it.
const BACKGROUND: f32 = 0.05;
const OTHER: f32 = 0.15;
/// Most places that are looked up.
const MOST_PLACES: usize = 6000;

/// Mean shares of lookups along the borders of all charts, 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seams {
    /// The share of a lookup in the picture itself that is background.
    pub background: f64,
    /// The same in the level of a quarter of the size.
    pub background_of_quarter: f64,
    /// The share of a lookup that belongs to another chart with another colour, in the right picture.
    pub other_chart: f64,
}

/// A place on the border of a chart.
struct Place {
    uv: [f32; 2],
    triangle: u32,
    weight: f64,
}

impl Seams {
    /// Looks the picture up along all borders. `is_judged` leaves parts out, which were not baked.
    pub fn measure(
        answer: &Answer,
        layout: &UvLayout,
        expected: &Expected,
        texture: &Texture,
        turn: Turn,
        is_judged: &dyn Fn(u32) -> bool,
    ) -> Seams {
        let places = places(answer, layout, is_judged);
        let lookup = Lookup { expected, texture, turn, background: None };
        let background = lookup.find_background();
        let lookup = Lookup { background, ..lookup };
        let (mut seams, mut whole) = (Seams::default(), 0.0);
        for place in &places {
            seams.background += place.weight * lookup.share(place.uv, 1, &|x, y| lookup.is_background(x, y));
            seams.background_of_quarter += place.weight * lookup.share(place.uv, 4, &|x, y| lookup.is_background(x, y));
            let is_other = |x, y| lookup.is_other_chart(layout, place, x, y);
            seams.other_chart += place.weight * lookup.share(place.uv, 1, &is_other);
            whole += place.weight;
        }
        if whole > 0.0 {
            seams.background /= whole;
            seams.background_of_quarter /= whole;
            seams.other_chart /= whole;
        }
        seams
    }
}

/// Places along the edges of one triangle alone, at equal distances.
fn places(answer: &Answer, layout: &UvLayout, is_judged: &dyn Fn(u32) -> bool) -> Vec<Place> {
    let mut edges: HashMap<[[u32; 2]; 2], (usize, u32, usize)> = HashMap::new();
    for t in 0..answer.mesh.triangle_count() {
        let corners = layout.corners(t);
        if layout.chart[t].is_none() || !is_judged(t as u32) {
            continue;
        }
        for k in 0..3 {
            let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|uv| uv.map(f32::to_bits));
            edges.entry([a.min(b), a.max(b)]).or_insert((0, t as u32, k)).0 += 1;
        }
    }
    let single = edges.into_values().filter(|(count, ..)| *count == 1);
    let mut borders: Vec<([[f32; 2]; 2], u32)> = single
        .map(|(_, t, k)| {
            let corners = layout.corners(t as usize);
            ([corners[k], corners[(k + 1) % 3]], t)
        })
        .collect();
    borders.sort_by_key(|(ends, t)| (*t, ends[0].map(f32::to_bits)));
    let length = |ends: &[[f32; 2]; 2]| f64::from((ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]));
    let whole: f64 = borders.iter().map(|(ends, _)| length(ends)).sum();
    let step = (whole / MOST_PLACES as f64).max(1e-6);
    let mut places = Vec::new();
    for (ends, triangle) in borders {
        let length = length(&ends);
        let count = ((length / step) as usize).clamp(1, MOST_PLACES);
        for i in 0..count {
            let share = (i as f32 + 0.5) / count as f32;
            let uv = [0, 1].map(|k| ends[0][k] + share * (ends[1][k] - ends[0][k]));
            places.push(Place { uv, triangle, weight: length / count as f64 });
        }
    }
    places
}

struct Lookup<'a> {
    expected: &'a Expected,
    texture: &'a Texture,
    turn: Turn,
    background: Option<Encoded>,
}

impl Lookup<'_> {
    /// The index in the right picture of a texel of the picture, turned back.
    fn index(&self, x: u32, y: u32) -> usize {
        let side = u64::from(self.expected.side);
        let at = |c: u32, size: u32| (u64::from(c) * side / u64::from(size)) as usize;
        let (width, height) = self.turned_size();
        at(y, height) * side as usize + at(x, width)
    }

    fn turned_size(&self) -> (u32, u32) {
        let (width, height) = (self.texture.width, self.texture.height);
        if self.turn.transposed { (height, width) } else { (width, height) }
    }

    /// The stored colour that is shown at a texel once the picture is turned back.
    fn color(&self, x: u32, y: u32) -> Encoded {
        let (x, y) = if self.turn.transposed { (y, x) } else { (x, y) };
        let x = if self.turn.flip_u { self.texture.width - 1 - x } else { x };
        let y = if self.turn.flip_v { self.texture.height - 1 - y } else { y };
        texel(self.texture, x, y)
    }

    /// The most frequent colour of the texels that no triangle touches.
    fn find_background(&self) -> Option<Encoded> {
        let (width, height) = self.turned_size();
        let step = (width.max(height) / 512).max(1) as usize;
        let columns = || (0..width).step_by(step);
        let all = (0..height).step_by(step).flat_map(|y| columns().map(move |x| (x, y)));
        most_frequent(all.filter(|&(x, y)| !self.expected.is_touched[self.index(x, y)]).map(|(x, y)| self.color(x, y)))
    }

    fn is_background(&self, x: u32, y: u32) -> bool {
        let Some(background) = self.background else { return false };
        difference(self.color(x, y), background) < BACKGROUND
            && difference(self.expected.filled[self.index(x, y)], background) > OTHER
    }

    fn is_other_chart(&self, layout: &UvLayout, place: &Place, x: u32, y: u32) -> bool {
        let index = self.index(x, y);
        let triangle = self.expected.triangle[index];
        if triangle == NONE || layout.chart[triangle as usize] == layout.chart[place.triangle as usize] {
            return false;
        }
        let own = self.own_color(layout, place);
        own.is_some_and(|own| difference(own, self.expected.filled[index]) > OTHER)
    }

    /// The right colour a little inside of the chart.
    fn own_color(&self, layout: &UvLayout, place: &Place) -> Option<Encoded> {
        let corners = layout.corners(place.triangle as usize);
        let middle = [0, 1].map(|k| corners.iter().map(|c| c[k]).sum::<f32>() / 3.0);
        let side = self.expected.side as f32;
        let toward = [0, 1].map(|k| middle[k] - place.uv[k]);
        let length = toward[0].hypot(toward[1]).max(1e-9);
        let inside = (1.5 / side).min(length);
        let texel =
            [0, 1].map(|k| ((place.uv[k] + toward[k] / length * inside) * side).clamp(0.0, side - 1.0) as usize);
        let index = texel[1] * self.expected.side as usize + texel[0];
        self.expected.is_touched[index].then(|| self.expected.filled[index])
    }

    /// The share of a bilinear lookup in the level whose texels are means of `block` x `block` texels.
    fn share(&self, uv: [f32; 2], block: u32, counts: &dyn Fn(u32, u32) -> bool) -> f64 {
        let (width, height) = self.turned_size();
        let axis = |c: f32, size: u32| {
            let levels = (size / block).max(1);
            let at = (f64::from(c.clamp(0.0, 1.0)) * f64::from(levels) - 0.5).clamp(0.0, f64::from(levels - 1));
            let low = at.floor();
            let high = (low as u32 + 1).min(levels - 1);
            [(low as u32, 1.0 - (at - low)), (high, at - low)]
        };
        let mut sum = 0.0;
        for (row, of_row) in axis(uv[1], height) {
            for (column, of_column) in axis(uv[0], width) {
                let weight = of_row * of_column;
                if weight == 0.0 {
                    continue;
                }
                let texels = (0..block * block).map(|i| (column * block + i % block, row * block + i / block));
                let counted = texels.filter(|&(x, y)| counts(x.min(width - 1), y.min(height - 1))).count();
                sum += weight * counted as f64 / f64::from(block * block);
            }
        }
        sum
    }
}
