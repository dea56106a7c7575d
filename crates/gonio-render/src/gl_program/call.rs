//! OpenGL calls as plain data, line by line.

use super::constants::Constant;

/// A call and its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// From 1.
    pub line: u32,
    /// The call.
    pub call: Call,
}

/// An integer: a literal, or the result of an earlier call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Number {
    /// Written out.
    Literal(i32),
    /// The variable that a call returned. It is only a number, as in C++.
    Variable(String),
}

/// One of OpenGL's constants, or any number in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// By its name.
    Constant(Constant),
    /// A number.
    Number(Number),
}

/// A kind of object that `gen_...` creates and `delete_...` deletes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ObjectKind {
    /// `gen_texture`
    Texture,
    /// `gen_buffer`
    Buffer,
    /// `gen_vertex_array`
    VertexArray,
}

impl ObjectKind {
    /// The name in calls.
    pub fn word(self) -> &'static str {
        match self {
            ObjectKind::Texture => "texture",
            ObjectKind::Buffer => "buffer",
            ObjectKind::VertexArray => "vertex_array",
        }
    }
}

/// The arguments of `vertex_attrib_pointer`, valid or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pointer {
    /// By name; its location is looked up in the program that was created last.
    pub attribute: String,
    /// Numbers for each vertex.
    pub size: i32,
    /// The type of its components.
    pub kind: Constant,
    /// Whether integers are mapped to fractions.
    pub normalized: bool,
    /// Bytes from vertex to vertex; 0: tightly packed.
    pub stride: i32,
    /// The first vertex's first byte.
    pub offset: i32,
}

/// The value of a uniform.
#[derive(Clone, Debug, PartialEq)]
pub enum UniformArgument {
    /// `uniform_1i`
    Whole(Number),
    /// `uniform_1f` to `uniform_4f`: one to four numbers.
    Floats(Vec<f32>),
}

/// A call. Arguments are in OpenGL's order and in its units.
#[derive(Clone, Debug, PartialEq)]
pub enum Call {
    /// `float NAME[] = { ... }`
    Data {
        /// Its name.
        name: String,
        /// The numbers.
        numbers: Vec<f32>,
    },
    /// `unsigned int NAME[] = { ... }`
    Indices {
        /// Its name.
        name: String,
        /// The numbers.
        numbers: Vec<u32>,
    },
    /// Reads an image file.
    LoadImage {
        /// The variable that refers to it.
        name: String,
        /// The file.
        file: String,
    },
    /// `glCreateProgram` with both shaders, linked.
    CreateProgram {
        /// The variable for its number.
        name: String,
        /// The vertex shader's file.
        vertex: String,
        /// The fragment shader's file.
        fragment: String,
    },
    /// `glGenTextures` and its like, for one object.
    Generate {
        /// The variable for its number.
        name: String,
        /// The kind of object.
        kind: ObjectKind,
    },
    /// `glDeleteTextures` and its like, for one object.
    Delete {
        /// The kind of object.
        kind: ObjectKind,
        /// Its number.
        object: Number,
    },
    /// `glBindVertexArray`
    BindVertexArray(Number),
    /// `glBindBuffer`
    BindBuffer {
        /// `ARRAY_BUFFER` or `ELEMENT_ARRAY_BUFFER`.
        target: Constant,
        /// The buffer's number.
        buffer: Number,
    },
    /// `glBufferData`
    BufferData {
        /// `ARRAY_BUFFER` or `ELEMENT_ARRAY_BUFFER`.
        target: Constant,
        /// The name of what it is filled with.
        data: String,
        /// `STATIC_DRAW`, ...
        usage: Constant,
    },
    /// `glVertexAttribPointer`
    VertexAttribPointer(Pointer),
    /// `glEnableVertexAttribArray`, `glDisableVertexAttribArray`
    SwitchAttribute {
        /// By name, as in [`Pointer::attribute`].
        attribute: String,
        /// Whether it is enabled.
        on: bool,
    },
    /// `glActiveTexture`
    ActiveTexture(Selector),
    /// `glBindTexture`
    BindTexture {
        /// `TEXTURE_2D`, `TEXTURE_CUBE_MAP`
        target: Constant,
        /// The texture's number.
        texture: Number,
    },
    /// `glTexImage2D`
    TexImage2d {
        /// `TEXTURE_2D`, or a face of a cubemap.
        target: Constant,
        /// 0 is the largest.
        level: i32,
        /// The internal format.
        format: Constant,
        /// The image's name.
        image: String,
    },
    /// `glTexParameteri`
    TexParameter {
        /// `TEXTURE_2D`, `TEXTURE_CUBE_MAP`
        target: Constant,
        /// `TEXTURE_MIN_FILTER`, ...
        parameter: Constant,
        /// `LINEAR`, ...
        value: Selector,
    },
    /// `glGenerateMipmap`
    GenerateMipmap {
        /// `TEXTURE_2D`, `TEXTURE_CUBE_MAP`
        target: Constant,
    },
    /// `glUseProgram`
    UseProgram(Number),
    /// `glUniform...`, of the program in use.
    Uniform {
        /// By name; its location is looked up in the program that was created last.
        uniform: String,
        /// Its value.
        given: UniformArgument,
    },
    /// `glViewport`: x, y, width, height.
    Viewport([i32; 4]),
    /// `glEnable`, `glDisable`
    Switch {
        /// `DEPTH_TEST`, ...
        what: Constant,
        /// Whether it is enabled.
        on: bool,
    },
    /// `glClearColor`
    ClearColor([f32; 4]),
    /// `glClear`
    Clear(Vec<Constant>),
    /// `glDrawArrays`
    DrawArrays {
        /// `TRIANGLES`, ...
        mode: Constant,
        /// The first vertex.
        first: i32,
        /// The number of vertices.
        count: i32,
    },
    /// `glDrawElements`
    DrawElements {
        /// `TRIANGLES`, ...
        mode: Constant,
        /// The number of indices.
        count: i32,
        /// `UNSIGNED_INT`, ...
        kind: Constant,
        /// The first index's byte in its buffer.
        offset: i32,
    },
}

