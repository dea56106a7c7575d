//! Models written as `.glb`, read again by this reader and by another.

use crate::builder::{near, rich};
use crate::second_reader;
use gonio_mesh::write::glb;
use gonio_mesh::{
    AmbientRule, Channel, EmbeddedImage, Limits, Material, Mesh, MetallicRoughness, Model, NoSidecars, NormalSource,
    Part, TexelRule, TextureMap, Wrap, gltf,
};
use serde_json::Value;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\nand no more of it";

/// The JSON and the binary chunk, by the specification's section 4.
fn chunks(bytes: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..8], word(8)), (&b"glTF\x02\0\0\0"[..], bytes.len()));
    let json_length = word(12);
    assert_eq!((&bytes[16..20], json_length % 4), (&b"JSON"[..], 0));
    let json = serde_json::from_slice(&bytes[20..20 + json_length]).unwrap();
    let at = 20 + json_length;
    if at == bytes.len() {
        return (json, &[]);
    }
    assert_eq!((&bytes[at + 4..at + 8], word(at) % 4), (&b"BIN\0"[..], 0));
    assert_eq!(at + 8 + word(at), bytes.len());
    (json, &bytes[at + 8..])
}

fn written(model: &Model) -> (Vec<u8>, Vec<String>) {
    let mut pictures = |map: &TextureMap| (map.path == "there.png").then(|| PNG.to_vec());
    let glb = glb::write(model, &mut pictures).unwrap();
    (glb.bytes, glb.diagnostics.iter().map(ToString::to_string).collect())
}

fn read(bytes: &[u8]) -> Model {
    gltf::read(bytes, &mut NoSidecars, &Limits::default()).unwrap()
}

fn quad() -> Mesh {
    Mesh {
        positions: vec![[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [1.0, 2.0, -3.0]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        tex_coords: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.75], [0.0, 0.25]],
        tangents: vec![[1.0, 0.0, 0.0, -1.0]; 4],
        colors: vec![[0.5, 0.25, 2.0, 1.0]; 4],
        indices: vec![0, 1, 2, 3, 2, 1],
        parts: vec![
            Part { name: "Lower".to_owned(), material: 1, first_triangle: 0, triangle_count: 1 },
            Part { name: "Upper".to_owned(), material: 0, first_triangle: 1, triangle_count: 1 },
        ],
        normal_source: NormalSource::File,
        ..Mesh::default()
    }
}

fn with_materials(materials: Vec<Material>) -> Model {
    let mut mesh = quad();
    mesh.parts.iter_mut().for_each(|part| part.material %= materials.len());
    Model { mesh, materials, ..Model::default() }
}

#[test]
fn geometry_comes_back() {
    let model =
        with_materials(vec![Material::default(), Material { name: "Second".to_owned(), ..Material::default() }]);
    let (bytes, messages) = written(&model);
    assert!(messages.is_empty(), "{messages:?}");
    let again = read(&bytes);
    let at = |mesh: &Mesh, corner: usize| mesh.indices[corner] as usize;
    for corner in 0..6 {
        let (a, b) = (at(&model.mesh, corner), at(&again.mesh, corner));
        assert_eq!(model.mesh.positions[a], again.mesh.positions[b]);
        assert_eq!(model.mesh.normals[a], again.mesh.normals[b]);
        assert_eq!(model.mesh.tex_coords[a], again.mesh.tex_coords[b]);
        assert_eq!(model.mesh.tangents[a], again.mesh.tangents[b]);
        assert_eq!(model.mesh.colors[a], again.mesh.colors[b]);
    }
    assert_eq!(again.mesh.parts, model.mesh.parts);
    assert_eq!(again.materials[1].name, "Second");
    second_reader::agree(&model, &second_reader::corners(&bytes));
}

