//! STL: small files, written by hand from the definition of the format, each with its expected result.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::{Limits, Mesh, Model, NoSidecars, NormalSource, normals, stl, topology};

fn read(bytes: &[u8]) -> Result<Model, String> {
    stl::read(bytes, &mut NoSidecars, &Limits::default()).map_err(|error| error.to_string())
}

fn messages_of(model: &Model) -> Vec<String> {
    model.diagnostics.iter().map(ToString::to_string).collect()
}

/// A model that must be read without a message.
fn quiet(bytes: &[u8]) -> Model {
    let model = read(bytes).unwrap();
    assert_eq!(messages_of(&model), [""; 0]);
    model
}

fn error(bytes: &[u8]) -> String {
    read(bytes).map(|model| panic!("was read: {model:?}")).unwrap_err()
}

fn triangles(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    (0..mesh.triangle_count()).map(|t| mesh.triangle_positions(t).map(Into::into)).collect()
}

const O: [f32; 3] = [0.0; 3];
const X: [f32; 3] = [1.0, 0.0, 0.0];
const Y: [f32; 3] = [0.0, 1.0, 0.0];
const Z: [f32; 3] = [0.0, 0.0, 1.0];

/// A tetrahedron with its outside outside: normal, corners.
const TETRAHEDRON: [[[f32; 3]; 4]; 4] = [
    [[0.0, 0.0, -1.0], O, Y, X],
    [[0.0, -1.0, 0.0], O, X, Z],
    [[-1.0, 0.0, 0.0], O, Z, Y],
    [[0.577_350_3, 0.577_350_3, 0.577_350_3], X, Y, Z],
];

/// Facets with their attribute, in either byte order.
fn binary(header: &[u8], facets: &[([[f32; 3]; 4], u16)], is_big_endian: bool) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    let count = facets.len() as u32;
    bytes.extend(if is_big_endian { count.to_be_bytes() } else { count.to_le_bytes() });
    for (numbers, attribute) in facets {
        for number in numbers.iter().flatten() {
            bytes.extend(if is_big_endian { number.to_be_bytes() } else { number.to_le_bytes() });
        }
        bytes.extend(if is_big_endian { attribute.to_be_bytes() } else { attribute.to_le_bytes() });
    }
    bytes
}

fn binary_tetrahedron(header: &[u8]) -> Vec<u8> {
    binary(header, &TETRAHEDRON.map(|facet| (facet, 0)), false)
}

fn ascii_facet(numbers: &[[f32; 3]; 4]) -> String {
    let [n, a, b, c] = numbers.map(|[x, y, z]| format!("{x} {y} {z}"));
    format!("facet normal {n}\n outer loop\n  vertex {a}\n  vertex {b}\n  vertex {c}\n endloop\nendfacet\n")
}

fn ascii_tetrahedron() -> String {
    format!("solid tetra\n{}endsolid tetra\n", TETRAHEDRON.map(|facet| ascii_facet(&facet)).concat())
}

fn one_facet(normal: &str) -> String {
    format!(
        "solid\nfacet normal {normal}\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"
    )
}

#[test]
fn a_tetrahedron_is_the_same_in_both_forms() {
    let expected = TETRAHEDRON.map(|[_, a, b, c]| [a, b, c]);
    let text = quiet(ascii_tetrahedron().as_bytes());
    // Many programs begin the free text of binary files with `solid` too.
    for header in [&b"by hand"[..], b"solid tetra\nfacet normal"] {
        let model = quiet(&binary_tetrahedron(header));
        assert_eq!(triangles(&model.mesh), expected);
        let model_without_names = Mesh { parts: text.mesh.parts.clone(), ..model.mesh };
        assert_eq!(model_without_names, text.mesh);
    }
    let mesh = &text.mesh;
    assert_eq!(mesh.parts.len(), 1);
    assert_eq!((mesh.parts[0].name.as_str(), mesh.parts[0].triangle_count), ("tetra", 4));
    assert_eq!(mesh.normal_source, NormalSource::File);
    for (t, [normal, ..]) in TETRAHEDRON.into_iter().enumerate() {
        for vertex in mesh.triangle(t) {
            assert!(mesh.normals[vertex].iter().zip(normal).all(|(a, b)| (a - b).abs() < 1e-7), "{t}");
        }
    }
    let contents: Vec<(&str, u64)> = text.contents.iter().map(|(what, count)| (what.as_str(), *count)).collect();
    assert_eq!(contents, [("solid", 1), ("facet", 4), ("distinct positions", 4)]);
}

