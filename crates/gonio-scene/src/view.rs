//! Views of a scene other than its picture: a quantity of the equation, special views, and overlays.

use gonio_light::{Quantity, named_enum};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// A debug view: a quantity of the equation, of one light or of all. Written `NAME` or `NAME:LIGHT`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ViewSpec {
    /// The quantity.
    pub quantity: Quantity,
    /// Index into the scene's lights.
    pub light: Option<usize>,
}

impl FromStr for ViewSpec {
    type Err = String;

    /// Names as in [`Quantity`], or its symbols (`N`, `L`, `V`, `R`, `H`, `T`, `att`, `d`, `A`, `E`).
    fn from_str(text: &str) -> Result<Self, String> {
        let (name, light) = match text.split_once(':') {
            None => (text, None),
            Some((name, index)) => {
                let index = index.trim().parse::<usize>().map_err(|_| {
                    format!("invalid light number `{index}`: write {name}:0 for the scene's first light")
                })?;
                (name, Some(index))
            }
        };
        let quantity = Quantity::ALL
            .iter()
            .copied()
            .find(|q| q.symbol().is_some_and(|s| s.eq_ignore_ascii_case(name.trim())))
            .map_or_else(|| name.parse::<Quantity>().map_err(|e| e.to_string()), Ok)?;
        if light.is_some() && !quantity.per_light() && !quantity.summed_over_lights() {
            return Err(format!("`{quantity}` does not belong to a light; write it without `:`"));
        }
        Ok(ViewSpec { quantity, light })
    }
}

impl std::fmt::Display for ViewSpec {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.light {
            None => write!(f, "{}", self.quantity),
            Some(light) => write!(f, "{}:{light}", self.quantity),
        }
    }
}

named_enum! {
    /// A view of a scene that is not a quantity of the light equation.
    pub enum SpecialView {
        /// The texture coordinates: eight by eight squares for each unit, red growing with u and green with v.
        UvChecker = "uv-checker",
        /// The number of fragments shaded at each pixel.
        Overdraw = "overdraw",
        /// The background only, for overlays by themselves.
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

/// The overlays of a view: lines of one and a half pixels, hidden where a surface is in front of them, in colours of
/// their own whatever the exposure is.
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
