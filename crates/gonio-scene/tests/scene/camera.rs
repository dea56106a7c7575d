//! Cameras, framing of models, and lights and objects that move.

use glam::{DVec3, DVec4};
use gonio_light::LightKind;
use gonio_light::vector::unit;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::frame::position_at;
use gonio_scene::load::{describe, load};
use gonio_scene::scene::world_from_model;
use gonio_scene::scene_file::LightSpec;
use gonio_scene::settings::{Aim, Motion};
use gonio_scene::{Camera, Frame, Scene};
use std::path::Path;

/// Set by rounding: both sides are a few operations on numbers near 1.
const EXACT: f64 = 1e-12;

fn camera() -> Camera {
    let (position, target) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-0.5, 0.25, -1.0));
    Camera::looking_along(position, target - position, DVec3::Y, 0.7, 0.1, 50.0)
}

#[test]
fn matrices_are_those_of_opengl() {
    let c = camera();
    let view = glam::dcamera::rh::view::look_at_mat4(c.position, c.position + c.front, DVec3::Y);
    assert!(c.view_from_world().abs_diff_eq(view, EXACT));
    let projection = glam::dcamera::rh::proj::opengl::perspective(0.7, 1.6, 0.1, 50.0);
    assert!(c.clip_from_view(1.6).abs_diff_eq(projection, EXACT));
}

#[test]
fn a_ray_agrees_with_the_projection() {
    let c = camera();
    let (width, height) = (640, 400);
    for (x, y) in [(0.5, 0.5), (320.0, 200.0), (600.25, 10.75)] {
        let point = c.position + 7.0 * c.ray_direction(x, y, width, height);
        let clip = c.clip_from_view(1.6) * c.view_from_world() * DVec4::from((point, 1.0));
        let ndc = clip.truncate() / clip.w;
        assert!((0.5 * (ndc.x + 1.0) * 640.0 - x).abs() < 1e-9 && (0.5 * (1.0 - ndc.y) * 400.0 - y).abs() < 1e-9);
        assert!((clip.w - c.depth_of(point)).abs() < EXACT * 100.0);
    }
}

#[test]
fn yaw_and_pitch_are_the_labs() {
    assert!(Camera::direction_of(-90.0, 0.0).abs_diff_eq(DVec3::NEG_Z, EXACT));
    assert!(Camera::direction_of(0.0, 0.0).abs_diff_eq(DVec3::X, EXACT));
    assert!(Camera::direction_of(10.0, 90.0).abs_diff_eq(DVec3::Y, EXACT));
    let c = Camera::looking_along(DVec3::ZERO, Camera::direction_of(-30.0, 20.0), DVec3::Y, 1.0, 0.1, 1.0);
    let (yaw, pitch) = c.yaw_pitch_deg();
    assert!((yaw + 30.0).abs() < 1e-9 && (pitch - 20.0).abs() < 1e-9);
}

#[test]
fn objects_turn_about_x_then_y_then_z() {
    let mut scene = describe(&["builtin:cube"], &BuiltinOnly).unwrap();
    let object = &mut scene.objects[0];
    object.rotate = [90.0, 90.0, 0.0];
    object.scale = [2.0, 3.0, 4.0];
    object.translate = [10.0, 20.0, 30.0];
    let m = world_from_model(object);
    // x: scaled to 2x; x stays; about y by 90 becomes -z.
    assert!(m.transform_vector3(DVec3::X).abs_diff_eq(DVec3::new(0.0, 0.0, -2.0), 1e-9));
    // y: about x by 90 becomes z; about y by 90 becomes x.
    assert!(m.transform_vector3(DVec3::Y).abs_diff_eq(DVec3::new(3.0, 0.0, 0.0), 1e-9));
    assert_eq!(m.w_axis.truncate(), DVec3::new(10.0, 20.0, 30.0));
}

#[test]
fn an_orbit_keeps_the_distance_and_the_target() {
    let scene = describe(&["builtin:cube"], &BuiltinOnly).unwrap();
    let loaded = load(scene, Path::new(""), &BuiltinOnly).unwrap();
    let frame = loaded.frame(0.0);
    let target = DVec3::from(loaded.settings.camera.target().unwrap());
    let turned = loaded.orbit(&frame, 1.0);
    let (before, after) = (frame.camera.position - target, turned.camera.position - target);
    assert!((before.length() - after.length()).abs() < 1e-9 && (before.y - after.y).abs() < 1e-9);
    let angle = before.reject_from(DVec3::Y).angle_between(after.reject_from(DVec3::Y));
    assert!((angle - 1.0).abs() < 1e-9);
    assert!((after - before).dot(frame.camera.right) > 0.0, "to the right");
    assert!(turned.camera.front.cross(target - turned.camera.position).length() < 1e-9);
    assert!(loaded.orbit(&frame, std::f64::consts::TAU).camera.position.abs_diff_eq(frame.camera.position, 1e-9));
}

