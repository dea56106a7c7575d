//! A picture as PNG, 8 bits a channel.

use png::{BitDepth, ColorType, Compression, Encoder, Filter, SrgbRenderingIntent};

/// A picture in the numbers of a screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Pixels: width and height.
    pub size: [u32; 2],
    /// `width * height * 4` bytes, the top row first; where there is no background, colours are premultiplied by alpha.
    pub rgba: Vec<u8>,
    /// Whether the numbers are sRGB: not so where they are light unencoded, or a quantity.
    pub is_srgb: bool,
}

/// The file. Opaque pictures have three channels; in others colours are divided by alpha, as the format has them.
pub fn encode(picture: &Shown) -> Result<Vec<u8>, String> {
    let (color, bytes) = channels(&picture.rgba);
    let [width, height] = picture.size;
    let mut file = Vec::with_capacity(bytes.len() / 4);
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(color);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    // As `gonio render` writes: on rendered pictures nearly as small as choosing a filter row by row, and faster.
    encoder.set_filter(Filter::Paeth);
    if picture.is_srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    let write = |encoder: Encoder<'_, &mut Vec<u8>>| {
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()
    };
    write(encoder).map_err(|why| format!("the picture could not be encoded as PNG: {why}"))?;
    Ok(file)
}

fn channels(rgba: &[u8]) -> (ColorType, Vec<u8>) {
    let pixels = rgba.as_chunks::<4>().0;
    if pixels.iter().all(|pixel| pixel[3] == u8::MAX) {
        return (ColorType::Rgb, pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect());
    }
    (ColorType::Rgba, pixels.iter().flat_map(|&pixel| straight(pixel)).collect())
}

/// Without the alpha in its colours.
fn straight([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let divided = |c: u8| match a {
        0 => 0,
        _ => ((u32::from(c) * 255 + u32::from(a) / 2) / u32::from(a)).min(255) as u8,
    };
    [divided(r), divided(g), divided(b), a]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Colour type and bytes, read by another program's reader of the same crate family.
    fn read(file: &[u8]) -> (ColorType, Vec<u8>, bool) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap_or_else(|e| panic!("{e}"));
        let mut bytes = vec![0; reader.output_buffer_size().unwrap_or_default()];
        let info = reader.next_frame(&mut bytes).unwrap_or_else(|e| panic!("{e}"));
        let srgb = reader.info().srgb.is_some();
        (info.color_type, bytes, srgb)
    }

    #[test]
    fn an_opaque_picture_keeps_its_bytes() {
        let rgba: Vec<u8> = (0..4 * 3 * 2).map(|i| if i % 4 == 3 { 255 } else { 7 * i }).collect();
        let file = encode(&Shown { size: [3, 2], rgba: rgba.clone(), is_srgb: true }).unwrap_or_else(|e| panic!("{e}"));
        let rgb: Vec<u8> = rgba.as_chunks::<4>().0.iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
        assert_eq!(read(&file), (ColorType::Rgb, rgb, true));
    }

    #[test]
    fn alpha_is_taken_out_of_the_colours() {
        let rgba = vec![64, 32, 0, 128, 0, 0, 0, 0];
        let file = encode(&Shown { size: [2, 1], rgba, is_srgb: false }).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(read(&file), (ColorType::Rgba, vec![128, 64, 0, 128, 0, 0, 0, 0], false));
    }

    #[test]
    fn too_few_bytes_are_an_error() {
        assert!(encode(&Shown { size: [3, 2], rgba: vec![255; 4], is_srgb: true }).is_err());
    }
}
