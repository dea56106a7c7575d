//! A scene without camera: everything is in the picture.

use glam::{DVec3, DVec4};
use gonio_light::{LightKind, vector::unit};
use gonio_scene::Scene;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::load::{describe, load};
use gonio_scene::settings::Aim;
use std::path::Path;

fn loaded(input: &str, change: impl Fn(&mut gonio_scene::SceneFile)) -> Scene {
    let mut scene = describe(&[input], &BuiltinOnly).unwrap();
    change(&mut scene);
    load(scene, Path::new(""), &BuiltinOnly).unwrap()
}

/// The largest |x|, |y| in normalised device coordinates over all vertices, and whether all lie between
/// near and far.
fn reach(scene: &Scene) -> (f64, f64, bool) {
    let frame = scene.frame(0.0);
    let aspect = f64::from(frame.width) / f64::from(frame.height);
    let clip_from_world = frame.camera.clip_from_view(aspect) * frame.camera.view_from_world();
    let (mut x, mut y, mut inside) = (0.0f64, 0.0f64, true);
    for object in &scene.objects {
        for p in &scene.meshes[object.mesh].positions {
            let world = object.world_from_model * DVec4::new(p[0].into(), p[1].into(), p[2].into(), 1.0);
            let clip = clip_from_world * world;
            let ndc = clip.truncate() / clip.w;
            (x, y) = (x.max(ndc.x.abs()), y.max(ndc.y.abs()));
            inside &= clip.w > 0.0 && ndc.z.abs() < 1.0;
        }
    }
    (x, y, inside)
}

#[test]
fn every_vertex_is_in_the_picture_and_the_picture_is_filled() {
    for input in ["builtin:suzanne", "builtin:still-life", "builtin:sphere-smooth", "builtin:cube"] {
        for (width, height) in [(1024, 768), (300, 900)] {
            for factor in [1e-3, 1.0, 1e4] {
                let scene = loaded(input, |s| {
                    (s.picture.width, s.picture.height) = (width, height);
                    s.objects[0].scale = [factor; 3];
                    s.objects[0].translate = [5.0 * factor, 0.0, -2.0 * factor];
                });
                let (x, y, inside) = reach(&scene);
                // 0.92 is wanted; the rounding of the printed numbers takes the rest.
                assert!(inside && x < 0.95 && y < 0.95, "{input} {width}x{height} {factor}: {x} {y} {inside}");
                assert!(x.max(y) > 0.88, "{input} {width}x{height} {factor}: {x} {y}");
                let camera = scene.frame(0.0).camera;
                assert!(camera.far / camera.near < 1.001e4);
            }
        }
    }
}

#[test]
fn what_is_given_stays_and_the_rest_follows() {
    let by_target = loaded("builtin:suzanne", |s| s.camera.target = Some([0.5, 0.0, 0.0]));
    assert_eq!(by_target.settings.camera.target(), Some([0.5, 0.0, 0.0]));
    let (x, y, inside) = reach(&by_target);
    assert!(inside && x.max(y) < 0.95);

    let by_angles = loaded("builtin:suzanne", |s| s.camera.yaw = Some(0.0));
    let camera = by_angles.frame(0.0).camera;
    assert!(camera.front.abs_diff_eq(DVec3::X, 1e-12), "yaw 0 looks along +X");
    assert_eq!(by_angles.settings.camera.aim, Aim::Angles { yaw: 0.0, pitch: 0.0 });
    let (x, y, inside) = reach(&by_angles);
    assert!(inside && x.max(y) < 0.95);

    let by_position = loaded("builtin:suzanne", |s| s.camera.position = Some([9.0, 0.0, 0.0]));
    let (min, max) = by_position.bounds();
    let toward = unit(0.5 * (min + max) - DVec3::new(9.0, 0.0, 0.0)).unwrap();
    assert!(by_position.frame(0.0).camera.front.abs_diff_eq(toward, 1e-12));

    let z_up = loaded("builtin:suzanne", |s| s.camera.up = Some([0.0, 0.0, 1.0]));
    assert!(z_up.frame(0.0).camera.up.z > 0.9 && reach(&z_up).2);
}

#[test]
fn the_light_is_a_portraits() {
    let scene = loaded("builtin:suzanne", |_| ());
    let frame = scene.frame(0.0);
    let center = 0.5 * (frame.bounds_min + frame.bounds_max);
    let names: Vec<&str> = scene.settings.lights.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["key", "fill", "rim", "ambient"]);
    // A white wall in the middle that faces the key: lit by about 0.8 to 0.9 in all, never blown out.
    let LightKind::Point { position } = frame.lights[0].kind else { panic!("the key is a point light") };
    let n = unit(position - center).unwrap();
    let lit: DVec3 = frame
        .lights
        .iter()
        .map(|l| match l.incident(center, n) {
            None => l.color,
            Some(i) => l.color * i.attenuation * n.dot(i.direction).max(0.0),
        })
        .sum();
    assert!(lit.min_element() > 0.75 && lit.max_element() < 0.92, "{lit}");
    // Key from the upper left front, rim from behind and above: as seen by the camera.
    let c = frame.camera;
    assert!(n.dot(c.right) < -0.3 && n.dot(c.up) > 0.3 && n.dot(-c.front) > 0.3);
    let LightKind::Directional { direction } = frame.lights[2].kind else { panic!("the rim is directional") };
    assert!(direction.dot(-c.front) > 0.3 && direction.dot(c.up) < -0.3);
}

#[test]
fn bounds_hold_every_transformed_vertex_tightly() {
    let scene = loaded("builtin:cube", |s| {
        s.objects[0].scale = [1.0, 2.0, 3.0];
        s.objects[0].rotate = [0.0, 90.0, 0.0];
        s.objects[0].translate = [10.0, 0.0, 0.0];
    });
    let (min, max) = scene.bounds();
    assert!(min.abs_diff_eq(DVec3::new(7.0, -2.0, -1.0), 1e-9) && max.abs_diff_eq(DVec3::new(13.0, 2.0, 1.0), 1e-9));
}
