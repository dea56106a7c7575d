//! Skyboxes, mirrors, and light from everywhere.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::Fresnel;
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::{LightSourceKind, LightSpec, SceneFile};

/// Three rows: an environment behind objects, in mirrors, and as their light.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "environments",
        title: "Environments",
        equation: "L = (1 − w) L_o + w E(R),   R = 2 (N·V) N − V",
        introduction: "An environment gives a radiance E for every direction. It is visible behind the objects and in \
                       mirrors, and can be the only light. Three are built in: sky, room and debug.",
        rows: vec![skyboxes()?, mirrors()?, image_based()?],
    })
}

/// The scene's environment, changed.
fn environment(scene: &mut SceneFile, image: &str, rotate: [f64; 3]) {
    let environment = scene.environment.get_or_insert_default();
    environment.image = image.into();
    environment.rotate = rotate;
}

fn skyboxes() -> Result<Vec<Exhibit>, GalleryError> {
    const SEEN: &str = "L = !{E(−V)}";
    let exhibit = |name: &str, remark: &str, look: &str, change: &dyn Fn(&mut SceneFile)| {
        let scene = BaseScene::RoomSphere.with(change)?;
        Ok::<_, GalleryError>(
            Exhibit::new(format!("skybox-{name}"), name, scene).remark(remark).aspect(1.75).about(SEEN, look),
        )
    };
    Ok(vec![
        exhibit(
            "sky",
            "computed: Preetham's model, with a sun",
            "A clear late morning after Preetham, Shirley and Smits. The lamp on the sphere is in the direction of \
             the sun; the sky is infinitely far away, so it does not move with the eye.",
            &|s| {
                environment(s, "sky", [20.0, 0.0, 0.0]);
                s.camera.position = Some([0.0, -0.25, 2.9]);
                s.camera.target = Some([0.0, 0.22, 0.0]);
                s.camera.fov_y = Some(62.0);
                s.lights.truncate(1);
                s.lights[0].color = Some(Color([0.6, 0.75, 1.0]));
                s.lights[0].intensity = Some(0.6);
                // A sun 40 degrees high, 130 degrees to the right of the view ahead before the rotation.
                let (azimuth, height) = (110_f64.to_radians(), 40_f64.to_radians());
                let light_in_world = [-height.cos() * azimuth.sin(), -height.sin(), height.cos() * azimuth.cos()];
                s.lights.push(LightSpec {
                    kind: LightSourceKind::Directional,
                    name: "sun".into(),
                    direction: Some(light_in_world),
                    color: Some(Color([1.0, 0.95, 0.85])),
                    intensity: Some(1.2),
                    ..LightSpec::default()
                });
            },
        )?,
        exhibit(
            "room",
            "a panorama of 512 × 256, made into a cubemap",
            "Infinitely far away, so it looks the same from everywhere. It is soft here because it is small: 128 texels \
             for 90 degrees.",
            &|s| {
                environment(s, "room", [-6.0, 0.0, 0.0]);
                s.camera.position = Some([0.0, 0.45, 2.9]);
                s.camera.fov_y = Some(66.0);
            },
        )?,
        exhibit(
            "debug",
            "which way is which",
            "Each face has its colour, its direction, its file's name and its axes. Legible text is not \
             mirrored.",
            &|s| {
                environment(s, "debug", [0.0; 3]);
                s.camera.position = Some([0.0, 0.9, 2.6]);
                s.camera.target = Some([0.0, 0.6, 0.0]);
                s.camera.fov_y = Some(85.0);
                s.objects[0].translate = [1.35, -0.2, -0.4];
                s.objects[0].scale = [0.8; 3];
            },
        )?,
    ])
}

