//! Edits of a scene, and its options.

use crate::{Memory, TRIANGLE, png};
use gonio_light::optics::Medium;
use gonio_light::{Convention, Fresnel, Specular, Surfaces};
use gonio_scene::color_value::Color;
use gonio_scene::edit::{Applied, Edited, apply};
use gonio_scene::load::load;
use gonio_scene::scene_file::{LightSourceKind, LightSpec, MaterialOverride, MotionKind, Normals, ObjectSpec, Shading};
use gonio_scene::settings::{Aim, EnvironmentSettings, LightSettings};
use gonio_scene::{Maps, Scene, SceneFile, SceneSettings};
use std::path::Path;
use std::sync::Arc;

const SCENE: &str = "[environment]\nimage = \"debug\"\nsize = 4\n[camera]\nposition = [0, 0, 4]\n\
                     [[light]]\nkind = \"point\"\nposition = [1, 2, 3]\n\
                     [[object]]\nmodel = \"t.obj\"\n\
                     [[object]]\nmodel = \"builtin:cube\"\nmaterial.reflectivity = 0.5\n\
                     [[object]]\nmodel = \"t.obj\"\nname = \"again\"\ntranslate = [1, 0, 0]\nshading = \"flat\"\n";
const MTL: &str = "newmtl m\nKd 0.5 0.6 0.7\nmap_Kd wood.png\nmap_Ks -bm 1 shine.png\nnorm bumps.png\nNs 20\n";

fn files() -> Memory {
    Memory::default()
        .with("t.obj", TRIANGLE)
        .with("t.mtl", MTL)
        .with("wood.png", png(2, 2, |x, y| [90, 100 * x as u8, 100 * y as u8, 255]))
        .with("shine.png", png(1, 1, |_, _| [200; 4]))
        .with("bumps.png", png(1, 1, |_, _| [128, 128, 255, 255]))
}

fn read(text: &str) -> SceneFile {
    gonio_scene::toml_file::read(text).unwrap()
}

fn loaded(scene: SceneFile) -> Scene {
    load(scene, Path::new(""), &files()).unwrap()
}

fn done(edited: Edited) -> Applied {
    match edited {
        Edited::Done(applied) => *applied,
        Edited::NeedsFiles(_) => panic!("it needs files"),
    }
}

/// A corner as it is drawn: tangents apart, which meshes keep for materials that no longer want them.
type Corner = ([f32; 3], [f32; 3], [f32; 2]);

/// Everything that is drawn of an object, without the numbers of meshes, materials and textures.
fn drawn(scene: &Scene) -> Vec<String> {
    let with_textures = |maps: &Maps| {
        let all = [&maps.diffuse, &maps.specular, &maps.emitted, &maps.shininess, &maps.opacity, &maps.normal];
        let texels = |b: &gonio_scene::BoundTexture| {
            let texture = &scene.textures[b.texture];
            (texture.name.clone(), texture.rgba.clone(), b.scale, b.rotation, b.offset, b.wrap)
        };
        format!("{:?} {:?}", all.map(|map| map.as_ref().map(texels)), maps.roughness)
    };
    let mut all = Vec::new();
    for object in &scene.objects {
        let mesh = &scene.meshes[object.mesh];
        let corner = |v: u32| -> Corner {
            let v = v as usize;
            (mesh.positions[v], mesh.normals[v], mesh.tex_coords.get(v).copied().unwrap_or_default())
        };
        let corners: Vec<Corner> = mesh.indices.iter().map(|&v| corner(v)).collect();
        let wants_tangents = object.parts.iter().any(|p| scene.materials[p.material].maps.normal.is_some());
        assert!(!wants_tangents || mesh.tangents.len() == mesh.positions.len());
        let parts: Vec<_> = object.parts.iter().map(|p| (&p.name, p.first_triangle, p.triangle_count)).collect();
        let materials: Vec<_> = object
            .parts
            .iter()
            .map(|p| &scene.materials[p.material])
            .map(|m| (&m.material, m.optics, with_textures(&m.maps)))
            .collect();
        let (name, shading, closed) = (&object.name, object.shading, object.closed);
        let place = object.world_from_model;
        all.push(format!("{name} {shading} {closed} {place:?} {parts:?} {materials:?} {corners:?}"));
    }
    all
}

