//! Equirectangular pictures.
//!
//! ```text
//! u = 1/2 + atan2(x, -z) / 2 pi      from the left edge to the right one
//! v = acos(y) / pi                   from the top edge to the bottom one
//! ```
//!
//! The centre column is the direction -Z, the right half turns towards +X, the top row is +Y.

use crate::{EnvironmentError, cubemap::mean};
use glam::DVec3;
use gonio_image::{Image, Pixel};
use gonio_threads::prelude::*;
use std::f64::consts::PI;

/// An equirectangular picture of the whole sphere. Its width need not be twice its height: 360 degrees then lie across
/// the width all the same, and 180 degrees along the height.
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// The picture; at least one pixel.
    pub image: Image,
}

impl Panorama {
    /// Creates a panorama from a picture.
    ///
    /// # Errors
    ///
    /// A picture without pixels.
    pub fn new(image: Image) -> Result<Self, EnvironmentError> {
        if image.width == 0 || image.height == 0 {
            return Err(EnvironmentError::new("a panorama needs at least one pixel"));
        }
        Ok(Panorama { image })
    }

    /// Creates a panorama from a function of the direction, evaluated at the middle of each pixel.
    pub fn from_function(width: u32, height: u32, radiance: impl Fn(DVec3) -> DVec3) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        let mut image = Image::new(width, height, [0.0; 4]);
        for y in 0..height {
            for x in 0..width {
                let u = (f64::from(x) + 0.5) / f64::from(width);
                let v = (f64::from(y) + 0.5) / f64::from(height);
                let [r, g, b] = radiance(direction(u, v)).to_array();
                image.pixels[y as usize * width as usize + x as usize] = [r as f32, g as f32, b as f32, 1.0];
            }
        }
        Panorama { image }
    }

    /// Returns the linear radiance from a direction, bilinear: across the +-180 degree meridian, and over the poles.
    pub fn sample(&self, direction: DVec3) -> DVec3 {
        let (u, v) = place(direction);
        let (width, height) = (i64::from(self.image.width), i64::from(self.image.height));
        let (x, y) = (u * width as f64 - 0.5, v * height as f64 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (right_share, lower_share) = (x - left, y - top);
        let texel = |dx: i64, dy: i64| self.texel(left as i64 + dx, top as i64 + dy);
        let upper = texel(0, 0).lerp(texel(1, 0), right_share);
        let lower = texel(0, 1).lerp(texel(1, 1), right_share);
        upper.lerp(lower, lower_share)
    }

    /// Returns the pixel in column `x` of row `y`. Columns wrap around, and rows beyond a pole continue in the same row
    /// half a turn further.
    pub fn texel(&self, x: i64, y: i64) -> DVec3 {
        let (x, y) = over_the_pole(x, y, i64::from(self.image.width), i64::from(self.image.height));
        color(self.image.at(x as u32, y as u32))
    }

    /// Turns back a panorama that was turned by 90 degrees. Of the two ways, it chooses the one with the brighter half
    /// above.
    pub fn turned_back(&self) -> Panorama {
        let (width, height) = (self.image.height, self.image.width);
        let turned = |clockwise: bool| {
            let mut image = Image::new(width, height, [0.0; 4]);
            for y in 0..height {
                for x in 0..width {
                    let from = if clockwise { (y, width - 1 - x) } else { (height - 1 - y, x) };
                    image.pixels[y as usize * width as usize + x as usize] = self.image.at(from.0, from.1);
                }
            }
            image
        };
        let half = (height / 2) as usize * width as usize;
        let brightness = |pixels: &[Pixel]| mean(pixels).map(|v| v.min(1.0)).element_sum();
        let image = turned(true);
        let upright = brightness(&image.pixels[..half]) >= brightness(&image.pixels[image.pixels.len() - half..]);
        Panorama { image: if upright { image } else { turned(false) } }
    }

    /// Returns the mean radiance over the sphere: rows are weighted by solid angle.
    pub fn mean_radiance(&self) -> DVec3 {
        let height = f64::from(self.image.height);
        let rows = (0..self.image.height).map(|y| {
            // The share of the sphere between two latitudes is half the difference of their sines.
            let edge = |y: f64| (PI * y / height).cos();
            let share = 0.5 * (edge(f64::from(y)) - edge(f64::from(y) + 1.0));
            share * mean(self.image.row(y))
        });
        rows.sum()
    }
}

/// Returns the texel at (`x`, `y`), which may be outside: columns wrap around, and rows beyond a pole continue in the
/// same row half a turn further. In [0, `width`) and [0, `height`).
pub(crate) fn over_the_pole(x: i64, y: i64, width: i64, height: i64) -> (i64, i64) {
    let (x, y) = match y {
        y if y < 0 => (x + width / 2, (-1 - y).min(height - 1)),
        y if y >= height => (x + width / 2, (2 * height - 1 - y).max(0)),
        y => (x, y),
    };
    (x.rem_euclid(width), y)
}

/// The number of texels of a crowded row that together are as wide as one is high.
pub const CROWDED: f64 = 2.0;

