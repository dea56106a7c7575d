//! Mistakes with single faces of a cubemap, generated from the table of faces: rotated, mirrored, swapped.

use super::{Mistake, ModelSolution};
use std::collections::BTreeMap;

/// The six faces in OpenGL's order: id and name.
pub const FACES: [(&str, &str); 6] =
    [("posx", "+X"), ("negx", "-X"), ("posy", "+Y"), ("negy", "-Y"), ("posz", "+Z"), ("negz", "-Z")];

/// The section of the lecture that teaches which face shows what.
pub const LECTURE_SECTION: &str = "Equirectangular to cubemap";

/// The orientations of a square picture other than the right one: id, description, and the coordinates (s, t) of the
/// actual picture in the expected one, as GLSL.
pub const TURNS: [(&str, &str, [&str; 2]); 7] = [
    ("turned-left", "rotated by 90 degrees to the left", ["-t", "s"]),
    ("turned-half", "rotated by 180 degrees", ["-s", "-t"]),
    ("turned-right", "rotated by 90 degrees to the right", ["t", "-s"]),
    ("mirrored", "mirrored left to right", ["-s", "t"]),
    ("flipped", "upside down, mirrored top to bottom", ["s", "-t"]),
    ("transposed", "mirrored about its diagonal: rows and columns are swapped", ["t", "s"]),
    ("transposed-back", "mirrored about its other diagonal: rows and columns are swapped", ["-t", "-s"]),
];

/// Returns the direction of a point on a face, by the table of the specification, as GLSL.
fn direction(face: usize, s: &str, t: &str) -> String {
    let less = |x: &str| x.strip_prefix('-').map_or_else(|| format!("-{x}"), str::to_owned);
    let [x, y, z] = match face {
        0 => ["1.0".to_owned(), less(t), less(s)],
        1 => ["-1.0".to_owned(), less(t), s.to_owned()],
        2 => [s.to_owned(), "1.0".to_owned(), t.to_owned()],
        3 => [s.to_owned(), "-1.0".to_owned(), less(t)],
        4 => [s.to_owned(), less(t), "1.0".to_owned()],
        _ => [less(s), less(t), "-1.0".to_owned()],
    };
    format!("vec3({x}, {y}, {z})")
}

fn mistake(id: String, name: String, looks_like: &str, fix: &str, change: BTreeMap<String, String>) -> Mistake {
    Mistake {
        id,
        name,
        models: vec![ModelSolution::Panorama],
        looks_like: looks_like.to_owned(),
        fix: fix.to_owned(),
        lecture_section: LECTURE_SECTION.to_owned(),
        change: vec![change],
        ..Mistake::default()
    }
}

/// Returns the id of a rotated face: `face-posy-turned-left`.
pub fn turned_id(face: usize, turn: usize) -> String {
    format!("face-{}-{}", FACES[face % 6].0, TURNS[turn % 7].0)
}

/// Returns the id of two swapped faces, the earlier one first: `faces-posz-negz-swapped`.
pub fn swapped_id(a: usize, b: usize) -> String {
    format!("faces-{}-{}-swapped", FACES[a.min(b) % 6].0, FACES[a.max(b) % 6].0)
}

/// Returns all mistakes with single faces.
pub fn mistakes() -> Vec<Mistake> {
    let mut all = Vec::new();
    for (face, (word, name)) in FACES.iter().enumerate() {
        for (turn, (_, description, [s, t])) in TURNS.iter().enumerate() {
            all.push(mistake(
                turned_id(face, turn),
                format!("Face {name} is {description}"),
                "Seams along the edges of that face.",
                &format!("Read its row of the table: in which directions do s and t run on {name}?"),
                BTreeMap::from([((*word).to_owned(), direction(face, s, t))]),
            ));
        }
    }
    for (a, (word_a, name_a)) in FACES.into_iter().enumerate() {
        for (b, (word_b, name_b)) in FACES.into_iter().enumerate().skip(a + 1) {
            all.push(mistake(
                swapped_id(a, b),
                format!("Faces {name_a} and {name_b} are swapped"),
                "Seams along the edges of both faces.",
                "The order of OpenGL's faces is +X, -X, +Y, -Y, +Z, -Z.",
                BTreeMap::from([
                    (word_a.to_owned(), direction(b, "s", "t")),
                    (word_b.to_owned(), direction(a, "s", "t")),
                ]),
            ));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_faces_equal_those_of_the_model_solution() {
        let [_, fragment] = ModelSolution::Panorama.sources();
        for (face, (word, _)) in FACES.iter().enumerate() {
            let line = format!("vec3 {word} = {};", direction(face, "s", "t"));
            assert!(fragment.contains(&line), "{line}");
        }
    }

    #[test]
    fn every_orientation_and_every_swap_has_a_mistake() {
        let all = mistakes();
        assert_eq!(all.len(), 6 * 7 + 15);
        let turned = all.iter().find(|mistake| mistake.id == "face-posy-turned-left").unwrap();
        assert_eq!(turned.name, "Face +Y is rotated by 90 degrees to the left");
        assert_eq!(turned.change[0]["posy"], "vec3(-t, 1.0, s)");
        assert!(all.iter().any(|mistake| mistake.id == "faces-posz-negz-swapped"));
    }
}
