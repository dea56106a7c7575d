//! Debug views: the vectors and scalars of the equation as colours.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::Quantity;
use gonio_scene::{SceneFile, ViewSpec};

/// Two rows of six.
pub fn section() -> Result<Section, GalleryError> {
    let vectors: [(Quantity, &str, &str, &str, &str); 6] = [
        (
            Quantity::Normal,
            "N",
            "normal",
            "N",
            "Red to the right, green up, blue towards +z: surfaces that face the eye are light blue.",
        ),
        (
            Quantity::Light,
            "L",
            "to the light",
            "L = \\f{p_i − x}{|p_i − x|}",
            "Nearly one colour, because the key light is far away; the direction changes a little across the face.",
        ),
        (
            Quantity::View,
            "V",
            "to the eye",
            "V = \\f{e − x}{|e − x|}",
            "Nearly constant too; in an orthographic picture it would be constant.",
        ),
        (
            Quantity::Reflection,
            "R",
            "L mirrored",
            "R = 2 (N·L) N − L",
            "Changes twice as fast as N. Phong's highlight is where it has the colour of V.",
        ),
        (
            Quantity::Half,
            "H",
            "between L and V",
            "H = \\f{L + V}{|L + V|}",
            "Hardly changes. Blinn–Phong's highlight is where N has this colour.",
        ),
        (
            Quantity::Refraction,
            "T",
            "V refracted",
            "T = (n N·V − √(1 − n^2 (1 − (N·V)^2))) N − n V",
            "The view direction inside the material, index 1.45: the environment is looked up along it.",
        ),
    ];
    let scalars: [(Quantity, &str, &str, &str, &str); 6] = [
        (
            Quantity::Uv,
            "UV",
            "texture coordinates",
            "(u, v)",
            "u in red, v in green. The floor covers the texture once.",
        ),
        (
            Quantity::GeometricNormal,
            "N of the triangle",
            "geometric normal",
            "N_g = \\f{(p_1 − p_0) × (p_2 − p_0)}{|…|}",
            "The normal of flat shading; the donut shows its triangles.",
        ),
        (Quantity::Position, "position", "world space", "x", "The scene's bounding box is mapped to the colour cube."),
        (Quantity::Depth, "depth", "along the view", "(x − e) · front", "Dark is near."),
        (
            Quantity::Attenuation,
            "att",
            "of the key",
            "att_i = \\f{1}{k_c + k_l d + k_q d^2}",
            "The key light decreases from left to right; 1 and more is white.",
        ),
        (
            Quantity::CosTheta,
            "cos θ",
            "⟨N·L⟩",
            "⟨N·L_i⟩",
            "The cosine of the diffuse term. Black surfaces face away from the key light.",
        ),
    ];
    let row =
        |base: BaseScene, table: [(Quantity, &str, &str, &str, &str); 6], aspect: f64, change: fn(&mut SceneFile)| {
            table
                .iter()
                .map(|&(quantity, caption, remark, equation, look)| {
                    let scene = base.with(change)?;
                    Ok(Exhibit::new(format!("view-{quantity}"), caption, scene)
                        .remark(remark)
                        .aspect(aspect)
                        .view(ViewSpec { quantity, light: None })
                        .about(equation, look))
                })
                .collect::<Result<Vec<Exhibit>, GalleryError>>()
        };
    Ok(Section {
        id: "views",
        title: "The quantities of the equation",
        equation: "N,  L,  V,  R,  H,  T,  uv,  N_g,  x,  d,  att,  cos θ",
        introduction: "Every quantity can be shown alone (gonio render --debug) and printed as numbers for any pixel \
                       (gonio probe). Directions are shown as (x + 1) / 2.",
        rows: vec![
            row(BaseScene::Suzanne, vectors, 1.2, |scene| scene.camera.fov_y = Some(27.0))?,
            row(BaseScene::StillLife, scalars, 1.35, |scene| {
                scene.camera.fov_y = Some(31.5);
                // A law whose factor stays within [0, 1].
                for light in &mut scene.lights {
                    if light.name == "key" {
                        (light.constant, light.quadratic) = (Some(0.0), Some(0.045));
                    }
                }
            })?,
        ],
    })
}
