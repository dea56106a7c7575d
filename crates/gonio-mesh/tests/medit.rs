//! Medit: small texts with their expected results, and binary files made here number by number.

#![allow(clippy::unwrap_used, missing_docs)]

#[path = "collada/summary.rs"]
mod summary;

use gonio_fixtures::assert_as_expected;
use gonio_mesh::{Limits, Model, NoSidecars, ReadError, medit};
use summary::{cases, check, files};

fn read(bytes: &[u8]) -> Result<Model, ReadError> {
    medit::read(bytes, &mut NoSidecars, &Limits::default())
}

fn texts() -> Vec<(String, Vec<u8>)> {
    files(cases("medit.txt", "mesh", 41))
}

#[test]
fn every_file_has_its_expected_result() {
    assert_as_expected(cases("medit.txt", "mesh", 41), |case| summary::summary(&read(&case.bytes)));
}

#[test]
fn every_prefix_is_survived() {
    let mut tried = 0;
    for bytes in texts().into_iter().map(|(_, bytes)| bytes).chain([square(2, false), square(4, true)]) {
        for length in 0..=bytes.len() {
            if let Ok(model) = read(&bytes[..length]) {
                check(&model);
            }
            tried += 1;
        }
    }
    assert!(tried > 4000, "{tried}");
}

#[test]
fn every_changed_byte_is_survived() {
    let (mut read_well, mut refused) = (0, 0);
    for bytes in texts().into_iter().map(|(_, bytes)| bytes).chain([square(1, false), square(3, true)]) {
        for at in 0..bytes.len() {
            for byte in *b"\n#-9 e.\x00\x01\x7F\xFF" {
                let mut changed = bytes.clone();
                changed[at] = byte;
                match read(&changed) {
                    Ok(model) => {
                        check(&model);
                        read_well += 1;
                    }
                    Err(_) => refused += 1,
                }
            }
        }
    }
    assert!(read_well > 5000 && refused > 5000, "{read_well} {refused}");
}

/// A binary file in the making.
struct Writer {
    bytes: Vec<u8>,
    version: u32,
    big_endian: bool,
}

impl Writer {
    fn new(version: u32, big_endian: bool) -> Self {
        let mut writer = Writer { bytes: Vec::new(), version, big_endian };
        writer.word(1);
        writer.word(version as i32);
        writer
    }

    fn put(&mut self, mut little_endian: Vec<u8>) {
        if self.big_endian {
            little_endian.reverse();
        }
        self.bytes.extend(little_endian);
    }

    fn word(&mut self, value: i32) {
        self.put(value.to_le_bytes().to_vec());
    }

    fn integer(&mut self, value: i64) {
        if self.version == 4 { self.put(value.to_le_bytes().to_vec()) } else { self.word(value as i32) }
    }

    fn position(&mut self, value: i64) {
        if self.version >= 3 { self.put(value.to_le_bytes().to_vec()) } else { self.word(value as i32) }
    }

    fn real(&mut self, value: f64) {
        if self.version == 1 {
            self.put((value as f32).to_le_bytes().to_vec());
        } else {
            self.put(value.to_le_bytes().to_vec());
        }
    }

    /// A section: code, where the next begins, and what `fill` writes.
    fn section(&mut self, code: i32, fill: impl FnOnce(&mut Self)) {
        self.word(code);
        let place = self.bytes.len();
        self.position(0);
        fill(self);
        let end = self.bytes.len() as i64;
        let mut next = Writer { bytes: Vec::new(), ..*self };
        next.position(end);
        self.bytes[place..place + next.bytes.len()].copy_from_slice(&next.bytes);
    }

    fn rows(&mut self, code: i32, rows: &[&[i64]]) {
        self.section(code, |writer| {
            writer.integer(rows.len() as i64);
            rows.iter().copied().flatten().for_each(|&value| writer.integer(value));
        });
    }

    fn dimension(&mut self, dimension: i32) {
        // Always 32 bits.
        self.section(3, |writer| writer.word(dimension));
    }

    fn vertices(&mut self, vertices: &[[f64; 3]], dimension: usize) {
        self.section(4, |writer| {
            writer.integer(vertices.len() as i64);
            for vertex in vertices {
                vertex[..dimension].iter().for_each(|&x| writer.real(x));
                writer.integer(0);
            }
        });
    }

    fn end(mut self) -> Vec<u8> {
        self.word(54);
        self.position(0);
        self.bytes
    }
}

const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5], [0.0, 1.0, 0.0]];

