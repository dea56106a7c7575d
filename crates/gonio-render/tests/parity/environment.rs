//! Environments on the GPU compared with the reference: skies, mirrors, glass. Tolerances as in `main.rs`.
//!
//! The environment is smooth, up to 50 times as bright as white, and its colour changes everywhere: a driver moves corners by
//! up to 1/256 of a pixel, and on a curved mirror that is some hundredths of a texel, which only counts where a texel
//! differs much from the next. Hard edges have a test and a tolerance of their own.

use crate::bench::{Bench, HEIGHT, WIDTH, scene_from};
use crate::textured_model;
use glam::DVec3;
use gonio_environment::Cubemap;
use gonio_light::Quantity;
use gonio_reference::ReferenceScene;
use gonio_scene::settings::EnvironmentSettings;
use gonio_scene::{LoadedEnvironment, Scene, TextureFilter, ViewSpec};
use std::sync::{Arc, LazyLock};

const CAMERA: &str = "position = [1.5, 2.0, 5.0]\ntarget = [0.1, 0.2, 0.0]";
const LIGHTS: &str = "[[light]]\nkind = \"directional\"\ndirection = [-1, -2, -1.5]\n[[light]]\nkind = \"ambient\"\n\
                      color = [0.2, 0.25, 0.3]\n";
const CLAY: &str = "ambient = [0.3, 0.2, 0.2], diffuse = [0.8, 0.45, 0.2], specular = [0.5, 0.5, 0.5], shininess = 32";

/// Linear radiance from a direction: waves of other lengths in each channel, and two lamps.
fn radiance(d: DVec3) -> DVec3 {
    let wave = |v: f64| 0.5 + 0.4 * v.sin();
    let base = DVec3::new(wave(3.0 * d.x + d.y), wave(4.0 * d.y - d.z), wave(2.0 * d.z + 3.0 * d.x * d.y));
    let lamp = |at: DVec3, sharpness: f64| (sharpness * (d.dot(at.normalize()) - 1.0)).exp();
    base + 50.0 * lamp(DVec3::new(0.3, 0.8, 0.5), 12.0) * DVec3::new(1.0, 0.9, 0.7)
        + 4.0 * lamp(DVec3::new(-1.0, 0.2, -0.4), 16.0) * DVec3::new(0.3, 0.6, 1.0)
}

static SMOOTH: LazyLock<Arc<LoadedEnvironment>> =
    LazyLock::new(|| Arc::new(LoadedEnvironment::new("waves", Cubemap::from_function(256, radiance))));

fn surrounded(mut scene: Scene, environment: &Arc<LoadedEnvironment>, spec: EnvironmentSettings) -> Scene {
    scene.environment = Some(environment.clone());
    scene.settings.environment = Some(spec);
    scene
}

/// An object of one material in the smooth environment.
fn scene(model: &str, shading: &str, material: &str) -> Scene {
    scene_of(&object(model, shading, material))
}

fn scene_of(objects: &str) -> Scene {
    surrounded(scene_from(CAMERA, "", LIGHTS, objects), &SMOOTH, EnvironmentSettings::default())
}

fn object(model: &str, shading: &str, material: &str) -> String {
    format!(
        "[[object]]\nmodel = \"builtin:{model}\"\nshading = \"{shading}\"\nrotate = [20, 35, -10]\n\
         scale = [1.0, 1.4, 0.8]\ntranslate = [0.2, 0.1, -0.3]\nmaterial = {{ {material} }}\n"
    )
}

/// Asserts that an environment is visible: the picture of the reference differs without it.
fn assert_shows(name: &str, with: &Scene, without: &Scene) {
    let picture = |scene: &Scene| ReferenceScene::new(scene).render(&scene.frame(0.0), None, &|_| ()).picture;
    assert!(picture(with) != picture(without), "{name} shows");
}

