//! Radiance's `.hdr` (or `.pic`): three mantissas and one exponent of 8 bits.
//!
//! Source: G. Ward, *Real Pixels*, Graphics Gems II, 1991, and Radiance's file formats (`filefmts.pdf`, 1997). A number
//! is `m 2^(e - 136)`, as almost all readers have it; Radiance itself adds half a step to `m`.

use super::{Decoded, DecodedContent, FileFormat};
use crate::image::Image;
use crate::{DecodeLimits, ImageError, Pixel};
use std::sync::LazyLock;

/// The first bytes of a Radiance HDR file.
pub(super) const MAGIC: &[u8] = b"#?";

/// `2^(e - 136)` of each exponent; 0 for exponent 0, which means black.
static SCALES: LazyLock<[f64; 256]> =
    LazyLock::new(|| std::array::from_fn(|e| if e == 0 { 0.0 } else { (e as f64 - 136.0).exp2() }));

pub(super) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    let mut rest = bytes;
    let header = Header::read(&mut rest)?;
    let order = Order::read(&mut rest)?;
    let mut image = limits.unfilled(order.scan_length, order.scans)?;
    let mut scan = vec![[0; 4]; order.scan_length as usize];
    // Light in the file is what was measured times the exposure and the colour correction.
    let factors = header.factors.map(|f| 1.0 / f);
    for _ in 0..order.scans {
        read_scan(&mut rest, &mut scan)?;
        image.pixels.extend(scan.iter().map(|p| linear(*p, factors)));
    }
    let mut notes = header.notes;
    if !rest.is_empty() {
        notes.push(format!("{} bytes after the last scan line are ignored", rest.len()));
    }
    let image = order.upright(image, &mut notes);
    Ok(Decoded {
        shape: DecodedContent::Picture(image),
        high_dynamic_range: true,
        format: FileFormat::Hdr,
        notes,
        warnings: header.warnings,
    })
}

/// A pixel's linear light; beyond f32 it is the largest f32.
fn linear([r, g, b, e]: [u8; 4], factors: [f64; 3]) -> Pixel {
    let scale = SCALES[usize::from(e)];
    let light = |m: u8, factor: f64| (f64::from(m) * scale * factor).min(f64::from(f32::MAX)) as f32;
    [light(r, factors[0]), light(g, factors[1]), light(b, factors[2]), 1.0]
}

struct Header {
    /// The factors of red, green and blue in the file.
    factors: [f64; 3],
    notes: Vec<String>,
    warnings: Vec<String>,
}

impl Header {
    /// The lines up to the empty one.
    fn read(rest: &mut &[u8]) -> Result<Self, ImageError> {
        let mut header = Header { factors: [1.0; 3], notes: Vec::new(), warnings: Vec::new() };
        let (mut exposure, mut correction) = (1.0, [1.0; 3]);
        loop {
            let line = next_line(rest)?;
            if line.is_empty() {
                break;
            }
            // Programs add their command lines; only assignments without space before them are settings.
            let Some((key, value)) = line.split_once('=') else { continue };
            match key {
                "FORMAT" => match value.trim() {
                    "32-bit_rle_rgbe" => {}
                    "32-bit_rle_xyze" => {
                        return Err(ImageError::new(
                            "the colours are CIE XYZ (32-bit_rle_xyze), which depends on a white point that the file \
                             does not state; convert it with Radiance: ra_xyze -r in.hdr out.hdr",
                        ));
                    }
                    other => {
                        return Err(ImageError::new(format!(
                            "unsupported pixel format `{other}`: expected 32-bit_rle_rgbe"
                        )));
                    }
                },
                // Both may occur several times, and then multiply.
                "EXPOSURE" => exposure *= positive(key, value)?,
                "COLORCORR" => {
                    let mut words = value.split_whitespace();
                    for factor in &mut correction {
                        *factor *= positive(key, words.next().unwrap_or_default())?;
                    }
                }
                "GAMMA" if value.trim().parse() != Ok(1.0) => header
                    .warnings
                    .push(format!("the header has gamma {}, which is ignored: RGBE is linear", value.trim())),
                "PRIMARIES" if !are_known(value) => header.warnings.push(format!(
                    "the colours have other primaries than sRGB ({}); they are read as if they were sRGB's",
                    value.trim()
                )),
                "PIXASPECT" if value.trim().parse() != Ok(1.0) => {
                    header.notes.push(format!("the aspect of the pixels ({}) is ignored", value.trim()));
                }
                _ => {}
            }
        }
        if exposure != 1.0 {
            header.notes.push(format!("the exposure of {exposure} in the header is taken back"));
        }
        if correction != [1.0; 3] {
            header.notes.push("the colour correction in the header is taken back".to_owned());
        }
        header.factors = correction.map(|c| c * exposure);
        if header.factors.iter().any(|f| !(f.is_finite() && *f > 0.0)) {
            return Err(ImageError::new(
                "the exposures in the header do not multiply to a positive number; correct the header",
            ));
        }
        Ok(header)
    }
}

/// Whether primaries are sRGB's or Radiance's, which differ by a hundredth; or are not understood, which is no reason
/// to warn of others.
fn are_known(text: &str) -> bool {
    let given: Vec<f64> = text.split_whitespace().map_while(|w| w.parse().ok()).collect();
    // Rec. 709 red, green, blue; white D65, or Radiance's equal energy.
    let colors = [0.64, 0.33, 0.30, 0.60, 0.15, 0.06];
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.011);
    given.len() != 8
        || near(&given, &colors) && (near(&given[6..], &[0.3127, 0.3290]) || near(&given[6..], &[0.3333, 0.3333]))
}

fn positive(key: &str, text: &str) -> Result<f64, ImageError> {
    text.trim().parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0).ok_or_else(|| {
        ImageError::new(format!("invalid {key} `{}` in the header: expected a positive number", text.trim()))
    })
}

