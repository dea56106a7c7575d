//! Conversion of pictures to textures: channels, ranges, heights to normals, metalness to colours.

use crate::image_file::Decoded;
use gonio_image::srgb::{ENCODER, LINEAR_FROM_8};
use gonio_mesh::{Channel, MetallicRoughness, TexelRule};

/// The purpose of a texture, which determines the conversion of its numbers. Floats are kept as bits, so that uses can
/// be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Purpose {
    /// sRGB.
    Color(Rule),
    /// Red, or the rule's channel.
    Data(Rule),
    /// Alpha where the picture has one, else red; or the rule's channel.
    Opacity(Rule),
    /// A normal map with its strength.
    Normal(u32),
    /// Heights, or a normal map if it is coloured; with its strength.
    Bump(u32),
    /// The diffuse colour of metalness (first, if it has a picture) and base colour (last, or white), without the
    /// base colour's factor.
    MetalDiffuse(Metal),
    /// The specular colour of the same, with all factors.
    MetalSpecular(Metal),
}

/// [`TexelRule`], comparable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Rule {
    channel: Option<Channel>,
    base: u32,
    gain: u32,
    cutoff: Option<u32>,
}

/// The factors that belong to metalness and base colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Metal {
    /// Whether metalness has a picture; without, it is the same everywhere.
    has_picture: bool,
    channel: Option<Channel>,
    metallic: u32,
    base_color: [u32; 3],
}

impl Rule {
    pub fn new(rule: TexelRule) -> Self {
        let TexelRule { channel, base, gain, cutoff } = rule;
        Rule { channel, base: base.to_bits(), gain: gain.to_bits(), cutoff: cutoff.map(f32::to_bits) }
    }

    fn is_plain(self) -> bool {
        self == Rule::new(TexelRule { channel: self.channel, ..TexelRule::default() })
    }

    /// Applies the rule to a number from 0 to 255.
    fn apply(self, value: u8) -> u8 {
        let value = f32::from_bits(self.base) + f32::from_bits(self.gain) * f32::from(value) / 255.0;
        let value = match self.cutoff.map(f32::from_bits) {
            Some(cutoff) => f32::from(u8::from(value >= cutoff)),
            None => value,
        };
        // A cast saturates; what is not a number becomes 0.
        (255.0 * value + 0.5) as u8
    }
}

impl Metal {
    pub fn new(from: &MetallicRoughness) -> Self {
        let channel = from.metallic_map.as_ref().and_then(|map| map.texel.channel);
        Metal {
            has_picture: from.metallic_map.is_some(),
            channel,
            metallic: from.metallic.to_bits(),
            base_color: from.base_color.map(f32::to_bits),
        }
    }
}

impl Purpose {
    /// Whether the texture holds sRGB colours.
    pub fn is_color(self) -> bool {
        matches!(self, Purpose::Color(_) | Purpose::MetalDiffuse(_) | Purpose::MetalSpecular(_))
    }
}

/// The texture's texels, and a note on the picture (to follow its name).
pub(crate) fn cook(purpose: Purpose, sources: &[&Decoded]) -> (Decoded, Option<String>) {
    let mut picture = sources[0].clone();
    let mut note = None;
    match purpose {
        Purpose::Color(rule) => color(&mut picture, rule),
        Purpose::Data(rule) => scalar(&mut picture, rule, Channel::Red),
        Purpose::Opacity(rule) => {
            let channel = if picture.has_alpha { Channel::Alpha } else { Channel::Red };
            scalar(&mut picture, rule, channel);
        }
        Purpose::Normal(bits) => strengthen(&mut picture, bits),
        Purpose::Bump(bits) if is_heights(&picture) => {
            normals_of_heights(&mut picture, f32::from_bits(bits).into());
            note = Some("is grey, so it is read as a height map".to_owned());
        }
        Purpose::Bump(bits) => {
            strengthen(&mut picture, bits);
            note = Some("is coloured, so it is read as a tangent-space normal map".to_owned());
        }
        Purpose::MetalDiffuse(metal) => picture = of_metal(metal, sources, false),
        Purpose::MetalSpecular(metal) => picture = of_metal(metal, sources, true),
    }
    (picture, note)
}

fn strengthen(picture: &mut Decoded, bits: u32) {
    let strength = f64::from(f32::from_bits(bits));
    if strength != 1.0 {
        scale_slopes(picture, strength);
    }
}

/// A colour's channels each by the rule; one chosen channel becomes a grey.
fn color(picture: &mut Decoded, rule: Rule) {
    if rule.is_plain() && rule.channel.is_none() {
        return;
    }
    for texel in picture.rgba.as_chunks_mut::<4>().0 {
        let [r, g, b] = match rule.channel {
            Some(channel) => [channel_of(*texel, channel); 3],
            None => [texel[0], texel[1], texel[2]],
        };
        *texel = [rule.apply(r), rule.apply(g), rule.apply(b), texel[3]];
    }
}

