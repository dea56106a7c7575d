//! Which triangle of the original each triangle of the answer is.
//!
//! Vertices are the same if they are in the same place; triangles if their corners are. Where a program divided polygons along
//! other diagonals, points are matched with the nearest point of those triangles of the original that no triangle of the answer
//! is.

use glam::{DMat3, DVec3};
use gonio_bake::texels::TexelSample;
use gonio_mesh::Mesh;
use std::collections::HashMap;

/// Largest distance of the same vertex in two files, as a share of the model's diagonal: exporters write six decimals, and
/// compressed files round to a part in 16,384.
const SAME_PLACE: f64 = 1e-4;
/// Largest distance of points on polygons that are divided differently.
const SAME_SURFACE: f64 = 4e-3;
/// Vertices by which a placement is tested.
const TESTED: usize = 400;
/// Most triangles that are matched by nearest points.
const MOST_OTHER: usize = 20_000;

/// How the answer's axes, unit and place differ: `original = scale * axes * answer + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelPlacement {
    /// A permutation of the axes with signs.
    pub axes: DMat3,
    /// 1 in the same unit.
    pub scale: f64,
    /// Zero in the same place.
    pub offset: DVec3,
}

impl ModelPlacement {
    const SAME: ModelPlacement = ModelPlacement { axes: DMat3::IDENTITY, scale: 1.0, offset: DVec3::ZERO };

    fn apply(&self, position: DVec3) -> DVec3 {
        self.scale * (self.axes * position) + self.offset
    }

    /// Whether the axes are those of the original.
    pub fn has_same_axes(&self) -> bool {
        self.axes == DMat3::IDENTITY
    }

    /// Whether it is a mirror image.
    pub fn is_mirrored(&self) -> bool {
        self.axes.determinant() < 0.0
    }
}

/// The counterpart of a triangle of the answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Counterpart {
    /// A triangle of the original; its corner for each corner of the answer's triangle.
    Same(u32, [u8; 3]),
    /// Parts of these triangles of the original.
    Among(Vec<u32>),
    /// None.
    Nothing,
}

/// The counterparts of all triangles.
pub struct Matching {
    /// Where the answer is.
    pub placement: ModelPlacement,
    /// For each triangle of the answer.
    pub counterparts: Vec<Counterpart>,
    /// Triangles of the original without a counterpart.
    pub missing: Vec<usize>,
    /// The length of the original's diagonal.
    pub diagonal: f64,
    /// The answer's vertices in the original's space.
    positions: Vec<DVec3>,
}

impl Matching {
    /// Matches a model with the original. `None` if most vertices of the model are not in the original.
    pub fn new(original: &Mesh, answer: &Mesh) -> Option<Matching> {
        let places = Places::new(original);
        let placement = find_placement(&places, original, answer)?;
        let positions: Vec<DVec3> = answer.positions.iter().map(|p| placement.apply(vector(*p))).collect();
        let place_of: Vec<Option<u32>> = positions.iter().map(|p| places.find(*p)).collect();
        let mut by_corners: HashMap<[u32; 3], Vec<u32>> = HashMap::new();
        for t in 0..original.triangle_count() {
            let corners = original.triangle(t).map(|i| places.of_vertex[i]);
            by_corners.entry(sorted(corners)).or_default().push(t as u32);
        }
        let mut is_matched = vec![false; original.triangle_count()];
        let mut counterparts: Vec<Counterpart> = (0..answer.triangle_count())
            .map(|t| {
                let corners = answer.triangle(t).map(|i| place_of[i]);
                let [Some(a), Some(b), Some(c)] = corners else { return Counterpart::Nothing };
                let Some(known) = by_corners.get(&sorted([a, b, c])) else { return Counterpart::Nothing };
                let Some(&found) = known.iter().find(|&&o| !is_matched[o as usize]).or_else(|| known.first()) else {
                    return Counterpart::Nothing;
                };
                is_matched[found as usize] = true;
                let own = original.triangle(found as usize).map(|i| places.of_vertex[i]);
                let corner = |place: u32| own.iter().position(|o| *o == place).unwrap_or(0) as u8;
                Counterpart::Same(found, [a, b, c].map(corner))
            })
            .collect();
        let shape =
            |mesh: &Mesh, positions: &dyn Fn(usize) -> DVec3, t: usize| Shape::new(mesh.triangle(t).map(positions));
        let of_original = |i: usize| vector(original.positions[i]);
        let of_answer = |i: usize| positions[i];
        let left: Vec<(usize, Shape)> = (0..original.triangle_count())
            .filter(|&t| !is_matched[t])
            .map(|t| (t, shape(original, &of_original, t)))
            .filter(|(_, shape)| shape.has_area())
            .collect();
        let other: Vec<(usize, Shape)> = (0..answer.triangle_count())
            .filter(|&t| counterparts[t] == Counterpart::Nothing)
            .map(|t| (t, shape(answer, &of_answer, t)))
            .filter(|(_, shape)| shape.has_area())
            .collect();
        let mut missing: Vec<usize> = left.iter().map(|(t, _)| *t).collect();
        if !left.is_empty() && !other.is_empty() && other.len() <= MOST_OTHER {
            let reach = SAME_SURFACE * places.diagonal;
            for (t, shape) in &other {
                let near = shape.within(&left, reach);
                if !near.is_empty() {
                    counterparts[*t] = Counterpart::Among(near.iter().map(|t| *t as u32).collect());
                }
            }
            missing =
                left.iter().filter(|(_, shape)| shape.within(&other, reach).is_empty()).map(|(t, _)| *t).collect();
        }
        Some(Matching { placement, counterparts, missing, diagonal: places.diagonal, positions })
    }

