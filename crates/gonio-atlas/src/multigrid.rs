//! An approximate inverse of a chart's Laplacian: vertices are joined in groups, the groups in larger groups, and each level removes
//! the errors that are as long as its groups are wide.
//!
//! Algebraic multigrid by aggregation, as a preconditioner with overcorrection (D. Braess, "Towards algebraic multigrid for elliptic
//! problems of second order", 1995). With the diagonal alone, conjugate gradients need as many steps as a chart has vertices from
//! side to side.

use glam::DVec2;

/// Charts with fewer vertices get the diagonal alone.
const LEAST_VERTICES: usize = 200;

/// Groups of the last level, and steps of smoothing there.
const COARSEST: usize = 32;
const COARSEST_STEPS: usize = 16;

/// The share of a Jacobi step.
const DAMPING: f64 = 0.65;

/// Functions that are constant in each group are too stiff; their corrections are too short.
const OVERCORRECTION: f64 = 1.9;

/// An edge is strong if its weight is at least this share of the largest at one of its ends.
const STRONG: f64 = 0.25;

/// `(i, j, w)`: adds w (x_i - x_j) to i, and the opposite to j.
pub(crate) type WeightedEdge = (u32, u32, f64);

/// A hierarchy of Laplacians. The finest one's edges are not in it.
pub(crate) struct Multigrid {
    finest: Diagonal,
    /// The group of each vertex of a level, and the Laplacian of the groups.
    coarser: Vec<(Vec<u32>, Laplacian)>,
}

/// The inverse of a diagonal; 0 where there is nothing to invert.
type Diagonal = Vec<f64>;

struct Laplacian {
    edges: Vec<WeightedEdge>,
    inverse_diagonal: Diagonal,
}

/// Vectors of each level: the right side, the solution, the residual.
pub(crate) struct Workspace {
    levels: Vec<[Vec<DVec2>; 3]>,
}

impl Multigrid {
    pub fn new(count: usize, edges: &[WeightedEdge]) -> Self {
        let finest = inverse_diagonal(count, edges);
        let mut coarser: Vec<(Vec<u32>, Laplacian)> = Vec::new();
        let mut last = count;
        while count >= LEAST_VERTICES && last > COARSEST {
            let own = coarser.last().map_or(edges, |(_, laplacian)| &laplacian.edges);
            let (group_of, groups, between) = grouped_twice(last, own);
            if 4 * groups > 3 * last {
                break;
            }
            last = groups;
            let inverse_diagonal = inverse_diagonal(groups, &between);
            coarser.push((group_of, Laplacian { edges: between, inverse_diagonal }));
        }
        Multigrid { finest, coarser }
    }

    pub fn workspace(&self) -> Workspace {
        let sizes = [self.finest.len()].into_iter().chain(self.coarser.iter().map(|(_, l)| l.inverse_diagonal.len()));
        Workspace { levels: sizes.map(|n| [(); 3].map(|()| vec![DVec2::ZERO; n])).collect() }
    }

    /// Sets `z` to an approximation of the solution of `L z = r`, a symmetric function of `r`. `edges` are those of [`Self::new`].
    pub fn apply(&self, edges: &[WeightedEdge], r: &[DVec2], z: &mut [DVec2], workspace: &mut Workspace) {
        if self.coarser.is_empty() {
            z.iter_mut().zip(r).zip(&self.finest).for_each(|((z, r), d)| *z = *d * *r);
            return;
        }
        workspace.levels[0][0].copy_from_slice(r);
        self.cycle(0, edges, &mut workspace.levels);
        z.copy_from_slice(&workspace.levels[0][1]);
    }

    fn cycle(&self, level: usize, edges: &[WeightedEdge], vectors: &mut [[Vec<DVec2>; 3]]) {
        let diagonal = match level.checked_sub(1) {
            None => &self.finest,
            Some(above) => &self.coarser[above].1.inverse_diagonal,
        };
        let Some(([right, x, residual], below)) = vectors.split_first_mut() else { return };
        for ((x, b), d) in x.iter_mut().zip(&*right).zip(diagonal) {
            *x = DAMPING * *d * *b;
        }
        let smooth = |x: &mut [DVec2], residual: &mut [DVec2]| {
            find_residual(edges, right, x, residual);
            for ((x, r), d) in x.iter_mut().zip(&*residual).zip(diagonal) {
                *x += DAMPING * *d * *r;
            }
        };
        let Some((group_of, laplacian)) = self.coarser.get(level) else {
            (1..COARSEST_STEPS).for_each(|_| smooth(x, residual));
            return;
        };
        // Twice where it costs little: a W-cycle.
        for _ in 0..if level == 0 { 1 } else { 2 } {
            find_residual(edges, right, x, residual);
            below[0][0].fill(DVec2::ZERO);
            for (&group, r) in group_of.iter().zip(&*residual) {
                below[0][0][group as usize] += *r;
            }
            self.cycle(level + 1, &laplacian.edges, below);
            for (x, &group) in x.iter_mut().zip(group_of) {
                *x += OVERCORRECTION * below[0][1][group as usize];
            }
        }
        smooth(x, residual);
    }
}

