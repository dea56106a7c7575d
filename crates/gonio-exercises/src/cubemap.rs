//! Checks a cubemap that is handed in as six pictures.
//!
//! The pictures are compared with gonio's own, drawn from the same panorama. A mistake in all of them (the panorama
//! upside down, a wrong angle) is a hypothesis of the catalogue, as in other exercises. A mistake in one (rotated, mirrored,
//! swapped) is found face by face: each is compared with all six faces in all eight orientations.

use crate::exercise::Exercise;
use gonio_check::ShaderChecker;
use gonio_check::comparison::{Evidence, SourceSupport};
use gonio_check::mistakes::{Hypothesis, ModelSolution};
use gonio_check::panorama::{Explanation, FaceBench, FaceTask, Tiles, Tolerance, blur, verdict};
use gonio_check::submission::SourceFile;
use gonio_check::testbench::TILE;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_environment::{Arrangement, Face, Layout, Panorama, arrange, names};
use gonio_gl::GlError;
use gonio_image::decode::{DecodedContent, FileFormat, decode};
use gonio_image::{DecodeLimits, Image};
use gonio_language::tr;

/// Side of the reference's faces in pixels: fine enough for the details of a panorama of usual size.
const FINE: u32 = 128;

/// Checks six faces, in six files or in one.
pub fn check(
    checker: &mut ShaderChecker,
    exercise: &Exercise,
    files: &[SourceFile],
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let submitted = match SubmittedFaces::read(exercise, files) {
        Ok(submitted) => submitted,
        Err(sentence) => return Ok((Verdict::new(&exercise.id, Outcome::Unsure, sentence), None)),
    };
    let bench = FaceBench::of_panorama(checker.gl()?, FINE, &submitted.panorama)?;
    let model = checker.model(ModelSolution::Panorama)?;
    let seen = submitted.tiles(TILE as usize).encoded().blurred();
    let silent: SourceSupport = Box::new(|id| if id == "layout-photographic" { 0.6 } else { 0.5 });
    let task = FaceTask { hypotheses: &model.hypotheses, tolerance: Tolerance::FILES, source_support: &silent };
    let draw = |hypothesis: &Hypothesis| Ok::<Tiles, GlError>(bench.draw_model(model, hypothesis)?.clamped());
    let mut predict = |hypothesis: &Hypothesis| Ok(draw(hypothesis)?.reduced(TILE as usize).encoded().blurred());
    let explanation = Explanation::find(&task, &seen, &mut predict)?;
    let (mut verdict, evidence) = verdict(&exercise.id, &explanation, &seen, |tiles| tiles.decoded().atlas());
    if verdict.verdict == Outcome::Correct {
        let reference = draw(&Hypothesis::default())?;
        blur(&mut verdict, submitted.sharpness(&reference));
    }
    verdict.warnings.extend(submitted.warnings);
    Ok((verdict, Some(evidence)))
}

/// Smallest side in pixels at which faces can be distinguished.
const LEAST: u32 = 32;
/// Maximum number of pictures in a submission.
const MOST: usize = 40;

/// Whether a file is a picture, by its first bytes.
pub fn is_picture(file: &SourceFile) -> bool {
    FileFormat::detect(&file.bytes).is_some()
}

/// The faces and the panorama of a submission.
pub struct SubmittedFaces {
    /// In OpenGL's order; all are square and of the same size.
    faces: [Image; 6],
    /// The panorama that they show.
    pub panorama: Panorama,
    /// Warnings, one sentence each.
    pub warnings: Vec<String>,
}