/// Neighbours are found by position, though every corner of a tetrahedron has three normals.
#[test]
fn flat_triangles_can_be_averaged_and_are_closed() {
    let mesh = quiet(&binary_tetrahedron(b"")).mesh;
    assert_eq!(mesh.positions.len(), 12);
    assert!(topology::is_closed_outward(&mesh));
    let (averaged, _) = normals::make_averaged(&mesh);
    let third = -1.0 / 3.0_f32.sqrt();
    let at_origin = averaged.positions.iter().zip(&averaged.normals).filter(|(p, _)| **p == O);
    let normals: Vec<_> = at_origin.map(|(_, normal)| *normal).collect();
    assert!(!normals.is_empty() && normals.iter().flatten().all(|c| (c - third).abs() < 1e-6), "{normals:?}");
}

/// Two facets of one plane share what they have in common.
#[test]
fn equal_positions_of_one_normal_are_one_vertex() {
    let up = [0.0, 0.0, 1.0];
    let corner = [1.0, 1.0, -0.0];
    let also_up = [-0.0, 0.0, 1.0];
    let facets = [([up, O, X, corner], 0), ([also_up, O, [1.0, 1.0, 0.0], Y], 0)];
    let mesh = quiet(&binary(b"", &facets, false)).mesh;
    assert_eq!((mesh.positions.len(), &mesh.indices[..]), (4, &[0, 1, 2, 0, 2, 3][..]));
}

#[test]
fn several_solids_are_parts() {
    let [a, b, c, d] = TETRAHEDRON.map(|facet| ascii_facet(&facet));
    let text = format!(
        "solid first one \r\n{a}endsolid\nsolid second # comment\n{b}{c}endsolid second\nsolid empty\nendsolid\n\
         SOLID second\n{d}EndSolid second\n"
    );
    let model = quiet(text.as_bytes());
    let parts: Vec<_> =
        model.mesh.parts.iter().map(|p| (p.name.as_str(), p.first_triangle, p.triangle_count)).collect();
    assert_eq!(parts, [("first one", 0, 1), ("second", 1, 3)]);
    assert_eq!(model.contents[0], ("solid".to_owned(), 4));
}

#[test]
fn text_in_many_manners() {
    let expected = quiet(ascii_tetrahedron().as_bytes()).mesh;
    let text = ascii_tetrahedron();
    let manners = [
        text.to_uppercase().replace("TETRA", "tetra"),
        text.replace('\n', "\r\n"),
        text.replace('\n', "\r"),
        text.replace('\n', "\n\t  "),
        text.trim_end().to_owned(),
        format!("\u{feff}\n  {text}"),
        text.replace("vertex 1 0 0", "vertex +1.000000E+00 .0e1 -0"),
        text.replace("outer loop\n", "outer loop ").replace("endloop\n", "endloop "),
    ];
    for manner in manners {
        let mesh = quiet(manner.as_bytes()).mesh;
        assert_eq!(triangles(&mesh), triangles(&expected), "{manner}");
        assert_eq!((&mesh.normals, &mesh.parts), (&expected.normals, &expected.parts), "{manner}");
    }
}

