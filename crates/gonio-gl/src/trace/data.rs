//! The record of a frame as plain data: passes, draws, programs, textures. No OpenGL.
//!
//! Objects are named by **id**: the number that `glGen…` returned. WebGL does not reveal these numbers; there objects are counted
//! in the order of creation, as drivers do.

use serde::Serialize;

/// Most draw calls that a record lists; more are counted. A model of transparent triangles may have one draw for each.
pub const MOST_DRAWS: usize = 2000;

/// Everything that happened during a recording, in order.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FrameRecord {
    /// The number of texture units of the driver, over all stages.
    pub texture_units: u32,
    /// Runs of commands that draw into one framebuffer.
    pub passes: Vec<PassRecord>,
    /// Draw calls, in order.
    pub draws: Vec<DrawRecord>,
    /// Programs that drew, in order of their first draw.
    pub programs: Vec<ProgramRecord>,
    /// All textures by id, including those that no draw reads.
    pub textures: Vec<TextureRecord>,
    /// Draw calls beyond the most that are kept ([`MOST_DRAWS`]).
    pub draws_left_out: usize,
    /// Notes, one sentence each.
    pub notes: Vec<String>,
}

impl FrameRecord {
    /// The texture of an id.
    pub fn texture(&self, id: u32) -> Option<&TextureRecord> {
        self.textures.iter().find(|t| t.id == id)
    }

    /// The program that a draw used.
    pub fn program_of(&self, draw: &DrawRecord) -> Option<&ProgramRecord> {
        self.programs.get(draw.program?)
    }
}

/// Consecutive commands into one framebuffer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassRecord {
    /// The outermost debug group, or what is drawn into.
    pub name: String,
    /// Its render target.
    pub target: TargetRecord,
    /// The clear of the pass, if there is one.
    pub cleared: Option<ClearRecord>,
    /// The framebuffer into which its samples were averaged (`glBlitFramebuffer`).
    pub resolved_into: Option<String>,
    /// Its first draw.
    pub first_draw: usize,
    /// The number of draws.
    pub draw_count: usize,
}

/// A framebuffer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TargetRecord {
    /// Its id; 0 is the window.
    pub id: u32,
    /// Its label.
    pub name: String,
    /// Pixels; 0 if unknown, as for a window.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// The format of its first colour, as OpenGL names it.
    pub format: Option<String>,
    /// Its attachments.
    pub attachments: Vec<AttachmentRecord>,
}

/// An attachment of a framebuffer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttachmentRecord {
    /// `color 0`, `depth`, ...
    pub point: String,
    /// The texture's id; `None` for a renderbuffer.
    pub texture: Option<u32>,
    /// The level of the texture.
    pub level: u32,
    /// Its label.
    pub name: String,
    /// As OpenGL names it, for example `RGBA16F`.
    pub format: String,
}

/// `glClear`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ClearRecord {
    /// The colour, if colours are cleared.
    pub color: Option<[f32; 4]>,
    /// The depth, if depths are cleared.
    pub depth: Option<f32>,
}

/// One draw call, with everything that it read.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrawRecord {
    /// Its place among all draws of the record.
    pub index: usize,
    /// The pass that it belongs to.
    pub pass: usize,
    /// Debug groups around it, the outermost first.
    pub groups: Vec<String>,
    /// The subject of the draw, if the caller named it.
    pub subject: Option<DrawSubject>,
    /// Its program, an index into [`FrameRecord::programs`]; `None` where none was in use.
    pub program: Option<usize>,
    /// `triangles`, `lines`, ...
    pub primitive: String,
    /// Vertices, or indices where it is indexed.
    pub count: u32,
    /// The first vertex, or the first index.
    pub first: u32,
    /// Whether vertices come through an index buffer.
    pub indexed: bool,
    /// The highest vertex that is read; `None` if it is unknown or no vertex is read.
    pub highest_vertex: Option<u32>,
    /// The number of instances.
    pub instances: u32,
    /// Vertex shader invocations, as counted by the GPU; `None` if the driver cannot count.
    pub vertices_shaded: Option<u64>,
    /// Fragment shader invocations: whole 2 x 2 blocks, and every sample if all are shaded. `None` if the driver cannot count.
    pub fragments_shaded: Option<u64>,
    /// Fixed functions.
    pub state: StateRecord,
    /// Values of the uniforms that are not samplers.
    pub uniforms: Vec<UniformValue>,
    /// The samplers and their textures.
    pub samplers: Vec<SamplerRecord>,
    /// The attributes of the vertex shader.
    pub attributes: Vec<AttributeRecord>,
    /// All textures that are bound to units.
    pub units: Vec<BindingRecord>,
    /// Textures that were bound between the previous draw and this one.
    pub bound: Vec<BindingRecord>,
    /// Errors that OpenGL reported since the previous draw or at this one, for example `INVALID_OPERATION`.
    pub errors: Vec<String>,
}

