//! Effects: `profile_COMMON` as terms of the light equation.

use super::document::{Document, name_of};
use super::image::{Images, Parameters, texture};
use super::xml::Element;
use crate::text::quote;
use crate::{AmbientRule, Channel, Material, PropertySource, ReadError, Severity, TexelRule, TextureMap};

/// `k_d` of an effect without one: that of a new material in Blender.
const DIFFUSE: f32 = 0.8;
/// The exponent of an effect without one: the default of the lab.
const SHININESS: f32 = 32.0;
/// Factor for a shininess between 0 and 1.
const SHININESS_OF_ONE: f32 = 128.0;
/// The refraction index of an effect without one: glass, plastics.
const REFRACTION_INDEX: f32 = 1.5;

/// A material, and the name of its textures' set of texture coordinates.
pub(super) struct EffectMaterial {
    pub(super) material: Material,
    pub(super) tex_coord: Option<String>,
}

/// Reads a `material` element.
pub(super) fn material<'t>(
    document: &Document<'t>,
    images: &mut Images,
    element: Element<'t>,
) -> Result<EffectMaterial, ReadError> {
    let name = name_of(element);
    let instance = element.child("instance_effect");
    let effect = instance.and_then(|instance| document.target(instance, "url", &["effect"]));
    if let Some(parameter) = instance.and_then(|instance| instance.child("setparam")) {
        document.add("unsupported parameters", Severity::Warning, parameter.at(), || {
            format!("setparam of the material {} is not supported: ignored", quote(name.as_bytes()))
        });
    }
    let profile = effect.and_then(|effect| effect.child("profile_COMMON"));
    let technique = profile.and_then(|profile| profile.child("technique"));
    let shader = technique.and_then(|t| t.children().find(|child| SHADERS.contains(&child.name())));
    let (Some(effect), Some(profile), Some(technique), Some(shader)) = (effect, profile, technique, shader) else {
        document.add("materials without an effect", Severity::Warning, effect.unwrap_or(element).at(), || {
            let name = quote(name.as_bytes());
            format!("the material {name} has no readable profile_COMMON effect: using the default material")
        });
        return Ok(EffectMaterial { material: Material { name, ..Material::default() }, tex_coord: None });
    };
    let parameters = Parameters::from_scopes(&[Some(technique), Some(profile), Some(effect)]);
    let mut reader = Reader {
        document,
        images,
        parameters,
        name: quote(name.as_bytes()),
        sources: Vec::new(),
        unused: Vec::new(),
        tex_coords: Vec::new(),
    };
    let mut material = reader.shader(shader)?;
    for scope in [technique, profile, effect, shader] {
        reader.bump(scope, &mut material)?;
    }
    material.name = name;
    material.sources = std::mem::take(&mut reader.sources);
    material.sort_sources();
    material.unused = std::mem::take(&mut reader.unused);
    let tex_coord = reader.one_tex_coord();
    Ok(EffectMaterial { material, tex_coord })
}

const SHADERS: [&str; 4] = ["phong", "blinn", "lambert", "constant"];

struct Reader<'a, 't> {
    document: &'a Document<'t>,
    images: &'a mut Images,
    parameters: Parameters<'t>,
    /// The material's name, in quotes.
    name: String,
    sources: Vec<PropertySource>,
    unused: Vec<PropertySource>,
    /// The names of the sets of texture coordinates that textures use, with the byte of each.
    tex_coords: Vec<(String, usize)>,
}

/// A colour or a texture of an effect.
struct Value {
    color: Option<[f32; 4]>,
    map: Option<TextureMap>,
    line: u64,
    at: usize,
    written: String,
}

