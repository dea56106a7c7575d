//! Builds the record of a frame from calls.

use super::data::{
    AttachmentRecord, ClearRecord, FrameRecord, LevelRecord, MOST_DRAWS, PassRecord, TargetRecord, TextureRecord,
};
use super::enums::{self, TextureKind};
use super::object_state::{Attached, TextureState};
use super::program_reader::ProgramInterface;
use super::state::State;
use crate::bounds::DrawCall;
use crate::functions::{FRAGMENT_SHADER_INVOCATIONS, Functions, VERTEX_SHADER_INVOCATIONS};
use std::collections::HashMap;

/// Most errors that are fetched at once: a driver may keep several flags, and a lost context returns errors without end.
const MOST_ERRORS: usize = 8;

/// Notes calls. A trait, so that a program that records nothing does not contain [`Recorder`]: it would be a twentieth of the
/// module that draws the page's first picture.
pub trait Record {
    /// Opens a debug group.
    fn enter_group(&mut self, name: &str);
    /// Closes it.
    fn leave_group(&mut self);
    /// Notes a clear.
    fn cleared(&mut self, state: &State, gl: &Functions, mask: u32);
    /// Notes that samples are averaged into the framebuffer that is drawn into.
    fn resolved(&mut self, state: &State);
    /// Notes everything that a draw will read, and starts counting.
    fn before_draw(&mut self, state: &mut State, gl: &Functions, call: &DrawCall);
    /// Stops counting, and fetches errors.
    fn after_draw(&mut self, gl: &Functions);
    /// Returns the record. Waits for the counters of the GPU.
    fn finish(self: Box<Self>, state: &State, gl: &Functions) -> FrameRecord;
    /// Deletes the counters.
    fn abandon(self: Box<Self>, gl: &Functions);
}

/// A recording in progress.
pub struct Recorder {
    pub(super) record: FrameRecord,
    /// Open debug groups.
    pub groups: Vec<String>,
    /// Programs that have drawn.
    pub(super) interfaces: HashMap<glow::Program, ProgramInterface>,
    /// Whether the GPU can count.
    counts: bool,
    /// Whether a buffer's bytes can be read back.
    pub(super) reads_buffers: bool,
    queries: Vec<Option<[glow::Query; 2]>>,
    /// The framebuffer of the last pass, and its outermost group.
    pass: Option<(Option<glow::Framebuffer>, Option<String>)>,
    /// Whether a recorded draw is in progress.
    drawing: bool,
}

impl Recorder {
    /// Creates a recorder; `counts` tells whether the driver can count shader invocations.
    pub fn new(gl: &Functions, counts: bool) -> Self {
        let texture_units = gl.get_parameter_i32(glow::MAX_COMBINED_TEXTURE_IMAGE_UNITS).max(0) as u32;
        Recorder {
            record: FrameRecord { texture_units, ..FrameRecord::default() },
            groups: Vec::new(),
            interfaces: HashMap::new(),
            counts,
            // OpenGL ES has no glGetBufferSubData; WebGL2 has.
            reads_buffers: cfg!(target_arch = "wasm32") || !gl.is_embedded(),
            queries: Vec::new(),
            pass: None,
            drawing: false,
        }
    }

    /// The pass that commands belong to now.
    fn enter_pass(&mut self, state: &State) -> &mut PassRecord {
        let now = (state.draw_framebuffer, self.groups.first().cloned());
        let passes = &mut self.record.passes;
        if passes.is_empty() || self.pass.as_ref() != Some(&now) {
            let target = target_record(state);
            let name = now.1.clone().unwrap_or_else(|| target.name.clone());
            let first_draw = self.record.draws.len();
            passes.push(PassRecord { name, target, cleared: None, resolved_into: None, first_draw, draw_count: 0 });
            self.pass = Some(now);
        }
        let last = passes.len() - 1;
        &mut passes[last]
    }
}

impl Record for Recorder {
    fn enter_group(&mut self, name: &str) {
        self.groups.push(name.to_owned());
    }

    fn leave_group(&mut self) {
        self.groups.pop();
    }

    fn cleared(&mut self, state: &State, gl: &Functions, mask: u32) {
        let mut clear = ClearRecord::default();
        if mask & glow::COLOR_BUFFER_BIT != 0 {
            clear.color = Some(gl.get_clear_color());
        }
        if mask & glow::DEPTH_BUFFER_BIT != 0 {
            clear.depth = Some(gl.get_clear_depth());
        }
        self.enter_pass(state).cleared = Some(clear);
    }

    fn resolved(&mut self, state: &State) {
        let name = target_record(state).name;
        if let Some(pass) = self.record.passes.last_mut() {
            pass.resolved_into = Some(name);
        }
    }

