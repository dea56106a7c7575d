//! The whole equation in two pictures at the top, then each of its terms alone, and their sum.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_scene::SceneFile;
use gonio_scene::scene_file::LightSourceKind;

const WHOLE: &str = "L_o = A + E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i spot_i";

/// The still life and Suzanne, by the whole equation.
pub fn whole_section() -> Result<Section, GalleryError> {
    let still_life = Exhibit::new("still-life", "A still life by the whole equation", BaseScene::StillLife.scene()?)
        .aspect(1.72)
        .remark("a warm key light, a cold rim light, and an ember that emits light")
        .about(
            WHOLE,
            "Four lights and an emitting body. The ember's E is the same from every direction; a point light in its \
             middle lights the floor and the donut, and decreases with att.",
        );
    let suzanne = Exhibit::new("suzanne", "Suzanne in bronze", BaseScene::Suzanne.scene()?)
        .remark("15 744 triangles, a normal for every fragment")
        .about(
            WHOLE,
            "Key, rim and kicker: three point lights of different colours show which way each part of the surface faces.",
        );
    Ok(Section { id: "whole", title: "", equation: WHOLE, introduction: "", rows: vec![vec![still_life, suzanne]] })
}

/// A, E, the diffuse and the specular term, and L.
pub fn section() -> Result<Section, GalleryError> {
    let only = |name: &str, caption: &str, remark: &str, joiner, terms: [bool; 4], equation: &str, look: &str| {
        let scene = BaseScene::StillLife.with(|scene| {
            keep(scene, terms);
            scene.camera.fov_y = Some(29.5);
        })?;
        Ok::<_, GalleryError>(
            Exhibit::new(name, caption, scene).remark(remark).aspect(1.45).joined(joiner).about(equation, look),
        )
    };
    Ok(Section {
        id: "terms",
        title: "The terms",
        equation: "L_o = A + E + diffuse + specular",
        introduction: "Every term can be switched off. Four pictures with one term each, and all of them together: \
                       light adds.",
        rows: vec![vec![
            only(
                "term-ambient",
                "A",
                "ambient",
                None,
                [true, false, false, false],
                "L_o = !{A} ~{+ E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i spot_i}",
                "k_a times the ambient colour: no direction, so no shape. Only colours and textures are visible.",
            )?,
            only(
                "term-emitted",
                "E",
                "emitted",
                Some("+"),
                [false, true, false, false],
                "L_o = ~{A +} !{E} ~{+ Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i spot_i}",
                "The light that a body emits itself. It does not light other bodies; that takes a light source.",
            )?,
            only(
                "term-diffuse",
                "diffuse",
                "diff k_d ⟨N·L⟩",
                Some("+"),
                [false, false, true, false],
                "L_o = ~{A + E +} Σ_i [ !{diff k_d ⟨N·L_i⟩} ~{+ k_s spec_i} ] L_i att_i spot_i",
                "The shape appears: brightness follows the angle between N and L, and does not depend on the eye.",
            )?,
            only(
                "term-specular",
                "specular",
                "k_s ⟨N·H⟩^g",
                Some("+"),
                [false, false, false, true],
                "L_o = ~{A + E +} Σ_i [ ~{diff k_d ⟨N·L_i⟩ +} !{k_s spec_i} ] L_i att_i spot_i",
                "Highlights: blurred reflections of the lights, narrower with higher shininess. They move with the eye.",
            )?,
            only(
                "term-sum",
                "L_o",
                "the sum",
                Some("="),
                [true, true, true, true],
                "L_o = !{A + E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i spot_i}",
                "The four pictures before, added in linear light, then tone mapped and encoded.",
            )?,
        ]],
    })
}

fn keep(scene: &mut SceneFile, [ambient, emitted, diffuse, specular]: [bool; 4]) {
    let equation = &mut scene.equation;
    (equation.ambient, equation.emitted) = (ambient, emitted);
    (equation.diffuse, equation.specular_term) = (diffuse, specular);
    // Alone, the ambient term must be bright enough to be visible.
    for light in scene.lights.iter_mut().filter(|l| l.kind == LightSourceKind::Ambient) {
        light.intensity = Some(0.16);
    }
}
