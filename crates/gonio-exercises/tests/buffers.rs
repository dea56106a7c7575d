//! Vertex buffers in every format and order, and everything that is none.

#[allow(dead_code)]
mod support;

use gonio_check::verdict::Outcome;
use gonio_exercises::buffers::{Vertex, choose, compare, names, read_buffer};
use gonio_fixtures::selected;
use std::collections::BTreeSet;
use support::{Format, formats, models, programs_output, shuffled};

#[test]
fn a_right_buffer_is_right_in_every_format_and_order() {
    let mut tried = 0;
    for (name, expected) in &models() {
        let has = expected.attributes();
        let vertices: Vec<Vertex> = expected.vertices().collect();
        for seed in 0..4 {
            let vertices = if seed == 0 { vertices.clone() } else { shuffled(&vertices, seed) };
            for Format { name: format, file, bytes } in formats(&vertices, has) {
                let buffer = read_buffer(&file, &bytes).unwrap_or_else(|error| panic!("{name} as {format}: {error}"));
                let verdict = compare(expected, &buffer);
                assert_eq!(verdict.verdict, Outcome::Correct, "{name} as {format}: {:?}", verdict.shares);
                let is_usual = !format.contains('!');
                assert_eq!(verdict.warnings.is_empty(), is_usual, "{name} as {format}: {:?}", verdict.warnings);
                tried += 1;
            }
        }
    }
    assert!(tried > 400, "only {tried}");
}

/// What the start files and references in Python and C++ wrote.
#[test]
fn the_exercises_own_programs_are_judged_rightly() {
    let models = models();
    let outputs = programs_output();
    assert!(outputs.len() >= 21, "only {} files", outputs.len());
    for (name, bytes) in selected(outputs, |(name, _)| name) {
        let (stem, kind) = name.split_once('.').expect("model.kind.ending");
        let buffer = read_buffer(&name, &bytes).expect("a buffer");
        let (chosen, expected) = choose(&models, &format!("{stem}.csv"), &buffer).expect("a model");
        assert_eq!(*chosen, format!("{stem}.obj"));
        // Without the name's help.
        let (chosen, _) = choose(&models, "buffer.csv", &buffer).expect("a model");
        assert_eq!(*chosen, format!("{stem}.obj"), "{name} by its numbers");
        let verdict = compare(expected, &buffer);
        let found: Vec<&str> = verdict.mistakes.iter().map(|mistake| mistake.id).collect();
        if kind.starts_with("reference") {
            assert_eq!(
                (verdict.verdict, found.as_slice()),
                (Outcome::Correct, &[][..]),
                "{name}: {:?}",
                verdict.shares
            );
        } else {
            assert_eq!((verdict.verdict, found.as_slice()), (Outcome::Wrong, &["faces-ignored"][..]), "{name}");
        }
    }
}

/// A quad's other diagonal, a pentagon's other fans: the same surface.
#[test]
fn convex_polygons_may_be_cut_in_any_way() {
    let (_, house) = models().into_iter().find(|(name, _)| name == "house.obj").expect("the house");
    // The first face is a pentagon: corners 0 to 4 in the first three triangles.
    let mut vertices: Vec<Vertex> = house.vertices().collect();
    let [a, b, c, d, e] = [vertices[0], vertices[1], vertices[2], vertices[5], vertices[8]];
    vertices.splice(0..9, [b, c, d, b, d, e, b, e, a]);
    let check = |vertices: &[Vertex]| {
        let bytes = support::csv(vertices, house.attributes(), ",", true);
        compare(&house, &read_buffer("house.csv", &bytes).expect("a buffer"))
    };
    assert_eq!(check(&vertices).verdict, Outcome::Correct);
    // These three overlap.
    vertices.splice(0..9, [b, c, d, b, d, e, b, d, a]);
    assert_eq!(check(&vertices).verdict, Outcome::Wrong);
    // One of them turned over.
    vertices.splice(0..9, [b, c, d, b, d, e, b, a, e]);
    assert_eq!(check(&vertices).verdict, Outcome::Wrong);
}

#[test]
fn few_digits_are_right_with_a_warning() {
    for (name, expected) in models().iter().filter(|(name, _)| name == "gem.obj" || name == "house.obj") {
        let round = |x: &mut f32| *x = (*x * 1000.0).round() / 1000.0;
        let mut vertices: Vec<Vertex> = expected.vertices().collect();
        for vertex in &mut vertices {
            vertex.position.iter_mut().chain(&mut vertex.tex_coord).chain(&mut vertex.normal).for_each(round);
        }
        let bytes = support::csv(&vertices, expected.attributes(), ",", true);
        let verdict = compare(expected, &read_buffer("x.csv", &bytes).expect("a buffer"));
        assert_eq!(verdict.verdict, Outcome::Correct, "{name}: {:?}", verdict.shares);
        assert!(
            verdict.warnings.iter().any(|warning| warning.contains("few digits")),
            "{name}: {:?}",
            verdict.warnings
        );
    }
}

