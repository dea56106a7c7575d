//! The sources of a conversion: the positions that directions meet, the memory layout of the texels, and their copies
//! for a GPU.

use super::lanes::{Directions, angle};
use super::lookup::{Cells, split};
use super::{EnvironmentRef, Filter};
use crate::face::Face;
use crate::panorama::{CROWDED, over_the_pole, reduced_rows};
use crate::{Cubemap, Panorama};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, i32x8, u32x8};
use gonio_image::Pixel;
use std::borrow::Cow;
use std::f32::consts::PI;

/// The positions at which eight directions meet a source: a plane (a cubemap's face), and texels from the middle of its
/// first one.
#[derive(Clone, Copy)]
pub(super) struct Places<S: Simd> {
    plane: i32x8<S>,
    x: f32x8<S>,
    y: f32x8<S>,
}

impl<S: Simd> Places<S> {
    /// The cells that the places are in, `shift` texels further right and down.
    #[inline(always)]
    pub fn cells(self, shift: f32) -> Cells<S> {
        let ((left, right_share), (top, lower_share)) = (split(self.x + shift), split(self.y + shift));
        Cells { plane: self.plane, left, top, right_share, lower_share }
    }
}

/// A source of texels for lookups by direction. Its texels are in up to three pieces of memory, in rows of one length.
pub(super) trait TexelSource: Sync {
    /// Returns the positions at which directions meet the source.
    fn places<S: Simd>(&self, d: Directions<S>) -> Places<S>;

    /// The texels of a piece.
    fn texels(&self, piece: u8) -> &[Pixel];

    /// Texels from a row to the next, in every piece.
    fn stride(&self) -> usize;

    /// The piece that contains eight windows of `N` x `N` texels, and the index of their first texels. `None` if a
    /// window crosses an edge.
    fn piece<S: Simd, const N: usize>(&self, plane: i32x8<S>, x: i32x8<S>, y: i32x8<S>) -> Option<(u8, u32x8<S>)>;

    /// A window whose first texel is (`x`, `y`). Neighbours are those on the sphere.
    fn window<const N: usize>(&self, plane: i32, x: i32, y: i32) -> [[Pixel; N]; N];

    /// Returns the distance of neighbouring texels about unit directions, in radians.
    fn spacing<S: Simd>(&self, d: Directions<S>) -> f32x8<S>;
}

/// Whether a source has so few texels that lanes of 32 bits can count them.
fn is_countable(texels: usize) -> bool {
    i32::try_from(texels).is_ok()
}

/// Whether each of eight numbers is in [0, `end`).
#[inline(always)]
fn below<S: Simd>(number: i32x8<S>, end: i32) -> fearless_simd::mask32x8<S> {
    // As numbers without sign, what is before 0 is far beyond the end.
    let number: u32x8<S> = number.bitcast();
    number.simd_lt(end.max(0) as u32)
}

/// A cubemap.
pub(super) struct CubeSource<'a> {
    map: &'a Cubemap,
    size: i32,
    half_size: f32,
    countable: bool,
}

impl<'a> CubeSource<'a> {
    pub fn new(map: &'a Cubemap) -> Self {
        let size = map.size() as i32;
        CubeSource { map, size, half_size: 0.5 * size as f32, countable: is_countable(map.pixels().len()) }
    }
}

/// The texel of a face, or of its neighbours where (`x`, `y`) is outside, at most one face far.
pub(super) fn texel_about(map: &Cubemap, face: Face, x: i64, y: i64) -> Pixel {
    let size = i64::from(map.size());
    let held = |v: i64| v.clamp(-size, 2 * size - 1);
    if (0..size).contains(&x) && (0..size).contains(&y) {
        return map.at(face, x as u32, y as u32);
    }
    let [r, g, b] = map.texel(face, held(x), held(y)).as_vec3().to_array();
    [r, g, b, 1.0]
}

