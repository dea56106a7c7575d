//! OpenEXR: R, G and B, ZIP-compressed.

use super::{Encoded, beyond_half, half};
use crate::EnvironmentError;
use crate::image::Image;
use exr::prelude::{Encoding, Image as Exr, SpecificChannels, Vec2, WritableImage};
use std::io::Cursor;

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Precision {
    /// 16 bits: three decimal digits, up to 65504.
    #[default]
    Half,
    /// 32 bits: as they are in memory.
    Float,
}

/// A picture as OpenEXR: scan lines, ZIP in blocks of 16.
///
/// # Errors
///
/// A picture without pixels.
pub fn encode(image: &Image, precision: Precision) -> Result<Encoded, EnvironmentError> {
    let size = (image.width as usize, image.height as usize);
    if image.pixels.is_empty() {
        return Err(EnvironmentError::new("a picture without pixels cannot be written as OpenEXR"));
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
    done.map_err(|e| {
        EnvironmentError::new(format!("a picture of {} x {} pixels cannot be written as OpenEXR ({e})", size.0, size.1))
    })?;
    Ok(Encoded { bytes, warnings })
}
