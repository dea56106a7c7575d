//! OpenEXR: half, float and integer channels; the part and the layer that hold the colours.

use super::{Decoded, DecodedContent, FileFormat, tidy};
use crate::image::Image;
use crate::{DecodeLimits, ImageError, Pixel};
use exr::block::UncompressedBlock;
use exr::block::reader::ChunksReader;
use exr::error::Error;
use exr::meta::attribute::{EnvironmentMap, SampleType};
use exr::meta::header::Header;
use half::f16;
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;
use std::io::Cursor;

/// The first bytes of an OpenEXR file.
pub(super) const MAGIC: &[u8] = &[0x76, 0x2F, 0x31, 0x01];

/// Blocks that are unpacked at once: enough for all threads, and at most a few hundred lines of the picture.
const BATCH: usize = 64;

pub(super) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(failed)?;
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let chosen = Chosen::find(reader.headers(), &mut notes)?;
    let header = reader.headers()[chosen.part].clone();
    let window = Window::from_header(&header, limits, &mut warnings)?;
    say_what_is_ignored(&header, &mut notes, &mut warnings);

    let part = chosen.part;
    let chunks = reader
        .filter_chunks(false, |_, _, block| block.layer == part && (block.level.x(), block.level.y()) == (0, 0))
        .map_err(failed)?;
    let meta = chunks.meta_data().clone();
    // Packed they take no more memory than the file. A false header has no blocks for its size, and is detected
    // before the picture takes any.
    let mut packed = chunks.collect::<Result<Vec<_>, _>>().map_err(failed)?.into_iter();
    let mut image = limits.unfilled(window.width, window.height)?;
    image.pixels.resize(window.width as usize * window.height as usize, [0.0, 0.0, 0.0, 1.0]);
    let (mut covered, mut scratch) = (0, Vec::new());
    // By our own threads: the codec would start new ones for each file.
    while packed.len() > 0 {
        let batch: Vec<_> = packed.by_ref().take(BATCH).collect();
        let unpack = |chunk| UncompressedBlock::decompress_chunk(chunk, &meta, false);
        let blocks = batch.into_par_iter().map(unpack).collect::<Result<Vec<_>, _>>().map_err(failed)?;
        for block in blocks {
            covered += block.index.pixel_size.area();
            lay(&block, &header, &chosen, &window, &mut image, &mut scratch);
        }
    }
    // Blocks that the file lacks would stay black.
    if covered < header.layer_size.area() {
        return Err(cut_off());
    }
    tidy(&mut [&mut image.pixels], &mut warnings);
    Ok(Decoded {
        shape: DecodedContent::Picture(image),
        high_dynamic_range: true,
        format: FileFormat::Exr,
        notes,
        warnings,
    })
}

/// The part and the channels for red, green and blue; the same channel three times for a grey picture.
struct Chosen {
    part: usize,
    channels: [usize; 3],
}

