//! Two traced pictures compared with their noise in mind, and the ambient light that replaces best what was left out.
//!
//! Every picture is traced in two halves, with the random numbers of two seeds. The halves of a difference agree where it is one of
//! light, and do not where it is noise: `mean(d_1 d_2)` is the mean square of the difference without noise, and
//! `mean((d_1 - d_2)^2) / 4` that of the noise. All pictures use the same random numbers, so that most noise cancels in
//! differences; what is left is measured, not assumed.

use crate::staircase::TracedPicture;
use glam::DVec3;
use gonio_image::flip::{PIXELS_PER_DEGREE, flip, mean};
use gonio_light::color::{OutputTransform, luminance, srgb_decode};
use gonio_scene::{DisplayMap, Picture};
use serde::Serialize;

/// Edge of the squares whose means are compared, pixels.
const BLOCK: u32 = 8;

/// The difference of two pictures.
#[derive(Clone, Debug, Serialize)]
pub struct PictureComparison {
    /// Root of the mean square of all channels' differences, linear light, relative to the mean luminance of the truth, without
    /// the pixels in which a lamp brighter than white is seen ([`PictureMeasure`]).
    pub rms: f64,
    /// The part of it that noise explains, in the same unit.
    pub noise: f64,
    /// Whether nothing but noise is different, as far as the samples tell.
    pub below_noise: bool,
    /// Whether both pictures are the same, bit for bit.
    pub identical: bool,
    /// Mean FLIP of the whole pictures as displayed, 0 to 1.
    pub flip: f64,
    /// Mean luminance of the second picture relative to the first one's, less 1; none where the first is black.
    pub brighter: Option<f64>,
    /// Where the pictures differ most, if not by noise.
    pub most: Option<LargestDifference>,
    /// FLIP of each pixel, of the pictures that are shown: without noise, if there are such pictures.
    #[serde(skip)]
    pub map: Vec<f32>,
}

/// A small square of two pictures.
#[derive(Clone, Debug, Serialize)]
pub struct LargestDifference {
    /// Column of its middle.
    pub x: u32,
    /// Row of its middle.
    pub y: u32,
    /// Mean of the square in the first picture, linear RGB.
    pub before: DVec3,
    /// Mean of the square in the second one.
    pub after: DVec3,
}

/// A pixel's light.
pub fn light([r, g, b, _]: [f32; 4]) -> DVec3 {
    DVec3::new(r.into(), g.into(), b.into())
}

/// The light of the pixels as a screen shows it, over black: linear sRGB in `[0, 1]`.
pub fn displayed(picture: &Picture, output: OutputTransform) -> Vec<[f32; 3]> {
    let map = DisplayMap::Light(output);
    let shown = |&p: &[f32; 4]| {
        let [r, g, b, alpha] = map.apply(p);
        [r, g, b].map(|v| srgb_decode(v * alpha) as f32)
    };
    picture.pixels.iter().map(shown).collect()
}

/// FLIP of each pixel of two pictures of the same size.
pub fn flip_map(a: &Picture, b: &Picture, output: OutputTransform) -> Vec<f32> {
    flip(a.width as usize, &displayed(a, output), &displayed(b, output), PIXELS_PER_DEGREE)
}

/// How the pictures of one staircase are measured.
#[derive(Clone, Debug)]
pub struct PictureMeasure {
    /// How the pictures are displayed.
    pub output: OutputTransform,
    /// The pixels that count, in every number but FLIP. A lamp of a thousand times the brightness of everything else would be
    /// nearly the whole of each mean and each RMS, so pixels in which one is seen are left out.
    pub counted: Vec<bool>,
    /// The mean luminance of the truth, > 0: numbers are relative to it.
    pub unit: f64,
}

impl PictureMeasure {
    /// The pixels in which what emits light itself is not brighter than white count, except for those beside the others, which may show
    /// its edge; all, if that leaves none. `seen` is the picture of what emits light, and of the background.
    pub fn new(output: OutputTransform, seen: &Picture) -> Self {
        let white = (-output.exposure).exp2();
        let (width, height) = (seen.width as usize, seen.height as usize);
        let mut counted = vec![true; seen.pixels.len()];
        for lamp in (0..counted.len()).filter(|&i| luminance(light(seen.pixels[i])) > white) {
            let (x, y) = (lamp % width, lamp / width);
            for beside in y.saturating_sub(1)..(y + 2).min(height) {
                counted[beside * width + x.saturating_sub(1)..beside * width + (x + 2).min(width)].fill(false);
            }
        }
        if !counted.contains(&true) {
            counted.fill(true);
        }
        PictureMeasure { output, counted, unit: 1.0 }
    }

