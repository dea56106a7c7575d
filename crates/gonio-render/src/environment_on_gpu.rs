//! A scene's environment as cube textures: linear light in half floats, with our own mip levels.
//!
//! Faces are not flipped: their rows begin at t = 0, which is at the top in OpenGL's table of directions, as in a [`Cubemap`].
//! (2-D textures are flipped, because v increases upwards.)

use gonio_environment::{BrdfTable, Cubemap, Face, SmallLight};
use gonio_gl::objects::TextureObject;
use gonio_gl::{Gl, GlError, Texels};
use gonio_scene::LoadedEnvironment;
use std::cell::OnceCell;
use std::sync::Arc;

/// A cubemap with its mip levels; freed when dropped.
pub(crate) struct CubeTexture {
    texture: TextureObject,
    /// Texels along an edge of the largest level that the driver holds.
    pub size: u32,
    /// The last level: the first is 0.
    pub last_level: i32,
    /// Finer levels that it does not hold.
    pub levels_left_out: usize,
}

/// A scene's environment; freed when dropped. Parts that take seconds to compute are computed on first use.
pub(crate) struct EnvironmentOnGpu {
    loaded: Arc<LoadedEnvironment>,
    max_size: u32,
    /// The cubemap for reflection and refraction.
    pub map: CubeTexture,
    background: Option<CubeTexture>,
    polynomial: OnceCell<[[f32; 3]; 9]>,
    gloss: OnceCell<Gloss>,
    blurred: OnceCell<CubeTexture>,
    rest: OnceCell<CubeTexture>,
    /// Limits of the driver that change the picture.
    pub notes: Vec<String>,
}

/// The environment as glossy surfaces reflect it.
pub(crate) struct Gloss {
    /// The prefiltered cubemap, whose levels increase in roughness.
    pub map: CubeTexture,
    /// [`BrdfTable`]: the same for all environments.
    pub brdf: TextureObject,
}

impl EnvironmentOnGpu {
    /// Uploads it. Adds a note if a cubemap is larger than the driver's `max_size`.
    pub fn upload(gl: &Gl, environment: &Arc<LoadedEnvironment>, max_size: u32) -> Result<Self, GlError> {
        let mut notes = Vec::new();
        let mut upload = |what: &str, levels: &[Cubemap]| {
            let texture = CubeTexture::upload(gl, &format!("{what} {}", environment.name), levels, max_size)?;
            if texture.levels_left_out > 0 {
                notes.push(format!(
                    "the {what} is drawn with {size} x {size} texels a face instead of {full} x {full}: the driver has \
                     no more",
                    size = texture.size,
                    full = levels.first().map_or(0, Cubemap::size)
                ));
            }
            Ok(texture)
        };
        let map = upload("environment", environment.mips.levels())?;
        let background = environment.background.as_ref().map(|b| upload("background", b.levels())).transpose()?;
        Ok(EnvironmentOnGpu {
            loaded: environment.clone(),
            max_size,
            map,
            background,
            polynomial: OnceCell::new(),
            gloss: OnceCell::new(),
            blurred: OnceCell::new(),
            rest: OnceCell::new(),
            notes,
        })
    }

    /// The cubemap that is visible behind the objects.
    pub fn seen(&self) -> &CubeTexture {
        self.background.as_ref().unwrap_or(&self.map)
    }

    /// The blurred cubemap that is visible behind the objects, and its level for a blur from 0 to 1.
    pub fn seen_blurred(&self, gl: &Gl, blur: f64) -> Result<(&CubeTexture, f64), GlError> {
        let levels = self.loaded.seen_glossy();
        let upload = || CubeTexture::upload(gl, "blurred background", levels.levels(), self.max_size);
        Ok((made_once(&self.blurred, upload)?, levels.level_of_roughness(blur)))
    }

    /// The nine constants of its irradiance.
    pub fn polynomial(&self) -> &[[f32; 3]; 9] {
        self.polynomial.get_or_init(|| self.loaded.harmonics().polynomial().map(|c| c.as_vec3().to_array()))
    }

