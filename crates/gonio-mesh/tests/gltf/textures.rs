//! Which picture, how it lies on the model.

use crate::builder::{File, Files, base64, near, says};
use gonio_mesh::{Limits, Model, TextureMap, Wrap, gltf};
use serde_json::{Value, json};

/// A triangle with one base colour texture.
fn file_of(info: Value, texture: Value, image: Value) -> File {
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
    let plain = |image| file_of(json!({ "index": 0 }), json!({ "source": 0 }), image);
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
fn textures_that_cannot_be_had() {
    let said = |info: Value, texture: Value, image: Value| {
        let (model, said) = file_of(info, texture, image).said();
        assert_eq!(model.materials[0].diffuse_map, None);
        said
    };
    let fine = || (json!({ "index": 0 }), json!({ "source": 0 }), json!({ "uri": "a.png" }));
    let (info, _, image) = fine();
    let lost = "the texture is left out";
    says(
        &said(info, json!({ "source": 1 }), image),
        &format!("warning: textures[0].source = 1, but the file has 1 images: {lost}"),
    );
    let (_, texture, image) = fine();
    let path = "materials[0].pbrMetallicRoughness.baseColorTexture";
    says(
        &said(json!({ "index": 7 }), texture, image),
        &format!("warning: {path}.index = 7, but the file has 1 textures: {lost}"),
    );
    let (info, texture, _) = fine();
    says(
        &said(info.clone(), texture.clone(), json!({ "uri": "data:image/png;base64,&&" })),
        &format!("warning: invalid data in images[0].uri: its character 1 is not base64: {lost}"),
    );
    says(
        &said(info.clone(), texture, json!({ "uri": "https://example.org/a.png" })),
        &format!("warning: images[0].uri = \"https://example.org/a.png\" is not fetched: {lost}"),
    );
    let (_, _, image) = fine();
    let basis = json!({ "extensions": { "KHR_texture_basisu": { "source": 9 } } });
    let source = "textures[0].extensions.KHR_texture_basisu.source";
    says(&said(info, basis, image), &format!("warning: {source} = 9, but the file has 1 images: {lost}"));
}

#[test]
fn wrap_modes() {
    let mut file = file_of(json!({ "index": 0 }), json!({ "source": 0, "sampler": 0 }), json!({ "uri": "a.png" }));
    file.push("samplers", json!({ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }));
    let (model, said) = file.said();
    assert_eq!(map_of(&model).wrap, [Wrap::Clamp, Wrap::Mirror]);
    says(&said, "note: samplers[0] asks for nearest-neighbor filtering: textures are always filtered linearly");
    file.json["samplers"] = json!([{}]);
    assert_eq!(map_of(&file.quiet()).wrap, [Wrap::Repeat; 2]);
    file.json["samplers"] = json!([{ "wrapS": 1 }]);
    let (_, said) = file.said();
    says(
        &said,
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
        let model = file_of(info, json!({ "source": 0 }), json!({ "uri": "a.png" })).quiet();
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
    let model = file_of(info, json!({ "source": 0 }), json!({ "uri": "a.png" })).quiet();
    let [u, v] = by_map(map_of(&model), [1.0, 1.0]);
    near(&[u as f32, v as f32], &[0.0, 2.0]);
}

#[test]
fn texture_coordinates_of_the_first_texture() {
    let mut file = file_of(json!({ "index": 0, "texCoord": 1 }), json!({ "source": 0 }), json!({ "uri": "a.png" }));
    let second = file.floats(&[0.5, 0.25, 0.5, 0.25, 0.5, 0.25], "VEC2");
    file.set("/meshes/0/primitives/0/attributes/TEXCOORD_1", second.into());
    file.set("/materials/0/emissiveTexture", json!({ "index": 0, "texCoord": 1 }));
    let (model, said) = file.said();
    assert_eq!(model.mesh.tex_coords, [[0.5, 0.75]; 3]);
    assert!(model.materials[0].emitted_map.is_some());
    says(
        &said,
        "note: meshes[0].primitives[0].attributes.TEXCOORD_0 is an additional set of texture coordinates: not used",
    );
    // The extension's word counts more; what lies on another set is left out.
    let transform = json!({ "KHR_texture_transform": { "texCoord": 0 } });
    file.set("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions", transform);
    let (model, said) = file.said();
    assert_eq!(model.mesh.tex_coords, [[0.0, 1.0]; 3]);
    assert_eq!(model.materials[0].emitted_map, None);
    let first = "the material's first texture on TEXCOORD_0: it is left out";
    says(&said, &format!("warning: materials[0].emissiveTexture lies on TEXCOORD_1, {first}"));
    file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TEXCOORD_0");
    let (model, said) = file.said();
    assert!(model.mesh.tex_coords.is_empty());
    says(&said, "warning: meshes[0].primitives[0] has textures but no TEXCOORD_0: using (0, 0)");
}

#[test]
fn pictures_have_a_limit() {
    let uri = format!("data:image/png;base64,{}", base64(&[7; 50_000]));
    let mut file = file_of(json!({ "index": 0 }), json!({ "source": 0 }), json!({ "uri": uri }));
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
    let said: Vec<String> = few.diagnostics.iter().map(ToString::to_string).collect();
    let limit = "makes the images larger than 99999 bytes, which is the limit: the texture is left out";
    says(&said, &format!("warning: images[1] {limit}"));
}
