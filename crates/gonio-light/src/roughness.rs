//! From roughness, as physically based materials have it, to the exponent of the light equation, and back.
//!
//! A microfacet surface of roughness r has alpha = r^2 (B. Burley, 2012, "Physically based shading at Disney", section
//! 5.4), and a Blinn-Phong lobe about as wide as its own has the exponent 2 / alpha^2 - 2 (B. Walter et al., 2007,
//! "Microfacet models for refraction through rough surfaces", section 5.2).

/// No roughness gives a larger exponent: a lobe of it is a degree wide, and a mirror's would never be seen.
pub const SHININESS_OF_ROUGHNESS_MAX: f64 = 10_000.0;

/// The exponent of a roughness in [0, 1] (beyond: as at the edge), from 1 to [`SHININESS_OF_ROUGHNESS_MAX`].
pub fn shininess_of_roughness(roughness: f64) -> f64 {
    let alpha = roughness * roughness;
    (2.0 / (alpha * alpha).max(1e-12) - 2.0).clamp(1.0, SHININESS_OF_ROUGHNESS_MAX)
}

/// The roughness of an exponent, in (0, 1]: the inverse, where there is one.
pub fn roughness_of_shininess(shininess: f64) -> f64 {
    (2.0 / (shininess.max(0.0) + 2.0)).powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_and_back() {
        // alpha 0.25: 2 / 0.0625 - 2.
        assert_eq!(shininess_of_roughness(0.5), 30.0);
        assert_eq!((shininess_of_roughness(0.0), shininess_of_roughness(1.0)), (SHININESS_OF_ROUGHNESS_MAX, 1.0));
        for shininess in [1.0, 2.0, 32.0, 500.0, 9_999.0] {
            let back = shininess_of_roughness(roughness_of_shininess(shininess));
            // Two powers in f64.
            assert!((back / shininess - 1.0).abs() < 1e-12, "{shininess}: {back}");
        }
    }
}