    /// The environment without its small lights.
    pub fn rest(&self, gl: &Gl) -> Result<&CubeTexture, GlError> {
        made_once(&self.rest, || {
            let levels = self.loaded.separated().rest.levels();
            CubeTexture::upload(gl, "environment without small lights", levels, self.max_size)
        })
    }

    /// The small lights of the environment.
    pub fn small_lights(&self) -> &[SmallLight] {
        &self.loaded.separated().lights
    }

    /// The environment as glossy surfaces reflect it.
    pub fn gloss(&self, gl: &Gl) -> Result<&Gloss, GlError> {
        made_once(&self.gloss, || {
            let map = CubeTexture::upload(gl, "glossy environment", self.loaded.glossy().levels(), self.max_size)?;
            Ok(Gloss { map, brdf: upload_brdf(gl)? })
        })
    }
}

fn made_once<T>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T, GlError>) -> Result<&T, GlError> {
    if let Some(made) = cell.get() {
        return Ok(made);
    }
    let made = make()?;
    Ok(cell.get_or_init(|| made))
}

/// The table of factors, filtered linearly: as half floats, because OpenGL ES need not filter 32-bit floats.
fn upload_brdf(gl: &Gl) -> Result<TextureObject, GlError> {
    let texture = TextureObject::bound(gl, "environment BRDF")?;
    let halves: Vec<u16> = BrdfTable::get().values().as_flattened().iter().map(|&v| bits_of(v)).collect();
    let size = BrdfTable::SIZE as i32;
    gl.tex_image_2d(
        glow::TEXTURE_2D,
        0,
        glow::RG16F,
        [size, size],
        Texels::f16(glow::RG, bytemuck::cast_slice(&halves)),
    );
    for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::LINEAR as i32);
    }
    for parameter in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::CLAMP_TO_EDGE as i32);
    }
    Ok(texture)
}

impl CubeTexture {
    /// Uploads levels, the largest first, beginning with the first that is not larger than `max_size`. Levels end where
    /// one is not half (rounded down) the size of the one before: OpenGL supports no others.
    pub fn upload(gl: &Gl, name: &str, levels: &[Cubemap], max_size: u32) -> Result<Self, GlError> {
        let left_out = levels.iter().take_while(|l| l.size() > max_size).count();
        let Some((first, smaller)) = levels.get(left_out..).and_then(<[Cubemap]>::split_first) else {
            return Err(GlError::new(format!(
                "{name}: no level of it is small enough for this driver, whose cubemaps have at most {max_size} texels \
                 along an edge; make it smaller"
            )));
        };
        let texture = TextureObject::cube(gl, name)?;
        upload_level(gl, 0, first);
        let mut last = 0;
        for (level, map) in (1..).zip(smaller) {
            if first.size() >> level != map.size() {
                break;
            }
            upload_level(gl, level, map);
            last = level;
        }
        for (parameter, value) in [
            (glow::TEXTURE_BASE_LEVEL, 0),
            (glow::TEXTURE_MAX_LEVEL, last),
            (glow::TEXTURE_MAG_FILTER, glow::LINEAR as i32),
            (glow::TEXTURE_MIN_FILTER, glow::LINEAR_MIPMAP_LINEAR as i32),
            (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_EDGE as i32),
            (glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE as i32),
            (glow::TEXTURE_WRAP_R, glow::CLAMP_TO_EDGE as i32),
        ] {
            gl.tex_parameter_i32(glow::TEXTURE_CUBE_MAP, parameter, value);
        }
        Ok(CubeTexture { texture, size: first.size(), last_level: last, levels_left_out: left_out })
    }

    /// Binds it to a texture unit.
    pub fn bind(&self, gl: &Gl, unit: u32) {
        gl.active_texture(glow::TEXTURE0 + unit);
        gl.bind_texture(glow::TEXTURE_CUBE_MAP, Some(self.texture.handle()));
    }
}

