//! Writers: written models are read again, and losses are reported.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_fixtures::FixtureTable;
use gonio_mesh::write::{obj as write_obj, ply as write_ply};
use gonio_mesh::{
    AmbientRule, Channel, EmbeddedImage, Limits, Material, Mesh, MetallicRoughness, MissingSidecar, Model, ModelCamera,
    ModelLight, ModelLightKind, NoSidecars, Part, PropertySource, Sidecar, Sidecars, TextureMap, Wrap, obj, ply,
};
use std::path::Path;

/// The files of the table `obj.txt`, or those that gonio ships.
struct Files(Vec<(String, Vec<u8>)>);

impl Files {
    fn get(&self, name: &str) -> Option<&[u8]> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, bytes)| bytes.as_slice())
    }
}

impl Sidecars for &Files {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        let missing = || MissingSidecar { tried: vec![name.to_owned()], refused: None };
        let bytes = self.get(name.trim_start_matches("./")).ok_or_else(missing)?;
        Ok(Sidecar { path: name.to_owned(), bytes: bytes.to_vec() })
    }
}

/// One library, whatever it is called.
struct Library(Vec<u8>);

impl Sidecars for Library {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        assert_eq!(name, "out.mtl");
        Ok(Sidecar { path: name.to_owned(), bytes: self.0.clone() })
    }
}

/// Written as OBJ and read again.
fn through_obj(model: &Model) -> (Model, String, String) {
    let files = write_obj::write(model, "out.mtl");
    let again = obj::read(&files.obj, &mut Library(files.mtl.clone()), &Limits::default()).unwrap();
    (again, String::from_utf8(files.obj).unwrap(), String::from_utf8(files.mtl).unwrap())
}

fn through_ply(model: &Model, encoding: write_ply::PlyEncoding) -> Model {
    ply::read(&write_ply::write(model, "out", encoding).ply, &mut NoSidecars, &Limits::default()).unwrap()
}

/// The same triangles in the same order: positions and texture coordinates bit by bit. Readers make normals unit length
/// again: the tolerance is a few roundings of `f32`.
fn check_same_triangles(again: &Mesh, before: &Mesh, name: &str) {
    assert_eq!(again.indices.len(), before.indices.len(), "{name}");
    let has = |mesh: &Mesh| (!mesh.tex_coords.is_empty(), !mesh.normals.is_empty(), !mesh.colors.is_empty());
    assert_eq!(has(again), has(before), "{name}");
    for (corner, (&a, &b)) in again.indices.iter().zip(&before.indices).enumerate() {
        let (a, b) = (a as usize, b as usize);
        assert_eq!(again.positions[a].map(f32::to_bits), before.positions[b].map(f32::to_bits), "{name} {corner}");
        if let (Some(a), Some(b)) = (again.tex_coords.get(a), before.tex_coords.get(b)) {
            assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits), "{name} {corner}");
        }
        if let (Some(a), Some(b)) = (again.normals.get(a), before.normals.get(b)) {
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-7), "{name} {corner}: {a:?} {b:?}");
        }
    }
}

/// The name of the part and the material of each triangle.
fn surfaces(model: &Model) -> Vec<(String, Material)> {
    let of_part = |part: &Part| {
        let mut material = comparable(&model.materials[part.material]);
        if material.name.is_empty() {
            material.name = "default".to_owned();
        }
        vec![(part.name.clone(), material); part.triangle_count]
    };
    model.mesh.parts.iter().flat_map(of_part).collect()
}

/// Without the places in the file.
fn comparable(material: &Material) -> Material {
    let mut material = Material { sources: Vec::new(), file: None, ..material.clone() };
    // Ks and Ns are written beside Pr and Pm, for other readers.
    material.unused.retain(|source| !matches!(source.property, "Ks" | "Ns" | "specular" | "shininess"));
    material.unused.iter_mut().for_each(|source| source.line = None);
    let physical = material.metallic_roughness.as_mut().map(|p| [&mut p.metallic_map, &mut p.roughness_map]);
    let maps = [
        &mut material.diffuse_map,
        &mut material.specular_map,
        &mut material.emitted_map,
        &mut material.shininess_map,
        &mut material.opacity_map,
        &mut material.normal_map,
        &mut material.bump_map,
    ];
    maps.into_iter().chain(physical.into_iter().flatten()).flatten().for_each(|map| map.line = None);
    material
}