type Edit = (&'static str, fn(&mut SceneSettings), [bool; 2]);

/// Each edit, and whether it changes the geometry and the materials.
const EDITS: [Edit; 25] = [
    ("nothing", |_| (), [false, false]),
    ("the picture", |s| (s.picture.width, s.picture.exposure) = (64, 1.0), [false, false]),
    ("the camera", |s| (s.camera.position, s.camera.fov_y) = ([1.0, 2.0, 5.0], 50.0), [false, false]),
    ("a direction", |s| s.camera.aim = Aim::Angles { yaw: -80.0, pitch: -5.0 }, [false, false]),
    ("the background", |s| s.background.top = Color::grey(0.9), [false, false]),
    ("the equation", |s| (s.equation.specular, s.equation.diffuse) = (Specular::Phong, false), [false, false]),
    (
        "the convention",
        |s| (s.equation.convention, s.equation.cosine_weighted) = (Convention::Physical, true),
        [false; 2],
    ),
    ("shadows", |s| s.equation.shadows = true, [false; 2]),
    ("a light moved", |s| s.lights[0].position = Some([0.0, 1.0, 0.0]), [false, false]),
    ("a lamp's radius", |s| s.lights[0].radius = 0.25, [false, false]),
    ("a light more", |s| s.lights.push(LightSettings::new(LightSourceKind::Ambient)), [false, false]),
    ("the environment turned", |s| environment(s).rotate = [10.0, 20.0, 30.0], [false, false]),
    ("the environment lights", |s| environment(s).light = true, [false, false]),
    ("no environment", |s| s.environment = None, [false, false]),
    ("an object moved", |s| s.objects[0].translate = [1.0, 1.0, -1.0], [true, false]),
    ("an object moves", |s| s.objects[0].motion = some_motion(), [false, false]),
    ("an object mirrored", |s| s.objects[1].scale = [-1.0, 2.0, 1.0], [true, false]),
    ("a name left out", |s| s.objects[2].name.clear(), [false, false]),
    ("shading", |s| s.objects[0].shading = Shading::Gouraud, [false, false]),
    ("an object removed", |s| drop(s.objects.remove(1)), [true, true]),
    (
        "an object copied",
        |s| s.objects.push(ObjectSpec { rotate: [0.0, 90.0, 0.0], ..s.objects[1].clone() }),
        [true, false],
    ),
    ("a colour", |s| s.objects[1].material.specular = Some(Color::grey(0.1)), [false, true]),
    ("a transparent body", |s| s.objects[1].material.opacity = Some(0.5), [true, true]),
    (
        "optics",
        |s| (s.objects[1].material.surfaces, s.objects[1].material.transmission) = (Some(Surfaces::Two), Some(0.5)),
        [false, true],
    ),
    (
        "no textures on both",
        |s| [0, 2].map(|i| s.objects[i].material.textures = Some(false)).iter().for_each(|()| ()),
        [false, true],
    ),
];

fn some_motion() -> Option<gonio_scene::scene_file::MotionSpec> {
    let light = LightSpec::from_option_text("point position=0,0,0 motion=oscillate period=2 amplitude=0,0,2");
    light.unwrap().motion
}

fn environment(scene: &mut SceneSettings) -> &mut EnvironmentSettings {
    scene.environment.as_mut().unwrap()
}

#[test]
fn an_edit_is_what_loading_the_edited_settings_gives() {
    let before = loaded(read(SCENE));
    for (what, edit, [geometry, materials]) in EDITS {
        let mut scene = before.settings.clone();
        edit(&mut scene);
        let applied = done(apply(&before, scene.clone()).unwrap());
        let afresh = loaded(SceneFile::from(&scene));
        assert_eq!(drawn(&applied.loaded), drawn(&afresh), "{what}");
        assert_eq!(applied.loaded.settings, afresh.settings, "{what}");
        assert_eq!(applied.loaded.frame(1.5), afresh.frame(1.5), "{what}");
        assert_eq!(applied.loaded.camera_was_framed, afresh.camera_was_framed, "{what}");
        assert_eq!(applied.loaded.environment.is_some(), afresh.environment.is_some(), "{what}");
        // The diagnostics that an edit adds.
        let warns = |s: &Scene| s.diagnostics.iter().any(|d| d.message.starts_with("mirrors and glass"));
        assert_eq!(warns(&applied.loaded), warns(&afresh), "{what}");
        assert_eq!([applied.geometry_changed, applied.materials_changed], [geometry, materials], "{what}");
        if !geometry && !materials {
            assert!(applied.loaded.meshes.iter().zip(&before.meshes).all(|(a, b)| Arc::ptr_eq(a, b)), "{what}");
        }
    }
}

/// One edit after another and all the way back, as undo does it: nothing is lost on the way.
#[test]
fn edits_can_be_taken_back_without_files() {
    let before = loaded(read(SCENE));
    for (what, edit, _) in EDITS {
        let mut scene = before.settings.clone();
        edit(&mut scene);
        let there = done(apply(&before, scene).unwrap()).loaded;
        let back = done(apply(&there, before.settings.clone()).unwrap()).loaded;
        assert_eq!(drawn(&back), drawn(&before), "{what}");
        assert_eq!(back.frame(0.0), before.frame(0.0), "{what}");
        assert!(back.textures.iter().zip(&before.textures).all(|(a, b)| Arc::ptr_eq(a, b)), "{what}");
        assert!(back.environment.zip(before.environment.clone()).is_some_and(|(a, b)| Arc::ptr_eq(&a, &b)), "{what}");
    }
}

#[test]
fn edits_of_unread_files_need_files() {
    let plain = loaded(read("[[object]]\nmodel = \"t.obj\"\nmaterial.textures = false\n"));
    let before = loaded(read(SCENE));
    type Edit<'a> = (&'a str, &'a Scene, fn(&mut SceneSettings));
    let edits: [Edit; 6] = [
        ("another model", &before, |s| s.objects[0].model = "builtin:suzanne".into()),
        ("other normals", &before, |s| s.objects[0].normals = Normals::Flat),
        ("a crease angle", &before, |s| s.objects[0].crease_angle = Some(30.0)),
        ("another environment", &before, |s| environment(s).image = "sky".into()),
        ("another size of it", &before, |s| environment(s).size = Some(8)),
        ("textures that were never read", &plain, |s| s.objects[0].material.textures = None),
    ];
    for (what, before, edit) in edits {
        let mut scene = before.settings.clone();
        edit(&mut scene);
        match apply(before, scene.clone()).unwrap() {
            Edited::NeedsFiles(same) => assert_eq!(*same, scene, "{what}"),
            Edited::Done(_) => panic!("{what}: nothing was read for it"),
        }
    }
}

#[test]
fn invalid_values_are_reported_in_a_sentence() {
    let before = loaded(read(SCENE));
    let mut scene = before.settings.clone();
    scene.camera.fov_y = -3.0;
    let problem = apply(&before, scene).unwrap_err();
    assert_eq!(problem.path, "camera.fov_y");
    assert!(problem.message.contains("fov_y"), "{problem}");
    let mut scene = before.settings.clone();
    scene.objects.clear();
    assert!(apply(&before, scene).is_err(), "a scene has an object");
}

/// Lights that were all taken out are not put back: whoever edits sees them gone.
#[test]
fn without_lights_it_is_dark() {
    let before = loaded(read("[[object]]\nmodel = \"builtin:cube\"\n"));
    assert!(!before.settings.lights.is_empty());
    let mut scene = before.settings.clone();
    scene.lights.clear();
    assert!(done(apply(&before, scene).unwrap()).loaded.frame(0.0).lights.is_empty());
}

/// A light that is off sends nothing and leaves the others their numbers; the scene file remembers it.
#[test]
fn a_light_that_is_off_keeps_its_place() {
    let before = loaded(read(SCENE));
    let mut scene = before.settings.clone();
    let other = LightSettings { intensity: 2.0, ..scene.lights[0].clone() };
    scene.lights.push(other);
    scene.lights[0].enabled = false;
    let after = done(apply(&before, scene).unwrap()).loaded;
    let lights = after.frame(0.0).lights;
    assert_eq!(lights.len(), 2);
    assert_eq!(lights[0].color.to_array(), [0.0; 3]);
    assert_eq!(lights[0].kind, lights[1].kind);
    assert_eq!(lights[1].color.to_array(), [2.0; 3]);
    let file = SceneFile::from(&after.settings);
    let text = file.to_toml_string();
    assert_eq!(text.matches("enabled = false").count(), 1, "{text}");
    assert_eq!(read(&text).lights, file.lights);
}

/// The file's material is known under the scene's override.
#[test]
fn the_materials_of_the_file_are_remembered() {
    let before = loaded(read(SCENE));
    let mut scene = before.settings.clone();
    scene.objects[0].material.diffuse = Some(Color([0.1, 0.2, 0.3]));
    let after = done(apply(&before, scene).unwrap()).loaded;
    for scene in [&before, &after] {
        let materials = scene.materials_in_file(0);
        assert_eq!(materials.len(), 1);
        // Three decimals of a file of 32-bit numbers.
        assert!((materials[0].diffuse[1] - 0.6).abs() < 1e-3, "{:?}", materials[0].diffuse);
        assert_eq!(materials[0].shininess, 20.0);
        assert!(scene.materials_in_file(7).is_empty());
    }
}

#[test]
fn a_light_takes_the_keys_of_a_scene_file() {
    let light = LightSpec::from_option_text(
        "spot name=key position=1,2,3 direction=0, -1, 0 color=#ffffff intensity=2 inner-angle=10 quadratic=0.5",
    )
    .unwrap();
    assert_eq!(light.kind, LightSourceKind::Spot);
    assert_eq!(light.name, "key");
    assert_eq!(light.position, Some([1.0, 2.0, 3.0]));
    assert_eq!(light.direction, Some([0.0, -1.0, 0.0]));
    assert_eq!(light.color, Some(Color([1.0; 3])));
    assert_eq!((light.intensity, light.inner_angle, light.quadratic), (Some(2.0), Some(10.0), Some(0.5)));
    let lamp = LightSpec::from_option_text("rectangle position=0,1,0 direction=0,-1,0 size=2,0.5").unwrap();
    assert_eq!((lamp.kind, lamp.size), (LightSourceKind::Rectangle, Some([2.0, 0.5])));
    assert_eq!(LightSpec::from_option_text("point position=0,1,0 radius=0.2").unwrap().radius, Some(0.2));
    let grey = LightSpec::from_option_text("ambient color=0.5 name=3").unwrap();
    assert_eq!((grey.color, grey.name.as_str()), (Some(Color::grey(0.5)), "3"));
}

#[test]
fn a_motion_is_written_with_its_light() {
    let light =
        LightSpec::from_option_text("point position=1,2,1.5 motion=oscillate period=2 amplitude=0,0,2").unwrap();
    let motion = light.motion.unwrap();
    assert_eq!((motion.kind, motion.period, motion.amplitude), (MotionKind::Oscillate, 2.0, Some([0.0, 0.0, 2.0])));
    let light = LightSpec::from_option_text("point motion=path period=4 points=0,0,0;1,0,0;1,1,0").unwrap();
    assert_eq!(light.motion.unwrap().points, Some(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]));
}

