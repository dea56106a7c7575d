//! Fills the outlines of glyphs: a replacement of the crate `vello_cpu` with the part of it that egui uses.
//!
//! Paths are filled with white where their winding number is not zero. The coverage of a pixel is the exact area of the
//! polygon in it (`fill`), a sum over the path's edges, clamped to 1 where contours overlap.

pub mod color;
mod fill;
pub mod kurbo;

use fill::Coverage;
use kurbo::{Affine, BezPath};

/// A drawing of white paths.
pub struct RenderContext {
    coverage: Coverage,
    transform: Affine,
}

impl RenderContext {
    /// An empty drawing of `width` times `height` pixels.
    pub fn new(width: u16, height: u16) -> Self {
        RenderContext { coverage: Coverage::new(width, height), transform: Affine::default() }
    }

    /// Sets the translation of the paths that follow.
    pub fn set_transform(&mut self, transform: Affine) {
        self.transform = transform;
    }

    /// Does nothing: the only paint is white.
    pub fn set_paint(&mut self, _: color::OpaqueColor<color::Srgb>) {}

    /// Fills a path; open contours are closed.
    pub fn fill_path(&mut self, path: &BezPath) {
        path.flatten(self.transform, |from, to| self.coverage.line(from, to));
    }

    /// Writes the picture, which has the size of the drawing; rows beyond it stay unchanged.
    pub fn render(&mut self, pixmap: &mut Pixmap, _: &mut Resources) {
        for (pixel, coverage) in pixmap.data.chunks_exact_mut(4).zip(self.coverage.pixels()) {
            pixel.fill((coverage * 255.0 + 0.5) as u8);
        }
    }
}

/// Memory that a renderer keeps between pictures: none.
#[derive(Debug, Default)]
pub struct Resources;

impl Resources {
    /// Empty.
    pub fn new() -> Self {
        Resources
    }
}

/// A picture: RGBA, 8 bits each, premultiplied.
pub struct Pixmap {
    data: Vec<u8>,
}

impl Pixmap {
    /// A transparent picture.
    pub fn new(width: u16, height: u16) -> Self {
        Pixmap { data: vec![0; usize::from(width) * usize::from(height) * 4] }
    }

    /// The pixels, row by row from the top.
    pub fn data_as_u8_slice(&self) -> &[u8] {
        &self.data
    }
}
