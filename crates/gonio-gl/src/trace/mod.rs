//! Records of frames: the calls to OpenGL as data that can be read, printed and checked.
//!
//! All calls go through [`crate::Gl`], which tracks objects and bindings; no call can bypass it. While a [`Recording`] runs,
//! each draw is recorded with everything that it reads: program, uniforms and their values, samplers, their units, and the
//! textures there. [`lint()`] searches the record for mistakes. Recording works wherever gonio draws, WebGL2 included, and for
//! any sequence of calls: `Renderer::record` is one, a student's program another.
//!
//! Nothing is recorded or queried while no recording runs.

pub(crate) mod data;
pub mod enums;
mod lint;
pub(crate) mod object_state;
mod program_reader;
pub(crate) mod recorder;
mod recording;
mod snapshot;
pub(crate) mod state;

pub use data::{
    ArraySource, AttachmentRecord, AttributeDeclaration, AttributeRecord, AttributeSource, BindingRecord, BlendRecord,
    ClearRecord, DrawRecord, DrawSubject, FrameRecord, LevelRecord, MOST_DRAWS, PassRecord, ProgramRecord,
    SamplerRecord, SamplingRecord, StateRecord, TargetRecord, TexelEncoding, TextureRecord, Thumbnail,
    UniformDeclaration, UniformNumbers, UniformValue,
};
pub use lint::{Finding, Rule, Severity, lint};
pub use recording::Recording;
