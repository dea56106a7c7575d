//! An environment to files: what, where to, in which format.

use crate::output::{FileSet, atomic};
use crate::report::CliError;
use crate::values::nearest;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::{CubeMips, Cubemap, Face, Layout, Panorama};
use gonio_image::decode::{self, FileFormat, Shape};
use gonio_image::encode::{exr, hdr, ktx2, png};
use gonio_image::{Image, ImageError, Limits};
use gonio_light::color::{OutputTransform, ToneMap};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Six files in a folder.
    Faces,
    /// The cube unfolded, 4 by 3.
    Cross,
    /// The cube unfolded, 3 by 4.
    VerticalCross,
    /// Side by side.
    Strip,
    /// One below the other.
    VerticalStrip,
    /// A panorama.
    Equirectangular,
    /// A cubemap with its mip levels.
    Ktx2,
}

impl Kind {
    /// All.
    pub const ALL: &'static [Self] = &[
        Self::Faces,
        Self::Cross,
        Self::VerticalCross,
        Self::Strip,
        Self::VerticalStrip,
        Self::Equirectangular,
        Self::Ktx2,
    ];

    /// As written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Faces => Arrangement::Faces.name(),
            Self::Cross => Arrangement::Cross.name(),
            Self::VerticalCross => Arrangement::VerticalCross.name(),
            Self::Strip => Arrangement::Strip.name(),
            Self::VerticalStrip => Arrangement::VerticalStrip.name(),
            Self::Equirectangular => Arrangement::Equirectangular.name(),
            Self::Ktx2 => "ktx2",
        }
    }

    /// Whether six faces are made for it.
    pub fn has_faces(self) -> bool {
        self != Self::Equirectangular
    }

    /// Of one picture with six faces: how they lie in it.
    fn arrangement(self) -> Option<Arrangement> {
        match self {
            Self::Cross => Some(Arrangement::Cross),
            Self::VerticalCross => Some(Arrangement::VerticalCross),
            Self::Strip => Some(Arrangement::Strip),
            Self::VerticalStrip => Some(Arrangement::VerticalStrip),
            Self::Faces | Self::Equirectangular | Self::Ktx2 => None,
        }
    }
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
    Hdr,
}

impl Format {
    const ALL: [Format; 3] = [Format::Png, Format::Exr, Format::Hdr];

    fn named(name: &str) -> Option<Format> {
        match name {
            "png" => Some(Format::Png),
            "exr" => Some(Format::Exr),
            "hdr" => Some(Format::Hdr),
            _ => None,
        }
    }

    /// What keeps all that a file of a kind holds.
    fn that_keeps(kind: FileFormat) -> Format {
        match kind {
            FileFormat::Png | FileFormat::Jpeg => Format::Png,
            FileFormat::Hdr => Format::Hdr,
            FileFormat::Exr | FileFormat::Ktx2 | FileFormat::Dds => Format::Exr,
        }
    }

    fn extension(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Exr => "exr",
            Format::Hdr => "hdr",
        }
    }
}

/// What is written where, settled before anything is read.
#[derive(Debug)]
pub struct Plan {
    /// What.
    pub kind: Kind,
    output: PathBuf,
    /// Of pictures; `None` for faces whose format depends on what is read, and for KTX2.
    format: Option<Format>,
    bits: Option<u8>,
}

/// How it is to look.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Of faces.
    pub layout: Layout,
    /// For PNG.
    pub transform: OutputTransform,
    /// What was read has light above 1.
    pub high_dynamic_range: bool,
    /// Every number is to be read again as it is: with as many bits as that takes.
    pub exact: bool,
}

/// What was written.
#[derive(Debug, Default)]
pub struct Written {
    /// The files.
    pub outputs: Vec<PathBuf>,
    /// What they could not hold.
    pub warnings: Vec<String>,
}

impl Plan {
    /// Settles what OUT is.
    pub fn new(output: &Path, to: Option<Kind>, format: Option<&str>, bits: Option<u8>) -> Result<Plan, CliError> {
        let extension = output.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let by_name = Format::named(&extension);
        let kind = to.unwrap_or(match (extension.as_str(), by_name) {
            ("ktx2", _) => Kind::Ktx2,
            (_, Some(_)) => Kind::Equirectangular,
            _ => Kind::Faces,
        });
        let asked = format.and_then(Format::named);
        let shown = output.display();
        let format = match kind {
            Kind::Faces => {
                if by_name.is_some() || extension == "ktx2" {
                    let message =
                        format!("six faces go to a folder, and `{shown}` is a file's name; leave its ending out");
                    return Err(CliError::new(message));
                }
                if !output.is_dir() && means_a_file(&extension) {
                    return Err(CliError::new(not_written(&shown.to_string(), &extension)));
                }
                asked
            }
            Kind::Ktx2 => {
                if extension != "ktx2" {
                    return Err(CliError::new(format!("`{shown}` must end in .ktx2 to be written as KTX2")));
                }
                if let Some(asked) = asked {
                    let message = format!("a .ktx2 file holds no .{}; leave --format out", asked.extension());
                    return Err(CliError::new(message));
                }
                None
            }
            _ => match (by_name, asked) {
                (None, _) => {
                    let message = format!("`{shown}` cannot be written as {kind}: it must end in .png, .exr or .hdr");
                    return Err(CliError::new(message));
                }
                (Some(named), Some(asked)) if named != asked => {
                    let message =
                        format!("`{shown}` ends in .{} and --format says {}", named.extension(), asked.extension());
                    return Err(CliError::new(message));
                }
                (named, _) => named,
            },
        };
        let is_png = format.is_none_or(|f| f == Format::Png) && kind != Kind::Ktx2;
        if bits.is_some() && !is_png {
            return Err(CliError::new("--bits belongs to PNG; .exr has half floats, .hdr 8 bits and an exponent"));
        }
        Ok(Plan { kind, output: output.to_owned(), format, bits })
    }

