//! Converts materials to the terms of the light equation, by the rule of [`MetallicRoughness`].

use super::buffer::Buffers;
use super::json::JsonRef;
use super::primitive::MaterialUse;
use super::texture::Textures;
use crate::diagnostic::Reports;
use crate::{
    AmbientRule, Channel, Material, MetallicRoughness, PropertySource, ReadError, Severity, TexelRule, TextureMap,
};

/// Extensions for which the light equation has no term, and the property each of them adds.
const WITHOUT_TERM: [(&str, &str); 8] = [
    ("KHR_materials_anisotropy", "anisotropy"),
    ("KHR_materials_clearcoat", "clearcoat"),
    ("KHR_materials_diffuse_transmission", "diffuse_transmission"),
    ("KHR_materials_dispersion", "dispersion"),
    ("KHR_materials_iridescence", "iridescence"),
    ("KHR_materials_sheen", "sheen"),
    ("KHR_materials_transmission", "transmission"),
    ("KHR_materials_volume", "volume"),
];

const UNDERSTOOD: [&str; 5] = [
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_unlit",
];

/// A material, and the set of texture coordinates it needs.
pub(super) struct ReadMaterial {
    pub material: Material,
    pub tex_coord_set: Option<usize>,
}

impl ReadMaterial {
    pub fn use_as(&self, material: usize) -> MaterialUse {
        MaterialUse { material, tex_coord_set: self.tex_coord_set }
    }
}

/// Reads one material. It never fails: an invalid value becomes a warning and is replaced by the default.
pub(super) fn read<'v>(
    at: JsonRef<'v>,
    textures: &mut Textures<'v>,
    buffers: &mut Buffers<'v, '_>,
    reports: &mut Reports,
) -> ReadMaterial {
    let material = Material {
        name: at.name().to_owned(),
        specular: [MetallicRoughness::DIELECTRIC_SPECULAR; 3],
        ..Material::default()
    };
    let mut draft = Draft { at, material, textures, buffers, reports, tex_coord_set: None };
    let base = match at.extension("KHR_materials_pbrSpecularGlossiness") {
        Some(extension) => draft.specular_glossiness(extension),
        None => draft.metallic_roughness(),
    };
    draft.emission();
    draft.opacity(&base);
    if at.extension("KHR_materials_unlit").is_some() {
        draft.unlit(&base);
    }
    draft.normal_map();
    draft.not_used();
    draft.material.sort_sources();
    ReadMaterial { material: draft.material, tex_coord_set: draft.tex_coord_set }
}

/// A material that is being read.
struct Draft<'d, 'v, 's> {
    at: JsonRef<'v>,
    material: Material,
    textures: &'d mut Textures<'v>,
    buffers: &'d mut Buffers<'v, 's>,
    reports: &'d mut Reports,
    /// The set of the first texture.
    tex_coord_set: Option<usize>,
}

/// The base colour or diffuse colour, with its opacity and texture.
struct Base {
    color: [f32; 3],
    alpha: f32,
    map: Option<TextureMap>,
    written: String,
    map_written: String,
}

/// A number or colour, and how it is written in the file.
struct Found<T> {
    value: T,
    written: String,
}

impl<'v> Draft<'_, 'v, '_> {
    fn source(&mut self, property: &'static str, written: String, rule: impl Into<String>) {
        let rule: String = rule.into();
        let rule = match (written.is_empty(), rule.is_empty()) {
            (true, true) => "glTF's default".to_owned(),
            (true, false) => format!("glTF's default; {rule}"),
            (false, _) => rule,
        };
        self.material.sources.push(PropertySource { property, line: None, written, rule });
    }

    fn warn(&mut self, error: ReadError) {
        let message = || format!("{}: using the default", error.message);
        self.reports.add_without_line("values of materials that are ignored", Severity::Warning, message);
    }

    /// Reads a number and clamps it to its range.
    fn number(&mut self, place: Option<JsonRef<'v>>, key: &'static str, default: f64, most: f64) -> Found<f32> {
        let Some(place) = place else { return Found { value: default as f32, written: String::new() } };
        let written = place.written(key);
        match place.number(key) {
            Ok(Some(value)) => Found { value: self.bounded([value], &written, most)[0], written },
            Ok(None) => Found { value: default as f32, written },
            Err(error) => {
                self.warn(error);
                Found { value: default as f32, written }
            }
        }
    }

    /// Reads a colour and clamps it to its range.
    fn color<const N: usize>(
        &mut self,
        place: Option<JsonRef<'v>>,
        key: &'static str,
        default: f32,
        most: f64,
    ) -> Found<[f32; N]> {
        let Some(place) = place else { return Found { value: [default; N], written: String::new() } };
        let written = place.written(key);
        match place.numbers::<N>(key) {
            Ok(Some(value)) => Found { value: self.bounded(value, &written, most), written },
            Ok(None) => Found { value: [default; N], written },
            Err(error) => {
                self.warn(error);
                Found { value: [default; N], written }
            }
        }
    }

