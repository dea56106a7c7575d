//! Conversions: an environment is read again from its files, converted, encoded, and packed.

use super::EnvironmentSource;
use crate::beside::Steps;
use crate::files;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::convert::Conversion;
use gonio_environment::encode::{self, Appearance, Container, PictureFormat};
use gonio_environment::{Cubemap, Face, Layout, Panorama};
use gonio_image::Image;
use gonio_light::color::{ColorEncoding, OutputTransform};
use gonio_scene::environment_check::EnvironmentFinding;
use gonio_scene::environment_file::{EnvironmentMap, OpenedEnvironment};

/// An environment to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnvironmentProduct {
    /// The container.
    pub container: Container,
    /// The format of pictures; KTX2 has its own.
    pub format: PictureFormat,
    /// Texels along an edge of a face; a panorama is four times as wide. `None`: as fine as the environment.
    pub size: Option<u32>,
    /// The layout of faces.
    pub layout: Layout,
    /// Whether six faces are one zip file.
    pub is_zip: bool,
}

impl EnvironmentProduct {
    /// Kebab-case, for widgets' ids.
    pub fn id(self) -> &'static str {
        match (self.container, self.is_zip) {
            (Container::Faces, true) => "environment-faces-zip",
            (Container::Faces, false) => "environment-faces",
            (Container::Cross, _) => "environment-cross",
            (Container::VerticalCross, _) => "environment-vertical-cross",
            (Container::Strip, _) => "environment-strip",
            (Container::VerticalStrip, _) => "environment-vertical-strip",
            (Container::Equirectangular, _) => "environment-panorama",
            (Container::Ktx2, _) => "environment-ktx2",
        }
    }

    /// The title of its button.
    pub fn title(self) -> &'static str {
        match (self.container, self.is_zip) {
            (Container::Faces, true) => "Six faces (ZIP)",
            (Container::Faces, false) => "Six faces",
            (Container::Cross, _) => "Cross",
            (Container::VerticalCross, _) => "Vertical cross",
            (Container::Strip, _) => "Strip",
            (Container::VerticalStrip, _) => "Vertical strip",
            (Container::Equirectangular, _) => "Panorama",
            (Container::Ktx2, _) => "KTX2",
        }
    }

    /// The file name extension.
    pub fn extension(self) -> &'static str {
        match (self.container, self.is_zip) {
            (Container::Faces, true) => "zip",
            (Container::Ktx2, _) => "ktx2",
            _ => self.format.extension(),
        }
    }

    /// Follows the environment's name in the name of the file.
    pub fn suffix(self) -> &'static str {
        match self.container {
            Container::Faces if self.is_zip => "_faces",
            Container::Cross | Container::VerticalCross => "_cross",
            Container::Strip | Container::VerticalStrip => "_strip",
            Container::Equirectangular => "_panorama",
            Container::Faces | Container::Ktx2 => "",
        }
    }
}

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
    stage: Stage,
    done: ConvertedFiles,
}

enum Stage {
    Read(EnvironmentSource),
    Convert(Box<OpenedEnvironment>),
    /// Pictures to encode, the last one first.
    Encode(Vec<(String, Image)>, PictureFormat, Appearance),
    EncodeCubemap(Box<Cubemap>, Appearance),
    Ended,
}

impl ConversionWork {
    /// Begins the conversion.
    pub fn new(source: EnvironmentSource, goal: ConversionGoal) -> Self {
        let done = ConvertedFiles { files: Vec::new(), warnings: Vec::new() };
        ConversionWork { goal, stage: Stage::Read(source), done }
    }

    fn convert(&self, opened: OpenedEnvironment) -> Result<Stage, String> {
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
                    EnvironmentMap::Cubemap(map) => Stage::EncodeCubemap(Box::new(map), appearance),
                    EnvironmentMap::Panorama(panorama) => {
                        let format = opened.format.map_or(PictureFormat::Exr, PictureFormat::that_preserves);
                        let name = format!("repaired.{}", format.extension());
                        Stage::Encode(vec![(name, panorama.image)], format, appearance)
                    }
                })
            }
            ConversionGoal::Product(product, transform) => {
                let appearance = appearance(product.layout, transform, false);
                if product.container == Container::Equirectangular {
                    let panorama = as_panorama(opened.map, product.size);
                    return Ok(Stage::Encode(vec![(String::new(), panorama.image)], product.format, appearance));
                }
                let map = as_cubemap(opened.map, product.size);
                let arranged = |arrangement: Arrangement| {
                    let image = arrange::from_cubemap(&map, arrangement, product.layout);
                    image.map(|image| vec![(String::new(), image)]).map_err(|error| error.to_string())
                };
                let pictures = match product.container.arrangement() {
                    Some(arrangement) => arranged(arrangement)?,
                    None if product.container == Container::Ktx2 => {
                        return Ok(Stage::EncodeCubemap(Box::new(map), appearance));
                    }
                    None => {
                        let name = |face: Face| format!("{}.{}", face.name(), product.format.extension());
                        let named = Face::ALL.into_iter().map(name).zip(map.faces(product.layout));
                        named.rev().collect()
                    }
                };
                Ok(Stage::Encode(pictures, product.format, appearance))
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
        match std::mem::replace(&mut self.stage, Stage::Ended) {
            Stage::Read(source) => match source.open() {
                Ok(opened) => self.stage = Stage::Convert(Box::new(opened)),
                Err(error) => return Some(Err(error)),
            },
            Stage::Convert(opened) => match self.convert(*opened) {
                Ok(stage) => self.stage = stage,
                Err(error) => return Some(Err(error)),
            },
            Stage::Encode(mut pictures, format, appearance) => {
                let Some((name, image)) = pictures.pop() else { return Some(Ok(self.finish())) };
                match encode::picture(&image, format, None, &appearance) {
                    Ok(encoded) => self.take(name, encoded),
                    Err(error) => return Some(Err(error.to_string())),
                }
                self.stage = Stage::Encode(pictures, format, appearance);
            }
            Stage::EncodeCubemap(map, appearance) => match encode::cubemap_ktx2(*map, &appearance) {
                Ok(encoded) => {
                    self.take("repaired.ktx2".to_owned(), encoded);
                    return Some(Ok(self.finish()));
                }
                Err(error) => return Some(Err(error.to_string())),
            },
            Stage::Ended => return Some(Err("the environment was converted already".to_owned())),
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