/// The next line without its end. Longer ones than any program writes mean that this is no header.
fn next_line<'a>(rest: &mut &'a [u8]) -> Result<std::borrow::Cow<'a, str>, ImageError> {
    const LONGEST: usize = 1 << 16;
    let end = rest.iter().take(LONGEST).position(|b| *b == b'\n');
    let end = end.ok_or_else(|| ImageError::new("the header of this .hdr does not end; get the file again"))?;
    let line = &rest[..end];
    *rest = &rest[end + 1..];
    Ok(String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)))
}

/// The order of the pixels.
struct Order {
    /// The number of scan lines, and the number of pixels in each.
    scans: u32,
    scan_length: u32,
    /// Whether scan lines are columns.
    columns: bool,
    /// Whether the first row is the lowest, and the first column the rightmost.
    bottom_up: bool,
    right_to_left: bool,
}

impl Order {
    /// The line `-Y 512 +X 1024` and its seven relatives: `-Y` is downwards, `+X` to the right, the first of the two
    /// counts scan lines.
    fn read(rest: &mut &[u8]) -> Result<Self, ImageError> {
        let line = next_line(rest)?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let wrong = || {
            ImageError::new(format!(
                "the line with the size reads `{}`, not like `-Y 512 +X 1024`; get the file again",
                line.chars().take(60).collect::<String>()
            ))
        };
        let [first, scans, second, length] = words[..] else { return Err(wrong()) };
        let (columns, vertical, horizontal) = match (first, second) {
            ("-Y" | "+Y", "-X" | "+X") => (false, first, second),
            ("-X" | "+X", "-Y" | "+Y") => (true, second, first),
            _ => return Err(wrong()),
        };
        let number = |word: &str| word.parse::<u32>().map_err(|_| wrong());
        Ok(Order {
            scans: number(scans)?,
            scan_length: number(length)?,
            columns,
            bottom_up: vertical == "+Y",
            right_to_left: horizontal == "-X",
        })
    }

    /// The picture, whose rows are scan lines so far, the right way up.
    fn upright(&self, scans: Image, notes: &mut Vec<String>) -> Image {
        let standard = !(self.columns || self.bottom_up || self.right_to_left);
        if standard {
            return scans;
        }
        notes.push("the pixels are stored in an unusual order and are put upright".to_owned());
        let (width, height) =
            if self.columns { (self.scans, self.scan_length) } else { (self.scan_length, self.scans) };
        let mut pixels = Vec::with_capacity(scans.pixels.len());
        for y in 0..height {
            let y = if self.bottom_up { height - 1 - y } else { y };
            for x in 0..width {
                let x = if self.right_to_left { width - 1 - x } else { x };
                pixels.push(if self.columns { scans.at(y, x) } else { scans.at(x, y) });
            }
        }
        Image { width, height, pixels }
    }
}

/// The next scan line, however it is packed.
fn read_scan(rest: &mut &[u8], scan: &mut [[u8; 4]]) -> Result<(), ImageError> {
    let length = scan.len();
    // Adaptive run lengths announce themselves by two 2s, and the length of the line.
    if let [2, 2, high, low, ..] = **rest
        && (8..0x8000).contains(&length)
        && usize::from(u16::from_be_bytes([high, low])) == length
    {
        *rest = &rest[4..];
        for channel in 0..4 {
            read_channel(rest, scan, channel)?;
        }
        return Ok(());
    }
    // Flat pixels; (1, 1, 1, n) repeats the last one n times, and several such are digits to the base of 256.
    let (mut filled, mut shift) = (0, 0);
    while filled < length {
        let (pixel, after) = rest.split_first_chunk::<4>().ok_or_else(cut_off)?;
        *rest = after;
        if pixel[..3] == [1, 1, 1] && filled > 0 {
            let repeat = usize::from(pixel[3]).checked_shl(shift).unwrap_or(usize::MAX);
            let end = filled.checked_add(repeat).filter(|end| *end <= length).ok_or_else(too_long)?;
            let last = scan[filled - 1];
            scan[filled..end].fill(last);
            filled = end;
            shift += 8;
            if shift > 24 {
                return Err(too_long());
            }
        } else {
            scan[filled] = *pixel;
            filled += 1;
            shift = 0;
        }
    }
    Ok(())
}

/// One channel of a line with adaptive run lengths: above 128 a run of equal bytes, else so many different ones.
fn read_channel(rest: &mut &[u8], scan: &mut [[u8; 4]], channel: usize) -> Result<(), ImageError> {
    let mut filled = 0;
    while filled < scan.len() {
        let (&count, after) = rest.split_first().ok_or_else(cut_off)?;
        let count = usize::from(count);
        if count > 128 {
            let run = count - 128;
            let (&value, after) = after.split_first().ok_or_else(cut_off)?;
            for pixel in scan.get_mut(filled..filled + run).ok_or_else(too_long)? {
                pixel[channel] = value;
            }
            filled += run;
            *rest = after;
        } else {
            if count == 0 {
                return Err(ImageError::new("a run of this .hdr has no length; the file is damaged"));
            }
            let (values, after) = after.split_at_checked(count).ok_or_else(cut_off)?;
            for (pixel, value) in scan.get_mut(filled..filled + count).ok_or_else(too_long)?.iter_mut().zip(values) {
                pixel[channel] = *value;
            }
            filled += count;
            *rest = after;
        }
    }
    Ok(())
}

fn cut_off() -> ImageError {
    ImageError::new("this .hdr ends before the picture is whole; get it again")
}

fn too_long() -> ImageError {
    ImageError::new("a run of this .hdr is longer than its scan line; the file is damaged, get it again")
}
