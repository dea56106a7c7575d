//! Checks that draws read nothing outside of their buffers: OpenGL leaves that undefined, and a driver may crash. WebGL makes
//! the same checks by itself, so a browser needs none of them.

use crate::trace::enums::component_bytes;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The arguments of a draw call.
#[derive(Clone, Copy, Debug)]
pub struct DrawCall {
    /// `GL_TRIANGLES`, ...
    pub mode: u32,
    /// The first vertex; of an indexed draw, the first index's byte.
    pub first: i32,
    /// Vertices or indices.
    pub count: i32,
    /// `GL_UNSIGNED_INT`, ... of an indexed draw.
    pub index_type: Option<u32>,
    /// The number of instances.
    pub instances: i32,
}

/// The largest buffer of which a copy is kept, so that the indices of any part of it can be checked.
const MOST_KEPT: usize = 64 << 10;
/// Bytes of a large buffer that are searched at a time, for all sizes of indices: they stay in the cache.
const BLOCK: usize = 16 << 10;
/// The sizes of indices in bytes, each with the highest index of that size.
const INDEX_SIZES: [(usize, u32); 3] = [(1, u8::MAX as u32), (2, u16::MAX as u32), (4, u32::MAX)];

/// The contents of a buffer, as far as the checks of draws need them.
#[derive(Debug, Default)]
pub struct Contents {
    /// Its size.
    pub bytes: u64,
    /// The highest index in it for each of [`INDEX_SIZES`]. Found when a large buffer is filled, because nothing else is kept
    /// of it, and in a copy when a draw first needs it; `None` until then, and for large buffers of vertices.
    highest: [Cell<Option<u32>>; INDEX_SIZES.len()],
    /// A copy of its bytes; empty if there are more than [`MOST_KEPT`].
    copy: Vec<u8>,
}

/// A buffer's contents: vertex arrays refer to them longer than the buffer has a name.
pub type SharedContents = Rc<RefCell<Contents>>;

impl Contents {
    /// The contents of a buffer that was filled with these bytes.
    pub fn new(bytes: &[u8], are_indices: bool) -> Self {
        let size = bytes.len() as u64;
        if cfg!(target_arch = "wasm32") {
            return Contents { bytes: size, ..Contents::default() };
        }
        if bytes.len() <= MOST_KEPT {
            return Contents { bytes: size, copy: bytes.to_vec(), ..Contents::default() };
        }
        let highest = if are_indices { highest_of_each_size(bytes).map(Some) } else { [None; INDEX_SIZES.len()] };
        Contents { bytes: size, highest: highest.map(Cell::new), copy: Vec::new() }
    }

    /// The highest index in the whole buffer; `None` if it is not known.
    fn highest(&self, index_bytes: usize) -> Option<u32> {
        let known = &self.highest[index_bytes.trailing_zeros() as usize];
        if known.get().is_none() && self.copy.len() as u64 == self.bytes {
            known.set(Some(highest(&self.copy, index_bytes)));
        }
        known.get()
    }

    /// Whether the indices of a range are in the buffer and all less than `end`.
    fn has_indices_below(&self, first: u64, count: u64, index_bytes: usize, end: u64) -> bool {
        let last = first.saturating_add(count.saturating_mul(index_bytes as u64));
        if last > self.bytes {
            return false;
        }
        let is_aligned = first.is_multiple_of(index_bytes as u64);
        if is_aligned && self.highest(index_bytes).is_some_and(|highest| u64::from(highest) < end) {
            return true;
        }
        // Only a part of the buffer may be drawn.
        let range = self.copy.get(first as usize..last as usize);
        range.is_some_and(|range| u64::from(highest(range, index_bytes)) < end)
    }
}

/// The highest index for each of [`INDEX_SIZES`], in one pass over the memory. A size whose highest possible index was found
/// is not searched any further, which for most models leaves only the size that is drawn.
fn highest_of_each_size(bytes: &[u8]) -> [u32; INDEX_SIZES.len()] {
    let mut highest_so_far = [0; INDEX_SIZES.len()];
    for block in bytes.chunks(BLOCK) {
        for (so_far, (index_bytes, most)) in highest_so_far.iter_mut().zip(INDEX_SIZES) {
            if *so_far < most {
                *so_far = highest(block, index_bytes).max(*so_far);
            }
        }
    }
    highest_so_far
}

fn highest(bytes: &[u8], index_bytes: usize) -> u32 {
    match index_bytes {
        1 => bytes.iter().copied().max().unwrap_or(0).into(),
        2 => bytes.as_chunks().0.iter().map(|&index| u16::from_ne_bytes(index)).max().unwrap_or(0).into(),
        _ => bytes.as_chunks().0.iter().map(|&index| u32::from_ne_bytes(index)).max().unwrap_or(0),
    }
}

