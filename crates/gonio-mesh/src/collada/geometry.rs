//! Reads geometries: their primitives, as polygons of corners.

use super::document::{Document, name_of};
use super::source::{DataSources, Input, Semantic, inputs};
use super::xml::Element;
use crate::{ReadError, Severity};
use std::collections::BTreeMap;

/// A `geometry` in its own space.
pub(super) struct Geometry {
    pub(super) name: String,
    pub(super) primitives: Vec<Primitive>,
}

pub(super) struct Primitive {
    /// The symbol by which a `bind_material` refers to its material.
    pub(super) symbol: Option<String>,
    pub(super) inputs: Vec<Input>,
    /// The number of indices per corner.
    pub(super) width: usize,
    /// The indices of all corners, one corner after the other.
    pub(super) indices: Vec<u32>,
    /// The number of corners of each polygon; `None` for triangles.
    pub(super) sizes: Option<Vec<u32>>,
    pub(super) at: usize,
    /// For each `p` element, the position of its first index and the element.
    places: Vec<(usize, u32)>,
}

impl Primitive {
    /// Returns the input with this meaning and, if possible, of this set; otherwise of the first set.
    pub(super) fn input(&self, semantic: Semantic, set: Option<u32>) -> Option<&Input> {
        let all = || self.inputs.iter().filter(|input| input.semantic == semantic);
        let of_set = set.and_then(|set| all().find(|input| input.set == set));
        of_set.or_else(|| all().min_by_key(|input| input.set))
    }

    /// Returns the byte where an index is.
    pub(super) fn place(&self, document: &Document<'_>, index: usize) -> usize {
        // Strips and fans are converted to triangles, so that only the `p` element is known.
        let (mut start, mut element) = (0, None);
        for (first, p) in &self.places {
            if *first <= index {
                (start, element) = (*first, Some(*p));
            }
        }
        let Some(element) = element.and_then(|p| document.tree.elements().nth(p as usize)) else { return self.at };
        element.words().nth(index - start).map_or(element.at(), |(at, _)| at)
    }
}

/// Kinds of geometry other than polygons.
const UNSUPPORTED: [&str; 3] = ["convex_mesh", "spline", "brep"];

pub(super) fn read(
    document: &Document<'_>,
    sources: &mut DataSources,
    element: Element<'_>,
    counts: &mut BTreeMap<&'static str, u64>,
) -> Result<Geometry, ReadError> {
    let mut geometry = Geometry { name: name_of(element), primitives: Vec::new() };
    for kind in UNSUPPORTED {
        if let Some(child) = element.child(kind) {
            document.add("geometries of kinds that are not drawn", Severity::Warning, child.at(), || {
                format!("the geometry {:?} is a <{kind}>, which is not drawn", geometry.name)
            });
        }
    }
    let Some(mesh) = element.child("mesh") else { return Ok(geometry) };
    for child in mesh.children() {
        let shape = match child.name() {
            "triangles" => Shape::Triangles,
            "polylist" => Shape::Polylist,
            "polygons" => Shape::Polygons,
            "tristrips" => Shape::Strips,
            "trifans" => Shape::Fans,
            "lines" | "linestrips" => {
                *counts.entry(if child.name() == "lines" { "lines" } else { "linestrips" }).or_default() +=
                    document.count(child, "count").unwrap_or(0);
                document.add("lines that are not drawn", Severity::Note, child.at(), || {
                    format!("<{}> are not drawn", child.name())
                });
                continue;
            }
            _ => continue,
        };
        if let Some(primitive) = primitive(document, sources, child, shape, &geometry.name)? {
            *counts.entry(shape.name()).or_default() += shape.count(&primitive);
            geometry.primitives.push(primitive);
        }
    }
    Ok(geometry)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Triangles,
    Polylist,
    Polygons,
    Strips,
    Fans,
}

impl Shape {
    fn name(self) -> &'static str {
        match self {
            Shape::Triangles => "triangles",
            Shape::Polylist => "polygons of polylist",
            Shape::Polygons => "polygons",
            Shape::Strips => "triangles of tristrips",
            Shape::Fans => "triangles of trifans",
        }
    }

    fn count(self, primitive: &Primitive) -> u64 {
        match &primitive.sizes {
            Some(sizes) => sizes.len() as u64,
            None => (primitive.indices.len() / primitive.width.max(1) / 3) as u64,
        }
    }
}

