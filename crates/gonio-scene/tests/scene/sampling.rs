//! Texture sampling where the answer is known on paper.

use glam::{DVec2, DVec4};
use gonio_light::color::srgb_decode;
use gonio_mesh::Wrap;
use gonio_scene::{ColorSpace, Texture, TextureFilter};

/// Set by 8 bits: one step is 1/255, a rounded mean is off by half of it.
const HALF_STEP: f64 = 0.5 / 255.0 + 1e-9;

/// Greys, row by row from the **top**.
fn greys(width: u32, height: u32, values: &[u8]) -> Texture {
    let rgba = values.iter().flat_map(|&v| [v, v, v, 255]).collect();
    Texture::new("greys", width, height, rgba, ColorSpace::Data)
}

fn sample(t: &Texture, u: f64, v: f64, filter: TextureFilter, wrap: Wrap) -> f64 {
    t.sample(DVec2::new(u, v), DVec2::ZERO, DVec2::ZERO, filter, [wrap; 2]).x
}

#[test]
fn nearest_counts_rows_from_the_bottom() {
    // top row 0 51, bottom row 102 255
    let t = greys(2, 2, &[0, 51, 102, 255]);
    let at = |u, v| sample(&t, u, v, TextureFilter::Nearest, Wrap::Repeat);
    assert_eq!([at(0.25, 0.25), at(0.75, 0.25), at(0.25, 0.75), at(0.75, 0.75)], [0.4, 1.0, 0.0, 0.2]);
    assert_eq!([at(1.25, 0.25), at(-0.75, 0.25), at(-0.25, 7.25)], [0.4, 0.4, 1.0], "repeats");
    let clamped = |u, v| sample(&t, u, v, TextureFilter::Nearest, Wrap::Clamp);
    assert_eq!([clamped(5.0, 0.25), clamped(-5.0, 0.25), clamped(1.0, 1.0)], [1.0, 0.4, 0.2]);
}

#[test]
fn linear_meets_texel_centres_at_half_integers() {
    let t = greys(2, 1, &[0, 255]);
    let at = |u, wrap| sample(&t, u, 0.5, TextureFilter::Linear, wrap);
    for (u, value) in [(0.25, 0.0), (0.5, 0.5), (0.75, 1.0), (0.375, 0.25)] {
        assert!((at(u, Wrap::Repeat) - value).abs() < 1e-12 && (at(u, Wrap::Clamp) - value).abs() < 1e-12);
    }
    assert!((at(0.0, Wrap::Repeat) - 0.5).abs() < 1e-12, "half of each neighbour across the seam");
    assert!((at(0.0, Wrap::Clamp)).abs() < 1e-12 && (at(1.0, Wrap::Clamp) - 1.0).abs() < 1e-12, "the edge's own texel");
    // Mirrored, the picture is 0 255 255 0 from u = 0 to 2: its second half begins with its own last texel.
    for (u, value) in [(1.0, 1.0), (1.25, 1.0), (1.5, 0.5), (1.75, 0.0), (2.0, 0.0), (-0.25, 0.0), (-0.5, 0.5)] {
        assert!((at(u, Wrap::Mirror) - value).abs() < 1e-12, "{u}");
    }
    let both =
        t.sample(DVec2::new(1.75, 9.0), DVec2::ZERO, DVec2::ZERO, TextureFilter::Linear, [Wrap::Mirror, Wrap::Clamp]);
    assert_eq!(both.x, 0.0);
}

