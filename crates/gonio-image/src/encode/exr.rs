//! OpenEXR, ZIP-compressed in blocks of 16 scan lines.

use super::{Encoded, beyond_half, half};
use crate::image::Image;
use crate::{ImageError, Pixel};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image as Exr, ImageAttributes, IntegerBounds, Layer as ExrLayer,
    LayerAttributes, Layers, SpecificChannels, Text, Vec2, WritableImage,
};
use std::io::Cursor;

/// The number format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Precision {
    /// 16 bits: three decimal digits, up to 65504.
    #[default]
    Half,
    /// 32 bits: as they are in memory.
    Float,
}

/// Encodes R, G and B of an image.
///
/// # Errors
///
/// An image without pixels.
pub fn encode(image: &Image, precision: Precision) -> Result<Encoded, ImageError> {
    let size = (image.width as usize, image.height as usize);
    if image.pixels.is_empty() {
        return Err(ImageError::new("a picture without pixels cannot be written as OpenEXR"));
    }
    let at = |x: usize, y: usize| {
        let [r, g, b, _] = image.pixels[y * size.0 + x];
        (r, g, b)
    };
    let encoding = Encoding::SMALL_LOSSLESS;
    let mut bytes = Vec::new();
    let to = Cursor::new(&mut bytes);
    let (done, warnings) = match precision {
        Precision::Float => {
            let mut file = Exr::from_channels(size, SpecificChannels::rgb(|Vec2(x, y)| at(x, y)));
            file.layer_data.encoding = encoding;
            (file.write().to_buffered(to), Vec::new())
        }
        Precision::Half => {
            let channels = SpecificChannels::rgb(|Vec2(x, y)| {
                let (r, g, b) = at(x, y);
                (half(r), half(g), half(b))
            });
            let mut file = Exr::from_channels(size, channels);
            file.layer_data.encoding = encoding;
            let warnings = beyond_half(&image.pixels, "write floats to keep them").into_iter().collect();
            (file.write().to_buffered(to), warnings)
        }
    };
    done.map_err(|e| failed(size, &e))?;
    Ok(Encoded { bytes, warnings })
}

fn failed((width, height): (usize, usize), error: &exr::error::Error) -> ImageError {
    ImageError::new(format!("a picture of {width} x {height} pixels cannot be written as OpenEXR: {error}"))
}

/// A layer: linear RGBA, alpha premultiplied as the format has it.
pub struct Layer<'a> {
    /// The layer's name in the file.
    pub name: &'a str,
    /// `width * height` pixels, first row the top one.
    pub pixels: &'a [Pixel],
}

/// Encodes layers of one size as 32-bit floats. Viewers that do not know layers show the first.
///
/// # Errors
///
/// No layers, layers without pixels, or layers of another size.
pub fn encode_layers([width, height]: [u32; 2], layers: &[Layer<'_>]) -> Result<Vec<u8>, ImageError> {
    let size = Vec2(width as usize, height as usize);
    if layers.is_empty() {
        return Err(ImageError::new("an OpenEXR file needs at least one layer"));
    }
    if size.area() == 0 || layers.iter().any(|layer| layer.pixels.len() != size.area()) {
        return Err(ImageError::new(format!(
            "a layer of an OpenEXR file does not have the {width} x {height} pixels of the picture"
        )));
    }
    let layers: Layers<AnyChannels<FlatSamples>> = layers.iter().map(|layer| float_layer(layer, size)).collect();
    let mut attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    attributes.pixel_aspect = 1.0;
    let mut file = Cursor::new(Vec::new());
    let done = Exr { attributes, layer_data: layers }.write().to_buffered(&mut file);
    done.map_err(|e| failed((size.0, size.1), &e))?;
    Ok(file.into_inner())
}

fn float_layer(layer: &Layer<'_>, size: Vec2<usize>) -> ExrLayer<AnyChannels<FlatSamples>> {
    let channel = |index: usize, name: &str| {
        AnyChannel::new(name, FlatSamples::F32(layer.pixels.iter().map(|p| p[index]).collect()))
    };
    let channels = [channel(0, "R"), channel(1, "G"), channel(2, "B"), channel(3, "A")];
    let mut attributes = LayerAttributes::named(layer.name);
    attributes.software_name = Some(Text::from("gonio"));
    ExrLayer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels.into_iter().collect()))
}
