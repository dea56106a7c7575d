//! The binary chunk with its views and accessors.

use serde_json::{Value, json};
use std::ops::Range;

const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

#[derive(Default)]
pub(super) struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Returns the bytes, views and accessors.
    pub fn finish(self) -> (Vec<u8>, Vec<Value>, Vec<Value>) {
        (self.bytes, self.views, self.accessors)
    }

    /// Appends vectors as a view that several accessors may share.
    pub fn vertices<const N: usize>(&mut self, vectors: impl Iterator<Item = [f32; N]>) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(vectors.flatten().flat_map(f32::to_le_bytes));
        self.view(first, json!({ "target": ARRAY_BUFFER, "byteStride": 4 * N }))
    }

    /// Appends an image file.
    pub fn file(&mut self, bytes: &[u8]) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(bytes);
        self.view(first, json!({}))
    }

    /// Adds a view of the bytes since `first`, padded so that the next view begins at a multiple of 4.
    fn view(&mut self, first: usize, mut view: Value) -> usize {
        view["buffer"] = 0.into();
        view["byteOffset"] = first.into();
        view["byteLength"] = (self.bytes.len() - first).into();
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds an accessor for a range of a view's vectors of `size` bytes each.
    pub fn stretch(&mut self, view: usize, range: &Range<usize>, kind: &str, size: usize) -> usize {
        self.accessor(json!({
            "bufferView": view, "byteOffset": range.start * size, "count": range.len(), "componentType": F32,
            "type": kind,
        }))
    }

    /// Adds an accessor for positions, which requires their bounds.
    pub fn positions(&mut self, view: usize, range: &Range<usize>, positions: &[[f32; 3]]) -> usize {
        let fold = |start: f32, pick: fn(f32, f32) -> f32| {
            positions.iter().fold([start; 3], |found, p| [0, 1, 2].map(|i| pick(found[i], p[i])))
        };
        let accessor = self.stretch(view, range, "VEC3", 12);
        self.accessors[accessor]["min"] = fold(f32::INFINITY, f32::min).to_vec().into();
        self.accessors[accessor]["max"] = fold(f32::NEG_INFINITY, f32::max).to_vec().into();
        accessor
    }

    /// Appends indices of 16 bits.
    pub fn short_indices(&mut self, indices: impl Iterator<Item = u32>) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(indices.flat_map(|index| (index as u16).to_le_bytes()));
        self.index_accessor(first, U16, 2)
    }

    /// Appends indices of 32 bits.
    pub fn indices(&mut self, indices: impl Iterator<Item = u32>) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(indices.flat_map(u32::to_le_bytes));
        self.index_accessor(first, U32, 4)
    }

    fn index_accessor(&mut self, first: usize, component: u32, size: usize) -> usize {
        let count = (self.bytes.len() - first) / size;
        let view = self.view(first, json!({ "target": ELEMENT_ARRAY_BUFFER }));
        self.accessor(json!({ "bufferView": view, "componentType": component, "count": count, "type": "SCALAR" }))
    }
}
