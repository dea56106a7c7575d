//! The study of an environment: it is read again from its files, checked, and made into small pictures.

use super::EnvironmentSource;
use crate::beside::Steps;
use glam::DVec3;
use gonio_environment::arrange::Arrangement;
use gonio_environment::convert::Conversion;
use gonio_environment::encode::EnvironmentFormat;
use gonio_environment::{Cubemap, Face};
use gonio_image::Image;
use gonio_image::encode::png;
use gonio_language::tr;
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_scene::environment_check::EnvironmentFinding;
use gonio_scene::environment_file::OpenedEnvironment;

/// Pixels along an edge of a face's small picture.
pub const FACE_PIXELS: u32 = 96;
/// Width of the panorama's small picture, pixels.
pub const PANORAMA_PIXELS: u32 = 384;

/// An RGB picture of 8 bits a channel.
pub struct SmallPicture {
    /// Width and height.
    pub size: [usize; 2],
    /// Three bytes for each pixel, the top row first.
    pub rgb: Vec<u8>,
}

/// The facts about an environment.
pub struct EnvironmentFacts {
    /// Form, size and layout: `a panorama of 1024 x 512`.
    pub description: String,
    /// The arrangement in the files.
    pub arrangement: Arrangement,
    /// Number of files; 0 for a built-in environment.
    pub files: usize,
    /// The name of the files' format; `None` for a built-in environment.
    pub format: Option<&'static str>,
    /// Whether it may have light above 1.
    pub high_dynamic_range: bool,
    /// The format that preserves all of it.
    pub preserving: EnvironmentFormat,
    /// Texels along an edge of faces that are as fine.
    pub face_size: u32,
    /// Whether nothing is wrong, in the order of the finding.
    pub fits: bool,
    /// Whether the faults can be repaired.
    pub is_repairable: bool,
    /// The finding, in sentences without full stop.
    pub sentences: Vec<String>,
}

/// The result of a study.
pub struct EnvironmentStudy {
    /// The facts.
    pub facts: EnvironmentFacts,
    /// The faces in the order of [`Face::ALL`], as they are seen from within the cube.
    pub faces: [SmallPicture; 6],
    /// The panorama, straight ahead (-Z) in its middle.
    pub panorama: SmallPicture,
}

/// A study at work: reads, checks, makes pictures of the faces, and one of the panorama.
pub enum StudyWork {
    Read(EnvironmentSource),
    Check(Box<OpenedEnvironment>),
    Faces(Box<OpenedEnvironment>, EnvironmentFacts),
    Panorama(Box<OpenedEnvironment>, EnvironmentFacts, Box<[SmallPicture; 6]>),
    Ended,
}

impl Steps for StudyWork {
    type Output = Result<EnvironmentStudy, String>;

    fn step(&mut self) -> Option<Self::Output> {
        match std::mem::replace(self, StudyWork::Ended) {
            StudyWork::Read(source) => match source.open() {
                Ok(opened) => *self = StudyWork::Check(Box::new(opened)),
                Err(error) => return Some(Err(error)),
            },
            StudyWork::Check(opened) => match EnvironmentFinding::of(&opened) {
                Ok(finding) => {
                    let facts = facts(&opened, &finding);
                    *self = StudyWork::Faces(opened, facts);
                }
                Err(error) => return Some(Err(error.to_string())),
            },
            StudyWork::Faces(opened, facts) => {
                let map = Conversion::default().cubemap(opened.map.as_environment(), FACE_PIXELS);
                let faces = Face::ALL.map(|face| small(&seen_from_within(&map, face), facts.high_dynamic_range));
                *self = StudyWork::Panorama(opened, facts, Box::new(faces));
            }
            StudyWork::Panorama(opened, facts, faces) => {
                let (width, height) = (PANORAMA_PIXELS, PANORAMA_PIXELS / 2);
                let panorama = Conversion::default().panorama(opened.map.as_environment(), width, height);
                let panorama = small(&panorama.image, facts.high_dynamic_range);
                return Some(Ok(EnvironmentStudy { facts, faces: *faces, panorama }));
            }
            StudyWork::Ended => return Some(Err(tr!("environment-the-environment-was-studied-already").to_owned())),
        }
        None
    }
}

fn facts(opened: &OpenedEnvironment, finding: &EnvironmentFinding) -> EnvironmentFacts {
    let usual = if opened.high_dynamic_range { EnvironmentFormat::Exr } else { EnvironmentFormat::Png };
    EnvironmentFacts {
        description: opened.description(),
        arrangement: opened.arrangement,
        files: opened.files.len(),
        format: opened.format.map(|format| format.name()),
        high_dynamic_range: opened.high_dynamic_range,
        preserving: opened.format.map_or(usual, EnvironmentFormat::that_preserves),
        face_size: opened.map.as_environment().natural_cubemap_size(),
        fits: finding.fits(),
        is_repairable: finding.is_repairable(),
        sentences: finding.sentences(),
    }
}

/// Displayed colours; light above 1 is brought into range.
fn small(image: &Image, high_dynamic_range: bool) -> SmallPicture {
    let tone_map = if high_dynamic_range { ToneMap::Aces } else { ToneMap::None };
    let transform = OutputTransform { exposure: 0.0, tone_map, encoding: ColorEncoding::Srgb };
    SmallPicture { size: [image.width as usize, image.height as usize], rgb: png::rows8(image, &transform) }
}

/// A face as the eye in the middle of the cube sees it, unfolded about the face ahead (-Z), so that neighbours continue each other.
fn seen_from_within(map: &Cubemap, face: Face) -> Image {
    let size = map.size();
    let mut image = Image::new(size, size, [0.0, 0.0, 0.0, 1.0]);
    let place = |at: u32| (2.0 * f64::from(at) + 1.0) / f64::from(size) - 1.0;
    for (index, pixel) in image.pixels.iter_mut().enumerate() {
        let index = index as u32;
        let light = map.sample(direction(face, place(index % size), place(index / size)));
        *pixel = [light.x as f32, light.y as f32, light.z as f32, 1.0];
    }
    image
}

/// The direction of a place in the unfolded cube; `right` and `down` are in -1 to 1.
fn direction(face: Face, right: f64, down: f64) -> DVec3 {
    match face {
        Face::PosX => DVec3::new(1.0, -down, right),
        Face::NegX => DVec3::new(-1.0, -down, -right),
        Face::PosY => DVec3::new(right, 1.0, -down),
        Face::NegY => DVec3::new(right, -1.0, down),
        Face::PosZ => DVec3::new(-right, -down, 1.0),
        Face::NegZ => DVec3::new(right, -down, -1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_in_the_unfolded_cube_continue_each_other() {
        use Face::{NegX, NegY, NegZ, PosX, PosY, PosZ};
        for along in [-0.7, 0.2, 0.9] {
            let row = [(NegX, NegZ), (NegZ, PosX), (PosX, PosZ), (PosZ, NegX)];
            for (left, right) in row {
                assert_eq!(direction(left, 1.0, along), direction(right, -1.0, along), "{left:?} {right:?}");
            }
            assert_eq!(direction(PosY, along, 1.0), direction(NegZ, along, -1.0));
            assert_eq!(direction(NegZ, along, 1.0), direction(NegY, along, -1.0));
        }
        for face in Face::ALL {
            let middle = direction(face, 0.0, 0.0);
            let open_gl = gonio_environment::Face::from_direction(middle, gonio_environment::Layout::OpenGl);
            assert_eq!(open_gl.map(|(face, ..)| face), Some(face));
        }
    }
}
