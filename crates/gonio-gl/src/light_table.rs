//! The lights of a frame, as uniforms or as a float texture: any number in one pass.

use crate::glsl::{LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT, LIGHT_TEXELS, LIGHTS_IN_UNIFORMS, LIGHTS_PER_ROW};
use crate::objects::TextureObject;
use crate::{Gl, GlError};
use glam::DVec3;
use glow::{HasContext, PixelUnpackData};
use gonio_light::{Light, LightKind, vector};

/// One light: `LIGHT_TEXELS` texels of four floats.
type Row = [[f32; 4]; LIGHT_TEXELS];

/// The lights of a frame: few are handed over as uniforms, many in a texture.
pub struct LightTable {
    texture: TextureObject,
    /// Lights in it: ambient ones are not.
    pub count: usize,
    /// Where they are few.
    few: Vec<Row>,
}

impl LightTable {
    /// An empty table.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let texture = TextureObject::bound(gl, "lights")?;
        // SAFETY: the texture is bound; it has one level and is read by texelFetch only.
        unsafe {
            for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
            }
            for parameter in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::CLAMP_TO_EDGE as i32);
            }
        }
        Ok(LightTable { texture, count: 0, few: Vec::new() })
    }

    /// Whether there are so many that they are in the texture.
    pub fn is_in_texture(&self) -> bool {
        self.count > LIGHTS_IN_UNIFORMS
    }

    /// The values of few lights, as `light_values` in lighting.glsl.
    pub fn uniforms(&self) -> &[[f32; 4]] {
        self.few.as_flattened()
    }

    /// Fills it; the texture stays bound to the active unit.
    pub fn fill(&mut self, gl: &Gl, lights: &[Light]) {
        let mut rows: Vec<Row> = lights.iter().filter_map(row_of).collect();
        self.count = rows.len();
        if !self.is_in_texture() {
            self.few = rows;
            return;
        }
        self.few.clear();
        let height = rows.len().div_ceil(LIGHTS_PER_ROW).max(1);
        // A single row may be narrower; WebGL2 has no limit from below.
        let width = if height == 1 { rows.len().max(1) } else { LIGHTS_PER_ROW };
        rows.resize(width * height, Row::default());
        // SAFETY: the slice holds width * height lights of LIGHT_TEXELS RGBA texels each.
        unsafe {
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture.handle()));
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 4);
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RGBA32F as i32,
                (width * LIGHT_TEXELS) as i32,
                height as i32,
                0,
                glow::RGBA,
                glow::FLOAT,
                PixelUnpackData::Slice(Some(bytemuck::cast_slice(&rows))),
            );
        }
    }

    /// The table's row of the scene's light `index`; `None` for ambient lights and beyond the end.
    pub fn row_of_light(lights: &[Light], index: usize) -> Option<usize> {
        let light = lights.get(index)?;
        (light.kind != LightKind::Ambient)
            .then(|| lights[..index].iter().filter(|l| l.kind != LightKind::Ambient).count())
    }
}

/// Place or direction and kind; colour; axis and cosine of the outer angle; attenuation and cosine of
/// the inner angle. `light_terms` in lighting.glsl reads this.
fn row_of(light: &Light) -> Option<Row> {
    let texel = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let a = light.attenuation;
    let attenuation = DVec3::new(a.constant, a.linear, a.quadratic);
    let color = texel(light.color, 0.0);
    match light.kind {
        LightKind::Ambient => None,
        LightKind::Directional { direction } => {
            Some([texel(direction_of(direction), f64::from(LIGHT_DIRECTIONAL)), color, [0.0; 4], texel(attenuation, 0.0)])
        }
        LightKind::Point { position } => {
            Some([texel(position, f64::from(LIGHT_POINT)), color, [0.0; 4], texel(attenuation, 0.0)])
        }
        LightKind::Spot { position, axis, inner_rad, outer_rad } => Some([
            texel(position, f64::from(LIGHT_SPOT)),
            color,
            texel(direction_of(axis), outer_rad.cos()),
            texel(attenuation, inner_rad.cos()),
        ]),
    }
}

/// At unit length, as the reference has it; zero where there is no direction.
fn direction_of(v: DVec3) -> DVec3 {
    vector::unit_or(v, DVec3::ZERO)
}