#[test]
fn skies_from_everywhere() {
    let mut bench = Bench::new();
    let far = object("cube", "phong", CLAY).replace("translate = [0.2, 0.1, -0.3]", "translate = [0.2, 0.1, -9.0]");
    for (camera, rotate, intensity) in [
        ("position = [0, 0, 5]\ntarget = [0, 0, 0]", [0.0; 3], 1.0),
        ("position = [9, 1, 0]\ntarget = [0, 0, 0]", [0.0; 3], 0.25),
        ("position = [0, -7, 0.1]\ntarget = [0, 0, 0]", [30.0, 0.0, 0.0], 2.0),
        ("position = [1, 7, 0.1]\ntarget = [0, 0, 0]", [0.0, -50.0, 0.0], 1.0),
        ("position = [3, 3, 3]\ntarget = [0, 0, 0]", [0.0, 0.0, 77.0], 1.0),
        ("position = [-4, 3, -3]\ntarget = [0, 1, 0]", [123.0, 34.0, -56.0], 0.7),
    ] {
        let spec = EnvironmentSettings { rotate, intensity, ..EnvironmentSettings::default() };
        let mut sky = surrounded(scene_from(camera, "", LIGHTS, &far), &SMOOTH, spec.clone());
        bench.check(&format!("{camera} {spec:?}"), &sky, None);
        sky.settings.background.transparent = true;
        bench.check(&format!("{camera} {spec:?} over nothing"), &sky, None);
        // An invisible environment does not change the background.
        let hidden = EnvironmentSettings { visible: false, ..spec };
        let hidden = surrounded(scene_from(camera, "", LIGHTS, &far), &SMOOTH, hidden);
        let c = bench.compare(&hidden, None);
        assert!(c.close >= 0.995, "hidden: {:.3} % within 1/255", 100.0 * c.close);
        assert_shows("the sky", &sky, &hidden);
    }
}

#[test]
fn another_environment_behind_the_objects() {
    let mut bench = Bench::new();
    let other = Cubemap::from_function(64, |d| radiance(-d) * DVec3::new(0.2, 1.0, 0.5));
    let environment = LoadedEnvironment::clone(&SMOOTH).with_background(other);
    let mirror = scene("sphere-smooth", "phong", "reflectivity = 1");
    let two = surrounded(mirror.clone(), &Arc::new(environment), EnvironmentSettings::default());
    bench.check("two environments", &two, None);
    assert_shows("the other", &two, &mirror);
}

#[test]
fn the_sky_through_surfaces_that_let_light_through() {
    let mut bench = Bench::new();
    for opacity in ["0.6", "0.1"] {
        for shading in ["flat", "gouraud", "phong"] {
            let front = object("sphere-coarse-averaged", shading, &format!("{CLAY}, opacity = {opacity}"))
                .replace("translate = [0.2, 0.1, -0.3]", "translate = [0.6, 0.7, 2.0]");
            let behind = object("cube", "phong", "reflectivity = 1");
            let scene = scene_of(&format!("{behind}{front}"));
            bench.check(&format!("opacity {opacity} {shading}"), &scene, None);
        }
    }
    // A surface that mirrors and is transparent.
    let pane = scene("cube", "phong", &format!("{CLAY}, opacity = 0.4, reflectivity = 0.5"));
    bench.check("half a mirror, half open", &pane, None);
}

#[test]
fn mirrors_of_every_shading() {
    let mut bench = Bench::new();
    for model in ["sphere-smooth", "suzanne", "cube"] {
        for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
            for reflectivity in ["1", "0.5"] {
                let mirror = scene(model, shading, &format!("{CLAY}, reflectivity = {reflectivity}"));
                bench.check(&format!("{model} {shading} {reflectivity}"), &mirror, None);
            }
        }
    }
}

#[test]
fn every_medium_and_fresnel_factor() {
    let mut bench = Bench::new();
    for medium in ["air", "water", "ice", "glass", "diamond"] {
        for fresnel in ["none", "exact", "schlick"] {
            let clear = scene("sphere-smooth", "phong", &format!("medium = \"{medium}\", fresnel = \"{fresnel}\""));
            bench.check(&format!("{medium} {fresnel}"), &clear, None);
        }
    }
}

#[test]
fn everything_between_mirror_glass_and_lit_surface() {
    let mut bench = Bench::new();
    let plain = scene("suzanne", "phong", CLAY);
    for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
        for optics in [
            "medium = \"glass\", tint = [0.9, 0.5, 0.2]",
            "transmission = 0.6, reflectivity = 0.3, fresnel = \"schlick\", refraction_index = 1.4",
            "reflectivity = 0.8, fresnel = \"exact\", refraction_index = 2.0",
            "medium = \"diamond\", dispersion = 0.3, tint = [1.0, 0.8, 0.9]",
            "transmission = 0.5, dispersion = 0.2, reflectivity = 0.5",
        ] {
            let some = scene("suzanne", shading, &format!("{CLAY}, {optics}"));
            bench.check(&format!("{shading} {optics}"), &some, None);
            assert_shows(optics, &some, &plain);
        }
    }
}

