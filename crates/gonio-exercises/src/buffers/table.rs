//! Vertex buffers as text: one row per vertex, with columns separated by commas, semicolons, tabs or spaces.

use super::buffer::{Attributes, Buffer, BufferError, Data, Vertex, WIDTHS, unit};
use gonio_language::tr;

/// Number of known columns: x y z, u v, nx ny nz.
const COLUMNS: usize = 8;

/// Reads a table. Rows that are empty or start with `#` are skipped.
pub(super) fn read(bytes: &[u8]) -> Result<Buffer, BufferError> {
    let text = decode(bytes)?;
    let mut lines = text.lines().enumerate().map(|(i, line)| Line { number: i as u64 + 1, text: line });
    let mut next =
        || lines.by_ref().find(|line| !line.text.trim().is_empty() && !line.text.trim_start().starts_with('#'));
    let Some(first) = next() else {
        return Err(BufferError::new(tr!("check-buffer-the-file-has-no-rows")));
    };
    let separator = Separator::detect(first.text);
    let mut parser = Parser { separator, decimal_commas: 0, not_finite: 0, values: Vec::new() };
    let mut warnings = Vec::new();
    let header = Header::parse(&first, separator, &mut warnings)?;
    let width = match &header {
        Some(header) => header.columns.len(),
        None => parser.row(&first, None)?,
    };
    while let Some(line) = next() {
        parser.row(&line, Some(width))?;
    }
    if parser.values.is_empty() {
        return Err(BufferError::new(tr!("check-buffer-the-file-has-a-header-but")));
    }
    if parser.decimal_commas > 0 {
        warnings.push(tr!("check-buffer-the-numbers-have-decimal-commas-write").to_owned());
    }
    if parser.not_finite > 0 {
        warnings.push(tr!("check-buffer-of-the-numbers-are-nan-or", count = parser.not_finite));
    }
    let values = parser.values;
    let data = match header {
        Some(header) => header.vertices(&values),
        None if WIDTHS.contains(&width) => Data::Rows { values, width },
        None => {
            let message = tr!("check-buffer-a-row-has-numbers-without-a", width = width);
            return Err(BufferError::new(message).at(first.number, None));
        }
    };
    Ok(Buffer { data, warnings })
}

fn decode(bytes: &[u8]) -> Result<&str, BufferError> {
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return Err(BufferError::new(tr!("check-buffer-the-file-is-utf-16-text")));
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        let message = tr!("check-buffer-the-file-is-binary-use-the");
        return Err(at_byte(bytes, at, message));
    }
    std::str::from_utf8(bytes)
        .map_err(|error| at_byte(bytes, error.valid_up_to(), tr!("check-buffer-the-file-is-not-utf-8")))
}

fn at_byte(bytes: &[u8], at: usize, message: &str) -> BufferError {
    let before = &bytes[..at];
    let line = before.iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
    let start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |place| place + 1);
    BufferError::new(message).at(line, Some((at - start) as u64 + 1))
}

struct Line<'a> {
    number: u64,
    text: &'a str,
}

#[derive(Clone, Copy, PartialEq)]
enum Separator {
    Character(char),
    Blanks,
}

impl Separator {
    fn detect(line: &str) -> Self {
        let found = [';', '\t', ','].into_iter().find(|separator| line.trim().contains(*separator));
        found.map_or(Separator::Blanks, Separator::Character)
    }

    /// The cells, each with its column in bytes, from 1. A separator at the end of a line adds no cell.
    fn cells(self, line: &str) -> Vec<(u64, &str)> {
        let mut cells = Vec::new();
        let mut start = 0;
        let is_separator = |c: char| match self {
            Separator::Character(separator) => c == separator,
            Separator::Blanks => c.is_whitespace(),
        };
        for part in line.split(is_separator) {
            let cell = part.trim();
            let column = start + (part.len() - part.trim_start().len()) + 1;
            cells.push((column as u64, cell));
            start += part.len() + 1;
        }
        if self == Separator::Blanks {
            cells.retain(|(_, cell)| !cell.is_empty());
        } else if cells.last().is_some_and(|(_, cell)| cell.is_empty()) {
            cells.pop();
        }
        cells
    }
}

struct Parser {
    separator: Separator,
    decimal_commas: u64,
    not_finite: u64,
    values: Vec<f32>,
}

impl Parser {
    /// Reads a row, and returns the number of its cells.
    fn row(&mut self, line: &Line<'_>, width: Option<usize>) -> Result<usize, BufferError> {
        let cells = self.separator.cells(line.text);
        for (column, cell) in &cells {
            let value = self.number(cell).ok_or_else(|| {
                let message = match cell.is_empty() {
                    true => tr!("check-buffer-a-number-is-missing-here").to_owned(),
                    false => tr!("check-buffer-is-not-a-number", cell = shortened(cell)),
                };
                BufferError::new(message).at(line.number, Some(*column))
            })?;
            self.values.push(value);
        }
        if let Some(width) = width.filter(|width| *width != cells.len()) {
            let comma = if self.separator == Separator::Character(',') {
                tr!("check-buffer-do-the-numbers-have-decimal-commas")
            } else {
                ""
            };
            let message =
                tr!("check-buffer-this-row-has-numbers-but-the", count = cells.len(), width = width, comma = comma);
            return Err(BufferError::new(message).at(line.number, None));
        }
        Ok(cells.len())
    }

