//! Materials and textures of glTF files.

use crate::builder::{File, Files, assert_message, base64, near};
use gonio_mesh::{AmbientRule, Limits, Material, MetallicRoughness, Model, PropertySource, TextureMap, Wrap, gltf};
use serde_json::{Value, json};

/// A triangle of this material.
fn file_of(material: Value) -> File {
    let mut file = File::triangle();
    file.push("materials", material);
    file.set("/meshes/0/primitives/0/material", json!(0));
    let tex_coords = file.floats(&[0.0; 6], "VEC2");
    file.set("/meshes/0/primitives/0/attributes/TEXCOORD_0", tex_coords.into());
    for (name, texture) in [("a.png", 0), ("b.png", 1), ("c.png", 2)] {
        file.push("images", json!({ "uri": name }));
        file.push("textures", json!({ "source": texture }));
    }
    file
}

fn quiet(material: Value) -> Material {
    file_of(material).quiet().materials.remove(0)
}

fn odd(material: Value) -> (Material, Vec<String>) {
    let (mut model, messages): (Model, _) = file_of(material).read_with_messages();
    (model.materials.remove(0), messages)
}

fn source<'m>(sources: &'m [PropertySource], property: &str) -> &'m PropertySource {
    sources.iter().find(|s| s.property == property).unwrap_or_else(|| panic!("{property}: {sources:?}"))
}

/// By hand: k_d = base * (1 - 0.25), k_s = 0.04 + (base - 0.04) * 0.25, gamma = 2 / 0.5^4 - 2 = 30.
#[test]
fn metal_and_roughness() {
    let material = quiet(json!({
        "name": "Copper",
        "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.4, 0.2, 0.5], "metallicFactor": 0.25, "roughnessFactor": 0.5 },
    }));
    assert_eq!(material.name, "Copper");
    assert_eq!(material.ambient, AmbientRule::FollowsDiffuse);
    near(&material.diffuse, &[0.6, 0.3, 0.15]);
    near(&material.specular, &[0.23, 0.13, 0.08]);
    near(&[material.shininess], &[30.0]);
    // OPAQUE: alpha counts for nothing.
    assert_eq!((material.opacity, material.emitted, material.refraction_index), (1.0, [0.0; 3], 1.5));
    let made = material.metallic_roughness.as_ref().unwrap();
    assert_eq!((made.base_color, made.metallic, made.roughness), ([0.8, 0.4, 0.2], 0.25, 0.5));
    let shininess = source(&material.sources, "shininess");
    assert_eq!(shininess.written, "materials[0].pbrMetallicRoughness.roughnessFactor = 0.5");
    assert_eq!(shininess.rule, "2 / roughness^4 - 2 with roughness 0.5");
    let diffuse = source(&material.sources, "diffuse");
    assert_eq!(diffuse.written, "materials[0].pbrMetallicRoughness.baseColorFactor = [0.8, 0.4, 0.2, 0.5]");
    assert_eq!(diffuse.rule, "times 1 - metallic (0.25)");
    assert_eq!(source(&material.sources, "opacity").rule, "glTF's default; opaque: the alpha 0.5 is ignored");
}

/// Absent values are 1: white metal without gloss. Without a material it is light clay.
#[test]
fn absent_values() {
    let material = quiet(json!({}));
    assert_eq!((material.diffuse, material.specular, material.shininess), ([0.0; 3], [1.0; 3], 1.0));
    let (model, messages) = File::triangle().read_with_messages();
    assert_eq!(model.materials, [Material::default()]);
    assert_eq!(model.mesh.parts[0].material, 0);
    assert_message(
        &messages,
        "note: meshes[0].primitives[0] has no material: using light clay (as for all primitives without one)",
    );
}

