//! Conversions, compared with lookups in f64, with known results, and with their inverse.

use glam::{DMat3, DVec3};
use gonio_environment::convert::{Conversion, EnvironmentRef, Filter};
use gonio_environment::{Cubemap, Face, Layout, Panorama, cubemap, panorama};
use gonio_image::Pixel;

/// Smooth, of another value in every direction, and not symmetric in any way.
fn smooth(d: DVec3) -> DVec3 {
    DVec3::new(1.2 + d.x + 0.1 * d.y, 1.2 + d.y * d.z + 0.3 * d.x, 1.2 - 0.7 * d.z + 0.4 * d.x * d.y)
}

/// The same with waves, about ten texels of 256 x 128 long, and lights of 30.
fn detailed(d: DVec3) -> DVec3 {
    let waves = DVec3::new((25.0 * d.x).sin(), (22.0 * d.y + 1.0).sin(), (24.0 * d.z).cos());
    let lamp = 30.0 * (40.0 * (d.dot(DVec3::new(0.6, 0.7, -0.3).normalize()) - 1.0)).exp();
    smooth(d) + 0.3 * waves + DVec3::splat(lamp)
}

fn color([r, g, b, _]: Pixel) -> DVec3 {
    DVec3::new(r.into(), g.into(), b.into())
}

/// A rotation that is none of the cube's own.
fn turn() -> DMat3 {
    DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_z(1.1)
}

/// Decibels between pictures in a logarithmic encoding, as HDR pictures are compared: of log2(1 + x), its peak the
/// largest value.
fn psnr(a: &[Pixel], b: &[Pixel]) -> f64 {
    let encode = |v: f32| f64::from(1.0 + v.max(0.0)).log2();
    let values = |p: &[Pixel]| p.iter().flat_map(|p| [encode(p[0]), encode(p[1]), encode(p[2])]).collect::<Vec<_>>();
    let (a, b) = (values(a), values(b));
    let peak = a.iter().copied().fold(0.0, f64::max);
    let mse = a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / a.len() as f64;
    10.0 * (peak * peak / mse).log10()
}

#[test]
fn bilinear_conversions_are_the_look_ups_in_double_precision() {
    let (map, pano) = (Cubemap::from_function(37, detailed), Panorama::from_function(90, 46, detailed));
    for from in [EnvironmentRef::Cubemap(&map), EnvironmentRef::Panorama(&pano)] {
        for source_from_target in [DMat3::IDENTITY, turn()] {
            let conversion = Conversion { filter: Some(Filter::Bilinear), source_from_target };
            let mut worst: f64 = 0.0;
            // An even number: no texel looks at a pole, which has no longitude to interpolate along.
            let made = conversion.cubemap(from, 42);
            for face in Face::ALL {
                for (i, got) in made.face(face).iter().enumerate() {
                    let d = cubemap::texel_direction(face, i as u32 % 42, i as u32 / 42, 42);
                    worst = worst.max((color(*got) - from.sample(source_from_target * d)).abs().max_element());
                }
            }
            let made = conversion.panorama(from, 81, 44);
            for (i, got) in made.image.pixels.iter().enumerate() {
                let d = panorama::direction((i % 81) as f64 / 81.0 + 0.5 / 81.0, ((i / 81) as f64 + 0.5) / 44.0);
                worst = worst.max((color(*got) - from.sample(source_from_target * d)).abs().max_element());
            }
            // Places are right to 1e-5 texels in f32, and texels differ by up to 8.
            assert!(worst < 2e-4, "{from:.0?} {worst}", from = from.texel_angle());
        }
    }
}

