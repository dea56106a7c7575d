//! A recording of a frame.

use super::data::FrameRecord;
use super::enums::TextureKind;
use super::recorder::{self, Recorder};
use super::thumbnails;
use crate::driver::DriverInfo;
use crate::{Gl, GlError};

/// Units that a recording begins by emptying: more than any of our programs, or of an exercise, reads.
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
        // What was wrong before is not this recording's.
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
        thumbnails::fill(&gl, &mut record)?;
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