#[test]
fn turned_environments_in_mirrors_and_glass() {
    let mut bench = Bench::new();
    for material in ["reflectivity = 1", "medium = \"water\""] {
        let spec =
            EnvironmentSettings { rotate: [200.0, -35.0, 80.0], intensity: 0.6, ..EnvironmentSettings::default() };
        let turned = surrounded(scene("sphere-smooth", "phong", material), &SMOOTH, spec);
        bench.check(material, &turned, None);
        assert_shows("the turn", &turned, &scene("sphere-smooth", "phong", material));
    }
}

/// A surface seen from its back, so that rays come from inside and are totally reflected beyond the critical angle: the belt
/// of a ball, seen from above, where it is open.
#[test]
fn glass_from_inside() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write_with_normal_map(folder.path());
    let from_above = "position = [0.5, 4.5, 1.5]\ntarget = [0.2, 0.0, -0.3]";
    let mut pictures = Vec::new();
    for shading in ["flat", "gouraud", "phong"] {
        for two_sided in [false, true] {
            let objects = object("cube", shading, "textures = false, medium = \"glass\"");
            let objects = objects.replace("builtin:cube", &model.display().to_string());
            let scene = scene_from(from_above, &format!("two_sided = {two_sided}"), LIGHTS, &objects);
            let scene = surrounded(scene, &SMOOTH, EnvironmentSettings::default());
            bench.check(&format!("{shading} {two_sided}"), &scene, None);
            let reference = ReferenceScene::new(&scene);
            let frame = scene.frame(0.0);
            let seen = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
            let inside = reference.probe_all(&frame, seen).iter().flatten().filter(|probe| !probe.front_facing).count();
            assert!(inside > 1000, "{inside} pixels show the inside");
            pictures.push(reference.render(&frame, None, &|_| ()).picture);
        }
    }
    assert!(pictures.chunks(2).all(|pair| pair[0] != pair[1]), "the side counts");
}

#[test]
fn normals_from_a_texture_turn_mirrors() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write_with_normal_map(folder.path());
    let path = |scene: &str| scene.replace("builtin:cube", &model.display().to_string());
    let bumpy = scene_of(&path(&object("cube", "phong", "reflectivity = 0.7")));
    assert!(bumpy.materials[0].maps.normal.is_some());
    let c = bench.compare(&bumpy, None);
    // The map's 8 bits of filter weights move directions by a thousandth, and a lamp is brighter by some per cent there.
    assert!(c.interior > 500 && c.worst.0 <= 0.02, "{} pixels, {} {}", c.interior, c.worst.0, c.worst.1);
    assert!(c.close >= 0.995, "{:.3} % within 1/255", 100.0 * c.close);
    assert_shows("the map", &bumpy, &scene_of(&path(&object("cube", "phong", "textures = false, reflectivity = 0.7"))));
}

#[test]
fn every_view_of_the_environment() {
    let mut bench = Bench::new();
    let views = [Quantity::ViewReflection, Quantity::Fresnel, Quantity::Reflected, Quantity::Transmitted];
    for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
        for material in [
            "medium = \"glass\", dispersion = 0.1, tint = [0.5, 0.8, 1.0]",
            "reflectivity = 0.5, fresnel = \"schlick\"",
            CLAY,
        ] {
            let scene = scene("sphere-coarse-averaged", shading, material);
            for quantity in views {
                let view = Some(ViewSpec { quantity, light: None });
                bench.check(&format!("{quantity} {shading} {material}"), &scene, view);
            }
        }
    }
}

