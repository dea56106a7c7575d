//! Vertex buffers in every format and order, and files that are not vertex buffers.

use gonio_check::verdict::Outcome;
use gonio_exercises::buffers::{Attributes, Expected, MOST_BYTES, Vertex, choose, compare, names, read_buffer};
use gonio_fixtures::{FixtureTable, selected};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

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

/// The output of the start files and references in Python and C++.
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
        // Without the help of the name.
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

/// The other diagonal of a quad and the other fans of a pentagon give the same surface.
#[test]
fn convex_polygons_may_be_cut_in_any_way() {
    let (_, house) = models().into_iter().find(|(name, _)| name == "house.obj").expect("the house");
    // The first face is a pentagon: corners 0 to 4 in the first three triangles.
    let mut vertices: Vec<Vertex> = house.vertices().collect();
    let [a, b, c, d, e] = [vertices[0], vertices[1], vertices[2], vertices[5], vertices[8]];
    vertices.splice(0..9, [b, c, d, b, d, e, b, e, a]);
    let check = |vertices: &[Vertex]| {
        let bytes = csv(vertices, house.attributes(), ",", true);
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
        let bytes = csv(&vertices, expected.attributes(), ",", true);
        let verdict = compare(expected, &read_buffer("x.csv", &bytes).expect("a buffer"));
        assert_eq!(verdict.verdict, Outcome::Correct, "{name}: {:?}", verdict.shares);
        assert!(
            verdict.warnings.iter().any(|warning| warning.contains("few digits")),
            "{name}: {:?}",
            verdict.warnings
        );
    }
}

/// A column that the model has and the buffer lacks is a mistake, and does not hide others.
#[test]
fn missing_columns_are_named_beside_other_mistakes() {
    let (_, cube) = models().into_iter().find(|(name, _)| name == "cube.obj").expect("the cube");
    let vertices: Vec<Vertex> = cube.vertices().collect();
    let without = |vertices: &[Vertex], tex_coords, normals| {
        let has = Attributes { tex_coords, normals };
        let verdict = compare(&cube, &read_buffer("x.csv", &csv(vertices, has, ",", true)).expect("a buffer"));
        assert_eq!(verdict.verdict, Outcome::Wrong);
        verdict.mistakes.iter().map(|mistake| mistake.id).collect::<Vec<_>>()
    };
    assert_eq!(without(&vertices, true, false), ["normals-missing"]);
    assert_eq!(without(&vertices, false, true), ["tex-coords-missing"]);
    assert_eq!(without(&vertices, false, false), ["tex-coords-missing", "normals-missing"]);
    let turned: Vec<Vertex> = vertices.as_chunks::<3>().0.iter().flat_map(|[a, b, c]| [*a, *c, *b]).collect();
    assert_eq!(without(&turned, true, false), ["normals-missing", "winding-reversed"]);
}

