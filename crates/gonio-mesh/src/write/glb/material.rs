//! Converts materials of the light equation to metal and roughness: the inverse of the rule of [`MetallicRoughness`].

use super::Buffer;
use crate::diagnostic::Reports;
use crate::{AmbientRule, Channel, EmbeddedImage, Material, MetallicRoughness, Severity, TexelRule, TextureMap, Wrap};
use serde_json::{Map, Value, json};
use std::collections::HashMap;

/// Below this reflectance an index of refraction would make the colour with it meaningless.
const LEAST_REFLECTANCE: f32 = 1e-4;

/// Colours that differ by no more are equal, because of rounding in the rule and its inverse.
const SAME: f32 = 1e-6;

pub(super) struct MaterialWriter<'w, 'm, 'i> {
    pub textures: TextureWriter<'m, 'i>,
    pub buffer: &'w mut Buffer,
    pub reports: &'w mut Reports,
}

impl MaterialWriter<'_, '_, '_> {
    /// `k_d` is the base colour of a dielectric, gamma the roughness, `k_s` the reflectance (`KHR_materials_specular`).
    /// Parameters that were read as metal and roughness are written unchanged.
    pub fn material(&mut self, material: &Material) -> Value {
        let mut written = Map::new();
        if !material.name.is_empty() {
            written.insert("name".to_owned(), material.name.as_str().into());
        }
        let made = material.metallic_roughness.clone().unwrap_or_else(|| MetallicRoughness {
            base_color: material.diffuse,
            metallic: 0.0,
            roughness: MetallicRoughness::roughness(material.shininess),
            metallic_map: None,
            roughness_map: None,
        });
        let mut extensions = Map::new();
        let mut pbr = self.base(material, &made, &mut written);
        self.scalars(material, &made, &mut pbr);
        self.specular(material, &made, &mut extensions);
        self.emission(material, &mut written, &mut extensions);
        if let Some(map) = &material.normal_map
            && let Some(mut info) = self.texture(material, map, "normal map")
        {
            if map.bump_multiplier != 1.0 {
                info["scale"] = map.bump_multiplier.into();
            }
            written.insert("normalTexture".to_owned(), info);
        }
        self.losses(material);
        written.insert("pbrMetallicRoughness".to_owned(), pbr.into());
        if !extensions.is_empty() {
            written.insert("extensions".to_owned(), extensions.into());
        }
        written.into()
    }

    fn lost(&mut self, material: &Material, what: &str) {
        let message = || format!("the material {:?} has {what}, which glTF cannot store: not written", material.name);
        self.reports.add_without_line("values of materials that are not written", Severity::Warning, message);
    }

    fn texture(&mut self, material: &Material, map: &TextureMap, what: &str) -> Option<Value> {
        let plain = TexelRule { channel: map.texel.channel, ..TexelRule::default() };
        if map.texel != plain {
            self.lost(
                material,
                &format!("a {what} whose range is changed (base {}, gain {})", map.texel.base, map.texel.gain),
            );
        }
        self.textures.info(map, self.buffer, self.reports)
    }

    /// Writes base colour, its texture, and alpha.
    fn base(
        &mut self,
        material: &Material,
        made: &MetallicRoughness,
        written: &mut Map<String, Value>,
    ) -> Map<String, Value> {
        let mut pbr = Map::new();
        let color_map = material.diffuse_map.as_ref();
        if let Some(map) = color_map
            && let Some(info) = self.texture(material, map, "diffuse texture")
        {
            pbr.insert("baseColorTexture".to_owned(), info);
        }
        let alpha_map = material.opacity_map.as_ref().filter(|map| {
            let is_alpha = matches!(map.texel.channel, None | Some(Channel::Alpha)) && map.texel.base == 0.0;
            is_alpha && color_map.is_some_and(|color| key(color) == key(map))
        });
        if material.opacity_map.is_some() && alpha_map.is_none() {
            self.lost(material, "an opacity texture other than the alpha of its color texture");
        }
        let alpha = material.opacity * alpha_map.map_or(1.0, |map| map.texel.gain);
        match alpha_map.and_then(|map| map.texel.cutoff) {
            Some(cutoff) => {
                written.insert("alphaMode".to_owned(), "MASK".into());
                written.insert("alphaCutoff".to_owned(), cutoff.into());
            }
            None if alpha < 1.0 || alpha_map.is_some() => {
                written.insert("alphaMode".to_owned(), "BLEND".into());
            }
            None => {}
        }
        let [r, g, b] = made.base_color;
        if made.base_color.iter().any(|c| *c > 1.0) {
            self.lost(material, "a color above 1");
        }
        pbr.insert("baseColorFactor".to_owned(), [r, g, b, alpha].map(|c| c.clamp(0.0, 1.0)).to_vec().into());
        pbr
    }

    fn scalars(&mut self, material: &Material, made: &MetallicRoughness, pbr: &mut Map<String, Value>) {
        pbr.insert("metallicFactor".to_owned(), made.metallic.into());
        pbr.insert("roughnessFactor".to_owned(), made.roughness.into());
        let (metallic, roughness) = (made.metallic_map.as_ref(), made.roughness_map.as_ref());
        let fits = |map: Option<&TextureMap>, channel| {
            let texel = TexelRule { channel: Some(channel), ..TexelRule::default() };
            map.is_none_or(|map| map.texel == texel)
        };
        let same = metallic.zip(roughness).is_none_or(|(m, r)| key(m) == key(r));
        // An image of one of the two would be read as both.
        let is_one = metallic.is_some() == roughness.is_some();
        match metallic {
            Some(map) if same && is_one && fits(metallic, Channel::Blue) && fits(roughness, Channel::Green) => {
                if let Some(info) = self.textures.info(map, self.buffer, self.reports) {
                    pbr.insert("metallicRoughnessTexture".to_owned(), info);
                }
            }
            None if roughness.is_none() => {}
            _ => self.lost(material, "textures of metalness or roughness that are not one picture's blue and green"),
        }
    }

    fn specular(&mut self, material: &Material, made: &MetallicRoughness, extensions: &mut Map<String, Value>) {
        let ior = material.refraction_index;
        let reflectance_of = |ior: f32| ((ior - 1.0) / (ior + 1.0)).powi(2);
        let mut reflectance = MetallicRoughness::DIELECTRIC_SPECULAR;
        if ior != 1.5 && ior >= 1.0 && reflectance_of(ior) >= LEAST_REFLECTANCE {
            reflectance = reflectance_of(ior);
            extensions.insert("KHR_materials_ior".to_owned(), json!({ "ior": ior }));
        } else if ior != 1.5 {
            self.lost(material, &format!("the refraction index {ior}"));
        }
        let mut specular = Map::new();
        if made.metallic < 1.0 {
            let part_of = |i: usize| {
                let metal = made.base_color[i] * made.metallic;
                ((material.specular[i] - metal) / (1.0 - made.metallic)).max(0.0)
            };
            let dielectric = [part_of(0), part_of(1), part_of(2)];
            if dielectric.iter().any(|c| (c - reflectance).abs() > SAME) {
                specular.insert("specularColorFactor".to_owned(), dielectric.map(|c| c / reflectance).to_vec().into());
            }
        }
        if let Some(map) = &material.specular_map {
            if made.metallic == 0.0 && made.metallic_map.is_none() {
                if let Some(info) = self.texture(material, map, "specular texture") {
                    specular.insert("specularColorTexture".to_owned(), info);
                }
            } else if material.diffuse_map.as_ref() != Some(map) {
                // The base colour's own texture is implied.
                self.lost(material, "a specular texture on metal");
            }
        }
        if !specular.is_empty() {
            extensions.insert("KHR_materials_specular".to_owned(), specular.into());
        }
    }

    fn emission(&mut self, material: &Material, written: &mut Map<String, Value>, extensions: &mut Map<String, Value>) {
        let strength = material.emitted.iter().fold(1.0_f32, |a, b| a.max(*b));
        if material.emitted != [0.0; 3] {
            written.insert("emissiveFactor".to_owned(), material.emitted.map(|c| c / strength).to_vec().into());
        }
        if strength > 1.0 {
            let extension = json!({ "emissiveStrength": strength });
            extensions.insert("KHR_materials_emissive_strength".to_owned(), extension);
        }
        if let Some(map) = &material.emitted_map
            && let Some(info) = self.texture(material, map, "emission texture")
        {
            written.insert("emissiveTexture".to_owned(), info);
        }
    }

    fn losses(&mut self, material: &Material) {
        if let AmbientRule::Value(ambient) = material.ambient
            && ambient != material.diffuse
        {
            self.lost(material, "an ambient color of its own");
        }
        if material.specular.iter().any(|c| *c > 1.0) {
            self.lost(material, "a specular color above 1");
        }
        if material.shininess_map.is_some() {
            self.lost(material, "a texture of exponents");
        }
        if material.bump_map.is_some() && material.normal_map.is_none() {
            self.lost(material, "a texture of heights");
        }
    }
}