    fn number(&mut self, cell: &str) -> Option<f32> {
        let cell = cell.trim_matches('"');
        if let Some(value) = parse(cell) {
            self.not_finite += u64::from(!value.is_finite());
            return Some(value);
        }
        if self.separator != Separator::Character(',') && cell.matches(',').count() == 1 {
            let value = parse(&cell.replace(',', "."))?;
            self.decimal_commas += 1;
            return Some(value);
        }
        None
    }
}

/// Parses a number as any language prints it, including `1.0f` and Microsoft's `-nan(ind)`.
fn parse(cell: &str) -> Option<f32> {
    let lower = cell.to_ascii_lowercase();
    match lower.as_str() {
        "nan" | "-nan" | "-nan(ind)" | "nan(ind)" | "null" | "none" | "undefined" => return Some(f32::NAN),
        _ => {}
    }
    lower.parse().ok().or_else(|| lower.strip_suffix('f').and_then(|number| number.parse().ok()))
}

fn shortened(cell: &str) -> String {
    if cell.chars().count() > 30 { cell.chars().take(30).chain(['…']).collect() } else { cell.to_owned() }
}

struct Header {
    /// For each column of the file, its index among x y z u v nx ny nz; `None` if it is unknown.
    columns: Vec<Option<usize>>,
}

impl Header {
    /// The header, if the first line is one: if a cell of it is not a number.
    fn parse(line: &Line<'_>, separator: Separator, warnings: &mut Vec<String>) -> Result<Option<Self>, BufferError> {
        let cells = separator.cells(line.text);
        let is_number = |cell: &str| {
            parse(cell.trim_matches('"')).is_some() || parse(&cell.trim_matches('"').replace(',', ".")).is_some()
        };
        // The cell must start with a letter: `(1` or `{0.5` is a row in an unknown format.
        if !cells.iter().any(|(_, cell)| !is_number(cell) && cell.trim_matches('"').starts_with(char::is_alphabetic)) {
            return Ok(None);
        }
        let mut columns = Vec::with_capacity(cells.len());
        for (place, name) in &cells {
            let column = column(name);
            if column.is_some() && columns.contains(&column) {
                let message = tr!("check-buffer-the-column-is-named-twice", name = shortened(name));
                return Err(BufferError::new(message).at(line.number, Some(*place)));
            }
            if column.is_none() {
                warnings.push(tr!("check-buffer-the-column-is-unknown-and-was", name = shortened(name)));
            }
            columns.push(column);
        }
        let has = |column: usize| columns.contains(&Some(column));
        const NAMES: [&str; COLUMNS] = ["x", "y", "z", "u", "v", "nx", "ny", "nz"];
        for group in [0..3, 3..5, 5..8] {
            let missing = group.clone().find(|column| !has(*column));
            if let Some(missing) = missing.filter(|_| group.start == 0 || group.clone().any(has)) {
                let name = NAMES[missing];
                let message = tr!("check-buffer-the-header-has-no-column-the", name = name);
                return Err(BufferError::new(message).at(line.number, None));
            }
        }
        Ok(Some(Header { columns }))
    }

    fn vertices(&self, values: &[f32]) -> Data {
        let has = |column: usize| self.columns.contains(&Some(column));
        let vertices = values.chunks_exact(self.columns.len()).map(|row| {
            let mut all = [0.0; COLUMNS];
            for (value, column) in row.iter().zip(&self.columns) {
                if let Some(column) = column {
                    all[*column] = *value;
                }
            }
            let [x, y, z, u, v, nx, ny, nz] = all;
            Vertex { position: [x, y, z], tex_coord: [u, v], normal: unit([nx, ny, nz]) }
        });
        Data::Named { vertices: vertices.collect(), has: Attributes { tex_coords: has(3), normals: has(5) } }
    }
}

/// The column that a name stands for, in the spellings that programs use.
fn column(name: &str) -> Option<usize> {
    let plain: String = name.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_ascii_lowercase();
    let of = |stem: &str, ends: &[&str]| {
        let stems: &[&str] = match stem {
            "position" => &["", "p", "v", "pos", "position", "positions", "vertex", "aposition", "apos"],
            "tex" => &["", "t", "vt", "tex", "uv", "texcoord", "texcoords", "texturecoord", "st", "atexcoord"],
            _ => &["n", "vn", "norm", "normal", "normals", "anormal"],
        };
        ends.iter().position(|end| stems.iter().any(|stem| plain == format!("{stem}{end}")))
    };
    // `v` alone is a texture coordinate, `vx` a position.
    of("tex", &["u", "v"])
        .or_else(|| of("tex", &["s", "t"]).filter(|_| plain.len() != 2 || !plain.starts_with('v')))
        .map(|place| 3 + place)
        .or_else(|| of("position", &["x", "y", "z"]))
        .or_else(|| of("normal", &["x", "y", "z"]).map(|place| 5 + place))
        .or_else(|| {
            ["texx", "texy", "texcoordx", "texcoordy", "texcoordsx", "texcoordsy", "vtx", "vty", "uvx", "uvy"]
                .iter()
                .position(|known| plain == *known)
                .map(|place| 3 + place % 2)
        })
}