/// Each OBJ that can be read, of the table and of the models that gonio ships, with its name.
fn obj_models() -> Vec<(String, Model)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = FixtureTable::read(root.join("tests/obj.txt")).unwrap_or_else(|error| panic!("{error}"));
    let cases = table.files().iter().map(|file| (file.path.clone(), file.bytes.clone())).collect();
    let entries = std::fs::read_dir(root.join("../../assets/models")).unwrap().map(|entry| entry.unwrap().path());
    let shipped = entries.filter(|path| path.is_file());
    let shipped =
        shipped.map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read(&path).unwrap()));
    let mut models = Vec::new();
    for files in [Files(cases), Files(shipped.collect())] {
        for (name, bytes) in files.0.iter().filter(|(name, _)| name.ends_with(".obj")) {
            models.extend(obj::read(bytes, &mut &files, &Limits::default()).ok().map(|model| (name.clone(), model)));
        }
    }
    assert!(models.len() >= 40, "only {} models", models.len());
    models
}

/// Every OBJ of the corpus and every model that gonio ships: the same triangles, bit by bit, with the same materials.
#[test]
fn obj_files_come_back_as_they_were() {
    for (name, model) in obj_models() {
        let (again, ..) = through_obj(&model);
        check_same_triangles(&again.mesh, &model.mesh, &name);
        assert_eq!(surfaces(&again), surfaces(&model), "{name}");
        assert_eq!(again.mesh.smoothing_groups, model.mesh.smoothing_groups, "{name}");
        // sRGB there and back, each rounded to f32.
        let colors = again.mesh.colors.iter().flatten().zip(model.mesh.colors.iter().flatten());
        assert!(colors.clone().all(|(a, b)| (a - b).abs() < 1e-6), "{name}");
    }
}

/// The same by way of PLY, which has neither parts nor materials; colours have 8 bits there.
#[test]
fn meshes_come_back_from_ply() {
    for (name, model) in obj_models() {
        for encoding in [write_ply::PlyEncoding::Binary, write_ply::PlyEncoding::Ascii] {
            let again = through_ply(&model, encoding);
            check_same_triangles(&again.mesh, &model.mesh, &name);
            let colors = again.mesh.colors.iter().flatten().zip(model.mesh.colors.iter().flatten());
            assert!(colors.clone().all(|(a, b)| (a - b).abs() < 0.01), "{name}");
            let notes_only = again.diagnostics.iter().all(|d| d.severity == gonio_mesh::Severity::Note);
            assert!(notes_only, "{name}: {:?}", again.diagnostics);
        }
    }
}

fn triangle() -> Mesh {
    Mesh {
        positions: vec![[0.0, -0.0, 1e-7], [1.0, 0.1, 3.4e38], [0.0, 1.0, 0.333_333_34]],
        indices: vec![0, 1, 2],
        parts: vec![Part { triangle_count: 1, ..Part::default() }],
        ..Mesh::default()
    }
}

#[test]
fn a_triangle_by_its_letters() {
    let model = Model { mesh: triangle(), materials: vec![Material::default()], ..Model::default() };
    let files = write_obj::write(&model, "out.mtl");
    let expected = "# gonio\nv 0 -0 1e-7\nv 1 0.1 3.4e38\nv 0 1 0.33333334\nf 1 2 3\n";
    assert_eq!(String::from_utf8(files.obj).unwrap(), expected);
    assert_eq!((files.mtl.len(), files.images.len(), files.diagnostics), (0, 0, vec![]));
    let files = write_ply::write(&model, "out", write_ply::PlyEncoding::Ascii);
    let expected = "ply\nformat ascii 1.0\ncomment gonio\nelement vertex 3\nproperty float x\nproperty float y\n\
                    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                    0 -0 1e-7\n1 0.1 3.4e38\n0 1 0.33333334\n3 0 1 2\n";
    assert_eq!(String::from_utf8(files.ply).unwrap(), expected);
    assert_eq!(files.diagnostics, vec![]);
}

