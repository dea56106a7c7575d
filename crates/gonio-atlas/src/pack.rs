//! Packs charts into the unit square: the largest scale at which all find a place, by bisection.
//!
//! Charts are placed in the order of their size, each at the lowest free place of four rotations, on a grid of cells that
//! holds the exact outlines: charts fill the hollows of others (P. Burke, R. Hellier, G. Kendall, G. Whitwell, "A new
//! bottom-left-fill heuristic algorithm for the two-dimensional irregular packing problem", 2006).

use crate::bitmap::{Bitmap, add_blocked};
use glam::DVec2;
use rayon::prelude::*;
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

/// Cells along a side while the scale is searched, and for the result.
const COARSE_CELLS: usize = 512;
const FINE_CELLS: usize = 1024;
const MOST_CELLS: usize = 16384;

/// Above this number of charts only two rotations are tried, and the grid stays coarse.
const MANY_CHARTS: usize = 1500;

/// The first attempt would cover this share of the square; each further one this factor of it.
const FIRST_COVERAGE: f64 = 0.9;
const COVERAGE_STEP: f64 = 0.85;

/// Rounds in which the interval of the coverage is divided by three.
const ROUNDS: usize = 3;

/// Steps of the scale that are tried on the fine grid.
const FINE_STEPS: [f64; 4] = [1.0, 1.012, 1.024, 1.036];

/// An outline to be packed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    /// Border edges in any order; their interior is inside by the even-odd rule.
    pub border: Vec<[DVec2; 2]>,
    /// Its area.
    pub area: f64,
}

/// Where an outline was placed: `scale * R(angle) * p + offset`, with u to the right and v up, within [0, 1].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Placement {
    pub angle_rad: f64,
    pub scale: f64,
    pub offset: DVec2,
}

impl Placement {
    pub fn apply(&self, p: DVec2) -> DVec2 {
        self.scale * DVec2::from_angle(self.angle_rad).rotate(p) + self.offset
    }
}

/// Placements with the margin that was kept, which is less than the requested one if that does not fit between so many
/// charts. `None` if `go_on` returned false.
pub(crate) fn pack(
    outlines: &[Outline],
    margin: f64,
    go_on: &(dyn Fn(f64) -> bool + Sync),
) -> Option<(Vec<Placement>, f64)> {
    let upright: Vec<(Outline, f64)> = outlines.par_iter().map(upright).collect();
    let total: f64 = outlines.iter().map(|outline| outline.area).sum();
    if outlines.is_empty() || total.is_nan() || total <= 0.0 {
        return Some((vec![Placement::default(); outlines.len()], margin));
    }
    let count = outlines.len() as f64;
    let mut margin = margin.min(0.5 / count.sqrt());
    let with_angles = |placements: Vec<Placement>| -> Vec<Placement> {
        let turned = placements.into_iter().zip(&upright);
        turned.map(|(p, (_, angle))| Placement { angle_rad: p.angle_rad + angle, ..p }).collect()
    };
    if outlines.len() <= MOST_BY_OUTLINE {
        for _ in 0..MARGIN_ATTEMPTS {
            let cells = ((8.0 * count.sqrt()) as usize).next_power_of_two().clamp(COARSE_CELLS, MOST_CELLS);
            let packer = Packer::new(&upright, total, margin);
            if let Some(placements) = packer.search(cells, go_on)? {
                return Some((with_angles(placements), margin));
            }
            margin *= 0.5;
        }
    }
    margin = margin.min(0.25 / count.sqrt());
    Some((with_angles(in_shelves(&upright, margin)), margin))
}

/// Smaller margins that are tried before charts are put on shelves.
const MARGIN_ATTEMPTS: usize = 6;

/// More charts than this are not packed by their outlines: they are a few texels each.
const MOST_BY_OUTLINE: usize = 20_000;