    /// The share of the pixels that do not count.
    pub fn left_out(&self) -> f64 {
        self.counted.iter().filter(|&&counts| !counts).count() as f64 / self.counted.len().max(1) as f64
    }

    /// The mean of a function of the pixels' indices.
    fn mean_of(&self, value: impl Fn(usize) -> f64) -> f64 {
        let (sum, count) = self.indices().fold((0.0, 0.0), |(sum, count), i| (sum + value(i), count + 1.0));
        sum / f64::max(count, 1.0)
    }

    fn indices(&self) -> impl Iterator<Item = usize> {
        self.counted.iter().enumerate().filter(|(_, counts)| **counts).map(|(index, _)| index)
    }

    /// The mean luminance of a picture.
    pub fn mean(&self, picture: &Picture) -> f64 {
        self.mean_of(|i| luminance(light(picture.pixels[i])))
    }

    /// The error of the mean of two pictures with independent noise: the root of the mean square of a pixel's luminance, in the
    /// unit.
    pub fn error(&self, halves: &[Picture; 2]) -> f64 {
        let [a, b] = halves;
        self.mean_of(|i| (0.5 * luminance(light(a.pixels[i]) - light(b.pixels[i]))).powi(2)).sqrt() / self.unit
    }

    /// The root of the mean square of all channels' differences, in the unit.
    pub fn rms(&self, a: &Picture, b: &Picture) -> f64 {
        self.mean_of(|i| (light(a.pixels[i]) - light(b.pixels[i])).length_squared() / 3.0).sqrt() / self.unit
    }

    /// Compares two traced pictures.
    pub fn compare(&self, before: &TracedPicture, after: &TracedPicture) -> PictureComparison {
        let halves = |traced: &TracedPicture| traced.halves.each_ref().map(|film| film.picture());
        let ([a1, a2], [b1, b2]) = (halves(before), halves(after));
        let difference =
            |i: usize| [light(b1.pixels[i]) - light(a1.pixels[i]), light(b2.pixels[i]) - light(a2.pixels[i])];
        let squares = self.mean_of(|i| {
            let [d1, d2] = difference(i);
            (0.5 * (d1 + d2)).length_squared() / 3.0
        });
        let noise = self.mean_of(|i| {
            let [d1, d2] = difference(i);
            0.25 * (d1 - d2).length_squared() / 3.0
        });
        let (mut agreement, mut block_noise, mut count) = (0.0, 0.0, 0.0);
        let mut most: Option<(f64, u32, u32, Vec<usize>)> = None;
        for (x, y, mut inside) in blocks(before.picture.width, before.picture.height) {
            inside.retain(|&i| self.counted[i]);
            if inside.is_empty() {
                continue;
            }
            let sum = inside.iter().map(|&i| difference(i)).fold([DVec3::ZERO; 2], |s, d| [s[0] + d[0], s[1] + d[1]]);
            let [d1, d2] = sum.map(|sum| sum / inside.len() as f64);
            let agrees = d1.dot(d2);
            agreement += agrees;
            block_noise += 0.25 * (d1 - d2).length_squared();
            count += 1.0;
            if agrees > most.as_ref().map_or(0.0, |m| m.0) {
                most = Some((agrees, x, y, inside));
            }
        }
        // Under noise alone the agreement of a square has the mean 0 and at most the standard deviation `2 block_noise`; four of them.
        let below_noise = agreement <= block_noise * 8.0 / f64::max(count, 1.0).sqrt();
        let map = flip_map(&before.picture, &after.picture, self.output);
        let (before_mean, after_mean) = (self.mean(&before.picture), self.mean(&after.picture));
        PictureComparison {
            rms: squares.sqrt() / self.unit,
            noise: noise.sqrt() / self.unit,
            below_noise,
            identical: before.picture == after.picture,
            flip: mean(&map),
            brighter: (before_mean > 0.0).then(|| after_mean / before_mean - 1.0),
            most: most.filter(|_| !below_noise).map(|(_, x, y, inside)| {
                let mean = |picture: &Picture| {
                    inside.iter().map(|&i| light(picture.pixels[i])).sum::<DVec3>() / inside.len() as f64
                };
                LargestDifference { x, y, before: mean(&before.picture), after: mean(&after.picture) }
            }),
            map,
        }
    }
}