#[test]
fn emission_with_its_strength() {
    let material = quiet(json!({ "emissiveFactor": [1, 0.5, 0] }));
    assert_eq!(material.emitted, [1.0, 0.5, 0.0]);
    let material = quiet(json!({
        "emissiveFactor": [1, 0.5, 0], "emissiveTexture": { "index": 1 },
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4 } },
    }));
    assert_eq!(material.emitted, [4.0, 2.0, 0.0]);
    assert_eq!(material.emitted_map.as_ref().unwrap().path, "b.png");
    assert_eq!(source(&material.sources, "emitted").written, "materials[0].emissiveFactor = [1, 0.5, 0]");
    let rule = &source(&material.sources, "emitted").rule;
    assert_eq!(rule, "times materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength = 4");
}

/// ((2 - 1) / (2 + 1))^2 = 1/9; a colour of 1.8 makes 0.2 of it, half as strong 0.1.
#[test]
fn refraction_and_specular_extensions() {
    let plastic = json!({ "metallicFactor": 0 });
    let material = quiet(json!({
        "pbrMetallicRoughness": plastic, "extensions": { "KHR_materials_ior": { "ior": 2 } },
    }));
    near(&material.specular, &[1.0 / 9.0; 3]);
    assert_eq!(material.refraction_index, 2.0);
    let material = quiet(json!({
        "pbrMetallicRoughness": plastic,
        "extensions": {
            "KHR_materials_ior": { "ior": 2 },
            "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [1.8, 0, 90] },
        },
    }));
    near(&material.specular, &[0.1, 0.0, 0.5]);
    let material = quiet(json!({
        "pbrMetallicRoughness": plastic,
        "extensions": { "KHR_materials_specular": { "specularColorTexture": { "index": 2 } } },
    }));
    near(&material.specular, &[0.04; 3]);
    assert_eq!(material.specular_map.as_ref().unwrap().path, "c.png");
    let material = quiet(json!({ "extensions": { "KHR_materials_specular": { "specularTexture": { "index": 2 } } } }));
    let unused = &material.unused[0];
    let written = "materials[0].extensions.KHR_materials_specular.specularTexture.index = 2 (c.png)";
    assert_eq!((unused.property, unused.written.as_str()), ("specular_texture", written));
}

/// Roughness 1 - 0.5: gamma = 30.
#[test]
fn specular_and_glossiness() {
    let material = quiet(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 0.25, 0, 1], "specularFactor": [0.3, 0.2, 0.1], "glossinessFactor": 0.5,
        "diffuseTexture": { "index": 0 }, "specularGlossinessTexture": { "index": 1 },
    } } }));
    assert_eq!((material.diffuse, material.specular), ([0.5, 0.25, 0.0], [0.3, 0.2, 0.1]));
    near(&[material.shininess], &[30.0]);
    assert_eq!(material.diffuse_map.unwrap().path, "a.png");
    assert_eq!(material.specular_map.unwrap().path, "b.png");
    // 1 - 0.5 * alpha, of 1.
    let made = material.metallic_roughness.unwrap();
    let texel = made.roughness_map.unwrap().texel;
    assert_eq!((made.metallic, made.roughness, made.metallic_map), (0.0, 1.0, None));
    assert_eq!((texel.channel, texel.base, texel.gain), (Some(gonio_mesh::Channel::Alpha), 1.0, -0.5));
}

#[test]
fn alpha_modes() {
    let material = |mode: &str, alpha: f32, texture: bool| {
        let mut pbr = json!({ "baseColorFactor": [1, 1, 1, alpha] });
        if texture {
            pbr["baseColorTexture"] = json!({ "index": 0 });
        }
        quiet(json!({ "alphaMode": mode, "alphaCutoff": 0.25, "pbrMetallicRoughness": pbr }))
    };
    let plain = |mode, alpha| {
        let material = material(mode, alpha, false);
        assert_eq!(material.opacity_map, None);
        material.opacity
    };
    assert_eq!(plain("OPAQUE", 0.125), 1.0);
    assert_eq!(plain("BLEND", 0.125), 0.125);
    assert_eq!((plain("MASK", 0.25), plain("MASK", 0.125)), (1.0, 0.0));
    assert_eq!(material("OPAQUE", 0.125, true).opacity_map, None);
    let blend = material("BLEND", 0.5, true);
    let map = blend.opacity_map.unwrap();
    assert_eq!((blend.opacity, map.path.as_str()), (0.5, "a.png"));
    assert_eq!((map.texel.channel, map.texel.gain, map.texel.cutoff), (Some(gonio_mesh::Channel::Alpha), 1.0, None));
    let mask = material("MASK", 0.5, true);
    let texel = mask.opacity_map.unwrap().texel;
    assert_eq!((mask.opacity, texel.gain, texel.cutoff), (1.0, 0.5, Some(0.25)));
    let (_, messages) = odd(json!({ "alphaMode": "GLASS" }));
    assert_message(
        &messages,
        "warning: materials[0].alphaMode is \"GLASS\", not OPAQUE, MASK or BLEND: using the default",
    );
}

