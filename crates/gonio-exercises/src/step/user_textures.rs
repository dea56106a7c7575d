//! The textures that a user's shaders read from a scene, on the CPU.

use glam::{DVec2, DVec3};
use gonio_environment::CubeMips;
use gonio_interpreter::{TextureDetail, TextureLookup, TextureSource};
use gonio_mesh::Wrap;
use gonio_render::{SampledTexture, displayed_environment, map_of};
use gonio_scene::texture::{ColorSpace, Texture, TextureFilter};
use gonio_scene::{Frame, Scene, SceneMaterial};
use std::collections::HashMap;
use std::sync::Arc;

/// The number of the environment.
const ENVIRONMENT: u32 = 0;
/// The number of the texture that is white, and of a normal map without bumps.
const PLAIN: [u32; 2] = [1, 2];
/// The number of a texture of no kind that gonio has: black.
pub(super) const NONE: u32 = u32::MAX;

struct Flat {
    texture: Arc<Texture>,
    wrap: [Wrap; 2],
}

/// The textures by their numbers, which are the values of samplers.
pub(super) struct UserTextures {
    environment: Option<CubeMips>,
    flat: Vec<Flat>,
    filter: TextureFilter,
}

/// Numbers textures while the parts of a scene are listed.
pub(super) struct TextureNumbers<'a> {
    scene: &'a Scene,
    files: &'a [Arc<Texture>],
    /// The textures from [`PLAIN`] on: a texture of the scene, or of the user, with its wrap modes.
    known: HashMap<(bool, usize, [Wrap; 2]), u32>,
    flat: Vec<Flat>,
}

impl<'a> TextureNumbers<'a> {
    pub fn new(scene: &'a Scene, files: &'a [Arc<Texture>]) -> Self {
        let plain = |rgba: [u8; 4]| Flat {
            texture: Arc::new(Texture::new("plain", 1, 1, rgba.to_vec(), ColorSpace::Data)),
            wrap: [Wrap::Repeat; 2],
        };
        let flat = vec![plain([255; 4]), plain([128, 128, 255, 255])];
        TextureNumbers { scene, files, known: HashMap::new(), flat }
    }

    /// The value of a sampler for a material.
    pub fn number(&mut self, sampled: SampledTexture, material: &SceneMaterial) -> u32 {
        let missing = PLAIN[usize::from(sampled == SampledTexture::NormalMap)];
        match sampled {
            SampledTexture::Environment => ENVIRONMENT,
            SampledTexture::White => missing,
            SampledTexture::File(index) => self.of(true, index, [Wrap::Repeat; 2]).unwrap_or(missing),
            _ => {
                map_of(material, sampled).and_then(|bound| self.of(false, bound.texture, bound.wrap)).unwrap_or(missing)
            }
        }
    }

    fn of(&mut self, is_file: bool, index: usize, wrap: [Wrap; 2]) -> Option<u32> {
        if let Some(known) = self.known.get(&(is_file, index, wrap)) {
            return Some(*known);
        }
        let texture = if is_file { self.files.get(index)? } else { self.scene.textures.get(index)? };
        let number = PLAIN[0] + self.flat.len() as u32;
        self.flat.push(Flat { texture: Arc::new(texture.undecoded()), wrap });
        self.known.insert((is_file, index, wrap), number);
        Some(number)
    }

    pub fn finish(self, frame: &Frame, reads_environment: bool) -> UserTextures {
        let environment = if reads_environment { displayed_environment(self.scene, frame) } else { None };
        UserTextures { environment, flat: self.flat, filter: frame.texture_filter }
    }
}

impl UserTextures {
    fn flat(&self, sampler: u32) -> Option<&Flat> {
        self.flat.get(sampler.checked_sub(PLAIN[0])? as usize)
    }

    fn environment(&self, lookup: &TextureLookup) -> [f32; 4] {
        let Some(map) = &self.environment else { return [0.0, 0.0, 0.0, 1.0] };
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let [x, y, z, _] = lookup.coordinates;
        let direction = vector([x, y, z]);
        let level = match lookup.detail {
            TextureDetail::Base => 0.0,
            TextureDetail::Level(level) => f64::from(level),
            TextureDetail::Implicit { dx, dy, bias } => {
                // A face is 2 units wide at distance 1 along the longest component.
                let longest = direction.abs().max_element();
                let texels = 0.5 * f64::from(map.full().size()) / longest;
                let step = vector(dx).length().max(vector(dy).length()) * texels;
                step.log2() + f64::from(bias)
            }
        };
        let level = if level.is_nan() { 0.0 } else { level.max(0.0) };
        let [r, g, b] = map.sample(direction, level).as_vec3().to_array();
        [r, g, b, 1.0]
    }

