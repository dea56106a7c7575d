//! OBJ files with one oddity each, and the expected results: the table `obj.txt`. The expectations were written
//! by hand: sizes, parts, triangles and every diagnostic, or the error.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_fixtures::{ExpectedCase, FixtureTable, assert_as_expected};
use gonio_mesh::{Limits, MissingSidecar, Model, ReadError, Sidecar, Sidecars, obj};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::LazyLock;

/// The files, and the material libraries that they refer to.
static TABLE: LazyLock<FixtureTable> = LazyLock::new(|| {
    FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/obj.txt")).unwrap_or_else(|error| panic!("{error}"))
});

/// The libraries of the table.
struct Libraries;

impl Sidecars for Libraries {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        let missing = || MissingSidecar { tried: vec![format!("here/{name}"), format!("there/{name}")], refused: None };
        let bytes = TABLE.get(name.trim_start_matches("./")).ok_or_else(missing)?;
        Ok(Sidecar { path: name.to_owned(), bytes: bytes.to_vec() })
    }
}

fn read(bytes: &[u8]) -> Result<Model, ReadError> {
    obj::read(bytes, &mut Libraries, &Limits::default())
}

fn summary(result: &Result<Model, ReadError>) -> String {
    let model = match result {
        Ok(model) => model,
        Err(error) => return format!("error {error}\n"),
    };
    let mesh = &model.mesh;
    let mut text = format!("{} vertices, {} triangles", mesh.positions.len(), mesh.triangle_count());
    for (what, length) in
        [("normals", mesh.normals.len()), ("tex coords", mesh.tex_coords.len()), ("colors", mesh.colors.len())]
    {
        assert!(length == 0 || length == mesh.positions.len(), "{what}");
        if length > 0 {
            write!(text, ", {what}").unwrap();
        }
    }
    if !mesh.smoothing_groups.is_empty() {
        let groups: Vec<String> = mesh.smoothing_groups.iter().map(u32::to_string).collect();
        write!(text, ", smoothing {}", groups.join(" ")).unwrap();
    }
    text.push('\n');
    for part in &mesh.parts {
        let material = &model.materials[part.material].name;
        let (first, count) = (part.first_triangle, part.triangle_count);
        writeln!(text, "part {:?}: {material:?} {first}+{count}", part.name).unwrap();
    }
    let triangles: Vec<String> = mesh.indices.chunks(3).map(|t| format!("{} {} {}", t[0], t[1], t[2])).collect();
    writeln!(text, "triangles {}", triangles.join(" | ")).unwrap();
    for diagnostic in &model.diagnostics {
        writeln!(text, "{diagnostic}").unwrap();
    }
    text
}

fn cases() -> Vec<ExpectedCase> {
    let cases = TABLE.expected_cases("obj").unwrap_or_else(|error| panic!("{error}"));
    assert!(cases.len() >= 75, "only {} cases", cases.len());
    cases
}

fn files() -> Vec<(String, Vec<u8>)> {
    cases().into_iter().map(|case| (case.name, case.bytes)).collect()
}

#[test]
fn every_file_has_its_expected_result() {
    assert_as_expected(cases(), |case| summary(&read(&case.bytes)));
}

#[test]
fn names_tell_which_files_are_refused() {
    for case in cases() {
        assert_eq!(case.expected.starts_with("error "), case.name.starts_with("fail_"), "{}", case.name);
    }
}

/// No prefix of any file makes a panic, and whatever is read is consistent.
#[test]
fn every_prefix_is_survived() {
    let mut tried = 0;
    for (_, bytes) in files() {
        for length in 0..=bytes.len() {
            if let Ok(model) = read(&bytes[..length]) {
                check_consistent(&model);
            }
            tried += 1;
        }
    }
    assert!(tried > 3000, "{tried}");
}

/// One byte changed at every place, to each of a few that mean something.
#[test]
fn every_changed_byte_is_survived() {
    let mut read_well = 0;
    for (_, bytes) in files() {
        for at in 0..bytes.len().min(400) {
            for byte in *b"\n\\#/-9 e.\0\xFF" {
                let mut changed = bytes.clone();
                changed[at] = byte;
                if let Ok(model) = read(&changed) {
                    check_consistent(&model);
                    read_well += 1;
                }
            }
        }
    }
    assert!(read_well > 5000, "{read_well}");
}

