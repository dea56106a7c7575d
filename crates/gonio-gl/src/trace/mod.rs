//! The frame taken apart: what OpenGL was told, as data that can be read, printed and checked.
//!
//! All calls go through [`crate::Gl`], which notes what exists and what is bound. While a [`Recording`] runs, each draw is
//! noted with all that it reads: program, uniforms and their values, samplers, the units they read, and the textures
//! there. [`lint`] looks through the record for what is wrong. It works wherever gonio draws, WebGL2 included, and on
//! any sequence of calls: `Renderer::record` is one, a student's exercise another.
//!
//! Nothing is recorded, and nothing looked up, while no recording runs.

mod complete;
mod data;
mod hooks;
mod hooks_programs;
mod lint;
mod program_reader;
mod recorder;
mod snapshot;
mod state;
mod thumbnails;
pub mod words;

pub use data::{
    ArraySource, AttachmentRecord, AttributeDeclaration, AttributeRecord, AttributeSource, BindingRecord, BlendRecord,
    ClearRecord, Content, DrawRecord, FrameRecord, LevelRecord, Numbers, PassRecord, ProgramRecord, SamplerRecord,
    SamplingRecord, StateRecord, Subject, TargetRecord, TextureRecord, Thumbnail, UniformDeclaration, UniformValue,
};
pub use lint::{Finding, Rule, Severity, lint};
pub(crate) use state::Mirror;

use crate::driver::DriverInfo;
use crate::{Gl, GlError};
use glow::HasContext;
use recorder::Recorder;
use words::TextureKind;

/// Most draw calls that a record lists; more are counted. A model of transparent triangles may have one draw for each.
pub const MOST_DRAWS: usize = 2000;
/// Units that a recording begins by emptying: more than any of our programs, or of an exercise, reads.
const UNITS_EMPTIED: u32 = 32;

/// Records until it is finished or dropped.
pub struct Recording {
    gl: Gl,
}

impl Recording {
    /// Begins: from here on every call through `gl` and its clones is noted. Units are emptied and no program is in use,
    /// so that a draw that relies on what somebody left behind shows it.
    ///
    /// An error where another recording runs.
    pub fn begin(gl: &Gl) -> Result<Self, GlError> {
        if gl.mirror().with(|state| state.recorder.is_some()) {
            return Err(GlError::new("a frame is being recorded already; finish that recording first"));
        }
        let counts = DriverInfo::of(gl).pipeline_statistics;
        let recorder = Recorder::new(gl.functions(), counts);
        let units = recorder.record.texture_units.min(UNITS_EMPTIED);
        // SAFETY: unbinding has no precondition; the units exist. OpenGL ES 3.0 knows no multisampled textures.
        unsafe {
            for unit in (0..units).rev() {
                gl.active_texture(glow::TEXTURE0 + unit);
                let kinds = TextureKind::ALL
                    .into_iter()
                    .filter(|k| *k != TextureKind::Multisample || !gl.version().is_embedded);
                kinds.for_each(|kind| gl.bind_texture(kind.target(), None));
            }
            gl.use_program(None);
        }
        // What was wrong before is not this recording's.
        recorder::errors(gl.functions());
        gl.mirror().with(|state| {
            for program in state.programs.values_mut() {
                program.is_fresh = false;
            }
            state.recorder = Some(Box::new(recorder));
        });
        Ok(Recording { gl: gl.clone() })
    }

    /// Ends, and gives what was recorded.
    pub fn finish(self) -> FrameRecord {
        let gl = self.gl.clone();
        gl.mirror().with(|state| match state.recorder.take() {
            Some(recorder) => {
                state.shaders.clear();
                recorder.finish(state, gl.functions())
            }
            None => FrameRecord::default(),
        })
    }

    /// Ends, and gives what was recorded with small pictures of all textures that can have one.
    pub fn finish_with_thumbnails(self) -> Result<FrameRecord, GlError> {
        let gl = self.gl.clone();
        let mut record = self.finish();
        thumbnails::fill(&gl, &mut record)?;
        Ok(record)
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        self.gl.mirror().with(|state| {
            if let Some(recorder) = state.recorder.take() {
                recorder.abandon(self.gl.functions());
            }
        });
    }
}
