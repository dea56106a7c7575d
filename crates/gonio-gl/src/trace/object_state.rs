//! Objects of a context, as calls have made them: textures, buffers, vertex arrays, framebuffers, programs.

use super::data::{DrawSubject, TexelEncoding};
use super::enums::TextureKind;
use crate::bounds::{EnabledArray, IndexLimits, SharedContents};
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// A texture unit.
#[derive(Default)]
pub struct TextureUnit {
    /// For each [`TextureKind`].
    pub bound: [Option<Binding>; TextureKind::ALL.len()],
}

/// A texture that is bound to a unit.
#[derive(Clone)]
pub struct Binding {
    /// The texture.
    pub texture: glow::Texture,
    /// The subject for which it was bound during a recording, with its number.
    pub owner: Option<(usize, Rc<DrawSubject>)>,
}

/// An object's number and label.
#[derive(Clone, Debug, Default)]
pub struct Label {
    /// The number that OpenGL names it by.
    pub id: u32,
    /// The label.
    pub name: String,
}

/// A texture.
#[derive(Default)]
pub struct TextureState {
    /// Its number and label.
    pub label: Label,
    /// `None` until the first use.
    pub kind: Option<TextureKind>,
    /// The format of the last image.
    pub format: u32,
    /// Width, height and faces of each level.
    pub levels: BTreeMap<u32, LevelState>,
    /// Layers or slices.
    pub depth: u32,
    /// Per texel.
    pub samples: u32,
    /// The encoding of its texels.
    pub content: TexelEncoding,
}

/// A level of a texture.
#[derive(Clone, Copy, Default)]
pub struct LevelState {
    /// Texels.
    pub size: [u32; 2],
    /// A bit for each face of a cubemap; the first bit for other textures.
    pub faces: u8,
}

impl TextureState {
    /// Notes an image of a target. Of cubemaps all faces should be of one size; the last one's is kept.
    pub fn image(&mut self, target: u32, level: i32, format: u32, size: [i32; 2], depth: i32, samples: i32) {
        let face = match target {
            glow::TEXTURE_CUBE_MAP_POSITIVE_X..=glow::TEXTURE_CUBE_MAP_NEGATIVE_Z => {
                target - glow::TEXTURE_CUBE_MAP_POSITIVE_X
            }
            _ => 0,
        };
        let state = self.levels.entry(level.max(0) as u32).or_default();
        let size = size.map(|side| side.max(0) as u32);
        if state.size != size {
            *state = LevelState { size, faces: 0 };
        }
        state.faces |= 1 << face;
        self.format = format;
        self.depth = depth.max(1) as u32;
        self.samples = samples.max(1) as u32;
    }

    /// Notes all levels below the first, as `glGenerateMipmap` makes them.
    pub fn mipmaps(&mut self) {
        let Some(&first) = self.levels.get(&0) else { return };
        let mut size = first.size;
        let mut level = 0;
        while size.into_iter().max() > Some(1) {
            size = size.map(|side| (side / 2).max(1));
            level += 1;
            self.levels.insert(level, LevelState { size, ..first });
        }
    }
}

/// A buffer.
#[derive(Default)]
pub struct BufferState {
    /// Its number and label.
    pub label: Label,
    /// Its contents.
    pub contents: SharedContents,
}

/// A vertex array.
#[derive(Default)]
pub struct ArrayState {
    /// Its number and label.
    pub label: Label,
    /// By location.
    pub attributes: HashMap<u32, AttributeState>,
    /// The buffer bound to `GL_ELEMENT_ARRAY_BUFFER`.
    pub index_buffer: Option<glow::Buffer>,
    /// The contents of that buffer.
    pub indices: Option<SharedContents>,
    /// The number of buffer fills at the last count, and the limits found then.
    pub limits: Option<(u64, IndexLimits)>,
}

impl ArrayState {
    /// An attribute, to be changed.
    pub fn attribute(&mut self, index: u32) -> &mut AttributeState {
        self.limits = None;
        self.attributes.entry(index).or_default()
    }
}

/// An attribute of a vertex array.
#[derive(Clone, Default)]
pub struct AttributeState {
    /// Whether it is read from its buffer.
    pub enabled: bool,
    /// The buffer that was bound when it was described.
    pub buffer: Option<glow::Buffer>,
    /// The contents of that buffer.
    pub contents: Option<SharedContents>,
    /// Numbers for each vertex; 0 where it was not described.
    pub components: u32,
    /// `GL_FLOAT`, ...
    pub component_type: u32,
    /// Whether integers are mapped to fractions.
    pub normalized: bool,
    /// As passed to `glVertexAttribPointer`.
    pub stride: u32,
    /// As passed to `glVertexAttribPointer`.
    pub offset: u32,
    /// As passed to `glVertexAttribDivisor`.
    pub divisor: u32,
}

impl AttributeState {
    pub(super) fn as_enabled_array(&self) -> EnabledArray<'_> {
        EnabledArray {
            contents: self.contents.as_ref(),
            components: self.components,
            component_type: self.component_type,
            stride: self.stride,
            offset: self.offset,
            divisor: self.divisor,
        }
    }
}

/// A framebuffer.
#[derive(Default)]
pub struct FramebufferState {
    /// Its number and label.
    pub label: Label,
    /// By attachment.
    pub attachments: BTreeMap<u32, Attached>,
}

/// An attachment of a framebuffer.
#[derive(Clone, Copy)]
pub enum Attached {
    /// A level of a texture.
    Texture(glow::Texture, u32),
    /// A renderbuffer.
    Renderbuffer(glow::Renderbuffer),
}

/// A renderbuffer.
#[derive(Default)]
pub struct RenderbufferState {
    /// Its number and label.
    pub label: Label,
    /// `GL_RGBA8`, ...
    pub format: u32,
    /// Pixels.
    pub size: [u32; 2],
    /// Per pixel.
    pub samples: u32,
}

/// A program.
#[derive(Default)]
pub struct ProgramState {
    /// Its number and label.
    pub label: Label,
    /// Uniforms whose locations were queried. [`crate::program::Program`] queries them when it first sets one.
    pub looked_up: Vec<(glow::UniformLocation, String)>,
    /// Uniforms that were set while a recording ran, without `[0]`, and the integers that were set last.
    pub sent: HashMap<String, Option<Vec<i32>>>,
    /// Whether it was linked during the current recording, so that `sent` has everything that was ever set.
    pub is_fresh: bool,
    /// Vertex and fragment shader, where they were compiled while a recording ran.
    pub sources: [String; 2],
}

impl ProgramState {
    /// Returns whether a uniform, without `[0]`, was set since the program was linked.
    pub fn was_sent(&self, name: &str) -> bool {
        self.sent.contains_key(name)
            || (!self.is_fresh && self.looked_up.iter().any(|(_, looked_up)| base_name(looked_up) == name))
    }
}

/// A uniform's name without the `[0]` of arrays.
pub fn base_name(name: &str) -> &str {
    name.strip_suffix("[0]").unwrap_or(name)
}