impl DrawRecord {
    /// The title in reports: object, part and material, or the innermost debug group, or `draw 3`.
    pub fn title(&self) -> String {
        match (&self.subject, self.groups.last()) {
            (Some(subject), _) => subject.to_string(),
            (None, Some(group)) => group.clone(),
            (None, None) => format!("draw {}", self.index),
        }
    }
}

/// The subject of a draw.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct DrawSubject {
    /// The object's index in its scene.
    pub index: usize,
    /// The object's name.
    pub object: String,
    /// The part's name; may be empty.
    pub part: String,
    /// The material's name.
    pub material: String,
}

impl std::fmt::Display for DrawSubject {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let DrawSubject { index: _, object, part, material } = self;
        f.write_str(object)?;
        if !part.is_empty() && part != object {
            write!(f, " {part}")?;
        }
        if material.is_empty() { Ok(()) } else { write!(f, " [{material}]") }
    }
}

/// The fixed functions around a draw.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StateRecord {
    /// `None` where blending is off.
    pub blend: Option<BlendRecord>,
    /// `less`, ...; `None` where depth is not tested.
    pub depth_test: Option<String>,
    /// Whether depth is written.
    pub depth_mask: bool,
    /// `back`, ...; `None` where nothing is culled.
    pub cull: Option<String>,
    /// `counter-clockwise` or `clockwise`.
    pub front_face: String,
    /// Whether red, green, blue and alpha are written.
    pub color_mask: [bool; 4],
    /// x, y of the lower left corner, width, height, in pixels.
    pub viewport: [i32; 4],
    /// The scissor rectangle; `None` if there is no scissor test.
    pub scissor: Option<[i32; 4]>,
}

/// Blending.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlendRecord {
    /// Factors of the source's and the destination's colour, for example `one`, `one minus source alpha`.
    pub color: [String; 2],
    /// The factors for alpha.
    pub alpha: [String; 2],
}

/// A program.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ProgramRecord {
    /// Its id.
    pub id: u32,
    /// Its label.
    pub name: String,
    /// GLSL of the vertex shader; empty if it was compiled before the recording and is no longer known.
    pub vertex_source: String,
    /// GLSL of the fragment shader.
    pub fragment_source: String,
    /// Attributes that the vertex shader reads.
    pub attributes: Vec<AttributeDeclaration>,
    /// Uniforms, samplers among them, that the program needs.
    pub uniforms: Vec<UniformDeclaration>,
}

/// An active attribute.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttributeDeclaration {
    /// Its name in GLSL.
    pub name: String,
    /// Its GLSL type.
    pub glsl_type: String,
    /// Its location.
    pub location: u32,
}

/// An active uniform.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UniformDeclaration {
    /// Its name in GLSL, without `[0]`.
    pub name: String,
    /// Its GLSL type.
    pub glsl_type: String,
    /// Its location; `None` on the web, where locations are not numbers, and for members of blocks.
    pub location: Option<u32>,
    /// Number of elements; 1 if it is not an array.
    pub array_size: u32,
}

/// A uniform at a draw.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UniformValue {
    /// Its name in GLSL, without `[0]`.
    pub name: String,
    /// Its GLSL type, of one element.
    pub glsl_type: String,
    /// Whether it was set since its program was linked.
    pub sent: bool,
    /// Its numbers; those of an array one after the other, matrices column by column.
    pub value: UniformNumbers,
}

/// Numbers of a uniform.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum UniformNumbers {
    /// `float`, vectors and matrices.
    Float(Vec<f32>),
    /// `int` and vectors of it.
    Int(Vec<i32>),
    /// `uint` and vectors of it.
    Uint(Vec<u32>),
    /// `bool` and vectors of it.
    Bool(Vec<bool>),
}

impl UniformNumbers {
    /// The number of values.
    pub fn len(&self) -> usize {
        match self {
            UniformNumbers::Float(v) => v.len(),
            UniformNumbers::Int(v) => v.len(),
            UniformNumbers::Uint(v) => v.len(),
            UniformNumbers::Bool(v) => v.len(),
        }
    }

    /// Whether there are no values, because they could not be read.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether all are 0 or false, the initial value of a uniform.
    pub fn is_zero(&self) -> bool {
        match self {
            UniformNumbers::Float(v) => v.iter().all(|v| *v == 0.0),
            UniformNumbers::Int(v) => v.iter().all(|v| *v == 0),
            UniformNumbers::Uint(v) => v.iter().all(|v| *v == 0),
            UniformNumbers::Bool(v) => v.iter().all(|v| !v),
        }
    }

    /// The floats, where they are.
    pub fn floats(&self) -> Option<&[f32]> {
        if let UniformNumbers::Float(v) = self { Some(v) } else { None }
    }
}