/// An image: its index in the model, or its path.
pub(super) type PictureKey = (Option<usize>, String);

/// The written textures, samplers and images.
pub(super) struct TextureLists {
    pub textures: Vec<Value>,
    pub samplers: Vec<Value>,
    pub images: Vec<Value>,
}

/// Writes each image, texture and sampler once.
pub(super) struct TextureWriter<'m, 'i> {
    embedded: &'m [EmbeddedImage],
    ask: &'i mut dyn FnMut(&TextureMap) -> Option<Vec<u8>>,
    written: TextureLists,
    known_images: HashMap<PictureKey, Option<usize>>,
    known_samplers: HashMap<[Wrap; 2], usize>,
    known_textures: HashMap<(usize, usize), usize>,
}

impl<'m, 'i> TextureWriter<'m, 'i> {
    pub fn new(embedded: &'m [EmbeddedImage], ask: &'i mut dyn FnMut(&TextureMap) -> Option<Vec<u8>>) -> Self {
        TextureWriter {
            embedded,
            ask,
            written: TextureLists { textures: Vec::new(), samplers: Vec::new(), images: Vec::new() },
            known_images: HashMap::new(),
            known_samplers: HashMap::new(),
            known_textures: HashMap::new(),
        }
    }

    pub fn finish(&mut self) -> TextureLists {
        let TextureLists { textures, samplers, images } = &mut self.written;
        let take = std::mem::take::<Vec<Value>>;
        TextureLists { textures: take(textures), samplers: take(samplers), images: take(images) }
    }

