//! Sources: arrays of numbers, and accessors that select points, directions and colours from them.

use super::document::{Document, FloatArray};
use super::xml::Element;
use crate::{ReadError, Severity};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;

/// The rows of a `source`.
#[derive(Clone)]
pub(super) struct DataSource {
    array: Rc<FloatArray>,
    /// For each parameter, the index in the array of its value in row 0.
    columns: [Option<usize>; 4],
    stride: usize,
    pub(super) rows: usize,
}

impl DataSource {
    /// Returns a row. Missing parameters are 0, and the fourth, an opacity, is 1.
    pub(super) fn row(&self, row: usize) -> [f32; 4] {
        let mut values = [0.0, 0.0, 0.0, 1.0];
        for (value, column) in values.iter_mut().zip(self.columns) {
            // The index is within the array, or `rows` would be smaller, so nothing overflows.
            let number = column.and_then(|column| self.array.values.get(column + row * self.stride));
            *value = number.copied().unwrap_or(*value);
        }
        values
    }

    /// The number of parameters.
    fn width(&self) -> usize {
        self.columns.iter().flatten().count()
    }

    /// The indices in the array of the numbers in some rows that are not finite.
    fn not_finite(&self, rows: Range<usize>) -> impl Iterator<Item = usize> {
        let row_of = move |row: usize| self.columns.into_iter().flatten().map(move |column| column + row * self.stride);
        rows.flat_map(row_of)
            .filter(move |number| self.array.values.get(*number).is_some_and(|value| !value.is_finite()))
    }

    /// Returns the byte of the first number of a row that is not finite.
    pub(super) fn place_of_not_finite(&self, document: &Document<'_>, row: usize) -> Option<usize> {
        let number = self.not_finite(row..row + 1).next()?;
        document.place_of_number(&self.array, number)
    }
}

/// Arrays and sources read so far, by element.
#[derive(Default)]
pub(super) struct DataSources {
    arrays: HashMap<u32, Rc<FloatArray>>,
    sources: HashMap<u32, Option<DataSource>>,
    /// Sources whose non-finite numbers have been reported.
    reported: HashSet<u32>,
}

impl DataSources {
    /// Returns the source of this element, with the parameters of a point, direction or colour. Reports a source that
    /// cannot be read and returns `None`.
    pub(super) fn get(
        &mut self,
        document: &Document<'_>,
        element: Element<'_>,
    ) -> Result<Option<DataSource>, ReadError> {
        if let Some(known) = self.sources.get(&element.index) {
            return Ok(known.clone());
        }
        let source = self.read(document, element)?;
        self.sources.insert(element.index, source.clone());
        Ok(source)
    }

    fn read(&mut self, document: &Document<'_>, element: Element<'_>) -> Result<Option<DataSource>, ReadError> {
        let accessor = element.path(&["technique_common", "accessor"]);
        let array = match accessor {
            Some(accessor) => document.target(accessor, "source", &["float_array", "int_array"]),
            None => element.child("float_array"),
        };
        let Some(array) = array else {
            document.add(UNREADABLE, Severity::Warning, element.at(), || {
                "this source has no readable array of numbers".to_owned()
            });
            return Ok(None);
        };
        let array = self.array(document, array)?;
        let offset = accessor.and_then(|a| document.count(a, "offset")).unwrap_or(0);
        let parameters: Vec<String> = accessor
            .iter()
            .flat_map(|a| a.all("param"))
            .map(|param| param.attribute("name").unwrap_or_default().into_owned())
            .collect();
        let stride = accessor.and_then(|a| document.count(a, "stride"));
        let stride = stride.unwrap_or(1).max(parameters.len() as u64).max(1);
        let columns = columns(&parameters, stride);
        let length = array.values.len() as u64;
        let last = columns.iter().flatten().max().copied().unwrap_or(0) as u64;
        let available =
            length.checked_sub(offset).and_then(|rest| rest.checked_sub(last + 1)).map_or(0, |r| r / stride + 1);
        let declared = accessor.and_then(|a| document.count(a, "count")).unwrap_or(available);
        if declared > available {
            document.add(TOO_SHORT, Severity::Warning, accessor.unwrap_or(element).at(), || {
                format!("the accessor declares {declared} rows, but the array contains only {available}")
            });
        }
        // Where any of these is too large for the array, `available` is 0 and no row is read.
        let small = |value: u64| usize::try_from(value).unwrap_or(0);
        let columns = columns.map(|column| column.map(|c| c.saturating_add(small(offset))));
        Ok(Some(DataSource { array, columns, stride: small(stride), rows: small(declared.min(available)) }))
    }

    fn array(&mut self, document: &Document<'_>, element: Element<'_>) -> Result<Rc<FloatArray>, ReadError> {
        if let Some(known) = self.arrays.get(&element.index) {
            return Ok(known.clone());
        }
        let array = Rc::new(document.array(element)?);
        let contained = array.values.len() as u64;
        if let Some(declared) = document.count(element, "count")
            && declared != contained
        {
            document.add(TOO_SHORT, Severity::Warning, element.at(), || {
                format!("<{}> declares {declared} numbers, but contains {contained}", element.name())
            });
        }
        self.arrays.insert(element.index, array.clone());
        Ok(array)
    }
}