#[test]
fn unlit_is_emitted() {
    let material = quiet(json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 0, 1], "baseColorTexture": { "index": 0 } },
        "emissiveFactor": [1, 1, 1],
        "extensions": { "KHR_materials_unlit": {} },
    }));
    assert_eq!((material.diffuse, material.specular), ([0.0; 3], [0.0; 3]));
    assert_eq!(material.ambient, AmbientRule::Value([0.0; 3]));
    assert_eq!(material.emitted, [0.5, 0.25, 0.0]);
    assert_eq!(material.emitted_map.unwrap().path, "a.png");
    assert_eq!((material.diffuse_map, material.metallic_roughness), (None, None));
}

#[test]
fn textures_of_materials() {
    let material = quiet(json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 1 },
            "metallicFactor": 0.5, "roughnessFactor": 0.5,
        },
        "normalTexture": { "index": 2, "scale": 0.5 },
    }));
    let made: MetallicRoughness = material.metallic_roughness.unwrap();
    let (metallic, roughness) = (made.metallic_map.unwrap(), made.roughness_map.unwrap());
    assert_eq!((metallic.path.as_str(), metallic.texel.channel), ("b.png", Some(gonio_mesh::Channel::Blue)));
    assert_eq!((roughness.path.as_str(), roughness.texel.channel), ("b.png", Some(gonio_mesh::Channel::Green)));
    let normal = material.normal_map.unwrap();
    assert_eq!((normal.path.as_str(), normal.bump_multiplier), ("c.png", 0.5));
    assert_eq!(material.diffuse_map.unwrap().path, "a.png");
    assert_eq!(material.specular_map, None);
    let source = source(&material.sources, "normal_map");
    assert_eq!(source.written, "materials[0].normalTexture.index = 2 (c.png)");
    // Pure metal shows its base colour in its highlight.
    let metal = quiet(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    assert_eq!(metal.specular_map, metal.diffuse_map);
    assert!(metal.specular_map.is_some());
}

#[test]
fn unsupported_properties_are_named() {
    let (material, messages) = odd(json!({
        "name": "Car", "doubleSided": true, "occlusionTexture": { "index": 0 },
        "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1 }, "ACME_rust": {} },
    }));
    let unused: Vec<(&str, &str)> = material.unused.iter().map(|s| (s.property, s.written.as_str())).collect();
    assert_eq!(unused[0], ("occlusion_map", "materials[0].occlusionTexture = {\"index\": 0}"));
    assert_eq!(unused[1], ("double_sided", "materials[0].doubleSided = true"));
    let clearcoat = ("clearcoat", "materials[0].extensions.KHR_materials_clearcoat = {\"clearcoatFactor\": 1}");
    assert!(unused.contains(&clearcoat) && unused.len() == 4, "{unused:?}");
    let title = "materials[0] (\"Car\")";
    assert_message(&messages, &format!("note: {title} has an occlusionTexture: it is not used"));
    let coat = "which the light equation has no term for: it is shown without it";
    assert_message(&messages, &format!("warning: {title} has KHR_materials_clearcoat, {coat}"));
    assert_message(&messages, &format!("warning: {title} has ACME_rust, which is not known: it is shown without it"));
}

