//! Executes OpenGL programs that are given as lists of calls, right or wrong.
//!
//! A call that OpenGL refuses is reported with its line. A call that OpenGL leaves undefined, such as reading beyond a buffer,
//! is reported and not made. All other calls are made. Objects have the numbers that OpenGL gives them in a
//! program that is alone in its context (1, 2, 3, ...), and no number refers to an object of other code.

mod call;
mod errors;
mod files;
mod run;
mod state;

pub use call::{
    CONSTANTS, Constant, GlCall, IntArgument, ObjectKind, Pointer, Selector, Step, UniformArgument, constant,
    texture_unit,
};
pub use errors::{CallError, MOST_VERTICES};
pub use files::{GlProgramFiles, GlProgramImage, MOST_TEXELS};

use crate::user_program::BrokenProgram;
use gonio_gl::SavedState;
use gonio_gl::target::OutputTarget;
use gonio_gl::trace::{Finding, FrameRecord, Recording, lint};
use gonio_gl::{Gl, GlError};
use run::Runner;
use std::fmt;

/// Most bytes of all buffers of a program.
pub const MOST_BUFFER_BYTES: usize = 64 << 20;
/// Most bytes of all textures of a program.
pub const MOST_TEXEL_BYTES: usize = 256 << 20;
/// Attributes that every OpenGL has.
const ATTRIBUTES: u32 = 16;
/// Units that are emptied when it is done.
const UNITS: u32 = 32;
/// Errors that a driver may have kept.
const MOST_ERRORS: usize = 8;

/// Options of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlProgramOptions {
    /// Pixels of its window.
    pub size: [u32; 2],
    /// Whether a pixel holds floats instead of 8 bits a channel.
    pub float: bool,
    /// Whether the record has small pictures of the textures.
    pub thumbnails: bool,
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct GlProgramRun {
    /// Pixels along x and y.
    pub size: [u32; 2],
    /// RGBA from 0 to 1 (more if `float` was set), the bottom row first. Pixels that were neither drawn nor cleared are black.
    pub pixels: Vec<[f32; 4]>,
    /// Calls that were refused, in order.
    pub errors: Vec<CallError>,
    /// The record of its draws. Their errors are those of the calls before them.
    pub record: FrameRecord,
    /// The mistakes in the record.
    pub findings: Vec<Finding>,
    /// The line of each draw of the record.
    pub draw_lines: Vec<u32>,
}

/// The reason why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GlProgramFailure {
    /// A missing file.
    MissingFile {
        /// The line of the program.
        line: u32,
        /// Its name.
        file: String,
    },
    /// Shaders that do not compile or link.
    Shaders {
        /// The line of the program.
        line: u32,
        /// The vertex shader's file.
        vertex: String,
        /// The fragment shader's file.
        fragment: String,
        /// The messages of the compiler.
        broken: Box<BrokenProgram>,
    },
    /// An error of OpenGL before the first call.
    Driver(GlError),
}

impl GlProgramFailure {
    fn missing(step: &Step, file: &str) -> Self {
        GlProgramFailure::MissingFile { line: step.line, file: file.to_owned() }
    }
}

impl From<GlError> for GlProgramFailure {
    fn from(error: GlError) -> Self {
        GlProgramFailure::Driver(error)
    }
}

