//! Writing an environment: as what, where to, and in which format.

use crate::error::CliError;
use crate::output::{OutputFiles, OutputPath, atomic};
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::encode::{self, Appearance, Container, EnvironmentFormat};
use gonio_environment::{Cubemap, Face, Panorama};
use gonio_image::decode::FileFormat;
use gonio_image::{Image, ImageError};
use gonio_light::color::ToneMap;
use gonio_scene::nearest_word;
use rayon::prelude::*;
use std::path::Path;

/// The output, settled before anything is read.
#[derive(Debug)]
pub struct EnvironmentPlan {
    pub container: Container,
    output: OutputPath,
    /// The format of pictures; `None` for KTX2, and if it depends on what is read.
    format: Option<EnvironmentFormat>,
    bits: Option<u8>,
}

/// The outputs that were written.
#[derive(Debug, Default)]
pub struct WrittenEnvironment {
    pub outputs: Vec<OutputPath>,
    /// Warnings about what their formats cannot represent.
    pub warnings: Vec<String>,
}

impl EnvironmentPlan {
    /// Settles what OUT is.
    pub fn new(
        output: &OutputPath,
        to: Option<Container>,
        format: Option<&str>,
        bits: Option<u8>,
    ) -> Result<EnvironmentPlan, CliError> {
        let path = output.file().unwrap_or(Path::new(""));
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let by_name = EnvironmentFormat::from_extension(&extension);
        let container = to.unwrap_or(match (extension.as_str(), by_name) {
            ("ktx2", _) => Container::Ktx2,
            (_, Some(_)) => Container::Equirectangular,
            _ if output.is_stdout() => Container::Equirectangular,
            _ => Container::Faces,
        });
        let requested = format.and_then(EnvironmentFormat::from_extension);
        let format = match container {
            Container::Faces => {
                if output.is_stdout() {
                    return Err(CliError::new("six faces are six files, and stdout takes one; name a folder"));
                }
                if by_name.is_some() || extension == "ktx2" {
                    let message = format!(
                        "six faces need a folder, and `{output}` is the name of a file; leave out its extension"
                    );
                    return Err(CliError::new(message));
                }
                if !path.is_dir() && means_a_file(&extension) {
                    return Err(CliError::new(unsupported(&output.to_string(), &extension)));
                }
                requested
            }
            Container::Ktx2 => {
                if extension != "ktx2" && !output.is_stdout() {
                    return Err(CliError::new(format!("`{output}` must end in .ktx2 to be written as KTX2")));
                }
                if let Some(requested) = requested {
                    let message = format!("a .ktx2 file contains no .{}; leave out --format", requested.extension());
                    return Err(CliError::new(message));
                }
                None
            }
            _ => match (by_name, requested) {
                (None, requested) if output.is_stdout() => requested,
                (None, _) => {
                    let message = format!(
                        "`{output}` cannot be written as {container}: expected an extension .png, .exr or .hdr"
                    );
                    return Err(CliError::new(message));
                }
                (Some(named), Some(requested)) if named != requested => {
                    let message =
                        format!("`{output}` ends in .{}, but --format is {}", named.extension(), requested.extension());
                    return Err(CliError::new(message));
                }
                (named, _) => named,
            },
        };
        let is_png = format.is_none_or(|f| f == EnvironmentFormat::Png) && container != Container::Ktx2;
        if bits.is_some() && !is_png {
            return Err(CliError::new("--bits applies to PNG only; .exr has half floats, .hdr 8 bits and an exponent"));
        }
        Ok(EnvironmentPlan { container, output: output.clone(), format, bits })
    }

    /// The plan with the format of the source for faces, and for a picture to stdout, if it is not settled.
    pub fn with_format_of(mut self, source: Option<FileFormat>) -> EnvironmentPlan {
        if self.container == Container::Faces || (self.output.is_stdout() && self.container != Container::Ktx2) {
            self.format = self.format.or(source.map(EnvironmentFormat::that_preserves));
        }
        self
    }

    /// The plan with the arrangement of the source, if the output is one picture.
    pub fn with_arrangement(mut self, arrangement: Arrangement) -> EnvironmentPlan {
        if self.container == Container::Equirectangular
            && let Some(container) = Container::ALL.iter().find(|c| c.arrangement() == Some(arrangement))
        {
            self.container = *container;
        }
        self
    }

    /// Finds out, before any work, whether the files can be written.
    pub fn check_writable(&self) -> Result<(), CliError> {
        let OutputPath::File(path) = &self.output else { return Ok(()) };
        if self.container != Container::Faces {
            return atomic::check_writable(path);
        }
        match std::fs::metadata(path) {
            Ok(metadata) if !metadata.is_dir() => {
                let message = format!("`{}` is a file; six faces need a folder", path.display());
                Err(CliError::new(message))
            }
            Ok(_) => atomic::check_writable(&path.join("posx.png")),
            Err(_) => atomic::check_writable(path),
        }
    }

    fn format(&self, high_dynamic_range: bool) -> EnvironmentFormat {
        self.format.unwrap_or(if high_dynamic_range && self.bits.is_none() {
            EnvironmentFormat::Exr
        } else {
            EnvironmentFormat::Png
        })
    }

    /// Checks that exposure and tone map, if `is_requested`, apply to the output.
    pub fn check_appearance(&self, is_requested: bool, high_dynamic_range: bool) -> Result<(), CliError> {
        let is_png = self.container != Container::Ktx2 && self.format(high_dynamic_range) == EnvironmentFormat::Png;
        if is_requested && !is_png {
            let message =
                "--exposure and --tone-map apply to PNG only; other formats store light as it is (--format png)";
            return Err(CliError::new(message));
        }
        Ok(())
    }

