//! The commands, one module each.

pub mod about;
pub mod atlas;
pub mod bake;
pub mod beyond;
pub mod brdf;
pub mod convert;
pub mod course;
pub mod diff;
pub mod environment;
pub mod frame;
pub mod inspect;
pub mod lab;
pub mod lsp;
pub mod probe;
pub mod reference;
pub mod render;
pub mod scene;
pub mod serve;
pub mod simplify;
pub mod tour;
pub mod trace;
pub mod unwrap;
pub mod view;
