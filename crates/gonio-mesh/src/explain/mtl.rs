//! Explains statements of a material library.

use super::file::{Extent, blank, describe_extent, named, no_such_line, numbers, printable};
use super::{InForce, LineExplanation, LineValue};
use crate::text::{Cursor, decode};
use crate::{AmbientRule, Material, ReadError, TextureMap, Wrap, mtl};

/// Statements and their meanings.
const MEANINGS: [(&str, &str); 44] = [
    ("Ka", "the ambient color"),
    ("Kd", "the diffuse color"),
    ("Ks", "the color of the highlight"),
    ("Ke", "the color of the emitted light"),
    ("Ns", "the exponent of the highlight: the larger, the smaller and sharper it is"),
    ("Ni", "the index of refraction"),
    ("d", "the opacity: 1 is solid, 0 invisible"),
    ("Tr", "the transparency: 0 is solid, 1 invisible"),
    ("illum", "the illumination model: which terms of the lighting are on"),
    ("Tf", "the color of the transmitted light"),
    ("sharpness", "the sharpness of reflections"),
    ("map_Ka", "a texture of the ambient color"),
    ("map_Kd", "a texture of the diffuse color"),
    ("map_Ks", "a texture of the color of the highlight"),
    ("map_Ke", "a texture of the emitted light"),
    ("map_emissive", "a texture of the emitted light"),
    ("map_Ns", "a texture of the exponent of the highlight"),
    ("map_d", "a texture of the opacity"),
    ("map_opacity", "a texture of the opacity"),
    ("map_Tr", "a texture of the transparency"),
    ("map_Bump", "a texture of heights, or of normals"),
    ("bump", "a texture of heights, or of normals"),
    ("norm", "a texture of normals"),
    ("map_Kn", "a texture of normals"),
    ("disp", "a texture of displacements"),
    ("decal", "a texture that replaces the color"),
    ("refl", "a reflection map"),
    ("map_refl", "a reflection map, or Blender's metalness texture"),
    ("map_aat", "whether textures are filtered"),
    ("Pr", "the roughness (physically based): 0 is a mirror, 1 matte"),
    ("Pm", "the metalness (physically based)"),
    ("Ps", "the sheen, as on velvet (physically based)"),
    ("Pc", "the thickness of a clear coat (physically based)"),
    ("Pcr", "the roughness of a clear coat (physically based)"),
    ("aniso", "the anisotropy of the highlight (physically based)"),
    ("anisor", "the rotation of the anisotropy (physically based)"),
    ("map_Pr", "a texture of the roughness (physically based)"),
    ("map_Pm", "a texture of metalness (physically based)"),
    ("map_Ps", "a texture of the sheen (physically based)"),
    ("map_Pc", "a texture of the clear coat (physically based)"),
    ("map_Pcr", "a texture of the roughness of the clear coat (physically based)"),
    ("map_RMA", "a texture of roughness, metalness and occlusion in red, green and blue"),
    ("map_ORM", "a texture of occlusion, roughness and metalness in red, green and blue"),
    ("map_norm", "a texture of normals"),
];

pub(super) fn explain(bytes: &[u8], line: u64) -> Result<LineExplanation, ReadError> {
    let (extent, material) = find(bytes, line)?;
    let mut explanation = blank(bytes, line, extent);
    let mut cursor = Cursor::at_line(bytes, extent.start, extent.first_line);
    if !cursor.next_word() {
        let is_comment = cursor.peek() == Some(b'#');
        explanation.meaning = if is_comment { "a comment" } else { "an empty line" }.to_owned();
    } else {
        let keyword = decode(cursor.word());
        let is = |known: &str| known.eq_ignore_ascii_case(&keyword);
        if is("newmtl") {
            let name = cursor.name();
            explanation.meaning = match name.is_empty() {
                true => "starts an unnamed material".to_owned(),
                false => format!("starts the material {}", named(&name)),
            };
            explanation.value = Some(LineValue::Name { name });
        } else {
            let known = MEANINGS.iter().find(|(known, _)| is(known));
            explanation.meaning = match (known, &material) {
                (None, _) => "not a known statement: skipped".to_owned(),
                (Some((_, meaning)), None) => format!("{meaning}, of no material: no newmtl precedes it"),
                (Some((_, meaning)), Some((name, _))) => format!("{meaning}, of the material {}", named(name)),
            };
        }
    }
    if let Some((name, line)) = &material {
        explanation.in_force.push(InForce { what: "material", name: printable(name), line: *line });
    }
    add_result(bytes, extent, &mut explanation);
    describe_extent(&mut explanation);
    Ok(explanation)
}

