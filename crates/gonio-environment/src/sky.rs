//! A clear sky with its sun, over plain ground.
//!
//! | parameter | is | default | range |
//! |---|---|---|---|
//! | `turbidity` | haze: 2 is very clear, 10 is hazy | 2.5 | `[2, 10]`, others are held there |
//! | `sun` | direction to the sun in the world, any length | 40 degrees high, 130 degrees to the right of straight ahead (-Z) | at least 2 degrees above the horizon, lower ones are raised |
//!
//! The unit of radiance is 36,000 cd/m^2 (of white): what is white and faces the default sun then has a radiance of about
//! 1.1, and pictures need no exposure.
//!
//! *Source*: A. J. Preetham, P. Shirley, B. Smits, *A Practical Analytic Model for Daylight*, SIGGRAPH 1999: luminance and
//! chromaticity of the sky, appendix A.2 (the function is R. Perez et al., 1993); the sun's light through the air after
//! Rayleigh and through haze, appendix A.1, of its five terms those two, at three wavelengths.
//! *Departures*: the disc's radiance is held at [`SUN_MAX`], which half precision can store: the default sun is below
//! that, a higher one in clearer air need not be. Below the horizon lies even ground of dry grass, lit by the sky and the sun (all of
//! its light) and seen through the haze of the way to it ([`HALF_VEILED_RAD`]). *Limits*: no clouds, no night; the model is too bright near a low sun.

use crate::Cubemap;
use crate::cubemap::{solid_angle, texel_direction};
use crate::face::Face;
use glam::{DMat3, DVec3};
use gonio_light::vector::unit_or;
use gonio_threads::prelude::*;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

/// The largest radiance of the sun's disc, in any channel: a little less than the largest half-precision number, 65504.
pub const SUN_MAX: f64 = 60_000.0;

/// Half of the angle under which the sun is seen, 0.53 degrees.
pub const SUN_RADIUS_RAD: f64 = 0.265 * PI / 180.0;

/// One unit of radiance in kcd/m^2, the unit of Preetham's formulas.
const UNIT_KCD: f64 = 36.0;

/// The sun's illuminance above the air, in units of radiance times steradian: 128 klux.
const SUN_ILLUMINANCE: f64 = 128.0 / UNIT_KCD;

/// Albedo of the ground, linear RGB: between the 0.1 of dark soil and the 0.2 of grass.
const GROUND_ALBEDO: DVec3 = DVec3::new(0.14, 0.125, 0.08);

/// The angle below the horizon at which the haze hides half of the ground: as on a hill of 100 m where one sees 30 km
/// far (contrast 2 %, H. Koschmieder, 1924: extinction 3.91 / 30 km, half after 5.3 km).
pub const HALF_VEILED_RAD: f64 = 1.08 * PI / 180.0;

/// A clear sky, by the position of its sun and its haze.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Direction to the sun in the world, of any length.
    pub sun: DVec3,
    /// Haze, from 2 to 10.
    pub turbidity: f64,
}

impl Default for Sky {
    /// A clear late morning, with the sun behind the right shoulder of a viewer who looks along -Z.
    fn default() -> Self {
        let ((sin_up, cos_up), (sin_right, cos_right)) =
            (40_f64.to_radians().sin_cos(), 130_f64.to_radians().sin_cos());
        Sky { sun: DVec3::new(cos_up * sin_right, sin_up, -cos_up * cos_right), turbidity: 2.5 }
    }
}

/// The factors of the formulas that do not depend on the direction.
struct Model {
    /// Clamped to its range.
    turbidity: f64,
    to_sun: DVec3,
    /// Luminance (kcd/m^2), x and y of the zenith, over the distribution's value there.
    zenith: DVec3,
    /// `A` to `E` of the distribution (eq. 3), each for luminance, x and y.
    distribution: [DVec3; 5],
}

