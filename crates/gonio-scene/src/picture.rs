//! A rendered picture, and from its linear numbers to those of a picture file: light through exposure, tone map and
//! encoding; a debug view's vectors and scalars through the range that makes them visible.

use crate::frame::Frame;
use crate::view::ViewSpec;
use glam::DVec3;
pub use gonio_image::EncodedPicture;
use gonio_image::srgb::ENCODER;
use gonio_light::Quantity;
use gonio_light::color::{ColorEncoding, OutputTransform};
use gonio_light::quantity::Encoding;
use gonio_threads::prelude::*;

/// Linear RGBA with premultiplied alpha, first row the top one.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// A picture of one colour.
    pub fn new(width: u32, height: u32, pixel: [f32; 4]) -> Self {
        Picture { width, height, pixels: vec![pixel; width as usize * height as usize] }
    }

    /// The pixel in column `x` of row `y`, both from the top left.
    pub fn at(&self, x: u32, y: u32) -> [f32; 4] {
        self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// 8 bits a channel, rounded to nearest.
    pub fn encode8(&self, map: &DisplayMap) -> EncodedPicture<u8> {
        match map {
            DisplayMap::Light(transform @ OutputTransform { encoding: ColorEncoding::Srgb, .. }) => {
                let to_display = OutputTransform { encoding: ColorEncoding::Direct, ..*transform };
                self.encode_with(|p| srgb8(p, &to_display))
            }
            _ => self.encode_with(|p| map.apply(p).map(|v| (v * 255.0 + 0.5) as u8)),
        }
    }

    /// 16 bits a channel, rounded to nearest.
    pub fn encode16(&self, map: &DisplayMap) -> EncodedPicture<u16> {
        self.encode_with(|p| map.apply(p).map(|v| (v * 65535.0 + 0.5) as u16))
    }

    fn encode_with<T: Copy + Default + Send>(&self, pixel: impl Fn([f32; 4]) -> [T; 4] + Sync) -> EncodedPicture<T> {
        let mut rgba = vec![T::default(); self.pixels.len() * 4];
        // Rows at a time: a pixel alone is too little work for a thread to fetch.
        let row = self.width.max(1) as usize;
        rgba.par_chunks_mut(4 * row).zip(self.pixels.par_chunks(row)).for_each(|(to, from)| {
            for (to, &from) in to.as_chunks_mut::<4>().0.iter_mut().zip(from) {
                *to = pixel(from);
            }
        });
        EncodedPicture { width: self.width, height: self.height, rgba }
    }
}

/// [`DisplayMap::apply`] with a table in place of the sRGB power. `to_display` is the
/// transform without its encoding.
fn srgb8(pixel: [f32; 4], to_display: &OutputTransform) -> [u8; 4] {
    let alpha = f64::from(pixel[3]).clamp(0.0, 1.0);
    if alpha <= 0.0 {
        return [0; 4];
    }
    let value = DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into()) / alpha;
    let display = to_display.encode(value);
    let [r, g, b] = display.to_array().map(|light| ENCODER.encode_f64(light));
    [r, g, b, (alpha * 255.0 + 0.5) as u8]
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
        // The range [low, high] becomes [0, 1]; a range without extent is not scaled.
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

    /// Whether the picture is black outside the objects (debug views) instead of showing the background.
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
