//! Resolves textures to images.

use super::document::{Document, percent_decode};
use super::xml::Element;
use crate::text::quote;
use crate::{EmbeddedImage, ReadError, Severity, TextureMap, Wrap};
use std::collections::HashMap;

/// The images looked up so far, and those inside the file.
#[derive(Default)]
pub(super) struct Images {
    pub(super) embedded: Vec<EmbeddedImage>,
    embedded_of: HashMap<u32, usize>,
}

/// The `newparam`s of an effect: those of its profile first, then its own.
pub(super) struct Parameters<'t> {
    by_sid: HashMap<String, Element<'t>>,
}

impl<'t> Parameters<'t> {
    pub(super) fn from_scopes(scopes: &[Option<Element<'t>>]) -> Self {
        let mut by_sid = HashMap::new();
        for parameter in scopes.iter().flatten().flat_map(|scope| scope.all("newparam")) {
            if let Some(sid) = parameter.attribute("sid") {
                by_sid.entry(sid.into_owned()).or_insert(parameter);
            }
        }
        Parameters { by_sid }
    }

    pub(super) fn get(&self, sid: &str) -> Option<Element<'t>> {
        self.by_sid.get(sid).copied()
    }
}

/// Resolves a `texture` element to a map and the name of its texture coordinates.
pub(super) fn texture<'t>(
    document: &Document<'t>,
    images: &mut Images,
    parameters: &Parameters<'t>,
    element: Element<'t>,
) -> Result<Option<TextureMap>, ReadError> {
    let Some(name) = element.attribute("texture") else {
        document.warn(element.at(), "this <texture> names no sampler: it is ignored");
        return Ok(None);
    };
    let sampler = parameters.get(&name).and_then(|p| p.child("sampler2D").or_else(|| p.child("samplerCUBE")));
    // Some programs refer to the image itself.
    let image = match sampler {
        Some(sampler) => image_of(document, parameters, sampler),
        None => document.by_id(&["image"], &name),
    };
    let Some(image) = image else {
        document.add("textures without an image", Severity::Warning, element.at(), || {
            let missing = if sampler.is_some() {
                "whose sampler has no image"
            } else {
                "which is neither a sampler nor an image"
            };
            format!("this texture refers to {}, {missing}: it is ignored", quote(name.as_bytes()))
        });
        return Ok(None);
    };
    let Some(mut map) = picture(document, images, image)? else { return Ok(None) };
    map.line = Some(document.line(element));
    if let Some(sampler) = sampler {
        map.wrap = ["wrap_s", "wrap_t"].map(|axis| wrap(document, sampler.child(axis)));
    }
    placement(document, element, &mut map)?;
    Ok(Some(map))
}

/// In COLLADA 1.4 the sampler refers to a surface, which refers to an image; in 1.5 it refers to the image.
fn image_of<'t>(document: &Document<'t>, parameters: &Parameters<'t>, sampler: Element<'t>) -> Option<Element<'t>> {
    if let Some(instance) = sampler.child("instance_image") {
        return document.target(instance, "url", &["image"]);
    }
    let source = sampler.child("source")?.text();
    let Some(surface) = parameters.get(&source).and_then(|p| p.child("surface")) else {
        return document.by_id(&["image"], &source);
    };
    let init = surface.child("init_from")?;
    document.by_id(&["image"], &init.text()).or_else(|| document.by_id(&["image"], init.text().trim_start_matches('#')))
}

fn wrap(document: &Document<'_>, element: Option<Element<'_>>) -> Wrap {
    let Some(element) = element else { return Wrap::Repeat };
    match element.text().as_ref() {
        "WRAP" => Wrap::Repeat,
        "MIRROR" => Wrap::Mirror,
        "CLAMP" => Wrap::Clamp,
        other => {
            document.add("unusual wrap modes", Severity::Note, element.at(), || {
                format!("<{}> is {}: using CLAMP", element.name(), quote(other.as_bytes()))
            });
            Wrap::Clamp
        }
    }
}

/// Reads an `image` element: a file, or bytes in the document.
fn picture(document: &Document<'_>, images: &mut Images, image: Element<'_>) -> Result<Option<TextureMap>, ReadError> {
    let init = image.child("init_from");
    let name = super::document::name_of(image);
    if let Some(bytes) = image.child("data").or_else(|| init?.child("hex")) {
        let index = match images.embedded_of.get(&image.index) {
            Some(&known) => known,
            None => {
                let Some(bytes) = hexadecimal(document, bytes) else { return Ok(None) };
                images.embedded.push(EmbeddedImage { name: name.clone(), bytes });
                images.embedded_of.insert(image.index, images.embedded.len() - 1);
                images.embedded.len() - 1
            }
        };
        return Ok(Some(TextureMap { embedded: Some(index), ..TextureMap::new(name) }));
    }
    let address = init.and_then(|init| init.child("ref").or(Some(init))).map(|element| element.text());
    match address.as_deref() {
        Some(address) if !address.is_empty() => Ok(Some(TextureMap::new(path_of(address)))),
        _ => {
            document.add("images without a file", Severity::Warning, image.at(), || {
                format!("the image {} names no file", quote(name.as_bytes()))
            });
            Ok(None)
        }
    }
}