/// An environment that is not smooth: squares, 24 texels wide, black and ten times white.
#[test]
fn hard_edges() {
    let mut bench = Bench::new();
    let squares = Cubemap::from_function(256, |d| {
        let d = d / d.abs().max_element();
        let odd = d.to_array().map(|v| (v * 5.0 + 0.5).floor() as i64).iter().sum::<i64>() % 2 != 0;
        if odd { DVec3::new(10.0, 9.0, 8.0) } else { DVec3::ZERO }
    });
    let squares = Arc::new(LoadedEnvironment::new("squares", squares));
    for material in ["reflectivity = 1", "medium = \"glass\""] {
        let scene = surrounded(scene("sphere-smooth", "phong", material), &squares, EnvironmentSettings::default());
        let c = bench.compare(&scene, None);
        // From black to 10 over one texel: 1/512 of a pixel, across which a ball's mirror turns by a tenth of a texel at
        // its rim, is up to 1 there. The 8-bit pictures must still agree.
        assert!(c.interior > 500 && c.worst.0 <= 1.0, "{material}: {} {}", c.worst.0, c.worst.1);
        assert!(c.close >= 0.995, "{material}: {:.3} % within 1/255", 100.0 * c.close);
    }
}

/// Levels by distances on the screen: the driver's derivatives are those of blocks of 2 x 2 pixels, the reference's of the
/// pixel itself.
#[test]
fn mip_levels() {
    let mut bench = Bench::new();
    let fine =
        Cubemap::from_function(512, |d| radiance(d) + DVec3::splat(0.4 * (150.0 * d.x).sin() * (130.0 * d.y).sin()));
    let fine = Arc::new(LoadedEnvironment::new("fine waves", fine));
    for material in ["reflectivity = 1", "medium = \"glass\", dispersion = 0.1"] {
        let mut scene = surrounded(scene("sphere-smooth", "phong", material), &fine, EnvironmentSettings::default());
        let linear = scene.clone();
        scene.settings.picture.texture_filter = TextureFilter::Mipmap;
        let c = bench.compare(&scene, None);
        assert!(c.close >= 0.9, "{material}: {:.3} % within 1/255", 100.0 * c.close);
        // Without levels, or with a constant one, fewer pixels would agree.
        let picture = |scene: &Scene| ReferenceScene::new(scene).render(&scene.frame(0.0), None, &|_| ()).picture;
        let (with, without) = (picture(&scene), picture(&linear));
        let differ = with.pixels.iter().zip(&without.pixels).filter(|(a, b)| (a[0] - b[0]).abs() > 0.02).count();
        assert!(differ > 2000, "levels change {differ} pixels only");
    }
}

#[test]
fn in_opengl_es() {
    let mut bench = Bench::with(true);
    for material in ["reflectivity = 0.7", "medium = \"glass\", dispersion = 0.1, tint = [0.5, 0.8, 1.0]"] {
        for shading in ["flat", "gouraud", "phong"] {
            bench.check(&format!("{shading} {material}"), &scene("suzanne", shading, material), None);
        }
    }
}

/// The sky does not depend on the kind of samples or on bands.
#[test]
fn skies_of_many_samples_and_in_bands() {
    for es in [false, true] {
        let mut bench = Bench::with(es);
        for model in ["cube", "suzanne"] {
            let mut scene = scene(model, "phong", "reflectivity = 1");
            scene.settings.picture.samples = 4;
            let c = bench.compare(&scene, None);
            assert!(c.close >= 0.95, "{model} es {es}: {:.3} % within 1/255", 100.0 * c.close);
            // Several bands, the last one smaller.
            (scene.settings.picture.width, scene.settings.picture.height) = (700, 621);
            let frame = scene.frame(0.0);
            let uploaded = bench.renderer.upload(&scene).unwrap();
            let whole = bench.renderer.render(&uploaded, &frame, None).unwrap().encoded8().unwrap();
            let banded = bench.renderer.render8(&uploaded, &frame, None).unwrap().picture;
            let differ = whole.rgba.iter().zip(&banded.rgba).filter(|(a, b)| a.abs_diff(**b) > 1).count();
            assert!(differ * 1000 <= whole.rgba.len(), "{model}: {differ} of {} values differ", whole.rgba.len());
        }
    }
}

/// A smaller environment: blurring it for all roughnesses takes a while in a test.
static SMALL: LazyLock<Arc<LoadedEnvironment>> =
    LazyLock::new(|| Arc::new(LoadedEnvironment::new("small waves", Cubemap::from_function(64, radiance))));

