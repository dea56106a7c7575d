//! Lights that move, at times whose places are known.

use glam::DVec3;
use gonio_scene::motion::position_at;
use gonio_scene::scene_file::LightSpec;
use gonio_scene::settings::Motion;

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
