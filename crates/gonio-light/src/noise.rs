//! Numbers that are 0 but for rounding errors.

/// Magnitude below which a number is noise. Rounding errors of terms of about 1 are smaller in f64 (2e-16 each), and so is what
/// remains of a term that vanishes, such as a cosine to a high power.
const NOISE: f64 = 1e-12;

/// Whether a number is displayed as 0: its magnitude is below 1e-12.
pub fn is_noise(number: f64) -> bool {
    number.abs() < NOISE
}
