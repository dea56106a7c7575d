//! Textures of materials: sought, decoded, and survived when missing.

use crate::memory::{Memory, TRIANGLE, png};
use gonio_mesh::Severity;
use gonio_scene::load::{describe, load};
use gonio_scene::{ColorSpace, Scene};
use std::path::Path;

fn loaded(mtl: &str, add: impl Fn(Memory) -> Memory) -> Scene {
    let files = Memory::default().with("models/t.obj", TRIANGLE).with("models/t.mtl", mtl);
    let files = add(files);
    load(describe(&["models/t.obj"], &files).unwrap(), Path::new(""), &files).unwrap()
}

fn warnings(scene: &Scene) -> Vec<String> {
    scene.diagnostics.iter().filter(|d| d.severity == Severity::Warning).map(ToString::to_string).collect()
}

#[test]
fn a_missing_texture_is_a_warning_that_names_every_place() {
    let scene = loaded("newmtl m\nKd 1 1 1\nmap_Kd textures\\wood.png\n", |f| f);
    assert_eq!(
        warnings(&scene),
        [
            "models/t.mtl:3: warning: map_Kd of material `m`: the texture `textures\\wood.png` is not to be found; looked at \
          models/textures/wood.png, models/wood.png (letters in any case). The material goes without it"
        ]
    );
    assert_eq!(scene.materials[0].maps.diffuse, None);
    assert_eq!(scene.objects.len(), 1);
}

/// Materials of the same name in two models are two: each is told of what it lacks.
#[test]
fn what_two_models_lack_is_said_of_both() {
    let mtl = "newmtl m\nmap_Kd wood.png\n";
    let files = Memory::default()
        .with("a/t.obj", TRIANGLE)
        .with("a/t.mtl", mtl)
        .with("a/wood.png", png(1, 1, |_, _| [255; 4]))
        .with("b/t.obj", TRIANGLE)
        .with("b/t.mtl", mtl);
    let scene = load(describe(&["a/t.obj", "b/t.obj"], &files).unwrap(), Path::new(""), &files).unwrap();
    let found = warnings(&scene);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("b/t.mtl:2: warning: map_Kd of material `m`: the texture `wood.png`"), "{found:?}");
}

#[test]
fn textures_are_found_in_any_case_with_backslashes_and_by_bare_name() {
    let white = || png(1, 1, |_, _| [255; 4]);
    for (written, lies_at) in [
        ("textures\\wood.png", "models/textures/wood.png"),
        ("Textures/WOOD.png", "models/textures/wood.PNG"),
        ("C:\\art\\wood.png", "models/wood.png"),
        ("/home/me/Wood.png", "models/wood.png"),
    ] {
        let scene = loaded(&format!("newmtl m\nmap_Kd {written}\n"), |f| f.with(lies_at, white()));
        assert_eq!(warnings(&scene), [""; 0], "{written}");
        assert_eq!(scene.textures[0].name, lies_at);
        assert_eq!(scene.textures[0].color_space, ColorSpace::Srgb);
        assert!(scene.materials[0].maps.diffuse.is_some());
    }
}

#[test]
fn a_broken_texture_is_a_warning() {
    let scene = loaded("newmtl m\nmap_Kd a.png\nmap_Ks b.png\n", |f| {
        let mut cut = png(64, 64, |x, y| [(x * 7 + y * 3) as u8, (x * y) as u8, 0, 255]);
        cut.truncate(cut.len() / 2);
        f.with("models/a.png", cut).with("models/b.png", "no picture at all")
    });
    let warnings = warnings(&scene);
    assert_eq!(warnings.len(), 2);
    assert!(warnings[0].contains("models/a.png: the picture is damaged"), "{}", warnings[0]);
    assert!(warnings[1].contains("models/b.png"), "{}", warnings[1]);
    assert_eq!(scene.textures.len(), 0);
    assert_eq!((scene.materials[0].maps.diffuse, scene.materials[0].maps.specular), (None, None));
}