/// Moves the value in use to the red channel.
fn scalar(picture: &mut Decoded, rule: Rule, usual: Channel) {
    let channel = rule.channel.unwrap_or(usual);
    if channel == Channel::Red && rule.is_plain() {
        return;
    }
    for texel in picture.rgba.as_chunks_mut::<4>().0 {
        texel[0] = rule.apply(channel_of(*texel, channel));
    }
}

fn channel_of(texel: [u8; 4], channel: Channel) -> u8 {
    match channel {
        Channel::Red => texel[0],
        Channel::Green => texel[1],
        Channel::Blue => texel[2],
        Channel::Alpha => texel[3],
        // Rec. 709 weights, of the encoded numbers (which is what paint programs call brightness).
        Channel::Luminance => {
            let [r, g, b] = [0, 1, 2].map(|c| f32::from(texel[c]));
            (0.2126 * r + 0.7152 * g + 0.0722 * b + 0.5) as u8
        }
    }
}

/// Diffuse or specular colour of metalness and base colour, as large as the larger of the two pictures.
fn of_metal(metal: Metal, sources: &[&Decoded], specular: bool) -> Decoded {
    let metalness = sources.first().filter(|_| metal.has_picture);
    let base = sources.get(usize::from(metal.has_picture));
    let width = sources.iter().map(|picture| picture.width).max().unwrap_or(1);
    let height = sources.iter().map(|picture| picture.height).max().unwrap_or(1);
    let channel = metal.channel.unwrap_or(Channel::Red);
    let factor = metal.base_color.map(f32::from_bits);
    let mut rgba = Vec::with_capacity(4 * width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let texel = |picture: &Decoded| {
                // The texel whose middle is nearest; both pictures cover the same square.
                let at = |i: u32, size: u32, whole: u32| (u64::from(i) * u64::from(size) / u64::from(whole)) as usize;
                let i = at(y, picture.height, height) * picture.width as usize + at(x, picture.width, width);
                picture.rgba.as_chunks::<4>().0[i]
            };
            let there = metalness.map_or(1.0, |metalness| f32::from(channel_of(texel(metalness), channel)) / 255.0);
            let m = f32::from_bits(metal.metallic) * there;
            let base = base.map_or([255; 4], |b| texel(b));
            let color = [0, 1, 2].map(|c| LINEAR_FROM_8[usize::from(base[c])]);
            let made = if specular {
                MetallicRoughness::specular([0, 1, 2].map(|c| factor[c] * color[c]), m)
            } else {
                MetallicRoughness::diffuse(color, m)
            };
            let [r, g, b] = made.map(|light| ENCODER.encode(light));
            rgba.extend([r, g, b, base[3]]);
        }
    }
    Decoded { width, height, rgba, has_alpha: base.is_some_and(|b| b.has_alpha) }
}

/// A picture counts as heights if no texel's channels differ by more than this (of 255): room for
/// what JPEG does to greys. A tangent-space normal map is bluish everywhere: (128, 128, 255).
const GREY_TOLERANCE: u8 = 24;

/// Whether the picture is grey, or nearly so: heights, not normals.
fn is_heights(picture: &Decoded) -> bool {
    let spread = |t: &[u8; 4]| t[0].max(t[1]).max(t[2]) - t[0].min(t[1]).min(t[2]);
    let texels = picture.rgba.as_chunks::<4>().0;
    let colored = texels.iter().filter(|t| spread(t) > GREY_TOLERANCE).count();
    colored * 100 <= texels.len()
}

/// Heights (red channel) in `[0, 1]` to a tangent-space normal map, green up.
///
/// The slope along u is `strength * (h[x+1] - h[x-1]) / 2` per texel (central differences, the
/// picture repeats), and so along v; the normal is `(-slope_u, -slope_v, 1)` at unit length, mapped
/// from [-1, 1] to bytes. `strength` is the material's `-bm`.
fn normals_of_heights(picture: &mut Decoded, strength: f64) {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let heights: Vec<f64> = picture.rgba.as_chunks::<4>().0.iter().map(|t| f64::from(t[0]) / 255.0).collect();
    let at = |x: usize, y: usize| heights[y * width + x];
    for (i, texel) in picture.rgba.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let (x, y) = (i % width, i / width);
        let slope_u = 0.5 * strength * (at((x + 1) % width, y) - at((x + width - 1) % width, y));
        // Rows run down, v runs up.
        let slope_v = 0.5 * strength * (at(x, (y + height - 1) % height) - at(x, (y + 1) % height));
        *texel = to_bytes([-slope_u, -slope_v, 1.0]);
    }
}

