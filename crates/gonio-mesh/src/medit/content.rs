//! The contents of a file, in either encoding.

use super::{Keyword, Rows};
use crate::diagnostic::Reports;
use crate::text::LineIndex;
use crate::{Diagnostic, Limits, ReadError, Severity};

/// Reads the numbers of a section one after another.
pub(super) trait Numbers {
    /// Reads a coordinate, which must be finite.
    fn real(&mut self) -> Result<f32, ReadError>;
    /// Reads an index or a reference.
    fn integer(&mut self) -> Result<i64, ReadError>;
    /// Returns the byte where the next number is.
    fn place(&mut self) -> usize;
    /// Creates an error at the next number.
    fn error(&mut self, message: String) -> ReadError;
    /// Returns an upper bound for the remaining numbers, which limits allocations.
    fn most_left(&self) -> usize;
}

/// The elements of one keyword.
pub(super) struct Elements {
    pub(super) keyword: &'static Keyword,
    /// Corners of an element.
    pub(super) corners: usize,
    pub(super) is_volume: bool,
    /// Indices from 1, not yet checked, for each corner of each element.
    pub(super) vertices: Vec<u32>,
    /// One for each element.
    pub(super) references: Vec<i64>,
    /// The byte where each begins.
    pub(super) places: Vec<usize>,
}

/// The contents of a file.
#[derive(Default)]
pub(super) struct Content {
    /// 2 or 3; 0 while unknown.
    pub(super) dimension: usize,
    /// Whether the section with the dimension has been read: in a text the dimension may be looked up ahead of it.
    pub(super) has_dimension: bool,
    /// Two-dimensional points are at z = 0.
    pub(super) vertices: Vec<[f32; 3]>,
    pub(super) elements: Vec<Elements>,
    /// Vectors of length 1 or 0.
    pub(super) normals: Vec<[f32; 3]>,
    /// Indices of a vertex and a normal, from 1.
    pub(super) normal_at_vertices: Vec<[i64; 2]>,
    /// For elements of each corner count: indices of normals from 1, for all corners of all elements.
    pub(super) normal_at_corners: Vec<(usize, Vec<i64>)>,
    /// The sections in the order of the file: keyword, number of rows and the byte where each begins.
    pub(super) counts: Vec<(&'static Keyword, u64, usize)>,
    pub(super) has_end: bool,
}

impl Content {
    pub(super) fn has(&self, keyword: &Keyword) -> bool {
        self.counts.iter().any(|(known, ..)| known.code == keyword.code)
    }

    /// Returns the numbers per row, if rows of this kind are read.
    pub(super) fn numbers_in_row(&self, rows: Rows) -> Option<usize> {
        match rows {
            Rows::Vertices => Some(self.dimension + 1),
            Rows::Surface { nodes, .. } | Rows::Volume { nodes, .. } => Some(nodes + 1),
            Rows::Normals => Some(self.dimension),
            Rows::NormalAtVertices => Some(2),
            Rows::NormalAtCorners(corners) => Some(corners),
            Rows::Dimension | Rows::Counted | Rows::Bare | Rows::End => None,
        }
    }

