//! Textures, decoded, with their smaller levels, sampled on the CPU as OpenGL defines it (OpenGL 4.6 core, section
//! 8.14).

use glam::{DVec2, DVec4};
use gonio_image::srgb::{ENCODER, EXACT_FROM_8};
use gonio_light::named_enum;
use gonio_mesh::Wrap;
use std::sync::OnceLock;

named_enum! {
    /// The filter of textures.
    pub enum TextureFilter {
        /// The nearest texel.
        Nearest = "nearest",
        /// Four texels of the full picture, no mipmaps.
        Linear = "linear",
        /// Trilinear.
        Mipmap = "mipmap",
        /// Trilinear, up to 16 times along the footprint's longer axis.
        Anisotropic = "anisotropic",
    }
    default Anisotropic;
    what "texture filter";
}

/// The meaning of a texture's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorSpace {
    /// sRGB colours (alpha linear): decoded before filtering.
    Srgb,
    /// Data: not decoded.
    Data,
}

/// A decoded picture: RGBA, 8 bits each. Made by [`Texture::new`].
#[derive(Clone, Debug)]
pub struct Texture {
    /// The file it came from, for reports and debug labels.
    pub name: String,
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// `width * height * 4` bytes, first row is the picture's **top**.
    pub rgba: Vec<u8>,
    /// The meaning of the numbers.
    pub color_space: ColorSpace,
    /// The smaller levels, computed when first needed.
    levels: OnceLock<Vec<MipLevel>>,
}

/// One level, made as [`Texture`]'s own: RGBA, 8 bits, first row the picture's top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipLevel {
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

impl PartialEq for Texture {
    /// The smaller levels follow from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && (self.width, self.height, self.color_space) == (other.width, other.height, other.color_space)
            && self.rgba == other.rgba
    }
}

impl Texture {
    /// A texture of `width * height * 4` bytes, first row the top one. Missing bytes of `rgba` are
    /// 0, surplus bytes are ignored; an empty texture becomes one texel.
    pub fn new(name: impl Into<String>, width: u32, height: u32, mut rgba: Vec<u8>, color_space: ColorSpace) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        rgba.resize(width as usize * height as usize * 4, 0);
        Texture { name: name.into(), width, height, rgba, color_space, levels: OnceLock::new() }
    }

    /// A picture file's texels, as colours: PNG, JPEG, BMP, TGA or GIF by its content. The error is a sentence about
    /// the file, without its name.
    pub fn decode(name: impl Into<String>, bytes: &[u8]) -> Result<Self, String> {
        let name = name.into();
        let picture = crate::image_file::decode(bytes, &name)?;
        Ok(Texture::new(name, picture.width, picture.height, picture.rgba, ColorSpace::Srgb))
    }

    /// The levels below the full picture, halving down to one texel: level 1 first.
    ///
    /// Each texel is the mean, in linear light, of the texels it covers, rounded to 8 bits. A GPU
    /// that is given these levels filters what the CPU filters.
    pub fn mip_levels(&self) -> &[MipLevel] {
        self.levels.get_or_init(|| chain(self))
    }
}

impl Texture {
    /// The same bytes, smaller levels included, that are not decoded when they are sampled: as a user's shaders read them.
    #[must_use]
    pub fn undecoded(&self) -> Texture {
        let levels = OnceLock::from(self.mip_levels().to_vec());
        let (name, rgba) = (self.name.clone(), self.rgba.clone());
        Texture { name, width: self.width, height: self.height, rgba, color_space: ColorSpace::Data, levels }
    }
}

/// RGBA bytes as linear numbers in [0, 1]; alpha is never encoded.
pub fn decode(texel: [u8; 4], color_space: ColorSpace) -> [f64; 4] {
    let plain = |byte: u8| f64::from(byte) / 255.0;
    match color_space {
        ColorSpace::Data => texel.map(plain),
        ColorSpace::Srgb => {
            let table = &*EXACT_FROM_8;
            let [r, g, b, a] = texel;
            [table[r as usize], table[g as usize], table[b as usize], plain(a)]
        }
    }
}

fn encode(value: [f32; 4], color_space: ColorSpace) -> [u8; 4] {
    let plain = |v: f32| (v * 255.0 + 0.5) as u8;
    match color_space {
        ColorSpace::Data => value.map(plain),
        ColorSpace::Srgb => {
            [ENCODER.encode(value[0]), ENCODER.encode(value[1]), ENCODER.encode(value[2]), plain(value[3])]
        }
    }
}

