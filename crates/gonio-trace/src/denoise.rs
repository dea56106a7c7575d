//! A picture without its noise: every pixel becomes a weighted fit of its neighbours.
//!
//! 1. The light is divided by the albedo, so that textures are no part of what is filtered.
//! 2. A neighbour counts where the squares around both pixels differ by no more than their noise (non-local means), and where
//!    normal, albedo and distance are alike.
//! 3. The value is that of a linear function of position, albedo, normal and distance, fitted to the neighbours: shading that
//!    changes across the window is kept.
//!
//! The samples are in two halves. Each half is filtered with the weights of the other: a pixel that is bright by chance does
//! not choose neighbours that are bright by chance, so the picture becomes neither darker nor brighter.
//!
//! The less noise, the fewer neighbours are alike: a picture without noise stays what it is.
//!
//! *Sources*: F. Rousselle, C. Knaus, M. Zwicker, *Adaptive Rendering with Non-Local Means Filtering*, SIGGRAPH Asia 2012, and
//! *Robust Denoising using Feature and Color Information*, Pacific Graphics 2013; B. Bitterli et al., *Nonlinearly
//! Weighted First-order Regression for Denoising Monte Carlo Renderings*, EGSR 2016.

use crate::features::Features;
use crate::film::{Film, PixelSums};
use glam::{DVec3, Vec3};
use gonio_light::color::luminance;
use gonio_scene::Picture;
use rayon::prelude::*;

/// Half edge of the window of neighbours, pixels.
const REACH: i32 = 8;
/// Half edge of the squares that are compared, pixels.
const PATCH: i32 = 2;
/// Rows that are filtered together.
const BAND: usize = 16;
/// Differences of this many standard deviations are seen as noise.
const DAMPING: f32 = 0.5;
/// Albedos below this are as good as black: what such a surface reflects is mostly gloss.
const SMALLEST_ALBEDO: f32 = 0.1;
/// How fast neighbours of other albedo, normal and distance lose weight: standard deviations.
const ALBEDO_WIDTH: f32 = 0.3;
const NORMAL_WIDTH: f32 = 0.3;
const DEPTH_WIDTH: f32 = 0.02;
/// Neighbours of less weight are left out.
const LEAST_WEIGHT: f32 = 1e-3;
/// Slopes of the fit are held back by this share of the weights, so that features that hardly vary have none.
const RIDGE: f64 = 3e-3;
/// Terms of the fit: constant, position, albedo, normal, distance.
const TERMS: usize = 8;
/// Half edge of the squares over which the noise of a channel is compared with that of the luminance, pixels.
const CHANNEL_REACH: usize = 5;

/// One half of the samples, divided by the albedo.
struct Half {
    value: Vec<Vec3>,
    /// Of the value.
    variance: Vec<Vec3>,
    /// Of the pixel's samples.
    share: Vec<f32>,
}

/// What tells the surfaces of two pixels apart.
struct Guides {
    /// Luminance of the albedo.
    albedo: Vec<f32>,
    normal: Vec<Vec3>,
    depth: Vec<f32>,
    /// The change of the depth from one pixel to the next.
    slope: Vec<f32>,
}

/// Sums of the weighted neighbours of a pixel in one half.
#[derive(Clone, Copy)]
struct Fit {
    matrix: [[f32; TERMS]; TERMS],
    right: [[f32; TERMS]; 3],
}

const NO_FIT: Fit = Fit { matrix: [[0.0; TERMS]; TERMS], right: [[0.0; TERMS]; 3] };

struct Denoiser {
    width: usize,
    height: usize,
    halves: [Half; 2],
    guides: Guides,
}