/// Fills a level of the bound cubemap.
fn upload_level(gl: &Gl, level: i32, map: &Cubemap) {
    for face in Face::ALL {
        let halves: Vec<u16> = map.face(face).as_flattened().iter().map(|&v| bits_of(v)).collect();
        // OpenGL numbers its targets in the order of the faces.
        let target = glow::TEXTURE_CUBE_MAP_POSITIVE_X + face as u32;
        gl.tex_image_2d(
            target,
            level,
            glow::RGBA16F,
            [map.size() as i32, map.size() as i32],
            Texels::f16(glow::RGBA, bytemuck::cast_slice(&halves)),
        );
    }
}

/// Filters across the edges of a cube's faces until it is dropped. OpenGL ES and WebGL always do.
pub(crate) struct Seamless<'a> {
    gl: &'a Gl,
}

impl<'a> Seamless<'a> {
    /// Enables it.
    pub fn new(gl: &'a Gl) -> Self {
        if !gl.is_embedded() {
            gl.enable(glow::TEXTURE_CUBE_MAP_SEAMLESS);
        }
        Seamless { gl }
    }
}

impl Drop for Seamless<'_> {
    fn drop(&mut self) {
        if !self.gl.is_embedded() {
            self.gl.disable(glow::TEXTURE_CUBE_MAP_SEAMLESS);
        }
    }
}

/// The largest half float, to which larger values are clamped.
pub const LARGEST: f32 = 65504.0;

/// The bits of the half float (IEEE 754 binary16) that is nearest to `value`; the even one of two. Values are clamped to
/// +-[`LARGEST`]; NaN becomes 0. Drivers that convert 32 bits themselves round in different ways, some towards zero, which
/// doubles the error.
pub fn bits_of(value: f32) -> u16 {
    if value.is_nan() {
        return 0;
    }
    let sign = ((value.to_bits() >> 16) & 0x8000) as u16;
    let size = value.abs().min(LARGEST);
    // Below 2^-14 halves are the multiples of 2^-24.
    if size < 1.0 / 16384.0 {
        return sign | (size * 16_777_216.0).round_ties_even() as u16;
    }
    // 13 bits of the fraction are dropped, and the bias of the exponent is 15 instead of 127. A carry of the fraction
    // increments the exponent, as it should.
    let bits = size.to_bits();
    let rounded = bits + 0x0fff + ((bits >> 13) & 1);
    sign | ((rounded >> 13) - ((127 - 15) << 10)) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value of a half, by the definition.
    fn value_of(bits: u16) -> f32 {
        let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f32::from(bits & 0x3ff));
        let size = match exponent {
            0 => fraction * 2.0_f32.powi(-24),
            e => (1024.0 + fraction) * 2.0_f32.powi(e - 25),
        };
        if bits & 0x8000 == 0 { size } else { -size }
    }

    #[test]
    fn every_half_is_itself_and_between_two_the_nearer_one_counts() {
        for bits in (0..0x7c00_u16).chain(0x8000..0xfc00) {
            let value = value_of(bits);
            assert_eq!(bits_of(value), bits, "{value}");
            let next = value_of(bits.wrapping_add(1));
            if bits & 0x7fff == 0x7bff {
                continue;
            }
            let middle = 0.5 * (value + next);
            assert_eq!(bits_of(middle), if bits & 1 == 0 { bits } else { bits + 1 }, "the even one at {middle}");
            assert_eq!(bits_of(value + 0.49 * (next - value)), bits, "above {value}");
            assert_eq!(bits_of(value + 0.51 * (next - value)), bits + 1, "below {next}");
        }
    }

    #[test]
    fn what_no_half_holds() {
        for (value, expected) in
            [(1e9, 0x7bff), (f32::INFINITY, 0x7bff), (-1e9, 0xfbff), (f32::NAN, 0), (65519.0, 0x7bff)]
        {
            assert_eq!(bits_of(value), expected, "{value}");
        }
    }
}
