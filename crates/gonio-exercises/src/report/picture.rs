//! Pictures of test scenes in 8 bits per channel, as PNG, and as contact sheets.

use gonio_check::comparison::{Evidence, PIXEL_TOLERANCE, pixel_difference};
use gonio_check::testbench::{Atlas, TILE};
use gonio_check::verdict::{Outcome, Verdict};

/// The colour of a pixel that is NaN.
pub const NAN_COLOUR: [u8; 4] = [255, 0, 255, 255];

/// A picture in RGBA, with the top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportPicture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<[u8; 4]>,
}

/// Encodes linear light from 0 to 1 as 8-bit sRGB (IEC 61966-2-1).
fn srgb(linear: f32) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

/// A pixel as it is shown: opaque, [`NAN_COLOUR`] if a channel is NaN, transparent if nothing is drawn. A student's alpha is
/// ignored, because the lab does not blend.
fn shown(pixel: &[f32; 4]) -> [u8; 4] {
    match pixel {
        pixel if !Atlas::is_drawn(pixel) => [0; 4],
        [r, g, b, _] if r.is_nan() || g.is_nan() || b.is_nan() => NAN_COLOUR,
        [r, g, b, _] => [srgb(*r), srgb(*g), srgb(*b), 255],
    }
}

/// Colours of differences from 0 to 1: from almost black through violet and orange to pale yellow. Their brightness increases
/// evenly, so that they can be distinguished without colour vision.
const HEAT: [[f32; 3]; 5] =
    [[14.0, 11.0, 32.0], [88.0, 26.0, 110.0], [188.0, 55.0, 84.0], [246.0, 138.0, 44.0], [252.0, 248.0, 176.0]];

/// The colour of a difference; 1 and above have the brightest colour.
pub fn heat(share: f32) -> [u8; 3] {
    let at = if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) } * (HEAT.len() - 1) as f32;
    let below = (at.floor() as usize).min(HEAT.len() - 2);
    let part = at - below as f32;
    let mix = |channel: usize| HEAT[below][channel] * (1.0 - part) + HEAT[below + 1][channel] * part;
    [mix(0).round() as u8, mix(1).round() as u8, mix(2).round() as u8]
}

/// A kind of picture, which is a row of a contact sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureKind {
    /// The student's picture.
    Yours,
    /// The picture of the reference.
    Reference,
    /// The difference between these two.
    Difference,
    /// The picture that the named mistakes predict.
    Predicted,
}

/// The pictures of a verdict.
pub struct Pictures<'a> {
    evidence: &'a Evidence,
    /// The scenes' names and tiles.
    scenes: Vec<(String, usize)>,
    /// The smallest difference that gets the brightest colour of [`heat`].
    pub full: f32,
    /// Whether the prediction is shown: that of named mistakes, or of a right answer's own method.
    has_prediction: bool,
}

impl<'a> Pictures<'a> {
    /// The pictures of all scenes in both the verdict and the evidence.
    pub fn new(evidence: &'a Evidence, verdict: &Verdict) -> Self {
        // The scenes of a verdict are in the order of the atlas; those with one term alone come after the named ones.
        let tile = |(index, word): (usize, &String)| {
            evidence.scenes.iter().position(|known| known == word).or((index >= evidence.scenes.len()).then_some(index))
        };
        let words: Vec<String> = verdict.scenes.iter().map(|scene| scene.scene.clone()).collect();
        let mut scenes: Vec<(String, usize)> =
            words.iter().enumerate().filter_map(|(index, word)| Some((word.clone(), tile((index, word))?))).collect();
        if words.is_empty() {
            scenes = evidence.scenes.iter().cloned().enumerate().map(|(tile, word)| (word, tile)).collect();
        }
        scenes.retain(|(_, tile)| !evidence.seen.tile(*tile).is_empty() && !evidence.reference.tile(*tile).is_empty());
        let full = full(evidence, &scenes);
        let is_explained = !verdict.mistakes.is_empty() || verdict.verdict == Outcome::Correct;
        Pictures { evidence, scenes, full, has_prediction: is_explained && evidence.predicted.is_some() }
    }

