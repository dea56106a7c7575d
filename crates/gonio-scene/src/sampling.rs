//! Textures sampled on the CPU as OpenGL defines it (OpenGL 4.6 core, section 8.14).

use crate::mip::decode;
use crate::texture::{Texture, TextureFilter};
use glam::{DVec2, DVec4};
use gonio_mesh::Wrap;

/// Most samples along the longer axis of a footprint.
pub const MAX_ANISOTROPY: f64 = 16.0;

/// One level, full or smaller.
struct Level<'a> {
    width: u32,
    height: u32,
    rgba: &'a [u8],
}

impl Texture {
    /// The texture at `uv` in linear light, alpha last. (0, 0) is the picture's bottom left corner, v up.
    ///
    /// `ddx` and `ddy` are the derivatives of `uv` along the screen's axes, per pixel; only the
    /// filters with mipmaps look at them. `wraps` says what is beyond the edges,
    /// along u and along v. Coordinates and derivatives that are not finite count as 0.
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

    fn level(&self, index: usize) -> Level<'_> {
        match index.checked_sub(1).and_then(|i| self.mip_levels().get(i)) {
            Some(level) => Level { width: level.width, height: level.height, rgba: &level.rgba },
            None => Level { width: self.width, height: self.height, rgba: &self.rgba },
        }
    }

    fn nearest(&self, uv: DVec2, wraps: [Wrap; 2]) -> DVec4 {
        let level = self.level(0);
        let at = |u: f64, size: u32, wrap| (near(u, wrap) * f64::from(size)).floor() as i64;
        self.texel(&level, at(uv.x, level.width, wraps[0]), at(uv.y, level.height, wraps[1]), wraps)
    }

    /// Texel centres lie at half integers.
    fn bilinear(&self, level: &Level<'_>, uv: DVec2, wraps: [Wrap; 2]) -> DVec4 {
        let x = near(uv.x, wraps[0]) * f64::from(level.width) - 0.5;
        let y = near(uv.y, wraps[1]) * f64::from(level.height) - 0.5;
        let (left, bottom) = (x.floor(), y.floor());
        let (i, j) = (left as i64, bottom as i64);
        let t = |di, dj| self.texel(level, i + di, j + dj, wraps);
        let (fx, fy) = (x - left, y - bottom);
        t(0, 0).lerp(t(1, 0), fx).lerp(t(0, 1).lerp(t(1, 1), fx), fy)
    }

    /// Column `i` from the left, row `j` from the **bottom**, wrapped.
    fn texel(&self, level: &Level<'_>, i: i64, j: i64, wraps: [Wrap; 2]) -> DVec4 {
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
