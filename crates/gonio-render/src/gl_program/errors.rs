//! Refused calls: draws are checked before they are made, and OpenGL's errors are explained for students.
//!
//! A draw must not read outside of its buffers. OpenGL leaves that undefined, and a driver may crash; here it is an error with
//! its reason.

use super::call::GlCall;
use super::state::{AttributePointer, ExecutionState};
use gonio_gl::trace::enums;
use serde::Serialize;

/// A call that OpenGL refused, or that gonio did not make because its result is undefined. All other calls were made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CallError {
    /// The line of the program, from 1.
    pub line: u32,
    /// `bind_texture`, ...
    pub call: &'static str,
    /// `INVALID_OPERATION`, ...; `UNDEFINED` if OpenGL does not check the call and the result is undefined.
    pub code: String,
    /// The reason: a sentence without a full stop.
    pub why: String,
}

impl std::fmt::Display for CallError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: {} raised {}: {}", self.line, self.call, self.code, self.why)
    }
}

/// Explains why OpenGL refuses a call with an error code.
pub fn explain(call: &GlCall, code: &str) -> String {
    let sentence = match (call, code) {
        (GlCall::ActiveTexture(_), _) => "invalid texture unit: expected TEXTURE0, TEXTURE1 and so on, not a number",
        (GlCall::BindTexture { .. }, "INVALID_OPERATION") => {
            "the texture was first bound to another target, which it keeps"
        }
        (GlCall::BindTexture { .. }, _) => "invalid target: textures cannot be bound to it",
        (GlCall::BindBuffer { .. } | GlCall::BufferData { .. }, "INVALID_ENUM") => {
            "invalid target or usage: expected ARRAY_BUFFER or ELEMENT_ARRAY_BUFFER, and STATIC_DRAW"
        }
        (GlCall::VertexAttribPointer(_), "INVALID_VALUE") => {
            "invalid size or stride: an attribute has 1 to 4 components and a stride of 0 to 2048 bytes"
        }
        (GlCall::VertexAttribPointer(_), "INVALID_ENUM") => "invalid component type: expected FLOAT",
        (GlCall::TexImage2d { .. }, "INVALID_ENUM") => {
            "invalid target: expected TEXTURE_2D or a face of a cubemap, not TEXTURE_CUBE_MAP"
        }
        (GlCall::TexImage2d { .. }, "INVALID_VALUE") => {
            "invalid level, format or image size: the first level is 0, and the faces of a cubemap are square"
        }
        (GlCall::TexImage2d { .. }, _) => "invalid format for an image",
        (GlCall::TexParameter { .. }, "INVALID_ENUM") => {
            "invalid target, parameter or value: TEXTURE_MAG_FILTER, for example, cannot use mipmaps"
        }
        (GlCall::GenerateMipmap { .. }, "INVALID_OPERATION") => {
            "cannot generate mipmaps of this texture: a cubemap needs all six faces, of the same size"
        }
        (GlCall::GenerateMipmap { .. }, _) => "invalid target: it has no mipmaps",
        (GlCall::Uniform { .. }, "INVALID_VALUE") => "no texture unit has this number",
        (GlCall::Uniform { .. }, _) => {
            "the call does not match the type of the uniform: samplers and ints need uniform_1i, floats uniform_1f"
        }
        (GlCall::Viewport(_), _) => "width and height cannot be negative",
        (GlCall::Switch { .. }, _) => "cannot be enabled or disabled; textures are only bound",
        (GlCall::DrawArrays { .. } | GlCall::DrawElements { .. }, "INVALID_OPERATION") => {
            "two samplers of different types read the same unit, or the program cannot run"
        }
        (_, "OUT_OF_MEMORY") => "not enough memory",
        _ => "OpenGL refused the call",
    };
    sentence.to_owned()
}

/// Most vertices of all draws of a program.
pub const MOST_VERTICES: usize = 10_000;

/// A draw call with its arguments.
pub struct DrawRequest {
    /// `GL_TRIANGLES`, ...
    pub mode: u32,
    /// The first vertex; where it is indexed, the first index's byte.
    pub first: i32,
    /// Vertices or indices.
    pub count: i32,
    /// The index type of an indexed draw.
    pub index_type: Option<u32>,
}

/// The reason why a call is not made.
pub struct CallRefusal {
    /// OpenGL's name of the error, or [`UNDEFINED`].
    pub code: &'static str,
    /// A sentence.
    pub why: String,
}

impl CallRefusal {
    /// Creates a refusal.
    pub fn new(code: &'static str, why: impl Into<String>) -> Self {
        CallRefusal { code, why: why.into() }
    }
}

/// The code of errors that OpenGL does not check, and gonio does.
pub const UNDEFINED: &str = "UNDEFINED";

