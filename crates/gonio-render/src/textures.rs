//! Textures on the GPU: sRGB colours decoded by the hardware, mipmapped, anisotropic.

use crate::glsl::MERL_WIDTH;
use gonio_bsdf::MerlTable;
use gonio_gl::objects::TextureObject;
use gonio_gl::trace::TexelEncoding;
use gonio_gl::{Gl, GlError, Texels};
use gonio_mesh::Wrap;
use gonio_scene::{ColorSpace, Texture, TextureFilter};

/// Most samples along the longer axis of a footprint.
const MAX_ANISOTROPY: f32 = 16.0;

/// Uploads a texture; v = 0 is its bottom row.
///
/// Data (normals, exponents, opacity) is stored as `2 t - 1` in half floats, which `data_texel` in material.glsl inverts: some
/// drivers filter 8-bit textures with 8-bit results, which shows as steps in highlights, and signed half floats are most precise
/// around the usual directions of normal maps.
pub fn upload(gl: &Gl, texture: &Texture, max_size: u32) -> Result<TextureObject, GlError> {
    check_size(texture, max_size)?;
    let object = TextureObject::bound(gl, &texture.name)?;
    let storage = match texture.color_space {
        ColorSpace::Srgb => Storage::Srgb,
        ColorSpace::Data => Storage::Signed,
    };
    if storage == Storage::Signed {
        gl.note_content(TexelEncoding::SignedHalves);
    }
    upload_levels(gl, storage, texture);
    Ok(object)
}

/// Uploads a texture as a user's shader reads it: the bytes of the file, 0 to 255 as 0 to 1, whatever they mean.
pub fn upload_bytes(gl: &Gl, texture: &Texture, max_size: u32) -> Result<TextureObject, GlError> {
    check_size(texture, max_size)?;
    let object = TextureObject::bound(gl, &texture.name)?;
    upload_levels(gl, Storage::Bytes, texture);
    Ok(object)
}

/// Uploads a measured BRDF: a cell is a texel, in rows of [`MERL_WIDTH`].
pub fn upload_merl(gl: &Gl, table: &MerlTable) -> Result<TextureObject, GlError> {
    let object = TextureObject::bound(gl, "measured BRDF")?;
    let texels = table.texels();
    let size = [MERL_WIDTH as i32, texels.len().div_ceil(MERL_WIDTH) as i32];
    gl.tex_image_2d(glow::TEXTURE_2D, 0, glow::RGBA32F, size, Texels::f32(glow::RGBA, bytemuck::cast_slice(&texels)));
    for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
    }
    Ok(object)
}

/// The form of texels on the GPU.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Storage {
    /// Colours, decoded when they are read.
    Srgb,
    /// `2 t - 1` in half floats.
    Signed,
    /// 0 to 1.
    Bytes,
}

fn upload_levels(gl: &Gl, storage: Storage, texture: &Texture) {
    upload_level(gl, storage, 0, [texture.width, texture.height], &texture.rgba);
    // The mipmaps of the reference: drivers round differently, and some do not average in linear light.
    for (level, mip) in texture.mip_levels().iter().enumerate() {
        upload_level(gl, storage, level as i32 + 1, [mip.width, mip.height], &mip.rgba);
    }
}

fn check_size(texture: &Texture, max_size: u32) -> Result<(), GlError> {
    if texture.width <= max_size && texture.height <= max_size {
        return Ok(());
    }
    Err(GlError::new(format!(
        "{}: {} x {} texels exceed the driver's limit of {max_size} along a side; reduce the picture",
        texture.name, texture.width, texture.height
    )))
}

/// Fills one level of the bound texture from rows that begin at the top.
fn upload_level(gl: &Gl, storage: Storage, level: i32, size: [u32; 2], rgba: &[u8]) {
    let flipped = rgba.chunks_exact(size[0] as usize * 4).rev().flatten();
    let fill = |format: u32, texels: Texels<'_>| {
        gl.tex_image_2d(glow::TEXTURE_2D, level, format, size.map(|side| side as i32), texels);
    };
    match storage {
        Storage::Srgb | Storage::Bytes => {
            let texels: Vec<u8> = flipped.copied().collect();
            let format = if storage == Storage::Srgb { glow::SRGB8_ALPHA8 } else { glow::RGBA8 };
            fill(format, Texels::u8(glow::RGBA, &texels));
        }
        Storage::Signed => {
            let signed: Vec<f32> = flipped.map(|&t| f32::from(t) / 127.5 - 1.0).collect();
            fill(glow::RGBA16F, Texels::f32(glow::RGBA, &signed));
        }
    }
}

/// Creates a 1x1 white texture for the units of missing textures.
pub fn white(gl: &Gl) -> Result<TextureObject, GlError> {
    let texture = Texture::new("white", 1, 1, vec![255; 4], ColorSpace::Data);
    upload(gl, &texture, 1)
}

/// Sets the sampling parameters of the texture that is bound to the active unit.
pub fn set_sampling(gl: &Gl, filter: TextureFilter, wraps: [Wrap; 2], anisotropy: bool) {
    let (minify, magnify) = match filter {
        TextureFilter::Nearest => (glow::NEAREST, glow::NEAREST),
        TextureFilter::Linear => (glow::LINEAR, glow::LINEAR),
        TextureFilter::Mipmap | TextureFilter::Anisotropic => (glow::LINEAR_MIPMAP_LINEAR, glow::LINEAR),
    };
    let [wrap_s, wrap_t] = wraps.map(|wrap| match wrap {
        Wrap::Repeat => glow::REPEAT,
        Wrap::Clamp => glow::CLAMP_TO_EDGE,
        Wrap::Mirror => glow::MIRRORED_REPEAT,
    });
    for (parameter, value) in [
        (glow::TEXTURE_MIN_FILTER, minify),
        (glow::TEXTURE_MAG_FILTER, magnify),
        (glow::TEXTURE_WRAP_S, wrap_s),
        (glow::TEXTURE_WRAP_T, wrap_t),
    ] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, value as i32);
    }
    if anisotropy {
        let level = if filter == TextureFilter::Anisotropic { MAX_ANISOTROPY } else { 1.0 };
        gl.tex_parameter_f32(glow::TEXTURE_2D, glow::TEXTURE_MAX_ANISOTROPY_EXT, level);
    }
}
