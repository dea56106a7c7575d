//! Water, ice, glass, diamond: the lab's refraction, and beyond it.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::optics::Medium;
use gonio_light::{Fresnel, Surfaces};
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::{MaterialOverride, SceneFile};

const SEED: &str = "T = (n N·V − √(1 − n^2 (1 − (N·V)^2))) N − n V";

/// The table twice, then what counts beside the index.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "refraction",
        title: "Refraction",
        equation: "L = F E(R) + (1 − F) E(T),   T = (n N·V − √(1 − n^2 (1 − (N·V)^2))) N − n V",
        introduction: "n is the index outside over the one inside. As in the lab, the ray of sight is bent once, where it \
                       enters; the last row follows it through the body.",
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
        Medium::Air => "The index of what is around it: nothing is bent, nothing is reflected, nothing is seen.",
        Medium::Water => "Straight through in the middle, bent more and more towards the outline, where F takes over.",
        Medium::Ice => "Less than water by a sixtieth of the index: hardly to be told apart.",
        Medium::Glass => "Window glass: what is seen through it is larger, and the rim mirrors.",
        Medium::Diamond => {
            "Bent so strongly that a large part of the room fits in; 17 % is reflected where one looks straight at it."
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

/// A picture of glass with something changed.
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
            ("L = !{E(T)}", "All light goes through, at every angle: a lens without a surface."),
            |m| m.fresnel = Some(Fresnel::None),
        )?,
        glass(
            sphere,
            "fresnel-schlick",
            ("Schlick", "F_0 + (1 − F_0) (1 − cos θ)^5"),
            (
                "F = F_0 + (1 − F_0)(1 − N·V)^5,   F_0 = \\f{(n − 1)^2}{(n + 1)^2} = !{0.043}",
                "The window and the floor appear in the surface, and the rim becomes a mirror.",
            ),
            |m| m.fresnel = Some(Fresnel::Schlick),
        )?,
        glass(
            sphere,
            "fresnel-exact",
            ("exact", "Fresnel's equations, unpolarised"),
            (
                "F = \\f{1}{2} (\\f{n c_i − c_t}{n c_i + c_t})^2 + \\f{1}{2} (\\f{c_i − n c_t}{c_i + n c_t})^2",
                "For glass Schlick's polynomial is within 0.04 of it; the most at 85 degrees, where it says 0.65.",
            ),
            |m| m.fresnel = Some(Fresnel::Exact),
        )?,
        glass(
            BaseScene::RoomSuzanne,
            "refraction-tint",
            ("tinted", "what goes through is multiplied"),
            (
                "L = F E(R) + (1 − F) !{tint} E(T)",
                "Green glass: only what goes through is coloured, the mirror images at the rims keep their colours.",
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
                "The ray is bent where it goes in and where it comes out: a ball of glass is a strong lens, and shows the \
                 room upside down.",
            ),
            both,
        )?,
        glass(
            BaseScene::RoomSuzanne,
            "two-suzanne",
            ("Suzanne in glass", "totally reflected inside of her"),
            (
                "V → T_1 → !{R → …} → T_2",
                "Where a ray meets the far side at more than 41 degrees it is reflected totally and goes on inside.",
            ),
            both,
        )?,
        glass(
            BaseScene::RoomSphere,
            "two-dispersion",
            ("dispersion", "diamond, eight times its own"),
            (
                "n_{red} = n − \\f{!{Δ}}{2},  n_{green} = n,  n_{blue} = n + \\f{!{Δ}}{2},   Δ = 0.2",
                "Each channel has an index of its own: coloured edges wherever the room has edges. A real diamond's Δ is \
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
            ("absorption", "the longer the way, the darker"),
            (
                "E(T) !{e^{−a d}},   a = (2.4, 0.5, 0.9)",
                "Beer and Lambert: red is lost first. Thin ears stay bright, the head is deep green; a tint would colour \
                 both alike.",
            ),
            |m| {
                both(m);
                m.absorption = Some(Color([2.4, 0.5, 0.9]));
            },
        )?,
    ];
    // Several rays for each sample: as dear as the rest of the section together.
    Ok(row.into_iter().map(Exhibit::at_sheet_size).collect())
}
