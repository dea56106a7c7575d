//! The statements of a material as they are written, before any rule is applied.

use super::map::{self, MapUse, UnsupportedOptions};
use super::values::{Located, Place, color, only_scalar, put};
use crate::diagnostic::Reports;
use crate::text::{Cursor, quote};
use crate::{Channel, PropertySource, Severity, TextureMap};

#[derive(Default)]
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) line: u64,
    pub(super) ambient: Option<Located<[f32; 3]>>,
    pub(super) diffuse: Option<Located<[f32; 3]>>,
    pub(super) specular: Option<Located<[f32; 3]>>,
    pub(super) emitted: Option<Located<[f32; 3]>>,
    pub(super) shininess: Option<Located<f32>>,
    pub(super) refraction_index: Option<Located<f32>>,
    pub(super) opacity: Option<Located<f32>>,
    pub(super) transparency: Option<Located<f32>>,
    pub(super) illumination_model: Option<Located<u8>>,
    pub(super) ambient_map: Option<Located<TextureMap>>,
    pub(super) diffuse_map: Option<Located<TextureMap>>,
    pub(super) specular_map: Option<Located<TextureMap>>,
    pub(super) emitted_map: Option<Located<TextureMap>>,
    pub(super) shininess_map: Option<Located<TextureMap>>,
    pub(super) opacity_map: Option<Located<TextureMap>>,
    pub(super) transparency_map: Option<Located<TextureMap>>,
    pub(super) normal_map: Option<Located<TextureMap>>,
    pub(super) bump_map: Option<Located<TextureMap>>,
    pub(super) metallic: Option<Located<f32>>,
    pub(super) roughness: Option<Located<f32>>,
    pub(super) metallic_map: Option<Located<TextureMap>>,
    pub(super) roughness_map: Option<Located<TextureMap>>,
    /// Statements without a term in the light equation; the last one of each keyword.
    pub(super) unused: Vec<PropertySource>,
}

/// Statements of the format and its physically based extension for which the light equation has no term.
pub(super) const UNUSED: [&str; 15] = [
    "map_Ps",
    "map_Pc",
    "map_Pcr",
    "map_aniso",
    "map_aat",
    "Tf",
    "Kt",
    "Km",
    "Ps",
    "Pc",
    "Pcr",
    "aniso",
    "anisor",
    "sharpness",
    "decal",
];

impl Draft {
    pub(super) fn new(name: String, line: u64) -> Self {
        Draft { name, line, ..Draft::default() }
    }

    /// Reads a statement. Returns whether it belongs to the format or its extensions.
    pub(super) fn statement(
        &mut self,
        keyword: &[u8],
        place: Place,
        cursor: &mut Cursor<'_>,
        unsupported: &mut UnsupportedOptions,
        reports: &mut Reports,
    ) -> bool {
        // Programs differ in the case of letters, and no two statements differ only in it.
        let lower = keyword.to_ascii_lowercase();
        let (slot, name): (&mut Option<Located<[f32; 3]>>, _) = match lower.as_slice() {
            b"ka" => (&mut self.ambient, "Ka"),
            b"kd" => (&mut self.diffuse, "Kd"),
            b"ks" => (&mut self.specular, "Ks"),
            b"ke" => (&mut self.emitted, "Ke"),
            _ => return self.scalar_or_map(&lower, place, cursor, unsupported, reports),
        };
        put(slot, color(cursor, name, reports), &place, name, reports);
        true
    }

    fn scalar_or_map(
        &mut self,
        lower: &[u8],
        place: Place,
        cursor: &mut Cursor<'_>,
        unsupported: &mut UnsupportedOptions,
        reports: &mut Reports,
    ) -> bool {
        let (slot, name): (&mut Option<Located<f32>>, _) = match lower {
            b"ns" => (&mut self.shininess, "Ns"),
            b"ni" => (&mut self.refraction_index, "Ni"),
            b"tr" => (&mut self.transparency, "Tr"),
            b"pr" => (&mut self.roughness, "Pr"),
            b"pm" => (&mut self.metallic, "Pm"),
            b"d" => {
                skip_halo(cursor, reports);
                (&mut self.opacity, "d")
            }
            b"illum" => {
                put(&mut self.illumination_model, illumination_model(cursor, reports), &place, "illum", reports);
                return true;
            }
            _ => return self.map_or_unused(lower, place, cursor, unsupported, reports),
        };
        put(slot, only_scalar(cursor, name, reports), &place, name, reports);
        true
    }

