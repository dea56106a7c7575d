//! Tests of internals: neither the number of pieces nor the fast path changes the result.

#![allow(clippy::unwrap_used)]

use super::pieces::Plan;
use super::read_with;
use crate::weld::mix;
use crate::{Limits, Model, NoSidecars, ReadError};
use std::fmt::Write;

fn read(text: &[u8], plan: Plan) -> Result<Model, ReadError> {
    read_with(text, &mut NoSidecars, &Limits::default(), plan)
}

/// Reads a text byte by byte in one piece and in every other way, and compares the results.
fn same_in_every_way(text: &[u8], name: &str) -> Result<Model, ReadError> {
    let expected = read(text, Plan { pieces: 1, stretches: 1, fast_path: false });
    for (pieces, stretches) in [(1, 1), (2, 1), (2, 2), (3, 2), (4, 4), (7, 3), (9, 9), (40, 40)] {
        for fast_path in [true, false] {
            let plan = Plan { pieces, stretches, fast_path };
            let found = read(text, plan);
            match (&expected, &found) {
                (Ok(expected), Ok(found)) => {
                    // Not `assert_eq`: the whole mesh would be printed.
                    assert!(found.mesh == expected.mesh, "{name}, {plan:?}: another mesh");
                    assert_eq!(found.materials, expected.materials, "{name}, {plan:?}");
                    assert_eq!(found.diagnostics, expected.diagnostics, "{name}, {plan:?}");
                    assert_eq!(found.contents, expected.contents, "{name}, {plan:?}");
                    assert_eq!(found.sidecars, expected.sidecars, "{name}, {plan:?}");
                }
                (Err(expected), Err(found)) => assert_eq!(found, expected, "{name}, {plan:?}"),
                _ => panic!("{name}, {plan:?}: {expected:?} but {found:?}"),
            }
        }
    }
    expected
}

#[test]
fn the_corpus_is_the_same_in_every_way() {
    let table = gonio_fixtures::FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/obj.txt"));
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    let mut files = 0;
    for file in table.files().iter().filter(|file| file.path.ends_with(".obj")) {
        let _ = same_in_every_way(&file.bytes, &file.path);
        // The fast path needs bytes after a line, which small files do not have.
        let padded = [&file.bytes[..], b"\n", &b"#\n".repeat(100)].concat();
        let _ = same_in_every_way(&padded, &file.path);
        files += 1;
    }
    assert!(files >= 69, "{files}");
}

/// Random numbers (G. Steele, D. Lea, C. Flood, 2014: SplitMix64), the same in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        mix(self.0) % limit
    }

    fn one_of<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len() as u64) as usize]
    }

    fn number(&mut self) -> String {
        let digits = self.below(1 << 40);
        match self.below(12) {
            0 => format!("{}", digits % 100),
            1 => format!("-{}.", digits % 10),
            2 => format!(".{}", digits % 1000),
            3 => format!("{}e-{}", digits % 1000, digits % 7),
            4 => format!("{:.12}", digits as f64 / 1e9),
            5 => format!("+{:.3}", digits as f64 / 1e11),
            6 => format!("-{}", digits as f64 / 1e10),
            _ => format!("{:.6}", digits as f64 / 1e11 - 5.0),
        }
    }

    /// Appends a random statement; most are plain. `strange` files contain some that are not.
    fn statement(&mut self, text: &mut String, counts: &mut [u64; 3], strange: bool) {
        let end = match self.below(40) {
            0 if strange => " # comment\n",
            1 if strange => "\r",
            2 => "\r\n",
            3 => " \n",
            4 if strange => " \\\n\n",
            5 if strange => "\\\r\n #\n",
            _ => "\n",
        };
        let blank = |random: &mut Random| match random.below(if strange { 60 } else { 1 }) {
            1 => "  ",
            2 => "\t",
            3 => " \\\n",
            4 => " \\ \r\n ",
            _ => " ",
        };
        match self.below(100) {
            kind @ 0..50 => {
                let (keyword, count, index) = match kind {
                    0..20 => ("v", 3, 0),
                    20 => ("v", 4, 0),
                    21 => ("v", 6, 0),
                    22..35 => ("vt", 1 + self.below(3), 1),
                    _ => ("vn", 3, 2),
                };
                counts[index] += 1;
                text.push_str(keyword);
                for _ in 0..count {
                    text.push_str(blank(self));
                    text.push_str(&self.number());
                }
                if strange && self.below(300) == 0 {
                    text.push_str(self.one_of(&[" nan", " 1", " x", " 1 2", " -1.#IND"]));
                }
            }
            kind @ 50..95 => {
                text.push('f');
                let form = self.below(4);
                let corners = if kind < 80 { 3 } else { 3 + self.below(4) };
                for _ in 0..corners {
                    text.push_str(blank(self));
                    let mut index = |kind: usize| {
                        let count = counts[kind];
                        let ahead = if strange { self.below(50) / 48 * self.below(20) } else { 0 };
                        // Mostly near the last one, as in real files.
                        let back = 1 + self.below(count.clamp(1, 12));
                        match self.below(8) {
                            0 if strange && self.below(40) == 0 => "0".to_owned(),
                            0 | 1 => format!("-{back}"),
                            _ => format!("{}", (count + 1).saturating_sub(back) + ahead),
                        }
                    };
                    let _ = match form {
                        0 => write!(text, "{}", index(0)),
                        1 => write!(text, "{}/{}", index(0), index(1)),
                        2 => write!(text, "{}//{}", index(0), index(2)),
                        _ => write!(text, "{}/{}/{}", index(0), index(1), index(2)),
                    };
                }
                if strange && self.below(200) == 0 {
                    text.push_str(self.one_of(&[
                        " 1/",
                        " 1//",
                        "//",
                        " 1/2/3/4",
                        " x",
                        " 99999999999999999999",
                        " -0",
                    ]));
                }
            }
            _ => {
                let names =
                    ["o a", "g b", "g c d", "usemtl red", "usemtl blue", "usemtl", "s 1", "s off", "s 2", "l 1 2"];
                let odd = [
                    "mtllib x.mtl",
                    "what is this",
                    "usemtl a#b \\\n c",
                    "#v 1 2 3",
                    "",
                    "  ",
                    "s x",
                    "p 1",
                    "fo 1 2 3",
                ];
                text.push_str(if strange { self.one_of(&odd) } else { self.one_of(&names) });
            }
        }
        text.push_str(end);
    }
}