fn hexadecimal(document: &Document<'_>, element: Element<'_>) -> Option<Vec<u8>> {
    let digits: Vec<u8> = element.words().flat_map(|(_, word)| word.bytes()).collect();
    let value = |digit: u8| (digit as char).to_digit(16).map(|value| value as u8);
    let bytes: Option<Vec<u8>> =
        digits.chunks(2).map(|pair| Some(value(*pair.first()?)? << 4 | value(*pair.get(1)?)?)).collect();
    if bytes.is_none() {
        document.warn(element.at(), "the data of this image is not hexadecimal: it is ignored");
    }
    bytes
}

/// Converts an address (RFC 3986, RFC 8089), or a path in its place, to a path.
pub(super) fn path_of(address: &str) -> String {
    let decoded = percent_decode(address.trim());
    let Some(rest) = decoded.get(..5).filter(|start| start.eq_ignore_ascii_case("file:")).map(|_| &decoded[5..]) else {
        return decoded;
    };
    // file:///C:/a.png and file:///home/a.png; file://server/a.png; file:a.png.
    let path = match rest.strip_prefix("//") {
        Some(rest) => match rest.strip_prefix("localhost/") {
            Some(path) => format!("/{path}"),
            None if rest.starts_with(['/', '\\', '.']) || is_drive(rest) => rest.to_owned(),
            None => format!("//{rest}"),
        },
        None => rest.to_owned(),
    };
    match path.strip_prefix(['/', '\\']) {
        Some(windows) if is_drive(windows) => windows.to_owned(),
        _ => path,
    }
}

/// `C:/`, or `C|/` in old addresses.
fn is_drive(path: &str) -> bool {
    matches!(path.as_bytes(), [letter, b':' | b'|', b'/' | b'\\', ..] if letter.is_ascii_alphabetic())
}

/// Reads the placement that Maya and 3ds Max write in an `extra` of a texture: repetition, offset and mirroring.
fn placement(document: &Document<'_>, texture: Element<'_>, map: &mut TextureMap) -> Result<(), ReadError> {
    for technique in texture.all("extra").flat_map(|extra| extra.all("technique")) {
        let number = |name: &str| technique.child(name).map(|element| document.number(element)).transpose();
        for (axis, [repeat, offset, wrap, mirror]) in
            [["repeatU", "offsetU", "wrapU", "mirrorU"], ["repeatV", "offsetV", "wrapV", "mirrorV"]].iter().enumerate()
        {
            if let Some(value) = number(repeat)? {
                map.scale[axis] = value as f32;
            }
            if let Some(value) = number(offset)? {
                map.offset[axis] = value as f32;
            }
            let is_on = |name: &str| technique.child(name).map(|e| matches!(e.text().as_ref(), "1" | "true" | "TRUE"));
            match (is_on(mirror), is_on(wrap)) {
                (Some(true), _) => map.wrap[axis] = Wrap::Mirror,
                (_, Some(false)) => map.wrap[axis] = Wrap::Clamp,
                _ => {}
            }
        }
        if let Some(element) = technique.child("rotateUV")
            && number("rotateUV")? != Some(0.0)
        {
            document.add("rotated textures", Severity::Warning, element.at(), || {
                "rotateUV is not supported: this texture is not rotated".to_owned()
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::path_of;

    #[test]
    fn addresses_become_paths() {
        let cases = [
            ("wood.png", "wood.png"),
            ("./a%20b/wood%2Epng", "./a b/wood.png"),
            ("file:///home/me/wood.png", "/home/me/wood.png"),
            ("file:///C:/My%20Files/wood.png", "C:/My Files/wood.png"),
            ("file://C:/wood.png", "C:/wood.png"),
            ("FILE:/C:\\wood.png", "C:\\wood.png"),
            ("file://localhost/wood.png", "/wood.png"),
            ("file://server/share/wood.png", "//server/share/wood.png"),
            ("C:\\textures\\wood.png", "C:\\textures\\wood.png"),
            ("100%.png", "100%.png"),
            ("caf%C3%A9.png", "caf\u{e9}.png"),
            ("caf%E9.png", "caf%E9.png"),
            ("file:wood.png", "wood.png"),
        ];
        for (address, path) in cases {
            assert_eq!(path_of(address), path, "{address}");
        }
    }
}