fn check_consistent(model: &Model) {
    let mesh = &model.mesh;
    let count = mesh.positions.len();
    assert!(!mesh.indices.is_empty() && mesh.indices.len().is_multiple_of(3));
    assert!(mesh.indices.iter().all(|&i| (i as usize) < count));
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
    for length in [mesh.normals.len(), mesh.tex_coords.len(), mesh.colors.len()] {
        assert!(length == 0 || length == count);
    }
    assert!(mesh.smoothing_groups.is_empty() || mesh.smoothing_groups.len() == mesh.triangle_count());
    let mut next = 0;
    for part in &mesh.parts {
        assert_eq!(part.first_triangle, next);
        assert!(part.triangle_count > 0 && part.material < model.materials.len());
        next += part.triangle_count;
    }
    assert_eq!(next, mesh.triangle_count());
}

#[test]
fn limits_are_kept() {
    let quad = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let message = |limits| obj::read(quad, &mut Libraries, &limits).unwrap_err().message;
    let few_triangles = Limits { max_triangles: 1, ..Limits::default() };
    assert_eq!(message(few_triangles), "contains more than 1 triangles, which is the limit");
    let few_vertices = Limits { max_vertices: 3, ..Limits::default() };
    assert_eq!(message(few_vertices), "needs more than 3 vertices, which is the limit");
    let enough = Limits { max_vertices: 4, max_triangles: 2, ..Limits::default() };
    assert_eq!(obj::read(quad, &mut Libraries, &enough).unwrap().mesh.indices, [0, 1, 2, 0, 2, 3]);
}

/// A line without end is no reason to take memory without end.
#[test]
fn polygons_beyond_the_limit_of_corners_are_errors_with_a_place() {
    const MOST: usize = 4_194_304;
    let error = |face: &str, limits| {
        let text = format!("v 0 0 0\nv 1 0 0\nv 1 1 0\n{face}\n");
        obj::read(text.as_bytes(), &mut Libraries, &limits).unwrap_err().to_string()
    };
    // As exporters write it, and with tabs.
    let at = 2 * MOST + 3;
    for blank in [" ", "\t"] {
        let face = format!("f{}", format!("{blank}1").repeat(MOST + 1));
        let expected = format!("4:{}: f has more than 4194304 corners, which is the limit", at + 1);
        assert_eq!(error(&face, Limits::default()), expected);
    }
    let few = Limits { max_triangles: 3, ..Limits::default() };
    let rest = "f 1 2 3\n".repeat(1000);
    assert_eq!(error(&format!("f 1 2 3 1 2 3\n{rest}"), few), "4: contains more than 3 triangles, which is the limit");
}