/// A column that the model has and the buffer has not is a mistake, and hides no other.
#[test]
fn missing_columns_are_named_beside_other_mistakes() {
    let (_, cube) = models().into_iter().find(|(name, _)| name == "cube.obj").expect("the cube");
    let vertices: Vec<Vertex> = cube.vertices().collect();
    let without = |vertices: &[Vertex], tex_coords, normals| {
        let has = gonio_exercises::buffers::Attributes { tex_coords, normals };
        let verdict = compare(&cube, &read_buffer("x.csv", &support::csv(vertices, has, ",", true)).expect("a buffer"));
        assert_eq!(verdict.verdict, Outcome::Wrong);
        verdict.mistakes.iter().map(|mistake| mistake.id).collect::<Vec<_>>()
    };
    assert_eq!(without(&vertices, true, false), ["normals-missing"]);
    assert_eq!(without(&vertices, false, true), ["tex-coords-missing"]);
    assert_eq!(without(&vertices, false, false), ["tex-coords-missing", "normals-missing"]);
    let turned: Vec<Vertex> = vertices.as_chunks::<3>().0.iter().flat_map(|[a, b, c]| [*a, *c, *b]).collect();
    assert_eq!(without(&turned, true, false), ["normals-missing", "winding-reversed"]);
}

/// v from the top is right for whoever does not flip his pictures: never wrong by itself.
#[test]
fn a_flipped_v_is_a_peculiarity() {
    for (name, expected) in models().iter().filter(|(_, expected)| expected.attributes().tex_coords) {
        let mut vertices: Vec<Vertex> = expected.vertices().collect();
        vertices.iter_mut().for_each(|vertex| vertex.tex_coord[1] = 1.0 - vertex.tex_coord[1]);
        let bytes = support::csv(&vertices, expected.attributes(), ";", false);
        let verdict = compare(expected, &read_buffer("x.csv", &bytes).expect("a buffer"));
        assert_eq!((verdict.verdict, verdict.mistakes.len()), (Outcome::Correct, 0), "{name}");
        assert!(verdict.warnings.iter().any(|warning| warning.contains("1 - v")), "{name}: {:?}", verdict.warnings);
    }
}

/// The example points to the line, the row and the numbers.
#[test]
fn the_example_shows_the_line_of_the_model() {
    let (_, house) = models().into_iter().find(|(name, _)| name == "house.obj").expect("the house");
    let mut vertices: Vec<Vertex> = house.vertices().collect();
    vertices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    let bytes = support::csv(&vertices, house.attributes(), ",", true);
    let verdict = compare(&house, &read_buffer("house.csv", &bytes).expect("a buffer"));
    let [mistake] = verdict.mistakes.as_slice() else { panic!("{:?}", verdict.mistakes) };
    assert_eq!((mistake.id, mistake.share_explained), ("winding-reversed", 1.0));
    let example = mistake.example.as_ref().expect("an example");
    assert_eq!(example.row, Some(1));
    let text = std::fs::read_to_string(support::model("house.obj")).expect("the house");
    let first_face = text.lines().position(|line| line.starts_with("f ")).expect("a face");
    assert_eq!(example.line, Some(first_face as u64 + 1));
    assert_eq!(Some(example.line_text.as_str()), text.lines().nth(first_face));
    let given = example.given.expect("what was given");
    let expected = example.expected.expect("what was expected");
    assert_eq!([given[1], given[0], given[2]], expected);
}

#[test]
fn another_models_buffer_is_unsure() {
    let models = models();
    let find = |wanted: &str| &models.iter().find(|(name, _)| name == wanted).expect("a model").1;
    let vertices: Vec<Vertex> = find("gem.obj").vertices().collect();
    let buffer =
        read_buffer("x.csv", &support::csv(&vertices, find("gem.obj").attributes(), ",", true)).expect("a buffer");
    let verdict = compare(find("cube.obj"), &buffer);
    assert_eq!((verdict.verdict, verdict.mistakes.len()), (Outcome::Unsure, 0));
    assert_eq!(choose(&models, "mine.csv", &buffer).expect("a model").0, "gem.obj");
    // What the student says it is comes first.
    assert_eq!(choose(&models, "out/Cube.csv", &buffer).expect("a model").0, "cube.obj");
    assert!(choose(&[], "cube.csv", &buffer).is_none());
}

#[test]
fn the_list_of_mistakes_is_whole() {
    let ids: BTreeSet<&str> = names().map(|mistake| mistake.id).collect();
    assert_eq!(ids.len(), names().count(), "an id is there twice");
    for mistake in names() {
        assert!(mistake.id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'), "{}", mistake.id);
        assert!(!mistake.name.ends_with('.') && mistake.explanation.ends_with('.'), "{}", mistake.id);
        assert!(!mistake.how_to_fix.is_empty(), "{}", mistake.id);
        assert!(!mistake.explanation.contains("  "), "{}", mistake.id);
    }
    for asked in ["indices-from-0", "tex-coord-and-normal-swapped", "v-flipped", "quads-lost", "normals-by-position"] {
        assert!(ids.contains(asked), "{asked}");
    }
}
