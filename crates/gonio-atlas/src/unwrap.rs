//! From a mesh to texture coordinates for each corner.

use crate::charts::{self, Segmentation};
use crate::crossing::find_overlap;
use crate::faces::{Faces, NONE};
use crate::flatten::{ChartMesh, flatten};
use crate::pack::{self, Outline, Placement};
use glam::DVec2;
use gonio_mesh::Mesh;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fmt;

/// The texture coordinates to start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UvSource {
    /// None: the mesh is cut into charts.
    #[default]
    New,
    /// Those of the mesh, unchanged.
    Kept,
    /// The charts of the mesh's own texture coordinates, scaled to equal density and packed again.
    Repacked,
}

/// How a mesh is unwrapped.
#[derive(Clone, Debug, PartialEq)]
pub struct UnwrapSettings {
    /// The largest angle between a triangle's normal and the axis of its chart, and between two triangles at an edge within
    /// a chart, in radians, above 0 and below pi / 2. Charts of less than a five-hundredth of the surface may bend further.
    pub angle_limit_rad: f64,
    /// The distance between charts as a share of the side, 0 to 0.25. Half of it stays free along the sides.
    pub margin: f64,
    /// The texture coordinates to start from.
    pub source: UvSource,
    /// Texels per unit of length in each part of the mesh, relative to the other parts, > 0; 1 for parts beyond its length. Does
    /// not apply to [`UvSource::Kept`].
    pub density_of_part: Vec<f64>,
    /// A number for each part of the mesh: parts with different ones share no chart. 0 for parts beyond its length. Does not apply to
    /// [`UvSource::Kept`].
    pub group_of_part: Vec<usize>,
}

impl Default for UnwrapSettings {
    /// 66 degrees and a margin of 0.01: the values of Blender's smart projection in the course's appendix.
    fn default() -> Self {
        UnwrapSettings {
            angle_limit_rad: 66_f64.to_radians(),
            margin: 0.01,
            source: UvSource::New,
            density_of_part: Vec::new(),
            group_of_part: Vec::new(),
        }
    }
}

/// Texture coordinates of a mesh, and its charts.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasUv {
    /// One for each index of the mesh; v up. Within [0, 1] unless they are [`UvSource::Kept`].
    pub tex_coords: Vec<[f32; 2]>,
    /// The chart of each triangle; `None` for degenerate ones, which cover no texel.
    pub chart_of_triangle: Vec<Option<u32>>,
    /// The number of charts.
    pub chart_count: usize,
    /// The distance kept between charts, as a share of the side: less than asked for if that leaves no room for so many
    /// charts; 0 for kept coordinates.
    pub margin: f64,
}

/// Describes why a mesh has no atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnwrapError {
    /// No triangle has an area.
    NoArea,
    /// The mesh has no texture coordinates that could be kept or repacked.
    NoTexCoords,
    /// The progress function returned false.
    Stopped,
}

impl fmt::Display for UnwrapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            UnwrapError::NoArea => "the model has no triangle with an area, so there is nothing to unwrap",
            UnwrapError::NoTexCoords => "the model has no texture coordinates to keep; make new ones instead",
            UnwrapError::Stopped => "unwrapping was stopped",
        })
    }
}

impl std::error::Error for UnwrapError {}

