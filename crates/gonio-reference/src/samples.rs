//! The positions of samples in a pixel.

/// The positions of `count` samples in a pixel: in `[0, 1)`, x to the right, y down. The same in every pixel.
///
/// - 1: the centre.
/// - 2, 4, 8, 16: the standard sample locations of the Vulkan specification (26.4, "Multisampling"), which
///   drivers of OpenGL use as well: 4 is the rotated grid, 8 and 16 are spread over columns and rows.
/// - Any other number: N rooks; one sample in each of `count` columns and rows, row `(i step) mod count` with the
///   step nearest to `count` times the golden section that shares no divisor with `count`.
///
/// 0 counts as 1.
pub fn sample_positions(count: u32) -> Vec<[f64; 2]> {
    /// Offsets from the pixel's centre, in sixteenths.
    const STANDARD_2: &[[i8; 2]] = &[[4, 4], [-4, -4]];
    const STANDARD_4: &[[i8; 2]] = &[[-2, -6], [6, -2], [-6, 2], [2, 6]];
    const STANDARD_8: &[[i8; 2]] = &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]];
    const STANDARD_16: &[[i8; 2]] = &[
        [1, 1],
        [-1, -3],
        [-3, 2],
        [4, -1],
        [-5, -2],
        [2, 5],
        [5, 3],
        [3, -5],
        [-2, 6],
        [0, -7],
        [-4, -6],
        [-6, 4],
        [-8, 0],
        [7, -4],
        [6, 7],
        [-7, -8],
    ];
    let sixteenths = match count {
        0 | 1 => return vec![[0.5, 0.5]],
        2 => STANDARD_2,
        4 => STANDARD_4,
        8 => STANDARD_8,
        16 => STANDARD_16,
        _ => return rooks(count),
    };
    sixteenths.iter().map(|p| p.map(|v| 0.5 + f64::from(v) / 16.0)).collect()
}

/// The part of a pixel's width that each of `count` samples represents: the footprint by which a sample's texture is
/// filtered. With a whole pixel's footprint the average of the samples would be blurred twice.
pub(crate) fn sample_width(count: u32) -> f64 {
    1.0 / f64::from(count.max(1)).sqrt()
}

fn rooks(count: u32) -> Vec<[f64; 2]> {
    let golden = (f64::from(count) * 0.618_033_988_749_894_9).round() as u32;
    // 1 always shares no divisor, so a step is always found.
    let step =
        (0..count).flat_map(|d| [golden + d, golden.saturating_sub(d)]).find(|&s| s >= 1 && divisor(s, count) == 1);
    let step = u64::from(step.unwrap_or(1));
    (0..u64::from(count))
        .map(|i| {
            let row = (i * step) % u64::from(count);
            [i, row].map(|v| (v as f64 + 0.5) / f64::from(count))
        })
        .collect()
}

/// The greatest common divisor.
fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_is_the_centre() {
        assert_eq!(sample_positions(1), [[0.5, 0.5]]);
        assert_eq!(sample_positions(0), [[0.5, 0.5]]);
    }

    #[test]
    fn every_pattern_has_its_count_in_distinct_columns_and_rows() {
        for count in 1..=40u32 {
            let positions = sample_positions(count);
            assert_eq!(positions.len(), count as usize);
            for axis in 0..2 {
                let mut values: Vec<f64> = positions.iter().map(|p| p[axis]).collect();
                values.sort_by(f64::total_cmp);
                assert!(values[0] >= 0.0 && values[values.len() - 1] < 1.0, "{count} samples: {values:?}");
                assert!(values.windows(2).all(|w| w[0] < w[1]), "{count} samples share a row or column: {values:?}");
            }
        }
    }

    /// The mean of a linear ramp over a pixel is its value at the centre (tolerance 1/16: the 16 standard
    /// positions are not centred, nor are odd numbers of rooks; the others are exact).
    #[test]
    fn patterns_are_centred() {
        for count in [1, 2, 4, 8, 16, 3, 5, 7, 12, 32] {
            for axis in 0..2 {
                let mean = sample_positions(count).iter().map(|p| p[axis]).sum::<f64>() / f64::from(count);
                assert!((mean - 0.5).abs() <= 1.0 / 16.0, "{count} samples: {mean}");
            }
        }
    }
}
