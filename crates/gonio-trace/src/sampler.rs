//! Owen-scrambled Sobol points: each sample of a pixel draws its random numbers from them, two dimensions at a time.
//!
//! Every pair of dimensions is the two-dimensional Sobol sequence, a (0, 2)-sequence in base 2, with its order shuffled and
//! both coordinates scrambled by hashes of the pixel and of the pair ("padding"). So the samples of a pixel are
//! stratified in every pair of dimensions, pixels and pairs are independent, and sample `i` is the same whatever was
//! drawn before.
//!
//! *Sources*: I. M. Sobol, *On the distribution of points in a cube*, 1967; A. B. Owen, *Randomly Permuted (t,m,s)-Nets and
//! (t,s)-Sequences*, 1995; S. Laine and T. Karras, *Stratified Sampling for Stochastic Transparency*, EGSR 2011;
//! B. Burley, *Practical Hash-based Owen Scrambling*, JCGT 9(4), 2020.

use glam::Vec2;

/// The largest f32 below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// The random numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    /// Of the pixel.
    seed: u32,
    /// The number of the sample in its pixel, its bits reversed.
    reversed_index: u32,
    /// The next pair of dimensions.
    pair: u32,
}

impl Sampler {
    /// Sample `index` of pixel number `pixel`.
    #[inline]
    pub fn new(seed: u64, pixel: u32, index: u32) -> Self {
        let seed = hash(hash(seed as u32 ^ hash((seed >> 32) as u32)) ^ pixel);
        Sampler { seed, reversed_index: index.reverse_bits(), pair: 0 }
    }

    /// The index of the sample in its pixel.
    #[inline]
    pub fn index(&self) -> u32 {
        self.reversed_index.reverse_bits()
    }

    /// The next number, in `[0, 1)`.
    #[inline]
    pub fn next_1d(&mut self) -> f32 {
        let seed = self.next_seed();
        unit_interval(permute(self.shuffled_index(seed), other_seed(seed, FIRST)).reverse_bits())
    }

    /// The next point, in `[0, 1)^2`.
    #[inline]
    pub fn next_2d(&mut self) -> Vec2 {
        let seed = self.next_seed();
        let index = self.shuffled_index(seed);
        // The first coordinate of the sequence is the index reversed, and scrambling reverses once more.
        Vec2::new(
            unit_interval(permute(index, other_seed(seed, FIRST)).reverse_bits()),
            unit_interval(permute(pascal(index), other_seed(seed, SECOND)).reverse_bits()),
        )
    }

    /// The index in an order of its own for each pair: Owen's scrambling keeps every run of 2^k samples together.
    #[inline]
    fn shuffled_index(&self, seed: u32) -> u32 {
        permute(self.reversed_index, seed).reverse_bits()
    }

    #[inline]
    fn next_seed(&mut self) -> u32 {
        self.pair += 1;
        hash(self.seed ^ self.pair.wrapping_mul(0x9E37_79B9))
    }
}

/// Odd, with bits that look random: the seeds of the two coordinates.
const FIRST: u64 = 0x9E37_79B9_7F4A_7C15;
const SECOND: u64 = 0xD1B5_4A32_D192_ED03;

/// A seed for another purpose: the upper half of the product depends on all bits of a hash.
#[inline]
fn other_seed(seed: u32, factor: u64) -> u32 {
    (u64::from(seed).wrapping_mul(factor) >> 32) as u32
}

#[inline]
fn unit_interval(bits: u32) -> f32 {
    // 2^-32. The largest integers round to 1.
    (bits as f32 * 2.328_306_4e-10).min(BELOW_ONE)
}

/// The index times Pascal's triangle modulo 2: the second coordinate of that point of the Sobol sequence, as a fraction of 2^32 with
/// its bits reversed.
#[inline]
fn pascal(index: u32) -> u32 {
    let mut v = index;
    v ^= v >> 16;
    v ^= (v & 0xFF00_FF00) >> 8;
    v ^= (v & 0xF0F0_F0F0) >> 4;
    v ^= (v & 0xCCCC_CCCC) >> 2;
    v ^= (v & 0xAAAA_AAAA) >> 1;
    v
}

/// Burley's hash: each bit is flipped depending on the bits below it. Between two reversals of bits it is Owen's nested uniform
/// scrambling of a binary fraction.
#[inline]
fn permute(mut x: u32, seed: u32) -> u32 {
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^ x.wrapping_mul(0x8d22_f6e6)
}

/// A bijection of 32 bits that changes half of them for each bit of its argument (C. Wellons, *Prospecting for Hash
/// Functions*, 2018).
#[inline]
fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Direction numbers of the polynomial x + 1: `m_k = 2 m_(k-1) xor m_(k-1)`.
    #[test]
    fn the_second_coordinate_is_that_of_the_direction_numbers() {
        for index in (0..5000).chain([0x8000_0000, 0xFFFF_FFFF, 0x1234_5678]) {
            let (mut m, mut expected) = (1_u32, 0);
            for k in 0..32 {
                if index >> k & 1 == 1 {
                    expected ^= m << (31 - k);
                }
                m = m ^ (m << 1);
            }
            assert_eq!(pascal(index).reverse_bits(), expected, "{index:#x}");
        }
    }

    /// 256 points in each of the 256 boxes of equal area of each shape: what makes it a (0, 2)-sequence.
    #[test]
    fn points_are_stratified_in_every_elementary_box() {
        for pixel in [0, 7, 123_456] {
            let points: Vec<Vec2> = (0..256).map(|i| Sampler::new(1, pixel, i).next_2d()).collect();
            for log_columns in 0..=8 {
                let (columns, rows) = (1 << log_columns, 256 >> log_columns);
                let mut seen = vec![false; 256];
                for p in &points {
                    let (x, y) = ((p.x * columns as f32) as usize, (p.y * rows as f32) as usize);
                    let cell = &mut seen[y * columns + x];
                    assert!(!*cell, "two points in a box of {columns} x {rows}");
                    *cell = true;
                }
            }
        }
    }

    #[test]
    fn pixels_and_pairs_are_independent() {
        // The correlation of 4096 independent pairs of uniform numbers is below 4 / sqrt(4096) in all but 1 of 16,000 cases.
        let correlation = |pairs: &[(f32, f32)]| {
            pairs.iter().map(|(a, b)| f64::from((a - 0.5) * (b - 0.5))).sum::<f64>() * 12.0 / pairs.len() as f64
        };
        let pixels: Vec<_> =
            (0..4096).map(|p| (Sampler::new(3, p, 0).next_1d(), Sampler::new(3, p + 1, 0).next_1d())).collect();
        assert!(correlation(&pixels).abs() < 4.0 / 64.0, "{}", correlation(&pixels));
        let pairs: Vec<_> = (0..4096)
            .map(|i| {
                let mut sampler = Sampler::new(3, 11, i);
                (sampler.next_2d().x, sampler.next_2d().x)
            })
            .collect();
        assert!(correlation(&pairs).abs() < 4.0 / 64.0, "{}", correlation(&pairs));
    }
}