    /// The point of the original that a point of the answer is.
    pub fn original_sample(&self, original: &Mesh, answer: &Mesh, sample: &TexelSample) -> Option<TexelSample> {
        match &self.counterparts[sample.triangle] {
            Counterpart::Same(triangle, corners) => {
                let turned = |weights: DVec3| {
                    let mut own = [0.0; 3];
                    corners.iter().zip(weights.to_array()).for_each(|(&corner, w)| own[usize::from(corner)] += w);
                    DVec3::from_array(own)
                };
                let steps = sample.steps.map(turned);
                Some(TexelSample { triangle: *triangle as usize, weights: turned(sample.weights), steps, ..*sample })
            }
            Counterpart::Among(near) => {
                let [a, b, c] = answer.triangle(sample.triangle).map(|i| self.positions[i]);
                let at = sample.weights.x * a + sample.weights.y * b + sample.weights.z * c;
                let shapes = near.iter().map(|&t| {
                    let shape = Shape::new(original.triangle(t as usize).map(|i| vector(original.positions[i])));
                    let (point, weights) = shape.nearest(at);
                    (point.distance_squared(at), t, weights)
                });
                let (_, triangle, weights) = shapes.min_by(|a, b| a.0.total_cmp(&b.0))?;
                Some(TexelSample { triangle: triangle as usize, weights, steps: [DVec3::ZERO; 2], ..*sample })
            }
            Counterpart::Nothing => None,
        }
    }
}

fn vector(position: [f32; 3]) -> DVec3 {
    DVec3::from(position.map(f64::from))
}

fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}

/// The vertices of the original by their place.
struct Places {
    of_vertex: Vec<u32>,
    cells: HashMap<[i64; 3], Vec<(u32, DVec3)>>,
    reach: f64,
    diagonal: f64,
}

impl Places {
    fn new(mesh: &Mesh) -> Places {
        let diagonal = mesh.bounds().map_or(1.0, |bounds| f64::from(bounds.size().length())).max(1e-9);
        let (of_vertex, _) = mesh.places();
        let mut places = Places { of_vertex, cells: HashMap::new(), reach: SAME_PLACE * diagonal, diagonal };
        for (i, position) in mesh.positions.iter().enumerate() {
            let (place, position) = (places.of_vertex[i], vector(*position));
            let cell = places.cells.entry(places.cell(position)).or_default();
            if !cell.iter().any(|(known, _)| *known == place) {
                cell.push((place, position));
            }
        }
        places
    }

    fn cell(&self, position: DVec3) -> [i64; 3] {
        (position / self.reach).floor().to_array().map(|c| c as i64)
    }

    /// The nearest place within reach.
    fn find(&self, position: DVec3) -> Option<u32> {
        let [x, y, z] = self.cell(position);
        let around = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        let known = around
            .filter_map(|[i, j, k]| self.cells.get(&[x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)]));
        let near = known.flatten().map(|(place, at)| (at.distance(position), *place));
        near.filter(|(distance, _)| *distance <= self.reach).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
    }
}

/// The 48 ways to permute the axes and change their signs, the identity first.
fn all_axes() -> impl Iterator<Item = DMat3> {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    ORDERS.into_iter().flat_map(move |order| {
        (0..8).map(move |signs| {
            let column = |k: usize| if signs >> k & 1 == 1 { -axes[order[k]] } else { axes[order[k]] };
            DMat3::from_cols(column(0), column(1), column(2))
        })
    })
}