/// Two triangles of references 5 and 6, normals of two corners, edges, and a keyword that no one knows.
fn square(version: u32, big_endian: bool) -> Vec<u8> {
    let mut writer = Writer::new(version, big_endian);
    writer.dimension(3);
    writer.vertices(&CORNERS, 3);
    writer.rows(5, &[&[1, 2, 0]]);
    writer.rows(6, &[&[1, 2, 3, 5], &[1, 3, 4, 6]]);
    writer.section(60, |writer| {
        writer.integer(1);
        [0.0, 3.0, 4.0].into_iter().for_each(|x| writer.real(x));
    });
    writer.rows(20, &[&[1, 1], &[4, 1]]);
    writer.rows(999, &[&[1, 2, 3]]);
    writer.end()
}

#[test]
fn all_versions_and_byte_orders_are_alike() {
    let expected = "contents 4 Vertices | 1 Edges | 2 Triangles | 1 Normals | 2 NormalAtVertices\n\
        positions 0 0 0 | 1 0 0 | 1 1 0.5 | 0 1 0\n\
        normals 0 0.6 0.8 | 0 0 0 | 0 0 0 | 0 0.6 0.8\n\
        triangles 0 1 2 | 0 2 3\n\
        part \"\": \"ref 5\" 0+1\n\
        part \"\": \"ref 6\" 1+1\n";
    for version in 1..=4 {
        for big_endian in [false, true] {
            let found = summary::summary(&read(&square(version, big_endian)));
            let (mesh, messages): (Vec<&str>, Vec<&str>) = found.lines().partition(|line| !line.contains("byte"));
            assert_eq!(mesh.join("\n") + "\n", expected, "version {version}, {big_endian}");
            assert_eq!(messages.len(), 2, "{messages:?}");
        }
    }
    // Header 8; Dimension 8 + 4; Vertices 8 + 4 + 4 * 16: Edges begin at byte 97 of version 1, from 1.
    let model = read(&square(1, true)).unwrap();
    let messages: Vec<String> = model.diagnostics.iter().map(ToString::to_string).collect();
    // ... and 8 + 4 + 12; Triangles 8 + 4 + 32; Normals 8 + 4 + 12; NormalAtVertices 8 + 4 + 16.
    let expected = ["warning: unknown keyword 999: skipped (at byte 217)", "note: Edges are not drawn (at byte 97)"];
    assert_eq!(messages, expected);
}

#[test]
fn binary_files_of_two_dimensions_lie_flat() {
    let mut writer = Writer::new(2, false);
    writer.dimension(2);
    writer.vertices(&CORNERS, 2);
    writer.rows(7, &[&[1, 2, 3, 4, 0]]);
    let model = read(&writer.end()).unwrap();
    assert_eq!(model.mesh.positions[2], [1.0, 1.0, 0.0]);
    assert_eq!(model.mesh.indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(model.diagnostics, []);
}

#[test]
fn sections_may_come_in_any_order_and_end_without_end() {
    let mut writer = Writer::new(3, true);
    writer.rows(6, &[&[1, 2, 3, 0]]);
    writer.vertices(&CORNERS, 3);
    writer.dimension(3);
    let model = read(&writer.bytes).unwrap();
    assert_eq!(model.mesh.indices, [0, 1, 2]);
    let expected =
        format!("warning: there is no End at the end: is the file cut off? (at byte {})", writer.bytes.len() + 1);
    assert_eq!(model.diagnostics.iter().map(ToString::to_string).collect::<Vec<_>>(), [expected]);
}

#[test]
fn broken_binary_files_are_refused() {
    let refused = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
    let good = square(2, false);
    let with = |at: usize, value: i32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        refused(&bytes)
    };
    assert_eq!(with(4, 7), "the version of this binary Medit file is 7: only 1 to 4 are known");
    // The position in the section of Dimension, which begins at byte 9: back to itself, and beyond the end.
    let back =
        "the section after Dimension is declared to begin at byte 8, which is before it or beyond the end (at byte 9)";
    assert_eq!(with(12, 8), back);
    let beyond = with(12, i32::MAX);
    assert!(beyond.starts_with("the section after Dimension is declared to begin at byte 2147483647"), "{beyond}");
    assert_eq!(with(16, 4), "Dimension is 4: only 2 and 3 can be drawn (at byte 17)");
    // The count of Vertices.
    assert_eq!(with(28, -1), "invalid count of Vertices: -1 (at byte 29)");
    assert_eq!(
        with(28, i32::MAX),
        "declares 2147483647 Vertices, more than the rest of the file can contain (at byte 33)"
    );
    assert_eq!(with(28, 5), "Vertices ends in the middle of a number: is the file cut off? (at byte 145)");
    assert_eq!(
        refused(&good[..30]),
        "the section after Vertices is declared to begin at byte 144, which is before it or beyond the end (at byte 21)"
    );
    let mut infinite = good.clone();
    infinite[32..40].copy_from_slice(&f64::INFINITY.to_le_bytes());
    assert_eq!(refused(&infinite), "inf of Vertices is not a finite number (at byte 33)");
    assert_eq!(
        refused(&good[..8]),
        "contains no faces (no known keyword): nothing to draw; there is no End at the end: is the file cut off? (at byte 9)"
    );
}

