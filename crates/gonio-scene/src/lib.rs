//! A scene as plain data, and the only place that opens a scene's files.
//!
//! [`description::Scene`] is what a person writes (TOML) and what `gonio scene` prints;
//! [`loaded::LoadedScene`] is the same with its files read; [`frame::Frame`] is one moment of it as
//! a renderer wants it.

mod assemble;
pub mod camera;
pub mod color_value;
mod describe;
pub mod description;
pub mod detail;
pub mod difference;
pub mod display;
mod document;
pub mod edit;
pub mod environment;
pub mod environment_file;
pub mod files;
pub mod frame;
pub mod framing;
mod height_map;
mod image_file;
pub mod inspect;
pub mod load;
pub mod loaded;
mod material_binding;
pub mod mip;
pub mod model_file;
mod model_kind;
mod model_scene;
pub mod model_textures;
pub mod motion;
mod option_text;
pub mod picture;
mod sampling;
pub mod show;
mod stock;
mod table_reader;
pub mod texture;
mod texture_library;
mod texture_recipe;
pub mod toml_reader;
mod toml_writer;
pub mod validate;

pub use camera::Camera;
pub use description::Scene;
pub use display::{DisplayMap, ViewSpec};
pub use environment::{LoadedEnvironment, Surroundings};
pub use frame::{Background, Frame};
pub use loaded::{BoundTexture, LoadedScene, Maps, Object, ObjectPart, SceneMaterial};
pub use picture::Picture;
pub use show::{Overlay, Overlays, SpecialView};
pub use stock::Stock;
pub use texture::{ColorSpace, Texture, TextureFilter};
pub use texture_library::TextureUse;
