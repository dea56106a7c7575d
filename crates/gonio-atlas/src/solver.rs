//! Linear equations of a chart's vertices, two unknowns each, by preconditioned conjugate gradients.
//!
//! M. R. Hestenes, E. Stiefel, "Methods of conjugate gradients for solving linear systems" (1952). The matrix is never stored: an
//! edge with its weight stands for four entries of the Laplacian.

use crate::multigrid::{Multigrid, WeightedEdge};
use glam::DVec2;

/// When a solution is good enough: shares of a residual, and steps.
#[derive(Clone, Copy)]
pub(crate) struct Accuracy {
    pub of_start: f64,
    pub of_zero: f64,
    pub most: usize,
}

/// A symmetric positive semi-definite operator on places in the plane.
pub(crate) struct PlaneOperator<'a> {
    pub edges: &'a [WeightedEdge],
    /// An approximate inverse of the Laplacian of the edges.
    pub inverse: &'a Multigrid,
    /// Border edges in their direction: the term of the area in the conformal energy; empty for the Laplacian alone.
    pub border: Vec<(u32, u32)>,
    /// Vertices that do not move.
    pub pins: Vec<u32>,
}

impl PlaneOperator<'_> {
    /// The gradient of the energy: L x, minus that of the area where there are border edges; zero at pins.
    pub fn apply(&self, x: &[DVec2], out: &mut [DVec2]) {
        out.fill(DVec2::ZERO);
        for &(i, j, w) in self.edges {
            let force = w * (x[i as usize] - x[j as usize]);
            out[i as usize] += force;
            out[j as usize] -= force;
        }
        for &(i, j) in &self.border {
            let (a, b) = (x[i as usize], x[j as usize]);
            // The area is the sum of (a x b) / 2; its derivatives are (b.y, -b.x) / 2 and (-a.y, a.x) / 2.
            out[i as usize] -= 0.5 * DVec2::new(b.y, -b.x);
            out[j as usize] -= 0.5 * DVec2::new(-a.y, a.x);
        }
        self.hold(out);
    }

    fn hold(&self, values: &mut [DVec2]) {
        for &pin in &self.pins {
            values[pin as usize] = DVec2::ZERO;
        }
    }

    /// Improves `x` towards `A x = b` until the residual is `of_start` times that of the given `x` or `of_zero` times that of `x = 0`,
    /// or for `most` steps.
    pub fn solve(&self, x: &mut [DVec2], b: &[DVec2], Accuracy { of_start, of_zero, most }: Accuracy) {
        let mut workspace = self.inverse.workspace();
        let mut precondition = |r: &[DVec2], z: &mut [DVec2]| {
            self.inverse.apply(self.edges, r, z, &mut workspace);
            self.hold(z);
        };
        let mut applied = vec![DVec2::ZERO; x.len()];
        let mut z = vec![DVec2::ZERO; x.len()];
        precondition(b, &mut z);
        let least = of_zero * of_zero * dot(b, &z);
        self.apply(x, &mut applied);
        let mut residual: Vec<DVec2> = b.iter().zip(&applied).map(|(b, a)| *b - *a).collect();
        self.hold(&mut residual);
        precondition(&residual, &mut z);
        let mut direction = z.clone();
        let mut rz = dot(&residual, &z);
        let goal = least.max(of_start * of_start * rz);
        for _ in 0..most {
            if rz.is_nan() || rz <= goal {
                return;
            }
            self.apply(&direction, &mut applied);
            let curvature = dot(&direction, &applied);
            // A direction without curvature belongs to the nullspace, or rounding has taken over.
            if curvature.is_nan() || curvature <= 0.0 {
                return;
            }
            let step = rz / curvature;
            for ((x, r), (d, a)) in x.iter_mut().zip(&mut residual).zip(direction.iter().zip(&applied)) {
                *x += step * *d;
                *r -= step * *a;
            }
            precondition(&residual, &mut z);
            let next = dot(&residual, &z);
            let turn = next / rz;
            rz = next;
            for (d, z) in direction.iter_mut().zip(&z) {
                *d = *z + turn * *d;
            }
        }
    }
}

fn dot(a: &[DVec2], b: &[DVec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 120 x 120 places, unequal in its two directions. With the diagonal alone the error is still a tenth after so many steps.
    #[test]
    fn large_charts_take_no_more_steps() {
        let side = 120_u32;
        let place = |x: u32, y: u32| y * side + x;
        let along = (0..side).flat_map(|y| (1..side).map(move |x| (place(x - 1, y), place(x, y), 1.0)));
        let across = (1..side).flat_map(|y| (0..side).map(move |x| (place(x, y - 1), place(x, y), 0.05)));
        let edges: Vec<WeightedEdge> = along.chain(across).collect();
        let inverse = Multigrid::new((side * side) as usize, &edges);
        let (border, pins) = (Vec::new(), (0..side).map(|x| place(x, 0)).collect());
        let operator = PlaneOperator { edges: &edges, inverse: &inverse, border, pins };
        let exact: Vec<DVec2> = (0..side * side).map(|i| DVec2::new(f64::from(i / side), 0.0)).collect();
        let mut right = vec![DVec2::ZERO; exact.len()];
        operator.apply(&exact, &mut right);
        let mut x = vec![DVec2::ZERO; exact.len()];
        operator.solve(&mut x, &right, Accuracy { of_start: 1e-5, of_zero: 0.0, most: 40 });
        let farthest = x.iter().zip(&exact).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(farthest < 0.01 * f64::from(side), "{farthest}");
    }

    #[test]
    fn a_chain_between_two_pins_is_straight() {
        let edges: Vec<WeightedEdge> = (0..10).map(|i| (i, i + 1, 1.0 + f64::from(i))).collect();
        let inverse = Multigrid::new(11, &edges);
        let operator = PlaneOperator { edges: &edges, inverse: &inverse, border: Vec::new(), pins: vec![0, 10] };
        let mut x = vec![DVec2::new(3.0, -7.0); 11];
        (x[0], x[10]) = (DVec2::ZERO, DVec2::new(1.0, 2.0));
        operator.solve(&mut x, &[DVec2::ZERO; 11], Accuracy { of_start: 1e-12, of_zero: 0.0, most: 100 });
        // Currents through resistors in series: the voltage falls by 1 / w.
        let total: f64 = (1..=10).map(|w| 1.0 / f64::from(w)).sum();
        let mut at = 0.0;
        for (i, place) in x.iter().enumerate() {
            assert!(place.distance(DVec2::new(1.0, 2.0) * at / total) < 1e-9, "{i}: {place}");
            at += 1.0 / (i + 1) as f64;
        }
    }
}
