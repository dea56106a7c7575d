//! PLY: small files, written by hand from the definition of the format, each with its expected result.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::{Limits, Mesh, Model, NoSidecars, NormalSource, normals, ply, topology};

fn read(bytes: &[u8]) -> Result<Model, String> {
    ply::read(bytes, &mut NoSidecars, &Limits::default()).map_err(|error| error.to_string())
}

/// A model that must be read without a message.
fn quiet(bytes: &[u8]) -> Model {
    let model = read(bytes).unwrap();
    assert_eq!(messages_of(&model), [""; 0]);
    model
}

fn messages_of(model: &Model) -> Vec<String> {
    model.diagnostics.iter().map(ToString::to_string).collect()
}

fn error(bytes: &[u8]) -> String {
    read(bytes).map(|model| panic!("was read: {model:?}")).unwrap_err()
}

/// The positions of the corners of each triangle.
fn triangles(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    (0..mesh.triangle_count()).map(|t| mesh.triangle_positions(t).map(Into::into)).collect()
}

const HEAD: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const FACE: &str = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const SQUARE: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const POINTS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// A square of four vertices with more in the header and in each of the lines.
fn square(more_header: &str, face_header: &str, lines: &str) -> String {
    format!("{HEAD}{more_header}element face 1\n{face_header}end_header\n{lines}")
}

fn ascii_square() -> String {
    format!("{HEAD}{FACE}{SQUARE}4 0 1 2 3\n")
}

/// The same square in both binary encodings, x y z as `float`, and a `double` and a list to step over in between.
fn binary_square(is_big_endian: bool, end: &str) -> Vec<u8> {
    let order = if is_big_endian { "big" } else { "little" };
    let header = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment numbers may begin with a line feed\nelement vertex 4\n\
         property list uint8 int16 skipped\nproperty float32 x\nproperty float y\nproperty double weight\n\
         property float z\nelement face 1\nproperty list ushort uint32 vertex_index\nend_header\n"
    );
    let mut bytes = header.replace('\n', end).into_bytes();
    macro_rules! put {
        ($value:expr) => {
            bytes.extend(if is_big_endian { $value.to_be_bytes().to_vec() } else { $value.to_le_bytes().to_vec() })
        };
    }
    for (i, [x, y, z]) in POINTS.into_iter().enumerate() {
        // The length of the first list is 10, a line feed.
        let length = if i == 0 { 10 } else { 0 };
        put!(length as u8);
        (0..length).for_each(|n| put!(n as i16));
        put!(x);
        put!(y);
        put!(-1.5_f64);
        put!(z);
    }
    put!(4_u16);
    (0..4_u32).for_each(|index| put!(index));
    bytes
}

#[test]
fn a_square_in_every_encoding() {
    let expected = [[POINTS[0], POINTS[1], POINTS[2]], [POINTS[0], POINTS[2], POINTS[3]]];
    let model = quiet(ascii_square().as_bytes());
    assert_eq!(model.mesh.positions, POINTS);
    assert_eq!(model.mesh.indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(model.mesh.normal_source, NormalSource::None);
    assert_eq!((model.mesh.parts.len(), model.mesh.parts[0].triangle_count, model.materials.len()), (1, 2, 1));
    let contents: Vec<(&str, u64)> = model.contents.iter().map(|(what, count)| (what.as_str(), *count)).collect();
    assert_eq!(contents, [("vertex", 4), ("face", 1), ("polygons of 4 corners", 1)]);
    for is_big_endian in [false, true] {
        for end in ["\n", "\r\n", "\r"] {
            let model = read(&binary_square(is_big_endian, end)).unwrap();
            assert_eq!(triangles(&model.mesh), expected, "{is_big_endian} {end:?}");
            assert_eq!(messages_of(&model), ["note: skipped: vertex.skipped, vertex.weight"]);
            assert!(model.contents.contains(&("vertex.weight (skipped)".to_owned(), 4)));
        }
    }
}

/// -3 in each integer type that can, 3 in the others, and 0.5 in both float types.
#[test]
fn every_type_by_both_spellings() {
    let types: [(&str, &str, &[u8], f32); 8] = [
        ("char", "int8", &[0xFD], -3.0),
        ("uchar", "uint8", &[3], 3.0),
        ("short", "int16", &[0xFF, 0xFD], -3.0),
        ("ushort", "uint16", &[0, 3], 3.0),
        ("int", "int32", &[0xFF, 0xFF, 0xFF, 0xFD], -3.0),
        ("uint", "uint32", &[0, 0, 0, 3], 3.0),
        ("float", "float32", &[0x3F, 0, 0, 0], 0.5),
        ("double", "float64", &[0x3F, 0xE0, 0, 0, 0, 0, 0, 0], 0.5),
    ];
    for (old, new, number, value) in types {
        for name in [old, new] {
            for is_big_endian in [true, false] {
                let order = if is_big_endian { "big" } else { "little" };
                let mut bytes = format!(
                    "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty {name} x\nproperty uchar y\n\
                     property uchar z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n"
                )
                .into_bytes();
                let bytes_of_x = if is_big_endian { number.to_vec() } else { number.iter().rev().copied().collect() };
                for yz in [[0, 0], [1, 0], [0, 1]] {
                    bytes.extend(bytes_of_x.iter().chain(&yz));
                }
                bytes.extend([3, 0, 1, 2]);
                let mesh = quiet(&bytes).mesh;
                assert_eq!(mesh.positions, [[value, 0.0, 0.0], [value, 1.0, 0.0], [value, 0.0, 1.0]], "{name} {order}");
            }
            let text = format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty {name} x\nproperty float y\nproperty float z\n\
                 element face 1\nproperty list {} {} vertex_indices\nend_header\n{value} 0 0\n{value} 1 0\n{value} 0 1\n\
                 3 0 1 2",
                if name.starts_with(['f', 'd']) { "uchar" } else { name },
                name,
            );
            assert_eq!(quiet(text.as_bytes()).mesh.positions[0], [value, 0.0, 0.0], "{name}");
        }
    }
}

