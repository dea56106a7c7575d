//! Radiance's `.hdr`: RGBE with adaptive run lengths.
//!
//! Source: G. Ward, *Real Pixels*, Graphics Gems II, 1991. A number is `m 2^(e - 136)`, as [`crate::decode`] reads it:
//! what was read is written as it was. Mantissas are rounded to the nearest, where Radiance cuts them off and adds half
//! a step when reading.

use super::Encoded;
use crate::image::Image;
use crate::{ImageError, Pixel};
use rayon::prelude::*;
use std::io::Write;

/// A picture as `.hdr`.
///
/// # Errors
///
/// A picture without pixels.
pub fn encode(image: &Image) -> Result<Encoded, ImageError> {
    if image.pixels.is_empty() {
        return Err(ImageError::new("a picture without pixels cannot be written as .hdr"));
    }
    let mut bytes = Vec::new();
    // Writing to memory does not fail.
    let _ =
        write!(bytes, "#?RADIANCE\nSOFTWARE=gonio\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
    let width = image.width as usize;
    // The length of a line has 15 bits; shorter than 8 is not worth it. Others are flat.
    let packs = (8..0x8000).contains(&width);
    let lines: Vec<Vec<u8>> = image
        .pixels
        .par_chunks(width)
        .map(|row| {
            let scan: Vec<[u8; 4]> = row.iter().map(rgbe).collect();
            if packs { packed(&scan) } else { scan.as_flattened().to_vec() }
        })
        .collect();
    bytes.reserve_exact(lines.iter().map(Vec::len).sum());
    lines.iter().for_each(|line| bytes.extend_from_slice(line));
    let tiny = |p: &Pixel| {
        let brightest = p[..3].iter().copied().fold(0.0, f32::max);
        brightest > 0.0 && f64::from(brightest) < SMALLEST
    };
    let lost = image.pixels.par_iter().with_min_len(1 << 14).filter(|p| tiny(p)).count();
    let warnings = match lost {
        0 => Vec::new(),
        n => vec![format!("{n} pixels are darker than the darkest value of .hdr (3e-39) and become black")],
    };
    Ok(Encoded { bytes, warnings })
}

/// The pixel's mantissas and their exponent, each rounded to the nearest; NaN and negative light are 0.
fn rgbe([r, g, b, _]: &Pixel) -> [u8; 4] {
    // Written so that NaN becomes 0.
    let light = [*r, *g, *b].map(|x| if x > 0.0 { f64::from(x.min(LARGEST)) } else { 0.0 });
    let brightest = light[0].max(light[1]).max(light[2]);
    if brightest < SMALLEST {
        return [0; 4];
    }
    // The exponent with which the brightest mantissa is in 128..=255; rounding may carry it to 256.
    let mut exponent = exponent_of(brightest) + 1;
    if brightest * scale(exponent) >= 255.5 {
        exponent += 1;
    }
    // Not negative: a half more, cut off, is the nearest.
    let [r, g, b] = light.map(|x| (x * scale(exponent) + 0.5) as u8);
    [r, g, b, (exponent + 128) as u8]
}

/// `255 * 2^(255 - 136)`, of the largest mantissa and exponent.
const LARGEST: f32 = f32::from_bits(0x7EFF_0000);
/// `128 * 2^(1 - 136)`, which is 2^-128: the smallest mantissa that is not too small, and the smallest exponent.
const SMALLEST: f64 = 2.938_735_877_055_719e-39;

/// `2^(8 - exponent)`: what takes light to mantissas. Put together from its bits, for speed; an f64 holds every such
/// power as a normal number.
fn scale(exponent: i32) -> f64 {
    f64::from_bits(((8 - exponent + 1023) as u64) << 52)
}

/// The exponent of 2 in a number's first bit.
fn exponent_of(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7FF) as i32 - 1023
}

/// A scan line with adaptive run lengths: all red, all green, all blue, all exponents.
fn packed(scan: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = vec![2, 2];
    bytes.extend((scan.len() as u16).to_be_bytes());
    let mut line = vec![0; scan.len()];
    for channel in 0..4 {
        for (to, from) in line.iter_mut().zip(scan) {
            *to = from[channel];
        }
        pack(&line, &mut bytes);
    }
    bytes
}

/// Runs of 4 and more equal bytes become two bytes; what is between stays, in pieces of at most 128.
fn pack(line: &[u8], bytes: &mut Vec<u8>) {
    let run_at = |start: usize| {
        let first = line[start];
        line[start..].iter().take(127).take_while(|b| **b == first).count()
    };
    let mut at = 0;
    while at < line.len() {
        let mut end = at;
        let mut run = 0;
        while end < line.len() {
            run = run_at(end);
            if run >= 4 {
                break;
            }
            end += run;
        }
        for piece in line[at..end].chunks(128) {
            bytes.push(piece.len() as u8);
            bytes.extend_from_slice(piece);
        }
        if end < line.len() {
            bytes.extend([128 + run as u8, line[end]]);
            end += run;
        }
        at = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mantissas_are_the_nearest() {
        for (light, expected) in [
            ([1.0, 0.5, 0.0], [128, 64, 0, 129]),
            ([255.0, 1.0, 0.4], [255, 1, 0, 136]),
            // Rounds up to 256, which is 128 of the next exponent.
            ([255.6, 0.0, 0.0], [128, 0, 0, 137]),
            ([0.0, 0.0, 0.0], [0; 4]),
            ([f32::NAN, -1.0, 0.0], [0; 4]),
            ([f32::MAX, 0.0, 0.0], [255, 0, 0, 255]),
        ] {
            assert_eq!(rgbe(&[light[0], light[1], light[2], 1.0]), expected, "{light:?}");
        }
    }

    #[test]
    fn every_exponent_comes_back() {
        for e in 1..=255_u8 {
            for m in [128, 200, 255] {
                let scale = (f64::from(e) - 136.0).exp2();
                let light = (f64::from(m) * scale) as f32;
                assert_eq!(rgbe(&[light, 0.0, light, 1.0]), [m, 0, m, e]);
            }
        }
    }
}