/// Bounds, alignment and targets as the specification asks for.
#[test]
fn the_file_keeps_the_rules() {
    let (bytes, _) = written(&with_materials(vec![Material::default()]));
    let (json, binary) = chunks(&bytes);
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    assert_eq!(number(&json["buffers"][0]["byteLength"]).next_multiple_of(4), binary.len());
    let mut seen = 0;
    for accessor in json["accessors"].as_array().unwrap() {
        let view = &json["bufferViews"][number(&accessor["bufferView"])];
        assert_eq!((number(&view["byteOffset"]) + number(&accessor["byteOffset"])) % 4, 0);
        if accessor["type"] == "SCALAR" {
            assert_eq!((number(&view["target"]), number(&accessor["componentType"])), (34963, 5123));
            assert!(view.get("byteStride").is_none());
        } else {
            assert_eq!(number(&view["target"]), 34962);
        }
        if let Some(min) = accessor.get("min") {
            // Of the three corners of each part.
            let expected = [("[1.0,0.0,0.0]", "[2.0,2.0,0.0]"), ("[1.0,0.0,-3.0]", "[2.0,2.0,0.0]")][seen];
            assert_eq!((min.to_string().as_str(), accessor["max"].to_string().as_str()), expected);
            seen += 1;
        }
    }
    assert_eq!(seen, 2);
    assert_eq!(json["asset"]["version"], "2.0");
}

/// k_d, k_s, gamma, opacity, emission of a material that knows nothing of metal.
#[test]
fn materials_come_back() {
    let plain = Material {
        name: "Varnish".to_owned(),
        diffuse: [0.5, 0.25, 0.125],
        specular: [0.3, 0.2, 0.1],
        emitted: [2.0, 0.5, 0.0],
        shininess: 50.0,
        refraction_index: 1.33,
        opacity: 0.25,
        ..Material::default()
    };
    let (bytes, messages) = written(&with_materials(vec![plain.clone(), Material { shininess: 1.0, ..plain.clone() }]));
    assert!(messages.is_empty(), "{messages:?}");
    let again = read(&bytes).materials;
    let material = &again[0];
    near(&material.diffuse, &plain.diffuse);
    near(&material.specular, &plain.specular);
    near(&material.emitted, &plain.emitted);
    near(&[material.refraction_index, material.opacity], &[1.33, 0.25]);
    // Through roughness and back, in f32.
    assert!((material.shininess - 50.0).abs() < 1e-3, "{}", material.shininess);
    assert!((again[1].shininess - 1.0).abs() < 1e-5, "{}", again[1].shininess);
    let (json, _) = chunks(&bytes);
    assert_eq!(json["materials"][0]["alphaMode"], "BLEND");
    let used = ["KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular"];
    assert_eq!(json["extensionsUsed"], serde_json::json!(used));
    // gamma = 30 is a roughness of 0.5: 2 / 0.5^4 - 2.
    let (bytes, _) = written(&with_materials(vec![Material { shininess: 30.0, ..Material::default() }]));
    let roughness = chunks(&bytes).0["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"].as_f64().unwrap();
    assert!((roughness - 0.5).abs() < 1e-6, "{roughness}");
}

