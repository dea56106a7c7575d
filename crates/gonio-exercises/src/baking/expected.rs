//! The right picture for the student's own layout.

use super::answer::Answer;
use super::layout::UvLayout;
use super::matching::Matching;
use super::original::{Original, weighted};
use glam::{DVec2, DVec3};
use gonio_atlas::raster::for_each_texel;
use gonio_bake::texels::{Border, TexelSample, bake_texels};
use gonio_light::color::srgb_encode;

/// No triangle.
pub const NONE: u32 = u32::MAX;
/// Two colours of one texel are in conflict if a channel differs by more, encoded.
const CONFLICT: f32 = 0.08;
/// A part with fewer texels whose neighbours belong to it is judged by all of its texels.
const FEW: usize = 30;

/// A colour, sRGB-encoded, 0 to 1 in each channel.
pub type Encoded = [f32; 3];

/// The largest difference of a channel.
pub fn difference(a: Encoded, b: Encoded) -> f32 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max)
}

/// A texel that is judged, and the part of the original on it.
#[derive(Clone, Copy, Debug)]
pub struct JudgedTexel {
    /// Its index.
    pub index: u32,
    /// The part.
    pub part: u16,
}

/// The right picture, `side` x `side`, first row at the **bottom**.
pub struct Expected {
    /// Texels along a side.
    pub side: u32,
    /// The colour of each texel; texels beside a chart have that of the nearest one.
    pub filled: Vec<Encoded>,
    /// The least and the greatest colour in the 3 x 3 texels around each.
    pub range: Vec<[Encoded; 2]>,
    /// The triangle of the answer on each texel's centre, or [`NONE`].
    pub triangle: Vec<u32>,
    /// Whether a triangle touches the texel.
    pub is_touched: Vec<bool>,
    /// Texels by which colours are judged: those around them belong to the surface too, and no two parts of the surface want
    /// different colours on them.
    pub judged: Vec<JudgedTexel>,
    /// Texels on whose centres two triangles with different colours are.
    pub conflicts: usize,
    /// Texels on whose centres two triangles are.
    pub overlaps: usize,
    /// Texels on whose centre a triangle is.
    pub covered: usize,
    /// Two triangles of the answer that are in conflict.
    pub conflicting: Option<[u32; 2]>,
}

/// The sample at a point of the texture, in texels.
fn sample_at(triangle: usize, corners: [[f32; 2]; 3], side: u32, at: DVec2) -> TexelSample {
    let [a, b, c] = corners.map(|uv| DVec2::from(uv.map(f64::from)) * f64::from(side));
    let area = (b - a).perp_dot(c - a);
    let second = (at - a).perp_dot(c - a) / area;
    let third = (b - a).perp_dot(at - a) / area;
    let weights = DVec3::new(1.0 - second - third, second, third);
    TexelSample { triangle, weights, steps: [DVec3::ZERO; 2], seed: 0 }
}

fn encoded(linear: DVec3) -> Encoded {
    linear.to_array().map(|c| srgb_encode(c.clamp(0.0, 1.0)) as f32)
}

impl Expected {
    /// Bakes the right picture for a layout.
    pub fn new(answer: &Answer, layout: &UvLayout, matching: &Matching, original: &Original, side: u32) -> Expected {
        Expected::of_quantity(answer, layout, matching, original, side, &|sample| original.diffuse(sample))
    }

