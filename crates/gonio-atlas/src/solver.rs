//! Linear equations of a chart's vertices, two unknowns each, by preconditioned conjugate gradients.
//!
//! M. R. Hestenes, E. Stiefel, "Methods of conjugate gradients for solving linear systems" (1952), with the diagonal as
//! the preconditioner. Matrices are never stored: an edge with its weight stands for four entries of the Laplacian.

use glam::DVec2;

/// A symmetric positive semi-definite operator on places in the plane.
pub(crate) struct PlaneOperator {
    /// `(i, j, w)`: adds w (x_i - x_j) to i, and the opposite to j.
    pub edges: Vec<(u32, u32, f64)>,
    /// Border edges in their direction: the term of the area in the conformal energy; empty for the Laplacian alone.
    pub border: Vec<(u32, u32)>,
    /// Vertices that do not move.
    pub pins: Vec<u32>,
    /// The inverse of the diagonal.
    inverse_diagonal: Vec<f64>,
}

impl PlaneOperator {
    pub fn new(count: usize, edges: Vec<(u32, u32, f64)>, border: Vec<(u32, u32)>, pins: Vec<u32>) -> Self {
        let mut diagonal = vec![0.0; count];
        for &(i, j, w) in &edges {
            diagonal[i as usize] += w;
            diagonal[j as usize] += w;
        }
        let inverse_diagonal = diagonal.into_iter().map(|d| if d > 1e-12 { 1.0 / d } else { 1.0 }).collect();
        PlaneOperator { edges, border, pins, inverse_diagonal }
    }

    /// The gradient of the energy: L x, minus that of the area where there are border edges; zero at pins.
    pub fn apply(&self, x: &[DVec2], out: &mut [DVec2]) {
        out.fill(DVec2::ZERO);
        for &(i, j, w) in &self.edges {
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

    /// Improves `x` towards `A x = b` until the residual is `tolerance` times that of `x = 0`, or for `most` steps.
    pub fn solve(&self, x: &mut [DVec2], b: &[DVec2], tolerance: f64, most: usize) {
        let count = x.len();
        let mut applied = vec![DVec2::ZERO; count];
        self.apply(x, &mut applied);
        let mut residual: Vec<DVec2> = b.iter().zip(&applied).map(|(b, a)| *b - *a).collect();
        self.hold(&mut residual);
        let precondition =
            |r: &[DVec2]| -> Vec<DVec2> { r.iter().zip(&self.inverse_diagonal).map(|(r, d)| *d * *r).collect() };
        let mut z = precondition(&residual);
        let mut direction = z.clone();
        let mut rz = dot(&residual, &z);
        let goal = tolerance * tolerance * rz.max(dot(b, &precondition(b)));
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
            for i in 0..count {
                x[i] += step * direction[i];
                residual[i] -= step * applied[i];
                z[i] = self.inverse_diagonal[i] * residual[i];
            }
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

    #[test]
    fn a_chain_between_two_pins_is_straight() {
        let edges = (0..10).map(|i| (i, i + 1, 1.0 + f64::from(i))).collect();
        let operator = PlaneOperator::new(11, edges, Vec::new(), vec![0, 10]);
        let mut x = vec![DVec2::new(3.0, -7.0); 11];
        (x[0], x[10]) = (DVec2::ZERO, DVec2::new(1.0, 2.0));
        operator.solve(&mut x, &[DVec2::ZERO; 11], 1e-12, 100);
        // Currents through resistors in series: the voltage falls by 1 / w.
        let total: f64 = (1..=10).map(|w| 1.0 / f64::from(w)).sum();
        let mut at = 0.0;
        for (i, place) in x.iter().enumerate() {
            assert!(place.distance(DVec2::new(1.0, 2.0) * at / total) < 1e-9, "{i}: {place}");
            at += 1.0 / (i + 1) as f64;
        }
    }
}
