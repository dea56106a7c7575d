//! Lamps with an extent, in a frame, and spectra.

use glam::DVec3;
use gonio_light::observer::{COLORIMETRY, daylight, matching};
use gonio_light::{LightKind, Spectrum};
use gonio_scene::color_value::Color;
use gonio_scene::edit::{self, Edited};
use gonio_scene::files::BuiltinOnly;
use gonio_scene::load::{describe, load};
use gonio_scene::toml_file::read;
use gonio_scene::{Frame, LightShape, Scene};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

fn loaded(text: &str) -> Scene {
    let scene = read(&format!("{text}\n[[object]]\nmodel = \"builtin:cube\"\n")).unwrap();
    load(scene, Path::new(""), &BuiltinOnly).unwrap()
}

/// The frame of a scene with one rectangle that is 4 wide and 2 high.
fn with_rectangle(up: [f64; 3], direction: [f64; 3]) -> Frame {
    let light =
        format!("[[light]]\nkind = \"rectangle\"\nposition = [1, 2, 3]\nsize = [4, 2]\ndirection = {direction:?}");
    loaded(&format!("camera = {{ up = {up:?} }}\n{light}")).frame(0.0)
}

#[test]
fn point_lights_and_spots_may_be_spheres() {
    let lights = "[[light]]\nkind = \"ambient\"\n\
                  [[light]]\nkind = \"directional\"\ndirection = [0, -1, 0]\n\
                  [[light]]\nkind = \"point\"\nposition = [0, 1, 0]\nradius = 0.5\n\
                  [[light]]\nkind = \"point\"\nposition = [0, 1, 0]\nradius = 0\n\
                  [[light]]\nkind = \"spot\"\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\nradius = 2\nenabled = false\n";
    let frame = loaded(lights).frame(0.0);
    let point = LightShape::Point;
    let sphere = |radius| LightShape::Sphere { radius };
    assert_eq!(frame.light_shapes, [point, point, sphere(0.5), point, sphere(2.0)]);
    assert_eq!(frame.lights.len(), frame.light_shapes.len());
}

/// The light equation sees a spot at the centre, whose factor is near the cosine.
#[test]
fn a_rectangle_is_a_wide_spot_at_its_centre() {
    let frame = with_rectangle([0.0, 1.0, 0.0], [0.0, 0.0, -2.0]);
    let spot = LightKind::Spot {
        position: DVec3::new(1.0, 2.0, 3.0),
        axis: DVec3::NEG_Z,
        inner_rad: 0.0,
        outer_rad: FRAC_PI_2,
    };
    assert_eq!(frame.lights[0].kind, spot);
    for degrees in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 89.0_f64] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let to_light = DVec3::new(sin, 0.0, cos);
        let spot = frame.lights[0].incident(DVec3::new(1.0, 2.0, 3.0) - to_light, DVec3::Z).unwrap().spot;
        // 3 c^2 - 2 c^3 is within 0.1 of c.
        assert!((spot - cos).abs() < 0.1, "{degrees}: {spot} and {cos}");
    }
    let behind = frame.lights[0].incident(DVec3::new(1.0, 2.0, 4.0), DVec3::Z).unwrap();
    assert_eq!(behind.spot, 0.0);
}

