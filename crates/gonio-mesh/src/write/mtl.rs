//! Writes materials as MTL, with its physically based extension.

use super::text::{Text, plain_name};
use super::{ImageFile, texture_path};
use crate::text::quote;
use crate::{AmbientRule, Channel, Diagnostic, Material, TexelRule, TextureMap, Wrap};

/// The keyword of a map, and whether it is a colour or data.
struct Purpose {
    keyword: &'static str,
    is_color: bool,
    is_bump: bool,
}

const fn color(keyword: &'static str) -> Purpose {
    Purpose { keyword, is_color: true, is_bump: false }
}

const fn scalar(keyword: &'static str) -> Purpose {
    Purpose { keyword, is_color: false, is_bump: false }
}

const fn bump(keyword: &'static str) -> Purpose {
    Purpose { keyword, is_color: false, is_bump: true }
}

/// Statements without a term in the light equation: written as they were read.
const UNUSED: [&str; 9] = ["Tf", "Kt", "Km", "Ps", "Pc", "Pcr", "aniso", "anisor", "sharpness"];

/// Statements written in another form, and those implied by OBJ.
const SAID_OTHERWISE: [&str; 5] = ["Ks", "map_Ks", "Ns", "map_Ns", "double_sided"];

/// Writes one material with a name.
pub(super) fn write(
    material: &Material,
    name: &str,
    images: &[ImageFile],
    text: &mut Text,
    diagnostics: &mut Vec<Diagnostic>,
) {
    text.named("\nnewmtl", name);
    let mut writer = Writer { name, images, text, diagnostics };
    writer.numbers(material);
    writer.maps(material);
    writer.unused(material);
}

