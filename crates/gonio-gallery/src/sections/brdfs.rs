//! The BRDFs of Appendix 6 on the donut.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::Convention;
use gonio_light::brdf::BrdfKind;
use gonio_scene::color_value::Color;
use std::f64::consts::PI;

/// Six lobes.
pub fn section() -> Result<Section, GalleryError> {
    let exhibit =
        |name: &str, kind, b: f64, matrix: Option<[f64; 3]>, caption: &str, remark: &str, f: &str, look: &str| {
            let scene = BaseScene::StillLife.with(|s| {
                s.equation.convention = Convention::Physical;
                s.equation.brdf = Some(kind);
                s.equation.brdf_normalised = true;
                s.equation.lafortune = matrix.unwrap_or(s.equation.lafortune);
                s.equation.emitted = false;
                // The ember's light would hide the lobes.
                s.lights.retain(|l| l.name != "ember");
                for light in &mut s.lights {
                    // Near the eye, so that a lobe back to the light is visible too.
                    if light.name == "key" {
                        (light.position, light.intensity) = (Some([1.1, 3.7, 4.6]), Some(3.4));
                        (light.constant, light.quadratic) = (Some(0.5), Some(0.06));
                    }
                    if light.name == "rim" {
                        light.intensity = light.intensity.map(|i| 0.5 * i * PI);
                    }
                }
                s.objects[0].material.shininess = Some(24.0);
                s.objects[0].material.specular = Some(Color::grey(b));
                s.camera.position = Some([1.9, 2.5, 4.9]);
                s.camera.target = Some([1.2, 0.27, 0.8]);
                s.camera.fov_y = Some(32.0);
            })?;
            Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).remark(remark).aspect(1.15).about(f, look))
        };
    Ok(Section {
        id: "brdfs",
        title: "BRDFs of Appendix 6",
        equation: "L_o = E + Σ_i f(L_i, V) L_i att_i spot_i ⟨N·L_i⟩",
        introduction: "A BRDF replaces both terms. All six are normalised, so they distribute the same share of \
                       light over different directions. g = 24, b = 0.22 (0.04 for the last, whose whole lobe returns to the eye).",
        rows: vec![vec![
            exhibit(
                "brdf-lambert",
                BrdfKind::Lambert,
                0.22,
                None,
                "Lambert",
                "a / π",
                "f = !{\\f{a}{π}}",
                "The same in all directions: no highlight.",
            )?,
            exhibit(
                "brdf-phong",
                BrdfKind::Phong,
                0.22,
                None,
                "Phong",
                "a/π + b ⟨R·V⟩^c",
                "f = \\f{a}{π} + b \\f{c + 2}{2π} !{⟨R·V⟩^c}",
                "A round lobe about the mirror direction, wherever the light comes from.",
            )?,
            exhibit(
                "brdf-blinn",
                BrdfKind::Blinn,
                0.22,
                None,
                "Blinn",
                "a/π + b ⟨N·H⟩^c",
                "f = \\f{a}{π} + b n(c) !{⟨N·H⟩^c}",
                "A lobe about the normal: at grazing angles it becomes narrow and high, as on real surfaces.",
            )?,
            exhibit(
                "brdf-ward",
                BrdfKind::Ward,
                0.22,
                None,
                "Ward",
                "a Gaussian of slopes",
                "f = \\f{a}{π} + \\f{b}{π c^2} e^{!{−tan^2 δ / c^2}} \\f{|L + V|^2}{(N·(L + V))^4}",
                "A Gaussian of the surface's slopes, δ between N and H, in the form with bounded albedo.",
            )?,
            exhibit(
                "brdf-lafortune",
                BrdfKind::Lafortune,
                0.22,
                Some([1.0, 1.0, -0.92]),
                "Lafortune",
                "off-specular lobe",
                "f = \\f{a}{π} + b !{⟨−w_i^T A w_o⟩^k},  A = diag(1, 1, −0.92)",
                "With |A_z| smaller than |A_x| the lobe leans away from the mirror direction: a little where the donut faces \
                 the lamp, more at grazing angles.",
            )?,
            exhibit(
                "brdf-lafortune-retro",
                BrdfKind::Lafortune,
                0.04,
                Some([-1.0, -1.0, -1.0]),
                "Lafortune, retro",
                "back to the light, b = 0.04",
                "f = \\f{a}{π} + b !{⟨w_i·w_o⟩^k},  A = diag(−1, −1, −1)",
                "Light returns to its source, as from a road sign or the full moon: with the lamp near \
                 the eye, everything is bright up to its outline, whatever its normal.",
            )?,
        ]],
    })
}