#[test]
fn light_of_the_environment() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let textured = textured_model::write(folder.path());
    let lit = EnvironmentSettings { light: true, ..EnvironmentSettings::default() };
    let turned = EnvironmentSettings { rotate: [200.0, -35.0, 80.0], intensity: 0.6, ..lit.clone() };
    for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
        for (model, material) in [
            ("suzanne", CLAY.to_owned()),
            ("suzanne", CLAY.replace("specular = [0.5, 0.5, 0.5]", "specular = [0, 0, 0]")),
            ("suzanne", format!("{CLAY}, reflectivity = 0.4, fresnel = \"exact\"")),
            // Opaque: edges of other triangles would be visible through transparent surfaces.
            ("textured", "opacity = 1".to_owned()),
        ] {
            let objects =
                object(model, shading, &material).replace("builtin:textured", &textured.display().to_string());
            for (equation, spec) in [("", &lit), ("specular_term = false", &turned), ("diffuse = false", &turned)] {
                let scene = surrounded(scene_from(CAMERA, equation, LIGHTS, &objects), &SMALL, spec.clone());
                let c = bench.compare(&scene, None);
                let name = format!("{shading} {model} {material} {equation}");
                // llvmpipe filters textures of 8 bits with 8 bits: a step of them is 3e-3 of the albedo, and light from
                // everywhere may be four times as strong as a light's.
                let tolerance = if model == "textured" { 4e-3 } else { 1e-3 };
                assert!(c.interior > 500 && c.worst.0 <= tolerance, "{name}: {} {}", c.worst.0, c.worst.1);
                assert!(c.close >= 0.995, "{name}: {:.3} % within 1/255", 100.0 * c.close);
            }
        }
    }
}

/// Model files have exponents of 0, which the light equation treats as 1; so must the conversion to roughness.
#[test]
fn exponents_below_one_are_one() {
    let mut bench = Bench::new();
    let lit = EnvironmentSettings { light: true, ..EnvironmentSettings::default() };
    for shading in ["gouraud", "phong"] {
        let one = object("suzanne", shading, &CLAY.replace("shininess = 32", "shininess = 1"));
        let one = surrounded(scene_from(CAMERA, "", LIGHTS, &one), &SMALL, lit.clone());
        let mut zero = one.clone();
        zero.materials.iter_mut().for_each(|m| m.material.shininess = 0.0);
        bench.check(shading, &zero, None);
        let picture = |scene| ReferenceScene::new(scene).render(&one.frame(0.0), None, &|_| ()).picture;
        assert!(picture(&zero) == picture(&one), "they look alike");
    }
}

/// A black k_s is matte without a bright rim, also if other materials of the scene are glossy.
#[test]
fn matte_beside_glossy() {
    let mut bench = Bench::new();
    let lit = EnvironmentSettings { light: true, ..EnvironmentSettings::default() };
    let matte = object("suzanne", "phong", &CLAY.replace("specular = [0.5, 0.5, 0.5]", "specular = [0, 0, 0]"));
    let glossy = object("cube", "flat", CLAY).replace("translate = [0.2, 0.1,", "translate = [0.2, -2.5,");
    let scene = scene_from(CAMERA, "", LIGHTS, &format!("{matte}{glossy}"));
    bench.check("matte beside glossy", &surrounded(scene, &SMALL, lit), None);
}

#[test]
fn views_of_the_environments_light() {
    let mut bench = Bench::new();
    let lit = EnvironmentSettings { light: true, ..EnvironmentSettings::default() };
    for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
        let scene = scene_from(CAMERA, "", LIGHTS, &object("sphere-coarse-averaged", shading, CLAY));
        let scene = surrounded(scene, &SMALL, lit.clone());
        for quantity in [Quantity::EnvironmentDiffuse, Quantity::EnvironmentSpecular] {
            bench.check(&format!("{quantity} {shading}"), &scene, Some(ViewSpec { quantity, light: None }));
        }
    }
}

#[test]
fn blurred_skies() {
    for es in [false, true] {
        let mut bench = Bench::with(es);
        let sharp = surrounded(scene("cube", "phong", CLAY), &SMALL, EnvironmentSettings::default());
        for blur in [0.2, 0.55, 1.0] {
            let spec = EnvironmentSettings { blur, ..EnvironmentSettings::default() };
            let scene = surrounded(scene("cube", "phong", CLAY), &SMALL, spec);
            bench.check(&format!("blur {blur} es {es}"), &scene, None);
            assert_shows("the blur", &scene, &sharp);
        }
    }
}