impl Chosen {
    /// The first part with R, G, B; else the first with a layer `name.R`, `name.G`, `name.B`; else the first with Y, or
    /// with one channel alone.
    fn find(headers: &[Header], notes: &mut Vec<String>) -> Result<Self, ImageError> {
        let layers = headers.iter().enumerate().flat_map(|(part, header)| {
            let names: Vec<String> = header.channels.list.iter().map(|c| c.name.to_string()).collect();
            layers_of(&names).into_iter().map(move |(rank, layer, channels)| (rank, part, layer, channels))
        });
        // Deep parts hold lists of samples, not a picture.
        let flat = layers.filter(|(_, part, ..)| !headers[*part].deep);
        let best = flat.min_by_key(|(rank, part, ..)| (*rank, *part));
        let Some((rank, part, layer, channels)) = best else {
            let all: Vec<String> =
                headers.iter().flat_map(|h| h.channels.list.iter().map(|c| format!("`{}`", c.name))).take(12).collect();
            return Err(ImageError::new(format!(
                "no channels R, G and B, nor Y, are among {}; save the colours under these names",
                if all.is_empty() { "none at all".to_owned() } else { all.join(", ") }
            )));
        };
        let list = &headers[part].channels.list;
        if let Some(channel) = channels.iter().map(|c| &list[*c]).find(|c| (c.sampling.x(), c.sampling.y()) != (1, 1)) {
            return Err(ImageError::new(format!(
                "the channel `{}` has fewer pixels than the picture; save it with R, G and B for every pixel",
                channel.name
            )));
        }
        if list.iter().any(|c| (c.sampling.x(), c.sampling.y()) != (1, 1)) {
            return Err(ImageError::new(
                "some channels have fewer pixels than the picture (luminance and chroma?); save it with R, G and B for \
                 every pixel",
            ));
        }
        if rank > 0 {
            let name = if layer.is_empty() { list[channels[0]].name.to_string() } else { layer };
            notes.push(format!("the colours are those of `{name}`"));
        }
        let used = if channels[0] == channels[2] { 1 } else { 3 };
        let others: usize = headers.iter().map(|h| h.channels.list.len()).sum::<usize>() - used;
        if list.len() == used + 1 && headers.len() == 1 && list.iter().any(|c| c.name.eq_case_insensitive("A")) {
            notes.push(super::ALPHA_IGNORED.to_owned());
        } else if others > 0 {
            notes.push(format!("{others} further channels are ignored"));
        }
        Ok(Chosen { part, channels })
    }
}

/// The layers of a part that hold colours: how good a choice each is (0 the best), its name, its channels.
fn layers_of(names: &[String]) -> Vec<(u32, String, [usize; 3])> {
    let find = |name: &str| names.iter().position(|n| n.eq_ignore_ascii_case(name));
    let mut found = Vec::new();
    if let (Some(r), Some(g), Some(b)) = (find("R"), find("G"), find("B")) {
        found.push((0, String::new(), [r, g, b]));
    }
    for name in names {
        if let Some(layer) = name.strip_suffix(".R").or_else(|| name.strip_suffix(".r"))
            && let (Some(r), Some(g), Some(b)) = (find(name), find(&format!("{layer}.G")), find(&format!("{layer}.B")))
        {
            found.push((1, layer.to_owned(), [r, g, b]));
        }
    }
    if let Some(y) = find("Y") {
        found.push((2, String::new(), [y; 3]));
    } else if let [_] = names {
        found.push((3, String::new(), [0; 3]));
    }
    found
}

/// The position of the part's pixels in the picture. The picture is the display window of the file. Pixels outside of it
/// are cut off, and missing pixels are black.
struct Window {
    width: u32,
    height: u32,
    /// The column and row of the picture at which the part's first pixel lies.
    left: i64,
    top: i64,
}

impl Window {
    fn from_header(header: &Header, limits: &DecodeLimits, warnings: &mut Vec<String>) -> Result<Self, ImageError> {
        let display = header.shared_attributes.display_window;
        let data = header.layer_size;
        let (data_width, data_height) = (data.width() as u64, data.height() as u64);
        limits.pixels(data_width, data_height, 1)?;
        let (width, height) = (display.size.width() as u64, display.size.height() as u64);
        limits.pixels(width, height, 1)?;
        let position = header.own_attributes.layer_position;
        let left = i64::from(position.x()) - i64::from(display.position.x());
        let top = i64::from(position.y()) - i64::from(display.position.y());
        if left > 0
            || top > 0
            || left + (data_width as i64) < width as i64
            || top + (data_height as i64) < height as i64
        {
            warnings.push(format!(
                "the pixels ({data_width} x {data_height}) do not cover the picture ({width} x {height}); what is \
                 missing is black"
            ));
        } else if (data_width, data_height) != (width, height) {
            warnings.push(format!(
                "the pixels ({data_width} x {data_height}) go beyond the picture ({width} x {height}); what is outside \
                 is cut off"
            ));
        }
        let side = |n: u64| u32::try_from(n).map_err(|_| ImageError::new("its window is too large"));
        Ok(Window { width: side(width)?, height: side(height)?, left, top })
    }
}