/// The first and the last rows of a panorama, those where texels crowd along the row by [`CROWDED`] or more, each
/// averaged along itself over as many texels as are together as wide as one is high. About a third of the picture.
pub(crate) fn reduced_rows(panorama: &Panorama) -> (Vec<Pixel>, Vec<Pixel>) {
    let (width, height) = (panorama.image.width as usize, panorama.image.height as usize);
    let aspect = width as f64 / (2.0 * height as f64);
    // How many texels, going along row y, are together as wide as one is high on the sphere.
    let crowd = |y: usize| aspect / (PI * (y as f64 + 0.5) / height as f64).sin();
    let crowded = (0..height / 2).take_while(|y| crowd(*y) >= CROWDED).count();
    let mut caps = [0..crowded, height - crowded..height].map(|rows| {
        let mut cap = vec![[0.0; 4]; rows.len() * width];
        cap.par_chunks_exact_mut(width).zip(rows).for_each(|(to, y)| {
            average_along(panorama.image.row(y as u32), crowd(y).min(width as f64), to);
        });
        cap
    });
    (std::mem::take(&mut caps[0]), std::mem::take(&mut caps[1]))
}

/// Each texel becomes the mean of `reach` texels about it, parts of texels included, going round.
fn average_along(from: &[Pixel], reach: f64, to: &mut [Pixel]) {
    let width = from.len();
    // Sums from the row's begin, in f64: differences of f32 sums would lose what is dark beside the sun.
    let mut sums = vec![[0.0; 4]; width + 1];
    for (x, texel) in from.iter().enumerate() {
        sums[x + 1] = std::array::from_fn(|c| sums[x][c] + f64::from(texel[c]));
    }
    let whole = sums[width];
    // The sum up to any place, before the begin and after the end too.
    let up_to = |x: f64| -> [f64; 4] {
        let rounds = (x / width as f64).floor();
        let x = x - rounds * width as f64;
        let (texel, part) = ((x as usize).min(width - 1), x.fract());
        std::array::from_fn(|c| rounds * whole[c] + sums[texel][c] + part * f64::from(from[texel][c]))
    };
    for (x, to) in to.iter_mut().enumerate() {
        let middle = x as f64 + 0.5;
        let (first, end) = (up_to(middle - 0.5 * reach), up_to(middle + 0.5 * reach));
        *to = std::array::from_fn(|c| ((end[c] - first[c]) / reach) as f32);
    }
}

/// Returns the unit direction of a position in the picture: `u` from 0 at the left edge to 1 at the right one, `v` from
/// 0 at the top edge to 1 at the bottom one.
pub fn direction(u: f64, v: f64) -> DVec3 {
    let (sin_lon, cos_lon) = ((u - 0.5) * 2.0 * PI).sin_cos();
    let (sin_polar, cos_polar) = (v * PI).sin_cos();
    DVec3::new(sin_polar * sin_lon, cos_polar, -sin_polar * cos_lon)
}

/// Returns the position (u, v) of a direction of any length, the inverse of [`direction`]; (0.5, 0.5) for length 0.
pub fn place(direction: DVec3) -> (f64, f64) {
    let across = direction.x.hypot(direction.z);
    if !(across > 0.0 || direction.y != 0.0) {
        return (0.5, 0.5);
    }
    // By two legs: acos(y) loses half of its digits near the poles.
    (0.5 + direction.x.atan2(-direction.z) / (2.0 * PI), across.atan2(direction.y) / PI)
}

/// Returns the radiance of a pixel.
pub(crate) fn color([r, g, b, _]: Pixel) -> DVec3 {
    DVec3::new(r.into(), g.into(), b.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_lies_as_defined() {
        let near = |d: DVec3, expected: DVec3| assert!(d.abs_diff_eq(expected, 1e-15), "{d} is not {expected}");
        near(direction(0.5, 0.5), DVec3::NEG_Z);
        near(direction(0.75, 0.5), DVec3::X);
        near(direction(0.25, 0.5), DVec3::NEG_X);
        near(direction(0.3, 0.0), DVec3::Y);
        near(direction(0.3, 1.0), DVec3::NEG_Y);
        for (u, v) in [(0.1, 0.2), (0.9, 0.7), (0.5, 0.5), (0.123, 1e-9)] {
            let (there_u, there_v) = place(7.0 * direction(u, v));
            // Rounding of pi and of two functions; near a pole only the place across it.
            assert!((there_u - u).abs() < 1e-12 && (there_v - v).abs() < 1e-15, "{u} {v}: {there_u} {there_v}");
        }
        assert_eq!(place(DVec3::ZERO), (0.5, 0.5));
    }

    #[test]
    fn lookups_go_round_and_over_the_poles() {
        // Radiance grows along x and z only by the direction: smooth everywhere, so a lookup anywhere is near it.
        let truth = |d: DVec3| DVec3::new(1.0 + d.x, 1.0 + d.y, 1.0 + d.z);
        let panorama = Panorama::from_function(64, 32, truth);
        for d in
            [DVec3::Z, DVec3::new(1e-3, 0.0, 1.0), DVec3::new(-1e-3, 0.1, 1.0), DVec3::Y, DVec3::new(0.02, -1.0, 0.01)]
        {
            let d = d.normalize();
            let got = panorama.sample(d);
            // A step of the grid is 0.1 rad: bilinear interpolation of sines errs by step^2 / 8 along each axis.
            assert!(got.abs_diff_eq(truth(d), 3e-3), "{d}: {got} is not {}", truth(d));
        }
        assert!(panorama.mean_radiance().abs_diff_eq(DVec3::ONE, 1e-6), "{}", panorama.mean_radiance());
    }
}