    /// The same; faces and pictures whose format nothing has settled keep that of the file they come from.
    pub fn with_format_of(mut self, kind: Option<FileFormat>) -> Plan {
        if self.kind == Kind::Faces {
            self.format = self.format.or(kind.map(Format::that_keeps));
        }
        self
    }

    /// The same; a picture that is not said to be anything else is arranged like what was read.
    pub fn with_arrangement(mut self, arrangement: Arrangement) -> Plan {
        if self.kind == Kind::Equirectangular
            && let Some(kind) = Kind::ALL.iter().find(|k| k.arrangement() == Some(arrangement))
        {
            self.kind = *kind;
        }
        self
    }

    /// Whether there is a place for it.
    pub fn check_writable(&self) -> Result<(), CliError> {
        if self.kind != Kind::Faces {
            return atomic::check_writable(&self.output);
        }
        match std::fs::metadata(&self.output) {
            Ok(metadata) if !metadata.is_dir() => {
                let message = format!("`{}` is a file; six faces want a folder", self.output.display());
                Err(CliError::new(message))
            }
            Ok(_) => atomic::check_writable(&self.output.join("posx.png")),
            Err(_) => atomic::check_writable(&self.output),
        }
    }

    fn format(&self, high_dynamic_range: bool) -> Format {
        self.format.unwrap_or(if high_dynamic_range && self.bits.is_none() { Format::Exr } else { Format::Png })
    }

    /// Whether exposure and tone map, where they were given, have a picture to act on.
    pub fn check_look(&self, given: bool, high_dynamic_range: bool) -> Result<(), CliError> {
        let is_png = self.kind != Kind::Ktx2 && self.format(high_dynamic_range) == Format::Png;
        if given && !is_png {
            let message = "--exposure and --tone-map belong to PNG; other formats keep light as it is (--format png)";
            return Err(CliError::new(message));
        }
        Ok(())
    }

    /// Whether light above 1 would be lost.
    pub fn clips(&self, high_dynamic_range: bool) -> bool {
        high_dynamic_range && self.kind != Kind::Ktx2 && self.format(high_dynamic_range) == Format::Png
    }

    /// Writes six faces, in whatever arrangement.
    pub fn write_cubemap(&self, map: Cubemap, look: &Look) -> Result<Written, CliError> {
        match (self.kind, self.kind.arrangement()) {
            (Kind::Faces, _) => self.write_faces(&map, look),
            (_, Some(arrangement)) => {
                let image = arrange::from_cubemap(&map, arrangement, look.layout).map_err(failed)?;
                self.write_picture(&image, look)
            }
            _ => {
                let formats = [ktx2::Format::Srgb8, ktx2::Format::Half, ktx2::Format::Float];
                let mips = CubeMips::new(map);
                let least = usize::from(look.high_dynamic_range);
                let encode = |format: &ktx2::Format| Ok(mips.to_ktx2(*format)).map(|e| (e.bytes, e.warnings));
                let faces = mips.full().faces(Layout::OpenGl);
                let (bytes, warnings) =
                    if look.exact { first_exact(&formats[least..], &faces, encode) } else { encode(&formats[least]) }
                        .map_err(failed)?;
                atomic::write(&self.output, &bytes)?;
                Ok(Written { outputs: vec![self.output.clone()], warnings })
            }
        }
    }

    /// Writes a panorama.
    pub fn write_panorama(&self, panorama: &Panorama, look: &Look) -> Result<Written, CliError> {
        self.write_picture(&panorama.image, look)
    }

    fn write_picture(&self, image: &Image, look: &Look) -> Result<Written, CliError> {
        let (bytes, warnings) = self.encode(image, look).map_err(failed)?;
        atomic::write(&self.output, &bytes)?;
        Ok(Written { outputs: vec![self.output.clone()], warnings })
    }

