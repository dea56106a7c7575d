//! Conversions: an environment is read again from its files, converted, encoded, and packed.

use super::{EnvironmentProduct, EnvironmentSource};
use crate::beside::Steps;
use crate::files;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::convert::Conversion;
use gonio_environment::encode::{self, Appearance, Container, EnvironmentFormat};
use gonio_environment::{Cubemap, Face, Layout, Panorama};
use gonio_image::Image;
use gonio_language::tr;
use gonio_light::color::{ColorEncoding, OutputTransform};
use gonio_scene::environment_check::EnvironmentFinding;
use gonio_scene::environment_file::{EnvironmentMap, OpenedEnvironment};

/// Files with their names, and warnings about what they cannot represent.
pub struct ConvertedFiles {
    /// One file, or the six faces by their names, with extension.
    pub files: Vec<(String, Vec<u8>)>,
    /// One sentence each, without full stop.
    pub warnings: Vec<String>,
}

/// The purpose of a conversion.
#[derive(Clone, Copy)]
pub enum ConversionGoal {
    /// A product, with the transform of light to a PNG's colours.
    Product(EnvironmentProduct, OutputTransform),
    /// The repaired environment, exactly, in a file of the same form.
    Repaired,
}

/// A conversion at work: reads, converts, and encodes file by file.
pub struct ConversionWork {
    goal: ConversionGoal,
    stage: ConversionStage,
    done: ConvertedFiles,
}

enum ConversionStage {
    Read(EnvironmentSource),
    Convert(Box<OpenedEnvironment>),
    /// Pictures to encode, the last one first.
    Encode(Vec<(String, Image)>, EnvironmentFormat, Appearance),
    EncodeCubemap(Box<Cubemap>, Appearance),
    Ended,
}

impl ConversionWork {
    /// Begins the conversion.
    pub fn new(source: EnvironmentSource, goal: ConversionGoal) -> Self {
        let done = ConvertedFiles { files: Vec::new(), warnings: Vec::new() };
        ConversionWork { goal, stage: ConversionStage::Read(source), done }
    }

    fn convert(&self, opened: OpenedEnvironment) -> Result<ConversionStage, String> {
        let appearance = |layout, transform, exact| Appearance {
            layout,
            transform,
            high_dynamic_range: opened.high_dynamic_range,
            exact,
        };
        match self.goal {
            ConversionGoal::Repaired => {
                let finding = EnvironmentFinding::of(&opened).map_err(|error| error.to_string())?;
                let transform = OutputTransform { encoding: ColorEncoding::Srgb, ..OutputTransform::default() };
                let appearance = appearance(Layout::OpenGl, transform, true);
                Ok(match finding.repaired(&opened).map_err(|error| error.to_string())? {
                    EnvironmentMap::Cubemap(map) => ConversionStage::EncodeCubemap(Box::new(map), appearance),
                    EnvironmentMap::Panorama(panorama) => {
                        let format = opened.format.map_or(EnvironmentFormat::Exr, EnvironmentFormat::that_preserves);
                        let name = format!("repaired.{}", format.extension());
                        ConversionStage::Encode(vec![(name, panorama.image)], format, appearance)
                    }
                })
            }
            ConversionGoal::Product(product, transform) => {
                let appearance = appearance(product.layout, transform, false);
                if product.container == Container::Equirectangular {
                    let panorama = as_panorama(opened.map, product.size);
                    return Ok(ConversionStage::Encode(
                        vec![(String::new(), panorama.image)],
                        product.format,
                        appearance,
                    ));
                }
                let map = as_cubemap(opened.map, product.size);
                let arranged = |arrangement: Arrangement| {
                    let image = arrange::from_cubemap(&map, arrangement, product.layout);
                    image.map(|image| vec![(String::new(), image)]).map_err(|error| error.to_string())
                };
                let pictures = match product.container.arrangement() {
                    Some(arrangement) => arranged(arrangement)?,
                    None if product.container == Container::Ktx2 => {
                        return Ok(ConversionStage::EncodeCubemap(Box::new(map), appearance));
                    }
                    None => {
                        let name = |face: Face| format!("{}.{}", face.name(), product.format.extension());
                        let named = Face::ALL.into_iter().map(name).zip(map.faces(product.layout));
                        named.rev().collect()
                    }
                };
                Ok(ConversionStage::Encode(pictures, product.format, appearance))
            }
        }
    }

    fn take(&mut self, name: String, encoded: gonio_image::encode::Encoded) {
        for warning in encoded.warnings {
            if !self.done.warnings.contains(&warning) {
                self.done.warnings.push(warning);
            }
        }
        self.done.files.push((name, encoded.bytes));
    }

    /// The files, in one zip file if that was requested.
    fn finish(&mut self) -> ConvertedFiles {
        let empty = ConvertedFiles { files: Vec::new(), warnings: Vec::new() };
        let mut done = std::mem::replace(&mut self.done, empty);
        if matches!(self.goal, ConversionGoal::Product(product, _) if product.is_zip) {
            let files: Vec<(&str, &[u8])> =
                done.files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
            done.files = vec![(String::new(), files::pack(&files))];
        }
        done
    }
}

impl Steps for ConversionWork {
    type Output = Result<ConvertedFiles, String>;

    fn step(&mut self) -> Option<Self::Output> {
        match std::mem::replace(&mut self.stage, ConversionStage::Ended) {
            ConversionStage::Read(source) => match source.open() {
                Ok(opened) => self.stage = ConversionStage::Convert(Box::new(opened)),
                Err(error) => return Some(Err(error)),
            },
            ConversionStage::Convert(opened) => match self.convert(*opened) {
                Ok(stage) => self.stage = stage,
                Err(error) => return Some(Err(error)),
            },
            ConversionStage::Encode(mut pictures, format, appearance) => {
                let Some((name, image)) = pictures.pop() else { return Some(Ok(self.finish())) };
                match encode::picture(&image, format, None, &appearance) {
                    Ok(encoded) => self.take(name, encoded),
                    Err(error) => return Some(Err(error.to_string())),
                }
                self.stage = ConversionStage::Encode(pictures, format, appearance);
            }
            ConversionStage::EncodeCubemap(map, appearance) => match encode::cubemap_ktx2(*map, &appearance) {
                Ok(encoded) => {
                    self.take("repaired.ktx2".to_owned(), encoded);
                    return Some(Ok(self.finish()));
                }
                Err(error) => return Some(Err(error.to_string())),
            },
            ConversionStage::Ended => {
                return Some(Err(tr!("environment-the-environment-was-converted-already").to_owned()));
            }
        }
        None
    }
}

/// The cubemap of this size, or as fine as the map.
fn as_cubemap(map: EnvironmentMap, size: Option<u32>) -> Cubemap {
    let size = size.unwrap_or_else(|| map.as_environment().natural_cubemap_size());
    match map {
        EnvironmentMap::Cubemap(map) if map.size() == size => map,
        other => Conversion::default().cubemap(other.as_environment(), size),
    }
}

/// The panorama whose faces have this size, or as fine as the map.
fn as_panorama(map: EnvironmentMap, size: Option<u32>) -> Panorama {
    match (map, size) {
        (EnvironmentMap::Panorama(panorama), None) => panorama,
        (map, size) => {
            let height = size.map_or_else(|| map.as_environment().natural_panorama_height(), |size| 2 * size);
            Conversion::default().panorama(map.as_environment(), 2 * height, height)
        }
    }
}
