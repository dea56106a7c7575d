//! Explanations of each kind of statement, written by hand, and their agreement with the readers.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_fixtures::FixtureTable;
use gonio_mesh::explain::{LineExplanation, LineValue, excerpt, line, mtl_line};
use gonio_mesh::{Format, Limits, NoSidecars, Severity, encoding, exporter, obj};
use std::path::Path;

const FILE: &str = "# two faces
mtllib a.mtl
o box
v 0 0 0
v 1 0 0
v 1 1 0 0.5
v 0 1 0
vt 0 0
vt 1 0.5 7
vn 0 0 2
g lid
usemtl red
s 2
f 1/1 2/2/1 3//1 \\
  -1
l 1 2
f 1 2 9

vp 0.5
curv 0 1 1 2
foo bar
s off
usemtl
f 2 3 4
";

fn of(number: u64) -> LineExplanation {
    line(FILE.as_bytes(), number).unwrap()
}

/// The explanation and the problems of the first statement of a text.
fn first_statement(text: &str) -> (String, Vec<String>) {
    let explanation = line(text.as_bytes(), 1).unwrap();
    (explanation.meaning, explanation.problems.iter().map(ToString::to_string).collect())
}

#[test]
fn each_statement_has_its_words() {
    let expected = [
        (1, "a comment"),
        (2, "materials are looked up in the library `a.mtl`"),
        (3, "starts the object `box`: no face after it, up to line 11, belongs to it"),
        (4, "vertex 1 of this file: x = 0, y = 0, z = 0"),
        (6, "vertex 3 of this file: x = 1, y = 1, z = 0"),
        (8, "texture coordinate 1 of this file: u = 0, v = 0"),
        (9, "texture coordinate 2 of this file: u = 1, v = 0.5"),
        (10, "normal 1 of this file: x = 0, y = 0, z = 2"),
        (11, "starts the group `lid`: the 3 faces after it, to the end of the file, belong to it"),
        (12, "the 2 faces after it, up to line 23, have the material `red`"),
        (13, "the 2 faces after it, up to line 22, are in the smoothing group 2"),
        (14, "face 1 of this file, with 4 corners, is cut into 2 triangles: (1 2 3), (1 3 4)"),
        (15, "continues line 14: face 1 of this file, with 4 corners, is cut into 2 triangles: (1 2 3), (1 3 4)"),
        (16, "a line through 2 vertices, which is not drawn"),
        (17, "face 2 of this file, with 3 corners"),
        (18, "an empty line"),
        (19, "a point in the parameter space of a free-form curve or surface: skipped"),
        (20, "a free-form curve: skipped"),
        (21, "not a known statement: skipped"),
        (22, "smoothing is off: the one face after it, to the end of the file, is flat"),
        (23, "the one face after it, to the end of the file, has the default material"),
        (24, "face 3 of this file, a triangle"),
    ];
    for (number, meaning) in expected {
        assert_eq!(of(number).meaning, meaning, "line {number}");
    }
}

#[test]
fn details_and_problems() {
    let details = |number: u64| of(number).details;
    assert_eq!(details(6), ["its weight w = 0.5 only matters to free-form curves: it is ignored"]);
    assert_eq!(details(9), ["the third component only matters to 3D textures: it is ignored"]);
    assert_eq!(details(10), ["its length is 2.0000: normalized to 0 0 1"]);
    assert_eq!(details(12), ["it is looked up in `a.mtl` (line 2)"]);
    let corners = [
        "the statement spans lines 14 to 15, joined by \\",
        "corner 1 is `1/1`: vertex 1 (line 4): 0 0 0; texture coordinate 1 (line 8): 0 0",
        "corner 2 is `2/2/1`: vertex 2 (line 5): 1 0 0; texture coordinate 2 (line 9): 1 0.5; normal 1 (line 10): 0 0 2",
        "corner 3 is `3//1`: vertex 3 (line 6): 1 1 0; normal 1 (line 10): 0 0 2",
        "corner 4 is `-1`: vertex 4 (line 7): 0 1 0",
    ];
    assert_eq!(details(14), corners);
    assert_eq!(details(15), corners);
    let broken = of(17);
    assert_eq!(broken.details[2], "corner 3 is `9`: no vertex");
    let problems: Vec<String> = broken.problems.iter().map(ToString::to_string).collect();
    assert_eq!(problems, ["17:7: warning: f has the v index 9, but there are 4 vertices: the face is left out"]);
    assert_eq!(of(21).problems[0].to_string(), "21:1: warning: unknown statement \"foo\"");
    let quiet = (1..=24).filter(|n| of(*n).problems.is_empty()).count();
    assert_eq!(quiet, 22);
}