impl Call {
    /// The name of the call in programs.
    pub fn word(&self) -> &'static str {
        match self {
            Call::Data { .. } => "data",
            Call::Indices { .. } => "indices",
            Call::LoadImage { .. } => "load_image",
            Call::CreateProgram { .. } => "create_program",
            Call::Generate { kind: ObjectKind::Texture, .. } => "gen_texture",
            Call::Generate { kind: ObjectKind::Buffer, .. } => "gen_buffer",
            Call::Generate { kind: ObjectKind::VertexArray, .. } => "gen_vertex_array",
            Call::Delete { kind: ObjectKind::Texture, .. } => "delete_texture",
            Call::Delete { kind: ObjectKind::Buffer, .. } => "delete_buffer",
            Call::Delete { kind: ObjectKind::VertexArray, .. } => "delete_vertex_array",
            Call::BindVertexArray(_) => "bind_vertex_array",
            Call::BindBuffer { .. } => "bind_buffer",
            Call::BufferData { .. } => "buffer_data",
            Call::VertexAttribPointer(_) => "vertex_attrib_pointer",
            Call::SwitchAttribute { on: true, .. } => "enable_vertex_attrib_array",
            Call::SwitchAttribute { on: false, .. } => "disable_vertex_attrib_array",
            Call::ActiveTexture(_) => "active_texture",
            Call::BindTexture { .. } => "bind_texture",
            Call::TexImage2d { .. } => "tex_image_2d",
            Call::TexParameter { .. } => "tex_parameter",
            Call::GenerateMipmap { .. } => "generate_mipmap",
            Call::UseProgram(_) => "use_program",
            Call::Uniform { given: UniformArgument::Whole(_), .. } => "uniform_1i",
            Call::Uniform { given: UniformArgument::Floats(numbers), .. } => match numbers.len() {
                0 | 1 => "uniform_1f",
                2 => "uniform_2f",
                3 => "uniform_3f",
                _ => "uniform_4f",
            },
            Call::Viewport(_) => "viewport",
            Call::Switch { on: true, .. } => "enable",
            Call::Switch { on: false, .. } => "disable",
            Call::ClearColor(_) => "clear_color",
            Call::Clear(_) => "clear",
            Call::DrawArrays { .. } => "draw_arrays",
            Call::DrawElements { .. } => "draw_elements",
        }
    }

    /// Returns whether the call draws.
    pub fn draws(&self) -> bool {
        matches!(self, Call::DrawArrays { .. } | Call::DrawElements { .. })
    }
}
