//! Builds an indexed mesh with a normal for each triangle from facets.

use super::Facets;
use crate::join::Joiner;
use crate::limits::too_many_vertices;
use crate::report::Reports;
use crate::tally::Tally;
use crate::{Limits, Mesh, Model, NormalSource, Part, ReadError, Severity, weld};
use glam::DVec3;

/// The cosine of the largest angle between a normal and that of the corners: 10 degrees. Six digits are more exact, and
/// so are the normals of all but the thinnest triangles.
const AGREES: f64 = 0.985;

pub(super) fn model(mut facets: Facets, limits: &Limits, mut reports: Reports) -> Result<Model, ReadError> {
    let (normals, normal_source) = normals(&facets, &mut reports);
    let (places, place_count) = weld::places(&facets.corners);
    let mut joiner = Joiner::new(place_count);
    let mut mesh = Mesh { normal_source, parts: parts(&facets), ..Mesh::default() };
    mesh.indices.reserve_exact(facets.corners.len());
    for (corner, (&place, &position)) in places.iter().zip(&facets.corners).enumerate() {
        let normal = normals[corner / 3];
        let color = facets.colors.get(corner / 3);
        let [x, y, z] = normal.map(f32::to_bits);
        let [r, g, b, _] = color.copied().unwrap_or_default().map(f32::to_bits);
        let (vertex, is_new) = joiner.vertex(place, [x, y, z, r, g, b]);
        if is_new {
            mesh.positions.push(position);
            mesh.normals.push(normal);
            mesh.colors.extend(color);
            if mesh.positions.len() as u64 > limits.max_vertices.min(u64::from(u32::MAX)) {
                let most = limits.max_vertices.min(u64::from(u32::MAX));
                return Err(too_many_vertices(most));
            }
        }
        mesh.indices.push(vertex);
    }
    let mut contents = std::mem::take(&mut facets.contents);
    contents.push(("distinct positions".to_owned(), place_count as u64));
    Ok(Model { mesh, materials: vec![facets.material], contents, diagnostics: reports.finish(), ..Model::default() })
}

/// Returns the spans of facets with one name.
fn parts(facets: &Facets) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let ends = facets.solids.iter().skip(1).map(|solid| solid.1).chain([facets.count()]);
    // Facets before the first `solid`.
    let before = facets.solids.first().map_or(facets.count(), |solid| solid.1);
    let nameless = (String::new(), 0);
    let solids = facets.solids.iter().zip(ends);
    for ((name, first_triangle), end) in [(&nameless, before)].into_iter().chain(solids) {
        let triangle_count = end - first_triangle;
        match parts.last_mut() {
            _ if triangle_count == 0 => {}
            Some(last) if last.name == *name => last.triangle_count += triangle_count,
            _ => {
                let (name, first_triangle) = (name.clone(), *first_triangle);
                parts.push(Part { name, material: 0, first_triangle, triangle_count });
            }
        }
    }
    parts
}

/// Returns one normal for each facet: the written one, or that of its corners.
fn normals(facets: &Facets, reports: &mut Reports) -> (Vec<[f32; 3]>, NormalSource) {
    let mut anomalies = Anomalies::default();
    let normals = facets.corners.chunks_exact(3).zip(&facets.normals).enumerate();
    let normals: Vec<[f32; 3]> =
        normals.map(|(i, (corners, &written))| anomalies.normal(i, corners, written)).collect();
    let computed = anomalies.absent.count + anomalies.against.count + anomalies.off.count;
    anomalies.report(facets.count(), reports);
    (normals, if computed == 0 { NormalSource::File } else { NormalSource::Flat })
}

#[derive(Default)]
struct Anomalies {
    absent: Tally,
    against: Tally,
    off: Tally,
    no_area: Tally,
}

impl Anomalies {
    fn normal(&mut self, facet: usize, corners: &[[f32; 3]], written: [f32; 3]) -> [f32; 3] {
        let place = || format!("facet {facet}");
        // A vector that is zero, infinite or NaN cannot be normalized.
        let written = DVec3::from(written.map(f64::from)).try_normalize();
        let computed = match corners {
            [a, b, c] => unit_normal([a, b, c].map(|&corner| DVec3::from(corner.map(f64::from)))),
            _ => None,
        };
        let normal = match (written, computed) {
            (None, None) => {
                self.no_area.add(None, place);
                return [0.0; 3];
            }
            (Some(written), None) => written,
            (None, Some(computed)) => {
                self.absent.add(None, place);
                computed
            }
            (Some(written), Some(computed)) => {
                let cosine = written.dot(computed);
                if cosine >= AGREES {
                    written
                } else {
                    (if cosine < 0.0 { &mut self.against } else { &mut self.off }).add(None, place);
                    computed
                }
            }
        };
        // Without -0, which would separate vertices.
        normal.as_vec3().to_array().map(|c| c + 0.0)
    }

    fn report(&self, count: usize, reports: &mut Reports) {
        let computed = "computed from the corners";
        self.absent.report(Severity::Note, reports, |tally| {
            format!("{} of {count} facets have no normal (the first is {}): {computed}", tally.count, tally.first)
        });
        self.against.report(Severity::Warning, reports, |tally| {
            let what = "normals point against the winding of their corners";
            format!("{} of {count} {what} (the first is that of {}): {computed}", tally.count, tally.first)
        });
        self.off.report(Severity::Warning, reports, |tally| {
            let what = "normals lie more than 10 degrees off their facet";
            format!("{} of {count} {what} (the first is that of {}): {computed}", tally.count, tally.first)
        });
        self.no_area.report(Severity::Warning, reports, |tally| {
            let facets = tally.counted("facet has", "facets have");
            format!("{facets} neither an area nor a normal (the first is {})", tally.first)
        });
    }
}

/// Returns `None` if the triangle has no area other than the rounding error of parallel edges.
fn unit_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (ab, ac) = (b - a, c - a);
    let cross = ab.cross(ac);
    let is_degenerate = cross.length_squared() <= 1e-28 * ab.length_squared() * ac.length_squared();
    if is_degenerate { None } else { cross.try_normalize() }
}