impl Film {
    /// The picture with most of its noise removed: linear, premultiplied, with the coverage of [`Film::picture`]. `features` has the
    /// film's size. Needs 16 samples in each pixel to tell noise from light well; pixels with fewer than two stay as they are.
    /// The result does not depend on the number of threads, and is finite.
    pub fn denoised(&self, features: &Features) -> Picture {
        let halves = |p: &PixelSums| {
            let whole = p.light / f64::from(p.samples.max(1));
            p.halves().unwrap_or([(whole, 1.0), (whole, 1.0)])
        };
        let noise = self.pixels.iter().map(|p| PixelNoise { halves: halves(p), variance: p.variance().0 }).collect();
        denoised(self.picture(), noise, features)
    }

    /// [`Film::denoised`] for two films of the same size with independent noise, such as those of two seeds: the mean of all their
    /// samples without most of its noise.
    pub fn denoised_together(films: &[Film; 2], features: &Features) -> Picture {
        let [mut picture, other] = films.each_ref().map(Film::picture);
        let mut noise = Vec::with_capacity(picture.pixels.len());
        for ((pixel, b), (p, q)) in
            picture.pixels.iter_mut().zip(&other.pixels).zip(films[0].pixels.iter().zip(&films[1].pixels))
        {
            let [n, m] = [p, q].map(|sums| f64::from(sums.samples.max(1)));
            let [first, second] = [n / (n + m), m / (n + m)];
            for (a, b) in pixel.iter_mut().zip(b) {
                *a = (f64::from(*a) * first + f64::from(*b) * second) as f32;
            }
            let variance = first * first * p.variance().0 + second * second * q.variance().0;
            noise.push(PixelNoise { halves: [(p.light / n, first), (q.light / m, second)], variance });
        }
        denoised(picture, noise, features)
    }
}

/// What is known about the noise of a pixel.
struct PixelNoise {
    /// Means of both halves of the samples, and their shares.
    halves: [(DVec3, f64); 2],
    /// Of the mean luminance.
    variance: f64,
}

/// Filters the picture whose pixels have this noise.
fn denoised(mut picture: Picture, noise: Vec<PixelNoise>, features: &Features) -> Picture {
    let count = noise.len();
    if count == 0
        || count != picture.pixels.len()
        || (features.width, features.height) != (picture.width, picture.height)
    {
        return picture;
    }
    let (width, height) = (picture.width as usize, picture.height as usize);
    let scale: Vec<Vec3> = features.albedo.iter().map(|&a| Vec3::from(a).max(Vec3::splat(SMALLEST_ALBEDO))).collect();
    let denoiser = Denoiser {
        width,
        height,
        halves: halves_without_albedo(&noise, &scale, width, height),
        guides: Guides::new(features),
    };
    let row = width;
    let before = denoiser.noisy_sum(&picture);
    picture.pixels.par_chunks_mut(row * BAND).enumerate().for_each(|(band, pixels)| {
        let filtered = denoiser.band(band * BAND, pixels.len() / row);
        for (i, (pixel, light)) in pixels.iter_mut().zip(filtered).enumerate() {
            let light = light * scale[band * BAND * row + i];
            // A fit may fall below 0 beside something bright.
            for (channel, new) in pixel.iter_mut().zip(light.to_array()) {
                let lowest = channel.min(0.0);
                *channel = if new.is_finite() { new.max(lowest) } else { *channel };
            }
        }
    });
    // What the fits lost or gained, together, goes back to the pixels that were filtered.
    let ratio = before / denoiser.noisy_sum(&picture);
    let ratio = [ratio.x, ratio.y, ratio.z].map(|r| if (0.8..1.25).contains(&r) { r as f32 } else { 1.0 });
    for (_, pixel) in picture.pixels.iter_mut().enumerate().filter(|(i, _)| denoiser.is_noisy(*i)) {
        pixel.iter_mut().zip(ratio).for_each(|(channel, ratio)| *channel *= ratio);
    }
    for channel in picture.pixels.iter_mut().flatten().filter(|channel| !channel.is_finite()) {
        *channel = 0.0;
    }
    picture
}

