//! Refraction: the lab's table of water, ice, glass and diamond, and further parameters.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::optics::Medium;
use gonio_light::{Fresnel, Surfaces};
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::{MaterialOverride, SceneFile};

const SEED: &str = "T = (n N·V − √(1 − n^2 (1 − (N·V)^2))) N − n V";

/// The table on two models, then the parameters other than the index.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "refraction",
        title: "Refraction",
        equation: "L = F E(R) + (1 − F) E(T),   T = (n N·V − √(1 − n^2 (1 − (N·V)^2))) N − n V",
        introduction: "n is the index outside divided by the index inside. As in the lab, the view ray is refracted once, \
                       where it enters; the last row follows it through the body.",
        rows: vec![
            table(BaseScene::RoomSphere, "")?,
            table(BaseScene::RoomSuzanne, "-suzanne")?,
            fresnel()?,
            through()?,
        ],
    })
}

/// The lab's table of indices.
fn table(base: BaseScene, suffix: &str) -> Result<Vec<Exhibit>, GalleryError> {
    let look = |medium| match medium {
        Medium::Air => "The index of its surroundings: no refraction, no reflection, invisible.",
        Medium::Water => "Straight through in the middle, refracted more towards the outline, where F dominates.",
        Medium::Ice => "An index a sixtieth smaller than that of water: hardly distinguishable.",
        Medium::Glass => "Window glass: the room behind it is magnified, and the rim is a mirror.",
        Medium::Diamond => {
            "Refracted so strongly that a large part of the room is visible; 17 % is reflected at normal incidence."
        }
    };
    let exhibit = |&medium: &Medium| {
        let scene = base.with(|s| s.objects[0].material.medium = Some(medium))?;
        let index = medium.refraction_index();
        Ok(Exhibit::new(format!("refraction-{medium}{suffix}"), medium.name(), scene)
            .remark(format!("n = 1 / {index}"))
            .about(format!("!{{n = \\f{{1}}{{{index}}}}},   {SEED}"), look(medium)))
    };
    Medium::ALL.iter().map(exhibit).collect()
}

/// A picture of glass with one change.
fn glass(
    base: BaseScene,
    name: &str,
    (caption, remark): (&str, &str),
    (equation, look): (&str, &str),
    change: impl FnOnce(&mut MaterialOverride),
) -> Result<Exhibit, GalleryError> {
    let scene = base.with(|s: &mut SceneFile| {
        s.objects[0].material.medium = Some(Medium::Glass);
        change(&mut s.objects[0].material);
    })?;
    Ok(Exhibit::new(name, caption, scene).remark(remark).aspect(1.3).about(equation, look))
}

fn fresnel() -> Result<Vec<Exhibit>, GalleryError> {
    let sphere = BaseScene::RoomSphere;
    Ok(vec![
        glass(
            sphere,
            "fresnel-none",
            ("F = 0", "as in the lab"),
            ("L = !{E(T)}", "All light is transmitted at every angle: a lens without reflection."),
            |m| m.fresnel = Some(Fresnel::None),
        )?,
        glass(
            sphere,
            "fresnel-schlick",
            ("Schlick", "F_0 + (1 − F_0) (1 − cos θ)^5"),
            (
                "F = F_0 + (1 − F_0)(1 − N·V)^5,   F_0 = \\f{(n − 1)^2}{(n + 1)^2} = !{0.043}",
                "The window and the floor are reflected, and the rim becomes a mirror.",
            ),
            |m| m.fresnel = Some(Fresnel::Schlick),
        )?,
        glass(
            sphere,
            "fresnel-exact",
            ("exact", "Fresnel's equations, unpolarised"),
            (
                "F = \\f{1}{2} (\\f{n c_i − c_t}{n c_i + c_t})^2 + \\f{1}{2} (\\f{c_i − n c_t}{c_i + n c_t})^2",
                "For glass, Schlick's polynomial differs by at most 0.04, at 85 degrees, where it is 0.65.",
            ),
            |m| m.fresnel = Some(Fresnel::Exact),
        )?,
        glass(
            BaseScene::RoomSuzanne,
            "refraction-tint",
            ("tinted", "transmitted light is multiplied"),
            (
                "L = F E(R) + (1 − F) !{tint} E(T)",
                "Green glass: only transmitted light is coloured; the reflections at the rim keep their colours.",
            ),
            |m| m.tint = Some(Color([0.4, 0.9, 0.6])),
        )?,
    ])
}

fn through() -> Result<Vec<Exhibit>, GalleryError> {
    let both = |m: &mut MaterialOverride| m.surfaces = Some(Surfaces::Two);
    let row = vec![
        glass(
            BaseScene::RoomSphere,
            "two-sphere",
            ("in and out", "two surfaces: upside down"),
            (
                "V → T_1 → !{T_2},   sin θ_c = \\f{1}{1.52}",
                "The ray is refracted where it enters and where it leaves: a glass ball is a strong lens, and shows the room \
                 upside down.",
            ),
            both,
        )?,
        glass(
            BaseScene::RoomSuzanne,
            "two-suzanne",
            ("Suzanne in glass", "total internal reflection"),
            (
                "V → T_1 → !{R → …} → T_2",
                "Where a ray meets the far side at more than 41 degrees it is totally reflected and continues inside.",
            ),
            both,
        )?,
        glass(
            BaseScene::RoomSphere,
            "two-dispersion",
            ("dispersion", "diamond, eight times its real dispersion"),
            (
                "n_{red} = n − \\f{!{Δ}}{2},  n_{green} = n,  n_{blue} = n + \\f{!{Δ}}{2},   Δ = 0.2",
                "Each channel has its own index: coloured fringes at the edges of the room. A real diamond's Δ is \
                 0.025.",
            ),
            |m| {
                both(m);
                m.medium = Some(Medium::Diamond);
                m.dispersion = Some(0.2);
            },
        )?,
        glass(
            BaseScene::RoomSuzanne,
            "two-absorption",
            ("absorption", "darker with distance"),
            (
                "E(T) !{e^{−a d}},   a = (2.4, 0.5, 0.9)",
                "The Beer-Lambert law: red is absorbed first. The thin ears stay bright, the head is deep green; a tint would \
                 colour both alike.",
            ),
            |m| {
                both(m);
                m.absorption = Some(Color([2.4, 0.5, 0.9]));
            },
        )?,
    ];
    // Several rays per sample cost as much as the rest of the section.
    Ok(row.into_iter().map(Exhibit::at_sheet_size).collect())
}
