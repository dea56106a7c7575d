//! Records of frames: the calls to OpenGL as data that can be read, printed and checked.
//!
//! All calls go through [`crate::Gl`], which tracks objects and bindings; no call can bypass it. While a [`Recording`] runs,
//! each draw is recorded with everything that it reads: program, uniforms and their values, samplers, their units, and the
//! textures there. [`lint`] searches the record for mistakes. Recording works wherever gonio draws, WebGL2 included, and for
//! any sequence of calls: `Renderer::record` is one, a student's program another.
//!
//! Nothing is recorded or queried while no recording runs.

mod complete;
pub(crate) mod data;
pub mod enums;
mod lint;
mod program_reader;
pub(crate) mod recorder;
mod recording;
mod snapshot;
pub(crate) mod state;
mod thumbnails;

pub use data::{
    ArraySource, AttachmentRecord, AttributeDeclaration, AttributeRecord, AttributeSource, BindingRecord, BlendRecord,
    ClearRecord, Content, DrawRecord, FrameRecord, LevelRecord, MOST_DRAWS, Numbers, PassRecord, ProgramRecord,
    SamplerRecord, SamplingRecord, StateRecord, Subject, TargetRecord, TextureRecord, Thumbnail, UniformDeclaration,
    UniformValue,
};
pub use lint::{Finding, Rule, Severity, lint};
pub use recording::Recording;