/// v from the top is right if images are not flipped: it is never wrong by itself.
#[test]
fn a_flipped_v_is_a_peculiarity() {
    for (name, expected) in models().iter().filter(|(_, expected)| expected.attributes().tex_coords) {
        let mut vertices: Vec<Vertex> = expected.vertices().collect();
        vertices.iter_mut().for_each(|vertex| vertex.tex_coord[1] = 1.0 - vertex.tex_coord[1]);
        let bytes = csv(&vertices, expected.attributes(), ";", false);
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
    let bytes = csv(&vertices, house.attributes(), ",", true);
    let verdict = compare(&house, &read_buffer("house.csv", &bytes).expect("a buffer"));
    let [mistake] = verdict.mistakes.as_slice() else { panic!("{:?}", verdict.mistakes) };
    assert_eq!((mistake.id, mistake.share_explained), ("winding-reversed", 1.0));
    let example = mistake.example.as_ref().expect("an example");
    assert_eq!(example.row, Some(1));
    let text = std::fs::read_to_string(model("house.obj")).expect("the house");
    let first_face = text.lines().position(|line| line.starts_with("f ")).expect("a face");
    assert_eq!(example.line, Some(first_face as u64 + 1));
    assert_eq!(Some(example.line_text.as_str()), text.lines().nth(first_face));
    let given = example.given.expect("the given triangle");
    let expected = example.expected.expect("the expected triangle");
    assert_eq!([given[1], given[0], given[2]], expected);
}

#[test]
fn another_models_buffer_is_unsure() {
    let models = models();
    let find = |wanted_name: &str| &models.iter().find(|(name, _)| name == wanted_name).expect("a model").1;
    let vertices: Vec<Vertex> = find("gem.obj").vertices().collect();
    let buffer = read_buffer("x.csv", &csv(&vertices, find("gem.obj").attributes(), ",", true)).expect("a buffer");
    let verdict = compare(find("cube.obj"), &buffer);
    assert_eq!((verdict.verdict, verdict.mistakes.len()), (Outcome::Unsure, 0));
    assert_eq!(choose(&models, "mine.csv", &buffer).expect("a model").0, "gem.obj");
    // The name that the student gives comes first.
    assert_eq!(choose(&models, "out/Cube.csv", &buffer).expect("a model").0, "cube.obj");
    assert!(choose(&[], "cube.csv", &buffer).is_none());
}

#[test]
fn the_list_of_mistakes_is_complete() {
    let ids: BTreeSet<&str> = names().map(|mistake| mistake.id).collect();
    assert_eq!(ids.len(), names().count(), "an id occurs twice");
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

/// File name, bytes, line, column, and a part of the message.
type Bad = (&'static str, &'static [u8], Option<u64>, Option<u64>, &'static str);

const BAD: &[Bad] = &[
    ("a.csv", b"", None, None, "empty"),
    ("a.csv", b"\n# nothing\n\n", None, None, "no rows"),
    ("a.csv", b"x,y,z\n", None, None, "header but no rows"),
    ("a.csv", b"x,y,z\n1,2,3\n1,two,3\n", Some(3), Some(3), "`two` is not a number"),
    ("a.csv", b"1,2,3\n4,,6\n", Some(2), Some(3), "missing"),
    ("a.csv", b"1,2,3\n4,5\n", Some(2), None, "2 numbers, but the first one has 3"),
    ("a.csv", b"1,2,3,4\n", Some(1), None, "4 numbers"),
    ("a.csv", b"x,y,u,v\n1,2,3,4\n", Some(1), None, "no column z"),
    ("a.csv", b"x,y,z,u\n1,2,3,4\n", Some(1), None, "no column v"),
    ("a.csv", b"x,y,z,y\n1,2,3,4\n", Some(1), Some(7), "`y` is named twice"),
    ("a.csv", b"(1, 2, 3)\n", Some(1), Some(1), "`(1` is not a number"),
    ("a.csv", b"1,2,3\n\xFF,1,2\n", Some(2), Some(1), "UTF-8"),
    ("a.csv", b"1,2,3\n4,\0,6\n", Some(2), Some(3), "binary"),
    ("a.csv", b"\xFF\xFE1\0,\0", None, None, "UTF-16"),
    ("a.csv", b"1,0,0,5,0,0\n1,0,0,5,1\n", Some(2), None, "decimal comma"),
    ("a.raw", b"\0\0\0", None, None, "3 bytes"),
    ("a.raw", &[0; 16], None, None, "4 floats"),
    ("a.raw8", &[0; 36], None, None, "multiple of the 8"),
    ("a.json", b"[[1,2,3],\n[1,2,x]]", Some(2), Some(6), "invalid JSON"),
    ("a.json", b"[[1,2,NaN]]", Some(1), Some(7), "write null"),
    ("a.json", b"[]", None, None, "empty"),
    ("a.json", b"[[1,2,3],[4,5]]", None, None, "row 2 has 2 numbers"),
    ("a.json", b"[[1,2,3,4]]", None, None, "a row has 4 numbers"),
    ("a.json", b"[[1,2,3],\"x\"]", None, None, "row 2"),
    ("a.json", b"{\"colour\": 3}", None, None, "expected a list"),
    ("a.json", b"7", None, None, "expected a list"),
    ("a.json", b"[{\"x\":1,\"y\":2}]", None, None, "no number `z`"),
    ("a.json", b"[{\"position\":[1,2]}]", None, None, "2 numbers instead of 3"),
    ("a.json", b"{\"positions\":[[0,0,0]],\"normals\":[]}", None, None, "1 positions and 0 normals"),
    ("a.json", b"{\"vertices\":[[0,0,0]],\"indices\":[0,1,0]}", None, None, "count from 0"),
    ("a.json", b"{\"vertices\":[[0,0,0]],\"indices\":[0,-1,0]}", None, None, "index 2 is -1"),
    ("a.json", b"{\"vertices\":[0,0,0],\"indices\":[0,0,0]}", None, None, "list of rows"),
];

#[test]
fn errors_state_the_cause_and_the_place() {
    for (name, bytes, line, column, part) in BAD {
        let text = String::from_utf8_lossy(bytes);
        let Err(error) = read_buffer(name, bytes) else { panic!("{name} {text:?} was read") };
        assert!(error.message.contains(part), "{name} {text:?}: {error}");
        assert_eq!((error.line, error.column), (*line, *column), "{name} {text:?}: {error}");
    }
}

#[test]
fn too_large_files_are_refused_before_they_are_read() {
    let large = vec![b'1'; MOST_BYTES + 1];
    assert!(read_buffer("a.csv", &large).expect_err("too large").message.contains("at most 100"));
    let error = read_buffer("a.json", &large[..40 << 20]).expect_err("too large");
    assert!(error.message.contains("at most 32"), "{error}");
    let deep = vec![b'['; 1 << 20];
    assert!(read_buffer("a.json", &deep).expect_err("too deep").message.contains("recursion"));
}

/// Every format, truncated and with changed bytes, gives an error or a verdict.
#[test]
fn broken_files_never_panic() {
    let models = models();
    let (_, expected) = models.iter().find(|(name, _)| name == "tent.obj").expect("the tent");
    let vertices: Vec<_> = expected.vertices().take(12).collect();
    let (mut state, mut errors, mut verdicts) = (1, 0, 0);
    for format in formats(&vertices, expected.attributes()) {
        for at in 0..format.bytes.len().min(400) {
            let mut changed = format.bytes.clone();
            changed[at] = random(&mut state, 256) as u8;
            for bytes in [&format.bytes[..at], &format.bytes[at..], &changed] {
                match read_buffer(&format.file, bytes) {
                    Ok(buffer) => {
                        verdicts += 1;
                        if at % 16 == 0 {
                            compare(expected, &buffer);
                        }
                    }
                    Err(error) => {
                        errors += 1;
                        assert!(!error.message.is_empty());
                    }
                }
            }
        }
    }
    assert!(errors > 5000 && verdicts > 3000, "{errors} errors, {verdicts} verdicts");
}

/// Numbers at the limits of floats, in a buffer and in a model.
#[test]
fn extreme_numbers_are_compared() {
    let models = models();
    let rows = ["nan,nan,nan", "inf,-inf,1e38", "-1e38,1e-45,0", "1e400,0,-0"];
    let buffer = read_buffer("a.csv", rows.join("\n").as_bytes()).expect("a buffer");
    for (_, expected) in &models {
        assert_ne!(compare(expected, &buffer).verdict, Outcome::Correct);
    }
    let extreme = b"v 1e38 -1e38 0\nv 3e38 0 1e-45\nv 0 1 -3e38\nvn 0 0 0\nf 1//1 2//1 3//1\nf -9223372036854775808 \
                    1 2\nf 9223372036854775807 1 2\n";
    let expected = Expected::from_obj(extreme).expect("a model");
    compare(&expected, &buffer);
    assert_eq!(expected.triangle_count(), 1);
}

fn model(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../exercises/ex02-object-reader/models").join(name)
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            (path.file_name().expect("a name").to_string_lossy().into_owned(), std::fs::read(&path).expect("a file"))
        })
        .collect();
    files.sort();
    files
}

fn models() -> Vec<(String, Expected)> {
    let models = files(&model("")).into_iter();
    models.map(|(name, bytes)| (name, Expected::from_obj(&bytes).expect("an OBJ"))).collect()
}

/// Files that the exercise's programs wrote: MODEL.start.csv, MODEL.reference.raw and so on.
fn programs_output() -> Vec<(String, Vec<u8>)> {
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/buffers.txt"));
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    table.files().iter().map(|file| (file.path.clone(), file.bytes.clone())).collect()
}

/// A random number from 0 to `below` - 1 (Knuth's MMIX).
fn random(state: &mut u64, below: usize) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize % below
}

