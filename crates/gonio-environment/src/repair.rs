//! Repairs of six faces: swapping, mirroring and turning them.

use crate::face::Face;
use crate::placement::{Placements, parts};
use gonio_image::Image;

/// The file that a repaired face is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaceSource {
    /// The file with this face's picture.
    pub file: Face,
    /// Whether its columns are mirrored (before it is turned).
    pub mirrored: bool,
    /// Quarter turns clockwise, as seen in a viewer, 0 to 3.
    pub quarter_turns: u8,
}

/// The source of each face, in the order of [`Face::ALL`]. Names are those of the files' layout, and orientations those of
/// an image viewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repair {
    /// One source per face; every file is used once.
    pub faces: [FaceSource; 6],
}

impl Repair {
    /// Creates the repair that changes nothing.
    pub fn nothing() -> Self {
        Repair { faces: Face::ALL.map(|file| FaceSource { file, mirrored: false, quarter_turns: 0 }) }
    }

    pub(crate) fn from_placements(arrangement: &Placements) -> Self {
        let mut repair = Repair::nothing();
        for (file, &placement) in Face::ALL.into_iter().zip(arrangement) {
            let (face, mirrored, quarters) = parts(placement);
            repair.faces[face] = FaceSource { file, mirrored, quarter_turns: quarters as u8 };
        }
        repair
    }

    /// Whether nothing is to be done.
    pub fn is_nothing(&self) -> bool {
        *self == Repair::nothing()
    }

    /// The faces that change.
    pub fn changed(&self) -> Vec<Face> {
        let as_given = Repair::nothing().faces;
        Face::ALL.into_iter().filter(|&f| self.faces[f as usize] != as_given[f as usize]).collect()
    }

    /// The repaired pictures. No texel changes but its place.
    pub fn apply(&self, faces: &[Image; 6]) -> [Image; 6] {
        self.faces.map(|source| turned(&faces[source.file as usize], source.mirrored, source.quarter_turns))
    }

    /// Describes the faults of the files, one sentence each, without final full stop; empty if there are none.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        if self.faces.iter().all(|s| s.mirrored) {
            // Said once instead of six times; what else is wrong follows.
            sentences.push("all six faces are mirrored, each in its own file".to_owned());
        }
        let all_mirrored = !sentences.is_empty();
        for face in Face::ALL {
            let source = self.faces[face as usize];
            let back = self.faces[source.file as usize];
            if source.file != face && back.file == face {
                if face < source.file {
                    sentences.push(format!("`{}` and `{}` are swapped", face.name(), source.file.name()));
                }
            } else if source.file != face {
                sentences.push(format!("the picture of `{}` is in the file `{}`", face.name(), source.file.name()));
            }
        }
        for source in self.faces {
            // The file's own state: the way back from what repairs it. A mirrored and turned picture is its own way back.
            let name = source.file.name();
            let quarters = if source.mirrored { source.quarter_turns } else { (4 - source.quarter_turns) % 4 };
            let turned = match quarters {
                1 => "turned by 90 degrees clockwise",
                2 => "turned by 180 degrees",
                3 => "turned by 90 degrees anticlockwise",
                _ => "",
            };
            match (source.mirrored && !all_mirrored, turned) {
                (true, "") => sentences.push(format!("`{name}` is mirrored")),
                (true, "turned by 180 degrees") => {
                    sentences.push(format!("`{name}` is upside down, mirrored top to bottom"))
                }
                (true, turned) => sentences.push(format!("`{name}` is mirrored and then {turned}")),
                (false, "") => {}
                (false, turned) => sentences.push(format!("`{name}` is {turned}")),
            }
        }
        sentences
    }
}

/// A picture with its columns mirrored or not, and then turned clockwise by quarters.
fn turned(image: &Image, mirrored: bool, quarters: u8) -> Image {
    let (width, height) = (image.width as usize, image.height as usize);
    let (new_width, new_height) = if quarters.is_multiple_of(2) { (width, height) } else { (height, width) };
    let mut pixels = Vec::with_capacity(image.pixels.len());
    for y in 0..new_height {
        for x in 0..new_width {
            // Where the pixel at (x, y) was before turning.
            let (u, v) = match quarters % 4 {
                0 => (x, y),
                1 => (y, height - 1 - x),
                2 => (width - 1 - x, height - 1 - y),
                _ => (width - 1 - y, x),
            };
            let u = if mirrored { width - 1 - u } else { u };
            pixels.push(image.pixels[v * width + u]);
        }
    }
    Image { width: new_width as u32, height: new_height as u32, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(changes: &[(Face, Face, bool, u8)]) -> Repair {
        let mut repair = Repair::nothing();
        for &(face, file, mirrored, quarter_turns) in changes {
            repair.faces[face as usize] = FaceSource { file, mirrored, quarter_turns };
        }
        repair
    }

    #[test]
    fn pictures_turn_clockwise() {
        // 1 2 3
        // 4 5 6
        let image = Image { width: 3, height: 2, pixels: (1..=6).map(|i| [i as f32; 4]).collect() };
        let numbers = |image: Image| (image.width, image.pixels.iter().map(|p| p[0] as u32).collect::<Vec<_>>());
        assert_eq!(numbers(turned(&image, false, 1)), (2, vec![4, 1, 5, 2, 6, 3]));
        assert_eq!(numbers(turned(&image, false, 2)), (3, vec![6, 5, 4, 3, 2, 1]));
        assert_eq!(numbers(turned(&image, false, 3)), (2, vec![3, 6, 2, 5, 1, 4]));
        assert_eq!(numbers(turned(&image, true, 0)), (3, vec![3, 2, 1, 6, 5, 4]));
        assert_eq!(numbers(turned(&image, true, 1)), (2, vec![6, 3, 5, 2, 4, 1]));
    }

    #[test]
    fn sentences_name_the_fault() {
        use Face::{NegX, NegY, PosX, PosY, PosZ};
        assert!(Repair::nothing().sentences().is_empty());
        assert_eq!(with(&[(NegY, NegY, false, 2)]).sentences(), ["`negy` is turned by 180 degrees"]);
        // To be turned clockwise: it is turned the other way.
        assert_eq!(with(&[(PosY, PosY, false, 1)]).sentences(), ["`posy` is turned by 90 degrees anticlockwise"]);
        assert_eq!(with(&[(PosX, PosX, true, 0)]).sentences(), ["`posx` is mirrored"]);
        assert_eq!(
            with(&[(PosX, NegX, false, 0), (NegX, PosX, false, 2)]).sentences(),
            ["`posx` and `negx` are swapped", "`posx` is turned by 180 degrees"]
        );
        let round = with(&[(PosX, PosY, false, 0), (PosY, PosZ, false, 0), (PosZ, PosX, false, 0)]);
        assert_eq!(round.sentences()[0], "the picture of `posx` is in the file `posy`");
        assert_eq!((round.sentences().len(), round.changed().len()), (3, 3));
    }
}
