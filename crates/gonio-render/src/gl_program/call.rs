//! OpenGL calls as plain data: what a host program does, line by line.

use super::constants::Constant;

/// A call and the line that it stands in.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// From 1.
    pub line: u32,
    /// What is called.
    pub call: Call,
}

/// A whole number: written out, or what a call before returned.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Number {
    /// Written out.
    Literal(i32),
    /// The name that was given to what a call returned. Nothing but a number either, as in C++.
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

/// What `gen_...` makes and `delete_...` deletes.
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
    /// As calls write it.
    pub fn word(self) -> &'static str {
        match self {
            ObjectKind::Texture => "texture",
            ObjectKind::Buffer => "buffer",
            ObjectKind::VertexArray => "vertex_array",
        }
    }
}

/// What `vertex_attrib_pointer` says of an attribute. What OpenGL would refuse may stand in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pointer {
    /// By name; its location is looked up in the program that was created last.
    pub attribute: String,
    /// Numbers for each vertex.
    pub size: i32,
    /// Of which type.
    pub kind: Constant,
    /// Whether integers are mapped to fractions.
    pub normalized: bool,
    /// Bytes from vertex to vertex; 0: tightly packed.
    pub stride: i32,
    /// The first vertex's first byte.
    pub offset: i32,
}

/// What a uniform is set to.
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
        /// What it is called from here on.
        name: String,
        /// The file.
        file: String,
    },
    /// `glCreateProgram` with both shaders, linked.
    CreateProgram {
        /// What holds its number.
        name: String,
        /// The vertex shader's file.
        vertex: String,
        /// The fragment shader's file.
        fragment: String,
    },
    /// `glGenTextures` and its like, for one object.
    Generate {
        /// What holds its number.
        name: String,
        /// What is made.
        kind: ObjectKind,
    },
    /// `glDeleteTextures` and its like, for one object.
    Delete {
        /// What is deleted.
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
        /// How the texels are kept.
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
        /// What it is set to.
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
        /// How many.
        count: i32,
    },
    /// `glDrawElements`
    DrawElements {
        /// `TRIANGLES`, ...
        mode: Constant,
        /// How many indices.
        count: i32,
        /// `UNSIGNED_INT`, ...
        kind: Constant,
        /// The first index's byte in its buffer.
        offset: i32,
    },
}

impl Call {
    /// The call's name, as host programs write it.
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

    /// Whether it draws.
    pub fn draws(&self) -> bool {
        matches!(self, Call::DrawArrays { .. } | Call::DrawElements { .. })
    }
}
