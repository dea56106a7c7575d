//! Conversions at every level of instructions that this CPU has: equal to the baseline bit by bit, and to look-ups in
//! f64.

use glam::{DMat3, DVec3};
use gonio_environment::convert::{Conversion, EnvironmentRef, Filter};
use gonio_environment::{Cubemap, Face, Panorama, SimdLevel, cubemap, panorama};
use gonio_image::Pixel;

/// Sizes that are no multiple of eight lanes: single texels, primes, one more and one less than a block of eight.
const PANORAMAS: &[(u32, u32)] = &[(1, 1), (2, 1), (1, 5), (7, 9), (31, 17), (64, 33)];
const CUBEMAPS: &[u32] = &[1, 2, 7, 13, 17];

fn turn() -> DMat3 {
    DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_z(1.1)
}

/// Texels without any order, from 0 to 1000, by G. Marsaglia's xorshift, 2003. Every `odd`-th number is NaN, infinite,
/// or too small for a normal f32.
fn noise(pixels: &mut [Pixel], odd: Option<usize>) {
    let mut state = 1_u32;
    for (i, value) in pixels.as_flattened_mut().iter_mut().enumerate() {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        *value = 1000.0 * (state as f32 / u32::MAX as f32);
        if odd.is_some_and(|odd| i % odd == 0) {
            *value = [f32::NAN, f32::INFINITY, 1e-40, f32::NEG_INFINITY][i % 4];
        }
    }
}

/// Bits, where every NaN is the same one: IEEE 754 leaves open which payload a sum has.
fn bits(pixels: &[Pixel]) -> Vec<u32> {
    pixels.as_flattened().iter().map(|v| if v.is_nan() { f32::NAN.to_bits() } else { v.to_bits() }).collect()
}