/// Unwraps a mesh. `progress` gets the share done, 0 to 1, from any thread; it returns whether to go on.
///
/// All triangles of the mesh, whatever their part, share one atlas with equal texel density, unless the settings weight it: the
/// area of a chart in the atlas is proportional to its area in space. Parts of different density or group share no
/// chart. Edges of more than two triangles, or of two with opposite orientation,
/// are cut.
///
/// # Errors
///
/// See [`UnwrapError`].
pub fn unwrap(
    mesh: &Mesh,
    settings: &UnwrapSettings,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<AtlasUv, UnwrapError> {
    let mut faces = Faces::new(mesh);
    if faces.areas.iter().all(|area| *area == 0.0) {
        return Err(UnwrapError::NoArea);
    }
    let density = of_triangles(mesh, &settings.density_of_part, 1.0);
    if settings.source != UvSource::Kept && !settings.density_of_part.is_empty() {
        faces.cut_between(|a, b| density[a] != density[b]);
    }
    if settings.source != UvSource::Kept && !settings.group_of_part.is_empty() {
        let group = of_triangles(mesh, &settings.group_of_part, 0);
        faces.cut_between(|a, b| group[a] != group[b]);
    }
    let step = |share: f64| if progress(share) { Ok(()) } else { Err(UnwrapError::Stopped) };
    step(0.1)?;
    if settings.source == UvSource::New {
        let limit_cos = settings.angle_limit_rad.clamp(0.01, 1.56).cos();
        faces.cut_sharp_edges(limit_cos);
        let segmentation = charts::segment(&faces, limit_cos);
        step(0.3)?;
        let mut charts = flatten_all(&faces, segmentation, &|share| step(0.3 + 0.3 * share))?;
        charts.iter_mut().for_each(|chart| chart.scale_to(&density));
        return assemble(&faces, &charts, settings.margin, &|share| progress(0.6 + 0.4 * share));
    }
    if mesh.tex_coords.len() != mesh.positions.len() {
        return Err(UnwrapError::NoTexCoords);
    }
    let segmentation = charts_in_texture(mesh, &faces);
    if settings.source == UvSource::Kept {
        let chart_of = segmentation.chart_of.iter().map(|&chart| (chart != NONE).then_some(chart)).collect();
        let tex_coords = mesh.indices.iter().map(|&vertex| mesh.tex_coords[vertex as usize]).collect();
        return Ok(AtlasUv { tex_coords, chart_of_triangle: chart_of, chart_count: segmentation.count, margin: 0.0 });
    }
    let mut charts = charts_of_texture(mesh, &faces, segmentation);
    charts.iter_mut().for_each(|chart| chart.scale_to(&density));
    assemble(&faces, &charts, settings.margin, &|share| progress(0.3 + 0.7 * share))
}

/// A chart in the plane, before it is packed.
struct FlatChart {
    triangles: Vec<u32>,
    /// Three places for each triangle.
    corners: Vec<[DVec2; 3]>,
    outline: Outline,
}

impl FlatChart {
    /// Scales it to the density of its triangles.
    fn scale_to(&mut self, density: &[f64]) {
        let scale = self.triangles.first().map_or(1.0, |&t| density[t as usize]);
        if scale != 1.0 {
            self.corners.iter_mut().flatten().for_each(|p| *p *= scale);
            self.outline.border.iter_mut().flatten().for_each(|p| *p *= scale);
            self.outline.area *= scale * scale;
        }
    }
}

/// The value of each triangle's part.
fn of_triangles<T: Copy>(mesh: &Mesh, of_part: &[T], otherwise: T) -> Vec<T> {
    let mut values = vec![otherwise; mesh.triangle_count()];
    for (part, &value) in mesh.parts.iter().zip(of_part) {
        let triangles = values.iter_mut().skip(part.first_triangle).take(part.triangle_count);
        triangles.for_each(|own| *own = value);
    }
    values
}

/// Flattens all charts, and divides those that overlap themselves until none does.
fn flatten_all(
    faces: &Faces,
    segmentation: Segmentation,
    step: &dyn Fn(f64) -> Result<(), UnwrapError>,
) -> Result<Vec<FlatChart>, UnwrapError> {
    let mut chart_of = segmentation.chart_of.clone();
    let mut pending: Vec<(u32, Vec<u32>)> = (0..).zip(segmentation.triangles()).collect();
    let mut next = segmentation.count as u32;
    let mut charts = Vec::new();
    while !pending.is_empty() {
        let flattened: Vec<Result<FlatChart, [Vec<u32>; 2]>> = pending
            .into_par_iter()
            .map(|(number, triangles)| flat_or_divided(faces, triangles, &|t| chart_of[t as usize] == number))
            .collect();
        pending = Vec::new();
        for result in flattened {
            match result {
                Ok(flat) => charts.push(flat),
                Err(halves) => {
                    for half in halves {
                        half.iter().for_each(|&t| chart_of[t as usize] = next);
                        pending.push((next, half));
                        next += 1;
                    }
                }
            }
        }
        step(1.0 - 1.0 / (1.0 + charts.len() as f64))?;
    }
    Ok(charts)
}

fn flat_or_divided(
    faces: &Faces,
    triangles: Vec<u32>,
    is_inside: &dyn Fn(u32) -> bool,
) -> Result<FlatChart, [Vec<u32>; 2]> {
    let chart = ChartMesh::new(faces, triangles, is_inside);
    let plane = flatten(faces, &chart, |plane| find_overlap(&chart, plane).map_or(Ok(()), Err))
        .map_err(|(a, b)| charts::divide(faces, &chart.triangles, chart.triangles[a], chart.triangles[b]))?;
    let border = chart.border.iter().map(|edge| {
        let (i, j) = chart.border_ends(edge);
        [plane[i as usize], plane[j as usize]]
    });
    let outline =
        Outline { border: border.collect(), area: chart.triangles.iter().map(|&t| faces.areas[t as usize]).sum() };
    let corners = chart.corners.iter().map(|corners| corners.map(|i| plane[i as usize])).collect();
    Ok(FlatChart { triangles: chart.triangles, corners, outline })
}

/// The charts of a mesh's own texture coordinates: triangles are connected where both ends of an edge have the same
/// coordinates in both.
fn charts_in_texture(mesh: &Mesh, faces: &Faces) -> Segmentation {
    let at = |t: usize, k: usize| mesh.tex_coords[mesh.indices[3 * t + k] as usize];
    let is_joined = |t: usize, k: usize, other: usize| {
        let (from, to) = (faces.corners[t][k], faces.corners[t][(k + 1) % 3]);
        let in_other = |place: u32| faces.corners[other].iter().position(|&corner| corner == place);
        let same = |own: [f32; 2], place: u32| in_other(place).is_some_and(|k| at(other, k) == own);
        same(at(t, k), from) && same(at(t, (k + 1) % 3), to)
    };
    let mut chart_of = vec![NONE; faces.len()];
    let mut count = 0;
    for start in 0..faces.len() {
        if chart_of[start] != NONE || faces.is_degenerate(start) {
            continue;
        }
        chart_of[start] = count;
        let mut open = vec![start];
        while let Some(t) = open.pop() {
            for (k, &other) in faces.neighbours[t].iter().enumerate() {
                if other != NONE && chart_of[other as usize] == NONE && is_joined(t, k, other as usize) {
                    chart_of[other as usize] = count;
                    open.push(other as usize);
                }
            }
        }
        count += 1;
    }
    Segmentation { chart_of, count: count as usize }
}

/// The length of a chart's edges in space by that in the texture. A chart that is nearly a line in the texture would become
/// longer than any other if its area were to count alone.
fn edge_scale(faces: &Faces, triangles: &[u32], corners: &[[DVec2; 3]]) -> f64 {
    let (mut in_space, mut in_texture) = (0.0, 0.0);
    for (&t, corners) in triangles.iter().zip(corners) {
        for k in 0..3 {
            in_space += faces.edge_length(t as usize, k);
            in_texture += corners[k].distance(corners[(k + 1) % 3]);
        }
    }
    in_space / in_texture
}

/// Those charts in the plane, each with the area of its surface. Mirrored ones stay mirrored; one without an area in the
/// texture stays a point.
fn charts_of_texture(mesh: &Mesh, faces: &Faces, segmentation: Segmentation) -> Vec<FlatChart> {
    let chart_of = &segmentation.chart_of;
    let place = |t: u32, k: usize| {
        let [u, v] = mesh.tex_coords[mesh.indices[3 * t as usize + k] as usize].map(f64::from);
        if u.is_finite() && v.is_finite() { DVec2::new(u, v) } else { DVec2::ZERO }
    };
    let flat = |triangles: Vec<u32>| {
        let area: f64 = triangles.iter().map(|&t| faces.areas[t as usize]).sum();
        let mut corners: Vec<[DVec2; 3]> = triangles.iter().map(|&t| [0, 1, 2].map(|k| place(t, k))).collect();
        let own: f64 = corners.iter().map(|c| crate::flatten::signed_area(*c).abs()).sum();
        let scale = (area / own).sqrt().min(2.0 * edge_scale(faces, &triangles, &corners));
        let scale = if scale.is_finite() { scale } else { 0.0 };
        corners.iter_mut().flatten().for_each(|p| *p *= scale);
        let mut border = Vec::new();
        for (corners, &t) in corners.iter().zip(&triangles) {
            for (k, &neighbour) in faces.neighbours[t as usize].iter().enumerate() {
                if neighbour == NONE || chart_of[neighbour as usize] != chart_of[t as usize] {
                    border.push([corners[k], corners[(k + 1) % 3]]);
                }
            }
        }
        // A closed surface whose texture is one point has no border.
        if border.is_empty() {
            border.extend(corners.first().map(|corners| [corners[0]; 2]));
        }
        FlatChart { triangles, corners, outline: Outline { border, area } }
    };
    segmentation.triangles().into_iter().map(flat).collect()
}

/// Packs the charts and gives each corner its coordinates.
fn assemble(
    faces: &Faces,
    charts: &[FlatChart],
    margin: f64,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<AtlasUv, UnwrapError> {
    let outlines: Vec<Outline> = charts.iter().map(|chart| chart.outline.clone()).collect();
    let (placements, margin) = pack::pack(&outlines, margin, progress).ok_or(UnwrapError::Stopped)?;
    let mut tex_coords = vec![[0.0; 2]; 3 * faces.len()];
    let mut chart_of_triangle = vec![None; faces.len()];
    for (number, (chart, placement)) in charts.iter().zip(&placements).enumerate() {
        place_chart(chart, placement, &mut tex_coords);
        chart.triangles.iter().for_each(|&t| chart_of_triangle[t as usize] = Some(number as u32));
    }
    place_degenerate(faces, &chart_of_triangle, &mut tex_coords);
    Ok(AtlasUv { tex_coords, chart_of_triangle, chart_count: charts.len(), margin })
}

fn place_chart(chart: &FlatChart, placement: &Placement, tex_coords: &mut [[f32; 2]]) {
    for (&triangle, corners) in chart.triangles.iter().zip(&chart.corners) {
        for (k, corner) in corners.iter().enumerate() {
            let uv = placement.apply(*corner).clamp(DVec2::ZERO, DVec2::ONE);
            tex_coords[3 * triangle as usize + k] = uv.as_vec2().to_array();
        }
    }
}

/// Gives triangles without area the coordinates that their corners have in one of the charts beside them; corners that
/// are not in that chart get those of one that is, so that the triangle stays without area in the texture.
fn place_degenerate(faces: &Faces, chart_of: &[Option<u32>], tex_coords: &mut [[f32; 2]]) {
    if chart_of.iter().all(Option::is_some) {
        return;
    }
    let mut known: HashMap<u32, (u32, [f32; 2])> = HashMap::new();
    for (t, chart) in chart_of.iter().enumerate() {
        let Some(chart) = chart else { continue };
        for k in 0..3 {
            known.entry(faces.corners[t][k]).or_insert((*chart, tex_coords[3 * t + k]));
        }
    }
    for t in (0..faces.len()).filter(|&t| chart_of[t].is_none()) {
        let found = faces.corners[t].map(|place| known.get(&place).copied());
        let Some((chart, uv)) = found.into_iter().flatten().next() else { continue };
        for (k, own) in found.into_iter().enumerate() {
            tex_coords[3 * t + k] = own.filter(|(other, _)| *other == chart).map_or(uv, |(_, uv)| uv);
        }
    }
}