#[test]
fn the_width_of_a_rectangle_is_horizontal() {
    let ups = [DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.8, 0.0)];
    let directions = [
        DVec3::NEG_Z,
        DVec3::NEG_Y,
        DVec3::Y,
        DVec3::X,
        DVec3::NEG_X,
        DVec3::new(0.6, 0.8, 0.0),
        DVec3::new(0.3, -0.9, 0.2),
        DVec3::new(1e-12, -1.0, 0.0),
    ];
    for up in ups {
        for direction in directions {
            let frame = with_rectangle(up.to_array(), direction.to_array());
            let LightShape::Rectangle { half_right, half_up } = frame.light_shapes[0] else { panic!("no rectangle") };
            let what = format!("up {up}, direction {direction}: {half_right} and {half_up}");
            assert!((half_right.length() - 2.0).abs() < 1e-9 && (half_up.length() - 1.0).abs() < 1e-9, "{what}");
            assert!(half_right.cross(half_up).normalize().abs_diff_eq(direction.normalize(), 1e-9), "{what}");
            assert!(half_right.dot(up).abs() < 1e-9 && half_up.dot(up) > -1e-9, "{what}");
        }
    }
    // Whoever stands at +z and looks along -z has +x on the right; the lamp faces them.
    let frame = with_rectangle([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(frame.light_shapes[0], LightShape::Rectangle { half_right: 2.0 * DVec3::X, half_up: DVec3::Y });
}

#[test]
fn colours_are_derived_from_spectra() {
    let text = "[[light]]\nkind = \"point\"\nposition = [0, 1, 0]\nintensity = 2\nspectrum = [[580, 0], [589, 1], [600, 0]]\n\
                [[object]]\nmodel = \"builtin:sphere-512\"\nmaterial = { diffuse_spectrum = [[400, 0.1], [500, 0.1], [600, 0.9]] }";
    let scene = loaded(text);
    let sodium = scene.settings.lights[0].spectrum.clone().unwrap();
    let color = sodium.color_of_light().unwrap();
    assert!(color.x > 2.0 * color.y && color.y > 0.5 && color.z < 1e-9, "{color}");
    assert_eq!(scene.frame(0.0).lights[0].color, 2.0 * color);
    let painted = scene.materials.iter().find(|m| m.diffuse_spectrum.is_some()).unwrap();
    let surface = painted.diffuse_spectrum.as_ref().unwrap().color_of_surface();
    assert_eq!(painted.material.diffuse, surface.as_vec3().to_array());
    assert!(surface.x > 0.6 && surface.z < 0.2, "{surface}");

    // Whoever edits a colour replaces the spectrum.
    let mut settings = scene.settings.clone();
    settings.lights[0].color = Color::grey(0.5);
    settings.objects[0].material.diffuse = Some(Color::grey(0.25));
    let Edited::Done(edited) = edit::apply(&scene, settings).unwrap() else { panic!("no file is needed") };
    assert_eq!(edited.loaded.settings.lights[0].spectrum, None);
    assert_eq!(edited.loaded.settings.objects[0].material.diffuse_spectrum, None);
    // Whoever edits something else keeps it.
    let mut settings = scene.settings.clone();
    settings.lights[0].intensity = 3.0;
    let Edited::Done(edited) = edit::apply(&scene, settings).unwrap() else { panic!("no file is needed") };
    assert_eq!(edited.loaded.settings.lights[0].spectrum, Some(sodium));
}

/// CIELAB (CIE 15, equations 8.3 to 8.5) of a surface under a light whose power is a function of the wavelength, nm, with
/// D65 as its white.
fn lab(surface: &Spectrum, light: impl Fn(f64) -> f64) -> DVec3 {
    let lambdas = || (0..=4000).map(|i| 380.0 + 0.1 * f64::from(i));
    let luminance: f64 = lambdas().map(|l| light(l) * matching(l).y).sum();
    let xyz: DVec3 = lambdas().map(|l| matching(l) * light(l) * surface.reflectance_at(l)).sum::<DVec3>() / luminance;
    let white = COLORIMETRY.rgb_from_xyz.inverse() * DVec3::ONE;
    let f = |t: f64| if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 };
    let [x, y, z] = (xyz / white).to_array().map(f);
    DVec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

#[test]
fn the_metamers_are_equal_in_daylight_and_differ_under_their_lamp() {
    let file = describe(&["builtin:hard-to-simplify"], &BuiltinOnly).unwrap();
    let scene = load(file, Path::new(""), &BuiltinOnly).unwrap();
    let spectra: Vec<&Spectrum> = scene.materials.iter().filter_map(|m| m.diffuse_spectrum.as_deref()).collect();
    let [a, b] = spectra[..] else { panic!("there are two: {}", spectra.len()) };
    let lamp = scene.settings.lights[0].spectrum.clone().unwrap();
    let by_day = lab(a, daylight).distance(lab(b, daylight));
    let under_lamp = lab(a, |l| lamp.power_at(l)).distance(lab(b, |l| lamp.power_at(l)));
    // A difference of 1 is about the smallest that is seen.
    assert!(by_day < 1.0 && under_lamp > 50.0, "{by_day} and {under_lamp}");
    // Whoever knows only RGB sees two equal spheres under a white lamp.
    assert!((a.color_of_surface() - b.color_of_surface()).abs().max_element() < 2e-3);
    assert!((lamp.color_of_light().unwrap() - 1.0).abs().max_element() < 0.02, "{:?}", lamp.color_of_light());
    // Both move.
    assert_eq!(scene.settings.objects.iter().filter(|o| o.motion.is_some()).count(), 2);
}
