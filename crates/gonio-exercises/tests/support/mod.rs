//! The exercise's models, and writers of every format.

use gonio_exercises::buffers::{Attributes, Expected, Vertex};
use gonio_fixtures::FixtureTable;
use std::fmt::Write;
use std::path::{Path, PathBuf};

pub fn model(name: &str) -> PathBuf {
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

pub fn models() -> Vec<(String, Expected)> {
    let models = files(&model("")).into_iter();
    models.map(|(name, bytes)| (name, Expected::from_obj(&bytes).expect("an OBJ"))).collect()
}

/// Files that the exercise's programs wrote: MODEL.start.csv, MODEL.reference.raw and so on.
pub fn programs_output() -> Vec<(String, Vec<u8>)> {
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/buffers.txt"));
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    table.files().iter().map(|file| (file.path.clone(), file.bytes.clone())).collect()
}

/// A random number from 0 to `below` - 1 (Knuth's MMIX).
pub fn random(state: &mut u64, below: usize) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize % below
}

/// The triangles in another order, each starting at another corner.
pub fn shuffled(vertices: &[Vertex], seed: u64) -> Vec<Vertex> {
    let mut state = seed;
    let mut triangles: Vec<[Vertex; 3]> = vertices.as_chunks::<3>().0.to_vec();
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, random(&mut state, i + 1));
    }
    triangles.iter_mut().for_each(|triangle| triangle.rotate_left(random(&mut state, 3)));
    triangles.concat()
}

/// x y z, u v, nx ny nz, as far as there are.
pub fn row(vertex: &Vertex, has: Attributes) -> Vec<f32> {
    let mut row = vertex.position.to_vec();
    if has.tex_coords {
        row.extend(vertex.tex_coord);
    }
    if has.normals {
        row.extend(vertex.normal);
    }
    row
}

pub fn csv(vertices: &[Vertex], has: Attributes, separator: &str, header: bool) -> Vec<u8> {
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

/// A file; `!` in the format's name says that a warning belongs to it.
pub struct Format {
    pub name: &'static str,
    pub file: String,
    pub bytes: Vec<u8>,
}

/// A buffer in all formats.
pub fn formats(vertices: &[Vertex], has: Attributes) -> Vec<Format> {
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
