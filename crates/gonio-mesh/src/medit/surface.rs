//! Selects the faces to draw: the surface in the file, or else the boundary of its volume elements.

use super::Rows;
use super::content::{Content, Elements, Locator};
use crate::Severity;
use crate::diagnostic::Reports;
use glam::DVec3;

const NO_VERTEX: &str = "elements with an index out of range";

/// Marks the fourth corner of a triangle.
pub(super) const NONE: u32 = u32::MAX;

/// A face with vertices from 0.
pub(super) struct Face {
    pub(super) corners: [u32; 4],
    pub(super) reference: i64,
    /// The number of corners of its element and the element's index, which normals may refer to.
    pub(super) element: Option<(usize, usize)>,
}

impl Face {
    pub(super) fn vertices(&self) -> &[u32] {
        if self.corners[3] == NONE { &self.corners[..3] } else { &self.corners }
    }
}

/// Returns all faces to draw, in the order of the file.
pub(super) fn faces(content: &Content, locator: &Locator<'_>, reports: &mut Reports) -> Vec<Face> {
    let has_surface = content.elements.iter().any(|e| !e.is_volume && !e.references.is_empty());
    let mut faces = Vec::new();
    let mut boundary = Vec::new();
    for elements in content.elements.iter().filter(|e| !e.references.is_empty()) {
        explain(elements, has_surface, content, locator, reports);
        match (elements.is_volume, has_surface) {
            (false, _) => add_surface(elements, content, locator, reports, &mut faces),
            (true, true) => {}
            (true, false) => add_volume(elements, content, locator, reports, &mut boundary),
        }
    }
    if !has_surface {
        faces = without_inner(boundary);
    }
    faces
}

/// Reports elements that are drawn differently than one might expect.
fn explain(elements: &Elements, has_surface: bool, content: &Content, locator: &Locator<'_>, reports: &mut Reports) {
    let keyword = elements.keyword;
    let at = content.counts.iter().find(|(k, ..)| k.code == keyword.code).map_or(0, |(.., at)| *at);
    let is_curved = match keyword.rows {
        Rows::Surface { corners, nodes } | Rows::Volume { corners, nodes } => nodes > corners,
        _ => false,
    };
    let message = match (elements.is_volume, has_surface) {
        (true, true) => format!("{} are not drawn: the file has a surface of its own", keyword.name),
        (true, false) => {
            format!("{} are drawn by their boundary: the faces that belong to only one of them", keyword.name)
        }
        (false, _) if is_curved => format!("{} are drawn by their corners, as if they were flat", keyword.name),
        (false, _) => return,
    };
    locator.report(Severity::Note, at, reports, message);
}

/// Returns the vertices of an element, from 0, or `None` if one of them does not exist.
fn vertices<'a>(
    elements: &'a Elements,
    index: usize,
    content: &Content,
    locator: &Locator<'_>,
    reports: &mut Reports,
) -> Option<&'a [u32]> {
    let corners = elements.vertices.get(index * elements.corners..(index + 1) * elements.corners)?;
    let count = content.vertices.len();
    let Some(bad) = corners.iter().find(|&&v| v == 0 || v as usize > count) else { return Some(corners) };
    let at = elements.places.get(index).copied().unwrap_or(0);
    locator.warn(NO_VERTEX, at, reports, || {
        let name = elements.keyword.name;
        let bad = if *bad == NONE { "an invalid vertex index".to_owned() } else { format!("the vertex {bad}") };
        format!("an element of {name} refers to {bad}, but vertices are numbered 1 to {count}: it is left out")
    });
    None
}

fn add_surface(
    elements: &Elements,
    content: &Content,
    locator: &Locator<'_>,
    reports: &mut Reports,
    faces: &mut Vec<Face>,
) {
    faces.reserve(elements.references.len());
    let has_normals = matches!(elements.keyword.rows, Rows::Surface { corners, nodes } if corners == nodes);
    for (index, &reference) in elements.references.iter().enumerate() {
        if let Some(v) = vertices(elements, index, content, locator, reports) {
            let corner = |i: usize| v.get(i).map_or(NONE, |vertex| vertex - 1);
            let corners = [corner(0), corner(1), corner(2), corner(3)];
            faces.push(Face { corners, reference, element: has_normals.then_some((elements.corners, index)) });
        }
    }
}

const T: usize = usize::MAX;
const TETRAHEDRON: &[[usize; 4]] = &[[0, 1, 2, T], [0, 1, 3, T], [1, 2, 3, T], [0, 2, 3, T]];
const PYRAMID: &[[usize; 4]] = &[[0, 1, 2, 3], [0, 1, 4, T], [1, 2, 4, T], [2, 3, 4, T], [3, 0, 4, T]];
const PRISM: &[[usize; 4]] = &[[0, 1, 2, T], [3, 4, 5, T], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]];
const HEXAHEDRON: &[[usize; 4]] = &[[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn add_volume(
    elements: &Elements,
    content: &Content,
    locator: &Locator<'_>,
    reports: &mut Reports,
    faces: &mut Vec<Face>,
) {
    let sides = match elements.corners {
        4 => TETRAHEDRON,
        5 => PYRAMID,
        6 => PRISM,
        _ => HEXAHEDRON,
    };
    for (index, &reference) in elements.references.iter().enumerate() {
        let Some(v) = vertices(elements, index, content, locator, reports) else { continue };
        let at =
            |vertex: u32| content.vertices.get(vertex as usize).map_or(DVec3::ZERO, |p| DVec3::from(p.map(f64::from)));
        let center = v.iter().map(|vertex| at(vertex - 1)).sum::<DVec3>() / v.len() as f64;
        for side in sides {
            let mut corners = side.map(|i| v.get(i).map_or(NONE, |vertex| vertex - 1));
            if faces_inward(corners, center, at) {
                // Swap the other two corners of a triangle, or two opposite corners of a quadrilateral.
                if corners[3] == NONE { corners.swap(1, 2) } else { corners.swap(1, 3) }
            }
            faces.push(Face { corners, reference, element: None });
        }
    }
}

/// Programs differ in the order of a volume's corners, so its centre decides which side is outside.
fn faces_inward(corners: [u32; 4], center: DVec3, at: impl Fn(u32) -> DVec3) -> bool {
    let [a, b, c] = [at(corners[0]), at(corners[1]), at(corners[2])];
    let normal = if corners[3] == NONE { (b - a).cross(c - a) } else { (c - a).cross(at(corners[3]) - b) };
    normal.dot(0.5 * (a + c) - center) < 0.0
}

/// Removes faces that occur twice, keeping the order.
fn without_inner(faces: Vec<Face>) -> Vec<Face> {
    let mut keys: Vec<([u32; 4], usize)> = faces
        .iter()
        .enumerate()
        .map(|(index, face)| {
            let mut key = face.corners;
            key.sort_unstable();
            (key, index)
        })
        .collect();
    keys.sort_unstable();
    let mut is_outer = vec![true; faces.len()];
    for pair in keys.windows(2) {
        if let [(a, i), (b, j)] = pair
            && a == b
        {
            is_outer[*i] = false;
            is_outer[*j] = false;
        }
    }
    let mut outer = is_outer.into_iter();
    faces.into_iter().filter(|_| outer.next() == Some(true)).collect()
}
