//! Kinds of light, attenuation, and a light that moves.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::{LightSourceKind, LightSpec, MotionKind, MotionSpec, SceneFile};
use std::f64::consts::TAU;

const WARM: Color = Color([1.0, 0.82, 0.6]);

/// Three rows: kinds, attenuation, motion.
pub fn section() -> Result<Section, GalleryError> {
    let mut second = attenuation()?;
    second.extend(motion()?);
    Ok(Section {
        id: "lights",
        title: "Lights",
        equation: "L_i att_i spot_i,   att = 1 / (k_c + k_l d + k_q d^2)",
        introduction: "Four kinds of light on the same still life, three kinds of attenuation, and the moving light \
                       of the lab's exercise 07.",
        rows: vec![kinds()?, second],
    })
}

fn kinds() -> Result<Vec<Exhibit>, GalleryError> {
    let point = LightSpec {
        kind: LightSourceKind::Point,
        position: Some([0.35, 1.9, 1.9]),
        color: Some(WARM),
        intensity: Some(1.5),
        constant: Some(0.5),
        quadratic: Some(0.22),
        ..LightSpec::default()
    };
    let exhibit = |name: &str, caption: &str, remark: &str, light, equation: &str, look: &str| {
        let scene = BaseScene::StillLife.with(|s| only(s, 0.03, light))?;
        Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).remark(remark).aspect(1.7).about(equation, look))
    };
    Ok(vec![
        exhibit(
            "light-ambient",
            "ambient",
            "from everywhere",
            LightSpec {
                kind: LightSourceKind::Ambient,
                color: Some(Color([0.85, 0.92, 1.0])),
                intensity: Some(0.3),
                ..LightSpec::default()
            },
            "L_o = !{A} = k_a L_a",
            "No direction and no distance: every point gets the same light.",
        )?,
        exhibit(
            "light-directional",
            "directional",
            "parallel rays, att = 1",
            LightSpec {
                kind: LightSourceKind::Directional,
                direction: Some([0.8, -0.62, -0.75]),
                color: Some(WARM),
                intensity: Some(0.85),
                ..LightSpec::default()
            },
            "L_i !{= const},  att = 1",
            "Like the sun: planes of the same orientation are equally bright everywhere, so the floor is even up to its edge.",
        )?,
        exhibit(
            "light-point",
            "point",
            "fades with d",
            point.clone(),
            "L_i = \\f{!{p} − x}{|p − x|},  att_i = \\f{1}{k_c + k_l d + k_q d^2}",
            "A lamp above the donut: its direction differs from point to point, and distant objects get less light.",
        )?,
        exhibit(
            "light-spot",
            "spot",
            "a point light within a cone",
            LightSpec {
                kind: LightSourceKind::Spot,
                position: Some([0.3, 5.2, 3.4]),
                direction: Some([0.15, -5.2, -2.9]),
                inner_angle: Some(14.0),
                outer_angle: Some(19.0),
                intensity: Some(1.7),
                constant: Some(1.0),
                quadratic: Some(0.01),
                ..point
            },
            "spot_i = smoothstep(cos θ_{outer}, cos θ_{inner}, −L_i · axis)",
            "Full light within the inner angle, none outside the outer one, and a smooth step between them. The \
             equation has no shadows: the cone passes through the donut.",
        )?,
    ])
}

fn attenuation() -> Result<Vec<Exhibit>, GalleryError> {
    let exhibit = |name: &str, caption: &str, k_q: f64, look: &str| {
        let scene = BaseScene::StillLife.with(|s| {
            let light = LightSpec {
                kind: LightSourceKind::Point,
                position: Some([-0.6, 1.1, 0.9]),
                color: Some(WARM),
                intensity: Some(1.0),
                constant: Some(1.0),
                quadratic: Some(k_q),
                ..LightSpec::default()
            };
            only(s, 0.02, light);
            s.camera.fov_y = Some(31.5);
        })?;
        Ok::<_, GalleryError>(
            Exhibit::new(name, caption, scene)
                .remark(format!("k_q = {k_q}"))
                .aspect(1.35)
                .about("att_i = \\f{1}{!{k_c} + k_l d + !{k_q} d^2}", look),
        )
    };
    Ok(vec![
        exhibit(
            "attenuation-none",
            "att = 1",
            0.0,
            "Without attenuation the far corner of the floor is as bright as its angle allows.",
        )?,
        exhibit(
            "attenuation-some",
            "att = 1 / (1 + d^2/4)",
            0.25,
            "The lamp has a position: near surfaces are brighter.",
        )?,
        exhibit("attenuation-strong", "att = 1 / (1 + 2 d^2)", 2.0, "A candle: only its surroundings are visible.")?,
    ])
}

fn motion() -> Result<Vec<Exhibit>, GalleryError> {
    let scene = BaseScene::Sphere.with(|s| {
        s.objects[0].model = "builtin:sphere-smooth".into();
        let light = LightSpec {
            kind: LightSourceKind::Point,
            position: Some([1.6, 2.2, 2.2]),
            intensity: Some(1.6),
            constant: Some(1.0),
            linear: Some(0.14),
            quadratic: Some(0.02),
            motion: Some(MotionSpec {
                kind: MotionKind::Oscillate,
                period: TAU,
                amplitude: Some([0.0, 0.0, 4.0]),
                ..MotionSpec::default()
            }),
            ..LightSpec::default()
        };
        s.lights.truncate(1);
        s.lights.push(light);
        s.camera.fov_y = Some(28.0);
    })?;
    Ok([(4.7, "behind"), (5.6, "on its way"), (6.4, "on its way"), (7.9, "in front")]
        .iter()
        .enumerate()
        .map(|(i, &(time, place))| {
            Exhibit::new(format!("moving-{}", i + 1), format!("t = {time} s"), scene.clone())
                .remark(place)
                .aspect(0.9)
                .at(time)
                .about(
                    "p_i(t) = p_i + a !{sin(2π t / T)}",
                    "The light swings along z as in exercise 07; the highlight and the terminator follow it.",
                )
        })
        .collect())
}

/// A little ambient light and one other light.
fn only(scene: &mut SceneFile, ambient: f64, light: LightSpec) {
    scene.lights.truncate(1);
    scene.lights[0].intensity = Some(ambient);
    if light.kind == LightSourceKind::Ambient {
        scene.lights.clear();
    }
    scene.lights.push(light);
    scene.equation.emitted = false;
}
