//! What the tests of the light equation share: directions, points, and repeatable random numbers.
#![allow(dead_code)] // Each test file uses its own part.

use gonio_light::{DVec3, ShadingPoint, Surface};

/// The unit vector at `theta` from +Z (the normal of [`upright`]) and `phi` about it, radians.
pub fn direction(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// A point at the origin with its normal along +Z and its tangent along +X, seen from `view`.
pub fn upright(view: DVec3) -> ShadingPoint {
    ShadingPoint { position: DVec3::ZERO, normal: DVec3::Z, view, tangent: DVec3::X }
}

/// A surface with diffuse 0.5, specular 0.25 and the given shininess.
pub fn surface(shininess: f64) -> Surface {
    Surface { diffuse: DVec3::splat(0.5), specular: DVec3::splat(0.25), shininess, ..Surface::default() }
}

/// A repeatable sequence (xorshift64*): the same numbers on every machine and in every run.
pub struct Sequence(u64);

impl Sequence {
    /// `seed` must not be 0.
    pub fn new(seed: u64) -> Self {
        assert_ne!(seed, 0);
        Sequence(seed)
    }

    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of `values`.
    pub fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[(self.unit() * values.len() as f64) as usize]
    }

    /// A unit vector in any direction.
    pub fn direction(&mut self) -> DVec3 {
        direction(self.within(-1.0, 1.0).acos(), self.within(0.0, std::f64::consts::TAU))
    }

    /// A unit vector with `z > 0`.
    pub fn above(&mut self) -> DVec3 {
        let d = self.direction();
        DVec3::new(d.x, d.y, d.z.abs().max(1e-9))
    }
}

/// Asserts that two numbers differ by at most `tolerance`, absolutely or relative to the larger.
#[track_caller]
pub fn assert_close(a: f64, b: f64, tolerance: f64) {
    let scale = a.abs().max(b.abs()).max(1.0);
    assert!((a - b).abs() <= tolerance * scale, "{a} and {b} differ by {:e}", (a - b).abs());
}