impl Model {
    fn new(sky: &Sky) -> Self {
        let turbidity = if sky.turbidity > 2.0 { sky.turbidity.min(10.0) } else { 2.0 };
        let t = turbidity;
        let to_sun = unit_or(sky.sun, Sky::default().sun);
        // Not below two degrees, in the same compass direction.
        let lowest = 2_f64.to_radians().sin();
        let flat = DVec3::new(to_sun.x, 0.0, to_sun.z).normalize_or(DVec3::X);
        let to_sun = if to_sun.y < lowest { flat * (1.0 - lowest * lowest).sqrt() + lowest * DVec3::Y } else { to_sun };
        let theta = to_sun.y.acos();
        let powers = DVec3::new(theta.powi(3), theta.powi(2), theta);
        let cubic = |abc: [f64; 3], d: f64| DVec3::from(abc).dot(powers) + d;
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
        let zenith = DVec3::new(
            (4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192,
            t * t * cubic([0.00166, -0.00375, 0.00209], 0.0)
                + t * cubic([-0.02903, 0.06377, -0.03202], 0.00394)
                + cubic([0.11693, -0.21196, 0.06052], 0.25886),
            t * t * cubic([0.00275, -0.00610, 0.00317], 0.0)
                + t * cubic([-0.04214, 0.08970, -0.04153], 0.00516)
                + cubic([0.15346, -0.26756, 0.06670], 0.26688),
        );
        let distribution = [
            t * DVec3::new(0.1787, -0.0193, -0.0167) + DVec3::new(-1.4630, -0.2592, -0.2608),
            t * DVec3::new(-0.3554, -0.0665, -0.0950) + DVec3::new(0.4275, 0.0008, 0.0092),
            t * DVec3::new(-0.0227, -0.0004, -0.0079) + DVec3::new(5.3251, 0.2125, 0.2102),
            t * DVec3::new(0.1206, -0.0641, -0.0441) + DVec3::new(-2.5771, -0.8989, -1.6537),
            t * DVec3::new(-0.0670, -0.0033, -0.0109) + DVec3::new(0.3703, 0.0452, 0.0529),
        ];
        let mut model = Model { turbidity, to_sun, zenith, distribution };
        model.zenith /= model.perez(1.0, theta);
        model
    }

    /// Eq. 3: `(1 + A e^(B / cos theta)) (1 + C e^(D gamma) + E cos^2 gamma)`.
    fn perez(&self, cos_theta: f64, gamma: f64) -> DVec3 {
        let [a, b, c, d, e] = self.distribution;
        (1.0 + a * (b / cos_theta).exp()) * (1.0 + c * (d * gamma).exp() + e * gamma.cos().powi(2))
    }

    /// Returns the radiance from a unit direction without the sun, linear RGB; below the horizon that at the horizon.
    fn radiance(&self, direction: DVec3) -> DVec3 {
        // The formula's quotient at the horizon itself is infinite, its value there is not.
        let cos_theta = direction.y.max(1e-3);
        let gamma = direction.angle_between(self.to_sun);
        let [luminance, x, y] = (self.zenith * self.perez(cos_theta, gamma)).to_array();
        let y_unit = (luminance / UNIT_KCD).max(0.0);
        rgb_from_xyz(y_unit * DVec3::new(x / y, 1.0, (1.0 - x - y) / y)).max(DVec3::ZERO)
    }

    /// Returns the radiance of the sun's disc through the air, linear RGB.
    fn sun_radiance(&self) -> DVec3 {
        let theta = self.to_sun.y.acos();
        // Relative optical mass (F. Kasten and A. T. Young, as Preetham's appendix has it).
        let mass = 1.0 / (theta.cos() + 0.15 * (93.885 - theta.to_degrees()).powf(-1.253));
        let beta = 0.04608 * self.turbidity - 0.04586;
        // Micrometres that stand for red, green and blue.
        let through = |wavelength: f64| {
            (-0.008735 * wavelength.powf(-4.08) * mass).exp() * (-beta * wavelength.powf(-1.3) * mass).exp()
        };
        let disc = 2.0 * PI * (1.0 - SUN_RADIUS_RAD.cos());
        DVec3::new(through(0.610), through(0.550), through(0.465)) * SUN_ILLUMINANCE / disc
    }
}

/// From CIE XYZ to linear RGB with the sRGB primaries and white point D65 (IEC 61966-2-1).
fn rgb_from_xyz(xyz: DVec3) -> DVec3 {
    const RGB_FROM_XYZ: DMat3 = DMat3::from_cols(
        DVec3::new(3.2406, -0.9689, 0.0557),
        DVec3::new(-1.5372, 1.8758, -0.2040),
        DVec3::new(-0.4986, 0.0415, 1.0570),
    );
    RGB_FROM_XYZ * xyz
}

impl Sky {
    /// Renders the sky as a cubemap of `size` texels an edge (0 counts as 1). The sun's disc is antialiased and keeps
    /// all of its light at any size.
    pub fn cubemap(&self, size: u32) -> Cubemap {
        let model = Model::new(self);
        let sun = model.sun_radiance();
        let ground = GROUND_ALBEDO * FRAC_1_PI * Self::light_on_the_ground(&model, sun);
        let mut map = Cubemap::new(size, [0.0; 4]);
        let (size, width) = (map.size(), map.size() as usize);
        map.pixels_mut().par_chunks_exact_mut(width).enumerate().for_each(|(index, row)| {
            let (face, y) = (Face::ALL[index / width], (index % width) as u32);
            for (x, pixel) in row.iter_mut().enumerate() {
                let direction = texel_direction(face, x as u32, y, size).normalize();
                *pixel = opaque(ground.lerp(model.radiance(direction), haze(direction.y, size)));
            }
        });
        add_sun(&mut map, model.to_sun, sun * (SUN_MAX / sun.max_element()).min(1.0));
        map
    }