    fn map_or_unused(
        &mut self,
        lower: &[u8],
        place: Place,
        cursor: &mut Cursor<'_>,
        unsupported: &mut UnsupportedOptions,
        reports: &mut Reports,
    ) -> bool {
        let (slot, name, purpose) = match lower {
            b"map_ka" => (&mut self.ambient_map, "map_Ka", MapUse::Color),
            b"map_kd" => (&mut self.diffuse_map, "map_Kd", MapUse::Color),
            b"map_ks" => (&mut self.specular_map, "map_Ks", MapUse::Color),
            b"map_ke" | b"map_emissive" => (&mut self.emitted_map, "map_Ke", MapUse::Color),
            b"map_ns" => (&mut self.shininess_map, "map_Ns", MapUse::Scalar),
            b"map_d" | b"map_opacity" => (&mut self.opacity_map, "map_d", MapUse::Scalar),
            b"map_tr" => (&mut self.transparency_map, "map_Tr", MapUse::Scalar),
            b"map_bump" | b"bump" => (&mut self.bump_map, "map_Bump", MapUse::Bump),
            b"norm" | b"map_kn" | b"map_norm" => (&mut self.normal_map, "norm", MapUse::Bump),
            b"map_pr" => (&mut self.roughness_map, "map_Pr", MapUse::Scalar),
            b"map_pm" => (&mut self.metallic_map, "map_Pm", MapUse::Scalar),
            b"map_rma" | b"map_orm" => {
                self.packed_map(lower == b"map_orm", &place, cursor, unsupported, reports);
                return true;
            }
            b"refl" | b"map_refl" => {
                self.surroundings(&place, cursor, unsupported, reports);
                return true;
            }
            // Displacement heights do not affect the light of a material.
            b"disp" | b"map_disp" => {
                map::read(cursor, "disp", MapUse::Bump, unsupported, reports);
                self.keep_unused("disp", &place, "displacement is not supported");
                return true;
            }
            _ => return self.unused(lower, &place),
        };
        let map = map::read(cursor, name, purpose, unsupported, reports).map(|statement| statement.texture);
        put(slot, map, &place, name, reports);
        true
    }

    /// Reads `map_RMA` (roughness, metalness, occlusion in red, green, blue) or `map_ORM` (occlusion, roughness,
    /// metalness).
    fn packed_map(
        &mut self,
        is_orm: bool,
        place: &Place,
        cursor: &mut Cursor<'_>,
        unsupported: &mut UnsupportedOptions,
        reports: &mut Reports,
    ) {
        let (name, roughness, metallic) =
            if is_orm { ("map_ORM", Channel::Green, Channel::Blue) } else { ("map_RMA", Channel::Red, Channel::Green) };
        let map = map::read(cursor, name, MapUse::Scalar, unsupported, reports).map(|statement| statement.texture);
        let of_channel = |channel| {
            map.clone().map(|mut map| {
                map.texel.channel = Some(channel);
                map
            })
        };
        put(&mut self.roughness_map, of_channel(roughness), place, name, reports);
        put(&mut self.metallic_map, of_channel(metallic), place, name, reports);
    }

    /// Reads `refl -type sphere sky.png`. Blender writes its metalness map as `map_refl`.
    fn surroundings(
        &mut self,
        place: &Place,
        cursor: &mut Cursor<'_>,
        unsupported: &mut UnsupportedOptions,
        reports: &mut Reports,
    ) {
        let Some(read) = map::read(cursor, "refl", MapUse::Surroundings, unsupported, reports) else { return };
        let path = quote(read.texture.path.as_bytes());
        reports.add("reflection maps", Severity::Note, place.line, Some(place.column), || {
            let how = read.projection.map(|word| format!(" ({word})")).unwrap_or_default();
            format!("refl{how} names the reflection map {path}, which is not used")
        });
        self.keep_unused("refl", place, "reflection maps are not used (Blender writes its metalness map as one)");
    }

    fn unused(&mut self, lower: &[u8], place: &Place) -> bool {
        let Some(keyword) = UNUSED.into_iter().find(|known| known.as_bytes().eq_ignore_ascii_case(lower)) else {
            return false;
        };
        self.keep_unused(keyword, place, "no term of the light equation");
        true
    }

    fn keep_unused(&mut self, property: &'static str, place: &Place, rule: &str) {
        self.unused.retain(|source| source.property != property);
        let (line, written) = (Some(place.line), place.written.clone());
        self.unused.push(PropertySource { property, line, written, rule: rule.to_owned() });
    }
}

/// Reads `d -halo 0.5` as `d 0.5`.
fn skip_halo(cursor: &mut Cursor<'_>, reports: &mut Reports) {
    if cursor.next_word() && cursor.offending_word().eq_ignore_ascii_case(b"-halo") {
        let (line, column) = (cursor.line(), Some(cursor.column()));
        cursor.word();
        reports.add("halos", Severity::Note, line, column, || {
            "d -halo is read as d: its dependence on the angle is not supported".to_owned()
        });
    }
}

/// Reads `illum 2`.
fn illumination_model(cursor: &mut Cursor<'_>, reports: &mut Reports) -> Option<u8> {
    cursor.next_word();
    let (line, column) = (cursor.line(), Some(cursor.column()));
    let value = only_scalar(cursor, "illum", reports)?;
    if value.fract() == 0.0 && value <= 10.0 {
        return Some(value as u8);
    }
    reports.add("unknown illumination models", Severity::Warning, line, column, || {
        format!("illum {value} is not an illumination model (0 to 10): it is ignored")
    });
    None
}
