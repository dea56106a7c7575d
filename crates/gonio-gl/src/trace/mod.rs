//! The frame taken apart: what OpenGL was told, as data that can be read, printed and checked.
//!
//! All calls go through [`crate::Gl`], which notes what exists and what is bound: no call can be made without its note.
//! While a [`Recording`] runs, each draw is noted with all that it reads: program, uniforms and their values, samplers, the units they read, and the textures
//! there. [`lint`] looks through the record for what is wrong. It works wherever gonio draws, WebGL2 included, and on
//! any sequence of calls: `Renderer::record` is one, a student's exercise another.
//!
//! Nothing is recorded, and nothing looked up, while no recording runs.

mod complete;
pub(crate) mod data;
mod lint;
mod program_reader;
pub(crate) mod recorder;
mod recording;
mod snapshot;
pub(crate) mod state;
mod thumbnails;
pub mod words;

pub use data::{
    ArraySource, AttachmentRecord, AttributeDeclaration, AttributeRecord, AttributeSource, BindingRecord, BlendRecord,
    ClearRecord, Content, DrawRecord, FrameRecord, LevelRecord, MOST_DRAWS, Numbers, PassRecord, ProgramRecord,
    SamplerRecord, SamplingRecord, StateRecord, Subject, TargetRecord, TextureRecord, Thumbnail, UniformDeclaration,
    UniformValue,
};
pub use lint::{Finding, Rule, Severity, lint};
pub use recording::Recording;
