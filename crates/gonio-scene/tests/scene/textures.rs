//! Textures, how they are sampled, and pictures as bytes.

use crate::{Memory, TRIANGLE, png};
use glam::{DVec2, DVec4};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap, srgb_decode};
use gonio_mesh::{Severity, Wrap};
use gonio_scene::load::{describe, load};
use gonio_scene::{ColorSpace, DisplayMap, Picture, Scene, Texture, TextureFilter};
use std::path::Path;

fn loaded(mtl: &str, add: impl Fn(Memory) -> Memory) -> Scene {
    let files = Memory::default().with("models/t.obj", TRIANGLE).with("models/t.mtl", mtl);
    let files = add(files);
    load(describe(&["models/t.obj"], &files).unwrap(), Path::new(""), &files).unwrap()
}

fn warnings(scene: &Scene) -> Vec<String> {
    scene.diagnostics.iter().filter(|d| d.severity == Severity::Warning).map(ToString::to_string).collect()
}

#[test]
fn a_missing_texture_is_a_warning_that_names_every_place() {
    let scene = loaded("newmtl m\nKd 1 1 1\nmap_Kd textures\\wood.png\n", |f| f);
    assert_eq!(
        warnings(&scene),
        [
            "models/t.mtl:3: warning: map_Kd of material `m`: the texture `textures\\wood.png` was not found; looked for \
          models/textures/wood.png, models/wood.png (upper or lower case). The material is used without it"
        ]
    );
    assert_eq!(scene.materials[0].maps.diffuse, None);
    assert_eq!(scene.objects.len(), 1);
}

/// Materials of the same name in two models are two: each reports what it lacks.
#[test]
fn missing_textures_are_reported_for_both_models() {
    let mtl = "newmtl m\nmap_Kd wood.png\n";
    let files = Memory::default()
        .with("a/t.obj", TRIANGLE)
        .with("a/t.mtl", mtl)
        .with("a/wood.png", png(1, 1, |_, _| [255; 4]))
        .with("b/t.obj", TRIANGLE)
        .with("b/t.mtl", mtl);
    let scene = load(describe(&["a/t.obj", "b/t.obj"], &files).unwrap(), Path::new(""), &files).unwrap();
    let found = warnings(&scene);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("b/t.mtl:2: warning: map_Kd of material `m`: the texture `wood.png`"), "{found:?}");
}

#[test]
fn textures_are_found_in_any_case_with_backslashes_and_by_bare_name() {
    let white = || png(1, 1, |_, _| [255; 4]);
    for (written, lies_at) in [
        ("textures\\wood.png", "models/textures/wood.png"),
        ("Textures/WOOD.png", "models/textures/wood.PNG"),
        ("C:\\art\\wood.png", "models/wood.png"),
        ("/home/me/Wood.png", "models/wood.png"),
    ] {
        let scene = loaded(&format!("newmtl m\nmap_Kd {written}\n"), |f| f.with(lies_at, white()));
        assert_eq!(warnings(&scene), [""; 0], "{written}");
        assert_eq!(scene.textures[0].name, lies_at);
        assert_eq!(scene.textures[0].color_space, ColorSpace::Srgb);
        assert!(scene.materials[0].maps.diffuse.is_some());
    }
}

#[test]
fn a_broken_texture_is_a_warning() {
    let scene = loaded("newmtl m\nmap_Kd a.png\nmap_Ks b.png\n", |f| {
        let mut cut = png(64, 64, |x, y| [(x * 7 + y * 3) as u8, (x * y) as u8, 0, 255]);
        cut.truncate(cut.len() / 2);
        f.with("models/a.png", cut).with("models/b.png", "no picture at all")
    });
    let warnings = warnings(&scene);
    assert_eq!(warnings.len(), 2);
    assert!(warnings[0].contains("models/a.png: the picture is damaged"), "{}", warnings[0]);
    assert!(warnings[1].contains("models/b.png"), "{}", warnings[1]);
    assert_eq!(scene.textures.len(), 0);
    assert_eq!((scene.materials[0].maps.diffuse, scene.materials[0].maps.specular), (None, None));
}