#[test]
fn bad_indices_of_binary_files_are_reported_with_their_byte() {
    let mut writer = Writer::new(1, false);
    writer.dimension(3);
    writer.vertices(&CORNERS, 3);
    let rows: Vec<&[i64]> =
        std::iter::once(&[1, 2, 3, 0][..]).chain(std::iter::repeat_n(&[1, 2, 9, 0][..], 22)).collect();
    writer.rows(6, &rows);
    let model = read(&writer.end()).unwrap();
    assert_eq!(model.mesh.indices, [0, 1, 2]);
    assert_eq!(model.diagnostics.len(), 21);
    // Header 8, Dimension 12, Vertices 76, then 12 and the first row.
    let first = "warning: an element of Triangles refers to the vertex 9, but vertices are numbered 1 to 4: it is left out (at byte 125)";
    assert_eq!(model.diagnostics[0].to_string(), first);
    assert_eq!(model.diagnostics[20].message, "and 2 more: elements with an index out of range");
}

#[test]
fn references_have_colours_of_their_own() {
    let mut writer = Writer::new(2, false);
    writer.dimension(3);
    writer.vertices(&CORNERS, 3);
    writer.rows(6, &[&[1, 2, 3, 0], &[1, 2, 3, 1], &[1, 2, 3, 2], &[1, 2, 3, 1]]);
    let model = read(&writer.end()).unwrap();
    let counts: Vec<usize> = model.mesh.parts.iter().map(|part| part.triangle_count).collect();
    assert_eq!(counts, [1, 2, 1]);
    assert_eq!(model.materials[0].diffuse, gonio_mesh::Material::default().diffuse);
    // 1: hue 0.618034 of the circle, 3.7082 of 6: blue is full, red least, green 0.7082 of the way down from blue.
    let linear = |encoded: f64| (((encoded + 0.055) / 1.055).powf(2.4)) as f32;
    let (value, saturation) = (0.85, 0.55);
    let expected = [value * (1.0 - saturation), value * (1.0 - saturation * 0.708_203_9), value].map(linear);
    for (found, expected) in model.materials[1].diffuse.iter().zip(expected) {
        // Rounding to f32.
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    assert_ne!(model.materials[1].diffuse, model.materials[2].diffuse);
}

#[test]
fn too_many_references_are_one_part() {
    let mut writer = Writer::new(2, false);
    writer.dimension(3);
    writer.vertices(&CORNERS, 3);
    let rows: Vec<[i64; 4]> = (0..1025).map(|reference| [1, 2, 3, reference]).collect();
    let rows: Vec<&[i64]> = rows.iter().map(|row| row.as_slice()).collect();
    writer.rows(6, &rows);
    let bytes = writer.end();
    let model = read(&bytes).unwrap();
    assert_eq!((model.mesh.parts.len(), model.materials.len(), model.mesh.triangle_count()), (1, 1, 1025));
    let expected = "warning: there are 1025 different references, more than 1024: merged into one part";
    assert_eq!(model.diagnostics[0].to_string(), expected);
}

#[test]
fn limits_are_kept() {
    let bytes = square(2, false);
    let message = |limits| medit::read(&bytes, &mut NoSidecars, &limits).unwrap_err().message;
    let few_triangles = Limits { max_triangles: 1, ..Limits::default() };
    assert_eq!(message(few_triangles), "contains more than 1 triangles, which is the limit");
    let few_vertices = Limits { max_vertices: 3, ..Limits::default() };
    assert_eq!(message(few_vertices), "has 4 vertices, more than 3, which is the limit (at byte 33)");
    let enough = Limits { max_vertices: 4, max_triangles: 2, ..Limits::default() };
    assert!(medit::read(&bytes, &mut NoSidecars, &enough).is_ok());
}

/// A count in a file makes no one allocate more than the file could hold.
#[test]
fn counts_are_not_believed() {
    let text = format!("MeshVersionFormatted 4 Dimension 3 Vertices {} 0 0 0 0", i64::MAX);
    assert!(read(text.as_bytes()).unwrap_err().message.contains("more than the rest of the file can contain"));
    let text = format!("MeshVersionFormatted 4 Dimension 3 Hexahedra {} 0 0 0 0", i64::MAX / 9);
    assert!(read(text.as_bytes()).unwrap_err().message.contains("more than the rest of the file can contain"));
}