#[test]
fn elements_and_properties_in_any_order() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty float quality\nproperty list uchar int vertex_index\n\
                element edge 2\nproperty int vertex1\nproperty int vertex2\nelement vertex 3\nproperty float nz\n\
                property float z\nproperty float nx\nproperty float x\nproperty float y\nproperty float ny\nend_header\n\
                0.5 3 0 1 2\n0 1\n1 2\n1 0 0 0 0 0\n2 0 0 1 0 0\n0 0 0 0 1 5\n";
    let model = read(text.as_bytes()).unwrap();
    assert_eq!(messages_of(&model), ["note: skipped: face.quality, edge"]);
    assert_eq!(model.mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(model.mesh.normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    assert_eq!(model.mesh.normal_source, NormalSource::File);
    assert!(model.contents.contains(&("edge (skipped)".to_owned(), 2)));
}

#[test]
fn texture_coordinates_by_three_pairs_of_names() {
    for names in [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]] {
        let header = format!("property float {}\nproperty float {}\n", names[0], names[1]);
        let lines = "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 0.75\n0 1 0 0 nan\n4 0 1 2 3\n";
        let text = square(&header, "property list uchar int vertex_indices\n", lines);
        let model = read(text.as_bytes()).unwrap();
        assert_eq!(model.mesh.tex_coords, [[0.0, 0.0], [1.0, 0.0], [1.0, 0.75], [0.0, 0.0]]);
        let expected = "15: warning: 1 vertex has texture coordinates that are not finite (the first is vertex 3): \
                        using (0, 0)";
        assert_eq!(messages_of(&model), [expected]);
    }
}

