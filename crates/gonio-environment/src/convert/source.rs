//! Looking up a source in eight directions at once.

use super::Filter;
use super::lanes::{Directions, LANES, angle};
use crate::face::Face;
use crate::image::Pixel;
use crate::panorama::{CROWDED, over_the_pole, reduced_rows};
use crate::{Cubemap, Panorama};
use std::f32::consts::PI;
use wide::{f32x4, f32x8, i32x8};

/// Where eight directions meet a source: a plane (a cubemap's face), and texels from the middle of its first one.
#[derive(Clone, Copy)]
pub(super) struct Places {
    plane: [i32; LANES],
    x: f32x8,
    y: f32x8,
}

impl Places {
    /// Of a source that is one picture.
    #[inline(always)]
    pub fn on_one_plane(x: f32x8, y: f32x8) -> Places {
        Places { plane: [0; LANES], x, y }
    }
}

/// The texel to the left (or above) of each place, and how far beyond it the place is, in [0, 1).
#[inline(always)]
fn split(place: f32x8) -> ([i32; LANES], [f32; LANES]) {
    // Places begin at -0.5; with 4 added all are positive, so cutting off is rounding down.
    let shifted = place + 4.0;
    let whole = shifted.fast_trunc_int();
    let share = shifted - whole.round_float();
    ((whole - i32x8::splat(4)).to_array(), share.to_array())
}

/// What directions are looked up in.
pub(super) trait Source: Sync {
    /// Where the directions meet it.
    fn places(&self, d: Directions) -> Places;

    /// `N` texels of a row from (`x`, `y`) on, and those below them in the `N - 1` rows that follow. Neighbours are those
    /// on the sphere.
    fn texels<const N: usize>(&self, plane: i32, x: i32, y: i32) -> [[Pixel; N]; N];

    /// Where the first of `N` x `N` texels is of each lane, where all of them lie in one piece of memory: the texels, how
    /// many are from a row to the next, and the places among them. `None` where some lane goes over an edge.
    fn piece<const N: usize>(
        &self,
        plane: &[i32; LANES],
        x: &[i32; LANES],
        y: &[i32; LANES],
    ) -> Option<(&[Pixel], usize, [usize; LANES])>;

    /// How many radians apart the nearest texels are about unit directions.
    fn spacing(&self, d: Directions) -> f32x8;

    #[inline(always)]
    fn nearest(&self, at: Places, mut found: impl FnMut(usize, f32x4)) {
        let ((x, _), (y, _)) = (split(at.x + 0.5), split(at.y + 0.5));
        for i in 0..LANES {
            found(i, f32x4::from(self.texels::<1>(at.plane[i], x[i], y[i])[0][0]));
        }
    }

    #[inline(always)]
    fn bilinear(&self, at: Places, mut found: impl FnMut(usize, f32x4)) {
        let ((left, right_share), (top, lower_share)) = (split(at.x), split(at.y));
        let mut between = |i: usize, [a, b]: [Pixel; 2], [c, d]: [Pixel; 2]| {
            let [a, b, c, d] = [f32x4::from(a), f32x4::from(b), f32x4::from(c), f32x4::from(d)];
            let upper = a + (b - a) * right_share[i];
            let lower = c + (d - c) * right_share[i];
            found(i, upper + (lower - upper) * lower_share[i]);
        };
        if let Some((texels, stride, first)) = self.piece::<2>(&at.plane, &left, &top) {
            for (i, first) in first.into_iter().enumerate() {
                if let (Some(&[a, b]), Some(&[c, d])) =
                    (texels.get(first..first + 2), texels.get(first + stride..first + stride + 2))
                {
                    between(i, [a, b], [c, d]);
                }
            }
        } else {
            for i in 0..LANES {
                let [upper, lower] = self.texels::<2>(at.plane[i], left[i], top[i]);
                between(i, upper, lower);
            }
        }
    }

    #[inline(always)]
    fn bicubic(&self, at: Places, mut found: impl FnMut(usize, f32x4)) {
        let ((left, right_share), (top, lower_share)) = (split(at.x), split(at.y));
        for i in 0..LANES {
            let rows = self.texels::<4>(at.plane[i], left[i] - 1, top[i] - 1);
            let (along, down) = (catmull_rom(right_share[i]), catmull_rom(lower_share[i]));
            let mut sum = f32x4::ZERO;
            for (row, high) in rows.iter().zip(down) {
                let [a, b, c, d] = [f32x4::from(row[0]), f32x4::from(row[1]), f32x4::from(row[2]), f32x4::from(row[3])];
                sum += (a * along[0] + b * along[1] + c * along[2] + d * along[3]) * high;
            }
            found(i, sum.max(f32x4::ZERO));
        }
    }
}

/// The weights of four values in a row for a place between the second and the third: the cardinal spline of
/// E. Catmull and R. Rom, "A class of local interpolating splines", 1974.
#[inline]
fn catmull_rom(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)]
}

