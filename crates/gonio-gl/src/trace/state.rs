//! What exists and what is bound, as the calls through [`crate::Gl`] have made it.
//!
//! OpenGL can be asked for most of this, WebGL2 for little: not for a texture's size, nor for its format. So it is noted
//! when it is made, which is seldom; of what happens often only the few words of a binding are kept.

use super::data::{Content, Subject};
use super::recorder::Recorder;
use super::words::TextureKind;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// The state of a context, shared by all clones of its [`crate::Gl`].
#[derive(Default)]
pub struct Mirror {
    state: RefCell<State>,
}

impl Mirror {
    /// Reads or changes the state. Not from within itself.
    pub fn with<T>(&self, f: impl FnOnce(&mut State) -> T) -> T {
        f(&mut self.state.borrow_mut())
    }
}

/// What exists and what is bound.
#[derive(Default)]
pub struct State {
    /// From 0.
    pub active_unit: usize,
    /// Grows with the units that are used.
    pub units: Vec<Unit>,
    /// All textures.
    pub textures: HashMap<glow::Texture, TextureState>,
    /// All buffers.
    pub buffers: HashMap<glow::Buffer, BufferState>,
    /// What is bound to `GL_ARRAY_BUFFER`.
    pub array_buffer: Option<glow::Buffer>,
    /// All vertex arrays; `None` is the one that there always is.
    pub arrays: HashMap<Option<glow::VertexArray>, ArrayState>,
    /// The one that is bound.
    pub vertex_array: Option<glow::VertexArray>,
    /// All framebuffers.
    pub framebuffers: HashMap<glow::Framebuffer, FramebufferState>,
    /// What is drawn into; `None` is the window.
    pub draw_framebuffer: Option<glow::Framebuffer>,
    /// All renderbuffers.
    pub renderbuffers: HashMap<glow::Renderbuffer, RenderbufferState>,
    /// The one that is bound.
    pub renderbuffer: Option<glow::Renderbuffer>,
    /// All programs.
    pub programs: HashMap<glow::Program, ProgramState>,
    /// The one that is in use.
    pub program: Option<glow::Program>,
    /// Kinds and sources of shaders, while a recording runs.
    pub shaders: HashMap<glow::Shader, (u32, String)>,
    /// While a recording runs.
    pub recorder: Option<Box<Recorder>>,
    /// How many objects were made, where OpenGL shows no numbers of its own.
    pub made: u32,
}

/// Most units that are kept an eye on; the drivers known have at most 192.
const MOST_UNITS: usize = 256;

impl State {
    /// The slot of the active unit for textures of a kind.
    pub fn slot(&mut self, kind: TextureKind) -> Option<&mut Option<Binding>> {
        let unit = self.active_unit;
        if unit >= MOST_UNITS {
            return None;
        }
        if self.units.len() <= unit {
            self.units.resize_with(unit + 1, Unit::default);
        }
        self.units.get_mut(unit)?.bound.get_mut(kind.index())
    }

    /// What is bound to a unit.
    pub fn bound(&self, unit: u32, kind: TextureKind) -> Option<&Binding> {
        self.units.get(unit as usize)?.bound.get(kind.index())?.as_ref()
    }

    /// The texture of the active unit, for a target or a face of a cubemap.
    pub fn bound_texture(&mut self, target: u32) -> Option<&mut TextureState> {
        let kind = TextureKind::of_target(target)?;
        let texture = self.slot(kind)?.as_ref()?.texture;
        let state = self.textures.get_mut(&texture)?;
        state.kind = Some(kind);
        Some(state)
    }

    /// The vertex array that is bound.
    pub fn array(&mut self) -> &mut ArrayState {
        self.arrays.entry(self.vertex_array).or_default()
    }
}

/// A texture unit.
#[derive(Default)]
pub struct Unit {
    /// For each [`TextureKind`].
    pub bound: [Option<Binding>; TextureKind::ALL.len()],
}

/// What is bound to a unit.
#[derive(Clone)]
pub struct Binding {
    /// The texture.
    pub texture: glow::Texture,
    /// The draw for which it was bound, where a recording knows: its number among the subjects, and the subject.
    pub owner: Option<(usize, Rc<Subject>)>,
}

/// An object's number and label.
#[derive(Clone, Debug, Default)]
pub struct Label {
    /// OpenGL's name of it.
    pub id: u32,
    /// For people.
    pub name: String,
}

/// A texture.
#[derive(Default)]
pub struct TextureState {
    /// Number and label.
    pub label: Label,
    /// Known from the first use.
    pub kind: Option<TextureKind>,
    /// Of the last image given.
    pub format: u32,
    /// Width, height and faces of each level.
    pub levels: BTreeMap<u32, LevelState>,
    /// Layers or slices.
    pub depth: u32,
    /// Per texel.
    pub samples: u32,
    /// How texels hold what they mean.
    pub content: Content,
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
    /// Number and label.
    pub label: Label,
    /// Bytes.
    pub bytes: u64,
}

/// A vertex array.
#[derive(Default)]
pub struct ArrayState {
    /// Number and label.
    pub label: Label,
    /// By location.
    pub attributes: HashMap<u32, AttributeState>,
    /// What is bound to `GL_ELEMENT_ARRAY_BUFFER`.
    pub index_buffer: Option<glow::Buffer>,
}

/// An attribute of a vertex array.
#[derive(Clone, Copy, Default)]
pub struct AttributeState {
    /// Whether it is read from its buffer.
    pub enabled: bool,
    /// The buffer that was bound when it was described.
    pub buffer: Option<glow::Buffer>,
    /// Numbers for each vertex; 0 where it was not described.
    pub components: u32,
    /// `GL_FLOAT`, ...
    pub component_type: u32,
    /// Whether integers are mapped to fractions.
    pub normalized: bool,
    /// As given.
    pub stride: u32,
    /// As given.
    pub offset: u32,
    /// As given.
    pub divisor: u32,
}

/// A framebuffer.
#[derive(Default)]
pub struct FramebufferState {
    /// Number and label.
    pub label: Label,
    /// By attachment.
    pub attachments: BTreeMap<u32, Attached>,
}

/// What is attached to a framebuffer.
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
    /// Number and label.
    pub label: Label,
    /// In OpenGL's number.
    pub format: u32,
    /// Pixels.
    pub size: [u32; 2],
    /// Per pixel.
    pub samples: u32,
}

/// A program.
#[derive(Default)]
pub struct ProgramState {
    /// Number and label.
    pub label: Label,
    /// Uniforms whose locations were asked for. Our own programs ask when they first set one.
    pub looked_up: Vec<(glow::UniformLocation, String)>,
    /// Uniforms that were set while a recording ran, without `[0]`, and the whole numbers last given.
    pub sent: HashMap<String, Option<Vec<i32>>>,
    /// Whether it was linked while the recording ran that runs now, so that `sent` is all that was ever set.
    pub is_fresh: bool,
    /// Vertex and fragment shader, where they were compiled while a recording ran.
    pub sources: [String; 2],
}

impl ProgramState {
    /// Whether a uniform, without `[0]`, was set since the program was linked.
    pub fn was_sent(&self, name: &str) -> bool {
        self.sent.contains_key(name)
            || (!self.is_fresh && self.looked_up.iter().any(|(_, looked_up)| base_name(looked_up) == name))
    }
}

/// A uniform's name without the `[0]` of arrays.
pub fn base_name(name: &str) -> &str {
    name.strip_suffix("[0]").unwrap_or(name)
}