    fn bounded<const N: usize>(&mut self, values: [f64; N], written: &str, most: f64) -> [f32; N] {
        if values.iter().any(|v| !(0.0..=most).contains(v)) {
            let message = || {
                let range =
                    if most < f64::from(f32::MAX) { format!("from 0 to {most}") } else { "at least 0".to_owned() };
                format!("{written}, but it must be {range}: clamped")
            };
            self.reports.add_without_line("values of materials out of their range", Severity::Warning, message);
        }
        values.map(|v| v.clamp(0.0, most.min(f32::MAX.into())) as f32)
    }

    /// Reads a texture. A mesh has one set of texture coordinates, so textures on a set other than the first one's are
    /// left out.
    fn texture(&mut self, place: Option<JsonRef<'v>>, key: &'static str) -> Option<(TextureMap, String)> {
        let info = place?.get(key)?;
        let placed = self.textures.map(info, self.buffers, self.reports)?;
        let set = *self.tex_coord_set.get_or_insert(placed.tex_coord_set);
        if set != placed.tex_coord_set {
            let message = || {
                let (path, other) = (info.path(), placed.tex_coord_set);
                format!(
                    "{path} uses TEXCOORD_{other}, but the material's first texture uses TEXCOORD_{set}: it is left out"
                )
            };
            let kind = "textures on other texture coordinates";
            self.reports.add_without_line(kind, Severity::Warning, message);
            return None;
        }
        let written = format!("{} ({})", info.written("index"), placed.map.path);
        Some((placed.map, written))
    }

    fn metallic_roughness(&mut self) -> Base {
        let pbr = self.at.get("pbrMetallicRoughness");
        let color = self.color::<4>(pbr, "baseColorFactor", 1.0, 1.0);
        let metallic = self.number(pbr, "metallicFactor", 1.0, 1.0);
        let roughness = self.number(pbr, "roughnessFactor", 1.0, 1.0);
        let [r, g, b, alpha] = color.value;
        let (map, map_written) = self.texture(pbr, "baseColorTexture").unzip();
        let base =
            Base { color: [r, g, b], alpha, map, written: color.written, map_written: map_written.unwrap_or_default() };
        let (scalars, scalars_written) = self.texture(pbr, "metallicRoughnessTexture").unzip();
        let channel = |channel| {
            let mut map: TextureMap = scalars.clone()?;
            map.texel.channel = Some(channel);
            Some(map)
        };
        let made = MetallicRoughness {
            base_color: base.color,
            metallic: metallic.value,
            roughness: roughness.value,
            metallic_map: channel(Channel::Blue),
            roughness_map: channel(Channel::Green),
        };
        self.material.diffuse = MetallicRoughness::diffuse(base.color, made.metallic);
        let by_metal =
            if made.metallic == 0.0 { String::new() } else { format!("times 1 - metallic ({})", made.metallic) };
        self.source("diffuse", base.written.clone(), by_metal);
        self.specular(&made, &metallic.written);
        self.material.shininess = MetallicRoughness::shininess(made.roughness);
        self.source("shininess", roughness.written, format!("2 / roughness^4 - 2 with roughness {}", made.roughness));
        self.material.diffuse_map = base.map.clone();
        if base.map.is_some() {
            self.source("diffuse_map", base.map_written.clone(), "");
        }
        if let Some(written) = scalars_written {
            self.source("metallic_roughness", written, "metalness is blue, roughness is green");
        }
        self.specular_map(&made, &base);
        self.material.metallic_roughness = Some(made);
        base
    }