/// Texels beyond an edge that a cubic spline reaches.
pub const BORDER: usize = 2;

/// A cubemap whose faces have their neighbours' texels around them.
pub(super) struct CubeSource {
    size: usize,
    half_size: f32,
    stride: usize,
    /// Six faces of `stride * stride` texels.
    texels: Vec<Pixel>,
}

impl CubeSource {
    pub fn new(map: &Cubemap) -> Self {
        let size = map.size() as usize;
        let stride = size + 2 * BORDER;
        let mut texels = vec![[0.0; 4]; 6 * stride * stride];
        for (face, with_border) in Face::ALL.into_iter().zip(texels.chunks_exact_mut(stride * stride)) {
            let rows = with_border.chunks_exact_mut(stride);
            for (y, row) in rows.enumerate() {
                let own = (BORDER..BORDER + size).contains(&y);
                for (x, texel) in row.iter_mut().enumerate() {
                    if !own || !(BORDER..BORDER + size).contains(&x) {
                        *texel = beyond(map, face, x, y);
                    }
                }
                if own {
                    let from = &map.face(face)[(y - BORDER) * size..][..size];
                    row[BORDER..BORDER + size].copy_from_slice(from);
                }
            }
        }
        CubeSource { size, half_size: 0.5 * size as f32, stride, texels }
    }
}

impl CubeSource {
    /// The bordered faces.
    pub fn into_texels(self) -> Vec<Pixel> {
        self.texels
    }
}

/// The texel of a bordered face at (`x`, `y`), outside of the face itself. A border reaches at most one face far.
fn beyond(map: &Cubemap, face: Face, x: usize, y: usize) -> Pixel {
    let size = i64::from(map.size());
    let held = |v: usize| (v as i64 - BORDER as i64).clamp(-size, 2 * size - 1);
    let [r, g, b] = map.texel(face, held(x), held(y)).as_vec3().to_array();
    [r, g, b, 1.0]
}

impl Source for CubeSource {
    #[inline(always)]
    fn places(&self, [x, y, z]: Directions) -> Places {
        let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
        // As `Face::of`: where two are equal the earlier one counts.
        let by_x = ax.simd_ge(ay) & ax.simd_ge(az);
        let by_y = !by_x & ay.simd_ge(az);
        let largest = by_x.select(ax, by_y.select(ay, az));
        let major = by_x.select(x, by_y.select(y, z));
        let is_negative = major.simd_lt(f32x8::ZERO);
        // OpenGL 4.6, table 8.19: s of +X is -z, of -X z, of +-Y x, of +Z x, of -Z -x; t of +Y is z, of -Y -z, else -y.
        let s = by_x.select(is_negative.select(z, -z), by_y.select(x, is_negative.select(-x, x)));
        let t = by_y.select(is_negative.select(-z, z), -y);
        let scale = f32x8::splat(self.half_size) / largest.max(f32x8::splat(f32::MIN_POSITIVE));
        let offset = self.half_size - 0.5;
        // Rounding may carry a place on an edge over it, and a direction that is not a number anywhere.
        let held = |v: f32x8| v.max(f32x8::splat(-0.5)).min(f32x8::splat(self.size as f32 - 0.5));
        let negative = is_negative.select(f32x8::ONE, f32x8::ZERO);
        let plane = by_x.select(f32x8::ZERO, by_y.select(f32x8::splat(2.0), f32x8::splat(4.0))) + negative;
        Places { plane: plane.fast_trunc_int().to_array(), x: held(s * scale + offset), y: held(t * scale + offset) }
    }

    #[inline(always)]
    fn texels<const N: usize>(&self, plane: i32, x: i32, y: i32) -> [[Pixel; N]; N] {
        let mut found = [[[0.0; 4]; N]; N];
        let first_row = (plane as usize * self.stride + (y + BORDER as i32) as usize) * self.stride;
        let first = first_row + (x + BORDER as i32) as usize;
        for (row, found) in found.iter_mut().enumerate() {
            if let Some(texels) = self.texels.get(first + row * self.stride..).and_then(|t| t.first_chunk()) {
                *found = *texels;
            }
        }
        found
    }

    #[inline(always)]
    fn piece<const N: usize>(
        &self,
        plane: &[i32; LANES],
        x: &[i32; LANES],
        y: &[i32; LANES],
    ) -> Option<(&[Pixel], usize, [usize; LANES])> {
        let mut first = [0; LANES];
        for i in 0..LANES {
            let row = plane[i] as usize * self.stride + (y[i] + BORDER as i32) as usize;
            first[i] = row * self.stride + (x[i] + BORDER as i32) as usize;
        }
        Some((&self.texels, self.stride, first))
    }

    #[inline]
    fn spacing(&self, [x, y, z]: Directions) -> f32x8 {
        // A texel of a cube with half edge 1 lies at 1 / m from the middle, m the largest component of the unit
        // direction, and is seen at an angle with this cosine: m^2 narrower where it is narrowest.
        let m = x.abs().max(y.abs()).max(z.abs());
        m * m * (1.0 / self.half_size)
    }
}

