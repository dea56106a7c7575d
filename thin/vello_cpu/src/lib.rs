//! Fills the outlines of glyphs: as much of the crate `vello_cpu` as egui uses, for it stands in its place.
//!
//! One path, filled where its winding number is not zero, white over nothing. The coverage of a pixel is the exact
//! area of the polygon in it (`fill`), the sum over the path's edges; where contours overlap it is held at 1.

pub mod color;
mod fill;
pub mod kurbo;

use fill::Coverage;
use kurbo::{Affine, BezPath};

/// What is drawn: at most one path after another, all in white.
pub struct RenderContext {
    coverage: Coverage,
    transform: Affine,
}

impl RenderContext {
    /// A picture of `width` times `height` pixels, empty.
    pub fn new(width: u16, height: u16) -> Self {
        RenderContext { coverage: Coverage::new(width, height), transform: Affine::default() }
    }

    /// How paths are moved from now on.
    pub fn set_transform(&mut self, transform: Affine) {
        self.transform = transform;
    }

    /// There is but one paint: white.
    pub fn set_paint(&mut self, _: color::OpaqueColor<color::Srgb>) {}

    /// Fills a path; those that are open are closed.
    pub fn fill_path(&mut self, path: &BezPath) {
        path.flatten(self.transform, |from, to| self.coverage.line(from, to));
    }

    /// Writes the picture. Both are of one size, or the picture's rows beyond are left as they are.
    pub fn render(&mut self, pixmap: &mut Pixmap, _: &mut Resources) {
        for (pixel, coverage) in pixmap.data.chunks_exact_mut(4).zip(self.coverage.pixels()) {
            pixel.fill((coverage * 255.0 + 0.5) as u8);
        }
    }
}

/// What a renderer keeps between pictures: nothing.
#[derive(Debug, Default)]
pub struct Resources;

impl Resources {
    /// Nothing.
    pub fn new() -> Self {
        Resources
    }
}

/// A picture: RGBA, 8 bits each, premultiplied.
pub struct Pixmap {
    data: Vec<u8>,
}

impl Pixmap {
    /// Transparent.
    pub fn new(width: u16, height: u16) -> Self {
        Pixmap { data: vec![0; usize::from(width) * usize::from(height) * 4] }
    }

    /// Row by row from the top.
    pub fn data_as_u8_slice(&self) -> &[u8] {
        &self.data
    }
}