/// A level that is not yet rounded, so that errors do not add up from level to level.
struct LinearLevel {
    width: u32,
    height: u32,
    texels: Vec<[f32; 4]>,
}

/// All levels below the full picture.
pub(crate) fn chain(texture: &Texture) -> Vec<MipLevel> {
    let texels = texture.rgba.as_chunks::<4>().0.iter();
    let mut level = LinearLevel {
        width: texture.width,
        height: texture.height,
        texels: texels.map(|&t| decode(t, texture.color_space).map(|v| v as f32)).collect(),
    };
    let mut levels = Vec::new();
    while level.width > 1 || level.height > 1 {
        level = halve(&level);
        let rgba = level.texels.iter().flat_map(|&t| encode(t, texture.color_space)).collect();
        levels.push(MipLevel { width: level.width, height: level.height, rgba });
    }
    levels
}

/// Half the size, rounded down, at least 1: the mean over each texel's area. Where a side is odd the
/// areas cut through texels, and those count by their share.
fn halve(from: &LinearLevel) -> LinearLevel {
    let (width, height) = ((from.width / 2).max(1), (from.height / 2).max(1));
    let columns: Vec<_> = (0..width).map(|x| cover(x, width, from.width)).collect();
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let rows = cover(y, height, from.height);
        for column in &columns {
            let mut sum = [0.0f32; 4];
            for &(row, row_share) in &rows {
                for &(x, share) in column {
                    let texel = from.texels[row as usize * from.width as usize + x as usize];
                    for (s, t) in sum.iter_mut().zip(texel) {
                        *s += t * share * row_share;
                    }
                }
            }
            texels.push(sum);
        }
    }
    LinearLevel { width, height, texels }
}

/// The texels that texel `i` of `size` covers in a side of `from` texels, with their shares.
fn cover(i: u32, size: u32, from: u32) -> Vec<(u32, f32)> {
    let extent = f64::from(from) / f64::from(size);
    let (start, end) = (f64::from(i) * extent, f64::from(i + 1) * extent);
    (start as u32..from)
        .map(|t| (t, (end.min(f64::from(t + 1)) - start.max(f64::from(t))) / extent))
        .take_while(|(_, share)| *share > 1e-9)
        .map(|(t, share)| (t, share as f32))
        .collect()
}

/// Most samples along the longer axis of a footprint.
pub const MAX_ANISOTROPY: f64 = 16.0;

/// One level, full or smaller.
struct LevelRef<'a> {
    width: u32,
    height: u32,
    rgba: &'a [u8],
}

impl Texture {
    /// The texture at `uv` in linear light, alpha last. (0, 0) is the picture's bottom left corner, v up.
    ///
    /// `ddx` and `ddy` are the derivatives of `uv` along the screen's axes, per pixel; only the filters with mipmaps
    /// use them. `wraps` are the wrap modes along u and along v. Coordinates and derivatives that are not finite count
    /// as 0.
    pub fn sample(&self, uv: DVec2, ddx: DVec2, ddy: DVec2, filter: TextureFilter, wraps: [Wrap; 2]) -> DVec4 {
        let [uv, ddx, ddy] = [uv, ddx, ddy].map(|v| if v.is_finite() { v } else { DVec2::ZERO });
        match filter {
            TextureFilter::Nearest => self.nearest(uv, wraps),
            TextureFilter::Linear => self.bilinear(&self.level(0), uv, wraps),
            TextureFilter::Mipmap => {
                let (px, py) = self.footprint(ddx, ddy);
                self.trilinear(uv, px.max(py).log2(), wraps)
            }
            TextureFilter::Anisotropic => self.anisotropic(uv, ddx, ddy, wraps),
        }
    }

    /// Lengths in texels of a pixel's two steps.
    fn footprint(&self, ddx: DVec2, ddy: DVec2) -> (f64, f64) {
        let size = DVec2::new(self.width.into(), self.height.into());
        ((ddx * size).length(), (ddy * size).length())
    }

