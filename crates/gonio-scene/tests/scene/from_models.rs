//! What a scene takes from its models' files besides triangles: metal and roughness, lights, cameras; and models that
//! are compressed, mapped, or held to limits; built-in spheres
//! of any number of triangles, and scenes in other levels of detail.

use crate::{Memory, TRIANGLE, png};
use gonio_light::microfacet::shininess_of_roughness;
use gonio_mesh::{Limits, Wrap, simplify};
use gonio_scene::detail::{self, LevelOfDetail};
use gonio_scene::files::{BuiltinOnly, Disk};
use gonio_scene::load::{describe, load, load_within};
use gonio_scene::scene_file::{LightSourceKind, Normals, ObjectSpec, SceneFile};
use gonio_scene::{Scene, inspect, model_file, toml_file};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// One triangle (0 0 0) (1 0 0) (0 1 0) with texture coordinates, seen by what `more` adds.
fn gltf(more: Value) -> Memory {
    let numbers = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    let buffer: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    let mut document = json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
        "materials": [{}],
        "buffers": [{ "uri": "b.bin", "byteLength": 60 }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 24 }
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" }
        ]
    });
    for (key, value) in more.as_object().unwrap() {
        document[key] = value.clone();
    }
    Memory::default().with("m.gltf", document.to_string()).with("b.bin", buffer)
}

fn loaded(files: &Memory) -> Scene {
    load(describe(&["m.gltf"], files).unwrap(), Path::new(""), files).unwrap()
}

/// Metalness 1 on the left half, 0 on the right one (blue); roughness 0.5 everywhere (green).
fn metal_and_roughness() -> Vec<u8> {
    png(2, 1, |x, _| [0, 128, if x == 0 { 255 } else { 0 }, 255])
}

#[test]
fn textures_of_metal_and_roughness_become_terms_of_the_equation() {
    let files = gltf(json!({
        "materials": [{ "pbrMetallicRoughness": {
            "baseColorFactor": [1.0, 0.5, 0.0, 1.0], "roughnessFactor": 0.8,
            "metallicRoughnessTexture": { "index": 0 }
        }}],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "wrapS": 33648, "wrapT": 33071 }],
        "images": [{ "uri": "mr%20.png" }]
    }))
    .with("mr .png", metal_and_roughness());
    let scene = loaded(&files);
    let material = &scene.materials[0];
    let texels = |bound: Option<gonio_scene::BoundTexture>| scene.textures[bound.unwrap().texture].rgba.clone();
    // The metal has no diffuse colour; its factor is applied by the material.
    assert_eq!(texels(material.maps.diffuse), [0, 0, 0, 255, 255, 255, 255, 255]);
    assert_eq!(material.material.diffuse, [1.0, 0.5, 0.0]);
    // The metal's specular colour is its base colour (sRGB 188 is 0.5), what is no metal has 0.04 (sRGB 56).
    assert_eq!(texels(material.maps.specular), [255, 188, 0, 255, 56, 56, 56, 255]);
    assert_eq!(material.material.specular, [1.0; 3]);
    let shininess = material.maps.shininess.unwrap();
    assert_eq!(shininess.wrap, [Wrap::Mirror, Wrap::Clamp]);
    assert_eq!((texels(material.maps.shininess)[0], material.maps.roughness), (128, Some(0.8)));
    assert!(scene.diagnostics.iter().all(|d| !d.message.contains("not to be found")), "{:?}", scene.diagnostics);
}

#[test]
fn numbers_of_metal_and_roughness_need_no_texture() {
    let pbr = json!({ "baseColorFactor": [0.5, 0.5, 0.5, 1.0], "metallicFactor": 0.25, "roughnessFactor": 0.5 });
    let scene = loaded(&gltf(json!({ "materials": [{ "pbrMetallicRoughness": pbr }] })));
    let material = &scene.materials[0].material;
    assert_eq!(material.diffuse, [0.375; 3]);
    // 0.04 + (0.5 - 0.04) / 4, in f32.
    assert!(material.specular.iter().all(|s| (s - 0.155).abs() < 1e-6), "{:?}", material.specular);
    assert_eq!(f64::from(material.shininess), shininess_of_roughness(0.5));
    assert_eq!((scene.materials[0].maps.shininess, scene.materials[0].maps.roughness), (None, None));
}