/// sRGB 0.5 is 0.21404114 linear light; of bytes, 188 is 0.50288646 (both by IEC 61966-2-1 on paper).
#[test]
fn colors_of_vertices_are_srgb() {
    let close = |a: [f32; 4], b: [f32; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    let types = [("uchar", "188 0 255 51", 0.2), ("ushort", "48316 0 65535 13107", 0.2), ("int", "188 0 255 255", 1.0)];
    for (kind, white, alpha) in types {
        let header: String = ["red", "green", "blue", "alpha"].map(|c| format!("property {kind} {c}\n")).concat();
        let lines: String = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"].map(|v| format!("{v} {white}\n")).concat();
        let text = square(&header, "property list uchar int vertex_indices\n", &(lines + "4 0 1 2 3\n"));
        let model = quiet(text.as_bytes());
        assert!(close(model.mesh.colors[3], [0.502_886_5, 0.0, 1.0, alpha]), "{kind}: {:?}", model.mesh.colors);
        // Beside colours the surface is white: they are what it looks like.
        assert_eq!(model.materials[0].diffuse, [1.0; 3]);
    }
    let of_floats = |red: &str| {
        let header = "property float red\nproperty float green\nproperty float blue\n";
        let lines = format!("0 0 0 {red} 0 1\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 0 0 0\n4 0 1 2 3\n");
        read(square(header, "property list uchar int vertex_indices\n", &lines).as_bytes()).unwrap()
    };
    let model = of_floats("0.5");
    assert!(close(model.mesh.colors[0], [0.214_041_14, 0.0, 1.0, 1.0]), "{:?}", model.mesh.colors);
    assert_eq!(messages_of(&model), [""; 0]);
    let model = of_floats("188");
    assert_eq!(messages_of(&model), ["note: vertex colors reach 188: treated as 0 to 255"]);
    assert!((model.mesh.colors[0][0] - 0.502_886_5).abs() < 1e-6);
    let expected = "warning: 1 vertex has a color outside 0 to 1 (the first is vertex 0): clamped";
    for red in ["-0.5", "1e6"] {
        assert_eq!(messages_of(&of_floats(red)), [expected], "{red}");
    }
}

/// Colours, normals and texture coordinates are optional, so values that are not finite are replaced with a warning.
#[test]
fn numbers_that_are_not_finite_are_reported_by_kind() {
    for number in ["nan", "-inf", "1e99"] {
        let vertices = |properties: &str, first: &str, others: &str| {
            let header: String = properties.split(' ').map(|name| format!("property float {name}\n")).collect();
            let lines = format!("0 0 0 {first}\n1 0 0 {others}\n1 1 0 {others}\n0 1 0 {others}\n4 0 1 2 3\n");
            read(square(&header, "property list uchar int vertex_indices\n", &lines).as_bytes()).unwrap()
        };
        let line = 13;
        let model = vertices("red green blue", &format!("1 {number} 0"), "0 0 1");
        let what = "1 vertex has a color that is not finite (the first is vertex 0): using 0 instead";
        assert_eq!(messages_of(&model), [format!("{line}: warning: {what}")]);
        assert_eq!(model.mesh.colors[..2], [[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]]);
        let model = vertices("nx ny nz", &format!("0 0 {number}"), "0 0 2");
        let what = "1 vertex has a normal that is not finite (the first is vertex 0): ignored";
        assert_eq!(messages_of(&model), [format!("{line}: warning: {what}")]);
        assert_eq!(model.mesh.normals[..2], [[0.0; 3], [0.0, 0.0, 1.0]]);
        let faces =
            "property list uchar int vertex_indices\nproperty float red\nproperty float green\nproperty float blue\n";
        let lines = format!("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 {number} 1 0\n");
        let model = read(square("", faces, &lines).as_bytes()).unwrap();
        let what = "1 face has a color that is not finite (the first is face 0): using 0 instead";
        assert_eq!(messages_of(&model).len(), 1);
        assert!(messages_of(&model)[0].ends_with(what), "{:?}", messages_of(&model));
        assert_eq!(model.mesh.colors[0], [0.0, 1.0, 0.0, 1.0]);
    }
}

/// MeshLab's texture coordinates of corners, with two textures.
#[test]
fn wedges_and_textures() {
    let text = "ply\nformat ascii 1.0\ncomment TextureFile wood grain.png\ncomment TextureFile b.png\nelement vertex 4\n\
                property float x\nproperty float y\nproperty float z\nelement face 2\n\
                property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n\
                end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 0.5 0.5 0 1 0\n";
    let model = quiet(text.as_bytes());
    // Vertex 0 has one pair for both faces, vertex 2 two.
    assert_eq!(model.mesh.positions.len(), 5);
    assert_eq!(model.mesh.indices, [0, 1, 2, 0, 3, 4]);
    assert_eq!(model.mesh.tex_coords, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.5], [0.0, 1.0]]);
    let parts: Vec<_> = model.mesh.parts.iter().map(|p| (p.material, p.first_triangle, p.triangle_count)).collect();
    assert_eq!(parts, [(1, 0, 1), (0, 1, 1)]);
    let maps: Vec<_> = model.materials.iter().map(|m| m.diffuse_map.as_ref().unwrap()).collect();
    assert_eq!(
        [(maps[0].path.as_str(), maps[0].line), (maps[1].path.as_str(), maps[1].line)],
        [("wood grain.png", Some(3)), ("b.png", Some(4))]
    );
    assert_eq!(model.materials[0].diffuse, [1.0; 3]);
    assert_eq!(model.materials[0].sources[1].written, "comment TextureFile wood grain.png");
    let bare = quiet(text.replace("1 1 1\n", "1 1 -1\n").as_bytes());
    assert_eq!((bare.materials.len(), bare.mesh.parts[0].material), (3, 2));
    assert_eq!(bare.materials[2].diffuse_map, None);
    let odd = text.replace("3 0 1 2 6 0 0 1 0 1 1 1", "3 0 1 2 4 0 0 1 0 7");
    let expected = [
        "18: warning: 1 face lacks two finite texture coordinates for each corner (the first is face 0): \
         using (0, 0)",
        "warning: 1 face has a texnumber without a comment TextureFile (the first is face 0): using the first \
         texture",
    ];
    assert_eq!(messages_of(&read(odd.as_bytes()).unwrap()), expected);
    let without = ascii_square().replace("element vertex", "comment TextureFile a.png\nelement vertex");
    let expected = "3: warning: the file names a texture, but it has no texture coordinates";
    assert_eq!(messages_of(&read(without.as_bytes()).unwrap()), [expected]);
}

