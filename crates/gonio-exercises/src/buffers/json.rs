//! Vertex buffers as JSON: rows, objects, or one list for each attribute, with or without indices.

use super::buffer::{Attributes, Buffer, BufferError, Data, Vertex, WIDTHS, unit};
use gonio_language::tr;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// Maximum size in bytes: a tree of JSON takes ten times the memory of its text.
const MOST_BYTES: usize = 32 << 20;

fn shapes() -> &'static str {
    tr!("check-buffer-expected-a-list-of-rows-a")
}

/// Reads JSON.
pub(super) fn read(bytes: &[u8]) -> Result<Buffer, BufferError> {
    if bytes.len() > MOST_BYTES {
        let message = tr!("check-buffer-json-too-large", count = bytes.len() >> 20, most = MOST_BYTES >> 20);
        return Err(BufferError::new(message));
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let tree: Tree = serde_json::from_slice(bytes).map_err(|error| {
        let text = error.to_string();
        let message = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
        let hint = match text.contains("expected value") && contains_nan(bytes) {
            true => tr!("check-buffer-json-has-no-nan-write-null"),
            false => "",
        };
        let error_line = (error.line() > 0).then_some(error.line() as u64);
        let error_at = BufferError::new(tr!("check-buffer-invalid-json", message = message, hint = hint));
        error_line.map_or(error_at.clone(), |line| error_at.at(line, Some(error.column() as u64)))
    })?;
    let mut warnings = Vec::new();
    let data = match tree {
        Tree::Numbers(values) if !values.is_empty() => flat(values)?,
        Tree::List(rows) => list(rows)?,
        Tree::Object(fields) => object(fields, &mut warnings)?,
        Tree::Numbers(_) => return Err(BufferError::new(tr!("check-buffer-the-list-is-empty-no-vertex"))),
        Tree::Other(_) => return Err(BufferError::new(shapes())),
    };
    let is_empty = match &data {
        Data::Named { vertices, .. } => vertices.is_empty(),
        Data::Rows { values, .. } => values.is_empty(),
        Data::Raw { bytes, .. } => bytes.is_empty(),
    };
    if is_empty {
        return Err(BufferError::new(tr!("check-buffer-the-file-has-no-vertices")));
    }
    Ok(Buffer { data, warnings })
}

fn contains_nan(bytes: &[u8]) -> bool {
    bytes.windows(3).any(|window| window.eq_ignore_ascii_case(b"nan"))
}

/// A JSON value; lists of numbers are stored compactly.
enum Tree {
    /// A list of numbers only (null is NaN, as JavaScript writes it), or an empty list.
    Numbers(Vec<f32>),
    List(Vec<Tree>),
    Object(Vec<(String, Tree)>),
    /// A number by itself, or a value that no buffer contains.
    Other(Option<f32>),
}

impl<'de> Deserialize<'de> for Tree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyTree;
        impl<'de> Visitor<'de> for AnyTree {
            type Value = Tree;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(tr!("check-buffer-a-vertex-buffer"))
            }
            fn visit_f64<E>(self, value: f64) -> Result<Tree, E> {
                Ok(Tree::Other(Some(value as f32)))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Tree, E> {
                Ok(Tree::Other(Some(value as f32)))
            }
            fn visit_u64<E>(self, value: u64) -> Result<Tree, E> {
                Ok(Tree::Other(Some(value as f32)))
            }
            fn visit_unit<E>(self) -> Result<Tree, E> {
                Ok(Tree::Other(Some(f32::NAN)))
            }
            fn visit_bool<E>(self, _: bool) -> Result<Tree, E> {
                Ok(Tree::Other(None))
            }
            fn visit_str<E>(self, _: &str) -> Result<Tree, E> {
                Ok(Tree::Other(None))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Tree, A::Error> {
                let (mut numbers, mut others) = (Vec::new(), Vec::new());
                while let Some(next) = seq.next_element()? {
                    match next {
                        Tree::Other(Some(number)) if others.is_empty() => numbers.push(number),
                        other => {
                            others.extend(numbers.drain(..).map(|number| Tree::Other(Some(number))));
                            others.push(other);
                        }
                    }
                }
                Ok(if others.is_empty() { Tree::Numbers(numbers) } else { Tree::List(others) })
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Tree, A::Error> {
                let mut fields = Vec::new();
                while let Some(field) = map.next_entry()? {
                    fields.push(field);
                }
                Ok(Tree::Object(fields))
            }
        }
        deserializer.deserialize_any(AnyTree)
    }
}

/// Treats a list of numbers without rows like raw floats.
fn flat(values: Vec<f32>) -> Result<Data, BufferError> {
    if !WIDTHS.iter().any(|width| values.len().is_multiple_of(*width)) {
        let message = tr!("check-buffer-the-list-has-numbers-which-is", count = values.len());
        return Err(BufferError::new(message));
    }
    Ok(Data::Raw { bytes: values.iter().flat_map(|value| value.to_le_bytes()).collect(), stride: None })
}

/// Reads rows of numbers, or one object per vertex.
fn list(rows: Vec<Tree>) -> Result<Data, BufferError> {
    if matches!(rows.first(), Some(Tree::Object(_))) {
        return objects(rows);
    }
    let mut values = Vec::new();
    let mut width = None;
    for (number, row) in (1..).zip(rows) {
        let Tree::Numbers(row) = row else {
            return Err(BufferError::new(tr!("check-buffer-row-is-not-a-list-of", number = number, shapes = shapes())));
        };
        let first = *width.get_or_insert(row.len());
        if row.len() != first {
            let message =
                tr!("check-buffer-row-has-numbers-but-the-first", number = number, count = row.len(), first = first);
            return Err(BufferError::new(message));
        }
        values.extend(row);
    }
    match width {
        Some(width) if WIDTHS.contains(&width) => Ok(Data::Rows { values, width }),
        width => {
            let message = tr!("check-buffer-a-row-has-numbers-it-may", count = width.unwrap_or(0));
            Err(BufferError::new(message))
        }
    }
}

fn plain(key: &str) -> String {
    key.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_ascii_lowercase()
}

const POSITIONS: [&str; 6] = ["positions", "position", "pos", "v", "p", "apos"];
const TEX_COORDS: [&str; 8] = ["texcoords", "texcoord", "uv", "uvs", "vt", "tex", "st", "texturecoordinates"];
const NORMALS: [&str; 5] = ["normals", "normal", "vn", "n", "norm"];

fn objects(rows: Vec<Tree>) -> Result<Data, BufferError> {
    let mut vertices = Vec::with_capacity(rows.len());
    let mut all = None;
    for (number, row) in (1..).zip(rows) {
        let Tree::Object(fields) = row else {
            return Err(BufferError::new(tr!("check-buffer-vertex-is-not-an-object-but", number = number)));
        };
        let (vertex, has) = one_object(&fields)
            .map_err(|message| BufferError::new(tr!("check-buffer-vertex", number = number, message = message)))?;
        if *all.get_or_insert(has) != has {
            let message = tr!("check-buffer-vertex-does-not-have-the-same", number = number);
            return Err(BufferError::new(message));
        }
        vertices.push(vertex);
    }
    Ok(Data::Named { vertices, has: all.unwrap_or_default() })
}

/// Reads `{"x": 1, ...}` or `{"position": [1, 2, 3], ...}`, or a mixture of both.
fn one_object(fields: &[(String, Tree)]) -> Result<(Vertex, Attributes), String> {
    const NAMES: [&str; 8] = ["x", "y", "z", "u", "v", "nx", "ny", "nz"];
    let mut all = [None; 8];
    for (key, value) in fields {
        let key = plain(key);
        let start = [(&POSITIONS[..], 0, 3), (&TEX_COORDS[..], 3, 2), (&NORMALS[..], 5, 3)];
        let group = start.into_iter().find(|(names, ..)| names.contains(&key.as_str()));
        match (value, group) {
            (Tree::Other(Some(number)), _) => {
                if let Some(place) = NAMES.iter().position(|name| *name == key) {
                    all[place] = Some(*number);
                }
            }
            (Tree::Numbers(numbers), Some((_, start, count))) => {
                if numbers.len() < count {
                    return Err(tr!(
                        "check-buffer-has-numbers-instead-of",
                        key = key,
                        found = numbers.len(),
                        count = count
                    ));
                }
                for (place, number) in (start..start + count).zip(numbers) {
                    all[place] = Some(*number);
                }
            }
            (Tree::Object(parts), Some((_, start, count))) => {
                for (name, part) in parts {
                    let letters =
                        if start == 3 { ["x", "y", "-", "u", "v", "-"] } else { ["x", "y", "z", "-", "-", "-"] };
                    let place = letters.iter().position(|letter| *letter == plain(name)).map(|place| place % 3);
                    if let (Some(place), Tree::Other(Some(number))) = (place.filter(|place| *place < count), part) {
                        all[start + place] = Some(*number);
                    }
                }
            }
            _ => {}
        }
    }
    for group in [0..3, 3..5, 5..8] {
        let missing = group.clone().find(|place| all[*place].is_none());
        if let Some(missing) = missing
            && (group.start == 0 || group.clone().any(|place| all[place].is_some()))
        {
            return Err(tr!("check-buffer-has-no-number", name = NAMES[missing]));
        }
    }
    let has = Attributes { tex_coords: all[3].is_some(), normals: all[5].is_some() };
    let [x, y, z, u, v, nx, ny, nz] = all.map(Option::unwrap_or_default);
    Ok((Vertex { position: [x, y, z], tex_coord: [u, v], normal: unit([nx, ny, nz]) }, has))
}

/// Reads a list for each attribute, or a list of vertices; with or without indices.
fn object(fields: Vec<(String, Tree)>, warnings: &mut Vec<String>) -> Result<Data, BufferError> {
    let (mut positions, mut tex_coords, mut normals, mut indices, mut vertices) = (None, None, None, None, None);
    for (key, value) in fields {
        let plain = plain(&key);
        match plain.as_str() {
            "vertices" | "vertexes" | "rows" | "buffer" | "data" => vertices = Some(value),
            "indices" | "index" | "elements" | "triangles" | "faces" => indices = Some(whole_numbers(value)?),
            name if POSITIONS.contains(&name) => positions = Some(rows_of::<3>(value, &key)?),
            name if TEX_COORDS.contains(&name) => tex_coords = Some(rows_of::<2>(value, &key)?),
            name if NORMALS.contains(&name) => normals = Some(rows_of::<3>(value, &key)?),
            _ => warnings
                .push(tr!("check-buffer-is-unknown-and-was-ignored", key = key.chars().take(30).collect::<String>())),
        }
    }
    // Some programs write `{"vertices": positions, "normals": ...}`.
    if positions.is_none()
        && (tex_coords.is_some() || normals.is_some())
        && let Some(tree) = vertices.take()
    {
        positions = Some(rows_of::<3>(tree, "vertices")?);
    }
    let data = match (positions, vertices) {
        (Some(positions), _) => named(positions, tex_coords, normals)?,
        (None, Some(Tree::List(rows))) => list(rows)?,
        (None, Some(Tree::Numbers(values))) if indices.is_none() && !values.is_empty() => flat(values)?,
        (None, Some(Tree::Numbers(_))) => {
            let message = tr!("check-buffer-vertices-is-one-list-of-numbers");
            return Err(BufferError::new(message));
        }
        _ => return Err(BufferError::new(shapes())),
    };
    match indices {
        Some(indices) => apply(data, &indices),
        None => Ok(data),
    }
}

fn named(
    positions: Vec<[f32; 3]>,
    tex_coords: Option<Vec<[f32; 2]>>,
    normals: Option<Vec<[f32; 3]>>,
) -> Result<Data, BufferError> {
    let has = Attributes { tex_coords: tex_coords.is_some(), normals: normals.is_some() };
    let tex_coords = tex_coords.unwrap_or_else(|| vec![[0.0; 2]; positions.len()]);
    let normals = normals.unwrap_or_else(|| vec![[0.0; 3]; positions.len()]);
    for (name, count) in
        [(tr!("check-buffer-texture-coordinates"), tex_coords.len()), (tr!("check-buffer-normals"), normals.len())]
    {
        if count != positions.len() {
            let message = tr!(
                "check-buffer-there-are-positions-and-each-vertex",
                positions = positions.len(),
                count = count,
                name = name
            );
            return Err(BufferError::new(message));
        }
    }
    let vertices = positions.into_iter().zip(tex_coords).zip(normals);
    let vertices = vertices.map(|((position, tex_coord), normal)| Vertex { position, tex_coord, normal: unit(normal) });
    Ok(Data::Named { vertices: vertices.collect(), has })
}

fn rows_of<const N: usize>(tree: Tree, key: &str) -> Result<Vec<[f32; N]>, BufferError> {
    let key: String = key.chars().take(30).collect();
    match tree {
        Tree::Numbers(values) if values.len().is_multiple_of(N) => Ok(values.as_chunks::<N>().0.to_vec()),
        Tree::Numbers(values) => Err(BufferError::new(tr!(
            "check-buffer-has-numbers-which-is-not-a",
            key = key,
            count = values.len(),
            width = N
        ))),
        Tree::List(rows) => {
            let row = |(number, row): (usize, Tree)| match row {
                Tree::Numbers(values) if values.len() >= N => Ok(std::array::from_fn(|i| values[i])),
                _ => Err(BufferError::new(tr!(
                    "check-buffer-row-of-is-not-a-list",
                    number = number,
                    key = key,
                    width = N
                ))),
            };
            (1..).zip(rows).map(row).collect()
        }
        _ => Err(BufferError::new(tr!("check-buffer-is-not-a-list-of-numbers", key = key))),
    }
}

fn whole_numbers(tree: Tree) -> Result<Vec<usize>, BufferError> {
    let values = match tree {
        Tree::Numbers(values) => values,
        Tree::List(rows) => rows_of::<3>(Tree::List(rows), "indices")?.concat(),
        _ => return Err(BufferError::new(tr!("check-buffer-indices-is-not-a-list-of"))),
    };
    let whole = |(number, value): (usize, &f32)| {
        let is_whole = value.fract() == 0.0 && *value >= 0.0 && *value < 16_777_216.0;
        is_whole.then_some(*value as usize).ok_or_else(|| {
            BufferError::new(tr!("check-buffer-index-is-expected-an-integer-from", number = number, value = value))
        })
    };
    (1..).zip(&values).map(whole).collect()
}

/// The vertices that the indices refer to, three per triangle.
fn apply(data: Data, indices: &[usize]) -> Result<Data, BufferError> {
    let missing = |index: usize, count: usize| {
        let hint = if index == count { tr!("check-buffer-indices-count-from-0-here") } else { "" };
        BufferError::new(tr!("check-buffer-index-is-out-of-range-there", index = index, count = count, hint = hint))
    };
    match data {
        Data::Named { vertices, has } => {
            let vertex = |index: &usize| vertices.get(*index).copied().ok_or_else(|| missing(*index, vertices.len()));
            Ok(Data::Named { vertices: indices.iter().map(vertex).collect::<Result<_, _>>()?, has })
        }
        Data::Rows { values, width } => {
            let mut gathered = Vec::new();
            for index in indices {
                let row = values.chunks_exact(width).nth(*index);
                gathered.extend(row.ok_or_else(|| missing(*index, values.len() / width))?);
            }
            Ok(Data::Rows { values: gathered, width })
        }
        raw => Ok(raw),
    }
}
