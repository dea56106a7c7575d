//! Makes small files: JSON by hand, numbers as bytes.

use gonio_mesh::{Limits, MissingSidecar, Model, NoSidecars, ReadError, Severity, Sidecar, Sidecars, gltf};
use serde_json::{Value, json};

pub const I8: u32 = 5120;
pub const U8: u32 = 5121;
pub const I16: u32 = 5122;
pub const U16: u32 = 5123;
pub const U32: u32 = 5125;
pub const F32: u32 = 5126;

/// Three corners of a right angle, counter-clockwise seen from +z.
pub const CORNERS: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

#[derive(Clone)]
pub struct File {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl File {
    /// A scene without nodes.
    pub fn empty() -> Self {
        let lists = json!({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [] }] });
        File { json: lists, bytes: Vec::new() }
    }

    /// One node with one triangle.
    pub fn triangle() -> Self {
        let mut file = File::empty();
        let positions = file.floats(&CORNERS, "VEC3");
        file.push("meshes", json!({ "primitives": [{ "attributes": { "POSITION": positions } }] }));
        file.root_node(json!({ "mesh": 0 }));
        file
    }

    /// One node of a primitive with these attributes and indices.
    pub fn of_primitive(&mut self, primitive: Value) {
        self.push("meshes", json!({ "primitives": [primitive] }));
        let mesh = self.json["meshes"].as_array().unwrap().len() - 1;
        self.root_node(json!({ "mesh": mesh }));
    }

    /// Appends to a list of the file; its index.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json.get(list).is_none() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    pub fn root_node(&mut self, node: Value) -> usize {
        let node = self.push("nodes", node);
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(node.into());
        node
    }

    /// Sets what a JSON pointer names (its parents exist).
    pub fn set(&mut self, pointer: &str, value: Value) {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        let parent = self.json.pointer_mut(parent).unwrap_or_else(|| panic!("{pointer}"));
        match parent {
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
            _ => parent[key] = value,
        }
    }

    pub fn with(mut self, pointer: &str, value: Value) -> Self {
        self.set(pointer, value);
        self
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let first = self.bytes.len();
        self.bytes.extend(bytes);
        self.push("bufferViews", json!({ "buffer": 0, "byteOffset": first, "byteLength": bytes.len() }))
    }

    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let accessor = json!({ "bufferView": view, "componentType": component, "type": kind, "count": count });
        self.push("accessors", accessor)
    }

    pub fn floats(&mut self, numbers: &[f32], kind: &str) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        self.accessor(&bytes, F32, kind, numbers.len() / width)
    }

    pub fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        self.accessor(&bytes, U16, "SCALAR", indices.len())
    }

    /// A `.gltf` with its data inside.
    pub fn gltf(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        let uri = format!("data:application/octet-stream;base64,{}", base64(&self.bytes));
        json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        json.to_string().into_bytes()
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        glb(&json.to_string(), &self.bytes)
    }

    pub fn read(&self) -> Result<Model, ReadError> {
        gltf::read(&self.glb(), &mut NoSidecars, &Limits::default())
    }

    /// The model, which must be read without a warning.
    pub fn quiet(&self) -> Model {
        let model = self.read().unwrap();
        let warnings: Vec<_> = model.diagnostics.iter().filter(|d| d.severity > Severity::Note).collect();
        assert!(warnings.is_empty(), "{warnings:?}");
        model
    }

    /// The model, and the messages of the reader.
    pub fn read_with_messages(&self) -> (Model, Vec<String>) {
        let model = self.read().unwrap();
        let messages = model.diagnostics.iter().map(ToString::to_string).collect();
        (model, messages)
    }

    pub fn error(&self) -> String {
        self.read().unwrap_err().to_string()
    }
}

/// A binary container, by the specification's section 4.
pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let total = 12 + 8 + json.len() + 8 + binary.len();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((total as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for chunk in bytes.chunks(3) {
        let word = chunk.iter().fold(0_u32, |word, b| word << 8 | u32::from(*b)) << (8 * (3 - chunk.len()));
        for i in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * i)) as usize & 63] as char;
            text.push(if i <= chunk.len() { letter } else { '=' });
        }
    }
    text
}

/// Files by name.
pub struct Files(pub Vec<(&'static str, Vec<u8>)>);

impl Sidecars for Files {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        let found = self.0.iter().find(|(known, _)| *known == name);
        let missing =
            || MissingSidecar { tried: vec![format!("models/{name}"), format!("textures/{name}")], refused: None };
        let (_, bytes) = found.ok_or_else(missing)?;
        Ok(Sidecar { path: format!("models/{name}"), bytes: bytes.clone() })
    }
}

/// To within a few units in the last place of an f32 near 1.
#[track_caller]
pub fn near(a: &[f32], b: &[f32]) {
    let close = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-6 * b.abs().max(1.0));
    assert!(close, "{a:?} is not {b:?}");
}