#[test]
fn normals_are_held_against_the_winding() {
    let read_normal = |text: &str| {
        let model = read(one_facet(text).as_bytes()).unwrap();
        (model.mesh.normals[0], model.mesh.normal_source, messages_of(&model))
    };
    let file = |normal: [f32; 3]| (normal, NormalSource::File, vec![]);
    let computed = |message: &str| (Z, NormalSource::Flat, vec![message.to_owned()]);
    assert_eq!(read_normal("0 0 1"), file(Z));
    assert_eq!(read_normal("0 0 2.5"), file(Z));
    // 5 degrees off: kept, unit length (0.0871557, 0.9961947 on paper).
    let (normal, source, messages) = read_normal("0.08748866 0 1");
    assert!((normal[0] - 0.087_155_7).abs() < 1e-6 && (normal[2] - 0.996_194_7).abs() < 1e-6, "{normal:?}");
    assert_eq!((source, messages.len()), (NormalSource::File, 0));
    let none = "note: 1 of 1 facets have no normal (the first is facet 0): computed from the corners";
    for text in ["0 0 0", "nan 0 0", "0 -nan(ind) 1", "1.#QNAN 0 0", "inf 0 0"] {
        assert_eq!(read_normal(text), computed(none), "{text}");
    }
    let against = "warning: 1 of 1 normals point against the winding of their corners (the first is that of facet 0): \
                   computed from the corners";
    assert_eq!(read_normal("0 0 -1"), computed(against));
    let off = "warning: 1 of 1 normals lie more than 10 degrees off their facet (the first is that of facet 0): \
               computed from the corners";
    assert_eq!(read_normal("1 0 0.5"), computed(off));
    let unreadable = "2: warning: 1 facet has an invalid normal: computed from the corners";
    for text in ["", "0 0", "a b c"] {
        let (normal, _, messages) = read_normal(text);
        assert_eq!((normal, messages[0].as_str()), (Z, unreadable), "{text:?}");
        assert_eq!(messages.last().unwrap(), none);
    }
    let thin = one_facet("0 0 0").replace("vertex 0 1 0", "vertex 2 0 0");
    let model = read(thin.as_bytes()).unwrap();
    assert_eq!(messages_of(&model), ["warning: 1 facet has neither an area nor a normal (the first is facet 0)"]);
    assert_eq!(model.mesh.normals, [O; 3]);
}

