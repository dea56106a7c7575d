//! OpenGL calls as plain data, line by line, and the constants that they may use.

/// A call and its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// From 1.
    pub line: u32,
    /// The call.
    pub call: GlCall,
}

/// An integer: a literal, or the result of an earlier call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IntArgument {
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
    Number(IntArgument),
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
    Whole(IntArgument),
    /// `uniform_1f` to `uniform_4f`: one to four numbers.
    Floats(Vec<f32>),
}

/// A call. Arguments are in OpenGL's order and in its units.
#[derive(Clone, Debug, PartialEq)]
pub enum GlCall {
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
        object: IntArgument,
    },
    /// `glBindVertexArray`
    BindVertexArray(IntArgument),
    /// `glBindBuffer`
    BindBuffer {
        /// `ARRAY_BUFFER` or `ELEMENT_ARRAY_BUFFER`.
        target: Constant,
        /// The buffer's number.
        buffer: IntArgument,
    },
    /// `glBufferData`
    BufferData {
        /// `ARRAY_BUFFER` or `ELEMENT_ARRAY_BUFFER`.
        target: Constant,
        /// The name of the data.
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
        texture: IntArgument,
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
    UseProgram(IntArgument),
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

impl GlCall {
    /// The name of the call in programs.
    pub fn word(&self) -> &'static str {
        match self {
            GlCall::Data { .. } => "data",
            GlCall::Indices { .. } => "indices",
            GlCall::LoadImage { .. } => "load_image",
            GlCall::CreateProgram { .. } => "create_program",
            GlCall::Generate { kind: ObjectKind::Texture, .. } => "gen_texture",
            GlCall::Generate { kind: ObjectKind::Buffer, .. } => "gen_buffer",
            GlCall::Generate { kind: ObjectKind::VertexArray, .. } => "gen_vertex_array",
            GlCall::Delete { kind: ObjectKind::Texture, .. } => "delete_texture",
            GlCall::Delete { kind: ObjectKind::Buffer, .. } => "delete_buffer",
            GlCall::Delete { kind: ObjectKind::VertexArray, .. } => "delete_vertex_array",
            GlCall::BindVertexArray(_) => "bind_vertex_array",
            GlCall::BindBuffer { .. } => "bind_buffer",
            GlCall::BufferData { .. } => "buffer_data",
            GlCall::VertexAttribPointer(_) => "vertex_attrib_pointer",
            GlCall::SwitchAttribute { on: true, .. } => "enable_vertex_attrib_array",
            GlCall::SwitchAttribute { on: false, .. } => "disable_vertex_attrib_array",
            GlCall::ActiveTexture(_) => "active_texture",
            GlCall::BindTexture { .. } => "bind_texture",
            GlCall::TexImage2d { .. } => "tex_image_2d",
            GlCall::TexParameter { .. } => "tex_parameter",
            GlCall::GenerateMipmap { .. } => "generate_mipmap",
            GlCall::UseProgram(_) => "use_program",
            GlCall::Uniform { given: UniformArgument::Whole(_), .. } => "uniform_1i",
            GlCall::Uniform { given: UniformArgument::Floats(numbers), .. } => match numbers.len() {
                0 | 1 => "uniform_1f",
                2 => "uniform_2f",
                3 => "uniform_3f",
                _ => "uniform_4f",
            },
            GlCall::Viewport(_) => "viewport",
            GlCall::Switch { on: true, .. } => "enable",
            GlCall::Switch { on: false, .. } => "disable",
            GlCall::ClearColor(_) => "clear_color",
            GlCall::Clear(_) => "clear",
            GlCall::DrawArrays { .. } => "draw_arrays",
            GlCall::DrawElements { .. } => "draw_elements",
        }
    }

    /// Returns whether the call draws.
    pub fn draws(&self) -> bool {
        matches!(self, GlCall::DrawArrays { .. } | GlCall::DrawElements { .. })
    }
}

/// One of OpenGL's constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Constant {
    /// Without `GL_`.
    pub name: &'static str,
    /// OpenGL's number.
    pub value: u32,
}

macro_rules! constants {
    ($($name:ident)+) => {
        /// All constants. OpenGL checks whether one is valid for a call.
        pub const CONSTANTS: &[Constant] = &[$(Constant { name: stringify!($name), value: glow::$name }),+];
    };
}

constants! {
    TEXTURE_2D TEXTURE_CUBE_MAP TEXTURE_2D_ARRAY TEXTURE_3D
    TEXTURE_CUBE_MAP_POSITIVE_X TEXTURE_CUBE_MAP_NEGATIVE_X TEXTURE_CUBE_MAP_POSITIVE_Y
    TEXTURE_CUBE_MAP_NEGATIVE_Y TEXTURE_CUBE_MAP_POSITIVE_Z TEXTURE_CUBE_MAP_NEGATIVE_Z
    TEXTURE0 TEXTURE1 TEXTURE2 TEXTURE3 TEXTURE4 TEXTURE5 TEXTURE6 TEXTURE7
    TEXTURE8 TEXTURE9 TEXTURE10 TEXTURE11 TEXTURE12 TEXTURE13 TEXTURE14 TEXTURE15
    TEXTURE_MIN_FILTER TEXTURE_MAG_FILTER TEXTURE_WRAP_S TEXTURE_WRAP_T TEXTURE_WRAP_R
    TEXTURE_BASE_LEVEL TEXTURE_MAX_LEVEL
    NEAREST LINEAR NEAREST_MIPMAP_NEAREST LINEAR_MIPMAP_NEAREST NEAREST_MIPMAP_LINEAR LINEAR_MIPMAP_LINEAR
    REPEAT MIRRORED_REPEAT CLAMP_TO_EDGE CLAMP_TO_BORDER
    R8 RG8 RGB8 RGBA8 SRGB8 SRGB8_ALPHA8 RED RG RGB RGBA
    ARRAY_BUFFER ELEMENT_ARRAY_BUFFER STATIC_DRAW DYNAMIC_DRAW STREAM_DRAW
    BYTE UNSIGNED_BYTE SHORT UNSIGNED_SHORT INT UNSIGNED_INT HALF_FLOAT FLOAT DOUBLE
    POINTS LINES LINE_LOOP LINE_STRIP TRIANGLES TRIANGLE_STRIP TRIANGLE_FAN
    DEPTH_TEST CULL_FACE BLEND SCISSOR_TEST STENCIL_TEST
    COLOR_BUFFER_BIT DEPTH_BUFFER_BIT STENCIL_BUFFER_BIT
}

/// The constant of a name.
pub fn constant(name: &str) -> Option<Constant> {
    CONSTANTS.iter().copied().find(|constant| constant.name == name)
}

/// `TEXTURE0` and so on, by its number.
pub fn texture_unit(unit: u32) -> Option<Constant> {
    CONSTANTS.iter().copied().find(|constant| constant.value == glow::TEXTURE0 + unit)
}

impl Constant {
    /// The unit, where it is one of `TEXTURE0` to `TEXTURE15`.
    pub fn unit(self) -> Option<u32> {
        (glow::TEXTURE0..=glow::TEXTURE15).contains(&self.value).then(|| self.value - glow::TEXTURE0)
    }
}