#[test]
fn values_arrive_where_they_belong() {
    let text =
        b"v 1 2 3 1 0 0.5\nv 4 5 6 0 0 0\nv 7 8 10 1 1 1\nvt 0.25 0.75 9\nvt 0.5\nvn 0 3 4\nf 3/1/1 1/2/1 2/1/1\n";
    let mesh = read(text).unwrap().mesh;
    assert_eq!(mesh.positions, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 10.0]]);
    assert_eq!(mesh.indices, [2, 0, 1]);
    assert_eq!(mesh.tex_coords, [[0.5, 0.0], [0.25, 0.75], [0.25, 0.75]]);
    // A 3-4-5 triangle, in f32.
    assert_eq!(mesh.normals, [[0.0, 0.6, 0.8]; 3]);
    assert_eq!(mesh.colors[2], [1.0; 4]);
    assert_eq!(mesh.colors[1], [0.0, 0.0, 0.0, 1.0]);
    // sRGB 0.5 is linear 0.21404 (IEC 61966-2-1); a float's precision is allowed for.
    assert!((mesh.colors[0][2] - 0.214_041).abs() < 1e-6 && mesh.colors[0][..2] == [1.0, 0.0]);
    // Negative indices count back from the end of their own kind.
    let text = b"v 1 2 3\nv 4 5 6\nv 7 8 10\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvn 1 0 0\nvn 0 1 0\nf -3/-4/-1 -2/-1/-2 -1/-2/-1\n";
    let relative = read(text).unwrap().mesh;
    assert_eq!(relative.positions, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 10.0]]);
    assert_eq!(relative.tex_coords, [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert_eq!(relative.normals, [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let bytes = read(b"v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 0 0 255\nf 1 2 3\n").unwrap();
    assert_eq!(bytes.mesh.colors[0], [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(bytes.diagnostics[0].message, "vertex colors reach 255: treated as 0 to 255");
}

#[test]
fn numbers_may_be_written_in_any_way() {
    let zeros = "0".repeat(5000);
    let text = format!(
        "v 1.{zeros}1 {zeros}2 -0.{zeros}3e5001\nv +1E+2 .5e-1 -2.\nv\t1e-45 16777217 1{zeros}e-5000 0.25\nf 1 2 3\n"
    );
    let mesh = read(text.as_bytes()).unwrap().mesh;
    // 2^24 + 1 is half-way between two numbers and goes to the even one; 1e-45 is the smallest above 0.
    assert_eq!(mesh.positions, [[1.0, 2.0, -3.0], [100.0, 0.05, -2.0], [f32::from_bits(1), 16_777_216.0, 1.0]]);
}

#[test]
fn contents_are_counted_in_the_words_of_the_file() {
    let text = b"o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1 0 0\nvt 0\nvn 0 0 1\ng x\ns 1\nf 1 2 3\nf 1 2 3 4\nf 1 2 9\nl 1 2\np 1\n";
    let contents = read(text).unwrap().contents;
    let expected = [
        ("v", 4),
        ("vt", 1),
        ("vn", 1),
        ("v with a color", 1),
        ("f of 3 corners", 1),
        ("f of 4 corners", 1),
        ("f left out", 1),
        ("l", 1),
        ("p", 1),
        ("o", 1),
        ("g", 1),
        ("s", 1),
    ];
    assert_eq!(contents, expected.map(|(name, count)| (name.to_owned(), count)));
}

/// Files of which tobj makes something else: it refuses or misreads byte order marks, comments behind numbers, continued lines,
/// carriage returns alone, names that are no UTF-8, UTF-16, colors that are not finite, numbers behind the third, indices that
/// point forward or at nothing; it makes triangles of lines and points, and of corners that are written twice.
const NOT_FOR_TOBJ: [&str; 23] = [
    "byte_order_mark.obj",
    "color_not_finite.obj",
    "comments_anywhere.obj",
    "continuation.obj",
    "continuation_at_end.obj",
    "corner_twice.obj",
    "cr_only.obj",
    "fewer_different_corners.obj",
    "five_numbers.obj",
    "index_huge.obj",
    "index_of_tex_coord_too_large.obj",
    "index_too_large.obj",
    "index_too_large_often.obj",
    "lines_and_points.obj",
    "names_latin_1.obj",
    "points_forward_and_back.obj",
    "too_few_corners.obj",
    "utf_16_be.obj",
    "utf_16_damaged.obj",
    "utf_16_le.obj",
    "utf_16_no_mark.obj",
    "vertex_colors_on_some.obj",
    "vertex_weights.obj",
];

/// Corner by corner, bit by bit: a second reader (tobj) agrees on every other file.
#[test]
fn a_second_reader_agrees() {
    let options = tobj::LoadOptions { single_index: true, triangulate: true, ..Default::default() };
    let (mut compared, mut others) = (0, Vec::new());
    for (name, bytes) in files() {
        let Ok(ours) = read(&bytes) else { continue };
        let no_library = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
        let theirs = std::panic::catch_unwind(|| tobj::load_obj_buf(&mut bytes.as_slice(), &options, no_library));
        let theirs: Vec<[f32; 3]> = theirs
            .ok()
            .and_then(Result::ok)
            .iter()
            .flat_map(|(models, _)| models)
            .flat_map(|model| {
                let positions = &model.mesh.positions;
                model.mesh.indices.iter().map(|&i| std::array::from_fn(|k| positions[3 * i as usize + k]))
            })
            .collect();
        let ours: Vec<[f32; 3]> = ours.mesh.indices.iter().map(|&i| ours.mesh.positions[i as usize]).collect();
        if ours == theirs {
            compared += 1;
        } else {
            others.push(name);
        }
    }
    assert_eq!(others, NOT_FOR_TOBJ);
    assert!(compared >= 30, "only {compared} files were read by both");
}

/// Many vertices of one position go through another path than a few.
#[test]
fn a_crowded_position_is_merged_too() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    (0..1000).for_each(|i| writeln!(text, "vt {i} 0").unwrap());
    for i in (1..=1000).chain(1..=1000) {
        writeln!(text, "f 1/{i} 2/1 3/1").unwrap();
    }
    let mesh = read(text.as_bytes()).unwrap().mesh;
    assert_eq!((mesh.positions.len(), mesh.triangle_count()), (1002, 2000));
    assert_eq!(mesh.indices[..3000], mesh.indices[3000..]);
    let seen: Vec<f32> = mesh.indices.chunks(3).take(1000).map(|t| mesh.tex_coords[t[0] as usize][0]).collect();
    assert_eq!(seen, (0..1000).map(|i| i as f32).collect::<Vec<_>>());
}
