//! Materials in the terms of the light equation.

use crate::builder::{File, near, says};
use gonio_mesh::{AmbientRule, Material, MetallicRoughness, Model, PropertySource};
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
    let (mut model, said): (Model, _) = file_of(material).said();
    (model.materials.remove(0), said)
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

/// What is absent is 1: white metal without gloss; where there is no material at all, light clay.
#[test]
fn what_is_absent() {
    let material = quiet(json!({}));
    assert_eq!((material.diffuse, material.specular, material.shininess), ([0.0; 3], [1.0; 3], 1.0));
    let (model, said) = File::triangle().said();
    assert_eq!(model.materials, [Material::default()]);
    assert_eq!(model.mesh.parts[0].material, 0);
    says(&said, "note: meshes[0].primitives[0] has no material: using light clay (as for all primitives without one)");
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
    let (_, said) = odd(json!({ "alphaMode": "GLASS" }));
    says(&said, "warning: materials[0].alphaMode is \"GLASS\", not OPAQUE, MASK or BLEND: using the default");
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
fn what_has_no_place_is_named() {
    let (material, said) = odd(json!({
        "name": "Car", "doubleSided": true, "occlusionTexture": { "index": 0 },
        "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1 }, "ACME_rust": {} },
    }));
    let unused: Vec<(&str, &str)> = material.unused.iter().map(|s| (s.property, s.written.as_str())).collect();
    assert_eq!(unused[0], ("occlusion_map", "materials[0].occlusionTexture = {\"index\": 0}"));
    assert_eq!(unused[1], ("double_sided", "materials[0].doubleSided = true"));
    let clearcoat = ("clearcoat", "materials[0].extensions.KHR_materials_clearcoat = {\"clearcoatFactor\": 1}");
    assert!(unused.contains(&clearcoat) && unused.len() == 4, "{unused:?}");
    let title = "materials[0] (\"Car\")";
    says(&said, &format!("note: {title} has an occlusionTexture: it is not used"));
    let coat = "which the light equation has no term for: it is shown without it";
    says(&said, &format!("warning: {title} has KHR_materials_clearcoat, {coat}"));
    says(&said, &format!("warning: {title} has ACME_rust, which is not known: it is shown without it"));
}

#[test]
fn values_that_are_no_use() {
    let (material, said) = odd(json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 0.5, 0.5], "metallicFactor": -3, "roughnessFactor": "rough",
    } }));
    assert_eq!((material.diffuse, material.shininess), ([1.0; 3], 1.0));
    let pbr = "materials[0].pbrMetallicRoughness";
    let at = format!("warning: {pbr}.baseColorFactor is [0.5, 0.5, 0.5], expected 4 numbers: using the default");
    says(&said, &at);
    says(&said, &format!("warning: {pbr}.metallicFactor = -3, but it must be from 0 to 1: clamped"));
    says(&said, &format!("warning: {pbr}.roughnessFactor is \"rough\", expected a number: using the default"));
    let (material, said) = odd(json!({ "emissiveFactor": [1e300, -1, 0] }));
    assert_eq!(material.emitted, [f32::MAX, 0.0, 0.0]);
    says(&said, "warning: materials[0].emissiveFactor = [1e+300, -1, 0], but it must be at least 0: clamped");
}

/// Where the file says nothing, the source says so; in the order of the fields.
#[test]
fn sources_of_what_is_absent() {
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