/// The triangles in random order, each starting at a random corner.
fn shuffled(vertices: &[Vertex], seed: u64) -> Vec<Vertex> {
    let mut state = seed;
    let mut triangles: Vec<[Vertex; 3]> = vertices.as_chunks::<3>().0.to_vec();
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, random(&mut state, i + 1));
    }
    triangles.iter_mut().for_each(|triangle| triangle.rotate_left(random(&mut state, 3)));
    triangles.concat()
}

/// x y z, u v, nx ny nz, as far as they exist.
fn row(vertex: &Vertex, has: Attributes) -> Vec<f32> {
    let mut row = vertex.position.to_vec();
    if has.tex_coords {
        row.extend(vertex.tex_coord);
    }
    if has.normals {
        row.extend(vertex.normal);
    }
    row
}

fn csv(vertices: &[Vertex], has: Attributes, separator: &str, header: bool) -> Vec<u8> {
    let mut text = String::new();
    if header {
        let mut names = vec!["x", "y", "z"];
        names.extend(if has.tex_coords { &["u", "v"][..] } else { &[] });
        names.extend(if has.normals { &["nx", "ny", "nz"][..] } else { &[] });
        writeln!(text, "{}", names.join(separator)).expect("a string");
    }
    for vertex in vertices {
        let words: Vec<String> = row(vertex, has).iter().map(f32::to_string).collect();
        writeln!(text, "{}", words.join(separator)).expect("a string");
    }
    text.into_bytes()
}