/// Puts the bounding boxes of outlines on shelves, the highest first, at the largest scale at which all fit. With a margin of at
/// most 0.25 / sqrt(n) there always is one.
fn in_shelves(upright: &[(Outline, f64)], margin: f64) -> Vec<Placement> {
    let range = |(outline, _): &(Outline, f64)| {
        let points = || outline.border.iter().map(|edge| edge[0]);
        let low = points().fold(DVec2::MAX, DVec2::min);
        (low, (points().fold(DVec2::MIN, DVec2::max) - low).max(DVec2::ZERO))
    };
    let boxes: Vec<(DVec2, DVec2)> = upright.iter().map(range).collect();
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[b].1.y.total_cmp(&boxes[a].1.y).then(a.cmp(&b)));
    let place_all = |scale: f64| {
        let mut placements = vec![Placement::default(); boxes.len()];
        let (mut at, mut height) = (DVec2::splat(0.5 * margin), 0.0_f64);
        for &index in &order {
            let (low, size) = (boxes[index].0, scale * boxes[index].1);
            if at.x + size.x > 1.0 - 0.5 * margin {
                at = DVec2::new(0.5 * margin, at.y + height + margin);
                height = 0.0;
            }
            if (at + size).max_element() > 1.0 - 0.5 * margin {
                return None;
            }
            placements[index] = Placement { angle_rad: 0.0, scale, offset: at - scale * low };
            at.x += size.x + margin;
            height = height.max(size.y);
        }
        Some(placements)
    };
    let largest = boxes.iter().map(|(_, size)| size.max_element()).fold(0.0, f64::max);
    let mut scale = if largest > 0.0 { 1.0 / largest } else { 1.0 };
    let mut best = None;
    while best.is_none() && scale > 0.0 {
        scale *= 0.5;
        best = place_all(scale);
    }
    let mut step = 0.5 * scale;
    for _ in 0..SHELF_ROUNDS {
        if let Some(placements) = place_all(scale + step) {
            (scale, best) = (scale + step, Some(placements));
        }
        step *= 0.5;
    }
    best.unwrap_or_else(|| vec![Placement::default(); boxes.len()])
}

/// Rounds of bisection of the scale of shelves: to 0.1 %.
const SHELF_ROUNDS: usize = 10;

/// Turns an outline so that its bounding rectangle has the least area, which one of the rectangles with a side along the
/// convex hull has (H. Freeman, R. Shapira, 1975); wider than high. Returns the angle too.
fn upright(outline: &Outline) -> (Outline, f64) {
    let points: Vec<DVec2> = outline.border.iter().map(|edge| edge[0]).collect();
    let hull = convex_hull(points);
    let extent = |angle: f64| {
        let turn = DVec2::from_angle(angle);
        let turned = || hull.iter().map(|p| turn.rotate(*p));
        let size = turned().fold(DVec2::MIN, DVec2::max) - turned().fold(DVec2::MAX, DVec2::min);
        (size.x * size.y, size)
    };
    let step = hull.len().div_ceil(256).max(1);
    let edges = (0..hull.len()).step_by(step).map(|i| hull[(i + 1) % hull.len()] - hull[i]);
    let angles = edges.filter(|edge| edge.length_squared() > 0.0).map(|edge| -edge.to_angle());
    let mut angle = angles.min_by(|&a, &b| extent(a).0.total_cmp(&extent(b).0)).unwrap_or(0.0);
    let size = extent(angle).1;
    if size.y > size.x {
        angle += FRAC_PI_2;
    }
    let turn = DVec2::from_angle(angle);
    let border = outline.border.iter().map(|edge| edge.map(|p| turn.rotate(p))).collect();
    (Outline { border, area: outline.area }, angle)
}

/// Andrew's monotone chain (1979).
fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for &p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - a) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter());
    hull.extend(half(&mut points.iter().rev()));
    if hull.is_empty() { points } else { hull }
}

struct Packer<'a> {
    outlines: &'a [(Outline, f64)],
    /// Indices of outlines, the largest first.
    order: Vec<usize>,
    total_area: f64,
    margin: f64,
}

impl<'a> Packer<'a> {
    fn new(outlines: &'a [(Outline, f64)], total_area: f64, margin: f64) -> Self {
        let perimeter = |(outline, _): &(Outline, f64)| {
            let points = || outline.border.iter().map(|edge| edge[0]);
            let size = points().fold(DVec2::MIN, DVec2::max) - points().fold(DVec2::MAX, DVec2::min);
            size.x + size.y
        };
        let sizes: Vec<f64> = outlines.iter().map(perimeter).collect();
        let mut order: Vec<usize> = (0..outlines.len()).collect();
        order.sort_by(|&a, &b| sizes[b].total_cmp(&sizes[a]).then(a.cmp(&b)));
        Packer { outlines, order, total_area, margin }
    }

