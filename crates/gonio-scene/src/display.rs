//! From a renderer's numbers to the numbers of a picture file: light through exposure, tone map and
//! encoding; a debug view's vectors and scalars through the range that makes them visible.

use crate::frame::Frame;
use glam::DVec3;
use gonio_light::Quantity;
use gonio_light::color::OutputTransform;
use gonio_light::quantity::Encoding;
use std::str::FromStr;

/// A debug view: a quantity of the equation, and of which light. Written `NAME` or `NAME:LIGHT`.
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

/// A mapping of a renderer's linear numbers to the display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplayMap {
    /// Light.
    Light(OutputTransform),
    /// A vector or scalar: `scale * x + bias`, clamped to [0, 1], not encoded.
    Affine {
        /// Per component.
        scale: DVec3,
        /// Per component.
        bias: DVec3,
    },
}

impl DisplayMap {
    /// The map for a picture (`None`) or for a debug view of `frame`.
    pub fn for_view(view: Option<ViewSpec>, frame: &Frame) -> DisplayMap {
        let quantity = view.map_or(Quantity::Total, |v| v.quantity);
        let identity = DisplayMap::Affine { scale: DVec3::ONE, bias: DVec3::ZERO };
        // The range [low, high] becomes [0, 1]; a range without extent is shown as it is.
        let range = |low: DVec3, high: DVec3| {
            let extent = high - low;
            let scale = DVec3::select(extent.cmpgt(DVec3::splat(1e-12)), 1.0 / extent, DVec3::ONE);
            DisplayMap::Affine { scale, bias: -low * scale }
        };
        match quantity.encoding() {
            Encoding::Color => DisplayMap::Light(frame.output),
            Encoding::Factor => identity,
            Encoding::Direction => DisplayMap::Affine { scale: DVec3::splat(0.5), bias: DVec3::splat(0.5) },
            Encoding::Position => range(frame.bounds_min, frame.bounds_max),
            Encoding::Distance => {
                let extent = (frame.bounds_max - frame.bounds_min).length();
                let center = 0.5 * (frame.bounds_min + frame.bounds_max);
                match quantity {
                    Quantity::Depth => {
                        let middle = frame.camera.depth_of(center);
                        range(DVec3::splat((middle - 0.5 * extent).max(0.0)), DVec3::splat(middle + 0.5 * extent))
                    }
                    _ => range(DVec3::ZERO, DVec3::splat(2.0 * extent)),
                }
            }
        }
    }

    /// Whether what is outside the objects is black (debug views) instead of the background.
    pub fn is_affine(&self) -> bool {
        matches!(self, DisplayMap::Affine { .. })
    }

    /// A pixel with premultiplied alpha to the picture's numbers in [0, 1], alpha not premultiplied.
    ///
    /// Debug views of vectors and scalars are opaque, black where nothing is.
    pub fn apply(&self, pixel: [f32; 4]) -> [f64; 4] {
        let alpha = f64::from(pixel[3]).clamp(0.0, 1.0);
        if alpha <= 0.0 {
            return if self.is_affine() { [0.0, 0.0, 0.0, 1.0] } else { [0.0; 4] };
        }
        let value = DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into()) / alpha;
        match self {
            DisplayMap::Light(transform) => {
                let c = transform.encode(value);
                [c.x, c.y, c.z, alpha]
            }
            DisplayMap::Affine { scale, bias } => {
                let c = (*scale * value + *bias).clamp(DVec3::ZERO, DVec3::ONE) * alpha;
                [c.x, c.y, c.z, 1.0]
            }
        }
    }
}