#[test]
fn metal_and_textures_come_back() {
    let map = |path: &str| TextureMap {
        embedded: Some(0),
        scale: [2.0, 3.0],
        rotation: 0.5,
        offset: [0.25, -0.5],
        wrap: [Wrap::Clamp, Wrap::Mirror],
        ..TextureMap::new(path)
    };
    let channel = |channel| TexelRule { channel: Some(channel), ..TexelRule::default() };
    let base = [0.75, 0.5, 0.25];
    let made = MetallicRoughness {
        base_color: base,
        metallic: 0.5,
        roughness: 0.25,
        metallic_map: Some(TextureMap { texel: channel(Channel::Blue), ..TextureMap::new("there.png") }),
        roughness_map: Some(TextureMap { texel: channel(Channel::Green), ..TextureMap::new("there.png") }),
    };
    let material = Material {
        diffuse: MetallicRoughness::diffuse(base, 0.5),
        specular: MetallicRoughness::specular(base, 0.5),
        shininess: MetallicRoughness::shininess(0.25),
        diffuse_map: Some(map("wood")),
        opacity_map: Some(TextureMap {
            texel: TexelRule { cutoff: Some(0.25), ..channel(Channel::Alpha) },
            ..map("wood")
        }),
        normal_map: Some(TextureMap { bump_multiplier: 0.5, ..map("wood") }),
        emitted_map: Some(TextureMap::new("there.png")),
        emitted: [1.0; 3],
        metallic_roughness: Some(made.clone()),
        ..Material::default()
    };
    let images = vec![EmbeddedImage { name: "wood".to_owned(), bytes: PNG.to_vec() }];
    let model = Model { images, ..with_materials(vec![material.clone()]) };
    let (bytes, messages) = written(&model);
    assert!(messages.is_empty(), "{messages:?}");
    let again = read(&bytes);
    let read = &again.materials[0];
    assert_eq!(
        (read.diffuse, read.specular, read.shininess),
        (material.diffuse, material.specular, material.shininess)
    );
    let metal = read.metallic_roughness.as_ref().unwrap();
    assert_eq!((metal.base_color, metal.metallic, metal.roughness), (base, 0.5, 0.25));
    assert_eq!(metal.metallic_map.as_ref().unwrap().texel.channel, Some(Channel::Blue));
    assert_eq!(metal.roughness_map.as_ref().unwrap().path, "there.png");
    let diffuse = read.diffuse_map.as_ref().unwrap();
    assert_eq!((diffuse.wrap, diffuse.scale, diffuse.rotation), ([Wrap::Clamp, Wrap::Mirror], [2.0, 3.0], 0.5));
    near(&diffuse.offset, &[0.25, -0.5]);
    assert_eq!(read.opacity_map.as_ref().unwrap().texel.cutoff, Some(0.25));
    assert_eq!(read.normal_map.as_ref().unwrap().bump_multiplier, 0.5);
    // Two pictures, each once.
    assert_eq!(again.images.len(), 2);
    assert!(again.images.iter().all(|image| image.bytes == PNG));
}

