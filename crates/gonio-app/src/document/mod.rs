//! The document: everything that is edited, saved and undone, as plain data.

mod history;
mod pane;

pub use history::History;
pub use pane::{Arrangement, DifferenceSettings, Overlay, Pane, Panes, Reflectance, VIEW_KEYS};

use gonio_scene::SceneSettings;

/// Everything that the user edits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The effective scene: every default filled in.
    pub scene: SceneSettings,
    /// The panes that show it.
    pub panes: Panes,
}

impl Document {
    /// Wraps a scene that was just opened, in one pane.
    pub fn from_scene(scene: SceneSettings) -> Self {
        Document { scene, panes: Panes::default() }
    }
}