    /// Applies `KHR_materials_ior` and `KHR_materials_specular`, the reflectance of dielectrics.
    fn specular(&mut self, made: &MetallicRoughness, metallic_written: &str) {
        let ior = self.number(self.at.extension("KHR_materials_ior"), "ior", 1.5, f64::MAX);
        let extension = self.at.extension("KHR_materials_specular");
        let strength = self.number(extension, "specularFactor", 1.0, 1.0);
        let color = self.color::<3>(extension, "specularColorFactor", 1.0, f64::MAX);
        // An index of 0 means a reflectance of 1.
        let reflectance = if ior.value == 0.0 { 1.0 } else { ((ior.value - 1.0) / (ior.value + 1.0)).powi(2) };
        let plain = ior.value == 1.5 && strength.value == 1.0 && color.value == [1.0; 3];
        // 0.04 is (0.5 / 2.5)^2 except for rounding.
        let dielectric = if plain {
            [MetallicRoughness::DIELECTRIC_SPECULAR; 3]
        } else {
            color.value.map(|c| (reflectance * c).min(1.0) * strength.value)
        };
        let mix = |i: usize| dielectric[i] + (made.base_color[i] - dielectric[i]) * made.metallic;
        self.material.specular = [mix(0), mix(1), mix(2)];
        if ior.value >= 1.0 {
            self.material.refraction_index = ior.value;
        }
        let written = [metallic_written, &ior.written, &strength.written, &color.written];
        let written = written.into_iter().filter(|w| !w.is_empty()).collect::<Vec<_>>().join("; ");
        let [r, g, b] = dielectric;
        let dielectric_name = if r == g && g == b { format!("{r}") } else { format!("[{r}, {g}, {b}]") };
        self.source("specular", written, format!("mix({dielectric_name}, base color, metallic {})", made.metallic));
        if !ior.written.is_empty() {
            self.source("refraction_index", ior.written, "");
        }
        if !plain && made.metallic_map.is_some() {
            let message = || {
                let path = self.at.title();
                format!(
                    "{path} has both a metalness texture and a specular factor or ior: using a reflectance of 0.04 for dielectrics"
                )
            };
            let kind = "materials with both metalness textures and specular factors";
            self.reports.add_without_line(kind, Severity::Warning, message);
        }
    }

    fn specular_map(&mut self, made: &MetallicRoughness, base: &Base) {
        // For pure metal, k_s is the base colour, with its texture.
        if made.metallic == 1.0 && made.metallic_map.is_none() && base.map.is_some() {
            self.material.specular_map = base.map.clone();
            self.source("specular_map", base.map_written.clone(), "metal reflects in its base color");
        }
        let extension = self.at.extension("KHR_materials_specular");
        if let Some((map, written)) = self.texture(extension, "specularColorTexture") {
            if made.metallic == 0.0 {
                self.material.specular_map = Some(map);
                self.source("specular_map", written, "");
            } else {
                self.unused("specular_color_texture", written, "only where metallicFactor is 0");
            }
        }
        if let Some((_, written)) = self.texture(extension, "specularTexture") {
            self.unused("specular_texture", written, "");
        }
    }

    /// Applies `KHR_materials_pbrSpecularGlossiness`: roughness is 1 - glossiness.
    fn specular_glossiness(&mut self, at: JsonRef<'v>) -> Base {
        let place = Some(at);
        let color = self.color::<4>(place, "diffuseFactor", 1.0, 1.0);
        let specular = self.color::<3>(place, "specularFactor", 1.0, 1.0);
        let glossiness = self.number(place, "glossinessFactor", 1.0, 1.0);
        let [r, g, b, alpha] = color.value;
        let (map, map_written) = self.texture(place, "diffuseTexture").unzip();
        let base =
            Base { color: [r, g, b], alpha, map, written: color.written, map_written: map_written.unwrap_or_default() };
        self.material.diffuse = base.color;
        self.source("diffuse", base.written.clone(), "");
        self.material.specular = specular.value;
        self.source("specular", specular.written, "");
        let roughness = 1.0 - glossiness.value;
        self.material.shininess = MetallicRoughness::shininess(roughness);
        let rule = format!("2 / roughness^4 - 2 with roughness = 1 - glossiness = {roughness}");
        self.source("shininess", glossiness.written, rule);
        self.material.diffuse_map = base.map.clone();
        if base.map.is_some() {
            self.source("diffuse_map", base.map_written.clone(), "");
        }
        if let Some((map, written)) = self.texture(place, "specularGlossinessTexture") {
            // 1 - glossinessFactor * alpha as a whole.
            let texel = TexelRule { channel: Some(Channel::Alpha), base: 1.0, gain: -glossiness.value, cutoff: None };
            self.material.metallic_roughness = Some(MetallicRoughness {
                base_color: base.color,
                metallic: 0.0,
                roughness: 1.0,
                metallic_map: None,
                roughness_map: Some(TextureMap { texel, ..map.clone() }),
            });
            self.material.specular_map = Some(map);
            self.source("specular_map", written.clone(), "");
            self.source("metallic_roughness", written, "roughness is 1 - glossiness * alpha");
        }
        base
    }

    fn emission(&mut self) {
        let color = self.color::<3>(Some(self.at), "emissiveFactor", 0.0, f64::MAX);
        let extension = self.at.extension("KHR_materials_emissive_strength");
        let strength = self.number(extension, "emissiveStrength", 1.0, f64::MAX);
        self.material.emitted = color.value.map(|c| (c * strength.value).min(f32::MAX));
        let rule = if strength.written.is_empty() { String::new() } else { format!("times {}", strength.written) };
        self.source("emitted", color.written, rule);
        if let Some((map, written)) = self.texture(Some(self.at), "emissiveTexture") {
            self.material.emitted_map = Some(map);
            self.source("emitted_map", written, "");
        }
    }

