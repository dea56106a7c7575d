//! The camera and its matrices.

use crate::bench::Bench;
use egui_kittest::kittest::Queryable;
use gonio_app::session::Tab;

#[test]
fn yaw_and_pitch_turn_the_eye_where_it_stands() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Camera);
    let before = bench.document().scene.camera.to_camera();
    bench.type_into("camera-yaw", "-90");
    bench.type_into("camera-pitch", "0");
    let after = bench.document().scene.camera.to_camera();
    assert_eq!(after.position, before.position);
    // Sines of degrees in f64.
    assert!((after.front - glam::DVec3::NEG_Z).length() < 1e-9, "{}", after.front);
}

#[test]
fn a_camera_always_looks_somewhere() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Camera);
    let [x, y, z] = bench.document().scene.camera.position;
    for (axis, value) in [("x", x), ("y", y), ("z", z)] {
        bench.type_into(&format!("camera-target-{axis}"), &value.to_string());
    }
    let camera = &bench.document().scene.camera;
    assert_ne!(Some(camera.position), camera.target());
    bench.type_into("camera-up-y", "0");
    assert_eq!(bench.document().scene.camera.up, [0.0, 1.0, 0.0]);
    let far = bench.document().scene.camera.far;
    bench.type_into("camera-near", "1e6");
    let camera = &bench.document().scene.camera;
    assert!(camera.near < camera.far && camera.far == far);
}

/// The rows of V are Right, Up and -Front, and what is shown are its numbers.
#[test]
fn the_view_matrix_is_shown_row_by_row() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Camera);
    let camera = bench.document().scene.camera.to_camera();
    let names = ["Right", "Up", "\u{2212}Front"];
    let rows = [camera.right, camera.up, -camera.front];
    for (name, row) in names.into_iter().zip(rows) {
        assert!(bench.harness.query_all_by_label(name).count() > 0, "{name}");
        for entry in row.to_array() {
            let text = format!("{entry:8.3}").replace("  -0.000", "   0.000");
            let shown = if entry == 0.0 { "   0    ".to_owned() } else { text };
            assert!(bench.harness.query_all_by_label(&shown).count() > 0, "{name}: `{shown}`");
        }
    }
    bench.type_into("camera-fov", "90");
    // 1 / tan(45 degrees)
    assert!(bench.harness.query_all_by_label("   1.000").count() > 0);
}
