//! Every wrong reader, applied to every model, must be named.

use super::buffer::Data;
use super::fit::{Triangles, fit};
use super::mistakes::{self, MISTAKES, WrongReader};
use super::reader::{Corner, Reader};
use super::*;
use gonio_check::verdict::Outcome;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const ALL: Attributes = Attributes { tex_coords: true, normals: true };

/// The exercise's models, by name.
pub(crate) fn models() -> Vec<(String, Expected)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../exercises/ex02-object-reader/models");
    let mut models: Vec<(String, Expected)> = std::fs::read_dir(folder)
        .expect("the models")
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            let bytes = std::fs::read(&path).expect("a model");
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            (name, Expected::from_obj(&bytes).expect("an OBJ"))
        })
        .collect();
    models.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(models.len() >= 9, "only {} models", models.len());
    models
}

/// The output of a reader; `behind` replaces values that it reads beyond the end of a list.
fn written(reader: &Reader, expected: &Expected, behind: f32) -> Vec<Vertex> {
    let vertex = |corner: Corner| Vertex {
        position: corner.position.unwrap_or([behind; 3]),
        tex_coord: corner.tex_coord.unwrap_or([behind; 2]),
        normal: corner.normal.unwrap_or([behind; 3]),
    };
    reader.read(&expected.source).iter().flat_map(|triangle| triangle.corners.map(vertex)).collect()
}

fn named(vertices: Vec<Vertex>) -> Buffer {
    Buffer { data: Data::Named { vertices, has: ALL }, warnings: Vec::new() }
}

/// Whether the verdict names the mistakes, or an indistinguishable alternative.
fn is_named(wrong: &WrongReader, verdict: &BufferFindings) -> bool {
    let expected_ids: BTreeSet<&str> = wrong.mistakes.iter().map(|number| MISTAKES[*number].id).collect();
    let mut found: BTreeSet<&str> = verdict.mistakes.iter().map(|mistake| mistake.id).collect();
    if verdict.warnings.iter().any(|warning| warning.starts_with("v is 1 - v")) {
        found.insert("v-flipped");
    }
    found == expected_ids
        || verdict.alternatives.iter().any(|ids| ids.iter().copied().collect::<BTreeSet<_>>() == expected_ids)
}

/// Whether a buffer differs from the right one.
fn shows(vertices: &[Vertex], expected: &Expected) -> bool {
    let verdict = compare(expected, &named(vertices.to_vec()));
    verdict.verdict != Outcome::Correct || verdict.warnings.iter().any(|warning| warning.starts_with("v is 1 - v"))
}

#[test]
fn the_right_reader_agrees_with_gonio_mesh_on_all_models() {
    for (name, expected) in models() {
        assert!(expected.triangles.iter().all(|triangle| triangle.face.is_some()), "{name}");
        let verdict = compare(&expected, &named(written(&Reader::default(), &expected, 0.0)));
        assert_eq!((verdict.verdict, verdict.warnings.len()), (Outcome::Correct, 0), "{name}: {verdict:?}");
    }
}

#[test]
fn each_single_mistake_is_named_on_every_model_that_shows_it() {
    let models = models();
    let (mut tried, mut first) = (0, BTreeMap::new());
    for wrong in mistakes::singles() {
        let id = MISTAKES[wrong.mistakes[0]].id;
        for (name, expected) in &models {
            let vertices = written(&wrong.reader, expected, 0.0);
            if vertices.is_empty() || !shows(&vertices, expected) {
                continue;
            }
            let verdict = compare(expected, &named(vertices));
            let found: Vec<_> = verdict.mistakes.iter().map(|mistake| mistake.id).collect();
            assert!(is_named(&wrong, &verdict), "{id} on {name}: {found:?} {:?} {wrong:?}", verdict.shares);
            tried += 1;
            let is_first = verdict.mistakes.first().is_none_or(|mistake| mistake.id == id);
            *first.entry(id).or_insert(0) += usize::from(is_first);
        }
    }
    assert!(tried > 200, "only {tried}");
    for mistake in &MISTAKES {
        let times = first.get(mistake.id);
        assert!(times.is_some_and(|times| *times > 0), "{} is never the first name: {times:?}", mistake.id);
    }
}