#[test]
fn settings_in_force_on_a_line() {
    let holds = |number: u64| {
        let explanation = of(number);
        explanation.in_force.iter().map(|f| format!("{} {} {}", f.what, f.name, f.line)).collect::<Vec<_>>()
    };
    assert!(holds(2).is_empty());
    assert_eq!(holds(4), ["object box 3", "material library a.mtl 2"]);
    assert_eq!(holds(12), ["object box 3", "group lid 11", "material library a.mtl 2"]);
    let all = ["object box 3", "group lid 11", "material red 12", "smoothing group 2 13", "material library a.mtl 2"];
    assert_eq!(holds(15), all);
    // A name that is empty is no material.
    assert_eq!(holds(24), ["object box 3", "group lid 11", "smoothing group off 22", "material library a.mtl 2"]);
}

#[test]
fn the_same_in_numbers() {
    let expected = LineValue::Vertex { number: 3, position: [1.0, 1.0, 0.0], weight: Some(0.5), color: None };
    assert_eq!(of(6).value, Some(expected));
    assert_eq!(of(9).value, Some(LineValue::TexCoord { number: 2, value: [1.0, 0.5] }));
    assert_eq!(of(10).value, Some(LineValue::Normal { number: 1, written: [0.0, 0.0, 2.0], unit: [0.0, 0.0, 1.0] }));
    assert_eq!(of(12).value, Some(LineValue::Name { name: "red".to_owned() }));
    assert_eq!(of(22).value, Some(LineValue::SmoothingGroup { group: 0 }));
    let Some(LineValue::Element { number, corner_count, corners, triangles }) = of(15).value else { panic!() };
    assert_eq!((number, corner_count, triangles), (1, 4, vec![[1, 2, 3], [1, 3, 4]]));
    let last = &corners[3];
    assert_eq!((last.line, last.column, last.written.as_str()), (15, 3, "-1"));
    let vertex = last.vertex.as_ref().unwrap();
    assert_eq!((vertex.written, vertex.number, vertex.line), (-1, 4, 7));
    assert_eq!(vertex.value, [0.0, 1.0, 0.0]);
    assert!(last.tex_coord.is_none() && last.normal.is_none());
}