impl SubmittedFaces {
    /// Reads the faces.
    ///
    /// # Errors
    /// The first problem, in one sentence.
    pub fn read(exercise: &Exercise, files: &[SourceFile]) -> Result<Self, String> {
        let pictures: Vec<&SourceFile> = files.iter().filter(|file| is_picture(file)).collect();
        if pictures.len() > MOST {
            return Err(tr!("check-cubemap-there-are-pictures-among-the-files", count = pictures.len()));
        }
        let mut read: Vec<(&str, Image)> = Vec::new();
        for file in pictures {
            let decoded =
                decode(&file.name, &file.bytes, &DecodeLimits::default()).map_err(|error| error.to_string())?;
            match decoded.shape {
                DecodedContent::Picture(image) => read.push((file.name.as_str(), image)),
                DecodedContent::Faces(_) => {
                    return Err(tr!("check-cubemap-hand-in-the-six-faces-as", name = file.name));
                }
            }
        }
        let mut warnings = Vec::new();
        let (panoramas, others): (Vec<_>, Vec<_>) =
            read.into_iter().partition(|(name, image)| is_panorama(name, image));
        let panorama = match panoramas.into_iter().next() {
            Some((_, image)) => image,
            None => given(exercise)?,
        };
        let faces = match others.as_slice() {
            [] => {
                return Err(tr!("check-cubemap-there-are-no-faces-among-the").to_owned());
            }
            [(name, image)] => in_one(name, image, &mut warnings)?,
            several => in_six(several, &mut warnings)?,
        };
        let size = faces[0].width;
        if let Some(other) = faces.iter().find(|face| face.width != face.height || face.width != size) {
            return Err(tr!(
                "check-cubemap-the-faces-must-be-square-and",
                width = faces[0].width,
                height = faces[0].height,
                width2 = other.width,
                height2 = other.height
            ));
        }
        if size < LEAST {
            return Err(tr!("check-cubemap-the-faces-have-x-pixels-at", size = size, least = LEAST));
        }
        let natural = panorama.width / 4;
        if size * 2 < natural {
            warnings.push(tr!("check-cubemap-the-faces-have-x-pixels-much", size = size, natural = natural));
        }
        let panorama = Panorama::new(panorama).map_err(|error| error.to_string())?;
        Ok(SubmittedFaces { faces, panorama, warnings })
    }

    /// The faces as small pictures.
    pub fn tiles(&self, side: usize) -> Tiles {
        let face = |face: &Image| face.pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
        Tiles { side: self.faces[0].width as usize, faces: self.faces.each_ref().map(face) }.reduced(side)
    }

    /// Sharpness relative to a reference of [`FINE`] pixels: 1 if they are as sharp.
    pub fn sharpness(&self, reference: &Tiles) -> f64 {
        let side = self.faces[0].width.clamp(LEAST, FINE) as usize;
        let possible = reference.reduced(side).encoded().sharpness();
        if possible > 1e-6 { self.tiles(side).encoded().sharpness() / possible } else { 1.0 }
    }
}

fn is_panorama(name: &str, image: &Image) -> bool {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name).to_ascii_lowercase();
    let is_called = ["pano", "equirect", "latlong"].iter().any(|word| name.contains(word));
    image.width == 2 * image.height || is_called && image.width != image.height
}

/// The exercise's own panorama.
fn given(exercise: &Exercise) -> Result<Image, String> {
    let (name, bytes) = exercise.pictures().next().ok_or(tr!("check-cubemap-the-exercise-has-no-panorama-hand"))?;
    match decode(name, bytes, &DecodeLimits::default()).map_err(|error| error.to_string())?.shape {
        DecodedContent::Picture(image) => Ok(image),
        DecodedContent::Faces(_) => Err(tr!("check-cubemap-is-not-a-panorama", name = name)),
    }
}

/// Reads a cross or a strip.
fn in_one(name: &str, image: &Image, warnings: &mut Vec<String>) -> Result<[Image; 6], String> {
    let arrangement = arrange::recognise(image.width, image.height).arrangement;
    if matches!(arrangement, Arrangement::Equirectangular | Arrangement::Faces) {
        return Err(tr!(
            "check-cubemap-has-x-pixels-which-is-neither",
            name = name,
            width = image.width,
            height = image.height
        ));
    }
    let arranged = arrange::to_cubemap(image, arrangement, Layout::OpenGl).map_err(|error| error.to_string())?;
    warnings.extend(arranged.warnings);
    warnings.push(tr!("check-cubemap-was-read-as-a", name = name, arrangement = arrangement.to_string()));
    Ok(arranged.cubemap.faces(Layout::OpenGl))
}

/// Assigns six files to faces by their names.
fn in_six(files: &[(&str, Image)], warnings: &mut Vec<String>) -> Result<[Image; 6], String> {
    let known: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let assigned = names::assign(&known).map_err(|error| error.to_string())?;
    warnings.extend(assigned.notes);
    Ok(Face::ALL.map(|face| files[assigned.files[face as usize]].1.clone()))
}