fn halves_without_albedo(noise: &[PixelNoise], scale: &[Vec3], width: usize, height: usize) -> [Half; 2] {
    let halves: Vec<[(DVec3, f64); 2]> = noise.iter().map(|pixel| pixel.halves).collect();
    // The film knows the noise of the luminance; the halves tell how much more or less each channel has.
    let difference = |[(a, _), (b, _)]: &[(DVec3, f64); 2]| {
        let d = *a - *b;
        (d * d).extend(luminance(d).powi(2)).as_vec4()
    };
    let squares: Vec<glam::Vec4> = halves.iter().map(difference).collect();
    let squares = blurred(&squares, width, height, CHANNEL_REACH);
    let variance: Vec<Vec3> = (0..noise.len())
        .into_par_iter()
        .map(|i| {
            let ratio = if squares[i].w > 0.0 { squares[i].truncate() / squares[i].w } else { Vec3::ONE };
            let variance = noise[i].variance as f32 * ratio / (scale[i] * scale[i]);
            if variance.is_finite() { variance } else { Vec3::splat(f32::MAX.sqrt()) }
        })
        .collect();
    // Few samples know their variance badly: neighbours help.
    let variance = blurred(&variance, width, height, 1);
    [0, 1].map(|k| Half {
        value: halves.iter().zip(scale).map(|(h, &scale)| h[k].0.as_vec3() / scale).collect(),
        variance: halves.iter().zip(&variance).map(|(h, &v)| v / h[k].1 as f32).collect(),
        share: halves.iter().map(|h| (h[k].1 / (h[0].1 + h[1].1)) as f32).collect(),
    })
}

/// The mean over the square of half edge `reach` around each pixel, as far as it lies in the picture.
fn blurred<T>(values: &[T], width: usize, height: usize, reach: usize) -> Vec<T>
where
    T: Copy + Send + Sync + Default + std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>,
{
    let along = |values: &[T], count: usize, step: usize, i: usize, at: usize| {
        let (from, to) = (at.saturating_sub(reach), (at + reach).min(count - 1));
        let sum = (from..=to).fold(T::default(), |sum, k| sum + values[i - at * step + k * step]);
        sum * (1.0 / (to - from + 1) as f32)
    };
    let rows: Vec<T> = (0..values.len()).into_par_iter().map(|i| along(values, width, 1, i, i % width)).collect();
    (0..values.len()).into_par_iter().map(|i| along(&rows, height, width, i, i / width)).collect()
}

impl Guides {
    fn new(features: &Features) -> Guides {
        let (width, height) = (features.width as usize, features.height as usize);
        let depth = &features.depth;
        let slope = |i: usize| {
            let (x, y) = (i % width, i / width);
            let to = |inside: bool, j: usize| if inside { (depth[j] - depth[i]).abs() } else { f32::INFINITY };
            // The smaller one of both sides: the other one may lie beyond an outline.
            let across = to(x > 0, i.wrapping_sub(1)).min(to(x + 1 < width, i + 1));
            let down = to(y > 0, i.wrapping_sub(width)).min(to(y + 1 < height, i + width));
            let finite = |v: f32| if v.is_finite() { v } else { 0.0 };
            finite(across) + finite(down)
        };
        Guides {
            albedo: features.albedo.iter().map(|&a| Vec3::from(a).dot(Vec3::new(0.2126, 0.7152, 0.0722))).collect(),
            normal: features.normal.iter().map(|&n| n.into()).collect(),
            depth: depth.clone(),
            slope: (0..depth.len()).map(slope).collect(),
        }
    }

    /// The logarithm of the weight of a neighbour at `distance` pixels, negated.
    fn difference(&self, p: usize, q: usize, distance: f32) -> f32 {
        let square = |v: f32| v * v;
        let albedo = square((self.albedo[p] - self.albedo[q]) / ALBEDO_WIDTH);
        let normal = self.normal[p].distance_squared(self.normal[q]) / square(NORMAL_WIDTH);
        let expected = self.slope[p].max(self.slope[q]) * distance + DEPTH_WIDTH * self.depth[p].min(self.depth[q]);
        let depth = square(self.depth[p] - self.depth[q]) / (square(expected) + f32::MIN_POSITIVE);
        0.5 * (albedo + normal + depth)
    }