/// A panorama, whose crowded rows about the poles may be averaged.
pub(super) struct PanoramaSource<'a> {
    panorama: &'a Panorama,
    width: i32,
    height: i32,
    /// How many rows at the top, and how many at the bottom, were averaged along themselves as far as texels crowd; 0
    /// where that is not wanted.
    rows_averaged: usize,
    /// The first rows, averaged, ...
    top: Vec<Pixel>,
    /// ... and the last ones.
    bottom: Vec<Pixel>,
}

impl<'a> PanoramaSource<'a> {
    pub fn new(panorama: &'a Panorama, filter: Filter) -> Self {
        let (top, bottom) = if filter == Filter::Area { reduced_rows(panorama) } else { Default::default() };
        let (width, height) = (panorama.image.width as i32, panorama.image.height as i32);
        let rows_averaged = top.len() / panorama.image.width.max(1) as usize;
        PanoramaSource { panorama, width, height, rows_averaged, top, bottom }
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width as u32
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height as u32
    }

    /// A row that is there.
    #[inline(always)]
    fn row(&self, y: i32) -> &[Pixel] {
        let (width, y) = (self.width as usize, y as usize);
        let bottom_begins = self.height as usize - self.rows_averaged;
        let (from, y) = if y < self.rows_averaged {
            (&self.top, y)
        } else if self.rows_averaged > 0 && y >= bottom_begins {
            (&self.bottom, y - bottom_begins)
        } else {
            (&self.panorama.image.pixels, y)
        };
        from.get(y * width..(y + 1) * width).unwrap_or_default()
    }

    /// A texel over the meridian or a pole.
    #[cold]
    fn texel_anywhere(&self, x: i32, y: i32) -> Pixel {
        let (x, y) = over_the_pole(i64::from(x), i64::from(y), i64::from(self.width), i64::from(self.height));
        self.row(y as i32).get(x as usize).copied().unwrap_or_default()
    }
}

impl Source for PanoramaSource<'_> {
    #[inline(always)]
    fn places(&self, [x, y, z]: Directions) -> Places {
        let longitude = angle(x, -z);
        let latitude = angle(y, (x * x + z * z).sqrt());
        let (width, height) = (self.width as f32, self.height as f32);
        // Straight ahead is the middle: 0 radians, exactly.
        let x = longitude * (width / (2.0 * PI)) + (0.5 * width - 0.5);
        let y = latitude * (-height / PI) + (0.5 * height - 0.5);
        Places::on_one_plane(x, y)
    }

    #[inline(always)]
    fn texels<const N: usize>(&self, _: i32, x: i32, y: i32) -> [[Pixel; N]; N] {
        let n = N as i32;
        let mut found = [[[0.0; 4]; N]; N];
        if x >= 0 && y >= 0 && x + n <= self.width && y + n <= self.height {
            for (row, found) in found.iter_mut().enumerate() {
                if let Some(texels) = self.row(y + row as i32).get(x as usize..).and_then(|t| t.first_chunk()) {
                    *found = *texels;
                }
            }
        } else {
            for (row, found) in found.iter_mut().enumerate() {
                for (column, found) in found.iter_mut().enumerate() {
                    *found = self.texel_anywhere(x + column as i32, y + row as i32);
                }
            }
        }
        found
    }

    #[inline(always)]
    fn piece<const N: usize>(
        &self,
        _: &[i32; LANES],
        x: &[i32; LANES],
        y: &[i32; LANES],
    ) -> Option<(&[Pixel], usize, [usize; LANES])> {
        let (n, averaged) = (N as i32, self.rows_averaged as i32);
        // As numbers without sign, what is before the begin is far beyond the end.
        let columns = (self.width - n + 1).max(0) as u32;
        let rows = (self.height - 2 * averaged - n + 1).max(0) as u32;
        let mut inside = true;
        let mut first = [0; LANES];
        for i in 0..LANES {
            inside &= ((x[i] as u32) < columns) & (((y[i] - averaged) as u32) < rows);
            first[i] = (y[i] as usize).wrapping_mul(self.width as usize).wrapping_add(x[i] as usize);
        }
        inside.then_some((&self.panorama.image.pixels, self.width as usize, first))
    }

    #[inline]
    fn spacing(&self, [x, _, z]: Directions) -> f32x8 {
        // Rows where texels crowd by CROWDED or more were averaged.
        let aspect = self.width as f32 / (2.0 * self.height as f32);
        let crowd = f32x8::splat(aspect) / (x * x + z * z).sqrt().max(f32x8::splat(1e-6));
        let crowd = crowd.simd_lt(f32x8::splat(CROWDED as f32)).select(crowd.max(f32x8::ONE), f32x8::ONE);
        f32x8::splat(PI / self.height as f32) / crowd
    }
}