/// A camera at (0, 0, 5) that is half as wide as usual, and a point light of 100 cd at (0, 0, 2).
fn with_camera_and_light() -> Memory {
    gltf(json!({
        "scenes": [{ "nodes": [0, 1, 2] }],
        "nodes": [
            { "mesh": 0 },
            { "camera": 0, "name": "Above", "translation": [0, 0, 5] },
            { "name": "Lamp", "translation": [0, 0, 2], "extensions": { "KHR_lights_punctual": { "light": 0 } } }
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1, "zfar": 50.0 } }],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [
            { "type": "point", "color": [1.0, 0.5, 0.25], "intensity": 100.0 }
        ] } }
    }))
}

#[test]
fn a_scene_without_lights_has_those_of_its_models() {
    let scene = loaded(&with_camera_and_light());
    let [lamp] = scene.settings.lights.as_slice() else { panic!("{:?}", scene.settings.lights) };
    assert_eq!((lamp.kind, lamp.name.as_str()), (LightSourceKind::Point, "Lamp"));
    assert_eq!((lamp.position, lamp.quadratic), (Some([0.0, 0.0, 2.0]), 1.0));
    // The middle is (0.5, 0.5, 0), 4.5 squared away: 100 cd are scaled so that 1 arrives there.
    let intensity = lamp.intensity;
    assert!((intensity - 4.5).abs() < 1e-6, "{intensity}");
    let note = scene.diagnostics.iter().find(|d| d.message.starts_with("lit by")).unwrap();
    assert_eq!(
        note.to_string(),
        "m.gltf: note: lit by the model's own light, scaled by 4.500e-2 so that the centre of the scene receives 1 in total"
    );
    // A light of the scene's own is all that counts.
    let text = "[[object]]\nmodel = \"m.gltf\"\n[[light]]\nkind = \"ambient\"\n";
    let own = load(toml_file::read(text).unwrap(), Path::new(""), &with_camera_and_light()).unwrap();
    assert_eq!(own.settings.lights.len(), 1);
    assert_eq!(own.settings.lights[0].kind, LightSourceKind::Ambient);
}

#[test]
fn a_camera_of_the_file_is_used_on_request() {
    let files = with_camera_and_light();
    let with = |camera: &str| {
        let text = format!("[camera]\n{camera}\n[[object]]\nmodel = \"m.gltf\"\ntranslate = [1, 0, 0]\n");
        load(toml_file::read(&text).unwrap(), Path::new(""), &files)
    };
    for name in ["Above", "1"] {
        let camera = with(&format!("from_model = \"{name}\"")).unwrap().settings.camera;
        // Moved with its object, looking along -z.
        assert_eq!((camera.position, camera.target()), ([1.0, 0.0, 5.0], Some([1.0, 0.0, 4.0])));
        assert!((camera.fov_y - 0.5_f64.to_degrees()).abs() < 1e-5);
        assert!((camera.far - 50.0).abs() < 1e-5);
    }
    let own = with("from_model = \"Above\"\nfov_y = 10").unwrap().settings.camera;
    assert_eq!((own.fov_y, own.position), (10.0, [1.0, 0.0, 5.0]));
    let error = with("from_model = \"Below\"").unwrap_err().to_string();
    assert_eq!(error, "camera.from_model: unknown camera `Below`: the models have Above");
    let framed = with("").unwrap();
    assert!(framed.camera_was_framed, "by default the camera frames the objects");
}

#[test]
fn a_compressed_model_is_read_within_its_limit() {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    std::io::Write::write_all(&mut encoder, TRIANGLE.as_bytes()).unwrap();
    let packed = encoder.finish().unwrap();
    let files = Memory::default().with("t.obj.gz", packed).with("t.mtl", "newmtl m\nKd 0.1 0.2 0.3\n");
    let read = |limits: &Limits| {
        let scene = describe(&["t.obj.gz"], &files).unwrap();
        load_within(scene, Path::new(""), &files, limits)
    };
    let scene = read(&Limits::default()).unwrap();
    assert_eq!(scene.meshes[0].triangle_count(), 1);
    assert_eq!(scene.materials[0].material.diffuse, [0.1, 0.2, 0.3]);
    let error = read(&Limits { max_bytes: 50, ..Limits::default() }).unwrap_err().to_string();
    assert!(error.starts_with("t.obj.gz: ") && error.contains("50"), "{error}");
}

