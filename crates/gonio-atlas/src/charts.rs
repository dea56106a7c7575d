//! Charts: connected groups of triangles whose normals stay within an angle of the chart's axis.
//!
//! Charts are grown triangle by triangle from seeds (M. Garland, A. Willmott, P. S. Heckbert, "Hierarchical face
//! clustering on polygonal surfaces", 2001), then balanced by growing all of them at once from their middles, as in
//! D. Cohen-Steiner, P. Alliez, M. Desbrun, "Variational shape approximation" (SIGGRAPH 2004). The limit of the angle,
//! 66 degrees by default, is that of Blender's smart projection.

use crate::faces::{Faces, NONE};
use glam::DVec3;
use gonio_mesh::ByCost;
use std::collections::{BinaryHeap, HashMap, HashSet};

/// Rounds of balancing. After three the borders hardly move.
const ROUNDS: usize = 3;

/// The weight of a straight border against the angle between normals.
const STRAIGHTNESS: f64 = 0.15;

/// A chart with less than this share of the area is small; it joins a neighbour up to this angle.
const SMALL_SHARE: f64 = 0.002;
const SMALL_LIMIT_COS: f64 = 0.2;

/// The chart of each triangle, [`NONE`] for degenerate ones; and the number of charts.
pub(crate) struct Segmentation {
    pub chart_of: Vec<u32>,
    pub count: usize,
}

impl Segmentation {
    /// The triangles of each chart, in order.
    pub fn triangles(&self) -> Vec<Vec<u32>> {
        let mut charts = vec![Vec::new(); self.count];
        for (triangle, &chart) in self.chart_of.iter().enumerate() {
            if let Some(triangles) = charts.get_mut(chart as usize) {
                triangles.push(triangle as u32);
            }
        }
        charts
    }
}

/// Returns charts in which every normal is within `limit_cos` of one axis; small ones may exceed it.
pub(crate) fn segment(faces: &Faces, limit_cos: f64) -> Segmentation {
    let mut growth = Growth::new(faces, limit_cos);
    growth.cover_the_rest();
    for _ in 0..ROUNDS {
        growth.balance();
        growth.cover_the_rest();
    }
    let segmentation = Segmentation { count: growth.axes.len(), chart_of: growth.chart_of };
    merge(faces, segmentation, limit_cos)
}

/// A triangle that may join a chart: (triangle, chart).
type Candidate = ByCost<(u32, u32)>;

struct Growth<'a> {
    faces: &'a Faces,
    limit_cos: f64,
    chart_of: Vec<u32>,
    /// Unit axis of each chart.
    axes: Vec<DVec3>,
    heap: BinaryHeap<Candidate>,
}

impl<'a> Growth<'a> {
    fn new(faces: &'a Faces, limit_cos: f64) -> Self {
        Growth { faces, limit_cos, chart_of: vec![NONE; faces.len()], axes: Vec::new(), heap: BinaryHeap::new() }
    }

    /// Grows new charts, one after another, until all triangles belong to one. A triangle at the border of the last
    /// chart is the next seed.
    fn cover_the_rest(&mut self) {
        let mut beside: Vec<u32> = Vec::new();
        let mut next = 0;
        loop {
            let is_free = |chart_of: &[u32], t: u32| chart_of[t as usize] == NONE;
            while beside.last().is_some_and(|&t| !is_free(&self.chart_of, t)) {
                beside.pop();
            }
            let seed = beside.pop().or_else(|| {
                while next < self.faces.len() && (self.chart_of[next] != NONE || self.faces.is_degenerate(next)) {
                    next += 1;
                }
                (next < self.faces.len()).then_some(next as u32)
            });
            let Some(seed) = seed else { return };
            self.grow_one(seed, &mut beside);
        }
    }

    /// Grows a chart whose axis is the mean normal of what it has. Triangles may end up beyond the limit as the axis
    /// moves; balancing removes them.
    fn grow_one(&mut self, seed: u32, beside: &mut Vec<u32>) {
        let chart = self.axes.len() as u32;
        let mut sum = DVec3::ZERO;
        self.axes.push(self.faces.normals[seed as usize]);
        self.heap.push(Candidate { cost: 0.0, of: (seed, chart) });
        while let Some(Candidate { of: (triangle, _), .. }) = self.heap.pop() {
            let t = triangle as usize;
            if self.chart_of[t] != NONE {
                continue;
            }
            if self.faces.normals[t].dot(self.axes[chart as usize]) < self.limit_cos {
                beside.push(triangle);
                continue;
            }
            self.chart_of[t] = chart;
            sum += self.faces.areas[t] * self.faces.normals[t];
            self.axes[chart as usize] = sum.normalize_or(self.axes[chart as usize]);
            self.push_neighbours(triangle, chart);
        }
    }