#[test]
fn oddities_are_explained() {
    let cases = [
        (
            "v 1 2",
            "vertex 1 of this file, which cannot be read",
            "1:6: warning: v ends early: it needs at least 3 numbers; is the file cut off?",
        ),
        (
            "v 1 two 3",
            "vertex 1 of this file, which cannot be read",
            "1:5: warning: v: expected a number, found \"two\"",
        ),
        (
            "v 1 2 nan",
            "vertex 1 of this file, which cannot be read",
            "1:7: warning: v has the coordinate \"nan\", which is not a finite number: export the model again",
        ),
        (
            "v 1 2 3 4 5",
            "vertex 1 of this file: x = 1, y = 2, z = 3",
            "1: warning: v has 5 numbers instead of 3, 4, 6 or 7: the last two are ignored",
        ),
        (
            "vn 0 inf 1",
            "normal 1 of this file: x = 0, y = 0, z = 1",
            "1:6: warning: vn has \"inf\", which is not a finite number: using 0 instead",
        ),
        (
            "vn 0 0 0",
            "normal 1 of this file: x = 0, y = 0, z = 0",
            "1:1: note: it has zero length: using an averaged normal instead",
        ),
        (
            "vt",
            "texture coordinate 1 of this file, which cannot be read",
            "1:3: warning: vt ends early: it needs at least 1 number; is the file cut off?",
        ),
        (
            "f 1 2",
            "face 1 of this file, with 2 corners",
            "1:3: warning: f has the v index 1, but there are 0 vertices: the face is left out",
        ),
        (
            "f 1 x 2\nv 0 0 0",
            "face 1 of this file, with 1 corner",
            "1:5: warning: f: expected an index (v, v/vt, v//vn or v/vt/vn), found \"x\"",
        ),
        (
            "f 1 1\nv 0 0 0",
            "face 1 of this file, with 2 corners",
            "1: warning: f has 2 corners, too few for a triangle: it is left out",
        ),
        (
            "f 0 1 1\nv 0 0 0",
            "face 1 of this file, with 3 corners",
            "1:3: warning: f has the v index 0, but indices are counted from 1: the face is left out",
        ),
        (
            "f 1 -1 1\nv 0 0 0",
            "face 1 of this file, with 3 corners",
            "1:5: warning: f has the v index -1, but there are 0 vertices before it: the face is left out",
        ),
        (
            "s smooth",
            "smoothing is off: no face after it, to the end of the file, is flat",
            "1:3: warning: s is followed by \"smooth\" instead of a number or off: treated as off",
        ),
        ("mtllib", "a material library without a name", "1: warning: mtllib names no material library"),
    ];
    for (text, meaning, problem) in cases {
        let (found, problems) = first_statement(text);
        assert_eq!((found.as_str(), problems.first().map(String::as_str)), (meaning, Some(problem)), "{text}");
    }
}

#[test]
fn polygons_are_cut_as_the_reader_cuts_them() {
    let points = "\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 1 1 0\n";
    // Concave at the second corner: both triangles meet there, and not at the first one as in a fan.
    let arrow = line(format!("f 2 4 3 1{points}").as_bytes(), 1).unwrap();
    let Some(LineValue::Element { triangles, .. }) = arrow.value else { panic!() };
    let mut sorted = triangles.clone();
    sorted.iter_mut().for_each(|t| t.sort_unstable());
    sorted.sort_unstable();
    assert_eq!(sorted, [[1, 2, 4], [2, 3, 4]]);
    let list = triangles.iter().map(|[a, b, c]| format!("({a} {b} {c})")).collect::<Vec<_>>().join(", ");
    assert_eq!(arrow.meaning, format!("face 1 of this file, with 4 corners, is cut into 2 triangles: {list}"));
    let (twice, problems) = first_statement(&format!("f 1 2 3 3{points}"));
    assert_eq!(twice, "face 1 of this file, with 4 corners, makes one triangle: (1 2 3)");
    assert_eq!(problems, ["1:9: note: a corner repeats the one before it: it counts once"]);
    let (_, problems) = first_statement("f 1 2 3 4\nv 0 0 0\nv 3 3 0\nv 3 0 0\nv 0 1 0\n");
    assert_eq!(problems, ["1: warning: the polygon crosses or touches itself: its triangles are guessed"]);
    let (_, problems) = first_statement("f 1 2 3\nv 0 0 0\nv 1 x 0\nv 1 0 0\n");
    let unreadable = "1: warning: the numbers of one of its vertices cannot be read: no triangle can be made";
    assert_eq!(problems, [unreadable]);
}