    /// Bakes a quantity of the original, linear.
    pub fn of_quantity(
        answer: &Answer,
        layout: &UvLayout,
        matching: &Matching,
        original: &Original,
        side: u32,
        quantity: &(dyn Fn(&TexelSample) -> DVec3 + Sync),
    ) -> Expected {
        let count = side as usize * side as usize;
        let value = |sample: &TexelSample| {
            matching.original_sample(&original.surface.mesh, &answer.mesh, sample).map(|sample| quantity(&sample))
        };
        let mut triangle = vec![NONE; count];
        let mut point: Vec<Option<Encoded>> = vec![None; count];
        let mut state = vec![TexelState::Free; count];
        let mut conflicting = None;
        for t in 0..layout.chart.len() {
            let corners = layout.corners(t);
            for_each_texel(corners, side, |x, y| {
                let index = y as usize * side as usize + x as usize;
                let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let color = value(&sample_at(t, corners, side, at)).map(encoded);
                if state[index] == TexelState::Free {
                    state[index] = if color.is_some() { TexelState::Covered } else { TexelState::Unknown };
                    (triangle[index], point[index]) = (t as u32, color);
                } else if let (Some(a), Some(b)) = (point[index], color)
                    && difference(a, b) > CONFLICT
                {
                    state[index] = TexelState::Conflict;
                    conflicting.get_or_insert([triangle[index], t as u32]);
                } else if state[index] == TexelState::Covered {
                    state[index] = TexelState::Overlap;
                }
            });
        }
        let known = |sample: &TexelSample| value(sample).map_or(glam::DVec4::ZERO, weighted);
        let baked = bake_texels(&layout.tex_coords, |_| true, side, 1, Border::Nearest, known, &|_| true);
        let (filled, is_touched) = match baked {
            Some(mut baked) => {
                for (value, touched) in baked.values.iter_mut().zip(&mut baked.covered) {
                    // Texels of triangles without a counterpart are a background too.
                    *touched &= value[3] > 0.0;
                    let weight = value[3].max(1e-6);
                    *value = value.map(|v| v / weight);
                }
                baked.fill_background();
                let color = |[r, g, b, _]: &[f32; 4]| encoded(DVec3::new((*r).into(), (*g).into(), (*b).into()));
                (baked.values.iter().map(color).collect(), baked.covered)
            }
            None => (vec![[0.0; 3]; count], vec![false; count]),
        };
        let is = |state: &&TexelState, wanted: &[TexelState]| wanted.contains(state);
        let count_of = |wanted: &[TexelState]| state.iter().filter(|state| is(state, wanted)).count();
        let overlaps = count_of(&[TexelState::Overlap, TexelState::Conflict]);
        let mut expected = Expected {
            side,
            range: ranges(side as usize, &filled, &point),
            filled,
            triangle,
            is_touched,
            judged: Vec::new(),
            conflicts: count_of(&[TexelState::Conflict]),
            overlaps,
            covered: count.saturating_sub(count_of(&[TexelState::Free])),
            conflicting,
        };
        expected.judged = expected.choose_judged(layout, &state, original.surface.mesh.parts.len());
        expected
    }

    fn choose_judged(&self, layout: &UvLayout, state: &[TexelState], parts: usize) -> Vec<JudgedTexel> {
        let side = self.side as usize;
        let is_good = |x: usize, y: usize| matches!(state[y * side + x], TexelState::Covered | TexelState::Overlap);
        let (mut inner, mut all) = (vec![Vec::new(); parts], vec![Vec::new(); parts]);
        for (index, &t) in self.triangle.iter().enumerate() {
            let (x, y) = (index % side, index / side);
            let Some(part) = layout.part.get(t as usize).copied().flatten() else { continue };
            if !is_good(x, y) {
                continue;
            }
            let texel = JudgedTexel { index: index as u32, part };
            all[usize::from(part)].push(texel);
            let around = |c: usize| c.saturating_sub(1)..=(c + 1).min(side - 1);
            if around(y).all(|y| around(x).all(|x| is_good(x, y))) {
                inner[usize::from(part)].push(texel);
            }
        }
        inner.into_iter().zip(all).flat_map(|(inner, all)| if inner.len() < FEW { all } else { inner }).collect()
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TexelState {
    /// No triangle.
    Free,
    /// One triangle.
    Covered,
    /// A triangle that is not in the original.
    Unknown,
    /// Several triangles that want the same colour.
    Overlap,
    /// Several triangles that want different colours.
    Conflict,
}

/// The least and the greatest of both pictures in the 3 x 3 texels around each texel.
fn ranges(side: usize, filled: &[Encoded], point: &[Option<Encoded>]) -> Vec<[Encoded; 2]> {
    let join = |a: [Encoded; 2], b: [Encoded; 2]| {
        let [mut low, mut high] = a;
        for k in 0..3 {
            low[k] = low[k].min(b[0][k]);
            high[k] = high[k].max(b[1][k]);
        }
        [low, high]
    };
    let own: Vec<[Encoded; 2]> = filled
        .iter()
        .zip(point)
        .map(|(&filled, point)| point.map_or([filled; 2], |point| join([filled; 2], [point; 2])))
        .collect();
    let pass = |values: &[[Encoded; 2]], step: usize, place: &dyn Fn(usize) -> usize| -> Vec<[Encoded; 2]> {
        (0..values.len())
            .map(|i| {
                let mut range = values[i];
                if place(i) > 0 {
                    range = join(range, values[i - step]);
                }
                if place(i) + 1 < side {
                    range = join(range, values[i + step]);
                }
                range
            })
            .collect()
    };
    let rows = pass(&own, 1, &|i| i % side);
    pass(&rows, side, &|i| i / side)
}