/// residual = right - L x.
fn find_residual(edges: &[WeightedEdge], right: &[DVec2], x: &[DVec2], residual: &mut [DVec2]) {
    residual.copy_from_slice(right);
    for &(i, j, w) in edges {
        let force = w * (x[i as usize] - x[j as usize]);
        residual[i as usize] -= force;
        residual[j as usize] += force;
    }
}

fn inverse_diagonal(count: usize, edges: &[WeightedEdge]) -> Diagonal {
    let mut diagonal = vec![0.0; count];
    for &(i, j, w) in edges {
        diagonal[i as usize] += w;
        diagonal[j as usize] += w;
    }
    diagonal.into_iter().map(|d| if d > 1e-12 { 1.0 / d } else { 0.0 }).collect()
}

/// Groups of about five vertices: pairs of pairs, and single vertices with a neighbour's pair. Returns the group of each vertex, the
/// number of groups, and the edges between them.
fn grouped_twice(count: usize, edges: &[WeightedEdge]) -> (Vec<u32>, usize, Vec<WeightedEdge>) {
    let (pair_of, pairs) = paired(count, edges);
    let between = joined_edges(edges, &pair_of);
    let (group_of_pair, groups) = paired(pairs, &between);
    let group_of = pair_of.into_iter().map(|pair| group_of_pair[pair as usize]).collect();
    (group_of, groups, joined_edges(&between, &group_of_pair))
}

/// Joins the ends of strong edges. Returns the pair of each vertex, and the number of pairs.
fn paired(count: usize, edges: &[WeightedEdge]) -> (Vec<u32>, usize) {
    const NONE: u32 = u32::MAX;
    let mut strongest = vec![(0.0, NONE); count];
    for &(i, j, w) in edges {
        for (own, other) in [(i, j), (j, i)] {
            if w > strongest[own as usize].0 {
                strongest[own as usize] = (w, other);
            }
        }
    }
    let mut pair_of = vec![NONE; count];
    let mut pairs = 0;
    for &(i, j, w) in edges {
        let (a, b) = (i as usize, j as usize);
        let is_strong = w > 0.0 && w >= STRONG * strongest[a].0.max(strongest[b].0);
        if is_strong && pair_of[a] == NONE && pair_of[b] == NONE {
            (pair_of[a], pair_of[b]) = (pairs, pairs);
            pairs += 1;
        }
    }
    for vertex in 0..count {
        if pair_of[vertex] == NONE {
            let beside = strongest[vertex].1;
            pair_of[vertex] = if beside == NONE { NONE } else { pair_of[beside as usize] };
            if pair_of[vertex] == NONE {
                pair_of[vertex] = pairs;
                pairs += 1;
            }
        }
    }
    (pair_of, pairs as usize)
}

/// The edges between groups, each with the sum of its weights.
fn joined_edges(edges: &[WeightedEdge], group_of: &[u32]) -> Vec<WeightedEdge> {
    let between = edges.iter().map(|&(i, j, w)| (group_of[i as usize], group_of[j as usize], w));
    summed_edges(between.filter(|(a, b, _)| a != b))
}

/// One edge for each pair of vertices, with the sum of its weights, in the order of the vertices.
pub(crate) fn summed_edges(edges: impl Iterator<Item = WeightedEdge>) -> Vec<WeightedEdge> {
    let mut edges: Vec<WeightedEdge> = edges.map(|(i, j, w)| (i.min(j), i.max(j), w)).collect();
    edges.sort_unstable_by_key(|&(i, j, _)| (i, j));
    edges.dedup_by(|next, kept| {
        let is_same = (next.0, next.1) == (kept.0, kept.1);
        if is_same {
            kept.2 += next.2;
        }
        is_same
    });
    edges.shrink_to_fit();
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The approximate inverse of a Laplacian is symmetric, as conjugate gradients need it.
    #[test]
    fn the_inverse_is_symmetric() {
        let side = 20_u32;
        let weight = |i: u32| 1.0 + f64::from(i.wrapping_mul(2_654_435_761) >> 28);
        let along = (0..side * side).filter(|i| i % side > 0).map(|i| (i - 1, i, weight(i)));
        let edges: Vec<WeightedEdge> = along.chain((side..side * side).map(|i| (i - side, i, weight(i + 7)))).collect();
        let multigrid = Multigrid::new((side * side) as usize, &edges);
        assert!(multigrid.coarser.len() > 1);
        let mut workspace = multigrid.workspace();
        let mut column = |i: usize| {
            let mut r = vec![DVec2::ZERO; (side * side) as usize];
            let mut z = r.clone();
            r[i] = DVec2::ONE;
            multigrid.apply(&edges, &r, &mut z, &mut workspace);
            z
        };
        let (a, b) = (column(43), column(217));
        assert!((a[217] - b[43]).length() < 1e-12 && a[217].x != 0.0 && a[43].x > 0.0, "{} {}", a[217], b[43]);
    }
}