    /// Reads the `count` rows of a section.
    pub(super) fn read_rows(
        &mut self,
        keyword: &'static Keyword,
        count: usize,
        numbers: &mut impl Numbers,
        limits: &Limits,
    ) -> Result<(), ReadError> {
        let Some(in_row) = self.numbers_in_row(keyword.rows) else { return Ok(()) };
        if count.checked_mul(in_row).is_none_or(|all| all > numbers.most_left()) {
            let message = format!("declares {count} {}, more than the rest of the file can contain", keyword.name);
            return Err(numbers.error(message));
        }
        match keyword.rows {
            Rows::Vertices => self.read_vertices(count, numbers, limits)?,
            Rows::Surface { corners, nodes } => self.read_elements(keyword, (corners, nodes), false, count, numbers)?,
            Rows::Volume { corners, nodes } => self.read_elements(keyword, (corners, nodes), true, count, numbers)?,
            Rows::Normals => {
                self.normals.reserve(count);
                for _ in 0..count {
                    let normal = glam::DVec3::from(point(self.dimension, numbers)?.map(f64::from));
                    self.normals.push(normal.normalize_or_zero().as_vec3().to_array());
                }
            }
            Rows::NormalAtVertices => {
                for _ in 0..count {
                    self.normal_at_vertices.push([numbers.integer()?, numbers.integer()?]);
                }
            }
            Rows::NormalAtCorners(corners) => {
                let normals = (0..count * corners).map(|_| numbers.integer()).collect::<Result<_, _>>()?;
                self.normal_at_corners.push((corners, normals));
            }
            Rows::Dimension | Rows::Counted | Rows::Bare | Rows::End => {}
        }
        Ok(())
    }

    fn read_vertices(&mut self, count: usize, numbers: &mut impl Numbers, limits: &Limits) -> Result<(), ReadError> {
        let most = limits.max_vertices.min(u64::from(u32::MAX) - 1);
        if count as u64 > most {
            return Err(numbers.error(format!("has {count} vertices, more than {most}, which is the limit")));
        }
        self.vertices.reserve(count);
        for _ in 0..count {
            self.vertices.push(point(self.dimension, numbers)?);
            numbers.integer()?;
        }
        Ok(())
    }

    fn read_elements(
        &mut self,
        keyword: &'static Keyword,
        (corners, nodes): (usize, usize),
        is_volume: bool,
        count: usize,
        numbers: &mut impl Numbers,
    ) -> Result<(), ReadError> {
        let mut elements = Elements {
            keyword,
            corners,
            is_volume,
            vertices: Vec::with_capacity(count * corners),
            references: Vec::with_capacity(count),
            places: Vec::with_capacity(count),
        };
        for _ in 0..count {
            elements.places.push(numbers.place());
            for node in 0..nodes {
                let index = numbers.integer()?;
                if node < corners {
                    // Indices out of range are reported when the number of vertices is known.
                    elements.vertices.push(u32::try_from(index).unwrap_or(u32::MAX));
                }
            }
            elements.references.push(numbers.integer()?);
        }
        self.elements.push(elements);
        Ok(())
    }
}

fn point(dimension: usize, numbers: &mut impl Numbers) -> Result<[f32; 3], ReadError> {
    let mut point = [0.0; 3];
    for value in point.iter_mut().take(dimension) {
        *value = numbers.real()?;
    }
    Ok(point)
}

/// Formats positions: as lines and columns of a text, or as bytes of a binary file.
pub(super) enum Locator<'a> {
    Text(LineIndex<'a>),
    Binary,
}

impl Locator<'_> {
    /// Reports a warning that may occur at many places; `kind` completes "and 5 more: KIND".
    pub(super) fn warn(&self, kind: &'static str, at: usize, reports: &mut Reports, message: impl FnOnce() -> String) {
        match self {
            Locator::Text(lines) => {
                let (line, column) = lines.place(at);
                reports.add_loss(kind, line, Some(column), message);
            }
            Locator::Binary => {
                reports.add_without_line(kind, Severity::Warning, || format!("{} (at byte {})", message(), at + 1));
            }
        }
    }

    /// Reports a diagnostic at a byte.
    pub(super) fn report(&self, severity: Severity, at: usize, reports: &mut Reports, message: String) {
        let (order, diagnostic) = match self {
            Locator::Text(lines) => {
                let (line, column) = lines.place(at);
                (line, Diagnostic::warning(message).at(line, Some(column)))
            }
            Locator::Binary => (0, Diagnostic::warning(format!("{message} (at byte {})", at + 1))),
        };
        reports.push(order, Diagnostic { severity, ..diagnostic });
    }
}
