//! The specular term: models, conventions and exponents.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::{Convention, Specular};
use gonio_scene::scene_file::{EquationSpec, SceneFile};
use std::f64::consts::PI;

/// Two rows: the choices on Suzanne, the exponents on a sphere.
pub fn section() -> Result<Section, GalleryError> {
    let mut exponents = Vec::new();
    for (specular, word, equation) in [
        (Specular::Phong, "Phong", "spec = ⟨R·V⟩^{!{g}},  R = 2 (N·L) N − L"),
        (Specular::BlinnPhong, "Blinn–Phong", "spec = ⟨N·H⟩^{!{g}},  H = \\f{L + V}{|L + V|}"),
    ] {
        for gamma in [4.0, 32.0, 256.0] {
            exponents.push(exponent(specular, word, gamma, equation)?);
        }
    }
    Ok(Section {
        id: "specular",
        title: "The specular term",
        equation: "Phong ⟨R·V⟩^g,   Blinn–Phong ⟨N·H⟩^g",
        introduction: "Phong compares the mirrored light with the eye, Blinn and Phong the half vector with the normal. \
                       At the same exponent Blinn–Phong's highlight is about twice as wide.",
        rows: vec![choices()?, exponents],
    })
}

fn choices() -> Result<Vec<Exhibit>, GalleryError> {
    let exhibit =
        |name: &str, caption: &str, remark: &str, change: fn(&mut EquationSpec), equation: &str, look: &str| {
            let scene = BaseScene::Suzanne.with(|s| {
                closer(s);
                change(&mut s.equation);
            })?;
            Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).remark(remark).aspect(1.25).about(equation, look))
        };
    let mut row = vec![
        exhibit(
            "specular-none",
            "none",
            "only diff k_d ⟨N·L⟩",
            |e| e.specular = Specular::None,
            "L_o = A + Σ_i [ diff k_d ⟨N·L_i⟩ ~{+ k_s spec_i} ] L_i",
            "Clay: the shape is visible, the material is not.",
        )?,
        exhibit(
            "specular-phong",
            "Phong",
            "⟨R·V⟩^g",
            |e| e.specular = Specular::Phong,
            "spec_i = !{⟨R_i·V⟩^g}",
            "Tight highlights; compare the forehead with the next picture at the same g.",
        )?,
        exhibit(
            "specular-blinn-phong",
            "Blinn–Phong",
            "⟨N·H⟩^g",
            |e| e.specular = Specular::BlinnPhong,
            "spec_i = !{⟨N·H_i⟩^g}",
            "Wider highlights, and long ones at grazing angles: the cold rim reaches further around the head.",
        )?,
        exhibit(
            "specular-cosine",
            "cosine-weighted",
            "⟨N·H⟩^g ⟨N·L⟩",
            |e| e.cosine_weighted = Some(true),
            "k_s spec_i !{⟨N·L_i⟩}",
            "The factor cos θ that the lab's specular term omits: grazing highlights fade out instead of ending abruptly.",
        )?,
    ];
    let scene = BaseScene::Suzanne.with(|s| {
        closer(s);
        s.equation.convention = Convention::Physical;
        // The row compares highlights alone.
        s.equation.shadows = Some(false);
        radiometric(s);
    })?;
    row.push(Exhibit::new("specular-physical", "physical", scene).remark("k_d / π, cosine-weighted").aspect(1.25).about(
        "L_o = A + Σ_i [ !{\\f{k_d}{π}} + k_s spec_i ] L_i !{⟨N·L_i⟩}",
        "The equation's own form: the albedo over π, every term times cos θ, the lights π times as strong so that the \
         diffuse part stays the same. Its highlights are relatively stronger.",
    ));
    Ok(row)
}

fn exponent(specular: Specular, word: &str, gamma: f64, equation: &str) -> Result<Exhibit, GalleryError> {
    let scene = BaseScene::Sphere.with(|s| {
        s.objects[0].model = "builtin:sphere-smooth".into();
        s.objects[0].material.shininess = Some(gamma);
        s.equation.specular = specular;
    })?;
    Ok(Exhibit::new(format!("{specular}-{gamma}"), format!("{word}, g = {gamma}"), scene)
        .aspect(1.3)
        .remark(match gamma {
            4.0 => "satin",
            32.0 => "the lab's",
            _ => "polished",
        })
        .about(
            equation,
            "The exponent narrows the highlight without raising it: a polished sphere reflects less light in total.",
        ))
}

/// Frames the face.
fn closer(scene: &mut SceneFile) {
    scene.camera.fov_y = Some(22.0);
    scene.camera.target = Some([0.08, 0.09, 0.2]);
}

/// Multiplies the lights by pi, because the diffuse term has `1/pi`.
pub fn radiometric(scene: &mut SceneFile) {
    for light in &mut scene.lights {
        if light.kind != gonio_scene::scene_file::LightSourceKind::Ambient {
            light.intensity = Some(light.intensity.unwrap_or(1.0) * PI);
        }
    }
}