/// A sampler at a draw: sampler, unit, texture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SamplerRecord {
    /// Its name in GLSL; `name[1]` for an element of an array.
    pub name: String,
    /// Its GLSL type, for example `sampler2D`.
    pub glsl_type: String,
    /// The unit that it reads.
    pub unit: u32,
    /// The last value passed to `glUniform1i` for it, which OpenGL refuses if no unit has that number; `None` if it was
    /// never set, or set before the recording.
    pub sent: Option<i32>,
    /// Whether it was set since its program was linked.
    pub was_set: bool,
    /// The texture of the sampler's kind that is bound to the unit, by id.
    pub texture: Option<u32>,
    /// The sampling parameters.
    pub sampling: Option<SamplingRecord>,
    /// The reason why the texture is incomplete at this draw, and reads as black; `None` if it is complete.
    pub incomplete: Option<String>,
    /// Ids of textures of other kinds that are bound to the unit.
    pub others: Vec<u32>,
    /// The subject of the earlier draw that bound the texture, if it is not this one.
    pub bound_for: Option<DrawSubject>,
}

/// A texture's parameters at a draw. They are part of the texture's state and may change before the next draw.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SamplingRecord {
    /// `nearest`, `linear`, `linear mipmap linear`, ...
    pub min_filter: String,
    /// `nearest` or `linear`.
    pub mag_filter: String,
    /// `repeat`, `clamp to edge`, ... along s and t.
    pub wrap: [String; 2],
    /// The first level that may be read.
    pub base_level: u32,
    /// The last level that may be read; 1000 if it was never set.
    pub max_level: u32,
}

/// A texture and the unit that it is bound to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BindingRecord {
    /// The unit.
    pub unit: u32,
    /// `2D`, `cube`, ...
    pub kind: String,
    /// The texture's id; `None` if the unit was unbound.
    pub texture: Option<u32>,
}

/// An attribute at a draw.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttributeRecord {
    /// Its name in GLSL.
    pub name: String,
    /// Its GLSL type.
    pub glsl_type: String,
    /// Its location.
    pub location: u32,
    /// The source of its values.
    pub source: AttributeSource,
}

/// The source of the values of an attribute.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum AttributeSource {
    /// A value of its own for each vertex.
    Array(ArraySource),
    /// One value for all vertices.
    Constant {
        /// x, y, z, w.
        value: [f32; 4],
        /// Whether it was set (`glVertexAttrib4f`); otherwise it is the initial value.
        set: bool,
    },
}

/// `glVertexAttribPointer`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ArraySource {
    /// The buffer's id; 0 where none was bound.
    pub buffer: u32,
    /// The buffer's label.
    pub buffer_name: String,
    /// Bytes in the buffer.
    pub buffer_bytes: u64,
    /// Numbers for each vertex, 1 to 4.
    pub components: u32,
    /// `float`, `unsigned byte`, ...
    pub component_type: String,
    /// Bytes of all components of one vertex.
    pub element_bytes: u32,
    /// Whether integers are mapped to -1 to 1 or 0 to 1.
    pub normalized: bool,
    /// Bytes from one vertex to the next, as passed to OpenGL; 0 means tightly packed.
    pub stride: u32,
    /// The first vertex's first byte.
    pub offset: u32,
    /// 0: a value for each vertex; n: one for each n instances.
    pub divisor: u32,
}

impl ArraySource {
    /// Bytes from one vertex to the next; a stride of 0 is replaced by the size of an element.
    pub fn effective_stride(&self) -> u32 {
        if self.stride == 0 { self.element_bytes } else { self.stride }
    }
}

/// A description in one line.
impl std::fmt::Display for ArraySource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (stride, offset) = (self.effective_stride(), self.offset);
        write!(
            f,
            "{} x {} from `{}`, offset {offset}, stride {stride}",
            self.components, self.component_type, self.buffer_name
        )
    }
}

/// A texture.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TextureRecord {
    /// Its id.
    pub id: u32,
    /// Its label.
    pub name: String,
    /// `2D`, `cube`, `2D array`, `3D`, `2D multisample`; empty where it was never bound.
    pub kind: String,
    /// Texels of the largest level.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// Layers of an array, slices of a 3-D texture, else 1.
    pub depth: u32,
    /// Samples per texel, at least 1.
    pub samples: u32,
    /// As OpenGL names it, for example `SRGB8_ALPHA8`.
    pub format: String,
    /// Its levels, the largest first.
    pub levels: Vec<LevelRecord>,
    /// The encoding of its texels.
    pub content: TexelEncoding,
    /// A small picture of it, if it was requested.
    #[serde(skip)]
    pub thumbnail: Option<Thumbnail>,
}

/// One level of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct LevelRecord {
    /// 0 is the largest.
    pub level: u32,
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// The number of faces of a cubemap that have it; 1 for any other texture.
    pub faces: u32,
}

/// The encoding of values in the texels of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TexelEncoding {
    /// The values themselves.
    #[default]
    Plain,
    /// A number t from 0 to 1 as 2 t - 1.
    SignedHalves,
}

/// A small picture: rows from the top, RGBA of 8 bits, at most [`Thumbnail::MOST`] along a side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thumbnail {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Four bytes a pixel, sRGB, alpha not premultiplied.
    pub rgba: Vec<u8>,
}

impl Thumbnail {
    /// Pixels along the longer side.
    pub const MOST: u32 = 64;
}