#[test]
fn textures_together_have_a_limit() {
    let (a, b) = (png(8, 8, |_, _| [9; 4]), png(8, 8, |_, _| [8; 4]));
    let library = "newmtl m\nmap_Kd a.png\nmap_Ks b.png\n";
    let read = (TRIANGLE.len() + library.len() + a.len() + b.len()) as u64;
    let files = Memory::default().with("t.obj", TRIANGLE).with("t.mtl", library).with("a.png", a).with("b.png", b);
    let limits = Limits { max_bytes: read + 300, ..Limits::default() };
    let scene = load_within(describe(&["t.obj"], &files).unwrap(), Path::new(""), &files, &limits).unwrap();
    // 8 x 8 x 4 bytes fit once.
    assert!(scene.materials[0].maps.diffuse.is_some() && scene.materials[0].maps.specular.is_none());
    let warning = scene.diagnostics.iter().find(|d| d.message.contains("map_Ks")).unwrap();
    assert!(warning.message.contains("the textures together would take more than"), "{warning}");
}

/// Larger files are mapped, not read: the bytes are the same.
#[test]
fn a_mapped_file_is_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.obj");
    let padding = "# nothing\n".repeat(20_000);
    std::fs::write(&path, format!("{padding}{}", TRIANGLE.replace("mtllib t.mtl\n", ""))).unwrap();
    let name = path.to_string_lossy();
    let file = model_file::read(&path, &name, &Disk, &Limits::default()).unwrap();
    assert_eq!((file.model.mesh.triangle_count(), file.size), (1, 200_000 + TRIANGLE.len() as u64 - 13));
}

#[test]
fn an_inspection_reports_the_source_of_each_value() {
    let files = Memory::default()
        .with("t.obj", TRIANGLE)
        .with("t.mtl", "newmtl m\nKd 0 0 0\nNs 20\nmap_Kd Wood.PNG\nmap_Ks none.png\n")
        .with("art/wood.png", png(4, 2, |_, _| [255; 4]))
        .with("wood.png", png(4, 2, |_, _| [255; 4]));
    let report = inspect::inspect("t.obj", &files, &Limits::default()).unwrap();
    assert_eq!((report.geometry.triangles, report.geometry.vertices), (1, 3));
    assert_eq!((report.geometry.min, report.geometry.max), ([0.0; 3], [1.0, 1.0, 0.0]));
    assert_eq!(report.geometry.parts[0].material, "m");
    // 3 vertices of 8 floats, 3 indices.
    assert_eq!(report.geometry.memory.iter().map(|m| m.count).sum::<u64>(), 3 * 32 + 12);
    assert_eq!((report.surface.closed, report.surface.boundary_edges.count), (false, 3));
    assert_eq!(
        (report.files[0].name.as_str(), report.files[0].line, report.files[0].found.as_deref()),
        ("t.mtl", Some(1), Some("t.mtl"))
    );
    let [wood, none] = report.textures.as_slice() else { panic!("{:?}", report.textures) };
    assert_eq!((wood.found.as_deref(), wood.size, wood.line), (Some("wood.png"), Some([4, 2]), Some(4)));
    assert_eq!((none.found.as_deref(), none.tried.as_slice()), (None, &["none.png".to_owned()][..]));
    let value = |property: &str| report.materials[0].values.iter().find(|v| v.property == property).unwrap();
    assert_eq!((value("shininess").value.as_str(), value("shininess").line), ("20", Some(3)));
    assert_eq!((value("diffuse").value.as_str(), value("diffuse").line), ("1 1 1", Some(2)));
    assert!(value("diffuse").rule.contains("black"), "{:?}", value("diffuse"));
    assert!(value("specular").rule.contains("not written"), "{:?}", value("specular"));
    let features: Vec<&str> = report.differences.iter().map(|d| d.feature).collect();
    assert!(features.contains(&"Kd 0 0 0 beside map_Kd"), "{features:?}");
    assert!(features.contains(&"textures that are not at the path in the file"), "{features:?}");
    let line = inspect::explain_line("t.obj", 10, &files, &Limits::default()).unwrap();
    assert!(line.text.starts_with("f 1/1/1"), "{line:?}");
    let lines = inspect::lines_around("t.mtl", 3, 1, &files, &Limits::default()).unwrap();
    assert_eq!(
        (lines.excerpt.first_line, lines.excerpt.lines.as_slice()),
        (2, &["Kd 0 0 0", "Ns 20", "map_Kd Wood.PNG"].map(String::from)[..])
    );
    assert!(lines.explanation.unwrap().meaning.contains("highlight"));
    let scene = Memory::default().with("scene.toml", "[[object]]\nmodel = \"t.obj\"\n");
    let lines = inspect::lines_around("scene.toml", 2, 9, &scene, &Limits::default()).unwrap();
    assert_eq!((lines.excerpt.line_count, lines.explanation), (2, None));
    let error = inspect::lines_around("none.obj", 1, 9, &scene, &Limits::default()).unwrap_err().to_string();
    assert!(error.starts_with("none.obj: "), "{error}");
    let error = inspect::explain_line("art/wood.png", 1, &files, &Limits::default()).unwrap_err().to_string();
    assert!(error.starts_with("art/wood.png: this is a PNG image"), "{error}");
}