/// Returns the statement of a line and the material that it belongs to.
fn find(bytes: &[u8], line: u64) -> Result<(Extent, Option<(String, u64)>), ReadError> {
    let mut material = None;
    let mut cursor = Cursor::new(bytes);
    while !cursor.at_end() && line > 0 {
        let (start, first_line) = (cursor.position(), cursor.line());
        let mut begun = None;
        if cursor.next_word() {
            let is_material = cursor.word().eq_ignore_ascii_case(b"newmtl");
            let name = cursor.name();
            begun = is_material.then_some((name, first_line));
        }
        cursor.next_line();
        let extent = Extent::ending_at(start, first_line, &cursor, bytes);
        if extent.last_line >= line {
            return Ok((extent, material));
        }
        material = begun.or(material);
    }
    Err(no_such_line(line, &cursor, bytes))
}

/// Adds the values that the reader takes from the statement, and its diagnostics.
fn add_result(bytes: &[u8], extent: Extent, explanation: &mut LineExplanation) {
    let (materials, diagnostics) = mtl::read(bytes);
    let is_here = |line: Option<u64>| line.is_some_and(|line| (extent.first_line..=extent.last_line).contains(&line));
    for material in &materials {
        for source in material.sources.iter().filter(|source| is_here(source.line)) {
            let value = value(material, source.property);
            let rule = if source.rule.is_empty() { String::new() } else { format!(" ({})", source.rule) };
            explanation.details.push(format!("{} = {}{rule}", source.property, printable(&value)));
            let property = source.property.to_owned();
            explanation.value.get_or_insert(LineValue::Property { property, value });
        }
        for unused in material.unused.iter().filter(|source| is_here(source.line)) {
            explanation.details.push(format!("not used: {}", unused.rule));
        }
    }
    explanation.problems.extend(diagnostics.into_iter().filter(|diagnostic| is_here(diagnostic.place.line)));
}

/// Formats a property of a material; empty if the material does not have it.
fn value(material: &Material, property: &str) -> String {
    let map = |map: &Option<TextureMap>| map.as_ref().map(texture).unwrap_or_default();
    let physical = material.metallic_roughness.as_ref();
    match property {
        "ambient" => match material.ambient {
            AmbientRule::FollowsDiffuse => "same as diffuse".to_owned(),
            AmbientRule::Value(color) => numbers(&color),
        },
        "diffuse" => numbers(&material.diffuse),
        "specular" => numbers(&material.specular),
        "emitted" => numbers(&material.emitted),
        "shininess" => material.shininess.to_string(),
        "refraction_index" => material.refraction_index.to_string(),
        "opacity" => material.opacity.to_string(),
        "illumination_model" => material.illumination_model.map(|model| model.to_string()).unwrap_or_default(),
        "diffuse_map" => map(&material.diffuse_map),
        "specular_map" => map(&material.specular_map),
        "emitted_map" => map(&material.emitted_map),
        "shininess_map" => map(&material.shininess_map),
        "opacity_map" => map(&material.opacity_map),
        "normal_map" => map(&material.normal_map),
        "bump_map" => map(&material.bump_map),
        "metallic_roughness.metallic" => physical.map(|p| p.metallic.to_string()).unwrap_or_default(),
        "metallic_roughness.roughness" => physical.map(|p| p.roughness.to_string()).unwrap_or_default(),
        "metallic_roughness.metallic_map" => physical.map(|p| map(&p.metallic_map)).unwrap_or_default(),
        "metallic_roughness.roughness_map" => physical.map(|p| map(&p.roughness_map)).unwrap_or_default(),
        _ => String::new(),
    }
}

/// Formats a texture and its unusual options.
fn texture(map: &TextureMap) -> String {
    let mut text = named(&map.path);
    let mut say = |what: &str, values: &[f32]| text.push_str(&format!(", {what} {}", numbers(values)));
    if map.scale != [1.0; 2] {
        say("scale", &map.scale);
    }
    if map.offset != [0.0; 2] {
        say("offset", &map.offset);
    }
    if (map.texel.base, map.texel.gain) != (0.0, 1.0) {
        say("base and gain", &[map.texel.base, map.texel.gain]);
    }
    if map.bump_multiplier != 1.0 {
        say("strength", &[map.bump_multiplier]);
    }
    if let Some(channel) = map.texel.channel {
        text.push_str(&format!(", channel {}", format!("{channel:?}").to_lowercase()));
    }
    if map.wrap == [Wrap::Clamp; 2] {
        text.push_str(", clamped");
    }
    text
}
