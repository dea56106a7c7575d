//! A recording of a frame, and thumbnails of its textures, drawn by the GPU because WebGL2 cannot read textures back.

use super::TexelEncoding;
use super::data::{FrameRecord, TextureRecord, Thumbnail};
use super::enums::TextureKind;
use super::recorder::{self, Recorder};
use crate::driver::DriverInfo;
use crate::objects::VertexArray;
use crate::program::Program;
use crate::target::OutputTarget;
use crate::{Gl, GlError};
use glam::Vec2;

/// Units that a recording empties at its start: more than any program of gonio or of an exercise reads.
const UNITS_EMPTIED: u32 = 32;

/// Records until it is finished or dropped.
pub struct Recording {
    gl: Gl,
}

impl Recording {
    /// Begins to record every call through `gl` and its clones. Units are emptied and no program is in use, so that the record
    /// shows if a draw relies on earlier state.
    ///
    /// # Errors
    ///
    /// Another recording is running.
    pub fn begin(gl: &Gl) -> Result<Self, GlError> {
        if gl.with_state(|state| state.is_recording) {
            return Err(GlError::new("another recording is running; finish it first"));
        }
        let counts = DriverInfo::new(gl).pipeline_statistics;
        let recorder = Recorder::new(gl.functions(), counts);
        let units = recorder.record.texture_units.min(UNITS_EMPTIED);
        for unit in (0..units).rev() {
            gl.active_texture(glow::TEXTURE0 + unit);
            let kinds = TextureKind::ALL.into_iter().filter(|k| *k != TextureKind::Multisample || !gl.is_embedded());
            kinds.for_each(|kind| gl.bind_texture(kind.target(), None));
        }
        gl.use_program(None);
        // Earlier errors do not belong to this recording.
        recorder::errors(gl.functions());
        gl.with_state(|state| {
            state.forget_recording();
            state.programs.values_mut().for_each(|program| program.is_fresh = false);
        });
        gl.exchange_recorder(Some(Box::new(recorder)));
        Ok(Recording { gl: gl.clone() })
    }

    /// Ends, and returns the record.
    pub fn finish(self) -> FrameRecord {
        let Some(recorder) = self.gl.exchange_recorder(None) else { return FrameRecord::default() };
        self.gl.with_state(|state| {
            let record = recorder.finish(state, self.gl.functions());
            state.forget_recording();
            record
        })
    }

    /// Ends, and returns the record with thumbnails of all textures that can have one.
    pub fn finish_with_thumbnails(self) -> Result<FrameRecord, GlError> {
        let gl = self.gl.clone();
        let mut record = self.finish();
        fill_thumbnails(&gl, &mut record)?;
        Ok(record)
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        if let Some(recorder) = self.gl.exchange_recorder(None) {
            recorder.abandon(self.gl.functions());
            self.gl.with_state(|state| state.forget_recording());
        }
    }
}

/// One triangle over the whole picture.
const VERTEX: &str = "void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
";
const FRAGMENT: &str = include_str!("../../shaders/thumbnail.frag");

/// Adds thumbnails of 2-D textures and cubemaps that have texels. Colours in linear light are encoded, and clamped to white.
fn fill_thumbnails(gl: &Gl, record: &mut FrameRecord) -> Result<(), GlError> {
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

/// Draws thumbnails.
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
        let finest = if kind == TextureKind::Cube { (scale * 4).ilog2() } else { scale.ilog2() };
        let level = texture.levels.iter().map(|level| level.level).filter(|level| *level <= finest).max();
        program.set_f32("level", level.unwrap_or(0) as f32);
        program.set_i32("signed_halves", (texture.content == TexelEncoding::SignedHalves).into());
        program.set_i32("encodes", is_linear(texture).into());
        program.set_i32("opaque", (texture.content == TexelEncoding::Plain && texture.format.ends_with('F')).into());
        gl.viewport(0, 0, size[0] as i32, size[1] as i32);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.disable(glow::SCISSOR_TEST);
        gl.active_texture(glow::TEXTURE0);
        gl.bind_texture(kind.target(), Some(handle));
        let filter = gl.get_tex_parameter_i32(kind.target(), glow::TEXTURE_MIN_FILTER);
        if texture.levels.len() == 1 {
            // It may lack the mipmaps that its filter needs, and would be black.
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
    texture.content == TexelEncoding::Plain && (texture.format.starts_with("SRGB") || texture.format.ends_with('F'))
}
