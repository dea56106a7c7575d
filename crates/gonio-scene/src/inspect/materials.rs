//! Materials as they were read: each value and its source.

use crate::model_file::ModelFile;
use gonio_mesh::{AmbientRule, Material, PropertySource, TexelRule, TextureMap, Wrap};
use serde::Serialize;

/// A material, value by value.
#[derive(Debug, Serialize)]
pub struct MaterialReport {
    /// Its name in the file.
    pub name: String,
    /// The file that describes it, where that is not the model itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The number of triangles that have it.
    pub triangles: usize,
    /// Its values.
    pub values: Vec<ValueReport>,
    /// Properties in the file that no term of the light equation uses.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unused: Vec<PropertySource>,
}

/// A value of a material.
#[derive(Debug, Serialize)]
pub struct ValueReport {
    /// The field's name, as `--material` and scene files have it.
    pub property: &'static str,
    /// The value in use.
    pub value: String,
    /// The line that sets it, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// The value in the file.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub written: String,
    /// The reason why the value differs from the one in the file, or its source if the file has none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub rule: String,
}

pub(super) fn reports(file: &ModelFile) -> Vec<MaterialReport> {
    let mut triangles = vec![0; file.model.materials.len()];
    for part in &file.model.mesh.parts {
        if let Some(count) = triangles.get_mut(part.material) {
            *count += part.triangle_count;
        }
    }
    let report = |(material, triangles): (&Material, usize)| MaterialReport {
        name: material.name.clone(),
        file: material.file.clone(),
        triangles,
        values: values(material),
        unused: material.unused.clone(),
    };
    file.model.materials.iter().zip(triangles).map(report).collect()
}

fn values(m: &Material) -> Vec<ValueReport> {
    let ambient = match m.ambient {
        AmbientRule::FollowsDiffuse => "follows diffuse".to_owned(),
        AmbientRule::Value(value) => color(value),
    };
    let mut values = vec![
        ("ambient", ambient),
        ("diffuse", color(m.diffuse)),
        ("specular", color(m.specular)),
        ("emitted", color(m.emitted)),
        ("shininess", number(m.shininess)),
        ("refraction_index", number(m.refraction_index)),
        ("opacity", number(m.opacity)),
    ];
    values.extend(m.illumination_model.map(|model| ("illumination_model", model.to_string())));
    let maps = [
        ("diffuse_map", &m.diffuse_map),
        ("specular_map", &m.specular_map),
        ("emitted_map", &m.emitted_map),
        ("shininess_map", &m.shininess_map),
        ("opacity_map", &m.opacity_map),
        ("normal_map", &m.normal_map),
        ("bump_map", &m.bump_map),
    ];
    values.extend(maps.into_iter().filter_map(|(property, map)| Some((property, texture(map.as_ref()?)))));
    if let Some(from) = &m.metallic_roughness {
        values.push(("base_color", color(from.base_color)));
        values.push(("metallic", number(from.metallic)));
        values.push(("roughness", number(from.roughness)));
        values.extend(from.metallic_map.as_ref().map(|map| ("metallic_map", texture(map))));
        values.extend(from.roughness_map.as_ref().map(|map| ("roughness_map", texture(map))));
    }
    values
        .into_iter()
        .map(|(property, value)| {
            // Those of the other parametrisation are named `metallic_roughness.metallic`.
            let is_its = |source: &&PropertySource| source.property.rsplit('.').next() == Some(property);
            let source = m.sources.iter().find(is_its);
            ValueReport {
                property,
                value,
                line: source.and_then(|s| s.line),
                written: source.map(|s| s.written.clone()).unwrap_or_default(),
                rule: source.map(|s| s.rule.clone()).unwrap_or_default(),
            }
        })
        .collect()
}

fn color(value: [f32; 3]) -> String {
    value.map(number).join(" ")
}

/// Shortest, and not longer than a person reads.
fn number(value: f32) -> String {
    let text = value.to_string();
    if text.len() <= 8 { text } else { format!("{value:.5}") }
}

/// The path of a texture and its transformations.
fn texture(map: &TextureMap) -> String {
    let mut text = map.path.clone();
    let mut add = |what: String| text += &format!(", {what}");
    if map.scale != [1.0; 2] {
        add(format!("scale {}", map.scale.map(number).join(" ")));
    }
    if map.rotation != 0.0 {
        add(format!("turned by {} degrees", number(map.rotation.to_degrees())));
    }
    if map.offset != [0.0; 2] {
        add(format!("offset {}", map.offset.map(number).join(" ")));
    }
    let wrap = |wrap| match wrap {
        Wrap::Repeat => "repeated",
        Wrap::Clamp => "clamped",
        Wrap::Mirror => "mirrored",
    };
    match map.wrap {
        [Wrap::Repeat, Wrap::Repeat] => {}
        [u, v] if u == v => add(wrap(u).to_owned()),
        [u, v] => add(format!("{} along u, {} along v", wrap(u), wrap(v))),
    }
    let TexelRule { channel, base, gain, cutoff } = map.texel;
    if let Some(channel) = channel {
        add(format!("{channel:?} channel").to_lowercase());
    }
    if (base, gain) != (0.0, 1.0) {
        add(format!("{} + {} * value", number(base), number(gain)));
    }
    if let Some(cutoff) = cutoff {
        add(format!("all or nothing at {}", number(cutoff)));
    }
    if map.bump_multiplier != 1.0 {
        add(format!("strength {}", number(map.bump_multiplier)));
    }
    text
}
