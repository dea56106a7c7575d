//! The camera's matrices against glam's own.

use glam::{DVec3, DVec4};
use gonio_scene::Camera;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::load::{describe, load, world_from_model};
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
fn a_ray_goes_where_the_projection_says() {
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
    // A camera that was asked for stays.
    let mut scene = describe(&["builtin:cube"], &BuiltinOnly).unwrap();
    scene.camera.position = Some([0.0, 0.0, 3.0]);
    let loaded = load(scene, Path::new(""), &BuiltinOnly).unwrap();
    assert_eq!(loaded.orbit_start(&loaded.frame(0.0)), loaded.frame(0.0));
}
