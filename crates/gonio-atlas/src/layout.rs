//! A picture of an atlas: each chart in a colour of its own, with its triangles and its outline.

use crate::raster::for_each_texel;
use crate::unwrap::AtlasUv;
use gonio_image::EncodedPicture;

/// Samples along a side of a pixel.
const SAMPLES: u32 = 2;

/// Above this number of triangles their edges would cover everything.
const MOST_EDGES: usize = 30_000;

const BACKGROUND: [f32; 3] = [24.0, 26.0, 31.0];

/// Pixels along a side of the largest picture of an atlas.
pub const LARGEST_LAYOUT: u32 = 4096;

/// Draws an atlas as a square of `size` pixels, at most [`LARGEST_LAYOUT`], sRGB, v up.
pub fn draw_layout(atlas: &AtlasUv, size: u32) -> EncodedPicture<u8> {
    let size = size.min(LARGEST_LAYOUT);
    let side = SAMPLES * size;
    let mut canvas = Canvas { side, colors: vec![BACKGROUND; side as usize * side as usize] };
    let triangles = atlas.tex_coords.as_chunks::<3>().0;
    let color = |t: usize| atlas.chart_of_triangle[t].map_or(BACKGROUND, chart_color);
    for (t, corners) in triangles.iter().enumerate() {
        for_each_texel(*corners, side, |x, y| canvas.set(x, y, color(t), 1.0));
    }
    if triangles.len() <= MOST_EDGES {
        for (t, corners) in triangles.iter().enumerate() {
            let ink = color(t).map(|c| 0.72 * c);
            (0..3).for_each(|k| canvas.line(corners[k], corners[(k + 1) % 3], ink));
        }
    }
    for (t, k) in border_edges(atlas) {
        canvas.line(triangles[t][k], triangles[t][(k + 1) % 3], color(t).map(|c| 0.35 * c + 165.0));
    }
    canvas.reduced(size)
}

/// Draws a checker of `squares` x `squares` squares as a square of `size` pixels, sRGB. Columns differ in hue and rows in
/// brightness, so that a place of a surface shows where in the texture it is.
pub fn draw_checker(size: u32, squares: u32) -> EncodedPicture<u8> {
    let square = |i: u32| u64::from(i) * u64::from(squares) / u64::from(size.max(1));
    let mut rgba = Vec::with_capacity(4 * size as usize * size as usize);
    for (y, x) in (0..size).flat_map(|y| (0..size).map(move |x| (y, x))) {
        let (column, row) = (square(x), square(y));
        let share = |i: u64| i as f32 / squares.max(1) as f32;
        let lightness = if (column + row) % 2 == 0 { 0.84 } else { 0.56 } - 0.12 * share(row);
        rgba.extend(oklab_color(lightness, std::f32::consts::TAU * share(column)).map(|c| (c + 0.5) as u8));
        rgba.push(255);
    }
    EncodedPicture { width: size, height: size, rgba }
}

/// A colour for a chart: hues turned by the golden angle, so that successive charts differ, in three brightnesses.
fn chart_color(chart: u32) -> [f32; 3] {
    let hue = (chart as f32 * 137.508).rem_euclid(360.0).to_radians();
    oklab_color([0.70, 0.62, 0.76][chart as usize % 3], hue)
}

/// OKLab (B. Ottosson, 2020) to sRGB, 0 to 255, at a chroma that sRGB has at all hues.
fn oklab_color(lightness: f32, hue: f32) -> [f32; 3] {
    let (a, b) = (0.105 * hue.cos(), 0.105 * hue.sin());
    let l = (lightness + 0.396_337_78 * a + 0.215_803_76 * b).powi(3);
    let m = (lightness - 0.105_561_346 * a - 0.063_854_17 * b).powi(3);
    let s = (lightness - 0.089_484_18 * a - 1.291_485_5 * b).powi(3);
    let linear = [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_4 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ];
    linear.map(|c| f32::from(gonio_image::srgb::ENCODER.encode(c.clamp(0.0, 1.0))))
}

/// The borders of the charts: edges that belong to one triangle only in the texture, as that triangle and the corner, 0 to 2, at
/// which its edge begins. Triangles without a chart have none.
pub fn border_edges(atlas: &AtlasUv) -> Vec<(usize, usize)> {
    let triangles = atlas.tex_coords.as_chunks::<3>().0.iter().enumerate();
    let mut edges: Vec<([[u32; 2]; 2], usize, usize)> = triangles
        .filter(|(t, _)| atlas.chart_of_triangle[*t].is_some())
        .flat_map(|(t, corners)| {
            (0..3).map(move |k| {
                let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|uv| uv.map(f32::to_bits));
                ([a.min(b), a.max(b)], t, k)
            })
        })
        .collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|edge| (edge[0].1, edge[0].2)).collect()
}

struct Canvas {
    side: u32,
    colors: Vec<[f32; 3]>,
}

impl Canvas {
    /// Mixes a colour into a sample, row 0 at the bottom.
    fn set(&mut self, x: u32, y: u32, color: [f32; 3], share: f32) {
        let index = (self.side - 1 - y) as usize * self.side as usize + x as usize;
        if let Some(old) = self.colors.get_mut(index) {
            for (old, new) in old.iter_mut().zip(color) {
                *old += share * (new - *old);
            }
        }
    }

    /// A line as wide as a sample, its edges smoothed.
    fn line(&mut self, from: [f32; 2], to: [f32; 2], color: [f32; 3]) {
        let side = self.side as f32;
        let [a, b] = [from, to].map(|uv| uv.map(|c| c * side - 0.5));
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil();
        if !steps.is_finite() || steps > 4.0 * side {
            return;
        }
        let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
        for step in 0..=steps as u32 {
            let share = if steps > 0.0 { step as f32 / steps } else { 0.0 };
            let at = [0, 1].map(|i| a[i] + share * (b[i] - a[i]));
            let (along, across) = if steep { (at[1].round(), at[0]) } else { (at[0].round(), at[1]) };
            for (offset, weight) in [(0.0, 1.0 - across.rem_euclid(1.0)), (1.0, across.rem_euclid(1.0))] {
                let line = across.floor() + offset;
                let (x, y) = if steep { (line, along) } else { (along, line) };
                if (0.0..side).contains(&x) && (0.0..side).contains(&y) {
                    self.set(x as u32, y as u32, color, weight);
                }
            }
        }
    }

    fn reduced(&self, size: u32) -> EncodedPicture<u8> {
        let mut rgba = Vec::with_capacity(4 * size as usize * size as usize);
        for (y, x) in (0..size).flat_map(|y| (0..size).map(move |x| (y, x))) {
            let mut sum = [0.0; 3];
            for (dy, dx) in (0..SAMPLES).flat_map(|dy| (0..SAMPLES).map(move |dx| (dy, dx))) {
                let index = (SAMPLES * y + dy) as usize * self.side as usize + (SAMPLES * x + dx) as usize;
                (0..3).for_each(|i| sum[i] += self.colors[index][i]);
            }
            rgba.extend(sum.map(|c| (c / (SAMPLES * SAMPLES) as f32 + 0.5) as u8));
            rgba.push(255);
        }
        EncodedPicture { width: size, height: size, rgba }
    }
}
