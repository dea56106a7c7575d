//! The objects and bindings of an OpenGL program, by its own numbers of objects, and its linked shaders.

use super::call::{IntArgument, Pointer};
use crate::user_program::BrokenProgram;
use gonio_gl::objects::{Buffer, TextureObject, VertexArray};
use gonio_gl::{Gl, GlError};
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
    /// The initial state.
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
    pub fn value(&self, number: &IntArgument) -> i32 {
        match number {
            IntArgument::Literal(value) => *value,
            IntArgument::Variable(name) => self.numbers.get(name).copied().unwrap_or(0),
        }
    }

    /// The state of the bound vertex array.
    pub fn view(&mut self) -> &mut ArrayView {
        self.views.entry(self.array).or_default()
    }

    /// Forgets a buffer as `glDeleteBuffers` does: the bound vertex array drops it, others keep it alive.
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

/// A linked program.
pub struct LinkedShaders {
    gl: Gl,
    /// OpenGL's name for it.
    pub handle: glow::Program,
}

impl LinkedShaders {
    /// Compiles and links. The error has the logs of all shaders that do not compile.
    pub fn new(gl: &Gl, vertex: &str, fragment: &str) -> Result<Self, BrokenProgram> {
        let handle = gl.create_program().map_err(GlError::new)?;
        let program = LinkedShaders { gl: gl.clone(), handle };
        let mut shaders = Vec::new();
        for (kind, source) in [(glow::VERTEX_SHADER, vertex), (glow::FRAGMENT_SHADER, fragment)] {
            let shader = gl.create_shader(kind).map_err(GlError::new)?;
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            gl.attach_shader(handle, shader);
            shaders.push(shader);
        }
        gl.link_program(handle);
        let mut broken = None;
        if !gl.get_program_link_status(handle) {
            let mut logs = shaders
                .iter()
                .map(|&shader| (!gl.get_shader_compile_status(shader)).then(|| gl.get_shader_info_log(shader)));
            let [vertex_log, fragment_log] = [logs.next().flatten(), logs.next().flatten()];
            let neither = vertex_log.is_none() && fragment_log.is_none();
            let link_log = neither.then(|| gl.get_program_info_log(handle));
            broken = Some(BrokenProgram { vertex_log, fragment_log, link_log, driver: None });
        }
        for shader in shaders {
            gl.detach_shader(handle, shader);
            gl.delete_shader(shader);
        }
        match broken {
            Some(broken) => Err(broken),
            None => Ok(program),
        }
    }

    /// The location of an attribute; `None` if the program has no active attribute of that name.
    pub fn attribute(&self, name: &str) -> Option<u32> {
        self.gl.get_attrib_location(self.handle, name)
    }

    /// The location of a uniform; `None` if the program has no active uniform of that name.
    pub fn uniform(&self, name: &str) -> Option<glow::UniformLocation> {
        self.gl.get_uniform_location(self.handle, name)
    }

    /// Locations of all attributes that it reads.
    pub fn locations(&self) -> Vec<u32> {
        let gl = &self.gl;
        let attributes =
            (0..gl.get_active_attributes(self.handle)).filter_map(|index| gl.get_active_attribute(self.handle, index));
        // Built-in attributes such as gl_VertexID have no location.
        attributes.filter_map(|attribute| gl.get_attrib_location(self.handle, &attribute.name)).collect()
    }
}

impl Drop for LinkedShaders {
    fn drop(&mut self) {
        self.gl.delete_program(self.handle);
    }
}