/// A file; `!` in the format's name means that reading it gives a warning.
struct Format {
    name: &'static str,
    file: String,
    bytes: Vec<u8>,
}

/// A buffer in all formats.
fn formats(vertices: &[Vertex], has: Attributes) -> Vec<Format> {
    let width = row(&vertices[0], has).len();
    let rows: Vec<Vec<f32>> = vertices.iter().map(|vertex| row(vertex, has)).collect();
    let flat: Vec<f32> = rows.concat();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    let plain = |separator, header| csv(vertices, has, separator, header);
    let mut formats = Vec::new();
    let mut add = |name: &'static str, ending: &str, bytes: Vec<u8>| {
        formats.push(Format { name, file: format!("buffer.{ending}"), bytes });
    };
    add("csv with header", "csv", plain(",", true));
    add("csv", "csv", plain(",", false));
    add("csv of an unknown ending", "out", plain(", ", false));
    add("semicolons", "csv", plain(";", true));
    add("tabs", "tsv", plain("\t", true));
    add("blanks", "txt", plain("  ", false));
    add("lines of Windows, byte order mark", "csv", {
        let windows = text(plain(",", true)).replace('\n', "\r\n");
        [b"\xEF\xBB\xBF", windows.as_bytes()].concat()
    });
    add("comma at the end", "csv", text(plain(",", false)).replace('\n', ",\n").into_bytes());
    add("decimal commas!", "csv", text(plain(";", true)).replace('.', ",").into_bytes());
    add("columns turned round", "csv", {
        let turned = |line: &str| line.split(',').rev().collect::<Vec<_>>().join(",") + "\n";
        text(plain(",", true)).lines().map(turned).collect::<String>().into_bytes()
    });
    add("other names of columns", "csv", {
        let names = text(plain(",", true)).replacen("x,y,z", "Position.x,Position.y,Position.z", 1);
        names.replacen("nx,ny,nz", "normal_x,normal_y,normal_z", 1).into_bytes()
    });
    let little = |values: &[f32]| values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    add("raw", "raw", little(&flat));
    add("raw, stated", &format!("raw{width}"), little(&flat));
    add("raw of an unknown ending", "buffer", little(&flat));
    add("raw doubles!", "bin", flat.iter().flat_map(|x| f64::from(*x).to_le_bytes()).collect());
    if width == 8 {
        let others: Vec<f32> = rows.iter().flat_map(|r| [&r[..3], &r[5..], &r[3..5]].concat()).collect();
        add("raw, normals first!", "raw", little(&others));
    }
    let json = |value: &serde_json::Value| value.to_string().into_bytes();
    add("json rows", "json", json(&serde_json::json!(rows)));
    add("json, one list", "json", json(&serde_json::json!(flat)));
    add("json without its ending", "txt2", json(&serde_json::json!(rows)));
    add("json vertices and indices", "json", {
        let indices: Vec<usize> = (0..rows.len()).rev().collect();
        let turned: Vec<_> = rows.iter().rev().collect();
        json(&serde_json::json!({ "vertices": turned, "indices": indices }))
    });
    let object = |vertex: &Vertex| {
        let mut object = serde_json::json!({ "position": vertex.position });
        if has.tex_coords {
            object["tex_coord"] = serde_json::json!(vertex.tex_coord);
        }
        if has.normals {
            let [x, y, z] = vertex.normal;
            object["normal"] = serde_json::json!({ "x": x, "y": y, "z": z });
        }
        object
    };
    add("json objects", "json", json(&vertices.iter().map(object).collect()));
    add("json lists", "json", {
        let mut lists = serde_json::json!({});
        lists["positions"] = vertices.iter().map(|vertex| serde_json::json!(vertex.position)).collect();
        if has.tex_coords {
            lists["uvs"] = serde_json::json!(vertices.iter().flat_map(|vertex| vertex.tex_coord).collect::<Vec<_>>());
        }
        if has.normals {
            lists["normals"] = vertices.iter().map(|vertex| serde_json::json!(vertex.normal)).collect();
        }
        json(&lists)
    });
    formats
}