/// Reports once for each source that it contains non-finite numbers. In positions they are an error where they are
/// used.
fn report_not_finite(
    document: &Document<'_>,
    sources: &mut DataSources,
    semantic: Semantic,
    source: &DataSource,
    element: Element<'_>,
) {
    if semantic == Semantic::Position || !source.array.has_not_finite || !sources.reported.insert(element.index) {
        return;
    }
    let Some(first) = source.not_finite(0..source.rows).next() else { return };
    let count = source.not_finite(0..source.rows).count();
    let at = document.place_of_number(&source.array, first).unwrap_or(element.at());
    document.add("sources with numbers that are not finite", Severity::Warning, at, || {
        let numbers = if count == 1 { "number is" } else { "numbers are" };
        format!("{count} {numbers} not finite in the {}: using 0 instead", semantic.plural())
    });
}

const UNREADABLE: &str = "sources that cannot be read";
const TOO_SHORT: &str = "wrong counts";

/// Returns the columns of the parameters within a row. Unnamed parameters are skipped, unless none has a name. Known
/// names may come in any order.
fn columns(parameters: &[String], stride: u64) -> [Option<usize>; 4] {
    const KNOWN: [[&str; 4]; 4] = [["X", "Y", "Z", ""], ["S", "T", "P", ""], ["U", "V", "W", ""], ["R", "G", "B", "A"]];
    let mut columns = [None; 4];
    let is_named = parameters.iter().any(|name| !name.is_empty());
    if !is_named {
        let width = if parameters.is_empty() { usize::try_from(stride).unwrap_or(4) } else { parameters.len() };
        columns.iter_mut().take(width).enumerate().for_each(|(i, column)| *column = Some(i));
        return columns;
    }
    let named = || parameters.iter().enumerate().filter(|(_, name)| !name.is_empty());
    let is_known = |names: &[&str; 4]| {
        let place = |name: &str| names.iter().position(|known| !known.is_empty() && *known == name);
        named().map(|(i, name)| place(name).map(|p| (i, p))).collect::<Option<Vec<_>>>()
    };
    match KNOWN.iter().find_map(is_known) {
        Some(places) => places.into_iter().for_each(|(i, place)| columns[place] = Some(i)),
        None => columns.iter_mut().zip(named()).for_each(|(column, (i, _))| *column = Some(i)),
    }
    columns
}

/// An input of a primitive: its meaning, and the position of its index in a corner.
pub(super) struct Input {
    pub(super) semantic: Semantic,
    /// Distinguishes inputs with the same meaning.
    pub(super) set: u32,
    pub(super) offset: usize,
    pub(super) source: DataSource,
    /// The element of the source, which identifies it.
    pub(super) element: u32,
}

/// The meaning of an input. Inputs with other meanings are not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Semantic {
    Position,
    Normal,
    TexCoord,
    Color,
}

impl Semantic {
    fn plural(self) -> &'static str {
        match self {
            Semantic::Position => "positions",
            Semantic::Normal => "normals",
            Semantic::TexCoord => "texture coordinates",
            Semantic::Color => "colors",
        }
    }
}

/// Returns the inputs of a primitive, including those of its `vertices`, and the number of indices per corner.
pub(super) fn inputs(
    document: &Document<'_>,
    sources: &mut DataSources,
    primitive: Element<'_>,
) -> Result<(Vec<Input>, usize), ReadError> {
    let mut inputs = Vec::new();
    let mut width = 0;
    for (index, input) in primitive.all("input").enumerate() {
        let offset = document.count(input, "offset").or_else(|| document.count(input, "idx")).unwrap_or(index as u64);
        let offset = usize::try_from(offset).unwrap_or(usize::MAX - 1).min(usize::MAX - 1);
        width = width.max(offset + 1);
        if input.attribute("semantic").as_deref() == Some("VERTEX") {
            let Some(vertices) = document.target(input, "source", &["vertices"]) else { continue };
            for shared in vertices.all("input") {
                add(document, sources, shared, offset, &mut inputs)?;
            }
        } else {
            add(document, sources, input, offset, &mut inputs)?;
        }
    }
    Ok((inputs, width))
}

fn add(
    document: &Document<'_>,
    sources: &mut DataSources,
    input: Element<'_>,
    offset: usize,
    inputs: &mut Vec<Input>,
) -> Result<(), ReadError> {
    let semantic = match input.attribute("semantic").as_deref() {
        Some("POSITION") => Semantic::Position,
        Some("NORMAL") => Semantic::Normal,
        Some("TEXCOORD" | "UV") => Semantic::TexCoord,
        Some("COLOR") => Semantic::Color,
        // Tangents are computed anew; the rest is for shaders and curves.
        _ => return Ok(()),
    };
    let Some(element) = document.target(input, "source", &["source"]) else { return Ok(()) };
    let Some(source) = sources.get(document, element)? else { return Ok(()) };
    let least = if semantic == Semantic::TexCoord { 2 } else { 3 };
    if source.width() < least {
        document.add("sources with too few parameters", Severity::Warning, input.at(), || {
            format!("the source of {semantic:?} has {} parameters instead of {least}: it is ignored", source.width())
        });
        return Ok(());
    }
    report_not_finite(document, sources, semantic, &source, element);
    let set = document.count(input, "set").and_then(|set| u32::try_from(set).ok()).unwrap_or(0);
    inputs.push(Input { semantic, set, offset, source, element: element.index });
    Ok(())
}