#[test]
fn every_filter_puts_everything_in_its_place() {
    let (map, pano) = (Cubemap::from_function(64, smooth), Panorama::from_function(256, 128, smooth));
    for from in [EnvironmentRef::Cubemap(&map), EnvironmentRef::Panorama(&pano)] {
        for &filter in Filter::ALL {
            let conversion = Conversion { filter: Some(filter), source_from_target: turn() };
            let made = conversion.cubemap(from, 16);
            for face in Face::ALL {
                for (i, got) in made.face(face).iter().enumerate() {
                    let d = cubemap::texel_direction(face, i as u32 % 16, i as u32 / 16, 16).normalize();
                    let off = (color(*got) - smooth(turn() * d)).abs().max_element();
                    // The nearest texel is half a texel away, 0.02 rad, where the function changes by up to 1.5 a
                    // radian in each of two directions; the mean over a pixel of 0.12 rad differs by its square.
                    let tolerance = if filter == Filter::Nearest { 0.04 } else { 0.004 };
                    assert!(off < tolerance, "{filter} {face:?} {i}: {off}");
                }
            }
        }
    }
}

#[test]
fn a_picture_comes_back() {
    let pano = Panorama::from_function(512, 256, detailed);
    for (filter, expected) in [(Filter::Bilinear, 45.0), (Filter::Bicubic, 55.0)] {
        let conversion = Conversion { filter: Some(filter), ..Conversion::default() };
        let map =
            conversion.cubemap(EnvironmentRef::Panorama(&pano), EnvironmentRef::Panorama(&pano).natural_cubemap_size());
        let back = conversion.panorama(EnvironmentRef::Cubemap(&map), 512, 256);
        let got = psnr(&pano.image.pixels, &back.image.pixels);
        assert!(got >= expected, "{filter}: {got} dB");
    }
}

