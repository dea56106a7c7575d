//! The objects and bindings of an OpenGL program, by its own numbers of objects.
//!
//! These numbers are counted here: 1, 2, 3 for each kind of object, as OpenGL gives them in a program that is alone in its
//! context. So a program's picture does not depend on what else has been drawn, and no number can reach an object of
//! somebody else.

use super::call::{Number, Pointer};
use super::program::LinkedShaders;
use gonio_gl::objects::{Buffer, TextureObject, VertexArray};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::rc::Rc;

/// OpenGL counts shaders and programs together, and a program has two shaders.
const NUMBERS_OF_A_PROGRAM: i32 = 3;

/// A buffer, and its bytes to look indices up.
pub struct BufferWithBytes {
    /// OpenGL's.
    pub object: Buffer,
    /// Its contents.
    pub bytes: Rc<Vec<u8>>,
}

/// A call of `vertex_attrib_pointer` and the buffer that was bound.
#[derive(Clone)]
pub struct AttributePointer {
    /// The arguments.
    pub pointer: Pointer,
    /// The buffer that was bound then.
    pub buffer: Option<Rc<RefCell<BufferWithBytes>>>,
}

/// The state of a vertex array.
#[derive(Default)]
pub struct ArrayView {
    /// By location.
    pub sources: BTreeMap<u32, AttributePointer>,
    /// Locations that are enabled.
    pub enabled: BTreeSet<u32>,
    /// The buffer bound to `ELEMENT_ARRAY_BUFFER`.
    pub indices: Option<Rc<RefCell<BufferWithBytes>>>,
}

/// Objects of one kind by their numbers.
pub struct Numbered<T> {
    /// The objects that exist.
    pub objects: BTreeMap<i32, T>,
    last: i32,
    step: i32,
}

impl<T> Numbered<T> {
    fn new(step: i32) -> Self {
        Numbered { objects: BTreeMap::new(), last: 0, step }
    }

    /// Adds an object and returns its number.
    pub fn add(&mut self, object: T) -> i32 {
        self.last += self.step;
        self.objects.insert(self.last, object);
        self.last
    }

    /// The number that the next object gets.
    pub fn next(&self) -> i32 {
        self.last + self.step
    }

    /// The object of a number.
    pub fn get(&self, number: i32) -> Option<&T> {
        self.objects.get(&number)
    }
}

/// The state of an OpenGL program while it runs.
pub struct ExecutionState {
    /// The values that calls returned, by variable.
    pub numbers: HashMap<String, i32>,
    /// Lists of numbers, as bytes.
    pub data: HashMap<String, Rc<Vec<u8>>>,
    /// Images: their files.
    pub images: HashMap<String, String>,
    /// Textures.
    pub textures: Numbered<TextureObject>,
    /// Buffers.
    pub buffers: Numbered<Rc<RefCell<BufferWithBytes>>>,
    /// Vertex arrays.
    pub arrays: Numbered<VertexArray>,
    /// Programs.
    pub programs: Numbered<Rc<LinkedShaders>>,
    /// The program that was created last.
    pub created: Option<Rc<LinkedShaders>>,
    /// The program in use.
    pub used: Option<Rc<LinkedShaders>>,
    /// The unit that is active.
    pub unit: u32,
    /// Textures by unit and target.
    pub bound: HashMap<(u32, u32), i32>,
    /// `ARRAY_BUFFER`.
    pub array_buffer: Option<i32>,
    /// The vertex array that is bound; 0 is none.
    pub array: i32,
    /// The state of vertex arrays, by number.
    pub views: HashMap<i32, ArrayView>,
    /// Bytes of texels uploaded so far.
    pub texel_bytes: usize,
    /// Bytes of buffers filled so far.
    pub buffer_bytes: usize,
    /// Vertices drawn so far.
    pub vertices: usize,
}

impl ExecutionState {
    /// Nothing.
    pub fn new() -> Self {
        ExecutionState {
            numbers: HashMap::new(),
            data: HashMap::new(),
            images: HashMap::new(),
            textures: Numbered::new(1),
            buffers: Numbered::new(1),
            arrays: Numbered::new(1),
            programs: Numbered::new(NUMBERS_OF_A_PROGRAM),
            created: None,
            used: None,
            unit: 0,
            bound: HashMap::new(),
            array_buffer: None,
            array: 0,
            views: HashMap::new(),
            texel_bytes: 0,
            buffer_bytes: 0,
            vertices: 0,
        }
    }

    /// Evaluates a number. An undefined variable is 0, as an uninitialised one probably is in C++.
    pub fn value(&self, number: &Number) -> i32 {
        match number {
            Number::Literal(value) => *value,
            Number::Variable(name) => self.numbers.get(name).copied().unwrap_or(0),
        }
    }

    /// The state of the bound vertex array.
    pub fn view(&mut self) -> &mut ArrayView {
        self.views.entry(self.array).or_default()
    }

    /// Forgets a buffer as `glDeleteBuffers` does: the bound vertex array lets go of it, others keep it alive.
    pub fn forget_buffer(&mut self, number: i32) {
        let Some(gone) = self.buffers.objects.remove(&number) else { return };
        if self.array_buffer == Some(number) {
            self.array_buffer = None;
        }
        let view = self.view();
        for source in view.sources.values_mut() {
            if source.buffer.as_ref().is_some_and(|buffer| Rc::ptr_eq(buffer, &gone)) {
                source.buffer = None;
            }
        }
        if view.indices.as_ref().is_some_and(|buffer| Rc::ptr_eq(buffer, &gone)) {
            view.indices = None;
        }
    }
}