/// The goal is 85 %.
#[test]
fn pairs_of_mistakes_are_named() {
    let (mut right, mut tried) = (0, 0);
    let mut failures = Vec::new();
    for (name, expected) in models() {
        let right_print = Triangles::read(&Reader::default(), &expected.source, &expected.keys, expected.has)[0].print;
        let prints: BTreeSet<u64> =
            expected.wrong_buffers(expected.has).singles.iter().map(|single| single.made.print).collect();
        for (number, pair) in expected.pairs(expected.has).iter().enumerate() {
            // If one mistake of a pair hides the other, the buffer is that of a single mistake.
            if prints.contains(&pair.made.print) || pair.made.print == right_print || pair.made.keys.len() < 2 {
                continue;
            }
            let behind = [0.0, f32::NAN, -7.25][number % 3];
            let vertices = written(&pair.wrong.reader, &expected, behind);
            tried += 1;
            let verdict = compare(&expected, &named(vertices));
            if is_named(&pair.wrong, &verdict) {
                right += 1;
            } else {
                let ids = pair.wrong.mistakes.iter().map(|number| MISTAKES[*number].id).collect::<Vec<_>>();
                let found: Vec<_> = verdict.mistakes.iter().map(|mistake| mistake.id).collect();
                failures.push(format!("{name}: {ids:?} -> {found:?} {:.2}", verdict.shares.all));
            }
        }
    }
    assert!(tried > 3000, "only {tried}");
    let share = f64::from(right) / f64::from(tried);
    let some: Vec<_> = failures.iter().step_by(failures.len().div_ceil(60).max(1)).collect();
    assert!(share >= 0.95, "{right} of {tried} are named ({share}):\n{some:#?}");
}

/// Unknown mistakes: wrong, without a name.
#[test]
fn unexplained_buffers_are_wrong_without_a_name() {
    type Change = fn(&mut Vertex);
    let changes: [(&str, Change); 6] = [
        ("normals negated", |vertex| vertex.normal = vertex.normal.map(|x| -x)),
        ("normals shuffled", |vertex| vertex.normal.rotate_left(1)),
        ("positions scaled", |vertex| vertex.position = vertex.position.map(|x| 1.5 * x)),
        ("positions moved", |vertex| vertex.position[1] += 0.25),
        ("texture moved", |vertex| vertex.tex_coord[0] += 0.1),
        ("texture shrunk", |vertex| vertex.tex_coord = vertex.tex_coord.map(|x| 0.5 * x)),
    ];
    for (name, expected) in models() {
        for (what, change) in changes {
            let mut vertices = written(&Reader::default(), &expected, 0.0);
            vertices.iter_mut().for_each(change);
            let verdict = compare(&expected, &named(vertices.clone()));
            let is_right = expected.vertices().eq(vertices.iter().copied());
            let is_compared = match what.split_once(' ').expect("two words").0 {
                "normals" => expected.has.normals,
                "texture" => expected.has.tex_coords,
                _ => true,
            };
            if is_compared && !is_right {
                assert_ne!(verdict.verdict, Outcome::Correct, "{what} on {name}");
                assert!(verdict.mistakes.is_empty(), "{what} on {name} is called {:?}", verdict.mistakes[0].id);
                assert!(verdict.example.is_some(), "{what} on {name}");
            } else {
                assert_eq!(verdict.verdict, Outcome::Correct, "{what} on {name}");
            }
        }
    }
}

#[test]
fn a_fit_is_one_only_for_the_same_triangles() {
    let (_, expected) = models().remove(0);
    let right = Triangles::read(&Reader::default(), &expected.source, &expected.keys, ALL).remove(0);
    let mut vertices: Vec<[Vertex; 3]> = expected.triangles.iter().map(|triangle| triangle.vertices).collect();
    let given = |vertices: &[[Vertex; 3]]| super::fit::SubmittedTriangles::new(vertices, &expected.keys, ALL);
    assert_eq!(fit(&right, &given(&vertices), 0.0).expect("a fit").share, 1.0);
    vertices.push(vertices[0]);
    assert!(fit(&right, &given(&vertices), 0.0).expect("a fit").share < 1.0);
    vertices.truncate(vertices.len() - 2);
    assert!(fit(&right, &given(&vertices), 0.0).expect("a fit").share < 1.0);
}

/// With half of the triangles turned over, a mistake explains half of the buffer, and is not named.
#[test]
fn mistakes_that_explain_too_little_are_not_named() {
    for (name, expected) in models() {
        let mut vertices = written(&Reader::default(), &expected, 0.0);
        vertices.as_chunks_mut::<3>().0.iter_mut().step_by(2).for_each(|triangle| triangle.swap(1, 2));
        let verdict = compare(&expected, &named(vertices));
        assert_eq!((verdict.verdict, verdict.mistakes.len()), (Outcome::Wrong, 0), "{name}");
    }
}

/// A hexagon with all its sides, and a triangle in the middle that shares no edge with the others.
#[test]
fn triangles_that_only_touch_do_not_cover_a_polygon() {
    let corner = |i: usize| (60.0 * i as f32).to_radians();
    let hexagon: Vec<[f32; 3]> = (0..6).map(corner).map(|a| [a.cos(), a.sin(), 0.0]).collect();
    let star = [[0, 1, 2], [2, 3, 4], [4, 5, 0]];
    let with = |middle: [usize; 3]| super::cut::covers(&hexagon, &[star[0], star[1], star[2], middle]);
    assert!(with([0, 2, 4]));
    assert!(!with([1, 3, 5]));
    assert!(!with([0, 4, 2]));
    assert!(!super::cut::covers(&hexagon, &star));
}
