//! What is edited, saved and undone: plain data.

mod history;
mod pane;

pub use history::History;
pub use pane::{Arrangement, DifferenceSettings, Overlay, Pane, Panes, Reflectance, VIEW_KEYS};

use gonio_scene::SceneSettings;

/// Everything that a person changes in the window and would want back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The effective scene: every default filled in.
    pub scene: SceneSettings,
    /// In how many ways it is shown, and how.
    pub panes: Panes,
}

impl Document {
    /// A scene that was just opened, in one pane.
    pub fn of(scene: SceneSettings) -> Self {
        Document { scene, panes: Panes::default() }
    }
}
