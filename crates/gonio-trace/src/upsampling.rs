//! Smooth spectra of RGB colours: reflectances in [0, 1] that look like the colour under daylight.
//!
//! A spectrum is `s(c0 x^2 + c1 x + c2)` with `s(t) = 1/2 + t / (2 sqrt(1 + t^2))` and `x` the wavelength from 0 (380 nm) to 1
//! (780 nm). The three coefficients are fitted to a colour by the Gauss-Newton method; a table of fits over the cube of
//! colours is interpolated for textures.
//!
//! *Source*: W. Jakob and J. Hanika, *A Low-Dimensional Function Space for Efficient Spectral Upsampling*, Computer Graphics
//! Forum 38(2), 2019.

use glam::{DMat3, DVec3, Vec3, Vec4};
use gonio_light::observer::{COLORIMETRY, LAMBDA_MAX, LAMBDA_MIN, SAMPLES, daylight, matching};
use std::sync::{LazyLock, OnceLock};

/// `c0, c1, c2` of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coefficients(pub Vec3);

impl Coefficients {
    /// The spectrum at four wavelengths, in nm. In `[0, 1]`.
    pub fn at(self, lambda: Vec4) -> Vec4 {
        let Vec3 { x: c0, y: c1, z: c2 } = self.0;
        let x = (lambda - LAMBDA_MIN as f32) * (1.0 / (LAMBDA_MAX - LAMBDA_MIN) as f32);
        let t = (c0 * x + c1) * x + c2;
        let root = (Vec4::ONE + t * t).map(f32::sqrt);
        (0.5 + 0.5 * t / root).clamp(Vec4::ZERO, Vec4::ONE)
    }

    /// The spectrum of a linear RGB colour; channels are held in `[0, 1]`, NaN counts as 0. Greys are exact.
    pub fn of(rgb: Vec3) -> Self {
        let rgb = rgb.max(Vec3::ZERO).min(Vec3::ONE);
        if rgb.x == rgb.y && rgb.y == rgb.z {
            return Coefficients(Vec3::new(0.0, 0.0, grey(rgb.x.into()) as f32));
        }
        TABLE.interpolate(rgb)
    }
}

/// The `t` with `s(t) = value`; 0 and 1 are met to f32's precision.
fn grey(value: f64) -> f64 {
    let value = value.clamp(1e-8, 1.0 - 1e-8);
    (value - 0.5) / (value * (1.0 - value)).sqrt()
}

/// Grid points along each axis of the table.
const RESOLUTION: usize = 24;

/// Fits over the cube of colours: for each channel that may be the largest, over its value and the other two relative to
/// it (Jakob and Hanika, section 4). A row has all values of one hue and saturation. It is fitted when it is first asked for:
/// all of them take longer than a first coarse picture may.
struct Table {
    /// `[largest][second][third]`.
    rows: Vec<OnceLock<[Vec3; RESOLUTION]>>,
}

static TABLE: LazyLock<Table> =
    LazyLock::new(|| Table { rows: (0..3 * RESOLUTION * RESOLUTION).map(|_| OnceLock::new()).collect() });

/// The value of the largest channel at grid point `k`: more points near 0 and 1, where coefficients change fast.
fn value_at(k: usize) -> f64 {
    let smoothstep = |x: f64| x * x * (3.0 - 2.0 * x);
    smoothstep(smoothstep(k as f64 / (RESOLUTION - 1) as f64))
}

impl Table {
    /// The coefficients at all grid points of the value.
    fn row(&self, largest: usize, second: usize, third: usize) -> &[Vec3; RESOLUTION] {
        self.rows[(largest * RESOLUTION + second) * RESOLUTION + third]
            .get_or_init(|| fit_along_value(largest, ratio_at(second), ratio_at(third)).map(|c| c.as_vec3()))
    }

    fn interpolate(&self, rgb: Vec3) -> Coefficients {
        let largest = rgb.max_position();
        let value = rgb[largest];
        if value <= 0.0 {
            return Coefficients(Vec3::new(0.0, 0.0, grey(0.0) as f32));
        }
        let scale = (RESOLUTION - 1) as f32;
        let ratio = |channel: usize| rgb[channel] / value * scale;
        let (y, x) = (ratio((largest + 1) % 3), ratio((largest + 2) % 3));
        let after = GRID.partition_point(|&g| g <= value).clamp(1, RESOLUTION - 1);
        let (low, high) = (GRID[after - 1], GRID[after]);
        let along = (value - low) / (high - low);
        let (yi, xi) = ((y as usize).min(RESOLUTION - 2), (x as usize).min(RESOLUTION - 2));
        let (fy, fx) = (y - yi as f32, x - xi as f32);
        let rows = [0, 1].map(|i| [0, 1].map(|j| self.row(largest, yi + i, xi + j)));
        let plane = |k: usize| {
            let row = |[left, right]: [&[Vec3; RESOLUTION]; 2]| left[k].lerp(right[k], fx);
            row(rows[0]).lerp(row(rows[1]), fy)
        };
        Coefficients(plane(after - 1).lerp(plane(after), along))
    }
}

