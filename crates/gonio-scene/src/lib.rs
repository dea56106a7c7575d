//! A scene as plain data, and the only place that opens a scene's files.
//!
//! [`SceneFile`] is what a person writes (TOML): everything in it is optional. [`Scene`] is complete: its files are
//! read and every default is filled in. [`Frame`] is the scene at one moment, the input of both renderers.

mod asset_cache;
pub mod camera;
pub mod color_value;
pub mod convert;
pub mod defaults;
pub mod detail;
pub mod difference;
pub mod edit;
pub mod environment;
pub mod environment_check;
pub mod environment_file;
pub mod files;
pub mod frame;
pub mod framing;
mod ground;
mod image_file;
mod input_kind;
pub mod inspect;
mod light_settings;
mod light_spec;
pub mod load;
mod material_binding;
mod material_brdf;
pub mod model_file;
mod model_scene;
mod option_text;
pub mod part_material;
pub mod picture;
pub mod readers;
pub mod scene;
pub mod scene_file;
pub mod settings;
pub mod texture;
mod texture_library;
mod texture_recipe;
pub mod toml_file;
pub mod toml_table;
pub mod validate;
pub mod view;

pub use asset_cache::AssetCache;
pub use camera::Camera;
pub use environment::{LoadedEnvironment, Surroundings};
pub use frame::{Background, Frame, LightShape};
pub use ground::GroundPlane;
pub use image_file::picture_size;
pub use material_brdf::{MaterialBrdf, read_brdf_file};
pub use picture::{DisplayMap, Picture};
pub use scene::{BoundTexture, Maps, Object, ObjectPart, Scene, SceneMaterial};
pub use scene_file::SceneFile;
pub use settings::SceneSettings;
pub use texture::{ColorSpace, Texture, TextureFilter};
pub use texture_library::TextureUse;
pub use toml_table::nearest_word;
pub use view::{Overlay, Overlays, SpecialView, ViewSpec};