    fn write_faces(&self, map: &Cubemap, look: &Look) -> Result<Written, CliError> {
        let extension = self.format(look.high_dynamic_range).extension();
        let encoded: Vec<(Vec<u8>, Vec<String>)> = map
            .faces(look.layout)
            .par_iter()
            .map(|image| self.encode(image, look))
            .collect::<Result<_, ImageError>>()
            .map_err(failed)?;
        let mut written = Written::default();
        let mut files = FileSet::new();
        files.make_folder(&self.output)?;
        for (face, (bytes, warnings)) in Face::ALL.into_iter().zip(encoded) {
            let path = self.output.join(format!("{}.{extension}", face.name()));
            written.warnings.extend(warnings.into_iter().map(|w| format!("{}: {w}", path.display())));
            files.add(&path, &bytes)?;
            written.outputs.push(path);
        }
        files.commit()?;
        // Two sets in a folder are a riddle for whoever reads it.
        let others = Format::ALL.into_iter().map(Format::extension).chain(["jpg"]).filter(|e| *e != extension);
        for other in others.map(|e| self.output.join(format!("posx.{e}"))).filter(|path| path.is_file()) {
            let (other, here) = (other.display(), self.output.join(format!("*.{extension}")));
            let here = here.display();
            written.warnings.push(format!("`{other}` is of another set of faces; name `{here}` to read these"));
        }
        Ok(written)
    }

    /// A picture's bytes, and what they could not hold.
    fn encode(&self, image: &Image, look: &Look) -> Result<(Vec<u8>, Vec<String>), ImageError> {
        match self.format(look.high_dynamic_range) {
            Format::Png => {
                let encode = |depth: &png::Depth| {
                    let bytes = png::encode(image, &look.transform, *depth)?;
                    Ok((bytes, clipped(image, look).into_iter().collect()))
                };
                match (self.bits, look.exact) {
                    (Some(16), _) => encode(&png::Depth::Sixteen),
                    (Some(_), _) | (None, false) => encode(&png::Depth::Eight),
                    (None, true) => {
                        first_exact(&[png::Depth::Eight, png::Depth::Sixteen], std::slice::from_ref(image), encode)
                    }
                }
            }
            Format::Exr => {
                let encode = |p: &exr::Precision| exr::encode(image, *p).map(|e| (e.bytes, e.warnings));
                if look.exact {
                    first_exact(&[exr::Precision::Half, exr::Precision::Float], std::slice::from_ref(image), encode)
                } else {
                    encode(&exr::Precision::Half)
                }
            }
            Format::Hdr => hdr::encode(image).map(|e| (e.bytes, e.warnings)),
        }
    }
}

/// Bytes, and what they could not hold.
type Bytes = Result<(Vec<u8>, Vec<String>), ImageError>;

/// The first way of writing pictures of which they are read again as they are; else the last.
fn first_exact<T>(ways: &[T], pictures: &[Image], encode: impl Fn(&T) -> Bytes) -> Bytes {
    let (last, cheaper) = ways.split_last().ok_or_else(|| ImageError::new("there is no way to write this"))?;
    for way in cheaper {
        let (bytes, warnings) = encode(way)?;
        let again = decode::decode("", &bytes, &Limits { max_bytes: u64::MAX })?;
        let same = match &again.shape {
            Shape::Picture(image) => pictures == std::slice::from_ref(image),
            Shape::Faces(faces) => pictures == faces.as_slice(),
        };
        if same {
            return Ok((bytes, warnings));
        }
    }
    encode(last)
}

/// Whether an ending is one of files and not a part of a folder's name, as in `sky.v2`.
fn means_a_file(extension: &str) -> bool {
    const OTHERS: [&str; 14] =
        ["jpg", "jpeg", "dds", "ktx", "tga", "bmp", "tif", "tiff", "webp", "gif", "avif", "jxl", "pic", "rgbe"];
    OTHERS.contains(&extension) || (extension.len() >= 3 && nearest(extension, WRITTEN).is_some())
}

/// Endings of what is written.
const WRITTEN: [&str; 4] = ["png", "exr", "hdr", "ktx2"];

fn not_written(shown: &str, extension: &str) -> String {
    let meant = nearest(extension, WRITTEN).map_or(String::new(), |known| format!("did you mean .{known}? "));
    format!(
        "`{shown}`: .{extension} is not written; {meant}.png, .exr, .hdr and .ktx2 are, and six faces to a folder's \
         name"
    )
}

/// Says how much light is too bright for a PNG.
fn clipped(image: &Image, look: &Look) -> Option<String> {
    if !look.high_dynamic_range || look.transform.tone_map != ToneMap::None {
        return None;
    }
    let limit = (-look.transform.exposure).exp2() as f32 * 1.001;
    let count = image.pixels.iter().filter(|p| p[..3].iter().any(|v| *v > limit)).count();
    let share = 100.0 * count as f64 / image.pixels.len().max(1) as f64;
    (count > 0).then(|| {
        format!(
            "{share:.1} % of the pixels are brighter than a PNG can be and are clipped; --tone-map or --exposure bring \
             them into range, --format exr keeps them"
        )
    })
}

fn failed(error: impl std::fmt::Display) -> CliError {
    CliError::new(error.to_string())
}
