//! Textures for programs that somebody else wrote.

use gonio_gl::objects::TextureObject;
use gonio_gl::{Gl, GlError, Texels};

/// A texture of float texels, filtered linearly, without smaller copies.
pub struct FloatTexture {
    gl: Gl,
    object: TextureObject,
    target: u32,
}

impl FloatTexture {
    /// A 2-D texture that repeats; rows from the bottom.
    pub fn flat(gl: &Gl, size: [usize; 2], rgba: &[[f32; 4]], name: &str) -> Result<Self, GlError> {
        let object = TextureObject::bound(gl, name)?;
        fill(gl, glow::TEXTURE_2D, size, rgba, name)?;
        finish(gl, glow::TEXTURE_2D, glow::REPEAT);
        Ok(FloatTexture { gl: gl.clone(), object, target: glow::TEXTURE_2D })
    }

    /// A panorama: repeated along its rows, held at its first and its last one. The first row lies at t = 0.
    pub fn panorama(gl: &Gl, size: [usize; 2], rgba: &[[f32; 4]], name: &str) -> Result<Self, GlError> {
        let panorama = Self::flat(gl, size, rgba, name)?;
        gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE as i32);
        Ok(panorama)
    }

    /// A cubemap: six faces +X -X +Y -Y +Z -Z in OpenGL's layout, each with the rows from t = 0.
    pub fn cube(gl: &Gl, side: usize, faces: &[Vec<[f32; 4]>; 6], name: &str) -> Result<Self, GlError> {
        let object = TextureObject::cube(gl, name)?;
        for (target, face) in (glow::TEXTURE_CUBE_MAP_POSITIVE_X..).zip(faces) {
            fill(gl, target, [side, side], face, name)?;
        }
        finish(gl, glow::TEXTURE_CUBE_MAP, glow::CLAMP_TO_EDGE);
        Ok(FloatTexture { gl: gl.clone(), object, target: glow::TEXTURE_CUBE_MAP })
    }

    /// Binds it to a unit.
    pub fn bind(&self, unit: u32) {
        self.gl.active_texture(glow::TEXTURE0 + unit.min(15));
        self.gl.bind_texture(self.target, Some(self.object.handle()));
    }
}

/// Half floats, which every driver filters.
fn fill(gl: &Gl, target: u32, [w, h]: [usize; 2], rgba: &[[f32; 4]], name: &str) -> Result<(), GlError> {
    if rgba.len() != w * h {
        return Err(GlError::new(format!("{name}: {} texels are not {w} x {h}", rgba.len())));
    }
    gl.tex_image_2d(target, 0, glow::RGBA16F, [w as i32, h as i32], Texels::f32(glow::RGBA, rgba.as_flattened()));
    Ok(())
}

fn finish(gl: &Gl, target: u32, wrap: u32) {
    let parameters = [
        (glow::TEXTURE_MIN_FILTER, glow::LINEAR),
        (glow::TEXTURE_MAG_FILTER, glow::LINEAR),
        (glow::TEXTURE_WRAP_S, wrap),
        (glow::TEXTURE_WRAP_T, wrap),
    ];
    for (parameter, value) in parameters {
        gl.tex_parameter_i32(target, parameter, value as i32);
    }
}