#[test]
fn lines_that_are_not_there() {
    let error = |bytes: &[u8], number: u64| line(bytes, number).unwrap_err().to_string();
    assert_eq!(error(b"", 1), "the file has 0 lines: there is no line 1");
    assert_eq!(error(b"v 0 0 0", 2), "the file has 1 line: there is no line 2");
    assert_eq!(error(b"v 0 0 0\n", 2), "the file has 1 line: there is no line 2");
    assert_eq!(error(b"f 1 2 \\", 2), "the file has 1 line: there is no line 2");
    assert_eq!(error(b"f 1 2 \\\n", 2), "the file has 1 line: there is no line 2");
    assert_eq!(error(b"a\rb\r\nc\nd \\\r\n e", 6), "the file has 5 lines: there is no line 6");
    assert_eq!(error(b"v 0 0 0\n", 0), "lines are counted from 1: there is no line 0");
    assert_eq!(mtl_line(b"newmtl a\n", 9).unwrap_err().to_string(), "the file has 1 line: there is no line 9");
    let text = |number: u64| line(b"\xef\xbb\xbfa\rb\r\nc\nd \\\r\n e\x1b[2J", number).unwrap().text;
    assert_eq!([1, 2, 3, 4, 5].map(text), ["a", "b", "c", "d \\", " e\\u{1b}[2J"]);
}