#[test]
fn values_that_are_no_use() {
    let (material, messages) = odd(json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 0.5, 0.5], "metallicFactor": -3, "roughnessFactor": "rough",
    } }));
    assert_eq!((material.diffuse, material.shininess), ([1.0; 3], 1.0));
    let pbr = "materials[0].pbrMetallicRoughness";
    let at = format!("warning: {pbr}.baseColorFactor is [0.5, 0.5, 0.5], expected 4 numbers: using the default");
    assert_message(&messages, &at);
    assert_message(&messages, &format!("warning: {pbr}.metallicFactor = -3, but it must be from 0 to 1: clamped"));
    assert_message(
        &messages,
        &format!("warning: {pbr}.roughnessFactor is \"rough\", expected a number: using the default"),
    );
    let (material, messages) = odd(json!({ "emissiveFactor": [1e300, -1, 0] }));
    assert_eq!(material.emitted, [f32::MAX, 0.0, 0.0]);
    assert_message(
        &messages,
        "warning: materials[0].emissiveFactor = [1e+300, -1, 0], but it must be at least 0: clamped",
    );
}

/// The sources of absent values, in the order of the fields.
#[test]
fn sources_of_absent_values() {
    let material = quiet(json!({
        "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions": { "KHR_materials_ior": { "ior": 1.25 } },
    }));
    let sources: Vec<[&str; 3]> =
        material.sources.iter().map(|s| [s.property, s.written.as_str(), s.rule.as_str()]).collect();
    let ior = "materials[0].extensions.KHR_materials_ior.ior = 1.25";
    // (0.25 / 2.25)^2 = 1 / 81
    let specular = format!("materials[0].pbrMetallicRoughness.metallicFactor = 0; {ior}");
    let expected = [
        ["diffuse", "", "glTF's default"],
        ["specular", &specular, "mix(0.012345679, base color, metallic 0)"],
        ["emitted", "", "glTF's default"],
        ["shininess", "", "glTF's default; 2 / roughness^4 - 2 with roughness 1"],
        ["refraction_index", ior, ""],
        ["opacity", "", "glTF's default"],
    ];
    assert_eq!(sources, expected);
}

/// A triangle with one base colour texture.
fn textured_file(info: Value, texture: Value, image: Value) -> File {
    let mut file = File::triangle();
    let tex_coords = file.floats(&[0.0; 6], "VEC2");
    file.set("/meshes/0/primitives/0/attributes/TEXCOORD_0", tex_coords.into());
    file.set("/meshes/0/primitives/0/material", json!(0));
    file.push("materials", json!({ "pbrMetallicRoughness": { "baseColorTexture": info } }));
    file.push("textures", texture);
    file.push("images", image);
    file
}

fn map_of(model: &Model) -> &TextureMap {
    model.materials[0].diffuse_map.as_ref().unwrap()
}

#[test]
fn pictures_inside_and_outside() {
    let plain = |image| textured_file(json!({ "index": 0 }), json!({ "source": 0 }), image);
    let model = plain(json!({ "uri": "wood%20grain.png" })).quiet();
    assert_eq!(*map_of(&model), TextureMap::new("wood grain.png"));
    assert!(model.images.is_empty());
    let uri = format!("data:image/png;base64,{}", base64(b"picture"));
    let model = plain(json!({ "uri": uri, "name": "Wood" })).quiet();
    assert_eq!((map_of(&model).embedded, map_of(&model).path.as_str()), (Some(0), "Wood"));
    assert_eq!((model.images[0].name.as_str(), &model.images[0].bytes[..]), ("Wood", &b"picture"[..]));
    let mut file = plain(json!({ "mimeType": "image/png" }));
    let view = file.view(b"other picture");
    file.set("/images/0/bufferView", view.into());
    // The same picture for two textures is there once.
    file.push("textures", json!({ "source": 0 }));
    file.set("/materials/0/emissiveTexture", json!({ "index": 1 }));
    let model = file.quiet();
    assert_eq!((model.images.len(), &model.images[0].bytes[..]), (1, &b"other picture"[..]));
    assert_eq!((map_of(&model).path.as_str(), model.images[0].name.as_str()), ("images[0]", "images[0]"));
    assert_eq!(model.materials[0].emitted_map, model.materials[0].diffuse_map);
}

