//! Accessors: arrays of vectors in buffers, dense or sparse (glTF 2.0, section 3.6.2).
//!
//! [`Accessor::open`] checks every range; later reads cannot leave the buffer.

use super::buffer::{Buffers, View, range};
use super::json::JsonRef;
use crate::ReadError;
use std::ops::Range;

/// The type of a component.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of_code(code: u64) -> Option<Self> {
        Some(match code {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    fn is_index(self) -> bool {
        matches!(self, Component::U8 | Component::U16 | Component::U32)
    }
}

/// An array in a buffer: `count` elements, each `width` components, `stride` bytes apart.
struct Array<'v> {
    view: View<'v>,
    /// The byte of the first element in the view.
    first: usize,
    stride: usize,
    width: usize,
    component: Component,
}

pub(super) struct Accessor<'v> {
    pub at: JsonRef<'v>,
    pub count: usize,
    width: usize,
    normalized: bool,
    /// `None` if all elements are 0.
    dense: Option<Array<'v>>,
    sparse: Option<Sparse<'v>>,
}

/// The elements that a sparse accessor replaces, and their values.
struct Sparse<'v> {
    indices: Vec<u32>,
    values: Array<'v>,
}

impl<'v> Accessor<'v> {
    /// Opens the accessor that the index `key` of `from` refers to. Its elements must have one of `widths` components.
    pub fn open(
        buffers: &mut Buffers<'v, '_>,
        root: JsonRef<'v>,
        from: JsonRef<'v>,
        key: &'v str,
        widths: &[usize],
    ) -> Result<Option<Self>, ReadError> {
        let Some((_, at)) = from.target(root, key, "accessors")? else { return Ok(None) };
        let count = at.index("count")?.ok_or_else(|| at.missing("count"))?;
        let component = component(at)?;
        let kind = at.text("type")?.ok_or_else(|| at.missing("type"))?;
        let width = ["SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"].iter().position(|name| *name == kind);
        let width = width.map(|i| [1, 2, 3, 4, 16][i]).filter(|width| widths.contains(width));
        let width = width.ok_or_else(|| {
            let (path, user) = (at.path(), from.get(key).map_or_else(String::new, JsonRef::path));
            ReadError::new(format!("{path} has the type {kind:?}, which {user} cannot have"))
        })?;
        let dense = match buffers.view(at, "bufferView")? {
            Some(view) => Some(Array::open(view, at, count, width, component)?),
            None => None,
        };
        let sparse = at.get("sparse").map(|sparse| Sparse::open(buffers, sparse, count, width, component));
        Ok(Some(Accessor { at, count, width, normalized: at.flag("normalized"), dense, sparse: sparse.transpose()? }))
    }

    /// Returns elements as vectors of `N`; missing components become `fill`.
    pub fn vectors<const N: usize>(&self, range: Range<usize>, fill: f32) -> Vec<[f32; N]> {
        let mut vectors = vec![[fill; N]; range.len()];
        match &self.dense {
            Some(array) => array.decode(range.start, self.normalized, &mut vectors),
            None => vectors.iter_mut().flat_map(|v| v.iter_mut().take(self.width)).for_each(|c| *c = 0.0),
        }
        if let Some(sparse) = &self.sparse {
            let mut values = vec![[fill; N]; sparse.indices.len()];
            sparse.values.decode(0, self.normalized, &mut values);
            for (&index, value) in sparse.indices.iter().zip(values) {
                if let Some(vector) = (index as usize).checked_sub(range.start).and_then(|i| vectors.get_mut(i)) {
                    *vector = value;
                }
            }
        }
        vectors
    }

    /// Returns all elements as indices.
    pub fn indices(&self) -> Result<Vec<u32>, ReadError> {
        let arrays = self.dense.iter().chain(self.sparse.as_ref().map(|sparse| &sparse.values));
        if arrays.into_iter().any(|array| !array.component.is_index()) {
            let what = "does not contain integers, so it cannot hold indices";
            return Err(ReadError::new(format!("{} {what}", self.at.path())));
        }
        let mut indices = match &self.dense {
            Some(array) => array.integers(self.count),
            None => vec![0; self.count],
        };
        if let Some(sparse) = &self.sparse {
            for (&index, value) in sparse.indices.iter().zip(sparse.values.integers(sparse.indices.len())) {
                if let Some(replaced) = indices.get_mut(index as usize) {
                    *replaced = value;
                }
            }
        }
        Ok(indices)
    }

    /// Whether the file contains the counted elements: without a view, the count is only a claim.
    pub fn is_backed(&self) -> bool {
        self.dense.is_some()
    }
}

fn component(at: JsonRef<'_>) -> Result<Component, ReadError> {
    let code = at.unsigned("componentType")?.ok_or_else(|| at.missing("componentType"))?;
    Component::of_code(code).ok_or_else(|| {
        let what = "is not one of 5120 (i8), 5121 (u8), 5122 (i16), 5123 (u16), 5125 (u32), 5126 (f32)";
        ReadError::new(format!("{} {what}", at.written("componentType")))
    })
}

