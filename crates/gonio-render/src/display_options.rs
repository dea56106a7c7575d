//! Display options of a scene: its picture or another view, and overlays.

use gonio_scene::{Overlays, SpecialView, ViewSpec};

/// A view of a scene.
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

/// A view of a scene, and overlays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DisplayOptions {
    /// The view.
    pub view: View,
    /// The overlays.
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
    /// The quantity, if the view is one.
    pub(crate) fn quantity(self) -> Option<ViewSpec> {
        if let View::Quantity(view) = self { Some(view) } else { None }
    }

    /// The special view, if it is one.
    pub(crate) fn special(self) -> Option<SpecialView> {
        if let View::Special(view) = self { Some(view) } else { None }
    }
}