#[test]
fn colors_of_faces_part_their_corners() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n\
                property uchar blue\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n";
    let mesh = quiet(text.as_bytes()).mesh;
    assert_eq!(mesh.indices, [0, 1, 2, 3, 4, 5]);
    assert_eq!(mesh.colors, [[[1.0, 0.0, 0.0, 1.0]; 3], [[0.0, 0.0, 1.0, 1.0]; 3]].concat());
}

/// Two strips with -1 between them; every second triangle turns the other way, which the strip itself undoes.
#[test]
fn strips_of_triangles() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
                0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n10 0 1 2 3 4 -1 0 0 1 2\n";
    let model = quiet(text.as_bytes());
    // 0 0 1 has no area; 0 1 2 behind it is the second triangle of its strip.
    assert_eq!(model.mesh.indices, [0, 1, 2, 2, 1, 3, 2, 3, 4, 1, 0, 2]);
    let astray = read(text.replace("3 4 -1", "3 9 -1").as_bytes()).unwrap();
    let expected = [
        "15: warning: 1 polygon points at missing vertices (the first is strip 0 at vertex 9 of 5): left out",
        "note: 1 vertex is unused: left out",
    ];
    assert_eq!(messages_of(&astray), expected);
}

#[test]
fn polygons_are_cut_and_vertices_without_triangles_left_out() {
    let text = "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n\
                9 9 9\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n6 1 2 3 4 5 6\n";
    let model = read(text.as_bytes()).unwrap();
    assert_eq!(messages_of(&model), ["note: 1 vertex is unused: left out"]);
    assert_eq!((model.mesh.positions.len(), model.mesh.triangle_count()), (6, 4));
    assert_eq!(model.mesh.positions[0], [0.0; 3]);
    // The L has an area of 3, whichever way it is cut, if no triangles overlap and none is turned over.
    let area = |[a, b, c]: [glam::Vec3; 3]| 0.5 * (b - a).cross(c - a).z;
    let areas: Vec<f32> = (0..4).map(|t| area(model.mesh.triangle_positions(t))).collect();
    assert!(areas.iter().all(|a| *a > 0.0) && areas.iter().sum::<f32>() == 3.0, "{areas:?}");
}

/// Models of the reader are complete enough for normals and topology.
#[test]
fn a_tetrahedron_is_closed_and_gets_normals() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                element face 4\nproperty list uchar int vertex_indices\nend_header\n\
                0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    let mesh = quiet(text.as_bytes()).mesh;
    assert!(topology::is_closed_outward(&mesh));
    let (averaged, _) = normals::make_averaged(&mesh);
    let third = -1.0 / 3.0_f32.sqrt();
    assert!(averaged.normals[0].iter().all(|c| (c - third).abs() < 1e-6), "{:?}", averaged.normals);
}