    /// Number of scenes.
    pub fn count(&self) -> usize {
        self.scenes.len()
    }

    /// The kinds of pictures that are shown. A prediction is left out if no mistake was named.
    pub fn kinds(&self) -> Vec<PictureKind> {
        let mut kinds = vec![PictureKind::Yours, PictureKind::Reference, PictureKind::Difference];
        kinds.extend(self.has_prediction.then_some(PictureKind::Predicted));
        kinds
    }

    /// The picture of a scene by its number, from 0.
    pub fn nth(&self, scene: usize, kind: PictureKind) -> Option<ReportPicture> {
        self.picture(self.scenes.get(scene)?.1, kind)
    }

    /// The picture of a scene by its name.
    pub fn find(&self, scene: &str, kind: PictureKind) -> Option<ReportPicture> {
        let (_, tile) = self.scenes.iter().find(|(word, _)| word == scene)?;
        self.picture(*tile, kind)
    }

    fn picture(&self, tile: usize, kind: PictureKind) -> Option<ReportPicture> {
        let Evidence { seen, reference, predicted, .. } = self.evidence;
        let pixels: Vec<[u8; 4]> = match kind {
            PictureKind::Yours => seen.tile(tile).iter().map(shown).collect(),
            PictureKind::Reference => reference.tile(tile).iter().map(shown).collect(),
            PictureKind::Predicted => predicted.as_ref()?.tile(tile).iter().map(shown).collect(),
            PictureKind::Difference => {
                let both = seen.tile(tile).iter().zip(reference.tile(tile));
                both.map(|(a, b)| self.difference(a, b)).collect()
            }
        };
        let side = TILE as usize;
        // The bottom row comes first in OpenGL, and last in a file.
        let rows = || pixels.chunks_exact(side).rev();
        (rows().len() == side).then(|| ReportPicture {
            width: TILE,
            height: TILE,
            pixels: rows().flatten().copied().collect(),
        })
    }

    fn difference(&self, a: &[f32; 4], b: &[f32; 4]) -> [u8; 4] {
        if !Atlas::is_drawn(a) && !Atlas::is_drawn(b) {
            return [0; 4];
        }
        if is_nan(a) != is_nan(b) {
            return NAN_COLOUR;
        }
        let [r, g, b] = heat(pixel_difference(a, b) / self.full);
        [r, g, b, 255]
    }
}

fn is_nan(pixel: &[f32; 4]) -> bool {
    Atlas::is_drawn(pixel) && pixel.iter().take(3).any(|channel| channel.is_nan())
}

/// The scale of the differences, the same in all scenes: the smallest power of 1/2 that at most one in twenty of the differing
/// pixels exceeds.
fn full(evidence: &Evidence, scenes: &[(String, usize)]) -> f32 {
    let both = |tile: usize| evidence.seen.tile(tile).iter().zip(evidence.reference.tile(tile));
    let mut differences: Vec<f32> = scenes
        .iter()
        .flat_map(|(_, tile)| both(*tile))
        .map(|(a, b)| pixel_difference(a, b))
        .filter(|difference| *difference > PIXEL_TOLERANCE)
        .collect();
    differences.sort_by(f32::total_cmp);
    let Some(most) = differences.get(differences.len() * 19 / 20) else { return 1.0 };
    let mut full = 1.0_f32;
    while full / 2.0 >= *most && full > 1.0 / 32.0 {
        full /= 2.0;
    }
    full
}

impl ReportPicture {
    /// The picture as a PNG file.
    pub fn png(&self) -> Vec<u8> {
        let bytes: Vec<u8> = self.pixels.iter().flatten().copied().collect();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        // Writing to memory cannot fail; only a picture of the wrong size would give an empty file.
        match encoder.write_header().and_then(|mut writer| writer.write_image_data(&bytes)) {
            Ok(()) => file,
            Err(_) => Vec::new(),
        }
    }