    /// Returns the irradiance of sky and sun on level ground.
    fn light_on_the_ground(model: &Model, sun: DVec3) -> DVec3 {
        let disc = PI * SUN_RADIUS_RAD.sin().powi(2);
        let mut sum = disc * model.to_sun.y * sun;
        // Midpoint rule over squared sines of the height: of each ring as much light falls on the ground.
        let (rings, sectors) = (16, 32);
        for i in 0..rings {
            let up = ((f64::from(i) + 0.5) / f64::from(rings)).sqrt();
            for j in 0..sectors {
                let (sin, cos) = (2.0 * PI * (f64::from(j) + 0.5) / f64::from(sectors)).sin_cos();
                let across = (1.0 - up * up).sqrt();
                sum += PI / f64::from(rings * sectors) * model.radiance(DVec3::new(across * cos, up, across * sin));
            }
        }
        sum
    }
}

/// Returns the share of a direction that haze hides: all of it above the horizon (where the sky itself is that haze),
/// nothing straight below. `y` is the direction's height; in a cubemap of this size no step is finer than a texel.
fn haze(y: f64, size: u32) -> f64 {
    if y >= 0.0 {
        return 1.0;
    }
    // The way to the ground, in heights of the eye above it, is 1 / -y.
    let half = HALF_VEILED_RAD.sin().max(1.0 / f64::from(size));
    1.0 - (-std::f64::consts::LN_2 * half * (1.0 / -y - 1.0)).exp()
}

/// Adds the sun's disc: to each texel by the share that it covers, and in all exactly as much light as the disc has.
fn add_sun(map: &mut Cubemap, to_sun: DVec3, radiance: DVec3) {
    let size = map.size();
    // Parts of a texel along an edge, so many that the disc holds some 20 of them across or more.
    let parts = (5_000 / size).clamp(8, 256);
    // How far from a texel's middle its corner may be.
    let reach = (SUN_RADIUS_RAD + 1.5 / f64::from(size)).min(FRAC_PI_2);
    let (cos_reach, cos_disc) = (reach.cos(), SUN_RADIUS_RAD.cos());
    let mut covered: Vec<(Face, u32, u32, f64)> = Vec::new();
    for face in Face::ALL {
        for y in 0..size {
            for x in 0..size {
                if texel_direction(face, x, y, size).normalize().dot(to_sun) < cos_reach {
                    continue;
                }
                let inside = |part: u32| {
                    let (px, py) = (x * parts + part % parts, y * parts + part / parts);
                    texel_direction(face, px, py, size * parts).normalize().dot(to_sun) > cos_disc
                };
                let count = (0..parts * parts).filter(|&part| inside(part)).count();
                if count > 0 {
                    covered.push((face, x, y, count as f64 / f64::from(parts * parts)));
                }
            }
        }
    }
    let total: f64 = covered.iter().map(|&(_, x, y, share)| share * solid_angle(x, y, size)).sum();
    let scale = 2.0 * PI * (1.0 - cos_disc) / total;
    for (face, x, y, share) in covered {
        let there = &mut map.face_mut(face)[(y * size + x) as usize];
        let behind = DVec3::new(there[0].into(), there[1].into(), there[2].into());
        // Counting parts errs by a few per cent; never beyond what half precision can store.
        *there = opaque((behind + share * scale * radiance).min(DVec3::splat(1.05 * SUN_MAX)));
    }
}

fn opaque(color: DVec3) -> [f32; 4] {
    [color.x as f32, color.y as f32, color.z as f32, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(c: DVec3) -> f64 {
        c.dot(DVec3::new(0.2126, 0.7152, 0.0722))
    }

    #[test]
    fn the_zenith_is_as_published() {
        // Sun overhead, turbidity 3: chi = (4/9 - 3/120) pi = 1.317723, tan = 3.868: Y = 7.1649 * 3.868 + 1.7727
        // kcd/m^2.
        let model = Model::new(&Sky { sun: DVec3::Y, turbidity: 3.0 });
        let got = luminance(model.radiance(DVec3::Y)) * UNIT_KCD;
        // Digits of the matrix, and of the numbers above.
        assert!((got - 29.486).abs() < 0.02, "{got}");
        // The same formula's x at the zenith: 3 * 0.00394 + 0.25886.
        assert!((model.zenith * model.perez(1.0, 0.0)).abs_diff_eq(DVec3::new(29.486, 0.27068, 0.28236), 0.01));
        // Equation 3 at 60 degrees from the zenith and one radian from the sun, with the table's numbers for turbidity
        // 3.
        assert!((model.perez(0.5, 1.0).x - 1.2037).abs() < 1e-4, "{}", model.perez(0.5, 1.0));
    }

    #[test]
    fn a_clear_sky_is_blue_bright_and_brightest_at_its_sun() {
        let sky = Sky::default();
        let model = Model::new(&sky);
        let mut sum = 0.0;
        for i in 0..1000 {
            let up = (f64::from(i) + 0.5) / 1000.0;
            let (sin, cos) = (2.399963 * f64::from(i)).sin_cos();
            let across = (1.0 - up * up).sqrt();
            sum += luminance(model.radiance(DVec3::new(across * cos, up, across * sin))) / 1000.0;
        }
        assert!((0.2..0.4).contains(&sum), "mean luminance {sum}");
        let zenith = model.radiance(DVec3::Y);
        assert!(zenith.z > 2.0 * zenith.x, "{zenith}");
        for sky in [sky, Sky { sun: DVec3::new(-1.0, 0.5, -2.0), turbidity: 6.0 }] {
            let map = sky.cubemap(64);
            let brightest = Face::ALL.into_iter().flat_map(|face| (0..64 * 64).map(move |i| (face, i % 64, i / 64)));
            let brightest = brightest.max_by(|a, b| map.at(a.0, a.1, a.2)[0].total_cmp(&map.at(b.0, b.1, b.2)[0]));
            let angle = brightest.map_or(9.0, |(face, x, y)| texel_direction(face, x, y, 64).angle_between(sky.sun));
            assert!(angle < 0.03, "{angle}");
        }
    }

    #[test]
    fn the_sun_keeps_its_light_at_every_size() {
        let sky = Sky::default();
        let model = Model::new(&sky);
        let sun = model.sun_radiance();
        // What the documentation says of it.
        assert!(sun.max_element() < SUN_MAX, "{sun}");
        let expected = sun * 2.0 * PI * (1.0 - SUN_RADIUS_RAD.cos());
        for size in [1, 16, 100, 512] {
            let mut map = Cubemap::new(size, [0.0; 4]);
            add_sun(&mut map, model.to_sun, sun);
            let got = map.mean_radiance() * 4.0 * PI;
            // Rounding to f32, and texels held below what half precision can store.
            assert!((got / expected - 1.0).abs().max_element() < 2e-3, "{size}: {got} is not {expected}");
        }
    }

    #[test]
    fn the_ground_sends_back_what_falls_on_it() {
        // A sun in haze is not held at its largest value, so that all of its light is in the cubemap.
        let sky = Sky { sun: DVec3::new(1.0, 0.6, 0.3), turbidity: 10.0 };
        let map = sky.cubemap(128);
        let mut falls = DVec3::ZERO;
        for face in Face::ALL {
            for y in 0..128 {
                for x in 0..128 {
                    let up = texel_direction(face, x, y, 128).normalize().y.max(0.0);
                    falls += up * solid_angle(x, y, 128) * crate::panorama::color(map.at(face, x, y));
                }
            }
        }
        assert!(Model::new(&sky).sun_radiance().max_element() < SUN_MAX);
        let (got, expected) = (map.sample(DVec3::NEG_Y), GROUND_ALBEDO / PI * falls);
        // Both integrals take a midpoint for its surroundings, of a sky steep about its sun.
        assert!((got / expected - 1.0).abs().max_element() < 0.02, "{got} is not {expected}");
    }

    #[test]
    fn haze_hides_the_far_ground_and_not_the_near_one() {
        assert_eq!([haze(0.3, 512), haze(0.0, 512), haze(-1.0, 512)], [1.0, 1.0, 0.0]);
        // Half at the documented depth, where the way is 53 times that straight down: off by 2 %.
        assert!((haze(-HALF_VEILED_RAD.sin(), 512) - 0.5).abs() < 0.01);
        let depths: Vec<f64> = (0..90).map(|i| haze(-f64::from(i).to_radians().sin(), 512)).collect();
        assert!(depths.windows(2).all(|w| w[0] > w[1]), "{depths:?}");
        // What is seen there: the sky at the horizon, and the ground's own colour.
        let map = Sky::default().cubemap(256);
        let at = |degrees: f64| map.sample(DVec3::new(0.0, degrees.to_radians().sin(), -degrees.to_radians().cos()));
        let (sky, edge, near) = (at(0.6), at(-0.3), at(-60.0));
        assert!(edge.abs_diff_eq(sky, 0.25 * sky.max_element()), "{edge} {sky}");
        assert!(luminance(near) < 0.5 * luminance(sky) && near.x > near.z, "{near} {sky}");
    }

    #[test]
    fn every_parameter_gives_a_sky() {
        for sun in [DVec3::ZERO, DVec3::NAN, DVec3::NEG_Y, DVec3::Y * 1e9, DVec3::new(1.0, -0.5, 0.0)] {
            for turbidity in [f64::NAN, -1.0, 2.0, 10.0, 1e9] {
                let map = Sky { sun, turbidity }.cubemap(8);
                let fine = map.pixels().iter().flatten().all(|v| v.is_finite() && (0.0..65504.0).contains(v));
                assert!(fine && luminance(map.sample(DVec3::new(0.3, 1.0, 0.2))) > 0.005, "{sun} {turbidity}");
            }
        }
    }
}