impl TexelSource for CubeSource<'_> {
    #[inline(always)]
    fn places<S: Simd>(&self, [x, y, z]: Directions<S>) -> Places<S> {
        let simd = x.simd;
        let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
        // As `Face::of`: where two are equal the earlier one counts.
        let by_x = ax.simd_ge(ay) & ax.simd_ge(az);
        let by_y = !by_x & ay.simd_ge(az);
        let largest = by_x.select(ax, by_y.select(ay, az));
        let major = by_x.select(x, by_y.select(y, z));
        let is_negative = major.simd_lt(0.0);
        // OpenGL 4.6, table 8.19: s of +X is -z, of -X z, of +-Y x, of +Z x, of -Z -x; t of +Y is z, of -Y -z, else -y.
        let s = by_x.select(is_negative.select(z, -z), by_y.select(x, is_negative.select(-x, x)));
        let t = by_y.select(is_negative.select(-z, z), -y);
        let scale = f32x8::splat(simd, self.half_size) / largest.max(f32::MIN_POSITIVE);
        let offset = self.half_size - 0.5;
        // Rounding may carry a place on an edge over it, and a direction that is not a number anywhere.
        let largest_place = self.size as f32 - 0.5;
        let x = (s * scale + offset).max(-0.5).min(largest_place);
        let y = (t * scale + offset).max(-0.5).min(largest_place);
        let zero = i32x8::splat(simd, 0);
        let positive = by_x.select(zero, by_y.select(i32x8::splat(simd, 2), i32x8::splat(simd, 4)));
        let plane = positive + is_negative.select(i32x8::splat(simd, 1), zero);
        Places { plane, x, y }
    }

    #[inline(always)]
    fn texels(&self, _: u8) -> &[Pixel] {
        self.map.pixels()
    }

    #[inline(always)]
    fn stride(&self) -> usize {
        // By way of u32, so that the compiler knows that sums of strides do not overflow.
        self.size as u32 as usize
    }

    #[inline(always)]
    fn piece<S: Simd, const N: usize>(&self, plane: i32x8<S>, x: i32x8<S>, y: i32x8<S>) -> Option<(u8, u32x8<S>)> {
        let ends = self.size - N as i32 + 1;
        let inside = below(x, ends) & below(y, ends) & below(plane, 6);
        let first = (plane * self.size + y) * self.size + x;
        if inside.all_true() && self.countable { Some((0, first.bitcast())) } else { None }
    }

    #[cold]
    fn window<const N: usize>(&self, plane: i32, x: i32, y: i32) -> [[Pixel; N]; N] {
        let face = Face::ALL[plane.clamp(0, 5) as usize];
        let at = |v: i32, i: usize| i64::from(v) + i as i64;
        std::array::from_fn(|row| std::array::from_fn(|column| texel_about(self.map, face, at(x, column), at(y, row))))
    }

    #[inline(always)]
    fn spacing<S: Simd>(&self, [x, y, z]: Directions<S>) -> f32x8<S> {
        // A texel of a cube with half edge 1 lies at 1 / m from the middle, m the largest component of the unit
        // direction, and is seen at an angle with this cosine: m^2 narrower where it is narrowest.
        let m = x.abs().max(y.abs()).max(z.abs());
        m * m * (1.0 / self.half_size)
    }
}

/// A panorama, whose crowded rows about the poles may be averaged. Its pieces: the picture, the averaged rows at the
/// top, and those at the bottom.
pub(super) struct PanoramaSource<'a> {
    panorama: &'a Panorama,
    width: i32,
    height: i32,
    /// The number of rows at the top, and at the bottom, that were averaged along themselves where texels crowd; 0
    /// without the area filter.
    rows_averaged: i32,
    /// The first rows, averaged, ...
    top: Vec<Pixel>,
    /// ... and the last ones.
    bottom: Vec<Pixel>,
    countable: bool,
}

impl<'a> PanoramaSource<'a> {
    pub fn new(panorama: &'a Panorama, filter: Filter) -> Self {
        let (top, bottom) = if filter == Filter::Area { reduced_rows(panorama) } else { Default::default() };
        let (width, height) = (panorama.image.width as i32, panorama.image.height as i32);
        let rows_averaged = (top.len() / panorama.image.width.max(1) as usize) as i32;
        let countable = is_countable(panorama.image.pixels.len());
        PanoramaSource { panorama, width, height, rows_averaged, top, bottom, countable }
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width as u32
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height as u32
    }

    /// The distance of a place from the middle of the first column, in columns, from the longitude in radians.
    #[inline(always)]
    pub fn across<S: Simd>(&self, longitude: f32x8<S>) -> f32x8<S> {
        // Straight ahead is the middle: 0 radians, exactly.
        longitude * (self.width as f32 / (2.0 * PI)) + (0.5 * self.width as f32 - 0.5)
    }