fn say_what_is_ignored(header: &Header, notes: &mut Vec<String>, warnings: &mut Vec<String>) {
    match header.own_attributes.environment_map {
        Some(EnvironmentMap::LatitudeLongitude) => notes.push(
            "the file is marked as a latitude-longitude map, whose middle OpenEXR has at +Z; gonio has the middle at \
             -Z, half a turn further"
                .to_owned(),
        ),
        Some(EnvironmentMap::Cube) => {
            notes.push("the file is marked as a cube: six faces below one another".to_owned());
        }
        None => {}
    }
    if let Some(c) = header.shared_attributes.chromaticities {
        let given = [c.red, c.green, c.blue, c.white].map(|v| [v.x(), v.y()]);
        let rec709 = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];
        let far = given.iter().flatten().zip(rec709.iter().flatten()).any(|(a, b)| (a - b).abs() > 0.005);
        if far {
            warnings
                .push("the colours have other primaries than sRGB; they are read as if they were sRGB's".to_owned());
        }
    }
    if header.shared_attributes.pixel_aspect != 1.0 {
        notes.push(format!("the aspect of the pixels ({}) is ignored", header.shared_attributes.pixel_aspect));
    }
}

/// Lays a block's lines into the picture.
fn lay(
    block: &UncompressedBlock,
    header: &Header,
    chosen: &Chosen,
    window: &Window,
    image: &mut Image,
    scratch: &mut Vec<f32>,
) {
    let list = &header.channels.list;
    for line in block.lines(&header.channels) {
        if !chosen.channels.contains(&line.location.channel) {
            continue;
        }
        let y = line.location.position.y() as i64 + window.top;
        let Some(row) = usize::try_from(y).ok().filter(|y| *y < window.height as usize) else { continue };
        let Some(channel) = list.get(line.location.channel) else { continue };
        numbers(line.value, channel.sample_type, scratch);
        let x = line.location.position.x() as i64 + window.left;
        // Of the line's numbers those that lie in the picture.
        let skip = usize::try_from(-x).unwrap_or(0).min(scratch.len());
        let x = usize::try_from(x).unwrap_or(0).min(window.width as usize);
        let pixels: &mut [Pixel] = &mut image.pixels[row * window.width as usize..][..window.width as usize];
        for (component, _) in chosen.channels.iter().enumerate().filter(|(_, c)| **c == line.location.channel) {
            for (pixel, number) in pixels[x..].iter_mut().zip(&scratch[skip..]) {
                pixel[component] = *number;
            }
        }
    }
}

/// A line's numbers, which the codec leaves in the machine's own order of bytes.
fn numbers(bytes: &[u8], kind: SampleType, into: &mut Vec<f32>) {
    into.clear();
    match kind {
        SampleType::F16 => {
            let halves: Vec<f16> = bytes.as_chunks::<2>().0.iter().map(|b| f16::from_ne_bytes(*b)).collect();
            into.resize(halves.len(), 0.0);
            // Many at once, with the processor's own instruction where it has one.
            halves.convert_to_f32_slice(into);
        }
        SampleType::F32 => into.extend(bytes.as_chunks::<4>().0.iter().map(|b| f32::from_ne_bytes(*b))),
        SampleType::U32 => into.extend(bytes.as_chunks::<4>().0.iter().map(|b| u32::from_ne_bytes(*b) as f32)),
    }
}

fn failed(error: Error) -> ImageError {
    match error {
        Error::NotSupported(what) => ImageError::new(format!(
            "this OpenEXR file cannot be read ({what}); save it as one flat picture with ZIP compression"
        )),
        Error::Io(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => cut_off(),
        error => ImageError::new(format!("this OpenEXR file is damaged ({error}); get it again")),
    }
}

fn cut_off() -> ImageError {
    ImageError::new("this OpenEXR file ends before the picture is whole; get it again")
}