/// Whether every corner of every mesh lies in the picture, between near and far.
fn all_in_picture(loaded: &gonio_scene::Scene, frame: &gonio_scene::Frame) -> bool {
    let aspect = f64::from(frame.width) / f64::from(frame.height);
    let clip = frame.camera.clip_from_view(aspect) * frame.camera.view_from_world();
    loaded.objects.iter().all(|object| {
        loaded.meshes[object.mesh].positions.iter().all(|&p| {
            let world = object.world_from_model.transform_point3(DVec3::from(p.map(f64::from)));
            let c: DVec4 = clip * world.extend(1.0);
            c.w > 0.0 && c.x.abs() <= c.w && c.y.abs() <= c.w && c.z.abs() <= c.w
        })
    })
}

#[test]
fn a_framed_orbit_has_everything_in_the_picture_from_every_side() {
    for name in ["builtin:suzanne", "builtin:still-life"] {
        let loaded = load(describe(&[name], &BuiltinOnly).unwrap(), Path::new(""), &BuiltinOnly).unwrap();
        let frame = loaded.frame(0.0);
        let around = |start: &gonio_scene::Frame| {
            (0..24).all(|i| all_in_picture(&loaded, &loaded.orbit(start, std::f64::consts::TAU * f64::from(i) / 24.0)))
        };
        assert!(!around(&frame), "{name}: the plain frame is tight, or this tests nothing");
        assert!(around(&loaded.orbit_start(&frame)), "{name}");
    }
    // A camera with a position stays.
    let mut scene = describe(&["builtin:cube"], &BuiltinOnly).unwrap();
    scene.camera.position = Some([0.0, 0.0, 3.0]);
    let loaded = load(scene, Path::new(""), &BuiltinOnly).unwrap();
    assert_eq!(loaded.orbit_start(&loaded.frame(0.0)), loaded.frame(0.0));
}

/// Samples show the same objects in windows of every usual shape.
#[test]
fn a_sample_is_in_the_picture_whatever_its_shape() {
    let mut moved = 0;
    for name in gonio_scene::files::builtin_names() {
        let input = format!("builtin:{name}");
        let loaded = load(describe(&[&input], &BuiltinOnly).unwrap(), Path::new(""), &BuiltinOnly).unwrap();
        let own = &loaded.settings.camera;
        // Floors and walls extend beyond the picture.
        let subject = |frame: &Frame| {
            let alone = |object: &gonio_scene::Object| Scene { objects: vec![object.clone()], ..loaded.clone() };
            loaded.objects.iter().filter(|object| all_in_picture(&alone(object), frame)).count()
        };
        let whole = subject(&loaded.frame(0.0));
        assert!(whole > 0 || name == "light-kinds", "{name}: nothing is whole in its own picture");
        for (width, height) in [(928, 626), (1984, 1266), (640, 300), (390, 366), (300, 600)] {
            let aspect = f64::from(width) / f64::from(height);
            let camera = loaded.with_all_in(own, aspect);
            moved += usize::from(camera != *own);
            let frame = Frame { width, height, camera: camera.to_camera(), ..loaded.frame(0.0) };
            assert!(subject(&frame) >= whole, "{name} at {width} x {height}: {} of {whole}", subject(&frame));
            // Positions are rounded to about a thousandth of the radius.
            let turned = (camera.to_camera().front - own.to_camera().front).length();
            assert!(turned < 2e-3, "{name}: the direction stays, but for {turned}");
        }
    }
    assert!(moved > 7, "upright pictures are narrower than those of the samples: {moved}");
}

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
                // The margin is 0.92; the rest is the rounding of the printed numbers.
                assert!(inside && x < 0.95 && y < 0.95, "{input} {width}x{height} {factor}: {x} {y} {inside}");
                assert!(x.max(y) > 0.88, "{input} {width}x{height} {factor}: {x} {y}");
                let camera = scene.frame(0.0).camera;
                assert!(camera.far / camera.near < 1.001e4);
            }
        }
    }
}