#[test]
fn oddities_are_survived_and_reported() {
    let face = |line: &str| format!("{HEAD}{FACE}{SQUARE}{line}\n");
    let two_faces = |lines: &str| face(lines).replace("face 1", "face 2");
    let cases: &[(String, &[&str])] = &[
        // More numbers on a line, an element on two lines, blank lines and blanks.
        (
            face("4 0 1 2 3").replace("1 0 0\n", "1 0 0 7 8\n"),
            &["11: warning: 1 line has more numbers than the header declares (the first is \"7\"): ignored"],
        ),
        (face("4 0 1\n2 3"), &["14: warning: 1 element is not on one line: the next lines are read as the rest"]),
        (face("\n \t4   0\t1 2 3  \r").replace("1 1 0\n", "\r\n1 1 0\r\n"), &[]),
        (face("4 0 1 2 3\n\nmore"), &["16: warning: \"more\" after the last element is ignored"]),
        (
            two_faces("4 0 1 2 3\n3 0 1 4"),
            &["15: warning: 1 polygon points at missing vertices (the first is face 1 at vertex 4 of 4): left out"],
        ),
        (
            two_faces("4 0 1 2 3\n3 0 1 -1"),
            &["15: warning: 1 polygon points at missing vertices (the first is face 1 at vertex -1 of 4): left out"],
        ),
        (
            two_faces("4 0 1 2 3\n2 0 1"),
            &["15: warning: 1 polygon has fewer than 3 corners (the first is face 1): left out"],
        ),
        (
            two_faces("3 0 1 2\n3 0 2 3").replace("0 1 0\n", "0 inf 0\n"),
            &[
                "warning: 1 polygons have corners whose position is not finite: left out",
                "note: 1 vertex is unused: left out",
            ],
        ),
        (
            face("4 0 2 1 3").replace("0 1 0\n", "0 3 0\n"),
            &["warning: 1 polygons cross or touch themselves: their triangles are guessed"],
        ),
        (
            face("4 0 1 2 3").replace("ascii 1.0", "ascii 2.0"),
            &["2: warning: unknown format version \"2.0\": reading it as 1.0"],
        ),
        (
            face("4 0 1 2 3").replace("element vertex", "Element vertex 3\nelement vertex"),
            &["3: warning: unknown header line \"Element\": it is skipped"],
        ),
        (
            face("4 0 1 2 3").replace("element face", "property float nx\nelement face").replace(" 0\n", " 0 1\n"),
            &["note: skipped: vertex.nx"],
        ),
        // Whole numbers where floats would do, floats where whole numbers are meant, a byte order mark, comments.
        (format!("\u{feff}{}", face("4.0 0 1.0 2e0 3")), &[]),
        (face("4 0 1 2 3").replace("element face", "comment x\nobj_info y\nelement face"), &[]),
    ];
    for (text, expected) in cases {
        let model = read(text.as_bytes()).unwrap_or_else(|e| panic!("{text}\n{e}"));
        assert_eq!(messages_of(&model), *expected, "{text}");
    }
    let mut bytes = binary_square(false, "\n");
    let end = bytes.len();
    bytes.extend(b"abc");
    let expected = format!("warning: 3 bytes after the last element (from byte {end}) are ignored");
    assert_eq!(messages_of(&read(&bytes).unwrap())[0], expected);
}

#[test]
fn errors_name_the_problem_and_its_place() {
    let text = ascii_square();
    let with = |old: &str, new: &str| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    };
    let cases = [
        (String::new(), "this is not a PLY file: its first line is not `ply`"),
        ("plyx\n".into(), "this is not a PLY file: its first line is not `ply`"),
        ("ply\nformat ascii 1.0\nend_header\n".into(), "has no vertex element: nothing to draw"),
        (with("format ascii 1.0\n", ""), "8: the header has no format line, such as `format ascii 1.0`"),
        (
            with("ascii", "binary"),
            "2: unknown PLY format \"binary\": expected ascii, binary_little_endian or binary_big_endian",
        ),
        (with("vertex 4", "vertex -4"), "3: invalid element \"element vertex -4\": expected `element NAME COUNT`"),
        (with("vertex 4", "vertex"), "3: invalid element \"element vertex\": expected `element NAME COUNT`"),
        (with("float z", "float32_t z"), "6: the property has the unknown type \"float32_t\": export the file again"),
        (
            with("float z", "list z"),
            "6: invalid property \"property list z\": expected `property TYPE NAME` or `property list TYPE TYPE NAME`",
        ),
        (with("element vertex 4\n", ""), "3: a property precedes the first element"),
        (with("end_header", "comment"), "14: the header has no `end_header` line: the file is cut off, get it again"),
        (with("float z", "float w"), "the vertices have no z: nothing to draw"),
        (with("vertex_indices", "corners"), "the faces have no list vertex_indices (or vertex_index): nothing to draw"),
        (
            with("1 1 0\n", "1 1,5 0\n"),
            "12:3: vertex 2 has \"1,5\" for y, which is not a number: export the file again",
        ),
        (
            with("4 0 1 2 3", "4 0 1 x 3"),
            "14:7: face 0 has \"x\" for vertex_indices, which is not a number: export the file again",
        ),
        (with("4 0 1 2 3", "-4 0 1 2 3"), "14: face 0 has a list vertex_indices of -4 numbers: the file is damaged"),
        (
            with("4 0 1 2 3", "5 0 1 2 3"),
            "the file ends early: its header declares 1 face elements, but only 0 are there; get it again",
        ),
        (with("4 0 1 2 3", "1e18 0 1 2 3"), "14: face 0 has more than 4194304 corners, which is the limit"),
        (
            with("vertex 4", "vertex 18446744073709551615"),
            "the file ends early: its header declares 18446744073709551615 vertex elements, but at most 5 fit in the \
             remaining bytes; get it again",
        ),
        (
            with("face 1", "face 2"),
            "the file ends early: its header declares 2 face elements, but only 1 is there; get it again",
        ),
        (
            with("4 0 1 2 3", "3 0 1 9"),
            "contains no triangles (vertices: 4, faces: 1): nothing to draw; 1 polygon points at missing \
             vertices (the first is face 0 at vertex 9 of 4): left out",
        ),
        (format!("{HEAD}end_header\n{SQUARE}"), "contains 4 points but no faces: nothing to draw"),
        (with("face 1", "face 0"), "contains 4 points but no faces: nothing to draw"),
    ];
    for (text, expected) in cases {
        assert_eq!(error(text.as_bytes()), expected, "{text}");
    }
    let bytes = binary_square(true, "\n");
    let expected = "the file ends early: its header declares 1 face elements, but only 0 are there; get it again";
    assert_eq!(error(&bytes[..bytes.len() - 1]), expected);
    let expected = "the file ends early: its header declares 4 vertex elements, but at most 3 fit in the remaining \
                    bytes; get it again";
    assert_eq!(error(&bytes[..bytes.len() - 18 - 30]), expected);
}

