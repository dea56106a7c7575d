//! Checks draws before they are made: nothing that they read may lie outside of its buffer. OpenGL leaves that undefined, and
//! a driver may crash; here it is an error with its reason.

use super::state::{AttributePointer, ExecutionState};
use gonio_gl::trace::enums;

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
pub struct Refusal {
    /// OpenGL's word, or ours where OpenGL has none.
    pub code: &'static str,
    /// A sentence.
    pub why: String,
}

impl Refusal {
    /// With OpenGL's word.
    pub fn new(code: &'static str, why: impl Into<String>) -> Self {
        Refusal { code, why: why.into() }
    }
}

/// The code of errors that OpenGL does not check, and gonio does.
pub const UNDEFINED: &str = "UNDEFINED";

/// Checks a draw. `Ok` has the enabled locations that must be disabled meanwhile: the program does not read them, and they
/// reach beyond their buffers.
pub fn check(state: &mut ExecutionState, request: &DrawRequest) -> Result<Vec<u32>, Refusal> {
    if request.mode > glow::TRIANGLE_FAN {
        return Err(Refusal::new("INVALID_ENUM", "invalid primitive: expected TRIANGLES, LINES, POINTS and so on"));
    }
    if request.count < 0 || request.first < 0 {
        return Err(Refusal::new("INVALID_VALUE", "the first vertex and the count cannot be negative"));
    }
    let Some(program) = state.used.clone() else {
        return Err(Refusal::new(UNDEFINED, "no program is in use"));
    };
    if state.array == 0 {
        return Err(Refusal::new("INVALID_OPERATION", "no vertex array is bound"));
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
        return Err(Refusal::new("OUT_OF_MEMORY", format!("a program may draw at most {MOST_VERTICES} vertices")));
    }
    Ok(hidden)
}

fn never_described() -> Refusal {
    Refusal::new(UNDEFINED, "an attribute is enabled, but vertex_attrib_pointer has not described it")
}

/// Whether an attribute's numbers for all vertices up to `highest` lie in its buffer.
fn fits(source: &AttributePointer, highest: u32) -> Result<(), Refusal> {
    let pointer = &source.pointer;
    let name = &pointer.attribute;
    let Some(buffer) = &source.buffer else {
        return Err(Refusal::new(
            "INVALID_OPERATION",
            format!("the attribute `{name}` is enabled, but no buffer was bound when it was described"),
        ));
    };
    let held = buffer.borrow().bytes.len() as u64;
    let each = pointer.size.max(0) as u64 * u64::from(enums::component_bytes(pointer.kind.value));
    let stride = if pointer.stride == 0 { each } else { pointer.stride.max(0) as u64 };
    let end = pointer.offset.max(0) as u64 + stride * u64::from(highest) + each;
    if end > held {
        return Err(Refusal::new(
            UNDEFINED,
            format!(
                "the attribute `{name}` would be read up to byte {end} (vertex {highest}, offset {}, stride {stride}), but \
                 its buffer has {held} bytes",
                pointer.offset
            ),
        ));
    }
    Ok(())
}

/// The highest vertex that is read; `None` where none is.
fn highest_vertex(state: &mut ExecutionState, request: &DrawRequest) -> Result<Option<u32>, Refusal> {
    let (first, count) = (request.first as usize, request.count as usize);
    let Some(kind) = request.index_type else {
        return Ok((count > 0).then(|| (first + count - 1).min(u32::MAX as usize) as u32));
    };
    let each = match kind {
        glow::UNSIGNED_BYTE => 1,
        glow::UNSIGNED_SHORT => 2,
        glow::UNSIGNED_INT => 4,
        _ => {
            return Err(Refusal::new(
                "INVALID_ENUM",
                "invalid index type: expected UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT",
            ));
        }
    };
    let Some(indices) = state.view().indices.clone() else {
        return Err(Refusal::new(
            "INVALID_OPERATION",
            "no ELEMENT_ARRAY_BUFFER is bound to this vertex array, so there are no indices",
        ));
    };
    if first % each != 0 {
        return Err(Refusal::new(
            "INVALID_OPERATION",
            format!("the offset {first} is within an index: it counts bytes, and each index has {each}"),
        ));
    }
    let buffer = indices.borrow();
    let Some(bytes) = buffer.bytes.get(first..first.saturating_add(count * each)) else {
        return Err(Refusal::new(
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