    /// Applies alpha according to `alphaMode`.
    fn opacity(&mut self, base: &Base) {
        let mode = match self.at.text("alphaMode") {
            Ok(mode) => mode.unwrap_or("OPAQUE"),
            Err(error) => {
                self.warn(error);
                "OPAQUE"
            }
        };
        let with_alpha = |texel: TexelRule| base.map.clone().map(|map| TextureMap { texel, ..map });
        let alpha = TexelRule { channel: Some(Channel::Alpha), ..TexelRule::default() };
        let written = self.at.written("alphaMode");
        match mode {
            "OPAQUE" => {
                let rule = if base.alpha < 1.0 {
                    format!("opaque: the alpha {} is ignored", base.alpha)
                } else {
                    String::new()
                };
                self.source("opacity", written, rule);
            }
            "BLEND" => {
                self.material.opacity = base.alpha;
                self.source("opacity", format!("{written}; {}", base.written), "alpha");
                self.material.opacity_map = with_alpha(alpha);
            }
            "MASK" => {
                let cutoff = self.number(Some(self.at), "alphaCutoff", 0.5, f64::MAX);
                let texel = TexelRule { gain: base.alpha, cutoff: Some(cutoff.value), ..alpha };
                self.material.opacity_map = with_alpha(texel);
                let is_seen = base.map.is_some() || base.alpha >= cutoff.value;
                self.material.opacity = if is_seen { 1.0 } else { 0.0 };
                self.source("opacity", written, format!("1 where alpha is at least {}, else 0", cutoff.value));
            }
            other => {
                let error =
                    ReadError::new(format!("{}.alphaMode is {other:?}, not OPAQUE, MASK or BLEND", self.at.path()));
                self.warn(error);
            }
        }
        if self.material.opacity_map.is_some() {
            self.source("opacity_map", base.map_written.clone(), "its alpha");
        }
    }

    /// Applies `KHR_materials_unlit`: the base colour does not depend on lighting, so it is emitted, and nothing else
    /// is.
    fn unlit(&mut self, base: &Base) {
        let material = &mut self.material;
        material.ambient = AmbientRule::Value([0.0; 3]);
        (material.diffuse, material.specular) = ([0.0; 3], [0.0; 3]);
        (material.diffuse_map, material.specular_map, material.metallic_roughness) = (None, None, None);
        (material.emitted, material.emitted_map) = (base.color, base.map.clone());
        material.sources.retain(|source| source.property.starts_with("opacity"));
        let rule = "unlit (KHR_materials_unlit): the base color is emitted, nothing is reflected";
        self.source("emitted", base.written.clone(), rule);
        if base.map.is_some() {
            self.source("emitted_map", base.map_written.clone(), rule);
        }
    }

    fn normal_map(&mut self) {
        let info = self.at.get("normalTexture");
        let Some((mut map, written)) = self.texture(Some(self.at), "normalTexture") else { return };
        let scale = match info.map_or(Ok(None), |info| info.number("scale")) {
            Ok(scale) => scale.unwrap_or(1.0) as f32,
            Err(error) => {
                self.warn(error);
                1.0
            }
        };
        map.bump_multiplier = if scale.is_finite() { scale } else { 1.0 };
        let rule = if scale == 1.0 { String::new() } else { format!("x and y times {scale}") };
        self.source("normal_map", written, rule);
        self.material.normal_map = Some(map);
    }

    fn unused(&mut self, property: &'static str, written: String, rule: &str) {
        self.material.unused.push(PropertySource { property, line: None, written, rule: rule.to_owned() });
    }

    /// Lists properties for which the light equation has no term.
    fn not_used(&mut self) {
        let at = self.at;
        if at.get("occlusionTexture").is_some() {
            self.unused("occlusion_map", at.written("occlusionTexture"), "baked shadow of ambient light");
            let message = || format!("{} has an occlusionTexture: it is not used", at.title());
            self.reports.add_without_line("materials with occlusion textures", Severity::Note, message);
        }
        if at.flag("doubleSided") {
            self.unused("double_sided", at.written("doubleSided"), "");
        }
        let Some(extensions) = at.get("extensions") else { return };
        for (name, extension) in extensions.members().filter(|(name, _)| !UNDERSTOOD.contains(name)) {
            let known = WITHOUT_TERM.iter().find(|(known, _)| *known == name);
            let written = format!("{} = {}", extension.path(), extension.quoted());
            self.unused(known.map_or("extension", |(_, property)| property), written, "");
            let message = || {
                let (title, reason) =
                    (at.title(), if known.is_some() { "the light equation has no term for" } else { "is not known" });
                format!("{title} has {name}, which {reason}: it is shown without it")
            };
            let kind = "materials with extensions that are not supported";
            self.reports.add_without_line(kind, Severity::Warning, message);
        }
    }
}