/// 15 bits: red 31, green 0, blue 16 of 31. sRGB 16/31 is 0.2293 linear light (IEC 61966-2-1 on paper).
#[test]
fn two_dialects_of_colors() {
    let [first, second, ..] = TETRAHEDRON;
    let blue = 0.229_275;
    let close = |a: [f32; 4], b: [f32; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
    let viscam = 0x8000 | 31 << 10 | 16;
    let model = quiet(&binary(b"", &[(first, viscam), (second, 0)], false));
    let color_of = |model: &Model, t: usize| model.mesh.colors[model.mesh.triangle(t)[0]];
    assert!(close(color_of(&model, 0), [1.0, 0.0, blue, 1.0]), "{:?}", model.mesh.colors);
    assert_eq!(color_of(&model, 1), [1.0; 4]);
    assert_eq!(model.materials[0].diffuse, [1.0; 3]);
    assert!(model.contents.contains(&("facet with a color".to_owned(), 1)));

    // Materialise Magics: the other way round, and bit 15 is the header's colour.
    let header = b"COLOR=\xFF\x00\x00\x80,MATERIAL=...";
    let magics = 16 << 10 | 31;
    let model = quiet(&binary(header, &[(first, magics), (second, 0x8000)], false));
    assert!(close(color_of(&model, 0), [1.0, 0.0, blue, 1.0]), "{:?}", model.mesh.colors);
    assert_eq!(color_of(&model, 1), [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(model.materials[0].opacity, 128.0 / 255.0);

    // No facet has a colour of its own: the material has the header's.
    for attribute in [0x8000, 0] {
        let model = quiet(&binary(header, &[(first, attribute), (second, attribute)], false));
        assert_eq!((model.mesh.colors.len(), model.materials[0].diffuse), (0, [1.0, 0.0, 0.0]));
        assert_eq!(model.materials[0].sources[0].written, "COLOR=[255, 0, 0, 128]");
    }
    let model = read(&binary(b"COLOR=\xFF\xFF\xFF\x00", &[(first, 0)], false)).unwrap();
    assert_eq!(messages_of(&model), ["note: the color of the header is invisible (its alpha is 0): treated as opaque"]);
    assert_eq!(model.materials[0].opacity, 1.0);
    let model = read(&binary(b"", &[(first, 0), (second, 7)], false)).unwrap();
    assert_eq!(
        messages_of(&model),
        ["note: 1 facet has attribute bytes that are not a color (the first is facet 1): ignored"]
    );
}

#[test]
fn sizes_that_do_not_fit() {
    let bytes = binary_tetrahedron(b"solid");
    assert_eq!(bytes.len(), 284);
    let more = read(&[&bytes[..], b"abc"].concat()).unwrap();
    assert_eq!(messages_of(&more), ["warning: 3 bytes after the last facet (from byte 284) are ignored"]);
    assert_eq!(more.mesh.triangle_count(), 4);
    let expected = "the file declares 4 facets but contains only 3: it is cut off (or not an STL file), get it again";
    assert_eq!(error(&bytes[..283]), expected);
    assert_eq!(error(&bytes[..284 - 50]), expected);
    let expected = "the file declares 4 facets but contains only 1: it is cut off (or not an STL file), get it again";
    assert_eq!(error(&bytes[..140]), expected);
    let mut uncounted = bytes.clone();
    uncounted[80..84].fill(0);
    let model = read(&uncounted).unwrap();
    assert_eq!(messages_of(&model), ["warning: the file declares no facets but contains 4: they are read"]);
    assert_eq!(model.mesh.triangle_count(), 4);
    let swapped = binary(b"", &TETRAHEDRON.map(|facet| (facet, 0)), true);
    let model = read(&swapped).unwrap();
    assert_eq!(
        messages_of(&model),
        ["warning: the numbers are big-endian, contrary to the specification: read as such"]
    );
    assert_eq!(triangles(&model.mesh), TETRAHEDRON.map(|[_, a, b, c]| [a, b, c]));
}

#[test]
fn oddities_are_survived_and_reported() {
    let facet = one_facet("0 0 1");
    let two = |more: &str| facet.replace("endsolid\n", more);
    let second =
        |corners: &str| two(&format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid\n"));
    let cases: &[(String, &str)] = &[
        (two(""), "9: warning: the last solid has no endsolid: the file may be cut off"),
        (
            two("facet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
            "9: warning: the file ends inside a facet, which is left out: the file is cut off, or damaged",
        ),
        (second("vertex 0 0 0\nvertex 1 0 0\n"), "9: warning: 1 facet has fewer than 3 corners: left out"),
        (
            second("vertex 0 0 0\nvertex 1 0 0\nvertex nan 1 0\n"),
            "9: warning: 1 facet has a corner that is not finite (the first is that of line 9): left out",
        ),
        (
            second("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1e99 0\n"),
            "9: warning: 1 facet has a corner that is not finite (the first is that of line 9): left out",
        ),
        (
            facet.replace("outer", "colour 1 0 0\nouter"),
            "3:1: warning: unknown statement \"colour\": the rest of its line is ignored",
        ),
    ];
    for (text, expected) in cases {
        let model = read(text.as_bytes()).unwrap_or_else(|e| panic!("{text}\n{e}"));
        assert_eq!(messages_of(&model), [*expected], "{text}");
        assert_eq!(model.mesh.triangle_count(), 1, "{text}");
    }
    let quad = read(second("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n").as_bytes()).unwrap();
    assert_eq!(messages_of(&quad), ["9: warning: 1 facet has more than 3 corners: triangulated"]);
    assert_eq!(quad.mesh.triangle_count(), 3);
    let unended = read(two(&facet.replace("solid\n", "")).replacen("endfacet\n", "", 1).as_bytes()).unwrap();
    assert_eq!(messages_of(&unended)[0], "2: warning: 1 facet has no endfacet");
    assert_eq!(unended.mesh.triangle_count(), 2);
    let mut bytes = binary_tetrahedron(b"");
    bytes[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let model = read(&bytes).unwrap();
    assert_eq!(
        messages_of(&model),
        ["warning: 1 facet has a corner that is not finite (the first is facet 0): left out"]
    );
    assert_eq!(model.mesh.triangle_count(), 3);
}

#[test]
fn errors_name_the_problem_and_its_place() {
    let facet = one_facet("0 0 1");
    let few = "this is not an STL file: it does not begin with `solid`, and 5 bytes are too few for a binary one (84 at least)";
    let cases: &[(String, &str)] = &[
        ("hello".into(), few),
        ("solid x\nendsolid x\n".into(), "contains no facets: nothing to draw"),
        (
            facet.replace("vertex 1 0 0", "vertex 1 0,5 0"),
            "5:10: vertex has the coordinate \"0,5\", which is not a number: export the model again",
        ),
        (facet.replace("vertex 1 0 0", "vertex 1 0"), "5:11: vertex has 2 of 3 coordinates: export the model again"),
        (
            facet.replace("vertex 1 0 0\n", ""),
            "contains no facets: nothing to draw; 1 facet has fewer than 3 corners: left out",
        ),
        (
            facet.replace("vertex 1 0 0", "vertex nan 0 0"),
            "contains no facets: nothing to draw; 1 facet has a corner that is not finite (the first is that of line 2): \
             left out",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(error(text.as_bytes()), *expected, "{text}");
    }
    assert_eq!(error(&binary(b"", &[], false)), "contains no facets: nothing to draw");
}

#[test]
fn limits_are_honoured() {
    let files = [ascii_tetrahedron().into_bytes(), binary_tetrahedron(b"")];
    let messages =
        ["contains more than 3 facets, which is the limit", "contains 4 facets, more than 3, which is the limit"];
    for (file, message) in files.iter().zip(messages) {
        let with = |limits: Limits| stl::read(file, &mut NoSidecars, &limits).map_err(|e| e.to_string());
        let limits = Limits { max_vertices: 12, max_triangles: 4, ..Limits::default() };
        assert!(with(limits).is_ok());
        let few_vertices = Limits { max_vertices: 11, ..limits };
        assert_eq!(with(few_vertices).unwrap_err(), "needs more than 11 vertices, which is the limit");
        let few_triangles = Limits { max_triangles: 3, ..limits };
        assert_eq!(with(few_triangles).unwrap_err(), message);
    }
}

fn check_consistent(model: &Model) {
    let mesh = &model.mesh;
    let vertices = mesh.positions.len();
    assert!(mesh.indices.len().is_multiple_of(3) && mesh.indices.iter().all(|&i| (i as usize) < vertices));
    assert!(mesh.normals.len() == vertices && (mesh.colors.is_empty() || mesh.colors.len() == vertices));
    assert!(mesh.positions.iter().chain(&mesh.normals).flatten().all(|c| c.is_finite()));
    assert_eq!(mesh.parts.iter().map(|part| part.triangle_count).sum::<usize>(), mesh.triangle_count());
}

#[test]
fn every_prefix_and_every_changed_byte_is_survived() {
    let header = b"COLOR=\xFF\x00\x00\x80";
    let colored = binary(header, &TETRAHEDRON.map(|facet| (facet, 31)), false);
    let (mut read_well, mut tried) = (0, 0);
    for file in [ascii_tetrahedron().into_bytes(), binary_tetrahedron(b"solid"), colored] {
        for length in 0..=file.len() {
            read(&file[..length]).iter().for_each(check_consistent);
            tried += 1;
        }
        for at in 0..file.len() {
            for byte in *b"\n 09-.ev#\0\x7F\xFF" {
                let mut changed = file.clone();
                changed[at] = byte;
                let result = read(&changed);
                result.iter().for_each(check_consistent);
                (read_well, tried) = (read_well + usize::from(result.is_ok()), tried + 1);
            }
        }
    }
    assert!(tried > 10_000 && read_well > 8000, "{read_well} of {tried}");
}
