//! Scenes that exhibits start from.

use crate::GalleryError;
use gonio_scene::{SceneFile, toml_file};

/// A scene that exhibits start from. It names built-in models and environments only.
#[derive(Clone, Copy, Debug)]
pub enum BaseScene {
    /// The still life by night.
    StillLife,
    /// A portrait.
    Suzanne,
    /// One sphere.
    Sphere,
    /// A smooth sphere in the room.
    RoomSphere,
    /// Suzanne in the room.
    RoomSuzanne,
}

impl BaseScene {
    /// All base scenes.
    pub const ALL: [BaseScene; 5] =
        [BaseScene::StillLife, BaseScene::Suzanne, BaseScene::Sphere, BaseScene::RoomSphere, BaseScene::RoomSuzanne];

    /// Reads the scene.
    ///
    /// # Errors
    ///
    /// A fault in the built-in text.
    pub fn scene(self) -> Result<SceneFile, GalleryError> {
        let text = match self {
            BaseScene::StillLife => include_str!("base_scenes/still_life.toml"),
            BaseScene::Suzanne => include_str!("base_scenes/suzanne.toml"),
            BaseScene::Sphere => include_str!("base_scenes/sphere.toml"),
            BaseScene::RoomSphere => include_str!("base_scenes/room_sphere.toml"),
            BaseScene::RoomSuzanne => include_str!("base_scenes/room_suzanne.toml"),
        };
        Ok(toml_file::read(text)?)
    }

    /// Reads the scene and changes it.
    ///
    /// # Errors
    ///
    /// A fault in the built-in text.
    pub fn with(self, change: impl FnOnce(&mut SceneFile)) -> Result<SceneFile, GalleryError> {
        let mut scene = self.scene()?;
        change(&mut scene);
        Ok(scene)
    }
}
