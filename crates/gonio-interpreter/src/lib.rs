//! Runs GLSL shaders on the CPU over many points at once, and observes every value.
//!
//! A shader that `gonio-glsl` has parsed and checked is compiled once into instructions on registers; each instruction
//! works on a block of [`LANES`] points. Values that are the same at all points of a block are kept as one number.
//! Control flow is a set of active lanes. Arithmetic is that of 32-bit floats and integers, as on a GPU.

mod code;
mod compile;
mod lanes;
mod layout;
mod machine;
mod math;
mod run;
mod source;
mod texture;

pub use code::{CallFrame, CompiledStage, InputRate, StageInput, StageOutput, TracedVariable};
pub use compile::{Unsupported, compile};
pub use lanes::{LANES, LaneSet};
pub use machine::prepare_thread;
pub use run::{
    Anomaly, AnomalyKind, EndedEarly, Evaluation, Fragment, Interpolation, PointValues, RunOptions, StageInputs,
    StageRun, Substitute, TraceStep, TraceWrite, Varying, interpolate, run, varyings,
};
pub use source::{ExprId, SourceExpression, SourceMap, SourceStatement, StatementId};
pub use texture::{NoTexture, TextureDetail, TextureLookup, TextureSource};