/// An enabled array of a vertex array.
#[derive(Clone, Copy)]
pub struct EnabledArray<'a> {
    /// The contents of its buffer; `None` if no buffer was bound when it was described.
    pub contents: Option<&'a SharedContents>,
    /// Numbers for each vertex.
    pub components: u32,
    /// `GL_FLOAT`, ...
    pub component_type: u32,
    /// Bytes from one vertex to the next; 0 means tightly packed.
    pub stride: u32,
    /// The first vertex's first byte.
    pub offset: u32,
    /// 0: a value for each vertex; n: one for each n instances.
    pub divisor: u32,
}

/// The number of vertices and instances that the enabled arrays have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndexLimits {
    vertices: u64,
    instances: u64,
}

impl IndexLimits {
    /// The smallest number of vertices and instances among arrays.
    pub fn least_of<'a>(arrays: impl Iterator<Item = EnabledArray<'a>>) -> Self {
        let mut limits = IndexLimits { vertices: u64::MAX, instances: u64::MAX };
        for array in arrays {
            let element = u64::from(array.components) * u64::from(component_bytes(array.component_type));
            let stride = if array.stride == 0 { element } else { array.stride.into() }.max(1);
            let bytes = array.contents.map_or(0, |contents| contents.borrow().bytes);
            let room = bytes.saturating_sub(array.offset.into());
            let elements = if array.contents.is_none() || room < element { 0 } else { 1 + (room - element) / stride };
            if array.divisor == 0 {
                limits.vertices = limits.vertices.min(elements);
            } else {
                limits.instances = limits.instances.min(elements.saturating_mul(array.divisor.into()));
            }
        }
        limits
    }
}

/// A draw call that reads nothing beyond the buffers of its vertex array. Only [`CheckedDraw::new`] makes one.
pub struct CheckedDraw {
    call: DrawCall,
    array: Option<glow::VertexArray>,
}

impl CheckedDraw {
    /// Checks a draw; `None` if it reads beyond a buffer. `array` is the vertex array that is bound, `limits` those of its
    /// enabled arrays, and `indices` the contents of its index buffer.
    pub fn new(
        call: DrawCall,
        array: Option<glow::VertexArray>,
        limits: IndexLimits,
        indices: Option<&Contents>,
    ) -> Option<Self> {
        let checked = CheckedDraw { call, array };
        // OpenGL refuses negative numbers of vertices and instances, and reads nothing for 0.
        if cfg!(target_arch = "wasm32") || call.count <= 0 || call.instances <= 0 {
            return Some(checked);
        }
        let (first, count) = (u64::try_from(call.first).ok()?, call.count as u64);
        if call.instances as u64 > limits.instances {
            return None;
        }
        let fits = match call.index_type {
            None => first + count <= limits.vertices,
            Some(glow::UNSIGNED_BYTE) => indices?.has_indices_below(first, count, 1, limits.vertices),
            Some(glow::UNSIGNED_SHORT) => indices?.has_indices_below(first, count, 2, limits.vertices),
            Some(glow::UNSIGNED_INT) => indices?.has_indices_below(first, count, 4, limits.vertices),
            // OpenGL refuses other types.
            Some(_) => true,
        };
        fits.then_some(checked)
    }