/// Whether one of the sentences is this one.
#[track_caller]
pub fn assert_message(messages: &[String], sentence: &str) {
    assert!(messages.iter().any(|s| s == sentence), "{sentence:?} is not among {messages:#?}");
}

/// A file with a bit of everything; the bounds of its positions, which readers need not have, are left out.
pub fn rich() -> File {
    let mut file = File::empty();
    // A grid of 4 x 3 points, some of them replaced.
    let grid: Vec<[f32; 2]> = (0..12).map(|i| [(i % 4) as f32, (i / 4) as f32]).collect();
    let positions = file.floats(&grid.iter().flat_map(|[x, y]| [*x, *y, 0.25 * x * y]).collect::<Vec<_>>(), "VEC3");
    let (which, what) =
        (file.view(&[5, 6]), file.view(&[0.5_f32, 0.5, 0.5, 1.5, 0.5, 0.5].map(f32::to_le_bytes).concat()));
    file.json["accessors"][positions]["sparse"] = json!({
        "count": 2, "indices": { "bufferView": which, "componentType": U8 }, "values": { "bufferView": what },
    });
    let normals: Vec<u8> = grid.iter().flat_map(|[x, _]| [(16.0 * x) as u8, 0, 120, 0]).collect();
    let normals = file.accessor(&normals, I8, "VEC3", 12);
    file.json["accessors"][normals]["normalized"] = json!(true);
    let view = file.json["accessors"][normals]["bufferView"].as_u64().unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    let tangents = file.floats(&[1.0, 0.0, 0.0, -1.0].repeat(12), "VEC4");
    let tex_coords: Vec<u8> = grid.iter().flat_map(|[x, y]| [(85.0 * x) as u8, (127.0 * y) as u8]).collect();
    let tex_coords = file.accessor(&tex_coords, U8, "VEC2", 12);
    file.json["accessors"][tex_coords]["normalized"] = json!(true);
    let colors = file.accessor(&(0..48).map(|i| 5 * i).collect::<Vec<u8>>(), U8, "VEC4", 12);
    file.json["accessors"][colors]["normalized"] = json!(true);
    let attributes = json!({
        "POSITION": positions, "NORMAL": normals, "TANGENT": tangents, "TEXCOORD_0": tex_coords, "COLOR_0": colors,
    });
    let list = file.indices(&[0, 1, 4, 4, 1, 5, 1, 2, 5, 5, 2, 6]);
    let strip = file.accessor(&[4, 8, 5, 9, 6, 10], U8, "SCALAR", 6);
    let fan: Vec<u8> = [11_u32, 7, 3, 2, 6].iter().flat_map(|i| i.to_le_bytes()).collect();
    let fan = file.accessor(&fan, U32, "SCALAR", 5);
    file.push(
        "meshes",
        json!({ "name": "Cloth", "primitives": [
        { "attributes": attributes, "indices": list, "material": 0 },
        { "attributes": attributes, "indices": strip, "mode": 5, "material": 1 },
        { "attributes": attributes, "indices": fan, "mode": 6, "material": 0 },
    ] }),
    );
    let picture = file.view(b"\x89PNG\r\n\x1a\nno more of it");
    file.push("images", json!({ "name": "weave", "mimeType": "image/png", "bufferView": picture }));
    file.push("samplers", json!({ "wrapS": 33071, "wrapT": 33648 }));
    file.push("textures", json!({ "source": 0, "sampler": 0 }));
    let transform = json!({ "KHR_texture_transform": { "offset": [0.25, 0.5], "rotation": 0.5, "scale": [2, 3] } });
    file.push(
        "materials",
        json!({
            "name": "Linen", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.5, 0.75, 1, 0.5], "metallicFactor": 0, "roughnessFactor": 0.5,
                "baseColorTexture": { "index": 0, "extensions": transform },
            },
            "normalTexture": { "index": 0, "scale": 0.5 },
        }),
    );
    file.push("materials", json!({
        "name": "Gold", "emissiveFactor": [0.5, 0.25, 0],
        "pbrMetallicRoughness": { "baseColorFactor": [1, 0.75, 0.25, 1], "metallicRoughnessTexture": { "index": 0 } },
    }));
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_texture_transform", "KHR_mesh_quantization"]);
    file.json["extensions"] =
        json!({ "KHR_lights_punctual": { "lights": [{ "type": "spot", "spot": {}, "intensity": 2 }] } });
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }));
    file.push("nodes", json!({ "mesh": 0, "name": "Left", "scale": [-1, 2, 1] }));
    file.push(
        "nodes",
        json!({
            "camera": 0, "mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1],
            "extensions": { "KHR_lights_punctual": { "light": 0 } },
        }),
    );
    file.root_node(json!({ "children": [0, 1], "translation": [0, 0, 5], "rotation": [0.6, 0, 0, 0.8] }));
    file
}