impl fmt::Display for GlProgramFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GlProgramFailure::MissingFile { line, file } => write!(f, "line {line}: there is no file `{file}`"),
            GlProgramFailure::Shaders { line, vertex, fragment, broken } => {
                write!(f, "line {line}: `{vertex}` and `{fragment}` do not form a program: {broken}")
            }
            GlProgramFailure::Driver(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for GlProgramFailure {}

/// Executes a program, from the state of a new context to the picture. Leaves a window's state as
/// `Renderer::paint` does, and units empty.
pub fn run(
    gl: &Gl,
    steps: &[Step],
    files: &GlProgramFiles,
    options: GlProgramOptions,
) -> Result<GlProgramRun, GlProgramFailure> {
    let size = options.size.map(|side| side.clamp(1, MOST_TEXELS));
    let _saved = SavedState::save(gl);
    let _emptied = EmptyUnits { gl };
    // Made by the other `Gl`: the program takes it for its window.
    let mut window = OutputTarget::new(gl, size.map(|side| side as i32), options.float)?;
    let apart = gl.apart();
    let recording = Recording::begin(&apart)?;
    window.begin_with_depth(gl)?;
    begin_anew(gl, size.map(|side| side as i32));
    let mut runner = Runner::new(apart, files);
    for step in steps {
        runner.step(step)?;
    }
    let pixels = match options.float {
        true => window.read_f32(gl),
        false => window.read8(gl).into_iter().map(|byte| f32::from(byte) / 255.0).collect(),
    };
    let mut record = if options.thumbnails { recording.finish_with_thumbnails()? } else { recording.finish() };
    // A recorder does not know how large a window is.
    for target in record.passes.iter_mut().map(|pass| &mut pass.target).filter(|target| target.id == 0) {
        [target.width, target.height] = size;
    }
    let draw_lines = runner.draws.iter().map(|(line, _)| *line).collect();
    let errors = merge(&mut record, &runner, steps);
    let findings = lint(&record);
    let pixels = pixels.as_chunks::<4>().0.to_vec();
    Ok(GlProgramRun { size, pixels, errors, record, findings, draw_lines })
}

/// Errors that draws raised become those of their lines, and those of the calls before become the draws'.
fn merge(record: &mut FrameRecord, runner: &Runner<'_>, steps: &[Step]) -> Vec<CallError> {
    let mut errors = Vec::new();
    let mut merged = 0;
    for (draw, &(line, before)) in record.draws.iter_mut().zip(&runner.draws) {
        // A draw that was refused is noted after it was counted.
        let refused = runner.errors.get(before).filter(|error| error.line == line);
        let end = before + usize::from(refused.is_some());
        let earlier = runner.errors.get(merged..end).unwrap_or_default();
        errors.extend(earlier.iter().cloned());
        merged = end;
        let call = steps.iter().find(|step| step.line == line && step.call.draws());
        if let Some(call) = call.map(|step| &step.call) {
            errors.extend(draw.errors.iter().map(|code| CallError {
                line,
                call: call.word(),
                code: code.clone(),
                why: errors::explain(call, code),
            }));
        }
        let own = std::mem::take(&mut draw.errors);
        draw.errors = earlier.iter().map(|error| error.code.clone()).chain(own).collect();
    }
    errors.extend(runner.errors.get(merged..).unwrap_or_default().iter().cloned());
    errors
}

/// Sets all state that a program can see to that of a new context.
fn begin_anew(gl: &Gl, size: [i32; 2]) {
    for switch in [glow::DEPTH_TEST, glow::CULL_FACE, glow::BLEND, glow::SCISSOR_TEST, glow::STENCIL_TEST] {
        gl.disable(switch);
    }
    gl.scissor(0, 0, size[0], size[1]);
    gl.blend_func(glow::ONE, glow::ZERO);
    gl.blend_equation(glow::FUNC_ADD);
    gl.depth_func(glow::LESS);
    gl.depth_mask(true);
    gl.color_mask(true, true, true, true);
    gl.cull_face(glow::BACK);
    gl.front_face(glow::CCW);
    gl.bind_vertex_array(None);
    gl.bind_buffer(glow::ARRAY_BUFFER, None);
    for location in 0..ATTRIBUTES {
        gl.vertex_attrib_4_f32(location, 0.0, 0.0, 0.0, 1.0);
    }
    gl.active_texture(glow::TEXTURE0);
    gl.clear_color(0.0, 0.0, 0.0, 1.0);
    gl.clear(glow::COLOR_BUFFER_BIT);
    gl.clear_color(0.0, 0.0, 0.0, 0.0);
    // Earlier errors do not belong to the program. (A lost context returns errors without end.)
    (0..MOST_ERRORS).find(|_| gl.get_error() == glow::NO_ERROR);
}

/// Empties units when it is dropped: the textures that the program bound there are gone, and its `Gl` with them.
struct EmptyUnits<'a> {
    gl: &'a Gl,
}

impl Drop for EmptyUnits<'_> {
    fn drop(&mut self) {
        let gl = self.gl;
        for unit in (0..UNITS).rev() {
            gl.active_texture(glow::TEXTURE0 + unit);
            gl.bind_texture(glow::TEXTURE_2D, None);
            gl.bind_texture(glow::TEXTURE_CUBE_MAP, None);
        }
        gl.bind_buffer(glow::ARRAY_BUFFER, None);
    }
}