#[test]
fn limits_are_honoured() {
    let with =
        |limits: Limits| ply::read(ascii_square().as_bytes(), &mut NoSidecars, &limits).map_err(|e| e.to_string());
    let limits = Limits { max_vertices: 4, max_triangles: 2, ..Limits::default() };
    assert!(with(limits).is_ok());
    let few_vertices = Limits { max_vertices: 3, ..limits };
    assert_eq!(with(few_vertices).unwrap_err(), "contains 4 vertices, more than 3, which is the limit");
    let few_triangles = Limits { max_triangles: 1, ..limits };
    assert_eq!(with(few_triangles).unwrap_err(), "contains more than 1 triangles, which is the limit");
    // Before it is read.
    let polygon = ascii_square().replace("list uchar", "list uint").replace("\n4 0 1 2 3", "\n4194305 0 1 2 3");
    let message = ply::read(polygon.as_bytes(), &mut NoSidecars, &limits).unwrap_err().to_string();
    assert!(message.ends_with(": face 0 has more than 4194304 corners, which is the limit"), "{message}");
}

fn check_consistent(model: &Model) {
    let mesh = &model.mesh;
    let vertices = mesh.positions.len();
    assert!(mesh.indices.len().is_multiple_of(3) && mesh.indices.iter().all(|&i| (i as usize) < vertices));
    assert!([mesh.normals.len(), mesh.tex_coords.len(), mesh.colors.len()].iter().all(|&n| n == 0 || n == vertices));
    assert!(mesh.positions.iter().flatten().all(|c| c.is_finite()));
    assert_eq!(mesh.parts.iter().map(|part| part.triangle_count).sum::<usize>(), mesh.triangle_count());
    assert!(mesh.parts.iter().all(|part| part.material < model.materials.len()));
}

#[test]
fn every_prefix_and_every_changed_byte_is_survived() {
    let wedges = "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\nproperty float y\n\
                  property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n\
                  property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n\
                  end_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2 6 0 0 1 0 0 1 0\n";
    let strips = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let files = [wedges.into(), strips.into(), binary_square(false, "\n"), binary_square(true, "\r\n")];
    let (mut read_well, mut tried) = (0, 0);
    for file in files {
        for length in 0..=file.len() {
            read(&file[..length]).iter().for_each(check_consistent);
            tried += 1;
        }
        for at in 0..file.len() {
            for byte in *b"\n\r 09-.ex\0\x7F\xFF" {
                let mut changed = file.clone();
                changed[at] = byte;
                let result = read(&changed);
                result.iter().for_each(check_consistent);
                (read_well, tried) = (read_well + usize::from(result.is_ok()), tried + 1);
            }
        }
    }
    assert!(tried > 10_000 && read_well > 1000, "{read_well} of {tried}");
}
