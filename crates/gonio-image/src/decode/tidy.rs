//! Numbers that are no light: NaN, infinite and negative ones.

use crate::Pixel;
use rayon::prelude::*;

/// Infinite light becomes this: the largest half float, which every GPU holds.
pub const INFINITE_LIGHT: f32 = 65504.0;

/// Makes NaN and negative numbers 0 and infinite ones [`INFINITE_LIGHT`], sets the fourth number of every pixel to 1,
/// and says in one sentence each how many there were.
pub(super) fn tidy(pictures: &mut [&mut [Pixel]], warnings: &mut Vec<String>) {
    let mut counts = [0_usize; 3];
    for pixels in pictures {
        let add = |a: [usize; 3], b: [usize; 3]| std::array::from_fn(|i| a[i] + b[i]);
        let here = pixels.par_chunks_mut(1 << 14).map(tidy_chunk).reduce(|| [0; 3], add);
        counts = add(counts, here);
    }
    let [nan, infinite, negative] = counts;
    let mut tell = |count: usize, what: &str, now: &str| match count {
        0 => {}
        1 => warnings.push(format!("one number is {what} and counts as {now}")),
        n => warnings.push(format!("{n} numbers are {what} and count as {now}")),
    };
    tell(nan, "NaN", "0");
    tell(infinite, "infinite", &INFINITE_LIGHT.to_string());
    tell(negative, "negative", "0");
}

fn tidy_chunk(pixels: &mut [Pixel]) -> [usize; 3] {
    let [mut nan, mut infinite, mut negative] = [0; 3];
    for pixel in pixels {
        for x in &mut pixel[..3] {
            // One comparison for almost every number; -0 is as good as 0.
            if *x >= 0.0 && *x < f32::INFINITY {
                continue;
            }
            if x.is_nan() {
                nan += 1;
                *x = 0.0;
            } else if *x > 0.0 {
                infinite += 1;
                *x = INFINITE_LIGHT;
            } else {
                negative += 1;
                *x = 0.0;
            }
        }
        pixel[3] = 1.0;
    }
    [nan, infinite, negative]
}