    /// The distance of a place from the middle of the first row, in rows, from the angle below the horizon in radians.
    #[inline(always)]
    pub fn down<S: Simd>(&self, below: f32x8<S>) -> f32x8<S> {
        below * (self.height as f32 / PI) + (0.5 * self.height as f32 - 0.5)
    }

    /// A row that is there.
    fn row(&self, y: i32) -> &[Pixel] {
        let bottom_begins = self.height - self.rows_averaged;
        let (piece, y) = if y < self.rows_averaged {
            (TOP, y)
        } else if self.rows_averaged > 0 && y >= bottom_begins {
            (BOTTOM, y - bottom_begins)
        } else {
            (PICTURE, y)
        };
        let (width, y) = (self.width as usize, y as usize);
        self.texels(piece).get(y * width..(y + 1) * width).unwrap_or_default()
    }

    /// A texel over the meridian or a pole.
    fn texel_anywhere(&self, x: i64, y: i64) -> Pixel {
        let (x, y) = over_the_pole(x, y, i64::from(self.width), i64::from(self.height));
        self.row(y as i32).get(x as usize).copied().unwrap_or_default()
    }

    /// The first texels of eight windows in a piece that has the rows from `from` to before `to`.
    #[inline(always)]
    fn in_rows<S: Simd, const N: usize>(&self, from: i32, to: i32, x: i32x8<S>, y: i32x8<S>) -> Option<u32x8<S>> {
        let n = N as i32;
        let y = y - from;
        let inside = below(x, self.width - n + 1) & below(y, to - from - n + 1);
        if inside.all_true() { Some((y * self.width + x).bitcast()) } else { None }
    }
}

/// The pieces of a panorama. Of the picture all rows count from 0, the averaged ones too.
const PICTURE: u8 = 0;
const TOP: u8 = 1;
const BOTTOM: u8 = 2;

impl TexelSource for PanoramaSource<'_> {
    #[inline(always)]
    fn places<S: Simd>(&self, [x, y, z]: Directions<S>) -> Places<S> {
        let longitude = angle(x, -z);
        let below = angle(-y, (x * x + z * z).sqrt());
        Places { plane: i32x8::splat(x.simd, 0), x: self.across(longitude), y: self.down(below) }
    }

    #[inline(always)]
    fn texels(&self, piece: u8) -> &[Pixel] {
        match piece {
            PICTURE => &self.panorama.image.pixels,
            TOP => &self.top,
            _ => &self.bottom,
        }
    }

    #[inline(always)]
    fn stride(&self) -> usize {
        self.width as u32 as usize
    }

    #[inline(always)]
    fn piece<S: Simd, const N: usize>(&self, _: i32x8<S>, x: i32x8<S>, y: i32x8<S>) -> Option<(u8, u32x8<S>)> {
        if !self.countable {
            return None;
        }
        let (averaged, height) = (self.rows_averaged, self.height);
        if averaged == 0 {
            let first = self.in_rows::<S, N>(0, height, x, y)?;
            return Some((PICTURE, first));
        }
        if let Some(first) = self.in_rows::<S, N>(averaged, height - averaged, x, y) {
            let before = (averaged * self.width) as u32;
            return Some((PICTURE, first + before));
        }
        if let Some(first) = self.in_rows::<S, N>(0, averaged, x, y) {
            return Some((TOP, first));
        }
        let first = self.in_rows::<S, N>(height - averaged, height, x, y)?;
        Some((BOTTOM, first))
    }

    #[cold]
    fn window<const N: usize>(&self, _: i32, x: i32, y: i32) -> [[Pixel; N]; N] {
        let at = |v: i32, i: usize| i64::from(v) + i as i64;
        std::array::from_fn(|row| std::array::from_fn(|column| self.texel_anywhere(at(x, column), at(y, row))))
    }

    #[inline(always)]
    fn spacing<S: Simd>(&self, [x, _, z]: Directions<S>) -> f32x8<S> {
        // Rows where texels crowd by CROWDED or more were averaged.
        let simd = x.simd;
        let aspect = self.width as f32 / (2.0 * self.height as f32);
        let crowd = f32x8::splat(simd, aspect) / (x * x + z * z).sqrt().max(1e-6);
        let crowd = crowd.simd_lt(CROWDED as f32).select(crowd.max(1.0), f32x8::splat(simd, 1.0));
        f32x8::splat(simd, PI / self.height as f32) / crowd
    }
}

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