fn mirrors() -> Result<Vec<Exhibit>, GalleryError> {
    const MIRROR: &str = "L = !{E(R)},   R = 2 (N·V) N − V";
    let mirror = |s: &mut SceneFile| s.objects[0].material.reflectivity = Some(1.0);
    Ok(vec![
        Exhibit::new("mirror-sphere", "a mirror", BaseScene::RoomSphere.with(mirror)?).remark("w = 1").about(
            MIRROR,
            "Nearly the whole room, including the part behind the eye, and at the outline even the part behind the sphere.",
        ),
        Exhibit::new("mirror-suzanne", "Suzanne as a mirror", BaseScene::RoomSuzanne.with(mirror)?).remark("w = 1").about(
            MIRROR,
            "Flat parts show the room large, strongly curved parts show it small. She does not reflect herself: E depends \
             on the direction only.",
        ),
        Exhibit::new(
            "mirror-debug",
            "left is left",
            BaseScene::RoomSphere.with(|s| {
                mirror(s);
                environment(s, "debug", [0.0; 3]);
                s.camera.position = Some([0.0, 0.3, 2.9]);
                s.camera.fov_y = Some(60.0);
            })?,
        )
        .remark("+Z is behind the eye")
        .about(
            MIRROR,
            "The mirror shows the writing mirrored; behind the sphere it is not, so the environment itself is the right \
             way round.",
        ),
        Exhibit::new(
            "mirror-blended",
            "a third of a mirror",
            BaseScene::RoomSuzanne.with(|s| s.objects[0].material.reflectivity = Some(0.3))?,
        )
        .remark("w = 0.3 at every angle")
        .about("L = (1 − !{0.3}) L_o + !{0.3} E(R)", "The lit surface and the mirror, mixed equally at every angle."),
        Exhibit::new(
            "mirror-lacquer",
            "lacquer",
            BaseScene::RoomSuzanne.with(|s| {
                mirror(s);
                s.objects[0].material.fresnel = Some(Fresnel::Exact);
                s.objects[0].material.refraction_index = Some(1.5);
            })?,
        )
        .remark("w = F, index 1.5")
        .about(
            "L = (1 − !{F}) L_o + !{F} E(R)",
            "The Fresnel factor as weight: 4 % at normal incidence, a mirror at grazing angles.",
        ),
    ])
}

fn image_based() -> Result<Vec<Exhibit>, GalleryError> {
    let lit_by_it_alone = |s: &mut SceneFile| {
        s.lights.clear();
        // The window is on the left, so that one side gets more light than the other.
        environment(s, "room", [110.0, 0.0, 0.0]);
        s.environment.get_or_insert_default().light = Some(true);
    };
    let suzanne =
        |name: &str, caption: &str, remark: &str, diffuse, specular, gamma: f64, equation: &str, look: &str| {
            let scene = BaseScene::RoomSuzanne.with(|s| {
                lit_by_it_alone(s);
                let material = &mut s.objects[0].material;
                material.ambient = Some(Color::grey(0.0));
                material.diffuse = Some(Color(diffuse));
                material.specular = Some(Color(specular));
                material.shininess = Some(gamma);
            })?;
            Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).remark(remark).about(equation, look))
        };
    const GLOSSY: &str = "∫ f_g E … ≈ E_g(R') !{(A k_s + B)}";
    let (metal, dark) = ([0.95, 0.68, 0.36], [0.02, 0.012, 0.006]);
    Ok(vec![
        suzanne(
            "ibl-diffuse",
            "matte",
            "light of the room alone: 9 coefficients",
            [0.66, 0.6, 0.54],
            [0.0; 3],
            1.0,
            "\\f{k_d}{π} ∫ E … ≈ k_d Σ !{A_l E_{lm}} Y_{lm}(N)",
            "No lamp. The light that reaches a matte surface varies so smoothly that nine spherical harmonics represent it: \
             red and green from the walls, white from the window and the ceiling.",
        )?,
        suzanne(
            "ibl-rough",
            "g = 8",
            "rough metal",
            dark,
            metal,
            8.0,
            GLOSSY,
            "A rough mirror reflects a blurred room: prefiltered cubemaps, and a table of the lobe's share of the light.",
        )?,
        suzanne(
            "ibl-satin",
            "g = 80",
            "satin",
            dark,
            metal,
            80.0,
            GLOSSY,
            "A narrower lobe blurs less: a finer level of the same cubemaps.",
        )?,
        suzanne(
            "ibl-polished",
            "g = 800",
            "polished",
            dark,
            metal,
            800.0,
            GLOSSY,
            "Nearly a mirror, tinted by k_s like a metal.",
        )?,
        Exhibit::new(
            "ibl-still-life",
            "blurred behind",
            BaseScene::StillLife.with(|s| {
                lit_by_it_alone(s);
                s.environment.get_or_insert_default().blur = 0.25;
                s.camera.position = Some([2.5, 2.35, 6.4]);
                s.camera.target = Some([0.1, 0.42, -0.12]);
                s.camera.fov_y = Some(32.0);
                s.picture.exposure = 0.0;
            })?,
        )
        .aspect(1.6)
        .at_sheet_size()
        .remark("the still life by the room's light")
        .about(
            "L = !{E_g(−V)}",
            "The same blurred cubemaps behind the objects keep the eye on what is in front. There are no shadows: E does \
             not depend on the objects.",
        ),
    ])
}