/// Through both surfaces. Rays meet edges of triangles on their way, at which normals turn: there the two renderers may hit
/// different triangles, which the neighbours of the pixel do not show. Smooth balls and cubes still agree within the usual
/// tolerance; the monkey's features are small, and its body is open at the eyes.
#[test]
fn bodies_seen_through() {
    for es in [false, true] {
        let mut bench = Bench::with(es);
        let usual = 1e-3;
        for (model, shading, tolerance) in [
            ("sphere-smooth", "phong", usual),
            ("cube", "flat", usual),
            ("cube", "flat-per-face", usual),
            ("suzanne", "gouraud", 0.05),
            ("suzanne", "phong", 0.05),
        ] {
            for optics in [
                "medium = \"glass\"",
                "medium = \"diamond\", dispersion = 0.2, tint = [0.9, 0.8, 0.7]",
                "medium = \"water\", fresnel = \"schlick\", absorption = [0.1, 0.7, 1.5]",
                "medium = \"ice\", fresnel = \"none\"",
            ] {
                // Half of the work in OpenGL ES.
                if es && (optics.contains("ice") || shading == "gouraud") {
                    continue;
                }
                let two = scene(model, shading, &format!("{optics}, surfaces = \"two\""));
                let c = bench.compare(&two, None);
                let name = format!("{model} {shading} {optics}");
                assert!(c.interior > 5000 && c.worst.0 <= tolerance, "{name}: {} {}", c.worst.0, c.worst.1);
                assert!(c.close >= 0.995, "{name}: {:.3} % within 1/255", 100.0 * c.close);
                assert_shows("the second surface", &two, &scene(model, shading, optics));
            }
        }
    }
}

/// Far from the origin, large, mirrored, and flat as a coin: rays inside are traced in the body space of the object.
#[test]
fn bodies_of_every_size_and_place() {
    let mut bench = Bench::new();
    for (place, camera) in [
        (
            "scale = [1000, 1500, 700]\ntranslate = [9000, 0, 0]",
            "position = [10500, 2000, 5000]\ntarget = [9000, 0, 0]",
        ),
        ("scale = [-1.2, 1.0, 0.9]\nrotate = [20, 35, -10]", CAMERA),
        ("scale = [0.001, 0.0015, 0.0007]", "position = [0.0015, 0.002, 0.005]\ntarget = [0, 0, 0]"),
        ("scale = [1.5, 1.5, 0.05]\nrotate = [20, 35, -10]", CAMERA),
    ] {
        for (model, shading) in [("sphere-smooth", "phong"), ("cube", "flat")] {
            let objects = format!(
                "[[object]]\nmodel = \"builtin:{model}\"\nshading = \"{shading}\"\n{place}\n\
                 material = {{ medium = \"glass\", surfaces = \"two\", absorption = [0.1, 0.2, 0.3] }}\n"
            );
            let scene = surrounded(scene_from(camera, "", LIGHTS, &objects), &SMOOTH, EnvironmentSettings::default());
            let c = bench.compare(&scene, None);
            let name = format!("{model} {place}");
            // f32 has 1e-3 for places 9,000 from the origin, a millionth of the object; glass turns it to some more.
            assert!(c.interior > 5000 && c.worst.0 <= 5e-3, "{name}: {} {}", c.worst.0, c.worst.1);
            assert!(c.close >= 0.995, "{name}: {:.3} % within 1/255", 100.0 * c.close);
        }
    }
}

/// Several transparent objects of one mesh, each with its own body, and an opaque one.
#[test]
fn bodies_side_by_side() {
    let mut bench = Bench::new();
    let glass = "medium = \"glass\", surfaces = \"two\"";
    let left = object("sphere-smooth", "phong", glass).replace("translate = [0.2,", "translate = [-1.0,");
    let right = object("sphere-smooth", "phong", &format!("{glass}, tint = [1.0, 0.5, 0.2]"))
        .replace("translate = [0.2,", "translate = [1.4,");
    let floor = object("cube", "flat", CLAY).replace("translate = [0.2, 0.1,", "translate = [0.2, -2.5,");
    bench.check("side by side", &scene_of(&format!("{left}{floor}{right}")), None);
}