#[test]
fn an_enormous_picture_is_refused_before_it_is_decoded() {
    // The header of a PNG of 60000 x 60000; a decoder without limits would want 14 GB.
    let mut bomb = png(1, 1, |_, _| [0; 4]);
    bomb[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
    let crc = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&crc.to_be_bytes());
    let scene = loaded("newmtl m\nmap_Kd a.png\n", |f| f.with("models/a.png", bomb.clone()));
    assert!(warnings(&scene)[0].contains("the picture is too large"), "{:?}", warnings(&scene));
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn heights_become_normals_and_normal_maps_stay() {
    // Heights that rise by 51/255 per texel to the right, dropping back at the seam.
    let ramp = || png(5, 2, |x, _| [51 * x as u8, 51 * x as u8, 51 * x as u8, 255]);
    let scene = loaded("newmtl m\nmap_Bump -bm 2 h.png\n", |f| f.with("models/h.png", ramp()));
    assert_eq!(warnings(&scene), [""; 0]);
    assert!(scene.diagnostics.iter().any(|d| d.message.contains("holds heights")), "{:?}", scene.diagnostics);
    let bound = scene.materials[0].maps.normal.unwrap();
    let texture = &scene.textures[bound.texture];
    assert_eq!(texture.color_space, ColorSpace::Data);
    // In the middle: slope 2 * 0.2, so the normal is (-0.4, 0, 1) / sqrt(1.16).
    let length = 1.16f64.sqrt();
    let expected = [-0.4 / length, 0.0, 1.0 / length].map(|c| (127.5 * (c + 1.0) + 0.5) as u8);
    assert_eq!(texture.rgba[4 * 2..4 * 2 + 3], expected);
    // At the seam the picture repeats: (0.2 - 0.8) / 2 * 2 = -0.6.
    let expected = (127.5 * (0.6 / 1.36f64.sqrt() + 1.0) + 0.5) as u8;
    assert_eq!(texture.rgba[0], expected);
    assert_eq!(scene.meshes[0].tangents.len(), scene.meshes[0].positions.len());

    let bluish = || png(2, 2, |_, _| [128, 128, 255, 255]);
    let scene = loaded("newmtl m\nmap_Bump n.png\n", |f| f.with("models/n.png", bluish()));
    assert_eq!(scene.textures[0].rgba[..4], [128, 128, 255, 255]);
    assert!(scene.diagnostics.iter().any(|d| d.message.contains("normal map")), "{:?}", scene.diagnostics);
}

#[test]
fn rows_run_down_and_v_runs_up() {
    // Light at the top: the slope along v is positive, so green is below the middle.
    let ramp = || {
        png(1, 5, |_, y| [255 - 51 * y as u8; 3].iter().chain([&255]).copied().collect::<Vec<_>>().try_into().unwrap())
    };
    let scene = loaded("newmtl m\nmap_Bump h.png\n", |f| f.with("models/h.png", ramp()));
    assert!(scene.textures[0].rgba[4 * 2 + 1] < 120 && scene.textures[0].rgba[4 * 2] == 128);
}

#[test]
fn opacity_is_alpha_where_there_is_one() {
    let scene = loaded("newmtl m\nmap_d a.png\n", |f| f.with("models/a.png", png(1, 1, |_, _| [10, 20, 30, 77])));
    assert_eq!(scene.textures[0].rgba[0], 77);
    assert!(scene.materials[0].is_transparent());
    let scene = loaded("newmtl m\nmap_d a.png\n", |f| f.with("models/a.png", png(1, 1, |_, _| [10, 20, 30, 255])));
    assert_eq!(scene.textures[0].rgba[0], 10);
}

#[test]
fn each_file_once_for_each_use() {
    let scene = loaded("newmtl m\nmap_Kd a.png\nmap_Ks A.png\nmap_Ns a.png\n", |f| {
        f.with("models/a.png", png(1, 1, |_, _| [1, 2, 3, 255]))
    });
    assert_eq!(scene.textures.len(), 2, "once as colour, once as data");
    let maps = &scene.materials[0].maps;
    assert_eq!(maps.diffuse, maps.specular);
    assert_ne!(maps.diffuse, maps.shininess);
    assert!(scene.meshes[0].tangents.is_empty(), "no normal map, no tangents");
}

#[test]
fn an_override_replaces_value_and_texture() {
    let files = Memory::default()
        .with("t.obj", TRIANGLE)
        .with("t.mtl", "newmtl m\nKd 0.1 0.2 0.3\nNs 5\nmap_Kd a.png\nmap_Ks a.png\n")
        .with("a.png", png(1, 1, |_, _| [255; 4]))
        .with(
            "s.toml",
            "[[object]]\nmodel = \"t.obj\"\n[object.material]\ndiffuse = [1, 0.5, 0]\nopacity = 0.5\n\
             [[object]]\nmodel = \"t.obj\"\nmaterial = { textures = false, shininess = 9 }\n\
             [[object]]\nmodel = \"t.obj\"\n",
        );
    let scene = load(describe(&["s.toml"], &files).unwrap(), Path::new(""), &files).unwrap();
    assert_eq!(scene.meshes.len(), 1, "one mesh for all three");
    let of = |object: usize| &scene.materials[scene.objects[object].parts[0].material];
    assert_eq!((of(0).material.diffuse, of(0).material.opacity), ([1.0, 0.5, 0.0], 0.5));
    assert!(of(0).maps.diffuse.is_none() && of(0).maps.specular.is_some());
    assert!(of(1).maps.diffuse.is_none() && of(1).maps.specular.is_none());
    assert_eq!((of(1).material.shininess, of(2).material.shininess), (9.0, 5.0));
    assert!(of(2).maps.diffuse.is_some());
}

#[test]
fn closed_means_closed_and_opaque() {
    let files = gonio_scene::files::BuiltinOnly;
    let mut scene = describe(&["builtin:cube", "builtin:cube", "builtin:still-life"], &files).unwrap();
    scene.objects[1].material.opacity = Some(0.5);
    let scene = load(scene, Path::new(""), &files).unwrap();
    let closed: Vec<bool> = scene.objects.iter().map(|o| o.closed).collect();
    assert_eq!(closed, [true, false, false]);
    assert!(scene.meshes.iter().all(|m| m.normals.len() == m.positions.len()));
}