    fn sample(&self, flat: &Flat, lookup: &TextureLookup) -> [f32; 4] {
        let Flat { texture, wrap } = flat;
        let size = DVec2::new(texture.width.into(), texture.height.into());
        let offset = DVec2::new(lookup.offset[0].into(), lookup.offset[1].into());
        let [x, y, ..] = lookup.coordinates.map(f64::from);
        let zero = DVec2::ZERO;
        if lookup.is_fetch {
            let level = match lookup.detail {
                TextureDetail::Level(level) => level.max(0.0) as usize,
                _ => 0,
            };
            return fetched(texture, DVec2::new(x, y) + offset, level);
        }
        let uv = DVec2::new(x, y) + offset / size;
        if let Some(component) = lookup.gather {
            let corner = (uv * size - 0.5).floor() + 0.5;
            // In OpenGL's order: counter-clockwise from the top left (OpenGL 4.6, section 8.14).
            return [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)].map(|(right, up)| {
                let texel = (corner + DVec2::new(right, up)) / size;
                let value = texture.sample(texel, zero, zero, TextureFilter::Nearest, *wrap);
                value.to_array().get(usize::from(component)).map_or(0.0, |value| *value as f32)
            });
        }
        let (dx, dy) = match lookup.detail {
            TextureDetail::Base => (zero, zero),
            TextureDetail::Level(level) => {
                let step = DVec2::new(f64::from(level).exp2() / size.x, 0.0);
                (step, DVec2::new(0.0, step.x * size.x / size.y))
            }
            TextureDetail::Implicit { dx, dy, bias } => {
                let scaled = |v: [f32; 3]| DVec2::new(v[0].into(), v[1].into()) * f64::from(bias).exp2();
                (scaled(dx), scaled(dy))
            }
        };
        texture.sample(uv, dx, dy, self.filter, *wrap).as_vec4().to_array()
    }
}

/// A texel of a level, counted from the bottom left; 0 outside.
fn fetched(texture: &Texture, texel: DVec2, level: usize) -> [f32; 4] {
    let smaller = level.checked_sub(1).and_then(|at| texture.mip_levels().get(at));
    let (width, height, rgba) = match (level, smaller) {
        (0, _) => (texture.width, texture.height, &texture.rgba),
        (_, Some(level)) => (level.width, level.height, &level.rgba),
        (_, None) => return [0.0; 4],
    };
    let (x, y) = (texel.x as i64, texel.y as i64);
    if x < 0 || y < 0 || x >= width.into() || y >= height.into() {
        return [0.0; 4];
    }
    let at = 4 * ((height as usize - 1 - y as usize) * width as usize + x as usize);
    std::array::from_fn(|channel| f32::from(rgba.get(at + channel).copied().unwrap_or(0)) / 255.0)
}

impl TextureSource for UserTextures {
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4] {
        match (lookup.sampler, self.flat(lookup.sampler)) {
            (ENVIRONMENT, _) => self.environment(lookup),
            (_, Some(flat)) => self.sample(flat, lookup),
            (_, None) => [0.0, 0.0, 0.0, 1.0],
        }
    }

    fn size(&self, sampler: u32, level: i32) -> [u32; 3] {
        let shrunk = |side: u32| (side >> level.clamp(0, 31)).max(1);
        match (sampler, self.flat(sampler)) {
            (ENVIRONMENT, _) => {
                let side = self.environment.as_ref().map_or(0, |map| shrunk(map.full().size()));
                [side, side, 1]
            }
            (_, Some(Flat { texture, .. })) => [shrunk(texture.width), shrunk(texture.height), 1],
            (_, None) => [0; 3],
        }
    }

    fn levels(&self, sampler: u32) -> u32 {
        match (sampler, self.flat(sampler)) {
            (ENVIRONMENT, _) => self.environment.as_ref().map_or(1, |map| map.levels().len() as u32),
            (_, Some(Flat { texture, .. })) => texture.mip_levels().len() as u32 + 1,
            (_, None) => 1,
        }
    }
}