/// The squares of a picture: the middle, and the indices of the pixels.
pub(crate) fn blocks(width: u32, height: u32) -> impl Iterator<Item = (u32, u32, Vec<usize>)> {
    let starts = |side: u32| (0..side).step_by(BLOCK as usize);
    starts(height).flat_map(move |top| {
        starts(width).map(move |left| {
            let (right, bottom) = ((left + BLOCK).min(width), (top + BLOCK).min(height));
            let inside = (top..bottom).flat_map(|y| (left..right).map(move |x| (y * width + x) as usize)).collect();
            ((left + right) / 2, (top + bottom) / 2, inside)
        })
    })
}

/// The constant ambient light that comes nearest to the truth.
#[derive(Clone, Debug, Serialize)]
pub struct AmbientFit {
    /// Linear RGB, >= 0.
    pub color: DVec3,
    /// The scene's own ambient light.
    pub own: DVec3,
    /// What remains of the difference to the truth on the objects, without ambient light: RMS relative to the mean luminance of
    /// the truth.
    pub rms_without: f64,
    /// The same with the scene's own.
    pub rms_own: f64,
    /// The same with the fitted one.
    pub rms_fitted: f64,
    /// The picture with the fitted one.
    #[serde(skip)]
    pub picture: Picture,
}

/// Fits `truth = base + k_a A` by least squares, each channel by itself: `A = sum k_a (truth - base) / sum k_a^2`, at least 0.
/// `coefficients` is the picture of `k_a`, 0 where there is no object; only pixels that count do. None where no material reflects ambient light.
pub fn fit_ambient(
    truth: &Picture,
    base: &Picture,
    coefficients: &Picture,
    own: DVec3,
    measure: &PictureMeasure,
) -> Option<AmbientFit> {
    let unit = measure.unit;
    let triples = || {
        let pixels = measure.indices().map(|i| [truth, base, coefficients].map(|picture| light(picture.pixels[i])));
        pixels.map(|[t, b, k]| (t - b, k)).filter(|(d, k)| *k != DVec3::ZERO && d.is_finite())
    };
    let (over, under) =
        triples().fold((DVec3::ZERO, DVec3::ZERO), |(over, under), (d, k)| (over + k * d, under + k * k));
    if under.max_element() <= 0.0 {
        return None;
    }
    let color = DVec3::select(under.cmpgt(DVec3::ZERO), over / under, DVec3::ZERO).max(DVec3::ZERO);
    let count = 3.0 * triples().count().max(1) as f64;
    let rms = |a: DVec3| (triples().map(|(d, k)| (d - k * a).length_squared()).sum::<f64>() / count).sqrt() / unit;
    let lit = |(&b, &k): (&[f32; 4], &[f32; 4])| (light(b) + light(k) * color).extend(b[3].into()).as_vec4().to_array();
    let pixels = base.pixels.iter().zip(&coefficients.pixels).map(lit).collect();
    Some(AmbientFit {
        color,
        own,
        rms_without: rms(DVec3::ZERO),
        rms_own: rms(own),
        rms_fitted: rms(color),
        picture: Picture { width: base.width, height: base.height, pixels },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts the pixels in which no lamp of this picture is brighter than white.
    fn measure(seen: &Picture) -> PictureMeasure {
        PictureMeasure::new(OutputTransform::default(), seen)
    }

    /// A row of pixels by index.
    fn picture(pixel: impl Fn(f32) -> [f32; 3]) -> Picture {
        let pixels = (0..60).map(|i| pixel(i as f32 / 60.0)).map(|[r, g, b]| [r, g, b, 1.0]).collect();
        Picture { width: 10, height: 6, pixels }
    }

    #[test]
    fn the_fitted_ambient_light_is_the_best_one() {
        let base = picture(|i| [0.1 + i, 0.2, 0.3 * i]);
        let k = picture(|i| [0.5 + 0.5 * i, 0.8, if i < 0.5 { 0.0 } else { 1.0 }]);
        let truth = picture(|i| [0.4 + i * i, 0.5 + 0.1 * (20.0 * i).sin(), 0.6]);
        let own = DVec3::splat(0.1);
        let rms = |a: DVec3| {
            let fitted = Picture {
                pixels: base
                    .pixels
                    .iter()
                    .zip(&k.pixels)
                    .map(|(&b, &k)| (light(b) + light(k) * a).extend(1.0).as_vec4().to_array())
                    .collect(),
                ..base.clone()
            };
            fitted.pixels.iter().zip(&truth.pixels).map(|(&a, &b)| (light(a) - light(b)).length_squared()).sum::<f64>()
        };
        let all = measure(&picture(|_| [0.0; 3]));
        let fit = fit_ambient(&truth, &base, &k, own, &all).expect("k_a is not 0");
        for change in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z] {
            assert!(rms(fit.color + 1e-3 * change) > rms(fit.color), "{change}");
        }
        assert!(fit.rms_fitted < fit.rms_own && fit.rms_own < fit.rms_without, "{fit:?}");
        let at = |i: usize| (light(fit.picture.pixels[i]), light(base.pixels[i]) + light(k.pixels[i]) * fit.color);
        assert!((0..60).all(|i| at(i).0.distance(at(i).1) < 1e-6));
    }

    #[test]
    fn ambient_light_is_never_negative_and_needs_a_material() {
        let (dark, bright) = (picture(|_| [0.1; 3]), picture(|_| [0.5, 0.05, 0.5]));
        let all = measure(&dark);
        let fit = fit_ambient(&dark, &bright, &picture(|_| [1.0; 3]), DVec3::ZERO, &all).expect("k_a is not 0");
        assert!(fit.color.x == 0.0 && (fit.color.y - 0.05).abs() < 1e-6, "{:?}", fit.color);
        assert!(fit_ambient(&dark, &bright, &picture(|_| [0.0; 3]), DVec3::ZERO, &all).is_none());
    }

    #[test]
    fn lamps_do_not_drown_the_light_of_surfaces() {
        // A lamp of radiance 1000 in 6 of 60 pixels, which has 8 neighbours.
        let is_lamp = |i: f32| i < 0.1;
        let seen = picture(|i| if is_lamp(i) { [1000.0; 3] } else { [0.0; 3] });
        let [a, b] = [0.2, 0.3].map(|v| picture(|i| if is_lamp(i) { [5000.0 * v; 3] } else { [v; 3] }));
        let measure = measure(&seen);
        assert_eq!(measure.left_out(), 14.0 / 60.0);
        for (measured, expected) in
            [(measure.mean(&a), 0.2), (measure.rms(&a, &b), 0.1), (measure.error(&[a.clone(), b.clone()]), 0.05)]
        {
            assert!((measured - expected).abs() < 1e-6, "{measured} instead of {expected}");
        }
        // The constant that makes up for 0.1, and no lamp.
        let fit = fit_ambient(&b, &a, &picture(|_| [0.5; 3]), DVec3::ZERO, &measure).expect("k_a is not 0");
        assert!((fit.color - 0.2).abs().max_element() < 1e-6 && fit.rms_fitted < 1e-6, "{fit:?}");
        // A screen that is no brighter than white counts, and so does everything where nothing else is left.
        assert_eq!(super::tests::measure(&picture(|_| [1.0; 3])).left_out(), 0.0);
        assert_eq!(super::tests::measure(&picture(|_| [2.0; 3])).left_out(), 0.0);
        let darker = OutputTransform { exposure: -2.0, ..OutputTransform::default() };
        let dim = picture(|i| [if is_lamp(i) { 5.0 } else { 3.0 }; 3]);
        assert_eq!(PictureMeasure::new(darker, &dim).left_out(), 14.0 / 60.0);
    }

    #[test]
    fn squares_cover_every_pixel_once() {
        for (width, height) in [(1, 1), (8, 8), (19, 9)] {
            let mut all: Vec<usize> = blocks(width, height).flat_map(|(_, _, inside)| inside).collect();
            all.sort_unstable();
            assert_eq!(all, (0..(width * height) as usize).collect::<Vec<_>>());
            assert!(blocks(width, height).all(|(x, y, _)| x < width.max(1) && y < height.max(1)));
        }
    }
}
