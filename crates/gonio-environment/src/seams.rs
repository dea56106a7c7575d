//! The texels along the edges of six faces, and how well any two edges meet.
//!
//! Light is compared in stops: `log2(L / mean + 1/20)` of each channel, with the mean over all edges. So neither a lamp nor
//! the exposure of the picture outweighs everything else, and noise in the dark counts little.
//!
//! Two edges that belong together differ by about as much as each differs from the row of texels inside it. So the misfit
//! of two edges is the mean square of their difference over the sum of those two mean squares: about 1/2 where a picture
//! goes on, and up to [`MISFIT_MAX`] where it does not. Edges along which nothing changes fit each other in whatever
//! direction, and so are evidence of nothing.

use gonio_image::{Image, Pixel};

/// The largest misfit: beyond it, the size of a difference carries no information.
pub(crate) const MISFIT_MAX: f64 = 25.0;

/// The largest number of samples along an edge: texels are averaged, against noise and for speed.
const SAMPLES_MAX: usize = 128;

/// Stops. Differences as small as this are below the precision of 8 bits.
const FLOOR: f64 = 0.01;

/// The texels along an edge of a face in stops, clockwise as seen in a viewer: the outermost row and the next one.
#[derive(Clone, Debug, Default)]
struct Strip {
    outer: Vec<[f64; 3]>,
    inner: Vec<[f64; 3]>,
}

/// Misfits of all pairs of the 24 edges of six files. Edge `4 f + k` is that of file `f` at the top (k = 0), right, bottom,
/// left.
pub(crate) struct Seams {
    strips: Vec<Strip>,
    /// Mean square difference of outer and inner texels, per edge.
    inside: Vec<f64>,
    /// `[a][b]`: the second the other way round (as neighbours lie, of which neither or both are mirrored), and the same
    /// way round.
    misfits: Vec<[f64; 2]>,
}

impl Seams {
    /// Collects the edges of six square pictures of one size.
    pub fn new(faces: &[Image; 6]) -> Self {
        let mut strips: Vec<Strip> = faces.iter().flat_map(|face| (0..4).map(|side| Strip::new(face, side))).collect();
        encode(strips.iter_mut().flat_map(|s| s.outer.iter_mut().chain(&mut s.inner)).collect());
        let inside: Vec<f64> = strips.iter().map(|s| mean_square(s.outer.iter(), s.inner.iter())).collect();
        let mut misfits = Vec::with_capacity(24 * 24);
        for (a, inside_a) in strips.iter().zip(&inside) {
            for (b, inside_b) in strips.iter().zip(&inside) {
                let natural = inside_a + inside_b + 2.0 * FLOOR * FLOOR;
                let misfit = |across: f64| (across / natural).min(MISFIT_MAX);
                misfits.push([
                    misfit(mean_square(a.outer.iter(), b.outer.iter().rev())),
                    misfit(mean_square(a.outer.iter(), b.outer.iter())),
                ]);
            }
        }
        Seams { strips, inside, misfits }
    }

    /// Returns the misfit of two edges, from 0 to [`MISFIT_MAX`].
    pub fn misfit(&self, a: usize, b: usize, same_way: bool) -> f64 {
        self.misfits[24 * a + b][usize::from(same_way)]
    }

    /// Returns root mean squares in stops: across the seam of two edges (the second the other way round), and between the
    /// outermost rows inside the two faces.
    pub fn differences(&self, a: usize, b: usize) -> (f64, f64) {
        let across = mean_square(self.strips[a].outer.iter(), self.strips[b].outer.iter().rev());
        (across.sqrt(), (0.5 * (self.inside[a] + self.inside[b])).sqrt())
    }
}

impl Strip {
    /// Returns the linear light along one side of a square face.
    fn new(face: &Image, side: usize) -> Self {
        let size = face.width as usize;
        let count = size.min(SAMPLES_MAX);
        let bound = |i: usize| i * size / count;
        let row = |depth: usize| -> Vec<[f64; 3]> {
            // The outermost block of texels, or the next one.
            let (near, far) = (bound(depth.min(count - 1)), bound(depth.min(count - 1) + 1));
            (0..count)
                .map(|i| {
                    let mut sum = [0.0; 3];
                    for along in bound(i)..bound(i + 1) {
                        for deep in near..far {
                            let (x, y) = match side {
                                0 => (along, deep),
                                1 => (size - 1 - deep, along),
                                2 => (size - 1 - along, size - 1 - deep),
                                _ => (deep, size - 1 - along),
                            };
                            add(&mut sum, face.at(x as u32, y as u32));
                        }
                    }
                    let texels = ((bound(i + 1) - bound(i)) * (far - near)) as f64;
                    sum.map(|s| s / texels)
                })
                .collect()
        };
        Strip { outer: row(0), inner: row(1) }
    }
}

fn add(sum: &mut [f64; 3], [r, g, b, _]: Pixel) {
    for (s, channel) in sum.iter_mut().zip([r, g, b]) {
        // What is no light counts as none, what is infinite as very much.
        *s += f64::from(if channel > 0.0 { channel.min(1e30) } else { 0.0 });
    }
}

/// Converts linear light to stops about the mean.
pub(crate) fn encode(mut lights: Vec<&mut [f64; 3]>) {
    let count = 3.0 * lights.len().max(1) as f64;
    // Brightest lamps would darken all else: the mean is that of the logarithms.
    let mean = (lights.iter().flat_map(|l| l.iter()).map(|v| (v + 1e-6).ln()).sum::<f64>() / count).exp();
    for channel in lights.iter_mut().flat_map(|l| l.iter_mut()) {
        *channel = (*channel / mean + 0.05).log2();
    }
}

/// Returns the mean square of the difference of two rows of samples.
pub(crate) fn mean_square<'a>(
    a: impl Iterator<Item = &'a [f64; 3]> + Clone,
    b: impl Iterator<Item = &'a [f64; 3]>,
) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for (p, q) in a.zip(b) {
        sum += p.iter().zip(q).map(|(x, y)| (x - y) * (x - y)).sum::<f64>();
        count += 3.0;
    }
    sum / count.max(1.0)
}