#[test]
fn shrinking_loses_no_light_and_makes_no_pattern() {
    // Every second column dark: a pattern that a plain look-up turns into another pattern.
    let mut pano = Panorama::from_function(1024, 512, |_| DVec3::ONE);
    for (i, p) in pano.image.pixels.iter_mut().enumerate() {
        *p = if i % 2 == 0 { [2.0, 2.0, 2.0, 1.0] } else { [0.0, 0.0, 0.0, 1.0] };
    }
    let small = Conversion::default().cubemap(EnvironmentRef::Panorama(&pano), 32);
    let worst = small.pixels().iter().map(|p| (f64::from(p[0]) - 1.0).abs()).fold(0.0, f64::max);
    // A pixel covers five columns at the corners of faces, ten in the middle; part of one tips the balance.
    assert!(worst < 0.15, "{worst}");
    let plain = Conversion { filter: Some(Filter::Bilinear), ..Conversion::default() };
    let aliased = plain.cubemap(EnvironmentRef::Panorama(&pano), 32);
    let worst = aliased.pixels().iter().map(|p| (f64::from(p[0]) - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst > 0.5, "the pattern would not show: {worst}");

    let pano = Panorama::from_function(1024, 512, detailed);
    let small = Conversion::default().cubemap(EnvironmentRef::Panorama(&pano), 16);
    // Bilinear look-ups weigh texels a little unevenly.
    assert!(
        small.mean_radiance().abs_diff_eq(pano.mean_radiance(), 2e-3),
        "{} {}",
        small.mean_radiance(),
        pano.mean_radiance()
    );
    let map = Cubemap::from_function(256, detailed);
    let small = Conversion::default().panorama(EnvironmentRef::Cubemap(&map), 64, 32);
    assert!(
        small.mean_radiance().abs_diff_eq(map.mean_radiance(), 2e-3),
        "{} {}",
        small.mean_radiance(),
        map.mean_radiance()
    );
}

#[test]
fn no_seam_shows() {
    let pano = Panorama::from_function(512, 256, detailed);
    for &filter in Filter::ALL {
        let conversion = Conversion { filter: Some(filter), source_from_target: turn() };
        for (from, size) in [(EnvironmentRef::Panorama(&pano), 96), (EnvironmentRef::Panorama(&pano), 20)] {
            let map = conversion.cubemap(from, size);
            let last = i64::from(size) - 1;
            let (mut across, mut inside, mut count) = (0.0, 0.0, 0.0);
            for face in Face::ALL {
                for i in 0..=last {
                    for [beyond, edge, inner] in [
                        [(-1, i), (0, i), (1, i)],
                        [(last + 1, i), (last, i), (last - 1, i)],
                        [(i, -1), (i, 0), (i, 1)],
                        [(i, last + 1), (i, last), (i, last - 1)],
                    ] {
                        let step = |a: (i64, i64), b: (i64, i64)| {
                            (map.texel(face, a.0, a.1) - map.texel(face, b.0, b.1)).length()
                        };
                        across += step(beyond, edge);
                        inside += step(edge, inner);
                        count += 1.0;
                    }
                }
            }
            // Equal but for chance: about the edges texels are as far apart to either side.
            assert!(across < 1.05 * inside, "{filter} {size}: {} and {}", across / count, inside / count);
        }
    }
}

#[test]
fn turning_there_and_back_changes_little() {
    let map = Cubemap::from_function(96, detailed);
    let there = Conversion { filter: Some(Filter::Bicubic), source_from_target: turn() };
    let back = Conversion { source_from_target: turn().transpose(), ..there };
    let turned = there.cubemap(EnvironmentRef::Cubemap(&map), 96);
    let again = back.cubemap(EnvironmentRef::Cubemap(&turned), 96);
    let (off, on) = (psnr(map.pixels(), turned.pixels()), psnr(map.pixels(), again.pixels()));
    assert!(off < 25.0 && on > 40.0, "turned {off} dB, turned back {on} dB");
}

#[test]
fn the_smallest_pictures_convert() {
    for (width, height) in [(1, 1), (2, 1), (1, 2), (3, 2), (4, 2)] {
        let pano = Panorama::from_function(width, height, |_| DVec3::splat(0.5));
        for &filter in Filter::ALL {
            let conversion = Conversion { filter: Some(filter), source_from_target: turn() };
            for size in [1, 2, 3, 9] {
                let map = conversion.cubemap(EnvironmentRef::Panorama(&pano), size);
                let back = conversion.panorama(EnvironmentRef::Cubemap(&map), 2 * size, size);
                for p in map.pixels().iter().chain(&back.image.pixels) {
                    assert!((p[0] - 0.5).abs() < 1e-6, "{width} x {height} {filter} {size}: {p:?}");
                }
            }
        }
    }
}

#[test]
fn layouts_are_the_same_environment() {
    // As `light-equation` defines it: a camera that looks along -Z sees the photographic `posz`.
    let pano = Panorama::from_function(128, 64, |d| d + DVec3::ONE);
    let conversion = Conversion { filter: Some(Filter::Bilinear), ..Conversion::default() };
    let map = conversion.cubemap(EnvironmentRef::Panorama(&pano), 9);
    let faces = map.faces(Layout::Photographic);
    let middle = |face: Face| color(faces[face as usize].at(4, 4)) - DVec3::ONE;
    for (face, expected) in [
        (Face::PosZ, DVec3::NEG_Z),
        (Face::NegZ, DVec3::Z),
        (Face::PosX, DVec3::X),
        (Face::NegX, DVec3::NEG_X),
        (Face::PosY, DVec3::Y),
        (Face::NegY, DVec3::NEG_Y),
    ] {
        // Interpolated between pixels of 0.05 rad.
        assert!(middle(face).abs_diff_eq(expected, 2e-3), "{face:?}: {}", middle(face));
    }
    // To the right of straight ahead is +X, on the left edge of the face to the right is -Z.
    let ahead = color(faces[Face::PosZ as usize].at(8, 4)) - DVec3::ONE;
    let right = color(faces[Face::PosX as usize].at(0, 4)) - DVec3::ONE;
    assert!(ahead.x > 0.6 && ahead.z < -0.6 && right.x > 0.6 && right.z < -0.6, "{ahead} {right}");
}