/// [`value_at`] of every grid point.
static GRID: LazyLock<Vec<f32>> = LazyLock::new(|| (0..RESOLUTION).map(|k| value_at(k) as f32).collect());

fn ratio_at(i: usize) -> f64 {
    i as f64 / (RESOLUTION - 1) as f64
}

/// Fits of colours of the same hue and saturation, from a middle value to the darkest and to the brightest: each starts
/// where its neighbour ended.
fn fit_along_value(largest: usize, second: f64, third: f64) -> [DVec3; RESOLUTION] {
    let color = |k: usize| {
        let mut rgb = DVec3::ZERO;
        rgb[largest] = 1.0;
        rgb[(largest + 1) % 3] = second;
        rgb[(largest + 2) % 3] = third;
        // Coefficients of 0 and 1 are infinite.
        rgb * value_at(k).clamp(1e-4, 1.0 - 1e-4)
    };
    let mut fits = [DVec3::ZERO; RESOLUTION];
    let middle = RESOLUTION / 5;
    let mut c = DVec3::ZERO;
    let (darker, brighter) = fits.split_at_mut(middle);
    for (k, fitted) in brighter.iter_mut().enumerate() {
        c = fit(color(middle + k), c);
        *fitted = c;
    }
    c = brighter[0];
    for (k, fitted) in darker.iter_mut().enumerate().rev() {
        c = fit(color(k), c);
        *fitted = c;
    }
    fits
}

/// The light of each table wavelength in linear sRGB, under daylight; a spectrum of 1 gives (1, 1, 1).
static RESPONSE: LazyLock<Vec<(f64, DVec3)>> = LazyLock::new(|| {
    (0..SAMPLES)
        .map(|i| {
            let x = i as f64 / (SAMPLES - 1) as f64;
            let lambda = LAMBDA_MIN + (LAMBDA_MAX - LAMBDA_MIN) * x;
            let xyz = matching(lambda) * (daylight(lambda) * 5.0 / COLORIMETRY.y_integral);
            (x, COLORIMETRY.rgb_from_xyz * xyz)
        })
        .collect()
});

/// The colour of a spectrum, and its derivative by the coefficients (columns).
fn color_of(c: DVec3) -> (DVec3, DMat3) {
    let (mut rgb, mut derivative) = (DVec3::ZERO, DMat3::ZERO);
    for &(x, response) in RESPONSE.iter() {
        let t = (c.x * x + c.y) * x + c.z;
        let root = (1.0 + t * t).sqrt();
        rgb += response * (0.5 + 0.5 * t / root);
        let slope = response * (0.5 / (root * root * root));
        derivative.x_axis += slope * (x * x);
        derivative.y_axis += slope * x;
        derivative.z_axis += slope;
    }
    (rgb, derivative)
}

/// The coefficients of a colour by damped Gauss-Newton steps from `start`.
fn fit(target: DVec3, start: DVec3) -> DVec3 {
    const STEPS: usize = 40;
    let mut c = start;
    let (mut rgb, mut derivative) = color_of(c);
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let residual = target - rgb;
        if residual.abs().max_element() < 1e-7 {
            break;
        }
        let normal = derivative.transpose() * derivative;
        let step = (normal + DMat3::from_diagonal(DVec3::splat(damping) * (normal.to_cols_array()[0] + 1e-12)))
            .inverse()
            .mul_vec3(derivative.transpose() * residual);
        // Steeper spectra than this differ nowhere that matters.
        let next = (c + step).clamp(DVec3::splat(-2000.0), DVec3::splat(2000.0));
        let (next_rgb, next_derivative) = color_of(next);
        if next.is_finite() && (target - next_rgb).length_squared() < residual.length_squared() {
            (c, rgb, derivative) = (next, next_rgb, next_derivative);
            damping = (damping * 0.3).max(1e-12);
        } else {
            damping = (damping * 10.0).max(1e-9);
        }
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;

    fn color(spectrum: Coefficients) -> DVec3 {
        color_of(spectrum.0.as_dvec3()).0
    }

    #[test]
    fn colors_survive_the_way_through_their_spectrum() {
        let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
        for r in 0..=10 {
            for g in 0..=10 {
                for b in 0..=10 {
                    let rgb = Vec3::new(r as f32, g as f32, b as f32) / 10.0;
                    let error = (color(Coefficients::of(rgb)) - rgb.as_dvec3()).abs().max_element();
                    worst = worst.max(error);
                    sum += error;
                    count += 1.0;
                }
            }
        }
        // Set by interpolation in the table: 0.0056 at worst and 0.0015 in the mean, about a step of 8 bits and half of one.
        assert!(worst < 0.008 && sum / count < 0.002, "{worst} {}", sum / count);
    }

    #[test]
    fn greys_are_flat_and_exact() {
        for value in [0.0, 0.18, 0.5, 0.8, 1.0] {
            let spectrum = Coefficients::of(Vec3::splat(value));
            let at = spectrum.at(Vec4::new(390.0, 500.0, 600.0, 770.0));
            // Rounding in f32.
            assert!((at - value).abs().max_element() < 2e-7, "{value}: {at}");
        }
    }
}