/// Vertices that differ in a normal only share a `v`; the four forms of `f`.
#[test]
fn equal_values_are_written_once() {
    let quad = Mesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]],
        normals: vec![[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        tex_coords: vec![[0.5, 0.5]; 4],
        indices: vec![0, 1, 2, 3, 1, 2],
        ..Mesh::default()
    };
    let faces = |mesh: Mesh| {
        let (_, text, _) = through_obj(&Model { mesh, materials: vec![Material::default()], ..Model::default() });
        assert_eq!(text.matches("v ").count(), 3, "{text}");
        text.lines().filter(|line| line.starts_with('f')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(faces(quad.clone()), ["f 1/1/1 2/1/1 3/1/1", "f 1/1/2 2/1/1 3/1/1"]);
    assert_eq!(faces(Mesh { tex_coords: vec![], ..quad.clone() }), ["f 1//1 2//1 3//1", "f 1//2 2//1 3//1"]);
    assert_eq!(faces(Mesh { normals: vec![], ..quad.clone() }), ["f 1/1 2/1 3/1", "f 1/1 2/1 3/1"]);
    assert_eq!(faces(Mesh { tex_coords: vec![], normals: vec![], ..quad }), ["f 1 2 3", "f 1 2 3"]);
}

/// A model of one triangle for each material, each a part of its own.
fn painted(materials: Vec<Material>) -> Model {
    let mut mesh = Mesh { parts: vec![], ..triangle() };
    mesh.tex_coords = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    for material in 0..materials.len() {
        mesh.parts.push(Part { name: String::new(), material, first_triangle: material, triangle_count: 1 });
    }
    mesh.indices = [0, 1, 2].repeat(materials.len());
    Model { mesh, materials, ..Model::default() }
}

/// A material with every property that MTL has.
fn rich() -> Material {
    let map = TextureMap::new;
    let placed = TextureMap { scale: [2.0, 0.5], offset: [0.25, -1.0], wrap: [Wrap::Clamp; 2], ..map("a b.png") };
    let mut inverted = map("textures/o.png");
    (inverted.texel.base, inverted.texel.gain, inverted.texel.channel) = (1.0, -1.0, Some(Channel::Green));
    Material {
        name: "rich".to_owned(),
        ambient: AmbientRule::Value([0.1, 0.2, 0.3]),
        diffuse: [0.3, 0.1, 0.7],
        specular: [0.5, 0.25, 0.125],
        emitted: [2.0, 0.7, 0.1],
        shininess: 37.5,
        refraction_index: 1.33,
        opacity: 0.3,
        illumination_model: Some(2),
        diffuse_map: Some(placed),
        specular_map: Some(map("s.png")),
        emitted_map: Some(map("e.png")),
        shininess_map: Some(map("n.png")),
        opacity_map: Some(inverted),
        normal_map: Some(TextureMap { bump_multiplier: 0.5, ..map("-normal.png") }),
        bump_map: Some(TextureMap { bump_multiplier: 3.0, ..map("bump.png") }),
        ..Material::default()
    }
}

fn metal() -> Material {
    let mut roughness_map = TextureMap::new("orm.png");
    roughness_map.texel.channel = Some(Channel::Green);
    let (base_color, metallic, roughness) = ([0.9, 0.6, 0.2], 0.75, 0.4);
    Material {
        name: "metal".to_owned(),
        diffuse: MetallicRoughness::diffuse(base_color, metallic),
        specular: MetallicRoughness::specular(base_color, metallic),
        shininess: MetallicRoughness::shininess(roughness),
        metallic_roughness: Some(MetallicRoughness {
            base_color,
            metallic,
            roughness,
            metallic_map: Some(TextureMap::new("m.png")),
            roughness_map: Some(roughness_map),
        }),
        ..Material::default()
    }
}

#[test]
fn every_field_of_a_material_comes_back() {
    let model = painted(vec![rich(), metal()]);
    let (again, obj, mtl) = through_obj(&model);
    let warnings: Vec<_> = again.diagnostics.iter().filter(|d| d.severity > gonio_mesh::Severity::Note).collect();
    assert!(warnings.is_empty(), "{warnings:?}\n{mtl}");
    let mut expected = rich();
    // A name that begins like an option is written with its folder.
    expected.normal_map.as_mut().unwrap().path = "./-normal.png".to_owned();
    assert_eq!(comparable(&again.materials[0]), expected, "{mtl}");
    assert_eq!(comparable(&again.materials[1]), metal(), "{mtl}");
    assert!(obj.contains("mtllib out.mtl\n") && obj.contains("usemtl rich\nf 1/1 2/2 3/3\nusemtl metal\n"), "{obj}");
    assert!(mtl.contains("map_Kd -s 2 0.5 1 -o 0.25 -1 0 -clamp on a b.png\n"), "{mtl}");
    assert!(mtl.contains("map_d -mm 1 -1 -imfchan g textures/o.png\n"), "{mtl}");
    assert!(mtl.contains("map_Bump -bm 3 bump.png\n"), "{mtl}");
}

#[test]
fn names_are_made_fit() {
    let named = |name: &str| Material { name: name.to_owned(), ..rich() };
    let mut model = painted(vec![named("a\nb"), named("a_b"), named(""), named("x # y"), named("Material #25")]);
    for (part, name) in model.mesh.parts.iter_mut().zip(["one\rtwo", "hash # tag", "", "back\\", "plain name"]) {
        part.name = name.to_owned();
    }
    let files = write_obj::write(&model, "out.mtl");
    let again = obj::read(&files.obj, &mut Library(files.mtl), &Limits::default()).unwrap();
    let names: Vec<&str> = again.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["a_b", "a_b.2", "default", "x _ y", "Material #25"]);
    let parts: Vec<&str> = again.mesh.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(parts, ["one_two", "hash _ tag", "", "back_", "plain name"]);
    let messages: Vec<String> = files.diagnostics.iter().map(ToString::to_string).collect();
    let expected = [
        "note: the material \"a\\nb\" is written as a_b",
        "note: the material \"a_b\" is written as a_b.2",
        "note: the material \"x # y\" is written as x _ y",
        "note: 3 names with line ends, comments or blanks around them were changed: OBJ cannot hold them",
    ];
    assert_eq!(messages, expected);
}

fn lossy() -> Model {
    let mut material = Material { name: "m".to_owned(), ..Material::default() };
    let map =
        TextureMap { rotation: 1.0, wrap: [Wrap::Mirror, Wrap::Repeat], embedded: Some(1), ..TextureMap::new("x") };
    material.diffuse_map = Some(map);
    material.emitted_map = Some(TextureMap::new("black.png"));
    let sheen = |property, written: &str| PropertySource {
        property,
        line: None,
        written: written.to_owned(),
        rule: String::new(),
    };
    material.unused = vec![sheen("sheen", "sheenColorFactor = 1"), sheen("Pc", "Pc 0.5")];
    let mut model = painted(vec![material]);
    model.images = vec![
        EmbeddedImage { name: "unused".to_owned(), bytes: vec![] },
        EmbeddedImage { name: "../wood grain.png".to_owned(), bytes: b"\x89PNG\r\n\x1a\n".to_vec() },
    ];
    model.mesh.colors = vec![[1.5, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.5], [0.0; 4]];
    model.lights.push(ModelLight {
        name: String::new(),
        kind: ModelLightKind::Point,
        position: [0.0; 3],
        direction: [0.0, 0.0, -1.0],
        color: [1.0; 3],
        intensity: 1.0,
        attenuation: [0.0, 0.0, 1.0],
    });
    let (position, direction, up) = ([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]);
    model.cameras.push(ModelCamera { name: String::new(), position, direction, up, fov_y_rad: None, clip: [None; 2] });
    model
}

#[test]
fn losses_in_obj_are_reported() {
    let files = write_obj::write(&lossy(), "out.mtl");
    let messages: Vec<String> = files.diagnostics.iter().map(ToString::to_string).collect();
    let expected = [
        "warning: the material \"m\" has a rotation of its map_Kd, which MTL cannot hold: it is lost",
        "warning: the material \"m\" has a way to wrap around of its map_Kd, which MTL cannot hold: it is lost",
        "note: the material \"m\" has a map_Ke of \"black.png\" that is multiplied by 0: it is left out",
        "note: the material \"m\" has properties without a term in the light equation, which are not written: sheen",
        "warning: 1 light not written: OBJ has none",
        "warning: 1 camera not written: OBJ has none",
        "warning: the alpha of vertex colors is not written: OBJ has none",
        "warning: vertex colors outside 0 to 1 are clamped: OBJ has none",
    ];
    assert_eq!(messages, expected);
    let images: Vec<_> = files.images.iter().map(|file| (file.name.as_str(), file.image)).collect();
    assert_eq!(images, [("out_wood_grain.png", 1)]);
    let mtl = String::from_utf8(files.mtl).unwrap();
    assert!(mtl.contains("map_Kd out_wood_grain.png\n") && mtl.ends_with("Pc 0.5\n"), "{mtl}");
}

#[test]
fn losses_in_ply_are_reported() {
    let mut model = lossy();
    model.mesh.parts[0].name = "part".to_owned();
    let files = write_ply::write(&model, "out", write_ply::PlyEncoding::Binary);
    let messages: Vec<String> = files.diagnostics.iter().map(ToString::to_string).collect();
    let expected = [
        "warning: of 1 material only the diffuse texture is written: PLY has no more",
        "warning: 1 name of parts not written: PLY has none",
        "warning: 1 light not written: PLY has none",
        "warning: 1 camera not written: PLY has none",
        "note: vertex colors are rounded to 8 bits",
    ];
    assert_eq!(messages, expected);
    assert_eq!(files.images.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), ["out_wood_grain.png"]);
    let again = ply::read(&files.ply, &mut NoSidecars, &Limits::default()).unwrap();
    assert_eq!(again.materials[0].diffuse_map.as_ref().unwrap().path, "out_wood_grain.png");
    assert_eq!(again.mesh.colors[1], [0.0, 1.0, 0.0, 128.0 / 255.0]);
}

/// MeshLab's way of several textures.
#[test]
fn several_textures_of_ply() {
    let textured = |path: &str| {
        let mut material = Material { diffuse: [1.0; 3], ..Material::default() };
        material.diffuse_map = Some(TextureMap::new(path));
        material
    };
    let model = painted(vec![textured("a.png"), textured("b c.png"), textured("a.png")]);
    for encoding in [write_ply::PlyEncoding::Binary, write_ply::PlyEncoding::Ascii] {
        let files = write_ply::write(&model, "out", encoding);
        assert_eq!(files.diagnostics, vec![]);
        let again = ply::read(&files.ply, &mut NoSidecars, &Limits::default()).unwrap();
        let parts: Vec<_> = again.mesh.parts.iter().map(|part| (part.material, part.triangle_count)).collect();
        assert_eq!(parts, [(0, 1), (1, 1), (0, 1)]);
        let paths: Vec<_> = again.materials.iter().map(|m| m.diffuse_map.as_ref().unwrap().path.as_str()).collect();
        assert_eq!(paths, ["a.png", "b c.png"]);
    }
}