    /// The best placements; the inner `None` if even a hundredth of the square cannot be covered because of the margin.
    fn search(&self, cells: usize, go_on: &(dyn Fn(f64) -> bool + Sync)) -> Option<Option<Vec<Placement>>> {
        let mut share = 0.0;
        let mut attempt = |coverages: &[f64], cells: usize| {
            share += (1.0 - share) * 0.2;
            go_on(share).then(|| {
                let placed = coverages.par_iter().map(|&coverage| self.place_all(coverage, cells));
                placed.collect::<Vec<Option<Vec<Placement>>>>()
            })
        };
        // Pairs of ever smaller scales until one fits.
        let (mut low, mut high) = (FIRST_COVERAGE, 1.0);
        let mut best = loop {
            let tried = [low, low * COVERAGE_STEP];
            let mut placed = attempt(&tried, cells)?;
            if let Some(found) = placed[0].take() {
                break found;
            }
            if let Some(found) = placed[1].take() {
                (low, high) = (tried[1], tried[0]);
                break found;
            }
            // A chart may be long and thin: then its length is the limit, and the coverage tiny.
            if low < 1e-12 || (low < 1e-3 && self.outlines.len() > 1000) {
                return Some(None);
            }
            (low, high) = (tried[1] * COVERAGE_STEP, tried[1]);
        };
        for _ in 0..ROUNDS {
            let tried = [low + (high - low) / 3.0, low + 2.0 * (high - low) / 3.0];
            let mut placed = attempt(&tried, cells)?;
            if let Some(found) = placed[1].take() {
                (low, best) = (tried[1], found);
            } else if let Some(found) = placed[0].take() {
                (low, high, best) = (tried[0], tried[1], found);
            } else {
                high = tried[0];
            }
        }
        if self.outlines.len() <= MANY_CHARTS {
            let tried = FINE_STEPS.map(|step| low * step * step);
            let placed = attempt(&tried, cells.max(FINE_CELLS))?;
            best = placed.into_iter().flatten().next_back().unwrap_or(best);
        }
        Some(Some(best))
    }

    /// Places all outlines at the scale at which they cover a share of the square, if they fit.
    fn place_all(&self, coverage: f64, cells: usize) -> Option<Vec<Placement>> {
        let scale = (coverage / self.total_area).sqrt();
        let is_crowded = self.order.len() > MANY_CHARTS;
        let mut grid = PackingGrid::new(cells, self.margin, is_crowded);
        let mut placements = vec![Placement::default(); self.outlines.len()];
        for &index in &self.order {
            let outline = &self.outlines[index].0;
            placements[index] = grid.place(outline, scale, if is_crowded { 2 } else { 4 })?;
        }
        Some(placements)
    }
}

/// The square while it is filled.
struct PackingGrid {
    cells: usize,
    /// In cells.
    margin: f64,
    /// Cells that are taken, or nearer to a chart than the margin.
    taken: Bitmap,
    free_run: Vec<usize>,
    /// Whether there are so many charts that rows are not searched again for boxes of the same size.
    is_crowded: bool,
    /// The row at which a box of a size was last placed. The square only becomes fuller, so that a small box, which is
    /// filled, cannot be placed lower.
    last_row: HashMap<(usize, usize), usize>,
    scratch: Vec<u64>,
}

/// An outline's cells in one rotation.
struct Stamp {
    cells: Bitmap,
    /// Runs (row, start, end), longest row first.
    runs: Vec<(usize, usize, usize)>,
    angle_rad: f64,
    /// The corner of its box before it was moved to the origin, in cells.
    low: DVec2,
}

/// Rectangles up to this size are remembered.
const SMALL: usize = 3;

impl PackingGrid {
    fn new(cells: usize, margin: f64, is_crowded: bool) -> Self {
        PackingGrid {
            cells,
            is_crowded,
            margin: margin * cells as f64,
            taken: Bitmap::new(cells, cells),
            free_run: vec![cells; cells],
            last_row: HashMap::new(),
            scratch: Vec::new(),
        }
    }