#[test]
fn textures_that_cannot_be_read() {
    let messages = |info: Value, texture: Value, image: Value| {
        let (model, messages) = textured_file(info, texture, image).read_with_messages();
        assert_eq!(model.materials[0].diffuse_map, None);
        messages
    };
    let fine = || (json!({ "index": 0 }), json!({ "source": 0 }), json!({ "uri": "a.png" }));
    let (info, _, image) = fine();
    let lost = "the texture is left out";
    assert_message(
        &messages(info, json!({ "source": 1 }), image),
        &format!("warning: textures[0].source = 1, but the file has 1 images: {lost}"),
    );
    let (_, texture, image) = fine();
    let path = "materials[0].pbrMetallicRoughness.baseColorTexture";
    assert_message(
        &messages(json!({ "index": 7 }), texture, image),
        &format!("warning: {path}.index = 7, but the file has 1 textures: {lost}"),
    );
    let (info, texture, _) = fine();
    assert_message(
        &messages(info.clone(), texture.clone(), json!({ "uri": "data:image/png;base64,&&" })),
        &format!("warning: invalid data in images[0].uri: its character 1 is not base64: {lost}"),
    );
    assert_message(
        &messages(info.clone(), texture, json!({ "uri": "https://example.org/a.png" })),
        &format!("warning: images[0].uri = \"https://example.org/a.png\" is not fetched: {lost}"),
    );
    let (_, _, image) = fine();
    let basis = json!({ "extensions": { "KHR_texture_basisu": { "source": 9 } } });
    let source = "textures[0].extensions.KHR_texture_basisu.source";
    assert_message(&messages(info, basis, image), &format!("warning: {source} = 9, but the file has 1 images: {lost}"));
}

#[test]
fn wrap_modes() {
    let mut file =
        textured_file(json!({ "index": 0 }), json!({ "source": 0, "sampler": 0 }), json!({ "uri": "a.png" }));
    file.push("samplers", json!({ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }));
    let (model, messages) = file.read_with_messages();
    assert_eq!(map_of(&model).wrap, [Wrap::Clamp, Wrap::Mirror]);
    assert_message(
        &messages,
        "note: samplers[0] asks for nearest-neighbor filtering: textures are always filtered linearly",
    );
    file.json["samplers"] = json!([{}]);
    assert_eq!(map_of(&file.quiet()).wrap, [Wrap::Repeat; 2]);
    file.json["samplers"] = json!([{ "wrapS": 1 }]);
    let (_, messages) = file.read_with_messages();
    assert_message(
        &messages,
        "warning: samplers[0].wrapS = 1, which is not 10497 (repeat), 33071 (clamp) or 33648 (mirror): the texture is left out",
    );
}

/// As `KHR_texture_transform` defines it, v down: scale, then counter-clockwise as one sees it, then offset.
fn by_definition(offset: [f64; 2], rotation: f64, scale: [f64; 2], uv: [f64; 2]) -> [f64; 2] {
    let scaled = [scale[0] * uv[0], scale[1] * uv[1]];
    let (sin, cos) = rotation.sin_cos();
    [cos * scaled[0] + sin * scaled[1] + offset[0], -sin * scaled[0] + cos * scaled[1] + offset[1]]
}

/// As [`TextureMap`] defines it, v up.
fn by_map(map: &TextureMap, uv: [f64; 2]) -> [f64; 2] {
    let scaled = [f64::from(map.scale[0]) * uv[0], f64::from(map.scale[1]) * uv[1]];
    let (sin, cos) = f64::from(map.rotation).sin_cos();
    let turned = [cos * scaled[0] - sin * scaled[1], sin * scaled[0] + cos * scaled[1]];
    [turned[0] + f64::from(map.offset[0]), turned[1] + f64::from(map.offset[1])]
}