fn find_placement(places: &Places, original: &Mesh, answer: &Mesh) -> Option<ModelPlacement> {
    let step = answer.positions.len().div_ceil(TESTED).max(1);
    let tested: Vec<DVec3> = answer.positions.iter().step_by(step).map(|p| vector(*p)).collect();
    let share = |placement: &ModelPlacement| {
        let found = tested.iter().filter(|p| places.find(placement.apply(**p)).is_some()).count();
        found as f64 / tested.len().max(1) as f64
    };
    let (own, other) = (original.bounds()?, answer.bounds()?);
    let scale = f64::from(own.size().length()) / f64::from(other.size().length());
    let fitted = |axes: DMat3| {
        let offset = own.center().as_dvec3() - scale * (axes * other.center().as_dvec3());
        ModelPlacement { axes, scale, offset }
    };
    let about_origin = all_axes().map(|axes| ModelPlacement { axes, ..ModelPlacement::SAME });
    let scaled = all_axes().map(|axes| ModelPlacement { axes, scale, offset: DVec3::ZERO });
    let candidates = about_origin.chain(scaled).chain(all_axes().map(fitted));
    let mut best: Option<(f64, ModelPlacement)> = None;
    for placement in candidates.filter(|placement| placement.scale.is_finite()) {
        let share = share(&placement);
        if best.is_none_or(|(known, _)| share > known) {
            best = Some((share, placement));
        }
        if share > 0.98 {
            break;
        }
    }
    best.filter(|(share, _)| *share >= 0.5).map(|(_, placement)| placement)
}

/// A triangle in space.
struct Shape {
    corners: [DVec3; 3],
    normal: DVec3,
    low: DVec3,
    high: DVec3,
}

impl Shape {
    fn new(corners: [DVec3; 3]) -> Shape {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        Shape { corners, normal: normal.normalize_or_zero(), low: a.min(b).min(c), high: a.max(b).max(c) }
    }

    fn has_area(&self) -> bool {
        self.normal != DVec3::ZERO
    }

    /// The triangles that are nearest to a point of this one and face the same way; none if a point is out of their reach.
    fn within(&self, others: &[(usize, Shape)], reach: f64) -> Vec<usize> {
        let touches = |other: &Shape| {
            let apart = self.low.cmpgt(other.high + reach).any() || other.low.cmpgt(self.high + reach).any();
            !apart && other.normal.dot(self.normal).abs() > 0.7
        };
        let candidates: Vec<&(usize, Shape)> = others.iter().filter(|(_, other)| touches(other)).collect();
        let mut found = Vec::new();
        for at in self.grid() {
            let distance = |other: &Shape| other.nearest(at).0.distance_squared(at);
            let near = candidates.iter().map(|(t, other)| (distance(other), *t)).min_by(|a, b| a.0.total_cmp(&b.0));
            match near {
                Some((distance, t)) if distance <= reach * reach => found.push(t),
                _ => return Vec::new(),
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Points all over the triangle.
    fn grid(&self) -> impl Iterator<Item = DVec3> {
        const STEPS: u32 = 5;
        let [a, b, c] = self.corners;
        (0..=STEPS).flat_map(move |i| {
            (0..=STEPS - i).map(move |j| {
                // A little inside, where no neighbour is as near.
                let share = |k: u32| (f64::from(k) + 0.2) / (f64::from(STEPS) + 0.6);
                share(i) * a + share(j) * b + share(STEPS - i - j) * c
            })
        })
    }

    /// The nearest point of the triangle and its weights (Ericson, *Real-Time Collision Detection*, 5.1.5, by projection
    /// onto the plane and then onto the edges).
    fn nearest(&self, p: DVec3) -> (DVec3, DVec3) {
        let [a, b, c] = self.corners;
        let area = (b - a).cross(c - a);
        let weight = |q: DVec3, r: DVec3| (q - p).cross(r - p).dot(area) / area.length_squared();
        let weights = DVec3::new(weight(b, c), weight(c, a), weight(a, b));
        let point = |w: DVec3| w.x * a + w.y * b + w.z * c;
        if weights.is_finite() && weights.min_element() >= 0.0 {
            return (point(weights), weights);
        }
        let on_edge = |k: usize| {
            let (from, to) = (self.corners[k], self.corners[(k + 1) % 3]);
            let along = ((p - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
            let along = if along.is_finite() { along } else { 0.0 };
            let mut weights = [0.0; 3];
            (weights[k], weights[(k + 1) % 3]) = (1.0 - along, along);
            DVec3::from_array(weights)
        };
        let edges = [0, 1, 2].map(on_edge).map(|w| (point(w), w));
        edges
            .into_iter()
            .min_by(|x, y| x.0.distance_squared(p).total_cmp(&y.0.distance_squared(p)))
            .unwrap_or((a, DVec3::X))
    }
}