    fn before_draw(&mut self, state: &mut State, gl: &Functions, call: &DrawCall) {
        self.drawing = self.record.draws.len() < MOST_DRAWS;
        if !self.drawing {
            self.record.draws_left_out += 1;
            return;
        }
        self.enter_pass(state).draw_count += 1;
        let draw = self.snapshot(state, gl, call);
        self.record.draws.push(draw);
        // No other counters run during a recording.
        let queries = match (self.counts, gl.create_query(), gl.create_query()) {
            (true, Ok(vertices), Ok(fragments)) => {
                gl.begin_query(VERTEX_SHADER_INVOCATIONS, vertices);
                gl.begin_query(FRAGMENT_SHADER_INVOCATIONS, fragments);
                Some([vertices, fragments])
            }
            (_, vertices, fragments) => {
                [vertices, fragments].into_iter().flatten().for_each(|query| gl.delete_query(query));
                None
            }
        };
        self.queries.push(queries);
    }

    fn after_draw(&mut self, gl: &Functions) {
        if !std::mem::take(&mut self.drawing) {
            return;
        }
        if self.queries.last().is_some_and(Option::is_some) {
            gl.end_query(FRAGMENT_SHADER_INVOCATIONS);
            gl.end_query(VERTEX_SHADER_INVOCATIONS);
        }
        if let Some(draw) = self.record.draws.last_mut() {
            draw.errors.extend(errors(gl));
        }
    }

    fn finish(mut self: Box<Self>, state: &State, gl: &Functions) -> FrameRecord {
        for (draw, queries) in self.record.draws.iter_mut().zip(std::mem::take(&mut self.queries)) {
            let Some(queries) = queries else { continue };
            let [vertices, fragments] = queries.map(|query| {
                let count = gl.get_query_parameter_u32(query, glow::QUERY_RESULT);
                gl.delete_query(query);
                u64::from(count)
            });
            draw.vertices_shaded = Some(vertices);
            draw.fragments_shaded = Some(fragments);
        }
        let mut textures: Vec<TextureRecord> = state.textures.values().map(texture_record).collect();
        textures.sort_by_key(|texture| texture.id);
        textures.extend(state.deleted_textures.iter().map(texture_record));
        self.record.textures = textures;
        if self.record.draws_left_out > 0 {
            self.record.notes.push(format!(
                "the first {MOST_DRAWS} draw calls are listed; {} more are not",
                self.record.draws_left_out
            ));
        }
        let late = errors(gl);
        if !late.is_empty() {
            self.record.notes.push(format!("OpenGL reported {} after the last draw", late.join(", ")));
        }
        self.record
    }

    fn abandon(self: Box<Self>, gl: &Functions) {
        for query in self.queries.into_iter().flatten().flatten() {
            gl.delete_query(query);
        }
    }
}

/// Fetches all errors of OpenGL.
pub fn errors(gl: &Functions) -> Vec<String> {
    let mut errors = Vec::new();
    while errors.len() < MOST_ERRORS {
        match gl.get_error() {
            glow::NO_ERROR => break,
            code => errors.push(enums::error(code)),
        }
    }
    errors
}

/// The framebuffer that is drawn into.
fn target_record(state: &State) -> TargetRecord {
    let Some(framebuffer) = state.draw_framebuffer else {
        return TargetRecord { name: "window".to_owned(), samples: 1, ..TargetRecord::default() };
    };
    let mut record = TargetRecord { samples: 1, ..TargetRecord::default() };
    let Some(framebuffer) = state.framebuffers.get(&framebuffer) else { return record };
    record.id = framebuffer.label.id;
    record.name = framebuffer.label.name.clone();
    for (point, attached) in &framebuffer.attachments {
        let (texture, level, name, format, size, samples) = match attached {
            Attached::Texture(texture, level) => {
                let Some(texture) = state.textures.get(texture) else { continue };
                let size = texture.levels.get(level).map_or([0; 2], |level| level.size);
                (Some(texture.label.id), *level, &texture.label.name, texture.format, size, texture.samples)
            }
            Attached::Renderbuffer(buffer) => {
                let Some(buffer) = state.renderbuffers.get(buffer) else { continue };
                (None, 0, &buffer.label.name, buffer.format, buffer.size, buffer.samples)
            }
        };
        let format = enums::format(format);
        [record.width, record.height] = size;
        record.samples = samples.max(1);
        if *point == glow::COLOR_ATTACHMENT0 {
            record.format = Some(format.clone());
        }
        let point = enums::attachment(*point);
        record.attachments.push(AttachmentRecord { point, texture, level, name: name.clone(), format });
    }
    record
}

/// The record of a texture in its current state.
pub(super) fn texture_record(texture: &TextureState) -> TextureRecord {
    let [width, height] = texture.levels.values().next().map_or([0; 2], |level| level.size);
    let level = |(&level, state): (&u32, &super::object_state::LevelState)| LevelRecord {
        level,
        width: state.size[0],
        height: state.size[1],
        faces: state.faces.count_ones(),
    };
    TextureRecord {
        id: texture.label.id,
        name: texture.label.name.clone(),
        kind: texture.kind.map_or("", TextureKind::name).to_owned(),
        width,
        height,
        depth: texture.depth.max(1),
        samples: texture.samples.max(1),
        format: if texture.levels.is_empty() { String::new() } else { enums::format(texture.format) },
        levels: texture.levels.iter().map(level).collect(),
        content: texture.content,
        thumbnail: None,
    }
}