impl<'v> Sparse<'v> {
    fn open(
        buffers: &mut Buffers<'v, '_>,
        at: JsonRef<'v>,
        whole: usize,
        width: usize,
        values_are: Component,
    ) -> Result<Self, ReadError> {
        let count = at.index("count")?.ok_or_else(|| at.missing("count"))?;
        let mut array = |key: &'v str, width, component: Option<Component>| {
            let at = at.get(key).ok_or_else(|| at.missing(key))?;
            let component = component.map_or_else(|| self::component(at), Ok)?;
            let view = buffers.view(at, "bufferView")?.ok_or_else(|| at.missing("bufferView"))?;
            Array::open(view, at, count, width, component)
        };
        let indices = array("indices", 1, None)?;
        let values = array("values", width, Some(values_are))?;
        if !indices.component.is_index() {
            return Err(ReadError::new(format!("{}.indices does not contain integers", at.path())));
        }
        let indices = indices.integers(count);
        if let Some(beyond) = indices.iter().find(|index| **index as usize >= whole) {
            let path = at.path();
            return Err(ReadError::new(format!("{path} replaces the element {beyond} of only {whole}")));
        }
        Ok(Sparse { indices, values })
    }
}

impl<'v> Array<'v> {
    /// Checks that `count` elements from the `byteOffset` of `at` are within the view.
    fn open(
        view: View<'v>,
        at: JsonRef<'v>,
        count: usize,
        width: usize,
        component: Component,
    ) -> Result<Self, ReadError> {
        let element = width * component.size();
        let stride = view.stride.unwrap_or(element);
        if stride < element {
            let path = at.path();
            return Err(ReadError::new(format!(
                "{path} has elements of {element} bytes, but its view's byteStride is {stride}"
            )));
        }
        let first = at.unsigned("byteOffset")?.unwrap_or(0);
        let length = match count.checked_sub(1) {
            Some(gaps) => (gaps as u64).checked_mul(stride as u64).and_then(|bytes| bytes.checked_add(element as u64)),
            None => Some(0),
        };
        let there = view.bytes().len();
        let range = length.and_then(|length| range(first, length)).filter(|range| range.end <= there);
        let Some(range) = range else {
            let path = at.path();
            return Err(ReadError::new(format!(
                "{path} reaches beyond its buffer view: {count} elements of {element} bytes, {stride} apart, from byte {first} of {there}"
            )));
        };
        Ok(Array { view, first: range.start, stride, width, component })
    }

    /// Returns the bytes of each element, starting with one of them.
    fn elements(&self, from: usize) -> impl Iterator<Item = &[u8]> {
        let first = from.checked_mul(self.stride).and_then(|skip| skip.checked_add(self.first));
        let bytes = first.and_then(|first| self.view.bytes().get(first..)).unwrap_or_default();
        bytes.chunks(self.stride)
    }

    fn decode<const N: usize>(&self, from: usize, normalized: bool, out: &mut [[f32; N]]) {
        match (self.component, normalized) {
            (Component::F32, _) => self.each(from, out, f32::from_le_bytes),
            (Component::I8, false) => self.each(from, out, |[b]: [u8; 1]| f32::from(b as i8)),
            (Component::U8, false) => self.each(from, out, |[b]: [u8; 1]| f32::from(b)),
            (Component::I16, false) => self.each(from, out, |b| f32::from(i16::from_le_bytes(b))),
            (Component::U16, false) => self.each(from, out, |b| f32::from(u16::from_le_bytes(b))),
            (Component::U32, false) => self.each(from, out, |b| u32::from_le_bytes(b) as f32),
            // glTF 2.0, section 3.6.2.2.
            (Component::I8, true) => self.each(from, out, |[b]: [u8; 1]| (f32::from(b as i8) / 127.0).max(-1.0)),
            (Component::U8, true) => self.each(from, out, |[b]: [u8; 1]| f32::from(b) / 255.0),
            (Component::I16, true) => {
                self.each(from, out, |b| (f32::from(i16::from_le_bytes(b)) / 32_767.0).max(-1.0));
            }
            (Component::U16, true) => self.each(from, out, |b| f32::from(u16::from_le_bytes(b)) / 65_535.0),
            (Component::U32, true) => {
                self.each(from, out, |b| (f64::from(u32::from_le_bytes(b)) / f64::from(u32::MAX)) as f32);
            }
        }
    }

    fn each<const N: usize, const SIZE: usize>(
        &self,
        from: usize,
        out: &mut [[f32; N]],
        number: impl Fn([u8; SIZE]) -> f32,
    ) {
        for (vector, element) in out.iter_mut().zip(self.elements(from)) {
            let components = element.as_chunks::<SIZE>().0.iter().take(self.width);
            for (out, bytes) in vector.iter_mut().zip(components) {
                *out = number(*bytes);
            }
        }
    }

    fn integers(&self, count: usize) -> Vec<u32> {
        let elements = self.elements(0).take(count);
        match self.component.size() {
            1 => elements.filter_map(|e| e.first().map(|b| u32::from(*b))).collect(),
            2 => elements.filter_map(|e| e.first_chunk().map(|b| u32::from(u16::from_le_bytes(*b)))).collect(),
            _ => elements.filter_map(|e| e.first_chunk().map(|b| u32::from_le_bytes(*b))).collect(),
        }
    }
}