#[test]
fn random_files_are_the_same_in_every_way() {
    let (mut read, mut vertices, mut refused) = (0, 0, 0);
    for seed in 0..240 {
        let mut random = Random(seed);
        let strange = seed % 2 == 1;
        let (mut text, mut counts) = (String::new(), [0; 3]);
        for _ in 0..20 + random.below(400) {
            random.statement(&mut text, &mut counts, strange);
        }
        match same_in_every_way(text.as_bytes(), &format!("seed {seed}")) {
            Ok(model) => {
                read += 1;
                vertices += model.mesh.positions.len();
            }
            Err(_) => refused += 1,
        }
    }
    assert!(read > 150 && refused > 10 && vertices > 10_000, "{read} {refused} {vertices}");
}

/// Pieces with different attributes at positions they share, in all orders.
#[test]
fn shared_positions_keep_their_first_kind() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvt 2 2\n");
    for i in 0..300 {
        let (a, b) = (1 + i % 3, 1 + i / 7 % 3);
        writeln!(text, "f 1/{a} 2/{b} 3/{a}").unwrap();
    }
    let mesh = same_in_every_way(text.as_bytes(), "shared").unwrap().mesh;
    assert_eq!((mesh.positions.len(), mesh.triangle_count()), (9, 300));
    // 1/1 2/1 3/1, then 1/2 and 3/2, 1/3 and 3/3, and at the eighth face 2/2.
    assert_eq!(mesh.indices[..9], [0, 1, 2, 3, 1, 4, 5, 1, 6]);
    assert_eq!(mesh.indices[21..24], [3, 7, 4]);
    let first: Vec<f32> = mesh.tex_coords.iter().map(|t| t[0]).collect();
    assert_eq!(first, [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 1.0, 2.0]);
}

/// A repeated name changes nothing: the warning refers to the first line.
#[test]
fn repeated_names_change_nothing() {
    let again = "# the same again, and no face between\nusemtl red\n".repeat(100);
    let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\n{again}f 1 2 3\n{again}f 1 2 3\n");
    let model = same_in_every_way(text.as_bytes(), "again").unwrap();
    assert_eq!((model.mesh.parts.len(), model.diagnostics.len(), model.diagnostics[0].place.line), (1, 1, Some(4)));
}

/// More unknown kinds than are counted separately: the counts are still the same.
#[test]
fn rubbish_is_counted_alike() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for i in 0..3000 {
        writeln!(text, "{}{} x", ["zzz", "yyy"][i % 2], i * i % 97).unwrap();
    }
    let model = same_in_every_way(text.as_bytes(), "rubbish").unwrap();
    assert!(model.diagnostics.len() > 20, "{:?}", model.diagnostics);
}