    fn push_neighbours(&mut self, triangle: u32, chart: u32) {
        for neighbour in self.faces.neighbours[triangle as usize] {
            if neighbour != NONE && self.chart_of[neighbour as usize] == NONE {
                let cost = self.cost(neighbour as usize, chart);
                self.heap.push(Candidate { cost, of: (neighbour, chart) });
            }
        }
    }

    /// The angle to the axis as 1 - cos, and whether the triangle shortens the border.
    fn cost(&self, triangle: usize, chart: u32) -> f64 {
        let (mut inside, mut outside) = (0.0, 0.0);
        for (k, &neighbour) in self.faces.neighbours[triangle].iter().enumerate() {
            let length = self.faces.edge_length(triangle, k);
            let is_inside = neighbour != NONE && self.chart_of[neighbour as usize] == chart;
            *(if is_inside { &mut inside } else { &mut outside }) += length;
        }
        let straightness = (outside - inside) / (outside + inside);
        1.0 - self.faces.normals[triangle].dot(self.axes[chart as usize]) + STRAIGHTNESS * straightness
    }

    /// Grows all charts again, at once, each around its mean normal, from the triangle in its middle.
    fn balance(&mut self) {
        let seeds = self.middles();
        self.chart_of.fill(NONE);
        for (chart, seed) in seeds.into_iter().enumerate() {
            if let Some(seed) = seed {
                self.heap.push(Candidate { cost: -1.0, of: (seed, chart as u32) });
            }
        }
        while let Some(Candidate { of: (triangle, chart), .. }) = self.heap.pop() {
            let t = triangle as usize;
            let fits = self.faces.normals[t].dot(self.axes[chart as usize]) >= self.limit_cos;
            if self.chart_of[t] == NONE && fits {
                self.chart_of[t] = chart;
                self.push_neighbours(triangle, chart);
            }
        }
        self.drop_empty();
    }

    /// Updates the axes; returns for each chart the triangle closest to its mean place among those near its axis.
    fn middles(&mut self) -> Vec<Option<u32>> {
        let count = self.axes.len();
        let mut sums = vec![(DVec3::ZERO, DVec3::ZERO, 0.0); count];
        let faces = self.faces;
        let assigned = |chart_of: &[u32]| -> Vec<(usize, usize)> {
            let pairs = chart_of.iter().enumerate().filter(|(_, chart)| **chart != NONE);
            pairs.map(|(t, &chart)| (t, chart as usize)).collect()
        };
        let pairs = assigned(&self.chart_of);
        let center = |t: usize| faces.corner_positions(t).into_iter().sum::<DVec3>() / 3.0;
        for &(t, chart) in &pairs {
            let (normal, place, area) = &mut sums[chart];
            *normal += faces.areas[t] * faces.normals[t];
            *place += faces.areas[t] * center(t);
            *area += faces.areas[t];
        }
        for (axis, (normal, _, _)) in self.axes.iter_mut().zip(&sums) {
            *axis = normal.normalize_or(*axis);
        }
        let mut best: Vec<Option<(f64, u32)>> = vec![None; count];
        for &(t, chart) in &pairs {
            let (_, place, area) = sums[chart];
            let distance = center(t).distance_squared(place / area) / area;
            let cost = distance + 1.0 - faces.normals[t].dot(self.axes[chart]);
            if best[chart].is_none_or(|(least, _)| cost < least) {
                best[chart] = Some((cost, t as u32));
            }
        }
        best.into_iter().map(|best| best.map(|(_, triangle)| triangle)).collect()
    }

    fn drop_empty(&mut self) {
        let mut number = vec![NONE; self.axes.len()];
        let mut axes = Vec::new();
        for chart in self.chart_of.iter_mut().filter(|chart| **chart != NONE) {
            let old = *chart as usize;
            if number[old] == NONE {
                number[old] = axes.len() as u32;
                axes.push(self.axes[old]);
            }
            *chart = number[old];
        }
        self.axes = axes;
    }
}

/// Joins charts with neighbours while the limit holds for their triangles together, the smallest first.
fn merge(faces: &Faces, segmentation: Segmentation, limit_cos: f64) -> Segmentation {
    let mut parts = Parts::new(faces, &segmentation);
    let small = SMALL_SHARE * faces.areas.iter().sum::<f64>();
    let mut order: Vec<usize> = (0..segmentation.count).collect();
    order.sort_by(|&a, &b| parts.area[a].total_cmp(&parts.area[b]).then(a.cmp(&b)));
    for chart in order {
        let limit = if parts.area[chart] < small { SMALL_LIMIT_COS.min(limit_cos) } else { limit_cos };
        if let Some(into) = parts.best_partner(faces, chart, limit) {
            parts.join(chart, into);
        }
    }
    parts.into_segmentation(segmentation)
}