    /// Whether light above 1 would be clipped.
    pub fn clips(&self, high_dynamic_range: bool) -> bool {
        high_dynamic_range
            && self.container != Container::Ktx2
            && self.format(high_dynamic_range) == EnvironmentFormat::Png
    }

    /// Writes six faces in the arrangement of the plan.
    pub fn write_cubemap(&self, map: Cubemap, appearance: &Appearance) -> Result<WrittenEnvironment, CliError> {
        match (self.container, self.container.arrangement()) {
            (Container::Faces, _) => self.write_faces(&map, appearance),
            (_, Some(arrangement)) => {
                let image = arrange::from_cubemap(&map, arrangement, appearance.layout).map_err(failed)?;
                self.write_picture(&image, appearance)
            }
            _ => {
                let encoded = encode::cubemap_ktx2(map, appearance).map_err(failed)?;
                self.output.write(&encoded.bytes)?;
                Ok(WrittenEnvironment { outputs: vec![self.output.clone()], warnings: encoded.warnings })
            }
        }
    }

    /// Writes a panorama.
    pub fn write_panorama(&self, panorama: &Panorama, appearance: &Appearance) -> Result<WrittenEnvironment, CliError> {
        self.write_picture(&panorama.image, appearance)
    }

    fn write_picture(&self, image: &Image, appearance: &Appearance) -> Result<WrittenEnvironment, CliError> {
        let (bytes, warnings) = self.encode(image, appearance).map_err(failed)?;
        self.output.write(&bytes)?;
        Ok(WrittenEnvironment { outputs: vec![self.output.clone()], warnings })
    }

    fn write_faces(&self, map: &Cubemap, appearance: &Appearance) -> Result<WrittenEnvironment, CliError> {
        let extension = self.format(appearance.high_dynamic_range).extension();
        let encoded: Vec<(Vec<u8>, Vec<String>)> = map
            .faces(appearance.layout)
            .par_iter()
            .map(|image| self.encode(image, appearance))
            .collect::<Result<_, ImageError>>()
            .map_err(failed)?;
        let mut written = WrittenEnvironment::default();
        let mut files = OutputFiles::new();
        let folder = self.output.file().unwrap_or(Path::new(""));
        files.make_folder(folder)?;
        for (face, (bytes, warnings)) in Face::ALL.into_iter().zip(encoded) {
            let path = folder.join(format!("{}.{extension}", face.name()));
            written.warnings.extend(warnings.into_iter().map(|w| format!("{}: {w}", path.display())));
            files.add(&path, &bytes)?;
            written.outputs.push(OutputPath::File(path));
        }
        files.commit()?;
        // A reader cannot choose between two sets in one folder.
        let others = EnvironmentFormat::ALL
            .into_iter()
            .map(EnvironmentFormat::extension)
            .chain(["jpg"])
            .filter(|e| *e != extension);
        for other in others.map(|e| folder.join(format!("posx.{e}"))).filter(|path| path.is_file()) {
            let (other, here) = (other.display(), folder.join(format!("*.{extension}")));
            let here = here.display();
            written.warnings.push(format!("`{other}` belongs to another set of faces; name `{here}` to read these"));
        }
        Ok(written)
    }

    /// A picture's bytes, and warnings about what they cannot represent.
    fn encode(&self, image: &Image, appearance: &Appearance) -> Result<(Vec<u8>, Vec<String>), ImageError> {
        let format = self.format(appearance.high_dynamic_range);
        let mut encoded = encode::picture(image, format, self.bits, appearance)?;
        if format == EnvironmentFormat::Png {
            encoded.warnings.extend(clipped(image, appearance));
        }
        Ok((encoded.bytes, encoded.warnings))
    }
}

/// Whether an extension is that of a file, and not a part of a folder's name as in `sky.v2`.
fn means_a_file(extension: &str) -> bool {
    const OTHERS: [&str; 14] =
        ["jpg", "jpeg", "dds", "ktx", "tga", "bmp", "tif", "tiff", "webp", "gif", "avif", "jxl", "pic", "rgbe"];
    OTHERS.contains(&extension) || (extension.len() >= 3 && nearest_word(extension, WRITTEN).is_some())
}

/// Extensions of files that can be written.
const WRITTEN: [&str; 4] = ["png", "exr", "hdr", "ktx2"];

fn unsupported(output: &str, extension: &str) -> String {
    let hint = nearest_word(extension, WRITTEN).map_or(String::new(), |known| format!("; did you mean .{known}?"));
    format!(
        "`{output}`: unsupported format `.{extension}`: expected .png, .exr, .hdr or .ktx2, or a folder for six faces{hint}"
    )
}

/// A warning about light that is too bright for a PNG.
fn clipped(image: &Image, appearance: &Appearance) -> Option<String> {
    if !appearance.high_dynamic_range || appearance.transform.tone_map != ToneMap::None {
        return None;
    }
    let limit = (-appearance.transform.exposure).exp2() as f32 * 1.001;
    let count = image.pixels.iter().filter(|p| p[..3].iter().any(|v| *v > limit)).count();
    let share = 100.0 * count as f64 / image.pixels.len().max(1) as f64;
    (count > 0).then(|| {
        format!(
            "{share:.1} % of the pixels are too bright for a PNG and are clipped; --tone-map or --exposure brings them into \
             range, --format exr preserves them"
        )
    })
}

fn failed(error: impl std::fmt::Display) -> CliError {
    CliError::new(error.to_string())
}