#[test]
fn a_checker_in_srgb_fades_to_the_mean_of_its_light() {
    let rgba = (0..64).flat_map(|i| if (i % 8 + i / 8) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let t = Texture::new("checker", 8, 8, rgba, ColorSpace::Srgb);
    assert_eq!(t.mip_levels().len(), 3);
    for level in t.mip_levels() {
        // Half of the light is sRGB byte 188, not 128.
        assert!(level.rgba.as_chunks::<4>().0.iter().all(|t| *t == [188, 188, 188, 255]));
    }
    let half = srgb_decode(188.0 / 255.0);
    let step = DVec2::new(4.0 / 8.0, 0.0);
    let far = t.sample(DVec2::splat(0.3), step, DVec2::ZERO, TextureFilter::Mipmap, [Wrap::Repeat; 2]);
    assert!(far.abs_diff_eq(DVec4::new(half, half, half, 1.0), 1e-12));
}

#[test]
fn levels_are_means_also_of_odd_sizes() {
    // Five columns become two: each covers two and a half.
    let t = greys(5, 1, &[0, 50, 100, 150, 250]);
    let levels = t.mip_levels();
    assert_eq!(levels.iter().map(|l| (l.width, l.height)).collect::<Vec<_>>(), [(2, 1), (1, 1)]);
    assert_eq!(levels[0].rgba[0], ((0.0 + 50.0 + 50.0) / 2.5f64).round() as u8);
    assert_eq!(levels[0].rgba[4], ((50.0 + 150.0 + 250.0) / 2.5f64).round() as u8);
    assert_eq!(levels[1].rgba[0], 110);
}

#[test]
fn trilinear_goes_between_levels() {
    // Left half dark, right half light: level 1 keeps the two, level 2 is their mean.
    let t = greys(4, 4, &[0, 0, 200, 200].repeat(4));
    let at = |texels: f64| {
        let step = DVec2::new(0.0, texels / 4.0);
        t.sample(DVec2::new(0.25, 0.25), DVec2::ZERO, step, TextureFilter::Mipmap, [Wrap::Clamp; 2]).x
    };
    assert!(at(1.0) < 1e-12 && at(0.01) < 1e-12, "the full picture");
    assert!((at(4.0) - 100.0 / 255.0).abs() < HALF_STEP, "the last level");
    assert!((at(100.0) - 100.0 / 255.0).abs() < HALF_STEP, "beyond the last level");
    // lod 1.5: half of level 1 (0 at its left texel's centre) and half of level 2.
    assert!((at(2f64.powf(1.5)) - 50.0 / 255.0).abs() < HALF_STEP);
}

#[test]
fn anisotropic_looks_along_the_longer_axis() {
    // Stripes that vary along u only, seen at a grazing angle along v: eight texels long, one wide.
    let stripes = greys(16, 16, &[0, 255].repeat(128));
    let at = |filter| {
        let (ddx, ddy) = (DVec2::new(1.0 / 16.0, 0.0), DVec2::new(0.0, 8.0 / 16.0));
        stripes.sample(DVec2::new(0.5 / 16.0, 0.5), ddx, ddy, filter, [Wrap::Repeat; 2]).x
    };
    assert!(at(TextureFilter::Anisotropic) < 1e-9, "the stripe stays dark");
    assert!((at(TextureFilter::Mipmap) - 0.5).abs() < 0.01, "isotropic filtering has lost it");
    // Across the stripes it is their mean: taps at odd spacing over eight texels.
    let (ddx, ddy) = (DVec2::new(8.0 / 16.0, 0.0), DVec2::new(0.0, 1.0 / 16.0));
    let across = stripes.sample(DVec2::new(0.5, 0.5), ddx, ddy, TextureFilter::Anisotropic, [Wrap::Repeat; 2]).x;
    assert!((across - 0.5).abs() < 0.06, "{across}");
    let none =
        stripes.sample(DVec2::splat(0.5), DVec2::ZERO, DVec2::ZERO, TextureFilter::Anisotropic, [Wrap::Repeat; 2]);
    assert!(none.is_finite());
}

#[test]
fn coordinates_that_are_not_finite_are_survived() {
    let t = greys(2, 2, &[10, 20, 30, 40]);
    for filter in TextureFilter::ALL {
        for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            let bad = DVec2::new(f64::NAN, f64::INFINITY);
            assert!(t.sample(bad, bad, bad, *filter, [wrap; 2]).is_finite());
            assert!(t.sample(DVec2::splat(1e300), DVec2::X, DVec2::Y, *filter, [wrap; 2]).is_finite());
        }
    }
}