#[test]
fn large_faces_are_reported_in_part() {
    let mut text = String::from("f");
    (0..5000).for_each(|_| text.push_str(" 1 2 3"));
    text.push_str("\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    let explanation = line(text.as_bytes(), 1).unwrap();
    assert_eq!(explanation.meaning, "face 1 of this file, with 15000 corners");
    assert_eq!(explanation.details.len(), 66);
    assert_eq!(explanation.details[64..], ["and 14936 more corners", "only the first 4000 corners were checked"]);
    assert_eq!(explanation.text.len(), 503);
}

const LIBRARY: &str = "Kd 1 1 1
newmtl red
Kd 0 0 0
map_Kd -s 2 2 a.png
  Ns 10 \\
 20
Ps 0.5
# hm
foo
";

#[test]
fn lines_of_a_material_library() {
    let of = |number: u64| {
        let explanation = mtl_line(LIBRARY.as_bytes(), number).unwrap();
        let problems: Vec<String> = explanation.problems.iter().map(ToString::to_string).collect();
        (explanation.meaning, explanation.details, problems)
    };
    let owned = |texts: &[&str]| texts.iter().map(|t| (*t).to_owned()).collect::<Vec<_>>();
    let expected: [(u64, &str, &[&str], &[&str]); 9] = [
        (
            1,
            "the diffuse color, of no material: no newmtl precedes it",
            &[],
            &["1:1: warning: \"Kd\" before the first newmtl is ignored"],
        ),
        (2, "starts the material `red`", &[], &[]),
        (
            3,
            "the diffuse color, of the material `red`",
            &["diffuse = 1 1 1 (black beside map_Kd: treated as 1 1 1)"],
            &["3:1: note: Kd of \"red\" is black beside map_Kd: treated as 1 1 1"],
        ),
        (4, "a texture of the diffuse color, of the material `red`", &["diffuse_map = `a.png`, scale 2 2"], &[]),
        (
            5,
            "the exponent of the highlight: the larger, the smaller and sharper it is, of the material `red`",
            &["the statement spans lines 5 to 6, joined by \\", "shininess = 10"],
            &["6:2: warning: Ns has \"20\" after its last number, which is ignored"],
        ),
        (
            6,
            "continues line 5: the exponent of the highlight: the larger, the smaller and sharper it is, of the \
            material `red`",
            &["the statement spans lines 5 to 6, joined by \\", "shininess = 10"],
            &["6:2: warning: Ns has \"20\" after its last number, which is ignored"],
        ),
        (
            7,
            "the sheen, as on velvet (physically based), of the material `red`",
            &["not used: no term of the light equation"],
            &["7: note: 1 statement without a term in the light equation: Ps"],
        ),
        (8, "a comment", &[], &[]),
        (9, "not a known statement: skipped", &[], &["9:1: warning: unknown material statement \"foo\""]),
    ];
    for (number, meaning, details, problems) in expected {
        assert_eq!(of(number), (meaning.to_owned(), owned(details), owned(problems)), "line {number}");
    }
    let explanation = mtl_line(LIBRARY.as_bytes(), 5).unwrap();
    let value = LineValue::Property { property: "shininess".to_owned(), value: "10".to_owned() };
    assert_eq!(explanation.value, Some(value));
    assert_eq!((explanation.in_force[0].name.as_str(), explanation.in_force[0].line), ("red", 2));
}

/// The files of a table in `tests` that end in `.extension`.
fn files(table: &str, extension: &str) -> Vec<(String, Vec<u8>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(table);
    let table = FixtureTable::read(path).unwrap_or_else(|error| panic!("{error}"));
    let ending = format!(".{extension}");
    let files = table.files().iter().filter(|file| file.path.ends_with(&ending));
    let files: Vec<_> = files.map(|file| (file.path.clone(), file.bytes.clone())).collect();
    assert!(files.len() > 50, "only {} files in {}", files.len(), table.name);
    files
}

/// The explanation of a line has the problems that the reader reports there, with the same words and places; and
/// it finds no other fault in a corner or a number.
#[test]
fn the_reader_and_the_explanation_agree() {
    let mut agreed = 0;
    for (name, bytes) in files("obj.txt", "obj") {
        let (error, diagnostics) = match obj::read(&bytes, &mut NoSidecars, &Limits::default()) {
            Ok(model) => (None, model.diagnostics),
            Err(error) => (Some(error), Vec::new()),
        };
        let of_reader =
            diagnostics.iter().filter(|d| d.place.file.is_none()).map(|d| (d.place.line, d.place.column, &d.message));
        let of_error = error.iter().map(|e| (e.place.line, e.place.column, &e.message));
        for (line_number, column, message) in of_reader.chain(of_error) {
            let (Some(number), Some(_)) = (line_number, column) else { continue };
            let explanation = line(&bytes, number).unwrap();
            let same = explanation.problems.iter().any(|p| (p.place.column, &p.message) == (column, message));
            assert!(same, "{name}:{number}: {message}\n{:?}", explanation.problems);
            agreed += 1;
        }
        // A file that says no such thing has no line that does.
        let is_silent = error.is_none() && diagnostics.iter().all(|d| d.severity == Severity::Note);
        let lines = (1..).map_while(|number| line(&bytes, number).ok());
        for explanation in lines.filter(|_| is_silent) {
            let warnings = explanation.problems.iter().filter(|p| p.severity > Severity::Note);
            assert_eq!(warnings.count(), 0, "{name}: {:?}", explanation.problems);
        }
    }
    assert!(agreed > 20, "{agreed}");
}

/// Every line of every file, cut off anywhere and with bytes changed, is explained; none beyond the last is.
#[test]
fn every_line_of_every_prefix_is_explained() {
    type Explain = fn(&[u8], u64) -> Result<LineExplanation, gonio_mesh::ReadError>;
    let check = |explain: Explain, bytes: &[u8]| {
        let text = encoding::to_utf8(bytes);
        let bytes = text.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&text.bytes);
        let explained = (1..).map_while(|number| explain(bytes, number).ok()).count();
        let ends =
            bytes.iter().enumerate().filter(|(i, b)| **b == b'\n' || **b == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
        let is_open = bytes.last().is_some_and(|b| !matches!(b, b'\n' | b'\r'));
        assert_eq!(explained, ends.count() + usize::from(is_open), "{:?}", String::from_utf8_lossy(bytes));
    };
    let mut tried = 0;
    for (table, extension, explain) in [("obj.txt", "obj", line as Explain), ("mtl.txt", "mtl", mtl_line as Explain)] {
        for (_, bytes) in files(table, extension) {
            let bytes = &bytes[..bytes.len().min(150)];
            for at in 0..bytes.len() {
                check(explain, &bytes[..at]);
                let mut changed = bytes.to_vec();
                changed[at] = b"\\\n#-/\r"[at % 6];
                check(explain, &changed);
                tried += 1;
            }
        }
    }
    assert!(tried > 5000, "{tried}");
}

#[test]
fn an_excerpt_has_the_lines_around_one() {
    let text = b"\xEF\xBB\xBFone\r\ntwo\rthree\n\nfive \x1b[31m\nsix";
    let of = |line, around| excerpt(text, line, around).unwrap();
    let middle = of(3, 1);
    assert_eq!((middle.first_line, middle.line_count), (2, 6));
    assert_eq!(middle.lines, ["two", "three", ""]);
    assert_eq!(of(1, 0).lines, ["one"]);
    assert_eq!(of(6, 1).lines, ["five \\u{1b}[31m", "six"], "control characters are escaped");
    assert_eq!((of(2, 90).first_line, of(2, 90).lines.len()), (1, 6));
    let wide: Vec<u8> = "\u{feff}v 0\nv 1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(excerpt(&wide, 2, 1).unwrap().lines, ["v 0", "v 1"]);
}

/// An excerpt counts lines as the explanation does, and refuses the same ones.
#[test]
fn excerpts_and_explanations_count_the_same_lines() {
    let mut tried = 0;
    for (name, bytes) in files("obj.txt", "obj") {
        let lines = (1..).take_while(|number| line(&bytes, *number).is_ok()).count() as u64;
        if bytes.contains(&0) || lines == 0 {
            continue;
        }
        let whole = excerpt(&bytes, 1, u64::MAX).unwrap();
        assert_eq!((whole.line_count, whole.lines.len() as u64), (lines, lines), "{name}");
        assert_eq!(excerpt(&bytes, lines + 1, 0).unwrap_err(), line(&bytes, lines + 1).unwrap_err(), "{name}");
        tried += 1;
    }
    assert!(tried > 30, "{tried}");
    assert_eq!(excerpt(b"glTF\0\0", 1, 9).unwrap_err().message, "the file is binary, so it has no lines");
    assert!(excerpt(b"", 1, 9).is_err() && excerpt(b"a", 0, 9).is_err());
}

#[test]
fn files_state_the_program_that_wrote_them() {
    let long = format!("# {}\n", "x".repeat(300));
    let mut stl = b"Exported by nobody".to_vec();
    stl.resize(84, 0);
    let cases: [(&[u8], Format, Option<&str>); 10] = [
        (b"\xEF\xBB\xBF# ------\n\n# Blender 3.4.1\nv 0 0 0\n", Format::Obj, Some("Blender 3.4.1")),
        (b"v 0 0 0\n# not this\n", Format::Obj, None),
        (b"ply\nformat ascii 1.0\ncomment Made by \x1bX\nend_header\n", Format::Ply, Some("Made by X")),
        (b"ply\nformat ascii 1.0\nend_header\ncomment no\n", Format::Ply, None),
        (br#"{"asset": {"generator" : "a \"b\"", "version": "2.0"}}"#, Format::Gltf, Some("a \"b\"")),
        (br#"{"asset": {"generator": 3}}"#, Format::Gltf, None),
        (b"<COLLADA><authoring_tool> Tool 1 </authoring_tool>", Format::Collada, Some("Tool 1")),
        (b"<COLLADA><authoring_tool>Tool", Format::Collada, None),
        (&stl, Format::Stl, Some("Exported by nobody")),
        (b"solid name\n", Format::Stl, None),
    ];
    for (bytes, format, expected) in cases {
        assert_eq!(exporter(bytes, format).as_deref(), expected, "{:?}", String::from_utf8_lossy(bytes));
    }
    assert_eq!(exporter(long.as_bytes(), Format::Obj).map(|name| name.len()), Some(200));
}
