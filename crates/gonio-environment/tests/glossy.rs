//! Prefiltered environments, compared with the integrals that they approximate.

use glam::DVec3;
use gonio_environment::{BrdfTable, CubeMips, Cubemap, GlossyMips};
use gonio_light::microfacet::specular_integral;

/// Soft light that comes from everywhere and more from some directions: three lobes about 60 degrees wide over a floor.
fn soft(d: DVec3) -> DVec3 {
    let lamp = |towards: DVec3| (4.0 * (d.dot(towards.normalize()) - 1.0)).exp();
    DVec3::splat(0.2)
        + DVec3::new(
            lamp(DVec3::new(1.0, 0.4, 0.2)),
            lamp(DVec3::new(-0.3, 1.0, 0.6)),
            lamp(DVec3::new(0.1, -0.7, -1.0)),
        )
}

fn glossy(map: Cubemap) -> GlossyMips {
    GlossyMips::new(&CubeMips::new(map), GlossyMips::SIZE)
}

/// Directions all over the sphere.
fn normals(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let y = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let (sin, cos) = (2.399963 * i as f64).sin_cos();
        let across = (1.0 - y * y).sqrt();
        DVec3::new(across * cos, y, across * sin)
    })
}

/// A unit vector whose cosine with `n` is given.
fn view(n: DVec3, cos: f64) -> DVec3 {
    let across = n.cross(DVec3::new(0.3, -0.5, 0.8)).normalize();
    cos * n + (1.0 - cos * cos).sqrt() * across
}

/// The split sum's largest error relative to the white mirror's reflection, over many normals at one view.
fn worst_split_error(mips: &GlossyMips, light: fn(DVec3) -> DVec3, f0: f64, roughness: f64, cos_v: f64) -> f64 {
    let (mut worst, mut mean) = (0.0_f64, 0.0);
    for n in normals(24) {
        let v = view(n, cos_v);
        let expected = specular_integral(n, v, DVec3::splat(f0), roughness, light, 2048);
        worst = worst.max((mips.reflected(n, v, DVec3::splat(f0), roughness) - expected).abs().max_element());
        mean += expected.max_element() / 24.0;
    }
    assert!(mean > 0.0);
    worst / mean
}

#[test]
fn uniform_light_does_not_change() {
    for size in [1, 16, 100, 512] {
        let mips = glossy(Cubemap::new(size, [0.25, 1.0, 300.0, 1.0]));
        let sizes: Vec<u32> = mips.levels().iter().map(Cubemap::size).collect();
        let expected: &[u32] = match size {
            1 | 16 => &[64, 32, 16, 8],
            100 => &[100, 50, 25, 12],
            _ => &[256, 128, 64, 32, 16, 8],
        };
        assert_eq!(sizes, expected);
        for level in mips.levels() {
            for [r, g, b, a] in level.pixels() {
                // Weights of a hundred samples in f32.
                let error = (r / 0.25 - 1.0).abs().max((g - 1.0).abs()).max((b / 300.0 - 1.0).abs());
                assert!(error < 1e-5 && (*a - 1.0).abs() < 1e-6, "{r} {g} {b} {a}");
            }
        }
        // A white mirror in it: the white furnace, as dark as the table says.
        for (roughness, cos_v) in [(0.0, 0.3), (0.5, 0.9), (1.0, 0.2)] {
            let got = mips.reflected(DVec3::Y, view(DVec3::Y, cos_v), DVec3::ONE, roughness).y;
            let (scale, bias) = BrdfTable::get().lookup(cos_v, roughness);
            assert!((got - (scale + bias)).abs() < 1e-5 && got <= 1.0 + 1e-5, "{got}");
        }
    }
}

#[test]
fn levels_are_the_integral_seen_along_the_normal() {
    let map = Cubemap::from_function(128, soft);
    let mips = glossy(map);
    let levels = mips.levels().len();
    assert_eq!(mips.level_of_roughness(1.0), (levels - 1) as f64);
    assert_eq!((mips.level_of_roughness(-1.0), mips.level_of_roughness(f64::NAN)), (0.0, 0.0));
    for index in 0..levels {
        let roughness = index as f64 / (levels - 1) as f64;
        for n in normals(40) {
            // A white mirror has no Fresnel: both factors together are then the whole integral.
            let whole = specular_integral(n, n, DVec3::ONE, roughness, soft, 2048);
            let white = specular_integral(n, n, DVec3::ONE, roughness, |_| DVec3::ONE, 2048);
            let got = mips.sample(n, roughness);
            // Texels of 11 degrees at roughness 1, linearly between them, and the filtered samples: 1 % of the light.
            assert!(got.abs_diff_eq(whole / white, 0.012), "{roughness} {n}: {got} is not {}", whole / white);
        }
    }
}