    /// EXT_texture_filter_anisotropic, its reference formula: as many trilinear samples along the
    /// longer step as it is longer than the shorter one, at the level of the shorter.
    fn anisotropic(&self, uv: DVec2, ddx: DVec2, ddy: DVec2, wraps: [Wrap; 2]) -> DVec4 {
        let (px, py) = self.footprint(ddx, ddy);
        let (longer, shorter) = (px.max(py), px.min(py));
        let ratio = longer / shorter;
        let taps = if ratio.is_nan() { 1.0 } else { ratio.ceil().clamp(1.0, MAX_ANISOTROPY) };
        let lod = (longer / taps).log2();
        let axis = if px > py { ddx } else { ddy };
        let count = taps as u32;
        let sum: DVec4 =
            (1..=count).map(|i| self.trilinear(uv + axis * (f64::from(i) / (taps + 1.0) - 0.5), lod, wraps)).sum();
        sum / taps
    }

    /// Between the two nearest levels; `lod` <= 0 (and NaN) is the full picture.
    fn trilinear(&self, uv: DVec2, lod: f64, wraps: [Wrap; 2]) -> DVec4 {
        if lod.is_nan() || lod <= 0.0 {
            return self.bilinear(&self.level(0), uv, wraps);
        }
        let last = self.mip_levels().len();
        let lod = lod.min(last as f64);
        let lower = lod.floor() as usize;
        let fine = self.bilinear(&self.level(lower), uv, wraps);
        if lower >= last {
            return fine;
        }
        fine.lerp(self.bilinear(&self.level(lower + 1), uv, wraps), lod.fract())
    }

    fn level(&self, index: usize) -> LevelRef<'_> {
        match index.checked_sub(1).and_then(|i| self.mip_levels().get(i)) {
            Some(level) => LevelRef { width: level.width, height: level.height, rgba: &level.rgba },
            None => LevelRef { width: self.width, height: self.height, rgba: &self.rgba },
        }
    }

    fn nearest(&self, uv: DVec2, wraps: [Wrap; 2]) -> DVec4 {
        let level = self.level(0);
        let at = |u: f64, size: u32, wrap| (near(u, wrap) * f64::from(size)).floor() as i64;
        self.texel(&level, at(uv.x, level.width, wraps[0]), at(uv.y, level.height, wraps[1]), wraps)
    }

    /// Texel centres lie at half integers.
    fn bilinear(&self, level: &LevelRef<'_>, uv: DVec2, wraps: [Wrap; 2]) -> DVec4 {
        let x = near(uv.x, wraps[0]) * f64::from(level.width) - 0.5;
        let y = near(uv.y, wraps[1]) * f64::from(level.height) - 0.5;
        let (left, bottom) = (x.floor(), y.floor());
        let (i, j) = (left as i64, bottom as i64);
        let t = |di, dj| self.texel(level, i + di, j + dj, wraps);
        let (fx, fy) = (x - left, y - bottom);
        t(0, 0).lerp(t(1, 0), fx).lerp(t(0, 1).lerp(t(1, 1), fx), fy)
    }

    /// Column `i` from the left, row `j` from the **bottom**, wrapped.
    fn texel(&self, level: &LevelRef<'_>, i: i64, j: i64, wraps: [Wrap; 2]) -> DVec4 {
        let column = inside(i, level.width, wraps[0]);
        let row = i64::from(level.height) - 1 - inside(j, level.height, wraps[1]);
        let at = 4 * (row as usize * level.width as usize + column as usize);
        let texel = [level.rgba[at], level.rgba[at + 1], level.rgba[at + 2], level.rgba[at + 3]];
        DVec4::from_array(decode(texel, self.color_space))
    }
}

/// A coordinate brought near [0, 1] (mirrored: [0, 2]), so that large ones keep their precision as integers.
fn near(u: f64, wrap: Wrap) -> f64 {
    match wrap {
        Wrap::Repeat => u - u.floor(),
        Wrap::Clamp => u.clamp(0.0, 1.0),
        Wrap::Mirror => u - 2.0 * (0.5 * u).floor(),
    }
}

/// The texel of `0..size` for number `k` (OpenGL 4.6 core, table 8.20).
fn inside(k: i64, size: u32, wrap: Wrap) -> i64 {
    let size = i64::from(size);
    match wrap {
        Wrap::Repeat => k.rem_euclid(size),
        Wrap::Clamp => k.clamp(0, size - 1),
        Wrap::Mirror => {
            let k = k.rem_euclid(2 * size);
            if k < size { k } else { 2 * size - 1 - k }
        }
    }
}
