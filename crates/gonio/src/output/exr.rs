//! OpenEXR: linear light as it is, 32 bits a channel, alpha premultiplied as the format has it.

use crate::report::CliError;
use exr::prelude::*;
use gonio_scene::Picture;
use std::io::Cursor;

/// A picture with its name.
pub struct NamedPicture {
    /// The layer's name.
    pub name: String,
    /// Linear.
    pub picture: Picture,
}

/// All pictures as layers of one file; they have one size. The first is what a viewer shows that
/// knows nothing of layers.
pub fn encode(pictures: &[NamedPicture]) -> std::result::Result<Vec<u8>, CliError> {
    let Some(first) = pictures.first() else {
        return Err(CliError::new("an EXR file needs at least one picture"));
    };
    let size = Vec2(first.picture.width as usize, first.picture.height as usize);
    let layers: Layers<AnyChannels<FlatSamples>> = pictures.iter().map(|named| layer(named, size)).collect();
    let mut attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    attributes.pixel_aspect = 1.0;
    let image = Image { attributes, layer_data: layers };
    let mut file = Cursor::new(Vec::new());
    image
        .write()
        .to_buffered(&mut file)
        .map_err(|e| CliError::new(format!("the picture could not be encoded as EXR: {e}")))?;
    Ok(file.into_inner())
}

fn layer(named: &NamedPicture, size: Vec2<usize>) -> Layer<AnyChannels<FlatSamples>> {
    let channel = |index: usize, name: &str| {
        let samples = named.picture.pixels.iter().map(|p| p[index]).collect();
        AnyChannel::new(name, FlatSamples::F32(samples))
    };
    let channels = [channel(0, "R"), channel(1, "G"), channel(2, "B"), channel(3, "A")];
    let mut attributes = LayerAttributes::named(named.name.as_str());
    attributes.software_name = Some(Text::from("gonio"));
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    Layer::new(size, attributes, encoding, AnyChannels::sort(channels.into_iter().collect()))
}