#[test]
fn the_split_sum_is_near_the_integral() {
    let mips = glossy(Cubemap::from_function(128, soft));
    // The split takes light and BRDF for independent, and the lobe for round. In soft light a mirror seen along its
    // normal is right but for the filtering; the error grows with roughness and towards grazing. The bounds are what
    // was measured, and about a quarter of it; without the dominant direction, the white rough ones fail by far.
    for (f0, roughness, cos_v, bound) in [
        (1.0, 0.0, 1.0, 0.002),
        (1.0, 0.0, 0.2, 0.002),
        (1.0, 0.25, 1.0, 0.015),
        (1.0, 0.5, 1.0, 0.008),
        (1.0, 1.0, 1.0, 0.02),
        (0.04, 0.5, 1.0, 0.008),
        (0.04, 1.0, 1.0, 0.02),
        (1.0, 0.25, 0.5, 0.08),
        (1.0, 0.5, 0.5, 0.14),
        (1.0, 1.0, 0.5, 0.05),
        (1.0, 0.25, 0.2, 0.07),
        (1.0, 0.5, 0.2, 0.27),
        (1.0, 1.0, 0.2, 0.11),
        (0.04, 0.25, 0.5, 0.13),
        (0.04, 0.5, 0.5, 0.35),
        (0.04, 0.25, 0.2, 0.12),
        (0.04, 0.5, 0.2, 0.42),
    ] {
        let error = worst_split_error(&mips, soft, f0, roughness, cos_v);
        assert!(error < bound, "f0 {f0}, roughness {roughness}, cos {cos_v}: {error}");
    }
}

#[test]
fn a_sun_leaves_no_bright_dots() {
    // A disc of 1.5 degrees across, 20,000 times as bright as the rest.
    let towards = DVec3::new(0.4, 0.7, -0.6).normalize();
    let sun = |d: DVec3| DVec3::splat(if d.dot(towards) > 0.75_f64.to_radians().cos() { 20_000.0 } else { 1.0 });
    let map = Cubemap::from_function(256, sun);
    let mean = map.mean_radiance().x;
    let mips = glossy(map);
    for level in &mips.levels()[1..] {
        // Blurring moves light about; the mean over all directions stays (but for the texels' shape).
        let there = level.mean_radiance().x;
        assert!((there / mean - 1.0).abs() < 0.02, "{}: {there} is not {mean}", level.size());
        // About the sun it falls off with the angle: nowhere is a texel brighter than one that is two texels nearer.
        let size = level.size();
        let two_texels = 2.0 * 2.0 / f64::from(size);
        let mut by_angle: Vec<(f64, f32)> = gonio_environment::Face::ALL
            .into_iter()
            .flat_map(|face| (0..size * size).map(move |i| (face, i % size, i / size)))
            .map(|(face, x, y)| {
                let d = gonio_environment::cubemap::texel_direction(face, x, y, size).normalize();
                (d.dot(towards).clamp(-1.0, 1.0).acos(), level.at(face, x, y)[0])
            })
            .collect();
        by_angle.sort_by(|a, b| a.0.total_cmp(&b.0));
        let brightest = by_angle[0].1;
        let mut worst: f32 = 0.0;
        let mut nearer = 0;
        let mut least_nearer = f32::INFINITY;
        for (angle, value) in &by_angle {
            while by_angle[nearer].0 < angle - two_texels {
                least_nearer = least_nearer.min(by_angle[nearer].1);
                nearer += 1;
            }
            if least_nearer.is_finite() {
                worst = worst.max((value - least_nearer) / brightest);
            }
        }
        // Relative to the highlight's middle; what a texel's middle stands for, and the discs' squares as
        // texels. Lookups one mip level sharper leave dots of half of it.
        assert!(worst < 0.02, "{size}: {worst}");
    }
}
