//! A scene in the address of a page: `#scene=` and the scene file, deflated, in base64url (RFC 4648, section 5); or a station
//! beyond the rendering equation: `#station=NAME:PARAMETER=VALUE,...`.

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use gonio_language::tr;
use gonio_scene::environment_file;
use gonio_scene::files::BUILTIN;
use gonio_scene::{SceneFile, SceneSettings};
use std::io::{Read, Write};

/// Prefix of the address fragment.
pub const KEY: &str = "scene=";
/// Most bytes of a scene file that are taken from an address.
const MOST_BYTES: u64 = 1 << 20;

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// Prefix of an address fragment with a station.
const STATION_KEY: &str = "station=";

/// A station beyond the rendering equation in an address.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StationLink {
    /// The name of the station.
    pub name: String,
    /// Parameters with their values as text; the others have their defaults.
    pub values: Vec<(String, String)>,
}

impl StationLink {
    /// The station in the part of an address after `#`; `None` if it contains none. Nothing is known yet about names and values.
    pub fn parse(fragment: &str) -> Option<StationLink> {
        let text = fragment.trim_start_matches('#').strip_prefix(STATION_KEY)?;
        let (name, values) = text.split_once(':').unwrap_or((text, ""));
        let pairs = values.split(',').filter_map(|pair| pair.split_once('='));
        let values = pairs.map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
        Some(StationLink { name: name.to_owned(), values })
    }

    /// The part of an address after `#`.
    pub fn fragment(&self) -> String {
        let values: Vec<String> = self.values.iter().map(|(key, value)| format!("{key}={value}")).collect();
        let colon = if values.is_empty() { "" } else { ":" };
        format!("{STATION_KEY}{}{colon}{}", self.name, values.join(","))
    }
}

/// The part of an address after `#` that contains the scene. Only scenes of built-in files can be sent; an error names the
/// first other file.
pub fn of_scene(scene: &SceneSettings) -> Result<String, String> {
    let models = scene.objects.iter().map(|object| &object.model).filter(|model| !model.starts_with(BUILTIN));
    let environments = scene.environment.iter().flat_map(|e| std::iter::once(&e.image).chain(&e.background));
    let files = environments.filter(|name| environment_file::builtin_of(name).is_none());
    if let Some(file) = models.chain(files).next() {
        return Err(tr!("window-a-link-contains-the-scene-but", file = file));
    }
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    let packed = encoder.write_all(SceneFile::from(scene).to_toml_string().as_bytes()).and_then(|()| encoder.finish());
    // Writing to memory does not fail.
    let packed = packed.map_err(|error| tr!("window-the-scene-could-not-be-compressed", error = error))?;
    Ok(format!("{KEY}{}", base64url(&packed)))
}

/// The scene file in such a part of an address; `None` if it contains none. An error is one sentence.
pub fn scene_file(fragment: &str) -> Option<Result<String, String>> {
    let text = fragment.trim_start_matches('#').strip_prefix(KEY)?;
    Some(unpack(text).ok_or_else(|| tr!("window-the-scene-in-the-link-is").to_owned()))
}

fn unpack(text: &str) -> Option<String> {
    let packed = from_base64url(text)?;
    let mut bytes = Vec::new();
    DeflateDecoder::new(&packed[..]).take(MOST_BYTES + 1).read_to_end(&mut bytes).ok()?;
    if bytes.len() as u64 > MOST_BYTES || bytes.is_empty() {
        return None;
    }
    String::from_utf8(bytes).ok()
}

fn base64url(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, i| bits << 8 | u32::from(group.get(i).copied().unwrap_or(0)));
        // n bytes make n + 1 characters; addresses have no padding.
        for i in 0..=group.len() {
            let digit = bits >> (18 - 6 * i) & 63;
            text.push(char::from(ALPHABET[digit as usize]));
        }
    }
    text
}

fn from_base64url(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=').as_bytes();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0_u32;
        for i in 0..4 {
            let digit = match group.get(i) {
                Some(character) => ALPHABET.iter().position(|known| known == character)? as u32,
                None => 0,
            };
            bits = bits << 6 | digit;
        }
        let whole = bits.to_be_bytes();
        match group.len() {
            4 => bytes.extend(&whole[1..4]),
            3 => bytes.extend(&whole[1..3]),
            2 => bytes.extend(&whole[1..2]),
            _ => return None,
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::scene_file::ObjectSpec;
    use gonio_scene::toml_file;

    /// RFC 4648, section 10, in the alphabet of its section 5 and without padding.
    #[test]
    fn base64_is_that_of_the_rfc() {
        let known = [("", ""), ("f", "Zg"), ("fo", "Zm8"), ("foo", "Zm9v"), ("foob", "Zm9vYg"), ("fooba", "Zm9vYmE")];
        for (plain, coded) in known {
            assert_eq!(base64url(plain.as_bytes()), coded);
            assert_eq!(from_base64url(coded).as_deref(), Some(plain.as_bytes()));
        }
        assert_eq!(base64url(&[0xfb, 0xff]), "-_8");
        assert_eq!(from_base64url("a+/b"), None);
    }

    #[test]
    fn a_scene_comes_back_from_its_link() {
        let loaded = gonio_scene::load::describe(&["builtin:light-kinds"], &gonio_scene::files::BuiltinOnly)
            .and_then(|s| gonio_scene::load::load(s, std::path::Path::new(""), &gonio_scene::files::BuiltinOnly))
            .unwrap_or_else(|e| panic!("{e}"));
        let link = of_scene(&loaded.settings).unwrap_or_else(|e| panic!("{e}"));
        let text =
            scene_file(&format!("#{link}")).unwrap_or_else(|| panic!("no scene")).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(toml_file::read(&text).unwrap_or_else(|e| panic!("{e}")), SceneFile::from(&loaded.settings));
        // Browsers and mail programs accept addresses of a few thousand characters.
        assert!(link.len() < 4000, "{} characters", link.len());
    }

    #[test]
    fn a_station_comes_back_from_its_link() {
        let pairs = [("density", "0.2"), ("g", "-0.5")].map(|(key, value)| (key.to_owned(), value.to_owned()));
        for values in [Vec::new(), pairs.to_vec()] {
            let link = StationLink { name: "fog".to_owned(), values };
            assert_eq!(StationLink::parse(&format!("#{}", link.fragment())), Some(link));
        }
        assert_eq!(
            StationLink { name: "fog".to_owned(), values: pairs.to_vec() }.fragment(),
            "station=fog:density=0.2,g=-0.5"
        );
        assert_eq!(StationLink::parse("#scene=fog"), None);
    }

    #[test]
    fn scenes_with_files_and_damaged_links_are_refused() {
        let object = ObjectSpec { model: "mine.obj".into(), ..ObjectSpec::default() };
        let scene = SceneSettings { objects: vec![object], ..SceneSettings::default() };
        assert!(of_scene(&scene).is_err_and(|error| error.contains("`mine.obj`")));
        assert_eq!(scene_file("#about"), None);
        assert!(scene_file("#scene=????").is_some_and(|scene| scene.is_err()));
        assert!(scene_file("#scene=").is_some_and(|scene| scene.is_err()));
    }
}