/// The reader takes the set that the material's textures use.
#[test]
fn second_texture_coordinates_are_written_and_read() {
    let corners = [[0.5, 0.5], [0.75, 0.5], [0.5, 1.0], [0.0, 0.25], [0.25, 0.0], [0.0, 0.0]];
    let mesh = quad().with_second_corner_tex_coords(&corners);
    assert_eq!(mesh.positions.len(), 6, "corners that differ are split");
    for (on_second_set, expected) in [(false, quad().tex_coords[1]), (true, corners[1])] {
        let map = TextureMap { on_second_set, ..TextureMap::new("there.png") };
        let material = Material { diffuse_map: Some(map), ..Material::default() };
        let model = Model { mesh: mesh.clone(), ..with_materials(vec![material.clone(), material]) };
        let (bytes, messages) = written(&model);
        assert!(messages.is_empty(), "{messages:?}");
        let json = chunks(&bytes).0;
        let info = &json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
        assert_eq!(info["texCoord"].as_u64(), on_second_set.then_some(1));
        assert!(json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"].is_u64());
        let again = read(&bytes);
        near(&again.mesh.tex_coords[again.mesh.indices[1] as usize], &expected);
    }
}

#[test]
fn a_file_read_and_written_is_the_same_model() {
    let first = rich().quiet();
    let (bytes, messages) = written(&Model { lights: Vec::new(), cameras: Vec::new(), ..first.clone() });
    assert!(messages.is_empty(), "{messages:?}");
    let again = read(&bytes);
    assert_eq!(again.mesh.indices.len(), first.mesh.indices.len());
    for (a, b) in first.mesh.indices.iter().zip(&again.mesh.indices) {
        let (a, b) = (*a as usize, *b as usize);
        assert_eq!(first.mesh.positions[a], again.mesh.positions[b]);
        near(&first.mesh.normals[a], &again.mesh.normals[b]);
        near(&first.mesh.tangents[a], &again.mesh.tangents[b]);
        near(&first.mesh.tex_coords[a], &again.mesh.tex_coords[b]);
        assert_eq!(first.mesh.colors[a], again.mesh.colors[b]);
    }
    for (a, b) in first.materials.iter().zip(&again.materials) {
        near(&a.diffuse, &b.diffuse);
        near(&a.specular, &b.specular);
        near(&[a.shininess, a.opacity], &[b.shininess, b.opacity]);
        assert_eq!(
            (a.opacity_map.is_some(), a.normal_map.is_some()),
            (b.opacity_map.is_some(), b.normal_map.is_some())
        );
    }
    assert_eq!(
        first.materials[0].opacity_map.as_ref().unwrap().texel,
        again.materials[0].opacity_map.as_ref().unwrap().texel
    );
    let (_, messages) = written(&first);
    assert_eq!(messages, ["warning: lights (2) and cameras (2) are not written".replace('2', "1")]);
}

#[test]
fn losses_are_reported() {
    let material = Material {
        name: "Odd".to_owned(),
        ambient: AmbientRule::Value([0.1; 3]),
        diffuse: [2.0, 0.0, 0.0],
        refraction_index: 1.0,
        diffuse_map: Some(TextureMap::new("gone.png")),
        shininess_map: Some(TextureMap::new("there.png")),
        opacity_map: Some(TextureMap::new("there.png")),
        bump_map: Some(TextureMap::new("there.png")),
        ..Material::default()
    };
    let (bytes, messages) = written(&with_materials(vec![material]));
    let lost = |what: &str| {
        let sentence = format!("warning: the material \"Odd\" has {what}, which glTF cannot store: not written");
        assert!(messages.contains(&sentence), "{sentence}: {messages:#?}");
    };
    lost("an ambient color of its own");
    lost("a color above 1");
    lost("the refraction index 1");
    lost("a texture of exponents");
    lost("a texture of heights");
    lost("an opacity texture other than the alpha of its color texture");
    assert!(
        messages.contains(&"warning: the texture \"gone.png\" was not found: it is not written".to_owned()),
        "{messages:?}"
    );
    assert_eq!(messages.len(), 7);
    assert_eq!(read(&bytes).materials[0].diffuse_map, None);
    let images = vec![EmbeddedImage { name: "odd".to_owned(), bytes: b"RIFF".to_vec() }];
    let map = TextureMap { embedded: Some(0), ..TextureMap::new("odd") };
    let material = Material { diffuse_map: Some(map), ..Material::default() };
    let (_, messages) = written(&Model { images, ..with_materials(vec![material]) });
    assert_eq!(messages, ["warning: the texture \"odd\" is neither PNG nor JPEG: it is not written"]);
}

#[test]
fn incomplete_and_large_meshes() {
    // Normals that are 0 are none.
    let mut model = with_materials(vec![Material::default()]);
    model.mesh.normals[3] = [0.0; 3];
    let (bytes, messages) = written(&model);
    assert_eq!(messages, ["warning: the part \"Upper\" lacks some normals: none of them is written"]);
    let again = read(&bytes).mesh;
    assert_eq!((again.normals[0], again.normals[3]), ([0.0, 0.0, 1.0], [0.0; 3]));
    // Indices that do not fit 16 bits.
    let count = 70_000_u32;
    let positions: Vec<[f32; 3]> = (0..count).map(|i| [i as f32, (i % 7) as f32, 0.0]).collect();
    let indices: Vec<u32> = (0..count - 2).flat_map(|i| [i, i + 1, i + 2]).collect();
    let mesh = Mesh { positions, indices, ..Mesh::default() };
    let (bytes, messages) = written(&Model { mesh: mesh.clone(), ..Model::default() });
    assert!(messages.is_empty());
    let again = read(&bytes).mesh;
    assert!(again.positions == mesh.positions && again.indices == mesh.indices);
    // Nothing at all is still a file.
    let (bytes, _) = written(&Model::default());
    let (json, binary) = chunks(&bytes);
    assert!(binary.is_empty() && json.get("meshes").is_none() && json.get("buffers").is_none());
    assert!(::gltf::Gltf::from_slice(&bytes).is_ok());
}
