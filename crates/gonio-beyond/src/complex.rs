//! Complex numbers, and Fresnel's amplitudes with their phases.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `re + i im`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex {
    /// The real part.
    pub re: f64,
    /// The imaginary part.
    pub im: f64,
}

impl Complex {
    /// 0.
    pub const ZERO: Self = Self::real(0.0);

    /// A real number.
    pub const fn real(re: f64) -> Self {
        Self { re, im: 0.0 }
    }

    /// `exp(i phase)`.
    pub fn phase(phase_rad: f64) -> Self {
        Self { re: phase_rad.cos(), im: phase_rad.sin() }
    }

    /// The complex conjugate.
    pub fn conjugate(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// The square of the modulus.
    pub fn square(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    /// The square root whose real part is not negative.
    pub fn sqrt(self) -> Self {
        let modulus = self.square().sqrt();
        let re = (0.5 * (modulus + self.re)).max(0.0).sqrt();
        let im = (0.5 * (modulus - self.re)).max(0.0).sqrt();
        Self { re, im: if self.im < 0.0 { -im } else { im } }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl Mul<f64> for Complex {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self * other.conjugate() * (1.0 / other.square())
    }
}

/// The amplitudes of the waves that a plane boundary reflects and transmits, for light polarised across the plane of
/// incidence (s) and in it (p).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryAmplitudes {
    /// `[r_s, r_p]`.
    pub reflected: [Complex; 2],
    /// `[t_s, t_p]`.
    pub transmitted: [Complex; 2],
    /// The cosine on the far side; imaginary where reflection is total.
    pub cos_t: Complex,
}

/// Fresnel's amplitudes at the boundary from index `n_i` to `n_t`, for the cosine `cos_i` on the near side; indices may be
/// complex (absorbing), the cosine too (from a boundary before).
///
/// ```text
/// r_s = (n_i cos_i - n_t cos_t) / (n_i cos_i + n_t cos_t)     t_s = 2 n_i cos_i / (n_i cos_i + n_t cos_t)
/// r_p = (n_t cos_i - n_i cos_t) / (n_t cos_i + n_i cos_t)     t_p = 2 n_i cos_i / (n_t cos_i + n_i cos_t)
/// ```
///
/// Source: M. Born and E. Wolf, *Principles of Optics*, section 1.5.2, (20) and (21).
pub fn boundary_amplitudes(n_i: Complex, cos_i: Complex, n_t: Complex) -> BoundaryAmplitudes {
    let sin_t = |c: Complex| n_i / n_t * (n_i / n_t) * (Complex::real(1.0) - c * c);
    let cos_t = (Complex::real(1.0) - sin_t(cos_i)).sqrt();
    let (s, p) = (n_i * cos_i + n_t * cos_t, n_t * cos_i + n_i * cos_t);
    let incident = n_i * cos_i * 2.0;
    BoundaryAmplitudes {
        reflected: [(n_i * cos_i - n_t * cos_t) / s, (n_t * cos_i - n_i * cos_t) / p],
        transmitted: [incident / s, incident / p],
        cos_t,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_light::optics::polarised_dielectric;

    /// The squares are the reflectances that gonio-light has, at 20 angles, from both sides.
    #[test]
    fn amplitudes_have_the_known_squares() {
        for (n_i, n_t) in [(1.0, 1.33), (1.0, 1.52), (1.52, 1.0)] {
            for step in 0..20 {
                let cos = (f64::from(step) * 4.7).to_radians().cos();
                let found = boundary_amplitudes(Complex::real(n_i), Complex::real(cos), Complex::real(n_t));
                let expected = polarised_dielectric(cos, n_i / n_t);
                for (amplitude, expected) in found.reflected.into_iter().zip(expected) {
                    assert!((amplitude.square() - expected).abs() < 1e-12, "{n_i} {n_t} {step}");
                }
            }
        }
    }

    #[test]
    fn roots_lie_on_the_right_side() {
        let root = Complex::real(-4.0).sqrt();
        assert_eq!((root.re, root.im), (0.0, 2.0));
        let z = Complex { re: 1.0, im: -2.0 };
        let back = z.sqrt() * z.sqrt();
        assert!((back - z).square() < 1e-24 && z.sqrt().re > 0.0);
    }
}
