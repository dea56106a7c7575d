//! The texels of a source, laid out for a GPU: the same texels that the CPU looks up.

use super::texel_source::texel_about;
use super::{EnvironmentRef, Filter};
use crate::Cubemap;
use crate::face::Face;
use crate::panorama::reduced_rows;
use gonio_image::Pixel;
use std::borrow::Cow;

/// One picture, or six of one size, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct TexelLayers<'a> {
    /// Texels, borders included.
    pub width: u32,
    /// Texels, borders included.
    pub height: u32,
    /// 1, or 6: the faces in the order of [`crate::Face::ALL`].
    pub layers: u32,
    /// Texels of the neighbours on each side of a face; 0 for a panorama, which wraps around instead.
    pub border: u32,
    /// Layer after layer.
    pub texels: Cow<'a, [Pixel]>,
}

impl<'a> EnvironmentRef<'a> {
    /// Returns the texels that a filter looks up: faces with a border of their neighbours' texels, or a panorama, whose
    /// crowded rows are averaged for [`Filter::Area`].
    pub fn texel_layers(&self, filter: Filter) -> TexelLayers<'a> {
        match *self {
            EnvironmentRef::Cubemap(map) => {
                let side = map.size() + 2 * BORDER as u32;
                let texels = Cow::Owned(with_borders(map));
                TexelLayers { width: side, height: side, layers: 6, border: BORDER as u32, texels }
            }
            EnvironmentRef::Panorama(panorama) => {
                let image = &panorama.image;
                let mut texels = Cow::Borrowed(image.pixels.as_slice());
                if filter == Filter::Area {
                    let (top, bottom) = reduced_rows(panorama);
                    let all = texels.to_mut();
                    let bottom_begins = all.len() - bottom.len();
                    all[..top.len()].copy_from_slice(&top);
                    all[bottom_begins..].copy_from_slice(&bottom);
                }
                TexelLayers { width: image.width, height: image.height, layers: 1, border: 0, texels }
            }
        }
    }
}

/// Texels beyond an edge that a cubic spline reaches.
pub const BORDER: usize = 2;

/// Six faces, each with its neighbours' texels around it.
fn with_borders(map: &Cubemap) -> Vec<Pixel> {
    let size = map.size() as usize;
    let stride = size + 2 * BORDER;
    let mut texels = vec![[0.0; 4]; 6 * stride * stride];
    for (face, with_border) in Face::ALL.into_iter().zip(texels.chunks_exact_mut(stride * stride)) {
        for (y, row) in with_border.chunks_exact_mut(stride).enumerate() {
            let own = (BORDER..BORDER + size).contains(&y);
            for (x, texel) in row.iter_mut().enumerate() {
                if !own || !(BORDER..BORDER + size).contains(&x) {
                    let at = |v: usize| v as i64 - BORDER as i64;
                    *texel = texel_about(map, face, at(x), at(y));
                }
            }
            if own {
                let from = &map.face(face)[(y - BORDER) * size..][..size];
                row[BORDER..BORDER + size].copy_from_slice(from);
            }
        }
    }
    texels
}
