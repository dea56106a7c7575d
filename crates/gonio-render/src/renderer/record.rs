//! Records all calls of a frame.

use super::output::{Band, DisplaySettings};
use super::shared::Shared;
use super::{PANES, Renderer};
use crate::scene_on_gpu::GpuScene;
use gonio_gl::GlError;
use gonio_gl::SavedState;
use gonio_gl::objects::DebugGroup;
use gonio_gl::target::{ColorPrecision, OutputTarget};
use gonio_gl::trace::{FrameRecord, Recording};
use gonio_scene::{Frame, ViewSpec};

impl Renderer {
    /// Draws the picture, or a debug view, as [`Renderer::render8`] does, but at once and not in bands, and records all its
    /// calls: the pass of the scene, the averaging of samples, the output pass. The picture itself is discarded. A window's
    /// state is left as [`Renderer::paint`] leaves it.
    pub fn record(&mut self, scene: &GpuScene, frame: &Frame, view: Option<ViewSpec>) -> Result<FrameRecord, GlError> {
        let shared = self.shared.clone();
        let _state = SavedState::save(&shared.gl);
        let (recording, _output) = self.recorded(scene, frame, view)?;
        let mut record = recording.recording.finish();
        self.shared.complete(&mut record, recording.notes);
        Ok(record)
    }

    /// Like [`Self::record`], with a thumbnail of each texture, for a window.
    pub fn record_with_thumbnails(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<FrameRecord, GlError> {
        let shared = self.shared.clone();
        let _state = SavedState::save(&shared.gl);
        let (recording, _output) = self.recorded(scene, frame, view)?;
        let mut record = recording.recording.finish_with_thumbnails()?;
        self.shared.complete(&mut record, recording.notes);
        Ok(record)
    }

    /// The target is kept until the thumbnails are drawn.
    fn recorded(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<(Recorded, OutputTarget), GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let recording = Recording::begin(gl)?;
        let mut notes = Vec::new();
        // Drawn again, so that they are in the record.
        scene.shadows.replace(None);
        let target = self.target_for(scene, frame, frame.height as i32, ColorPrecision::Half, PANES, &mut notes)?;
        {
            let _group = DebugGroup::new(gl, "scene");
            let shadows = self.shadow_maps(scene, frame, &mut notes)?;
            self.draw_scene(scene, frame, view, shadows.as_deref(), &target, 0)?;
        }
        target.resolve(gl);
        let rows = target.size[1];
        let output = OutputTarget::new(gl, target.size, false)?;
        let look = DisplaySettings::new(view, frame);
        let whole = Band { picture_height: rows, first_row: 0, rows };
        shared.output_into(&output, &target, whole, &look, look.encoded())?;
        Ok((Recorded { recording, notes }, output))
    }
}

struct Recorded {
    recording: Recording,
    notes: Vec<String>,
}

impl Shared {
    /// Adds notes, and the sources of programs that were compiled before the recording.
    fn complete(&self, record: &mut FrameRecord, notes: Vec<String>) {
        record.notes.splice(0..0, notes);
        let dialect = self.info.dialect;
        for program in record.programs.iter_mut().filter(|program| program.vertex_source.is_empty()) {
            let scenes = self.scene_programs.borrow();
            let outputs = self.output_programs.borrow();
            let sources = match program.id {
                id if self.sky.borrow().as_ref().is_some_and(|sky| sky.id() == id) => {
                    Some(crate::glsl::sky_sources(dialect))
                }
                id => {
                    let scene = scenes.iter().find(|(_, known)| known.id() == id).map(|(key, _)| key.sources(dialect));
                    let special = self.special_programs.borrow();
                    let special = special.iter().find(|(_, known)| known.id() == id);
                    scene.or_else(|| special.map(|(which, _)| which.sources(dialect))).or_else(|| {
                        outputs.iter().find(|(_, known)| known.id() == id).map(|(key, _)| key.sources(dialect))
                    })
                }
            };
            [program.vertex_source, program.fragment_source] = sources.unwrap_or_default();
        }
    }
}