    /// The call, and the vertex array that it was checked with.
    pub fn parts(&self) -> (DrawCall, Option<glow::VertexArray>) {
        (self.call, self.array)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(first: i32, count: i32, index_type: Option<u32>) -> DrawCall {
        DrawCall { mode: glow::TRIANGLES, first, count, index_type, instances: 1 }
    }

    fn limits(bytes: usize, stride: u32, offset: u32) -> IndexLimits {
        let contents = Rc::new(RefCell::new(Contents::new(&vec![0; bytes], false)));
        let array = EnabledArray {
            contents: Some(&contents),
            components: 3,
            component_type: glow::FLOAT,
            stride,
            offset,
            divisor: 0,
        };
        IndexLimits::least_of([array].into_iter())
    }

    fn allows(call: DrawCall, limits: IndexLimits, indices: Option<&Contents>) -> bool {
        CheckedDraw::new(call, None, limits, indices).is_some()
    }

    #[test]
    fn vertices_up_to_the_end_of_the_buffer_and_no_further() {
        for (bytes, stride, offset, most) in [(72, 24, 12, 3), (71, 24, 12, 2), (36, 0, 0, 3), (11, 0, 0, 0)] {
            let limits = limits(bytes, stride, offset);
            assert!(allows(call(0, most, None), limits, None), "{bytes} {stride} {offset}");
            assert!(!allows(call(0, most + 1, None), limits, None), "{bytes} {stride} {offset}");
            assert!(!allows(call(most, 1, None), limits, None), "{bytes} {stride} {offset}");
        }
        assert!(
            allows(call(0, 1000, None), IndexLimits::least_of(std::iter::empty()), None),
            "no array, nothing to read"
        );
        assert!(!allows(call(-1, 1, None), limits(72, 24, 0), None));
    }

    #[test]
    fn indices_of_every_size_name_vertices_that_are_there() {
        let limits = limits(36, 0, 0);
        let words: Vec<u8> = [0_u32, 1, 2, 7].iter().flat_map(|index| index.to_ne_bytes()).collect();
        let contents = Contents::new(&words, true);
        let of = |first, count| call(first, count, Some(glow::UNSIGNED_INT));
        assert!(allows(of(0, 3), limits, Some(&contents)), "the part that is drawn counts");
        assert!(!allows(of(0, 4), limits, Some(&contents)), "vertex 7");
        assert!(!allows(of(4, 4), limits, Some(&contents)), "beyond the indices");
        assert!(!allows(of(0, 1), limits, None), "no index buffer");
        let shorts: Vec<u8> = [0_u16, 2, 3].iter().flat_map(|index| index.to_ne_bytes()).collect();
        let contents = Contents::new(&shorts, false);
        let of = |count| call(0, count, Some(glow::UNSIGNED_SHORT));
        assert!(allows(of(2), limits, Some(&contents)));
        assert!(!allows(of(3), limits, Some(&contents)));
        let bytes = Contents::new(&[2, 1, 0, 3], true);
        let of = |count| call(0, count, Some(glow::UNSIGNED_BYTE));
        assert!(allows(of(3), limits, Some(&bytes)) && !allows(of(4), limits, Some(&bytes)));
    }

    #[test]
    fn a_large_buffer_is_judged_by_its_highest_index() {
        let mut indices = vec![0_u32; MOST_KEPT];
        let contents = |indices: &[u32]| Contents::new(bytemuck::cast_slice(indices), true);
        let all = call(0, MOST_KEPT as i32, Some(glow::UNSIGNED_INT));
        assert!(allows(all, limits(36, 0, 0), Some(&contents(&indices))));
        indices[MOST_KEPT - 1] = 3;
        assert!(!allows(all, limits(36, 0, 0), Some(&contents(&indices))));
    }

    #[test]
    fn indices_of_every_size_are_found_in_a_large_buffer() {
        let mut bytes = vec![0; 4 * MOST_KEPT + 2];
        assert_eq!(highest_of_each_size(&bytes), [0; 3]);
        bytes[BLOCK + 4] = 7;
        bytes[3 * BLOCK - 2] = 9;
        let [ones, twos, fours] = highest_of_each_size(&bytes);
        assert_eq!((ones, twos), (9, highest(&bytes, 2)));
        assert_eq!(fours, highest(&bytes, 4));
        bytes[0] = u8::MAX;
        assert_eq!(highest_of_each_size(&bytes), [1, 2, 4].map(|index_bytes| highest(&bytes, index_bytes)));
    }

    #[test]
    fn indices_at_an_odd_byte_are_read_from_there() {
        let contents = Contents::new(&[0, 1, 0, 1, 0, 0, 0, 0], true);
        assert_eq!(contents.highest(2), Some(256));
        let at = |first| call(first, 1, Some(glow::UNSIGNED_SHORT));
        let limits = limits(36, 0, 0);
        assert!(allows(at(4), limits, Some(&contents)) && !allows(at(0), limits, Some(&contents)));
        assert!(allows(at(1), limits, Some(&contents)), "bytes 1 and 0");
    }

    #[test]
    fn instances_have_arrays_of_their_own() {
        let contents = Rc::new(RefCell::new(Contents::new(&[0; 24], false)));
        let array = EnabledArray {
            contents: Some(&contents),
            components: 3,
            component_type: glow::FLOAT,
            stride: 0,
            offset: 0,
            divisor: 1,
        };
        let limits = IndexLimits::least_of([array].into_iter());
        let draw = |instances| DrawCall { instances, ..call(0, 4, None) };
        assert!(allows(draw(2), limits, None) && !allows(draw(3), limits, None));
        let without_buffer = IndexLimits::least_of([EnabledArray { contents: None, divisor: 0, ..array }].into_iter());
        assert!(!allows(call(0, 1, None), without_buffer, None));
    }
}