#[test]
fn texture_transforms_look_at_the_same_texel() {
    let cases: [([f64; 2], f64, [f64; 2]); 5] = [
        ([0.25, 0.5], 0.0, [1.0, 1.0]),
        ([0.0, 0.0], 0.0, [2.0, 3.0]),
        ([0.0, 0.0], 0.75, [1.0, 1.0]),
        ([0.25, -0.5], 0.75, [2.0, 3.0]),
        ([-1.5, 0.125], -2.0, [-0.5, 4.0]),
    ];
    for (offset, rotation, scale) in cases {
        let transform = json!({ "offset": offset, "rotation": rotation, "scale": scale });
        let info = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
        let model = textured_file(info, json!({ "source": 0 }), json!({ "uri": "a.png" })).quiet();
        let map = map_of(&model);
        for uv in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.3, 0.8]] {
            let [u, v] = by_definition(offset, rotation, scale, uv);
            let [our_u, our_v] = by_map(map, [uv[0], 1.0 - uv[1]]);
            near(&[our_u as f32, our_v as f32], &[u as f32, 1.0 - v as f32]);
        }
    }
    // A quarter turn on paper: "rotate the UVs counter-clockwise", v down, takes u = 1 to v = -1.
    let info =
        json!({ "index": 0, "extensions": { "KHR_texture_transform": { "rotation": std::f64::consts::FRAC_PI_2 } } });
    let model = textured_file(info, json!({ "source": 0 }), json!({ "uri": "a.png" })).quiet();
    let [u, v] = by_map(map_of(&model), [1.0, 1.0]);
    near(&[u as f32, v as f32], &[0.0, 2.0]);
}

#[test]
fn texture_coordinates_of_the_first_texture() {
    let mut file =
        textured_file(json!({ "index": 0, "texCoord": 1 }), json!({ "source": 0 }), json!({ "uri": "a.png" }));
    let second = file.floats(&[0.5, 0.25, 0.5, 0.25, 0.5, 0.25], "VEC2");
    file.set("/meshes/0/primitives/0/attributes/TEXCOORD_1", second.into());
    file.set("/materials/0/emissiveTexture", json!({ "index": 0, "texCoord": 1 }));
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.tex_coords, [[0.5, 0.75]; 3]);
    assert!(model.materials[0].emitted_map.is_some());
    assert_message(
        &messages,
        "note: meshes[0].primitives[0].attributes.TEXCOORD_0 is an additional set of texture coordinates: not used",
    );
    // The extension's word counts more; what lies on another set is left out.
    let transform = json!({ "KHR_texture_transform": { "texCoord": 0 } });
    file.set("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions", transform);
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.tex_coords, [[0.0, 1.0]; 3]);
    assert_eq!(model.materials[0].emitted_map, None);
    let first = "but the material's first texture uses TEXCOORD_0: it is left out";
    assert_message(&messages, &format!("warning: materials[0].emissiveTexture uses TEXCOORD_1, {first}"));
    file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TEXCOORD_0");
    let (model, messages) = file.read_with_messages();
    assert!(model.mesh.tex_coords.is_empty());
    assert_message(&messages, "warning: meshes[0].primitives[0] has textures but no TEXCOORD_0: using (0, 0)");
}

#[test]
fn pictures_have_a_limit() {
    let uri = format!("data:image/png;base64,{}", base64(&[7; 50_000]));
    let mut file = textured_file(json!({ "index": 0 }), json!({ "source": 0 }), json!({ "uri": uri }));
    // A second one, of bytes in the buffer.
    let view = file.view(&[8; 50_000]);
    file.push("images", json!({ "bufferView": view }));
    file.push("textures", json!({ "source": 1 }));
    file.set("/materials/0/emissiveTexture", json!({ "index": 1 }));
    let read = |max_bytes| {
        let limits = Limits { max_bytes, ..Limits::default() };
        gltf::read(&file.glb(), &mut Files(Vec::new()), &limits).unwrap()
    };
    let enough = read(100_000);
    assert_eq!((enough.images.len(), enough.images[1].bytes.len()), (2, 50_000));
    let few = read(99_999);
    assert_eq!((few.images.len(), few.images[0].bytes.len()), (1, 50_000));
    let messages: Vec<String> = few.diagnostics.iter().map(ToString::to_string).collect();
    let limit = "makes the images larger than 99999 bytes, which is the limit: the texture is left out";
    assert_message(&messages, &format!("warning: images[1] {limit}"));
}
