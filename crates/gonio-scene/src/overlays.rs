//! Views of a scene besides its picture and the quantities of the equation, and overlays.

use gonio_light::named_enum;
use serde::{Deserialize, Serialize};

named_enum! {
    /// A view of a scene that is not a quantity of the light equation.
    pub enum SpecialView {
        /// The texture coordinates: eight by eight squares for each unit, red growing with u and green with v.
        UvChecker = "uv-checker",
        /// How many fragments were shaded at each pixel.
        Overdraw = "overdraw",
        /// Nothing but the background, for overlays by themselves.
        Nothing = "nothing",
    }
    default UvChecker;
    what "special view";
}

named_enum! {
    /// Something that is laid over a picture.
    pub enum Overlay {
        /// The edges of all triangles.
        Wireframe = "wireframe",
        /// The normals that the equation takes.
        Normals = "normals",
        /// The box around each object.
        Boxes = "boxes",
    }
    default Wireframe;
    what "overlay";
}

/// The overlays of a view: lines of one and a half pixels, hidden where a surface is in front of them, in colours of their
/// own whatever the exposure is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Overlays {
    /// The edges of all triangles.
    pub wireframe: bool,
    /// The normals that the equation takes: at each vertex, or in the middle of each triangle where shading is flat.
    /// They are a fiftieth of the diagonal of the box around all objects long, and shorter where triangles are many.
    pub normals: bool,
    /// The box around each object, along the axes of its model.
    pub boxes: bool,
}

impl FromIterator<Overlay> for Overlays {
    fn from_iter<I: IntoIterator<Item = Overlay>>(chosen: I) -> Self {
        chosen.into_iter().fold(Overlays::default(), |mut all, overlay| {
            match overlay {
                Overlay::Wireframe => all.wireframe = true,
                Overlay::Normals => all.normals = true,
                Overlay::Boxes => all.boxes = true,
            }
            all
        })
    }
}

impl Overlays {
    /// Whether there is any.
    pub fn any(&self) -> bool {
        *self != Overlays::default()
    }
}
