//! Scenes that decide whether a mistake shows at all, apart from those that the checker judges by.

use glam::{Quat, Vec3};
use gonio_check::comparison::pixel_difference;
use gonio_check::picture_judge::JudgeScenes;
use gonio_check::testbench::{Atlas, TestLight, TestScene};

/// A channel's difference that a person may see: three steps of 8 bits.
const SEEN: f32 = 3.0 / 255.0;
/// The share of an object's pixels that has to differ.
const SEEN_SHARE: f64 = 0.02;

/// The checker's scenes with the world turned, the light elsewhere, and other strengths and materials.
pub(super) fn own_scenes(judged: &[TestScene]) -> JudgeScenes {
    let turn = Quat::from_axis_angle(Vec3::new(0.3, 0.8, 0.5).normalize(), 1.1);
    let other = |(at, scene): (usize, &TestScene)| {
        let light = scene.light;
        let centre = scene.world_from_model.w_axis.truncate();
        let aside = Quat::from_rotation_y(0.6 + 0.4 * at as f32) * (light.position - centre);
        let light = TestLight {
            position: centre + 0.9 * aside,
            ambient: 0.2 + 0.05 * (at % 3) as f32,
            diffuse: 0.7,
            specular: 0.5,
            attenuation: light.attenuation.map(|k| 0.8 * k),
            ..light
        };
        let material = Vec3::new(0.7, 0.5, 0.9 - 0.1 * (at % 4) as f32);
        let (shininess, roughness) = (0.6 * scene.shininess + 2.0, (scene.roughness + 0.1).min(0.6));
        TestScene { light, material, shininess, roughness, refraction_index: 1.4, ..scene.clone() }.turned(turn)
    };
    let all: Vec<TestScene> = judged.iter().enumerate().map(other).collect();
    JudgeScenes { whole: all.len(), all }
}

/// Whether two programs draw visibly different pictures in one of the scenes.
pub(super) fn is_visible(a: &Atlas, b: &Atlas, scenes: usize) -> bool {
    (0..scenes).any(|tile| {
        let (mut drawn, mut seen) = (0_usize, 0_usize);
        for (p, q) in a.tile(tile).iter().zip(b.tile(tile)) {
            if Atlas::is_drawn(p) || Atlas::is_drawn(q) {
                drawn += 1;
                seen += usize::from(pixel_difference(p, q) > SEEN);
            }
        }
        seen as f64 > SEEN_SHARE * drawn.max(1) as f64
    })
}