impl<'t> Reader<'_, 't> {
    fn shader(&mut self, shader: Element<'t>) -> Result<Material, ReadError> {
        let mut material = Material::default();
        // The diffuse colour first: its texture decides on the set of texture coordinates.
        let diffuse = self.color(shader, "diffuse")?;
        let emission = self.color(shader, "emission")?;
        let ambient = self.color(shader, "ambient")?;
        let specular = self.color(shader, "specular")?;
        self.ambient(&mut material, ambient, diffuse.as_ref());
        let absent = if shader.name() == "constant" { 0.0 } else { DIFFUSE };
        (material.diffuse, material.diffuse_map) = self.term("diffuse", "diffuse_map", diffuse, absent);
        (material.specular, material.specular_map) = self.term("specular", "specular_map", specular, 0.0);
        (material.emitted, material.emitted_map) = self.term("emitted", "emitted_map", emission, 0.0);
        self.shininess(shader, &mut material)?;
        material.refraction_index = REFRACTION_INDEX;
        if let Some((value, line, at)) = self.float(shader, "index_of_refraction")? {
            if value > 0.0 {
                material.refraction_index = value;
                self.source("refraction_index", line, format!("<index_of_refraction> {value}"), "");
            } else {
                let name = &self.name;
                self.document
                    .note(at, format!("the index_of_refraction of {name} is {value}: using {REFRACTION_INDEX}"));
            }
        }
        self.opacity(shader, &mut material)?;
        self.reflection(shader)?;
        Ok(material)
    }

    fn source(&mut self, property: &'static str, line: u64, written: String, rule: &str) {
        self.sources.push(PropertySource { property, line: Some(line), written, rule: rule.to_owned() });
    }

    fn color(&mut self, shader: Element<'t>, name: &'static str) -> Result<Option<Value>, ReadError> {
        let Some(element) = shader.child(name) else { return Ok(None) };
        let Some(content) = element.children().find(|child| matches!(child.name(), "color" | "texture" | "param"))
        else {
            return Ok(None);
        };
        let mut value = Value {
            color: None,
            map: None,
            line: self.document.line(content),
            at: content.at(),
            written: String::new(),
        };
        match content.name() {
            "texture" => {
                value.map = texture(self.document, self.images, &self.parameters, content)?;
                let Some(map) = &value.map else { return Ok(None) };
                let sampler = content.attribute("texture").unwrap_or_default();
                value.written =
                    format!("<{name}> texture {} = {}", quote(sampler.as_bytes()), quote(map.path.as_bytes()));
                if let Some(coords) = content.attribute("texcoord").filter(|coords| !coords.is_empty()) {
                    self.tex_coords.push((coords.into_owned(), content.at()));
                }
            }
            "color" => value.color = Some(self.color_of(content)?),
            _ => {
                let sid = content.attribute("ref").unwrap_or_default();
                let parameter = self.parameters.get(&sid);
                let numbers = parameter.and_then(|p| p.children().find(|c| matches!(c.name(), "float4" | "float3")));
                let Some(numbers) = numbers else {
                    let message = format!(
                        "{name} of {} refers to {}, which is not a color: it is ignored",
                        self.name,
                        quote(sid.as_bytes())
                    );
                    self.document.warn(content.at(), message);
                    return Ok(None);
                };
                value.color = Some(self.color_of(numbers)?);
            }
        }
        if let Some([r, g, b, a]) = value.color {
            value.written = format!("<{name}> {r} {g} {b} {a}");
        }
        Ok(Some(value))
    }

    /// Reads three or four numbers; negative ones become 0.
    fn color_of(&self, element: Element<'_>) -> Result<[f32; 4], ReadError> {
        let numbers = self.document.finite(element)?;
        if numbers.len() < 3 {
            let message = format!("<{}> holds {} numbers instead of 4", element.name(), numbers.len());
            return Err(self.document.error(element.at(), message));
        }
        let mut color = [0.0, 0.0, 0.0, 1.0];
        color.iter_mut().zip(&numbers).for_each(|(value, number)| *value = (*number as f32).clamp(0.0, f32::MAX));
        Ok(color)
    }

    /// Returns a colour and a texture. Where there is a texture, the colour is 1.
    fn term(
        &mut self,
        property: &'static str,
        map_property: &'static str,
        value: Option<Value>,
        absent: f32,
    ) -> ([f32; 3], Option<TextureMap>) {
        let Some(value) = value else { return ([absent; 3], None) };
        match (value.color, value.map) {
            (Some([r, g, b, _]), _) => {
                self.source(property, value.line, value.written, "");
                ([r, g, b], None)
            }
            (None, map) => {
                self.source(map_property, value.line, value.written, "");
                ([1.0; 3], map)
            }
        }
    }

    /// A texture of the ambient colour means that it follows the diffuse colour: ambient light has no texture of its
    /// own.
    fn ambient(&mut self, material: &mut Material, ambient: Option<Value>, diffuse: Option<&Value>) {
        let Some(value) = ambient else { return };
        if let Some([r, g, b, _]) = value.color {
            material.ambient = AmbientRule::Value([r, g, b]);
            self.source("ambient", value.line, value.written, "");
            return;
        }
        let path = |value: &Value| value.map.as_ref().map(|map| map.path.clone());
        if diffuse.and_then(path) != path(&value) {
            let message = format!(
                "the ambient texture of {} is not used: the ambient color follows the diffuse color",
                self.name
            );
            self.document.note(value.at, message);
        }
        self.source("ambient", value.line, value.written, "a texture: follows the diffuse color");
    }

    /// Returns a number, its line and its byte.
    fn float(&self, shader: Element<'t>, name: &str) -> Result<Option<(f32, u64, usize)>, ReadError> {
        let Some(element) = shader.child(name) else { return Ok(None) };
        let number = element.child("float").or_else(|| {
            let sid = element.child("param")?.attribute("ref")?;
            self.parameters.get(&sid)?.child("float")
        });
        let Some(number) = number else { return Ok(None) };
        Ok(Some((self.document.number(number)? as f32, self.document.line(number), number.at())))
    }

    fn shininess(&mut self, shader: Element<'t>, material: &mut Material) -> Result<(), ReadError> {
        material.shininess = SHININESS;
        let Some((value, line, at)) = self.float(shader, "shininess")? else { return Ok(()) };
        let has_highlight = material.specular != [0.0; 3];
        let written = format!("<shininess> {value}");
        if value <= 0.0 || value > 1.0 {
            material.shininess = value.clamp(1.0, f32::MAX);
            let rule = if value < 1.0 { "raised to the minimum of 1" } else { "" };
            self.source("shininess", line, written, rule);
            return Ok(());
        }
        material.shininess = (value * SHININESS_OF_ONE).max(1.0);
        let rule = format!("between 0 and 1: multiplied by {SHININESS_OF_ONE}");
        self.source("shininess", line, written, &rule);
        if has_highlight {
            let message =
                format!("the shininess of {} is {value}, {rule} (some programs write it as a fraction)", self.name);
            self.document.note(at, message);
        }
        Ok(())
    }

    /// Computes the opacity from `transparent` and `transparency` (COLLADA 1.5, "Determining Transparency"): A_ONE: a
    /// t; A_ZERO: 1 - a t; RGB_ONE: l t; RGB_ZERO: 1 - l t; with a the colour's opacity and l its luminance.
    fn opacity(&mut self, shader: Element<'t>, material: &mut Material) -> Result<(), ReadError> {
        let transparent = self.color(shader, "transparent")?;
        let transparency = self.float(shader, "transparency")?;
        let mode = shader.child("transparent").and_then(|e| e.attribute("opaque"));
        let mode = mode.as_deref().unwrap_or("A_ONE").to_owned();
        let (is_alpha, is_opaque_at_one) = match mode.as_str() {
            "A_ONE" => (true, true),
            "A_ZERO" => (true, false),
            "RGB_ONE" => (false, true),
            "RGB_ZERO" => (false, false),
            other => {
                let at = shader.child("transparent").unwrap_or(shader).at();
                let message = format!("opaque of {} is {}: using A_ONE", self.name, quote(other.as_bytes()));
                self.document.warn(at, message);
                (true, true)
            }
        };
        if transparent.is_none() && transparency.is_none() {
            return Ok(());
        }
        let factor = transparency.map_or(1.0, |(value, ..)| value);
        let written_factor = transparency.map_or(String::new(), |(value, ..)| format!("<transparency> {value}"));
        let line = transparent.as_ref().map(|v| v.line).or(transparency.map(|(_, line, _)| line)).unwrap_or(0);
        let at = transparent.as_ref().map(|v| v.at).or(transparency.map(|(.., at)| at)).unwrap_or(0);
        let written_color = transparent.as_ref().map_or(String::new(), |v| v.written.clone());
        let written =
            [written_color, written_factor].iter().filter(|w| !w.is_empty()).cloned().collect::<Vec<_>>().join(", ");
        if let Some(mut map) = transparent.as_ref().and_then(|value| value.map.clone()) {
            let channel = Some(if is_alpha { Channel::Alpha } else { Channel::Luminance });
            let (base, gain) = if is_opaque_at_one { (0.0, factor) } else { (1.0, -factor) };
            map.texel = TexelRule { channel, base, gain, cutoff: None };
            material.opacity_map = Some(map);
            self.source("opacity_map", line, written, &mode);
            return Ok(());
        }
        let [r, g, b, a] = transparent.and_then(|value| value.color).unwrap_or([1.0; 4]);
        // ISO/CIE 10526:1991, as in the specification.
        let amount = factor * if is_alpha { a } else { 0.212671 * r + 0.715160 * g + 0.072169 * b };
        let opacity = if is_opaque_at_one { amount } else { 1.0 - amount }.clamp(0.0, 1.0);
        // The three weights add up to 1 except for rounding.
        let opacity = if opacity > 1.0 - 1e-6 { 1.0 } else { opacity };
        if opacity <= 1e-6 {
            let name = &self.name;
            let message = format!(
                "the material {name} would be invisible ({written}, {mode}): treated as opaque, because programs \
                 confuse the two"
            );
            self.document.warn(at, message);
            self.source("opacity", line, written, "would be invisible: treated as opaque");
            return Ok(());
        }
        material.opacity = opacity;
        self.source("opacity", line, written, &mode);
        Ok(())
    }

    /// Mirror reflections, for which the light equation has no term.
    fn reflection(&mut self, shader: Element<'t>) -> Result<(), ReadError> {
        if let Some(value) = self.color(shader, "reflective")? {
            self.unused.push(PropertySource {
                property: "reflective",
                line: Some(value.line),
                written: value.written,
                rule: String::new(),
            });
        }
        if let Some((value, line, _)) = self.float(shader, "reflectivity")? {
            let written = format!("<reflectivity> {value}");
            self.unused.push(PropertySource {
                property: "reflectivity",
                line: Some(line),
                written,
                rule: String::new(),
            });
        }
        Ok(())
    }

    /// Reads `bump` in an `extra`, as FCollada and OpenCOLLADA write it.
    fn bump(&mut self, scope: Element<'t>, material: &mut Material) -> Result<(), ReadError> {
        for bump in scope.all("extra").flat_map(|e| e.all("technique")).flat_map(|t| t.all("bump")) {
            let Some(element) = bump.child("texture") else { continue };
            if material.bump_map.is_some() || material.normal_map.is_some() {
                self.document
                    .warn(bump.at(), format!("the material {} has a second bump texture: it is ignored", self.name));
                continue;
            }
            let Some(map) = texture(self.document, self.images, &self.parameters, element)? else { continue };
            let line = self.document.line(element);
            let kind = bump.attribute("bumptype").unwrap_or_default();
            let written = format!("<bump> texture {}", quote(map.path.as_bytes()));
            if kind.eq_ignore_ascii_case("NORMALMAP") {
                material.normal_map = Some(map);
                self.source("normal_map", line, written, "");
            } else {
                material.bump_map = Some(map);
                self.source("bump_map", line, written, "");
            }
            if let Some(coords) = element.attribute("texcoord").filter(|coords| !coords.is_empty()) {
                self.tex_coords.push((coords.into_owned(), element.at()));
            }
        }
        Ok(())
    }

    /// Returns the name of the model's only set of texture coordinates: that of the first texture.
    fn one_tex_coord(&self) -> Option<String> {
        let (first, _) = self.tex_coords.first()?;
        if let Some((other, at)) = self.tex_coords.iter().find(|(name, _)| name != first) {
            self.document.add("textures with other texture coordinates", Severity::Warning, *at, || {
                let [first, other] = [first, other].map(|name| quote(name.as_bytes()));
                format!(
                    "textures of {} use the texture coordinates {first} and {other}: using {first} for all",
                    self.name
                )
            });
        }
        Some(first.clone())
    }
}
