//! Thumbnails of textures, drawn by the GPU, because WebGL2 cannot read textures back.

use super::Content;
use super::data::{FrameRecord, TextureRecord, Thumbnail};
use super::enums::TextureKind;
use crate::objects::VertexArray;
use crate::program::Program;
use crate::target::OutputTarget;
use crate::{Gl, GlError};
use glam::Vec2;

/// One triangle over the whole picture.
const VERTEX: &str = "void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
";
const FRAGMENT: &str = include_str!("../../shaders/thumbnail.frag");

/// Gives a record's 2-D textures and cubemaps a small picture each. Others, and those that have no texels, get none.
/// Colours in linear light are encoded, and what is brighter than white is white.
pub fn fill(gl: &Gl, record: &mut FrameRecord) -> Result<(), GlError> {
    let mut painter = Painter { gl, array: VertexArray::bound(gl, "thumbnails")?, programs: [None, None] };
    for texture in &mut record.textures {
        let found = gl.with_state(|state| {
            state
                .textures
                .iter()
                .find(|(_, state)| state.label.id == texture.id)
                .map(|(&handle, state)| (handle, state.kind, state.levels.keys().next().copied()))
        });
        if let Some((handle, Some(kind @ (TextureKind::Flat | TextureKind::Cube)), Some(_))) = found {
            texture.thumbnail = Some(painter.paint(handle, kind, texture)?);
        }
    }
    gl.bind_vertex_array(None);
    gl.use_program(None);
    Ok(())
}

struct Painter<'a> {
    gl: &'a Gl,
    array: VertexArray,
    programs: [Option<Program>; 2],
}

impl Painter<'_> {
    fn paint(
        &mut self,
        handle: glow::Texture,
        kind: TextureKind,
        texture: &TextureRecord,
    ) -> Result<Thumbnail, GlError> {
        let gl = self.gl;
        // A cubemap as a cross of 4 x 3 faces.
        let shape = if kind == TextureKind::Cube { [4, 3] } else { [texture.width.max(1), texture.height.max(1)] };
        let longer = shape[0].max(shape[1]);
        let most = if kind == TextureKind::Cube { Thumbnail::MOST } else { Thumbnail::MOST.min(longer) };
        let size = shape.map(|side| ((side * most + longer / 2) / longer).max(1));
        let output = OutputTarget::new(gl, size.map(|side| side as i32), false)?;
        let slot = &mut self.programs[usize::from(kind == TextureKind::Cube)];
        if slot.is_none() {
            let dialect = gl.dialect();
            let define = if kind == TextureKind::Cube { "#define CUBE 1\n" } else { "#define CUBE 0\n" };
            let fragment = [dialect.header(), define, FRAGMENT].concat();
            *slot = Some(Program::new(gl, "thumbnail", &[dialect.header(), VERTEX].concat(), &fragment, &[])?);
        }
        let Some(program) = slot else { return Err(GlError::new("no program for thumbnails")) };
        output.bind(gl);
        program.bind();
        program.set_i32("source", 0);
        program.set_vec2("picture_size", Vec2::new(size[0] as f32, size[1] as f32));
        // The level about as large as the picture; only where it has it.
        let scale = (texture.width.max(texture.height) / most.max(1)).max(1);
        let wanted = if kind == TextureKind::Cube { (scale * 4).ilog2() } else { scale.ilog2() };
        let level = texture.levels.iter().map(|level| level.level).filter(|level| *level <= wanted).max();
        program.set_f32("level", level.unwrap_or(0) as f32);
        program.set_i32("signed_halves", (texture.content == Content::SignedHalves).into());
        program.set_i32("encodes", is_linear(texture).into());
        program.set_i32("opaque", (texture.content == Content::Plain && texture.format.ends_with('F')).into());
        gl.viewport(0, 0, size[0] as i32, size[1] as i32);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.disable(glow::SCISSOR_TEST);
        gl.active_texture(glow::TEXTURE0);
        gl.bind_texture(kind.target(), Some(handle));
        let filter = gl.get_tex_parameter_i32(kind.target(), glow::TEXTURE_MIN_FILTER);
        if texture.levels.len() == 1 {
            // It may lack the mipmaps that its filter wants, and would be black.
            gl.tex_parameter_i32(kind.target(), glow::TEXTURE_MIN_FILTER, glow::NEAREST as i32);
        }
        gl.bind_vertex_array(Some(self.array.handle()));
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.tex_parameter_i32(kind.target(), glow::TEXTURE_MIN_FILTER, filter);
        gl.bind_texture(kind.target(), None);
        Ok(Thumbnail { width: size[0], height: size[1], rgba: output.read8(gl) })
    }
}

/// Whether texels are light in linear numbers when a shader reads them: sRGB formats are decoded, floats are linear.
fn is_linear(texture: &TextureRecord) -> bool {
    texture.content == Content::Plain && (texture.format.starts_with("SRGB") || texture.format.ends_with('F'))
}