/// Checks a draw. `Ok` has the enabled locations that must be disabled for the draw: the program does not read them, and they
/// reach beyond their buffers.
pub fn check_draw(state: &mut ExecutionState, request: &DrawRequest) -> Result<Vec<u32>, CallRefusal> {
    if request.mode > glow::TRIANGLE_FAN {
        return Err(CallRefusal::new("INVALID_ENUM", "invalid primitive: expected TRIANGLES, LINES, POINTS and so on"));
    }
    if request.count < 0 || request.first < 0 {
        return Err(CallRefusal::new("INVALID_VALUE", "the first vertex and the count cannot be negative"));
    }
    let Some(program) = state.used.clone() else {
        return Err(CallRefusal::new(UNDEFINED, "no program is in use"));
    };
    if state.array == 0 {
        return Err(CallRefusal::new("INVALID_OPERATION", "no vertex array is bound"));
    }
    let highest = highest_vertex(state, request)?;
    let read = program.locations();
    let mut hidden = Vec::new();
    let Some(highest) = highest else { return Ok(hidden) };
    let view = state.view();
    for &location in &view.enabled {
        match view.sources.get(&location).map_or_else(|| Err(never_described()), |source| fits(source, highest)) {
            Ok(()) => {}
            Err(why) if read.contains(&location) => return Err(why),
            Err(_) => hidden.push(location),
        }
    }
    state.vertices += request.count as usize;
    if state.vertices > MOST_VERTICES {
        return Err(CallRefusal::new("OUT_OF_MEMORY", format!("a program may draw at most {MOST_VERTICES} vertices")));
    }
    Ok(hidden)
}

fn never_described() -> CallRefusal {
    CallRefusal::new(UNDEFINED, "an attribute is enabled, but vertex_attrib_pointer has not described it")
}

/// Whether the numbers of an attribute for all vertices up to `highest` are in its buffer.
fn fits(source: &AttributePointer, highest: u32) -> Result<(), CallRefusal> {
    let pointer = &source.pointer;
    let name = &pointer.attribute;
    let Some(buffer) = &source.buffer else {
        return Err(CallRefusal::new(
            "INVALID_OPERATION",
            format!("the attribute `{name}` is enabled, but no buffer was bound when it was described"),
        ));
    };
    let buffer_bytes = buffer.borrow().bytes.len() as u64;
    let each = pointer.size.max(0) as u64 * u64::from(enums::component_bytes(pointer.kind.value));
    let stride = if pointer.stride == 0 { each } else { pointer.stride.max(0) as u64 };
    let end = pointer.offset.max(0) as u64 + stride * u64::from(highest) + each;
    if end > buffer_bytes {
        return Err(CallRefusal::new(
            UNDEFINED,
            format!(
                "the attribute `{name}` would be read up to byte {end} (vertex {highest}, offset {}, stride {stride}), but \
                 its buffer has {buffer_bytes} bytes",
                pointer.offset
            ),
        ));
    }
    Ok(())
}

/// The highest vertex that is read; `None` where none is.
fn highest_vertex(state: &mut ExecutionState, request: &DrawRequest) -> Result<Option<u32>, CallRefusal> {
    let (first, count) = (request.first as usize, request.count as usize);
    let Some(kind) = request.index_type else {
        return Ok((count > 0).then(|| (first + count - 1).min(u32::MAX as usize) as u32));
    };
    let each = match kind {
        glow::UNSIGNED_BYTE => 1,
        glow::UNSIGNED_SHORT => 2,
        glow::UNSIGNED_INT => 4,
        _ => {
            return Err(CallRefusal::new(
                "INVALID_ENUM",
                "invalid index type: expected UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT",
            ));
        }
    };
    let Some(indices) = state.view().indices.clone() else {
        return Err(CallRefusal::new(
            "INVALID_OPERATION",
            "no ELEMENT_ARRAY_BUFFER is bound to this vertex array, so there are no indices",
        ));
    };
    if first % each != 0 {
        return Err(CallRefusal::new(
            "INVALID_OPERATION",
            format!("the offset {first} is within an index: it counts bytes, and each index has {each}"),
        ));
    }
    let buffer = indices.borrow();
    let Some(bytes) = buffer.bytes.get(first..first.saturating_add(count * each)) else {
        return Err(CallRefusal::new(
            UNDEFINED,
            format!(
                "{count} indices of {each} bytes from byte {first} on would be read, but their buffer has {} bytes",
                buffer.bytes.len()
            ),
        ));
    };
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0_u32, |number, byte| number << 8 | u32::from(*byte));
    Ok(bytes.chunks_exact(each).map(number).max())
}
