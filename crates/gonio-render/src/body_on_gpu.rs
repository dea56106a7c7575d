//! The inside of a clear object on the GPU: a [`BodyTable`] as a float texture.

use crate::body_tree::BodyTable;
use crate::glsl::BODY_ROW;
use gonio_gl::objects::TextureObject;
use gonio_gl::program::Program;
use gonio_gl::{Gl, GlError, Texels};
use gonio_light::{DVec3, Optics};

/// An object's own triangles for rays that go through it; freed when dropped.
pub(crate) struct BodyOnGpu {
    texture: TextureObject,
    table: BodyTable,
}

impl BodyOnGpu {
    /// Uploads a table; `None` where it has more rows than this driver's textures.
    pub fn upload(gl: &Gl, mut table: BodyTable, name: &str, max_size: u32) -> Result<Option<Self>, GlError> {
        let rows = table.texels.len().div_ceil(BODY_ROW);
        if rows > max_size as usize {
            return Ok(None);
        }
        table.texels.resize(rows * BODY_ROW, [0.0; 4]);
        let texture = TextureObject::bound(gl, &format!("inside of {name}"))?;
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::RGBA32F,
            [BODY_ROW as i32, rows as i32],
            Texels::f32(glow::RGBA, bytemuck::cast_slice(&table.texels)),
        );
        for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
        }
        table.texels = Vec::new();
        Ok(Some(BodyOnGpu { texture, table }))
    }

    /// Binds it to a texture unit.
    pub fn bind(&self, gl: &Gl, unit: u32) {
        gl.active_texture(glow::TEXTURE0 + unit);
        gl.bind_texture(glow::TEXTURE_2D, Some(self.texture.handle()));
    }

    /// Sets the uniforms of body.glsl.
    pub fn set(&self, program: &Program, optics: &Optics) {
        program.set_i32("body_nodes", self.table.nodes as i32);
        program.set_i32("body_corners", self.table.corners as i32);
        program.set_i32("body_normals", self.table.normals as i32);
        program.set_dvec3("body_center", self.table.center);
        program.set_f32("body_scale", self.table.scale as f32);
        // A product beyond f32 weakens light to nothing all the same, and 0 times it stays 0.
        let absorption = (optics.absorption / self.table.scale).min(DVec3::splat(1e30));
        program.set_dvec3("absorption_in_body", absorption);
    }
}