#[test]
fn a_light_can_be_off() {
    let off = LightSpec::from_option_text("point off position=1,2,3").unwrap();
    assert_eq!(off.enabled, Some(false));
    assert_eq!(LightSpec::from_option_text("point position=1,2,3 enabled=false").unwrap(), off);
    let on = LightSpec::from_option_text("point position=1,2,3").unwrap();
    assert_eq!(on.enabled, None);
    assert_eq!(
        LightSpec::from_option_text("point off enabled=true position=1,2,3").unwrap_err(),
        "`point off enabled=true position=1,2,3`, at 11: `enabled` is given twice",
    );
}

#[test]
fn errors_have_a_place_in_the_text() {
    let check_message = |text: &str, expected: &str| {
        assert_eq!(LightSpec::from_option_text(text).unwrap_err(), expected);
    };
    check_message(
        "point position=1,2,3 colr=1,1,1",
        "`point position=1,2,3 colr=1,1,1`, at 22: unknown key `colr` in a light; did you mean `color`? Known keys: \
         name, enabled, position, direction, radius, size, color, spectrum, intensity, constant, linear, quadratic, inner_angle, outer_angle, \
         motion, period, amplitude, center, axis, points",
    );
    check_message(
        "pont position=1,2,3",
        "`pont position=1,2,3`: `kind`: invalid kind of light `pont`: expected one of ambient, directional, \
         point, spot, rectangle; did you mean `point`?",
    );
    check_message(
        "point position=1,2",
        "`point position=1,2`, at 16: `position`: expected three numbers [x, y, z], found a list of 2",
    );
    check_message(
        "position=1,2,3",
        "`position=1,2,3`: a light begins with its kind of light: ambient, directional, point, spot or rectangle",
    );
    check_message(
        "point position=1,2,3 position=1,2,3",
        "`point position=1,2,3 position=1,2,3`, at 22: `position` is given twice",
    );
    check_message("point position=", "`point position=`, at 7: `position` has no value: expected key=value");
    check_message("point", "`point`: this point light needs `position`");
    check_message(
        "ambient position=1,2,3",
        "`ambient position=1,2,3`, at 18: `position` does not belong to an ambient light; it takes kind, name, color, \
         intensity",
    );
    check_message(
        "point position=1,2,3 period=2",
        "`point position=1,2,3 period=2`, at 22: a light that moves needs motion=oscillate, motion=circle or \
         motion=path",
    );
    check_message(
        "point position=1,2,3 motion=circle center=0,0,0 period=-2",
        "`point position=1,2,3 motion=circle center=0,0,0 period=-2`, at 56: `period` must be greater than 0, in \
         seconds, not -2",
    );
    check_message(
        "ambient intensity=nan",
        "`ambient intensity=nan`, at 19: `intensity` must be finite and not negative, not NaN",
    );
}

