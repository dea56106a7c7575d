//! What is shown of a scene: its picture or a view of it, and what is laid over that.

use gonio_scene::{Overlays, SpecialView, ViewSpec};

/// What is drawn of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum View {
    /// The picture.
    #[default]
    Picture,
    /// A quantity of the light equation.
    Quantity(ViewSpec),
    /// Another view.
    Special(SpecialView),
}

/// What is shown of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DisplayOptions {
    /// What is drawn of it.
    pub view: View,
    /// What is laid over it.
    pub overlays: Overlays,
}

impl From<Option<ViewSpec>> for View {
    fn from(view: Option<ViewSpec>) -> Self {
        view.map_or(View::Picture, View::Quantity)
    }
}

impl From<Option<ViewSpec>> for DisplayOptions {
    fn from(view: Option<ViewSpec>) -> Self {
        DisplayOptions { view: view.into(), overlays: Overlays::default() }
    }
}

impl View {
    /// The quantity, where it is one.
    pub(crate) fn quantity(self) -> Option<ViewSpec> {
        if let View::Quantity(view) = self { Some(view) } else { None }
    }

    /// The special view, where it is one.
    pub(crate) fn special(self) -> Option<SpecialView> {
        if let View::Special(view) = self { Some(view) } else { None }
    }
}
