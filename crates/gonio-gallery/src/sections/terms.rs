//! The whole equation in two pictures at the top, then each of its terms alone, and their sum.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_scene::SceneFile;
use gonio_scene::scene_file::LightSourceKind;

const WHOLE: &str = "L_o = A + E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i spot_i";

/// The still life and Suzanne.
pub fn whole_section() -> Result<Section, GalleryError> {
    let still_life = Exhibit::new("still-life", "A still life by the whole equation", BaseScene::StillLife.scene()?)
        .aspect(1.72)
        .remark("a warm key, a cold rim, an ember that emits and lights what is around it")
        .about(
            WHOLE,
            "Four lights and an emitting body. The ember's E is the same from everywhere; the point light in its \
             middle is what falls on the floor and the donut, and fades with att.",
        );
    let suzanne = Exhibit::new("suzanne", "Suzanne in bronze", BaseScene::Suzanne.scene()?)
        .remark("15 744 triangles, a normal for every fragment")
        .about(
            WHOLE,
            "Key, rim and kicker: three point lights that differ in colour show which part of the surface faces which.",
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
        equation: "L_o = A + E + Σ_i diff_i + Σ_i spec_i",
        introduction: "Every term can be switched off. Four pictures with one term each, and all of them together: \
                       light adds.",
        rows: vec![vec![
            only(
                "term-ambient",
                "A",
                "ambient",
                None,
                [true, false, false, false],
                "L_o = !{A} ~{+ E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i}",
                "k_a times the ambient colour: no direction, so no form. Only colours and textures are seen.",
            )?,
            only(
                "term-emitted",
                "E",
                "emitted",
                Some("+"),
                [false, true, false, false],
                "L_o = ~{A +} !{E} ~{+ Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i}",
                "What a body sends out by itself. It lights nothing else: for that a light has to stand there.",
            )?,
            only(
                "term-diffuse",
                "diffuse",
                "diff k_d ⟨N·L⟩",
                Some("+"),
                [false, false, true, false],
                "L_o = ~{A + E +} Σ_i [ !{diff k_d ⟨N·L_i⟩} ~{+ k_s spec_i} ] L_i att_i",
                "Form appears: brightness follows the angle between N and L, and does not depend on the eye.",
            )?,
            only(
                "term-specular",
                "specular",
                "k_s ⟨N·H⟩^g",
                Some("+"),
                [false, false, false, true],
                "L_o = ~{A + E +} Σ_i [ ~{diff k_d ⟨N·L_i⟩ +} !{k_s spec_i} ] L_i att_i",
                "Mirror images of the lights, as wide as the shininess allows. Move the eye and they move too.",
            )?,
            only(
                "term-sum",
                "L_o",
                "the sum",
                Some("="),
                [true, true, true, true],
                "L_o = !{A + E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i}",
                "The four pictures before, added in linear light, then tone mapped and encoded.",
            )?,
        ]],
    })
}

fn keep(scene: &mut SceneFile, [ambient, emitted, diffuse, specular]: [bool; 4]) {
    let equation = &mut scene.equation;
    (equation.ambient, equation.emitted) = (ambient, emitted);
    (equation.diffuse, equation.specular_term) = (diffuse, specular);
    // Alone, the ambient term has to be bright enough to be looked at.
    for light in scene.lights.iter_mut().filter(|l| l.kind == LightSourceKind::Ambient) {
        light.intensity = Some(0.16);
    }
}