fn opened(model: &str, normals: Normals) -> Result<Scene, String> {
    let object = ObjectSpec { model: model.into(), normals, ..ObjectSpec::default() };
    let scene = SceneFile { objects: vec![object], ..SceneFile::default() };
    load(scene, Path::new(""), &BuiltinOnly).map_err(|e| e.to_string())
}

#[test]
fn a_sphere_has_the_number_of_triangles_in_its_name() {
    for (model, triangles) in [("builtin:sphere-8", 8), ("builtin:sphere_72", 72), ("builtin:sphere-4232", 4232)] {
        let loaded = opened(model, Normals::File).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(loaded.meshes[0].triangle_count(), triangles);
        assert!(loaded.objects[0].closed);
        // The material of the other spheres.
        let same = opened("builtin:sphere-smooth", Normals::File).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(loaded.materials, same.materials);
        for (p, n) in loaded.meshes[0].positions.iter().zip(&loaded.meshes[0].normals) {
            assert!(p.iter().zip(n).all(|(p, n)| (p - n).abs() < 1e-6), "{p:?} has the normal {n:?}");
        }
    }
}

#[test]
fn impossible_numbers_are_refused_with_the_possible_ones() {
    let error = opened("builtin:sphere-100", Normals::File).err().unwrap_or_default();
    assert!(error.contains("72") && error.contains("128"), "{error}");
    let error = opened("builtin:sphere-08", Normals::File).err().unwrap_or_default();
    assert!(error.contains("sphere-N"), "{error}");
}

#[test]
fn a_scene_at_another_level_of_detail_is_the_same_scene() {
    let loaded = opened("builtin:sphere-smooth", Normals::Flat).unwrap_or_else(|e| panic!("{e}"));
    let spec = &loaded.settings.objects[0];
    let sphere =
        LevelOfDetail::Sphere(100).mesh_for(&loaded.meshes[0], spec).unwrap_or_else(|| panic!("it is a sphere"));
    // The next to 100 is 128; flat, as the object wants it.
    assert_eq!((sphere.triangle_count(), sphere.positions.len()), (128, 3 * 128));
    let coarse = detail::with_meshes(&loaded, &[Arc::new(sphere)]);
    let object = &coarse.objects[0];
    assert_eq!(coarse.meshes[object.mesh].triangle_count(), 128);
    assert_eq!(object.parts.iter().map(|part| part.triangle_count).sum::<usize>(), 128);
    assert_eq!(object.parts[0].material, loaded.objects[0].parts[0].material);
    assert!(object.closed);
    assert_eq!(coarse.settings, loaded.settings);

    let monkey = opened("builtin:suzanne", Normals::File).unwrap_or_else(|e| panic!("{e}"));
    let spec = &monkey.settings.objects[0];
    assert!(LevelOfDetail::Sphere(100).mesh_for(&monkey.meshes[0], spec).is_none(), "no sphere");
    assert!(LevelOfDetail::Share(1.0).mesh_for(&monkey.meshes[0], spec).is_none(), "all of it");
    let quarter = monkey.meshes[0].triangle_count() / 4;
    let mesh = LevelOfDetail::Share(0.25).mesh_for(&monkey.meshes[0], spec).unwrap_or_else(|| panic!("fewer"));
    assert!(mesh.triangle_count() <= quarter + 1);
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    assert_eq!(mesh, simplify::simplify(&monkey.meshes[0], mesh.triangle_count()));
}