#[test]
fn an_enormous_picture_is_refused_before_it_is_decoded() {
    // The header of a PNG of 60000 x 60000; a decoder without limits would want 14 GB.
    let mut bomb = png(1, 1, |_, _| [0; 4]);
    bomb[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
    let crc = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&crc.to_be_bytes());
    let scene = loaded("newmtl m\nmap_Kd a.png\n", |f| f.with("models/a.png", bomb.clone()));
    assert!(warnings(&scene)[0].contains("the picture is too large"), "{:?}", warnings(&scene));
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn heights_become_normals_and_normal_maps_stay() {
    // Heights that rise by 51/255 per texel to the right, dropping back at the seam.
    let ramp = || png(5, 2, |x, _| [51 * x as u8, 51 * x as u8, 51 * x as u8, 255]);
    let scene = loaded("newmtl m\nmap_Bump -bm 2 h.png\n", |f| f.with("models/h.png", ramp()));
    assert_eq!(warnings(&scene), [""; 0]);
    assert!(scene.diagnostics.iter().any(|d| d.message.contains("is read as a height map")), "{:?}", scene.diagnostics);
    let bound = scene.materials[0].maps.normal.unwrap();
    let texture = &scene.textures[bound.texture];
    assert_eq!(texture.color_space, ColorSpace::Data);
    // In the middle: slope 2 * 0.2, so the normal is (-0.4, 0, 1) / sqrt(1.16).
    let length = 1.16f64.sqrt();
    let expected = [-0.4 / length, 0.0, 1.0 / length].map(|c| (127.5 * (c + 1.0) + 0.5) as u8);
    assert_eq!(texture.rgba[4 * 2..4 * 2 + 3], expected);
    // At the seam the picture repeats: (0.2 - 0.8) / 2 * 2 = -0.6.
    let expected = (127.5 * (0.6 / 1.36f64.sqrt() + 1.0) + 0.5) as u8;
    assert_eq!(texture.rgba[0], expected);
    assert_eq!(scene.meshes[0].tangents.len(), scene.meshes[0].positions.len());

    let bluish = || png(2, 2, |_, _| [128, 128, 255, 255]);
    let scene = loaded("newmtl m\nmap_Bump n.png\n", |f| f.with("models/n.png", bluish()));
    assert_eq!(scene.textures[0].rgba[..4], [128, 128, 255, 255]);
    assert!(scene.diagnostics.iter().any(|d| d.message.contains("normal map")), "{:?}", scene.diagnostics);
}

#[test]
fn rows_run_down_and_v_runs_up() {
    // Light at the top: the slope along v is positive, so green is below the middle.
    let ramp = || {
        png(1, 5, |_, y| [255 - 51 * y as u8; 3].iter().chain([&255]).copied().collect::<Vec<_>>().try_into().unwrap())
    };
    let scene = loaded("newmtl m\nmap_Bump h.png\n", |f| f.with("models/h.png", ramp()));
    assert!(scene.textures[0].rgba[4 * 2 + 1] < 120 && scene.textures[0].rgba[4 * 2] == 128);
}

#[test]
fn opacity_is_alpha_where_there_is_one() {
    let scene = loaded("newmtl m\nmap_d a.png\n", |f| f.with("models/a.png", png(1, 1, |_, _| [10, 20, 30, 77])));
    assert_eq!(scene.textures[0].rgba[0], 77);
    assert!(scene.materials[0].is_transparent());
    let scene = loaded("newmtl m\nmap_d a.png\n", |f| f.with("models/a.png", png(1, 1, |_, _| [10, 20, 30, 255])));
    assert_eq!(scene.textures[0].rgba[0], 10);
}

#[test]
fn each_file_once_for_each_use() {
    let scene = loaded("newmtl m\nmap_Kd a.png\nmap_Ks A.png\nmap_Ns a.png\n", |f| {
        f.with("models/a.png", png(1, 1, |_, _| [1, 2, 3, 255]))
    });
    assert_eq!(scene.textures.len(), 2, "once as colour, once as data");
    let maps = &scene.materials[0].maps;
    assert_eq!(maps.diffuse, maps.specular);
    assert_ne!(maps.diffuse, maps.shininess);
    assert!(scene.meshes[0].tangents.is_empty(), "no normal map, no tangents");
}

#[test]
fn an_override_replaces_value_and_texture() {
    let files = Memory::default()
        .with("t.obj", TRIANGLE)
        .with("t.mtl", "newmtl m\nKd 0.1 0.2 0.3\nNs 5\nmap_Kd a.png\nmap_Ks a.png\n")
        .with("a.png", png(1, 1, |_, _| [255; 4]))
        .with(
            "s.toml",
            "[[object]]\nmodel = \"t.obj\"\n[object.material]\ndiffuse = [1, 0.5, 0]\nopacity = 0.5\n\
             [[object]]\nmodel = \"t.obj\"\nmaterial = { textures = false, shininess = 9 }\n\
             [[object]]\nmodel = \"t.obj\"\n",
        );
    let scene = load(describe(&["s.toml"], &files).unwrap(), Path::new(""), &files).unwrap();
    assert_eq!(scene.meshes.len(), 1, "one mesh for all three");
    let of = |object: usize| &scene.materials[scene.objects[object].parts[0].material];
    assert_eq!((of(0).material.diffuse, of(0).material.opacity), ([1.0, 0.5, 0.0], 0.5));
    assert!(of(0).maps.diffuse.is_none() && of(0).maps.specular.is_some());
    assert!(of(1).maps.diffuse.is_none() && of(1).maps.specular.is_none());
    assert_eq!((of(1).material.shininess, of(2).material.shininess), (9.0, 5.0));
    assert!(of(2).maps.diffuse.is_some());
}

#[test]
fn closed_means_closed_and_opaque() {
    let files = gonio_scene::files::BuiltinOnly;
    let mut scene = describe(&["builtin:cube", "builtin:cube", "builtin:still-life"], &files).unwrap();
    scene.objects[1].material.opacity = Some(0.5);
    let scene = load(scene, Path::new(""), &files).unwrap();
    let closed: Vec<bool> = scene.objects.iter().map(|o| o.closed).collect();
    assert_eq!(closed, [true, false, false]);
    assert!(scene.meshes.iter().all(|m| m.normals.len() == m.positions.len()));
}

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

#[test]
fn bytes_are_those_of_the_display_map() {
    let mut picture = Picture::new(257, 33, [0.0; 4]);
    for (i, pixel) in picture.pixels.iter_mut().enumerate() {
        let v = i as f32 / 8000.0;
        *pixel = match i % 5 {
            0 => [v, v * v, 4.0 * v, 1.0],
            1 => [0.2 * v, 0.1, 0.3 * v, 0.4],
            2 => [v, 0.0, 0.0, 0.0],
            3 => [1e-5 * v, -v, f32::NAN, 1.0],
            _ => [1.0 - 1e-7, 1.0, f32::INFINITY, 1.0],
        };
    }
    for encoding in [ColorEncoding::Srgb, ColorEncoding::Direct] {
        for tone_map in ToneMap::ALL {
            for exposure in [0.0, -1.5, 3.0] {
                let map = DisplayMap::Light(OutputTransform { exposure, tone_map: *tone_map, encoding });
                let got = picture.encode8(&map);
                assert_eq!((got.width, got.height, got.rgba.len()), (257, 33, 257 * 33 * 4));
                for (pixel, bytes) in picture.pixels.iter().zip(got.rgba.as_chunks::<4>().0) {
                    let expected = map.apply(*pixel).map(|v| (v * 255.0 + 0.5) as u8);
                    assert_eq!(*bytes, expected, "{pixel:?} {map:?}");
                }
                let deep = picture.encode16(&map);
                let expected = map.apply(picture.pixels[700]).map(|v| (v * 65535.0 + 0.5) as u16);
                assert_eq!(deep.rgba[2800..2804], expected);
            }
        }
    }
}