    /// The terms of the fit at `q` for a pixel `p`: all 0 but the first where they are the same.
    fn terms(&self, p: usize, q: usize, dx: i32, dy: i32) -> [f32; TERMS] {
        let normal = self.normal[q] - self.normal[p];
        let reach = REACH as f32;
        let depth = (self.depth[q] - self.depth[p]) / (self.depth[p] + f32::MIN_POSITIVE);
        [
            1.0,
            dx as f32 / reach,
            dy as f32 / reach,
            self.albedo[q] - self.albedo[p],
            normal.x,
            normal.y,
            normal.z,
            depth.clamp(-1.0, 1.0),
        ]
    }
}

impl Denoiser {
    /// Whether the noise of a pixel exceeds rounding.
    fn is_noisy(&self, i: usize) -> bool {
        let Half { value, variance, .. } = &self.halves[0];
        variance[i].max_element() > 1e-8 * value[i].length_squared()
    }

    /// The light of all pixels with noise.
    fn noisy_sum(&self, picture: &Picture) -> DVec3 {
        let noisy = picture.pixels.iter().enumerate().filter(|(i, _)| self.is_noisy(*i));
        noisy.map(|(_, &[r, g, b, _])| Vec3::new(r, g, b).as_dvec3()).sum()
    }

    /// The filtered light of `rows` rows from `top`, without albedo.
    fn band(&self, top: usize, rows: usize) -> Vec<Vec3> {
        let mut fits = vec![[NO_FIT; 2]; rows * self.width];
        let mut distances = [Vec::new(), Vec::new()];
        for dy in -REACH..=REACH {
            for dx in -REACH..=REACH {
                for (half, distances) in self.halves.iter().zip(&mut distances) {
                    self.patch_distances(half, top, rows, dx, dy, distances);
                }
                self.add_neighbours(&mut fits, &distances, top, rows, dx, dy);
            }
        }
        let value = |(i, fits): (usize, &[Fit; 2])| {
            let [a, b] = [0, 1].map(|k| fits[k].value() * self.halves[k].share[top * self.width + i]);
            a + b
        };
        fits.iter().enumerate().map(value).collect()
    }

    /// Adds the neighbour at `(dx, dy)` of each pixel of the band.
    fn add_neighbours(
        &self,
        fits: &mut [[Fit; 2]],
        distances: &[Vec<f32>; 2],
        top: usize,
        rows: usize,
        dx: i32,
        dy: i32,
    ) {
        let apart = ((dx * dx + dy * dy) as f32).sqrt();
        let columns = (-dx).max(0) as usize..(self.width as i32 - dx.max(0)).max(0) as usize;
        for row in 0..rows {
            let y = top as i32 + row as i32 + dy;
            if y < 0 || y >= self.height as i32 {
                continue;
            }
            for x in columns.clone() {
                let p = (top + row) * self.width + x;
                let q = (p as isize + dy as isize * self.width as isize + dx as isize) as usize;
                let i = row * self.width + x;
                let nearest = distances[0][i].min(distances[1][i]);
                // Beyond this the weight is below the least one, whatever the features.
                if nearest > 7.0 {
                    continue;
                }
                let difference = self.guides.difference(p, q, apart);
                let terms = self.guides.terms(p, q, dx, dy);
                for k in 0..2 {
                    let weight = (-difference - distances[1 - k][i].max(0.0)).exp();
                    if weight > LEAST_WEIGHT {
                        fits[i][k].add(weight, &terms, self.halves[k].value[q]);
                    }
                }
            }
        }
    }