struct Writer<'a> {
    name: &'a str,
    images: &'a [ImageFile],
    text: &'a mut Text,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Writer<'_> {
    fn numbers(&mut self, material: &Material) {
        let text = &mut *self.text;
        text.statement("Ns", &[material.shininess]);
        match material.ambient {
            // As Blender writes it.
            AmbientRule::FollowsDiffuse => text.statement("Ka", &[1.0; 3]),
            AmbientRule::Value(value) => text.statement("Ka", &value),
        }
        let base_color = material.metallic_roughness.as_ref().map(|physical| physical.base_color);
        text.statement("Kd", &base_color.unwrap_or(material.diffuse));
        text.statement("Ks", &material.specular);
        text.statement("Ke", &material.emitted);
        text.statement("Ni", &[material.refraction_index]);
        text.statement("d", &[material.opacity]);
        if let Some(model) = material.illumination_model {
            text.named("illum", &model.to_string());
        }
        if let Some(physical) = &material.metallic_roughness {
            text.statement("Pr", &[physical.roughness]);
            text.statement("Pm", &[physical.metallic]);
        }
        if material.ambient == AmbientRule::Value([1.0; 3]) {
            self.note("has Ka 1 1 1, which readers take for \"follows Kd\", because Blender always writes it");
        }
    }

    fn maps(&mut self, material: &Material) {
        let physical = material.metallic_roughness.as_ref();
        let is_black = |color: [f32; 3]| color == [0.0; 3];
        let diffuse = physical.map_or(material.diffuse, |physical| physical.base_color);
        self.factored_map(&material.diffuse_map, &color("map_Kd"), is_black(diffuse));
        self.factored_map(&material.specular_map, &color("map_Ks"), is_black(material.specular));
        self.factored_map(&material.emitted_map, &color("map_Ke"), is_black(material.emitted));
        self.factored_map(&material.shininess_map, &scalar("map_Ns"), false);
        self.factored_map(&material.opacity_map, &scalar("map_d"), material.opacity == 0.0);
        self.factored_map(&material.normal_map, &bump("norm"), false);
        self.factored_map(&material.bump_map, &bump("map_Bump"), false);
        if let Some(physical) = physical {
            self.factored_map(&physical.roughness_map, &scalar("map_Pr"), physical.roughness == 0.0);
            self.factored_map(&physical.metallic_map, &scalar("map_Pm"), physical.metallic == 0.0);
        }
    }

    /// Writes a map. One with a factor of 0 is left out: readers ignore a black `Kd` with a `map_Kd` and show the map.
    fn factored_map(&mut self, map: &Option<TextureMap>, purpose: &Purpose, is_zero: bool) {
        let Some(map) = map else { return };
        let path = texture_path(map, self.images);
        if is_zero {
            let path = quote(path.as_bytes());
            self.note(&format!("has a {} of {path} that is multiplied by 0: it is left out", purpose.keyword));
            return;
        }
        self.text.push(purpose.keyword);
        self.options(map, purpose);
        let plain = plain_name(path);
        // A name that begins with `-` would be an option.
        self.text.push(if plain.starts_with('-') { " ./" } else { " " });
        self.text.push(&plain);
        self.text.byte(b'\n');
        if plain != path {
            self.warn(&format!("names the texture {}, which MTL cannot: change its name", quote(path.as_bytes())));
        }
    }

    fn options(&mut self, map: &TextureMap, purpose: &Purpose) {
        let text = &mut *self.text;
        let [u, v] = map.scale;
        if map.scale != [1.0; 2] {
            text.push(" -s");
            text.numbers(&[u, v, 1.0]);
        }
        let [u, v] = map.offset;
        if map.offset != [0.0; 2] {
            text.push(" -o");
            text.numbers(&[u, v, 0.0]);
        }
        let TexelRule { channel, base, gain, cutoff } = map.texel;
        if (base, gain) != (0.0, 1.0) {
            text.push(" -mm");
            text.numbers(&[base, gain]);
        }
        if let Some(channel) = channel.filter(|_| !purpose.is_color) {
            text.push(match channel {
                Channel::Red => " -imfchan r",
                Channel::Green => " -imfchan g",
                Channel::Blue => " -imfchan b",
                Channel::Alpha => " -imfchan m",
                Channel::Luminance => " -imfchan l",
            });
        }
        if map.wrap == [Wrap::Clamp; 2] {
            text.push(" -clamp on");
        }
        if purpose.is_bump && map.bump_multiplier != 1.0 {
            text.push(" -bm");
            text.numbers(&[map.bump_multiplier]);
        }
        let lost = [
            (map.rotation != 0.0, "a rotation"),
            (cutoff.is_some(), "a cutoff"),
            (channel.is_some() && purpose.is_color, "a channel of colors"),
            (!matches!(map.wrap, [Wrap::Clamp, Wrap::Clamp] | [Wrap::Repeat, Wrap::Repeat]), "a way to wrap around"),
        ];
        for (_, what) in lost.into_iter().filter(|(is_lost, _)| *is_lost) {
            self.warn(&format!("has {what} of its {}, which MTL cannot hold: it is lost", purpose.keyword));
        }
    }

    fn unused(&mut self, material: &Material) {
        let mut lost: Vec<&str> = Vec::new();
        for source in &material.unused {
            let mut words = source.written.split_ascii_whitespace();
            let is_known = words.next().is_some_and(|word| UNUSED.contains(&word));
            if is_known && words.all(|word| word.parse::<f32>().is_ok_and(f32::is_finite)) {
                self.text.push(&source.written);
                self.text.byte(b'\n');
            } else if !SAID_OTHERWISE.contains(&source.property) {
                lost.push(source.property);
            }
        }
        if !lost.is_empty() {
            self.note(&format!(
                "has properties without a term in the light equation, which are not written: {}",
                lost.join(", ")
            ));
        }
    }

    fn note(&mut self, what: &str) {
        self.diagnostics.push(Diagnostic::note(format!("the material {} {what}", quote(self.name.as_bytes()))));
    }

    fn warn(&mut self, what: &str) {
        self.diagnostics.push(Diagnostic::warning(format!("the material {} {what}", quote(self.name.as_bytes()))));
    }
}