#[test]
fn a_material_takes_several_keys() {
    let material = MaterialOverride::from_option_text("diffuse=1,0.5,0,shininess=32, textures=false").unwrap();
    assert_eq!(material.diffuse, Some(Color([1.0, 0.5, 0.0])));
    assert_eq!((material.shininess, material.textures), (Some(32.0), Some(false)));
    let error = MaterialOverride::from_option_text("shinyness=3").unwrap_err();
    assert!(error.contains("did you mean `shininess`?"), "{error}");
    let error = MaterialOverride::from_option_text("opacity=2").unwrap_err();
    assert!(error.ends_with("at 9: `opacity` must be 0 to 1, not 2"), "{error}");
}

#[test]
fn names_of_materials_come_first() {
    let read = |text: &str| MaterialOverride::from_option_text(text).unwrap_or_else(|e| panic!("{e}"));
    let glass = MaterialOverride { medium: Some(Medium::Glass), ..MaterialOverride::default() };
    for text in ["glass", "Glass", "medium=glass"] {
        assert_eq!(read(text), glass, "{text}");
    }
    let mirror = MaterialOverride { reflectivity: Some(1.0), ..MaterialOverride::default() };
    assert_eq!((read("mirror"), read("reflectivity=1")), (mirror.clone(), mirror));
    assert_eq!(read("glass dispersion=0.02"), MaterialOverride { dispersion: Some(0.02), ..glass });
    for (name, medium) in
        [("water", Medium::Water), ("ice", Medium::Ice), ("diamond", Medium::Diamond), ("air", Medium::Air)]
    {
        assert_eq!(read(name).medium, Some(medium));
    }
    let all = read("diamond,fresnel=schlick,surfaces=two,tint=1,0.9,0.8,absorption=0.1 transmission=0.5");
    assert_eq!(
        (all.medium, all.fresnel, all.surfaces),
        (Some(Medium::Diamond), Some(Fresnel::Schlick), Some(Surfaces::Two))
    );
    assert_eq!((all.tint, all.absorption), (Some(Color([1.0, 0.9, 0.8])), Some(Color::grey(0.1))));
    assert_eq!(all.transmission, Some(0.5));

    let check_message = |text: &str, expected: &str| {
        assert_eq!(MaterialOverride::from_option_text(text).unwrap_err(), expected);
    };
    check_message(
        "glas",
        "`glas`: `glas` has no value: expected key=value or one of mirror, air, water, ice, glass, diamond; did you \
         mean `glass`?",
    );
    check_message(
        "velvet",
        "`velvet`: `velvet` has no value: expected key=value or one of mirror, air, water, ice, glass, diamond",
    );
    check_message("glass water", "`glass water`, at 7: `medium` is given twice");
    check_message("glass medium=water", "`glass medium=water`, at 7: `medium` is given twice");
    check_message("mirror reflectivity=2", "`mirror reflectivity=2`, at 8: `reflectivity` is given twice");
    check_message("reflectivity=2", "`reflectivity=2`, at 14: `reflectivity` must be 0 to 1, not 2");
    check_message("dispersion=3", "`dispersion=3`, at 12: `dispersion` must be -1 to 1, not 3");
    check_message(
        "tint=1,1,2",
        "`tint=1,1,2`, at 6: `tint` must be 0 to 1 in each channel: a body cannot transmit more light than it receives",
    );
    check_message(
        "medium=glas",
        "`medium=glas`, at 8: `medium`: invalid medium `glas`: expected one of air, water, ice, glass, diamond; \
         did you mean `glass`?",
    );
}
