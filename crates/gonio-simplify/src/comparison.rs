//! Two traced pictures compared with their noise in mind, and the ambient light that replaces best what was left out.
//!
//! Every picture is traced in two halves, with the random numbers of two seeds. The halves of a difference agree where it is one of
//! light, and do not where it is noise: `mean(d_1 d_2)` is the mean square of the difference without noise, and
//! `mean((d_1 - d_2)^2) / 4` that of the noise. All pictures use the same random numbers, so that most noise cancels in
//! differences; what is left is measured, not assumed.

use crate::staircase::TracedPicture;
use glam::DVec3;
use gonio_image::flip::{PIXELS_PER_DEGREE, flip, mean};
use gonio_light::color::{OutputTransform, srgb_decode};
use gonio_scene::{DisplayMap, Frame, Picture};
use serde::Serialize;

/// Edge of the squares whose means are compared, pixels.
const BLOCK: u32 = 8;

/// The difference of two pictures.
#[derive(Clone, Debug, Serialize)]
pub struct PictureComparison {
    /// Root of the mean square of all channels' differences, linear light, relative to the mean luminance of the truth.
    pub rms: f64,
    /// The part of it that noise explains, in the same unit.
    pub noise: f64,
    /// Whether nothing but noise is different, as far as the samples tell.
    pub below_noise: bool,
    /// Whether both pictures are the same, bit for bit.
    pub identical: bool,
    /// Mean FLIP of the pictures as displayed, 0 to 1.
    pub flip: f64,
    /// Mean luminance of the second picture relative to the first one's, less 1; none where the first is black.
    pub brighter: Option<f64>,
    /// Where the pictures differ most, if not by noise.
    pub most: Option<LargestDifference>,
    /// FLIP of each pixel.
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

/// Luminance of linear sRGB (IEC 61966-2-1).
pub fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// A pixel's light.
pub fn light([r, g, b, _]: [f32; 4]) -> DVec3 {
    DVec3::new(r.into(), g.into(), b.into())
}

/// The mean luminance of a picture.
pub fn mean_luminance(picture: &Picture) -> f64 {
    picture.pixels.iter().map(|&p| luminance(light(p))).sum::<f64>() / picture.pixels.len().max(1) as f64
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

/// Compares two stages; `unit` is the mean luminance of the truth.
pub fn compare(before: &TracedPicture, after: &TracedPicture, frame: &Frame, unit: f64) -> PictureComparison {
    let unit = if unit > 0.0 { unit } else { 1.0 };
    let halves = |traced: &TracedPicture| traced.halves.each_ref().map(|film| film.picture());
    let ([a1, a2], [b1, b2]) = (halves(before), halves(after));
    let difference = |i: usize| [light(b1.pixels[i]) - light(a1.pixels[i]), light(b2.pixels[i]) - light(a2.pixels[i])];
    let pixels = before.picture.pixels.len();
    let values = 3.0 * pixels.max(1) as f64;
    let (mut squares, mut noise) = (0.0, 0.0);
    for [d1, d2] in (0..pixels).map(difference) {
        squares += (0.5 * (d1 + d2)).length_squared();
        noise += 0.25 * (d1 - d2).length_squared();
    }
    let (mut agreement, mut block_noise, mut count) = (0.0, 0.0, 0.0);
    let mut most: Option<(f64, u32, u32, Vec<usize>)> = None;
    for (x, y, inside) in blocks(before.picture.width, before.picture.height) {
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
    let map = flip_map(&before.picture, &after.picture, frame.output);
    let (before_mean, after_mean) = (mean_luminance(&before.picture), mean_luminance(&after.picture));
    PictureComparison {
        rms: (squares / values).sqrt() / unit,
        noise: (noise / values).sqrt() / unit,
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
/// `coefficients` is the picture of `k_a`, 0 where there is no object. None where no material reflects ambient light.
pub fn fit_ambient(
    truth: &Picture,
    base: &Picture,
    coefficients: &Picture,
    own: DVec3,
    unit: f64,
) -> Option<AmbientFit> {
    let unit = if unit > 0.0 { unit } else { 1.0 };
    let triples = || {
        let pixels = truth.pixels.iter().zip(&base.pixels).zip(&coefficients.pixels);
        pixels.map(|((&t, &b), &k)| (light(t) - light(b), light(k))).filter(|(d, k)| *k != DVec3::ZERO && d.is_finite())
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
        let fit = fit_ambient(&truth, &base, &k, own, 1.0).expect("k_a is not 0");
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
        let fit = fit_ambient(&dark, &bright, &picture(|_| [1.0; 3]), DVec3::ZERO, 1.0).expect("k_a is not 0");
        assert!(fit.color.x == 0.0 && (fit.color.y - 0.05).abs() < 1e-6, "{:?}", fit.color);
        assert!(fit_ambient(&dark, &bright, &picture(|_| [0.0; 3]), DVec3::ZERO, 1.0).is_none());
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