/// Charts that are being joined.
struct Parts {
    /// The chart that a chart was joined to; itself if none.
    joined: Vec<usize>,
    triangles: Vec<Vec<u32>>,
    area: Vec<f64>,
    normal: Vec<DVec3>,
    /// Lengths of the common borders.
    borders: Vec<HashMap<usize, f64>>,
    /// Triangles that may still be looked at: thousands of small charts beside a large one must not take forever.
    budget: usize,
}

impl Parts {
    fn new(faces: &Faces, segmentation: &Segmentation) -> Self {
        let triangles = segmentation.triangles();
        let mut borders = vec![HashMap::new(); segmentation.count];
        for (t, &chart) in segmentation.chart_of.iter().enumerate().filter(|(_, chart)| **chart != NONE) {
            for (k, &neighbour) in faces.neighbours[t].iter().enumerate() {
                let other = if neighbour == NONE { NONE } else { segmentation.chart_of[neighbour as usize] };
                if other != NONE && other != chart {
                    *borders[chart as usize].entry(other as usize).or_insert(0.0) += faces.edge_length(t, k);
                }
            }
        }
        let sum = |of: &dyn Fn(usize) -> DVec3| -> Vec<DVec3> {
            triangles.iter().map(|chart| chart.iter().map(|&t| of(t as usize)).sum()).collect()
        };
        let normal = sum(&|t| faces.areas[t] * faces.normals[t]);
        let area = triangles.iter().map(|chart| chart.iter().map(|&t| faces.areas[t as usize]).sum()).collect();
        Parts { joined: (0..segmentation.count).collect(), triangles, area, normal, borders, budget: 40 * faces.len() }
    }

    /// The neighbour with the longest common border with which the limit holds.
    fn best_partner(&mut self, faces: &Faces, chart: usize, limit_cos: f64) -> Option<usize> {
        let mut partners: Vec<(usize, f64)> =
            self.borders[chart].iter().map(|(&other, &length)| (other, length)).collect();
        partners.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        partners.into_iter().map(|(other, _)| other).find(|&other| {
            let work = self.triangles[chart].len() + self.triangles[other].len();
            if work > self.budget {
                return false;
            }
            self.budget -= work;
            let axis = (self.normal[chart] + self.normal[other]).normalize_or_zero();
            let fits = |t: &u32| faces.normals[*t as usize].dot(axis) >= limit_cos;
            self.triangles[chart].iter().all(fits) && self.triangles[other].iter().all(fits)
        })
    }

    fn join(&mut self, chart: usize, into: usize) {
        self.joined[chart] = into;
        let triangles = std::mem::take(&mut self.triangles[chart]);
        self.triangles[into].extend(triangles);
        self.area[into] += self.area[chart];
        let normal = self.normal[chart];
        self.normal[into] += normal;
        for (other, length) in std::mem::take(&mut self.borders[chart]) {
            self.borders[other].remove(&chart);
            if other != into {
                *self.borders[into].entry(other).or_insert(0.0) += length;
                *self.borders[other].entry(into).or_insert(0.0) += length;
            }
        }
    }

    fn into_segmentation(self, mut segmentation: Segmentation) -> Segmentation {
        let root = |mut chart: usize| {
            while self.joined[chart] != chart {
                chart = self.joined[chart];
            }
            chart
        };
        let mut number = HashMap::new();
        for chart in segmentation.chart_of.iter_mut().filter(|chart| **chart != NONE) {
            let next = number.len() as u32;
            *chart = *number.entry(root(*chart as usize)).or_insert(next);
        }
        segmentation.count = number.len();
        segmentation
    }
}

/// Divides a connected chart into the triangles closer to `a` and those closer to `b`, counted in steps between
/// neighbours; both are connected.
pub(crate) fn divide(faces: &Faces, triangles: &[u32], a: u32, b: u32) -> [Vec<u32>; 2] {
    let inside: HashSet<u32> = triangles.iter().copied().collect();
    let mut side_of: HashMap<u32, usize> = HashMap::from([(a, 0), (b, 1)]);
    let mut front = std::collections::VecDeque::from([a, b]);
    while let Some(triangle) = front.pop_front() {
        let side = side_of[&triangle];
        for neighbour in faces.neighbours[triangle as usize] {
            if inside.contains(&neighbour) && !side_of.contains_key(&neighbour) {
                side_of.insert(neighbour, side);
                front.push_back(neighbour);
            }
        }
    }
    let (first, second) = triangles.iter().copied().partition(|t| side_of.get(t).copied().unwrap_or(0) == 0);
    [first, second]
}