/// A normal map with its slopes multiplied by `strength`.
fn scale_slopes(picture: &mut Decoded, strength: f64) {
    for texel in picture.rgba.as_chunks_mut::<4>().0 {
        let [x, y, z] = [0, 1, 2].map(|c| f64::from(texel[c]) / 127.5 - 1.0);
        *texel = to_bytes([x * strength, y * strength, z]);
    }
}

fn to_bytes(normal: [f64; 3]) -> [u8; 4] {
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt().max(1e-12);
    let [x, y, z] = normal.map(|c| (127.5 * (c / length + 1.0) + 0.5) as u8);
    [x, y, z, 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, rgba: &[[u8; 4]]) -> Decoded {
        let has_alpha = rgba.iter().any(|t| t[3] != 255);
        Decoded { width, height, rgba: rgba.concat(), has_alpha }
    }

    fn cooked(purpose: Purpose, texel: [u8; 4]) -> [u8; 4] {
        let (made, note) = cook(purpose, &[&picture(1, 1, &[texel])]);
        assert_eq!(note, None);
        [made.rgba[0], made.rgba[1], made.rgba[2], made.rgba[3]]
    }

    #[test]
    fn channels_and_ranges() {
        let rule = |channel, base, gain, cutoff| Rule::new(TexelRule { channel, base, gain, cutoff });
        let plain = Rule::new(TexelRule::default());
        assert_eq!(cooked(Purpose::Color(plain), [10, 20, 30, 40]), [10, 20, 30, 40]);
        assert_eq!(cooked(Purpose::Data(plain), [10, 20, 30, 40])[0], 10);
        assert_eq!(cooked(Purpose::Data(rule(Some(Channel::Green), 0.0, 1.0, None)), [10, 20, 30, 40])[0], 20);
        assert_eq!(
            cooked(Purpose::Color(rule(Some(Channel::Blue), 0.0, 1.0, None)), [10, 20, 30, 40]),
            [30, 30, 30, 40]
        );
        // An opacity is alpha where there is one; inverted it is a transparency.
        assert_eq!(cooked(Purpose::Opacity(plain), [10, 20, 30, 40])[0], 40);
        assert_eq!(cooked(Purpose::Opacity(plain), [10, 20, 30, 255])[0], 10);
        assert_eq!(cooked(Purpose::Opacity(rule(None, 1.0, -1.0, None)), [10, 20, 30, 255])[0], 245);
        // All or nothing, at 0.5 = 127.5 of 255; beyond 1 and below 0 is cut.
        assert_eq!(cooked(Purpose::Data(rule(None, 0.0, 1.0, Some(0.5))), [127, 0, 0, 255])[0], 0);
        assert_eq!(cooked(Purpose::Data(rule(None, 0.0, 1.0, Some(0.5))), [128, 0, 0, 255])[0], 255);
        assert_eq!(cooked(Purpose::Data(rule(None, 0.5, 2.0, None)), [128, 0, 0, 255])[0], 255);
        assert_eq!(cooked(Purpose::Data(rule(None, -1.0, 1.0, None)), [128, 0, 0, 255])[0], 0);
        // 0.2126 * 100 + 0.7152 * 200 + 0.0722 * 50 = 167.91
        assert_eq!(cooked(Purpose::Data(rule(Some(Channel::Luminance), 0.0, 1.0, None)), [100, 200, 50, 255])[0], 168);
    }

    #[test]
    fn metal_has_no_diffuse_colour_and_its_own_specular_one() {
        let from = MetallicRoughness {
            base_color: [1.0, 0.5, 0.0],
            metallic: 1.0,
            roughness: 1.0,
            metallic_map: Some(gonio_mesh::TextureMap::new("m.png")),
            roughness_map: None,
        };
        let metal = Metal::new(&from);
        let metalness = picture(2, 1, &[[255, 0, 0, 255], [0, 0, 0, 255]]);
        let base = picture(1, 1, &[[255, 255, 255, 255]]);
        let diffuse = cook(Purpose::MetalDiffuse(metal), &[&metalness, &base]).0;
        // No metal: the base colour's texel (its factor is applied later).
        assert_eq!((diffuse.width, diffuse.rgba.as_slice()), (2, &[0, 0, 0, 255, 255, 255, 255, 255][..]));
        let specular = cook(Purpose::MetalSpecular(metal), &[&metalness, &base]).0;
        // Metal: the base colour, sRGB 188 for 0.5. No metal: 0.04, which is sRGB 56.
        assert_eq!(specular.rgba, [255, 188, 0, 255, 56, 56, 56, 255]);
        assert_eq!(cook(Purpose::MetalSpecular(metal), &[&metalness]).0.rgba[..4], [255, 188, 0, 255]);
        // Half a metal everywhere, white: (1 + 0.04) / 2 = 0.52 is sRGB 191 for red.
        let half = Metal::new(&MetallicRoughness { metallic: 0.5, metallic_map: None, ..from });
        assert_eq!(cook(Purpose::MetalSpecular(half), &[&base]).0.rgba[0], 191);
    }
}
