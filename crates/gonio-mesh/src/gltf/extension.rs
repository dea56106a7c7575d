//! Extensions: checks which ones a file needs and uses.

use super::json::JsonRef;
use crate::report::Reports;
use crate::{Diagnostic, ReadError};

/// Extensions that are supported, or that do not affect a model at rest.
const UNDERSTOOD: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Unsupported extensions without which the shape is right, but not the appearance, and what is lost.
const SURVIVED: &[(&str, &str)] = &[
    ("KHR_animation_pointer", "animations are not played"),
    ("KHR_materials_variants", "each part has its first material"),
    ("KHR_technique_webgl", "its shaders are not run: the material is shown without them"),
    ("KHR_techniques_webgl", "its shaders are not run: the material is shown without them"),
    ("KHR_texture_basisu", "KTX2 images cannot be read"),
    ("EXT_texture_webp", "an image in another format is used instead, if there is one"),
    ("EXT_texture_avif", "an image in another format is used instead, if there is one"),
    ("MSFT_texture_dds", "an image in another format is used instead, if there is one"),
    ("KHR_node_visibility", "hidden nodes are shown"),
    ("EXT_lights_image_based", "its environment is not used"),
];

/// Unsupported extensions without which nothing is right, with advice.
const REFUSED: &[(&str, &str)] = &[
    ("KHR_draco_mesh_compression", "export it without Draco compression"),
    ("EXT_meshopt_compression", "export it without meshopt compression, or unpack it with gltf-transform"),
    ("KHR_meshopt_compression", "export it without meshopt compression, or unpack it with gltf-transform"),
    ("EXT_mesh_gpu_instancing", "export the copies as nodes of their own"),
];

/// Rejects a file that cannot be shown without an extension; warns about others.
pub(super) fn check(root: JsonRef<'_>, reports: &mut Reports) -> Result<(), ReadError> {
    for at in root.list("extensionsRequired")? {
        let name = at.value.as_str().unwrap_or_default();
        if UNDERSTOOD.contains(&name) || lost_without(name).is_some() {
            continue;
        }
        let advice = find(REFUSED, name).unwrap_or("export it without that extension");
        return Err(ReadError::new(format!("needs the extension {name:?}, which is not supported: {advice}")));
    }
    let mut reported: Vec<&str> = Vec::new();
    for at in root.list("extensionsUsed")? {
        let name = at.value.as_str().unwrap_or_default();
        // Extensions of materials are reported where they are used.
        if UNDERSTOOD.contains(&name) || name.starts_with("KHR_materials_") && find(SURVIVED, name).is_none() {
            continue;
        }
        if reported.contains(&name) || reported.len() > 50 {
            continue;
        }
        reported.push(name);
        let lost = match (find(SURVIVED, name), find(REFUSED, name)) {
            (Some(lost), _) => lost,
            (None, Some(_)) => "the rest of the file is shown",
            (None, None) => "its data is ignored",
        };
        reports.push(0, Diagnostic::warning(format!("uses the extension {name:?}, which is not supported: {lost}")));
    }
    Ok(())
}

fn lost_without(name: &str) -> Option<&'static str> {
    let of_material = name.starts_with("KHR_materials_").then_some("the material is shown without it");
    find(SURVIVED, name).or(of_material)
}

fn find(list: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    list.iter().find(|(known, _)| *known == name).map(|(_, what)| *what)
}
