//! A scene as plain data, and the only place that opens a scene's files.
//!
//! [`description::Scene`] is what a person writes (TOML) and what `gonio scene` prints;
//! [`loaded::LoadedScene`] is the same with its files read; [`frame::Frame`] is one moment of it as
//! a renderer wants it.

pub mod camera;
pub mod color_value;
pub mod description;
pub mod display;
pub mod files;
pub mod frame;
pub mod framing;
pub mod load;
pub mod loaded;
pub mod picture;
pub mod texture;
pub mod toml_reader;

pub use camera::Camera;
pub use description::Scene;
pub use display::{DisplayMap, ViewSpec};
pub use frame::{Background, Frame};
pub use loaded::{BoundTexture, LoadedScene, Maps, Object, ObjectPart, SceneMaterial};
pub use picture::Picture;
pub use texture::{ColorSpace, Texture, TextureFilter};
