//! A scene as plain data, and the only place that opens a scene's files.
//!
//! [`SceneFile`] is what a person writes (TOML): everything in it is optional. [`Scene`] is complete: its files are read
//! and every default is filled in. [`Frame`] is the scene at one moment, the input of both renderers.

mod assemble;
mod asset_cache;
pub mod camera;
pub mod color_value;
pub mod defaults;
mod describe;
pub mod detail;
pub mod difference;
pub mod display;
pub mod edit;
pub mod environment;
pub mod environment_file;
pub mod files;
pub mod frame;
pub mod framing;
mod height_map;
mod image_file;
mod input_kind;
pub mod inspect;
pub mod load;
mod material_binding;
pub mod mip;
pub mod model_file;
mod model_scene;
pub mod model_textures;
pub mod motion;
mod option_text;
pub mod overlays;
pub mod picture;
mod sampling;
pub mod scene;
pub mod scene_file;
pub mod settings;
mod table_reader;
pub mod texture;
mod texture_library;
mod texture_recipe;
pub mod toml_reader;
mod toml_tree;
mod toml_writer;
pub mod validate;

pub use asset_cache::AssetCache;
pub use camera::Camera;
pub use display::{DisplayMap, ViewSpec};
pub use environment::{LoadedEnvironment, Surroundings};
pub use frame::{Background, Frame};
pub use overlays::{Overlay, Overlays, SpecialView};
pub use picture::Picture;
pub use scene::{BoundTexture, Maps, Object, ObjectPart, Scene, SceneMaterial};
pub use scene_file::SceneFile;
pub use settings::SceneSettings;
pub use texture::{ColorSpace, Texture, TextureFilter};
pub use texture_library::TextureUse;