    /// The picture as the address of an `img`.
    pub fn data_uri(&self) -> String {
        format!("data:image/png;base64,{}", base64(&self.png()))
    }
}

/// Base 64 as in RFC 4648, section 4.
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |index: usize| u32::from(three.get(index).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for letter in 0..4 {
            let index = (bits >> (18 - 6 * letter)) & 63;
            text.push(if letter > three.len() { '=' } else { char::from(LETTERS[index as usize]) });
        }
    }
    text
}

/// Factor by which a contact sheet enlarges the pixels of a test scene.
const ENLARGED: usize = 3;
/// Pixels between two pictures, and around all of them.
const GAP: usize = 6;
/// The background colour, which also shows where nothing is drawn.
const BACKGROUND: [u8; 4] = [46, 48, 54, 255];

/// A contact sheet as PNG: a column for each scene, with the rows yours, reference, difference and, if a mistake is named, the
/// picture that it predicts (for a right answer: the reference with the answer's own method). Differences are colours from
/// almost black (none) to pale yellow, on the scale that the page of the same verdict states; NaN is magenta. Empty if there is
/// nothing to show.
pub fn contact_sheet(evidence: &Evidence, verdict: &Verdict) -> Vec<u8> {
    let pictures = Pictures::new(evidence, verdict);
    let kinds = pictures.kinds();
    if pictures.count() == 0 {
        return Vec::new();
    }
    let side = TILE as usize * ENLARGED;
    let length = |count: usize| GAP + count * (side + GAP);
    let (width, height) = (length(pictures.count()), length(kinds.len()));
    let (Ok(wide), Ok(high)) = (u32::try_from(width), u32::try_from(height)) else { return Vec::new() };
    let mut sheet = ReportPicture { width: wide, height: high, pixels: vec![BACKGROUND; width * height] };
    for column in 0..pictures.count() {
        for (row, kind) in kinds.iter().enumerate() {
            let Some(picture) = pictures.nth(column, *kind) else { continue };
            for y in 0..side {
                let start = (length(row) + y) * width + length(column);
                let from = &picture.pixels[(y / ENLARGED) * TILE as usize..];
                for (x, pixel) in sheet.pixels[start..start + side].iter_mut().enumerate() {
                    let drawn = from[x / ENLARGED];
                    if drawn[3] > 0 {
                        *pixel = drawn;
                    }
                }
            }
        }
    }
    sheet.png()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use gonio_render::user_program::NOT_DRAWN;

    #[test]
    fn base64_matches_the_examples_of_the_rfc() {
        for (text, expected) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("fooba", "Zm9vYmE=")]
        {
            assert_eq!(base64(text.as_bytes()), expected);
        }
        assert_eq!(base64(&[0xff, 0xfe, 0xfb]), "//77");
    }

    #[test]
    fn light_is_encoded_for_screens() {
        assert_eq!([0.0, 0.5, 1.0, 7.0, -1.0, f32::INFINITY].map(srgb), [0, 188, 255, 255, 0, 255]);
        assert_eq!(shown(&[0.5, f32::NAN, 0.0, 1.0]), NAN_COLOUR);
        assert_eq!(shown(&NOT_DRAWN), [0; 4]);
        assert_eq!(shown(&[1.0, 0.0, 0.5, 0.0]), [255, 0, 188, 255]);
    }

    #[test]
    fn differences_grow_brighter() {
        let brightness = |share: f32| heat(share).iter().map(|&channel| u32::from(channel)).sum::<u32>();
        for step in 0..20 {
            assert!(brightness(step as f32 / 20.0) < brightness((step + 1) as f32 / 20.0), "{step}");
        }
        assert_eq!(heat(9.0), heat(1.0));
        assert_eq!(heat(f32::NAN), heat(1.0));
    }

    fn evidence(difference: f32) -> Evidence {
        let size = (TILE * TILE) as usize;
        let mut seen = vec![[0.25, 0.25, 0.25, 1.0]; 2 * size];
        let reference = Atlas { pixels: seen.clone() };
        for pixel in &mut seen[..TILE as usize] {
            pixel[1] += difference;
        }
        seen[size] = NOT_DRAWN;
        let scenes = vec!["one".to_owned(), "two".to_owned()];
        Evidence { seen: Atlas { pixels: seen }, reference, predicted: None, scenes }
    }

    #[test]
    fn the_bottom_row_comes_last() {
        let evidence = evidence(0.2);
        let pictures = Pictures::new(&evidence, &Verdict::new("ex04", Outcome::Wrong, ""));
        assert_eq!(pictures.count(), 2);
        assert_eq!(pictures.full, 0.25);
        let difference = pictures.find("one", PictureKind::Difference).unwrap();
        let [r, g, b] = heat(0.2 / 0.25);
        let last = difference.pixels.len() - 1;
        assert_eq!(difference.pixels[last][0].abs_diff(r), 0);
        assert_eq!(difference.pixels[last], [r, g, b, 255]);
        assert_eq!(difference.pixels[0][..3], heat(0.0));
        assert!(
            pictures.find("three", PictureKind::Yours).is_none()
                && pictures.find("one", PictureKind::Predicted).is_none()
        );
        let two = pictures.nth(1, PictureKind::Yours).unwrap();
        assert_eq!(two.pixels[last - (TILE as usize - 1)], [0; 4]);
    }

    #[test]
    fn a_png_can_be_read_back() {
        let evidence = evidence(0.2);
        let pictures = Pictures::new(&evidence, &Verdict::new("ex04", Outcome::Wrong, ""));
        let picture = pictures.nth(0, PictureKind::Yours).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(picture.png())).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.width, info.height, info.color_type), (TILE, TILE, png::ColorType::Rgba));
        assert_eq!(bytes, picture.pixels.concat());
    }

    #[test]
    fn too_few_pixels_give_no_picture() {
        let mut evidence = evidence(0.2);
        evidence.seen.pixels.truncate(7);
        assert_eq!(Pictures::new(&evidence, &Verdict::new("ex04", Outcome::Wrong, "")).count(), 0);
        assert!(contact_sheet(&evidence, &Verdict::new("ex04", Outcome::Wrong, "")).is_empty());
    }

    #[test]
    fn each_picture_has_its_place() {
        let size = (TILE * TILE) as usize;
        let flat = |grey: [f32; 2]| Atlas {
            pixels: grey.iter().flat_map(|grey| vec![[*grey, *grey, *grey, 1.0]; size]).collect(),
        };
        let evidence = Evidence {
            seen: flat([0.0, f32::NAN]),
            reference: flat([1.0, 1.0]),
            predicted: Some(flat([0.5, 0.5])),
            scenes: vec!["one".to_owned(), "two".to_owned()],
        };
        let file = contact_sheet(&evidence, &Verdict::new("ex04", Outcome::Correct, ""));
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        let side = TILE * ENLARGED as u32 + GAP as u32;
        assert_eq!((info.width, info.height), (2 * side + GAP as u32, 4 * side + GAP as u32));
        let at = |column: u32, row: u32| {
            let (x, y) = (column * side + side / 2, row * side + side / 2);
            let start = (y * info.width + x) as usize * 4;
            [bytes[start], bytes[start + 1], bytes[start + 2]]
        };
        assert_eq!(at(0, 0), [0, 0, 0]);
        assert_eq!(at(1, 0), [255, 0, 255]);
        assert_eq!([at(0, 1), at(1, 1)], [[255; 3]; 2]);
        assert_eq!(at(0, 2), heat(1.0));
        assert_eq!(at(1, 3), [188; 3]);
        assert_eq!(bytes[..4], BACKGROUND);
    }
}