/// Both kinds of sources in all sizes, with noise.
fn for_each_source(odd: Option<usize>, mut test: impl FnMut(EnvironmentRef<'_>, &str)) {
    for &(width, height) in PANORAMAS {
        let mut pano = Panorama::from_function(width, height, |_| DVec3::ONE);
        noise(&mut pano.image.pixels, odd);
        test(EnvironmentRef::Panorama(&pano), &format!("panorama {width} x {height}"));
    }
    for &size in CUBEMAPS {
        let mut map = Cubemap::new(size, [1.0; 4]);
        noise(map.pixels_mut(), odd);
        test(EnvironmentRef::Cubemap(&map), &format!("cubemap {size}"));
    }
}

#[test]
fn every_level_gives_the_bits_of_the_baseline() {
    assert_eq!(SimdLevel::available().first(), Some(&SimdLevel::Baseline));
    assert_eq!(SimdLevel::available().last(), Some(&SimdLevel::detect()));
    for odd in [None, Some(5)] {
        for_each_source(odd, |from, name| {
            for &filter in Filter::ALL {
                for source_from_target in [DMat3::IDENTITY, turn()] {
                    let conversion = Conversion { filter: Some(filter), source_from_target };
                    for &level in SimdLevel::available() {
                        for size in [1, 3, 8, 19] {
                            let expected = conversion.cubemap_at(SimdLevel::Baseline, from, size);
                            let got = conversion.cubemap_at(level, from, size);
                            let same = bits(got.pixels()) == bits(expected.pixels());
                            assert!(same, "{name} to cubemap {size}, {filter}, {level:?}, {source_from_target}");
                        }
                        for (width, height) in [(1, 1), (5, 3), (23, 11)] {
                            let expected = conversion.panorama_at(SimdLevel::Baseline, from, width, height);
                            let got = conversion.panorama_at(level, from, width, height);
                            let same = bits(&got.image.pixels) == bits(&expected.image.pixels);
                            assert!(same, "{name} to panorama {width}, {filter}, {level:?}, {source_from_target}");
                        }
                    }
                }
            }
        });
    }
}

/// A difference from the look-up in f64, in units of what a place that is off by a hundred-thousandth of the source's
/// width changes between texels that differ by 1000: what f32 leaves of a place.
fn off(got: Pixel, from: EnvironmentRef<'_>, direction: DVec3) -> f64 {
    let expected = from.sample(direction);
    (DVec3::new(got[0].into(), got[1].into(), got[2].into()) - expected).abs().max_element() / 1000.0
}

#[test]
fn every_level_gives_the_look_ups_in_double_precision() {
    for_each_source(None, |from, name| {
        for &level in SimdLevel::available() {
            for source_from_target in [DMat3::IDENTITY, turn()] {
                let conversion = Conversion { filter: Some(Filter::Bilinear), source_from_target };
                let mut worst: f64 = 0.0;
                for size in [2, 5, 19] {
                    let made = conversion.cubemap_at(level, from, size);
                    for face in Face::ALL {
                        for (i, got) in made.face(face).iter().enumerate() {
                            let d = cubemap::texel_direction(face, i as u32 % size, i as u32 / size, size);
                            let d = source_from_target * d.normalize();
                            // A pole has no longitude to interpolate along.
                            if matches!(from, EnvironmentRef::Cubemap(_)) || d.x.hypot(d.z) > 1e-6 {
                                worst = worst.max(off(*got, from, d));
                            }
                        }
                    }
                }
                let made = conversion.panorama_at(level, from, 23, 11);
                for (i, got) in made.image.pixels.iter().enumerate() {
                    let (u, v) = ((i % 23) as f64 / 23.0 + 0.5 / 23.0, ((i / 23) as f64 + 0.5) / 11.0);
                    worst = worst.max(off(*got, from, source_from_target * panorama::direction(u, v)));
                }
                // A place is right to 64 * 3e-7 texels, more about a pole, where a texel is seen ever wider.
                assert!(worst < 1e-4, "{name}, {level:?}, {source_from_target}: {worst}");
            }
        }
    });
}

#[test]
fn a_texel_that_is_no_number_spoils_its_neighbourhood_alone() {
    let clean = Panorama::from_function(64, 32, |d| d + DVec3::splat(2.0));
    // Ahead, on the meridian behind, and at the poles.
    for (x, y) in [(32, 16), (0, 16), (63, 9), (20, 0), (20, 31)] {
        let mut spoilt = clean.clone();
        // At a pole a single texel is narrower than a pixel.
        let width = if [0, 31].contains(&y) { 16 } else { 1 };
        spoilt.image.pixels[y * 64 + x..][..width].fill([f32::NAN, f32::INFINITY, f32::NAN, 1.0]);
        let bad = panorama::direction((x as f64 + 0.5) / 64.0, (y as f64 + 0.5) / 32.0);
        for &level in SimdLevel::available() {
            for filter in [Filter::Nearest, Filter::Bilinear, Filter::Bicubic] {
                let conversion = Conversion { filter: Some(filter), ..Conversion::default() };
                let expected = conversion.cubemap_at(level, EnvironmentRef::Panorama(&clean), 24);
                let got = conversion.cubemap_at(level, EnvironmentRef::Panorama(&spoilt), 24);
                let mut changed = 0;
                for face in Face::ALL {
                    for (i, (got, expected)) in got.face(face).iter().zip(expected.face(face)).enumerate() {
                        let d = cubemap::texel_direction(face, i as u32 % 24, i as u32 / 24, 24).normalize();
                        let is_near = d.angle_between(bad) < 4.0 * std::f64::consts::PI / 32.0;
                        let is_same = bits(&[*got]) == bits(&[*expected]);
                        assert!(is_near || is_same, "{x} {y} {filter} {level:?} {face:?} {i}: {got:?}");
                        changed += usize::from(!is_same);
                    }
                }
                assert!(changed > 0, "{x} {y} {filter} {level:?}");
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mut pano = Panorama::from_function(101, 57, |_| DVec3::ONE);
    noise(&mut pano.image.pixels, None);
    let mut map = Cubemap::new(29, [1.0; 4]);
    noise(map.pixels_mut(), None);
    for &level in SimdLevel::available() {
        for &filter in Filter::ALL {
            let conversion = Conversion { filter: Some(filter), ..Conversion::default() };
            let made = [1, 3, 8].map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
                pool.install(|| {
                    let to_cubemap = conversion.cubemap_at(level, EnvironmentRef::Panorama(&pano), 43);
                    let to_panorama = conversion.panorama_at(level, EnvironmentRef::Cubemap(&map), 61, 47);
                    [bits(to_cubemap.pixels()), bits(&to_panorama.image.pixels)]
                })
            });
            assert!(made[0] == made[1] && made[0] == made[2], "{filter} {level:?}");
        }
    }
}
