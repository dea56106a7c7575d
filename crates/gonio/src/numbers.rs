//! Numbers in reports.

/// Magnitude below which a number is noise: rounding errors of terms of about 1 are smaller in f64 (2e-16 each), and so is what
/// remains of a term that vanishes, such as a cosine to a high power. No report shows as many digits of anything it is added to.
const NOISE: f64 = 1e-12;

/// Whether a number is 0 but for rounding errors.
pub fn is_noise(number: f64) -> bool {
    number.abs() < NOISE
}