    /// How much the squares around each pixel and its neighbour differ, in units of their noise: below 0 where no more than
    /// by noise.
    fn patch_distances(&self, half: &Half, top: usize, rows: usize, dx: i32, dy: i32, result: &mut Vec<f32>) {
        let width = self.width;
        let patch = PATCH as usize;
        let (last_x, last_y) = (width as i32 - 1, self.height as i32 - 1);
        let tall = rows + 2 * patch;
        let mut single = vec![0.0_f32; width];
        let mut across = vec![0.0_f32; tall * width];
        for row in 0..tall {
            let y = (top as i32 + row as i32 - PATCH).clamp(0, last_y);
            let (at, other) = (y as usize * width, (y + dy).clamp(0, last_y) as usize * width);
            for (x, single) in single.iter_mut().enumerate() {
                let (p, q) = (at + x, other + (x as i32 + dx).clamp(0, last_x) as usize);
                let (vp, vq) = (half.variance[p], half.variance[q]);
                let d = half.value[p] - half.value[q];
                let least = (half.value[p] * half.value[p] + half.value[q] * half.value[q]) * 1e-9 + 1e-30;
                let term = (d * d - (vp + vp.min(vq))) / (least + DAMPING * DAMPING * (vp + vq));
                *single = term.element_sum() / 3.0;
            }
            let out = &mut across[row * width..(row + 1) * width];
            for (x, out) in out.iter_mut().enumerate() {
                *out = (x as i32 - PATCH..=x as i32 + PATCH).map(|x| single[x.clamp(0, last_x) as usize]).sum();
            }
        }
        result.clear();
        result.resize(rows * width, 0.0);
        let area = ((2 * PATCH + 1) * (2 * PATCH + 1)) as f32;
        for row in 0..rows {
            let out = &mut result[row * width..(row + 1) * width];
            for line in row..=row + 2 * patch {
                for (out, value) in out.iter_mut().zip(&across[line * width..(line + 1) * width]) {
                    *out += value / area;
                }
            }
        }
    }
}

impl Fit {
    fn add(&mut self, weight: f32, terms: &[f32; TERMS], value: Vec3) {
        let weighted = terms.map(|term| weight * term);
        for (row, &a) in self.matrix.iter_mut().zip(&weighted) {
            for (sum, &b) in row.iter_mut().zip(terms) {
                *sum += a * b;
            }
        }
        for (row, channel) in self.right.iter_mut().zip(value.to_array()) {
            for (sum, &a) in row.iter_mut().zip(&weighted) {
                *sum += a * channel;
            }
        }
    }

    /// The fitted value at the pixel itself; the weighted mean where there is no fit.
    fn value(&self) -> Vec3 {
        let total = f64::from(self.matrix[0][0]);
        let mut matrix = self.matrix.map(|row| row.map(f64::from));
        for (i, row) in matrix.iter_mut().enumerate().skip(1) {
            row[i] += RIDGE * total;
        }
        // The first row of the inverse: its product with a right side is the constant term. By elimination from the last term
        // to the first; the matrix is symmetric and positive.
        let mut right = self.right.map(|row| row.map(f64::from));
        for k in (1..TERMS).rev() {
            let pivot = matrix[k][k];
            let row = matrix[k];
            for i in 0..k {
                let factor = matrix[i][k] / pivot;
                for j in 0..k {
                    matrix[i][j] -= factor * row[j];
                }
                for channel in &mut right {
                    channel[i] -= factor * channel[k];
                }
            }
        }
        let pivot = matrix[0][0];
        let value = right.map(|channel| channel[0] / pivot);
        // Rounding may eat up a tiny pivot.
        let fitted = pivot > 1e-6 * total && value.iter().all(|v| v.is_finite());
        let mean = self.right.map(|channel| f64::from(channel[0]) / total);
        Vec3::from(if fitted { value } else { mean }.map(|v| v as f32))
    }
}
