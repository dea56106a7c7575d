//! Hundreds of small lights in one pass.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::{LightSourceKind, LightSpec};
use std::f64::consts::{PI, TAU};

/// Lights on the floor. A thousand work too, and take five times as long.
const CARPET: usize = 200;
/// Lights around Suzanne.
const RING: usize = 24;

/// A carpet and a ring of lights.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "many-lights",
        title: "Many lights",
        equation: "Σ_i,  i = 1 … 200",
        introduction: "The sum is not limited to eight lights: the shader reads them from a table.",
        rows: vec![vec![carpet()?, ring()?]],
    })
}

fn carpet() -> Result<Exhibit, GalleryError> {
    let scene = BaseScene::StillLife.with(|s| {
        s.lights.truncate(1);
        s.lights[0].intensity = Some(0.05);
        s.lights.extend((0..CARPET).map(carpet_light));
        s.picture.exposure = 0.1;
        s.camera.position = Some([2.7, 3.6, 8.4]);
        s.camera.target = Some([0.1, 0.42, -0.1]);
        s.camera.fov_y = Some(25.0);
    })?;
    Ok(Exhibit::new("many-lights", format!("{CARPET} point lights in one pass"), scene)
        .aspect(1.9)
        .at_sheet_size()
        .remark("a sunflower pattern of lamps just above the floor, attenuated by 1 / (0.35 + 14 d^2)")
        .about(
            "L_o = A + E + !{Σ_{i=1}^{200}} [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i !{att_i} spot_i",
            "Every fragment sums all lights. Each pool of light on the floor belongs to one of them; the dark squares and \
             the crate show a small highlight of each.",
        ))
}

fn ring() -> Result<Exhibit, GalleryError> {
    let pearl = Some(Color::grey(0.3));
    let scene = BaseScene::Suzanne.with(|s| {
        s.lights.truncate(1);
        s.lights[0].intensity = Some(0.04);
        s.lights.extend((0..RING).map(|i| {
            let share = i as f64 / RING as f64;
            let (x, y) = (2.3 * (TAU * share).cos(), 2.3 * (TAU * share).sin());
            LightSpec {
                kind: LightSourceKind::Point,
                position: Some([x + 0.1, y, 1.6].map(tidy)),
                color: Some(Color(rainbow(share, 0.85))),
                intensity: Some(0.34),
                constant: Some(1.0),
                quadratic: Some(0.25),
                ..LightSpec::default()
            }
        }));
        let material = &mut s.objects[0].material;
        (material.ambient, material.diffuse) = (pearl, pearl);
        (material.specular, material.shininess) = (Some(Color::grey(0.7)), Some(60.0));
    })?;
    Ok(Exhibit::new("ring-of-lights", format!("{RING} lights in a ring"), scene)
        .at_sheet_size()
        .remark("grey material: every colour comes from a light")
        .about(
            "L_o = A + E + !{Σ_{i=1}^{24}} [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] !{L_i} att_i spot_i",
            "A colour wheel of lamps around a grey head: surfaces that face a lamp take its colour, and mixed \
             lamps give grey again.",
        ))
}

/// Light `i` of a sunflower's seeds: the golden angle apart, evenly spread over the floor.
fn carpet_light(i: usize) -> LightSpec {
    let golden_angle = PI * (3.0 - 5f64.sqrt());
    let (radius, angle) = (4.0 * ((i as f64 + 0.5) / CARPET as f64).sqrt(), i as f64 * golden_angle);
    let (x, z) = (radius * angle.cos(), radius * angle.sin());
    let hue = z.atan2(x) / TAU + 0.58 + 0.06 * (i as f64 * 12.99).sin();
    LightSpec {
        kind: LightSourceKind::Point,
        position: Some([x, 0.18, z].map(tidy)),
        color: Some(Color(rainbow(hue, 0.82))),
        intensity: Some(0.6),
        constant: Some(0.35),
        quadratic: Some(14.0),
        ..LightSpec::default()
    }
}

/// A soft colour wheel, linear RGB: three cosines a third of a turn apart, deepened, with white mixed in.
fn rainbow(hue: f64, saturation: f64) -> [f64; 3] {
    [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|shift| {
        let wave = 0.5 + 0.5 * (TAU * (hue - shift)).cos();
        tidy(wave.powf(1.5) * saturation + 1.0 - saturation)
    })
}

/// Rounds to three decimals, for a legible scene file.
fn tidy(v: f64) -> f64 {
    // No negative zero.
    (v * 1e3).round() / 1e3 + 0.0
}