    /// Returns a textureInfo; `None` if its image is not available.
    pub fn info(&mut self, map: &TextureMap, buffer: &mut Buffer, reports: &mut Reports) -> Option<Value> {
        let image = self.image(map, buffer, reports)?;
        let samplers = &mut self.written.samplers;
        let sampler = *self.known_samplers.entry(map.wrap).or_insert_with(|| {
            let [s, t] = map.wrap.map(|wrap| match wrap {
                Wrap::Repeat => 10497,
                Wrap::Clamp => 33071,
                Wrap::Mirror => 33648,
            });
            // Linear, and linear between mipmaps.
            samplers.push(json!({ "wrapS": s, "wrapT": t, "magFilter": 9729, "minFilter": 9987 }));
            samplers.len() - 1
        });
        let textures = &mut self.written.textures;
        let texture = *self.known_textures.entry((image, sampler)).or_insert_with(|| {
            textures.push(json!({ "source": image, "sampler": sampler }));
            textures.len() - 1
        });
        let mut info = json!({ "index": texture });
        if map.on_second_set {
            info["texCoord"] = 1.into();
        }
        if let Some(transform) = transform(map) {
            info["extensions"] = json!({ "KHR_texture_transform": transform });
        }
        Some(info)
    }

    fn image(&mut self, map: &TextureMap, buffer: &mut Buffer, reports: &mut Reports) -> Option<usize> {
        let key = key(map);
        if let Some(known) = self.known_images.get(&key) {
            return *known;
        }
        let inside = map.embedded.and_then(|index| self.embedded.get(index));
        let requested = if inside.is_none() { (self.ask)(map) } else { None };
        let bytes = inside.map(|image| image.bytes.as_slice()).or(requested.as_deref());
        let kind = bytes.and_then(mime_type);
        let image = bytes.zip(kind).map(|(bytes, kind)| {
            let view = buffer.file(bytes);
            self.written.images.push(json!({ "name": map.path, "mimeType": kind, "bufferView": view }));
            self.written.images.len() - 1
        });
        if image.is_none() {
            let reason = if bytes.is_some() { "is neither PNG nor JPEG" } else { "was not found" };
            let message = || format!("the texture {:?} {reason}: it is not written", map.path);
            reports.add_without_line("textures that are not written", Severity::Warning, message);
        }
        self.known_images.insert(key, image);
        image
    }
}

pub(super) fn key(map: &TextureMap) -> PictureKey {
    (map.embedded, if map.embedded.is_some() { String::new() } else { map.path.clone() })
}

fn mime_type(bytes: &[u8]) -> Option<&'static str> {
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some("image/png")
    } else if bytes.starts_with(b"\xFF\xD8\xFF") {
        Some("image/jpeg")
    } else {
        None
    }
}

/// Returns `KHR_texture_transform`: the reader's formula solved for its offset.
fn transform(map: &TextureMap) -> Option<Value> {
    if map.scale == [1.0; 2] && map.rotation == 0.0 && map.offset == [0.0; 2] {
        return None;
    }
    let (sin, cos) = f64::from(map.rotation).sin_cos();
    let [u, v] = map.offset.map(f64::from);
    let scale_v = f64::from(map.scale[1]);
    let offset = [u - scale_v * sin, 1.0 - v - scale_v * cos];
    Some(json!({ "offset": offset, "rotation": map.rotation, "scale": map.scale }))
}