#[test]
fn given_values_stay_and_the_rest_is_chosen() {
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
fn the_default_light_is_a_portrait_rig() {
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

fn motion(text: &str) -> (Motion, DVec3) {
    let light = LightSpec::from_option_text(text).unwrap();
    (light.motion.unwrap().into(), light.position.unwrap_or_default().into())
}

#[track_caller]
fn at(text: &str, time: f64, expected: [f64; 3]) {
    let (motion, position) = motion(text);
    let got = position_at(&motion, position, time);
    assert!(got.abs_diff_eq(expected.into(), 1e-12), "{text} at {time}: {got}");
}

#[test]
fn oscillate() {
    let text = "point position=1,2,1.5 motion=oscillate period=4 amplitude=0,0,2";
    at(text, 0.0, [1.0, 2.0, 1.5]);
    at(text, 1.0, [1.0, 2.0, 3.5]);
    at(text, 3.0, [1.0, 2.0, -0.5]);
    at(text, -1.0, [1.0, 2.0, -0.5]);
    at(text, 4.0 / 12.0, [1.0, 2.0, 2.5]);
}

#[test]
fn circle() {
    let text = "point position=2,5,0 motion=circle period=4 center=0,5,0";
    at(text, 0.0, [2.0, 5.0, 0.0]);
    // Right-handed about +y: from +x towards -z.
    at(text, 1.0, [0.0, 5.0, -2.0]);
    at(text, 2.0, [-2.0, 5.0, 0.0]);
    at("point position=2,0,1 motion=circle period=4 center=0,0,0 axis=0,0,-3", 1.0, [0.0, -2.0, 1.0]);
}

#[test]
fn path() {
    // A closed path of length 3 + 4 + 5: constant speed, one unit a second.
    let text = "point motion=path period=12 points=0,0,0;3,0,0;3,4,0";
    at(text, 0.0, [0.0, 0.0, 0.0]);
    at(text, 1.5, [1.5, 0.0, 0.0]);
    at(text, 5.0, [3.0, 2.0, 0.0]);
    at(text, 9.5, [1.5, 2.0, 0.0]);
    at(text, 12.0, [0.0, 0.0, 0.0]);
    at(text, -5.0, [3.0, 4.0, 0.0]);
    at("point motion=path period=1 points=1,2,3;1,2,3", 0.3, [1.0, 2.0, 3.0]);
}

const MOVING: &str = "[[object]]\nmodel = \"builtin:cube\"\ntranslate = [1, 2, 3]\nrotate = [0, 30, 0]\nscale = [2, 1, 1]\n\
                      motion = { kind = \"oscillate\", period = 4, amplitude = [0, 0, 50] }\n\
                      [[object]]\nmodel = \"builtin:cube\"\n\
                      [[object]]\nmodel = \"builtin:cube\"\n\
                      motion = { kind = \"path\", period = 2, points = [[5, 0, 0], [7, 0, 0]] }\n";

fn moving() -> Scene {
    load(gonio_scene::toml_file::read(MOVING).unwrap(), Path::new(""), &BuiltinOnly).unwrap()
}

#[test]
fn objects_move_and_keep_their_rotation_and_scale() {
    let scene = moving();
    assert!(scene.has_moving_objects() && !loaded("builtin:cube", |_| ()).has_moving_objects());
    let places = |scene: &Scene| scene.objects.iter().map(|o| o.world_from_model.w_axis.truncate()).collect::<Vec<_>>();
    let start = [DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO, DVec3::new(5.0, 0.0, 0.0)];
    assert_eq!(places(&scene), start);
    assert_eq!(places(&scene.at(0.0)), start);
    let later = scene.at(1.0);
    let expected = [DVec3::new(1.0, 2.0, 53.0), DVec3::ZERO, DVec3::new(7.0, 0.0, 0.0)];
    assert!(places(&later).iter().zip(expected).all(|(a, b)| a.abs_diff_eq(b, 1e-12)), "{:?}", places(&later));
    for (a, b) in later.objects.iter().zip(&scene.objects) {
        let linear = |o: &gonio_scene::Object| glam::DMat3::from_mat4(o.world_from_model);
        assert_eq!(linear(a), linear(b));
    }
    // Nothing is copied, and another moment can be taken from any.
    assert!(later.meshes.iter().zip(&scene.meshes).all(|(a, b)| std::sync::Arc::ptr_eq(a, b)));
    assert_eq!(places(&later.at(0.0)), start);
    // The boxes are those of the moment.
    assert!((scene.bounds().1.z, later.bounds().1.z) < (10.0, 60.0) && later.bounds().1.z > 50.0);
    assert_eq!(later.frame(1.0).bounds_max, later.bounds().1);
}

/// The planes that are chosen for a camera are those of the whole motion.
#[test]
fn nothing_that_moves_is_cut_off() {
    let scene = moving();
    for step in 0..16 {
        let moved = scene.at(0.25 * f64::from(step));
        let frame = moved.frame(0.0);
        let (min, max) = moved.bounds();
        let farthest = (0..8).map(|i| {
            let pick = |axis: usize| if i >> axis & 1 == 1 { max[axis] } else { min[axis] };
            frame.camera.depth_of(DVec3::new(pick(0), pick(1), pick(2)))
        });
        assert!(farthest.fold(0.0, f64::max) < frame.camera.far, "{step}");
    }
}

#[test]
fn a_path_moves_with_its_object() {
    let mut object = moving().settings.objects[2].clone();
    assert_eq!(object.translate, [5.0, 0.0, 0.0], "it starts at the first point");
    object.move_to([5.0, 1.0, 0.0]);
    assert_eq!(object.translate, [5.0, 1.0, 0.0]);
    assert_eq!(object.motion.unwrap().points, Some(vec![[5.0, 1.0, 0.0], [7.0, 1.0, 0.0]]));
}