    /// Places an outline at the lowest place of its first `rotations` rotations by 90 degrees.
    fn place(&mut self, outline: &Outline, scale: f64, rotations: usize) -> Option<Placement> {
        let mut best: Option<(usize, usize, usize, Stamp)> = None;
        for rotation in 0..rotations {
            let Some(stamp) = self.stamp(outline, scale, FRAC_PI_2 * rotation as f64) else { continue };
            let limit = best.as_ref().map_or(usize::MAX, |(top, ..)| *top);
            if let Some((x, y)) = self.lowest(&stamp, limit) {
                best = Some((y + stamp.cells.height, y, x, stamp));
            }
        }
        let (_, y, x, stamp) = best?;
        let rows = self.taken.add_with_margin(&stamp.cells, x, y, self.margin);
        // An old length is an upper bound; keeping it up to date takes longer than it saves where rows are remembered.
        for row in rows.filter(|_| !self.is_crowded) {
            self.free_run[row] = self.taken.longest_free_run(row);
        }
        let cells = self.cells as f64;
        let offset = (DVec2::new(x as f64, y as f64) - stamp.low) / cells;
        Some(Placement { angle_rad: stamp.angle_rad, scale, offset })
    }

    /// `None` if it is larger than the square.
    fn stamp(&self, outline: &Outline, scale: f64, angle_rad: f64) -> Option<Stamp> {
        let turn = DVec2::from_angle(angle_rad) * (scale * self.cells as f64);
        let mut border: Vec<[DVec2; 2]> = outline.border.iter().map(|edge| edge.map(|p| turn.rotate(p))).collect();
        let points = || border.iter().map(|edge| edge[0]);
        let (low, high) = (points().fold(DVec2::MAX, DVec2::min), points().fold(DVec2::MIN, DVec2::max));
        let size = high - low;
        if !size.is_finite() || size.max_element() >= self.cells as f64 {
            return None;
        }
        border.iter_mut().flatten().for_each(|p| *p -= low);
        let (width, height) = (size.x.floor() as usize + 1, size.y.floor() as usize + 1);
        let mut cells = Bitmap::of_polygon(&border, width, height);
        if width <= SMALL && height <= SMALL {
            (0..height).for_each(|y| cells.set_run(y, 0, width));
        }
        let mut rows: Vec<(usize, Vec<(usize, usize)>)> = (0..height).map(|y| (y, cells.runs(y))).collect();
        rows.sort_by_key(|(y, runs)| (usize::MAX - runs.iter().map(|r| r.1 - r.0).max().unwrap_or(0), *y));
        let runs = rows.into_iter().flat_map(|(y, runs)| runs.into_iter().map(move |(start, end)| (y, start, end)));
        Some(Stamp { runs: runs.collect(), cells, angle_rad, low })
    }

    /// The lowest free place, then the leftmost, whose top is below `limit`. Half the margin stays free along the sides of
    /// the square.
    fn lowest(&mut self, stamp: &Stamp, limit: usize) -> Option<(usize, usize)> {
        let edge = (0.5 * self.margin).ceil() as usize;
        let (width, height) = (stamp.cells.width, stamp.cells.height);
        let last_x = self.cells.checked_sub(edge + width)?;
        let last_y = self.cells.checked_sub(edge + height)?.min(limit.saturating_sub(height + 1));
        // Boxes of about the same size: hundreds of exact sizes would each search the rows from the bottom.
        let class = |side: usize| if self.is_crowded { side.ilog2() as usize } else { side };
        let key = (class(width), class(height));
        let is_remembered = self.is_crowded || (width <= SMALL && height <= SMALL);
        let first_y = if is_remembered { self.last_row.get(&key).copied().unwrap_or(edge) } else { edge };
        let mut outside = Bitmap::new(self.cells, 1);
        outside.set_run(0, 0, edge);
        outside.set_run(0, last_x + 1, self.cells);
        let mut blocked = vec![0; outside.row(0).len()];
        let full = {
            let mut full = Bitmap::new(self.cells, 1);
            full.set_run(0, 0, self.cells);
            full
        };
        for y in first_y..=last_y {
            if stamp.runs.iter().any(|&(row, start, end)| self.free_run[y + row] < end - start) {
                continue;
            }
            blocked.copy_from_slice(outside.row(0));
            let is_free = stamp.runs.iter().all(|&(row, start, end)| {
                add_blocked(&mut blocked, self.taken.row(y + row), start, end - start, &mut self.scratch);
                blocked != full.row(0)
            });
            if is_free {
                if is_remembered {
                    self.last_row.insert(key, y);
                }
                let word = blocked.iter().zip(full.row(0)).position(|(b, f)| b != f)?;
                return Some((64 * word + (!blocked[word]).trailing_zeros() as usize, y));
            }
        }
        None
    }
}