fn primitive(
    document: &Document<'_>,
    sources: &mut DataSources,
    element: Element<'_>,
    shape: Shape,
    name: &str,
) -> Result<Option<Primitive>, ReadError> {
    let (inputs, width) = inputs(document, sources, element)?;
    if !inputs.iter().any(|input| input.semantic == Semantic::Position) {
        document.add_loss("primitives without positions", element.at(), || {
            format!("<{}> of the geometry {name:?} has no positions: it is not drawn", element.name())
        });
        return Ok(None);
    }
    let mut made = Primitive {
        symbol: element.attribute("material").map(|symbol| symbol.into_owned()),
        inputs,
        width,
        indices: Vec::new(),
        sizes: None,
        at: element.at(),
        places: Vec::new(),
    };
    match shape {
        Shape::Triangles => triangles(document, element, &mut made)?,
        Shape::Polylist => polylist(document, element, &mut made)?,
        Shape::Polygons => polygons(document, element, &mut made)?,
        Shape::Strips | Shape::Fans => strips_or_fans(document, element, shape, &mut made)?,
    }
    check_count(document, element, shape, &made);
    Ok(Some(made))
}

fn check_count(document: &Document<'_>, element: Element<'_>, shape: Shape, made: &Primitive) {
    let there = match shape {
        Shape::Strips | Shape::Fans => element.all("p").count() as u64,
        _ => shape.count(made),
    };
    if let Some(declared) = document.count(element, "count")
        && declared != there
    {
        document.add(COUNTS, Severity::Warning, element.at(), || {
            format!("<{}> declares {declared}, but contains {there}", element.name())
        });
    }
}

const COUNTS: &str = "wrong counts";
const LEFT_OVER: &str = "indices that do not form a polygon";

fn left_over(document: &Document<'_>, p: Element<'_>, count: usize) {
    document.add(LEFT_OVER, Severity::Warning, p.at(), || format!("{count} indices at the end do not form a polygon"));
}

fn triangles(document: &Document<'_>, element: Element<'_>, made: &mut Primitive) -> Result<(), ReadError> {
    for p in element.all("p") {
        made.places.push((made.indices.len(), p.index));
        document.indices(p, &mut made.indices)?;
        let excess = made.indices.len() % made.width.saturating_mul(3);
        if excess > 0 {
            left_over(document, p, excess);
            made.indices.truncate(made.indices.len() - excess);
        }
    }
    Ok(())
}

fn polylist(document: &Document<'_>, element: Element<'_>, made: &mut Primitive) -> Result<(), ReadError> {
    let mut sizes = Vec::new();
    if let Some(vcount) = element.child("vcount") {
        document.indices(vcount, &mut sizes)?;
    }
    let Some(p) = element.child("p") else {
        made.sizes = Some(Vec::new());
        return Ok(());
    };
    made.places.push((0, p.index));
    document.indices(p, &mut made.indices)?;
    // The polygons for which all indices exist.
    let mut used: usize = 0;
    let mut whole = 0;
    for &size in &sizes {
        let Some(end) = (size as usize).checked_mul(made.width).and_then(|n| n.checked_add(used)) else { break };
        if end > made.indices.len() {
            break;
        }
        used = end;
        whole += 1;
    }
    if whole < sizes.len() {
        document.add_loss("polygons whose indices are missing", p.at(), || {
            format!("vcount declares {} polygons, but there are indices for only {whole}", sizes.len())
        });
        sizes.truncate(whole);
    }
    if used < made.indices.len() {
        left_over(document, p, made.indices.len() - used);
        made.indices.truncate(used);
    }
    made.sizes = Some(sizes);
    Ok(())
}

fn polygons(document: &Document<'_>, element: Element<'_>, made: &mut Primitive) -> Result<(), ReadError> {
    let mut sizes = Vec::new();
    for child in element.children() {
        let p = match child.name() {
            "p" => Some(child),
            "ph" => {
                document.add("polygons with holes", Severity::Warning, child.at(), || {
                    "this polygon has holes, which are drawn filled".to_owned()
                });
                child.child("p")
            }
            _ => None,
        };
        let Some(p) = p else { continue };
        let before = made.indices.len();
        made.places.push((before, p.index));
        document.indices(p, &mut made.indices)?;
        let excess = (made.indices.len() - before) % made.width;
        if excess > 0 {
            left_over(document, p, excess);
            made.indices.truncate(made.indices.len() - excess);
        }
        sizes.push(u32::try_from((made.indices.len() - before) / made.width).unwrap_or(u32::MAX));
    }
    made.sizes = Some(sizes);
    Ok(())
}

fn strips_or_fans(
    document: &Document<'_>,
    element: Element<'_>,
    shape: Shape,
    made: &mut Primitive,
) -> Result<(), ReadError> {
    let mut strip = Vec::new();
    for p in element.all("p") {
        strip.clear();
        document.indices(p, &mut strip)?;
        let excess = strip.len() % made.width;
        if excess > 0 {
            left_over(document, p, excess);
        }
        let corners: Vec<&[u32]> = strip.chunks_exact(made.width).collect();
        for i in 2..corners.len() {
            let triangle = match shape {
                Shape::Fans => [0, i - 1, i],
                // Every other triangle of a strip has the opposite winding.
                _ if i % 2 == 0 => [i - 2, i - 1, i],
                _ => [i - 1, i - 2, i],
            };
            for corner in triangle {
                made.indices.extend_from_slice(corners[corner]);
            }
        }
    }
    Ok(())
}
