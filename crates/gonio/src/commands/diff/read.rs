//! Reading pictures.

use crate::error::CliError;
use crate::options::limits;
use crate::report::Reporter;
use glam::DVec3;
use gonio_light::color::{OutputTransform, srgb_decode};
use gonio_scene::files::{DiskAndInput, FileSource};
use image::ImageReader;
use std::io::Cursor;
use std::path::Path;

/// The pixels of a picture as its file stores them.
pub struct Pixels {
    pub width: u32,
    pub height: u32,
    values: Values,
}

enum Values {
    /// sRGB, alpha not premultiplied.
    Eight(Vec<[u8; 4]>),
    /// sRGB, alpha not premultiplied.
    Sixteen(Vec<[u16; 4]>),
    /// Linear, alpha premultiplied.
    Float(Vec<[f32; 4]>),
}

impl Pixels {
    /// The number of pixels.
    pub fn len(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// A description of the stored values.
    pub fn depth(&self) -> &'static str {
        match self.values {
            Values::Eight(_) => "8 bits",
            Values::Sixteen(_) => "16 bits",
            Values::Float(_) => "float, linear",
        }
    }

    /// Encoded (sRGB) RGB in [0, 1] premultiplied by alpha, and alpha.
    pub fn encoded(&self, i: usize) -> [f64; 4] {
        match &self.values {
            Values::Eight(v) => premultiplied(v[i].map(|v| f64::from(v) / 255.0)),
            Values::Sixteen(v) => premultiplied(v[i].map(|v| f64::from(v) / 65535.0)),
            Values::Float(v) => {
                let p = v[i].map(f64::from);
                let alpha = p[3].clamp(0.0, 1.0);
                if alpha <= 0.0 {
                    return [0.0; 4];
                }
                let c = OutputTransform::default().encode(DVec3::new(p[0], p[1], p[2]) / alpha);
                [c.x * alpha, c.y * alpha, c.z * alpha, alpha]
            }
        }
    }

    /// Linear RGB premultiplied by alpha, and alpha.
    pub fn linear(&self, i: usize) -> [f64; 4] {
        let decoded = |p: [f64; 4]| premultiplied([srgb_decode(p[0]), srgb_decode(p[1]), srgb_decode(p[2]), p[3]]);
        match &self.values {
            Values::Eight(v) => decoded(v[i].map(|v| f64::from(v) / 255.0)),
            Values::Sixteen(v) => decoded(v[i].map(|v| f64::from(v) / 65535.0)),
            Values::Float(v) => v[i].map(f64::from),
        }
    }

    /// Whether some pixel is not opaque.
    pub fn has_alpha(&self) -> bool {
        match &self.values {
            Values::Eight(v) => v.iter().any(|p| p[3] != u8::MAX),
            Values::Sixteen(v) => v.iter().any(|p| p[3] != u16::MAX),
            Values::Float(v) => v.iter().any(|p| p[3] != 1.0),
        }
    }

    /// The displayed colour over black.
    pub fn displayed(&self, i: usize) -> [u8; 3] {
        let p = self.encoded(i);
        [0, 1, 2].map(|c| (p[c] * 255.0 + 0.5) as u8)
    }
}

fn premultiplied(p: [f64; 4]) -> [f64; 4] {
    [p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]]
}

/// Reads a picture. Its first bytes determine the format.
pub fn read(path: &Path, layer: Option<&str>, reporter: &Reporter) -> Result<Pixels, CliError> {
    let name = path.display();
    let limit = limits::default_limit();
    let named = path.to_str();
    let bytes = reporter
        .reporting_reads(DiskAndInput::new(named))
        .read_within(path, limit)
        .map_err(|e| CliError::io(format_args!("`{name}` cannot be read"), &e))?
        .into_vec();
    let broken = |e: &dyn std::fmt::Display| CliError::new(format!("`{name}` is damaged or not a picture: {e}"));
    match bytes.get(..4) {
        Some([0x89, b'P', b'N', b'G'] | [0xff, 0xd8, 0xff, _]) => decode(&bytes, limit).map_err(|e| broken(&e)),
        Some([0x76, 0x2f, 0x31, 0x01]) => read_exr(bytes, layer).map_err(|e| broken(&e)),
        _ if bytes.is_empty() => Err(CliError::new(format!("`{name}` is empty"))),
        _ => Err(CliError::new(format!("unsupported format of `{name}`: expected a .png, .jpg or .exr picture"))),
    }
}

fn decode(bytes: &[u8], limit: u64) -> Result<Pixels, image::ImageError> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(limit);
    reader.limits(limits);
    let image = reader.decode()?;
    let (width, height) = (image.width(), image.height());
    let sixteen = matches!(
        image,
        image::DynamicImage::ImageLuma16(_)
            | image::DynamicImage::ImageLumaA16(_)
            | image::DynamicImage::ImageRgb16(_)
            | image::DynamicImage::ImageRgba16(_)
    );
    let values = if sixteen {
        Values::Sixteen(image.into_rgba16().pixels().map(|p| p.0).collect())
    } else {
        Values::Eight(image.into_rgba8().pixels().map(|p| p.0).collect())
    };
    Ok(Pixels { width, height, values })
}

fn read_exr(bytes: Vec<u8>, layer: Option<&str>) -> Result<Pixels, String> {
    use exr::prelude::*;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| e.to_string())?;
    let name_of = |l: &Layer<AnyChannels<FlatSamples>>| l.attributes.layer_name.as_ref().map(Text::to_string);
    // A layer is a part of the file, or (in older programs) a prefix of channel names.
    let chosen = match layer {
        None => image.layer_data.first().map(|l| (l, String::new())),
        Some(name) => {
            image.layer_data.iter().find(|l| name_of(l).as_deref() == Some(name)).map(|l| (l, String::new())).or_else(
                || {
                    let prefix = format!("{name}.");
                    let has = |l: &&Layer<AnyChannels<FlatSamples>>| {
                        l.channel_data.list.iter().any(|c| c.name.to_string().starts_with(&prefix))
                    };
                    image.layer_data.iter().find(has).map(|l| (l, prefix.clone()))
                },
            )
        }
    };
    let Some((layer_found, prefix)) = chosen else {
        let names: Vec<String> = image.layer_data.iter().filter_map(name_of).collect();
        return Err(format!("there is no layer `{}`; the layers are {}", layer.unwrap_or_default(), names.join(", ")));
    };
    let size = layer_found.size;
    let channel = |name: &str| {
        layer_found
            .channel_data
            .list
            .iter()
            .find(|c| c.name.to_string() == format!("{prefix}{name}"))
            .map(|c| c.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let grey = channel("Y");
    let color = |name: &str| channel(name).or_else(|| grey.clone()).ok_or("there are no channels R, G and B");
    let (r, g, b) = (color("R")?, color("G")?, color("B")?);
    let a = channel("A").unwrap_or_else(|| vec![1.0; size.area()]);
    if [&r, &g, &b, &a].iter().any(|c| c.len() != size.area()) {
        return Err("the channels have different sizes".into());
    }
    let values = (0..size.area()).map(|i| [r[i], g[i], b[i], a[i]]).collect();
    Ok(Pixels { width: size.width() as u32, height: size.height() as u32, values: Values::Float(values) })
}
